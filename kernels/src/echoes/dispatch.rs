//! The widest registers that the machine has, chosen at run time. This is the one file of the echoes
//! with unsafe code: instructions that not every machine has. The compiler does not find them by
//! itself, because loops over eight lanes are unrolled before it looks for vectors.
#![allow(unsafe_code)]

use super::blocked::fill_blocks;
use super::lanes::Portable;
use super::sum::EchoSum;

/// Fills the values with what the machine does best. Eight vectors of points are in flight where
/// there are 32 registers of eight doubles; fewer where they would not fit.
pub(super) fn fill(sum: &EchoSum, times: &[f64], include_arriving: bool, values: &mut [f64]) {
    #[cfg(target_arch = "x86_64")]
    {
        let wide = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("fma");
        if wide {
            // SAFETY: the lines above have asked the machine for every feature that the function is
            // compiled for.
            return unsafe { fill_avx512(sum, times, include_arriving, values) };
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            // SAFETY: as above.
            return unsafe { fill_avx2(sum, times, include_arriving, values) };
        }
    }
    // Elsewhere a fused operation is an instruction only where the target has it from the start.
    const FUSED: bool = cfg!(any(target_arch = "aarch64", target_feature = "fma"));
    fill_blocks::<Portable<FUSED>, 1>(sum, times, include_arriving, values);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,fma")]
fn fill_avx512(sum: &EchoSum, times: &[f64], include_arriving: bool, values: &mut [f64]) {
    fill_blocks::<x86::Wide, 8>(sum, times, include_arriving, values);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn fill_avx2(sum: &EchoSum, times: &[f64], include_arriving: bool, values: &mut [f64]) {
    fill_blocks::<x86::Halves, 2>(sum, times, include_arriving, values);
}

/// Registers of the x86 family.
///
/// SAFETY of all blocks: values of these types are made and used only in the functions above that are
/// compiled for their instructions, which are called where the machine has them.
#[cfg(target_arch = "x86_64")]
mod x86 {
    use crate::echoes::lanes::{Lanes, WIDTH};
    use std::arch::x86_64::*;
    use std::ops::{Add, Mul, Neg, Sub};

    /// One register of eight doubles.
    #[derive(Clone, Copy)]
    pub struct Wide(__m512d);

    /// Two registers of four doubles.
    #[derive(Clone, Copy)]
    pub struct Halves(__m256d, __m256d);

    impl Lanes for Wide {
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
        fn where_counted(self, since: Self, include_arriving: bool) -> Self {
            Wide(unsafe {
                let zero = _mm512_setzero_pd();
                let counts = match include_arriving {
                    true => _mm512_cmp_pd_mask::<_CMP_GE_OQ>(since.0, zero),
                    false => _mm512_cmp_pd_mask::<_CMP_GT_OQ>(since.0, zero),
                };
                _mm512_maskz_mov_pd(counts, self.0)
            })
        }
    }

    impl Lanes for Halves {
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
        fn where_counted(self, since: Self, include_arriving: bool) -> Self {
            let counts = since.each(|half| unsafe {
                match include_arriving {
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::echoes::{Echoes, Expansion, Family, Term, Time};

    /// Every version that this machine runs agrees with the scalar summation.
    #[test]
    fn all_versions_agree() {
        let number = |value: f64| Expansion::try_from(value).expect("a number");
        let (one, two) = (Expansion::ONE, number(2.0));
        let terms = [Term { lag: 0, coefficient: one }];
        let wave = Echoes::new(Family::Laguerre, one, two, one, &terms, number(0.7)).expect("fine");
        let sum = EchoSum::new(wave, 60).expect("fine");
        let times: Vec<f64> = (0..1003).map(|i| f64::from(i) * 0.0417).collect();
        let mut versions = vec![];
        let mut values = vec![f64::NAN; times.len()];
        fill_blocks::<Portable<false>, 1>(&sum, &times, true, &mut values);
        versions.push(values.clone());
        fill_blocks::<Portable<true>, 3>(&sum, &times, true, &mut values);
        versions.push(values.clone());
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                // SAFETY: the features are there.
                unsafe { fill_avx2(&sum, &times, true, &mut values) };
                versions.push(values.clone());
            }
        }
        fill(&sum, &times, true, &mut values);
        versions.push(values);
        for version in &versions {
            for (&time, value) in times.iter().zip(version) {
                let method = crate::echoes::Method::Scaled;
                let right = sum.value(method, Time::from(time), true).expect("in range");
                assert!((value - right).abs() < 1e-14, "{time}: {value} and not {right}");
            }
        }
        println!("{} versions at {} times", versions.len(), times.len());
    }
}
