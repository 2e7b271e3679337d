//! Vectors of one double, for machines whose vector instructions are not used here.

use super::Simd;
use super::eight::Eight;
use crate::double_double::two_product;

/// One double. With `FUSED`, only to be used where the machine fuses multiply-adds: elsewhere
/// [`f64::mul_add`] is a slow call.
#[derive(Clone, Copy)]
pub(crate) struct Scalar<const FUSED: bool>;

/// Methods that need no more than a line.
macro_rules! methods {
    ($($name:ident($($argument:ident: $kind:ty),*) -> $result:ty { $value:expr })*) => {$(
        #[inline(always)]
        fn $name(self, $($argument: $kind),*) -> $result {
            $value
        }
    )*};
}

impl<const FUSED: bool> Simd for Scalar<FUSED> {
    type Values = f64;
    type Mask = bool;
    type Offsets = usize;
    type Eight = Eight<Self, 8>;
    const HERE: Self = Scalar;
    const LANES: usize = 1;
    const MANY_REGISTERS: bool = true;
    const EIGHTS_IN_FLIGHT: usize = 1;

    methods! {
        splat(value: f64) -> f64 { value }
        load(values: &[f64]) -> f64 { values[0] }
        store(values: f64, out: &mut [f64]) -> () { out[0] = values }
        stream(values: f64, out: &mut [f64]) -> () { out[0] = values }
        fence() -> () { () }
        add(a: f64, b: f64) -> f64 { a + b }
        subtract(a: f64, b: f64) -> f64 { a - b }
        multiply(a: f64, b: f64) -> f64 { a * b }
        divide(a: f64, b: f64) -> f64 { a / b }
        lesser(a: f64, b: f64) -> f64 { if a < b { a } else { b } }
        greater(a: f64, b: f64) -> f64 { if a > b { a } else { b } }
        abs(a: f64) -> f64 { a.abs() }
        multiply_add(a: f64, b: f64, c: f64) -> f64 { if FUSED { a.mul_add(b, c) } else { a * b + c } }
        at_least(a: f64, b: f64) -> bool { a >= b }
        less(a: f64, b: f64) -> bool { a < b }
        equal(a: f64, b: f64) -> bool { a == b }
        both(a: bool, b: bool) -> bool { a && b }
        select(mask: bool, a: f64, b: f64) -> f64 { if mask { a } else { b } }
        bits(mask: bool) -> u32 { u32::from(mask) }
        offsets(values: f64, limit: usize) -> usize { (values as usize).min(limit - 1) }
        gather(values: &[f64], offsets: usize) -> f64 { values[offsets] }
        gather_integers(values: &[u32], offsets: usize) -> f64 { f64::from(values[offsets]) }
    }

    #[inline(always)]
    fn times_power(self, a: f64, shifted: f64) -> f64 {
        a * f64::from_bits((shifted.to_bits() << 52).wrapping_add(1023 << 52))
    }

    #[inline(always)]
    fn transpose(self, values: &[f64], offsets: usize, columns: &mut [f64]) {
        columns.copy_from_slice(&values[offsets..][..columns.len()]);
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
