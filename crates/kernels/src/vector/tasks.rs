//! The evaluation of many points, or of one, as tasks for whatever vectors there are.

use super::blocks::Job;
use super::horner::{Broadcast, Evaluate};
use super::points::Points;
use super::{Simd, Task};
use crate::table::Table;

/// Many points, as many as `out` has places. The output is the indices of those in doubt.
pub(crate) struct Many<'a, P, E> {
    pub(crate) table: &'a Table,
    pub(crate) points: P,
    pub(crate) evaluate: E,
    /// Whether neighbouring points are expected in one piece.
    pub(crate) sorted: bool,
    pub(crate) out: &'a mut [f64],
}

impl<P: Points, E: Evaluate> Task for Many<'_, P, E> {
    type Output = Vec<usize>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Vec<usize> {
        let Self { table, points, evaluate, sorted, out } = self;
        let job = Job { simd, table, points, evaluate, sorted };
        let mut undecided = Vec::new();
        match if S::MANY_REGISTERS { E::MANY_IN_FLIGHT } else { E::FEW_IN_FLIGHT } {
            8.. => job.run::<8>(out, &mut undecided),
            6.. => job.run::<6>(out, &mut undecided),
            4.. => job.run::<4>(out, &mut undecided),
            _ => job.run::<2>(out, &mut undecided),
        }
        undecided
    }
}

/// One point. The output is the value and whether it is in doubt.
pub(crate) struct Single<'a, E> {
    pub(crate) table: &'a Table,
    pub(crate) time: f64,
    pub(crate) evaluate: E,
}

impl<E: Evaluate> Task for Single<'_, E> {
    type Output = (f64, bool);

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> (f64, bool) {
        let Self { table, time, evaluate } = self;
        let times = simd.splat(time);
        if !simd.all(table.lookup.within(simd, times)) {
            return (f64::NAN, false);
        }
        let mut lanes = [0.0; 8];
        simd.store(table.lookup.pieces(simd, times), &mut lanes);
        let rows = Broadcast::new(E::rows(table), lanes[0] as usize);
        let ([value], [doubt]) = evaluate.evaluate(simd, table, rows, &[times]);
        simd.store(value, &mut lanes);
        (lanes[0], doubt & 1 != 0)
    }
}
