//! What of a problem is drawn against time, and on which window.

use super::{Course, PictureError, Sampled, sampled};
use crate::hertz::ContactOfScene;
use crate::nearest;
use wavestep::answer::{Accuracy, Method, Remark, Tested};
use wavestep::ball::Ball;
use wavestep::planner::Purpose;
use wavestep::problem::{Problem, ProblemError, Wanted, two_figures};
use wavestep::signal::Limit;
use wavestep_polynomial::Rational;

/// The method for local contacts: far finer than a picture shows.
const MODEL: Method = Method::Steps { tolerance: 1e-8 };

/// At how many times it is asked.
const POINTS: usize = 1000;

/// How many units of time of a local contact are shown where no end is given.
const UNITS: f64 = 8.0;

const BITS: u64 = 64;

/// The usual window from a time on: some periods; with a local contact some units of its time, and twice
/// the time until a wave returns to it.
pub fn usual_end(problem: &Problem, from: &Rational) -> Result<Rational, PictureError> {
    let length = match problem.usual_method() {
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

/// The waves and observables of these names on a window, or all observables; with a local contact also
/// how far their values were tested.
pub fn courses(
    problem: &Problem,
    names: &[String],
    window: [&Rational; 2],
) -> Result<(Vec<Course>, Option<Tested>), PictureError> {
    let all = problem.observables();
    let names = if names.is_empty() { all } else { names.iter().map(String::as_str).collect() };
    if names.is_empty() {
        return Err(PictureError::NothingObserved);
    }
    let mut tested = None;
    let mut courses = Vec::new();
    for name in names {
        let wanted = problem.wanted(name)?;
        let values = match problem.usual_method() {
            None => sampled(&*problem.signal_on(&wanted, window, Purpose::Stretches)?)?,
            Some(_) => {
                let (values, remark) = by_model(problem, &wanted, window)?;
                tested = tested.or(remark);
                values
            }
        };
        if values.points.iter().any(|(_, value)| value.is_infinite()) {
            return Err(PictureError::TooLarge(wanted.name.clone()));
        }
        let (name, dimension) = (wanted.name.clone(), wanted.dimension);
        courses.push(Course { name, dimension, measure: problem.measure(&wanted), values });
    }
    Ok((courses, tested))
}

fn by_model(
    problem: &Problem,
    wanted: &Wanted,
    window: [&Rational; 2],
) -> Result<(Sampled, Option<Tested>), PictureError> {
    let [from, to] = window.map(nearest);
    let times: Vec<f64> =
        (0..=POINTS).map(|i| from + (to - from) * i as f64 / POINTS as f64).collect();
    let exact: Vec<Rational> =
        times.iter().filter_map(|time| Rational::from_float(*time)).collect();
    let accuracy = Accuracy::Method(MODEL, None);
    let found = problem.doubles(&wanted.name, &exact, Limit::Right, accuracy)?;
    let tested = found.remarks.into_iter().find_map(|remark| match remark {
        Remark::Tested(tested) => Some(tested),
        _ => None,
    });
    let points = times.into_iter().zip(found.values).collect();
    Ok((Sampled { points, jumps: Vec::new() }, tested))
}
