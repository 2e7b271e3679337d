//! Binomial coefficients and factorials: the structure constants of divided powers.
//!
//! `x^[a] · x^[b] = C(a+b, a) x^[a+b]`, so every product asks for them; ordinary coefficients ask
//! for `j!`. Small ones are kept for the life of the process, each row of Pascal's triangle from
//! the time it is first asked for; larger ones are computed when asked.

use crate::term::MAX_EXPONENT;
use num_bigint::BigInt;
use num_traits::One;
use std::sync::OnceLock;

/// How many rows of Pascal's triangle are kept. All of them would take about 12 MB.
const KEPT_ROWS: usize = 768;

/// The left halves of the rows of Pascal's triangle.
static ROWS: [OnceLock<Vec<BigInt>>; KEPT_ROWS] = [const { OnceLock::new() }; KEPT_ROWS];

/// How many factorials are kept in one block.
const BLOCK: usize = 64;

/// How many blocks of factorials are kept: up to [`MAX_EXPONENT`]. All of them would
/// take about 11 MB.
const KEPT_BLOCKS: usize = MAX_EXPONENT as usize / BLOCK + 1;

static FACTORIALS: [OnceLock<Vec<BigInt>>; KEPT_BLOCKS] = [const { OnceLock::new() }; KEPT_BLOCKS];

/// Multiplies `value` by `C(a + b, a)`. O(1) products of integers for `a + b` within the kept
/// rows, O(min(a, b)) beyond.
pub(crate) fn multiply_by_binomial(value: &mut BigInt, a: u32, b: u32) {
    let row = a.checked_add(b).expect("a row of Pascal's triangle fits 32 bits");
    match (a.min(b), ROWS.get(row as usize)) {
        (0, _) => {}
        (1, _) => *value *= row,
        (k, Some(kept)) => *value *= &kept.get_or_init(|| half_row(row))[k as usize],
        (k, None) => *value *= binomial(row, k),
    }
}

/// `C(n, 0), …, C(n, ⌊n/2⌋)`.
fn half_row(n: u32) -> Vec<BigInt> {
    let mut row = vec![BigInt::one()];
    for k in 0..n / 2 {
        row.push(&row[k as usize] * (n - k) / (k + 1));
    }
    row
}

/// The factorial `n!` where it is kept.
fn kept_factorial(n: u32) -> Option<&'static BigInt> {
    let block = FACTORIALS.get(n as usize / BLOCK)?;
    let factorials = block.get_or_init(|| {
        let first = n - n % BLOCK as u32;
        let mut factorials = vec![falling_factorial(first, first)];
        for i in 1..BLOCK {
            factorials.push(&factorials[i - 1] * (first as usize + i));
        }
        factorials
    });
    factorials.get(n as usize % BLOCK)
}

/// Multiplies `value` by `n!`. One product up to [`MAX_EXPONENT`].
pub(crate) fn multiply_by_factorial(value: &mut BigInt, n: u32) {
    match kept_factorial(n) {
        Some(kept) => *value *= kept,
        None => *value *= factorial(n),
    }
}

/// The binomial coefficient `C(n, k)`, zero for `k > n`. O(min(k, n−k)) products by a word.
pub fn binomial(n: u32, k: u32) -> BigInt {
    if k > n {
        return BigInt::ZERO;
    }
    let mut value = BigInt::one();
    for i in 0..k.min(n - k) {
        value *= n - i;
        value /= i + 1;
    }
    value
}

/// The factorial `n!`. A copy for `n` up to `MAX_EXPONENT`; beyond, O(n) products,
/// all but the last few short.
pub fn factorial(n: u32) -> BigInt {
    match kept_factorial(n) {
        Some(kept) => kept.clone(),
        None => falling_factorial(n, n),
    }
}

/// `n (n−1) … (n−k+1)`, for `k ≤ n`. O(k) products, all but the last few short.
pub(crate) fn falling_factorial(n: u32, k: u32) -> BigInt {
    if k < 32 {
        return (0..k).fold(BigInt::one(), |product, i| product * (n - i));
    }
    let half = k / 2;
    falling_factorial(n, half) * falling_factorial(n - half, k - half)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_rows_and_single_entries_agree_with_factorials() {
        for n in (0..60).chain([767, 768, 770]) {
            for k in 0..=n {
                let mut kept = BigInt::from(3);
                multiply_by_binomial(&mut kept, k, n - k);
                assert_eq!(kept, binomial(n, k) * 3);
                assert_eq!(binomial(n, k) * factorial(k) * factorial(n - k), factorial(n));
            }
        }
    }

    #[test]
    fn factorials_follow_their_recurrence() {
        assert_eq!(factorial(0), BigInt::one());
        for n in (1..200).chain([4094, 4095, 4096, 4097, 10_000]) {
            let mut scaled = BigInt::from(5);
            multiply_by_factorial(&mut scaled, n);
            assert_eq!(scaled, factorial(n) * 5);
            assert_eq!(factorial(n), factorial(n - 1) * n);
            assert_eq!(factorial(n), falling_factorial(n, n / 3) * factorial(n - n / 3));
        }
    }

    #[test]
    fn no_subset_is_larger_than_its_set() {
        assert_eq!(binomial(3, 4), BigInt::ZERO);
    }
}
