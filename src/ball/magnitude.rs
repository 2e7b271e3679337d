//! Upper bounds of non-negative reals.
//!
//! A radius needs few digits but a huge range: 32 bits of mantissa and an exponent of 64 bits are
//! small, cheap, and neither overflow nor underflow on the way. Every operation rounds up, so a
//! bound put together from bounds is a bound again.

use std::cmp::Ordering;

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};
use wavestep_polynomial::power;

/// Bits of a mantissa.
const BITS: u32 = 32;

/// A non-negative number `m·2^e` that bounds another from above.
///
/// # Invariants
/// - `m` has exactly 32 bits, or `m = e = 0` for zero; equal values have one representation.
///
/// Products and quotients exceed the exact value by less than one part in 2^31, sums likewise.
///
/// # Panics
/// Every operation panics when the exponent of its result leaves `i64`, that is beyond
/// `2^(2^63)`: no sum of exponentials whose arguments `exp_of_rational`
/// admits comes near.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Magnitude {
    mantissa: u64,
    exponent: i64,
}

impl Magnitude {
    /// Zero, the bound of an exact value.
    pub const ZERO: Self = Self { mantissa: 0, exponent: 0 };

    /// The least magnitude of at least `mantissa·2^exponent`, or above it where more follows.
    fn round_up(mantissa: u128, more: bool, exponent: i64) -> Self {
        if mantissa == 0 {
            return Self::ZERO;
        }
        let zeros = mantissa.leading_zeros();
        let digits = mantissa << zeros;
        let top = shifted(exponent, 128 - i64::from(zeros));
        Self::of_leading((digits >> 64) as u64, more || digits as u64 != 0, top)
    }

    /// The least magnitude of at least `mantissa·2^exponent`, for a word.
    fn rounded_up(mantissa: u64, exponent: i64) -> Self {
        if mantissa == 0 {
            return Self::ZERO;
        }
        let zeros = mantissa.leading_zeros();
        Self::of_leading(mantissa << zeros, false, shifted(exponent, 64 - i64::from(zeros)))
    }

    /// The least magnitude of at least `value`.
    pub fn from_u64(value: u64) -> Self {
        Self::rounded_up(value, 0)
    }

    /// `2^exponent`, exactly.
    pub fn power_of_two(exponent: i64) -> Self {
        Self::rounded_up(1, exponent)
    }

    /// An upper bound of `|value|·2^exponent`, within one part in 2^31.
    pub fn from_integer(value: &BigInt, exponent: i64) -> Self {
        Self::from_natural(value.magnitude(), exponent)
    }

    /// An upper bound of `value·2^exponent`, within one part in 2^31.
    fn from_natural(value: &BigUint, exponent: i64) -> Self {
        // The two leading digits, and whether others follow.
        let mut digits = value.iter_u64_digits();
        let high = digits.next_back().map_or(0, u128::from);
        let top = digits.next_back().map_or(high, |low| high << 64 | u128::from(low));
        let rest = digits.len() as i64;
        Self::round_up(top, rest > 0, shifted(exponent, 64 * rest))
    }

    /// The least magnitude of at least `f·2^top`, where the fraction `½ ≤ f < 1` begins with these 64 binary digits,
    /// and others follow or not.
    pub(super) fn of_leading(digits: u64, more: bool, top: i64) -> Self {
        let short = (digits >> BITS) + u64::from(more || digits << BITS != 0);
        match short >> BITS {
            0 => Self { mantissa: short, exponent: shifted(top, -i64::from(BITS)) },
            _ => Self { mantissa: short >> 1, exponent: shifted(top, 1 - i64::from(BITS)) },
        }
    }

    /// An upper bound of `|value|`, within one part in 2^30.
    pub fn from_rational(value: &BigRational) -> Self {
        let (numerator, denominator) = (value.numer().magnitude(), value.denom().magnitude());
        if let (Some(numerator), Some(denominator)) = (numerator.to_u64(), denominator.to_u64()) {
            return Self::from_u64(numerator).divide(denominator);
        }
        // A quotient of 34 bits or more, so that its unit is below one part in 2^33.
        let shift = (denominator.bits() as i64 - numerator.bits() as i64 + 34).max(0);
        let quotient = (numerator << shift as u64).div_ceil(denominator);
        Self::from_natural(&quotient, -shift)
    }

