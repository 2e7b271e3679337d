//! Errors of operations on balls.

/// The logarithm of the largest argument of exponentials, sines and cosines: `2^40`.
pub(super) const ARGUMENT_BITS: u32 = 40;

/// An operation that has no result that is supported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[non_exhaustive]
pub enum BallError {
    #[error("the argument of an exponential exceeds 2^{} in absolute value", ARGUMENT_BITS)]
    ArgumentTooLarge,
    #[error("the enclosure of a divisor contains zero")]
    DivisorMayBeZero,
    #[error("the argument of a logarithm may not be positive")]
    NotPositive,
}
