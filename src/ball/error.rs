//! What can be wrong with the operands of an operation on balls.

use std::error::Error;
use std::fmt;

use super::exponential::ARGUMENT_BITS;

/// An operation that has no result that is supported.
///
/// ```
/// use wavestep::ball::BallError;
/// let error = BallError::ArgumentTooLarge;
/// assert_eq!(error.to_string(), "the argument of an exponential exceeds 2^40 in absolute value");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BallError {
    /// The argument of an exponential may exceed `2^40` in absolute value: not supported.
    ArgumentTooLarge,
    /// A divisor may be zero: its enclosure contains it.
    DivisorMayBeZero,
    /// A number whose logarithm or root is taken may not be positive: its enclosure contains others.
    NotPositive,
}

impl fmt::Display for BallError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ArgumentTooLarge => write!(
                formatter,
                "the argument of an exponential exceeds 2^{ARGUMENT_BITS} in absolute value"
            ),
            Self::DivisorMayBeZero => {
                formatter.write_str("the enclosure of a divisor contains zero")
            }
            Self::NotPositive => formatter
                .write_str("the enclosure of a number whose logarithm is taken is not positive"),
        }
    }
}

impl Error for BallError {}
