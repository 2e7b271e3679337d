//! The waves in a bar as strips between characteristics, for diagrams of place and time.
//!
//! A wave to the right is constant along `t − x/c`. It is cut into strips along its fronts, and into
//! more where it varies; where two strips cross, a field is constant or nearly so. What is constant
//! between fronts is thus drawn exactly, and nothing is smeared across them.

use super::wave::{Entering, Heading, Instant, Order};
use super::{FIRST_BITS, FieldError, FieldEvaluator, MAX_BITS};
use crate::ball::{Attempt, Ball, Magnitude, Precisions};
use crate::expression::{Fraction, Root};
use crate::network::{Extent, FieldBar};
use crate::signal::{EvaluateError, Limit};
use wavestep_polynomial::Rational;

/// A stretch of a wave, by the times at which it enters the bar.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Strip {
    /// When its beginning enters.
    pub from: f64,
    /// When its end does.
    pub to: f64,
    /// What it adds to the velocity, at its middle.
    pub value: f64,
}

/// A front: when it enters a bar, and what jumps there.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Front {
    /// When it enters.
    pub at: f64,
    /// Whether velocity and strain jump; else their slopes do.
    pub jumps: bool,
}

/// The waves of a bar on a window of time.
///
/// In it `v = velocity + f + g` and `X = force + impedance·(f − g)`, where `f` is the value of the
/// strip of `right` that entered `x·slowness` before, and `g` that of `left`.
///
/// # Invariants
/// - strips follow one another without gaps.
#[derive(Clone, PartialEq, Debug)]
pub struct BarWaves {
    /// The name of the bar.
    pub name: String,
    /// Its length; of an endless bar, the length that is drawn.
    pub length: f64,
    /// The time that a wave takes for a unit of length.
    pub slowness: f64,
    /// Whether it is endless.
    pub is_endless: bool,
    /// Its velocity at the start.
    pub velocity: f64,
    /// The force that compresses it at the start.
    pub force: f64,
    /// Its impedance.
    pub impedance: f64,
    /// The force over the strain.
    pub stiffness: f64,
    /// The wave to the right, by the time at the left end.
    pub right: Vec<Strip>,
    /// The wave to the left, by the time at the right end.
    pub left: Vec<Strip>,
    /// The fronts to the right.
    pub right_fronts: Vec<Front>,
    /// The fronts to the left.
    pub left_fronts: Vec<Front>,
}

/// The absolute accuracy of what is drawn, in bits.
const FINE_BITS: i64 = 48;

/// Jumps below this part of the largest value are no fronts.
const VISIBLE: f64 = 1e-9;

impl FieldEvaluator<'_> {
    /// The waves of all bars on a window of time, in strips: at least `strips` of them for the window
    /// where a wave is not constant. Of an endless bar as much is drawn as the others are long together,
    /// or as waves have reached.
    pub fn waves(
        &self,
        [from, to]: [&Rational; 2],
        strips: usize,
    ) -> Result<Vec<BarWaves>, FieldError> {
        if from >= to || *from < Rational::default() {
            return Err(EvaluateError::EmptyWindow.into());
        }
        if *to > self.last {
            return Err(EvaluateError::AfterLast.into());
        }
        let mut found = Vec::with_capacity(self.bars.len());
        for (place, bar) in self.bars.iter().enumerate() {
            let endless = bar.extent != Extent::Finite;
            let (span, length) = self.drawn_span(bar, to)?;
            let second = self.network().scaled_time(&Rational::from_integer(1.into()));
            let slowness = self.double_of(&span)? / self.double_of(&second)? / length;
            let unit = |place: usize| self.double(&bar.units[place]);
            let strips_of = |heading: Heading| {
                self.wave_strips(Entering { bar: place, heading }, &span, [from, to], strips)
            };
            let (right, right_fronts) = strips_of(Heading::Right)?;
            let (left, left_fronts) = strips_of(Heading::Left)?;
            let scaled = |strips: Vec<Strip>, unit: f64| {
                strips.into_iter().map(|s| Strip { value: s.value * unit, ..s }).collect()
            };
            let (velocity, force) = (unit(0)?, unit(3)?);
            found.push(BarWaves {
                name: self.name(bar).to_owned(),
                length,
                slowness,
                is_endless: endless,
                velocity: velocity * self.double_of(&bar.data.velocity)?,
                force: force * self.double_of(&bar.data.force)?,
                impedance: self.double_of(&bar.data.impedance)? * force / velocity,
                stiffness: force / unit(1)?,
                right: scaled(right, velocity),
                left: scaled(left, velocity),
                right_fronts,
                left_fronts,
            });
        }
        Ok(found)
    }

    /// The part of a bar that is drawn, as a delay and as a length: all of it; of an endless bar as much
    /// as the others are long together, or as waves have reached.
    pub(super) fn drawn_span(
        &self,
        bar: &FieldBar,
        to: &Rational,
    ) -> Result<(Fraction, f64), FieldError> {
        let asked = self.reach.as_ref();
        let (span, length) = self.span(bar, &self.network().scaled_time(to), asked)?;
        let length = self.double(&length)?;
        let reach = match bar.extent {
            _ if asked.is_some() => None,
            Extent::Finite => None,
            _ => self.reach_of_endless(to)?.filter(|reach| *reach < length),
        };
        Ok(match reach {
            Some(reach) => {
                let share = Rational::from_float(reach / length).expect("a finite number");
                (span.scale(&share), reach)
            }
            None => (span, length),
        })
    }

    /// The total length of the bars that are not endless; `None` if all are.
    fn reach_of_endless(&self, to: &Rational) -> Result<Option<f64>, FieldError> {
        let mut sum = 0.0;
        for bar in self.bars.iter().filter(|bar| bar.extent == Extent::Finite) {
            sum += self.double(&self.span(bar, &self.network().scaled_time(to), None)?.1)?;
        }
        Ok((sum > 0.0).then_some(sum))
    }

    fn double(&self, value: &Root) -> Result<f64, FieldError> {
        Ok(self.waves.numbers.enclose_root(value, FIRST_BITS)?.to_double().0)
    }

    pub(super) fn double_of(&self, value: &Fraction) -> Result<f64, FieldError> {
        Ok(self.waves.numbers.enclose(value, FIRST_BITS)?.to_double().0)
    }

    /// A wave in strips, from one travel time before the window to its end, and its fronts.
    fn wave_strips(
        &self,
        wave: Entering,
        span: &Fraction,
        [from, to]: [&Rational; 2],
        strips: usize,
    ) -> Result<(Vec<Strip>, Vec<Front>), FieldError> {
        let scaled = |time: &Rational| self.network().scaled_time(time);
        let drawn = DrawnWave { fields: self, wave, unit: self.waves.time_unit(FIRST_BITS)? };
        let (first, last) = (&scaled(from) - span, scaled(to));
        let mut ends = vec![first.clone()];
        ends.extend(
            self.waves.fronts(wave, [&first, &last])?.into_iter().filter(|at| *at != first),
        );
        ends.push(last.clone());
        ends.dedup();
        let density = strips as f64 / (drawn.seconds(&last)? - drawn.seconds(&first)?);
        let mut found: Vec<Strip> = Vec::new();
        for pair in ends.windows(2) {
            drawn.add_strips([&pair[0], &pair[1]], density, &mut found)?;
        }
        let scale = found.iter().map(|strip| strip.value.abs()).fold(0.0, f64::max);
        let mut fronts = Vec::new();
        for at in &ends[..ends.len() - 1] {
            fronts.extend(drawn.front(at, scale)?);
        }
        Ok((found, fronts))
    }
}

