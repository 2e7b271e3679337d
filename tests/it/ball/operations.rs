//! Operations on balls: each result holds the exact ones, and is not much wider.

use super::samples;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Signed as _;
use proptest::prelude::*;
use wavestep::ball::{Ball, Binary, Magnitude};

proptest! {
    #[test]
    fn operations_include_the_exact_result(
        ((a, x), (b, y)) in (samples::ball_and_point(), samples::ball_and_point()),
        factor in samples::rational(20),
        precision in 2_u64..200,
    ) {
        let (a, b) = (&a, &b);
        prop_assert!(a.contains(&x));
        prop_assert!(a.add(b, precision).contains(&(&x + &y)));
        prop_assert!(a.subtract(b, precision).contains(&(&x - &y)));
        prop_assert!(a.multiply(b, precision).contains(&(&x * &y)));
        prop_assert!(a.square(precision).contains(&(&x * &x)));
        prop_assert!(a.multiply_rational(&factor, precision).contains(&(&x * &factor)));
        prop_assert!(a.clone().round(precision).contains(&x));
        prop_assert!(a.clone().negate().contains(&-&x));
        prop_assert!(Ball::from_rational(&factor, precision).contains(&factor));
        prop_assert!(BigRational::from(&a.magnitude()) >= x.abs());
        let (lower, upper) = a.endpoints();
        prop_assert!(BigRational::from(&lower) <= x && x <= BigRational::from(&upper));
        prop_assert_eq!(a.contains_zero(), a.contains(&BigInt::ZERO.into()));
        match a.reciprocal(precision) {
            Ok(inverse) => prop_assert!(inverse.contains(&x.recip())),
            Err(_) => prop_assert!(a.contains_zero()),
        }
    }
}

#[test]
fn exact_operations_stay_exact() {
    let ball = |value: i64| Ball::from_integer(&value.into());
    assert_eq!(ball(12).add(&ball(-5), 8), ball(7));
    assert_eq!(ball(12).multiply(&ball(-5), 8), ball(-60));
    assert_eq!(ball(12).multiply_rational(&BigRational::new(2.into(), 3.into()), 8), ball(8));
    assert!(!ball(257).round(8).is_exact());
}

#[test]
fn radii_are_tight() {
    let radius = Magnitude::power_of_two(-50);
    let ball = Ball::new(Binary::new(3.into(), 0), radius);
    // (3 + r)² − 9 = 6r + r².
    let bound = BigRational::from(ball.square(200).radius());
    let r = BigRational::from(&radius);
    let six = BigRational::from_integer(6.into());
    assert!(bound >= &six * &r + &r * &r);
    assert!(bound < six * &r * BigRational::new(1_000_001.into(), 1_000_000.into()));
}

#[test]
fn distant_exponents_cost_nothing() {
    let far = 1 << 50;
    let high = Ball::new(Binary::new(1.into(), far), Magnitude::power_of_two(-far));
    let low = Ball::new(Binary::new(1.into(), -far), Magnitude::power_of_two(far));
    let sum = high.add(&low, 64);
    assert!(sum.contains_zero());
    let (lower, upper) = high.endpoints();
    assert!(&lower < high.midpoint() && high.midpoint() < &upper);
    let (lower, upper) = low.endpoints();
    assert!(lower.is_negative() && !upper.is_negative());
}
