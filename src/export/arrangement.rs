//! The order in which a person would write an expression.
//!
//! First the exponential of the time variable, then descending powers of that variable, each with
//! its coefficient; coefficients ascend in the exponentials of symbols (`1 + e^{−2μ} + …`) and in
//! the symbols. The sign stands outside a bracket, so that what is inside starts positive; a common
//! denominator stands outside, a common integer factor stays inside.

use crate::expression::{Expression, Fraction};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol};

/// The sign in front of a term.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sign {
    /// `+`
    Plus,
    /// `−`
    Minus,
}

impl Sign {
    /// The sign of a number, `+` for zero.
    pub fn of(value: &Rational) -> Sign {
        if value.is_negative() { Sign::Minus } else { Sign::Plus }
    }

    /// The sign of a product.
    pub fn times(self, other: Sign) -> Sign {
        if self == other { Sign::Plus } else { Sign::Minus }
    }
}

/// A formula as it is to be written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Node {
    /// A number, not negative.
    Number(Rational),
    /// A name.
    Symbol(Symbol),
    /// A sum of at least two terms.
    Sum(Vec<(Sign, Node)>),
    /// A product of at least two factors.
    Product(Vec<Node>),
    /// A quotient.
    Quotient(Box<Node>, Box<Node>),
    /// A power.
    Power(Box<Node>, Box<Node>),
    /// `e^{…}`, with the exponent's sign.
    Exponential(Sign, Box<Node>),
    /// `L_k(x)`, a Laguerre polynomial: index and argument.
    Laguerre(Box<Node>, Box<Node>),
    /// `k!`
    Factorial(Box<Node>),
}

/// A term: sign and what follows it.
pub type Term = (Sign, Node);

impl Node {
    /// A product, of what there is.
    pub fn product(mut factors: Vec<Node>) -> Node {
        match factors.len() {
            0 => Node::Number(Rational::one()),
            1 => factors.remove(0),
            _ => Node::Product(factors),
        }
    }

    /// The factors of a product; none for 1.
    pub fn into_factors(self) -> Vec<Node> {
        match self {
            Node::Product(factors) => factors,
            Node::Number(one) if one.is_one() => Vec::new(),
            other => vec![other],
        }
    }

    /// A sum with its sign, of what there is.
    pub fn sum(mut terms: Vec<Term>) -> Term {
        match terms.len() {
            0 => (Sign::Plus, Node::Number(Rational::zero())),
            1 => terms.remove(0),
            _ => (Sign::Plus, Node::Sum(terms)),
        }
    }

    /// A power, of what there is.
    pub fn power(base: Node, exponent: u32) -> Node {
        match exponent {
            1 => base,
            _ => Node::Power(
                Box::new(base),
                Box::new(Node::Number(Rational::from_integer(exponent.into()))),
            ),
        }
    }
}

/// The terms of an expression in writing order; `variable` is the time variable, if there is one.
/// Zero has no terms.
pub fn arrange(expression: &Expression, variable: Option<&Symbol>) -> Vec<Term> {
    let Some(x) = variable else { return coefficient_terms(expression) };
    let mut terms = Vec::new();
    for (rate, by_power) in by_rate_and_power(expression, x) {
        let mut inner = Vec::new();
        for (power, coefficient) in by_power.iter().rev() {
            match power {
                0 => inner.extend(coefficient_terms(coefficient)),
                _ => inner.push(power_term(coefficient, x, *power)),
            }
        }
        if rate.is_zero() {
            terms.extend(inner);
            continue;
        }
        let (sign, exponent) = Node::sum(fraction_terms(&(&rate * &Fraction::symbol(x))));
        let exponential = Node::Exponential(sign, Box::new(exponent));
        terms.push(match inner.len() {
            1 => with_factor(inner, exponential),
            // Here signs stay inside: the bracket is the polynomial of the wave function.
            _ => (Sign::Plus, Node::Product(vec![exponential, Node::Sum(inner)])),
        });
    }
    terms
}

