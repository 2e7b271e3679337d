//! Values that the page shows under a pointer: doubles nearest to the exact values, at times that are
//! short decimals, so that `eval` and `field` give the same for what is shown.

use crate::picture::{PictureError, Places, Prefixed};
use serde_json::{Value as Json, json};
use wavestep::ball::{Ball, in_decimals};
use wavestep::field::{FieldEvaluator, Mesh, Quantity};
use wavestep::limits::VALUE_BITS;
use wavestep::problem::{Digits, Problem};
use wavestep::scene::End;
use wavestep::signal::{Limit, Value};
use wavestep_polynomial::Rational;

/// Into how many parts the window is cut for observables, and for fields; and each bar.
const PARTS: i64 = 240;
const PARTS_OF_FIELDS: i64 = 48;
const CELLS: usize = 24;

/// As many digits as tell a double.
const DIGITS: usize = 17;

/// About so many times from zero to the end of a window, multiples of a power of ten.
pub fn times(to: &Rational, parts: i64) -> Vec<Rational> {
    let step = crate::nearest(to) / parts as f64;
    let power = step.log10().floor() as i32 - 1;
    let ten = Rational::from_integer(10.into());
    let grid = if power < 0 { ten.pow(-power).recip() } else { ten.pow(power) };
    let part = |k: i64| to * Rational::new(k.into(), parts.into());
    let mut times: Vec<Rational> = (0..=parts).map(|k| (part(k) / &grid).floor() * &grid).collect();
    times.dedup();
    times
}

/// The values of observables at times, by name; a quantity whose values are not proven has none.
pub fn samples(problem: &Problem, names: &[&str], to: &Rational) -> Result<Json, PictureError> {
    let times = times(to, PARTS);
    let digits =
        Digits { count: DIGITS, max_bits: VALUE_BITS, limit: Limit::Right, count_echoes: false };
    let quantity = |name: &&str| -> Result<Json, PictureError> {
        let wanted = problem.wanted(name)?;
        let found = problem.proven(&wanted, &times, digits, &|| ()).ok();
        let values = found.map(|found| found.values.iter().map(Value::to_f64).collect::<Vec<_>>());
        Ok(json!({ "name": name, "unit": wanted.unit(), "values": values }))
    };
    let quantities = names.iter().map(quantity).collect::<Result<Vec<_>, _>>()?;
    Ok(json!({
        "times": times.iter().map(in_decimals).collect::<Vec<_>>(),
        "unit": problem.time_unit(),
        "quantities": quantities,
    }))
}

/// The values of a field at the nodes of bars, with the places of these nodes in a diagram.
pub fn fields(
    evaluator: &FieldEvaluator<'_>,
    quantity: Quantity,
    to: &Rational,
) -> Result<Json, PictureError> {
    let network = evaluator.network();
    let scene = network.scene();
    let zero = Rational::default();
    let bars = evaluator.waves([&zero, to], 2)?;
    let places = Places::of(network, bars.iter().map(|bar| bar.length))?;
    let largest = places.window.0.abs().max(places.window.1);
    let metre = Prefixed::in_scene(scene.dimensional, "m", largest);
    let names: Vec<&str> = evaluator.bars().collect();
    let mirrored = |bar: usize| bar == 0 && scene.line.left == End::Endless;
    let times = times(to, PARTS_OF_FIELDS);
    let mesh = Mesh::new(CELLS)?;
    let mut rows = Vec::with_capacity(times.len());
    for time in &times {
        let fields = evaluator.at(time, &mesh)?;
        let row = fields.bars.iter().enumerate().flat_map(|(bar, own)| {
            let left = places.lefts[bar];
            let place = move |x: f64| if mirrored(bar) { -x } else { left + x };
            own.x.iter().zip(own.of(quantity)).map(move |(x, value)| {
                let shown = place(*x) * metre.factor;
                json!([bar, x, (shown * 1e4).round() / 1e4, value.value])
            })
        });
        rows.push(row.collect::<Vec<Json>>());
    }
    let dimensional = |unit: String| if scene.dimensional { unit } else { String::new() };
    let [low, high] = [places.window.0, places.window.1].map(|x| x * metre.factor);
    Ok(json!({
        "times": times.iter().map(in_decimals).collect::<Vec<_>>(),
        "unit": dimensional("s".to_owned()),
        "quantity": quantity.name(),
        "own": dimensional(quantity.dimension().unit()),
        "place": dimensional("m".to_owned()),
        "across": [low, high],
        "bars": names,
        "rows": rows,
    }))
}

/// A time in shown units.
pub fn shown(to: &Rational, dimensional: bool) -> (f64, f64) {
    let seconds = Ball::from_rational(to, 64).to_double().0;
    let unit = Prefixed::in_scene(dimensional, "s", seconds);
    (seconds * unit.factor, unit.factor)
}
