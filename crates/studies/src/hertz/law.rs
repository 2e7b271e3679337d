//! The rise of the force in a contact `X = k α^m`, without units.
//!
//! Between long bars `α̇ + h α^m = V`, `h = k (1/Z₁ + 1/Z₂)` (6.47). With the compression in units of
//! its limit `(V/h)^{1/m}` and the time in units of `h^{−1/m} V^{1/m−1}` it is
//!
//! ```text
//! β' = 1 − β^m,   β(0) = 0,   φ = X/X_max = β^m.
//! ```
//!
//! So the time at which the force has the share φ of its limit is
//!
//! ```text
//! t̄(φ) = ∫₀^{φ^{1/m}} dβ/(1 − β^m) = (1/m) ∫₀^φ s^{1/m−1}/(1 − s) ds,
//! ```
//!
//! logarithms and arctangents for rational m ([`Rise`]; 6.51 for Hertz's m = 3/2). For any m there are two series. Up to
//! the middle, `φ ≤ 1/2`,
//!
//! ```text
//! t̄ = β Σ_j φ^j/(1 + jm),                       what is left out ≤ β φ^J/(1 − φ);
//! ```
//!
//! beyond it, with the deficit `y = 1 − φ ≤ 1/2`, `a = 1/m − 1` and `s^a = Σ_j c_j y^j`,
//! `c_j = Π_{i≤j} (i − 1 − a)/i`,
//!
//! ```text
//! t̄(y) = t̄(1/2) + (1/m) [ln(1/2) − ln y + S(1/2) − S(y)],   S(y) = Σ_{j≥1} c_j y^j/j.
//! ```
//!
//! From `j ≥ (1 + a)/2` on `|c_j|` does not grow, so that what S leaves out is at most `2 |c_J| y^J`.

use super::error::HertzError;
use crate::ratio;
use num_traits::{One, Signed, ToPrimitive};
use wavestep::ball::{Ball, Magnitude, Precisions};
use wavestep::solution::Rise;
use wavestep_polynomial::Rational;

/// The exponent of a contact.
///
/// # Invariants
/// It is from 1/10 to 100.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PowerLaw {
    exponent: Rational,
}

/// How far the force has risen at a time.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Share {
    /// `X/X_max = φ`.
    pub force: Ball,
    /// `1 − X/X_max`, with a small relative error however close the force is to its limit.
    pub deficit: Ball,
    /// `α/α_max = φ^{1/m}`.
    pub compression: Ball,
}

fn one() -> Ball {
    Ball::from_integer(&1.into())
}

/// Units of time after which the largest force is as good as reached.
const VERY_LATE: i64 = 1 << 20;

/// What a sum leaves out, before it is known: it shall be below this part of the first term.
fn negligible(precision: u64) -> Magnitude {
    Magnitude::power_of_two(-(precision as i64) - 8)
}

impl PowerLaw {
    pub const MOST: i64 = 100;

    /// The inverse of the smallest exponent: below it the second series cancels.
    pub const LEAST_INVERSE: i64 = 10;

    pub fn new(exponent: Rational) -> Result<PowerLaw, HertzError> {
        match exponent >= ratio(1, Self::LEAST_INVERSE) && exponent <= ratio(Self::MOST, 1) {
            true => Ok(PowerLaw { exponent }),
            false => Err(HertzError::Exponent(exponent.to_string())),
        }
    }

    /// Hertz' law, `m = 3/2` (6.49).
    pub fn hertz() -> PowerLaw {
        PowerLaw { exponent: ratio(3, 2) }
    }

    pub fn exponent(&self) -> &Rational {
        &self.exponent
    }

    /// The time `t̄ = t h^{1/m} V^{1−1/m}` at which the force has a share of its largest value.
    /// As many logarithms as [`Rise`] has poles, or where that is no use as many products as bits.
    pub fn time(&self, share: &Rational, precision: u64) -> Result<Ball, HertzError> {
        if share.is_negative() || *share >= Rational::one() {
            return Err(HertzError::Share(share.to_string()));
        }
        if *share.numer() == 0.into() {
            return Ok(Ball::zero());
        }
        let deficit = Rational::one() - share;
        // How far the deficit, or the share, is below 1: closed forms take it from the deficit.
        let below_one = |x: &Rational| x.denom().bits().saturating_sub(x.numer().bits());
        // For small shares `t̄ ≈ φ^{1/m}`.
        let steep = self.exponent.recip().ceil().to_integer().to_u64().unwrap_or(1);
        let working = precision + below_one(&deficit) + steep * below_one(share) + 16;
        let force = Ball::from_rational(share, working);
        let deficit = Ball::from_rational(&deficit, working);
        match Rise::new(&self.exponent) {
            Some(rise) => {
                let p = force.power(&ratio(1, rise.exponents[0].into()), working)?;
                closed_time(&rise, &p, &deficit, working)
            }
            None => self.time_by_series(&force, &deficit, working),
        }
    }

