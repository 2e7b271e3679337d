//! Registers of the x86 family, and the choice of the widest at run time.
//!
//! SAFETY of all blocks with instructions: values of [`Wide`] and [`Halves`] are made and used only in
//! work that the functions below run, which are compiled for these instructions and called where the
//! machine has them. Pointers come from arrays of eight doubles.
#![allow(unsafe_code)]

use super::portable::Portable;
use super::{Lanes, WIDTH, Work};
use crate::Level;
use std::arch::x86_64::*;
use std::ops::{Add, Mul, Neg, Sub};

/// Does work with the widest registers that the machine has.
pub(super) fn widest<W: Work>(work: W) -> W::Output {
    match Level::best() {
        // SAFETY: the level is available: the machine has AVX-512F, AVX2 and fused multiply-add.
        Level::Avx512 => unsafe { with_avx512(work) },
        // SAFETY: the level is available: the machine has AVX2 and fused multiply-add.
        Level::Avx2 => unsafe { with_avx2(work) },
        Level::Baseline => work.run::<Portable<false>>(),
    }
}

#[target_feature(enable = "avx512f,avx2,fma")]
fn with_avx512<W: Work>(work: W) -> W::Output {
    work.run::<Wide>()
}

#[target_feature(enable = "avx2,fma")]
fn with_avx2<W: Work>(work: W) -> W::Output {
    work.run::<Halves>()
}

/// Appends what the registers of this machine give.
#[cfg(test)]
pub(super) fn each_way<W: Work + Clone>(work: &W, outputs: &mut Vec<W::Output>) {
    if Level::Avx2.is_available() {
        // SAFETY: the line above has asked for what the function is compiled for.
        outputs.push(unsafe { with_avx2(work.clone()) });
    }
    if Level::Avx512.is_available() {
        // SAFETY: as above.
        outputs.push(unsafe { with_avx512(work.clone()) });
    }
}

/// One register of eight doubles.
#[derive(Clone, Copy)]
pub(super) struct Wide(__m512d);

/// Two registers of four doubles.
#[derive(Clone, Copy)]
pub(super) struct Halves(__m256d, __m256d);

