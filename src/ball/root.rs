//! Enclosures of square roots.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed};

use super::ball::Ball;
use super::binary::{Binary, LEAST_PRECISION};
use super::magnitude::Magnitude;

impl Ball {
    /// `√q` for a rational `q`, `None` where it is negative: `radius ≤ 2^(1−p)·√q` for precision
    /// `p`, and zero where that many bits hold the root.
    ///
    /// With an integer `y = ⌊2^k √q⌋`, the root lies between `y/2^k` and `(y + 1)/2^k`, whose middle
    /// is the midpoint; `k` is such that `y` has more than `p` bits.
    pub fn square_root(q: &BigRational, precision: u64) -> Option<Ball> {
        if q.is_negative() {
            return None;
        }
        let precision = precision.max(LEAST_PRECISION);
        // √q ≥ 2^((bits(a) − bits(b) − 1)/2).
        let half = (q.numer().bits() as i64 - q.denom().bits() as i64 - 1).div_euclid(2);
        let k = (precision as i64 + 1 - half).max(0);
        let scaled = q.numer() << (2 * k as u64);
        let root = (&scaled / q.denom()).sqrt();
        if &root * &root * q.denom() == scaled {
            return Some(Ball::new(Binary::new(root, -k), Magnitude::ZERO).round(precision));
        }
        let middle = Binary::new((root << 1_u32) + BigInt::one(), -k - 1);
        Some(Ball::new(middle, Magnitude::power_of_two(-k - 1)).round(precision + 2))
    }
}

impl Ball {
    /// `√x` over a ball of positive numbers, `None` where it may hold others. With the midpoint `m`
    /// and the radius `r`, `|√x − √m| = |x − m|/(√x + √m) ≤ r/√m`.
    pub fn sqrt(&self, precision: u64) -> Option<Ball> {
        if self.contains_zero() || self.midpoint().is_negative() {
            return None;
        }
        let root = Ball::square_root(&BigRational::from(self.midpoint()), precision)?;
        if self.is_exact() {
            return Some(root);
        }
        let spread = Ball::new(self.radius().to_binary(), Magnitude::ZERO);
        let spread = spread.multiply(&root.reciprocal(precision).ok()?, precision).magnitude();
        let radius = root.radius().add(&spread);
        Some(Ball::new(root.midpoint().clone(), radius))
    }
}

#[cfg(test)]
mod tests {
    use astro_float::RoundingMode;
    use num_traits::Zero;
    use proptest::prelude::*;

    use super::super::samples::{self, includes};
    use super::*;

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
}
