//! Lanes in vectors of any length.

use super::Simd;
use crate::lanes::{Lanes, WIDTH};
use std::ops::{Add, Mul, Neg, Sub};

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
