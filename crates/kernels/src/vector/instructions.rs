//! The instructions of x86-64, and the choice of a level at run time.
//!
//! Two things need it: instructions may be used only where
//! the machine has them, which holds in all code that is generic over a level's type, because
//! [`dispatch`] alone names these types; and pointers may be read and written only within their slices,
//! which is asserted before.
#![allow(unsafe_code)]

use super::eight::Eight;
#[cfg(not(target_arch = "x86_64"))]
use super::scalar::Scalar;
use super::{Simd, Task};
use crate::Level;

/// Runs a task with the instructions of a level, or of the best one that the machine has below it.
pub(crate) fn dispatch<T: Task>(level: Level, task: T) -> T::Output {
    let level = level.min(Level::best());
    #[cfg(target_arch = "x86_64")]
    match level {
        Level::Baseline => task.run(x86::Pair),
        // SAFETY: the level is available: the machine has AVX2 and fused multiply-add.
        Level::Avx2 => unsafe { x86::with_avx2(task) },
        // SAFETY: the level is available: the machine has AVX-512F, AVX2 and fused multiply-add.
        Level::Avx512 => unsafe { x86::with_avx512(task) },
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        debug_assert_eq!(level, Level::Baseline);
        task.run(Scalar::<false>)
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{Eight, Simd, Task};
    use crate::double_double::SPLITTER;
    use std::arch::x86_64::*;

    /// Two doubles: SSE2, which every x86-64 has.
    #[derive(Clone, Copy)]
    pub(super) struct Pair;

    /// Four doubles, used only in functions that enable AVX2 and fused multiply-add.
    #[derive(Clone, Copy)]
    struct Quad;

    /// Eight doubles, used only in functions that enable AVX-512F and what `Quad` has.
    #[derive(Clone, Copy)]
    struct Octet;

    #[target_feature(enable = "avx2,fma")]
    pub(super) fn with_avx2<T: Task>(task: T) -> T::Output {
        task.run(Quad)
    }

    #[target_feature(enable = "avx512f,avx2,fma")]
    pub(super) fn with_avx512<T: Task>(task: T) -> T::Output {
        task.run(Octet)
    }

    /// Indices that are less than `limit`.
    #[derive(Clone, Copy)]
    pub(super) struct Offsets<I> {
        lanes: I,
        limit: usize,
    }

    /// The indices of four lanes.
    #[inline(always)]
    fn quad_lanes(lanes: __m128i) -> [i32; 4] {
        let mut indices = [0; 4];
        // SAFETY: every x86-64 has the instruction, and the array holds a whole vector.
        unsafe { _mm_storeu_si128(indices.as_mut_ptr().cast(), lanes) };
        indices
    }

    /// The indices of eight lanes.
    #[inline(always)]
    fn octet_lanes(lanes: __m256i) -> [i32; 8] {
        let mut indices = [0; 8];
        // SAFETY: only `Octet` calls this, so the machine has the instruction; the array holds the vector.
        unsafe { _mm256_storeu_si256(indices.as_mut_ptr().cast(), lanes) };
        indices
    }

    /// A call of an instruction in a method of a level's type.
    macro_rules! instruction {
        ($call:expr) => {
            // SAFETY: this is a method of a level's type, so the machine has the instructions; no
            // pointer is followed.
            unsafe { $call }
        };
    }

    /// The methods of two vectors that are one instruction each.
    macro_rules! operations {
        ($($result:ident: $($name:ident $call:path),*;)*) => {$($(
            #[inline(always)]
            fn $name(self, a: Self::Values, b: Self::Values) -> Self::$result {
                instruction!($call(a, b))
            }
        )*)*};
    }

    /// The methods that touch memory, and that make a vector of one double.
    macro_rules! memory {
        ($lanes:literal, $splat:ident, $load:ident, $store:ident, $stream:ident) => {
            type Eight = Eight<Self, { 8 / $lanes }>;
            const LANES: usize = $lanes;

            #[inline(always)]
            fn splat(self, value: f64) -> Self::Values {
                instruction!($splat(value))
            }

            #[inline(always)]
            fn load(self, values: &[f64]) -> Self::Values {
                assert!(values.len() >= $lanes);
                // SAFETY: the slice holds a whole vector; any alignment will do.
                unsafe { $load(values.as_ptr()) }
            }

            #[inline(always)]
            fn store(self, values: Self::Values, out: &mut [f64]) {
                assert!(out.len() >= $lanes);
                // SAFETY: the slice holds a whole vector; any alignment will do.
                unsafe { $store(out.as_mut_ptr(), values) }
            }

            #[inline(always)]
            fn stream(self, values: Self::Values, out: &mut [f64]) {
                assert!(out.len() >= $lanes);
                if out.as_ptr().addr() % size_of::<Self::Values>() == 0 {
                    // SAFETY: the slice holds a whole vector and is aligned to its size. Callers fence
                    // before they return, so no other thread can see the memory unordered.
                    unsafe { $stream(out.as_mut_ptr(), values) }
                } else {
                    self.store(values, out);
                }
            }

            #[inline(always)]
            fn fence(self) {
                instruction!(_mm_sfence());
            }
        };
    }

    /// `a · 2^n` in the integers of a vector.
    macro_rules! times_power {
        ($bits:ident, $shift:path, $add:ident, $splat:ident, $doubles:ident) => {
            #[inline(always)]
            fn times_power(self, a: Self::Values, shifted: Self::Values) -> Self::Values {
                let power = instruction!({
                    let exponent = $shift($bits(shifted));
                    $doubles($add(exponent, $splat(1023 << 52)))
                });
                self.multiply(a, power)
            }
        };
    }

    /// The methods of levels with fused multiply-add.
    macro_rules! fused_methods {
        ($multiply_add:ident, $multiply_subtract:ident, $truncate:ident,
            |$from:ident, $lanes:ident| $gather:expr, $gather_integers:expr) => {
            #[inline(always)]
            fn gather(self, values: &[f64], offsets: Self::Offsets) -> Self::Values {
                assert!(offsets.limit <= values.len());
                let ($from, $lanes) = (values.as_ptr(), offsets.lanes);
                // SAFETY: all lanes are in 0 … limit − 1, and the slice is not shorter than the limit.
                unsafe { $gather }
            }

            #[inline(always)]
            fn gather_integers(self, values: &[u32], offsets: Self::Offsets) -> Self::Values {
                assert!(offsets.limit <= values.len());
                let ($from, $lanes) = (values.as_ptr().cast(), offsets.lanes);
                // SAFETY: all lanes are in 0 … limit − 1, and the slice is not shorter than the limit.
                unsafe { $gather_integers }
            }

            #[inline(always)]
            fn offsets(self, values: Self::Values, limit: usize) -> Self::Offsets {
                let clamped = self.clamped(values, limit);
                Offsets { lanes: instruction!($truncate(clamped)), limit }
            }

            #[inline(always)]
            fn multiply_add(
                self,
                a: Self::Values,
                b: Self::Values,
                c: Self::Values,
            ) -> Self::Values {
                instruction!($multiply_add(a, b, c))
            }

            #[inline(always)]
            fn two_product(self, a: Self::Values, b: Self::Values) -> (Self::Values, Self::Values) {
                let product = self.multiply(a, b);
                (product, instruction!($multiply_subtract(a, b, product)))
            }

            #[inline(always)]
            fn anchored_product(
                self,
                a: Self::Values,
                b: Self::Values,
                anchored: Self::Values,
            ) -> (Self::Values, Self::Values) {
                let sum = self.multiply_add(a, b, anchored);
                let kept = self.subtract(sum, anchored);
                (sum, instruction!($multiply_subtract(a, b, kept)))
            }
        };
    }

    impl Pair {
        /// Veltkamp's splitting, as for one double.
        #[inline(always)]
        fn split(self, a: __m128d) -> (__m128d, __m128d) {
            let scaled = self.multiply(self.splat(SPLITTER), a);
            let high = self.subtract(scaled, self.subtract(scaled, a));
            (high, self.subtract(a, high))
        }
    }

    impl Simd for Pair {
        type Values = __m128d;
        type Mask = __m128d;
        type Offsets = [usize; 2];
        const HERE: Self = Pair;
        const MANY_REGISTERS: bool = false;
        const EIGHTS_IN_FLIGHT: usize = 1;

        memory!(2, _mm_set1_pd, _mm_loadu_pd, _mm_storeu_pd, _mm_stream_pd);
        operations! {
            Values: add _mm_add_pd, subtract _mm_sub_pd, multiply _mm_mul_pd, divide _mm_div_pd,
                lesser _mm_min_pd, greater _mm_max_pd;
            Mask: at_least _mm_cmpge_pd, less _mm_cmplt_pd, equal _mm_cmpeq_pd, both _mm_and_pd;
        }
        times_power!(
            _mm_castpd_si128,
            _mm_slli_epi64::<52>,
            _mm_add_epi64,
            _mm_set1_epi64x,
            _mm_castsi128_pd
        );

        #[inline(always)]
        fn abs(self, a: __m128d) -> __m128d {
            instruction!(_mm_andnot_pd(_mm_set1_pd(-0.0), a))
        }

        #[inline(always)]
        fn offsets(self, values: __m128d, limit: usize) -> [usize; 2] {
            let clamped = self.clamped(values, limit);
            let both = instruction!(_mm_cvtsi128_si64(_mm_cvttpd_epi32(clamped))).cast_unsigned();
            [both & u64::from(u32::MAX), both >> 32].map(|lane| lane as usize)
        }

        #[inline(always)]
        fn multiply_add(self, a: __m128d, b: __m128d, c: __m128d) -> __m128d {
            self.add(self.multiply(a, b), c)
        }

        #[inline(always)]
        fn two_product(self, a: __m128d, b: __m128d) -> (__m128d, __m128d) {
            let product = self.multiply(a, b);
            let ((a_high, a_low), (b_high, b_low)) = (self.split(a), self.split(b));
            let error = self.subtract(self.multiply(a_high, b_high), product);
            let error = self.add(error, self.multiply(a_high, b_low));
            let error = self.add(error, self.multiply(a_low, b_high));
            (product, self.add(error, self.multiply(a_low, b_low)))
        }

        #[inline(always)]
        fn select(self, mask: __m128d, a: __m128d, b: __m128d) -> __m128d {
            instruction!(_mm_or_pd(_mm_and_pd(mask, a), _mm_andnot_pd(mask, b)))
        }

        #[inline(always)]
        fn bits(self, mask: __m128d) -> u32 {
            instruction!(_mm_movemask_pd(mask)).cast_unsigned()
        }

        #[inline(always)]
        fn gather(self, values: &[f64], offsets: [usize; 2]) -> __m128d {
            self.load(&[values[offsets[0]], values[offsets[1]]])
        }

        #[inline(always)]
        fn gather_integers(self, values: &[u32], offsets: [usize; 2]) -> __m128d {
            self.load(&offsets.map(|offset| f64::from(values[offset])))
        }

        #[inline(always)]
        fn transpose(self, values: &[f64], offsets: [usize; 2], columns: &mut [__m128d]) {
            let [first, second] = offsets.map(|offset| &values[offset..][..columns.len()]);
            let rows = first.as_chunks::<2>().0.iter().zip(second.as_chunks::<2>().0);
            for (columns, (first, second)) in columns.chunks_exact_mut(2).zip(rows) {
                let (first, second) = (self.load(first), self.load(second));
                columns[0] = instruction!(_mm_unpacklo_pd(first, second));
                columns[1] = instruction!(_mm_unpackhi_pd(first, second));
            }
        }
    }

    impl Simd for Quad {
        type Values = __m256d;
        type Mask = __m256d;
        type Offsets = Offsets<__m128i>;
        const HERE: Self = Quad;
        const MANY_REGISTERS: bool = false;
        const EIGHTS_IN_FLIGHT: usize = 2;

        memory!(4, _mm256_set1_pd, _mm256_loadu_pd, _mm256_storeu_pd, _mm256_stream_pd);
        operations! {
            Values: add _mm256_add_pd, subtract _mm256_sub_pd, multiply _mm256_mul_pd,
                divide _mm256_div_pd, lesser _mm256_min_pd, greater _mm256_max_pd;
            Mask: at_least _mm256_cmp_pd::<_CMP_GE_OQ>, less _mm256_cmp_pd::<_CMP_LT_OQ>,
                equal _mm256_cmp_pd::<_CMP_EQ_OQ>, both _mm256_and_pd;
        }
        times_power!(
            _mm256_castpd_si256,
            _mm256_slli_epi64::<52>,
            _mm256_add_epi64,
            _mm256_set1_epi64x,
            _mm256_castsi256_pd
        );
        fused_methods!(
            _mm256_fmadd_pd,
            _mm256_fmsub_pd,
            _mm256_cvttpd_epi32,
            |from, lanes| _mm256_i32gather_pd::<8>(from, lanes),
            _mm256_cvtepi32_pd(_mm_i32gather_epi32::<4>(from, lanes))
        );

        #[inline(always)]
        fn abs(self, a: __m256d) -> __m256d {
            instruction!(_mm256_andnot_pd(_mm256_set1_pd(-0.0), a))
        }

        #[inline(always)]
        fn select(self, mask: __m256d, a: __m256d, b: __m256d) -> __m256d {
            instruction!(_mm256_blendv_pd(b, a, mask))
        }

        #[inline(always)]
        fn bits(self, mask: __m256d) -> u32 {
            instruction!(_mm256_movemask_pd(mask)).cast_unsigned()
        }

        /// Halves of the rows r and r + 2 are put together, and then interleaved.
        #[inline(always)]
        fn transpose(self, values: &[f64], offsets: Offsets<__m128i>, columns: &mut [__m256d]) {
            let count = columns.len();
            assert!(offsets.limit + count <= values.len() + 1 && count.is_multiple_of(2));
            // SAFETY: all lanes are in 0 … limit − 1, so that each row from there, as long as there
            // are columns, is within the slice.
            unsafe {
                let rows = quad_lanes(offsets.lanes).map(|lane| values.as_ptr().add(lane as usize));
                for from in (0..count).step_by(2) {
                    let [first, second, third, fourth] =
                        rows.map(|row| _mm_loadu_pd(row.add(from)));
                    let even = _mm256_set_m128d(third, first);
                    let odd = _mm256_set_m128d(fourth, second);
                    *columns.get_unchecked_mut(from) = _mm256_unpacklo_pd(even, odd);
                    *columns.get_unchecked_mut(from + 1) = _mm256_unpackhi_pd(even, odd);
                }
            }
        }
    }

    impl Simd for Octet {
        type Values = __m512d;
        type Mask = __mmask8;
        type Offsets = Offsets<__m256i>;
        const HERE: Self = Octet;
        const MANY_REGISTERS: bool = true;
        const EIGHTS_IN_FLIGHT: usize = 8;

        memory!(8, _mm512_set1_pd, _mm512_loadu_pd, _mm512_storeu_pd, _mm512_stream_pd);
        operations! {
            Values: add _mm512_add_pd, subtract _mm512_sub_pd, multiply _mm512_mul_pd,
                divide _mm512_div_pd, lesser _mm512_min_pd, greater _mm512_max_pd;
            Mask: at_least _mm512_cmp_pd_mask::<_CMP_GE_OQ>,
                less _mm512_cmp_pd_mask::<_CMP_LT_OQ>, equal _mm512_cmp_pd_mask::<_CMP_EQ_OQ>;
        }
        times_power!(
            _mm512_castpd_si512,
            _mm512_slli_epi64::<52>,
            _mm512_add_epi64,
            _mm512_set1_epi64,
            _mm512_castsi512_pd
        );
        fused_methods!(
            _mm512_fmadd_pd,
            _mm512_fmsub_pd,
            _mm512_cvttpd_epi32,
            |from, lanes| _mm512_i32gather_pd::<8>(lanes, from),
            _mm512_cvtepi32_pd(_mm256_i32gather_epi32::<4>(from, lanes))
        );

        #[inline(always)]
        fn abs(self, a: __m512d) -> __m512d {
            instruction!(_mm512_abs_pd(a))
        }

        #[inline(always)]
        fn rough_reciprocal(self, a: __m512d) -> __m512d {
            let away = self.at_least(self.abs(a), self.splat(1e-30));
            instruction!(_mm512_maskz_rcp14_pd(away, a))
        }

        #[inline(always)]
        fn both(self, a: __mmask8, b: __mmask8) -> __mmask8 {
            a & b
        }

        #[inline(always)]
        fn select(self, mask: __mmask8, a: __m512d, b: __m512d) -> __m512d {
            instruction!(_mm512_mask_blend_pd(mask, b, a))
        }

        #[inline(always)]
        fn bits(self, mask: __mmask8) -> u32 {
            u32::from(mask)
        }

        /// Halves of the rows r and r + 4 are put together, interleaved, and their quarters sorted.
        #[inline(always)]
        fn transpose(self, values: &[f64], offsets: Offsets<__m256i>, columns: &mut [__m512d]) {
            let count = columns.len();
            assert!(offsets.limit + count <= values.len() + 1 && count.is_multiple_of(4));
            // SAFETY: all lanes are in 0 … limit − 1, so that each row from there, as long as there
            // are columns, is within the slice.
            unsafe {
                let rows =
                    octet_lanes(offsets.lanes).map(|lane| values.as_ptr().add(lane as usize));
                // Quarters 0 and 2 of both operands, in the order of the rows; quarters 1 and 3.
                let low = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
                let high = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
                for from in (0..count).step_by(4) {
                    let mut halves = [_mm512_setzero_pd(); 4];
                    for (row, both) in halves.iter_mut().enumerate() {
                        let first = _mm256_loadu_pd(rows[row].add(from));
                        let second = _mm256_loadu_pd(rows[row + 4].add(from));
                        *both = _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(first), second);
                    }
                    let even = _mm512_unpacklo_pd(halves[0], halves[1]);
                    let odd = _mm512_unpackhi_pd(halves[0], halves[1]);
                    let later_even = _mm512_unpacklo_pd(halves[2], halves[3]);
                    let later_odd = _mm512_unpackhi_pd(halves[2], halves[3]);
                    let four = [
                        _mm512_permutex2var_pd(even, low, later_even),
                        _mm512_permutex2var_pd(odd, low, later_odd),
                        _mm512_permutex2var_pd(even, high, later_even),
                        _mm512_permutex2var_pd(odd, high, later_odd),
                    ];
                    for (i, column) in four.into_iter().enumerate() {
                        *columns.get_unchecked_mut(from + i) = column;
                    }
                }
            }
        }
    }
}
