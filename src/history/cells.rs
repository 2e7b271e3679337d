//! What is known of something cell by cell, and kept no longer than it is asked for.

use crate::history::error::{HistoryError, Outcome};
use crate::history::moment::{Clock, Moment};
use crate::signal::Limit;
use std::cmp::Ordering;
use std::collections::VecDeque;

/// Cells, each with its start, by their numbers since the first one.
///
/// # Invariants
/// They follow each other without gaps, and the first ones of them may be forgotten; the last one never is.
pub struct Cells<T> {
    kept: VecDeque<(Moment, T)>,
    forgotten: usize,
}

impl<T> Default for Cells<T> {
    fn default() -> Cells<T> {
        Cells { kept: VecDeque::new(), forgotten: 0 }
    }
}

impl<T> Cells<T> {
    /// Goes on with a cell.
    pub fn push(&mut self, start: Moment, cell: T) {
        self.kept.push_back((start, cell));
    }

    /// Changes the last cell.
    ///
    /// # Panics
    /// Where there has been none.
    pub fn change_last<R>(&mut self, change: impl FnOnce(&mut T) -> R) -> R {
        let (_, last) = self.kept.back_mut().expect("the last cell is kept");
        change(last)
    }

    /// Whether there has been none yet.
    pub fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// How many there have been.
    pub fn count(&self) -> usize {
        self.forgotten + self.kept.len()
    }

    /// How many are kept.
    pub fn kept(&self) -> usize {
        self.kept.len()
    }

    /// How many are not kept.
    pub fn forgotten(&self) -> usize {
        self.forgotten
    }

    /// The n-th cell, with its start.
    ///
    /// # Panics
    /// Where it is forgotten.
    pub fn get(&self, number: usize) -> &(Moment, T) {
        let place = number.checked_sub(self.forgotten).expect("the cell is kept");
        &self.kept[place]
    }

    /// When the cells begin that are kept.
    pub fn starts(&self) -> impl Iterator<Item = &Moment> {
        self.kept.iter().map(|(start, _)| start)
    }

    /// Where the n-th cell ends; the last one reaches to `end`.
    pub fn end_of<'a>(&'a self, number: usize, end: &'a Moment) -> &'a Moment {
        self.kept.get(number + 1 - self.forgotten).map_or(end, |(start, _)| start)
    }

    /// The number of the cell that an instant is in; where cells meet, the limit tells which.
    ///
    /// # Errors
    /// [`HistoryError::AfterLast`] after the end, [`HistoryError::Forgotten`] before what is kept; as [`Clock::compare`].
    pub fn find(
        &self,
        clock: &Clock,
        (moment, limit): (&Moment, Limit),
        end: &Moment,
    ) -> Outcome<usize> {
        let (mut low, mut high) = (self.forgotten, self.count());
        // The first cell that ends behind the instant.
        while low < high {
            let middle = low.midpoint(high);
            let is_behind = match clock.compare(self.end_of(middle, end), moment)? {
                Ordering::Less => false,
                Ordering::Equal => limit == Limit::Left,
                Ordering::Greater => true,
            };
            if is_behind { high = middle } else { low = middle + 1 }
        }
        if low == self.count() {
            return Err(HistoryError::AfterLast);
        }
        if self.forgotten > 0 && low == self.forgotten {
            let begins = clock.compare(&self.get(low).0, moment)?;
            if begins == Ordering::Greater || begins == Ordering::Equal && limit == Limit::Left {
                return Err(HistoryError::Forgotten);
            }
        }
        Ok(low)
    }

    /// Forgets the first cell that is kept, where another follows and its end has passed.
    pub fn forget(&mut self, has_passed: impl Fn(&Moment) -> bool) -> Option<T> {
        let (next, _) = self.kept.get(1)?;
        if !has_passed(next) {
            return None;
        }
        self.forgotten += 1;
        self.kept.pop_front().map(|(_, cell)| cell)
    }
}
