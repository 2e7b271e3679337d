//! Multipliers: constants between −1 and 1 by which fixed-point numbers are multiplied.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive};

use super::product::signed_product;

/// Fraction bits of a multiplier.
pub(super) const MULTIPLIER_BITS: u32 = 126;

/// A number `mantissa·2^−126` between −1 and 1.
///
/// # Invariants
/// - `|mantissa| ≤ 2^126`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Multiplier(i128);

impl Multiplier {
    /// One.
    pub(super) const ONE: Self = Self(1 << MULTIPLIER_BITS);

    /// The multiplier nearest to a rational, not further away than `2^−127`; none if it is not
    /// between −1 and 1.
    pub(super) fn nearest(value: &BigRational) -> Option<Self> {
        if value.abs() > BigRational::one() {
            return None;
        }
        let doubled: BigInt = (value.numer() << (MULTIPLIER_BITS + 1)).div_floor(value.denom());
        ((doubled + 1u32) >> 1u32).to_i128().map(Self)
    }

    /// The multiplier with this mantissa; none if it is not between −1 and 1.
    #[inline]
    pub(super) fn from_mantissa(mantissa: i128) -> Option<Self> {
        (mantissa.unsigned_abs() <= 1 << MULTIPLIER_BITS).then_some(Self(mantissa))
    }

    /// The number times `2^126`.
    #[inline]
    pub(super) fn mantissa(self) -> i128 {
        self.0
    }

    /// A part of the multiplier, rounded downwards.
    pub(super) fn divided_by(self, divisor: u32) -> Self {
        Self(self.0.div_euclid(i128::from(divisor)))
    }

    /// The product `value·mantissa·2^−126`, rounded to the nearest integer, for
    /// `|value| < 2^127`; so it is off by at most half a unit, and no larger than the value.
    ///
    /// For a multiplier that is the nearest to a real number r and `|value| ≤ 2^126`, the product
    /// is off from `value·r` by at most `1/2 + |value|·2^−127` units: by at most one unit.
    #[inline]
    pub(super) fn times(self, value: i128) -> i128 {
        debug_assert!(value != i128::MIN, "the product would not fit");
        let (high, low) = signed_product(value, self.0);
        let (low, carry) = low.overflowing_add(1 << (MULTIPLIER_BITS - 1));
        ((high + i128::from(carry)) << (128 - MULTIPLIER_BITS)) | (low >> MULTIPLIER_BITS) as i128
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed::samples::Samples;

    /// `|value·factor − product| ≤ limit / 2`, exactly.
    fn within(value: i128, factor: &BigRational, product: i128, halves: u32) -> bool {
        let exact = BigRational::from(BigInt::from(value)) * factor;
        (exact - BigRational::from(BigInt::from(product))).abs()
            <= BigRational::new(halves.into(), 2.into())
    }

    #[test]
    fn products_are_rounded_to_nearest() {
        let mut samples = Samples::new(7);
        for _ in 0..100_000 {
            let value = (samples.word() as i128).max(-i128::MAX);
            let Some(multiplier) = Multiplier::from_mantissa(samples.word() as i128) else {
                continue;
            };
            let factor = BigRational::new(multiplier.0.into(), BigInt::one() << MULTIPLIER_BITS);
            let product = multiplier.times(value);
            assert!(within(value, &factor, product, 1), "{value} {factor}");
            assert!(product.unsigned_abs() <= value.unsigned_abs());
        }
        assert_eq!(Multiplier::from_mantissa(-(1 << 126)).unwrap().times(i128::MAX), -i128::MAX);
        assert_eq!(Multiplier::ONE.times(-i128::MAX), -i128::MAX);
    }

    #[test]
    fn products_by_the_nearest_multiplier_are_off_by_one_at_most() {
        let mut samples = Samples::new(8);
        for _ in 0..20_000 {
            let value = (samples.word() as i128) >> 1;
            let denominator = i128::from(samples.bits() | 1);
            let numerator = i128::from(samples.bits()) % (denominator + 1);
            let factor = BigRational::new((-numerator).into(), denominator.into());
            let multiplier = Multiplier::nearest(&factor).unwrap();
            assert!(within(value, &factor, multiplier.times(value), 2), "{value} {factor}");
        }
        assert_eq!(Multiplier::nearest(&BigRational::one()), Some(Multiplier::ONE));
        assert_eq!(Multiplier::nearest(&BigRational::new(101.into(), 100.into())), None);
    }

    #[test]
    fn parts_are_rounded_downwards() {
        assert_eq!(Multiplier(-7).divided_by(2), Multiplier(-4));
        assert_eq!(Multiplier::ONE.divided_by(4).mantissa(), 1 << 124);
    }
}
