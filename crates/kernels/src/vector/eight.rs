//! Lanes in vectors of any length.

use super::Simd;
use crate::lanes::{Lanes, WIDTH};
use std::ops::{Add, Mul, Neg, Sub};

/// Eight doubles in `N` vectors.
#[derive(Clone, Copy)]
pub(crate) struct Eight<S: Simd, const N: usize>([S::Values; N]);

/// Functions of lanes that are those of vectors, one after the other.
macro_rules! vector_by_vector {
    ($($name:ident($($other:ident),*) is $of_vectors:ident;)*) => {$(
        #[inline(always)]
        fn $name(mut self, $($other: Self),*) -> Self {
            for i in 0..N {
                self.0[i] = S::HERE.$of_vectors(self.0[i], $($other.0[i]),*);
            }
            self
        }
    )*};
}

/// The same with two results.
macro_rules! with_rest {
    ($($name:ident is $of_vectors:ident;)*) => {$(
        #[inline(always)]
        fn $name(mut self, mut other: Self) -> (Self, Self) {
            for i in 0..N {
                (self.0[i], other.0[i]) = S::HERE.$of_vectors(self.0[i], other.0[i]);
            }
            (self, other)
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
        lesser(other) is lesser;
        greater(other) is greater;
        abs() is abs;
        rough_reciprocal() is rough_reciprocal;
        times_power(shifted) is times_power;
        fused(factor, addend) is multiply_add;
    }

    with_rest! {
        product is two_product;
        two_sum is two_sum;
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

            vector_by_vector! { $name(other) is $instruction; }
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
