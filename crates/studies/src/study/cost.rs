//! What things cost by the order: exact derivation, preparation, and values.

use crate::study::curves::DOUBLES;
use crate::study::harness::{Measured, Settings, Subject, least, measure};
use crate::study::reference::{Reference, Sampling};
use std::time::{Duration, Instant};
use wavestep::answer::Method;
use wavestep::problem::ProblemError;
use wavestep::recurrence::{Observation, Recurrence};
use wavestep::solution::{ObserveError, Solution};
use wavestep_draw::{Axis, Caption, Curve, Curves, PlotError};

/// A derivation that takes longer is the last one: the next order may take all memory.
const PATIENCE: Duration = Duration::from_millis(300);

/// A preparation that takes less is not drawn.
const NO_PREPARATION: f64 = 1e-6;

/// Seconds to derive the pieces 0 to n of an observable exactly, for ascending orders n, nothing known
/// beforehand; the first one that takes more than 0.3 s is the last.
pub fn derivation_cost(
    recurrence: &Recurrence,
    observation: &Observation,
    orders: &[usize],
    settings: Settings,
) -> Result<Vec<(f64, f64)>, ObserveError> {
    let mut points = Vec::new();
    for &order in orders {
        let least = least(settings, PATIENCE, || {
            let solution = Solution::new(recurrence.clone());
            let start = Instant::now();
            let pieces = std::hint::black_box(solution.observed(observation, 0, order)?);
            let elapsed = start.elapsed();
            drop(pieces);
            Ok::<_, ObserveError>(elapsed)
        })?;
        points.push((order as f64, least.as_secs_f64().max(1e-9)));
        if least > PATIENCE {
            break;
        }
    }
    Ok(points)
}

/// What values cost, and what exact derivation and preparation cost, by the number of periods before
/// them: two charts, values first.
///
/// Derived are all pieces to that order, as `derive` gives them: with numbers in place of symbols, and
/// with the symbols of `symbolic`, where that is given. Prepared and evaluated is one period.
pub fn cost_over_order(
    subject: Subject<'_>,
    symbolic: Option<(&Recurrence, &Observation)>,
    period: f64,
    orders: &[usize],
    settings: Settings,
    caption: Caption,
) -> Result<[Curves; 2], PlotError> {
    let (mut of_values, mut of_preparation) = (caption.clone(), caption);
    let (mut values, mut preparations) = (Vec::new(), Vec::new());
    let numeric = numeric(subject, period);
    let numeric = numeric.as_ref().map(|(recurrence, observation)| (recurrence, observation));
    for (what, derived) in [("symbols kept", symbolic), ("numbers set", numeric)] {
        let Some((recurrence, observation)) = derived else { continue };
        let name = format!("derivation of 0 to n, {what}");
        match derivation_cost(recurrence, observation, orders, settings) {
            Ok(points) => preparations.push(Curve { name, points }),
            Err(error) => of_preparation.remarks.push(format!("{name}, is left out: {error}.")),
        }
    }
    for method in DOUBLES.into_iter().chain([Method::Certified]) {
        let mut measured = Vec::new();
        for &order in orders {
            match on_period(subject, method, (order, period), settings) {
                Ok(costs) => measured.push((order as f64, costs.seconds, costs.preparation)),
                Err(reason) => {
                    let remark = format!("{method} is left out from n = {order} on: {reason}.");
                    of_values.remarks.push(remark);
                    break;
                }
            }
        }
        let points = measured.iter().map(|(order, seconds, _)| (*order, *seconds)).collect();
        values.push(Curve { name: method.to_string(), points });
        // A difference of two times that are alike says nothing.
        let prepared = measured.iter().filter(|(_, _, preparation)| *preparation > NO_PREPARATION);
        let points = prepared.map(|(order, _, preparation)| (*order, *preparation)).collect();
        preparations.push(Curve { name: format!("{method}, period n"), points });
    }
    let chart = |title: &str, mut curves: Vec<Curve>, caption: Caption| {
        curves.retain(|curve| !curve.points.is_empty());
        let (order, seconds) = (Axis::logarithmic("order n"), Axis::logarithmic("time").unit("s"));
        Curves::new(title, order, seconds, curves, caption)
    };
    Ok([
        chart("Cost of a value by order", values, of_values)?,
        chart("Cost of derivation and preparation by order", preparations, of_preparation)?,
    ])
}

/// The recurrence with numbers, and what is seen of it.
fn numeric(subject: Subject<'_>, period: f64) -> Option<(Recurrence, Observation)> {
    let question = subject.between(0.0, period).ok()?;
    let form = question.signal.closed_form().ok()?;
    Some((form.recurrence.clone(), form.observation.clone()))
}

/// One way on the period that begins after so many.
fn on_period(
    subject: Subject<'_>,
    method: Method,
    (order, period): (usize, f64),
    settings: Settings,
) -> Result<Measured, ProblemError> {
    let [from, to] = [order as f64 * period, (order as f64 + 1.0) * period];
    let question = subject.between(from, to)?;
    let reference = Reference::new(&question, &Sampling { points: 64, seed: 1 }.times(from, to))?;
    measure((subject, question.signal.window()), (method, None), &reference, settings)
}
