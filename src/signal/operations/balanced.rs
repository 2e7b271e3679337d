//! A quantity by its values, and by what flows in: its derivative.
//!
//! It is continuous, and as smooth as the flow between the breaks of that, where its own may have more.

use super::{Mark, Outcome, Rule, Scale, locate, taylor_by_rate, value_at};
use crate::ball::{Ball, Magnitude};
use crate::expression::{Expression, Fraction};
use crate::signal::signal::STILL_BITS;
use crate::signal::{At, Effort, Enclosure, Known, Limit, Near, Signal, Taylor};
use num_traits::Zero as _;
use std::cell::OnceCell;
use std::cmp::Ordering;
use std::ops::Range;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// # Invariants
/// - both have the window of the result; `flow` is the derivative of `of` with respect to the time of the
///   scene, and never has the sign that is opposite to `trend`.
pub(crate) struct Balanced<'a> {
    scale: Rc<Scale<'a>>,
    of: Box<dyn Signal + 'a>,
    flow: Box<dyn Signal + 'a>,
    trend: Option<Ordering>,
    /// The stretches of the flow with which those of the quantity begin: all but the last instant, and those
    /// on which nothing flows as before.
    kept: OnceCell<Vec<usize>>,
}

impl<'a> Balanced<'a> {
    pub fn new(
        scale: &Rc<Scale<'a>>,
        of: Box<dyn Signal + 'a>,
        flow: Box<dyn Signal + 'a>,
        trend: Option<Ordering>,
    ) -> Balanced<'a> {
        Balanced { scale: Rc::clone(scale), of, flow, trend, kept: OnceCell::new() }
    }

    fn slowness(&self, bits: u64) -> Outcome<Ball> {
        Ok(self.scale.numbers.enclose(&self.scale.slowness, bits)?)
    }

    /// The stretch of the flow of a place, at its beginning or its end.
    fn stretch(&self, place: usize, end: Limit) -> usize {
        let kept = self.kept.get().expect("places were counted");
        match (end, kept.get(place + 1)) {
            (Limit::Left, Some(next)) => next - 1,
            _ => kept[place],
        }
    }

    /// A time on a stretch that is told from its ends, near one that is known within a radius, and within
    /// which radius of it that one is.
    fn within(
        &self,
        place: usize,
        (time, radius): (Rational, Rational),
        bits: u64,
    ) -> Outcome<(Rational, Rational)> {
        let end = |end| -> Outcome<Rational> {
            let time = self.flow.time(self.stretch(place, end), end, bits)?;
            Ok(time.midpoint().into())
        };
        let (from, to) = (end(Limit::Right)?, end(Limit::Left)?);
        let two = Rational::from_integer(2.into());
        let away =
            Magnitude::power_of_two(-(bits as i64)).max(Magnitude::from_rational(&radius).scale(1));
        let away = Rational::from(&away).min((&to - &from) / &two);
        let about = match &time * &two < &from + &to {
            true => &time + &away,
            false => &time - &away,
        };
        Ok((about, radius + away))
    }

    /// Whether the quantity is known to be zero at the beginning or the end of a place: where nothing has
    /// flowed in on one side of it, or at the beginning of the window.
    fn is_zero_at(&self, place: usize, end: Limit) -> Outcome<bool> {
        let own = self.stretch(place, end);
        let begins_at_zero = |stretch: usize| -> Outcome<bool> {
            let start = locate(&*self.of, &Mark::of(&*self.flow, stretch), Limit::Right)?;
            let first = At::End(Limit::Right);
            let exact = || self.of.exact(start, first);
            Ok(self.of.is_zero(start)
                || self.of.enclose(start, 0, first, STILL_BITS)?.sign() == Some(Ordering::Equal)
                || exact()?.is_some_and(|value| value.is_zero()))
        };
        let stays_zero = |stretch| Ok(self.flow.vanishes(stretch, 0)? && begins_at_zero(stretch)?);
        match (end, own.checked_sub(1)) {
            _ if stays_zero(own)? => Ok(true),
            (Limit::Right, Some(before)) => stays_zero(before),
            (Limit::Right, None) => begins_at_zero(own),
            (Limit::Left, _) => Ok(false),
        }
    }

    /// As [`Signal::taylor`], about a time that is told from the breaks.
    fn expanded(&self, places: &[usize], near: Near<'_>) -> Outcome<Taylor> {
        let stretch = self.stretch(places[0], Limit::Right);
        let Near { place: (middle, _), bits, .. } = near;
        let rate = |near: Near<'_>| match self.flow.is_zero(stretch) {
            true => Ok(Taylor::polynomial(vec![Ball::zero(); near.terms])),
            false => Ok(self.flow.taylor(stretch, near)?.scaled(&self.slowness(bits)?, bits)),
        };
        let value = || (self.of.point(middle, Limit::Right)?.enclose)(bits);
        taylor_by_rate(near, rate, value)
    }
}

