//! What can be wrong with the operands of an operation on balls.

use std::error::Error;
use std::fmt;

use super::exponential::ARGUMENT_BITS;

/// An operation that has no result, or none that is supported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BallError {
    /// The divisor is zero: the quotient is undefined.
    DivisionByZero,
    /// The argument of an exponential may exceed `2^40` in absolute value: not supported.
    ArgumentTooLarge,
}

impl fmt::Display for BallError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DivisionByZero => formatter.write_str("division by zero"),
            Self::ArgumentTooLarge => write!(
                formatter,
                "the argument of an exponential exceeds 2^{ARGUMENT_BITS} in absolute value"
            ),
        }
    }
}

impl Error for BallError {}