/// A wave to be drawn.
struct DrawnWave<'a> {
    fields: &'a FieldEvaluator<'a>,
    wave: Entering,
    /// One in the scale of the scene in seconds.
    unit: Ball,
}

impl DrawnWave<'_> {
    fn seconds(&self, time: &Fraction) -> Result<f64, FieldError> {
        let ball = self.fields.waves.numbers.enclose(time, FIRST_BITS)?;
        Ok(ball.multiply(&self.unit, FIRST_BITS).to_double().0)
    }

    /// Late waves are small differences of large terms, so the precision grows until everything that can
    /// be seen is decided. Velocities are of the order of 1 in the scale of the scene.
    fn value(&self, at: &Fraction, order: Order, side: Limit) -> Result<f64, FieldError> {
        let fine = Magnitude::power_of_two(-FINE_BITS);
        let attempt = |bits| {
            let instant = Instant { at, side, is_drawn: true };
            let ball = self.fields.waves.value(self.wave, order, instant, bits)?;
            if *ball.radius() > fine {
                let best = Box::new(ball);
                let error = EvaluateError::AccuracyNotReached { best, bits };
                return Ok(Attempt::NotYet(error.into()));
            }
            let value = if ball.contains_zero() { 0.0 } else { ball.to_double().0 };
            Ok(Attempt::Done(value))
        };
        Precisions::doubling(FIRST_BITS, MAX_BITS).raise(attempt).and_then(Attempt::done)
    }

    /// Adds the strips between two breaks: one where the wave is constant, joined with the one before if
    /// that has the same value; else so many per second.
    fn add_strips(
        &self,
        [from, to]: [&Fraction; 2],
        density: f64,
        found: &mut Vec<Strip>,
    ) -> Result<(), FieldError> {
        let (start, end) = (self.seconds(from)?, self.seconds(to)?);
        let length = to - from;
        let at = |numerator: usize, denominator: usize| {
            from + &length.scale(&Rational::new(numerator.into(), denominator.into()))
        };
        let low = self.value(from, Order::Value, Limit::Right)?;
        let middle = self.value(&at(1, 2), Order::Value, Limit::Right)?;
        let high = self.value(to, Order::Value, Limit::Left)?;
        let size = low.abs().max(middle.abs()).max(high.abs());
        if (low - middle).abs().max((high - middle).abs()) <= VISIBLE * size {
            match found.last_mut().filter(|last| last.value == middle) {
                Some(last) => last.to = end,
                None => found.push(Strip { from: start, to: end, value: middle }),
            }
            return Ok(());
        }
        let count = ((end - start) * density).ceil().max(1.0) as usize;
        let place = |i: usize| start + (end - start) * i as f64 / count as f64;
        for i in 0..count {
            let value = self.value(&at(2 * i + 1, 2 * count), Order::Value, Limit::Right)?;
            found.push(Strip { from: place(i), to: place(i + 1), value });
        }
        Ok(())
    }

    /// The front at a break, if the wave or its slope jumps there visibly.
    fn front(&self, at: &Fraction, scale: f64) -> Result<Option<Front>, FieldError> {
        for order in [Order::Value, Order::Slope] {
            let after = self.value(at, order, Limit::Right)?;
            let before = self.value(at, order, Limit::Left)?;
            if (after - before).abs() > VISIBLE * scale {
                let jumps = matches!(order, Order::Value);
                return Ok(Some(Front { at: self.seconds(at)?, jumps }));
            }
        }
        Ok(None)
    }
}
