//! A sum of cosines and sines beside a motion as a whole: what modes of vibration are.
//!
//! Its numbers are doubles, taken for what they are exactly: bounds hold for this function, however its frequencies
//! were found.

use super::{Mark, Outcome, Rule, Scale};
use crate::ball::Ball;
use crate::expression::{Expression, Fraction};
use crate::signal::{Effort, Enclosure, EvaluateError, Known, Limit, Near, Taylor};
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// `c + s t + Σ (a cos ωt + b sin ωt)` of the user's time, in the unit of its values, in balls without radius.
pub(crate) struct Vibrating<'a> {
    scale: Rc<Scale<'a>>,
    drift: [Ball; 2],
    modes: Vec<[Ball; 3]>,
}

/// A double as it is.
fn exact(value: f64) -> Option<Ball> {
    Some(Ball::from_rational(&Rational::from_float(value)?, DOUBLE_BITS))
}

const DOUBLE_BITS: u64 = 64;

impl<'a> Vibrating<'a> {
    /// None where a number is infinite, or no number.
    pub fn new(
        scale: &Rc<Scale<'a>>,
        drift: [f64; 2],
        modes: &[[f64; 3]],
    ) -> Option<Vibrating<'a>> {
        let [constant, slope] = drift.map(exact);
        let modes = modes.iter().map(|mode| {
            let [frequency, cosine, sine] = mode.map(exact);
            Some([frequency?, cosine?, sine?])
        });
        let modes = modes.collect::<Option<_>>()?;
        Some(Vibrating { scale: Rc::clone(scale), drift: [constant?, slope?], modes })
    }

    /// Of each mode the derivative of an order at a time, over `ω^order`, with the one that follows it:
    /// `a cos(ωt + jπ/2) + b sin(ωt + jπ/2)` for `j = order` and `order + 1`.
    fn turned(&self, order: usize, at: &Ball, bits: u64) -> Outcome<Vec<[Ball; 2]>> {
        let mode = |[frequency, cosine, sine]: &[Ball; 3]| {
            let angle = at.multiply(frequency, bits);
            let (cos, sin) = angle.cos_sin(bits).map_err(EvaluateError::Ball)?;
            let value = cos.multiply(cosine, bits).add(&sin.multiply(sine, bits), bits);
            let slope = cos.multiply(sine, bits).subtract(&sin.multiply(cosine, bits), bits);
            Ok(match order % 4 {
                0 => [value, slope],
                1 => [slope, value.negate()],
                2 => [value.negate(), slope.negate()],
                _ => [slope.negate(), value],
            })
        };
        self.modes.iter().map(mode).collect()
    }

    /// The drift, differentiated so often.
    fn drift(&self, order: usize, at: &Ball, bits: u64) -> Ball {
        let [constant, slope] = &self.drift;
        match order {
            0 => at.multiply(slope, bits).add(constant, bits),
            1 => slope.clone(),
            _ => Ball::zero(),
        }
    }

    fn derivative(&self, order: usize, at: &Ball, bits: u64) -> Outcome<Ball> {
        let mut sum = self.drift(order, at, bits);
        for ([frequency, ..], [value, _]) in self.modes.iter().zip(self.turned(order, at, bits)?) {
            sum = sum.add(&value.multiply(&power(frequency, order, bits), bits), bits);
        }
        Ok(sum)
    }
}

fn power(base: &Ball, exponent: usize, bits: u64) -> Ball {
    (0..exponent).fold(Ball::from_integer(&1.into()), |power, _| power.multiply(base, bits))
}

impl Rule for Vibrating<'_> {
    /// There are no breaks.
    fn mark(&self, _: usize, _: usize) -> Mark<'_> {
        self.scale.mark(&Rational::default())
    }

    fn is_zero(&self, _: &[usize]) -> bool {
        false
    }

    fn terms(&self, _: &[usize], order: usize, at: &Mark<'_>, bits: u64) -> Outcome<Vec<Ball>> {
        Ok(vec![self.derivative(order, &at.ball(bits)?, bits)?])
    }

    /// With `η = ωh` the coefficients of a mode are `η^k/k!` times its values and slopes by turns, and what is left out is at
    /// most `(|a| + |b|) η^n/n!` for `n` terms (Lagrange).
    fn taylor(
        &self,
        _: &[usize],
        Near { order, place: (middle, half), terms, bits }: Near<'_>,
    ) -> Outcome<Taylor> {
        let [at, half] = [middle, half].map(|value| Ball::from_rational(value, bits));
        let mut sum = Taylor::polynomial(vec![Ball::zero(); terms]);
        let mut scale = Ball::from_integer(&1.into());
        for (own, derivative) in sum.coefficients.iter_mut().zip(order..2) {
            *own = self.drift(derivative, &at, bits).multiply(&scale, bits);
            scale = half.clone();
        }
        let turned = self.turned(order, &at, bits)?;
        for ([frequency, cosine, sine], [value, slope]) in self.modes.iter().zip(turned) {
            let eta = frequency.multiply(&half, bits);
            let mut factor = power(frequency, order, bits);
            for (k, own) in sum.coefficients.iter_mut().enumerate() {
                let term = factor.multiply(if k % 2 == 0 { &value } else { &slope }, bits);
                *own = if k % 4 < 2 { own.add(&term, bits) } else { own.subtract(&term, bits) };
                factor = factor.multiply(&eta, bits).over(k as u64 + 1, bits);
            }
            let size = cosine.magnitude().add(&sine.magnitude());
            sum.remainder = sum.remainder.add(&factor.magnitude().multiply(&size));
        }
        Ok(sum)
    }

    fn exact_at(&self, _: &[usize], _: &Fraction, _: Effort) -> Option<Expression> {
        None
    }

    fn point(&self, at: &Rational, _: Limit) -> Outcome<(Known, Enclosure<'_>, u64)> {
        let at = at.clone();
        let enclose = move |bits| self.derivative(0, &Ball::from_rational(&at, bits), bits);
        Ok((Known::Unknown, Box::new(enclose), u64::MAX))
    }
}
