//! Why fields cannot be given.

use crate::ball::Ball;
use crate::enclosure::EnclosureError;
use crate::network::NetworkError;
use crate::planner::SignalError;
use crate::signal::EvaluateError;
use wavestep_polynomial::Rational;

/// Why fields cannot be given.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum FieldError {
    /// A number of cells that a bar is not divided into.
    #[error("{cells} cells per bar are not possible: give 1 to {limit}")]
    Cells {
        /// The name that was asked for.
        cells: usize,
        /// The most.
        limit: usize,
    },
    /// No bar of the line has this name.
    #[error("the line has no bar `{name}`: its bars are {}", bars.join(", "))]
    UnknownBar {
        /// The name.
        name: String,
        /// The bars of the scene.
        bars: Vec<String>,
    },
    /// A time before the start.
    #[error("the time {0} is before the start: give a time from 0 on")]
    Negative(Rational),
    /// A section at a distance below zero.
    #[error("the distance {0} is outside the bar: give one above 0")]
    NegativeReach(Rational),
    /// A wave cannot be evaluated.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// The precision allowed does not tell whether an instant comes before or after a break of a wave
    /// of which only an enclosure is known.
    #[error(
        "with {bits} bits it is undecided whether a place is ahead of or behind the front of an opening \
         or closing contact, which enters the bar about t = {}",
        at.to_decimal(20)
    )]
    Undecided {
        /// About the break, in the scale of the scene.
        at: Box<Ball>,
        /// The precision in bits.
        bits: u64,
    },
}

impl From<EvaluateError> for FieldError {
    fn from(error: EvaluateError) -> FieldError {
        FieldError::Signal(error.into())
    }
}

impl From<EnclosureError> for FieldError {
    fn from(error: EnclosureError) -> FieldError {
        EvaluateError::from(error).into()
    }
}

impl From<NetworkError> for FieldError {
    fn from(error: NetworkError) -> FieldError {
        EvaluateError::from(error).into()
    }
}
