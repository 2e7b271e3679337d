//! Why a value cannot be enclosed.

use crate::ball::{Ball, BallError};
use crate::expression::NotAUnit;
use wavestep_polynomial::Symbol;

/// Why a value cannot be enclosed.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EnclosureError {
    #[error("the symbol {0} has no value")]
    MissingValue(Symbol),
    #[error(transparent)]
    Ball(#[from] BallError),
    #[error("the value is not real")]
    NotReal,
    #[error(transparent)]
    Division(#[from] NotAUnit),
    #[error("two numbers cannot be told apart with {bits} bits")]
    Undecided { best: Box<Ball>, bits: u64 },
}
