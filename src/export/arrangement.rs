//! The order in which a person would write an expression.
//!
//! First the exponential of the time variable, then descending powers of that variable, each with
//! its coefficient; coefficients ascend in the exponentials of symbols (`1 + e^{−2μ} + …`) and in
//! the symbols. The sign stands outside a bracket, so that the inside starts positive; a common
//! denominator stands outside, a common integer factor stays inside. Conjugate exponentials are
//! written as cosines and sines.

use crate::export::oscillation::{Oscillation, oscillations};
use crate::export::terms::{divided_terms, fraction_terms, monomials};
use crate::export::tree::{Sign, Term, Tree, positive_first};
use crate::expression::{Expression, Fraction};
use num_integer::Integer as _;
use num_traits::{One, Zero};
use std::collections::BTreeMap;
use wavestep_polynomial::{Integer, Ordinary, Rational, Symbol, factorial};

/// How an expression is arranged.
#[derive(Clone, Default, Debug)]
pub(crate) struct Arrangement {
    /// The time variable, if there is one.
    pub variable: Option<Symbol>,
    /// Takes a common integer factor out of a bracket that holds a further bracket.
    pub factored: bool,
    /// A name for the term without the variable beside its leading exponential, where that would
    /// hold a bracket; it is then stated apart.
    pub constant: Option<Symbol>,
}

/// The terms of an expression in writing order; zero has no terms.
pub(crate) fn arrange(expression: &Expression, variable: Option<&Symbol>) -> Vec<Term> {
    let arrangement = Arrangement { variable: variable.cloned(), ..Arrangement::default() };
    arrangement.terms(expression).0
}

impl Arrangement {
    /// The terms of an expression in writing order, and those of the constant that is stated
    /// apart. Zero has no terms.
    pub fn terms(&self, expression: &Expression) -> (Vec<Term>, Option<Vec<Term>>) {
        let Some(x) = &self.variable else {
            let parts = oscillations(expression).into_iter();
            let mut parts: Vec<Summand> = parts.map(|(wave, p)| (wave, p.into_owned())).collect();
            parts.sort_by_cached_key(|(exponent, _)| exponent.key());
            return (Coefficient::new(0, parts).terms(), None);
        };
        let mut apart = None;
        let mut terms = Vec::new();
        for (i, (rate, by_power)) in by_rate_and_power(expression, x).into_iter().enumerate() {
            let mut inner = Vec::new();
            for (power, coefficient) in by_power.into_iter().rev() {
                match (power, &self.constant) {
                    (0, Some(name)) if i == 0 && coefficient.is_nested() => {
                        apart = Some(coefficient.terms());
                        inner.push((Sign::Plus, Tree::Symbol(name.clone())));
                    }
                    (0, _) => inner.extend(coefficient.terms()),
                    _ => inner.push(coefficient.times_power(x, self.factored)),
                }
            }
            if rate.is_one() {
                terms.extend(inner);
                continue;
            }
            let growth = &rate.growth * &Fraction::symbol(x);
            let mut factors = wave_factors(&Oscillation { growth, angle: rate.angle });
            terms.push(match inner.len() {
                1 => with_factors(inner, factors),
                // Here signs stay inside: the bracket is the polynomial of the wave function.
                _ => {
                    factors.push(Tree::Bracket(inner));
                    (Sign::Plus, Tree::Product(factors))
                }
            });
        }
        (terms, apart)
    }
}

/// The coefficient of a power of the variable: `(1/power!) Σ p e^{λ}`, by ascending exponent.
struct Coefficient {
    power: u32,
    divisor: Integer,
    parts: Vec<Summand>,
}

/// An exponential, cosine or sine with its coefficient.
type Summand = (Oscillation, Fraction);

/// The coefficients of an expression by the rate of the variable in the exponent and by the angle
/// that holds the variable, then by its power.
fn by_rate_and_power(
    expression: &Expression,
    x: &Symbol,
) -> Vec<(Oscillation, BTreeMap<u32, Coefficient>)> {
    let split = |exponent: Oscillation| {
        let rate = exponent.growth.derivative(x);
        let base = &exponent.growth - &(&rate * &Fraction::symbol(x));
        let depends = exponent.angle.as_ref().is_some_and(|(_, angle)| angle.contains(x));
        let (outer, inner) = if depends { (exponent.angle, None) } else { (None, exponent.angle) };
        let base = Oscillation { growth: base, angle: inner };
        (base, Oscillation { growth: rate, angle: outer })
    };
    let terms = oscillations(expression).into_iter();
    let mut terms: Vec<_> = terms.map(|(exponent, p)| (split(exponent), p)).collect();
    terms.sort_by_cached_key(|((base, _), _)| base.key());
    let mut groups = BTreeMap::<Oscillation, BTreeMap<u32, Vec<Summand>>>::new();
    for ((base, rate), p) in terms {
        let group = groups.entry(rate).or_default();
        for (power, part) in p.numerator().divided_coefficients(x) {
            group.entry(power).or_default().push((base.clone(), p.with_numerator(part)));
        }
    }
    let coefficient = |(power, parts)| (power, Coefficient::new(power, parts));
    let by_power = |(rate, group): (Oscillation, BTreeMap<u32, Vec<_>>)| {
        (rate, group.into_iter().map(coefficient).collect())
    };
    let mut groups: Vec<_> = groups.into_iter().map(by_power).collect();
    groups.sort_by_cached_key(|group| group.0.key());
    groups
}

