//! Numbers that are not doubles, as unevaluated sums of three doubles. A period such as `2μ` with
//! `μ = 1/3` is kept to some 159 bits, so that the time since an echo arrived loses nothing.

use super::error::EchoError;
use crate::double_double::{DoubleDouble, fast_two_sum, two_product, two_sum};
use crate::exponent::split;
use std::cmp::Ordering;

/// The sum `a + b + c` of three doubles, never evaluated.
///
/// # Invariants
/// - the parts are finite, and each is at most half an ulp of the one before;
/// - a part that is zero is followed by zeros only.
///
/// A real number is kept with a relative error of at most `2^−158`; a number with at most 159 bits,
/// exactly, unless something underflows.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Expansion([f64; 3]);

impl Expansion {
    /// Zero.
    pub const ZERO: Expansion = Expansion([0.0; 3]);
    /// One.
    pub const ONE: Expansion = Expansion([1.0, 0.0, 0.0]);

    /// The sum of three doubles in any order; constant cost.
    pub fn new(parts: [f64; 3]) -> Result<Expansion, EchoError> {
        let sum = Expansion::sum(parts);
        if sum.0.iter().all(|part| part.is_finite()) { Ok(sum) } else { Err(EchoError::NotFinite) }
    }

    /// The three doubles, the largest first.
    pub fn parts(self) -> [f64; 3] {
        self.0
    }

    /// The three leading parts of a sum that is formed without error: each pass of [`two_sum`] over
    /// the doubles leaves their sum as it is and carries what is large to the front.
    fn sum<const N: usize>(mut doubles: [f64; N]) -> Expansion {
        for first in 0..N - 1 {
            for i in (first + 1..N).rev() {
                (doubles[i - 1], doubles[i]) = two_sum(doubles[i - 1], doubles[i]);
            }
        }
        let mut parts = [0.0; 3];
        let (mut place, mut carried) = (0, doubles[0]);
        for &double in &doubles[1..] {
            let (high, low) = fast_two_sum(carried, double);
            if low == 0.0 {
                carried = high;
            } else if place < 2 {
                parts[place] = high;
                (place, carried) = (place + 1, low);
            } else {
                carried = high;
                break;
            }
        }
        parts[place] = carried;
        Expansion(parts)
    }

    /// `factor` times the number, with a relative error of at most `2^−158`, and without any where
    /// the product fits in three doubles: all six partial products are exact.
    pub(super) fn times(self, factor: f64) -> Expansion {
        let [a, b, c] = self.0.map(|part| two_product(part, factor));
        Expansion::sum([a.0, b.0, a.1, c.0, b.1, c.1])
    }

    /// The sum, with a relative error of at most `2^−158`, and exact where it fits.
    pub(super) fn plus(self, other: Expansion) -> Expansion {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Expansion::sum([a, d, b, e, c, f])
    }

    /// The two leading parts: relative error at most `2^−105`.
    pub(super) fn pair(self) -> DoubleDouble {
        DoubleDouble { high: self.0[0], low: self.0[1] }
    }

    pub(super) fn high(self) -> f64 {
        self.0[0]
    }

    pub(super) fn is_positive(self) -> bool {
        self.0[0].partial_cmp(&0.0) == Some(Ordering::Greater)
    }

    /// Whether all parts are so far inside the range of doubles that products stay exact.
    pub(super) fn is_moderate(self) -> bool {
        let exponent = split(self.0[0]).1;
        self.0[0] == 0.0 || exponent.abs() <= 200
    }
}

impl TryFrom<f64> for Expansion {
    type Error = EchoError;

    fn try_from(double: f64) -> Result<Expansion, EchoError> {
        Expansion::new([double, 0.0, 0.0])
    }
}
