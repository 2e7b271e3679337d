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
