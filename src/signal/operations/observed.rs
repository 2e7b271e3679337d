//! What is observed of a recurrence: in closed form, or as a sum of products of such.

use super::{Combination, Operation, Outcome, Product, Scale};
use crate::expression::{Fraction, Root};
use crate::recurrence::{Observation, ProductTerm, Quadratic};
use crate::signal::{ClosedSignal, Signal};
use crate::solution::Solution;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// A wave or an observable of a recurrence on a window of time; none where nothing has this name.
pub fn of_recurrence<'a>(
    solution: &'a Solution,
    name: &str,
    window: [&Rational; 2],
) -> Outcome<Option<Box<dyn Signal + 'a>>> {
    let recurrence = solution.recurrence();
    if let Some(observation) = recurrence.observation(name) {
        return Ok(Some(Box::new(ClosedSignal::of_recurrence(solution, &observation, window)?)));
    }
    let Some(Quadratic { terms, .. }) = recurrence.quadratic(name) else { return Ok(None) };
    let mut seen: Vec<&Observation> = Vec::new();
    let mut place = |factor| match seen.iter().position(|known| *known == factor) {
        Some(place) => place,
        None => {
            seen.push(factor);
            seen.len() - 1
        }
    };
    let product = |ProductTerm { coefficient, factors }: &'a ProductTerm| Product {
        coefficient: coefficient.clone(),
        factors: factors.iter().map(&mut place).collect(),
    };
    let products = terms.iter().map(product).collect();
    let mut operands: Vec<Rc<dyn Signal + 'a>> = Vec::new();
    for observation in seen {
        operands.push(Rc::new(ClosedSignal::of_recurrence(solution, observation, window)?));
    }
    let scale = Scale::of_recurrence(recurrence);
    let sum = Combination { scale: Rc::clone(&scale), operands, products };
    Ok(Some(Box::new(Operation::new(&scale, sum, Root::from(Fraction::one()), window))))
}
