//! Exact values in which a symbol takes all values from one to another.

use crate::ball::{Arithmetic, Ball, Varying};
use crate::enclosure::error::EnclosureError;
use crate::expression::{Constant, Definition, Fraction, Root};
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// A symbol and the values that it takes, and constants that have names.
#[derive(Clone)]
pub struct OverSymbol<'a> {
    pub symbol: &'a Symbol,
    pub between: [&'a Rational; 2],
    pub constants: &'a [Constant],
    pub bits: u64,
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
        let root = self.fraction(value.radicand())?.sqrt(self.bits);
        Ok(factor.multiply(&root.ok_or(EnclosureError::NotReal)?, self.bits))
    }

    /// The same of a fraction.
    ///
    /// # Errors
    /// As [`OverSymbol::root`].
    pub fn fraction(&self, value: &Fraction) -> Result<Varying, EnclosureError> {
        let mut result = self.polynomial(value.numerator())?;
        for (factor, power) in value.factors() {
            let inverse = self.polynomial(factor)?.reciprocal(self.bits)?;
            for _ in 0..power {
                result = result.multiply(&inverse, self.bits);
            }
        }
        Ok(result)
    }

    fn polynomial(&self, p: &Polynomial) -> Result<Varying, EnclosureError> {
        let values: Vec<Varying> =
            p.symbols().iter().map(|symbol| self.value(symbol)).collect::<Result<_, _>>()?;
        let mut sum = Varying::zero();
        for (exponents, coefficient) in p.terms() {
            let mut term = Varying::constant(&coefficient, self.bits);
            for (value, exponent) in values.iter().zip(exponents) {
                for _ in 0..*exponent {
                    term = term.multiply(value, self.bits);
                }
            }
            sum = sum.add(&term, self.bits);
        }
        Ok(sum)
    }

    fn value(&self, symbol: &Symbol) -> Result<Varying, EnclosureError> {
        if symbol == self.symbol {
            return Ok(Varying::between(self.between, self.bits));
        }
        let missing = || EnclosureError::MissingValue(symbol.clone());
        if let Some(square) = symbol.square() {
            let root = Ball::square_root(&Rational::from_integer(square.into()), self.bits);
            return root.map(Varying::from).ok_or(EnclosureError::NotReal);
        }
        match self.constants.iter().find(|constant| constant.symbol == *symbol) {
            Some(Constant { value: Definition::Root(root), .. }) => self.root(root),
            None if symbol.name() == "pi" => Ok(Ball::pi(self.bits).into()),
            _ => Err(missing()),
        }
    }
}
