//! Quantities that are one number on each stretch.

use super::{Mark, Outcome, Rule, Scale};
use crate::ball::Ball;
use crate::expression::{Expression, Fraction};
use crate::signal::{
    Effort, Enclosure, EvaluateError, Known, Limit, MAX_FLATNESS, Near, Taylor, last_begun,
};
use std::ops::Range;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// A number on each stretch.
///
/// # Invariants
/// - there is one value more than there are breaks, times of the scene in their order.
pub(crate) struct Constant<'a> {
    scale: Rc<Scale<'a>>,
    breaks: Vec<Fraction>,
    values: Vec<Fraction>,
}

impl<'a> Constant<'a> {
    /// One value for ever.
    pub fn new(scale: &Rc<Scale<'a>>, value: Fraction) -> Constant<'a> {
        Constant { scale: Rc::clone(scale), breaks: Vec::new(), values: vec![value] }
    }

    /// 1 on these intervals, which may overlap, and 0 elsewhere in a window of the user's time.
    pub fn within(
        scale: &Rc<Scale<'a>>,
        intervals: &[(Fraction, Option<Fraction>)],
        window: [&Rational; 2],
    ) -> Outcome<Constant<'a>> {
        let is_before =
            |one: &Mark<'_>, other: &Mark<'_>| Ok::<_, EvaluateError>(one.compare(other)?.is_lt());
        let [first, last] = window.map(|time| scale.mark(time));
        let mut breaks = Vec::new();
        for time in
            intervals.iter().flat_map(|(from, until)| [Some(from), until.as_ref()]).flatten()
        {
            let mark = scale.mark_scaled(time);
            if !is_before(&first, &mark)? || !is_before(&mark, &last)? {
                continue;
            }
            if let Err(place) = scale.numbers.search(&breaks, time)? {
                breaks.insert(place, time.clone());
            }
        }
        let mut values = Vec::new();
        for stretch in 0..=breaks.len() {
            let begin = match stretch.checked_sub(1) {
                Some(before) => scale.mark_scaled(&breaks[before]),
                None => first.again(),
            };
            let mut is_within = false;
            for (from, until) in intervals {
                let has_begun = !is_before(&begin, &scale.mark_scaled(from))?;
                let ends = until.as_ref().map(|until| is_before(&begin, &scale.mark_scaled(until)));
                is_within |= has_begun && ends.transpose()?.unwrap_or(true);
            }
            values.push(if is_within { Fraction::one() } else { Fraction::zero() });
        }
        Ok(Constant { scale: Rc::clone(scale), breaks, values })
    }

    fn derivative(&self, stretch: usize, order: usize, bits: u64) -> Outcome<Ball> {
        match order {
            0 => Ok(self.scale.numbers.enclose(&self.values[stretch], bits)?),
            _ => Ok(Ball::zero()),
        }
    }
}

impl Rule for Constant<'_> {
    fn ranges(&self) -> Outcome<Vec<Range<usize>>> {
        Ok(std::iter::once(0..self.values.len()).collect())
    }

    fn mark(&self, _: usize, place: usize) -> Mark<'_> {
        match place.checked_sub(1) {
            Some(before) => self.scale.mark_scaled(&self.breaks[before]),
            None => self.scale.mark(&Rational::default()),
        }
    }

    fn is_zero(&self, places: &[usize]) -> bool {
        self.values[places[0]].is_zero()
    }

    fn terms(&self, places: &[usize], order: usize, _: &Mark<'_>, bits: u64) -> Outcome<Vec<Ball>> {
        Ok(vec![self.derivative(places[0], order, bits)?])
    }

    fn taylor(&self, places: &[usize], near: Near<'_>) -> Outcome<Taylor> {
        let mut coefficients = vec![Ball::zero(); near.terms];
        coefficients[0] = self.derivative(places[0], near.order, near.bits)?;
        Ok(Taylor::polynomial(coefficients))
    }

    fn exact_at(&self, places: &[usize], _: &Fraction, _: Effort) -> Option<Expression> {
        Some(self.values[places[0]].clone().into())
    }

    fn flatness(&self, places: &[usize], _: (&Mark<'_>, Limit), order: usize) -> Outcome<usize> {
        Ok(if order > 0 || self.values[places[0]].is_zero() { MAX_FLATNESS } else { 0 })
    }

    fn point(&self, at: &Rational, side: Limit) -> Outcome<(Known, Enclosure<'_>, u64)> {
        let at = self.scale.mark(at);
        let stretch =
            last_begun(self.values.len(), side, |place| self.mark(0, place).compare(&at))?;
        let known = self.values[stretch].as_constant().map_or(Known::Unknown, Known::Rational);
        Ok((known, Box::new(move |bits| self.derivative(stretch, 0, bits)), u64::MAX))
    }
}
