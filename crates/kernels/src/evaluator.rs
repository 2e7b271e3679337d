//! Evaluation of a table at given times.

use crate::vector::{Certified, Evaluate, Many, Neighbours, Plain, Simd, Stores, Task, dispatch};
use crate::{Level, Table};

/// Evaluates a table with chosen instructions.
///
/// The table's function is continuous from the right. Outside the table and at NaN, values are NaN.
/// A value is the same double whether it is computed alone or among others; it is the same at the
/// levels above [`Level::Baseline`]. A level that the machine lacks is replaced by the best one below it.
///
/// The methods beginning with `rounded` return the double nearest to the exact value `f(t)`, by pairs
/// of doubles and a proven bound, see [`Table::certified_bound`]. Where the bound does not tell to
/// which of two doubles the value rounds, as close to zeros, they return the index of the time,
/// ascending, and leave a double next to the value. Times outside the table are not reported.
#[derive(Clone, Copy, Debug)]
pub struct Evaluator<'a> {
    table: &'a Table,
    level: Level,
    /// Of how many values those that are asked for are a part.
    whole: usize,
}

impl<'a> Evaluator<'a> {
    /// At the best level of this machine.
    pub fn new(table: &'a Table) -> Self {
        Self { table, level: Level::best(), whole: 0 }
    }

    /// The same with other instructions.
    pub fn with_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// The same for parts of so many values, which are written as all of them would be.
    pub fn in_parts_of(self, whole: usize) -> Self {
        Self { whole, ..self }
    }

    /// `out[i] = f(times[i])`, fast where neighbouring times mostly lie in one piece, in any order.
    pub fn sorted(self, times: &[f64], out: &mut [f64]) {
        self.many(times, Neighbours::Together, Plain, out);
    }

    /// `out[i] = f(times[i])` for times in no order.
    pub fn unsorted(self, times: &[f64], out: &mut [f64]) {
        self.many(times, Neighbours::Apart, Plain, out);
    }

    /// Like [`sorted`](Self::sorted), rounded correctly; gives the indices that are not decided.
    pub fn rounded_sorted(self, times: &[f64], out: &mut [f64]) -> Vec<usize> {
        self.many(times, Neighbours::Together, Certified, out)
    }

    /// Like [`unsorted`](Self::unsorted), rounded correctly; gives the indices that are not decided.
    pub fn rounded_unsorted(self, times: &[f64], out: &mut [f64]) -> Vec<usize> {
        self.many(times, Neighbours::Apart, Certified, out)
    }

    fn many(
        self,
        times: &[f64],
        neighbours: Neighbours,
        evaluate: impl Evaluate,
        out: &mut [f64],
    ) -> Vec<usize> {
        assert_eq!(times.len(), out.len(), "there is one place for every time");
        let stores = Stores::of(out.len().max(self.whole));
        dispatch(self.level, Many { table: self.table, times, evaluate, neighbours, stores, out })
    }
}

/// Whether all times are numbers, and none is earlier than the one before.
pub fn ascend(times: &[f64]) -> bool {
    dispatch(Level::best(), Ascending(times))
}

struct Ascending<'a>(&'a [f64]);

impl Task for Ascending<'_> {
    type Output = bool;

    /// Every pair is looked at, so that many are compared at once.
    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> bool {
        let Ascending(times) = self;
        let Some((first, later)) = times.split_first() else { return true };
        let pairs = times.iter().zip(later);
        pairs.fold(!first.is_nan(), |so_far, (one, next)| so_far & (one <= next))
    }
}
