//! Products of 128-bit integers in full length, from products of 64-bit words.

/// The product of two words of 128 bits as `(high, low)`: `high·2^128 + low`, exactly.
///
/// With `a = a₁·2^64 + a₀` and `b` alike, the four products `aᵢbⱼ` are below `2^128`. The column at
/// `2^64` is a sum of three words, below `3·2^64`; the high part cannot overflow, because the
/// product is below `2^256`.
#[inline]
pub(super) fn wide_product(a: u128, b: u128) -> (u128, u128) {
    const WORD: u128 = u64::MAX as u128;
    let (a1, a0) = (a >> 64, a & WORD);
    let (b1, b0) = (b >> 64, b & WORD);
    let (low, cross, other, high) = (a0 * b0, a0 * b1, a1 * b0, a1 * b1);
    let column = (low >> 64) + (cross & WORD) + (other & WORD);
    let high = high + (cross >> 64) + (other >> 64) + (column >> 64);
    (high, (column << 64) | (low & WORD))
}

/// The product of two signed words of 128 bits as `(high, low)`: `high·2^128 + low`, exactly.
///
/// A negative `a` stands as `a + 2^128` in an unsigned word, which adds `b·2^128` to the product.
#[inline]
pub(super) fn signed_product(a: i128, b: i128) -> (i128, u128) {
    let (high, low) = wide_product(a as u128, b as u128);
    let excess = (b & (a >> 127)).wrapping_add(a & (b >> 127));
    ((high as i128).wrapping_sub(excess), low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed::samples::Samples;
    use num_bigint::BigInt;

    #[test]
    fn products_are_exact() {
        let mut samples = Samples::new(11);
        for _ in 0..200_000 {
            let (a, b) = (samples.word(), samples.word());
            let (high, low) = wide_product(a, b);
            assert_eq!((BigInt::from(high) << 128) + low, BigInt::from(a) * b, "{a} {b}");
            let (a, b) = (a as i128, b as i128);
            let (high, low) = signed_product(a, b);
            assert_eq!((BigInt::from(high) << 128) + low, BigInt::from(a) * b, "{a} {b}");
        }
    }
}
