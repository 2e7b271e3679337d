//! Instants: exact sums of travel times and times of loads, counted from the start or from an event.
//!
//! What an event sends out arrives whole travel times later. So every instant is that of one event, or
//! of the start, and an exact delay. Instants of the same event compare exactly; those of different
//! events by enclosures.

use crate::ball::{Ball, Number};
use crate::enclosure::{EnclosureError, Numbers};
use crate::expression::Fraction;
use crate::history::error::{HistoryError, Question};
use num_traits::Zero;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// An instant in the scale of the scene.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Moment {
    /// The event that it is counted from; `None` for the start.
    pub event: Option<usize>,
    /// The delay since then.
    pub delay: Fraction,
}

impl Moment {
    /// An instant counted from the start.
    pub fn at(delay: Fraction) -> Moment {
        Moment { event: None, delay }
    }

    /// The instant a delay later.
    pub fn after(&self, delay: &Fraction) -> Moment {
        Moment { event: self.event, delay: &self.delay + delay }
    }

    /// The instant a delay earlier.
    pub fn before(&self, delay: &Fraction) -> Moment {
        Moment { event: self.event, delay: &self.delay - delay }
    }
}

/// Instants as numbers.
pub(crate) struct Clock {
    pub numbers: Numbers,
    pub bits: u64,
    /// When events without an exact instant are.
    events: Vec<Ball>,
}

impl Clock {
    pub fn new(numbers: Numbers, bits: u64) -> Clock {
        Clock { numbers, bits, events: Vec::new() }
    }

    /// An instant of which an enclosure is known.
    pub fn enclose(&mut self, instant: Ball) -> Moment {
        self.events.push(instant);
        Moment { event: Some(self.events.len() - 1), delay: Fraction::zero() }
    }

    /// An exact value of the scene as a number.
    ///
    /// # Errors
    /// [`HistoryError::Value`] for a symbol without a value.
    pub fn number(&self, value: &Fraction) -> Result<Number, EnclosureError> {
        self.numbers.number(value, self.bits)
    }

    /// The time since the start.
    ///
    /// # Errors
    /// As [`Clock::number`].
    pub fn time(&self, moment: &Moment) -> Result<Number, EnclosureError> {
        let delay = self.number(&moment.delay)?;
        Ok(match moment.event {
            None => delay,
            Some(event) => Number::Enclosed(self.events[event].clone()).add(&delay, self.bits),
        })
    }

    /// The time from one instant to another.
    ///
    /// # Errors
    /// As [`Clock::number`].
    pub fn since(&self, from: &Moment, to: &Moment) -> Result<Number, EnclosureError> {
        match from.event == to.event {
            true => self.number(&(&to.delay - &from.delay)),
            false => Ok(self.time(to)?.subtract(&self.time(from)?, self.bits)),
        }
    }

    /// Which of two instants is earlier.
    ///
    /// # Errors
    /// [`HistoryError::Undecided`] where their enclosures meet.
    pub fn compare(&self, left: &Moment, right: &Moment) -> Result<Ordering, HistoryError> {
        if left.event == right.event {
            if left.delay == right.delay {
                return Ok(Ordering::Equal);
            }
            return Ok(self.numbers.compare(&left.delay, &right.delay)?);
        }
        let difference = self.since(right, left)?;
        difference.sign().ok_or_else(|| HistoryError::Undecided {
            what: Question::Order,
            at: Box::new(self.time(left).map_or_else(|_| Ball::zero(), |t| t.ball(self.bits))),
            bits: self.bits,
        })
    }

    /// The earlier of two instants.
    ///
    /// # Errors
    /// As [`Clock::compare`].
    pub fn earlier(&self, left: Moment, right: Moment) -> Result<Moment, HistoryError> {
        Ok(if self.compare(&left, &right)? == Ordering::Greater { right } else { left })
    }

    /// An instant near a moment, as a double: for choices that need no proof.
    pub fn about(&self, moment: &Moment) -> f64 {
        self.time(moment).map_or(f64::NAN, |time| time.ball(64).to_double().0)
    }

    /// The instant after a time that has passed since a moment: exact where the time is.
    pub fn later(&mut self, from: &Moment, by: &Number) -> Result<Moment, EnclosureError> {
        match by.exact() {
            Some(by) if by.is_zero() => Ok(from.clone()),
            Some(by) => Ok(from.after(&Fraction::constant(by))),
            None => {
                let instant = self.time(from)?.add(by, self.bits);
                Ok(self.enclose(instant.ball(self.bits)))
            }
        }
    }

    /// A rational number of units of time after a moment.
    pub fn step(from: &Moment, by: &Rational) -> Moment {
        from.after(&Fraction::constant(by))
    }
}
