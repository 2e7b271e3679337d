//! The evaluation of many points, block by block.
//!
//! A block is several vectors, so that their dependent operations overlap. Where all its points lie
//! in one piece, that piece's coefficients are broadcast; where they lie in two neighbours, each lane
//! takes the coefficients of one of them; where they lie in a few neighbouring pieces, each of these is
//! evaluated and the right lanes are taken; else every lane gathers its own coefficients. All of these
//! perform the same operations on a point and give the same double.

use super::horner::{Blended, Broadcast, Evaluate, Transposed};
use super::{Simd, Task};
use crate::table::Table;

/// Longer outputs are streamed past the caches: they are larger than a second-level cache.
const STREAMED: usize = 1 << 18;

/// How values are written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stores {
    Cached,
    Streamed,
}

/// Blocks that touch more pieces than this gather their coefficients.
const NEIGHBOURS: usize = 6;

/// After as many blocks in a row that gather, only every eighth looks for neighbours first.
const TRIES: u32 = 2;

/// What is found of many points beside their values.
#[derive(Default)]
pub(crate) struct Found {
    /// The indices of points in doubt, ascending.
    pub(crate) undecided: Vec<usize>,
    /// Whether a point lies outside the table.
    pub(crate) is_outside: bool,
}

/// The evaluation of many points, as many as `out` has places.
pub(crate) struct Many<'a, E> {
    pub(crate) table: &'a Table,
    pub(crate) times: &'a [f64],
    pub(crate) evaluate: E,
    pub(crate) out: &'a mut [f64],
}

impl<E: Evaluate> Task for Many<'_, E> {
    type Output = Found;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Found {
        let Self { table, times, evaluate, out } = self;
        let job = Job { simd, table, times, evaluate };
        match if S::MANY_REGISTERS { E::MANY_IN_FLIGHT } else { E::FEW_IN_FLIGHT } {
            8.. => job.run::<8>(out),
            6.. => job.run::<6>(out),
            4.. => job.run::<4>(out),
            _ => job.run::<2>(out),
        }
    }
}

/// What is evaluated, and how.
struct Job<'a, S, E> {
    simd: S,
    table: &'a Table,
    times: &'a [f64],
    evaluate: E,
}

/// Where the block before ended.
#[derive(Default)]
struct Trail {
    piece: usize,
    /// How many blocks in a row gathered.
    gathered: u32,
}

impl Trail {
    /// Whether neighbours are worth looking for: points in no order have none.
    #[inline(always)]
    fn tries(&self) -> bool {
        self.gathered < TRIES || self.gathered.is_multiple_of(8)
    }
}