impl Lanes for Wide {
    const IN_FLIGHT: usize = 8;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Wide(unsafe { _mm512_set1_pd(value) })
    }

    #[inline(always)]
    fn from_array(array: [f64; WIDTH]) -> Self {
        Wide(unsafe { _mm512_loadu_pd(array.as_ptr()) })
    }

    #[inline(always)]
    fn to_array(self) -> [f64; WIDTH] {
        let mut array = [0.0; WIDTH];
        unsafe { _mm512_storeu_pd(array.as_mut_ptr(), self.0) };
        array
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        Wide(unsafe { _mm512_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        Wide(unsafe { _mm512_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        Wide(unsafe { _mm512_fmadd_pd(self.0, factor.0, addend.0) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Wide(unsafe { _mm512_abs_pd(self.0) })
    }

    #[inline(always)]
    fn rough_reciprocal(self) -> Self {
        Wide(unsafe {
            let size = _mm512_abs_pd(self.0);
            let away = _mm512_cmp_pd_mask::<_CMP_GE_OQ>(size, _mm512_set1_pd(1e-30));
            _mm512_maskz_rcp14_pd(away, self.0)
        })
    }

    #[inline(always)]
    fn times_power(self, shifted: Self) -> Self {
        Wide(unsafe {
            let exponent = _mm512_slli_epi64::<52>(_mm512_castpd_si512(shifted.0));
            let power = _mm512_add_epi64(exponent, _mm512_set1_epi64(1023 << 52));
            _mm512_mul_pd(self.0, _mm512_castsi512_pd(power))
        })
    }

    #[inline(always)]
    fn where_positive(self, other: Self, or_zero: bool) -> Self {
        Wide(unsafe {
            let zero = _mm512_setzero_pd();
            let counts = match or_zero {
                true => _mm512_cmp_pd_mask::<_CMP_GE_OQ>(other.0, zero),
                false => _mm512_cmp_pd_mask::<_CMP_GT_OQ>(other.0, zero),
            };
            _mm512_maskz_mov_pd(counts, self.0)
        })
    }
}

impl Lanes for Halves {
    const IN_FLIGHT: usize = 2;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        let half = unsafe { _mm256_set1_pd(value) };
        Halves(half, half)
    }

    #[inline(always)]
    fn from_array(array: [f64; WIDTH]) -> Self {
        let (low, high) = array.split_at(WIDTH / 2);
        unsafe { Halves(_mm256_loadu_pd(low.as_ptr()), _mm256_loadu_pd(high.as_ptr())) }
    }

    #[inline(always)]
    fn to_array(self) -> [f64; WIDTH] {
        let mut array = [0.0; WIDTH];
        let (low, high) = array.split_at_mut(WIDTH / 2);
        unsafe {
            _mm256_storeu_pd(low.as_mut_ptr(), self.0);
            _mm256_storeu_pd(high.as_mut_ptr(), self.1);
        }
        array
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        unsafe { Halves(_mm256_min_pd(self.0, other.0), _mm256_min_pd(self.1, other.1)) }
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        unsafe { Halves(_mm256_max_pd(self.0, other.0), _mm256_max_pd(self.1, other.1)) }
    }

    #[inline(always)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        unsafe {
            let low = _mm256_fmadd_pd(self.0, factor.0, addend.0);
            Halves(low, _mm256_fmadd_pd(self.1, factor.1, addend.1))
        }
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.each(|half| unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), half) })
    }

    #[inline(always)]
    fn rough_reciprocal(self) -> Self {
        self.each(|half| unsafe {
            let size = _mm256_andnot_pd(_mm256_set1_pd(-0.0), half);
            let away = _mm256_cmp_pd::<_CMP_GE_OQ>(size, _mm256_set1_pd(1e-30));
            _mm256_and_pd(away, _mm256_div_pd(_mm256_set1_pd(1.0), half))
        })
    }

    #[inline(always)]
    fn times_power(self, shifted: Self) -> Self {
        let power = shifted.each(|half| unsafe {
            let exponent = _mm256_slli_epi64::<52>(_mm256_castpd_si256(half));
            _mm256_castsi256_pd(_mm256_add_epi64(exponent, _mm256_set1_epi64x(1023 << 52)))
        });
        self * power
    }

    #[inline(always)]
    fn where_positive(self, other: Self, or_zero: bool) -> Self {
        let counts = other.each(|half| unsafe {
            match or_zero {
                true => _mm256_cmp_pd::<_CMP_GE_OQ>(half, _mm256_setzero_pd()),
                false => _mm256_cmp_pd::<_CMP_GT_OQ>(half, _mm256_setzero_pd()),
            }
        });
        unsafe { Halves(_mm256_and_pd(counts.0, self.0), _mm256_and_pd(counts.1, self.1)) }
    }
}

impl Halves {
    #[inline(always)]
    fn each(self, operation: impl Fn(__m256d) -> __m256d) -> Self {
        Halves(operation(self.0), operation(self.1))
    }
}

macro_rules! lane_by_lane {
    ($operation:ident, $name:ident, $wide:ident, $half:ident) => {
        impl $operation for Wide {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Wide(unsafe { $wide(self.0, other.0) })
            }
        }

        impl $operation for Halves {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                unsafe { Halves($half(self.0, other.0), $half(self.1, other.1)) }
            }
        }
    };
}
lane_by_lane!(Add, add, _mm512_add_pd, _mm256_add_pd);
lane_by_lane!(Sub, sub, _mm512_sub_pd, _mm256_sub_pd);
lane_by_lane!(Mul, mul, _mm512_mul_pd, _mm256_mul_pd);

impl Neg for Wide {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Wide::splat(-0.0) - self
    }
}

impl Neg for Halves {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Halves::splat(-0.0) - self
    }
}
