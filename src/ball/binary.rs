//! Binary floating-point numbers of any length, the midpoints of balls.
//!
//! Sums and products are exact unless a precision is given; where one is, the function returns a
//! bound of the rounding error beside the rounded number, so that no error can be left out by
//! oversight.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::magnitude::{Magnitude, shifted};

/// The least precision in bits; smaller requests are raised to it.
pub(super) const LEAST_PRECISION: u64 = 2;

/// The number `m·2^e`.
///
/// # Invariants
/// - `m` is odd, or `m = e = 0`; equal values have one representation.
///
/// # Panics
/// Every operation panics when the exponent of its result leaves `i64`.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Binary {
    mantissa: BigInt,
    exponent: i64,
}

impl Binary {
    /// `mantissa·2^exponent`.
    pub fn new(mut mantissa: BigInt, exponent: i64) -> Self {
        match mantissa.trailing_zeros() {
            None => Self { mantissa, exponent: 0 },
            Some(0) => Self { mantissa, exponent },
            Some(zeros) => {
                mantissa >>= zeros;
                Self { mantissa, exponent: shifted(exponent, zeros as i64) }
            }
        }
    }

    pub fn zero() -> Self {
        Self { mantissa: BigInt::zero(), exponent: 0 }
    }

    /// The odd `m` of `m·2^e`, or zero.
    pub const fn mantissa(&self) -> &BigInt {
        &self.mantissa
    }

    /// The `e` of `m·2^e`.
    pub const fn exponent(&self) -> i64 {
        self.exponent
    }

    /// Whether the number is zero.
    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    /// Whether the number is below zero.
    pub fn is_negative(&self) -> bool {
        self.mantissa.is_negative()
    }

    /// The `t` with `2^(t−1) ≤ |self| < 2^t`, or `None` for zero.
    pub fn top(&self) -> Option<i64> {
        (!self.is_zero()).then(|| shifted(self.exponent, self.mantissa.bits() as i64))
    }

    /// An upper bound of `|self|`, within one part in 2^31.
    pub fn magnitude(&self) -> Magnitude {
        Magnitude::from_integer(&self.mantissa, self.exponent)
    }

    /// `⌊self·2^shift⌋`. The cost grows with the size of the result.
    pub(super) fn floor_scaled(&self, shift: i64) -> BigInt {
        match shifted(self.exponent, shift) {
            up @ 0.. => &self.mantissa << up as u64,
            down => &self.mantissa >> down.unsigned_abs(),
        }
    }

    /// `−self`.
    pub fn negate(self) -> Self {
        Self { mantissa: -self.mantissa, exponent: self.exponent }
    }

    /// The exact sum. The cost grows with the distance of the exponents; see [`Self::add_rounded`].
    pub fn add(&self, other: &Self) -> Self {
        if self.is_zero() {
            return other.clone();
        }
        if other.is_zero() {
            return self.clone();
        }
        let (high, low) =
            if self.exponent < other.exponent { (other, self) } else { (self, other) };
        let gap = high.exponent.abs_diff(low.exponent);
        let mantissa = if gap == 0 {
            &high.mantissa + &low.mantissa
        } else {
            (&high.mantissa << gap) + &low.mantissa
        };
        Self::new(mantissa, low.exponent)
    }

    /// The exact product.
    pub fn multiply(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        // Odd times odd is odd: nothing to normalise.
        Self {
            mantissa: &self.mantissa * &other.mantissa,
            exponent: shifted(self.exponent, other.exponent),
        }
    }

    /// `(y, ε)` with `|self − y| ≤ ε ≤ 2^(t−p−1)`, where `2^(t−1) ≤ |self| < 2^t` and `p` is the
    /// precision; `y` has at most `p` bits and is `self` itself (`ε = 0`) when that fits.
    pub fn round(self, precision: u64) -> (Self, Magnitude) {
        let precision = precision.max(LEAST_PRECISION);
        let bits = self.mantissa.bits();
        if bits <= precision {
            return (self, Magnitude::ZERO);
        }
        let excess = bits - precision;
        let (sign, mut magnitude) = self.mantissa.into_parts();
        // To nearest: half a unit 2^excess at most is lost. A mantissa that carries into another
        // bit is a power of two and thus still fits.
        let up = magnitude.bit(excess - 1);
        magnitude >>= excess;
        magnitude += u32::from(up);
        let rounded =
            Self::new(BigInt::from_biguint(sign, magnitude), shifted(self.exponent, excess as i64));
        (rounded, Magnitude::power_of_two(shifted(self.exponent, excess as i64 - 1)))
    }

