//! Vectors of one double: single values, and machines without vectors that are known here.

use super::Simd;
use super::points::{MAX_STEP, Parts};
use crate::double_double::{fused_multiply_add, two_product};

/// One double. With `FUSED`, only to be used where the machine fuses multiply-adds: elsewhere
/// [`f64::mul_add`] is a slow call.
#[derive(Clone, Copy)]
pub(super) struct Scalar<const FUSED: bool>;

impl<const FUSED: bool> Simd for Scalar<FUSED> {
    type Values = f64;
    type Mask = bool;
    type Offsets = usize;
    const LANES: usize = 1;
    const MANY_REGISTERS: bool = true;

    #[inline(always)]
    fn splat(self, value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn load(self, values: &[f64]) -> f64 {
        values[0]
    }

    #[inline(always)]
    fn store(self, values: f64, out: &mut [f64]) {
        out[0] = values;
    }

    #[inline(always)]
    fn stream(self, values: f64, out: &mut [f64]) {
        out[0] = values;
    }

    #[inline(always)]
    fn fence(self) {}

    #[inline(always)]
    fn add(self, a: f64, b: f64) -> f64 {
        a + b
    }

    #[inline(always)]
    fn subtract(self, a: f64, b: f64) -> f64 {
        a - b
    }

    #[inline(always)]
    fn multiply(self, a: f64, b: f64) -> f64 {
        a * b
    }

    #[inline(always)]
    fn multiply_add(self, a: f64, b: f64, c: f64) -> f64 {
        if FUSED { a.mul_add(b, c) } else { a * b + c }
    }

    #[inline(always)]
    fn at_least(self, a: f64, b: f64) -> bool {
        a >= b
    }

    #[inline(always)]
    fn less(self, a: f64, b: f64) -> bool {
        a < b
    }

    #[inline(always)]
    fn equal(self, a: f64, b: f64) -> bool {
        a == b
    }

    #[inline(always)]
    fn both(self, a: bool, b: bool) -> bool {
        a && b
    }

    #[inline(always)]
    fn select(self, mask: bool, a: f64, b: f64) -> f64 {
        if mask { a } else { b }
    }

    #[inline(always)]
    fn bits(self, mask: bool) -> u32 {
        u32::from(mask)
    }

    #[inline(always)]
    fn offsets(self, values: f64, limit: usize) -> usize {
        (values as usize).min(limit - 1)
    }

    #[inline(always)]
    fn gather(self, values: &[f64], offsets: usize) -> f64 {
        values[offsets]
    }

    #[inline(always)]
    fn gather_integers(self, values: &[u32], offsets: usize) -> f64 {
        f64::from(values[offsets])
    }

    #[inline(always)]
    fn transpose(self, values: &[f64], offsets: usize, columns: &mut [f64]) {
        columns.copy_from_slice(&values[offsets..][..columns.len()]);
    }

    #[inline(always)]
    fn grid<const N: usize>(self, first: usize, from: f64, step: f64, _: &Parts) -> [f64; N] {
        // Steps that are hardly ever met go to the library, which rounds once, too.
        let mut times = [0.0; N];
        for (j, time) in times.iter_mut().enumerate() {
            let i = (first + j) as f64;
            *time = if FUSED || step.abs() > MAX_STEP {
                i.mul_add(step, from)
            } else {
                fused_multiply_add(i, step, from)
            };
        }
        times
    }

    #[inline(always)]
    fn two_product(self, a: f64, b: f64) -> (f64, f64) {
        if FUSED {
            let product = a * b;
            (product, a.mul_add(b, -product))
        } else {
            two_product(a, b)
        }
    }

    #[inline(always)]
    fn anchored_product(self, a: f64, b: f64, anchored: f64) -> (f64, f64) {
        let (product, error) = self.two_product(a, b);
        let sum = self.multiply_add(a, b, anchored);
        let kept = sum - anchored;
        let rest = if FUSED { a.mul_add(b, -kept) } else { (product - kept) + error };
        (sum, rest)
    }
}
