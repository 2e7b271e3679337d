//! A quantity that nothing changes.

use super::{Mark, Outcome, Rule, Scale};
use crate::ball::Ball;
use crate::expression::{Expression, Fraction};
use crate::signal::{EchoCount, Effort, Enclosure, Known, Limit, MAX_FLATNESS, Taylor};
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// One value for ever, on one stretch.
pub(crate) struct Constant<'a> {
    pub scale: Rc<Scale<'a>>,
    pub value: Fraction,
}

impl Constant<'_> {
    fn derivative(&self, order: usize, bits: u64) -> Outcome<Ball> {
        match order {
            0 => Ok(self.scale.numbers.enclose(&self.value, bits)?),
            _ => Ok(Ball::zero()),
        }
    }
}

impl Rule for Constant<'_> {
    /// There are no breaks.
    fn mark(&self, _: usize, _: usize) -> Mark<'_> {
        self.scale.mark(&Rational::default())
    }

    fn is_zero(&self, _: &[usize]) -> bool {
        self.value.is_zero()
    }

    fn terms(&self, _: &[usize], order: usize, _: &Mark<'_>, bits: u64) -> Outcome<Vec<Ball>> {
        Ok(vec![self.derivative(order, bits)?])
    }

    fn taylor(
        &self,
        _: &[usize],
        order: usize,
        _: (&Rational, &Rational),
        terms: usize,
        bits: u64,
    ) -> Outcome<Taylor> {
        let mut coefficients = vec![Ball::zero(); terms];
        coefficients[0] = self.derivative(order, bits)?;
        Ok(Taylor::polynomial(coefficients))
    }

    fn exact_at(&self, _: &[usize], _: &Fraction, _: Effort) -> Option<Expression> {
        Some(self.value.clone().into())
    }

    fn flatness(&self, _: &[usize], _: (&Mark<'_>, Limit), order: usize) -> Outcome<usize> {
        Ok(if order > 0 || self.value.is_zero() { MAX_FLATNESS } else { 0 })
    }

    fn point(&self, _: &Rational, _: Limit) -> Outcome<(Known, Enclosure<'_>, u64)> {
        let known = self.value.as_constant().map_or(Known::Unknown, Known::Rational);
        Ok((known, Box::new(|bits| self.derivative(0, bits)), u64::MAX))
    }

    fn most_bits(&self) -> u64 {
        u64::MAX
    }

    fn echoes(&self) -> Option<EchoCount> {
        None
    }
}
