//! The evaluation of many points, block by block.
//!
//! A block is several vectors, so that their dependent operations overlap. Where all its points lie
//! in one piece, that piece's coefficients are broadcast; where they lie in a few neighbouring pieces,
//! each of these is evaluated and the right lanes are taken; else every lane gathers its own
//! coefficients. All three perform the same operations on a point and give the same double.

use super::Simd;
use super::horner::{Broadcast, Gathered, Rows};
use super::points::Points;
use crate::table::Table;

/// Longer outputs are streamed past the caches: they are larger than a second-level cache.
const STREAMED: usize = 1 << 18;

/// Blocks that touch more pieces than this gather their coefficients.
const NEIGHBOURS: usize = 6;

/// A way to evaluate polynomials.
pub(crate) trait Evaluate: Copy + Sync {
    /// Vectors a block with 32 vector registers.
    const MANY_IN_FLIGHT: usize;
    /// Vectors a block with 16 vector registers.
    const FEW_IN_FLIGHT: usize;

    /// Values of the polynomials of the given rows, and one bit for every lane that is in doubt.
    fn evaluate<S: Simd, R: Rows<S>, const N: usize>(
        self,
        simd: S,
        table: &Table,
        rows: R,
        times: &[S::Values; N],
    ) -> ([S::Values; N], [u32; N]);
}

/// What is evaluated, and how.
pub(super) struct Job<'a, S, P, E> {
    pub(super) simd: S,
    pub(super) table: &'a Table,
    pub(super) points: P,
    pub(super) evaluate: E,
    /// Whether neighbouring points are expected in one piece.
    pub(super) sorted: bool,
}