    /// The same for every m by the two series: a second derivation, which tests hold against the closed forms.
    pub fn time_by_series(
        &self,
        force: &Ball,
        deficit: &Ball,
        precision: u64,
    ) -> Result<Ball, HertzError> {
        let half = Ball::from_rational(&ratio(1, 2), 4);
        if !half.is_below(force) {
            let compression = force.power(&self.exponent.recip(), precision)?;
            return Ok(self.first_series(&compression, force, precision));
        }
        let late = self.late_constant(precision)?;
        let spent = deficit.ln(precision)?.add(&self.second_series(deficit, precision), precision);
        let spent = spent.multiply_rational(&self.exponent.recip(), precision);
        Ok(late.subtract(&spent, precision))
    }

    /// `β Σ_j φ^j/(1 + jm)` for `φ = β^m` not above 1/2 by much.
    fn first_series(&self, compression: &Ball, force: &Ball, precision: u64) -> Ball {
        let (mut power, mut sum) = (one(), one());
        let mut divisor = Rational::one();
        loop {
            power = power.multiply(force, precision);
            divisor += &self.exponent;
            sum = sum.add(&power.multiply_rational(&divisor.recip(), precision), precision);
            if power.magnitude() <= negligible(precision) {
                // φ^J/(1 − φ) ≤ 4 φ^J while φ ≤ 3/4.
                let rest = power.magnitude().scale(2);
                return sum.widened(&rest).multiply(compression, precision);
            }
        }
    }

    /// `S(y) = Σ_{j≥1} c_j y^j/j`, `0 ≤ y ≤ 1/2`.
    fn second_series(&self, deficit: &Ball, precision: u64) -> Ball {
        let a = self.exponent.recip() - Rational::one();
        let steady = ((Rational::one() + &a) / ratio(2, 1)).ceil().to_integer().to_u64();
        let steady = steady.unwrap_or(u64::MAX);
        // c_j y^j
        let (mut power, mut sum) = (one(), Ball::zero());
        let mut j = 0_u64;
        loop {
            j += 1;
            let count = Rational::from_integer(j.into());
            let factor = (&count - Rational::one() - &a) / &count;
            power = power.multiply(deficit, precision).multiply_rational(&factor, precision);
            sum = sum.add(&power.multiply_rational(&count.recip(), precision), precision);
            if j >= steady && power.magnitude() <= negligible(precision) {
                return sum.widened(&power.magnitude().scale(1));
            }
        }
    }

    /// `t̄(1/2) + (ln(1/2) + S(1/2))/m`.
    fn late_constant(&self, precision: u64) -> Result<Ball, HertzError> {
        let half = Ball::from_rational(&ratio(1, 2), 4);
        let compression = half.power(&self.exponent.recip(), precision)?;
        let middle = self.first_series(&compression, &half, precision);
        let rest = half.ln(precision)?.add(&self.second_series(&half, precision), precision);
        Ok(middle.add(&rest.multiply_rational(&self.exponent.recip(), precision), precision))
    }

    /// How far the force has risen at a time `t̄`.
    ///
    /// Newton's method finds a number near β, or beyond the middle near `λ = −ln(1 − φ)`; the mean
    /// value theorem encloses: `β* = β + (t̄ − t̄(β)) (1 − ξ^m)` and `λ* = λ + (t̄ − t̄(λ)) m (1 − η)^{−a}`, with
    /// factors from 0 to 1, and to `m max(1, 2^a)`.
    /// Takes some `log₂` of the precision evaluations of [`time`](Self::time).
    pub fn share(&self, time: &Rational, precision: u64) -> Result<Share, HertzError> {
        if time.is_negative() {
            return Err(HertzError::Time(time.to_string()));
        }
        self.share_at(&Ball::from_rational(time, precision + 64), precision)
    }

