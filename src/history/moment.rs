//! Instants: exact sums of travel times and times of loads, counted from the start or from an event.
//!
//! What an event sends out arrives whole travel times later. So every instant is that of one event, or
//! of the start, and an exact delay. Instants of the same event compare exactly; those of different
//! events by enclosures.

use crate::ball::{Ball, Magnitude, Number, Value};
use crate::enclosure::{EnclosureError, Numbers};
use crate::expression::Fraction;
use crate::history::error::{HistoryError, Outcome, Question, When};
use crate::network::Assumed;
use num_traits::Zero;
use std::cell::RefCell;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// Digits of the times in assumptions.
pub const TOLD_DIGITS: usize = 12;

/// An instant in the scale of the scene.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Moment {
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

/// From so many bits on what is undecided by no more than `2^(−bits/2)`, in the scale of the scene, is a tie.
const TIE_BITS: u64 = 640;

/// Instants as numbers.
pub struct Clock {
    pub numbers: Numbers,
    pub bits: u64,
    /// When events without an exact instant are.
    events: Vec<Ball>,
    /// The unit of time, and its name after a space, for what is told.
    unit: (Number, &'static str),
    assumed: Assumed,
    /// The questions that were ties, each told when it is met first.
    ties: RefCell<Vec<Question>>,
}

impl Clock {
    /// The clock of a scene, which tells what it takes for granted.
    pub fn new(numbers: Numbers, bits: u64, assumed: &Assumed) -> Clock {
        let (unit, assumed) = ((Number::one(), ""), assumed.clone());
        Clock { numbers, bits, events: Vec::new(), unit, assumed, ties: RefCell::default() }
    }

    /// Tells times in this unit from now on.
    pub fn tell_in(&mut self, unit: Number, name: &'static str) {
        self.unit = (unit, name);
    }

    /// A time of the scene as it is told, with its unit.
    pub fn told(&self, time: &Number) -> When {
        let (scale, unit) = &self.unit;
        When { time: Box::new(time.multiply(scale, self.bits).ball(self.bits)), unit }
    }

    /// That a question about a time is not decided.
    pub fn undecided(&self, what: Question, at: &Number) -> HistoryError {
        HistoryError::Undecided { what, when: self.told(at), bits: self.bits }
    }

    /// How far from zero a tie may be; `None` where more bits are to be tried first.
    pub fn tie_size(&self) -> Option<Magnitude> {
        (self.bits >= TIE_BITS).then(|| Magnitude::power_of_two(-(self.bits as i64) / 2))
    }

    /// Takes the case on the border for granted, where what is undecided is a tie. Motion depends continuously
    /// on the data: what comes next is near on either side.
    pub fn tie(&self, what: Question, at: &Number, size: &Magnitude) -> Outcome<()> {
        if self.tie_size().is_none_or(|tie| *size > tie) {
            return Err(self.undecided(what, at));
        }
        self.assume(what, at);
        Ok(())
    }

    /// Whether anything was taken for granted.
    pub fn has_ties(&self) -> bool {
        !self.ties.borrow().is_empty()
    }

    /// Takes the case on the border for granted.
    pub fn assume(&self, what: Question, at: &Number) {
        if !self.ties.borrow().contains(&what) {
            let (unit, name) = &self.unit;
            let at = Value::of(&at.multiply(unit, self.bits), TOLD_DIGITS).to_text(TOLD_DIGITS);
            self.assumed.add(what.tied(&format!("{at}{name}")), self.bits);
            self.ties.borrow_mut().push(what);
        }
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
    pub fn time(&self, moment: &Moment) -> Result<Number, EnclosureError> {
        let delay = self.number(&moment.delay)?;
        Ok(match moment.event {
            None => delay,
            Some(event) => Number::Enclosed(self.events[event].clone()).add(&delay, self.bits),
        })
    }

    /// The time from one instant to another.
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
    pub fn compare(&self, left: &Moment, right: &Moment) -> Outcome<Ordering> {
        if left.event == right.event {
            if left.delay == right.delay {
                return Ok(Ordering::Equal);
            }
            return Ok(self.numbers.compare(&left.delay, &right.delay)?);
        }
        let difference = self.since(right, left)?;
        match difference.sign() {
            Some(order) => Ok(order),
            None => {
                self.tie(Question::Order, &self.time(left)?, &difference.magnitude())?;
                Ok(Ordering::Equal)
            }
        }
    }

    /// The earlier of two instants.
    pub fn earlier(&self, left: Moment, right: Moment) -> Outcome<Moment> {
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
