//! Horner's scheme in doubles, and in pairs of doubles with the test of rounding.
//!
//! The roundings of both are bounded in `bounds`.

use super::Simd;
use super::blocks::Evaluate;
use crate::rows::AlignedRows;
use crate::table::{ROW_BOUND, ROW_HEAD, ROW_OFFSET, ROW_SCALE, Table};

/// The rows of the pieces that the lanes of some vectors are in.
pub(crate) trait Rows<S: Simd, const N: usize>: Copy {
    /// An entry of the rows.
    fn entry(self, simd: S, column: usize) -> [S::Values; N];
    /// The low part of a coefficient below the split.
    fn low(self, simd: S, k: usize) -> [S::Values; N];
}

/// One piece for all lanes.
#[derive(Clone, Copy)]
pub(super) struct Broadcast<'a> {
    row: &'a [f64],
    low: &'a [f64],
}

impl<'a> Broadcast<'a> {
    #[inline(always)]
    pub(super) fn new(table: &'a Table, piece: usize) -> Self {
        Self { row: table.rows.row(piece), low: table.low.row(piece) }
    }
}

impl<S: Simd, const N: usize> Rows<S, N> for Broadcast<'_> {
    #[inline(always)]
    fn entry(self, simd: S, column: usize) -> [S::Values; N] {
        [simd.splat(self.row[column]); N]
    }

    #[inline(always)]
    fn low(self, simd: S, k: usize) -> [S::Values; N] {
        [simd.splat(self.low[k]); N]
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
    pub(super) fn new(table: &'a Table, first: usize, later: [S::Mask; N]) -> Self {
        let (first, second) = (Broadcast::new(table, first), Broadcast::new(table, first + 1));
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

    #[inline(always)]
    fn low(self, simd: S, k: usize) -> [S::Values; N] {
        self.of(simd, [self.first.low[k], self.second.low[k]])
    }
}

/// A piece for every lane, entry by entry.
#[derive(Clone, Copy)]
pub(super) struct Gathered<'a, S: Simd> {
    rows: &'a [f64],
    low: &'a [f64],
    row_offsets: S::Offsets,
    low_offsets: S::Offsets,
}

/// The first entries of the rows of pieces. A column is a slice that begins with its first entry, so the
/// limit leaves room for all further columns.
#[inline(always)]
fn offsets<S: Simd>(simd: S, pieces: S::Values, rows: &AlignedRows) -> S::Offsets {
    let first = simd.multiply(pieces, simd.splat(rows.stride() as f64));
    simd.offsets(first, (rows.values().len() + 1).saturating_sub(rows.stride()).max(1))
}

impl<'a, S: Simd> Gathered<'a, S> {
    /// Of the numbers of pieces.
    #[inline(always)]
    pub(super) fn new(simd: S, table: &'a Table, pieces: S::Values) -> Self {
        Self {
            rows: table.rows.values(),
            low: table.low.values(),
            row_offsets: offsets(simd, pieces, &table.rows),
            low_offsets: offsets(simd, pieces, &table.low),
        }
    }
}

impl<S: Simd> Rows<S, 1> for Gathered<'_, S> {
    #[inline(always)]
    fn entry(self, simd: S, column: usize) -> [S::Values; 1] {
        [simd.gather(&self.rows[column..], self.row_offsets)]
    }

    #[inline(always)]
    fn low(self, simd: S, k: usize) -> [S::Values; 1] {
        [simd.gather(&self.low[k..], self.low_offsets)]
    }
}

/// A piece for every lane: whole rows are read, and turned into columns.
#[derive(Clone, Copy)]
pub(super) struct Transposed<'a, S: Simd> {
    rows: &'a [S::Values],
    low: &'a [S::Values],
}

impl<'a, S: Simd> Transposed<'a, S> {
    /// Of the numbers of pieces, with or without the low parts, in room for a row of each.
    #[inline(always)]
    pub(super) fn new(
        simd: S,
        table: &Table,
        pieces: S::Values,
        with_low: bool,
        room: &'a mut [S::Values],
    ) -> Self {
        let (rows, low) = room.split_at_mut(table.rows.stride());
        Self::fill(simd, &table.rows, pieces, rows);
        if with_low && table.split > 0 {
            Self::fill(simd, &table.low, pieces, low);
        }
        Self { rows, low }
    }

    #[inline(always)]
    fn fill(simd: S, rows: &AlignedRows, pieces: S::Values, columns: &mut [S::Values]) {
        let offsets = offsets(simd, pieces, rows);
        for (i, columns) in columns.chunks_exact_mut(S::LANES).enumerate() {
            simd.transpose(&rows.values()[i * S::LANES..], offsets, columns);
        }
    }
}

impl<S: Simd> Rows<S, 1> for Transposed<'_, S> {
    #[inline(always)]
    fn entry(self, _: S, column: usize) -> [S::Values; 1] {
        [self.rows[column]]
    }

    #[inline(always)]
    fn low(self, _: S, k: usize) -> [S::Values; 1] {
        [self.low[k]]
    }
}

/// Values in doubles: Horner's scheme, one multiply-add a coefficient.
#[derive(Clone, Copy)]
pub(crate) struct Plain;

impl Evaluate for Plain {
    const MANY_IN_FLIGHT: usize = 8;
    const FEW_IN_FLIGHT: usize = 6;
    const PAIRS: bool = false;

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
        let mut value = rows.entry(simd, ROW_HEAD + table.degree)[vector];
        let mut derivative = simd.splat(0.0);
        for k in (0..table.degree).rev() {
            derivative = simd.multiply_add(derivative, argument, value);
            let coefficient = rows.entry(simd, ROW_HEAD + k)[vector];
            value = simd.multiply_add(value, argument, coefficient);
        }
        derivative
    }
}

impl Evaluate for Certified {
    const MANY_IN_FLIGHT: usize = 4;
    const FEW_IN_FLIGHT: usize = 2;
    const PAIRS: bool = true;

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
        let degree = table.degree;
        let zero = simd.splat(0.0);
        let mut high = rows.entry(simd, ROW_HEAD + degree);
        let mut low = if table.split > degree { rows.low(simd, degree) } else { [zero; N] };
        for k in (table.split..degree).rev() {
            let coefficient = rows.entry(simd, ROW_HEAD + k);
            for j in 0..N {
                high[j] = simd.multiply_add(high[j], arguments[j], coefficient[j]);
            }
        }
        for k in (0..table.split.min(degree)).rev() {
            let (coefficient, coefficient_low) =
                (rows.entry(simd, ROW_HEAD + k), rows.low(simd, k));
            for j in 0..N {
                let (product, product_error) = simd.two_product(high[j], arguments[j]);
                let (sum, sum_error) = simd.two_sum(coefficient[j], product);
                let rest = simd.multiply_add(low[j], arguments[j], product_error);
                low[j] = simd.add(simd.add(rest, coefficient_low[j]), sum_error);
                high[j] = sum;
            }
        }
        let bound = rows.entry(simd, ROW_BOUND);
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
