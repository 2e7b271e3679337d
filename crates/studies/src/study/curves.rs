//! Errors along one axis: time, order, distance from a jump, Courant's number.

use crate::study::harness::{Subject, errors};
use crate::study::reference::Reference;
use wavestep::answer::{Method, Question};
use wavestep::signal::{StablePrecision, first_doubles};
use wavestep_draw::{Axis, Caption, Curve, Curves, PlotError};
use wavestep_polynomial::Rational;

/// The methods in doubles whose errors are followed.
pub const DOUBLES: [Method; 6] = [
    Method::Expanded,
    Method::Plain,
    Method::Stable(StablePrecision::Double),
    Method::Stable(StablePrecision::DoubleDouble),
    Method::Marched { proven: false },
    Method::Compiled,
];

/// An error, in parts of the largest value, from which on a result is of no use.
pub const USELESS: f64 = 1e-3;

/// An error at which half of the digits are lost.
pub const HALF: f64 = 1e-8;

/// Errors above this, in parts of the largest value, stand at the upper edge of a chart.
const CEILING: f64 = 100.0;

/// A curve for each method, of what `points` makes of its errors; what a method refused is a remark.
pub(super) fn by_method(
    methods: &[Method],
    question: &Question<'_>,
    reference: &Reference,
    caption: &mut Caption,
    points: impl Fn(&[f64]) -> Vec<(f64, f64)>,
) -> Vec<Curve> {
    let mut curves = Vec::new();
    for method in methods {
        match errors(question, *method, reference) {
            Ok(errors) => curves.push(Curve { name: method.to_string(), points: points(&errors) }),
            Err(reason) => caption.remarks.push(format!("{method} is left out: {reason}.")),
        }
    }
    curves
}

pub(super) fn empty(title: &str) -> PlotError {
    PlotError::Empty { title: title.to_owned() }
}

/// Curves with the lines at which half and all of the usefulness is lost.
fn levelled(
    title: &str,
    x: Axis,
    curves: Vec<Curve>,
    caption: Caption,
) -> Result<Curves, PlotError> {
    let chart = Curves::new(title, x, Axis::logarithmic("error"), curves, caption)?;
    chart.level(HALF, "8 digits lost")?.level(USELESS, "useful no longer")?.ceiling(CEILING)
}

/// The largest error in each of equal parts of the window.
pub fn over_time(
    reference: &Reference,
    question: &Question<'_>,
    axis: Axis,
    parts: usize,
    mut caption: Caption,
) -> Result<Curves, PlotError> {
    let times = reference.times();
    let size = times.len().div_ceil(parts).max(1);
    let curves = by_method(&DOUBLES, question, reference, &mut caption, |errors| {
        let parts = times.chunks(size).zip(errors.chunks(size));
        parts.map(|(t, e)| (t[t.len() / 2], super::worst(e))).collect()
    });
    levelled("Error over time", axis, curves, caption)
}

/// The error just after arrivals, by their number.
pub fn at_arrivals(
    question: &Question<'_>,
    most: usize,
    mut caption: Caption,
) -> Result<Curves, PlotError> {
    let title = "Error just after arrivals";
    let mut arrivals = first_doubles(&*question.signal).map_err(|_| empty(title))?.split_off(1);
    // One at the very end has no time after it.
    let [_, to] = question.signal.window();
    arrivals.retain(|at| Rational::from_float(at.next_up()).is_some_and(|at| at <= *to));
    let stride = arrivals.len().div_ceil(most).max(1);
    let chosen: Vec<(usize, f64)> = arrivals.iter().copied().enumerate().step_by(stride).collect();
    let times: Vec<f64> = chosen.iter().flat_map(|(_, at)| [*at, at.next_up()]).collect();
    let reference = Reference::new(question, &times).map_err(|_| empty(title))?;
    let curves = by_method(&DOUBLES, question, &reference, &mut caption, |errors| {
        let pairs = chosen.iter().zip(errors.chunks(2));
        pairs.map(|((n, _), pair)| (*n as f64 + 1.0, super::worst(pair))).collect()
    });
    levelled(title, Axis::linear("number of the arrival"), curves, caption)
}

/// The error at orders so high that exponentials underflow long before the echoes do.
pub fn over_order(
    subject: Subject<'_>,
    period: f64,
    orders: &[usize],
    mut caption: Caption,
) -> Result<Curves, PlotError> {
    let methods = &DOUBLES[..5];
    let rows = super::errors_by_order(subject, period, orders, methods);
    let mut curves = Vec::new();
    for (method, row) in methods.iter().zip(rows) {
        caption.remarks.extend(row.refusal.map(|refusal| format!("{method}: {refusal}.")));
        let points = orders.iter().zip(row.errors);
        let points = points.filter_map(|(order, error)| Some((*order as f64, error?))).collect();
        curves.push(Curve { name: method.to_string(), points });
    }
    curves.retain(|curve: &Curve| !curve.points.is_empty());
    levelled("Error at high orders", Axis::logarithmic("order n"), curves, caption)
}

/// The error of sums of modes by the distance from a jump, after it.
pub fn near_jump(
    question: &Question<'_>,
    unit: &str,
    mut caption: Caption,
) -> Result<Curves, PlotError> {
    const PLACES: usize = 60;
    let title = "Modes near a jump";
    let arrivals = first_doubles(&*question.signal).map_err(|_| empty(title))?.split_off(1);
    let middle = arrivals.len() / 2;
    let (Some(at), Some(next)) = (arrivals.get(middle), arrivals.get(middle + 1)) else {
        return Err(empty(title));
    };
    let distance = |i: usize| 10f64.powf(-4.0 + 3.8 * i as f64 / PLACES as f64) * (next - at);
    let times: Vec<f64> = (0..PLACES).map(|i| at + distance(i)).collect();
    let reference = Reference::new(question, &times).map_err(|_| empty(title))?;
    let methods = [30, 300, 3000].map(|count| Method::Modes { count });
    let curves = by_method(&methods, question, &reference, &mut caption, |errors| {
        times.iter().zip(errors).map(|(t, e)| (t - at, *e)).collect()
    });
    let axis = Axis::logarithmic("time after the jump").unit(unit);
    Curves::new(title, axis, Axis::logarithmic("error"), curves, caption)
}

/// The error of finite differences by Courant's number: the mean, and the largest.
pub fn over_courant(
    question: &Question<'_>,
    (reference, most_cells): (&Reference, usize),
    mut caption: Caption,
) -> Result<Curves, PlotError> {
    let numbers = [0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 0.98, 1.0];
    let mut curves = Vec::new();
    for cells in [50, 200, 800].into_iter().filter(|cells| *cells <= most_cells) {
        let (mut mean, mut largest) = (Vec::new(), Vec::new());
        for courant in numbers {
            match errors(question, Method::Leapfrog { cells, courant }, reference) {
                Ok(errors) => {
                    let sum: f64 = errors.iter().sum();
                    mean.push((courant, sum / errors.len().max(1) as f64));
                    largest.push((courant, super::worst(&errors)));
                }
                Err(reason) => {
                    caption.remarks.push(format!("{cells} cells at {courant}: {reason}."));
                    break;
                }
            }
        }
        curves.push(Curve { name: format!("{cells} cells, mean"), points: mean });
        curves.push(Curve { name: format!("{cells} cells, largest"), points: largest });
    }
    let axis = Axis::linear("Courant's number");
    let title = "Finite differences by Courant's number";
    Curves::new(title, axis, Axis::logarithmic("error"), curves, caption)
}
