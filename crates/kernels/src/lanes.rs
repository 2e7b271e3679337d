//! Eight doubles that take the same operations: one register of the widest machines, two or four of
//! others.
//!
//! The count is the same everywhere, so that sums of lanes have the same terms in the same order on every
//! machine; only what is [fused](Lanes::fused) is rounded twice where there is no instruction for it.
//! Work in lanes is inlined whole into a function that is compiled for the registers: it has loops where
//! others have closures, which compilers may leave outside. Loops over arrays of doubles would do the
//! same, but compilers unroll them before they look for vectors.
//!
//! Tables are evaluated in the vectors themselves, as long as the registers are: their values do not
//! depend on how many points go together, and memory is their limit.

use std::ops::{Add, Mul, Neg, Sub};

/// How many doubles lie side by side.
pub(crate) const WIDTH: usize = 8;

/// Eight doubles side by side. Each operation is that of doubles, lane by lane.
pub(crate) trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// How many of them are worked on at once where steps wait for each other and nothing else: as
    /// many as leave registers for what a step needs.
    const IN_FLIGHT: usize;

    fn splat(value: f64) -> Self;
    fn from_array(array: [f64; WIDTH]) -> Self;
    fn to_array(self) -> [f64; WIDTH];

    /// The lesser of each two.
    fn lesser(self, other: Self) -> Self;
    /// The greater of each two.
    fn greater(self, other: Self) -> Self;
    /// Absolute values.
    fn abs(self) -> Self;

    /// `self · factor + addend`, rounded once where the machine has the instruction, else twice.
    fn fused(self, factor: Self, addend: Self) -> Self;
    /// The product and its rounding, without error.
    fn product(self, factor: Self) -> (Self, Self);
    /// The sum and its rounding, without error.
    fn two_sum(self, other: Self) -> (Self, Self);

    /// `1/x` to at least 13 bits for `10^−30 ≤ |x| ≤ 10^30`; where `|x|` is smaller, at most `1.01 · 10^30`.
    fn rough_reciprocal(self) -> Self;
    /// `self · 2^n`, where `n` stands in the last bits of `shifted`, added to `1.5 · 2^52`, and both
    /// `2^n` and the result are normal.
    fn times_power(self, shifted: Self) -> Self;

    /// The lanes in which another number is positive, and 0 in the others.
    fn where_positive(self, other: Self) -> Self;
    /// The lanes in which another number is positive or 0, and 0 in the others.
    fn where_not_negative(self, other: Self) -> Self;

    /// The first eight of some doubles, of which there are as many.
    #[inline(always)]
    fn load(values: &[f64]) -> Self {
        Self::from_array(*values.first_chunk().expect("there are eight"))
    }

    /// The sum of all lanes, pair by pair.
    #[inline(always)]
    fn sum(self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.to_array();
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }
}

/// Fewer than eight doubles, filled up with zeros.
#[inline(always)]
pub(crate) fn padded(rest: &[f64]) -> [f64; WIDTH] {
    let mut lanes = [0.0; WIDTH];
    lanes[..rest.len()].copy_from_slice(rest);
    lanes
}
