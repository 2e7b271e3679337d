//! From which order on digits are lost: every order measured where the loss begins.

use crate::study::curves::HALF;
use crate::study::harness::Subject;
use crate::study::map::errors_by_order;
use wavestep::answer::Method;
use wavestep_draw::{Axis, Caption, Curve, Curves, Listing, PlotError};

/// The first orders at which a way has lost digits, for one value of a parameter.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Loss {
    pub parameter: f64,
    /// The first order with an error of 1e-8 of the largest value, or more.
    pub half: Option<usize>,
    /// The first order with an error as large as the largest value, or larger.
    pub all: Option<usize>,
}

/// The first orders, up to the last given one, at which the error of a way reaches 1e-8 and 1.
///
/// `known` are errors at ascending orders. Between the last order below a level and the first one that is
/// not, each order is measured.
pub fn first_losses(
    subject: Subject<'_>,
    method: Method,
    (parameter, period): (f64, f64),
    (orders, known): (&[usize], &[Option<f64>]),
) -> Loss {
    let first = |level: f64| {
        let is_lost = |error: &Option<f64>| error.is_some_and(|error| error >= level);
        let place = known.iter().position(is_lost)?;
        let before = place.checked_sub(1).map_or(0, |place| orders[place]);
        let between: Vec<usize> = (before + 1..orders[place]).collect();
        let row = errors_by_order(subject, period, &between, &[method]).swap_remove(0);
        let found = row.errors.iter().position(is_lost).map(|place| between[place]);
        Some(found.unwrap_or(orders[place]))
    };
    Loss { parameter, half: first(HALF), all: first(1.0) }
}

/// Losses as a chart over the parameter, and as a small table.
pub fn losses(
    method: Method,
    parameter: &str,
    last: usize,
    rows: &[Loss],
    caption: Caption,
) -> Result<(Curves, Listing), PlotError> {
    let curve = |name: &str, of: fn(&Loss) -> Option<usize>| {
        let point = |loss: &Loss| Some((loss.parameter, of(loss)? as f64));
        Curve { name: name.to_owned(), points: rows.iter().filter_map(point).collect() }
    };
    let mut curves = vec![
        curve("8 digits lost: error 1e-8", |loss| loss.half),
        curve("all digits lost: error 1", |loss| loss.all),
    ];
    curves.retain(|curve| !curve.points.is_empty());
    let title = format!("First order at which {method} has lost digits");
    let (x, y) = (Axis::logarithmic(parameter), Axis::logarithmic("order n"));
    let chart = Curves::new(&title, x, y, curves, caption)?;
    let told = |order: Option<usize>| match order {
        Some(order) => order.to_string(),
        None => format!("> {last}"),
    };
    let row = |loss: &Loss| vec![loss.parameter.to_string(), told(loss.half), told(loss.all)];
    let listing = Listing {
        caption: format!("{title}, by {parameter}. Orders to {last} were looked at."),
        heads: vec![parameter.to_owned(), "8 digits lost".to_owned(), "all digits lost".to_owned()],
        rows: rows.iter().map(row).collect(),
    };
    Ok((chart, listing))
}
