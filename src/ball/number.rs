//! Real numbers that are rational and exact, or enclosed.
//!
//! Whether a rational number is zero can be decided. Numbers that are not rational, and fractions that
//! grow too long, are balls.

use super::ball::Ball;
use super::error::BallError;
use super::magnitude::Magnitude;
use num_traits::{One as _, Signed, Zero};
use std::borrow::Cow;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// Fractions with longer numerators or denominators are enclosed instead.
const MAX_EXACT_BITS: u64 = 1 << 11;

/// A real number.
///
/// # Invariants
/// A rational has at most 2048 bits above and below the line.
#[derive(Clone, PartialEq, Debug)]
pub enum Number {
    Exact(Rational),
    /// Some number in this ball.
    Enclosed(Ball),
}

impl Number {
    pub fn zero() -> Number {
        Number::Exact(Rational::zero())
    }

    pub fn one() -> Number {
        Number::integer(1)
    }

    pub fn integer(value: i64) -> Number {
        Number::Exact(Rational::from_integer(value.into()))
    }

    /// A rational, enclosed with so many bits where it is too long.
    pub fn of_rational(value: Rational, bits: u64) -> Number {
        match value.numer().bits().max(value.denom().bits()) > MAX_EXACT_BITS {
            true => Number::Enclosed(Ball::from_rational(&value, bits)),
            false => Number::Exact(value),
        }
    }

    /// Whether it is known to be zero.
    pub fn is_zero(&self) -> bool {
        match self {
            Number::Exact(value) => value.is_zero(),
            Number::Enclosed(ball) => ball.is_exact() && ball.contains_zero(),
        }
    }

    /// The rational that it is, where that is known.
    pub fn exact(&self) -> Option<&Rational> {
        match self {
            Number::Exact(value) => Some(value),
            Number::Enclosed(_) => None,
        }
    }

    /// An enclosure.
    pub fn ball(&self, bits: u64) -> Ball {
        match self {
            Number::Exact(value) => Ball::from_rational(value, bits),
            Number::Enclosed(ball) => ball.clone(),
        }
    }

    /// An enclosure, borrowed where there is one.
    pub(super) fn as_ball(&self, bits: u64) -> Cow<'_, Ball> {
        match self {
            Number::Exact(value) => Cow::Owned(Ball::from_rational(value, bits)),
            Number::Enclosed(ball) => Cow::Borrowed(ball),
        }
    }

    /// The same number as a ball; zero stays exact.
    pub fn enclosed(&self, bits: u64) -> Number {
        match self.is_zero() {
            true => Number::zero(),
            false => Number::Enclosed(self.ball(bits)),
        }
    }

    /// A number without radius near it, and how far it is from that at most. Zero stays exact.
    pub fn split(&self, bits: u64) -> (Number, Magnitude) {
        if self.is_zero() {
            return (Number::zero(), Magnitude::ZERO);
        }
        let ball = self.ball(bits);
        let middle = Ball::new(ball.midpoint().clone(), Magnitude::ZERO);
        (Number::Enclosed(middle), *ball.radius())
    }

    /// How it compares with zero; `None` where its enclosure does not tell.
    pub fn sign(&self) -> Option<Ordering> {
        match self {
            Number::Exact(value) => Some(value.cmp(&Rational::zero())),
            Number::Enclosed(ball) => ball.sign(),
        }
    }

    /// An upper bound of the absolute value.
    pub fn magnitude(&self) -> Magnitude {
        match self {
            Number::Exact(value) => Magnitude::from_rational(&value.abs()),
            Number::Enclosed(ball) => ball.magnitude(),
        }
    }

    pub fn negate(&self) -> Number {
        match self {
            Number::Exact(value) => Number::Exact(-value),
            Number::Enclosed(ball) => Number::Enclosed(ball.clone().negate()),
        }
    }

    pub fn add(&self, other: &Number, bits: u64) -> Number {
        match (self, other) {
            (zero, value) | (value, zero) if zero.is_zero() => value.clone(),
            (Number::Exact(a), Number::Exact(b)) => Number::of_rational(a + b, bits),
            (a, b) => Number::Enclosed(a.as_ball(bits).add(&b.as_ball(bits), bits)),
        }
    }

    pub fn subtract(&self, other: &Number, bits: u64) -> Number {
        self.add(&other.negate(), bits)
    }

    pub fn multiply(&self, other: &Number, bits: u64) -> Number {
        match (self, other) {
            (zero, _) | (_, zero) if zero.is_zero() => Number::zero(),
            (Number::Exact(one), value) | (value, Number::Exact(one)) if one.is_one() => {
                value.clone()
            }
            (Number::Exact(a), Number::Exact(b)) => Number::of_rational(a * b, bits),
            (Number::Exact(factor), Number::Enclosed(ball))
            | (Number::Enclosed(ball), Number::Exact(factor)) => {
                Number::Enclosed(ball.multiply_rational(factor, bits))
            }
            (Number::Enclosed(a), Number::Enclosed(b)) => Number::Enclosed(a.multiply(b, bits)),
        }
    }

    /// `1/x`.
    pub fn reciprocal(&self, bits: u64) -> Result<Number, BallError> {
        match self {
            Number::Exact(value) if value.is_zero() => Err(BallError::DivisorMayBeZero),
            Number::Exact(value) => Ok(Number::Exact(value.recip())),
            Number::Enclosed(ball) => Ok(Number::Enclosed(ball.reciprocal(bits)?)),
        }
    }

    /// The quotient by an integer that is not zero.
    pub fn over(&self, divisor: u64, bits: u64) -> Number {
        match self {
            value if divisor == 1 => value.clone(),
            Number::Exact(value) => {
                Number::of_rational(value / Rational::from_integer(divisor.into()), bits)
            }
            Number::Enclosed(ball) => Number::Enclosed(ball.over(divisor, bits)),
        }
    }

    /// All numbers within a distance.
    pub fn widened(&self, by: &Magnitude, bits: u64) -> Number {
        match by.is_zero() {
            true => self.clone(),
            false => Number::Enclosed(self.ball(bits).widened(by)),
        }
    }
}
