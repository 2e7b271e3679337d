//! Energies and momenta with what flows in, their derivative: what roots and extrema ask for.

use super::SignalError;
use super::energy;
use super::together::Sources;
use crate::enclosure::Numbers;
use crate::expression::{Fraction, Root};
use crate::network::{Balance, FlowTerm, Observed, ObservedValue, Reading};
use crate::signal::{Balanced, Constant, Operation, Scale, Signal};
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// Bits with which the sign of a coefficient is looked for.
const SIGN_BITS: u64 = 128;

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
        ObservedValue::Energy(sum) => energy::of_sources(sources, sum, &one, window)?,
        ObservedValue::Linear(value) => sources.signal(value, &observed.readings, window)?,
    };
    let trend = trend(&scale.numbers, flow);
    let flow = Box::new(energy::power(sources, flow, window)?);
    let rule = Balanced::new(&scale, of, flow, trend);
    Ok(Box::new(Operation::new(&scale, rule, unit, window)))
}

/// The sign that a flow has wherever it is not zero, if that is known: products of two readings, of which the squares outweigh the
/// rest, by `2 |v₁ v₂| ≤ v₁² + v₂²`. What a damper takes up, `−c (v₁ − v₂)²`, is one.
fn trend(numbers: &Numbers, flow: &[FlowTerm]) -> Option<Ordering> {
    let signs = [Ordering::Less, Ordering::Greater];
    signs.into_iter().find(|sign| has_sign(numbers, flow, *sign) == Some(true))
}

/// Whether a flow has this sign wherever it is not zero; `None` or false where that is not known.
fn has_sign(numbers: &Numbers, flow: &[FlowTerm], wanted: Ordering) -> Option<bool> {
    let sign = |value: &Fraction| match value.is_zero() {
        true => Some(Ordering::Equal),
        false => numbers.enclose(value, SIGN_BITS).ok()?.sign(),
    };
    // Of each reading twice what its square counts, less what its products may count against it.
    let mut weights: Vec<(&Reading, Fraction)> = Vec::new();
    for FlowTerm { coefficient, factors, acts, course } in flow {
        let ([(one, _), (other, _)], None, None) = (&factors[..], acts, course) else {
            return None;
        };
        let share = match one != other && sign(coefficient)? == wanted {
            true => -coefficient,
            false => coefficient.clone(),
        };
        for reading in [one, other] {
            match weights.iter_mut().find(|(own, _)| *own == reading) {
                Some((_, weight)) => *weight = &*weight + &share,
                None => weights.push((reading, share.clone())),
            }
        }
    }
    let outweighs = |(_, weight): &(&Reading, Fraction)| {
        sign(weight).is_some_and(|own| own.is_eq() || own == wanted)
    };
    Some(weights.iter().all(outweighs))
}
