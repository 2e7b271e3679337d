//! The sparse multivariate polynomial: its representation, its normal form, its constructors.

use crate::alignment::Places;
use crate::binomial::multiply_by_factorial;
use crate::integer::gcd;
use crate::reduction::reduce_roots;
use crate::symbol::Symbol;
use crate::term::{MAX_EXPONENT, Monomial, Term, add_exponents};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::sync::Arc;

/// A polynomial over the rationals in named symbols.
///
/// ```text
/// p = (1/d) Σ_α c_α Π_i x_i^{α_i} / α_i!         c_α, d integers, d > 0
/// ```
///
/// Coefficients are held in the *divided-power* basis `x^[j] = x^j/j!`, as integers over one
/// shared denominator `d`: there a derivative and an antiderivative are shifts of exponents, a
/// Taylor shift by a symbol makes no denominator, and no fraction is reduced until it is shown.
///
/// # Order of terms
/// Symbols are ordered by name. Terms are in descending lexicographic order of their exponents,
/// the first symbol weighing most. Polynomials are ordered (`Ord`) by symbols, terms, then
/// denominator: a total order without algebraic meaning, for use as keys.
///
/// # Limits
/// An exponent is at most [`Polynomial::MAX_EXPONENT`]: factorials of exponents are formed, and
/// they get long (4095! has 43 kbit). Operations whose result would exceed it panic; the reader returns an error.
///
/// # Invariants
/// - symbols strictly ascending, each with a positive exponent somewhere;
/// - exponents at most [`Polynomial::MAX_EXPONENT`], and at most 1 for square roots;
/// - terms strictly descending, numerators non-zero;
/// - `d > 0` and `gcd(d, all numerators) = 1`; the zero polynomial has `d = 1`.
///
/// Equal polynomials therefore have one representation, and `==` compares it.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Polynomial {
    pub(crate) symbols: Arc<[Symbol]>,
    pub(crate) terms: Vec<Term>,
    pub(crate) denominator: BigInt,
}

impl Polynomial {
    /// The largest exponent of a symbol.
    pub const MAX_EXPONENT: u32 = MAX_EXPONENT;

    /// The polynomial 0. O(1).
    pub fn zero() -> Polynomial {
        Polynomial { symbols: Arc::default(), terms: Vec::new(), denominator: BigInt::one() }
    }

    /// The polynomial 1. O(1).
    pub fn one() -> Polynomial {
        Polynomial::integer(1)
    }

    /// An integer constant. O(1).
    pub fn integer(value: impl Into<BigInt>) -> Polynomial {
        Polynomial::constant(&BigRational::from_integer(value.into()))
    }

    /// A rational constant. O(1).
    pub fn constant(value: &BigRational) -> Polynomial {
        let mut constant = Polynomial::zero();
        if !value.is_zero() {
            let term = Term { exponents: Monomial::new(), numerator: value.numer().clone() };
            constant.terms.push(term);
            constant.denominator = value.denom().clone();
        }
        constant
    }

    /// The polynomial `x`. O(1).
    pub fn symbol(x: &Symbol) -> Polynomial {
        Polynomial::monomial(&BigRational::one(), &[(x, 1)])
    }

