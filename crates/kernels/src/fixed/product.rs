//! The upper half of a product of 128-bit integers, from products of 64-bit words.

/// `⌊(a·b + 2^127)/2^128⌋`: the upper half of the product, rounded to nearest, ties upwards.
///
/// With `a = a₁·2^64 + a₀` and `b` alike, the four products `aᵢbⱼ` are below `2^128`. The column at
/// `2^64` is a sum of three words and of half a unit, below `4·2^64`, so that its carry is that of
/// the whole lower half: what stands below the column is less than a unit of it. An unsigned word
/// stands for a negative a as `a + 2^128`, which adds b to the upper half. The result is not larger
/// in size than a, because `b < 2^128`.
#[inline(always)]
pub(super) fn upper_product(a: i128, b: u128) -> i128 {
    const WORD: u128 = u64::MAX as u128;
    let (a1, a0) = (a as u128 >> 64, a as u128 & WORD);
    let (b1, b0) = (b >> 64, b & WORD);
    let (low, cross, other, high) = (a0 * b0, a0 * b1, a1 * b0, a1 * b1);
    let column = (low >> 64) + (cross & WORD) + (other & WORD) + (1 << 63);
    let high = high + (cross >> 64) + (other >> 64) + (column >> 64);
    (high as i128).wrapping_sub(b as i128 & (a >> 127))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed::samples::Samples;
    use num_bigint::BigInt;
    use num_traits::One;

    #[test]
    fn products_are_rounded_to_nearest() {
        let mut samples = Samples::new(11);
        for _ in 0..300_000 {
            let (a, b) = (samples.word() as i128, samples.word());
            let exact = (BigInt::from(a) * b + (BigInt::one() << 127u32)) >> 128u32;
            let product = upper_product(a, b);
            assert_eq!(BigInt::from(product), exact, "{a} {b}");
            assert!(product.unsigned_abs() <= a.unsigned_abs(), "{a} {b}");
        }
    }
}