impl<S: Simd, E: Evaluate> Job<'_, S, E> {
    /// The times from index `at` on, all of which exist.
    #[inline(always)]
    fn times<const N: usize>(&self, at: usize) -> [S::Values; N] {
        let times = &self.times[at..][..N * S::LANES];
        let mut vectors = [self.simd.splat(0.0); N];
        for j in 0..N {
            vectors[j] = self.simd.load(&times[j * S::LANES..]);
        }
        vectors
    }

    /// Every lane with its own piece; NaN, without doubt, outside the table; and one bit for every lane that lies
    /// there. The pieces of all vectors
    /// are looked up first, so that one search need not wait for another, and then all of them are
    /// evaluated together, so that one step need not wait for the step before.
    #[inline(always)]
    fn gathered<const N: usize>(
        &self,
        times: &[S::Values; N],
        room: &mut [S::Values],
    ) -> ([S::Values; N], [u32; N], [u32; N]) {
        let (simd, table, rows) = (self.simd, self.table, E::rows(self.table));
        let start = simd.splat(table.start());
        let stride = simd.splat(rows.stride() as f64);
        let mut inner = *times;
        let mut offsets = [simd.offsets(start, 1); N];
        for j in 0..N {
            inner[j] = simd.select(table.lookup.within(simd, times[j]), times[j], start);
            let first = simd.multiply(table.lookup.pieces(simd, inner[j]), stride);
            offsets[j] = simd.offsets(first, rows.values().len() + 1 - rows.stride());
        }
        let columns = Transposed::new(simd, rows, &offsets, room);
        let (mut values, mut doubts) = self.evaluate.evaluate(simd, table, columns, &inner);
        let mut outside = [(1 << S::LANES) - 1; N];
        for j in 0..N {
            let within = table.lookup.within(simd, times[j]);
            values[j] = simd.select(within, values[j], simd.splat(f64::NAN));
            doubts[j] &= simd.bits(within);
            outside[j] ^= simd.bits(within);
        }
        (values, doubts, outside)
    }

    /// Room for the columns of so many vectors.
    #[inline(always)]
    fn room(&self, vectors: usize) -> Vec<S::Values> {
        vec![self.simd.splat(0.0); vectors * E::rows(self.table).stride()]
    }

    /// Whether all points of a block are at least `lower` and less than `upper`.
    #[inline(always)]
    fn inside<const N: usize>(&self, times: &[S::Values; N], (lower, upper): (f64, f64)) -> bool {
        let simd = self.simd;
        let (lower, upper) = (simd.splat(lower), simd.splat(upper));
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

    /// One block.
    #[inline(always)]
    fn block<const N: usize>(
        &self,
        at: usize,
        trail: &mut Trail,
        room: &mut [S::Values],
        found: &mut Found,
    ) -> ([S::Values; N], [u32; N]) {
        let (simd, table) = (self.simd, self.table);
        let times: [S::Values; N] = self.times(at);
        if trail.tries() {
            let first = trail.piece;
            if self.inside(&times, table.lookup.span(first, first)) {
                trail.gathered = 0;
                let rows = Broadcast::new(E::rows(table), first);
                return self.evaluate.evaluate(simd, table, rows, &times);
            }
            if first + 1 < table.pieces()
                && self.inside(&times, table.lookup.span(first, first + 1))
            {
                *trail = Trail { piece: first + 1, gathered: 0 };
                let start = simd.splat(table.lookup.span(first + 1, first + 1).0);
                let mut later = [simd.at_least(times[0], start); N];
                for j in 1..N {
                    later[j] = simd.at_least(times[j], start);
                }
                let rows = Blended::new(E::rows(table), first, later);
                return self.evaluate.evaluate(simd, table, rows, &times);
            }
            if let Some((first, last)) = self.neighbours(&times) {
                *trail = Trail { piece: last, gathered: 0 };
                return self.merged(&times, first, last);
            }
        }
        trail.gathered = trail.gathered.wrapping_add(1);
        let (values, doubts, outside) = self.gathered(&times, room);
        found.is_outside |= outside != [0; N];
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
            let rows = Broadcast::new(E::rows(table), piece);
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
    fn partial(&self, at: usize, out: &mut [f64], room: &mut [S::Values], found: &mut Found) {
        for (i, chunk) in out.chunks_mut(S::LANES).enumerate() {
            let at = at + i * S::LANES;
            let mut lanes = [f64::NAN; 8];
            lanes[..chunk.len()].copy_from_slice(&self.times[at..][..chunk.len()]);
            let ([values], [doubt], [outside]) = self.gathered(&[self.simd.load(&lanes)], room);
            self.simd.store(values, &mut lanes);
            chunk.copy_from_slice(&lanes[..chunk.len()]);
            let filled = (1 << chunk.len()) - 1;
            found.is_outside |= outside & filled != 0;
            collect(at, doubt & filled, &mut found.undecided);
        }
    }

    /// Writes the values of a block from index `at` on, and notes which are in doubt.
    #[inline(always)]
    fn write<const N: usize>(
        &self,
        (at, block): (usize, &mut [f64]),
        stores: Stores,
        (values, doubts): ([S::Values; N], [u32; N]),
        undecided: &mut Vec<usize>,
    ) {
        for (chunk, &value) in block.chunks_exact_mut(S::LANES).zip(&values) {
            match stores {
                Stores::Cached => self.simd.store(value, chunk),
                Stores::Streamed => self.simd.stream(value, chunk),
            }
        }
        for (j, &doubt) in doubts.iter().enumerate() {
            collect(at + j * S::LANES, doubt, undecided);
        }
    }

    /// All points, `out.len()` of them.
    #[inline(always)]
    fn run<const N: usize>(&self, out: &mut [f64]) -> Found {
        let simd = self.simd;
        let stores = if out.len() >= STREAMED { Stores::Streamed } else { Stores::Cached };
        let vector = size_of::<S::Values>();
        let misaligned = out.as_ptr().addr() % vector;
        let streams = stores == Stores::Streamed;
        let head = if streams && misaligned != 0 { (vector - misaligned) / 8 } else { 0 };
        let (head, body) = out.split_at_mut(head);
        let (mut room, mut found) = (self.room(N), Found::default());
        self.partial(0, head, &mut room, &mut found);
        let (mut at, mut trail) = (head.len(), Trail::default());
        let size = N * S::LANES;
        let mut blocks = body.chunks_exact_mut(size);
        for block in &mut blocks {
            let values = self.block::<N>(at, &mut trail, &mut room, &mut found);
            self.write((at, block), stores, values, &mut found.undecided);
            at += size;
        }
        self.partial(at, blocks.into_remainder(), &mut room, &mut found);
        if streams {
            simd.fence();
        }
        found
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
