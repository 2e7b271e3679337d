//! Products, powers, multiples by a number.

use crate::alignment::{Places, common_symbols};
use crate::binomial::multiply_by_binomial;
use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use crate::term::{Monomial, Term, add_exponents};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::ops::{Div, Mul};
use std::sync::Arc;

/// A sum of products in the making, over one list of symbols and one denominator.
#[derive(Default)]
pub(crate) struct Accumulator {
    sums: BTreeMap<Monomial, BigInt>,
}

impl Accumulator {
    /// Adds the product of one term with many, all over the symbols of the accumulator.
    /// O(terms · log).
    pub fn add_product(&mut self, exponents: &Monomial, numerator: &BigInt, others: &[Term]) {
        for other in others {
            let mut value = numerator * &other.numerator;
            let mut place = Monomial::from_slice(exponents);
            for (sum, e) in place.iter_mut().zip(&other.exponents) {
                multiply_by_binomial(&mut value, *sum, *e);
                *sum = add_exponents(*sum, *e);
            }
            match self.sums.entry(place) {
                Entry::Vacant(place) => {
                    place.insert(value);
                }
                Entry::Occupied(mut place) => *place.get_mut() += value,
            }
        }
    }

    /// The sum over `denominator`, in normal form. O(terms), and gcds while they are not 1.
    pub fn finish(self, symbols: Arc<[Symbol]>, denominator: BigInt) -> Polynomial {
        let descending = self.sums.into_iter().rev();
        let terms = descending.map(|(exponents, numerator)| Term { exponents, numerator });
        Polynomial::from_parts(symbols, terms.collect(), denominator)
    }
}

fn product(left: &Polynomial, right: &Polynomial) -> Polynomial {
    if let Some(value) = right.as_constant() {
        return scale(left, &value);
    }
    if let Some(value) = left.as_constant() {
        return scale(right, &value);
    }
    let symbols = common_symbols(&left.symbols, &right.symbols);
    let others = right.terms_over(&symbols);
    let places = Places::new(&left.symbols, &symbols);
    let mut sums = Accumulator::default();
    for term in &left.terms {
        sums.add_product(&places.spread(&term.exponents), &term.numerator, &others);
    }
    sums.finish(symbols, &left.denominator * &right.denominator)
}

fn scale(p: &Polynomial, factor: &BigRational) -> Polynomial {
    let mut terms = p.terms.clone();
    if !factor.numer().is_one() {
        terms.iter_mut().for_each(|term| term.numerator *= factor.numer());
    }
    Polynomial::from_parts(p.symbols.clone(), terms, &p.denominator * factor.denom())
}

impl Mul for &Polynomial {
    type Output = Polynomial;
    /// O(terms of one × terms of the other × log).
    fn mul(self, other: &Polynomial) -> Polynomial {
        product(self, other)
    }
}

impl Mul<&BigRational> for &Polynomial {
    type Output = Polynomial;
    /// O(terms).
    fn mul(self, factor: &BigRational) -> Polynomial {
        scale(self, factor)
    }
}

impl Div<&BigRational> for &Polynomial {
    type Output = Polynomial;
    /// O(terms).
    fn div(self, divisor: &BigRational) -> Polynomial {
        scale(self, &divisor.recip())
    }
}

impl Polynomial {
    /// `p^exponent`, by repeated squaring; `p^0 = 1`, also for 0. O(log exponent) products.
    pub fn pow(&self, exponent: u32) -> Polynomial {
        power(Polynomial::one(), self, exponent.into(), |a, b| a * b)
    }
}

/// `base^exponent`, by repeated squaring from `one`. O(log exponent) products.
#[doc(hidden)]
pub fn power<T>(one: T, base: &T, exponent: u64, product: impl Fn(&T, &T) -> T) -> T {
    let mut power = one;
    for bit in (0..u64::BITS - exponent.leading_zeros()).rev() {
        power = product(&power, &power);
        if exponent >> bit & 1 == 1 {
            power = product(&power, base);
        }
    }
    power
}