    /// Whether the bound is zero, that is the bounded number is.
    pub const fn is_zero(&self) -> bool {
        self.mantissa == 0
    }

    /// The least magnitude of at least the sum.
    pub fn add(&self, other: &Self) -> Self {
        let (large, small) = match self.is_zero() || self.exponent < other.exponent {
            true => (other, self),
            false => (self, other),
        };
        if small.is_zero() {
            return *large;
        }
        if large.is_zero() {
            return *small;
        }
        let gap = large.exponent.abs_diff(small.exponent);
        if gap >= u64::from(BITS) {
            // It is less than one unit.
            return Self::rounded_up(large.mantissa + 1, large.exponent);
        }
        // At most 31 bits below the larger mantissa, and one above.
        let sum = (large.mantissa << gap) + small.mantissa;
        let carry = sum >> (u64::from(BITS) + gap);
        let below = gap + carry;
        let short = (sum >> below) + u64::from(sum & ((1 << below) - 1) != 0);
        let carry_again = short >> BITS;
        let exponent = shifted(large.exponent, (carry + carry_again) as i64);
        Self { mantissa: short >> carry_again, exponent }
    }

    /// An upper bound of the product.
    pub fn multiply(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        Self::rounded_up(self.mantissa * other.mantissa, shifted(self.exponent, other.exponent))
    }

    /// An upper bound of a power, by squares.
    pub fn power(&self, exponent: u64) -> Self {
        power(Self::power_of_two(0), self, exponent, Self::multiply)
    }

    /// An upper bound of the quotient by `divisor`.
    pub fn divide(&self, divisor: u64) -> Self {
        if self.is_zero() {
            assert!(divisor != 0, "division of a magnitude by zero");
            return Self::ZERO;
        }
        // A mantissa has 32 bits: with 32 more a quotient by a short divisor has 32 bits still.
        if divisor >> (BITS - 1) == 0 {
            let quotient = (self.mantissa << BITS).div_ceil(divisor);
            return Self::rounded_up(quotient, shifted(self.exponent, -i64::from(BITS)));
        }
        let quotient = (u128::from(self.mantissa) << 95).div_ceil(u128::from(divisor));
        Self::round_up(quotient, false, shifted(self.exponent, -95))
    }

    /// An upper bound of the square root.
    pub fn square_root(&self) -> Self {
        // An even exponent, and a mantissa of 63 or 64 bits.
        let odd = self.exponent & 1;
        let wide = self.mantissa << (i64::from(BITS) - odd);
        let root = wide.isqrt();
        let root = root + u64::from(root * root < wide);
        Self::rounded_up(root, (self.exponent + odd - i64::from(BITS)) / 2)
    }

    /// `self·2^exponent`, exactly.
    pub fn scale(&self, exponent: i64) -> Self {
        if self.is_zero() {
            return Self::ZERO;
        }
        Self { mantissa: self.mantissa, exponent: shifted(self.exponent, exponent) }
    }

    /// The `t` with `2^(t−1) ≤ self < 2^t`, or `None` for zero.
    pub fn top(&self) -> Option<i64> {
        (!self.is_zero()).then(|| shifted(self.exponent, i64::from(BITS)))
    }

    /// The mantissa and the exponent.
    pub const fn parts(self) -> (u64, i64) {
        (self.mantissa, self.exponent)
    }
}

/// `exponent + by`.
pub(super) fn shifted(exponent: i64, by: i64) -> i64 {
    exponent.checked_add(by).expect("a binary exponent stays within 64 bits")
}

impl PartialOrd for Magnitude {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Magnitude {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |value: &Self| (!value.is_zero(), value.exponent, value.mantissa);
        key(self).cmp(&key(other))
    }
}

/// The exact value of a bound, for exact comparisons.
impl From<&Magnitude> for BigRational {
    fn from(value: &Magnitude) -> Self {
        let power = BigInt::one() << value.exponent.unsigned_abs();
        let mantissa = BigInt::from(value.mantissa);
        if value.exponent < 0 {
            Self::new(mantissa, power)
        } else {
            Self::from_integer(mantissa * power)
        }
    }
}
