//! The doubles at which a table is evaluated.

use super::Simd;
use super::parts::{MAX_STEP, Parts};

/// A sequence of doubles that can be read some vectors at a time.
pub(crate) trait Points: Copy {
    /// Whether certainly no double is less than the one before; all or none of them may be NaN.
    fn ascend(self) -> bool;

    /// About how many doubles from index `at` on are less than `upper`. It is a guess: 0 where
    /// nothing is known.
    fn guess_below(self, at: usize, upper: f64) -> usize;

    /// The doubles from index `at` on, all of which exist.
    fn times<S: Simd, const N: usize>(self, simd: S, at: usize) -> [S::Values; N];

    /// One vector of them; lanes beyond the last double hold anything.
    fn times_padded<S: Simd>(self, simd: S, at: usize) -> S::Values;
}

/// `t_i = RN(from + i step)`.
///
/// It is the exact sum rounded once, on every machine.
#[derive(Clone, Copy)]
pub(crate) struct Grid {
    from: f64,
    step: f64,
    parts: Parts,
}

impl Grid {
    /// The first `count` doubles.
    pub(crate) fn new(from: f64, step: f64, count: usize) -> Self {
        Self { from, step, parts: Parts::new(from, step, count.saturating_add(128)) }
    }
}

impl Points for Grid {
    /// Rounding is monotone, so a grid ascends weakly if its step is not negative. No product with an
    /// index overflows below the given step; if `from` is NaN, all doubles are.
    #[inline(always)]
    fn ascend(self) -> bool {
        self.step >= 0.0 && self.step <= MAX_STEP
    }

    #[inline(always)]
    fn guess_below(self, at: usize, upper: f64) -> usize {
        // NaN becomes 0, and so does what is negative.
        ((upper - self.from) / self.step - at as f64) as usize
    }

    #[inline(always)]
    fn times<S: Simd, const N: usize>(self, simd: S, at: usize) -> [S::Values; N] {
        simd.grid(at, self.from, self.step, &self.parts)
    }

    #[inline(always)]
    fn times_padded<S: Simd>(self, simd: S, at: usize) -> S::Values {
        let [times] = self.times(simd, at);
        times
    }
}

/// Doubles in memory.
#[derive(Clone, Copy)]
pub(crate) struct Times<'a>(pub(crate) &'a [f64]);

impl Points for Times<'_> {
    #[inline(always)]
    fn ascend(self) -> bool {
        false
    }

    #[inline(always)]
    fn guess_below(self, _: usize, _: f64) -> usize {
        0
    }

    #[inline(always)]
    fn times<S: Simd, const N: usize>(self, simd: S, at: usize) -> [S::Values; N] {
        let times = &self.0[at..][..N * S::LANES];
        let mut vectors = [simd.splat(0.0); N];
        for j in 0..N {
            vectors[j] = simd.load(&times[j * S::LANES..]);
        }
        vectors
    }

    #[inline(always)]
    fn times_padded<S: Simd>(self, simd: S, at: usize) -> S::Values {
        let rest = &self.0[at..];
        if rest.len() >= S::LANES {
            return simd.load(rest);
        }
        let mut padded = [f64::NAN; 8];
        padded[..rest.len()].copy_from_slice(rest);
        simd.load(&padded)
    }
}
