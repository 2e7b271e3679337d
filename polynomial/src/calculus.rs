//! Derivative, antiderivative, substitution, Taylor shift, evaluation.

use crate::arithmetic::{Accumulator, common_symbols, spread_terms};
use crate::polynomial::{Monomial, Polynomial, Term};
use crate::symbol::Symbol;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::One;
use std::sync::Arc;

impl Polynomial {
    /// The partial derivative `∂p/∂x`: in divided powers, exponents of `x` go down by one.
    /// O(terms).
    ///
    /// ```
    /// use wavestep_polynomial::{Polynomial, Symbol};
    /// let p: Polynomial = "x^3*y + x".parse().unwrap();
    /// assert_eq!(p.derivative(&Symbol::new("x").unwrap()).to_string(), "3*x^2*y + 1");
    /// ```
    pub fn derivative(&self, x: &Symbol) -> Polynomial {
        let Some(column) = self.column(x) else { return Polynomial::zero() };
        let lowered = self.terms.iter().filter(|term| term.exponents[column] > 0).map(|term| {
            let mut term = term.clone();
            term.exponents[column] -= 1;
            term
        });
        let terms = lowered.collect();
        Polynomial::from_parts(self.symbols.clone(), terms, self.denominator.clone())
    }

    /// The antiderivative `∫_0^x p dx`, which is zero at `x = 0`: in divided powers, exponents of
    /// `x` go up by one. O(terms).
    ///
    /// ```
    /// use wavestep_polynomial::{Polynomial, Symbol};
    /// let p: Polynomial = "3*x^2*y + 1".parse().unwrap();
    /// assert_eq!(p.antiderivative(&Symbol::new("x").unwrap()).to_string(), "x^3*y + x");
    /// ```
    pub fn antiderivative(&self, x: &Symbol) -> Polynomial {
        let symbols = common_symbols(&self.symbols, &Arc::from([x.clone()]));
        let column = symbols.binary_search(x).expect("x is among the common symbols");
        let raised = spread_terms(self, &symbols).map(|(mut exponents, numerator)| {
            exponents[column] =
                exponents[column].checked_add(1).expect("exponents stay below 2^32");
            Term { exponents, numerator: numerator.clone() }
        });
        let terms = raised.collect();
        Polynomial::from_parts(symbols, terms, self.denominator.clone())
    }

    /// `p` with the polynomial `value` in place of `x`. The divided powers of `value` are formed
    /// once; then as many products of terms as the answer adds up.
    ///
    /// ```
    /// use wavestep_polynomial::{Polynomial, Symbol};
    /// let p: Polynomial = "s^2 + mu".parse().unwrap();
    /// let at = p.substitute(&Symbol::new("s").unwrap(), &"2*mu".parse().unwrap());
    /// assert_eq!(at.to_string(), "4*mu^2 + mu");
    /// ```
    pub fn substitute(&self, x: &Symbol, value: &Polynomial) -> Polynomial {
        let Some(column) = self.column(x) else { return self.clone() };
        let symbols = common_symbols(&self.symbols, &value.symbols);
        let powers = divided_powers(value, self.degree(x));
        let denominator = powers.iter().fold(BigInt::one(), |d, p| d.lcm(&p.denominator));
        let powers: Vec<Vec<(Monomial, BigInt)>> = powers
            .iter()
            .map(|power| {
                let scale = &denominator / &power.denominator;
                let scaled = spread_terms(power, &symbols);
                scaled.map(|(exponents, numerator)| (exponents, numerator * &scale)).collect()
            })
            .collect();
        let wide_column = symbols.binary_search(x).unwrap_or(column);
        let mut sums = Accumulator::default();
        for (mut exponents, numerator) in spread_terms(self, &symbols) {
            let power = std::mem::take(&mut exponents[wide_column]);
            sums.add_product(std::iter::once((exponents, numerator)), &powers[power as usize]);
        }
        sums.finish(symbols, denominator * &self.denominator)
    }

    /// The Taylor shift `p(x + step)`. Cost as for [`Polynomial::substitute`]; a shift by an
    /// integer or an integer multiple of a symbol makes no denominator.
    ///
    /// ```
    /// use wavestep_polynomial::{Polynomial, Symbol};
    /// let p: Polynomial = "x^2".parse().unwrap();
    /// let shifted = p.shift(&Symbol::new("x").unwrap(), &"h".parse().unwrap());
    /// assert_eq!(shifted.to_string(), "h^2 + 2*h*x + x^2");
    /// ```
    pub fn shift(&self, x: &Symbol, step: &Polynomial) -> Polynomial {
        self.substitute(x, &(&Polynomial::symbol(x) + step))
    }

    /// The value where every symbol has a value, or the first symbol that has none. Cost as for
    /// one [`Polynomial::substitute`] a symbol.
    ///
    /// ```
    /// use wavestep_polynomial::{Polynomial, Rational, Symbol};
    /// let p: Polynomial = "x^2 - 1/4".parse().unwrap();
    /// let half = Rational::new(1.into(), 2.into());
    /// let value = p.evaluate(|_: &Symbol| Some(half.clone())).unwrap();
    /// assert_eq!(value, Rational::from_integer(0.into()));
    /// ```
    ///
    /// # Errors
    /// The symbol for which `values` answers `None`.
    pub fn evaluate(
        &self,
        values: impl Fn(&Symbol) -> Option<BigRational>,
    ) -> Result<BigRational, Symbol> {
        let mut value = self.clone();
        for symbol in self.symbols.iter() {
            let given = values(symbol).ok_or_else(|| symbol.clone())?;
            value = value.substitute(symbol, &Polynomial::constant(&given));
        }
        Ok(value.as_constant().expect("no symbol is left"))
    }
}

/// `q^[0], …, q^[degree]` with `q^[j] = q^j/j!`.
fn divided_powers(q: &Polynomial, degree: u32) -> Vec<Polynomial> {
    let mut powers = vec![Polynomial::one()];
    for j in 1..=degree {
        let next = &powers[j as usize - 1] * q;
        powers.push(&next / &BigRational::from_integer(j.into()));
    }
    powers
}
