//! What of a problem is drawn against time, and on which window.

use super::{Course, PictureError, sampled};
use crate::hertz::ContactOfScene;
use crate::nearest;
use wavestep::ball::Ball;
use wavestep::planner::Purpose;
use wavestep::problem::{Problem, ProblemError, Wanted, two_figures};
use wavestep::signal::Signal;
use wavestep_polynomial::Rational;

/// How many units of time of a local contact are shown where no end is given.
const UNITS: f64 = 8.0;

const BITS: u64 = 64;

/// The usual window from a time on: some periods; with a local contact some units of its time, and twice
/// the time until a wave returns to it.
pub fn usual_end(problem: &Problem, from: &Rational) -> Result<Rational, PictureError> {
    let length = match problem.local_contact() {
        None => problem.usual_length()?,
        Some(_) => {
            let contact = ContactOfScene::new(problem.scaled()?, BITS);
            let contact = contact.map_err(|_| ProblemError::NoEnd)?;
            let seconds = |ball: &Ball| nearest(&ball.to_decimal(15).midpoint().to_rational());
            let returned = contact.first_return.as_ref().map_or(0.0, |time| 2.0 * seconds(time));
            two_figures((seconds(&contact.bars.time_unit) * UNITS).max(returned))?
        }
    };
    Ok(from + length)
}

/// The window from a time to another, to the usual end where none is given.
pub fn window(
    problem: &Problem,
    from: Rational,
    to: Option<Rational>,
) -> Result<[Rational; 2], PictureError> {
    let to = to.map_or_else(|| usual_end(problem, &from), Ok)?;
    Ok(problem.between(from, to)?)
}

/// The waves and observables of these names on a window, or all observables.
pub fn courses(
    problem: &Problem,
    names: &[String],
    window: [&Rational; 2],
) -> Result<Vec<Course>, PictureError> {
    let all = problem.observables();
    let names = if names.is_empty() { all } else { names.iter().map(String::as_str).collect() };
    if names.is_empty() {
        return Err(PictureError::NothingObserved);
    }
    let names = names.into_iter();
    let wanted: Vec<Wanted> = names.map(|name| problem.wanted(name)).collect::<Result<_, _>>()?;
    let signals = problem.signals_on(&wanted, window, Purpose::Polynomials).into_iter();
    wanted.iter().zip(signals).map(|(wanted, signal)| course(problem, wanted, &*signal?)).collect()
}

/// What is drawn of a quantity.
pub fn course(
    problem: &Problem,
    wanted: &Wanted,
    signal: &dyn Signal,
) -> Result<Course, PictureError> {
    let values = sampled(signal)?;
    if values.points.iter().any(|(_, value)| value.is_infinite()) {
        return Err(PictureError::TooLarge(wanted.name.clone()));
    }
    let (name, dimension) = (wanted.name.clone(), wanted.dimension);
    Ok(Course { name, dimension, measure: problem.measure(wanted), values })
}
