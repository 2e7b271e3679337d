//! Evaluation of a table at given times.

use crate::vector::{Certified, Evaluate, Found, Many, Plain, dispatch};
use crate::{Level, Table};

/// Evaluates a table with chosen instructions, at times in any order; fastest where neighbouring times mostly lie in one
/// piece.
///
/// The table's function is continuous from the right. Outside the table and at NaN, values are NaN.
/// A value is the same double whether it is computed alone or among others; it is the same at the
/// levels above [`Level::Baseline`]. A level that the machine lacks is replaced by the best one below it.
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

    /// `out[i] = f(times[i])`; whether all times lie in the table.
    pub fn values(self, times: &[f64], out: &mut [f64]) -> bool {
        !self.many(times, Plain, out).is_outside
    }

    /// The doubles nearest to the exact values `f(times[i])`, by pairs of doubles and a proven bound, see
    /// [`Table::certified_bound`].
    ///
    /// Where the bound does not tell to which of two doubles a value rounds, as close to zeros, a double next to the value
    /// is left, and the index of the time is returned; the indices ascend. Times outside the table are not reported.
    pub fn rounded(self, times: &[f64], out: &mut [f64]) -> Vec<usize> {
        self.many(times, Certified, out).undecided
    }

    fn many(self, times: &[f64], evaluate: impl Evaluate, out: &mut [f64]) -> Found {
        assert_eq!(times.len(), out.len(), "there is one place for every time");
        dispatch(self.level, Many { table: self.table, times, evaluate, out })
    }
}
