//! Arithmetic of formulas. Every operation leaves a formula in a form that a person would write: like terms
//! collected, powers of one base joined, small products multiplied out, and what all terms of a sum are
//! divided by written once.
//!
//! The last rule makes group velocities readable: the derivative of `k/sqrt(1 + k²)` is
//! `1/(1 + k²)^(3/2)`, not the difference of two quotients.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use num_traits::{One, Signed, ToPrimitive as _, Zero};
use wavestep_polynomial::{Integer, Rational, Symbol};

use super::formula::{Formula, FormulaError, Function, Node, wave_number};

/// The largest exponent, in absolute value.
const MAX_EXPONENT: i64 = 1 << 12;
/// The most bits of a number that is raised to a power.
const MAX_POWER_BITS: u64 = 1 << 15;

/// The largest power of a sum that is multiplied out.
const MAX_EXPANDED_POWER: u32 = 16;
/// The most terms that multiplying out may make before collection.
const MAX_EXPANDED_TERMS: usize = 512;

pub(super) fn sum(terms: impl IntoIterator<Item = Formula>) -> Formula {
    let mut collected: BTreeMap<Formula, Rational> = BTreeMap::new();
    for term in terms {
        for part in term.terms() {
            let (coefficient, rest) = split(part);
            *collected.entry(rest).or_insert_with(Rational::zero) += coefficient;
        }
    }
    collected.retain(|_, coefficient| !coefficient.is_zero());
    let terms: Vec<Formula> = collected
        .iter()
        .map(|(rest, number)| joined(number, rest.factors().iter().cloned()))
        .collect();
    match terms.len() {
        0 => Formula::zero(),
        1 => terms.into_iter().next().expect("one term"),
        _ => over_common_power(&terms).unwrap_or_else(|| Formula::new(Node::Sum(terms))),
    }
}

/// The number in front, and the rest, which is 1 for a number.
fn split(term: &Formula) -> (Rational, Formula) {
    let factors = term.factors();
    match factors[0].as_number() {
        Some(value) => (value.clone(), joined(&Rational::one(), factors[1..].iter().cloned())),
        None => (Rational::one(), term.clone()),
    }
}

/// A factor as a base and its exponent.
fn base_and_exponent(factor: &Formula) -> (Formula, Rational) {
    match factor.node() {
        Node::Power(base, exponent) => (base.clone(), exponent.clone()),
        _ => (factor.clone(), Rational::one()),
    }
}

/// The terms as `B^e (…)`, where each of them holds a power of the sum `B`, the exponents differ by
/// whole numbers, and not all are whole and positive.
fn over_common_power(terms: &[Formula]) -> Option<Formula> {
    let exponent_in = |term: &Formula, base: &Formula| {
        let mut pairs = term.factors().iter().map(base_and_exponent);
        pairs.find(|(other, _)| other == base).map(|(_, exponent)| exponent)
    };
    for factor in terms[0].factors() {
        let (base, first) = base_and_exponent(factor);
        if !matches!(base.node(), Node::Sum(_)) {
            continue;
        }
        let exponents: Option<Vec<Rational>> =
            terms.iter().map(|term| exponent_in(term, &base)).collect();
        let Some(exponents) = exponents else { continue };
        let whole = exponents.iter().all(|exponent| (exponent - &first).is_integer());
        let least = exponents.iter().min().expect("terms").clone();
        if !whole || least.is_integer() && least.is_positive() {
            continue;
        }
        // Not multiplied out: it is to cancel.
        let inverse = raw_power(base.clone(), -&least);
        let rest = sum(terms.iter().map(|term| product([term.clone(), inverse.clone()])));
        return Some(product([power(&base, &least), rest]));
    }
    None
}

