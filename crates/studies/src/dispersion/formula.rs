//! Formulas of one variable, the wavenumber `k`, and named constants: what dispersion relations and
//! spectra are written in.

use std::collections::BTreeSet;
use std::sync::Arc;

use num_traits::{Signed, Zero};
use wavestep_polynomial::{Integer, Rational, Symbol};

/// An elementary function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Function {
    Sine,
    Cosine,
    Exponential,
    HyperbolicTangent,
    /// `sinc z = sin(z)/z`, and 1 at zero.
    Sinc,
}

impl Function {
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sine => "sin",
            Self::Cosine => "cos",
            Self::Exponential => "exp",
            Self::HyperbolicTangent => "tanh",
            Self::Sinc => "sinc",
        }
    }
}

/// Why a formula has no value for any `k`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FormulaError {
    /// Zero to a negative power.
    #[error("division by zero")]
    DivisionByZero,
    /// A power too large to be worked out: exponents go to 4096, numbers to 32768 bits.
    #[error("a power that is too large to be worked out")]
    TooLarge,
}

/// What a formula is made of.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Node {
    Number(Rational),
    Symbol(Symbol),
    Power(Formula, Rational),
    Product(Vec<Formula>),
    Function(Function, Formula),
    Sum(Vec<Formula>),
}

/// A formula in the wavenumber `k`, `pi`, and parameters that stand for positive numbers.
///
/// Equal formulas are equal functions. Polynomials, also with negative powers of symbols, are equal
/// exactly when their formulas are; of other functions this is not promised. Symbols are taken to be
/// positive: `sqrt(k^2)` is `k`. Simplification may fill a gap in the domain: `(k^2 - k)/k` is `k - 1`.
///
/// # Invariants
/// - The terms of a sum are sorted, at least two, no sums, and no two differ by a number only.
/// - The factors of a product are sorted, at least two, no products; a number comes first and is not 1.
/// - Exponents are neither 0 nor 1; sums to small whole powers are multiplied out.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Formula(Arc<Node>);

impl Formula {
    pub(super) fn new(node: Node) -> Formula {
        Formula(Arc::new(node))
    }

    pub(crate) fn node(&self) -> &Node {
        &self.0
    }

    /// The variable `k`.
    pub fn wave_number() -> Formula {
        Formula::symbol(&wave_number())
    }

    /// A named constant; `pi` is the number, other names are parameters.
    pub fn symbol(symbol: &Symbol) -> Formula {
        Formula::new(Node::Symbol(symbol.clone()))
    }

    pub fn number(value: &Rational) -> Formula {
        Formula::new(Node::Number(value.clone()))
    }

    pub(crate) fn integer(value: i64) -> Formula {
        Formula::number(&Rational::from_integer(value.into()))
    }

    pub(super) fn zero() -> Formula {
        Formula::integer(0)
    }

    pub(super) fn one() -> Formula {
        Formula::integer(1)
    }

    pub(crate) fn pi() -> Formula {
        Formula::symbol(&pi())
    }

    pub fn as_number(&self) -> Option<&Rational> {
        match self.node() {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    pub fn is_zero(&self) -> bool {
        self.as_number().is_some_and(Zero::is_zero)
    }

    /// Its terms: itself where it is no sum.
    pub(super) fn terms(&self) -> &[Formula] {
        match self.node() {
            Node::Sum(terms) => terms,
            _ => std::slice::from_ref(self),
        }
    }

    /// Its factors: itself where it is no product.
    pub(super) fn factors(&self) -> &[Formula] {
        match self.node() {
            Node::Product(factors) => factors,
            _ => std::slice::from_ref(self),
        }
    }

    /// Whether the number in front of it, or of its first term, is negative.
    pub(crate) fn leads_negative(&self) -> bool {
        match self.node() {
            Node::Number(value) => value.is_negative(),
            Node::Product(parts) | Node::Sum(parts) => parts[0].leads_negative(),
            _ => false,
        }
    }

    /// Every symbol in it, `k` and `pi` among them.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        let mut found = BTreeSet::new();
        self.collect_symbols(&mut found);
        found
    }

    fn collect_symbols(&self, found: &mut BTreeSet<Symbol>) {
        match self.node() {
            Node::Number(_) => {}
            Node::Symbol(symbol) => {
                found.insert(symbol.clone());
            }
            Node::Power(part, _) | Node::Function(_, part) => part.collect_symbols(found),
            Node::Product(parts) | Node::Sum(parts) => {
                parts.iter().for_each(|part| part.collect_symbols(found));
            }
        }
    }

    /// Whether it is at least zero wherever it is real, for `k ≥ 0`: seen from its structure, so a
    /// `false` says nothing.
    pub(super) fn is_structurally_nonnegative(&self) -> bool {
        match self.node() {
            Node::Number(value) => !value.is_negative(),
            Node::Symbol(_) | Node::Function(Function::Exponential, _) => true,
            Node::Function(Function::HyperbolicTangent, z) => z.is_structurally_nonnegative(),
            Node::Function(..) => false,
            Node::Power(base, exponent) => {
                let even = exponent.numer() % 2 == Integer::zero();
                even || !exponent.is_integer() || base.is_structurally_nonnegative()
            }
            Node::Product(parts) | Node::Sum(parts) => {
                parts.iter().all(Formula::is_structurally_nonnegative)
            }
        }
    }
}

pub(super) fn wave_number() -> Symbol {
    Symbol::new("k").expect("a name")
}

pub(crate) fn pi() -> Symbol {
    Symbol::new("pi").expect("a name")
}
