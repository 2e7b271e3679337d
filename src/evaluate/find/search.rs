//! A window of time in which roots and extrema of one observable are looked for.
//!
//! A search asks it for enclosures, and for exact values
//! where a ball cannot decide because the answer is zero.

use crate::ball::{Attempt, Ball, Precisions};
use crate::evaluate::error::EvaluateError;
use crate::evaluate::signal::Limit;
use crate::evaluate::signal::{At, Signal};
use std::cell::Cell;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// The precision in bits that is begun with.
const FIRST_BITS: u64 = 192;

/// The precision in bits of times that are irrational, where they bound a cell.
const BOUND_BITS: u64 = 320;

/// The most bits of such times: more than it takes to tell two arrivals apart.
const MAX_BOUND_BITS: u64 = 1 << 16;

/// Of how many parts of a stretch its bounds may lie one beyond its ends.
const BOUND_SHARE: u128 = 1 << 80;

/// The most bits that a sign is tried with, unless fewer are allowed.
const SIGN_BITS: u64 = 1 << 12;

/// An observable on a window of the user's time.
///
/// # Invariants
/// - the window is not empty; every symbol has a value; its arrivals are known.
pub struct Search<'a> {
    pub(crate) function: &'a dyn Signal,
    /// How many stretches are looked at.
    pub(crate) count: usize,
    pub(crate) window: [Rational; 2],
    /// The precision that has done so far.
    pub(crate) bits: Cell<u64>,
    /// The cells looked at so far.
    pub(crate) work: Cell<usize>,
    /// More bits than these tell no more.
    pub(crate) most_bits: u64,
    /// Whether the end of the window, at which an echo arrives, is left out.
    open: bool,
}

impl<'a> Search<'a> {
    /// A signal on its window, both its ends included.
    ///
    /// # Errors
    /// [`EvaluateError::EmptyWindow`]; [`EvaluateError::TooManyEchoes`] where too many arrivals lie in the
    /// window.
    pub fn new(signal: &'a dyn Signal) -> Result<Search<'a>, EvaluateError> {
        let window = signal.window();
        if window[1] <= window[0] || *window[0] < Rational::default() {
            return Err(EvaluateError::EmptyWindow);
        }
        if let Ok(form) = signal.closed_form() {
            form.foresee(window[1])?;
        }
        let (bits, work) = (Cell::new(FIRST_BITS), Cell::new(0));
        let (count, window) = (signal.count()?, window.map(Clone::clone));
        let most_bits = signal.most_bits();
        Ok(Search { function: signal, count, window, bits, work, most_bits, open: false })
    }

    /// The same window without its end: an echo that arrives there does not count, the limit before
    /// does.
    #[must_use]
    pub fn half_open(mut self) -> Search<'a> {
        if self.count > 1 && self.is_instant(self.count - 1) {
            self.count -= 1;
            self.open = true;
        }
        self
    }

    /// Whether an echo arrives at the end of the window.
    pub(crate) fn arrives_at_end(&self) -> bool {
        self.open
    }

    /// Whether a stretch is the last instant of the window alone, where an echo arrives.
    pub(crate) fn is_instant(&self, stretch: usize) -> bool {
        self.function.is_instant(stretch)
    }

    /// An enclosure of a derivative at a time of the user's.
    pub(crate) fn at(
        &self,
        stretch: usize,
        order: usize,
        time: &Rational,
        bits: u64,
    ) -> Result<Ball, EvaluateError> {
        self.function.enclose(stretch, order, At::Time(time), bits)
    }

    /// An enclosure of a derivative at an end of a stretch.
    pub(crate) fn limit(
        &self,
        stretch: usize,
        order: usize,
        side: Limit,
        bits: u64,
    ) -> Result<Ball, EvaluateError> {
        self.function.enclose(stretch, order, At::End(side), bits)
    }

