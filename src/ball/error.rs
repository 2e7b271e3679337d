//! Errors of operations on balls.

/// The logarithm of the largest argument of exponentials, sines and cosines: `2^40`.
pub(super) const ARGUMENT_BITS: u32 = 40;

/// An operation that has no result that is supported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[non_exhaustive]
pub enum BallError {
    /// The argument of an exponential may exceed `2^40` in absolute value: not supported.
    #[error("the argument of an exponential exceeds 2^{} in absolute value", ARGUMENT_BITS)]
    ArgumentTooLarge,
    /// A divisor may be zero: its enclosure contains it.
    #[error("the enclosure of a divisor contains zero")]
    DivisorMayBeZero,
    /// A number whose logarithm or root is taken may not be positive: its enclosure contains others.
    #[error("the enclosure of a number whose logarithm is taken is not positive")]
    NotPositive,
}
