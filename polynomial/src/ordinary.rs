//! Ordinary powers over one denominator, for writing.

use crate::integer::{fraction, gcd};
use crate::polynomial::Polynomial;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// A polynomial in ordinary powers, as integers over their least common denominator:
///
/// ```text
/// p = (1/m) Σ_α n_α Π_i x_i^{α_i}         gcd(m, all n_α) = 1
/// ```
///
/// ```
/// use wavestep_polynomial::{Polynomial, Rational};
/// let p: Polynomial = "1/2*x^2 - 1/3*x".parse().unwrap();
/// let ordinary = p.ordinary(&1.into()); // (3x² − 2x)/6
/// assert_eq!(*ordinary.denominator(), 6.into());
/// let mut coefficients = ordinary.coefficients();
/// assert_eq!(coefficients.next(), Some((&[2][..], Rational::new(1.into(), 2.into()))));
/// ```
pub struct Ordinary<'a> {
    polynomial: &'a Polynomial,
    denominator: BigInt,
    numerators: Vec<BigInt>,
}

impl Polynomial {
    /// `p / divisor` in ordinary powers. A product for each symbol of a term, and one division a
    /// term: the gcd with the denominator soon no longer changes.
    ///
    /// ```
    /// use wavestep_polynomial::{Integer, Polynomial};
    /// let p: Polynomial = "2*x^2 + 3*x".parse().unwrap();
    /// let sixth = p.ordinary(&6.into()); // (2x² + 3x)/6
    /// assert_eq!(*sixth.denominator(), Integer::from(6));
    /// let twelfths: Vec<Integer> = sixth.integers(&12.into()).map(|(_, n)| n).collect();
    /// assert_eq!(twelfths, [4, 6].map(Integer::from));
    /// ```
    ///
    /// # Panics
    /// Where `divisor` is not positive.
    pub fn ordinary(&self, divisor: &BigInt) -> Ordinary<'_> {
        assert!(divisor.is_positive(), "coefficients over {divisor}");
        let mut denominator = &self.denominator * divisor;
        let tables: Vec<Vec<BigInt>> = (0..self.symbols.len())
            .map(|column| {
                let exponents = self.terms.iter().map(|term| term.exponents[column]);
                let table = factorial_ratios(exponents.max().unwrap_or(0));
                denominator *= &table[0];
                table
            })
            .collect();
        // So far: the common divisor of the denominator and the numerators divided by it.
        let mut common = denominator.clone();
        let mut numerators: Vec<BigInt> = Vec::with_capacity(self.terms.len());
        for term in &self.terms {
            let mut numerator = term.numerator.clone();
            for (table, exponent) in tables.iter().zip(&term.exponents) {
                let ratio = &table[*exponent as usize];
                if !ratio.is_one() {
                    numerator *= ratio;
                }
            }
            if common.is_one() {
                numerators.push(numerator);
                continue;
            }
            let (mut quotient, rest) = numerator.div_rem(&common);
            if !rest.is_zero() {
                let smaller = gcd(&common, &rest);
                let scale = &common / &smaller;
                numerators.iter_mut().for_each(|numerator| *numerator *= &scale);
                quotient = numerator / &smaller;
                common = smaller;
            }
            numerators.push(quotient);
        }
        Ordinary { polynomial: self, denominator: denominator / common, numerators }
    }
}

/// `n!/e!` for `e = 0 … n`.
fn factorial_ratios(n: u32) -> Vec<BigInt> {
    let mut ratios = vec![BigInt::one(); n as usize + 1];
    for e in (0..n as usize).rev() {
        ratios[e] = &ratios[e + 1] * (e + 1);
    }
    ratios
}

impl Ordinary<'_> {
    /// The least positive integer by which all coefficients become integers. O(1).
    pub fn denominator(&self) -> &BigInt {
        &self.denominator
    }

    /// The coefficients times `common`, a multiple of the denominator, with the exponents, in the
    /// order of [`Polynomial::terms`]. One product a term, and none where `common` is the
    /// denominator.
    ///
    /// # Panics
    /// Where `common` is no multiple of the denominator.
    pub fn integers(&self, common: &BigInt) -> impl Iterator<Item = (&[u32], BigInt)> + use<'_> {
        let (factor, rest) = common.div_rem(&self.denominator);
        assert!(rest.is_zero(), "{common} is no common denominator");
        let exponents = self.polynomial.terms.iter().map(|term| &term.exponents[..]);
        exponents.zip(&self.numerators).map(move |(exponents, numerator)| {
            (exponents, if factor.is_one() { numerator.clone() } else { numerator * &factor })
        })
    }

    /// The reduced coefficients, with the exponents, in the order of [`Polynomial::terms`]. One
    /// gcd a term, and none where the denominator is 1.
    pub fn coefficients(&self) -> impl Iterator<Item = (&[u32], BigRational)> + '_ {
        let exponents = self.polynomial.terms.iter().map(|term| &term.exponents[..]);
        exponents.zip(&self.numerators).map(|(exponents, numerator)| {
            let value = match self.denominator.is_one() {
                true => BigRational::from_integer(numerator.clone()),
                false => fraction(numerator.clone(), self.denominator.clone()),
            };
            (exponents, value)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_are_those_of_the_polynomial() {
        for text in
            ["0", "7/3", "x", "4/3*x^3 - 1/6*x", "1/2*x^2*y^5 + 3/35*x*y - 9/8", "6*x^9 - 12*y^4"]
        {
            let p: Polynomial = text.parse().unwrap();
            for divisor in [1, 2, 12, 35] {
                let divided = &p / &BigRational::from_integer(divisor.into());
                let ordinary = p.ordinary(&divisor.into());
                assert!(ordinary.coefficients().eq(divided.terms()), "({text})/{divisor}");
                let common = ordinary.denominator() * 5;
                let back =
                    ordinary.integers(&common).map(|(e, n)| (e, fraction(n, common.clone())));
                assert!(back.eq(divided.terms()), "({text})/{divisor}");
                let all = divided.terms().fold(BigInt::one(), |d, (_, c)| d.lcm(c.denom()));
                assert_eq!(*ordinary.denominator(), all, "({text})/{divisor}");
            }
        }
    }

    #[test]
    #[should_panic(expected = "coefficients over 0")]
    fn the_divisor_is_positive() {
        let _ = Polynomial::one().ordinary(&BigInt::ZERO);
    }
}
