//! Integers in decimal digits: formulas of high order have a hundred thousand of them.

use num_bigint::{BigInt, Sign};
use smallvec::SmallVec;

/// The largest power of ten in a limb; its highest bit is set.
const CHUNK: u64 = 10_000_000_000_000_000_000;

/// The digits of a chunk.
const DIGITS: usize = 19;

/// `⌊(2^128 − 1)/CHUNK⌋ − 2^64`.
const RECIPROCAL: u64 = (u128::MAX / CHUNK as u128 - (1 << 64)) as u64;

/// Up to this many limbs division by chunks is faster than splitting in halves.
const SHORT: usize = 24;

/// An integer in decimal digits, several times faster than its `Display` where it has at most
/// 400 digits. O(limbs²).
pub fn decimal(value: &BigInt) -> String {
    let mut limbs: SmallVec<[u64; SHORT]> = value.iter_u64_digits().collect();
    if limbs.len() > SHORT {
        return value.to_string();
    }
    let mut chunks: SmallVec<[u64; SHORT + 2]> = SmallVec::new();
    while let Some(top) = limbs.last() {
        if *top == 0 {
            limbs.pop();
            continue;
        }
        let mut rest = 0;
        for limb in limbs.iter_mut().rev() {
            (*limb, rest) = divide_by_chunk(rest, *limb);
        }
        chunks.push(rest);
    }
    let first = chunks.pop().unwrap_or(0).to_string();
    let mut text = Vec::with_capacity(1 + first.len() + DIGITS * chunks.len());
    if value.sign() == Sign::Minus {
        text.push(b'-');
    }
    text.extend_from_slice(first.as_bytes());
    for chunk in chunks.into_iter().rev() {
        // Two halves of ten and nine digits: their divisions do not wait for each other.
        let mut digits = [b'0'; DIGITS];
        let (mut left, mut right) = (chunk / 1_000_000_000, (chunk % 1_000_000_000) as u32);
        for i in (0..9).rev() {
            digits[i + 1] += (left % 10) as u8;
            digits[i + 10] += (right % 10) as u8;
            (left, right) = (left / 10, right / 10);
        }
        digits[0] += left as u8;
        text.extend_from_slice(&digits);
    }
    String::from_utf8(text).expect("digits")
}

/// Quotient and remainder of `high·2^64 + low` by [`CHUNK`], for `high < CHUNK`: the quotient
/// estimated with the reciprocal is at most one off (Möller and Granlund, *Improved division by
/// invariant integers*, algorithm 4).
fn divide_by_chunk(high: u64, low: u64) -> (u64, u64) {
    let estimate =
        u128::from(RECIPROCAL) * u128::from(high) + (u128::from(high) << 64 | u128::from(low));
    let mut quotient = ((estimate >> 64) as u64).wrapping_add(1);
    let mut rest = low.wrapping_sub(quotient.wrapping_mul(CHUNK));
    if rest > estimate as u64 {
        quotient = quotient.wrapping_sub(1);
        rest = rest.wrapping_add(CHUNK);
    }
    if rest >= CHUNK { (quotient + 1, rest - CHUNK) } else { (quotient, rest) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn powers_of_two_and_ten_and_their_neighbours() {
        for base in [2, 10] {
            let mut power = BigInt::from(1);
            while power.bits() < 64 * (SHORT as u64 + 2) {
                for value in [&power - 1, power.clone(), &power + 1, -&power] {
                    assert_eq!(decimal(&value), value.to_string());
                }
                power *= base;
            }
        }
    }

    proptest! {
        #[test]
        fn digits_of_any_integer(digits in prop::collection::vec(any::<u32>(), 0..40), minus: bool) {
            let sign = if minus { Sign::Minus } else { Sign::Plus };
            let value = BigInt::from_slice(sign, &digits);
            prop_assert_eq!(decimal(&value), value.to_string());
        }

        #[test]
        fn division_by_a_chunk(
            high in prop_oneof![4 => 0..CHUNK, 1 => Just(CHUNK - 1), 1 => Just(0)],
            low in prop_oneof![4 => any::<u64>(), 1 => Just(u64::MAX), 1 => Just(0)],
        ) {
            let (quotient, rest) = divide_by_chunk(high, low);
            let value = u128::from(high) << 64 | u128::from(low);
            prop_assert_eq!(u128::from(quotient), value / u128::from(CHUNK));
            prop_assert_eq!(u128::from(rest), value % u128::from(CHUNK));
        }
    }
}
