//! Energies and momenta with what flows in, their derivative: what roots and extrema ask for.

use super::energy;
use super::{SignalError, has_periods};
use crate::expression::{Fraction, Root};
use crate::history::{FollowedSignal, Follower};
use crate::network::{Balance, FlowTerm, Network, Observed, ObservedValue, Squared};
use crate::signal::{
    Balanced, ClosedSignal, Combination, Constant, Operation, Product, Scale, Signal,
};
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// An energy or a momentum on a window of the user's time; one value where nothing flows in.
pub(super) fn of_scene<'a>(
    network: &'a Network,
    observed: &Observed,
    Balance { at_start, flow }: &Balance,
    window: [&Rational; 2],
) -> Result<Box<dyn Signal + 'a>, SignalError> {
    let scale = Scale::of(network);
    let unit = observed.unit.clone();
    if flow.is_empty() {
        let rule = Constant { scale: Rc::clone(&scale), value: at_start.clone() };
        return Ok(Box::new(Operation::new(&scale, rule, unit, window)));
    }
    let one = Root::from(Fraction::one());
    let of: Box<dyn Signal + 'a> = match &observed.value {
        ObservedValue::Energy(terms) => energy::of_scene(network, terms, &one, window)?,
        ObservedValue::Linear(value) if has_periods(network) => {
            let [momentum] = ClosedSignal::several(network, &[(value, window)], window[1])?
                .try_into()
                .unwrap_or_else(|_| unreachable!("one for each"));
            Box::new(momentum)
        }
        ObservedValue::Linear(_) => {
            let scaled = Observed { unit: one.clone(), ..observed.clone() };
            Box::new(FollowedSignal::of_scene(network, &scaled, window)?)
        }
    };
    let operands = factors(network, flow, window)?;
    let mut places = 0..operands.len();
    let product = |term: &FlowTerm| Product {
        coefficient: term.coefficient.clone(),
        factors: places.by_ref().take(term.factors.len()).collect(),
    };
    let products = flow.iter().map(product).collect();
    let flow = Combination { scale: Rc::clone(&scale), operands, products };
    let flow = Box::new(Operation::new(&scale, flow, one, window));
    let rule = Balanced::new(&scale, of, flow);
    Ok(Box::new(Operation::new(&scale, rule, unit, window)))
}

/// The factors of all terms, one after the other.
fn factors<'a>(
    network: &'a Network,
    flow: &[FlowTerm],
    window: [&Rational; 2],
) -> Result<Vec<Rc<dyn Signal + 'a>>, SignalError> {
    let all = flow.iter().flat_map(|term| &term.factors);
    if has_periods(network) {
        let all: Vec<_> = all.map(|(_, waves)| (waves, window)).collect();
        let signals = ClosedSignal::several(network, &all, window[1])?.into_iter();
        return Ok(signals.map(|signal| Rc::new(signal) as Rc<dyn Signal>).collect());
    }
    let follower = Follower::new(network, window[1])?;
    let mut signals: Vec<Rc<dyn Signal + 'a>> = Vec::new();
    for (reading, _) in all {
        let reading = Squared::Reading(reading.clone());
        signals.push(Rc::new(FollowedSignal::squared(&follower, &reading, window)?));
    }
    Ok(signals)
}
