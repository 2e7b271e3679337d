//! Rows of integers whose limbs lie one after another in one allocation.
//!
//! A polynomial of degree 1000 is a thousand integers of some hundred bits; one allocation for each
//! would cost more than the arithmetic. Only what rows need is here: combinations of two rows,
//! products with a word, remainders by one. Everything else goes by way of `Integer`.

use crate::limbs::{natural, negate};
use num_bigint::{BigInt, Sign};
use num_traits::ToPrimitive;
use std::borrow::Borrow;

/// A row of integers `c_0, c_1, …` in one allocation.
///
/// # Invariants
/// - entries end at ascending places of `limbs`, the last at its end;
/// - the highest limb of an entry is not zero; zero has no limbs and no sign.
///
/// Equal rows have one representation.
#[derive(Clone, PartialEq, Eq, Hash, Default, Debug)]
pub struct IntegerRow {
    limbs: Vec<u64>,
    entries: Vec<Entry>,
}

/// Where an entry ends among the limbs, and its sign.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct Entry {
    end: u32,
    negative: bool,
}

/// An integer that lies in a row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct IntegerRef<'a> {
    negative: bool,
    limbs: &'a [u64],
}

/// The integer 0, where a row has no entry.
const ZERO: IntegerRef<'static> = IntegerRef { negative: false, limbs: &[] };

impl IntegerRow {
    /// The number of entries. O(1).
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there are no entries. O(1).
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The entry at a place; 0 beyond the last. O(1).
    pub fn get(&self, i: usize) -> IntegerRef<'_> {
        let Some(entry) = self.entries.get(i) else { return ZERO };
        let start = i.checked_sub(1).map_or(0, |before| self.entries[before].end);
        let limbs = &self.limbs[start as usize..entry.end as usize];
        IntegerRef { negative: entry.negative, limbs }
    }

    /// The entries in order.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = IntegerRef<'_>> + ExactSizeIterator + '_ {
        (0..self.len()).map(|i| self.get(i))
    }

    /// Adds an entry at the end. O(limbs).
    pub(crate) fn push(&mut self, value: IntegerRef<'_>) {
        self.limbs.extend_from_slice(value.limbs);
        self.close(value.negative);
    }

    /// Adds an integer at the end. O(limbs).
    pub(crate) fn push_integer(&mut self, value: &BigInt) {
        self.limbs.extend(value.iter_u64_digits());
        self.close(value.sign() == Sign::Minus);
    }

    /// Takes the last entries off where they are zero. O(entries taken).
    pub(crate) fn trim(&mut self) {
        while !self.is_empty() && self.get(self.len() - 1).is_zero() {
            self.entries.pop();
        }
    }

    /// Makes the limbs after the last entry an entry of their own.
    fn close(&mut self, negative: bool) {
        let start = self.entries.last().map_or(0, |entry| entry.end as usize);
        while self.limbs.len() > start && self.limbs.last() == Some(&0) {
            self.limbs.pop();
        }
        let end = u32::try_from(self.limbs.len()).expect("a row has fewer than 2^32 limbs");
        self.entries.push(Entry { end, negative: negative && self.limbs.len() > start });
    }

    /// `a x_j + b y_{j−offset}` for all `j`, entries that a row does not have being 0. One pass over
    /// the limbs where both factors fit 32 bits; else O(limbs of an entry × limbs of a factor).
    pub fn combination(
        a: &BigInt,
        x: &IntegerRow,
        b: &BigInt,
        y: &IntegerRow,
        offset: usize,
    ) -> IntegerRow {
        let length = x.len().max(y.len() + offset);
        let mut row = IntegerRow {
            limbs: Vec::with_capacity(x.limbs.len().max(y.limbs.len()) + length / 2 + 1),
            entries: Vec::with_capacity(length),
        };
        let words = a.to_i32().zip(b.to_i32());
        for j in 0..length {
            let right = j.checked_sub(offset).map_or(ZERO, |j| y.get(j));
            match words {
                Some((a, b)) => row.push_combination(a, x.get(j), b, right),
                None => row.push_integer(&(a * x.get(j).to_integer() + b * right.to_integer())),
            }
        }
        row
    }

    /// Adds `a x + b y` at the end: the limbs of a two's complement number, and its magnitude where it
    /// came out negative. By induction |carry| ≤ 2^32, since |a x_i + b y_i| ≤ 2·(2^64−1)·2^31
    /// = 2^96 − 2^32: with the carry at most 2^96, whose floor by 2^64 is at most 2^32.
    fn push_combination(&mut self, a: i32, x: IntegerRef<'_>, b: i32, y: IntegerRef<'_>) {
        let start = self.limbs.len();
        let signed = |factor: i32, negative: bool| {
            if negative { -i128::from(factor) } else { i128::from(factor) }
        };
        let (a, b) = (signed(a, x.negative), signed(b, y.negative));
        let mut carry = 0_i128;
        let mut low = |sum: i128| {
            carry += sum;
            let limb = carry as u64;
            carry >>= 64;
            limb
        };
        let both = x.limbs.len().min(y.limbs.len());
        let pairs = x.limbs.iter().zip(y.limbs);
        self.limbs.extend(pairs.map(|(x, y)| low(i128::from(*x) * a + i128::from(*y) * b)));
        let (longer, factor) = if x.limbs.len() > both { (x.limbs, a) } else { (y.limbs, b) };
        self.limbs.extend(longer[both..].iter().map(|limb| low(i128::from(*limb) * factor)));
        // What is left fits a limb with its sign.
        let negative = carry < 0;
        self.limbs.push(carry as u64);
        if negative {
            negate(&mut self.limbs[start..]);
        }
        self.close(negative);
    }

    /// Replaces the row by its entries from the second on, each times `word`. Started from the
    /// divided-power coefficients of `p`, the l-th row is that of `word^l p^{(l)}`, which Taylor's
    /// theorem asks for. `spare` holds the new limbs meanwhile, and the old ones after. O(limbs).
    pub fn advance(&mut self, word: u64, spare: &mut IntegerRow) {
        spare.limbs.clear();
        spare.entries.clear();
        for entry in self.iter().skip(1) {
            let mut carry = 0_u64;
            spare.limbs.extend(entry.limbs.iter().map(|limb| {
                let product = u128::from(*limb) * u128::from(word) + u128::from(carry);
                carry = (product >> 64) as u64;
                product as u64
            }));
            if carry > 0 {
                spare.limbs.push(carry);
            }
            spare.close(entry.negative);
        }
        std::mem::swap(self, spare);
    }
}

