//! Rows of doubles that fill whole lines of a cache.
//!
//! Points in no order each read one row. A row that begins with a line of 64 bytes and ends with one is
//! read with the fewest lines, and by whole vectors.

/// Doubles a line of 64 bytes.
const LINE: usize = 8;

/// Rows of one length, padded with zeros to whole lines.
///
/// # Invariants
/// - `values` holds `first` zeros, at most 7, then the rows of [`stride`](Self::stride) doubles, a
///   multiple of 8.
/// - The first row is aligned to 64 bytes.
#[derive(Debug)]
pub(crate) struct AlignedRows {
    values: Vec<f64>,
    first: usize,
    stride: usize,
}

impl AlignedRows {
    /// No rows yet, with room for `count` rows of a length.
    pub(crate) fn new(count: usize, length: usize) -> Self {
        let stride = length.next_multiple_of(LINE);
        let mut values: Vec<f64> = Vec::with_capacity(count * stride + LINE);
        let first = values.as_ptr().align_offset(64).min(LINE - 1);
        values.resize(first, 0.0);
        Self { values, first, stride }
    }

    /// Appends a row. O(length).
    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = f64>) {
        let end = self.values.len() + self.stride;
        self.values.extend(row);
        assert!(self.values.len() <= end, "a row is not longer than its place");
        self.values.resize(end, 0.0);
    }

    /// All rows, one after the other.
    pub(crate) fn values(&self) -> &[f64] {
        &self.values[self.first..]
    }

    /// Doubles a row.
    pub(crate) fn stride(&self) -> usize {
        self.stride
    }

    /// One row.
    pub(crate) fn row(&self, number: usize) -> &[f64] {
        &self.values()[number * self.stride..][..self.stride]
    }
}

/// The copy is aligned as well.
impl Clone for AlignedRows {
    fn clone(&self) -> Self {
        let count = self.values().len() / self.stride.max(1);
        let mut copy = Self::new(count, self.stride);
        for row in 0..count {
            copy.push(self.row(row).iter().copied());
        }
        copy
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_padded_and_aligned_and_so_are_copies() {
        let mut rows = AlignedRows::new(3, 9);
        for i in 0..3 {
            rows.push((0..9).map(|k| f64::from(10 * i + k)));
        }
        let copies: Vec<AlignedRows> = (0..5).map(|_| rows.clone()).collect();
        for rows in copies.iter().chain([&rows]) {
            assert_eq!((rows.stride(), rows.values().len()), (16, 48));
            assert_eq!(rows.row(2)[..9], [20.0, 21.0, 22.0, 23.0, 24.0, 25.0, 26.0, 27.0, 28.0]);
            assert_eq!(rows.row(1)[9..], [0.0; 7]);
            assert_eq!(rows.values().as_ptr().addr() % 64, 0);
        }
        assert_eq!(AlignedRows::new(4, 0).clone().values(), [0.0; 0]);
    }

    #[test]
    #[should_panic(expected = "not longer than its place")]
    fn long_rows_are_refused() {
        AlignedRows::new(1, 1).push([1.0; 9]);
    }
}
