//! Formulas of one variable, the wavenumber `k`, and named constants: what dispersion relations and
//! spectra are written in. Every operation leaves a formula in a form that a person would write.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use num_traits::{One, Signed, ToPrimitive as _, Zero};
use wavestep_polynomial::{Integer, Rational, Symbol};

use super::normal;

/// The largest exponent, in absolute value.
const MAX_EXPONENT: i64 = 1 << 12;
/// The most bits of a number that is raised to a power.
const MAX_POWER_BITS: u64 = 1 << 15;

/// An elementary function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Function {
    /// `sin`
    Sine,
    /// `cos`
    Cosine,
    /// `exp`
    Exponential,
    /// `tanh`
    HyperbolicTangent,
    /// `sinc z = sin(z)/z`, and 1 at zero.
    Sinc,
}

impl Function {
    /// Its name in text.
    #[must_use]
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
    #[must_use]
    pub fn wave_number() -> Formula {
        Formula::symbol(&wave_number())
    }

    /// A named constant; `pi` is the number, other names are parameters.
    #[must_use]
    pub fn symbol(symbol: &Symbol) -> Formula {
        Formula::new(Node::Symbol(symbol.clone()))
    }

    /// A number.
    #[must_use]
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

    /// `π` as a symbol.
    pub(crate) fn pi() -> Formula {
        Formula::symbol(&pi())
    }

