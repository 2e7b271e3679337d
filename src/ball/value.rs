//! Values: rational ones exactly, others with proven digits, or enclosed where digits are not proven.

use super::ball::Ball;
use super::decimal::{Decimal, Exactness};
use super::magnitude::Magnitude;
use super::number::Number;
use super::precision::{Attempt, Precisions};
use std::convert::Infallible;
use std::fmt;
use wavestep_polynomial::Rational;

/// The longest fraction that is written beside its decimals.
const MAX_FRACTION: usize = 60;

/// `−log₂` of a size that is nothing beside any value of a scene.
pub(crate) const NEGLIGIBLE_BITS: i64 = 1024;

/// Bits of the first attempt beyond those of the digits.
const SPARE_BITS: u64 = 32;

/// The precision of doubles, and a few bits more.
const DOUBLE_BITS: u64 = 64;

/// A value, or a time: a rational number exactly, any other with proven digits.
///
/// ```
/// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
/// let strain = mass.signal("strain_fixed")?;
/// let (exact, rounded) = (strain.at(1, 9)?, strain.at("3/2", 9)?); // -2 and -2 exp(-1/2)
/// assert!(exact.exact().is_some() && rounded.exact().is_none());
/// assert_eq!((rounded.to_string(), rounded.to_f64()), ("-1.21306132".into(), -1.2130613194252668));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Value {
    /// A rational number, exactly.
    Exact(Rational),
    /// A number that is not known to be rational, with proven digits.
    #[doc(hidden)]
    Certified {
        /// The correctly rounded value.
        decimal: Decimal,
        /// The enclosure that proves it.
        ball: Ball,
    },
    /// Enclosed, but not so that one decimal is left: it may be half-way between two.
    #[doc(hidden)]
    Enclosed(Ball),
}

impl Value {
    /// The number that `enclosure(bits)` encloses, rounded correctly to `digits` significant decimal
    /// digits, ties to even; where no precision up to the limit proves them, its best enclosure.
    ///
    /// `enclosure` must return a ball around the same number whatever the precision; how its radius
    /// depends on the precision is its own affair. The precision starts 32 bits above that of the digits;
    /// the last attempt is made at `limit_bits`. A number that is a tie between two decimals, or zero, is
    /// never decided by balls of positive radius: decide such cases exactly beforehand.
    #[doc(hidden)]
    pub fn certify<E>(
        digits: usize,
        limit_bits: u64,
        enclosure: impl FnMut(u64) -> Result<Ball, E>,
    ) -> Result<Value, E> {
        Value::certify_from(0, digits, limit_bits, enclosure)
    }

    /// The same where fewer bits than these are known to tell nothing, or cost no less.
    pub(crate) fn certify_from<E>(
        bits: u64,
        digits: usize,
        limit_bits: u64,
        mut enclosure: impl FnMut(u64) -> Result<Ball, E>,
    ) -> Result<Value, E> {
        // log_2 10 < 10/3.
        let first = bits.max((10 * digits as u64).div_ceil(3) + SPARE_BITS);
        let mut best: Option<Ball> = None;
        let attempt = |bits| {
            let ball = enclosure(bits)?;
            if let Some(decimal) = ball.proven_digits(digits) {
                return Ok(Attempt::Done(Value::Certified { decimal, ball }));
            }
            let best = match best.take() {
                Some(other) if other.radius() <= ball.radius() => best.insert(other),
                _ => best.insert(ball),
            };
            Ok(Attempt::NotYet(Value::Enclosed(best.clone())))
        };
        Precisions::doubling(first, limit_bits).raise(attempt).map(Attempt::best)
    }

    /// A number with the digits that its enclosure proves.
    pub fn of(number: &Number, digits: usize) -> Value {
        match number {
            Number::Exact(value) => Value::Exact(value.clone()),
            Number::Enclosed(ball) if ball.is_exact() => Value::Exact(ball.midpoint().into()),
            Number::Enclosed(ball) => match ball.proven_digits(digits) {
                Some(decimal) => Value::Certified { decimal, ball: ball.clone() },
                None => Value::Enclosed(ball.clone()),
            },
        }
    }

    /// Exactly, where the enclosure of a certified value is a point.
    pub fn exact_if_known(self) -> Value {
        match self {
            Value::Certified { ball, .. } if ball.is_exact() => {
                Value::Exact(ball.midpoint().into())
            }
            value => value,
        }
    }

