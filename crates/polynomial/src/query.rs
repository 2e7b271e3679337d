//! Degrees, terms, coefficients and content.

use crate::binomial::{factorial, multiply_by_factorial};
use crate::integer::{fraction, gcd, lcm};
use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use crate::term::Term;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

impl Polynomial {
    /// Whether this is 0. O(1).
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Whether this is 1. O(1).
    pub fn is_one(&self) -> bool {
        match &self.terms[..] {
            [only] => {
                self.symbols.is_empty() && self.denominator.is_one() && only.numerator.is_one()
            }
            _ => false,
        }
    }

    /// The value, where no symbol occurs. O(1).
    pub fn as_constant(&self) -> Option<BigRational> {
        match &self.terms[..] {
            [] => Some(BigRational::zero()),
            [only] if self.symbols.is_empty() => {
                Some(BigRational::new_raw(only.numerator.clone(), self.denominator.clone()))
            }
            _ => None,
        }
    }

    /// The symbols that occur, ascending by name. O(1).
    pub fn symbols(&self) -> &[Symbol] {
        &self.symbols
    }

    /// The number of terms. O(1).
    pub fn term_count(&self) -> usize {
        self.terms.len()
    }

    /// The degree in `x`: 0 where `x` does not occur, and for the zero polynomial. O(terms).
    pub fn degree(&self, x: &Symbol) -> u32 {
        let column = self.column(x);
        column.map_or(0, |i| self.terms.iter().map(|term| term.exponents[i]).max().unwrap_or(0))
    }

    /// The largest sum of exponents in one term; 0 for the zero polynomial. O(terms).
    pub fn total_degree(&self) -> u32 {
        self.terms.iter().map(|term| term.exponents.iter().sum()).max().unwrap_or(0)
    }

    /// The terms in the documented order: exponents by [`Polynomial::symbols`], and the reduced
    /// coefficient of the *ordinary* powers. One gcd a term.
    pub fn terms(&self) -> impl Iterator<Item = (&[u32], BigRational)> + '_ {
        self.terms.iter().map(|term| {
            let mut denominator = self.denominator.clone();
            term.exponents.iter().for_each(|e| multiply_by_factorial(&mut denominator, *e));
            (&term.exponents[..], fraction(term.numerator.clone(), denominator))
        })
    }

    /// The shared denominator `d` and the integers `c_α` of the divided-power form, in the
    /// documented order. O(1) a term.
    pub fn divided_terms(&self) -> (&BigInt, impl Iterator<Item = (&[u32], &BigInt)> + '_) {
        let terms = self.terms.iter().map(|term| (&term.exponents[..], &term.numerator));
        (&self.denominator, terms)
    }

    /// The coefficient of the first term in the documented order, of ordinary powers; 0 for 0.
    /// One gcd.
    pub fn leading_coefficient(&self) -> BigRational {
        self.terms().next().map_or_else(BigRational::zero, |(_, coefficient)| coefficient)
    }

    /// The non-zero coefficients of `x^j` (ordinary powers), `j` descending, each a polynomial in
    /// the other symbols. O(terms · log), and gcds with `j!`.
    pub fn coefficients(&self, x: &Symbol) -> Vec<(u32, Polynomial)> {
        let mut coefficients = self.divided_coefficients(x);
        for (power, coefficient) in &mut coefficients {
            *coefficient = &*coefficient / &BigRational::from_integer(factorial(*power));
        }
        coefficients
    }

    /// The non-zero coefficients of `x^j/j!`, `j` descending, each a polynomial in the other
    /// symbols. O(terms · log).
    pub fn divided_coefficients(&self, x: &Symbol) -> Vec<(u32, Polynomial)> {
        let Some(column) = self.column(x) else {
            return if self.is_zero() { Vec::new() } else { vec![(0, self.clone())] };
        };
        let mut by_power = BTreeMap::<u32, Vec<Term>>::new();
        for term in &self.terms {
            let mut others = term.clone();
            let power = std::mem::take(&mut others.exponents[column]);
            by_power.entry(power).or_default().push(others);
        }
        let normal =
            |terms| Polynomial::from_parts(self.symbols.clone(), terms, self.denominator.clone());
        by_power.into_iter().rev().map(|(power, terms)| (power, normal(terms))).collect()
    }

    /// The content: the positive rational `c` such that `p/c` has coprime integer coefficients in
    /// ordinary powers; 0 for 0. Three gcds a term.
    pub fn content(&self) -> BigRational {
        let mut numerator = BigInt::zero();
        let mut denominator = BigInt::one();
        for (_, coefficient) in self.terms() {
            numerator = gcd(&numerator, coefficient.numer());
            denominator = lcm(&denominator, coefficient.denom());
        }
        BigRational::new_raw(numerator, denominator)
    }

    /// `(c, p/c)` with `p/c` *primitive*: coprime integer coefficients in ordinary powers, the
    /// leading one positive, `c` of the sign that makes it so. `(0, 0)` for 0. Three gcds a term.
    pub fn primitive_part(&self) -> (BigRational, Polynomial) {
        if self.is_zero() {
            return (BigRational::zero(), Polynomial::zero());
        }
        let leading_is_negative = self.terms[0].numerator.is_negative();
        let content = if leading_is_negative { -self.content() } else { self.content() };
        let primitive = self / &content;
        (content, primitive)
    }
}
