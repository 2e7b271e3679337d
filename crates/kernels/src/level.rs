//! Which vector instructions an evaluation uses.

use std::sync::atomic::{AtomicU8, Ordering};

/// A set of instructions for evaluation, from the one that every machine has to the widest.
///
/// `Avx2` and `Avx512` give the same doubles bit for bit. `Baseline` has no fused multiply-add, so
/// its values can differ from theirs, within the same bound.
#[derive(Clone, Copy, Debug, Eq, Hash, Ord, PartialEq, PartialOrd)]
pub enum Level {
    /// What every machine has: pairs of doubles (SSE2) on x86-64, single doubles elsewhere.
    Baseline,
    /// AVX2 with fused multiply-add: four doubles a vector.
    Avx2,
    /// AVX-512F: eight doubles a vector.
    Avx512,
}

impl Level {
    const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// Whether this machine has the instructions. O(1), detected once.
    fn is_available(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = || is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            match self {
                Self::Baseline => true,
                Self::Avx2 => avx2(),
                Self::Avx512 => avx2() && is_x86_feature_detected!("avx512f"),
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            self == Self::Baseline
        }
    }

    /// The levels of this machine, ascending.
    pub fn available() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|level| level.is_available())
    }

    /// The widest level of this machine, at most that of [`Level::limit`].
    pub fn best() -> Self {
        let most = MOST.load(Ordering::Relaxed);
        Self::available().filter(|level| *level as u8 <= most).last().unwrap_or(Self::Baseline)
    }

    /// From now on, evaluates with this level at most.
    pub fn limit(self) {
        MOST.store(self as u8, Ordering::Relaxed);
    }
}

static MOST: AtomicU8 = AtomicU8::new(Level::Avx512 as u8);
