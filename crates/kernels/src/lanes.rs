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

use crate::Level;
use crate::vector::{Simd, Task, dispatch};
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

/// Eight doubles in `N` vectors.
#[derive(Clone, Copy)]
pub(crate) struct Eight<S: Simd, const N: usize>([S::Values; N]);

/// Functions of lanes that are those of vectors, one after the other.
macro_rules! vector_by_vector {
    ($($name:ident($($other:ident),*);)*) => {$(
        #[inline(always)]
        fn $name(mut self, $($other: Self),*) -> Self {
            for i in 0..N {
                self.0[i] = S::HERE.$name(self.0[i], $($other.0[i]),*);
            }
            self
        }
    )*};
}

impl<S: Simd, const N: usize> Lanes for Eight<S, N> {
    const IN_FLIGHT: usize = S::EIGHTS_IN_FLIGHT;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Eight([S::HERE.splat(value); N])
    }

    #[inline(always)]
    fn from_array(array: [f64; WIDTH]) -> Self {
        let mut vectors = [S::HERE.splat(0.0); N];
        for i in 0..N {
            vectors[i] = S::HERE.load(&array[i * S::LANES..]);
        }
        Eight(vectors)
    }

    #[inline(always)]
    fn to_array(self) -> [f64; WIDTH] {
        let mut array = [0.0; WIDTH];
        for i in 0..N {
            S::HERE.store(self.0[i], &mut array[i * S::LANES..]);
        }
        array
    }

    vector_by_vector! {
        lesser(other);
        greater(other);
        abs();
        rough_reciprocal();
        times_power(shifted);
    }

    #[inline(always)]
    fn fused(mut self, factor: Self, addend: Self) -> Self {
        for i in 0..N {
            self.0[i] = S::HERE.multiply_add(self.0[i], factor.0[i], addend.0[i]);
        }
        self
    }

    #[inline(always)]
    fn product(mut self, mut factor: Self) -> (Self, Self) {
        for i in 0..N {
            (self.0[i], factor.0[i]) = S::HERE.two_product(self.0[i], factor.0[i]);
        }
        (self, factor)
    }

    #[inline(always)]
    fn two_sum(mut self, mut other: Self) -> (Self, Self) {
        for i in 0..N {
            (self.0[i], other.0[i]) = S::HERE.two_sum(self.0[i], other.0[i]);
        }
        (self, other)
    }

    #[inline(always)]
    fn where_positive(mut self, other: Self) -> Self {
        let zero = S::HERE.splat(0.0);
        for i in 0..N {
            let positive = S::HERE.less(zero, other.0[i]);
            self.0[i] = S::HERE.select(positive, self.0[i], zero);
        }
        self
    }

    #[inline(always)]
    fn where_not_negative(mut self, other: Self) -> Self {
        let zero = S::HERE.splat(0.0);
        for i in 0..N {
            let counts = S::HERE.at_least(other.0[i], zero);
            self.0[i] = S::HERE.select(counts, self.0[i], zero);
        }
        self
    }
}

macro_rules! operator {
    ($operator:ident, $name:ident, $instruction:ident) => {
        impl<S: Simd, const N: usize> $operator for Eight<S, N> {
            type Output = Self;

            #[inline(always)]
            fn $name(mut self, other: Self) -> Self {
                for i in 0..N {
                    self.0[i] = S::HERE.$instruction(self.0[i], other.0[i]);
                }
                self
            }
        }
    };
}
operator!(Add, add, add);
operator!(Sub, sub, subtract);
operator!(Mul, mul, multiply);

impl<S: Simd, const N: usize> Neg for Eight<S, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::splat(-0.0) - self
    }
}

/// Work that is written in lanes.
pub(crate) trait Work {
    /// What it gives.
    type Output;

    /// Does it. Implementations are inlined, and so is what they call.
    fn run<L: Lanes>(self) -> Self::Output;
}

/// Work in lanes as a task for vectors.
struct InLanes<W>(W);

impl<W: Work> Task for InLanes<W> {
    type Output = W::Output;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> W::Output {
        self.0.run::<S::Eight>()
    }
}

