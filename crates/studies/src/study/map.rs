//! Maps of the error over the order and a parameter of the scene.

use crate::study::curves::{HALF, USELESS};
use crate::study::harness::{Subject, worst};
use crate::study::reference::{Reference, Sampling};
use wavestep::answer::{Method, Way};
use wavestep::problem::ProblemError;
use wavestep_draw::{Axis, Caption, Map, PlotError};

/// How many times a period are drawn uniformly, and as many near its arrival.
const TIMES: usize = 8;

/// The nearest of the times after an arrival: `10^−NEAREST` of a period.
const NEAREST: f64 = 6.0;

/// What is known of one way for one value of the parameter.
#[derive(Clone, Debug)]
pub struct OrderRow {
    /// The largest error on each period; `None` where the way has no values.
    pub errors: Vec<Option<f64>>,
    pub refusal: Option<ProblemError>,
}

/// The law by which [`errors_by_order`] draws times.
pub fn order_law() -> String {
    format!(
        "{} times on each period: {TIMES} uniform, {TIMES} whose distance from the arrival is uniform in \
         its logarithm, from 10^-{NEAREST} of a period on",
        2 * TIMES
    )
}

/// Times on the period that begins after so many: uniform, and near its arrival. Of a long period all that
/// happens may lie in a small part after the arrival.
fn times_on(order: usize, period: f64) -> Vec<f64> {
    let from = order as f64 * period;
    let seed = order as u64;
    let uniform = Sampling { points: TIMES, seed }.times(0.0, 1.0);
    let near = Sampling { points: TIMES, seed: !seed }.times(-NEAREST, 0.0);
    let mut shares: Vec<f64> = near.iter().map(|power| 10f64.powf(*power)).collect();
    shares.extend(uniform);
    shares.sort_by(f64::total_cmp);
    shares.iter().map(|share| from + share * period).collect()
}

/// The largest error on each of some periods, ascending, for each of some ways. Where a way refuses, it
/// is asked again without the last period, until it does not.
pub fn errors_by_order(
    subject: Subject<'_>,
    period: f64,
    orders: &[usize],
    methods: &[Method],
) -> Vec<OrderRow> {
    let until = |orders: &[usize]| {
        subject.between(0.0, (orders.last().copied().unwrap_or(0) as f64 + 1.0) * period)
    };
    let times: Vec<f64> = orders.iter().flat_map(|order| times_on(*order, period)).collect();
    let reference = until(orders).and_then(|question| Ok(Reference::new(&question, &times)?));
    let reference = match reference {
        Ok(reference) => reference,
        Err(refusal) => {
            let refused = OrderRow { errors: vec![None; orders.len()], refusal: Some(refusal) };
            return vec![refused; methods.len()];
        }
    };
    let row = |method: &Method| {
        let mut refusal = None;
        for known in (1..=orders.len()).rev() {
            let known_times = &times[..known * 2 * TIMES];
            let values = until(&orders[..known])
                .and_then(|question| Ok(Way::new(*method, &question, None)?.values(known_times)?));
            match values {
                Ok(values) => {
                    let errors = reference.errors(&values);
                    let worst = errors.chunks(2 * TIMES).map(|errors| Some(worst(errors)));
                    let mut errors: Vec<Option<f64>> = worst.collect();
                    errors.resize(orders.len(), None);
                    return OrderRow { errors, refusal };
                }
                Err(error) => {
                    refusal.get_or_insert(error);
                }
            }
        }
        OrderRow { errors: vec![None; orders.len()], refusal }
    };
    methods.iter().map(row).collect()
}

/// A map from its rows, each for one value of the parameter, ascending.
pub fn order_map(
    method: Method,
    parameter: &str,
    orders: &[usize],
    rows: &[(f64, Vec<Option<f64>>)],
    caption: Caption,
) -> Result<Map, PlotError> {
    let orders = orders.iter().map(|order| *order as f64).collect();
    let values = rows.iter().map(|(value, _)| *value).collect();
    let cells = rows.iter().flat_map(|(_, row)| row.iter().copied()).collect();
    let x = (Axis::logarithmic("order n"), orders);
    let y = (Axis::logarithmic(parameter), values);
    let map =
        Map::new(&format!("Error of {method} by order and {parameter}"), x, y, cells, caption)?;
    let map = map.level(HALF, "8 digits lost")?.level(USELESS, "useful no longer")?;
    map.level(1.0, "all digits lost")?.decades(-17, 1)
}
