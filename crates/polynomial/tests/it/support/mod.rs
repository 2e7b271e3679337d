//! Polynomials, numbers and symbols at random: zero, constants, shared and disjoint symbols, high
//! powers, long and negative and fractional coefficients.

use proptest::prelude::*;
use std::collections::BTreeMap;
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol, Univariate, factorial};

/// One term: coefficient and powers.
pub type Term = (Rational, Vec<(Symbol, u32)>);

pub fn symbol(name: &str) -> Symbol {
    Symbol::new(name).expect("a name")
}

pub fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// A sum of products of numbers, names, square roots and powers, such as `-3/2*mu^2*s + sqrt(-1)`.
pub fn read(text: &str) -> Polynomial {
    let (mut terms, mut depth) = (vec![String::new()], 0);
    for c in text.chars().filter(|c| !c.is_whitespace()) {
        depth += i32::from(c == '(') - i32::from(c == ')');
        if depth == 0 && (c == '+' || c == '-') {
            terms.push(if c == '-' { "-1*".to_owned() } else { String::new() });
        } else {
            terms.last_mut().expect("a term").push(c);
        }
    }
    if terms[0].is_empty() {
        terms.remove(0);
    }
    valid(terms.iter().map(|term| read_term(term)).sum())
}

fn read_term(text: &str) -> Polynomial {
    let (mut coefficient, mut powers) = (rational(1, 1), BTreeMap::new());
    for factor in text.split('*') {
        if let Ok(number) = factor.parse::<Rational>() {
            coefficient *= number;
            continue;
        }
        let (base, exponent) = factor.split_once('^').unwrap_or((factor, "1"));
        let root = base.strip_prefix("sqrt(").and_then(|rest| rest.strip_suffix(')'));
        let symbol = match root {
            Some(radicand) => Symbol::square_root(radicand.parse().unwrap()).expect("no square"),
            None => symbol(base),
        };
        *powers.entry(symbol).or_insert(0) += exponent.parse::<u32>().expect("an exponent");
    }
    let powers: Vec<_> = powers.iter().map(|(symbol, exponent)| (symbol, *exponent)).collect();
    Polynomial::monomial(&coefficient, &powers)
}

/// The polynomial itself, its invariants asserted.
#[track_caller]
pub fn valid(p: Polynomial) -> Polynomial {
    assert!(p.is_valid(), "invariants broken: {p}");
    p
}

pub fn monomial((coefficient, powers): &Term) -> Polynomial {
    let powers: Vec<_> = powers.iter().map(|(symbol, e)| (symbol, *e)).collect();
    valid(Polynomial::monomial(coefficient, &powers))
}

/// Integers of either sign: small ones most often, some of 200 bits, some with many factors.
pub fn integers() -> BoxedStrategy<Integer> {
    prop_oneof![
        6 => (-9_i64..10).prop_map(Integer::from),
        2 => any::<i64>().prop_map(Integer::from),
        1 => any::<[i64; 3]>().prop_map(|[a, b, c]| Integer::from(a) * b * c + 1),
        1 => (0_u32..25, -3_i32..4).prop_map(|(n, sign)| factorial(n) * sign),
    ]
    .boxed()
}

/// Rationals of either sign, integers half of the time.
pub fn rationals() -> BoxedStrategy<Rational> {
    let denominators = prop_oneof![3 => Just(Integer::from(1)), 3 => integers()];
    (integers(), denominators)
        .prop_map(|(numerator, denominator)| {
            let zero = Integer::from(0);
            Rational::new(numerator, if denominator == zero { 12.into() } else { denominator })
        })
        .boxed()
}

pub fn non_zero_rationals() -> BoxedStrategy<Rational> {
    rationals().prop_filter("not zero", |value| *value != rational(0, 1)).boxed()
}

pub fn symbols() -> BoxedStrategy<Symbol> {
    prop::sample::select(vec!["b", "mu", "s", "x_1"]).prop_map(symbol).boxed()
}

fn terms_of(
    symbol: impl Strategy<Value = Symbol> + Clone + 'static,
    exponents: impl Strategy<Value = u32> + Clone + 'static,
    count: usize,
) -> BoxedStrategy<Vec<Term>> {
    let powers = prop::collection::vec((symbol, exponents), 0..4);
    prop::collection::vec((rationals(), powers), 0..=count).boxed()
}

/// Lists of terms; symbols come twice in a term, and terms twice in a list.
pub fn terms() -> BoxedStrategy<Vec<Term>> {
    terms_of(symbols(), 0_u32..4, 6).boxed()
}

/// Polynomials of a few terms in some of four symbols, among them zero and constants.
pub fn polynomials() -> BoxedStrategy<Polynomial> {
    let one = |name| Just(symbol(name));
    prop_oneof![
        8 => terms(),
        1 => terms_of(one("a"), 0_u32..4, 3),
        1 => terms_of(one("z"), 0_u32..4, 3),
        1 => terms_of(symbols(), prop_oneof![0_u32..3, 30_u32..40, 190_u32..200], 2),
        1 => rationals().prop_map(|value| vec![(value, Vec::new())]),
    ]
    .prop_map(|terms| terms.iter().map(monomial).sum())
    .prop_map(valid)
    .boxed()
}

/// Polynomials of low degree, for what composes them.
pub fn small_polynomials() -> BoxedStrategy<Polynomial> {
    terms_of(symbols(), 0_u32..3, 3)
        .prop_map(|terms| valid(terms.iter().map(monomial).sum()))
        .boxed()
}

pub fn non_zero_polynomials() -> BoxedStrategy<Polynomial> {
    polynomials().prop_filter("not zero", |p| !p.is_zero()).boxed()
}

/// Dense polynomials in one variable, up to degree 11.
pub fn univariates() -> BoxedStrategy<Univariate> {
    let denominators = integers().prop_filter("not zero", |d| *d != Integer::from(0));
    (prop::collection::vec(integers(), 0..12), denominators)
        .prop_map(|(coefficients, denominator)| Univariate::new(coefficients, denominator))
        .boxed()
}
