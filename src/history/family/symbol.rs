//! Exact values in which a symbol takes all values from one to another.

use crate::ball::Arithmetic as _;
use crate::enclosure::{EnclosureError, Numbers};
use crate::expression::{Constant, Definition, Fraction, Root};
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::signal::Varying;
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// A symbol and the values that it takes, and constants that have names.
pub struct OverSymbol<'a> {
    pub symbol: &'a Symbol,
    pub between: [&'a Rational; 2],
    pub constants: &'a [Constant],
}

impl OverSymbol<'_> {
    /// The value of a factor times a root, for each value of the symbol.
    ///
    /// # Errors
    /// [`EnclosureError::MissingValue`] for any other symbol; [`EnclosureError::NotReal`];
    /// [`EnclosureError::Ball`] where a divisor may be zero, or varies too much.
    pub fn root(&self, value: &Root) -> Result<Varying, EnclosureError> {
        let factor = self.fraction(value.factor())?;
        if value.radicand().is_one() {
            return Ok(factor);
        }
        let root = self.fraction(value.radicand())?.sqrt(BITS);
        Ok(factor.multiply(&root.ok_or(EnclosureError::NotReal)?, BITS))
    }

    /// The same of a fraction.
    pub fn fraction(&self, value: &Fraction) -> Result<Varying, EnclosureError> {
        let mut result = self.polynomial(value.numerator())?;
        for (factor, power) in value.factors() {
            let inverse = self.polynomial(factor)?.reciprocal(BITS)?;
            result = (0..power).fold(result, |result, _| result.multiply(&inverse, BITS));
        }
        Ok(result)
    }

    /// The real and the imaginary part of a fraction.
    pub fn complex(&self, value: &Fraction) -> Result<[Varying; 2], EnclosureError> {
        let i = Symbol::square_root(-1).expect("the imaginary unit");
        if value.factors().any(|(factor, _)| factor.symbols().contains(&i)) {
            return Err(EnclosureError::NotReal);
        }
        // Where i² = −1 was put in, i is left in no higher power.
        let parts = [value.substitute(&i, &Fraction::zero())?, value.derivative(&i)];
        Ok([self.fraction(&parts[0])?, self.fraction(&parts[1])?])
    }

    fn polynomial(&self, p: &Polynomial) -> Result<Varying, EnclosureError> {
        let values: Vec<Varying> =
            p.symbols().iter().map(|symbol| self.value(symbol)).collect::<Result<_, _>>()?;
        let terms = p.terms().map(|(exponents, coefficient)| {
            let factors = values.iter().zip(exponents);
            let factors = factors.flat_map(|(value, exponent)| (0..*exponent).map(move |_| value));
            let constant = Varying::constant(&coefficient, BITS);
            factors.fold(constant, |product, factor| product.multiply(factor, BITS))
        });
        Ok(terms.fold(Varying::zero(), |sum, term| sum.add(&term, BITS)))
    }

    fn value(&self, symbol: &Symbol) -> Result<Varying, EnclosureError> {
        if symbol == self.symbol {
            return Ok(Varying::between(self.between, BITS));
        }
        match self.constants.iter().find(|constant| constant.symbol == *symbol) {
            // It may hold the symbol.
            Some(Constant { value: Definition::Root(root), .. }) => self.root(root),
            _ => Ok(Numbers::new(self.constants).enclose(&Fraction::symbol(symbol), BITS)?.into()),
        }
    }
}
