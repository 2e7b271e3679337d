//! A formula as it is to be written: signs, factors and brackets.

use num_traits::{One, Signed, Zero};
use smallvec::SmallVec;
use std::sync::Arc;
use wavestep_polynomial::{Integer, Rational, Symbol};

/// A function that oscillates.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Circular {
    Cosine,
    Sine,
}

impl Circular {
    pub fn name(self) -> &'static str {
        match self {
            Circular::Cosine => "cos",
            Circular::Sine => "sin",
        }
    }
}

/// The sign in front of a term.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Sign {
    Plus,
    Minus,
}

impl Sign {
    /// The sign of a number, `+` for zero.
    pub fn of(value: &Rational) -> Sign {
        if value.is_negative() { Sign::Minus } else { Sign::Plus }
    }

    pub fn times(self, other: Sign) -> Sign {
        if self == other { Sign::Plus } else { Sign::Minus }
    }
}

/// A formula as it is to be written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Tree {
    /// A number, not negative.
    Number(Rational),
    Symbol(Symbol),
    /// A sum of at least two terms.
    Sum(Vec<(Sign, Tree)>),
    /// The bracket of a wave function, after its exponential.
    Bracket(Vec<(Sign, Tree)>),
    /// A number times powers of symbols, at least two factors: what sums have most of.
    Monomial(Monomial),
    /// A product of at least two factors.
    Product(Vec<Tree>),
    Quotient(Box<Tree>, Box<Tree>),
    Power(Box<Tree>, Box<Tree>),
    /// `e^{…}`, with the exponent's sign.
    Exponential(Sign, Box<Tree>),
    /// `cos(…)` or `sin(…)`.
    Oscillation(Circular, Box<Tree>),
    /// Another function, by its name.
    Function(&'static str, Box<Tree>),
    /// The square root of a positive integer; times the imaginary unit if true.
    Root(Integer, bool),
    /// `L_k(x)`, a Laguerre polynomial: name, index and argument.
    Laguerre(Symbol, Box<Tree>, Box<Tree>),
    /// `k!`
    Factorial(Box<Tree>),
}

/// A positive number times powers of symbols.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Monomial {
    pub coefficient: Rational,
    pub symbols: Arc<[Symbol]>,
    pub exponents: Exponents,
}

/// Roots are written as one root of a product below this: its factors are found again by trial.
const LARGEST_RADICAND: i64 = 1_000_000_000_000;

/// Exponents of a few symbols.
pub(crate) type Exponents = SmallVec<[u32; 4]>;

impl Monomial {
    /// As a tree of the simplest kind.
    pub fn into_tree(self) -> Tree {
        let mut powers = self.exponents.iter().enumerate().filter(|(_, e)| **e > 0);
        match (powers.next(), powers.next()) {
            (None, _) => Tree::Number(self.coefficient),
            (Some((i, exponent)), None) if self.coefficient.is_one() => {
                Tree::power(Tree::Symbol(self.symbols[i].clone()), *exponent)
            }
            _ => Tree::Monomial(self),
        }
    }

    /// The degree in the symbols that are no roots, and the number of roots.
    pub fn degrees(&self) -> (u32, u32) {
        self.powers().fold((0, 0), |(degree, roots), (x, e)| match x.square() {
            None => (degree + e, roots),
            Some(_) => (degree, roots + e),
        })
    }

    /// As a tree that shows its roots together with the number: `3*sqrt(6)/4*x`.
    pub fn with_roots_apart(mut self) -> Tree {
        let (mut roots, mut radicand, mut imaginary) = (Vec::new(), Integer::one(), false);
        for (symbol, exponent) in self.symbols.iter().zip(&mut self.exponents) {
            let Some(square) = symbol.square().filter(|_| *exponent > 0) else { continue };
            *exponent = 0;
            let longer = &radicand * square;
            match square {
                -1 => imaginary = true,
                _ if longer < Integer::from(LARGEST_RADICAND) => radicand = longer,
                _ => roots.push(Tree::Root(square.into(), false)),
            }
        }
        if !radicand.is_one() || imaginary {
            roots.insert(0, Tree::Root(radicand, imaginary));
        }
        if roots.is_empty() {
            return self.into_tree();
        }
        let (top, bottom) = self.coefficient.clone().into_raw();
        self.coefficient = Rational::one();
        if !top.is_one() {
            roots.insert(0, Tree::Number(top.into()));
        }
        let mut factors = match bottom.is_one() {
            true => roots,
            false => {
                let (top, bottom) = (Tree::product(roots), Tree::Number(bottom.into()));
                vec![Tree::Quotient(Box::new(top), Box::new(bottom))]
            }
        };
        factors.extend(self.into_tree().into_factors());
        Tree::product(factors)
    }

    /// The symbols that occur, with their exponents.
    pub fn powers(&self) -> impl Iterator<Item = (&Symbol, u32)> {
        self.symbols.iter().zip(self.exponents.iter().copied()).filter(|(_, e)| *e > 0)
    }
}

/// A term: sign and what follows it.
pub(crate) type Term = (Sign, Tree);

impl Tree {
    /// Whether it is higher than a line.
    pub fn is_tall(&self) -> bool {
        match self {
            Tree::Number(value) => !value.is_integer(),
            Tree::Monomial(monomial) => !monomial.coefficient.is_integer(),
            Tree::Quotient(..) => true,
            Tree::Sum(terms) | Tree::Bracket(terms) => terms.iter().any(|term| term.1.is_tall()),
            Tree::Product(factors) => factors.iter().any(Tree::is_tall),
            Tree::Power(base, _) => base.is_tall(),
            Tree::Oscillation(_, argument)
            | Tree::Function(_, argument)
            | Tree::Laguerre(_, _, argument) => argument.is_tall(),
            Tree::Symbol(_) | Tree::Root(..) | Tree::Exponential(..) | Tree::Factorial(_) => false,
        }
    }

    /// Whether this is an exponential, a cosine or a sine.
    pub fn is_wave(&self) -> bool {
        matches!(self, Tree::Exponential(..) | Tree::Oscillation(..))
    }

    /// A product, of what there is.
    pub fn product(mut factors: Vec<Tree>) -> Tree {
        match factors.len() {
            0 => Tree::Number(Rational::one()),
            1 => factors.remove(0),
            _ => Tree::Product(factors),
        }
    }

    /// The factors of a product; none for 1.
    pub fn into_factors(self) -> Vec<Tree> {
        match self {
            Tree::Product(factors) => factors,
            Tree::Number(one) if one.is_one() => Vec::new(),
            other => vec![other],
        }
    }

    /// A sum with its sign, of what there is.
    pub fn sum(mut terms: Vec<Term>) -> Term {
        match terms.len() {
            0 => (Sign::Plus, Tree::Number(Rational::zero())),
            1 => terms.remove(0),
            _ => (Sign::Plus, Tree::Sum(terms)),
        }
    }

    /// A power, of what there is.
    pub fn power(base: Tree, exponent: u32) -> Tree {
        match exponent {
            1 => base,
            _ => Tree::Power(
                Box::new(base),
                Box::new(Tree::Number(Rational::from_integer(exponent.into()))),
            ),
        }
    }
}

/// Takes the sign out of a sum, so that the rest starts positive.
pub(crate) fn positive_first(mut terms: Vec<Term>) -> (Sign, Vec<Term>) {
    let sign = terms.first().map_or(Sign::Plus, |term| term.0);
    terms.iter_mut().for_each(|term| term.0 = term.0.times(sign));
    (sign, terms)
}
