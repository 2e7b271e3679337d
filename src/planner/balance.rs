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

/// The precision at which a coefficient without a sign counts as unknown.
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

/// The sign that a flow has wherever it is not zero: that of squares which outweigh the products of different readings, as what
/// dampers take up, `−c (v₁ − v₂)²`. `|2 v₁ v₂| ≤ v₁² + v₂²`.
fn trend(numbers: &Numbers, flow: &[FlowTerm]) -> Option<Ordering> {
    let sign = |value: &Fraction| match value.is_zero() {
        true => Some(Ordering::Equal),
        false => numbers.enclose(value, SIGN_BITS).ok()?.sign(),
    };
    let (mut trend, mut weights) = (None, Vec::<(&Reading, Fraction)>::new());
    let squares = flow.iter().filter_map(|term| match &term.factors[..] {
        [(one, _), (other, _)] if one == other => Some(&term.coefficient),
        _ => None,
    });
    for coefficient in squares {
        let own = sign(coefficient)?;
        if *trend.get_or_insert(own) != own {
            return None;
        }
    }
    let trend = trend?;
    let mut weigh =
        |reading, share: &Fraction| match weights.iter_mut().find(|(own, _)| *own == reading) {
            Some((_, weight)) => *weight = &*weight + share,
            None => weights.push((reading, share.clone())),
        };
    for FlowTerm { coefficient, factors, acts, course } in flow {
        let ([(one, _), (other, _)], None, None) = (&factors[..], acts, course) else {
            return None;
        };
        // Half of a product counts for each square, and a square of one reading twice for it.
        let against = match one != other && sign(coefficient)? == trend {
            true => -coefficient,
            false => coefficient.clone(),
        };
        [one, other].into_iter().for_each(|reading| weigh(reading, &against));
    }
    let outweighs = |(_, weight): &(&Reading, Fraction)| {
        sign(weight).is_some_and(|own| own.is_eq() || own == trend)
    };
    weights.iter().all(outweighs).then_some(trend)
}
