//! Eight doubles that take the same operations: one register of the widest machines, two or four of
//! others. What echoes ask of them is a trait, and here is its version for any machine.

use super::delay::counts;
use std::array::from_fn;
use std::ops::{Add, Mul, Neg, Sub};

/// How many doubles lie side by side.
pub(super) const WIDTH: usize = 8;

/// Eight doubles side by side. Each operation is that of doubles, lane by lane.
pub(super) trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    fn splat(value: f64) -> Self;
    fn from_array(array: [f64; WIDTH]) -> Self;
    fn to_array(self) -> [f64; WIDTH];

    /// The lesser of each two.
    fn lesser(self, other: Self) -> Self;
    /// The greater of each two.
    fn greater(self, other: Self) -> Self;

    /// `self · factor + addend`, rounded once where the machine has the instruction, else twice.
    fn fused(self, factor: Self, addend: Self) -> Self;

    /// The product and its rounding, without error.
    #[inline(always)]
    fn product(self, factor: Self) -> (Self, Self) {
        let product = self * factor;
        (product, self.fused(factor, -product))
    }

    /// The sum and its rounding, without error.
    #[inline(always)]
    fn two_sum(self, other: Self) -> (Self, Self) {
        let sum = self + other;
        let part = sum - self;
        (sum, (self - (sum - part)) + (other - part))
    }

    /// `1/x` to at least 13 bits for `10^−30 ≤ |x| ≤ 10^30`; where `|x|` is smaller, at most `10^30`.
    fn rough_reciprocal(self) -> Self;

    /// `self · 2^n`, where `n` stands in the last bits of `shifted`, added to `1.5 · 2^52`, and both
    /// `2^n` and the result are normal.
    fn times_power(self, shifted: Self) -> Self;

    /// The lanes in which an echo counts that arrived `since` ago, and 0 in the others.
    fn where_counted(self, since: Self, include_arriving: bool) -> Self;
}

/// Eight doubles in an array. `FUSED` says whether the machine multiplies and adds with one rounding;
/// where it does not, that operation would be a call of a library.
#[derive(Clone, Copy, Debug)]
pub(super) struct Portable<const FUSED: bool>([f64; WIDTH]);

impl<const FUSED: bool> Lanes for Portable<FUSED> {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Portable([value; WIDTH])
    }

    #[inline(always)]
    fn from_array(array: [f64; WIDTH]) -> Self {
        Portable(array)
    }

    #[inline(always)]
    fn to_array(self) -> [f64; WIDTH] {
        self.0
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        Portable(from_fn(|i| if self.0[i] < other.0[i] { self.0[i] } else { other.0[i] }))
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        Portable(from_fn(|i| if self.0[i] > other.0[i] { self.0[i] } else { other.0[i] }))
    }

    #[inline(always)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        match FUSED {
            true => Portable(from_fn(|i| self.0[i].mul_add(factor.0[i], addend.0[i]))),
            false => self * factor + addend,
        }
    }

    /// Without the fused operation, by Veltkamp's splitting and Dekker's product.
    #[inline(always)]
    fn product(self, factor: Self) -> (Self, Self) {
        let product = self * factor;
        if FUSED {
            return (product, self.fused(factor, -product));
        }
        let split = |lanes: Self| {
            let large = lanes * Self::splat(134217729.0);
            let head = large - (large - lanes);
            (head, lanes - head)
        };
        let ((a, b), (c, d)) = (split(self), split(factor));
        (product, ((a * c - product) + a * d + b * c) + b * d)
    }

    #[inline(always)]
    fn rough_reciprocal(self) -> Self {
        Portable(self.0.map(|value| {
            let away = if value.abs() < 1e-30 { 1e-30 } else { value };
            f64::from(1.0 / (away as f32))
        }))
    }

    #[inline(always)]
    fn times_power(self, shifted: Self) -> Self {
        let power = |bits: u64| f64::from_bits((bits << 52).wrapping_add(1023 << 52));
        Portable(from_fn(|i| self.0[i] * power(shifted.0[i].to_bits())))
    }

    #[inline(always)]
    fn where_counted(self, since: Self, include_arriving: bool) -> Self {
        let kept = |i: usize| if counts(since.0[i], include_arriving) { self.0[i] } else { 0.0 };
        Portable(from_fn(kept))
    }
}

macro_rules! lane_by_lane {
    ($operation:ident, $name:ident, $sign:tt) => {
        impl<const FUSED: bool> $operation for Portable<FUSED> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Portable(from_fn(|i| self.0[i] $sign other.0[i]))
            }
        }
    };
}
lane_by_lane!(Add, add, +);
lane_by_lane!(Sub, sub, -);
lane_by_lane!(Mul, mul, *);

impl<const FUSED: bool> Neg for Portable<FUSED> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Portable(self.0.map(|value| -value))
    }
}
