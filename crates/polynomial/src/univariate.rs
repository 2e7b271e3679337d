//! Dense polynomials in one unnamed variable, in the divided-power basis.

use crate::integer::{fraction, gcd, lcm};
use crate::polynomial::Polynomial;
use crate::row::IntegerRow;
use crate::symbol::Symbol;
use crate::term::{Term, add_exponents};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use smallvec::smallvec;
use std::ops::Add;
use std::sync::Arc;

/// A dense polynomial in one variable,
///
/// ```text
/// p(x) = (1/d) Σ_j c_j x^j/j!         c_j, d integers, d > 0
/// ```
///
/// # Invariants
/// - the last `c_j` is not zero (the zero polynomial has none, and `d = 1`);
/// - `d > 0` and `gcd(d, all c_j) = 1`.
///
/// Equal polynomials have one representation.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Univariate {
    coefficients: IntegerRow,
    denominator: BigInt,
}

impl Univariate {
    /// `(1/denominator) Σ_j coefficients_j x^j/j!`. O(degree), and gcds while they are
    /// not 1.
    pub fn new(coefficients: impl IntoIterator<Item = BigInt>, denominator: BigInt) -> Univariate {
        Univariate::from_row(coefficients.into_iter().collect(), denominator)
    }

    /// `(1/denominator) Σ_j coefficients_j x^j/j!`. O(degree), and gcds while they are
    /// not 1.
    pub fn from_row(mut coefficients: IntegerRow, mut denominator: BigInt) -> Univariate {
        assert!(!denominator.is_zero(), "a polynomial over the denominator zero");
        coefficients.trim();
        let mut common = denominator.clone();
        // The last ones first: they are the least likely to share what early ones were scaled by.
        for value in coefficients.iter().rev() {
            if common.is_one() {
                break;
            }
            common = gcd(&common, &value.to_integer());
        }
        if denominator.is_negative() {
            common = -common.abs();
        }
        if !common.is_one() {
            denominator /= &common;
            coefficients = coefficients.iter().map(|value| value.to_integer() / &common).collect();
        }
        Univariate { coefficients, denominator }
    }

    /// The polynomial 0. O(1).
    pub fn zero() -> Univariate {
        Univariate { coefficients: IntegerRow::default(), denominator: BigInt::one() }
    }

    /// A constant. O(1).
    pub fn constant(value: &BigRational) -> Univariate {
        Univariate::new([value.numer().clone()], value.denom().clone())
    }

    /// `p` read as a polynomial in `x`, or `None` where another symbol occurs. O(degree).
    pub fn from_polynomial(p: &Polynomial, x: &Symbol) -> Option<Univariate> {
        if p.symbols().iter().any(|symbol| symbol != x) {
            return None;
        }
        let mut coefficients = vec![BigInt::zero(); p.degree(x) as usize + 1];
        let (denominator, terms) = p.divided_terms();
        for (exponents, numerator) in terms {
            let power = exponents.first().copied().unwrap_or(0);
            coefficients[power as usize] = numerator.clone();
        }
        Some(Univariate::new(coefficients, denominator.clone()))
    }

    /// The same polynomial in the symbol `x`. O(degree).
    pub fn to_polynomial(&self, x: &Symbol) -> Polynomial {
        let descending = self.coefficients.iter().enumerate().rev().map(|(j, numerator)| {
            let exponent = add_exponents(index(j), 0);
            Term { exponents: smallvec![exponent], numerator: numerator.to_integer() }
        });
        let symbols = Arc::from([x.clone()]);
        Polynomial::from_parts(symbols, descending.collect(), self.denominator.clone())
    }

    /// Whether the invariants of the type hold, for tests. O(degree), and gcds while they are
    /// not 1.
    pub fn is_valid(&self) -> bool {
        self.denominator.is_positive()
            && Univariate::from_row(self.coefficients.clone(), self.denominator.clone()) == *self
    }

    /// Whether this is 0. O(1).
    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// The integers `c_0, c_1, …` of the divided-power form; the last is not zero. O(1).
    pub fn coefficients(&self) -> &IntegerRow {
        &self.coefficients
    }

    /// The shared denominator `d > 0`. O(1).
    pub fn denominator(&self) -> &BigInt {
        &self.denominator
    }

    /// `a p + b q`. O(degree) where the factors over the common denominator fit 32 bits.
    fn combination(a: &BigRational, p: &Univariate, b: &BigRational, q: &Univariate) -> Univariate {
        let (below_a, below_b) = (a.denom() * &p.denominator, b.denom() * &q.denominator);
        let denominator = lcm(&below_a, &below_b);
        let a = a.numer() * (&denominator / &below_a);
        let b = b.numer() * (&denominator / &below_b);
        let row = IntegerRow::combination(&a, &p.coefficients, &b, &q.coefficients, 0);
        Univariate::from_row(row, denominator)
    }

    /// `factor · p`. Cost as for `combination`.
    pub fn scale(&self, factor: &BigRational) -> Univariate {
        Univariate::combination(factor, self, &BigRational::zero(), &Univariate::zero())
    }

    /// The derivative: the coefficients go down by one place. O(degree).
    pub fn derivative(&self) -> Univariate {
        let mut lowered = IntegerRow::default();
        self.coefficients.iter().skip(1).for_each(|value| lowered.push(value));
        Univariate::from_row(lowered, self.denominator.clone())
    }

    /// The value at a rational point, by Horner's rule `c_j + x/(j+1) (…)`. O(degree) products.
    pub fn evaluate(&self, x: &BigRational) -> BigRational {
        // numerator / (den(x)^k k!), brought to one denominator step by step.
        let mut numerator = BigInt::zero();
        let mut scale = BigInt::one();
        for (j, coefficient) in self.coefficients.iter().enumerate().rev() {
            let step = x.denom() * BigInt::from(j + 1);
            numerator *= x.numer();
            scale *= step;
            numerator += coefficient.to_integer() * &scale;
        }
        fraction(numerator, scale * &self.denominator)
    }
}

/// A place among the coefficients as an exponent. Memory ends long before 2^32 coefficients.
fn index(j: usize) -> u32 {
    u32::try_from(j).expect("an exponent fits 32 bits")
}

impl Add for &Univariate {
    type Output = Univariate;
    /// O(degree).
    fn add(self, other: &Univariate) -> Univariate {
        Univariate::combination(&BigRational::one(), self, &BigRational::one(), other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_invariants_are_seen() {
        let broken = |coefficients: &[i64], denominator: i64| {
            let coefficients = coefficients.iter().map(|c| BigInt::from(*c)).collect();
            !Univariate { coefficients, denominator: denominator.into() }.is_valid()
        };
        assert!(!broken(&[1, 2], 2));
        assert!(broken(&[1, 0], 2));
        assert!(broken(&[1, 2], -2));
        assert!(broken(&[4, 2], 2));
        assert!(broken(&[], 2));
        assert!(broken(&[1], 0));
    }
}
