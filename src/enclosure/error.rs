//! Why a value cannot be enclosed.

use crate::ball::{Ball, BallError};
use crate::expression::NotAUnit;
use wavestep_polynomial::Symbol;

/// Why a value cannot be enclosed.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EnclosureError {
    /// A symbol without a value.
    #[error("the symbol {0} has no value")]
    MissingValue(Symbol),
    /// An enclosure could not be computed.
    #[error(transparent)]
    Ball(BallError),
    /// The square root of a number that may not be positive.
    #[error("the value is not real")]
    NotReal,
    /// A value that cannot be divided by.
    #[error(transparent)]
    Division(#[from] NotAUnit),
    /// Two numbers, or a number and zero, that so many bits do not tell apart.
    #[error("two numbers cannot be told apart with {bits} bits")]
    Undecided {
        /// An enclosure of their difference.
        best: Box<Ball>,
        /// The precision tried last, in bits.
        bits: u64,
    },
}