    /// The single term `coefficient · Π x_i^{e_i}` (ordinary powers); a symbol may come twice.
    /// One product with a factorial for each symbol.
    pub fn monomial(coefficient: &BigRational, powers: &[(&Symbol, u32)]) -> Polynomial {
        let mut powers = powers.to_vec();
        powers.sort();
        powers.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 = add_exponents(kept.1, next.1);
            }
            same
        });
        let mut numerator = coefficient.numer().clone();
        for (_, exponent) in &powers {
            multiply_by_factorial(&mut numerator, add_exponents(0, *exponent));
        }
        let exponents = powers.iter().map(|(_, e)| *e).collect();
        let symbols = powers.iter().map(|(x, _)| (*x).clone()).collect();
        let terms = vec![Term { exponents, numerator }];
        Polynomial::from_parts(symbols, terms, coefficient.denom().clone())
    }

    /// Brings a value into normal form. `terms` must be strictly descending; zero numerators,
    /// common divisors, unused symbols and powers of square roots are allowed. O(terms), and gcds
    /// while they are not 1.
    pub(crate) fn from_parts(
        symbols: Arc<[Symbol]>,
        mut terms: Vec<Term>,
        mut denominator: BigInt,
    ) -> Polynomial {
        debug_assert!(terms.windows(2).all(|pair| pair[0].exponents > pair[1].exponents));
        if symbols.iter().any(Symbol::is_root) {
            (terms, denominator) = reduce_roots(&symbols, terms, denominator);
        }
        terms.retain(|term| !term.numerator.is_zero());
        if terms.is_empty() {
            return Polynomial::zero();
        }
        if !denominator.is_one() {
            let mut common = denominator.clone();
            for term in &terms {
                if common.is_one() {
                    break;
                }
                common = gcd(&common, &term.numerator);
            }
            if !common.is_one() {
                denominator /= &common;
                terms.iter_mut().for_each(|term| term.numerator /= &common);
            }
        }
        let used = |i: usize| terms.iter().any(|term| term.exponents[i] > 0);
        let keep: Vec<bool> = (0..symbols.len()).map(used).collect();
        let symbols = if keep.iter().all(|keep| *keep) {
            symbols
        } else {
            for term in &mut terms {
                let mut column = keep.iter();
                term.exponents.retain(|_| *column.next().expect("one exponent a symbol"));
            }
            let kept = symbols.iter().zip(&keep).filter(|(_, keep)| **keep);
            kept.map(|(symbol, _)| symbol.clone()).collect()
        };
        Polynomial { symbols, terms, denominator }
    }

    /// The place of `x` among the symbols.
    pub(crate) fn column(&self, x: &Symbol) -> Option<usize> {
        self.symbols.binary_search(x).ok()
    }

    /// The terms over a longer list of symbols, in the same order. O(terms).
    pub(crate) fn terms_over(&self, symbols: &[Symbol]) -> Vec<Term> {
        let places = Places::new(&self.symbols, symbols);
        let spread = |term: &Term| Term {
            exponents: places.spread(&term.exponents),
            numerator: term.numerator.clone(),
        };
        self.terms.iter().map(spread).collect()
    }

    /// Whether the invariants of the type hold, for tests. O(terms), and gcds while they are
    /// not 1.
    pub fn is_valid(&self) -> bool {
        let width = self.symbols.len();
        let in_form = self.symbols.windows(2).all(|pair| pair[0] < pair[1])
            && self.terms.iter().all(|term| term.exponents.len() == width)
            && self.terms.windows(2).all(|pair| pair[0].exponents > pair[1].exponents)
            && self.terms.iter().flat_map(|term| &term.exponents).all(|e| *e <= Self::MAX_EXPONENT)
            && self.denominator.is_positive();
        let rebuilt = || {
            let (symbols, terms) = (self.symbols.clone(), self.terms.clone());
            Polynomial::from_parts(symbols, terms, self.denominator.clone())
        };
        in_form && rebuilt() == *self
    }
}

impl Default for Polynomial {
    /// The polynomial 0.
    fn default() -> Polynomial {
        Polynomial::zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_invariants_are_seen() {
        let [a, b] = ["a", "b"].map(|name| Polynomial::symbol(&Symbol::new(name).unwrap()));
        let half = Polynomial::constant(&BigRational::new(1.into(), 2.into()));
        let valid = &(&(&half * &a) * &b) + &a;
        assert!(valid.is_valid());
        let damages: [fn(&mut Polynomial); 9] = [
            |p| p.symbols = [p.symbols[1].clone(), p.symbols[0].clone()].into(),
            |p| p.symbols = p.symbols[..1].into(),
            |p| p.terms.reverse(),
            |p| p.terms[1] = p.terms[0].clone(),
            |p| p.terms[0].exponents[0] = Polynomial::MAX_EXPONENT + 1,
            |p| p.terms[0].numerator = BigInt::ZERO,
            |p| p.terms.iter_mut().for_each(|term| term.exponents[1] = 0),
            |p| p.denominator = -p.denominator.clone(),
            |p| p.terms.iter_mut().for_each(|term| term.numerator *= 2),
        ];
        for (i, damage) in damages.iter().enumerate() {
            let mut broken = valid.clone();
            damage(&mut broken);
            assert!(!broken.is_valid(), "case {i}");
        }
        assert!(!Polynomial { denominator: 2.into(), ..Polynomial::zero() }.is_valid());
    }
}
