//! The doubles at which a table is evaluated.

use super::Simd;

/// Products of an index and a smaller step can be split without overflow.
pub(super) const MAX_STEP: f64 = 1e280;

/// A sequence of doubles that can be read a vector at a time.
pub(crate) trait Points: Copy {
    /// Whether certainly no double is less than the one before; all or none of them may be NaN.
    fn ascend(self) -> bool;

    /// The doubles from index `at` on, all of which exist.
    fn times<S: Simd>(self, simd: S, at: usize) -> S::Values;

    /// Like [`times`](Self::times); lanes beyond the last double hold anything.
    fn times_padded<S: Simd>(self, simd: S, at: usize) -> S::Values;
}

/// `t_i = RN(from + (first + i) step)`.
///
/// It is the exact sum rounded once, on every machine.
#[derive(Clone, Copy)]
pub(crate) struct Grid {
    pub(crate) from: f64,
    pub(crate) step: f64,
    pub(crate) first: usize,
}

impl Points for Grid {
    /// Rounding is monotone, so a grid ascends weakly if its step is not negative. No product with an
    /// index overflows below the given step; if `from` is NaN, all doubles are.
    #[inline(always)]
    fn ascend(self) -> bool {
        self.step >= 0.0 && self.step <= MAX_STEP
    }

    #[inline(always)]
    fn times<S: Simd>(self, simd: S, at: usize) -> S::Values {
        simd.grid(self.first + at, self.from, self.step)
    }

    #[inline(always)]
    fn times_padded<S: Simd>(self, simd: S, at: usize) -> S::Values {
        self.times(simd, at)
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
    fn times<S: Simd>(self, simd: S, at: usize) -> S::Values {
        simd.load(&self.0[at..])
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
