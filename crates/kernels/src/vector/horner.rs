//! Horner's scheme in doubles, and in pairs of doubles with the test of rounding.
//!
//! The roundings of both are bounded in `bounds`.

use super::Simd;
use crate::rows::AlignedRows;
use crate::table::{PAIRS_ANCHOR, PAIRS_BOUND, PAIRS_HEAD, ROW_HEAD, ROW_OFFSET, ROW_SCALE, Table};

/// The rows of the pieces that the lanes of some vectors are in.
pub(crate) trait Rows<S: Simd, const N: usize>: Copy {
    /// An entry of the rows.
    fn entry(self, simd: S, column: usize) -> [S::Values; N];
}

/// One piece for all lanes.
#[derive(Clone, Copy)]
pub(super) struct Broadcast<'a> {
    row: &'a [f64],
}

impl<'a> Broadcast<'a> {
    #[inline(always)]
    pub(super) fn new(rows: &'a AlignedRows, piece: usize) -> Self {
        Self { row: rows.row(piece) }
    }
}

impl<S: Simd, const N: usize> Rows<S, N> for Broadcast<'_> {
    #[inline(always)]
    fn entry(self, simd: S, column: usize) -> [S::Values; N] {
        [simd.splat(self.row[column]); N]
    }
}

/// One of two neighbouring pieces for every lane.
#[derive(Clone, Copy)]
pub(super) struct Blended<'a, S: Simd, const N: usize> {
    first: Broadcast<'a>,
    second: Broadcast<'a>,
    /// The lanes in the second piece.
    later: [S::Mask; N],
}

impl<'a, S: Simd, const N: usize> Blended<'a, S, N> {
    /// Of the piece `first`, and the one after it for the lanes that are `later`.
    #[inline(always)]
    pub(super) fn new(rows: &'a AlignedRows, first: usize, later: [S::Mask; N]) -> Self {
        let (first, second) = (Broadcast::new(rows, first), Broadcast::new(rows, first + 1));
        Self { first, second, later }
    }

    #[inline(always)]
    fn of(self, simd: S, [first, second]: [f64; 2]) -> [S::Values; N] {
        let (first, second) = (simd.splat(first), simd.splat(second));
        let mut entries = [first; N];
        for (entry, &later) in entries.iter_mut().zip(&self.later) {
            *entry = simd.select(later, second, first);
        }
        entries
    }
}

impl<S: Simd, const N: usize> Rows<S, N> for Blended<'_, S, N> {
    #[inline(always)]
    fn entry(self, simd: S, column: usize) -> [S::Values; N] {
        self.of(simd, [self.first.row[column], self.second.row[column]])
    }
}

/// A piece for every lane: whole rows are read, and turned into columns.
#[derive(Clone, Copy)]
pub(super) struct Transposed<'a, S: Simd> {
    /// The columns of all vectors, one vector after the other.
    columns: &'a [S::Values],
    stride: usize,
}

impl<'a, S: Simd> Transposed<'a, S> {
    /// Of rows at offsets, in room for as many columns as they have.
    #[inline(always)]
    pub(super) fn new<const N: usize>(
        simd: S,
        rows: &AlignedRows,
        offsets: &[S::Offsets; N],
        columns: &'a mut [S::Values],
    ) -> Self {
        let (values, stride) = (rows.values(), rows.stride());
        for (columns, &offsets) in columns.chunks_exact_mut(stride).zip(offsets) {
            simd.transpose(values, offsets, columns);
        }
        Self { columns, stride }
    }
}

impl<S: Simd, const N: usize> Rows<S, N> for Transposed<'_, S> {
    #[inline(always)]
    fn entry(self, simd: S, column: usize) -> [S::Values; N] {
        let mut entries = [simd.splat(0.0); N];
        for (j, entry) in entries.iter_mut().enumerate() {
            *entry = self.columns[j * self.stride + column];
        }
        entries
    }
}

/// A way to evaluate polynomials.
pub(crate) trait Evaluate: Copy + Sync {
    /// Vectors a block with 32 vector registers.
    const MANY_IN_FLIGHT: usize;
    /// Vectors a block with 16 vector registers.
    const FEW_IN_FLIGHT: usize;

    /// The rows that are read.
    fn rows(table: &Table) -> &AlignedRows;

    /// Values of the polynomials of the given rows, and one bit for every lane that is in doubt.
    fn evaluate<S: Simd, R: Rows<S, N>, const N: usize>(
        self,
        simd: S,
        table: &Table,
        rows: R,
        times: &[S::Values; N],
    ) -> ([S::Values; N], [u32; N]);
}

/// Values in doubles: Horner's scheme, one multiply-add a coefficient.
#[derive(Clone, Copy)]
pub(crate) struct Plain;

impl Evaluate for Plain {
    const MANY_IN_FLIGHT: usize = 8;
    const FEW_IN_FLIGHT: usize = 6;

