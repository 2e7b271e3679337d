//! Evaluation of a table at one point, on a grid, or at given points.

use crate::vector::{Certified, Evaluate, Grid, Many, Plain, Single, Times};
use crate::vector::{dispatch, dispatch_scalar};
use crate::{Level, Table};

/// Evaluates a table with chosen instructions on a chosen number of threads.
///
/// The table's function is continuous from the right. Outside the table and at NaN, values are NaN.
/// A value is the same double whether it is computed alone, on a grid, or among others, and whatever
/// the number of threads; it is the same at the levels above [`Level::Baseline`]. A level that the
/// machine lacks is replaced by the best one below it.
///
/// The methods beginning with `rounded` return the double nearest to the exact value `f(t)`, by pairs
/// of doubles and a proven bound, see [`Table::certified_bound`]. Where the bound does not tell to
/// which of two doubles the value rounds, as close to zeros, they return the index of the point, and
/// leave a double next to the value. Points outside the table are not reported.
#[derive(Clone, Copy, Debug)]
pub struct Evaluator<'a> {
    table: &'a Table,
    level: Level,
    threads: usize,
}

impl<'a> Evaluator<'a> {
    /// On one thread, at the best level of this machine.
    pub fn new(table: &'a Table) -> Self {
        Self { table, level: Level::best(), threads: 1 }
    }

    /// The same with other instructions.
    pub fn with_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// The same on a number of threads; 0 counts as 1. Each takes one run of neighbouring points.
    pub fn with_threads(self, threads: usize) -> Self {
        Self { threads: threads.max(1), ..self }
    }

    /// `f(t)` within [`Table::bound`]. O(degree + log pieces), O(degree) if the pieces have similar
    /// lengths.
    pub fn value(self, time: f64) -> f64 {
        dispatch_scalar(self.level, Single { table: self.table, time, evaluate: Plain }).0
    }

    /// The double nearest to `f(t)`, NaN outside the table, none if the bound does not decide it.
    ///
    /// O(degree), some five times the cost of [`value`](Self::value).
    pub fn rounded(self, time: f64) -> Option<f64> {
        let single = Single { table: self.table, time, evaluate: Certified };
        let (value, in_doubt) = dispatch_scalar(self.level, single);
        (!in_doubt).then_some(value)
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
    ///
    /// # Panics
    /// If the slices have different lengths.
    pub fn sorted(self, times: &[f64], out: &mut [f64]) {
        self.at_times(times, true, Plain, out);
    }

    /// `out[i] = f(times[i])` for times in no order. O(points · degree).
    ///
    /// # Panics
    /// If the slices have different lengths.
    pub fn unsorted(self, times: &[f64], out: &mut [f64]) {
        self.at_times(times, false, Plain, out);
    }

    /// Like [`grid`](Self::grid), rounded correctly. Returns the indices that are not decided,
    /// ascending.
    pub fn rounded_grid(self, from: f64, step: f64, out: &mut [f64]) -> Vec<usize> {
        self.on_grid(from, step, Certified, out)
    }

    /// Like [`sorted`](Self::sorted), rounded correctly. Returns the indices that are not decided,
    /// ascending.
    ///
    /// # Panics
    /// If the slices have different lengths.
    pub fn rounded_sorted(self, times: &[f64], out: &mut [f64]) -> Vec<usize> {
        self.at_times(times, true, Certified, out)
    }

    /// Like [`unsorted`](Self::unsorted), rounded correctly. Returns the indices that are not decided,
    /// ascending.
    ///
    /// # Panics
    /// If the slices have different lengths.
    pub fn rounded_unsorted(self, times: &[f64], out: &mut [f64]) -> Vec<usize> {
        self.at_times(times, false, Certified, out)
    }

    fn on_grid<E: Evaluate>(
        self,
        from: f64,
        step: f64,
        evaluate: E,
        out: &mut [f64],
    ) -> Vec<usize> {
        let table = self.table;
        self.in_parts(out, |first, out| {
            let points = Grid::new(from, step, first, out.len());
            dispatch(self.level, Many { table, points, evaluate, sorted: true, out })
        })
    }

    fn at_times<E: Evaluate>(
        self,
        times: &[f64],
        sorted: bool,
        evaluate: E,
        out: &mut [f64],
    ) -> Vec<usize> {
        assert_eq!(times.len(), out.len(), "there is one place for every time");
        let table = self.table;
        self.in_parts(out, |first, out| {
            let points = Times(&times[first..][..out.len()]);
            dispatch(self.level, Many { table, points, evaluate, sorted, out })
        })
    }

    /// Runs work on parts of the output, one a thread, each with the index of its first place. The
    /// indices that the parts return are made those of the whole.
    fn in_parts(
        self,
        out: &mut [f64],
        work: impl Fn(usize, &mut [f64]) -> Vec<usize> + Sync,
    ) -> Vec<usize> {
        if self.threads == 1 || out.len() < 2 {
            return work(0, out);
        }
        let size = out.len().div_ceil(self.threads);
        let mut undecided = Vec::new();
        std::thread::scope(|scope| {
            let work = &work;
            let part = |(i, part)| scope.spawn(move || (i * size, work(i * size, part)));
            let threads: Vec<_> = out.chunks_mut(size).enumerate().map(part).collect();
            for thread in threads {
                let (first, indices) =
                    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
                undecided.extend(indices.into_iter().map(|i| first + i));
            }
        });
        undecided
    }
}
