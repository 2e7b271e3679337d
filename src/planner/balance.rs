//! Energies and momenta with what flows in, their derivative: what roots and extrema ask for.

use super::SignalError;
use super::energy;
use super::together::Sources;
use crate::expression::{Fraction, Root};
use crate::network::{Balance, FlowTerm, Observed, ObservedValue, Squared};
use crate::signal::{
    Balanced, ClosedSignal, Combination, Constant, Operation, Product, Scale, Signal,
};
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// An energy or a momentum on a window of the user's time; one value where nothing flows in.
pub(super) fn of_sources<'a>(
    sources: &Sources<'a>,
    observed: &Observed,
    Balance { at_start, flow }: &Balance,
    window: [&Rational; 2],
) -> Result<Box<dyn Signal + 'a>, SignalError> {
    let network = sources.network;
    let scale = Scale::of(network);
    let unit = observed.unit.clone();
    if flow.is_empty() {
        let rule = Constant::new(&scale, at_start.clone());
        return Ok(Box::new(Operation::new(&scale, rule, unit, window)));
    }
    let one = Root::from(Fraction::one());
    let of: Box<dyn Signal + 'a> = match &observed.value {
        ObservedValue::Energy(terms) => energy::of_sources(sources, terms, &one, window)?,
        ObservedValue::Linear(value) => sources.signal(value, &observed.readings, window)?,
    };
    let factors = flow.iter().flat_map(|term| &term.factors);
    let mut operands = sources.signals(
        factors.map(|(reading, waves)| (waves, Squared::Reading(reading.clone()), window)),
    )?;
    let mut places = 0..operands.len();
    let mut products = Vec::new();
    for FlowTerm { coefficient, factors, acts, course } in flow {
        let mut factors: Vec<usize> = places.by_ref().take(factors.len()).collect();
        // What is known to be zero before and after is a product with zero there.
        let acting = acts.as_ref().map(|acts| Constant::within(&scale, acts, window));
        if let Some(Ok(acting)) = acting {
            factors.push(operands.len());
            operands.push(Rc::new(Operation::new(&scale, acting, one.clone(), window)));
        }
        if let Some(course) = course {
            factors.push(operands.len());
            operands.push(Rc::new(ClosedSignal::of_course(network, course, window)?));
        }
        products.push(Product { coefficient: coefficient.clone(), factors });
    }
    let flow = Combination { scale: Rc::clone(&scale), operands, products };
    let flow = Box::new(Operation::new(&scale, flow, one, window));
    let rule = Balanced::new(&scale, of, flow);
    Ok(Box::new(Operation::new(&scale, rule, unit, window)))
}
