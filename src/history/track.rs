//! A function of time, cell by cell.

use crate::ball::{Magnitude, Number};
use crate::enclosure::EnclosureError;
use crate::expression::Fraction;
use crate::history::cells::Cells;
use crate::history::energy::{Integrand, Wave};
use crate::history::error::Outcome;
use crate::history::moment::{Clock, Moment};
use crate::history::series::{Series, Truncation};
use crate::signal::Limit;
use std::cmp::Ordering;

/// A function of time from its first cell to its end.
///
/// # Invariants
/// There is a cell before the start. Cells follow each other without gaps; the last one reaches to `end`.
pub struct Track {
    pub cells: Cells<Wave>,
    pub end: Moment,
    /// The first cell, which is never forgotten.
    first: (Moment, Wave),
    /// `∫ f dt` over the cells that are forgotten, where it is asked for.
    passed: Option<Number>,
}

impl Track {
    /// What is constant for a time before the start.
    pub fn new(value: Number, time: &Fraction, clock: &Clock) -> Result<Track, EnclosureError> {
        let start = Moment::at(-time);
        let end = Moment::at(Fraction::zero());
        let length = clock.number(time)?;
        let wave = || Wave::new(Series::constant(value.clone()), length.clone());
        let first = (start.clone(), wave());
        let mut cells = Cells::default();
        cells.push(start, wave());
        Ok(Track { cells, end, first, passed: Some(Number::zero()) })
    }

    /// What it was before the start.
    pub fn before(&self) -> &Series {
        self.first.1.series()
    }

    /// Goes on with a cell until an instant, which is `length` after its start.
    pub fn push(&mut self, series: Series, end: Moment, length: Number) {
        let start = std::mem::replace(&mut self.end, end);
        self.cells.push(start, Wave::new(series, length));
    }

    /// The last cell, with its start.
    pub fn last(&self) -> &(Moment, Wave) {
        self.cells.get(self.cells.count() - 1)
    }

    /// Goes on with the last cell, by a series in place of its own if one is given; gives how many bytes its own held.
    pub fn lengthen(&mut self, series: Option<Series>, end: Moment, length: Number) -> u64 {
        self.end = end;
        self.cells.change_last(|last| {
            let bytes = last.series().bytes();
            let series = series.unwrap_or_else(|| last.take_series());
            *last = Wave::new(series, length);
            bytes
        })
    }

    /// From now on forgets the integrals of what is forgotten.
    pub fn forget_integral(&mut self) {
        self.passed = None;
    }

    /// Forgets cells whose end has passed, but none from the n-th on; gives how many bytes they held.
    pub fn forget(
        &mut self,
        number: usize,
        has_passed: impl Fn(&Moment) -> bool,
        cut: &Truncation,
    ) -> u64 {
        let mut bytes = 0;
        while self.cells.forgotten() < number
            && let Some(wave) = self.cells.forget(&has_passed)
        {
            if let Some(passed) = &mut self.passed {
                *passed = passed.add(wave.whole(Integrand::Wave, cut), cut.bits);
            }
            bytes += wave.series().bytes();
        }
        bytes
    }

    /// Where the n-th cell ends.
    pub fn end_of(&self, number: usize) -> &Moment {
        self.cells.end_of(number, &self.end)
    }

    /// The cell that an instant is in; where cells meet, the limit tells which.
    pub fn cell(&self, clock: &Clock, moment: &Moment, limit: Limit) -> Outcome<usize> {
        self.cells.find(clock, (moment, limit), &self.end)
    }

    /// The value at an instant.
    pub fn value(
        &self,
        clock: &Clock,
        moment: &Moment,
        limit: Limit,
        cut: &Truncation,
    ) -> Outcome<Number> {
        let (start, wave) = self.cells.get(self.cell(clock, moment, limit)?);
        Ok(wave.series().value(&clock.since(start, moment)?, cut))
    }

    /// `∫ f dt` or `∫ f² dt` from one instant to another, both within the track: the whole of all cells that
    /// end before the last one, up to the end in that one, and less what the first one holds before the
    /// start. Of `∫ f dt` since the start or before the whole of what is forgotten is known.
    pub fn integral(
        &self,
        integrand: Integrand,
        clock: &Clock,
        [from, to]: [&Moment; 2],
        cut: &Truncation,
    ) -> Outcome<Number> {
        if clock.compare(from, to)? != Ordering::Less {
            return Ok(Number::zero());
        }
        let until = |(start, wave): &(Moment, Wave), moment: &Moment| -> Outcome<_> {
            Ok(wave.until(integrand, &clock.since(start, moment)?, cut))
        };
        let forgotten = self.cells.forgotten();
        let passed = self.passed.as_ref();
        let passed = passed.filter(|_| integrand == Integrand::Wave && forgotten > 0);
        let start = Moment::at(Fraction::zero());
        let (mut sum, first, begun) = match passed {
            Some(passed) if clock.compare(from, &start)? != Ordering::Greater => {
                (passed.clone(), forgotten, &self.first)
            }
            _ => {
                let first = self.cell(clock, from, Limit::Right)?;
                (Number::zero(), first, self.cells.get(first))
            }
        };
        let last = self.cell(clock, to, Limit::Left)?;
        for number in first..last {
            sum = sum.add(self.cells.get(number).1.whole(integrand, cut), cut.bits);
        }
        sum = sum.add(&until(self.cells.get(last), to)?, cut.bits);
        Ok(sum.subtract(&until(begun, from)?, cut.bits))
    }
}

/// The arriving wave of a node's side.
pub enum Arriving {
    /// Nothing arrives: there is no bar.
    Nothing,
    /// Always the same: from the far end of an endless bar.
    Constant(Number),
    /// What left the other end of a bar a travel time before.
    Delayed {
        bar: usize,
        /// 0 to the right, 1 to the left.
        direction: usize,
        travel: Fraction,
        /// The cell that arrives now.
        cell: usize,
    },
}

impl Arriving {
    /// The series of what arrives, on a cell that begins at an instant.
    pub fn series(
        &self,
        waves: &[[Track; 2]],
        now: &Moment,
        clock: &Clock,
        cut: &Truncation,
    ) -> Result<Series, EnclosureError> {
        match self {
            Arriving::Nothing => Ok(Series::zero()),
            Arriving::Constant(value) => Ok(Series::constant(value.clone())),
            Arriving::Delayed { bar, direction, travel, cell } => {
                let (start, wave) = waves[*bar][*direction].cells.get(*cell);
                Ok(wave.series().shift(&clock.since(&start.after(travel), now)?, cut))
            }
        }
    }

    /// The number of the cell that arrives now, where one arrives after the other.
    pub fn cell(&self) -> Option<usize> {
        match self {
            Arriving::Delayed { cell, .. } => Some(*cell),
            _ => None,
        }
    }

    /// A bound of the errors of its values.
    pub fn error(&self, waves: &[[Track; 2]]) -> Magnitude {
        match self {
            Arriving::Delayed { bar, direction, cell, .. } => {
                waves[*bar][*direction].cells.get(*cell).1.series().error
            }
            _ => Magnitude::ZERO,
        }
    }

    /// Until when that series holds.
    pub fn end(&self, waves: &[[Track; 2]]) -> Option<Moment> {
        match self {
            Arriving::Delayed { bar, direction, travel, cell } => {
                Some(waves[*bar][*direction].end_of(*cell).after(travel))
            }
            _ => None,
        }
    }
}
