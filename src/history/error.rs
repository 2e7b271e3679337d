//! Why a history is not told.

use crate::ball::Ball;
use crate::enclosure::EnclosureError;
use crate::evaluate::EvaluateError;
use crate::field::FieldError;
use std::fmt;
use wavestep_polynomial::Symbol;

/// Why a history is not told to its end.
///
/// ```
/// use wavestep::history::{History, HistoryError};
/// use wavestep::language::{Source, read_scene};
/// use wavestep::network::Network;
///
/// let text = wavestep::scenes::find("mass-on-fixed-bar").unwrap().text;
/// let scene = read_scene(&Source::new("mass", text)?, &Default::default()).unwrap();
/// let error = History::of(&Network::new(&scene).unwrap(), None, 12).err().unwrap();
/// assert!(matches!(&error, HistoryError::MissingValue(mu) if mu.name() == "mu"));
/// assert_eq!(error.to_string(), "the history needs numbers, and `mu` has no value");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum HistoryError {
    /// A symbol without a value.
    MissingValue(Symbol),
    /// A value of the scene that is no number.
    Value(EnclosureError),
    /// What is not followed, by the name of the element.
    Refused(String),
    /// Something that the precision allowed does not decide.
    Undecided {
        /// Whether what.
        what: String,
        /// About when, in the scale of the scene.
        at: Box<Ball>,
        /// The precision in bits.
        bits: u64,
    },
    /// More events than are followed.
    TooManyEvents {
        /// How many are followed.
        limit: usize,
        /// About when the last one was, in the scale of the scene.
        at: Box<Ball>,
    },
    /// More cells than are worked out.
    TooManyCells {
        /// How many are worked out.
        limit: usize,
        /// How far the history was followed, in the scale of the scene.
        at: Box<Ball>,
    },
    /// A time after the last one that was asked for.
    AfterLast,
    /// A value that is not enclosed.
    Evaluate(Box<EvaluateError>),
    /// A window that does not end after it begins, at or after time 0.
    EmptyWindow,
    /// Fields along the bars cannot be given.
    Field(Box<FieldError>),
}

impl From<EnclosureError> for HistoryError {
    fn from(error: EnclosureError) -> HistoryError {
        match error {
            EnclosureError::MissingValue(symbol) => HistoryError::MissingValue(symbol),
            other => HistoryError::Value(other),
        }
    }
}

impl From<EvaluateError> for HistoryError {
    fn from(error: EvaluateError) -> HistoryError {
        match error {
            EvaluateError::MissingValue(symbol) => HistoryError::MissingValue(symbol),
            other => HistoryError::Evaluate(Box::new(other)),
        }
    }
}

impl From<crate::ball::BallError> for HistoryError {
    fn from(error: crate::ball::BallError) -> HistoryError {
        HistoryError::Value(EnclosureError::Ball(error))
    }
}

impl fmt::Display for HistoryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MissingValue(symbol) => {
                write!(f, "the history needs numbers, and `{symbol}` has no value")
            }
            Self::Value(error) => error.fmt(f),
            Self::Refused(reason) => f.write_str(reason),
            Self::Undecided { what, at, bits } => {
                write!(f, "undecided {what}, at t = {} with {bits} bits", at.to_decimal(20))
            }
            Self::TooManyEvents { limit, at } => {
                let at = at.to_decimal(8);
                write!(f, "more than {limit} events, the last of them followed at t = {at}")
            }
            Self::TooManyCells { limit, at } => {
                let at = at.to_decimal(8);
                write!(f, "more than {limit} cells of waves; followed until t = {at}")
            }
            Self::Field(error) => error.fmt(f),
            Self::AfterLast => f.write_str("a time after the last one that was followed"),
            Self::Evaluate(error) => error.fmt(f),
            Self::EmptyWindow => f.write_str("the window is empty, or begins before time 0"),
        }
    }
}

impl std::error::Error for HistoryError {}