    /// The sign of `f − level` in the limit at an end of a stretch; `None` where it is not decided.
    pub(crate) fn sign_of_limit(
        &self,
        stretch: usize,
        side: Limit,
        level: &Rational,
        limit_bits: u64,
    ) -> Result<Option<Ordering>, EvaluateError> {
        if self.function.is_zero(stretch) {
            return Ok(Some(Rational::default().cmp(level)));
        }
        self.sign(
            limit_bits,
            |bits| Ok(less(self.limit(stretch, 0, side, bits)?, level, bits)),
            || Ok(self.exact(stretch, At::End(side))?.map(|value| value.cmp(level))),
        )
    }

    /// The sign of `f − level` at a time within a stretch.
    pub(crate) fn sign_at(
        &self,
        stretch: usize,
        time: &Rational,
        level: &Rational,
        limit_bits: u64,
    ) -> Result<Option<Ordering>, EvaluateError> {
        self.sign(
            limit_bits,
            |bits| Ok(less(self.at(stretch, 0, time, bits)?, level, bits)),
            || Ok(self.exact(stretch, At::Time(time))?.map(|value| value.cmp(level))),
        )
    }

    /// A sign by balls, and by an exact value where the first balls do not tell it.
    fn sign(
        &self,
        limit_bits: u64,
        enclosure: impl Fn(u64) -> Result<Ball, EvaluateError>,
        exact: impl Fn() -> Result<Option<Ordering>, EvaluateError>,
    ) -> Result<Option<Ordering>, EvaluateError> {
        let precisions = Precisions::doubling(self.bits.get(), limit_bits.min(SIGN_BITS));
        let attempt = |bits| {
            let sign = match enclosure(bits)?.sign() {
                None if bits == precisions.first() => exact()?,
                sign => sign,
            };
            Ok(Attempt::of(sign, sign.is_some()))
        };
        precisions.raise(attempt).map(Attempt::best)
    }

    /// The value, where it is known to be rational.
    pub(crate) fn exact(
        &self,
        stretch: usize,
        at: At<'_>,
    ) -> Result<Option<Rational>, EvaluateError> {
        self.function.exact(stretch, at)
    }

    /// Whether the derivative in the limit at an end of a stretch is known to be exactly zero.
    pub(crate) fn slope_vanishes(
        &self,
        stretch: usize,
        side: Limit,
    ) -> Result<bool, EvaluateError> {
        Ok(self.limit(stretch, 1, side, self.bits.get())?.contains_zero()
            && self.function.slope_vanishes(stretch, side)?)
    }

    /// Whether `f = v` is known on all of a stretch.
    pub(crate) fn equals(&self, stretch: usize, value: &Rational) -> Result<bool, EvaluateError> {
        self.function.equals(stretch, value, &self.bounds(stretch)?, self.bits.get())
    }

    /// Rational bounds of a stretch: its ends themselves where they are rational, else so little
    /// beyond them that the middle of no cell lies outside.
    pub(crate) fn bounds(&self, stretch: usize) -> Result<[Rational; 2], EvaluateError> {
        let attempt = |bits| {
            let outer = |end| -> Result<(Rational, Rational), EvaluateError> {
                if let Some(time) = self.function.exact_time(stretch, end) {
                    return Ok((time.clone(), time));
                }
                Ok(rationals(&self.function.time(stretch, end, bits)?))
            };
            let ((first, after), (before, last)) = (outer(Limit::Right)?, outer(Limit::Left)?);
            let slack = (&after - &first).max(&last - &before);
            let is_near = slack * Rational::from_integer(BOUND_SHARE.into()) <= &before - &after;
            Ok(Attempt::of([first, last], is_near))
        };
        Precisions::doubling(BOUND_BITS, MAX_BOUND_BITS).raise(attempt).map(Attempt::best)
    }
}

/// `f − level`.
pub(crate) fn less(value: Ball, level: &Rational, bits: u64) -> Ball {
    match *level == Rational::default() {
        true => value,
        false => value.subtract(&Ball::from_rational(level, bits), bits),
    }
}

/// Two rationals with the ball between them.
pub(crate) fn rationals(ball: &Ball) -> (Rational, Rational) {
    let (lower, upper) = ball.endpoints();
    (Rational::from(&lower), Rational::from(&upper))
}