/// The exponential, and the cosine or sine, if they are not 1.
fn wave_factors(oscillation: &Oscillation) -> Vec<Tree> {
    let mut factors = Vec::new();
    if !oscillation.growth.is_zero() {
        let (sign, exponent) = Tree::sum(fraction_terms(&oscillation.growth));
        factors.push(Tree::Exponential(sign, Box::new(exponent)));
    }
    if let Some((wave, angle)) = &oscillation.angle {
        let (_, angle) = Tree::sum(fraction_terms(angle));
        factors.push(Tree::Oscillation(*wave, Box::new(angle)));
    }
    factors
}

impl Coefficient {
    fn new(power: u32, parts: Vec<Summand>) -> Coefficient {
        Coefficient { power, divisor: factorial(power), parts }
    }

    /// Whether writing it takes a bracket inside a bracket.
    fn is_nested(&self) -> bool {
        let bracket =
            |(exponent, p): &Summand| !exponent.is_one() && p.numerator().term_count() > 1;
        self.parts.iter().any(bracket)
    }

    fn terms(&self) -> Vec<Term> {
        let part = |(exponent, p): &Summand| (exponent.clone(), divided_terms(p, &self.divisor));
        sum_of_parts(self.parts.iter().map(part))
    }

    /// `coefficient · x^power`, as `−(1/2) x² (1 + e^{−μ})`.
    fn times_power(&self, x: &Symbol, factored: bool) -> Term {
        let power = Tree::power(Tree::Symbol(x.clone()), self.power);
        if let [(_, p)] = &self.parts[..]
            && (p.as_polynomial().is_none() || p.numerator().term_count() == 1)
        {
            let (sign, tree) = self.terms().remove(0);
            let mut factors = tree.into_factors();
            let place = factors.iter().position(Tree::is_wave);
            factors.insert(place.unwrap_or(factors.len()), power);
            return (sign, Tree::product(factors));
        }
        let (front, terms) = self.over_common_denominator(factored);
        let (sign, inner) = positive_first(terms);
        let mut factors = Vec::new();
        if !front.is_one() {
            factors.push(Tree::Number(front));
        }
        factors.push(power);
        match Tree::sum(inner) {
            (_, Tree::Product(inner)) => factors.extend(inner),
            (_, inner) => factors.push(inner),
        }
        (sign, Tree::product(factors))
    }

    /// `front · (terms)` with integers in the terms: their common factor stays with them unless
    /// it is to be taken out of a nested bracket.
    fn over_common_denominator(&self, factored: bool) -> (Rational, Vec<Term>) {
        let numerators = self.parts.iter().map(|(_, p)| p.numerator());
        let ordinary = Ordinary::new(numerators, &self.divisor);
        let content = match factored && self.is_nested() {
            true => (0..self.parts.len())
                .flat_map(|i| ordinary.integers(i))
                .fold(Integer::zero(), |gcd, value| gcd.gcd(value)),
            false => Integer::one(),
        };
        let front = Rational::new(content.clone(), ordinary.denominator().clone());
        let part = |(i, (exponent, p)): (usize, &Summand)| {
            let terms = match p.as_polynomial() {
                Some(polynomial) => {
                    let whole = |value: &Integer| match content.is_one() {
                        true => value.clone(),
                        false => value / &content,
                    };
                    let values = ordinary.integers(i).iter().map(whole);
                    monomials(polynomial, values.map(Rational::from_integer))
                }
                None => fraction_terms(&p.scale(&(front.recip() / &self.divisor))),
            };
            (exponent.clone(), terms)
        };
        let sum = sum_of_parts(self.parts.iter().enumerate().map(part));
        (front, sum)
    }
}

/// `Σ e^{exponent} (terms)`.
fn sum_of_parts(parts: impl Iterator<Item = (Oscillation, Vec<Term>)>) -> Vec<Term> {
    let mut sum = Vec::new();
    for (exponent, inner) in parts {
        if exponent.is_one() {
            sum.extend(inner);
        } else {
            sum.push(with_factors(inner, wave_factors(&exponent)));
        }
    }
    sum
}

/// `waves · (inner)`: the waves before a bracket, or among the factors of a single term.
fn with_factors(mut inner: Vec<Term>, mut waves: Vec<Tree>) -> Term {
    if inner.len() == 1 {
        let (sign, tree) = inner.remove(0);
        let mut factors = tree.into_factors();
        // A number and symbols stand before the exponentials, cosines and brackets after them.
        for wave in waves {
            let follows = |f: &Tree| match (&wave, f) {
                (Tree::Exponential(..), Tree::Exponential(..)) => true,
                (_, f) => matches!(f, Tree::Sum(_) | Tree::Oscillation(..)),
            };
            let place = factors.iter().position(follows);
            factors.insert(place.unwrap_or(factors.len()), wave);
        }
        return (sign, Tree::product(factors));
    }
    let (sign, inner) = positive_first(inner);
    waves.push(Tree::Sum(inner));
    (sign, Tree::Product(waves))
}
