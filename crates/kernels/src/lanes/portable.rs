//! Eight doubles in an array, for any machine.

use super::{Lanes, WIDTH};
use crate::double_double::SPLITTER;
use std::array::from_fn;
use std::ops::{Add, Mul, Neg, Sub};

/// What a machine without registers of its own here takes: a fused operation is an instruction only where
/// the target has it from the start.
#[cfg(not(target_arch = "x86_64"))]
pub(super) type Native = Portable<{ cfg!(target_arch = "aarch64") }>;

/// Eight doubles in an array. `FUSED` says whether the machine multiplies and adds with one rounding;
/// where it does not, that operation would be a call of a library.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable<const FUSED: bool>([f64; WIDTH]);

impl<const FUSED: bool> Lanes for Portable<FUSED> {
    const IN_FLIGHT: usize = 1;

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
    fn abs(self) -> Self {
        Portable(self.0.map(f64::abs))
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
            let large = lanes * Self::splat(SPLITTER);
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
    fn where_positive(self, other: Self, or_zero: bool) -> Self {
        let counts = |number: f64| number > 0.0 || (or_zero && number == 0.0);
        Portable(from_fn(|i| if counts(other.0[i]) { self.0[i] } else { 0.0 }))
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
