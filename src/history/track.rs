//! A signal over time, cell by cell.

use crate::enclosure::EnclosureError;
use crate::expression::Fraction;
use crate::history::error::HistoryError;
use crate::history::moment::{Clock, Moment};
use crate::history::number::Number;
use crate::history::series::{Series, Truncation};
use std::cmp::Ordering;

/// A function of time from its first cell to its end.
///
/// # Invariants
/// Cells follow each other without gaps; the last one reaches to `end`.
pub(crate) struct Track {
    pub cells: Vec<(Moment, Series)>,
    pub end: Moment,
}

/// Which limit is meant where a signal jumps.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Limit {
    Before,
    After,
}

impl Track {
    /// A signal that is constant for a time before the start.
    pub fn before(value: Number, time: &Fraction) -> Track {
        let start = Moment::at(-time);
        let end = Moment::at(Fraction::zero());
        Track { cells: vec![(start, Series::constant(value))], end }
    }

    /// Goes on with a cell until an instant.
    pub fn push(&mut self, series: Series, end: Moment) {
        let start = std::mem::replace(&mut self.end, end);
        self.cells.push((start, series));
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
                Ordering::Equal => limit == Limit::Before,
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
        let (start, series) = &self.cells[self.cell(clock, moment, limit)?];
        Ok(series.value(&clock.since(start, moment)?, cut))
    }

    /// `∫ g(f) dt` from one instant to another, both within the track; `part` gives it for a series up
    /// to a time.
    ///
    /// # Errors
    /// As [`Track::cell`].
    pub fn sum(
        &self,
        clock: &Clock,
        [from, to]: [&Moment; 2],
        cut: &Truncation,
        part: impl Fn(&Series, &Number) -> Number,
    ) -> Result<Number, HistoryError> {
        let mut sum = Number::zero();
        if clock.compare(from, to)? != Ordering::Less {
            return Ok(sum);
        }
        let first = self.cell(clock, from, Limit::After)?;
        let last = self.cell(clock, to, Limit::Before)?;
        for number in first..=last {
            let (start, series) = &self.cells[number];
            let begin = if number == first { from } else { start };
            let end = if number == last { to } else { self.end_of(number) };
            let shifted = series.shift(&clock.since(start, begin)?, cut);
            sum = sum.add(&part(&shifted, &clock.since(begin, end)?), cut.bits);
        }
        Ok(sum)
    }

    /// `∫ f² dt`.
    ///
    /// # Errors
    /// As [`Track::cell`].
    pub fn energy(
        &self,
        clock: &Clock,
        window: [&Moment; 2],
        cut: &Truncation,
    ) -> Result<Number, HistoryError> {
        self.sum(clock, window, cut, |series, time| series.energy(time, cut))
    }

    /// `∫ f dt`.
    ///
    /// # Errors
    /// As [`Track::cell`].
    pub fn integral(
        &self,
        clock: &Clock,
        window: [&Moment; 2],
        cut: &Truncation,
    ) -> Result<Number, HistoryError> {
        let part =
            |series: &Series, time: &Number| series.integral(Number::zero(), cut).value(time, cut);
        self.sum(clock, window, cut, part)
    }
}

/// The arriving wave of a node's side.
pub(crate) enum Arriving {
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
                let (start, series) = &waves[*bar][*direction].cells[*cell];
                Ok(series.shift(&clock.since(&start.after(travel), now)?, cut))
            }
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
