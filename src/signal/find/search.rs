//! A window of time in which roots and extrema of one observable are looked for.
//!
//! A search asks it for enclosures, and for exact values
//! where a ball cannot decide because the answer is zero.

use crate::ball::{Attempt, Ball, Precisions};
use crate::expression::Fraction;
use crate::signal::error::{EvaluateError, Outcome};
use crate::signal::signal::{At, Effort, Limit, Signal, later, zeros_of};
use std::cell::Cell;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// The precision in bits that is begun with, also for times that are irrational, where they bound a cell: a scene that is followed
/// has it.
const FIRST_BITS: u64 = 192;

/// The most bits of such times: more than it takes to tell two arrivals apart.
const MAX_BOUND_BITS: u64 = 1 << 16;

/// Of how many parts of a stretch its bounds may lie one beyond its ends.
const BOUND_SHARE: u128 = 1 << 80;

/// The most bits that a sign is tried with, unless fewer are allowed.
const SIGN_BITS: u64 = 1 << 12;

/// The same of a derivative.
const SLOPE_BITS: u64 = 1 << 10;

/// What is looked at: the derivative of this order, less a level where that is 0.
#[derive(Clone, Copy)]
pub(crate) struct Target<'a> {
    pub order: usize,
    pub level: &'a Rational,
    /// The most bits of balls.
    pub limit_bits: u64,
}

/// An observable on a window of the user's time.
///
/// # Invariants
/// - the window is not empty; every symbol has a value; its arrivals are known.
pub struct Search<'a> {
    pub(crate) function: &'a dyn Signal,
    /// How many stretches are looked at.
    pub(crate) count: usize,
    /// The precision that has done so far.
    pub(crate) bits: Cell<u64>,
    /// The cells looked at so far.
    pub(crate) work: Cell<usize>,
    /// Whether the end of the window, at which an echo arrives, is left out.
    pub(crate) open: bool,
}

impl<'a> Search<'a> {
    /// A signal on its window, both its ends included.
    pub fn new(signal: &'a dyn Signal) -> Outcome<Search<'a>> {
        let window = signal.window();
        if window[1] <= window[0] || *window[0] < Rational::default() {
            return Err(EvaluateError::EmptyWindow);
        }
        if let Ok(form) = signal.closed_form() {
            form.foresee(window[1])?;
        }
        let (count, bits, work) = (signal.count()?, Cell::new(FIRST_BITS), Cell::new(0));
        Ok(Search { function: signal, count, bits, work, open: false })
    }

    /// As many bits as are allowed and tell more.
    pub(crate) fn most_bits(&self, limit_bits: u64) -> u64 {
        limit_bits.min(self.function.most_bits()).max(self.bits.get())
    }

    /// The same window without its end: an echo that arrives there does not count, the limit before
    /// does.
    #[must_use]
    pub fn half_open(mut self) -> Search<'a> {
        if self.count > 1 && self.function.is_instant(self.count - 1) {
            self.count -= 1;
            self.open = true;
        }
        self
    }

    /// An enclosure of the target.
    pub(crate) fn enclose(
        &self,
        stretch: usize,
        target: Target<'_>,
        at: At<'_>,
        bits: u64,
    ) -> Outcome<Ball> {
        let value = self.function.enclose(stretch, target.order, at, bits)?;
        if target.order > 0 || *target.level == Rational::default() {
            return Ok(value);
        }
        Ok(value.subtract(&Ball::from_rational(target.level, bits), bits))
    }

    /// The sign of the target by balls, and exactly where the first balls do not tell it; `None` where it is
    /// not decided.
    pub(crate) fn sign(
        &self,
        stretch: usize,
        target: Target<'_>,
        at: At<'_>,
    ) -> Outcome<Option<Ordering>> {
        let function = self.function;
        if target.order == 0 && function.is_zero(stretch) {
            return Ok(Some(Rational::default().cmp(target.level)));
        }
        let most = if target.order == 0 { SIGN_BITS } else { SLOPE_BITS };
        let precisions = Precisions::doubling(self.bits.get(), target.limit_bits.min(most));
        let attempt = |bits| {
            let sign = match (self.enclose(stretch, target, at, bits)?.sign(), target.order, at) {
                (None, 0, _) if bits == precisions.first() => {
                    match (function.exact(stretch, at)?, at) {
                        (Some(value), _) => Some(value.cmp(target.level)),
                        (None, At::End(end)) if *target.level == Rational::default() => {
                            self.sign_at_end(stretch, end)?
                        }
                        (None, _) => None,
                    }
                }
                (None, 1, At::End(side)) if bits == precisions.first() => {
                    (function.flatness(stretch, side, 1)? > 0).then_some(Ordering::Equal)
                }
                (sign, ..) => sign,
            };
            Ok(Attempt::of(sign, sign.is_some()))
        };
        precisions.raise(attempt).map(Attempt::best)
    }

    /// What is known of the sign in the limit at an end of a stretch, whatever enclosures tell.
    fn sign_at_end(&self, stretch: usize, end: Limit) -> Outcome<Option<Ordering>> {
        let signed = self.function.signed(stretch).filter(|own| own.holds_at(end));
        if let Some(signed) = signed {
            return Ok(Some(signed.sign));
        }
        let vanishes = self.function.flatness(stretch, end, 0)? > 0;
        Ok(vanishes.then_some(Ordering::Equal))
    }

    /// How many derivatives, from the target on, are known to be exactly zero in the limit at an end of a stretch.
    pub(crate) fn flatness(
        &self,
        stretch: usize,
        end: Limit,
        target: Target<'_>,
    ) -> Outcome<usize> {
        let function = self.function;
        if target.order > 0 || *target.level == Rational::default() {
            return function.flatness(stretch, end, target.order);
        }
        match function.exact(stretch, At::End(end))?.as_ref() == Some(target.level) {
            true => Ok(1 + function.flatness(stretch, end, 1)?),
            false => Ok(0),
        }
    }

    /// How many derivatives, from that of an order on, are known to be exactly zero at a time.
    pub(crate) fn zeros_at(&self, stretch: usize, time: &Rational, order: usize) -> usize {
        let later = later();
        let at = &self.function.scaled_time(time) + &Fraction::symbol(&later);
        let function = self.function.exact_at(stretch, &at, Effort::Much);
        let zeros = function.map(|function| zeros_of(function, &later, &Fraction::zero(), order));
        // Where exact arithmetic fails nothing is known.
        zeros.and_then(Result::ok).unwrap_or(0)
    }

    /// Rational bounds of a stretch: its ends themselves where they are rational, else so little
    /// beyond them that the middle of no cell lies outside.
    pub(crate) fn bounds(&self, stretch: usize) -> Outcome<[Rational; 2]> {
        let attempt = |bits| {
            let outer = |end| -> Outcome<[Rational; 2]> {
                if let Some(time) = self.function.exact_time(stretch, end) {
                    return Ok([time.clone(), time]);
                }
                Ok(self.function.time(stretch, end, bits)?.bounds())
            };
            let ([first, after], [before, last]) = (outer(Limit::Right)?, outer(Limit::Left)?);
            let slack = (&after - &first).max(&last - &before);
            let is_near = slack * Rational::from_integer(BOUND_SHARE.into()) <= &before - &after;
            Ok(Attempt::of([first, last], is_near))
        };
        Precisions::doubling(FIRST_BITS, MAX_BOUND_BITS).raise(attempt).map(Attempt::best)
    }
}
