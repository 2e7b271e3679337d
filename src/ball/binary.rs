//! Binary floating-point numbers of any length, the midpoints of balls.
//!
//! Sums and products are exact unless a precision is given; where one is, the function returns a
//! bound of the rounding error beside the rounded number, so that no error can be left out by
//! oversight.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::magnitude::{Magnitude, shifted};
use wavestep_polynomial::limbs::{self, Limbs, in_buffer};

/// The least precision in bits; smaller requests are raised to it.
pub(super) const LEAST_PRECISION: u64 = 2;

/// The number `±f·2^t`, with a fraction `½ ≤ f < 1` of binary digits.
///
/// # Invariants
/// - the highest bit of `limbs` is set and the lowest limb is not zero, or there are none, `t` is 0 and
///   the sign positive for zero; equal values have one representation.
///
/// # Panics
/// Every operation panics when the exponent of its result leaves `i64`.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Binary {
    limbs: Limbs,
    top: i64,
}

impl Binary {
    /// `mantissa·2^exponent`.
    pub fn new(mantissa: BigInt, exponent: i64) -> Self {
        let digits = mantissa.magnitude().iter_u64_digits();
        in_buffer(digits.len(), |buffer| {
            let top = shifted(exponent, 64 * buffer.len() as i64);
            buffer.iter_mut().zip(digits).for_each(|(limb, digit)| *limb = digit);
            Self::finish(buffer, top, mantissa.is_negative(), None).0
        })
    }

    /// `±mantissa·2^exponent`.
    pub(super) fn from_word(negative: bool, mantissa: u64, exponent: i64) -> Self {
        Self::finish(&mut [mantissa], shifted(exponent, 64), negative, None).0
    }

    /// The number whose binary digits before the exponent `top` stand in a buffer, rounded to a precision where
    /// one is given; with a bound of the rounding error.
    pub(super) fn finish(
        buffer: &mut [u64],
        top: i64,
        negative: bool,
        precision: Option<u64>,
    ) -> (Self, Magnitude) {
        let Some(highest) = buffer.iter().rposition(|limb| *limb != 0) else {
            return (Self::zero(), Magnitude::ZERO);
        };
        let zeros = buffer[highest].leading_zeros();
        let above = 64 * (buffer.len() - 1 - highest) as i64 + i64::from(zeros);
        let (buffer, mut top) = (&mut buffer[..=highest], shifted(top, -above));
        limbs::shift_left(buffer, zeros);
        let mut error = Magnitude::ZERO;
        let excess = precision.and_then(|bits| (64 * buffer.len() as u64).checked_sub(bits));
        if let (Some(excess @ 1..), Some(precision)) = (excess, precision) {
            // To nearest: half a unit 2^(top − precision) at most is lost.
            let (is_rounded, carries) = limbs::round(buffer, excess);
            if is_rounded {
                error = Magnitude::power_of_two(shifted(top, -(precision as i64) - 1));
            }
            if carries {
                buffer[highest] = 1 << 63;
                top = shifted(top, 1);
            }
        }
        let lowest = buffer.iter().position(|limb| *limb != 0).expect("the highest is not zero");
        (Self { limbs: Limbs::of(&buffer[lowest..], negative), top }, error)
    }

    pub fn zero() -> Self {
        Self { limbs: Limbs::EMPTY, top: 0 }
    }

    /// The odd `m` of `m·2^e`, or zero.
    pub fn mantissa(&self) -> BigInt {
        let zeros = self.limbs.first().map_or(0, |limb| limb.trailing_zeros());
        let sign = if self.is_negative() { Sign::Minus } else { Sign::Plus };
        BigInt::from_biguint(sign, limbs::natural(&self.limbs) >> zeros)
    }

    /// The `e` of `m·2^e`.
    pub fn exponent(&self) -> i64 {
        match self.limbs.first() {
            Some(limb) => {
                let bits = 64 * self.limbs.len() as i64 - i64::from(limb.trailing_zeros());
                shifted(self.top, -bits)
            }
            None => 0,
        }
    }

    /// How many bits the odd `m` of `m·2^e` has.
    pub fn bits(&self) -> u64 {
        self.limbs
            .first()
            .map_or(0, |limb| 64 * self.limbs.len() as u64 - u64::from(limb.trailing_zeros()))
    }

    /// Whether the number is zero.
    pub fn is_zero(&self) -> bool {
        self.limbs.is_empty()
    }