    /// The same for an enclosed time, which must not be negative.
    pub fn share_at(&self, time: &Ball, precision: u64) -> Result<Share, HertzError> {
        let working = precision + 32;
        if time.magnitude() == Magnitude::ZERO {
            return Ok(Share { force: Ball::zero(), deficit: one(), compression: Ball::zero() });
        }
        if Ball::from_rational(&ratio(VERY_LATE, 1), 4).is_below(time) {
            // 1 − φ ≤ max(1, m) e^{−t̄ min(1, m)} ≤ 100 e^{−t̄/10}: from 1 − β^m ≥ 1 − β where m ≥ 1, else
            // from t̄ ≤ −ln(1 − φ)/m.
            let deficit = Ball::zero().widened(&Magnitude::power_of_two(-VERY_LATE / 8));
            let share = one().subtract(&deficit, working);
            return Ok(Share { force: share.clone(), compression: share, deficit });
        }
        if self.exponent.is_one() {
            let early = time.magnitude().top().map_or(0, |top| (-top).max(0) as u64);
            let working = working + early;
            let deficit = time.clone().negate().exp(working)?;
            let force = one().subtract(&deficit, working);
            return Ok(Share { compression: force.clone(), force, deficit });
        }
        let half = Ball::from_rational(&ratio(1, 2), 4);
        let compression = half.power(&self.exponent.recip(), working)?;
        let middle = self.first_series(&compression, &half, working);
        if time.is_below(&middle) { self.early(time, working) } else { self.late(time, working) }
    }

    /// In the first half of the rise.
    fn early(&self, time: &Ball, working: u64) -> Result<Share, HertzError> {
        let (target, m) = (time.midpoint().to_double(), self.exponent.to_f64().unwrap_or(1.0));
        // In doubles: t̄ is convex and at least β, so that Newton's method falls to the root from above.
        let of = |beta: f64| {
            let force = beta.powf(m);
            let terms = (0..200).map(|j| force.powi(j) / f64::from(j).mul_add(m, 1.0));
            beta * terms.sum::<f64>()
        };
        let mut guess = target.min(0.5_f64.powf(1.0 / m));
        for _ in 0..60 {
            guess += (target - of(guess)) * (1.0 - guess.powf(m));
        }
        let [compression, residual] = newton(guess, working, |compression, bits| {
            let force = compression.power(&self.exponent, bits)?;
            let there = self.first_series(compression, &force, bits);
            Ok([time.subtract(&there, bits), one().subtract(&force, bits)])
        })?;
        let compression = compression.widened(&residual.magnitude());
        let force = compression.power(&self.exponent, working)?;
        let deficit = one().subtract(&force, working);
        Ok(Share { force, deficit, compression })
    }

    /// Beyond it.
    fn late(&self, time: &Ball, working: u64) -> Result<Share, HertzError> {
        let m = self.exponent.to_f64().unwrap_or(1.0);
        let a = 1.0 / m - 1.0;
        let constant = self.late_constant(working)?;
        // λ = m (t̄ − constant) + S(e^{−λ}), whose right-hand side moves less than λ does.
        let target = time.subtract(&constant, working).multiply_rational(&self.exponent, working);
        let series = |y: f64| {
            let (mut power, mut sum) = (1.0, 0.0);
            for j in 1..400 {
                power *= y * (f64::from(j - 1) - a) / f64::from(j);
                sum += power / f64::from(j);
            }
            sum
        };
        let wanted = target.midpoint().to_double();
        let (mut low, mut high) = (2.0_f64.ln() * 0.999, wanted.abs() + 2.0 + series(0.5).abs());
        for _ in 0..80 {
            let middle = (low + high) / 2.0;
            let is_early = middle - series((-middle).exp()) < wanted;
            if is_early { low = middle } else { high = middle }
        }
        let [exponent, residual] = newton(low.max(2.0_f64.ln()), working, |exponent, bits| {
            let deficit = exponent.clone().negate().exp(bits)?;
            // m (t̄ − t̄(λ))
            let there = exponent.subtract(&self.second_series(&deficit, bits), bits);
            // dλ/d(m t̄) = (1 − y)^{−a}
            let rising = one().subtract(&deficit, bits);
            let slope = rising.power(&(Rational::one() - self.exponent.recip()), bits)?;
            Ok([target.subtract(&there, bits), slope])
        })?;
        // All numbers between λ and λ* are those of deficits up to 1/2 and hardly beyond.
        let most = if a > 0.0 { a.ceil() as i64 + 1 } else { 0 };
        let exponent = exponent.widened(&residual.magnitude().scale(most));
        let deficit = exponent.negate().exp(working)?;
        let force = one().subtract(&deficit, working);
        let compression = force.power(&self.exponent.recip(), working)?;
        Ok(Share { force, deficit, compression })
    }
}

