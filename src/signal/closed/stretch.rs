//! Stretches between arrivals, on each of which a signal is one exponential polynomial.

use super::form::{ClosedForm, MAX_STRETCHES};
use crate::expression::Fraction;
use crate::limits::MAX_ECHOES;
use crate::signal::error::{EvaluateError, Outcome};
use std::cmp::Ordering;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// A part of a signal: a piece of a wave, or an echo.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Which of the waves that are seen.
    pub(super) seen: usize,
    /// The period, or the number of the echo.
    pub(super) number: usize,
    /// When it began, in the scale of the waves.
    pub(super) origin: Fraction,
}

/// A time between arrivals, on which a signal is one exponential polynomial.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    /// Its first time, in the scale of the waves.
    pub(super) from: Fraction,
    /// Its end: the next arrival, or the end of the window.
    pub(super) to: Fraction,
    /// On a lattice those of all stretches, in the order in which they arrive; on a grid its own.
    parts: Rc<[Part]>,
    /// How many of them have arrived.
    count: usize,
    /// Whether time has begun.
    pub(super) begun: bool,
}

/// An arrival: which of the waves seen, the number of the piece or echo, and when.
type Break = (Option<usize>, usize, Fraction);

impl ClosedForm {
    /// The arrivals after `from`, up to `to`, ascending, and those that are there at `from`.
    fn breaks(&self, from: &Fraction, to: &Fraction) -> Outcome<(Vec<Break>, Vec<Break>)> {
        let mut before = Vec::new();
        let mut after = Vec::new();
        let mut place = |found: Break| -> Outcome<bool> {
            if self.numbers.compare(&found.2, to)? == Ordering::Greater {
                return Ok(false);
            }
            match self.numbers.compare(&found.2, from)? {
                Ordering::Greater => after.push(found),
                _ => before.push(found),
            }
            Ok(true)
        };
        place((None, 0, Fraction::zero()))?;
        let period = &self.recurrence.statement().period;
        for (seen, wave) in self.observation.waves.iter().enumerate() {
            match &self.lattice {
                None => {
                    // The last piece that is there at `from` is the only one that still counts.
                    let first = self.last_piece(wave, from, MAX_ECHOES)?.saturating_sub(1);
                    let numbers: &mut dyn Iterator<Item = usize> = match self.arrivals(wave.wave) {
                        None => &mut (first..),
                        Some(all) => {
                            let begun = all.range(..=first).next_back().copied().unwrap_or(0);
                            &mut all.range(begun..).copied()
                        }
                    };
                    for n in numbers {
                        let delay = period.scale(&Rational::from_integer(n.into()));
                        if !place((Some(seen), n, &delay + &wave.delay))? {
                            break;
                        }
                        if n > MAX_ECHOES {
                            let (echoes, limit) = (n as u128, MAX_ECHOES);
                            return Err(EvaluateError::TooManyEchoes { echoes, limit });
                        }
                    }
                }
                Some(lattice) => {
                    let is_left_out = |number: usize| {
                        self.kept.as_ref().is_some_and(|kept| !kept.demand.wants(wave.wave, number))
                    };
                    for (number, delay) in &lattice.arrivals {
                        if is_left_out(*number) {
                            continue;
                        }
                        place((Some(seen), *number, delay + &wave.delay))?;
                    }
                }
            }
        }
        if after.len() > MAX_STRETCHES {
            let (echoes, limit) = (after.len() as u128, MAX_STRETCHES);
            return Err(EvaluateError::TooManyEchoes { echoes, limit });
        }
        Ok((before, self.numbers.sorted(after, |found| &found.2)?))
    }

    /// The stretches of a window in the user's time, in order.
    pub(super) fn stretches(&self, from: &Rational, to: &Rational) -> Outcome<Vec<Stretch>> {
        let (from, to) = (self.slowness.scale(from), self.slowness.scale(to));
        if let Some(lattice) = &self.lattice
            && self.numbers.compare(&to, &lattice.last)? == Ordering::Greater
        {
            return Err(EvaluateError::AfterLast);
        }
        let (before, after) = self.breaks(&from, &to)?;
        let parts = match self.is_on_grid() {
            true => Rc::default(),
            false => before.iter().chain(&after).filter_map(part).collect(),
        };
        let mut now = Stretch { from, to: to.clone(), parts, count: 0, begun: false };
        before.iter().for_each(|found| self.arrive(&mut now, found));
        let mut stretches = Vec::new();
        for found in &after {
            if self.numbers.compare(&found.2, &now.from)? == Ordering::Greater {
                stretches.push(Stretch { to: found.2.clone(), ..now.clone() });
                now.from = found.2.clone();
            }
            self.arrive(&mut now, found);
        }
        stretches.push(now);
        Ok(stretches)
    }

    /// What has arrived is seen from now on: on a grid in place of the piece before it.
    fn arrive(&self, stretch: &mut Stretch, found: &Break) {
        let Some(part) = part(found) else {
            stretch.begun = true;
            return;
        };
        if !self.is_on_grid() {
            stretch.count += 1;
            return;
        }
        let mut parts = stretch.parts.to_vec();
        match parts.iter_mut().find(|known| known.seen == part.seen) {
            Some(known) => *known = part,
            None => parts.push(part),
        }
        stretch.count = parts.len();
        stretch.parts = parts.into();
    }
}

impl Stretch {
    /// Whether nothing is seen on it.
    pub(super) fn is_silent(&self) -> bool {
        self.has_no_waves() && !self.begun
    }

    /// What has arrived.
    pub(super) fn parts(&self) -> &[Part] {
        &self.parts[..self.count]
    }

    /// Whether no wave is seen on it.
    pub(super) fn has_no_waves(&self) -> bool {
        self.count == 0
    }
}

/// What is seen since an arrival; nothing of the start of time.
fn part((seen, number, origin): &Break) -> Option<Part> {
    Some(Part { seen: (*seen)?, number: *number, origin: origin.clone() })
}
