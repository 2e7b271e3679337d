//! Horner's scheme in doubles, and in pairs of doubles with the test of rounding.
//!
//! The roundings of both are bounded in `bounds`.

use super::Simd;
use super::blocks::Evaluate;
use crate::table::{ROW_BOUND, ROW_HEAD, ROW_OFFSET, ROW_SCALE, Table};

/// The rows of the pieces that the lanes of a vector are in.
pub(crate) trait Rows<S: Simd>: Copy {
    /// An entry of the rows.
    fn entry(self, simd: S, column: usize) -> S::Values;
    /// The low part of a coefficient below the split.
    fn low(self, simd: S, k: usize) -> S::Values;
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
        Self { row: table.row(piece), low: table.low_row(piece) }
    }
}

impl<S: Simd> Rows<S> for Broadcast<'_> {
    #[inline(always)]
    fn entry(self, simd: S, column: usize) -> S::Values {
        simd.splat(self.row[column])
    }

    #[inline(always)]
    fn low(self, simd: S, k: usize) -> S::Values {
        simd.splat(self.low[k])
    }
}

/// A piece for every lane.
#[derive(Clone, Copy)]
pub(super) struct Gathered<'a, S: Simd> {
    rows: &'a [f64],
    low: &'a [f64],
    row_offsets: S::Offsets,
    low_offsets: S::Offsets,
}

impl<'a, S: Simd> Gathered<'a, S> {
    /// Of the numbers of pieces.
    #[inline(always)]
    pub(super) fn new(simd: S, table: &'a Table, pieces: S::Values) -> Self {
        Self {
            rows: &table.rows,
            low: &table.low,
            row_offsets: Self::offsets(simd, pieces, table.stride(), table.rows.len()),
            low_offsets: Self::offsets(simd, pieces, table.split, table.low.len()),
        }
    }

    /// The first entries of rows. A column is a slice that begins with its first entry, so the limit
    /// leaves room for all further columns.
    #[inline(always)]
    fn offsets(simd: S, pieces: S::Values, width: usize, entries: usize) -> S::Offsets {
        let first = simd.multiply(pieces, simd.splat(width as f64));
        simd.offsets(first, (entries + 1).saturating_sub(width).max(1))
    }
}

impl<S: Simd> Rows<S> for Gathered<'_, S> {
    #[inline(always)]
    fn entry(self, simd: S, column: usize) -> S::Values {
        simd.gather(&self.rows[column..], self.row_offsets)
    }

    #[inline(always)]
    fn low(self, simd: S, k: usize) -> S::Values {
        simd.gather(&self.low[k..], self.low_offsets)
    }
}

/// Values in doubles: Horner's scheme, one multiply-add a coefficient.
#[derive(Clone, Copy)]
pub(crate) struct Plain;

impl Evaluate for Plain {
    const MANY_IN_FLIGHT: usize = 8;
    const FEW_IN_FLIGHT: usize = 4;

    #[inline(always)]
    fn evaluate<S: Simd, R: Rows<S>, const N: usize>(
        self,
        simd: S,
        table: &Table,
        rows: R,
        times: &[S::Values; N],
    ) -> ([S::Values; N], [u32; N]) {
        let (scale, offset) = (rows.entry(simd, ROW_SCALE), rows.entry(simd, ROW_OFFSET));
        let mut arguments = *times;
        for u in &mut arguments {
            *u = simd.multiply_add(*u, scale, offset);
        }
        let mut values = [rows.entry(simd, ROW_HEAD + table.degree); N];
        for k in (0..table.degree).rev() {
            let coefficient = rows.entry(simd, ROW_HEAD + k);
            for (value, &u) in values.iter_mut().zip(&arguments) {
                *value = simd.multiply_add(*value, u, coefficient);
            }
        }
        (values, [0; N])
    }
}

/// Correctly rounded values: pairs of doubles and the test whether they round to one double.
#[derive(Clone, Copy)]
pub(crate) struct Certified;

impl Certified {
    /// `p'(û)` in doubles, for the part of the argument that `û` leaves.
    #[inline(always)]
    fn derivative<S: Simd, R: Rows<S>>(
        simd: S,
        table: &Table,
        rows: R,
        argument: S::Values,
    ) -> S::Values {
        let mut value = rows.entry(simd, ROW_HEAD + table.degree);
        let mut derivative = simd.splat(0.0);
        for k in (0..table.degree).rev() {
            derivative = simd.multiply_add(derivative, argument, value);
            value = simd.multiply_add(value, argument, rows.entry(simd, ROW_HEAD + k));
        }
        derivative
    }
}

impl Evaluate for Certified {
    const MANY_IN_FLIGHT: usize = 4;
    const FEW_IN_FLIGHT: usize = 2;

    #[inline(always)]
    fn evaluate<S: Simd, R: Rows<S>, const N: usize>(
        self,
        simd: S,
        table: &Table,
        rows: R,
        times: &[S::Values; N],
    ) -> ([S::Values; N], [u32; N]) {
        let (scale, offset) = (rows.entry(simd, ROW_SCALE), rows.entry(simd, ROW_OFFSET));
        let (mut arguments, mut rests) = (*times, *times);
        for (u, rest) in arguments.iter_mut().zip(&mut rests) {
            (*u, *rest) = simd.two_sum(simd.multiply(*u, scale), offset);
        }
        let degree = table.degree;
        let zero = simd.splat(0.0);
        let mut high = [rows.entry(simd, ROW_HEAD + degree); N];
        let first_low = if table.split > degree { rows.low(simd, degree) } else { zero };
        let mut low = [first_low; N];
        for k in (table.split..degree).rev() {
            let coefficient = rows.entry(simd, ROW_HEAD + k);
            for (value, &u) in high.iter_mut().zip(&arguments) {
                *value = simd.multiply_add(*value, u, coefficient);
            }
        }
        for k in (0..table.split.min(degree)).rev() {
            let (coefficient, coefficient_low) =
                (rows.entry(simd, ROW_HEAD + k), rows.low(simd, k));
            for ((high, low), &u) in high.iter_mut().zip(&mut low).zip(&arguments) {
                let (product, product_error) = simd.two_product(*high, u);
                let (sum, sum_error) = simd.two_sum(coefficient, product);
                let rest = simd.multiply_add(*low, u, product_error);
                *low = simd.add(simd.add(rest, coefficient_low), sum_error);
                *high = sum;
            }
        }
        let bound = rows.entry(simd, ROW_BOUND);
        let mut doubts = [0; N];
        for j in 0..N {
            if !simd.all(simd.equal(rests[j], zero)) {
                let derivative = Self::derivative(simd, table, rows, arguments[j]);
                low[j] = simd.add(low[j], simd.multiply(derivative, rests[j]));
            }
            let (sum, rest) = simd.two_sum(high[j], low[j]);
            let down = simd.add(sum, simd.subtract(rest, bound));
            let up = simd.add(sum, simd.add(rest, bound));
            high[j] = sum;
            doubts[j] = !simd.bits(simd.equal(down, up)) & ((1 << S::LANES) - 1);
        }
        (high, doubts)
    }
}