pub(super) fn product(factors: impl IntoIterator<Item = Formula>) -> Formula {
    let mut coefficient = Rational::one();
    let mut powers: BTreeMap<Formula, Rational> = BTreeMap::new();
    let mut exponents = Vec::new();
    for factor in factors {
        for part in factor.factors() {
            match part.node() {
                Node::Number(value) => coefficient *= value,
                Node::Function(Function::Exponential, z) => exponents.push(z.clone()),
                _ => {
                    let (base, exponent) = base_and_exponent(part);
                    *powers.entry(base).or_insert_with(Rational::zero) += exponent;
                }
            }
        }
    }
    if coefficient.is_zero() {
        return Formula::zero();
    }
    powers.retain(|_, exponent| !exponent.is_zero());
    // A root of a number or of a product may have become a whole power.
    let unfinished = |(base, exponent): &(&Formula, &Rational)| {
        exponent.is_integer()
            && matches!(base.node(), Node::Number(_) | Node::Product(_) | Node::Power(..))
    };
    if powers.iter().any(|pair| unfinished(&pair)) {
        let mut again = vec![Formula::number(&coefficient)];
        again.extend(powers.iter().map(|(base, exponent)| power(base, exponent)));
        again.extend(exponents.into_iter().map(|z| z.apply(Function::Exponential)));
        return product(again);
    }
    let small = |base: &Formula, exponent: &Rational| match base.node() {
        Node::Sum(terms) if exponent.is_integer() && exponent.is_positive() => {
            let power = exponent.to_integer().to_u32().filter(|e| *e <= MAX_EXPANDED_POWER);
            power.map(|power| (power, terms.len()))
        }
        _ => None,
    };
    let count: f64 = powers
        .iter()
        .filter_map(|(base, exponent)| small(base, exponent))
        .map(|(exponent, terms)| (terms as f64).powi(exponent as i32))
        .product();
    let expand = count > 1.0 && count <= MAX_EXPANDED_TERMS as f64;
    let (mut simple, mut sums, mut others) = (Vec::new(), Vec::new(), Vec::new());
    for (base, exponent) in powers {
        match (base.node(), small(&base, &exponent)) {
            (Node::Symbol(_), _) => simple.push(raw_power(base, exponent)),
            (_, Some((count, _))) if expand => {
                sums.extend(std::iter::repeat_n(base, count as usize))
            }
            _ => others.push(raw_power(base, exponent)),
        }
    }
    let exponent = sum(exponents);
    if !exponent.is_zero() {
        others.push(exponent.apply(Function::Exponential));
    }
    let monomial = joined(&coefficient, simple);
    if sums.is_empty() {
        return joined(&Rational::one(), monomial.factors().iter().cloned().chain(others));
    }
    let expanded = sums.iter().fold(monomial, |left, right| {
        let Node::Sum(right) = right.node() else { unreachable!("sums alone are expanded") };
        let pairs =
            left.terms().iter().flat_map(|a| right.iter().map(move |b| (a.clone(), b.clone())));
        sum(pairs.map(|(a, b)| product([a, b])).collect::<Vec<_>>())
    });
    match expanded.node() {
        _ if others.is_empty() => expanded,
        Node::Sum(_) => joined(&Rational::one(), others.into_iter().chain([expanded])),
        _ => product(others.into_iter().chain([expanded])),
    }
}

/// Factors with different bases, sorted, after a number.
fn joined(coefficient: &Rational, factors: impl IntoIterator<Item = Formula>) -> Formula {
    let (mut number, mut all) = (coefficient.clone(), Vec::new());
    for factor in factors {
        match factor.node() {
            Node::Number(value) => number *= value,
            _ => all.push(factor),
        }
    }
    all.sort();
    if all.is_empty() {
        return Formula::number(&number);
    }
    if !number.is_one() {
        all.insert(0, Formula::number(&number));
    }
    if all.len() == 1 { all.remove(0) } else { Formula::new(Node::Product(all)) }
}

fn raw_power(base: Formula, exponent: Rational) -> Formula {
    if exponent.is_one() { base } else { Formula::new(Node::Power(base, exponent)) }
}

/// A power; the base is not zero where the exponent is negative.
pub(super) fn power(base: &Formula, exponent: &Rational) -> Formula {
    if exponent.is_zero() {
        return Formula::one();
    }
    if exponent.is_one() {
        return base.clone();
    }
    let plain = || raw_power(base.clone(), exponent.clone());
    match base.node() {
        Node::Number(value) => match rational_power(value, exponent) {
            Some(power) => Formula::number(&power),
            None => plain(),
        },
        // Symbols are positive, and so is what a root was taken of.
        Node::Power(inner, first)
            if exponent.is_integer()
                || !first.is_integer()
                || matches!(inner.node(), Node::Symbol(_)) =>
        {
            power(inner, &(first * exponent))
        }
        Node::Product(factors) if exponent.is_integer() => {
            product(factors.iter().map(|factor| power(factor, exponent)))
        }
        Node::Product(factors) => {
            // Positive factors come out of the root.
            let positive = |factor: &&Formula| match factor.node() {
                Node::Number(value) => value.is_positive(),
                Node::Symbol(_) | Node::Function(Function::Exponential, _) => true,
                Node::Power(inner, _) => matches!(inner.node(), Node::Symbol(_)),
                _ => false,
            };
            let (outside, inside): (Vec<&Formula>, Vec<&Formula>) =
                factors.iter().partition(positive);
            let inside = product(inside.into_iter().cloned());
            let inside = match inside.node() {
                Node::Product(_) => raw_power(inside, exponent.clone()),
                _ => power(&inside, exponent),
            };
            let outside = outside.into_iter().map(|factor| power(factor, exponent));
            product(outside.chain([inside]).collect::<Vec<_>>())
        }
        Node::Function(Function::Exponential, z) => {
            z.multiply(&Formula::number(exponent)).apply(Function::Exponential)
        }
        Node::Sum(_) if exponent.is_integer() && exponent.is_positive() => product([plain()]),
        Node::Sum(terms) => match common_monomial(terms) {
            None => plain(),
            Some(monomial) => {
                let inverse = power(&monomial, &-Rational::one());
                let rest = sum(terms.iter().map(|term| product([term.clone(), inverse.clone()])));
                product([power(&monomial, exponent), raw_power(rest, exponent.clone())])
            }
        },
        Node::Symbol(_) | Node::Power(..) | Node::Function(..) => plain(),
    }
}

