//! Two long bars that meet at a contact `X = k α^m`, with units.

use super::error::HertzError;
use super::law::{PowerLaw, Share};
use wavestep::ball::Ball;
use wavestep_polynomial::Rational;

/// Two long bars, the velocity at which they meet, and the law of their contact, as enclosures in any
/// consistent units.
///
/// With the force `F₀` at a compression `α₀` the law is `X = F₀ (α/α₀)^m`, and k need not have a unit
/// of its own. From `α̇ + X (1/Z₁ + 1/Z₂) = V` (6.46) follow the largest force `X_max = V/(1/Z₁ + 1/Z₂)`
/// (6.52), the largest compression `α_max = α₀ (X_max/F₀)^{1/m}`, and the unit of time
/// `h^{−1/m} V^{1/m−1} = α_max/V` (6.53). Valid until a wave returns from a far end.
///
/// # Invariants
/// All enclosures are of positive numbers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LongBars {
    pub law: PowerLaw,
    /// `X_max` (6.52).
    pub largest_force: Ball,
    /// `α_max`, where the contact carries `X_max`.
    pub largest_compression: Ball,
    /// `k = F₀/α₀^m` of `X = k α^m` (6.49), in units of force by the m-th power of those of length.
    pub stiffness: Ball,
    /// `t/t̄ = α_max/V`.
    pub time_unit: Ball,
    precision: u64,
}

impl LongBars {
    /// Of the law, a force with the compression it belongs to, the impedances of the bars, one before a wall, and the
    /// velocity at which they approach each other.
    /// All have to be certainly positive.
    pub fn new(
        law: PowerLaw,
        (force, compression): (Ball, Ball),
        impedances: &[Ball],
        velocity: Ball,
        precision: u64,
    ) -> Result<LongBars, HertzError> {
        let mut given = vec![
            ("the force of the contact", &force),
            ("the compression of the contact", &compression),
            ("the velocity at which the bars meet", &velocity),
        ];
        given.extend(impedances.iter().map(|own| ("the impedance of a bar", own)));
        let zero = Ball::zero();
        if let Some((name, value)) = given.iter().find(|(_, value)| !zero.is_below(value)) {
            return Err(HertzError::NotPositive(name, value.to_string()));
        }
        let mut yielding = Ball::zero();
        for own in impedances {
            yielding = yielding.add(&own.reciprocal(precision)?, precision);
        }
        let largest_force = velocity.multiply(&yielding.reciprocal(precision)?, precision);
        let share = largest_force.multiply(&force.reciprocal(precision)?, precision);
        let share = share.power(&law.exponent().recip(), precision)?;
        let largest_compression = compression.multiply(&share, precision);
        let stiffness = compression.power(&-law.exponent(), precision)?.multiply(&force, precision);
        let time_unit = largest_compression.multiply(&velocity.reciprocal(precision)?, precision);
        Ok(LongBars { law, largest_force, largest_compression, stiffness, time_unit, precision })
    }

    pub fn rise_time(&self, share: &Rational) -> Result<Ball, HertzError> {
        let time = self.law.time(share, self.precision)?;
        Ok(time.multiply(&self.time_unit, self.precision))
    }

    pub fn force(&self, time: &Ball) -> Result<Ball, HertzError> {
        Ok(self.share(time)?.force.multiply(&self.largest_force, self.precision))
    }

    /// How far the force has risen at a time.
    /// The time must not be negative.
    pub fn share(&self, time: &Ball) -> Result<Share, HertzError> {
        let is_start = time == &Ball::zero();
        if !is_start && !Ball::zero().is_below(time) {
            return Err(HertzError::Time(time.to_string()));
        }
        let time = time.multiply(&self.time_unit.reciprocal(self.precision)?, self.precision);
        self.law.share_at(&time, self.precision)
    }

    /// `k₁` of the spring `X = k₁ α` with the same unit of time: `k₁ = X_max/α_max`, the same as 6.57,
    /// `k₁ (1/Z₁ + 1/Z₂) = [k (1/Z₁ + 1/Z₂)]^{1/m} V^{1−1/m}`.
    pub fn stiffness_of_spring(&self) -> Ball {
        let inverse = self.largest_compression.reciprocal(self.precision);
        let inverse = inverse.expect("a compression is positive");
        self.largest_force.multiply(&inverse, self.precision)
    }

    /// The time at which the force of that spring has a share φ of the largest one, `−ln(1 − φ)` units of
    /// time (6.55).
    pub fn rise_time_of_spring(&self, share: &Rational) -> Result<Ball, HertzError> {
        let spring = PowerLaw::new(Rational::from_integer(1.into()))?;
        Ok(spring.time(share, self.precision)?.multiply(&self.time_unit, self.precision))
    }
}
