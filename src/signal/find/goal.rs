//! Which extremum is looked for, and how far values have come.

use crate::ball::{Ball, Binary};
use std::cmp::Ordering;

/// Which extremum.
///
/// ```
/// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
/// let strain = mass.signal("strain_fixed")?;
/// let least = strain.extremum(wavestep::Goal::Smallest, 0..=5, 9)?;
/// assert_eq!(least.value.to_string(), "-2.27067057"); // -2 - 2 exp(-2)
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Goal {
    /// The supremum.
    Largest,
    /// The infimum.
    Smallest,
}

impl Goal {
    /// A value, or its negative, so that the largest is looked for.
    pub(crate) fn raised(self, value: Ball) -> Ball {
        match self {
            Goal::Largest => value,
            Goal::Smallest => value.negate(),
        }
    }

    /// The sign of what is no extremum as long as there is any of the other sign; that of the curvature at one.
    pub(crate) fn lesser(self) -> Ordering {
        match self {
            Goal::Largest => Ordering::Less,
            Goal::Smallest => Ordering::Greater,
        }
    }
}

/// The largest value that is known to be taken, or the negative of the smallest.
pub(crate) struct Record {
    pub goal: Goal,
    pub best: Option<Binary>,
}

impl Record {
    /// Notes a value that is taken, raised as the goal asks.
    pub fn note(&mut self, value: &Ball) {
        let (lower, _) = value.endpoints();
        if self.best.as_ref().is_none_or(|best| *best < lower) {
            self.best = Some(lower);
        }
    }

    /// Whether all values of a sign are below it.
    pub fn beats_sign(&self, sign: Ordering) -> bool {
        sign == self.goal.lesser() && self.best.as_ref().is_some_and(|best| *best >= Binary::zero())
    }

    /// Whether all values of a ball, raised as the goal asks, are below it.
    pub fn beats(&self, value: &Ball) -> bool {
        self.best.as_ref().is_some_and(|best| value.endpoints().1 < *best)
    }
}
