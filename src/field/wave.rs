//! The two waves of every bar as they enter it at its ends, of which fields are made.
//!
//! A wave to the right enters a bar at its left end and passes every section unchanged; one to the left
//! enters at the right end. All fields follow from these signals of the scene,
//!
//! ```text
//! v = V + f + g        X = X_0 + Z (f − g)
//! ```
//!
//! which are what is added to the state at the start, zero before it.
//!
//! Pictures show both sides of a front. Where the instant of an event is only enclosed, one number stands
//! for it in all waves, so that fronts that meet are drawn at one place.

use super::{FIRST_BITS, FieldError};
use crate::ball::{Attempt, Ball, Magnitude, Precisions};
use crate::enclosure::Numbers;
use crate::expression::Fraction;
use crate::limits::MAX_HISTORY_BITS;
use crate::network::Network;
use crate::planner::{self, EnteringWave};
use crate::signal::{At, EvaluateError, Limit, Signal, has_begun, last_begun};
use std::cell::OnceCell;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep_polynomial::Rational;

/// How narrow the enclosure of an event is before a number stands for it, in bits.
const STAND_IN_BITS: i64 = 100;

/// A jump that is known to be smaller than this is none.
const NO_JUMP_BITS: i64 = 100;

/// A wave of a bar.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Entering {
    /// The bar, by its place in the line.
    pub bar: usize,
    /// Which of its waves.
    pub heading: Heading,
}

/// The direction of a wave.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Heading {
    Right,
    Left,
}

/// A derivative or integral of a wave `f`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Order {
    /// `f'`
    Slope,
    /// `f`
    Value,
    /// `F = ∫ f dt` since the start.
    Integral,
    /// `∫ F dt` since the start.
    DoubleIntegral,
}

/// An instant at the end of a bar, in the scale of the scene, and the limit there.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    pub at: &'a Fraction,
    pub side: Limit,
    /// Whether a number that stands for a front means the front, as in pictures. The function on that side
    /// of the front is then continued to the number.
    pub is_drawn: bool,
}

/// When a wave changes, in numbers: exact instants, or the middles of their enclosures.
pub struct Drawn {
    /// When the stretches of the wave and of its integral begin.
    starts: [Vec<Fraction>; 2],
    /// Where the wave, its slope or its curvature jumps, ascending.
    fronts: Vec<Fraction>,
}

/// When events without an exact instant are, in the scale of the scene.
type Events = BTreeMap<(u64, usize), Ball>;

/// The waves of the bars of a scene, until a time.
pub struct Waves<'a> {
    pub numbers: Numbers,
    slowness: &'a Fraction,
    /// Of each bar the waves to the right and to the left; none for what comes from afar.
    pub entering: Vec<[Option<EnteringWave<'a>>; 2]>,
    drawn: OnceCell<Vec<[Option<Drawn>; 2]>>,
}