/// Newton's method from a double, with rising precision: the last number, and what is left there. `step`
/// gives what is left at a number, and by what it is multiplied to become the next step.
fn newton(
    start: f64,
    working: u64,
    step: impl Fn(&Ball, u64) -> Result<[Ball; 2], HertzError>,
) -> Result<[Ball; 2], HertzError> {
    let precisions = Precisions::doubling(80, working);
    let mut near = Rational::from_float(start).expect("a finite number");
    let mut good = precisions.first();
    loop {
        let bits = good + 16;
        let at = Ball::from_rational(&near, bits);
        let [residual, slope] = step(&at, bits)?;
        let Some(more) = precisions.after(good) else { return Ok([at, residual]) };
        near = Rational::from(at.add(&residual.multiply(&slope, bits), bits).midpoint());
        good = more;
    }
}

/// The closed form by `p = φ^{1/P}` and `1 − φ`.
///
/// `1 − p^P` is the product of `1 − p` and what the other logarithms are of, so that `ln(1 − p)` is `ln(1 − φ)` without
/// these, not that of a difference of near numbers. For small p the terms cancel to `t̄ ≈ p^Q`, so it takes more bits.
fn closed_time(rise: &Rise, p: &Ball, deficit: &Ball, precision: u64) -> Result<Ball, HertzError> {
    let small = p.magnitude().top().map_or(0, |top| (-top).max(0) as u64);
    let bits = precision + u64::from(rise.exponents[1]) * small + 8;
    let mut sum = deficit.ln(bits)?.negate();
    if rise.has_second_real_pole() {
        sum = sum.add(&one().add(p, bits).ln(bits)?.multiply_rational(&ratio(2, 1), bits), bits);
    }
    for angles in &rise.pairs {
        let of = |turn: &Rational| {
            Ball::pi(bits).multiply_rational(&(turn * ratio(2, 1)), bits).cos_sin(bits)
        };
        let [(cosine, sine), (share, turned)] = [of(&angles[0])?, of(&angles[1])?];
        let along = one().subtract(&p.multiply(&cosine, bits), bits);
        let across = p.multiply(&sine, bits);
        // p² − 2 p cos a + 1
        let square = along.multiply(&along, bits).add(&across.multiply(&across, bits), bits);
        let logarithm = square.ln(bits)?.multiply(&one().subtract(&share, bits), bits);
        let angle = across.multiply(&along.reciprocal(bits)?, bits).arctan(bits)?;
        let angle = angle.multiply(&turned, bits).multiply_rational(&ratio(2, 1), bits);
        sum = sum.add(&logarithm, bits).add(&angle, bits);
    }
    let mut time = sum.multiply_rational(&rise.factor(), bits);
    let mut power = one();
    let mut powers = rise.powers.iter().rev().peekable();
    for exponent in 1.. {
        let Some((coefficient, next)) = powers.peek() else { break };
        power = power.multiply(p, bits);
        if *next == exponent {
            time = time.subtract(&power.multiply_rational(coefficient, bits), bits);
            powers.next();
        }
    }
    Ok(time)
}

/// The constant of 6.54, `[2√2/(3π (1 − ν²))]^{2/3}`: two equal bars of radius r with noses of radius R
/// have `t̄ = constant · (V/c)^{1/3} (R/r)^{1/3} (c t/r)`.
///
/// It follows from `k = (4/3) E/(2(1 − ν²)) √(R/2)`, `Z = π r² E/c` and `t̄ = t h^{2/3} V^{1/3}`.
pub fn equal_bars_constant(poisson: &Rational, precision: u64) -> Result<Ball, HertzError> {
    if *poisson <= ratio(-1, 1) || *poisson > ratio(1, 2) {
        return Err(HertzError::Poisson(poisson.to_string()));
    }
    let bits = precision + 8;
    // 2√2/(3π(1 − ν²)) = √(8/9)/(π (1 − ν²))
    let root = Ball::square_root(&ratio(8, 9), bits).expect("a positive number");
    let loss = (Rational::one() - poisson * poisson).recip();
    let inside = root.multiply(&Ball::pi(bits).reciprocal(bits)?, bits);
    Ok(inside.multiply_rational(&loss, bits).power(&ratio(2, 3), bits)?)
}
