//! Binary floating-point numbers: rounding keeps its bounds.

use super::samples;
use num_bigint::BigInt;
use num_integer::Integer as _;
use num_rational::BigRational;
use num_traits::{One as _, Signed as _, Zero as _};
use proptest::prelude::*;
use wavestep::ball::{Binary, Magnitude};

fn exact(value: &Binary) -> BigRational {
    let normal = if value.is_zero() { value.exponent() == 0 } else { value.mantissa().is_odd() };
    assert!(normal, "not normalised: {value:?}");
    BigRational::from(value)
}

fn assert_within(rounded: &(Binary, Magnitude), value: &BigRational) {
    let distance = (exact(&rounded.0) - value).abs();
    assert!(distance <= BigRational::from(&rounded.1), "{rounded:?} for {value}");
}

proptest! {
    #[test]
    fn rounding_keeps_its_bounds(
        (a, b) in (samples::ball_and_point(), samples::ball_and_point()),
        (above, below) in (samples::integer(30), samples::integer(30)),
        precision in 2_u64..200,
    ) {
        let (a, b) = (a.0.midpoint().clone(), b.0.midpoint().clone());
        let (x, y) = (exact(&a), exact(&b));
        prop_assert_eq!(exact(&a.add(&b)), &x + &y);
        prop_assert_eq!(exact(&a.multiply(&b)), &x * &y);
        prop_assert_eq!(a.cmp(&b), x.cmp(&y));

        let sum = a.add_rounded(&b, precision);
        assert_within(&sum, &(&x + &y));
        let rounded = a.clone().round(precision);
        assert_within(&rounded, &x);
        prop_assert!(rounded.0.mantissa().bits() <= precision && sum.0.mantissa().bits() <= precision);
        if let Some(top) = a.top() {
            prop_assert!(rounded.1 <= Magnitude::power_of_two(top - precision as i64 - 1));
        }
        if !below.is_zero() {
            let quotient = Binary::quotient(&above, &below, 0, precision);
            assert_within(&quotient, &BigRational::new(above, below));
            prop_assert!(quotient.1 <= quotient.0.magnitude().scale(2 - precision as i64));
        }
    }
}

/// Integers of up to seventy words, with many that are full or empty: where carries run.
fn long() -> impl Strategy<Value = BigInt> {
    let word = prop_oneof![Just(0), Just(u64::MAX), Just(1 << 63), any::<u64>()];
    (any::<bool>(), proptest::collection::vec(word, 0..70)).prop_map(|(negative, words)| {
        let sum = words.iter().fold(BigInt::zero(), |sum, word| (sum << 64_u32) + word);
        if negative { -sum } else { sum }
    })
}

proptest! {
    #[test]
    fn long_numbers_carry_and_borrow(
        (a, b) in (long(), long()),
        by in -300_i64..300,
        precision in 2_u64..3000,
        (numerator, denominator) in (any::<i64>(), 1_u64..),
    ) {
        let (first, second) = (Binary::new(a, by), Binary::new(b, 0));
        let (x, y) = (exact(&first), exact(&second));
        prop_assert_eq!(first.bits(), first.mantissa().bits());
        prop_assert_eq!(exact(&first.add(&second)), &x + &y);
        prop_assert_eq!(exact(&first.add(&second.clone().negate())), &x - &y);
        prop_assert_eq!(exact(&first.multiply(&second)), &x * &y);
        prop_assert_eq!(first.cmp(&second), x.cmp(&y));

        let product = first.multiply_rounded(&second, precision);
        prop_assert_eq!(&product, &first.multiply(&second).round(precision));
        assert_within(&product, &(&x * &y));
        assert_within(&first.add_rounded(&second, precision), &(&x + &y));
        let factor = BigRational::new(numerator.into(), denominator.into());
        let scaled = first.times(&numerator.into(), &denominator.into(), precision);
        assert_within(&scaled, &(&x * factor));
        prop_assert!(scaled.1 <= scaled.0.magnitude().scale(2 - precision as i64));

        let size = first.magnitude();
        prop_assert!(BigRational::from(&size) >= x.abs() && first.is_within(&size));
        prop_assert_eq!(first.is_within(&second.magnitude()),
            x.abs() <= BigRational::from(&second.magnitude()));
    }
}

#[test]
fn a_far_smaller_operand_costs_nothing() {
    let (one, tiny) = (Binary::new(BigInt::one(), 0), Binary::new(BigInt::one(), -(1 << 60)));
    let (sum, error) = one.add_rounded(&tiny, 64);
    assert_eq!(sum, one);
    assert!(error >= tiny.magnitude());
    assert!(one > tiny && tiny.negate() > one.negate());
}
