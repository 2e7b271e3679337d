//! Which piece a double belongs to.
//!
//! The window is cut into uniform buckets. A bucket knows the first piece that can hold one of its
//! doubles; a short search by comparisons with the starts does the rest. Comparisons alone decide, so
//! the result is exact whatever the rounding of a bucket's number.

use crate::vector::Simd;

/// Starts of pieces with buckets over them.
///
/// # Invariants
/// - `starts` holds the starts, ascending, then the double after the end, then infinities, so that a
///   search may look `2^widths − 1` entries beyond the last start.
/// - For every double `t` within the window, the piece of `t` is at least `buckets[b]` and at most
///   `buckets[b] + 2^widths − 1`, with `b` the bucket of `t`. All entries are less than `pieces`.
#[derive(Clone, Debug)]
pub(crate) struct Lookup {
    starts: Vec<f64>,
    buckets: Vec<u32>,
    inverse_width: f64,
    pieces: usize,
    widths: u32,
}

impl Lookup {
    /// Of ascending starts, not empty, and the last double of the window. O(pieces).
    pub(crate) fn new(starts: impl Iterator<Item = f64>, end: f64) -> Self {
        let mut starts: Vec<f64> = starts.collect();
        let pieces = starts.len();
        let all =
            [2, 4, 8].map(|more| Buckets::new(&starts, end, (more * pieces).next_power_of_two()));
        // The fewest buckets of those that leave the shortest search.
        let [first, second, third] = all;
        let shorter = |a: Buckets, b: Buckets| if b.widths < a.widths { b } else { a };
        let Buckets { buckets, inverse_width, widths } = shorter(shorter(first, second), third);
        starts.push(end.next_up());
        starts.resize(pieces + (1 << widths), f64::INFINITY);
        Self { starts, buckets, inverse_width, pieces, widths }
    }

    /// The starts, then the double after the end, then infinities.
    pub(crate) fn starts(&self) -> &[f64] {
        &self.starts
    }

    /// The size of the larger array.
    pub(crate) fn entries(&self) -> usize {
        self.starts.len().max(self.buckets.len())
    }

    /// The doubles that belong to a run of pieces: from the first bound up to, not including, the second.
    pub(crate) fn span(&self, first: usize, last: usize) -> (f64, f64) {
        (self.starts[first], self.starts[last + 1])
    }

    /// Which lanes lie within the window; NaN does not.
    #[inline(always)]
    pub(crate) fn within<S: Simd>(&self, simd: S, times: S::Values) -> S::Mask {
        let (lower, upper) = (self.starts[0], self.starts[self.pieces]);
        let from = simd.at_least(times, simd.splat(lower));
        simd.both(from, simd.less(times, simd.splat(upper)))
    }

    /// The numbers of the pieces of doubles within the window.
    #[inline(always)]
    pub(crate) fn pieces<S: Simd>(&self, simd: S, times: S::Values) -> S::Values {
        let distance = simd.subtract(times, simd.splat(self.starts[0]));
        let bucket = simd.multiply(distance, simd.splat(self.inverse_width));
        let bucket = simd.offsets(bucket, self.buckets.len());
        let mut piece = simd.gather_integers(&self.buckets, bucket);
        for exponent in (0..self.widths).rev() {
            let further = simd.add(piece, simd.splat((1_u64 << exponent) as f64));
            let start = simd.gather(&self.starts, simd.offsets(further, self.starts.len()));
            piece = simd.select(simd.at_least(times, start), further, piece);
        }
        piece
    }
}

/// Buckets over the window, of which [`Lookup`] takes the best.
struct Buckets {
    buckets: Vec<u32>,
    inverse_width: f64,
    widths: u32,
}

impl Buckets {
    /// `count` buckets over ascending starts up to an end. O(count).
    fn new(starts: &[f64], end: f64, count: usize) -> Self {
        let inverse_width = Some(count as f64 / (end - starts[0])).filter(|x| x.is_finite());
        let inverse_width = inverse_width.unwrap_or(0.0);
        // The number of a bucket grows with t, roundings included: subtraction and multiplication by a
        // positive number are monotone when rounded, and so is truncation. So a piece that starts in
        // an earlier bucket than that of t starts before t, and one that starts in a later bucket
        // after t.
        let bucket = |t: f64| (((t - starts[0]) * inverse_width) as usize).min(count - 1);
        let mut last_before = vec![0; count + 1];
        for (piece, &start) in starts.iter().enumerate() {
            last_before[bucket(start) + 1] = piece as u32;
        }
        for b in 1..=count {
            last_before[b] = last_before[b].max(last_before[b - 1]);
        }
        let spread = last_before.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0);
        let widths = u32::BITS - spread.leading_zeros();
        last_before.pop();
        Self { buckets: last_before, inverse_width, widths }
    }
}
