//! What small systems of equations need of their numbers, enclosures or doubles.

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
    fn reciprocal(&self, bits: u64) -> Result<Self, BallError>;

    fn subtract(&self, other: &Self, bits: u64) -> Self {
        self.add(&other.negate(), bits)
    }

    fn quotient(&self, divisor: &Self, bits: u64) -> Result<Self, BallError> {
        Ok(self.multiply(&divisor.reciprocal(bits)?, bits))
    }
}

/// Numbers with a cosine and a sine.
pub trait Trigonometric: Arithmetic {
    fn cos_sin(&self, bits: u64) -> Result<[Self; 2], BallError>;
}

/// Methods that need no more than a line.
macro_rules! methods {
    ($($name:ident($($argument:tt)*) -> $result:ty { $value:expr })*) => {$(
        fn $name($($argument)*) -> $result {
            $value
        }
    )*};
}

/// Doubles have the bits that they have. Where a divisor is zero, a quotient is no number.
impl Arithmetic for f64 {
    methods! {
        zero() -> f64 { 0.0 }
        one() -> f64 { 1.0 }
        is_zero(&self) -> bool { *self == 0.0 }
        magnitude(&self) -> Magnitude { Magnitude::from_double(self.abs()) }
        negate(&self) -> f64 { -self }
        add(&self, other: &f64, _: u64) -> f64 { self + other }
        multiply(&self, other: &f64, _: u64) -> f64 { self * other }
        reciprocal(&self, _: u64) -> Result<f64, BallError> { Ok(1.0 / self) }
        quotient(&self, divisor: &f64, _: u64) -> Result<f64, BallError> { Ok(self / divisor) }
    }
}

impl Trigonometric for f64 {
    fn cos_sin(&self, _: u64) -> Result<[f64; 2], BallError> {
        let (sine, cosine) = self.sin_cos();
        Ok([cosine, sine])
    }
}

impl Arithmetic for Number {
    methods! {
        zero() -> Number { Number::zero() }
        one() -> Number { Number::one() }
        is_zero(&self) -> bool { self.is_zero() }
        magnitude(&self) -> Magnitude { self.magnitude() }
        negate(&self) -> Number { self.negate() }
        add(&self, other: &Number, bits: u64) -> Number { self.add(other, bits) }
        multiply(&self, other: &Number, bits: u64) -> Number { self.multiply(other, bits) }
        reciprocal(&self, bits: u64) -> Result<Number, BallError> { self.reciprocal(bits) }
    }
}