    /// `(y, ε)` with `|self + other − y| ≤ ε`: at most `2^(2−p)` times the larger operand for
    /// precision `p`.
    ///
    /// An operand that cannot reach the kept bits is left out and counted in `ε`, so that the cost
    /// does not depend on the distance of the exponents.
    pub fn add_rounded(&self, other: &Self, precision: u64) -> (Self, Magnitude) {
        let precision = precision.max(LEAST_PRECISION);
        if let (Some(first), Some(second)) = (self.top(), other.top()) {
            let (high, low) = if first < second { (other, self) } else { (self, other) };
            let gap = i128::from(first.max(second)) - i128::from(first.min(second));
            if gap > i128::from(precision) + 2 {
                let (sum, error) = high.clone().round(precision);
                return (sum, error.add(&low.magnitude()));
            }
        }
        self.add(other).round(precision)
    }

    /// `(y, ε)` with `|numerator/denominator·2^exponent − y| ≤ ε ≤ 2^(2−p)·|y|` for precision `p`;
    /// `ε = 0` when the division leaves no remainder.
    pub fn quotient(
        numerator: &BigInt,
        denominator: &BigInt,
        exponent: i64,
        precision: u64,
    ) -> (Self, Magnitude) {
        let precision = precision.max(LEAST_PRECISION);
        if denominator.magnitude().is_one() {
            let sign = if denominator.is_negative() { -BigInt::one() } else { BigInt::one() };
            return Self::new(numerator * sign, exponent).round(precision);
        }
        // |numerator|·2^shift / |denominator| ≥ 2^p, hence a quotient of more than p bits.
        let shift = precision as i64 + denominator.bits() as i64 - numerator.bits() as i64 + 1;
        let shift = shift.max(0);
        let (quotient, remainder) = (numerator << shift as u64).div_rem(denominator);
        let exponent = shifted(exponent, -shift);
        let truncation =
            if remainder.is_zero() { Magnitude::ZERO } else { Magnitude::power_of_two(exponent) };
        let (rounded, rounding) = Self::new(quotient, exponent).round(precision);
        (rounded, truncation.add(&rounding))
    }
}

impl PartialOrd for Binary {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Binary {
    fn cmp(&self, other: &Self) -> Ordering {
        let sign = |value: &Self| match value.mantissa.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        };
        sign(self).cmp(&sign(other)).then_with(|| {
            // Of one sign: the larger top decides, and equal tops bound the cost of a subtraction.
            let order = self.top().cmp(&other.top()).then_with(|| {
                let gap = self.exponent.abs_diff(other.exponent);
                let (first, second) = (self.mantissa.magnitude(), other.mantissa.magnitude());
                match self.exponent.cmp(&other.exponent) {
                    Ordering::Equal => first.cmp(second),
                    Ordering::Greater => (first << gap).cmp(second),
                    Ordering::Less => first.cmp(&(second << gap)),
                }
            });
            if self.is_negative() { order.reverse() } else { order }
        })
    }
}

/// The exact value. The cost grows with the exponent.
impl From<&Binary> for BigRational {
    fn from(value: &Binary) -> Self {
        let power = BigInt::one() << value.exponent.unsigned_abs();
        if value.exponent < 0 {
            // An odd mantissa over a power of two is in lowest terms.
            Self::new_raw(value.mantissa.clone(), power)
        } else {
            Self::from_integer(&value.mantissa * power)
        }
    }
}

impl Magnitude {
    /// The bound itself as an exact binary number.
    pub fn to_binary(self) -> Binary {
        let (mantissa, exponent) = self.parts();
        Binary::new(BigInt::from(mantissa), exponent)
    }
}
