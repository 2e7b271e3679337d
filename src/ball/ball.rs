//! The ball: a number known to lie within a radius of a midpoint.
//!
//! The midpoint is a binary number of any length and the radius a cheap upper bound. Operations
//! round the midpoint to a precision the caller states and add to the radius all that this may
//! have changed.

use std::cmp::Ordering;
use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

use super::binary::Binary;
use super::error::BallError;
use super::magnitude::Magnitude;
use wavestep_polynomial::limbs::further_bytes;

/// Where an exact endpoint would need more bits than this below its midpoint, the radius is widened
/// instead.
const ENDPOINT_BITS: i64 = 1 << 20;

/// All reals `x` with `|x − midpoint| ≤ radius`.
///
/// # Invariants
/// - A ball made by an operation contains the exact result for every choice of points in its
///   operands (*inclusion*).
/// - A precision `p` is a number of bits: it bounds the length of the midpoint, and the rounding
///   adds at most `2^(2−p)` of the larger operand (sums) or of the result (products, quotients).
///   Fewer than two bits count as two.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ball {
    midpoint: Binary,
    radius: Magnitude,
}

impl Ball {
    /// The ball of this midpoint and radius.
    pub const fn new(midpoint: Binary, radius: Magnitude) -> Self {
        Self { midpoint, radius }
    }

    /// The ball of one point, zero.
    pub fn zero() -> Self {
        Self::new(Binary::zero(), Magnitude::ZERO)
    }

    /// The ball of one point, the integer itself.
    pub fn from_integer(value: &BigInt) -> Self {
        Self::new(Binary::new(value.clone(), 0), Magnitude::ZERO)
    }

    /// A ball around a rational: `radius ≤ 2^(2−p)·|value|`, and zero when `p` bits hold the value.
    pub fn from_rational(value: &BigRational, precision: u64) -> Self {
        let (midpoint, radius) = Binary::quotient(value.numer(), value.denom(), 0, precision);
        Self::new(midpoint, radius)
    }

    /// The ball around zero with this radius, rounded up.
    pub fn symmetric(radius: &BigRational) -> Self {
        Self::new(Binary::zero(), Magnitude::from_rational(radius))
    }

    /// A ball around two rationals and all that is between them.
    pub fn between(lower: &BigRational, upper: &BigRational, precision: u64) -> Self {
        let two = BigRational::from_integer(2.into());
        let half = (upper - lower) / &two;
        let middle = Self::from_rational(&((lower + upper) / &two), precision);
        let radius = middle.radius.add(&Magnitude::from_rational(&half));
        Self::new(middle.midpoint, radius)
    }

    /// How many bytes a ball of so many bits takes beside itself, about.
    pub(crate) fn further_bytes(bits: u64) -> u64 {
        further_bytes(bits)
    }

    pub const fn midpoint(&self) -> &Binary {
        &self.midpoint
    }

    pub const fn radius(&self) -> &Magnitude {
        &self.radius
    }

    /// Whether the ball is a single point.
    pub const fn is_exact(&self) -> bool {
        self.radius.is_zero()
    }

    /// The sign of all points of the ball, where they have one.
    pub fn sign(&self) -> Option<Ordering> {
        match self.contains_zero() {
            true => self.is_exact().then_some(Ordering::Equal),
            false if self.midpoint().is_negative() => Some(Ordering::Less),
            false => Some(Ordering::Greater),
        }
    }

    /// Whether zero is in the ball.
    pub fn contains_zero(&self) -> bool {
        self.midpoint.is_within(&self.radius)
    }

    /// Whether this rational is in the ball, decided exactly. The cost grows with the exponents.
    pub fn contains(&self, value: &BigRational) -> bool {
        let distance = value - BigRational::from(&self.midpoint);
        let radius = BigRational::from(&self.radius);
        distance <= radius && -distance <= radius
    }

    /// An upper bound of `|x|` over the ball.
    pub fn magnitude(&self) -> Magnitude {
        self.midpoint.magnitude().add(&self.radius)
    }

    /// The smallest `|x|` over the ball, or less.
    pub fn smallest_size(&self) -> BigRational {
        let (low, high) = self.endpoints();
        match self.sign() {
            Some(Ordering::Greater) => BigRational::from(&low),
            Some(Ordering::Less) => -BigRational::from(&high),
            _ => BigRational::default(),
        }
    }

    /// `(a, b)` with `a ≤ x ≤ b` for all `x` of the ball.
    ///
    /// They are the exact ends unless the ball contains zero, where they may lie up to one radius
    /// further out, or the radius is more than `2^20` bits below the last bit of the midpoint,
    /// where they lie that far out.
    pub fn endpoints(&self) -> (Binary, Binary) {
        if self.is_exact() {
            return (self.midpoint.clone(), self.midpoint.clone());
        }
        if self.contains_zero() {
            let both = self.radius.scale(1).to_binary();
            return (both.clone().negate(), both);
        }
        let floor = Magnitude::power_of_two(self.midpoint.exponent().saturating_sub(ENDPOINT_BITS));
        let radius = self.radius.max(floor);
        let radius = radius.to_binary();
        (self.midpoint.add(&radius.clone().negate()), self.midpoint.add(&radius))
    }