impl Rule for Balanced<'_> {
    fn ranges(&self) -> Outcome<Vec<Range<usize>>> {
        let count = self.flow.count()?;
        let goes_on = |stretch: &usize| {
            let last = count > 1 && stretch + 1 == count && self.flow.is_instant(*stretch);
            let is_still = |own: usize| self.flow.vanishes(own, 0).unwrap_or(false);
            let as_before = *stretch > 0 && is_still(stretch - 1) && is_still(*stretch);
            !(last || as_before)
        };
        let kept = self.kept.get_or_init(|| (0..count).filter(goes_on).collect());
        Ok(std::iter::once(0..kept.len()).collect())
    }

    fn mark(&self, _: usize, place: usize) -> Mark<'_> {
        Mark::of(&*self.flow, self.stretch(place, Limit::Right))
    }

    fn is_continuous(&self) -> bool {
        true
    }

    fn trend(&self) -> Option<Ordering> {
        self.trend
    }

    fn is_zero(&self, places: &[usize]) -> bool {
        let place = places[0];
        self.flow.vanishes(self.stretch(place, Limit::Right), 0).unwrap_or(false)
            && self.is_zero_at(place, Limit::Right).unwrap_or(false)
    }

    fn terms(
        &self,
        places: &[usize],
        order: usize,
        at: &Mark<'_>,
        bits: u64,
    ) -> Outcome<Vec<Ball>> {
        if let Some(order) = order.checked_sub(1) {
            let stretch = self.stretch(places[0], Limit::Right);
            let slope = value_at(&*self.flow, stretch, order, at, bits)?;
            return Ok(vec![slope.multiply(&self.slowness(bits)?, bits)]);
        }
        let time = at.ball(bits)?;
        let (time, half) = (Rational::from(time.midpoint()), Rational::from(time.radius()));
        if at.exact.is_some() || half.is_zero() {
            let time = at.exact.as_ref().unwrap_or(&time);
            return Ok(vec![(self.of.point(time, Limit::Right)?.enclose)(bits)?]);
        }
        let (about, half) = self.within(places[0], (time, half), bits)?;
        let near = Near { order: 0, place: (&about, &half), terms: 2, bits };
        let taylor = self.expanded(places, near)?;
        Ok(vec![taylor.coefficients[0].widened(&taylor.tail(1))])
    }

    /// The size of the flow's terms, or of the quantity's own: `terms` gives only their sum, in which they may cancel.
    fn size(
        &self,
        places: &[usize],
        order: usize,
        (time, at): (&Rational, &Mark<'_>),
        bits: u64,
    ) -> Outcome<(Magnitude, Magnitude)> {
        let Some(order) = order.checked_sub(1) else {
            let stretch = locate(&*self.of, at, Limit::Right)?;
            return self.of.size(stretch, 0, time, bits);
        };
        let stretch = self.stretch(places[0], Limit::Right);
        let (size, error) = self.flow.size(stretch, order, time, bits)?;
        let slowness = self.slowness(bits)?.magnitude();
        Ok((size.multiply(&slowness), error.multiply(&slowness)))
    }

    fn taylor(&self, places: &[usize], near: Near<'_>) -> Outcome<Taylor> {
        let Near { order, place: (middle, half), bits, .. } = near;
        if order == 0
            && Magnitude::from_rational(half) < Magnitude::power_of_two(-(bits as i64) / 3)
        {
            // So short a time may be an instant that another scene has too, and is told from no break then: one beside
            // it is.
            let (about, reach) = self.within(places[0], (middle.clone(), half.clone()), bits)?;
            let taylor = self.expanded(places, Near { place: (&about, &reach), ..near })?;
            return Ok(taylor.part(&((middle - about) / &reach), &(half / &reach), bits));
        }
        self.expanded(places, near)
    }

    fn exact_at(&self, places: &[usize], at: &Fraction, effort: Effort) -> Option<Expression> {
        if at.contains(self.scale.clock) {
            return None;
        }
        let at_start = self.mark(0, places[0]).compare(&self.scale.mark_scaled(at)).ok()?.is_eq();
        if at_start && self.is_zero_at(places[0], Limit::Right).ok()? {
            return Some(Expression::zero());
        }
        let stretch = locate(&*self.of, &self.scale.mark_scaled(at), Limit::Right).ok()?;
        self.of.exact_at(stretch, at, effort)
    }

    fn flatness(
        &self,
        places: &[usize],
        (_, end): (&Mark<'_>, Limit),
        order: usize,
    ) -> Outcome<usize> {
        let stretch = self.stretch(places[0], end);
        match order.checked_sub(1) {
            Some(order) => self.flow.flatness(stretch, end, order),
            None if self.is_zero_at(places[0], end)? => {
                Ok(1 + self.flow.flatness(stretch, end, 0)?)
            }
            None => Ok(0),
        }
    }

    fn point(&self, at: &Rational, side: Limit) -> Outcome<(Known, Enclosure<'_>, u64)> {
        let point = self.of.point(at, side)?;
        Ok((point.known, point.enclose, point.most_bits))
    }

    fn operands(&self) -> Vec<&dyn Signal> {
        vec![&*self.of, &*self.flow]
    }
}
