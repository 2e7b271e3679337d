//! Derivative and antiderivative: in divided powers, shifts of exponents.

use crate::alignment::{Places, common_symbols};
use crate::polynomial::Polynomial;
use crate::symbol::Symbol;
use crate::term::{Term, add_exponents};
use std::sync::Arc;

impl Polynomial {
    /// The partial derivative `∂p/∂x`: exponents of `x` go down by one, `x^[j] → x^[j−1]`.
    /// O(terms).
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

    /// The antiderivative `∫_0^x p dx`, which is zero at `x = 0`: exponents of `x` go up by one,
    /// `x^[j] → x^[j+1]`. O(terms).
    pub fn antiderivative(&self, x: &Symbol) -> Polynomial {
        let symbols = common_symbols(&self.symbols, &Arc::from([x.clone()]));
        let column = symbols.binary_search(x).expect("x is among the common symbols");
        let places = Places::new(&self.symbols, &symbols);
        let raised = self.terms.iter().map(|term| {
            let mut exponents = places.spread(&term.exponents);
            exponents[column] = add_exponents(exponents[column], 1);
            Term { exponents, numerator: term.numerator.clone() }
        });
        let terms = raised.collect();
        Polynomial::from_parts(symbols, terms, self.denominator.clone())
    }
}