/// The powers of symbols, which are positive, that all terms hold: `k²` of `k² + k³`.
fn common_monomial(terms: &[Formula]) -> Option<Formula> {
    let powers_of = |term: &Formula| -> BTreeMap<Formula, Rational> {
        let pairs = term.factors().iter().map(base_and_exponent);
        pairs.filter(|(base, _)| matches!(base.node(), Node::Symbol(_))).collect()
    };
    let mut common = powers_of(&terms[0]);
    for term in &terms[1..] {
        let powers = powers_of(term);
        common.retain(|base, exponent| match powers.get(base) {
            Some(other) => {
                *exponent = exponent.clone().min(other.clone());
                true
            }
            None => false,
        });
    }
    let factors: Vec<Formula> =
        common.iter().map(|(base, exponent)| power(base, exponent)).collect();
    (!factors.is_empty()).then(|| product(factors))
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

impl Formula {
    pub fn add(&self, other: &Formula) -> Formula {
        sum([self.clone(), other.clone()])
    }

    pub fn subtract(&self, other: &Formula) -> Formula {
        self.add(&other.negate())
    }

    pub fn negate(&self) -> Formula {
        Formula::integer(-1).multiply(self)
    }

    pub fn multiply(&self, other: &Formula) -> Formula {
        product([self.clone(), other.clone()])
    }

    pub fn divide(&self, other: &Formula) -> Result<Formula, FormulaError> {
        Ok(self.multiply(&other.power(&-Rational::one())?))
    }

    /// `self^exponent`, the real one; refused are zero to a negative power and powers that are too large.
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
        Ok(power(self, exponent))
    }

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

    /// `d/dk`.
    pub fn derivative(&self) -> Formula {
        match self.node() {
            Node::Number(_) => Formula::zero(),
            Node::Symbol(symbol) if *symbol == wave_number() => Formula::one(),
            Node::Symbol(_) => Formula::zero(),
            Node::Power(base, exponent) => product([
                Formula::number(exponent),
                power(base, &(exponent - Rational::one())),
                base.derivative(),
            ]),
            Node::Product(factors) => sum((0..factors.len()).map(|i| {
                let part = |(j, factor): (usize, &Formula)| match i == j {
                    true => factor.derivative(),
                    false => factor.clone(),
                };
                product(factors.iter().enumerate().map(part).collect::<Vec<_>>())
            })),
            Node::Sum(terms) => sum(terms.iter().map(Formula::derivative)),
            Node::Function(function, argument) => {
                let z = argument;
                let slope = match function {
                    Function::Sine => z.apply(Function::Cosine),
                    Function::Cosine => z.apply(Function::Sine).negate(),
                    Function::Exponential => self.clone(),
                    Function::HyperbolicTangent => Formula::one().subtract(&self.multiply(self)),
                    Function::Sinc => {
                        let numerator = z.apply(Function::Cosine).subtract(self);
                        numerator.multiply(&power(z, &-Rational::one()))
                    }
                };
                slope.multiply(&argument.derivative())
            }
        }
    }

    /// With formulas in place of symbols.
    pub fn substitute(&self, values: &BTreeMap<Symbol, Formula>) -> Result<Formula, FormulaError> {
        let all = |parts: &[Formula]| -> Result<Vec<Formula>, FormulaError> {
            parts.iter().map(|part| part.substitute(values)).collect()
        };
        Ok(match self.node() {
            Node::Number(_) => self.clone(),
            Node::Symbol(symbol) => values.get(symbol).unwrap_or(self).clone(),
            Node::Power(base, exponent) => base.substitute(values)?.power(exponent)?,
            Node::Product(factors) => product(all(factors)?),
            Node::Sum(terms) => sum(all(terms)?),
            Node::Function(function, argument) => argument.substitute(values)?.apply(*function),
        })
    }

    /// The coefficients `a_m` of `Σ a_m k^m`, by exponent, where it is a polynomial in `k` whose
    /// coefficients may hold other symbols.
    pub fn polynomial(&self) -> Option<BTreeMap<u32, Formula>> {
        let k = wave_number();
        let mut coefficients: BTreeMap<u32, Formula> = BTreeMap::new();
        for term in self.terms() {
            let (mut exponent, mut rest) = (0, Vec::new());
            for factor in term.factors() {
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
            *sum = sum.add(&product(rest));
        }
        coefficients.retain(|_, coefficient| !coefficient.is_zero());
        Some(coefficients)
    }
}