impl IntegerRef<'_> {
    /// The integer itself. One allocation.
    pub fn to_integer(self) -> BigInt {
        let sign = if self.negative { Sign::Minus } else { Sign::Plus };
        BigInt::from_biguint(sign, natural(self.limbs))
    }

    /// Whether this is 0. O(1).
    pub fn is_zero(self) -> bool {
        self.limbs.is_empty()
    }

    /// The number of bits of the magnitude; 0 for 0. O(1).
    pub fn bits(self) -> u64 {
        let top = self.limbs.last().map_or(64, |limb| u64::from(limb.leading_zeros()));
        64 * self.limbs.len().max(1) as u64 - top
    }

    /// The remainder of the value modulo `word`, from 0 on. One division a limb.
    pub fn modulo(self, word: u64) -> u64 {
        let divisor = u128::from(word);
        let fold =
            |rest: u64, limb: &u64| ((u128::from(rest) << 64 | u128::from(*limb)) % divisor) as u64;
        match self.limbs.iter().rev().fold(0, fold) {
            rest if self.negative && rest > 0 => word - rest,
            rest => rest,
        }
    }
}

impl<I: Borrow<BigInt>> FromIterator<I> for IntegerRow {
    fn from_iter<T: IntoIterator<Item = I>>(values: T) -> IntegerRow {
        let mut row = IntegerRow::default();
        values.into_iter().for_each(|value| row.push_integer(value.borrow()));
        row
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Integers of up to four limbs, often at the edges of a limb.
    fn integers() -> impl Strategy<Value = BigInt> {
        let edge = |bits: u32| BigInt::from(1) << bits;
        let limbs = prop::collection::vec(prop_oneof![any::<u32>(), Just(0), Just(u32::MAX)], 0..9);
        let random = (any::<bool>(), limbs).prop_map(|(negative, limbs)| {
            BigInt::from_slice(if negative { Sign::Minus } else { Sign::Plus }, &limbs)
        });
        let edges =
            (0..130_u32, -1..=1_i32, any::<bool>()).prop_map(move |(bits, more, negative)| {
                if negative { -(edge(bits) + more) } else { edge(bits) + more }
            });
        prop_oneof![3 => random, 1 => edges, 1 => (-3..=3_i64).prop_map(BigInt::from)]
    }

    fn rows() -> impl Strategy<Value = Vec<BigInt>> {
        prop::collection::vec(integers(), 0..6)
    }

    fn factors() -> impl Strategy<Value = BigInt> {
        prop_oneof![any::<i32>().prop_map(BigInt::from), Just(i32::MIN.into()), integers()]
    }

    /// The row of these integers, its invariants checked.
    fn row(values: &[BigInt]) -> IntegerRow {
        let row: IntegerRow = values.iter().collect();
        assert_valid(&row);
        row
    }

    fn assert_valid(row: &IntegerRow) {
        assert_eq!(row.entries.last().map_or(0, |entry| entry.end as usize), row.limbs.len());
        assert!(row.entries.windows(2).all(|pair| pair[0].end <= pair[1].end));
        for entry in row.iter() {
            assert!(entry.limbs.last() != Some(&0), "{row:?}");
            assert!(!entry.negative || !entry.is_zero(), "{row:?}");
        }
    }

    fn plain(row: &IntegerRow) -> Vec<BigInt> {
        assert_valid(row);
        row.iter().map(IntegerRef::to_integer).collect()
    }

    proptest! {
        #[test]
        fn entries_are_the_integers_put_in(values in rows(), word in 1..=u64::MAX) {
            let row = row(&values);
            prop_assert_eq!(&plain(&row), &values);
            for (entry, value) in row.iter().zip(&values) {
                prop_assert_eq!(entry.bits(), value.bits());
                prop_assert_eq!(entry.negative, value.sign() == Sign::Minus);
                let modulo = num_integer::Integer::mod_floor(value, &BigInt::from(word));
                prop_assert_eq!(BigInt::from(entry.modulo(word)), modulo);
            }
            prop_assert!(row.get(values.len()).is_zero());
        }

        #[test]
        fn combinations_agree_with_integers(
            a in factors(), x in rows(), b in factors(), y in rows(), offset in 0_usize..3,
        ) {
            let at = |values: &[BigInt], j: Option<usize>| {
                j.and_then(|j| values.get(j)).cloned().unwrap_or_default()
            };
            let length = x.len().max(y.len() + offset);
            let expected: Vec<BigInt> = (0..length)
                .map(|j| &a * at(&x, Some(j)) + &b * at(&y, j.checked_sub(offset)))
                .collect();
            let found = IntegerRow::combination(&a, &row(&x), &b, &row(&y), offset);
            prop_assert_eq!(plain(&found), expected);
        }

        #[test]
        fn advancing_agrees_with_integers(
            values in rows(),
            word in prop_oneof![4 => any::<u64>(), 1 => Just(0), 1 => Just(u64::MAX), 1 => 1..99_u64],
        ) {
            let (mut found, mut spare) = (row(&values), row(&values));
            found.advance(word, &mut spare);
            let expected: Vec<BigInt> = values.iter().skip(1).map(|value| value * word).collect();
            prop_assert_eq!(plain(&found), expected);
        }

        #[test]
        fn trimming_takes_zeros_off(values in rows(), zeros in 0_usize..3) {
            let mut longer = values.clone();
            longer.resize(values.len() + zeros, BigInt::ZERO);
            let mut trimmed = row(&longer);
            trimmed.trim();
            assert_valid(&trimmed);
            let last = values.iter().rposition(|value| *value != BigInt::ZERO);
            prop_assert_eq!(plain(&trimmed), &values[..last.map_or(0, |last| last + 1)]);
        }
    }
}
