//! Logarithms, arctangents and powers against another library.

use super::samples::{self, includes};
use astro_float_num::RoundingMode;
use num_rational::BigRational;
use num_traits::Signed as _;
use proptest::prelude::*;
use wavestep::ball::{Ball, Binary, Magnitude};

proptest! {
    #[test]
    fn logarithms_agree_with_another_library(
        mantissa in samples::integer(12), exponent in -300_i64..300, precision in 2_u64..400,
    ) {
        let x = Binary::new(mantissa.abs(), exponent);
        prop_assume!(!x.is_zero());
        let bits = precision as usize + 128;
        let opinion = samples::second_opinion(&x, bits, |x, constants| {
            x.ln(bits, RoundingMode::ToEven, constants)
        });
        let ball = Ball::new(x.clone(), Magnitude::ZERO).ln(precision).unwrap();
        let both = ball.subtract(&opinion, 2 * bits as u64);
        prop_assert!(both.contains_zero(), "{x:?} {ball} {opinion}");
        // Small against 1 and against the value, except where that is near zero.
        let allowed = Magnitude::from_u64(1).add(&ball.magnitude()).scale(-(precision as i64));
        prop_assert!(*ball.radius() <= allowed.scale(1), "{ball}");
    }

    #[test]
    fn arctangents_agree_with_another_library(
        mantissa in samples::integer(12), exponent in -150_i64..60, precision in 2_u64..400,
    ) {
        let x = Binary::new(mantissa, exponent);
        prop_assume!(!x.is_zero());
        let bits = precision as usize + 128;
        let opinion = samples::second_opinion(&x, bits, |x, constants| {
            x.atan(bits, RoundingMode::ToEven, constants)
        });
        let ball = Ball::new(x.clone(), Magnitude::ZERO).arctan(precision).unwrap();
        let both = ball.subtract(&opinion, 2 * bits as u64);
        prop_assert!(both.contains_zero(), "{x:?} {ball} {opinion}");
        prop_assert!(*ball.radius() <= ball.magnitude().scale(2 - precision as i64), "{ball}");
    }

    #[test]
    fn balls_hold_the_values_of_their_points(
        (ball, point) in samples::ball_and_point(), precision in 2_u64..200,
    ) {
        // Finer than the relative radius of every sample and of the squares of small ones.
        let fine = 2 * precision + 1000;
        let point = Ball::from_rational(&point, fine);
        prop_assert!(includes(&ball.arctan(precision).unwrap(), &point.arctan(fine).unwrap()));
        if let Ok(logarithm) = ball.ln(precision) {
            prop_assert!(includes(&logarithm, &point.ln(fine).unwrap()));
        } else {
            prop_assert!(ball.contains_zero() || ball.midpoint().is_negative());
        }
    }

    #[test]
    fn powers_of_powers_are_the_number(
        q in samples::rational(8), a in 1_i64..9, b in 1_i64..9, precision in 20_u64..200,
    ) {
        prop_assume!(q.is_positive());
        let number = Ball::from_rational(&q, precision + 64);
        let there = number.power(&BigRational::new(a.into(), b.into()), precision + 64).unwrap();
        let back = there.power(&BigRational::new(b.into(), a.into()), precision).unwrap();
        prop_assert!(back.contains(&q), "{q} {back}");
        prop_assert!(*back.radius() <= back.magnitude().scale(4 - precision as i64), "{back}");
    }
}