    #[inline(always)]
    fn rows(table: &Table) -> &AlignedRows {
        &table.rows
    }

    #[inline(always)]
    fn evaluate<S: Simd, R: Rows<S, N>, const N: usize>(
        self,
        simd: S,
        table: &Table,
        rows: R,
        times: &[S::Values; N],
    ) -> ([S::Values; N], [u32; N]) {
        let (scale, offset) = (rows.entry(simd, ROW_SCALE), rows.entry(simd, ROW_OFFSET));
        let mut arguments = *times;
        for j in 0..N {
            arguments[j] = simd.multiply_add(times[j], scale[j], offset[j]);
        }
        let mut values = rows.entry(simd, ROW_HEAD + table.degree);
        for k in (0..table.degree).rev() {
            let coefficient = rows.entry(simd, ROW_HEAD + k);
            for j in 0..N {
                values[j] = simd.multiply_add(values[j], arguments[j], coefficient[j]);
            }
        }
        (values, [0; N])
    }
}

/// Correctly rounded values: pairs of doubles and the test whether they round to one double.
#[derive(Clone, Copy)]
pub(crate) struct Certified;

impl Certified {
    /// `p'(û)` in doubles, for the part of the argument that `û` leaves, of one of the vectors.
    #[inline(always)]
    fn derivative<S: Simd, R: Rows<S, N>, const N: usize>(
        simd: S,
        table: &Table,
        rows: R,
        (vector, argument): (usize, S::Values),
    ) -> S::Values {
        let zero = simd.splat(0.0);
        let anchor = rows.entry(simd, PAIRS_ANCHOR)[vector];
        let (mut value, mut derivative) = (zero, zero);
        for k in (0..=table.degree).rev() {
            let entry = rows.entry(simd, PAIRS_HEAD + k)[vector];
            let coefficient = if k < table.split { simd.subtract(entry, anchor) } else { entry };
            derivative = simd.multiply_add(derivative, argument, value);
            value = simd.multiply_add(value, argument, coefficient);
        }
        derivative
    }
}

impl Evaluate for Certified {
    const MANY_IN_FLIGHT: usize = 6;
    const FEW_IN_FLIGHT: usize = 4;

    #[inline(always)]
    fn rows(table: &Table) -> &AlignedRows {
        &table.pairs
    }

    #[inline(always)]
    fn evaluate<S: Simd, R: Rows<S, N>, const N: usize>(
        self,
        simd: S,
        table: &Table,
        rows: R,
        times: &[S::Values; N],
    ) -> ([S::Values; N], [u32; N]) {
        let (scale, offset) = (rows.entry(simd, ROW_SCALE), rows.entry(simd, ROW_OFFSET));
        let (mut arguments, mut rests) = (*times, *times);
        for j in 0..N {
            let scaled = simd.multiply(times[j], scale[j]);
            (arguments[j], rests[j]) = simd.two_sum(scaled, offset[j]);
        }
        let (degree, split) = (table.degree, table.split);
        let zero = simd.splat(0.0);
        let (mut high, mut low) = ([zero; N], [zero; N]);
        if split <= degree {
            high = rows.entry(simd, PAIRS_HEAD + degree);
        }
        for k in (split..degree).rev() {
            let coefficient = rows.entry(simd, PAIRS_HEAD + k);
            for j in 0..N {
                high[j] = simd.multiply_add(high[j], arguments[j], coefficient[j]);
            }
        }
        let anchor = rows.entry(simd, PAIRS_ANCHOR);
        for k in (0..split).rev() {
            let anchored = rows.entry(simd, PAIRS_HEAD + k);
            let coefficient_low = rows.entry(simd, PAIRS_HEAD + degree + 1 + k);
            for j in 0..N {
                let (sum, rest) = simd.anchored_product(high[j], arguments[j], anchored[j]);
                let rest = simd.add(rest, coefficient_low[j]);
                low[j] = simd.multiply_add(low[j], arguments[j], rest);
                high[j] = simd.subtract(sum, anchor[j]);
            }
        }
        let bound = rows.entry(simd, PAIRS_BOUND);
        let mut doubts = [0; N];
        for j in 0..N {
            if !simd.all(simd.equal(rests[j], zero)) {
                let derivative = Self::derivative(simd, table, rows, (j, arguments[j]));
                low[j] = simd.add(low[j], simd.multiply(derivative, rests[j]));
            }
            let (sum, rest) = simd.two_sum(high[j], low[j]);
            let down = simd.add(sum, simd.subtract(rest, bound[j]));
            let up = simd.add(sum, simd.add(rest, bound[j]));
            high[j] = sum;
            doubts[j] = !simd.bits(simd.equal(down, up)) & ((1 << S::LANES) - 1);
        }
        (high, doubts)
    }
}
