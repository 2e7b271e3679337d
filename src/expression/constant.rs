//! Square roots of exact values, and constants that are named instead of worked out.

use crate::expression::fraction::{Fraction, NotAUnit};
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use wavestep_polynomial::{Rational, Symbol};

/// A value `factor · √radicand`, the radicand positive. Impedances `A √(Eρ)` and travel times
/// `L √(ρ/E)` are such values.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Root {
    factor: Fraction,
    radicand: Fraction,
}

impl Root {
    /// `√radicand`.
    pub fn of(radicand: Fraction) -> Root {
        Root { factor: Fraction::one(), radicand }.normal()
    }

    pub fn factor(&self) -> &Fraction {
        &self.factor
    }

    /// The radicand; 1 where the value is a fraction.
    pub fn radicand(&self) -> &Fraction {
        &self.radicand
    }

    /// The value without a root, where it needs none.
    pub fn exact(&self) -> Option<Fraction> {
        self.radicand.is_one().then(|| self.factor.clone())
    }

    pub fn times(&self, other: &Root) -> Root {
        let factor = &self.factor * &other.factor;
        Root { factor, radicand: &self.radicand * &other.radicand }.normal()
    }

    pub fn over(&self, other: &Root) -> Result<Root, NotAUnit> {
        let factor = &self.factor * &other.factor.inverse()?;
        let radicand = &self.radicand * &other.radicand.inverse()?;
        Ok(Root { factor, radicand }.normal())
    }

    fn normal(mut self) -> Root {
        if self.factor.is_zero() {
            return Root::from(self.factor);
        }
        if let Some(root) = self.radicand.as_constant().as_ref().and_then(rational_square_root) {
            self.factor = self.factor.scale(&root);
            self.radicand = Fraction::one();
        }
        self
    }
}

impl From<Fraction> for Root {
    fn from(factor: Fraction) -> Root {
        Root { factor, radicand: Fraction::one() }
    }
}

impl From<&Fraction> for Root {
    fn from(factor: &Fraction) -> Root {
        Root::from(factor.clone())
    }
}

/// The square root of a rational number, where it is rational.
fn rational_square_root(value: &Rational) -> Option<Rational> {
    let root = |n: &BigInt| -> Option<BigInt> {
        let root = n.sqrt();
        (&root * &root == *n).then_some(root)
    };
    match value.is_negative() || value.is_zero() {
        true => None,
        false => Some(Rational::new(root(value.numer())?, root(value.denom())?)),
    }
}

/// The definition of a named constant.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Definition {
    /// A factor times a square root.
    Root(Root),
    /// A zero of a polynomial, coefficients from the highest power down, between two numbers at
    /// which it has different signs: the one that halving finds.
    Zero { polynomial: Vec<Fraction>, between: [Rational; 2] },
    /// The real or imaginary part of a complex zero of a polynomial, coefficients from the highest
    /// power down: the zero that the method of Newton finds from a starting point.
    ComplexZero {
        polynomial: Vec<Fraction>,
        /// The starting point, as real and imaginary part.
        near: (Rational, Rational),
        /// Whether the imaginary part is meant.
        imaginary: bool,
    },
}

impl From<Root> for Definition {
    fn from(root: Root) -> Definition {
        Definition::Root(root)
    }
}

/// A real constant that is named, because it is no rational number: formulas hold its symbol, and
/// numbers come from its definition.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Constant {
    pub symbol: Symbol,
    /// Its definition, in `pi`, constants before it, and the scene's symbols.
    pub value: Definition,
}
