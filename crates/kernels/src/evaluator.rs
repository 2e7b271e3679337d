//! Evaluation of a table on a grid, or at given points.

use crate::vector::{Certified, Evaluate, Grid, Many, Neighbours, Plain, Points, Times, dispatch};
use crate::{Level, Table};

/// Evaluates a table with chosen instructions.
///
/// The table's function is continuous from the right. Outside the table and at NaN, values are NaN.
/// A value is the same double whether it is computed alone, on a grid, or among others; it is the same
/// at the levels above [`Level::Baseline`]. A level that the machine lacks is replaced by the best one
/// below it.
///
/// The methods beginning with `rounded` return the double nearest to the exact value `f(t)`, by pairs
/// of doubles and a proven bound, see [`Table::certified_bound`]. Where the bound does not tell to
/// which of two doubles the value rounds, as close to zeros, they return the index of the point, and
/// leave a double next to the value. Points outside the table are not reported.
#[derive(Clone, Copy, Debug)]
pub struct Evaluator<'a> {
    table: &'a Table,
    level: Level,
}

impl<'a> Evaluator<'a> {
    /// At the best level of this machine.
    pub fn new(table: &'a Table) -> Self {
        Self { table, level: Level::best() }
    }

    /// The same with other instructions.
    pub fn with_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// `out[i] = f(t_i)`, `t_i = from + i · step` rounded once, on every machine.
    ///
    /// Fast for steps that are not negative and small against the pieces; large outputs are written
    /// past the caches. O(points · degree).
    pub fn grid(self, from: f64, step: f64, out: &mut [f64]) {
        self.on_grid(from, step, Plain, out);
    }

    /// `out[i] = f(times[i])`, fast where neighbouring times mostly lie in one piece.
    ///
    /// Any order is allowed. O(points · degree).
    pub fn sorted(self, times: &[f64], out: &mut [f64]) {
        self.at_times(times, Neighbours::Together, Plain, out);
    }

    /// `out[i] = f(times[i])` for times in no order. O(points · degree).
    pub fn unsorted(self, times: &[f64], out: &mut [f64]) {
        self.at_times(times, Neighbours::Apart, Plain, out);
    }

    /// Like [`grid`](Self::grid), rounded correctly. Returns the indices that are not decided,
    /// ascending.
    pub fn rounded_grid(self, from: f64, step: f64, out: &mut [f64]) -> Vec<usize> {
        self.on_grid(from, step, Certified, out)
    }

    /// Like [`sorted`](Self::sorted), rounded correctly. Returns the indices that are not decided,
    /// ascending.
    pub fn rounded_sorted(self, times: &[f64], out: &mut [f64]) -> Vec<usize> {
        self.at_times(times, Neighbours::Together, Certified, out)
    }

    /// Like [`unsorted`](Self::unsorted), rounded correctly. Returns the indices that are not decided,
    /// ascending.
    pub fn rounded_unsorted(self, times: &[f64], out: &mut [f64]) -> Vec<usize> {
        self.at_times(times, Neighbours::Apart, Certified, out)
    }

    fn on_grid<E: Evaluate>(self, from: f64, step: f64, how: E, out: &mut [f64]) -> Vec<usize> {
        self.many(Grid::new(from, step, out.len()), Neighbours::Together, how, out)
    }

    fn at_times<E: Evaluate>(
        self,
        times: &[f64],
        neighbours: Neighbours,
        how: E,
        out: &mut [f64],
    ) -> Vec<usize> {
        assert_eq!(times.len(), out.len(), "there is one place for every time");
        self.many(Times(times), neighbours, how, out)
    }

    fn many<P: Points, E: Evaluate>(
        self,
        points: P,
        neighbours: Neighbours,
        evaluate: E,
        out: &mut [f64],
    ) -> Vec<usize> {
        dispatch(self.level, Many { table: self.table, points, evaluate, neighbours, out })
    }
}
