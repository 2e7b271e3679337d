//! A quantity by its values, and by what flows in: its derivative.
//!
//! It is continuous, and as smooth as the flow between the breaks of that, where its own may have more.

use super::{Mark, Outcome, Rule, Scale, locate, value_at};
use crate::ball::Ball;
use crate::expression::{Expression, Fraction};
use crate::signal::{At, Effort, Enclosure, Known, Limit, Signal, Taylor};
use num_traits::Zero as _;
use std::ops::Range;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// # Invariants
/// - both have the window of the result; `flow` is the derivative of `of` with respect to the time of the
///   scene.
pub(crate) struct Balanced<'a> {
    pub scale: Rc<Scale<'a>>,
    pub of: Box<dyn Signal + 'a>,
    pub flow: Box<dyn Signal + 'a>,
}

impl Balanced<'_> {
    fn slowness(&self, bits: u64) -> Outcome<Ball> {
        Ok(self.scale.numbers.enclose(self.scale.slowness(), bits)?)
    }
}

impl Rule for Balanced<'_> {
    fn ranges(&self) -> Outcome<Vec<Range<usize>>> {
        Ok(vec![0..self.flow.count()?])
    }

    fn mark(&self, _: usize, place: usize) -> Mark<'_> {
        Mark::of(&*self.flow, place)
    }

    fn is_instant(&self, _: usize, place: usize) -> bool {
        self.flow.is_instant(place)
    }

    fn is_zero(&self, _: &[usize]) -> bool {
        false
    }

    fn terms(
        &self,
        places: &[usize],
        order: usize,
        at: &Mark<'_>,
        bits: u64,
    ) -> Outcome<Vec<Ball>> {
        if let Some(order) = order.checked_sub(1) {
            let slope = value_at(&*self.flow, places[0], order, at, bits)?;
            return Ok(vec![slope.multiply(&self.slowness(bits)?, bits)]);
        }
        let time = at.ball(bits)?;
        let (about, half) = (Rational::from(time.midpoint()), Rational::from(time.radius()));
        let about = at.exact.clone().unwrap_or(about);
        if at.exact.is_some() || half.is_zero() {
            return Ok(vec![(self.of.point(&about, Limit::Right)?.enclose)(bits)?]);
        }
        let near = self.taylor(places, 0, (&about, &half), 2, bits)?;
        Ok(vec![near.coefficients[0].widened(&near.tail(1))])
    }

    fn taylor(
        &self,
        places: &[usize],
        order: usize,
        (middle, half): (&Rational, &Rational),
        terms: usize,
        bits: u64,
    ) -> Outcome<Taylor> {
        let (slope, kept) =
            (order.saturating_sub(1), terms - usize::from(order == 0).min(terms - 1));
        let flow = self.flow.taylor(places[0], slope, (middle, half), kept, bits)?;
        let flow = flow.scaled(&self.slowness(bits)?, bits);
        if order > 0 {
            return Ok(flow);
        }
        let mut sum = flow.antiderivative(bits).scaled(&Ball::from_rational(half, bits), bits);
        let value = (self.of.point(middle, Limit::Right)?.enclose)(bits)?;
        sum.coefficients[0] = sum.coefficients[0].add(&value, bits);
        Ok(sum)
    }

    fn exact_at(&self, _: &[usize], at: &Fraction, effort: Effort) -> Option<Expression> {
        if at.contains(&self.scale.network.scene().time) {
            return None;
        }
        let stretch = locate(&*self.of, &self.scale.mark_scaled(at), Limit::Right).ok()?;
        self.of.exact_at(stretch, at, effort)
    }

    fn slope_vanishes(&self, places: &[usize], end: Limit) -> Outcome<bool> {
        Ok(self.flow.exact(places[0], At::End(end))?.is_some_and(|slope| slope.is_zero()))
    }

    fn point(&self, at: &Rational, side: Limit) -> Outcome<(Known, Enclosure<'_>, u64)> {
        let point = self.of.point(at, side)?;
        Ok((point.known, point.enclose, point.most_bits))
    }

    fn most_bits(&self) -> u64 {
        self.of.most_bits().min(self.flow.most_bits())
    }

    fn echoes(&self) -> Option<(usize, usize)> {
        None
    }
}
