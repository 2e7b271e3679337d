//! Rows of 64-bit limbs, lowest first: the mantissas of binary numbers.
//!
//! Most numbers have few limbs and take no memory of their own. What is worked out stands in a buffer on the
//! stack, and is copied when it is known how long it is.

use num_bigint::BigUint;
use smallvec::SmallVec;
use std::cmp::Ordering;
use std::ops::Deref;

/// Rows of so many limbs stand in place.
const SHORT: usize = 4;

/// Buffers of so many limbs stand on the stack.
const FEW: usize = 8;
const MANY: usize = 32;

/// Longer rows are multiplied by the methods of `num-bigint`.
const SCHOOLBOOK: usize = 32;

/// What the allocator takes for a row.
const HEAP_BYTES: u64 = 16;

/// How many bytes a row of so many bits takes that does not stand in place.
pub fn further_bytes(bits: u64) -> u64 {
    match bits <= 64 * SHORT as u64 {
        true => 0,
        false => bits / 8 + HEAP_BYTES,
    }
}

/// A row of limbs, and a sign beside it.
///
/// # Invariants
/// Rows that are short enough stand in place, with zeros behind them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Limbs {
    Short { limbs: [u64; SHORT], count: u8, negative: bool },
    Long { limbs: Box<[u64]>, negative: bool },
}

impl Limbs {
    pub const EMPTY: Limbs = Limbs::Short { limbs: [0; SHORT], count: 0, negative: false };

    #[inline]
    pub fn of(row: &[u64], negative: bool) -> Limbs {
        if row.len() > SHORT {
            return Limbs::Long { limbs: row.into(), negative };
        }
        let mut limbs = [0; SHORT];
        limbs[..row.len()].copy_from_slice(row);
        Limbs::Short { limbs, count: row.len() as u8, negative }
    }

    #[inline]
    pub fn is_negative(&self) -> bool {
        let (Limbs::Short { negative, .. } | Limbs::Long { negative, .. }) = self;
        *negative
    }

    #[inline]
    pub fn change_sign(&mut self) {
        let (Limbs::Short { negative, .. } | Limbs::Long { negative, .. }) = self;
        *negative = !*negative;
    }
}

impl Deref for Limbs {
    type Target = [u64];

    #[inline]
    fn deref(&self) -> &[u64] {
        match self {
            Limbs::Short { limbs, count, .. } => &limbs[..usize::from(*count)],
            Limbs::Long { limbs, .. } => limbs,
        }
    }
}

/// Works in a buffer of zeros.
#[inline]
pub fn in_buffer<R>(length: usize, work: impl FnOnce(&mut [u64]) -> R) -> R {
    if length <= FEW {
        work(&mut [0; FEW][..length])
    } else if length <= MANY {
        work(&mut [0; MANY][..length])
    } else {
        work(&mut vec![0; length])
    }
}

/// Shifts to the left by fewer than 64 bits, which the highest limb has room for.
pub fn shift_left(row: &mut [u64], bits: u32) {
    if bits == 0 {
        return;
    }
    for i in (1..row.len()).rev() {
        row[i] = row[i] << bits | row[i - 1] >> (64 - bits);
    }
    row[0] <<= bits;
}

/// Adds `other · 2^(64 place − bits)`, with `0 ≤ bits < 64`, to a row that has room for the sum.
pub fn add_shifted(row: &mut [u64], other: &[u64], place: usize, bits: u32) {
    let mut carry = false;
    each_shifted(row, other, place, bits, |limb, added| {
        let (sum, first) = limb.overflowing_add(added);
        let (sum, second) = sum.overflowing_add(carry.into());
        carry = first || second;
        sum
    });
    debug_assert!(!carry, "a row with room for the sum");
}

/// Subtracts `other · 2^(64 place − bits)`, with `0 ≤ bits < 64`; whether the difference is negative, and its
/// absolute value is left.
pub fn subtract_shifted(row: &mut [u64], other: &[u64], place: usize, bits: u32) -> bool {
    let mut borrow = false;
    each_shifted(row, other, place, bits, |limb, subtracted| {
        let (rest, first) = limb.overflowing_sub(subtracted);
        let (rest, second) = rest.overflowing_sub(borrow.into());
        borrow = first || second;
        rest
    });
    if borrow {
        negate(row);
    }
    borrow
}

