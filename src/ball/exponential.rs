//! Enclosures of the exponential function.
//!
//! The argument is halved until it is small, a Taylor sum in integers gives the exponential of
//! that, and squaring balls undoes the halving: neither a logarithm nor a library's claim enters
//! the proof, and the exponent of the result is unbounded.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::ball::Ball;
use super::binary::{Binary, LEAST_PRECISION};
use super::error::{ARGUMENT_BITS, BallError};
use super::magnitude::Magnitude;
use crate::limits::pause;

/// How an argument of size below `2^t` is reduced for a result of `p` bits.
#[derive(Clone, Copy)]
struct Reduction {
    /// The number `k` of halvings: `|x|/2^k < 2^(−r)`, `r ≥ 2`.
    halvings: u64,
    /// The Taylor sum works in units of `2^(−w)`.
    working: u64,
    /// The precision `p` of the result.
    precision: u64,
}

impl Reduction {
    fn new(top: i64, precision: u64) -> Self {
        let precision = precision.max(LEAST_PRECISION);
        // A halving costs a squaring and saves a share of the terms; about √p they balance.
        let smallness = precision.isqrt().max(2) as i64;
        let halvings = top.saturating_add(smallness).max(0) as u64;
        // A squaring doubles the relative error; the rest covers the terms and the roundings.
        let guard = u64::from(precision.ilog2()) + 8;
        Self { halvings, working: precision + halvings + guard, precision }
    }

    /// Encloses `e^x`, given an integer `Y` with `|x·2^(w−k) − Y| ≤ 1`.
    ///
    /// With `y = Y·2^(−w)`, `|y| ≤ 1/4`, the computed terms `t_i ≈ y^i/i!·2^w` follow
    /// `t_(i+1) = trunc(⌊t_i·Y/2^w⌋/(i+1))` from `t_0 = 2^w`, `t_1 = Y` without error. Their errors
    /// obey `ε_(i+1) ≤ (ε_i·|y| + 1)/(i+1) + 1`, hence `ε_i ≤ 2`. The sum stops at `t_n = 0`, where
    /// `|y^n/n!|·2^w ≤ 2` and what follows adds up to less than 3. The unit of `Y` moves `e^y` by
    /// less than 2 units. Altogether
    /// `|e^(x/2^k)·2^w − Σ_(i<n) t_i| ≤ 2n + 5`.
    fn exponential(self, argument: &BigInt) -> Ball {
        pause();
        let mut term = argument.clone();
        let mut sum = (BigInt::one() << self.working) + argument;
        let mut count = 1_u64;
        while !term.is_zero() {
            count += 1;
            term *= argument;
            term >>= self.working;
            term /= count;
            sum += &term;
        }
        // Here t_count = 0: n = count when the loop ran, and n ≤ count = 1 when Y = 0.
        let unit = -(self.working as i64);
        let radius = Magnitude::from_u64(2 * count + 5).scale(unit);
        let mut power = Ball::new(Binary::new(sum, unit), radius);
        for _ in 0..self.halvings {
            power = power.square(self.working);
        }
        power.round(self.precision + 2)
    }
}

/// Encloses `e^x`: the true value lies in the ball, and `radius ≤ 2^(−p)·e^x` for precision `p`.
///
/// Results of any size are represented: `e^(−10^6)` is not zero.
///
/// About `2√p` products of `p` bits, and one of `p` bits for each bit of `⌊x⌋`.
pub fn exp_of_rational(x: &BigRational, precision: u64) -> Result<Ball, BallError> {
    let (numerator, denominator) = (x.numer(), x.denom());
    if numerator.magnitude() > &(denominator.magnitude() << ARGUMENT_BITS) {
        return Err(BallError::ArgumentTooLarge);
    }
    // |a| < 2^bits(a) and b ≥ 2^(bits(b)−1).
    let top = numerator.bits() as i64 - denominator.bits() as i64 + 1;
    let reduction = Reduction::new(top, precision);
    // The working precision exceeds the number of halvings.
    let scaled = numerator << (reduction.working - reduction.halvings);
    Ok(reduction.exponential(&scaled.div_floor(denominator)))
}

impl Ball {
    /// `e^x` for all `x` of the ball.
    ///
    /// For a midpoint `m` and a radius `r`, `|e^x − e^m| ≤ e^m (e^r − 1)`; that is at most
    /// `e^m r (1 + r)` for `r ≤ 1`, since `e^r ≤ 1 + r + r²` there, and else at most
    /// `e^m 2^{3r/2}`, since `log₂ e < 3/2`.
    pub fn exp(&self, precision: u64) -> Result<Ball, BallError> {
        if self.magnitude() > Magnitude::power_of_two(i64::from(ARGUMENT_BITS)) {
            return self.exp_of_many().ok_or(BallError::ArgumentTooLarge);
        }
        let midpoint = self.midpoint();
        let reduction = Reduction::new(midpoint.top().unwrap_or(i64::MIN), precision);
        let shift = (reduction.working - reduction.halvings) as i64;
        let power = reduction.exponential(&midpoint.floor_scaled(shift));
        let radius = self.radius();
        let Some(top) = radius.top() else { return Ok(power) };
        let spread = if top <= 0 {
            radius.multiply(&Magnitude::from_u64(1).add(radius))
        } else {
            Magnitude::power_of_two(3 << (top - 1))
        };
        let spread = power.magnitude().multiply(&spread);
        Ok(Ball::new(power.midpoint().clone(), power.radius().add(&spread)))
    }

    /// `0 < e^x < 2^x` for negative numbers far apart: the radius is an eighth of the midpoint or more.
    fn exp_of_many(&self) -> Option<Ball> {
        let (_, upper) = self.endpoints();
        if !upper.is_negative() || self.radius().top()? < self.midpoint().top()? - 3 {
            return None;
        }
        // |x| ≥ 2^(top − 1); near zero the bound is 1.
        let size = upper.top()? - 1;
        let least = if size < 0 { 0 } else { 1 << size.min(i64::from(ARGUMENT_BITS)) };
        Some(Ball::new(Binary::zero(), Magnitude::power_of_two(-least)))
    }
}