    /// Whether the number is below zero.
    pub fn is_negative(&self) -> bool {
        self.limbs.is_negative()
    }

    /// The `t` with `2^(t−1) ≤ |self| < 2^t`, or `None` for zero.
    pub fn top(&self) -> Option<i64> {
        (!self.is_zero()).then_some(self.top)
    }

    /// The highest 64 binary digits, the first of them set, and whether others follow; `None` for zero.
    pub(super) fn leading(&self) -> Option<(u64, bool)> {
        Some((*self.limbs.last()?, self.limbs.len() > 1))
    }

    /// An upper bound of `|self|`, within one part in 2^31.
    pub fn magnitude(&self) -> Magnitude {
        let Some((leading, more)) = self.leading() else { return Magnitude::ZERO };
        Magnitude::of_leading(leading, more, self.top)
    }

    /// Whether `|self| ≤ bound`.
    pub fn is_within(&self, bound: &Magnitude) -> bool {
        let (Some(top), Some(most)) = (self.top(), bound.top()) else { return self.is_zero() };
        top.cmp(&most).then_with(|| {
            let (mantissa, _) = bound.parts();
            limbs::compare(&self.limbs, &[mantissa << mantissa.leading_zeros()])
        }) != Ordering::Greater
    }

    /// `⌊self·2^shift⌋`. The cost grows with the size of the result.
    pub(super) fn floor_scaled(&self, shift: i64) -> BigInt {
        match shifted(self.exponent(), shift) {
            up @ 0.. => self.mantissa() << up as u64,
            down => self.mantissa() >> down.unsigned_abs(),
        }
    }

    /// `−self`.
    pub fn negate(mut self) -> Self {
        if !self.is_zero() {
            self.limbs.change_sign();
        }
        self
    }

    /// The exact sum. The cost grows with the distance of the exponents; see [`Self::add_rounded`].
    pub fn add(&self, other: &Self) -> Self {
        self.sum(other, None).0
    }

    fn sum(&self, other: &Self, precision: Option<u64>) -> (Self, Magnitude) {
        let (high, low) = if self.top < other.top { (other, self) } else { (self, other) };
        match (high.is_zero(), low.is_zero()) {
            (true, _) => return low.clone().rounded(precision),
            (_, true) => return high.clone().rounded(precision),
            _ => {}
        }
        // The lower one begins `places` limbs and `bits` bits below the higher one.
        let gap = high.top.abs_diff(low.top);
        let (places, bits) = ((gap / 64) as usize, (gap % 64) as u32);
        let below = places + low.limbs.len() + usize::from(bits > 0);
        let length = high.limbs.len().max(below) + 1;
        in_buffer(length, |buffer| {
            buffer[length - 1 - high.limbs.len()..length - 1].copy_from_slice(&high.limbs);
            let place = length - 1 - places - low.limbs.len();
            let mut negative = high.is_negative();
            if high.is_negative() == low.is_negative() {
                limbs::add_shifted(buffer, &low.limbs, place, bits);
            } else {
                negative ^= limbs::subtract_shifted(buffer, &low.limbs, place, bits);
            }
            Self::finish(buffer, shifted(high.top, 64), negative, precision)
        })
    }

    /// The exact product.
    pub fn multiply(&self, other: &Self) -> Self {
        self.product(other, None).0
    }

    /// `(y, ε)` with `|self·other − y| ≤ ε`, as [`Self::round`] gives them for the exact product.
    pub fn multiply_rounded(&self, other: &Self, precision: u64) -> (Self, Magnitude) {
        self.product(other, Some(precision.max(LEAST_PRECISION)))
    }

    fn product(&self, other: &Self, precision: Option<u64>) -> (Self, Magnitude) {
        if self.is_zero() || other.is_zero() {
            return (Self::zero(), Magnitude::ZERO);
        }
        let negative = self.is_negative() != other.is_negative();
        self.with_product(other, 1, |buffer, top| Self::finish(buffer, top, negative, precision))
    }

    /// Works with the digits of `w |self·other|`, two numbers that are not zero, and the exponent that they stand before.
    pub(super) fn with_product<R>(
        &self,
        other: &Self,
        weight: u64,
        work: impl FnOnce(&mut [u64], i64) -> R,
    ) -> R {
        let short = self.limbs.len() + other.limbs.len();
        // A weight takes a limb more.
        let above = usize::from(weight != 1);
        let top = shifted(shifted(self.top, other.top), 64 * above as i64);
        in_buffer(short + above, |buffer| {
            limbs::multiply(&mut buffer[..short], &self.limbs, &other.limbs);
            if weight != 1 {
                limbs::scale(buffer, weight);
            }
            work(buffer, top)
        })
    }