/// The two's complement.
pub(crate) fn negate(row: &mut [u64]) {
    let mut carry = true;
    for limb in row {
        (*limb, carry) = (!*limb).overflowing_add(carry.into());
    }
}

/// Applies a step to the limbs of a row and of another that is moved to the right by `bits` of a limb and to the left
/// by `place` limbs, from the lowest on; and to zeros above.
fn each_shifted(
    row: &mut [u64],
    other: &[u64],
    place: usize,
    bits: u32,
    mut step: impl FnMut(u64, u64) -> u64,
) {
    let mut below = 0;
    let mut limbs = other.iter();
    let start = place - usize::from(bits > 0);
    for limb in &mut row[start..] {
        let moved = match (bits, limbs.next()) {
            (0, next) => next.copied().unwrap_or(0),
            (_, next) => {
                let next = next.copied().unwrap_or(0);
                let moved = below >> bits | next << (64 - bits);
                below = next;
                moved
            }
        };
        *limb = step(*limb, moved);
    }
}

/// The product, in a buffer of zeros as long as both rows.
pub fn multiply(buffer: &mut [u64], one: &[u64], other: &[u64]) {
    if one.len().min(other.len()) > SCHOOLBOOK {
        let product = natural(one) * natural(other);
        for (limb, digit) in buffer.iter_mut().zip(product.iter_u64_digits()) {
            *limb = digit;
        }
        return;
    }
    for (place, a) in one.iter().enumerate() {
        let mut carry = 0;
        for (limb, b) in buffer[place..].iter_mut().zip(other) {
            let sum = u128::from(*a) * u128::from(*b) + u128::from(*limb) + u128::from(carry);
            *limb = sum as u64;
            carry = (sum >> 64) as u64;
        }
        buffer[place + other.len()] = carry;
    }
}

/// Multiplies a row that has room for it.
pub fn scale(row: &mut [u64], factor: u64) {
    let mut carry = 0;
    for limb in row {
        let product = u128::from(*limb) * u128::from(factor) + u128::from(carry);
        *limb = product as u64;
        carry = (product >> 64) as u64;
    }
    debug_assert!(carry == 0, "a row with room for the product");
}

/// Divides a row, and returns the remainder.
pub fn divide(row: &mut [u64], divisor: u64) -> u64 {
    let mut remainder = 0;
    for limb in row.iter_mut().rev() {
        (*limb, remainder) = match divisor >> 32 {
            0 => {
                let high = remainder << 32 | *limb >> 32;
                let low = ((high % divisor) << 32) | (*limb & u64::from(u32::MAX));
                (((high / divisor) << 32) | (low / divisor), low % divisor)
            }
            _ => {
                let both = u128::from(remainder) << 64 | u128::from(*limb);
                let divisor = u128::from(divisor);
                ((both / divisor) as u64, (both % divisor) as u64)
            }
        };
    }
    remainder
}

/// Rounds to the nearest multiple of `2^excess`, halves upwards: whether anything was lost, and whether the row
/// carries, all its limbs zero then.
pub fn round(row: &mut [u64], excess: u64) -> (bool, bool) {
    let (place, bit) = ((excess / 64) as usize, excess % 64);
    let low = (1 << bit) - 1;
    if row[place] & low == 0 && row[..place].iter().all(|limb| *limb == 0) {
        return (false, false);
    }
    let half = excess - 1;
    let mut carry = row[(half / 64) as usize] >> (half % 64) & 1 == 1;
    row[..place].fill(0);
    row[place] &= !low;
    let mut unit = 1 << bit;
    for limb in &mut row[place..] {
        if !carry {
            break;
        }
        (*limb, carry) = limb.overflowing_add(unit);
        unit = 1;
    }
    (true, carry)
}

/// Which of two fractions is larger whose highest limbs these are.
pub fn compare(one: &[u64], other: &[u64]) -> Ordering {
    one.iter().rev().cmp(other.iter().rev())
}

/// A row as a natural number. One allocation, where it has no more than 32 limbs.
pub fn natural(row: &[u64]) -> BigUint {
    let halves = row.iter().flat_map(|limb| [*limb as u32, (limb >> 32) as u32]);
    BigUint::from_slice(&halves.collect::<SmallVec<[u32; 64]>>())
}
