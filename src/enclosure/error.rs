//! Why a value cannot be enclosed.

use crate::ball::{Ball, BallError};
use crate::expression::NotAUnit;
use std::fmt;
use wavestep_polynomial::Symbol;

/// Why a value cannot be enclosed.
///
/// ```
/// use wavestep::enclosure::{EnclosureError, Numbers};
/// use wavestep::expression::Fraction;
/// use wavestep_polynomial::Symbol;
///
/// let x = Symbol::new("x").unwrap();
/// let error = Numbers::new(&[]).enclose(&Fraction::symbol(&x), 60).unwrap_err();
/// assert_eq!(error, EnclosureError::MissingValue(x));
/// assert_eq!(error.to_string(), "the symbol x has no value");
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum EnclosureError {
    /// A symbol without a value.
    MissingValue(Symbol),
    /// An enclosure could not be computed.
    Ball(BallError),
    /// The square root of what is not certainly positive.
    NotReal,
    /// A value that cannot be divided by.
    Division(NotAUnit),
    /// Two numbers, or a number and zero, that so many bits do not tell apart.
    Undecided {
        /// An enclosure of their difference.
        best: Box<Ball>,
        /// The precision tried last, in bits.
        bits: u64,
    },
}

impl fmt::Display for EnclosureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EnclosureError::MissingValue(symbol) => write!(f, "the symbol {symbol} has no value"),
            EnclosureError::Ball(error) => error.fmt(f),
            EnclosureError::NotReal => f.write_str("the value is not real"),
            EnclosureError::Division(reason) => reason.fmt(f),
            EnclosureError::Undecided { bits, .. } => {
                write!(f, "two numbers cannot be told apart with {bits} bits")
            }
        }
    }
}

impl std::error::Error for EnclosureError {}

impl From<NotAUnit> for EnclosureError {
    fn from(reason: NotAUnit) -> EnclosureError {
        EnclosureError::Division(reason)
    }
}
