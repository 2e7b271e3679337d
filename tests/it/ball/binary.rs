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

#[test]
fn a_far_smaller_operand_costs_nothing() {
    let (one, tiny) = (Binary::new(BigInt::one(), 0), Binary::new(BigInt::one(), -(1 << 60)));
    let (sum, error) = one.add_rounded(&tiny, 64);
    assert_eq!(sum, one);
    assert!(error >= tiny.magnitude());
    assert!(one > tiny && tiny.negate() > one.negate());
}
