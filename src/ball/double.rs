//! Balls and doubles: the nearest one with its distance, and correct rounding.

use crate::ball::{Ball, Binary, Magnitude};
use num_traits::Zero as _;
use wavestep_polynomial::Rational;

impl Ball {
    /// A double near the midpoint, and a bound on its distance from every point of the ball.
    /// Infinite where the midpoint is beyond all doubles.
    pub fn to_double(&self) -> (f64, Magnitude) {
        let (double, rest) = self.split();
        (double, rest.magnitude())
    }

    /// A double near the midpoint, and what the ball is without it.
    pub fn split(&self) -> (f64, Ball) {
        let double = self.midpoint().to_double();
        let exact = Binary::from_double(double);
        let rest = match exact {
            Some(exact) => self.midpoint().add(&exact.negate()),
            None => return (double, Ball::new(Binary::zero(), Magnitude::power_of_two(1 << 20))),
        };
        (double, Ball::new(rest, *self.radius()))
    }

    /// Two doubles whose sum is near the midpoint, and a bound on its distance from every point of the
    /// ball.
    pub fn two_doubles(&self) -> (f64, f64, f64) {
        let (high, rest) = self.split();
        let (low, rest) = rest.split();
        (high, low, rest.magnitude().to_double())
    }

    /// The double that all points of the ball round to, ties to even; `None` where there is no one.
    pub fn rounded(&self) -> Option<f64> {
        let (lower, upper) = self.endpoints();
        let (lower, upper) = (lower.to_double(), upper.to_double());
        // 0 and −0 have different bits, so a value that may be either is not decided.
        (lower.to_bits() == upper.to_bits()).then_some(lower)
    }
}

impl Binary {
    /// The nearest double, ties to even; infinite beyond all doubles.
    pub fn to_double(&self) -> f64 {
        let Some(top) = self.top() else { return 0.0 };
        if top > 1024 {
            return if self.is_negative() { f64::NEG_INFINITY } else { f64::INFINITY };
        }
        // The exponent of the last bit: 53 bits, fewer below the normal numbers.
        let last = (top - 53).max(-1074);
        if top < last {
            return if self.is_negative() { -0.0 } else { 0.0 };
        }
        let (digits, others) = self.leading().expect("not zero");
        // Between none and 53 of them are kept.
        let kept = (top - last) as u32;
        let whole = digits.checked_shr(64 - kept).unwrap_or(0);
        let rest = digits << kept;
        let (half, more) = (rest >> 63 == 1, others || rest << 1 != 0);
        let units = whole + u64::from(half && (more || whole & 1 == 1));
        // Adding a carry to the exponent field is what rounding up to the next power of two is.
        let bits = match units >> 52 {
            0 => units,
            _ => ((last + 1074) as u64).wrapping_shl(52) + units,
        };
        let double = f64::from_bits(bits);
        if self.is_negative() { -double } else { double }
    }

    /// A double exactly; `None` where it is no number.
    pub fn from_double(value: f64) -> Option<Binary> {
        if value.is_zero() {
            return Some(Binary::zero());
        }
        if !value.is_finite() {
            return None;
        }
        let bits = value.to_bits();
        let exponent = ((bits >> 52) & 0x7ff) as i64;
        let fraction = bits & ((1 << 52) - 1);
        let (mantissa, exponent) = match exponent {
            0 => (fraction, -1074),
            _ => (fraction | (1 << 52), exponent - 1075),
        };
        Some(Binary::from_word(value.is_sign_negative(), mantissa, exponent))
    }
}

impl Magnitude {
    /// The least magnitude of at least the absolute value of a double; `2^(2^20)` if it is infinite or
    /// not a number.
    pub(crate) fn from_double(value: f64) -> Magnitude {
        match Binary::from_double(value) {
            Some(binary) => binary.magnitude(),
            None => Magnitude::power_of_two(1 << 20),
        }
    }

    /// The least double that is at least as large, or infinity.
    pub fn to_double(self) -> f64 {
        match self.top() {
            None => 0.0,
            Some(top) if top > 1023 => f64::INFINITY,
            Some(top) if top < -1000 => 2f64.powi(-1000),
            // The mantissa has 32 bits: nothing is rounded.
            Some(_) => self.to_binary().to_double(),
        }
    }
}

/// A finite double as a fraction.
pub fn rational(value: f64) -> Rational {
    Rational::from(&Binary::from_double(value).expect("a finite number"))
}

/// The smallest double that is at least as large; infinity beyond all of them.
pub(crate) fn at_or_after(value: &Rational) -> f64 {
    let ball = Ball::from_rational(value, 80);
    let double = ball.midpoint().to_double().clamp(f64::MIN, f64::MAX);
    match rational(double) < *value {
        true => double.next_up(),
        false if double > f64::MIN && rational(double.next_down()) >= *value => double.next_down(),
        false => double,
    }
}

/// The largest double that is at most as large.
pub(crate) fn at_or_before(value: &Rational) -> f64 {
    -at_or_after(&-value)
}

/// The distance of doubles at a value: `2^(e−52)` for `2^e ≤ |value| < 2^(e+1)`.
pub(crate) fn unit_in_the_last_place(value: f64) -> f64 {
    let value = value.abs().max(f64::MIN_POSITIVE);
    let power = f64::from_bits(value.to_bits() & !((1 << 52) - 1));
    power * f64::EPSILON
}
