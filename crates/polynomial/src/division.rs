//! Exact division.

use crate::alignment::{Places, common_symbols};
use crate::binomial::multiply_by_factorial;
use crate::integer::lcm;
use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use crate::term::{Monomial, Term};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

impl Polynomial {
    /// The quotient `p / divisor` where it is a polynomial, else `None`. O(terms of the
    /// quotient × terms of the divisor × log), and no fraction: a primitive integer polynomial
    /// divides an integer polynomial only with an integer quotient (Gauss's lemma).
    ///
    /// A divisor with square roots is first multiplied, together with the dividend, by its
    /// conjugates until it has none: `p/d = p m/(d m)`. The polynomials with square roots have no
    /// divisors of zero, so one quotient exists where the other does.
    pub fn divide(&self, divisor: &Polynomial) -> Option<Polynomial> {
        assert!(!divisor.is_zero(), "division by the zero polynomial");
        if let Some(value) = divisor.as_constant() {
            return Some(self / &value);
        }
        if self.is_zero() {
            return Some(Polynomial::zero());
        }
        if divisor.roots().next().is_some() {
            let (multiplier, norm) = divisor.norm();
            return (self * &multiplier).divide(&norm);
        }
        let symbols = common_symbols(&self.symbols, &divisor.symbols);
        // Degrees of a product are sums of degrees: these are the quotient's.
        let degrees = symbols.iter().map(|x| self.degree(x).checked_sub(divisor.degree(x)));
        let degrees: Monomial = degrees.collect::<Option<_>>()?;
        let (content, primitive) = divisor.primitive_part();
        let (divisor, _) = ordinary(&primitive, &symbols);
        let (mut rest, scale) = ordinary(self, &symbols);
        let (lead, lead_value) = divisor.last_key_value().expect("the divisor is not zero");
        let mut quotient = Vec::new();
        while let Some((exponents, value)) = rest.last_key_value() {
            let differences = exponents.iter().zip(lead).map(|(e, l)| e.checked_sub(*l));
            let step = differences.collect::<Option<Monomial>>()?;
            let (factor, remainder) = value.div_rem(lead_value);
            if !remainder.is_zero() || step.iter().zip(&degrees).any(|(e, degree)| e > degree) {
                return None;
            }
            for (exponents, value) in &divisor {
                let place = exponents.iter().zip(&step).map(|(a, b)| a + b).collect();
                let mut entry = match rest.entry(place) {
                    Entry::Occupied(entry) => entry,
                    Entry::Vacant(entry) => entry.insert_entry(BigInt::zero()),
                };
                *entry.get_mut() -= value * &factor;
                if entry.get().is_zero() {
                    entry.remove();
                }
            }
            quotient.push((step, factor));
        }
        let quotient = from_ordinary(symbols, quotient);
        Some(&quotient / &(content * BigRational::from_integer(scale)))
    }
}

/// The integer coefficients of `scale · p` in ordinary powers, with the smallest such scale.
fn ordinary(p: &Polynomial, symbols: &[Symbol]) -> (BTreeMap<Monomial, BigInt>, BigInt) {
    let coefficients: Vec<BigRational> = p.terms().map(|(_, coefficient)| coefficient).collect();
    let scale = coefficients.iter().fold(BigInt::one(), |d, c| lcm(&d, c.denom()));
    let integers = coefficients.iter().map(|c| c.numer() * (&scale / c.denom()));
    let places = Places::new(&p.symbols, symbols);
    let exponents = p.terms.iter().map(|term| places.spread(&term.exponents));
    (exponents.zip(integers).collect(), scale)
}

/// The polynomial with these integer coefficients of ordinary powers, exponents descending.
fn from_ordinary(symbols: Arc<[Symbol]>, terms: Vec<(Monomial, BigInt)>) -> Polynomial {
    let divided = terms.into_iter().map(|(exponents, mut numerator)| {
        exponents.iter().for_each(|e| multiply_by_factorial(&mut numerator, *e));
        Term { exponents, numerator }
    });
    Polynomial::from_parts(symbols, divided.collect(), BigInt::one())
}
