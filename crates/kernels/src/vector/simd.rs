//! The operations of vectors of doubles, and tasks written in them.

use crate::lanes::Lanes;

/// The operations of a vector of doubles.
///
/// Code that is generic over implementing types runs where the machine has their instructions: only
/// [`dispatch`](super::dispatch) can name the types. All methods are inlined into functions that enable
/// the instructions.
pub(crate) trait Simd: Copy {
    /// A vector of doubles.
    type Values: Copy;
    /// A truth value for every lane.
    type Mask: Copy;
    /// Checked indices.
    type Offsets: Copy;
    /// Eight doubles in such vectors.
    type Eight: Lanes;
    /// The value of the type.
    const HERE: Self;
    /// Doubles a vector, at most 8.
    const LANES: usize;
    /// Whether there are 32 vector registers, not 16.
    const MANY_REGISTERS: bool;
    /// How many [`Eight`](Self::Eight)s leave registers for what a step needs.
    const EIGHTS_IN_FLIGHT: usize;

    /// The same double in all lanes.
    fn splat(self, value: f64) -> Self::Values;
    /// The first doubles of a slice that has `LANES` at least.
    fn load(self, values: &[f64]) -> Self::Values;
    /// Writes the first doubles of a slice that has `LANES` at least.
    fn store(self, values: Self::Values, out: &mut [f64]);
    /// Like [`store`](Self::store), past the caches where `out` is aligned to a vector.
    fn stream(self, values: Self::Values, out: &mut [f64]);
    /// Makes streamed doubles visible to other threads. Due before a function that streams returns.
    fn fence(self);
    fn add(self, a: Self::Values, b: Self::Values) -> Self::Values;
    fn subtract(self, a: Self::Values, b: Self::Values) -> Self::Values;
    fn multiply(self, a: Self::Values, b: Self::Values) -> Self::Values;
    fn divide(self, a: Self::Values, b: Self::Values) -> Self::Values;
    /// `a` where `a < b`, else `b`.
    fn lesser(self, a: Self::Values, b: Self::Values) -> Self::Values;
    /// `a` where `a > b`, else `b`.
    fn greater(self, a: Self::Values, b: Self::Values) -> Self::Values;
    fn abs(self, a: Self::Values) -> Self::Values;
    /// `a · 2^n`, where `n` stands in the last bits of `shifted`.
    fn times_power(self, a: Self::Values, shifted: Self::Values) -> Self::Values;
    /// `a b + c`, rounded once above the baseline, else twice.
    fn multiply_add(self, a: Self::Values, b: Self::Values, c: Self::Values) -> Self::Values;
    /// `a ≥ b`, false with NaN.
    fn at_least(self, a: Self::Values, b: Self::Values) -> Self::Mask;
    /// `a < b`, false with NaN.
    fn less(self, a: Self::Values, b: Self::Values) -> Self::Mask;
    /// `a = b`, false with NaN.
    fn equal(self, a: Self::Values, b: Self::Values) -> Self::Mask;
    fn both(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `a` where the mask is set, else `b`.
    fn select(self, mask: Self::Mask, a: Self::Values, b: Self::Values) -> Self::Values;
    /// One bit a lane, the first lane lowest.
    fn bits(self, mask: Self::Mask) -> u32;
    /// Truncated to integers within `0 … limit − 1`, clamped; NaN becomes 0. `1 ≤ limit < 2³¹`.
    fn offsets(self, values: Self::Values, limit: usize) -> Self::Offsets;
    /// The doubles at offsets whose limit is the length of the slice at most.
    fn gather(self, values: &[f64], offsets: Self::Offsets) -> Self::Values;
    /// Integers below `2³¹` in the same way, as doubles.
    fn gather_integers(self, values: &[u32], offsets: Self::Offsets) -> Self::Values;
    /// `columns[c]` gets the doubles at offset + c, one a lane. The number of columns is a multiple
    /// of 8; it and an offset together are not beyond the slice.
    fn transpose(self, values: &[f64], offsets: Self::Offsets, columns: &mut [Self::Values]);
    /// `1/a` to at least 13 bits for `10^−30 ≤ |a| ≤ 10^30`, 0 where `|a|` is smaller.
    #[inline(always)]
    fn rough_reciprocal(self, a: Self::Values) -> Self::Values {
        let away = self.at_least(self.abs(a), self.splat(1e-30));
        self.select(away, self.divide(self.splat(1.0), a), self.splat(0.0))
    }

    /// Clamped to `0 … limit − 1`; NaN becomes 0.
    #[inline(always)]
    fn clamped(self, values: Self::Values, limit: usize) -> Self::Values {
        assert!(limit >= 1 && limit <= i32::MAX as usize);
        // The greater of NaN and a second operand is the second operand.
        let low = self.greater(values, self.splat(0.0));
        self.lesser(low, self.splat((limit - 1) as f64))
    }

    /// Whether the mask is set in all lanes.
    #[inline(always)]
    fn all(self, mask: Self::Mask) -> bool {
        self.bits(mask) == (1 << Self::LANES) - 1
    }

    /// `(s, e)` with `s + e = a + b` exactly, as [`two_sum`](crate::double_double::two_sum).
    #[inline(always)]
    fn two_sum(self, a: Self::Values, b: Self::Values) -> (Self::Values, Self::Values) {
        let sum = self.add(a, b);
        let from_a = self.subtract(sum, b);
        let from_b = self.subtract(sum, from_a);
        (sum, self.add(self.subtract(a, from_a), self.subtract(b, from_b)))
    }

    /// `(p, e)` with `p + e = a b` exactly, as [`two_product`](crate::double_double::two_product).
    fn two_product(self, a: Self::Values, b: Self::Values) -> (Self::Values, Self::Values);

    /// `(t, r)` with `t` the sum `a b + anchored`, rounded to the grid of an anchor, and `r` the
    /// part of `a b` that this leaves, rounded, see `bounds`.
    #[inline(always)]
    fn anchored_product(
        self,
        a: Self::Values,
        b: Self::Values,
        anchored: Self::Values,
    ) -> (Self::Values, Self::Values) {
        let (product, error) = self.two_product(a, b);
        let sum = self.add(product, anchored);
        let kept = self.subtract(sum, anchored);
        (sum, self.add(self.subtract(product, kept), error))
    }
}

/// A computation for whatever vectors there are.
pub(crate) trait Task {
    /// What it returns.
    type Output;

    /// Runs it. Implementations are inlined.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}