    /// A ball around zero that is below `2^−bits` counts as zero; it is written as `0 ± r`.
    pub(crate) fn near_zero(ball: &Ball, digits: usize, bits: i64) -> Option<Value> {
        if !ball.contains_zero() || *ball.radius() > Magnitude::power_of_two(-bits) {
            return None;
        }
        let decimal = Decimal::from_rational(&Rational::default(), digits).0;
        Some(Value::Certified { decimal, ball: ball.clone() })
    }

    /// The value rounded to `digits` significant digits, and whether they are all of it. A certified
    /// value has the digits it was computed to, the midpoint of an enclosure those that it proves.
    #[doc(hidden)]
    pub fn decimal(&self, digits: usize) -> (Decimal, Exactness) {
        match self {
            Value::Exact(value) => Decimal::from_rational(value, digits),
            Value::Certified { decimal, .. } => (decimal.clone(), Exactness::Rounded),
            Value::Enclosed(ball) => {
                (ball.to_decimal(digits).midpoint().clone(), Exactness::Rounded)
            }
        }
    }

    /// The number, where it is known to be rational.
    pub fn exact(&self) -> Option<&Rational> {
        match self {
            Value::Exact(value) => Some(value),
            _ => None,
        }
    }

    /// Two rational numbers with the value between them, equal where it is one.
    pub fn bounds(&self) -> [Rational; 2] {
        match self {
            Value::Exact(value) => [value.clone(), value.clone()],
            Value::Certified { ball, .. } | Value::Enclosed(ball) => ball.bounds(),
        }
    }

    /// The nearest double, ties to even; where the enclosure lies around the middle of two, that of its
    /// midpoint. Values of signals at times are enclosed so narrowly that only one is left.
    pub fn to_f64(&self) -> f64 {
        let most = match self {
            Value::Exact(value) => value.numer().bits() + value.denom().bits() + 2 * DOUBLE_BITS,
            Value::Certified { .. } | Value::Enclosed(_) => DOUBLE_BITS,
        };
        let rounded = |bits| {
            let ball = self.ball(bits);
            Ok::<_, Infallible>(match ball.rounded() {
                Some(double) => Attempt::Done(double),
                None => Attempt::NotYet(ball.midpoint().to_double()),
            })
        };
        let Ok(attempt) = Precisions::doubling(DOUBLE_BITS, most).raise(rounded);
        attempt.best()
    }

    /// The best enclosure there is; that of a rational number has so many bits.
    #[doc(hidden)]
    pub fn ball(&self, bits: u64) -> Ball {
        match self {
            Value::Exact(value) => Ball::from_rational(value, bits),
            Value::Certified { ball, .. } | Value::Enclosed(ball) => ball.clone(),
        }
    }

    /// The value as plain text: its digits; a rational number that is no integer of so many digits
    /// as a fraction as well, where that is short; an enclosure as a midpoint with a radius.
    pub fn to_text(&self, digits: usize) -> String {
        match (self, self.decimal(digits)) {
            (Value::Exact(value), (_, Exactness::Exact)) if value.is_integer() => value.to_string(),
            (Value::Exact(value), (decimal, _)) => match value.to_string() {
                fraction if fraction.len() <= MAX_FRACTION => format!("{decimal} = {fraction}"),
                _ => decimal.to_string(),
            },
            (Value::Certified { .. }, _) => self.to_string(),
            (Value::Enclosed(ball), _) if ball.contains_zero() => around_zero(ball),
            (Value::Enclosed(ball), _) => ball.to_decimal(digits).to_string(),
        }
    }
}

/// A ball of which no midpoint tells anything.
fn around_zero(ball: &Ball) -> String {
    format!("0 ± {:e}", Ball::zero().widened(&ball.magnitude()).to_decimal(1).radius())
}

/// A rational number as a fraction, else the digits that are proven.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Exact(value) => value.fmt(f),
            Value::Certified { decimal, ball } if decimal.is_zero() => {
                f.write_str(&around_zero(ball))
            }
            Value::Enclosed(ball) if ball.contains_zero() => f.write_str(&around_zero(ball)),
            Value::Certified { decimal, .. } => decimal.fmt(f),
            Value::Enclosed(ball) => ball.fmt(f),
        }
    }
}