impl<'a> Waves<'a> {
    pub fn new(network: &'a Network, last: &Rational) -> Result<Waves<'a>, FieldError> {
        Ok(Waves {
            numbers: Numbers::new(&network.model().constants),
            slowness: &network.model().slowness,
            entering: planner::entering_waves(network, last)?,
            drawn: OnceCell::new(),
        })
    }

    /// An enclosure of a wave, its slope or its integral, in the scale of the scene.
    pub fn value(
        &self,
        wave: Entering,
        order: Order,
        instant: Instant<'_>,
        bits: u64,
    ) -> Result<Ball, FieldError> {
        let Instant { at, side, is_drawn } = instant;
        let place = wave.heading as usize;
        let Some(levels) = &self.entering[wave.bar][place] else { return Ok(Ball::zero()) };
        let (level, derivative) = match order {
            Order::Slope => (0, 1),
            Order::Value => (0, 0),
            Order::Integral => (1, 0),
            Order::DoubleIntegral => (2, 0),
        };
        let signal = &*levels[level];
        let drawn = if is_drawn { self.drawn()?[wave.bar][place].as_ref() } else { None };
        let starts = drawn.and_then(|drawn| drawn.starts.get(level));
        let begins = |stretch: usize| match starts {
            Some(starts) => Ok(self.numbers.compare(&starts[stretch], at)?),
            None => {
                signal.begins(stretch, at).map_err(|error| self.undecided(signal, stretch, error))
            }
        };
        let stretch = last_begun(signal.count()?, side, begins)?;
        if stretch == 0 {
            let begun = self.numbers.compare(at, &Fraction::zero())?;
            let side = if level > 0 { Limit::Left } else { side };
            if !has_begun(begun.reverse(), side) {
                return Ok(Ball::zero());
            }
        }
        let value = signal.enclose(stretch, derivative, At::Scaled(at), bits)?;
        Ok(match order {
            Order::Slope => value.multiply(&self.time_unit(bits)?, bits),
            _ => value,
        })
    }

    /// The fronts of a wave that enter in a window.
    pub fn fronts(
        &self,
        wave: Entering,
        [from, to]: [&Fraction; 2],
    ) -> Result<Vec<Fraction>, FieldError> {
        let mut fronts = Vec::new();
        for at in self.drawn()?[wave.bar][wave.heading as usize].iter().flat_map(|own| &own.fronts)
        {
            if self.numbers.compare(at, from)? != Ordering::Less
                && self.numbers.compare(at, to)? != Ordering::Greater
            {
                fronts.push(at.clone());
            }
        }
        Ok(fronts)
    }

    /// One in the scale of the scene in the user's unit of time.
    pub fn time_unit(&self, bits: u64) -> Result<Ball, FieldError> {
        let slowness = self.numbers.enclose(self.slowness, bits)?;
        Ok(slowness.reciprocal(bits).map_err(EvaluateError::Ball)?)
    }

    /// When a stretch begins, in the scale of the scene.
    fn start(&self, signal: &dyn Signal, stretch: usize, bits: u64) -> Result<Ball, FieldError> {
        let slowness = self.numbers.enclose(self.slowness, bits)?;
        Ok(signal.time(stretch, Limit::Right, bits)?.multiply(&slowness, bits))
    }

    /// Why it is not known whether a stretch has begun.
    fn undecided(&self, signal: &dyn Signal, stretch: usize, error: EvaluateError) -> FieldError {
        match (&error, self.start(signal, stretch, FIRST_BITS)) {
            (EvaluateError::NotFollowed { bits }, Ok(at)) => {
                FieldError::Undecided { at: Box::new(at), bits: *bits }
            }
            _ => error.into(),
        }
    }

    /// What is drawn of all waves.
    fn drawn(&self) -> Result<&[[Option<Drawn>; 2]], FieldError> {
        if let Some(drawn) = self.drawn.get() {
            return Ok(drawn);
        }
        let attempt = |bits| {
            let mut events = Events::new();
            let mut drawn = Vec::with_capacity(self.entering.len());
            for pair in &self.entering {
                let [right, left] = pair.each_ref().map(|wave| {
                    wave.as_ref().map(|wave| self.drawn_of(wave, &mut events, bits)).transpose()
                });
                drawn.push([right?, left?]);
            }
            let narrow = Magnitude::power_of_two(-STAND_IN_BITS);
            let is_narrow = events.values().all(|event| *event.radius() <= narrow);
            Ok::<_, FieldError>(Attempt::of(drawn, is_narrow))
        };
        let drawn = Precisions::doubling(FIRST_BITS, MAX_HISTORY_BITS).raise(attempt)?.best();
        Ok(self.drawn.get_or_init(|| drawn))
    }

    fn drawn_of(
        &self,
        [wave, integral, _]: &EnteringWave<'_>,
        events: &mut Events,
        bits: u64,
    ) -> Result<Drawn, FieldError> {
        let mut starts = |signal: &dyn Signal| -> Result<Vec<Fraction>, FieldError> {
            let count = signal.count()?;
            // From now on events are known with so many bits.
            let _ = signal.time(0, Limit::Right, bits)?;
            (0..count).map(|stretch| self.stand_in(signal, stretch, events, bits)).collect()
        };
        let wave = &**wave;
        let starts = [starts(wave)?, starts(&**integral)?];
        let mut fronts = Vec::new();
        for (stretch, start) in starts[0].iter().enumerate() {
            if self.is_front(wave, stretch, bits)? {
                fronts.push(start.clone());
            }
        }
        Ok(Drawn { starts, fronts })
    }

    /// The exact instant at which a stretch begins, or a number in the middle of its enclosure.
    fn stand_in(
        &self,
        signal: &dyn Signal,
        stretch: usize,
        events: &mut Events,
        bits: u64,
    ) -> Result<Fraction, FieldError> {
        let Some(instant) = signal.instant(stretch) else {
            return Ok(Fraction::constant(&self.start(signal, stretch, bits)?.midpoint().into()));
        };
        let Some(event) = instant.event else { return Ok(instant.delay) };
        let time = self.start(signal, stretch, bits)?;
        let since = self.numbers.enclose(&instant.delay, bits)?;
        let event = events.entry(event).or_insert_with(|| time.subtract(&since, bits));
        Ok(&Fraction::constant(&event.midpoint().into()) + &instant.delay)
    }

    /// Whether a wave, its slope or its curvature jumps where a stretch begins. Stretches also end where
    /// a series would become too long.
    fn is_front(&self, signal: &dyn Signal, stretch: usize, bits: u64) -> Result<bool, FieldError> {
        let mut factor = Ball::from_integer(&1.into());
        for order in 0..3 {
            let after = signal.enclose(stretch, order, At::End(Limit::Right), bits)?;
            let before = match stretch.checked_sub(1) {
                Some(before) => signal.enclose(before, order, At::End(Limit::Left), bits)?,
                None => Ball::zero(),
            };
            let jump = after.subtract(&before, bits).multiply(&factor, bits);
            // Near the beginning and the end of a local contact little is known of derivatives.
            let is_known = !jump.contains_zero();
            if is_known && jump.magnitude() > Magnitude::power_of_two(-NO_JUMP_BITS) {
                return Ok(true);
            }
            factor = factor.multiply(&self.time_unit(bits)?, bits);
        }
        Ok(false)
    }
}