/// Does work with the widest registers that the machine has.
pub(crate) fn widest<W: Work>(work: W) -> W::Output {
    // Every such machine fuses multiply-adds.
    #[cfg(target_arch = "aarch64")]
    return work.run::<Eight<crate::vector::Scalar<true>, WIDTH>>();
    #[cfg(not(target_arch = "aarch64"))]
    dispatch(Level::Avx512, InLanes(work))
}

/// Fewer than eight doubles, filled up with zeros.
#[inline(always)]
pub(crate) fn padded(rest: &[f64]) -> [f64; WIDTH] {
    let mut lanes = [0.0; WIDTH];
    lanes[..rest.len()].copy_from_slice(rest);
    lanes
}

/// Eight doubles one by one, for tests that need no machine.
#[cfg(test)]
pub(crate) type OneByOne<const FUSED: bool> = Eight<crate::vector::Scalar<FUSED>, WIDTH>;

/// Does work in every way that this machine has, the plainest first.
#[cfg(test)]
pub(crate) fn each_way<W: Work + Clone>(work: &W) -> Vec<W::Output> {
    let one_by_one = [work.clone().run::<OneByOne<false>>(), work.clone().run::<OneByOne<true>>()];
    let levels = Level::available().map(|level| dispatch(level, InLanes(work.clone())));
    one_by_one.into_iter().chain(levels).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All operations, on numbers of all kinds of sizes.
    #[derive(Clone)]
    struct Operations;

    impl Work for Operations {
        type Output = Vec<[f64; WIDTH]>;

        fn run<L: Lanes>(self) -> Self::Output {
            let a = L::from_array([1.5, -2.25, 0.0, 1e-40, 3.0, -0.0, 7e30, 0.1]);
            let b = L::from_array([0.3, 2.0, -1.0, 5.0, -3.0, 0.0, 1e-20, 11.0]);
            let exponents = L::from_array([-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 40.0]);
            let (sum, rest) = a.two_sum(b);
            let (product, error) = a.product(b);
            [
                a + b,
                a - b,
                a * b,
                -a,
                a.abs(),
                L::splat(0.0).abs(),
                a.lesser(b),
                a.greater(b),
                a.where_positive(b),
                a.where_not_negative(b),
                a.times_power(exponents + L::splat(6755399441055744.0)),
                sum,
                rest,
                product,
                error,
                L::splat(a.sum()),
                L::load(&b.to_array()),
            ]
            .map(L::to_array)
            .to_vec()
        }
    }

    #[test]
    fn all_ways_give_the_same_doubles() {
        let ways = each_way(&Operations);
        let bits = |way: &[[f64; WIDTH]]| -> Vec<_> {
            way.as_flattened().iter().map(|value| value.to_bits()).collect()
        };
        for way in &ways {
            assert_eq!(bits(way), bits(&ways[0]));
        }
        let [sum, rest, product, error] = [11, 12, 13, 14].map(|row| ways[0][row]);
        assert_eq!((sum[3], rest[3]), (5.0, 1e-40));
        assert_eq!((product[0], error[0]), (1.5 * 0.3, 1.5_f64.mul_add(0.3, -(1.5 * 0.3))));
        println!("{} ways", ways.len());
    }

    /// Reciprocals are rough, but as good as is said, and never large.
    #[derive(Clone)]
    struct Reciprocals([f64; WIDTH]);

    impl Work for Reciprocals {
        type Output = [f64; WIDTH];

        fn run<L: Lanes>(self) -> Self::Output {
            L::from_array(self.0).rough_reciprocal().to_array()
        }
    }

    #[test]
    fn reciprocals_have_thirteen_bits() {
        let values = [1.0, -3.0, 1e-20, 7e25, 0.3, -1e-29, 0.0, 1e-300];
        for way in each_way(&Reciprocals(values)) {
            for (value, found) in values.iter().zip(way) {
                let fine = (value * found - 1.0).abs() < 2f64.powi(-13);
                assert!(
                    fine || (value.abs() < 1e-30 && found.abs() <= 1.01e30),
                    "{value}: {found}"
                );
            }
        }
    }
}
