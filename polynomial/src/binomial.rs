//! Binomial coefficients and factorials: the structure constants of divided powers.
//!
//! `x^[a] · x^[b] = C(a+b, a) x^[a+b]`, so every product asks for them. Small rows of Pascal's
//! triangle are kept for the life of the thread; larger entries are computed when asked.

use num_bigint::BigInt;
use num_traits::One;
use std::cell::RefCell;

/// Rows of Pascal's triangle that are kept. The whole table to this row has about 2^16 entries.
const KEPT_ROWS: u32 = 360;

thread_local! {
    static PASCAL: RefCell<Vec<Vec<BigInt>>> = const { RefCell::new(Vec::new()) };
}

/// Multiplies `value` by `C(a + b, a)`. O(1) products of integers for `a + b` within the kept
/// rows, O(min(a, b)) beyond.
pub(crate) fn multiply_by_binomial(value: &mut BigInt, a: u32, b: u32) {
    let small = a.min(b);
    let row = a.checked_add(b).expect("exponents stay below 2^32");
    if small == 0 {
    } else if small == 1 {
        *value *= row;
    } else if row < KEPT_ROWS {
        PASCAL.with_borrow_mut(|rows| {
            grow(rows, row);
            *value *= &rows[row as usize][small as usize];
        });
    } else {
        *value *= binomial(row, small);
    }
}

fn grow(rows: &mut Vec<Vec<BigInt>>, to: u32) {
    while rows.len() <= to as usize {
        let n = rows.len();
        let next = match rows.last() {
            None => vec![BigInt::one()],
            Some(last) => (0..=n / 2)
                .map(|k| match k {
                    0 => BigInt::one(),
                    _ => &last[(k - 1).min(n - k)] + &last[k.min(n - 1 - k)],
                })
                .collect(),
        };
        rows.push(next);
    }
}

/// The binomial coefficient `C(n, k)`, zero for `k > n`. O(min(k, n−k)) products by a word.
///
/// ```
/// assert_eq!(wavestep_polynomial::binomial(80, 3), 82160.into());
/// ```
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

/// The factorial `n!`. O(n) products by a word.
///
/// ```
/// assert_eq!(wavestep_polynomial::factorial(5), 120.into());
/// ```
pub fn factorial(n: u32) -> BigInt {
    (2..=n).fold(BigInt::one(), |product, i| product * i)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_rows_and_single_entries_agree_with_factorials() {
        for n in (0..60).chain(KEPT_ROWS - 2..KEPT_ROWS + 3) {
            for k in 0..=n {
                let mut kept = BigInt::from(3);
                multiply_by_binomial(&mut kept, k, n - k);
                let direct = binomial(n, k);
                assert_eq!(kept, &direct * 3);
                if n < 60 {
                    assert_eq!(direct * factorial(k) * factorial(n - k), factorial(n));
                }
            }
        }
    }
}
