//! The planner: which source of signals answers for a quantity, and what is made of its signals.
//!
//! Where contacts stay closed, waves have a closed form, which is cheap and exact; where they open, the
//! scene is followed from cell to cell. Energies are sums of squares of such signals, in bars integrated
//! over the last travel time. Who has a signal need not know which it is. Only what is no signal, such as
//! locks, remarks and refusals, asks elsewhere whether contacts open.

mod energy;
mod operations;

use crate::evaluate::{ClosedSignal, EvaluateError, Signal};
use crate::field::{FieldError, FieldEvaluator};
use crate::history::{FollowedSignal, HistoryError, field_evaluator};
use crate::network::{Network, Observed, ObservedValue};
use wavestep_polynomial::Rational;

/// Why there is no signal.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum SignalError {
    /// There is no closed form.
    #[error(transparent)]
    Closed(#[from] EvaluateError),
    /// The scene cannot be followed.
    #[error(transparent)]
    Followed(#[from] HistoryError),
    /// There are no fields along its bars.
    #[error(transparent)]
    Field(#[from] FieldError),
}

/// What is asked of a signal, which decides what is prepared.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Purpose {
    /// Values at times.
    Values,
    /// Values at times, from echoes that are counted one by one.
    Echoes,
    /// Stretches between breaks, for roots, extrema and polynomials.
    Stretches,
}

/// An observable of a scene on a window of the user's time.
///
/// # Errors
/// [`SignalError`], where the scene has no such signal.
pub fn of_scene<'a>(
    network: &'a Network,
    observed: &Observed,
    window: [&Rational; 2],
    purpose: Purpose,
) -> Result<Box<dyn Signal + 'a>, SignalError> {
    if let ObservedValue::Energy(terms) = &observed.value {
        return energy::of_scene(network, terms, &observed.unit, window);
    }
    if !network.scene().contacts_open {
        let signal = ClosedSignal::of_scene(network, observed, window)?;
        return Ok(Box::new(match purpose {
            Purpose::Echoes => signal.echo_by_echo(),
            Purpose::Values | Purpose::Stretches => signal,
        }));
    }
    let followed = FollowedSignal::new(network, &observed.name, window)?;
    Ok(match purpose {
        Purpose::Values | Purpose::Echoes => Box::new(followed),
        Purpose::Stretches => Box::new(followed.cut_at_breaks()?),
    })
}

/// Velocity, strain, displacement and force along the bars of a scene until a time.
///
/// # Errors
/// [`SignalError`], where the scene cannot be followed, and for a time before the start.
pub fn fields_of_scene(network: &Network, last: &Rational) -> Result<FieldEvaluator, SignalError> {
    Ok(match network.scene().contacts_open {
        true => field_evaluator(network, last)?,
        false => FieldEvaluator::new(network, last)?,
    })
}