/// The coefficients of an expression by the rate of the variable in the exponent, then by its
/// power.
fn by_rate_and_power(
    expression: &Expression,
    x: &Symbol,
) -> Vec<(Fraction, BTreeMap<u32, Expression>)> {
    let mut groups = BTreeMap::<Fraction, BTreeMap<u32, Expression>>::new();
    for (exponent, p) in expression.terms() {
        let rate = exponent.derivative(x);
        let base = exponent - &(&rate * &Fraction::symbol(x));
        let group = groups.entry(rate).or_default();
        for (power, part) in p.numerator().coefficients(x) {
            group.entry(power).or_default().add_term(base.clone(), p.with_numerator(part));
        }
    }
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_by(|a, b| exponent_order(&a.0, &b.0));
    groups
}

/// Zero first, then descending value where all symbols are 1: `−2μ` before `−4μ`.
fn exponent_order(a: &Fraction, b: &Fraction) -> Ordering {
    let at_ones = |value: &Fraction| {
        let ones = |p: &Polynomial| p.evaluate(|_| Some(Rational::one())).unwrap_or_default();
        let denominator = ones(&value.denominator());
        if denominator.is_zero() { Rational::zero() } else { ones(value.numerator()) / denominator }
    };
    let key = |value: &Fraction| (!value.is_zero(), -at_ones(value));
    key(a).cmp(&key(b)).then_with(|| a.cmp(b))
}

/// The terms of an expression without a time variable, ascending.
fn coefficient_terms(coefficient: &Expression) -> Vec<Term> {
    let mut parts: Vec<_> = coefficient.terms().collect();
    parts.sort_by(|a, b| exponent_order(a.0, b.0));
    let mut terms = Vec::new();
    for (exponent, fraction) in parts {
        let inner = fraction_terms(fraction);
        if exponent.is_zero() {
            terms.extend(inner);
        } else {
            let (sign, exponent) = Node::sum(fraction_terms(exponent));
            terms.push(with_factor(inner, Node::Exponential(sign, Box::new(exponent))));
        }
    }
    terms
}

/// `factor · (inner)`: the factor before a bracket, or among the factors of a single term.
fn with_factor(mut inner: Vec<Term>, factor: Node) -> Term {
    if inner.len() == 1 {
        let (sign, node) = inner.remove(0);
        let mut factors = node.into_factors();
        // A number and symbols stand before the exponential, a bracket after it.
        let place = factors.iter().position(|f| matches!(f, Node::Sum(_) | Node::Exponential(..)));
        factors.insert(place.unwrap_or(factors.len()), factor);
        return (sign, Node::product(factors));
    }
    let (sign, inner) = positive_first(inner);
    (sign, Node::Product(vec![factor, Node::Sum(inner)]))
}

/// Takes the sign out of a sum, so that what is left starts positive.
fn positive_first(mut terms: Vec<Term>) -> (Sign, Vec<Term>) {
    let sign = terms.first().map_or(Sign::Plus, |term| term.0);
    terms.iter_mut().for_each(|term| term.0 = term.0.times(sign));
    (sign, terms)
}

/// `coefficient · x^power`, as `−(1/2) x² (1 + e^{−μ})`.
fn power_term(coefficient: &Expression, x: &Symbol, power: u32) -> Term {
    let power = Node::power(Node::Symbol(x.clone()), power);
    let mut terms = coefficient_terms(coefficient);
    if terms.len() == 1 && !matches!(&terms[0].1, Node::Product(f) if has_sum(f)) {
        let (sign, node) = terms.remove(0);
        let mut factors = node.into_factors();
        let place = factors.iter().position(|f| matches!(f, Node::Exponential(..)));
        factors.insert(place.unwrap_or(factors.len()), power);
        return (sign, Node::product(factors));
    }
    let denominator = common_denominator(coefficient);
    let whole = coefficient.scale(&Rational::from_integer(denominator.clone()));
    let (sign, inner) = positive_first(coefficient_terms(&whole));
    let mut factors = Vec::new();
    if !denominator.is_one() {
        factors.push(Node::Number(Rational::new(Integer::one(), denominator)));
    }
    factors.push(power);
    match Node::sum(inner) {
        (_, Node::Product(inner)) => factors.extend(inner),
        (_, inner) => factors.push(inner),
    }
    (sign, Node::product(factors))
}

