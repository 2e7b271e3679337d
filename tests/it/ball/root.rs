//! Square roots.

use super::samples::{self, includes};
use astro_float_num::RoundingMode;
use num_rational::BigRational;
use num_traits::{Signed as _, Zero as _};
use proptest::prelude::*;
use wavestep::ball::{Ball, Binary};

proptest! {
    #[test]
    fn the_square_contains_the_number(q in samples::rational(20), precision in 2_u64..300) {
        let q = q.abs();
        let ball = Ball::square_root(&q, precision).unwrap();
        prop_assert!(ball.square(2 * precision + 64).contains(&q));
        prop_assert!(!ball.endpoints().0.is_negative());
        let fine = Ball::square_root(&q, 2 * precision + 64).unwrap();
        prop_assert!(includes(&ball, &fine));
        let share = ball.magnitude().scale(1 - precision as i64);
        prop_assert!(q.is_zero() || ball.radius() <= &share, "{ball}");
        // The root of a square is the number.
        let root = Ball::square_root(&(&q * &q), precision).unwrap();
        prop_assert!(root.contains(&q));
    }

    #[test]
    fn roots_of_balls_hold_the_roots_of_their_points(
        (ball, point) in samples::ball_and_point(), precision in 2_u64..200,
    ) {
        if let Some(root) = ball.sqrt(precision) {
            // In rationals, since no precision is finer than every radius: l² ≤ x ≤ u².
            let (lower, upper) = root.endpoints();
            let square = |end: &Binary| BigRational::from(&end.multiply(end));
            prop_assert!(lower.is_negative() || square(&lower) <= point);
            prop_assert!(point <= square(&upper));
        } else {
            prop_assert!(ball.contains_zero() || ball.midpoint().is_negative());
        }
    }

    #[test]
    fn agrees_with_another_library(
        mantissa in samples::integer(12), exponent in -300_i64..300, precision in 2_u64..400,
    ) {
        let x = Binary::new(mantissa.abs(), exponent);
        prop_assume!(!x.is_zero());
        let bits = precision as usize + 128;
        let opinion =
            samples::second_opinion(&x, bits, |x, _| x.sqrt(bits, RoundingMode::ToEven));
        let ball = Ball::square_root(&BigRational::from(&x), precision).unwrap();
        // An exact root may be a point that the other library's ball is wider than.
        let both = ball.subtract(&opinion, 2 * bits as u64);
        prop_assert!(both.contains_zero(), "{x:?} {ball} {opinion}");
    }
}

#[test]
fn roots_of_squares_are_exact() {
    let square = BigRational::new(49.into(), 64.into());
    let root = Ball::square_root(&square, 64).unwrap();
    assert!(root.is_exact() && root.contains(&BigRational::new(7.into(), 8.into())));
    assert_eq!(Ball::square_root(&BigRational::zero(), 64), Some(Ball::zero()));
}
