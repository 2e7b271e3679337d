//! The waves in a bar as strips between characteristics, for diagrams of place and time.
//!
//! A wave to the right is constant along `t − x/c`. Cut into strips along its fronts, and further
//! where it is smooth, a field is constant, or nearly so, where two strips cross: what is constant
//! between fronts is drawn exactly, and nothing is smeared across them.

use super::entering::{Entering, Heading, Instant, Order};
use super::{FieldError, FieldEvaluator};
use crate::ball::{Attempt, Magnitude, Precisions};
use crate::evaluate::{EvaluateError, Limit};
use crate::expression::{Fraction, Root};
use crate::network::{Extent, FieldBar};
use wavestep_polynomial::Rational;

/// A part of a wave between two times at the end of the bar at which it enters.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Strip {
    /// When it enters.
    pub from: f64,
    /// When its end does.
    pub to: f64,
    /// What it adds to the velocity, in its middle.
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
    /// What the bar is called.
    pub name: String,
    /// Its length; for an endless bar, what is looked at of it.
    pub length: f64,
    /// The time that a wave takes for a unit of length.
    pub slowness: f64,
    /// Whether it goes on.
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

/// The precision of what is drawn.
const BITS: u64 = 192;

/// The precision at which a value is given up, and the absolute accuracy in bits of those that are drawn.
const MAX_BITS: u64 = 1 << 14;
const FINE_BITS: i64 = 48;

/// What is smaller than this part of the largest value is no front.
const VISIBLE: f64 = 1e-9;

impl FieldEvaluator {
    /// The waves of all bars on a window of time, in strips: at least `strips` of them for the window
    /// where a wave is not constant. Endless bars are looked at as far as all others reach together,
    /// or as waves have come.
    ///
    /// # Errors
    /// [`FieldError::Evaluate`], also for an empty window.
    pub fn waves(
        &self,
        [from, to]: [&Rational; 2],
        strips: usize,
    ) -> Result<Vec<BarWaves>, FieldError> {
        if from >= to || *from < Rational::default() {
            return Err(EvaluateError::EmptyWindow.into());
        }
        let mut found = Vec::with_capacity(self.bars.len());
        for (place, bar) in self.bars.iter().enumerate() {
            let endless = bar.extent != Extent::Finite;
            let (span, length) = self.span_looked_at(bar, to)?;
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

    /// How far a bar is looked at in pictures, as a delay and as a length: all of it; of an endless
    /// bar, as far as all others reach together, or as waves have come.
    pub(super) fn span_looked_at(
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

    /// The length of all bars that are not endless together; none where there are none.
    fn reach_of_endless(&self, to: &Rational) -> Result<Option<f64>, FieldError> {
        let mut sum = 0.0;
        for bar in self.bars.iter().filter(|bar| bar.extent == Extent::Finite) {
            sum += self.double(&self.span(bar, &self.network().scaled_time(to), None)?.1)?;
        }
        Ok((sum > 0.0).then_some(sum))
    }

    fn double(&self, value: &Root) -> Result<f64, FieldError> {
        Ok(self.numbers.enclose_root(value, BITS)?.to_double().0)
    }

    pub(super) fn double_of(&self, value: &Fraction) -> Result<f64, FieldError> {
        Ok(self.numbers.enclose(value, BITS)?.to_double().0)
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
        let second = scaled(&Rational::from_integer(1.into()));
        let inverse = self.numbers.enclose(&second, BITS)?;
        let inverse = inverse.reciprocal(BITS).map_err(EvaluateError::Ball)?;
        let seconds = |time: &Fraction| -> Result<f64, FieldError> {
            let ball = self.numbers.enclose(time, BITS)?;
            Ok(ball.multiply(&inverse, BITS).to_double().0)
        };
        let (first, last) = (&scaled(from) - span, scaled(to));
        let value = |at: &Fraction, order, side| -> Result<f64, FieldError> {
            // Late waves are small differences of large terms: the precision grows until nothing that is
            // seen is left open. Velocities are of the size of 1 in the scale of the scene.
            let fine = Magnitude::power_of_two(-FINE_BITS);
            let attempt = |bits| {
                let instant = Instant { at, side, is_drawn: true };
                let ball = self.waves.enclose(wave, order, instant, bits)?;
                if *ball.radius() > fine {
                    let best = Box::new(ball);
                    let error = EvaluateError::AccuracyNotReached { best, bits };
                    return Ok(Attempt::NotYet(error.into()));
                }
                let value = if ball.contains_zero() { 0.0 } else { ball.to_double().0 };
                Ok(Attempt::Done(value))
            };
            Precisions::doubling(BITS, MAX_BITS).raise(attempt).and_then(Attempt::done)
        };
        let mut ends = vec![first.clone()];
        let breaks = self.waves.breaks(wave, &first..=&last)?;
        ends.extend(breaks.into_iter().filter(|at| *at != first));
        ends.push(last.clone());
        ends.dedup();
        let window = seconds(&last)? - seconds(&first)?;
        let mut found: Vec<Strip> = Vec::new();
        for pair in ends.windows(2) {
            let (start, end) = (seconds(&pair[0])?, seconds(&pair[1])?);
            let length = &pair[1] - &pair[0];
            let at = |share: &Rational| &pair[0] + &length.scale(share);
            let [low, middle, high] = [(0, 1), (1, 2), (1, 1)].map(|(a, b): (i32, i32)| {
                let side = if a == b { Limit::Left } else { Limit::Right };
                value(&at(&Rational::new(a.into(), b.into())), Order::Value, side)
            });
            let (low, middle, high) = (low?, middle?, high?);
            let size = low.abs().max(middle.abs()).max(high.abs());
            let flat = (low - middle).abs().max((high - middle).abs()) <= VISIBLE * size;
            let parts = match flat {
                true => 1,
                false => ((end - start) / window * strips as f64).ceil().max(1.0) as usize,
            };
            for part in 0..parts {
                let share = |twice: usize| Rational::new(twice.into(), (2 * parts).into());
                let place = |i: usize| start + (end - start) * i as f64 / parts as f64;
                let value = match flat {
                    true => middle,
                    false => value(&at(&share(2 * part + 1)), Order::Value, Limit::Right)?,
                };
                let joined = found.last_mut().filter(|last| last.value == value && flat);
                match joined {
                    Some(last) => last.to = end,
                    None => {
                        found.push(Strip { from: place(part), to: place(part + 1), value });
                    }
                }
            }
        }
        let scale = found.iter().map(|strip| strip.value.abs()).fold(0.0, f64::max);
        let mut fronts = Vec::new();
        for at in &ends[..ends.len() - 1] {
            let jump = |order| -> Result<f64, FieldError> {
                let (after, before) =
                    (value(at, order, Limit::Right)?, value(at, order, Limit::Left)?);
                Ok((after - before).abs())
            };
            if jump(Order::Value)? > VISIBLE * scale {
                fronts.push(Front { at: seconds(at)?, jumps: true });
            } else if jump(Order::Slope)? > VISIBLE * scale {
                fronts.push(Front { at: seconds(at)?, jumps: false });
            }
        }
        Ok((found, fronts))
    }
}
