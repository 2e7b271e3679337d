//! Enclosures of π, sine and cosine.
//!
//! The argument is brought near zero by a multiple of π/2, and one Taylor sum in integers gives
//! both functions there.

use std::cell::RefCell;
use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive, Zero};

use super::ball::Ball;
use super::binary::{Binary, LEAST_PRECISION};
use super::error::{ARGUMENT_BITS, BallError};
use super::magnitude::Magnitude;

/// `(A, ε)` with `|arctan(1/n)·2^w − A| ≤ ε`, for `n ≥ 2`.
///
/// The powers `t_k = ⌊t_(k−1)/n²⌋` from `t_0 = ⌊2^w/n⌋` are below `2^w/n^(2k+1)` by less than two
/// units, the terms `⌊t_k/(2k+1)⌋` thus off by less than three. The sum stops at `t_k = 0`, where what
/// is left out is less than the first term of it, two units.
fn arctan_of_reciprocal(n: u64, working: u64) -> (BigInt, u64) {
    let mut power = (BigInt::one() << working) / n;
    let mut sum = BigInt::zero();
    let mut count = 0_u64;
    while !power.is_zero() {
        let term = &power / (2 * count + 1);
        if count.is_multiple_of(2) {
            sum += term
        } else {
            sum -= term
        }
        power /= n * n;
        count += 1;
    }
    (sum, 3 * count + 2)
}

/// What is kept of π is dropped where it is known with more precisions than these.
const MAX_KEPT_PRECISIONS: usize = 32;

thread_local! {
    /// π by the bits of its precision, as [`pi_scaled`] gives it.
    static KEPT_PI: RefCell<BTreeMap<u64, (BigInt, u64)>> = const { RefCell::new(BTreeMap::new()) };
}

/// `(P, ε)` with `|π·2^w − P| ≤ ε`, kept by each thread: a sum of cosines asks for it in every term.
fn pi_scaled(working: u64) -> (BigInt, u64) {
    KEPT_PI.with_borrow_mut(|kept| {
        if kept.len() >= MAX_KEPT_PRECISIONS && !kept.contains_key(&working) {
            kept.clear();
        }
        kept.entry(working).or_insert_with(|| pi_by_machin(working)).clone()
    })
}

/// The same by Machin's formula `π = 16 arctan(1/5) − 4 arctan(1/239)`.
fn pi_by_machin(working: u64) -> (BigInt, u64) {
    let (fifth, fifth_error) = arctan_of_reciprocal(5, working);
    let (other, other_error) = arctan_of_reciprocal(239, working);
    (fifth * 16 - other * 4, 16 * fifth_error + 4 * other_error)
}

/// `(C, S, ε)` with `|cos(y)·2^w − C| ≤ ε` and `|sin(y)·2^w − S| ≤ ε`, given an integer `Y` with
/// `|y·2^w − Y| ≤ δ` and `|Y| ≤ 2^w`.
///
/// The terms `t_i ≈ |Y·2^(−w)|^i/i!·2^w` follow `t_(i+1) = trunc(⌊t_i·Y/2^w⌋/(i+1))` from `t_0 = 2^w`,
/// `t_1 = Y` without error. Their errors obey `ε_(i+1) ≤ (ε_i + 1)/(i+1) + 1`, hence `ε_i ≤ 2`. The
/// sum stops at `t_n = 0`, `n ≥ 1`, where the exact term is at most 2 and what follows, each at most
/// half the one before, less than 4 in all. Sine and cosine move by no more than their argument.
/// Altogether `ε = 2n + 4 + δ`.
fn cos_sin_of_small(argument: &BigInt, working: u64) -> (BigInt, BigInt, u64) {
    let mut term = argument.clone();
    let (mut cos, mut sin) = (BigInt::one() << working, argument.clone());
    let mut count = 1_u64;
    while !term.is_zero() {
        count += 1;
        term *= argument;
        term >>= working;
        term /= count;
        match count % 4 {
            0 => cos += &term,
            1 => sin += &term,
            2 => cos -= &term,
            _ => sin -= &term,
        }
    }
    (cos, sin, 2 * count + 4)
}

impl Ball {
    /// π: `radius ≤ 2^(2−p)` for precision `p`.
    pub fn pi(precision: u64) -> Ball {
        let precision = precision.max(LEAST_PRECISION);
        let working = precision + u64::from(precision.ilog2()) + 8;
        let (value, error) = pi_scaled(working);
        let unit = -(working as i64);
        let radius = Magnitude::from_u64(error).scale(unit);
        Ball::new(Binary::new(value, unit), radius).round(precision + 3)
    }

    /// `(cos x, sin x)` for all `x` of the ball: for a radius `r`, the radii are at most
    /// `r + 2^(1−p)` for precision `p`.
    ///
    /// With `n` the integer next to `2m/π`, `m` the midpoint, `y = m − nπ/2` is at most `π/4` in
    /// absolute value but for rounding; `n` modulo 4 says which of `±cos y`, `±sin y` are meant. Both
    /// functions move by no more than their argument.
    pub fn cos_sin(&self, precision: u64) -> Result<(Ball, Ball), BallError> {
        if self.magnitude() > Magnitude::power_of_two(i64::from(ARGUMENT_BITS)) {
            return Err(BallError::ArgumentTooLarge);
        }
        let precision = precision.max(LEAST_PRECISION);
        let top = self.midpoint().top().unwrap_or(0).max(0) as u64;
        let working = precision + top + 2 * u64::from(precision.ilog2()) + 16;
        let (pi, pi_error) = pi_scaled(working);
        // |m·2^w − M| ≤ 1, and n differs from 2m/π by little more than 1/2.
        let midpoint = self.midpoint().floor_scaled(working as i64);
        let quarters: BigInt = Integer::div_floor(&(&midpoint * 4 + &pi), &(&pi * 2));
        let argument: BigInt = &midpoint - ((&quarters * &pi) >> 1_u32);
        assert!(argument.bits() <= working, "it is about π/4 at most");
        let (cos, sin, error) = cos_sin_of_small(&argument, working);
        // One unit for M, one for the half, and n/2 times the error of π.
        let drift = Magnitude::from_integer(&quarters, 0).multiply(&Magnitude::from_u64(pi_error));
        let unit = -(working as i64);
        let error = Magnitude::from_u64(error + 2).add(&drift).scale(unit).add(self.radius());
        let ball = |value: BigInt| Ball::new(Binary::new(value, unit), error).round(precision + 2);
        let quadrant = quarters.mod_floor(&4.into()).to_u8().expect("a remainder below 4");
        let (cos, sin) = match quadrant {
            0 => (cos, sin),
            1 => (-sin, cos),
            2 => (-cos, -sin),
            _ => (sin, -cos),
        };
        Ok((ball(cos), ball(sin)))
    }
}
