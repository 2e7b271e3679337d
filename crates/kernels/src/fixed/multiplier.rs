//! Multipliers: constants between −1 and 1 by which fixed-point numbers are multiplied.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use super::product::upper_product;

/// Fraction bits of a multiplier.
pub(super) const MULTIPLIER_BITS: u32 = 128;

/// A number `mantissa·2^−128`, at least 0 and less than 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Fraction(pub(super) u128);

impl Fraction {
    /// The product `value·mantissa·2^−128`, rounded to the nearest integer: off by at most half a
    /// unit, and no larger than the value.
    ///
    /// For a fraction that is off from a real number r by at most `2^−128` and `|value| ≤ 2^126`,
    /// the product is off from `value·r` by at most `1/2 + 1/4` units: by less than one unit.
    #[inline(always)]
    pub(super) fn times(self, value: i128) -> i128 {
        upper_product(value, self.0)
    }

    /// A part of the fraction, rounded downwards.
    pub(super) fn divided_by(self, divisor: u32) -> Self {
        Self(self.0 / u128::from(divisor))
    }
}

/// A fraction with a sign.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Multiplier {
    /// The size.
    pub(super) size: Fraction,
    /// Whether the number is negative.
    pub(super) negative: bool,
}

impl Multiplier {
    /// The multiplier next to a rational: off by at most `2^−128`, towards zero. None if the size of
    /// the rational is not below 1.
    pub(super) fn near(value: &BigRational) -> Option<Self> {
        let size: BigInt = (value.numer().abs() << MULTIPLIER_BITS).div_floor(value.denom());
        Some(Self { size: Fraction(size.to_u128()?), negative: value.is_negative() })
    }

    /// The product, like that of [`Fraction::times`].
    #[inline(always)]
    pub(super) fn times(self, value: i128) -> i128 {
        let product = self.size.times(value);
        if self.negative { -product } else { product }
    }

    /// A part of the multiplier, rounded towards zero.
    pub(super) fn divided_by(self, divisor: u32) -> Self {
        Self { size: self.size.divided_by(divisor), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed::samples::Samples;
    use num_traits::One;

    #[test]
    fn products_are_off_by_less_than_a_unit() {
        let mut samples = Samples::new(8);
        for _ in 0..20_000 {
            let value = (samples.word() as i128) >> 1;
            let denominator = i128::from(samples.bits() | 1);
            let numerator = i128::from(samples.bits()) % denominator;
            let sign = if samples.bits().is_multiple_of(2) { 1 } else { -1 };
            let factor = BigRational::new((sign * numerator).into(), denominator.into());
            let product = Multiplier::near(&factor).unwrap().times(value);
            let exact = BigRational::from(BigInt::from(value)) * &factor;
            let error = (exact - BigRational::from(BigInt::from(product))).abs();
            assert!(error <= BigRational::new(3.into(), 4.into()), "{value} {factor}");
        }
        assert_eq!(Multiplier::near(&BigRational::one()), None);
        assert_eq!(Multiplier::near(&-BigRational::one()), None);
    }

    #[test]
    fn parts_are_rounded_towards_zero() {
        let seventh = Multiplier::near(&BigRational::new((-1).into(), 7.into())).unwrap();
        assert_eq!(seventh.size.0, u128::MAX / 7);
        assert_eq!(seventh.divided_by(2), Multiplier { size: Fraction(u128::MAX / 14), ..seventh });
        assert_eq!(seventh.times(-70), 10);
    }
}
