//! Built-in scenes and recurrences with numbers put in.

use crate::picture::{PictureError, Sampled, sampled};
use wavestep::planner::Purpose;
use wavestep::problem::Problem;
use wavestep_polynomial::Rational;

pub(super) fn problem(name: &str, given: &[(&str, Rational)]) -> Problem {
    let text = wavestep::scenes::find(name).expect("a built-in scene").text;
    let values = given.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    Problem::of_text(name, text, &values).expect("a built-in scene")
}

/// The values of an observable on a window from 0.
pub(super) fn course(
    problem: &Problem,
    name: &str,
    last: &Rational,
) -> Result<Sampled, PictureError> {
    let window = [&Rational::default(), last];
    Ok(sampled(&*problem.signal_on(&problem.wanted(name)?, window, Purpose::Search)?)?)
}