    /// The number it is, where it is a rational one.
    #[must_use]
    pub fn as_number(&self) -> Option<&Rational> {
        match self.node() {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Whether it is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.as_number().is_some_and(Zero::is_zero)
    }

    /// `self + other`.
    #[must_use]
    pub fn add(&self, other: &Formula) -> Formula {
        normal::sum([self.clone(), other.clone()])
    }

    /// `self − other`.
    #[must_use]
    pub fn subtract(&self, other: &Formula) -> Formula {
        self.add(&other.negate())
    }

    /// `−self`.
    #[must_use]
    pub fn negate(&self) -> Formula {
        Formula::integer(-1).multiply(self)
    }

    /// `self · other`.
    #[must_use]
    pub fn multiply(&self, other: &Formula) -> Formula {
        normal::product([self.clone(), other.clone()])
    }

    /// `self / other`.
    ///
    /// # Errors
    /// [`FormulaError::DivisionByZero`] where the divisor is 0.
    pub fn divide(&self, other: &Formula) -> Result<Formula, FormulaError> {
        Ok(self.multiply(&other.power(&-Rational::one())?))
    }

    /// `self^exponent`, the real one.
    ///
    /// # Errors
    /// [`FormulaError`] for zero to a negative power, and for powers that are too large.
    pub fn power(&self, exponent: &Rational) -> Result<Formula, FormulaError> {
        let limit = Rational::from_integer(MAX_EXPONENT.into());
        if exponent.abs() > limit || exponent.denom() > &MAX_EXPONENT.into() {
            return Err(FormulaError::TooLarge);
        }
        if exponent.is_zero() {
            return Ok(Formula::one());
        }
        if let Node::Number(value) = self.node() {
            if value.is_zero() && exponent.is_negative() {
                return Err(FormulaError::DivisionByZero);
            }
            let bits = value.numer().bits().max(value.denom().bits());
            let power = exponent.to_integer().abs().to_u64().unwrap_or(u64::MAX);
            if bits > 1 && bits.saturating_mul(power) > MAX_POWER_BITS {
                return Err(FormulaError::TooLarge);
            }
        }
        if let Node::Power(_, inner) = self.node()
            && (inner * exponent).abs() > limit
        {
            return Err(FormulaError::TooLarge);
        }
        Ok(normal::power(self, exponent))
    }

    /// The function of it.
    #[must_use]
    pub fn apply(&self, function: Function) -> Formula {
        if self.is_zero() {
            let at_zero = match function {
                Function::Sine | Function::HyperbolicTangent => 0,
                Function::Cosine | Function::Exponential | Function::Sinc => 1,
            };
            return Formula::integer(at_zero);
        }
        let plain = |argument| Formula::new(Node::Function(function, argument));
        match function {
            Function::Exponential => plain(self.clone()),
            _ if !self.leads_negative() => plain(self.clone()),
            Function::Cosine | Function::Sinc => plain(self.negate()),
            Function::Sine | Function::HyperbolicTangent => plain(self.negate()).negate(),
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

    /// `d/dk`.
    #[must_use]
    pub fn derivative(&self) -> Formula {
        match self.node() {
            Node::Number(_) => Formula::zero(),
            Node::Symbol(symbol) if *symbol == wave_number() => Formula::one(),
            Node::Symbol(_) => Formula::zero(),
            Node::Power(base, exponent) => normal::product([
                Formula::number(exponent),
                normal::power(base, &(exponent - Rational::one())),
                base.derivative(),
            ]),
            Node::Product(factors) => normal::sum((0..factors.len()).map(|i| {
                let part = |(j, factor): (usize, &Formula)| match i == j {
                    true => factor.derivative(),
                    false => factor.clone(),
                };
                normal::product(factors.iter().enumerate().map(part).collect::<Vec<_>>())
            })),
            Node::Sum(terms) => normal::sum(terms.iter().map(Formula::derivative)),
            Node::Function(function, argument) => {
                let z = argument;
                let slope = match function {
                    Function::Sine => z.apply(Function::Cosine),
                    Function::Cosine => z.apply(Function::Sine).negate(),
                    Function::Exponential => self.clone(),
                    Function::HyperbolicTangent => Formula::one().subtract(&self.multiply(self)),
                    Function::Sinc => {
                        let numerator = z.apply(Function::Cosine).subtract(self);
                        numerator.multiply(&normal::power(z, &-Rational::one()))
                    }
                };
                slope.multiply(&argument.derivative())
            }
        }
    }

    /// With formulas in place of symbols.
    ///
    /// # Errors
    /// [`FormulaError`] where a divisor becomes zero.
    pub fn substitute(&self, values: &BTreeMap<Symbol, Formula>) -> Result<Formula, FormulaError> {
        let all = |parts: &[Formula]| -> Result<Vec<Formula>, FormulaError> {
            parts.iter().map(|part| part.substitute(values)).collect()
        };
        Ok(match self.node() {
            Node::Number(_) => self.clone(),
            Node::Symbol(symbol) => values.get(symbol).unwrap_or(self).clone(),
            Node::Power(base, exponent) => base.substitute(values)?.power(exponent)?,
            Node::Product(factors) => normal::product(all(factors)?),
            Node::Sum(terms) => normal::sum(all(terms)?),
            Node::Function(function, argument) => argument.substitute(values)?.apply(*function),
        })
    }

    /// Every symbol in it, `k` and `pi` among them.
    #[must_use]
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

    /// The coefficients `a_m` of `Σ a_m k^m`, by exponent, where it is a polynomial in `k` whose
    /// coefficients may hold other symbols.
    #[must_use]
    pub fn polynomial(&self) -> Option<BTreeMap<u32, Formula>> {
        let k = wave_number();
        let terms = match self.node() {
            Node::Sum(terms) => &terms[..],
            _ => std::slice::from_ref(self),
        };
        let mut coefficients: BTreeMap<u32, Formula> = BTreeMap::new();
        for term in terms {
            let factors = match term.node() {
                Node::Product(factors) => &factors[..],
                _ => std::slice::from_ref(term),
            };
            let (mut exponent, mut rest) = (0, Vec::new());
            for factor in factors {
                match factor.node() {
                    Node::Symbol(symbol) if *symbol == k => exponent = 1,
                    Node::Power(base, power) if base.node() == &Node::Symbol(k.clone()) => {
                        exponent = power.is_integer().then(|| power.to_integer().to_u32())??;
                    }
                    _ if factor.symbols().contains(&k) => return None,
                    _ => rest.push(factor.clone()),
                }
            }
            let sum = coefficients.entry(exponent).or_insert_with(Formula::zero);
            *sum = sum.add(&normal::product(rest));
        }
        coefficients.retain(|_, coefficient| !coefficient.is_zero());
        Some(coefficients)
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

/// The symbol `k`.
pub(super) fn wave_number() -> Symbol {
    Symbol::new("k").expect("a name")
}

/// The symbol `pi`.
pub(crate) fn pi() -> Symbol {
    Symbol::new("pi").expect("a name")
}

/// The exact power of a number that is not zero, where it is rational.
pub(super) fn rational_power(value: &Rational, exponent: &Rational) -> Option<Rational> {
    let degree = exponent.denom().to_u32()?;
    let root = match (degree, value.cmp(&Rational::zero())) {
        (1, _) => value.clone(),
        (_, Ordering::Greater) => {
            let root =
                |part: &Integer| Some(part.nth_root(degree)).filter(|r| &r.pow(degree) == part);
            Rational::new(root(value.numer())?, root(value.denom())?)
        }
        _ => return None,
    };
    Some(root.pow(exponent.numer().to_i32()?))
}