fn has_sum(factors: &[Node]) -> bool {
    factors.iter().any(|factor| matches!(factor, Node::Sum(_)))
}

/// The least common denominator of all numbers in an expression.
fn common_denominator(expression: &Expression) -> Integer {
    expression.terms().fold(Integer::one(), |common, (_, fraction)| {
        common.lcm(fraction.numerator().content().denom())
    })
}

/// The terms of a fraction: those of the numerator, ascending in the symbols, or one quotient
/// with what is common to the terms of the numerator in front of them.
pub(crate) fn fraction_terms(fraction: &Fraction) -> Vec<Term> {
    if fraction.as_polynomial().is_some() {
        return polynomial_terms(fraction.numerator());
    }
    let mut sign = Sign::Plus;
    let positive = |p: &Polynomial| {
        let (own, terms) = positive_first(polynomial_terms(p));
        (own, Node::sum(terms).1)
    };
    let (content, common, rest) = common_factors(fraction.numerator());
    let (own, rest) = positive(&rest);
    sign = sign.times(own);
    let mut top = common;
    if rest != Node::Number(Rational::one()) {
        top.push(rest);
    }
    if !content.numer().is_one() {
        top.insert(0, Node::Number(Rational::from_integer(content.numer().clone())));
    }
    let mut bottom = Vec::new();
    if !content.denom().is_one() {
        bottom.push(Node::Number(Rational::from_integer(content.denom().clone())));
    }
    for (factor, power) in fraction.factors() {
        // Factors are stored with a positive leading term, and shown with a positive first term.
        let (own, base) = positive(factor);
        if power % 2 == 1 {
            sign = sign.times(own);
        }
        bottom.push(Node::power(base, power));
    }
    let quotient = Node::Quotient(Box::new(Node::product(top)), Box::new(Node::product(bottom)));
    vec![(sign, quotient)]
}

/// The content of a polynomial, the powers of symbols common to its terms, and the rest.
fn common_factors(p: &Polynomial) -> (Rational, Vec<Node>, Polynomial) {
    let content = p.content();
    let mut rest = p / &content;
    let mut common = Vec::new();
    for symbol in p.symbols() {
        let lowest = rest.coefficients(symbol).last().map_or(0, |(power, _)| *power);
        if lowest > 0 {
            let power = Polynomial::symbol(symbol).pow(lowest);
            rest = rest.divide(&power).expect("the power divides every term");
            common.push(Node::power(Node::Symbol(symbol.clone()), lowest));
        }
    }
    (content, common, rest)
}

/// The terms of a polynomial by ascending total degree.
pub(crate) fn polynomial_terms(p: &Polynomial) -> Vec<Term> {
    let mut terms: Vec<_> = p.terms().collect();
    terms.sort_by_key(|(exponents, _)| exponents.iter().sum::<u32>());
    let node = |(exponents, coefficient): (&[u32], Rational)| {
        let mut factors = Vec::new();
        let size = coefficient.abs();
        let powers = p.symbols().iter().zip(exponents).filter(|(_, e)| **e > 0);
        let powers: Vec<Node> =
            powers.map(|(symbol, e)| Node::power(Node::Symbol(symbol.clone()), *e)).collect();
        if !size.is_one() || powers.is_empty() {
            factors.push(Node::Number(size));
        }
        factors.extend(powers);
        (Sign::of(&coefficient), Node::product(factors))
    };
    terms.into_iter().map(node).collect()
}
