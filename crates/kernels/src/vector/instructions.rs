//! The instructions of x86-64, and the choice of a level at run time.
//!
//! This is the only file with unsafe code. Two things need it: instructions may be used only where
//! the machine has them, which a witness type of each level proves; and pointers may be read and
//! written only within their slices, which is asserted before.
#![allow(unsafe_code)]

use super::points::Parts;
use super::scalar::Scalar;
use super::{Simd, Task};
use crate::Level;

/// Runs a task with the instructions of a level, or of the best one that the machine has below it.
pub(crate) fn dispatch<T: Task>(level: Level, task: T) -> T::Output {
    let level = level.min(Level::best());
    #[cfg(target_arch = "x86_64")]
    match level {
        Level::Baseline => task.run(x86::Pair(())),
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

/// Runs a task on single doubles, with the roundings of a level.
pub(crate) fn dispatch_scalar<T: Task>(level: Level, task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    if level > Level::Baseline && Level::Avx2.is_available() {
        // SAFETY: the machine has fused multiply-add.
        return unsafe { x86::with_fused(task) };
    }
    let _ = level;
    task.run(Scalar::<false>)
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{Parts, Scalar, Simd, Task};
    use crate::double_double::SPLITTER;
    use std::arch::x86_64::*;

    /// Two doubles: SSE2, which every x86-64 has.
    #[derive(Clone, Copy)]
    pub(super) struct Pair(pub(super) ());

    /// Four doubles. A value exists only in functions that enable AVX2 and fused multiply-add.
    #[derive(Clone, Copy)]
    pub(super) struct Quad(());

    /// Eight doubles. A value exists only in functions that enable AVX-512F and what `Quad` has.
    #[derive(Clone, Copy)]
    pub(super) struct Octet(());

    #[target_feature(enable = "fma")]
    pub(super) fn with_fused<T: Task>(task: T) -> T::Output {
        task.run(Scalar::<true>)
    }

    #[target_feature(enable = "avx2,fma")]
    pub(super) fn with_avx2<T: Task>(task: T) -> T::Output {
        task.run(Quad(()))
    }

    #[target_feature(enable = "avx512f,avx2,fma")]
    pub(super) fn with_avx512<T: Task>(task: T) -> T::Output {
        task.run(Octet(()))
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
        // SAFETY: a vector of this kind comes from a witness of AVX-512, and the array holds it.
        unsafe { _mm256_storeu_si256(indices.as_mut_ptr().cast(), lanes) };
        indices
    }

    /// A call of an instruction in a method of a witness type.
    macro_rules! instruction {
        ($call:expr) => {
            // SAFETY: `self` exists, so the machine has the instructions; no pointer is followed.
            unsafe { $call }
        };
    }

    /// The methods that are one instruction each, and those that touch memory.
    macro_rules! common_methods {
        ($lanes:literal, splat $splat:ident, load $load:ident, store $store:ident,
         stream $stream:ident, add $add:ident, subtract $subtract:ident, multiply $multiply:ident) => {
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

            #[inline(always)]
            fn add(self, a: Self::Values, b: Self::Values) -> Self::Values {
                instruction!($add(a, b))
            }

            #[inline(always)]
            fn subtract(self, a: Self::Values, b: Self::Values) -> Self::Values {
                instruction!($subtract(a, b))
            }

            #[inline(always)]
            fn multiply(self, a: Self::Values, b: Self::Values) -> Self::Values {
                instruction!($multiply(a, b))
            }
        };
    }

    /// The methods of levels with fused multiply-add.
    macro_rules! fused_methods {
        ($multiply_add:ident, $multiply_subtract:ident) => {
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

            #[inline(always)]
            fn grid<const N: usize>(
                self,
                first: usize,
                from: f64,
                step: f64,
                _: &Parts,
            ) -> [Self::Values; N] {
                // Below 2⁵³ the sum of two indices is exact; beyond, each index is rounded alone.
                if first < 1 << 52 {
                    let mut times: [Self::Values; N] = self.indices(first);
                    let (from, step) = (self.splat(from), self.splat(step));
                    for time in &mut times {
                        *time = self.multiply_add(*time, step, from);
                    }
                    return times;
                }
                let mut times = [self.splat(0.0); N];
                for (j, time) in times.iter_mut().enumerate() {
                    let mut lanes = [0.0; 8];
                    for (lane, time) in lanes.iter_mut().enumerate() {
                        let index = first + j * Self::LANES + lane;
                        *time = (index as f64).mul_add(step, from);
                    }
                    *time = self.load(&lanes);
                }
                times
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

        /// `start + i slope`.
        #[inline(always)]
        fn line(self, i: __m128d, [start, slope]: [f64; 2]) -> __m128d {
            self.add(self.splat(start), self.multiply(i, self.splat(slope)))
        }
    }

    impl Simd for Pair {
        type Values = __m128d;
        type Mask = __m128d;
        type Offsets = [usize; 2];
        const MANY_REGISTERS: bool = false;

        common_methods!(2, splat _mm_set1_pd, load _mm_loadu_pd, store _mm_storeu_pd,
            stream _mm_stream_pd, add _mm_add_pd, subtract _mm_sub_pd, multiply _mm_mul_pd);

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
        fn at_least(self, a: __m128d, b: __m128d) -> __m128d {
            instruction!(_mm_cmpge_pd(a, b))
        }

        #[inline(always)]
        fn less(self, a: __m128d, b: __m128d) -> __m128d {
            instruction!(_mm_cmplt_pd(a, b))
        }

        #[inline(always)]
        fn equal(self, a: __m128d, b: __m128d) -> __m128d {
            instruction!(_mm_cmpeq_pd(a, b))
        }

        #[inline(always)]
        fn both(self, a: __m128d, b: __m128d) -> __m128d {
            instruction!(_mm_and_pd(a, b))
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
        fn offsets(self, values: __m128d, limit: usize) -> [usize; 2] {
            assert!(limit >= 1 && limit <= i32::MAX as usize);
            // The maximum of NaN and a second operand is the second operand.
            let both = instruction!({
                let low = _mm_max_pd(values, _mm_setzero_pd());
                let lanes = _mm_cvttpd_epi32(_mm_min_pd(low, self.splat((limit - 1) as f64)));
                _mm_cvtsi128_si64(lanes).cast_unsigned()
            });
            [both & u64::from(u32::MAX), both >> 32].map(|lane| lane as usize)
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

        /// Exact sums and two ends of the rest, see [`Parts`]. The rare sums that these do not
        /// decide are rounded one by one.
        #[inline(always)]
        fn grid<const N: usize>(
            self,
            first: usize,
            from: f64,
            step: f64,
            parts: &Parts,
        ) -> [__m128d; N] {
            let indices: [__m128d; N] = self.indices(first);
            let mut times = indices;
            let mut decided = self.equal(self.splat(0.0), self.splat(0.0));
            for (time, i) in times.iter_mut().zip(indices) {
                let coarse = self.line(i, parts.coarse);
                let down = self.add(coarse, self.line(i, parts.below));
                *time = self.add(coarse, self.line(i, parts.above));
                decided = self.both(decided, self.equal(down, *time));
            }
            if self.all(decided) {
                return times;
            }
            for (j, time) in times.iter_mut().enumerate() {
                *time = self.load(&Scalar::<false>.grid::<2>(first + 2 * j, from, step, parts));
            }
            times
        }
    }

    impl Simd for Quad {
        type Values = __m256d;
        type Mask = __m256d;
        type Offsets = Offsets<__m128i>;
        const MANY_REGISTERS: bool = false;

        common_methods!(4, splat _mm256_set1_pd, load _mm256_loadu_pd, store _mm256_storeu_pd,
            stream _mm256_stream_pd, add _mm256_add_pd, subtract _mm256_sub_pd,
            multiply _mm256_mul_pd);
        fused_methods!(_mm256_fmadd_pd, _mm256_fmsub_pd);

        #[inline(always)]
        fn at_least(self, a: __m256d, b: __m256d) -> __m256d {
            instruction!(_mm256_cmp_pd::<_CMP_GE_OQ>(a, b))
        }

        #[inline(always)]
        fn less(self, a: __m256d, b: __m256d) -> __m256d {
            instruction!(_mm256_cmp_pd::<_CMP_LT_OQ>(a, b))
        }

        #[inline(always)]
        fn equal(self, a: __m256d, b: __m256d) -> __m256d {
            instruction!(_mm256_cmp_pd::<_CMP_EQ_OQ>(a, b))
        }

        #[inline(always)]
        fn both(self, a: __m256d, b: __m256d) -> __m256d {
            instruction!(_mm256_and_pd(a, b))
        }

        #[inline(always)]
        fn select(self, mask: __m256d, a: __m256d, b: __m256d) -> __m256d {
            instruction!(_mm256_blendv_pd(b, a, mask))
        }

        #[inline(always)]
        fn bits(self, mask: __m256d) -> u32 {
            instruction!(_mm256_movemask_pd(mask)).cast_unsigned()
        }

        #[inline(always)]
        fn offsets(self, values: __m256d, limit: usize) -> Offsets<__m128i> {
            assert!(limit >= 1 && limit <= i32::MAX as usize);
            // The maximum of NaN and a second operand is the second operand.
            let lanes = instruction!({
                let low = _mm256_max_pd(values, _mm256_setzero_pd());
                _mm256_cvttpd_epi32(_mm256_min_pd(low, _mm256_set1_pd((limit - 1) as f64)))
            });
            Offsets { lanes, limit }
        }

        #[inline(always)]
        fn gather(self, values: &[f64], offsets: Offsets<__m128i>) -> __m256d {
            assert!(offsets.limit <= values.len());
            // SAFETY: all lanes are in 0 … limit − 1, and the slice is not shorter than the limit.
            unsafe { _mm256_i32gather_pd::<8>(values.as_ptr(), offsets.lanes) }
        }

        #[inline(always)]
        fn gather_integers(self, values: &[u32], offsets: Offsets<__m128i>) -> __m256d {
            assert!(offsets.limit <= values.len());
            // SAFETY: all lanes are in 0 … limit − 1, and the slice is not shorter than the limit.
            unsafe {
                let integers = _mm_i32gather_epi32::<4>(values.as_ptr().cast(), offsets.lanes);
                _mm256_cvtepi32_pd(integers)
            }
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
        const MANY_REGISTERS: bool = true;

        common_methods!(8, splat _mm512_set1_pd, load _mm512_loadu_pd, store _mm512_storeu_pd,
            stream _mm512_stream_pd, add _mm512_add_pd, subtract _mm512_sub_pd,
            multiply _mm512_mul_pd);
        fused_methods!(_mm512_fmadd_pd, _mm512_fmsub_pd);

        #[inline(always)]
        fn at_least(self, a: __m512d, b: __m512d) -> __mmask8 {
            instruction!(_mm512_cmp_pd_mask::<_CMP_GE_OQ>(a, b))
        }

        #[inline(always)]
        fn less(self, a: __m512d, b: __m512d) -> __mmask8 {
            instruction!(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b))
        }

        #[inline(always)]
        fn equal(self, a: __m512d, b: __m512d) -> __mmask8 {
            instruction!(_mm512_cmp_pd_mask::<_CMP_EQ_OQ>(a, b))
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

        #[inline(always)]
        fn offsets(self, values: __m512d, limit: usize) -> Offsets<__m256i> {
            assert!(limit >= 1 && limit <= i32::MAX as usize);
            // The maximum of NaN and a second operand is the second operand.
            let lanes = instruction!({
                let low = _mm512_max_pd(values, _mm512_setzero_pd());
                _mm512_cvttpd_epi32(_mm512_min_pd(low, _mm512_set1_pd((limit - 1) as f64)))
            });
            Offsets { lanes, limit }
        }

        #[inline(always)]
        fn gather(self, values: &[f64], offsets: Offsets<__m256i>) -> __m512d {
            assert!(offsets.limit <= values.len());
            // SAFETY: all lanes are in 0 … limit − 1, and the slice is not shorter than the limit.
            unsafe { _mm512_i32gather_pd::<8>(offsets.lanes, values.as_ptr()) }
        }

        #[inline(always)]
        fn gather_integers(self, values: &[u32], offsets: Offsets<__m256i>) -> __m512d {
            assert!(offsets.limit <= values.len());
            // SAFETY: all lanes are in 0 … limit − 1, and the slice is not shorter than the limit.
            unsafe {
                let integers = _mm256_i32gather_epi32::<4>(values.as_ptr().cast(), offsets.lanes);
                _mm512_cvtepi32_pd(integers)
            }
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
