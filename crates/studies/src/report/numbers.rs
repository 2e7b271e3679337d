//! Values that the page shows under a pointer: doubles nearest to the exact values, at times that are
//! short decimals, so that `eval` and `field` give the same for what is shown.

use super::Observed;
use crate::picture::{PictureError, Places, Prefixed};
use serde_json::{Value as Json, json};
use wavestep::ball::in_decimals;
use wavestep::field::{FieldEvaluator, Fields, Mesh, Quantity};
use wavestep::limits::VALUE_BITS;
use wavestep::scene::End;
use wavestep::signal::{Limit, digits};
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

/// What figures share: times as short decimals, the end of the window, and the factor of shown times.
fn over_time(times: &[Rational], to: &Rational, dimensional: bool) -> Json {
    let end = crate::nearest(to);
    json!({
        "times": times.iter().map(in_decimals).collect::<Vec<_>>(),
        "unit": if dimensional { "s" } else { "" },
        "end": end,
        "factor": Prefixed::in_scene(dimensional, "s", end).factor,
    })
}

/// The values of observables at times, by name; one whose digits are not all proven has none.
pub fn samples(observed: &[Observed<'_>], to: &Rational, dimensional: bool) -> Json {
    let times = times(to, PARTS);
    let quantity = |Observed { wanted, signal }: &Observed<'_>| {
        let value = |time| digits(&**signal, time, Limit::Right, DIGITS, VALUE_BITS);
        let values: Result<Vec<f64>, _> =
            times.iter().map(|time| value(time).map(|value| value.to_f64())).collect();
        json!({ "name": wanted.name, "unit": wanted.unit(), "values": values.ok() })
    };
    let mut data = over_time(&times, to, dimensional);
    data["quantities"] = observed.iter().map(quantity).collect();
    data
}

/// The values of fields at the nodes of bars, with the places of these nodes in a diagram.
pub fn fields(
    evaluator: &FieldEvaluator<'_>,
    quantities: &[Quantity],
    to: &Rational,
) -> Result<Vec<Json>, PictureError> {
    let network = evaluator.network();
    let scene = network.scene();
    let bars = evaluator.waves([&Rational::default(), to], 2)?;
    let places = Places::of(network, bars.iter().map(|bar| bar.length))?;
    let largest = places.window.0.abs().max(places.window.1);
    let factor = Prefixed::in_scene(scene.dimensional, "m", largest).factor;
    let mirrored = |bar: usize| bar == 0 && scene.line.left == End::Endless;
    let times = times(to, PARTS_OF_FIELDS);
    let mesh = Mesh::new(CELLS)?;
    let states =
        times.iter().map(|time| evaluator.at(time, &mesh)).collect::<Result<Vec<_>, _>>()?;
    let row = |state: &Fields, quantity: Quantity| -> Vec<Json> {
        let bars = state.bars.iter().enumerate();
        let nodes = bars.flat_map(|(bar, own)| {
            let left = places.lefts[bar];
            let place = move |x: f64| if mirrored(bar) { -x } else { left + x };
            own.x.iter().zip(own.of(quantity)).map(move |(x, value)| {
                let shown = (place(*x) * factor * 1e4).round() / 1e4;
                json!([bar, x, shown, value.value])
            })
        });
        nodes.collect()
    };
    let data = |quantity: &Quantity| {
        let unit = |unit: String| if scene.dimensional { unit } else { String::new() };
        let mut data = over_time(&times, to, scene.dimensional);
        data["quantity"] = quantity.name().into();
        data["own"] = unit(quantity.dimension().unit()).into();
        data["place"] = unit("m".to_owned()).into();
        data["across"] = json!([places.window.0 * factor, places.window.1 * factor]);
        data["bars"] = evaluator.bars().collect();
        data["rows"] = states.iter().map(|state| row(state, *quantity)).collect();
        data
    };
    Ok(quantities.iter().map(data).collect())
}
