//! Why fields cannot be given.

use crate::ball::Ball;
use crate::enclosure::EnclosureError;
use crate::evaluate::EvaluateError;
use crate::network::NetworkError;
use std::fmt;
use wavestep_polynomial::Rational;

/// Why fields cannot be given.
///
/// ```
/// use wavestep::field::{FieldError, MAX_CELLS, Mesh};
///
/// let error = Mesh::new(0).unwrap_err();
/// assert_eq!(error, FieldError::Cells { cells: 0, limit: MAX_CELLS });
/// assert!(error.to_string().contains("from 1 to"));
/// ```
#[derive(Clone, PartialEq, Debug)]
pub enum FieldError {
    /// A number of cells that a bar is not divided into.
    Cells {
        /// What was asked for.
        cells: usize,
        /// The most.
        limit: usize,
    },
    /// No bar of the line has this name.
    UnknownBar {
        /// The name.
        name: String,
        /// Those that there are.
        bars: Vec<String>,
    },
    /// A time before the start.
    Negative(Rational),
    /// A section at a distance below zero.
    NegativeReach(Rational),
    /// A wave cannot be evaluated.
    Evaluate(EvaluateError),
    /// The precision allowed does not tell whether an instant comes before or after a break of a wave
    /// of which only an enclosure is known.
    Undecided {
        /// About the break, in the scale of the scene.
        at: Box<Ball>,
        /// The precision in bits.
        bits: u64,
    },
}

impl fmt::Display for FieldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FieldError::Cells { cells, limit } => {
                write!(f, "{cells} cells a bar are none that are made: give from 1 to {limit}")
            }
            FieldError::UnknownBar { name, bars } => {
                write!(f, "the line has no bar `{name}`: its bars are {}", bars.join(", "))
            }
            FieldError::Negative(time) => {
                write!(f, "the time {time} lies before the start: give a time from 0 on")
            }
            FieldError::NegativeReach(reach) => {
                write!(f, "the distance {reach} lies outside of the bar: give one above 0")
            }
            FieldError::Evaluate(error) => error.fmt(f),
            FieldError::Undecided { at, bits } => write!(
                f,
                "undecided whether a place is before or behind a front that a contact caused as it opened \
                 or closed, which enters the bar about t = {}, with {bits} bits",
                at.to_decimal(20)
            ),
        }
    }
}

impl std::error::Error for FieldError {}

impl From<EvaluateError> for FieldError {
    fn from(error: EvaluateError) -> FieldError {
        FieldError::Evaluate(error)
    }
}

impl From<EnclosureError> for FieldError {
    fn from(error: EnclosureError) -> FieldError {
        FieldError::Evaluate(error.into())
    }
}

impl From<NetworkError> for FieldError {
    fn from(error: NetworkError) -> FieldError {
        FieldError::Evaluate(EvaluateError::Network(Box::new(error)))
    }
}