impl<S: Simd, P: Points, E: Evaluate> Job<'_, S, P, E> {
    /// Every lane with its own piece; NaN, without doubt, outside the table.
    #[inline(always)]
    fn gathered(&self, times: S::Values) -> (S::Values, u32) {
        let (simd, lookup) = (self.simd, &self.table.lookup);
        let within = lookup.within(simd, times);
        let inner = simd.select(within, times, simd.splat(self.table.start()));
        let rows = Gathered::new(simd, self.table, lookup.pieces(simd, inner));
        let ([value], [doubt]) = self.evaluate.evaluate(simd, self.table, rows, &[inner]);
        (simd.select(within, value, simd.splat(f64::NAN)), doubt & simd.bits(within))
    }

    /// Whether all points of a block are at least `lower` and less than `upper`.
    #[inline(always)]
    fn inside<const N: usize>(&self, times: &[S::Values; N], (lower, upper): (f64, f64)) -> bool {
        let simd = self.simd;
        let (lower, upper) = (simd.splat(lower), simd.splat(upper));
        if self.points.ascend() {
            let from = simd.at_least(times[0], lower);
            return simd.all(from) && simd.all(simd.less(times[N - 1], upper));
        }
        let mut inside = simd.both(simd.at_least(times[0], lower), simd.less(times[0], upper));
        for &t in &times[1..] {
            let this = simd.both(simd.at_least(t, lower), simd.less(t, upper));
            inside = simd.both(inside, this);
        }
        simd.all(inside)
    }

    /// The pieces of the first and of the last point of a block, if all points lie in them and
    /// between, and they are few.
    #[inline(always)]
    fn neighbours<const N: usize>(&self, times: &[S::Values; N]) -> Option<(usize, usize)> {
        let (simd, lookup) = (self.simd, &self.table.lookup);
        let (mut first, mut last) = ([0.0; 8], [0.0; 8]);
        simd.store(lookup.pieces(simd, times[0]), &mut first);
        simd.store(lookup.pieces(simd, times[N - 1]), &mut last);
        // Outside the window a number of a piece means nothing, but is clamped, and `inside` refuses.
        let highest = self.table.pieces() - 1;
        let first = (first[0] as usize).min(highest);
        let last = (last[S::LANES - 1] as usize).min(highest);
        let few = first <= last && last - first < NEIGHBOURS;
        (few && self.inside(times, lookup.span(first, last))).then_some((first, last))
    }

    /// One block. `piece` is where the block before ended.
    #[inline(always)]
    fn block<const N: usize>(&self, at: usize, piece: &mut usize) -> ([S::Values; N], [u32; N]) {
        let (simd, table) = (self.simd, self.table);
        let mut times = [simd.splat(0.0); N];
        for (j, t) in times.iter_mut().enumerate() {
            *t = self.points.times(simd, at + j * S::LANES);
        }
        if self.sorted {
            if self.inside(&times, table.lookup.span(*piece, *piece)) {
                return self.evaluate.evaluate(simd, table, Broadcast::new(table, *piece), &times);
            }
            if let Some((first, last)) = self.neighbours(&times) {
                *piece = last;
                return self.merged(&times, first, last);
            }
        }
        let (mut values, mut doubts) = (times, [0; N]);
        for (value, doubt) in values.iter_mut().zip(&mut doubts) {
            (*value, *doubt) = self.gathered(*value);
        }
        (values, doubts)
    }

    /// A block whose points lie in a few neighbouring pieces.
    #[inline(always)]
    fn merged<const N: usize>(
        &self,
        times: &[S::Values; N],
        first: usize,
        last: usize,
    ) -> ([S::Values; N], [u32; N]) {
        let (simd, table) = (self.simd, self.table);
        let (mut values, mut doubts) = ([simd.splat(0.0); N], [0; N]);
        for piece in first..=last {
            let start = simd.splat(table.lookup.span(piece, piece).0);
            let rows = Broadcast::new(table, piece);
            let (new, new_doubts) = self.evaluate.evaluate(simd, table, rows, times);
            for j in 0..N {
                let from = simd.at_least(times[j], start);
                let bits = simd.bits(from);
                values[j] = simd.select(from, new[j], values[j]);
                doubts[j] = (new_doubts[j] & bits) | (doubts[j] & !bits);
            }
        }
        (values, doubts)
    }

    /// Fewer points than a block, from index `at` on.
    #[inline(always)]
    pub(super) fn partial(&self, at: usize, out: &mut [f64], undecided: &mut Vec<usize>) {
        for (i, chunk) in out.chunks_mut(S::LANES).enumerate() {
            let at = at + i * S::LANES;
            let (values, doubt) = self.gathered(self.points.times_padded(self.simd, at));
            let mut lanes = [0.0; 8];
            self.simd.store(values, &mut lanes);
            chunk.copy_from_slice(&lanes[..chunk.len()]);
            collect(at, doubt & ((1 << chunk.len()) - 1), undecided);
        }
    }

    /// All points, `out.len()` of them; the indices of those in doubt are appended, ascending.
    #[inline(always)]
    pub(super) fn run<const N: usize>(&self, out: &mut [f64], undecided: &mut Vec<usize>) {
        let simd = self.simd;
        let streamed = out.len() >= STREAMED;
        let vector = size_of::<S::Values>();
        let misaligned = out.as_ptr().addr() % vector;
        let head = if streamed && misaligned != 0 { (vector - misaligned) / 8 } else { 0 };
        let (head, body) = out.split_at_mut(head);
        self.partial(0, head, undecided);
        let (mut at, mut piece) = (head.len(), 0);
        let mut blocks = body.chunks_exact_mut(N * S::LANES);
        for block in &mut blocks {
            let (values, doubts) = self.block::<N>(at, &mut piece);
            for (chunk, &value) in block.chunks_exact_mut(S::LANES).zip(&values) {
                if streamed { simd.stream(value, chunk) } else { simd.store(value, chunk) }
            }
            for (j, &doubt) in doubts.iter().enumerate() {
                collect(at + j * S::LANES, doubt, undecided);
            }
            at += N * S::LANES;
        }
        self.partial(at, blocks.into_remainder(), undecided);
        if streamed {
            simd.fence();
        }
    }
}

/// Appends the indices of the lanes whose bits are set.
#[inline(always)]
fn collect(at: usize, mut lanes: u32, undecided: &mut Vec<usize>) {
    while lanes != 0 {
        undecided.push(at + lanes.trailing_zeros() as usize);
        lanes &= lanes - 1;
    }
}
