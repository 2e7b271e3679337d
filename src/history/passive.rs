//! What becomes of errors in the whole line: they hold energy, and nothing in the line gives any.
//!
//! The difference between a motion and what is followed of it, `e`, obeys the equations of the line, but for the
//! *fresh* error that each cell of each node adds: what its series leave out, and what is rounded. Contacts open and
//! close at the same instants in both, since these are known by name and not by number. So its energy
//!
//! `E = ½ Σ m v² + ½ Σ k u² + Σ Z ∫ f² dt`, over masses, springs, and waves on their way from node to node,
//!
//! does not grow by itself. Fresh errors are motions of the same kind, and `√E` is a norm: it grows by no more than
//! theirs. No wave and no state has an error of more energy than all of them.
//!
//! **Values.** Let `∫ f² dx ≤ η²` on a cell of length `h`, and `|f^(m)| ≤ B γ^m`. About the middle of the cell `f` is a
//! polynomial `p` of degree `m − 1` and no more than `R = B (γh/2)^m/m! ≤ B (eγh/(2m))^m` besides. With Legendre's
//! polynomials `|p| ≤ m/√h · √(∫ p² dx)`, so that `|f| ≤ m η/√h + (m + 1) R`. For `m ≥ eγh` and `m ≥ log₂(B √h/η)`
//! the rest is `R ≤ B 2^(−m) ≤ η/√h`, and together
//!
//! `|f| ≤ (2m + 1) η/√h`.
//!
//! So `B` may grow from passage to passage as it likes: its logarithm is what counts.

use crate::ball::{Magnitude, Number};
use crate::history::series::{Series, Truncation};

/// The precision of bounds.
const BITS: u64 = 64;

/// `eγh` is told up to a power of two; no cell comes near this one.
const LONGEST: i64 = 60;

/// A bound of `√(2E)` of all errors so far.
#[derive(Clone, Copy, Debug)]
pub struct ErrorEnergy(Magnitude);

/// A wave that leaves into a bar while a cell lasts.
pub struct Passage {
    pub length: Magnitude,
    /// `√(2Zh)`, and `1/√(2Zh)` where the cell is known to have a length.
    root: Magnitude,
    inverse_root: Option<Magnitude>,
}

impl Passage {
    pub fn of(impedance: &Number, length: &Number) -> Passage {
        let double = impedance.multiply(length, BITS);
        let double = double.add(&double, BITS);
        let inverse = double.reciprocal(BITS).ok();
        Passage {
            length: length.magnitude(),
            root: double.magnitude().square_root(),
            inverse_root: inverse.map(|inverse| inverse.magnitude().square_root()),
        }
    }
}

impl ErrorEnergy {
    pub const NONE: ErrorEnergy = ErrorEnergy(Magnitude::ZERO);

    /// With the fresh error of a state, of this size.
    pub fn add_state(&mut self, size: &Magnitude) {
        self.0 = self.0.add(size);
    }

    /// With the fresh error of a wave.
    pub fn add_wave(&mut self, fresh: &Magnitude, passage: &Passage) {
        self.0 = self.0.add(&fresh.multiply(&passage.root));
    }

    /// A bound of the size of an error of the state of a node.
    pub fn of_state(&self) -> Magnitude {
        self.0
    }

    /// A wave with an error that is no larger than all errors so far allow, none of it fresh any more.
    pub fn settle(&self, wave: Series, passage: &Passage, cut: &Truncation) -> Series {
        let Some(inverse_root) = &passage.inverse_root else {
            return wave;
        };
        // η/√h, with η² = E/Z.
        let mean = self.0.multiply(inverse_root);
        let (Some(top), Some(most)) = (mean.top(), wave.rest.top()) else {
            return wave.with_error(Magnitude::ZERO, Magnitude::ZERO);
        };
        let bits = u64::try_from(most - top + 1).unwrap_or(0);
        // eγh is no more than 3γh.
        let stretch = passage.length.scale(cut.rate).multiply(&Magnitude::from_u64(3));
        let stretch = stretch.top().map_or(0, |top| 1 << top.clamp(0, LONGEST));
        let terms = bits.max(stretch).max(1);
        let error = mean.multiply(&Magnitude::from_u64(2 * terms + 1)).min(wave.error);
        wave.with_error(error, Magnitude::ZERO)
    }
}

impl Series {
    /// The fresh error of its values on a cell, its coefficients' radii included.
    pub fn fresh_on(&self, length: &Magnitude, bits: u64) -> Magnitude {
        let radii = self.coefficients.iter().rev().map(|c| match c.exact() {
            Some(_) => Magnitude::ZERO,
            None => c.split(bits).1,
        });
        radii
            .fold(Magnitude::ZERO, |sum, radius| sum.multiply(length).add(&radius))
            .add(&self.fresh)
    }
}
