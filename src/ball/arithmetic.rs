//! What small systems of equations need of their numbers.

use super::error::BallError;
use super::magnitude::Magnitude;
use super::number::Number;

/// Enclosures that are added, multiplied and divided with about so many bits.
pub trait Arithmetic: Clone {
    fn zero() -> Self;
    fn one() -> Self;
    /// Whether it is known to be zero.
    fn is_zero(&self) -> bool;
    /// An upper bound of the absolute value.
    fn magnitude(&self) -> Magnitude;
    fn negate(&self) -> Self;
    fn add(&self, other: &Self, bits: u64) -> Self;
    fn multiply(&self, other: &Self, bits: u64) -> Self;
    /// `1/x`.
    ///
    /// # Errors
    /// [`BallError::DivisorMayBeZero`].
    fn reciprocal(&self, bits: u64) -> Result<Self, BallError>;

    fn subtract(&self, other: &Self, bits: u64) -> Self {
        self.add(&other.negate(), bits)
    }
}

impl Arithmetic for Number {
    fn zero() -> Number {
        Number::zero()
    }

    fn one() -> Number {
        Number::one()
    }

    fn is_zero(&self) -> bool {
        self.is_zero()
    }

    fn magnitude(&self) -> Magnitude {
        self.magnitude()
    }

    fn negate(&self) -> Number {
        self.negate()
    }

    fn add(&self, other: &Number, bits: u64) -> Number {
        self.add(other, bits)
    }

    fn multiply(&self, other: &Number, bits: u64) -> Number {
        self.multiply(other, bits)
    }

    fn reciprocal(&self, bits: u64) -> Result<Number, BallError> {
        self.reciprocal(bits)
    }
}
