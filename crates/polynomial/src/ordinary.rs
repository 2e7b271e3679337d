//! Ordinary powers over one denominator, for writing.

use crate::integer::{fraction, gcd, lcm};
use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// Polynomials in ordinary powers, as integers over the least denominator that they share:
///
/// ```text
/// p_i = (1/m) Σ_α n_{i,α} Π_j x_j^{α_j}         gcd(m, all n_{i,α}) = 1
/// ```
///
/// # Invariants
/// - `m > 0`, and no prime divides `m` and all integers;
/// - one integer for each term of a polynomial, in its order.
pub struct Ordinary<'a> {
    polynomials: Vec<&'a Polynomial>,
    denominator: BigInt,
    integers: Vec<Vec<BigInt>>,
}

impl<'a> Ordinary<'a> {
    /// `p / divisor` for each polynomial. A product for each symbol of a term, and one division a
    /// term: the gcd with the denominator soon no longer changes.
    pub fn new(
        polynomials: impl IntoIterator<Item = &'a Polynomial>,
        divisor: &BigInt,
    ) -> Ordinary<'a> {
        assert!(divisor.is_positive(), "coefficients over {divisor}");
        let polynomials: Vec<&Polynomial> = polynomials.into_iter().collect();
        let shared = polynomials.iter().fold(BigInt::one(), |d, p| lcm(&d, &p.denominator));
        let tables = factorial_ratios(&polynomials);
        // A denominator that does for all terms, and by what it and the integers are divided.
        let whole = tables.values().fold(&shared * divisor, |whole, table| whole * &table[0]);
        let mut common = whole.clone();
        let mut integers: Vec<Vec<BigInt>> = vec![Vec::new(); polynomials.len()];
        // Long polynomials first: they settle what is common.
        let mut order: Vec<usize> = (0..polynomials.len()).collect();
        order.sort_by_key(|i| std::cmp::Reverse(polynomials[*i].terms.len()));
        for i in order {
            let p = polynomials[i];
            let absent = tables.iter().filter(|(x, _)| p.column(x).is_none());
            let scale =
                absent.fold(&shared / &p.denominator, |scale, (_, table)| scale * &table[0]);
            let columns: Vec<&Vec<BigInt>> = p.symbols.iter().map(|x| &tables[x]).collect();
            for term in &p.terms {
                let mut integer = term.numerator.clone();
                let ratios =
                    columns.iter().zip(&term.exponents).map(|(table, e)| &table[*e as usize]);
                for factor in ratios.chain([&scale]).filter(|factor| !factor.is_one()) {
                    integer *= factor;
                }
                let (mut quotient, rest) = integer.div_rem(&common);
                if !rest.is_zero() {
                    let smaller = gcd(&common, &rest);
                    let more = &common / &smaller;
                    integers.iter_mut().flatten().for_each(|known| *known *= &more);
                    quotient = integer / &smaller;
                    common = smaller;
                }
                integers[i].push(quotient);
            }
        }
        Ordinary { polynomials, denominator: whole / common, integers }
    }

    /// The least positive integer by which all coefficients become integers. O(1).
    pub fn denominator(&self) -> &BigInt {
        &self.denominator
    }

    /// The integers of the i-th polynomial, in the order of [`Polynomial::terms`]. O(1).
    ///
    /// # Panics
    /// Where there is no such polynomial.
    pub fn integers(&self, i: usize) -> &[BigInt] {
        &self.integers[i]
    }

    /// The reduced coefficients of the i-th polynomial, with the exponents, in the order of
    /// [`Polynomial::terms`]. One gcd a term, and none where the denominator is 1.
    ///
    /// # Panics
    /// Where there is no such polynomial.
    pub fn coefficients(&self, i: usize) -> impl Iterator<Item = (&[u32], BigRational)> + '_ {
        let exponents = self.polynomials[i].terms.iter().map(|term| &term.exponents[..]);
        exponents.zip(&self.integers[i]).map(|(exponents, integer)| {
            let value = match self.denominator.is_one() {
                true => BigRational::from_integer(integer.clone()),
                false => fraction(integer.clone(), self.denominator.clone()),
            };
            (exponents, value)
        })
    }
}

/// `n!/e!` for `e = 0 … n`, for each symbol with its highest exponent n.
fn factorial_ratios<'a>(polynomials: &[&'a Polynomial]) -> BTreeMap<&'a Symbol, Vec<BigInt>> {
    let mut highest = BTreeMap::<&Symbol, u32>::new();
    for p in polynomials {
        for (column, x) in p.symbols.iter().enumerate() {
            let own = p.terms.iter().map(|term| term.exponents[column]).max().unwrap_or(0);
            let known = highest.entry(x).or_default();
            *known = own.max(*known);
        }
    }
    let table = |n: u32| {
        let mut ratios = vec![BigInt::one(); n as usize + 1];
        for e in (0..n as usize).rev() {
            ratios[e] = &ratios[e + 1] * (e + 1);
        }
        ratios
    };
    highest.into_iter().map(|(x, n)| (x, table(n))).collect()
}
