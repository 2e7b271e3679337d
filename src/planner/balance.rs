//! Energies and momenta with what flows in, their derivative: what roots and extrema ask for.

use super::SignalError;
use super::energy;
use super::together::Sources;
use crate::expression::{Fraction, Root};
use crate::network::{Balance, Observed, ObservedValue};
use crate::signal::{Balanced, Constant, Operation, Scale, Signal};
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
        ObservedValue::Energy(sum) => energy::of_sources(sources, sum, &one, window)?,
        ObservedValue::Linear(value) => sources.signal(value, &observed.readings, window)?,
    };
    let flow = Box::new(energy::power(sources, flow, window)?);
    let rule = Balanced::new(&scale, of, flow);
    Ok(Box::new(Operation::new(&scale, rule, unit, window)))
}
