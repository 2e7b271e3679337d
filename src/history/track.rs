//! A function of time, cell by cell.

use crate::ball::{Magnitude, Number};
use crate::enclosure::EnclosureError;
use crate::expression::Fraction;
use crate::history::energy::{Integrand, Wave};
use crate::history::error::HistoryError;
use crate::history::moment::{Clock, Moment};
use crate::history::series::{Series, Truncation};
use crate::signal::Limit;
use std::cmp::Ordering;

/// A function of time from its first cell to its end.
///
/// # Invariants
/// There is a cell before the start. Cells follow each other without gaps; the last one reaches to `end`.
pub struct Track {
    pub cells: Vec<(Moment, Wave)>,
    pub end: Moment,
}

impl Track {
    /// What is constant for a time before the start.
    ///
    /// # Errors
    /// As [`Clock::number`].
    pub fn new(value: Number, time: &Fraction, clock: &Clock) -> Result<Track, EnclosureError> {
        let start = Moment::at(-time);
        let end = Moment::at(Fraction::zero());
        let wave = Wave::new(Series::constant(value), clock.number(time)?);
        Ok(Track { cells: vec![(start, wave)], end })
    }

    /// What it was before the start.
    pub fn before(&self) -> &Series {
        self.cells[0].1.series()
    }

    /// Goes on with a cell until an instant, which is `length` after its start.
    pub fn push(&mut self, series: Series, end: Moment, length: Number) {
        let start = std::mem::replace(&mut self.end, end);
        self.cells.push((start, Wave::new(series, length)));
    }

    /// Where the n-th cell ends.
    pub fn end_of(&self, number: usize) -> &Moment {
        self.cells.get(number + 1).map_or(&self.end, |(start, _)| start)
    }

    /// The cell that an instant is in; where cells meet, the limit tells which.
    ///
    /// # Errors
    /// [`HistoryError::AfterLast`] after the end; as [`Clock::compare`].
    pub fn cell(
        &self,
        clock: &Clock,
        moment: &Moment,
        limit: Limit,
    ) -> Result<usize, HistoryError> {
        let (mut low, mut high) = (0, self.cells.len());
        // The first cell that ends behind the instant.
        while low < high {
            let middle = low.midpoint(high);
            let is_behind = match clock.compare(self.end_of(middle), moment)? {
                Ordering::Less => false,
                Ordering::Equal => limit == Limit::Left,
                Ordering::Greater => true,
            };
            if is_behind { high = middle } else { low = middle + 1 }
        }
        if low == self.cells.len() {
            return Err(HistoryError::AfterLast);
        }
        Ok(low)
    }

    /// The value at an instant.
    ///
    /// # Errors
    /// As [`Track::cell`].
    pub fn value(
        &self,
        clock: &Clock,
        moment: &Moment,
        limit: Limit,
        cut: &Truncation,
    ) -> Result<Number, HistoryError> {
        let (start, wave) = &self.cells[self.cell(clock, moment, limit)?];
        Ok(wave.series().value(&clock.since(start, moment)?, cut))
    }

    /// `∫ f dt` or `∫ f² dt` from one instant to another, both within the track: the whole of all cells that
    /// end before the last one, up to the end in that one, and less what the first one holds before the
    /// start.
    ///
    /// # Errors
    /// As [`Track::cell`].
    pub fn integral(
        &self,
        integrand: Integrand,
        clock: &Clock,
        [from, to]: [&Moment; 2],
        cut: &Truncation,
    ) -> Result<Number, HistoryError> {
        let mut sum = Number::zero();
        if clock.compare(from, to)? != Ordering::Less {
            return Ok(sum);
        }
        let first = self.cell(clock, from, Limit::Right)?;
        let last = self.cell(clock, to, Limit::Left)?;
        let until = |number: usize, moment: &Moment| -> Result<Number, HistoryError> {
            let (start, wave) = &self.cells[number];
            Ok(wave.until(integrand, &clock.since(start, moment)?, cut))
        };
        for (_, wave) in &self.cells[first..last] {
            sum = sum.add(wave.whole(integrand, cut), cut.bits);
        }
        sum = sum.add(&until(last, to)?, cut.bits);
        Ok(sum.subtract(&until(first, from)?, cut.bits))
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
    ///
    /// # Errors
    /// As [`Clock::since`].
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
                let (start, wave) = &waves[*bar][*direction].cells[*cell];
                Ok(wave.series().shift(&clock.since(&start.after(travel), now)?, cut))
            }
        }
    }

    /// A bound of the errors of its values.
    pub fn error(&self, waves: &[[Track; 2]]) -> Magnitude {
        match self {
            Arriving::Delayed { bar, direction, cell, .. } => {
                waves[*bar][*direction].cells[*cell].1.series().error
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