    /// The same as rational numbers.
    pub fn bounds(&self) -> [BigRational; 2] {
        <[_; 2]>::from(self.endpoints()).map(|end| BigRational::from(&end))
    }

    /// The same points and at most a few more, with a midpoint of at most `precision` bits.
    pub fn round(self, precision: u64) -> Self {
        let (midpoint, error) = self.midpoint.round(precision);
        Self::new(midpoint, self.radius.add(&error))
    }

    /// All points within `by` of this ball.
    pub fn widened(&self, by: &Magnitude) -> Self {
        Self::new(self.midpoint.clone(), self.radius.add(by))
    }

    /// `−x`, exactly.
    pub fn negate(self) -> Self {
        Self::new(self.midpoint.negate(), self.radius)
    }

    /// `x + y`: `radius ≤ r_x + r_y + ε`, `ε` the rounding error of the midpoint.
    pub fn add(&self, other: &Self, precision: u64) -> Self {
        let (midpoint, error) = self.midpoint.add_rounded(&other.midpoint, precision);
        Self::new(midpoint, self.radius.add(&other.radius).add(&error))
    }

    /// `x − y`, with the radius of [`Self::add`].
    pub fn subtract(&self, other: &Self, precision: u64) -> Self {
        self.add(&other.clone().negate(), precision)
    }

    /// `x·y`: `radius ≤ |m_x| r_y + |m_y| r_x + r_x r_y + ε`, `ε` the rounding error of the
    /// midpoint.
    pub fn multiply(&self, other: &Self, precision: u64) -> Self {
        let (midpoint, error) = self.midpoint.multiply_rounded(&other.midpoint, precision);
        let mut radius = error;
        if !other.is_exact() {
            radius = radius.add(&self.magnitude().multiply(&other.radius));
        }
        if !self.is_exact() {
            radius = radius.add(&other.midpoint.magnitude().multiply(&self.radius));
        }
        Self::new(midpoint, radius)
    }

    /// `x²`: `radius ≤ (2|m| + r) r + ε`.
    pub fn square(&self, precision: u64) -> Self {
        let (midpoint, error) = self.midpoint.multiply_rounded(&self.midpoint, precision);
        let sum = self.midpoint.magnitude().scale(1).add(&self.radius);
        Self::new(midpoint, sum.multiply(&self.radius).add(&error))
    }

    /// `x·q`: `radius ≤ |q| r + ε`.
    pub fn multiply_rational(&self, factor: &BigRational, precision: u64) -> Self {
        let (numerator, denominator) = (factor.numer(), factor.denom());
        let (midpoint, error) = self.midpoint.times(numerator, denominator, precision);
        if self.is_exact() {
            return Self::new(midpoint, error);
        }
        let scaled = self.radius.multiply(&Magnitude::from_integer(numerator, 0));
        let radius = match denominator.magnitude().to_u64() {
            Some(divisor) => scaled.divide(divisor),
            None => {
                let inverse = BigRational::new(BigInt::one(), denominator.clone());
                scaled.multiply(&Magnitude::from_rational(&inverse))
            }
        };
        Self::new(midpoint, radius.add(&error))
    }

    /// `x/n` for a number that is not zero: `radius ≤ r/n + ε`.
    pub fn over(&self, divisor: u64, precision: u64) -> Self {
        let (midpoint, error) = self.midpoint.scaled((1, divisor), false, precision);
        Self::new(midpoint, self.radius.divide(divisor).add(&error))
    }

    /// `1/x`: `radius ≤ r/(|m| (|m| − r)) + ε`, by `|1/x − 1/m| = |x − m|/(|x| |m|)`.
    pub fn reciprocal(&self, precision: u64) -> Result<Self, BallError> {
        if self.contains_zero() {
            return Err(BallError::DivisorMayBeZero);
        }
        let inverse = |value: &Binary, precision| {
            let exponent = value.exponent().checked_neg().expect("an exponent within 64 bits");
            Binary::quotient(&BigInt::one(), &value.mantissa(), exponent, precision)
        };
        let (midpoint, error) = inverse(&self.midpoint, precision);
        if self.is_exact() {
            return Ok(Self::new(midpoint, error));
        }
        let (lower, upper) = self.endpoints();
        let nearest = if lower.is_negative() { upper } else { lower };
        if nearest.is_zero() || nearest.is_negative() != self.midpoint.is_negative() {
            return Err(BallError::DivisorMayBeZero);
        }
        let bound = |value: &Binary| {
            let (inverse, error) = inverse(value, 32);
            inverse.magnitude().add(&error)
        };
        let spread = self.radius.multiply(&bound(&self.midpoint)).multiply(&bound(&nearest));
        Ok(Self::new(midpoint, spread.add(&error)))
    }
}

impl fmt::Display for Ball {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.to_decimal(50).fmt(formatter)
    }
}