    /// `(y, ε)` with `|self − y| ≤ ε ≤ 2^(t−p−1)`, where `2^(t−1) ≤ |self| < 2^t` and `p` is the
    /// precision; `y` has at most `p` bits and is `self` itself (`ε = 0`) when that fits.
    pub fn round(self, precision: u64) -> (Self, Magnitude) {
        self.rounded(Some(precision.max(LEAST_PRECISION)))
    }

    fn rounded(self, precision: Option<u64>) -> (Self, Magnitude) {
        if precision.is_none_or(|precision| self.bits() <= precision) {
            return (self, Magnitude::ZERO);
        }
        in_buffer(self.limbs.len(), |buffer| {
            buffer.copy_from_slice(&self.limbs);
            Self::finish(buffer, self.top, self.is_negative(), precision)
        })
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
        self.sum(other, Some(precision))
    }

    /// `(y, ε)` with `|self·numerator/denominator − y| ≤ ε ≤ 2^(2−p)·|y|` for precision `p`;
    /// `ε = 0` when the division leaves no remainder.
    pub fn times(
        &self,
        numerator: &BigInt,
        denominator: &BigInt,
        precision: u64,
    ) -> (Self, Magnitude) {
        let words = numerator.magnitude().to_u64().zip(denominator.to_u64());
        match words {
            Some(fraction @ (_, 1..)) => self.scaled(fraction, numerator.is_negative(), precision),
            _ => {
                let product = self.mantissa() * numerator;
                Self::quotient(&product, denominator, self.exponent(), precision)
            }
        }
    }

    /// The same for a fraction of machine words, of which only the absolute value and the sign are given.
    pub(super) fn scaled(
        &self,
        (factor, divisor): (u64, u64),
        negative: bool,
        precision: u64,
    ) -> (Self, Magnitude) {
        let precision = precision.max(LEAST_PRECISION);
        // The product has a limb more, which may be zero; the quotient has as many bits as the precision at least.
        let above = usize::from(factor != 1);
        let wanted = precision + 1 + u64::from(u64::BITS - divisor.leading_zeros());
        let whole = self.limbs.len() + above;
        let length = match divisor {
            1 => whole,
            _ => whole.max(wanted.div_ceil(64) as usize + above),
        };
        let top = shifted(self.top, 64 * above as i64);
        in_buffer(length, |buffer| {
            let highest = &mut buffer[length - whole..];
            match factor {
                1 => highest.copy_from_slice(&self.limbs),
                _ => limbs::multiply(highest, &self.limbs, &[factor]),
            }
            let remainder = if divisor == 1 { 0 } else { limbs::divide(buffer, divisor) };
            let truncation = match remainder {
                0 => Magnitude::ZERO,
                _ => Magnitude::power_of_two(shifted(top, -64 * length as i64)),
            };
            let negative = self.is_negative() != negative;
            let (rounded, rounding) = Self::finish(buffer, top, negative, Some(precision));
            (rounded, truncation.add(&rounding))
        })
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
        let sign = |value: &Self| match (value.is_zero(), value.is_negative()) {
            (true, _) => 0,
            (_, true) => -1,
            (_, false) => 1,
        };
        sign(self).cmp(&sign(other)).then_with(|| {
            let order = self.top.cmp(&other.top);
            let order = order.then_with(|| limbs::compare(&self.limbs, &other.limbs));
            if self.is_negative() { order.reverse() } else { order }
        })
    }
}

/// The exact value. The cost grows with the exponent.
impl From<&Binary> for BigRational {
    fn from(value: &Binary) -> Self {
        let exponent = value.exponent();
        let power = BigInt::one() << exponent.unsigned_abs();
        if exponent < 0 {
            // An odd mantissa over a power of two is in lowest terms.
            Self::new_raw(value.mantissa(), power)
        } else {
            Self::from_integer(value.mantissa() * power)
        }
    }
}

impl Magnitude {
    /// The bound itself as an exact binary number.
    pub fn to_binary(self) -> Binary {
        let (mantissa, exponent) = self.parts();
        Binary::from_word(false, mantissa, exponent)
    }
}
