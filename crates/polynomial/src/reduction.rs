//! Reduction of powers of square roots.

use crate::binomial::factorial;
use crate::symbol::Symbol;
use crate::term::{Monomial, Term};
use num_bigint::BigInt;
use std::collections::BTreeMap;

/// The same value with exponents of square roots at most 1: by `x² = n`,
///
/// ```text
/// x^[j] = x^j/j! = n^{⌊j/2⌋}/j! · x^{j mod 2}
/// ```
///
/// O(terms) where nothing is to be done, else O(terms · log).
pub(crate) fn reduce_roots(
    symbols: &[Symbol],
    mut terms: Vec<Term>,
    mut denominator: BigInt,
) -> (Vec<Term>, BigInt) {
    for (column, symbol) in symbols.iter().enumerate() {
        let Some(square) = symbol.square() else { continue };
        let highest = terms.iter().map(|term| term.exponents[column]).max().unwrap_or(0);
        if highest < 2 {
            continue;
        }
        let scale = factorial(highest);
        let factor = |j: u32| BigInt::from(square).pow(j / 2) * (&scale / factorial(j));
        let factors: Vec<BigInt> = (0..=highest).map(factor).collect();
        let mut sums = BTreeMap::<Monomial, BigInt>::new();
        for mut term in terms {
            let exponent = &mut term.exponents[column];
            let numerator = term.numerator * &factors[*exponent as usize];
            *exponent %= 2;
            *sums.entry(term.exponents).or_default() += numerator;
        }
        let descending = sums.into_iter().rev();
        terms = descending.map(|(exponents, numerator)| Term { exponents, numerator }).collect();
        denominator *= scale;
    }
    (terms, denominator)
}
