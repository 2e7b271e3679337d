//! Sine, cosine and π against another library.

use super::samples::{self, includes};
use astro_float_num::RoundingMode;
use num_rational::BigRational;
use num_traits::{FromPrimitive as _, One as _};
use proptest::prelude::*;
use wavestep::ball::{Ball, BallError, Binary, Magnitude};

proptest! {
    #[test]
    fn agrees_with_another_library(
        mantissa in samples::integer(12), exponent in -120_i64..8, precision in 2_u64..400,
    ) {
        let x = Binary::new(mantissa, exponent);
        prop_assume!(!x.is_zero() && x.top().unwrap() < 30);
        let bits = precision as usize + 256;
        let rounding = RoundingMode::ToEven;
        let cos_there = samples::second_opinion(&x, bits, |x, c| x.cos(bits, rounding, c));
        let sin_there = samples::second_opinion(&x, bits, |x, c| x.sin(bits, rounding, c));
        let (cos, sin) = Ball::new(x.clone(), Magnitude::ZERO).cos_sin(precision).unwrap();
        prop_assert!(includes(&cos, &cos_there), "cos {x:?} {cos} {cos_there}");
        prop_assert!(includes(&sin, &sin_there), "sin {x:?} {sin} {sin_there}");
        let small = Magnitude::power_of_two(1 - precision as i64);
        prop_assert!(cos.radius() <= &small && sin.radius() <= &small);
    }

    #[test]
    fn a_ball_includes_its_points((ball, point) in samples::ball_and_point(), precision in 2_u64..200) {
        prop_assume!(ball.magnitude() < Magnitude::power_of_two(40));
        let exact = Ball::from_rational(&point, precision + 200).cos_sin(precision + 100).unwrap();
        let (cos, sin) = ball.cos_sin(precision).unwrap();
        prop_assert!(includes(&cos, &exact.0) && includes(&sin, &exact.1));
    }

    #[test]
    fn twice_the_precision_of_pi_lies_within(precision in 2_u64..3000) {
        let pi = Ball::pi(precision);
        prop_assert!(includes(&pi, &Ball::pi(2 * precision + 64)));
        prop_assert!(pi.radius() <= &Magnitude::power_of_two(2 - precision as i64));
    }
}

#[test]
fn pi_agrees_with_another_library() {
    for bits in [64, 1000, 5000] {
        let one = Binary::new(1.into(), 0);
        let there = samples::second_opinion(&one, bits, |_, c| c.pi(bits, RoundingMode::ToEven));
        assert!(includes(&Ball::pi(bits as u64 - 40), &there));
    }
    assert!(Ball::pi(20).contains(&BigRational::from_f64(std::f64::consts::PI).unwrap()));
}

#[test]
fn special_arguments() {
    let (cos, sin) = Ball::zero().cos_sin(64).unwrap();
    assert!(cos.contains(&BigRational::one()) && sin.contains_zero());
    let wide = Ball::new(Binary::zero(), Magnitude::power_of_two(41));
    assert_eq!(wide.cos_sin(64), Err(BallError::ArgumentTooLarge));
    // The sine of π is enclosed, far out as well: sin(2^30 π).
    let far = Ball::pi(200).multiply_rational(&BigRational::from_i64(1 << 30).unwrap(), 200);
    let (cos, sin) = far.cos_sin(150).unwrap();
    assert!(cos.contains(&BigRational::one()) && sin.contains_zero());
    assert!(sin.radius() < &Magnitude::power_of_two(-140));
}
