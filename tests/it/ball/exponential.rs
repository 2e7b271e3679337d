//! The exponential function against another library and at special arguments.

use super::samples::{self, includes};
use astro_float_num::RoundingMode;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One as _;
use proptest::prelude::*;
use wavestep::ball::{Ball, BallError, Binary, Magnitude, exp_of_rational};

/// An enclosure of `e^x` from another library's value of `bits` bits.
fn second_opinion(x: &Binary, bits: usize) -> Ball {
    samples::second_opinion(x, bits, |x, constants| x.exp(bits, RoundingMode::ToEven, constants))
}

fn assert_small(ball: &Ball, precision: u64) {
    // The radius is below 2^(−p) of the least value.
    let (lower, _) = ball.endpoints();
    assert!(!lower.is_negative() && !ball.contains_zero());
    let share = Binary::new(lower.mantissa().clone(), lower.exponent() - precision as i64);
    assert!(ball.radius().to_binary() <= share, "{ball}");
}

fn integer(value: i64) -> BigRational {
    BigRational::from_integer(value.into())
}

proptest! {
    #[test]
    fn agrees_with_another_library(
        mantissa in samples::integer(12), exponent in -120_i64..8, precision in 2_u64..400,
    ) {
        let x = Binary::new(mantissa, exponent);
        prop_assume!(!x.is_zero() && x.top().unwrap() < 20);
        let opinion = second_opinion(&x, precision as usize + 128);
        let ball = exp_of_rational(&BigRational::from(&x), precision).unwrap();
        prop_assert!(includes(&ball, &opinion), "{x:?} {ball} {opinion}");
        assert_small(&ball, precision);
        let ball = Ball::new(x.clone(), Magnitude::ZERO).exp(precision).unwrap();
        prop_assert!(includes(&ball, &opinion), "{x:?} {ball} {opinion}");
        assert_small(&ball, precision);
    }

    #[test]
    fn a_ball_includes_its_points((ball, point) in samples::ball_and_point(), precision in 2_u64..200) {
        prop_assume!(ball.magnitude() < Magnitude::power_of_two(12));
        let exact = exp_of_rational(&point, precision + 64).unwrap();
        prop_assert!(includes(&ball.exp(precision).unwrap(), &exact));
    }

    #[test]
    fn twice_the_precision_lies_within(x in samples::rational(6), precision in 2_u64..300) {
        prop_assume!(Magnitude::from_rational(&x) < Magnitude::power_of_two(30));
        let ball = exp_of_rational(&x, precision).unwrap();
        prop_assert!(includes(&ball, &exp_of_rational(&x, 2 * precision + 64).unwrap()));
        assert_small(&ball, precision);
    }
}

#[test]
fn special_arguments() {
    let one = exp_of_rational(&integer(0), 100).unwrap();
    assert!(one.contains(&integer(1)));
    let tiny = BigRational::new(1.into(), BigInt::one() << 5000_u32);
    for (x, sign) in [(tiny.clone(), 1), (-tiny, -1)] {
        // 1 + x < e^x < 1 + x + x² for these.
        let ball = exp_of_rational(&x, 64).unwrap();
        assert!(ball.contains(&(integer(1) + &x)) && ball.contains(&(integer(1) + &x + &x * &x)));
        let fine =
            exp_of_rational(&x, 6000).unwrap().subtract(&Ball::from_integer(&1.into()), 6000);
        assert!(!fine.contains_zero());
        assert_eq!(fine.midpoint().is_negative(), sign < 0);
    }
}

#[test]
fn the_exponent_of_the_result_is_unbounded() {
    let start = |x: i64, count: usize| {
        let ball = exp_of_rational(&integer(x), 128).unwrap();
        assert_small(&ball, 128);
        let decimal = ball.proven_digits(count).unwrap();
        format!("{decimal:e}")
    };
    assert_eq!(start(1, 30), "2.71828182845904523536028747135e0");
    assert_eq!(start(-900, 20), "1.3644772123656827617e-391");
    assert_eq!(start(-1_000_000, 12), "3.29683147809e-434295");
    assert_eq!(start(1_000_000, 12), "3.03321539680e434294");
    // 2^40·log_10 e = 477511832731.57…
    assert!(start(1 << 40, 3).ends_with("e477511832731"));
    assert!(start(-(1 << 40), 3).ends_with("e-477511832732"));
}

#[test]
fn arguments_beyond_the_limit_are_an_error() {
    let over = integer((1 << 40) + 1);
    assert_eq!(exp_of_rational(&over, 64), Err(BallError::ArgumentTooLarge));
    assert_eq!(exp_of_rational(&-over, 64), Err(BallError::ArgumentTooLarge));
    let wide = Ball::new(Binary::zero(), Magnitude::power_of_two(41));
    assert_eq!(wide.exp(64), Err(BallError::ArgumentTooLarge));
    assert!(Ball::new(Binary::zero(), Magnitude::power_of_two(39)).exp(64).is_ok());
}

/// Of negative numbers far apart, however large they are, the exponential is small.
#[test]
fn arguments_beyond_the_limit_may_be_negative_and_far_apart() {
    let between = |low: i64, high: BigRational| {
        Ball::between(&BigRational::from_integer(low.into()), &high, 64).exp(64)
    };
    let many = |low: i64, high: i64| between(low, BigRational::from_integer(high.into()));
    // e^(−1/8) is near 1.
    let bound = between(-(1 << 50), BigRational::new((-1).into(), 8.into())).unwrap().magnitude();
    assert!(bound >= Magnitude::power_of_two(0));
    let bound = many(-(1 << 50), -4).unwrap().magnitude();
    assert!(bound > Magnitude::power_of_two(-6) && bound <= Magnitude::power_of_two(-2));
    let least = many(-3 << 41, -1 << 41).unwrap();
    assert!(least.contains_zero() && least.magnitude() <= Magnitude::power_of_two(-(1 << 40)));
    assert_eq!(many(-(1 << 50), 1), Err(BallError::ArgumentTooLarge));
    assert_eq!(many(-(1 << 41) - 1, -1 << 41), Err(BallError::ArgumentTooLarge));
}
