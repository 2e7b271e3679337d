//! The order in which a person would write an expression.
//!
//! First the exponential of the time variable, then descending powers of that variable, each with
//! its coefficient; coefficients ascend in the exponentials of symbols (`1 + e^{−2μ} + …`) and in
//! the symbols. The sign stands outside a bracket, so that what is inside starts positive; a common
//! denominator stands outside, a common integer factor stays inside. Conjugate exponentials are
//! written as cosines and sines.

use crate::export::oscillation::{Oscillation, Wave, oscillations};
use crate::expression::{Expression, Fraction};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};
use smallvec::SmallVec;
use std::collections::BTreeMap;
use std::sync::Arc;
use wavestep_polynomial::{Integer, Ordinary, Polynomial, Rational, Symbol, factorial};

/// The sign in front of a term.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Sign {
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
pub(crate) enum Node {
    /// A number, not negative.
    Number(Rational),
    /// A name.
    Symbol(Symbol),
    /// A sum of at least two terms.
    Sum(Vec<(Sign, Node)>),
    /// The bracket of a wave function, after its exponential.
    Bracket(Vec<(Sign, Node)>),
    /// A number times powers of symbols, at least two factors: what sums have most of.
    Monomial(Monomial),
    /// A product of at least two factors.
    Product(Vec<Node>),
    /// A quotient.
    Quotient(Box<Node>, Box<Node>),
    /// A power.
    Power(Box<Node>, Box<Node>),
    /// `e^{…}`, with the exponent's sign.
    Exponential(Sign, Box<Node>),
    /// `cos(…)` or `sin(…)`.
    Oscillation(Wave, Box<Node>),
    /// The square root of a positive integer, times the imaginary unit where that is said.
    Root(Integer, bool),
    /// `L_k(x)`, a Laguerre polynomial: index and argument.
    Laguerre(Box<Node>, Box<Node>),
    /// `k!`
    Factorial(Box<Node>),
}

/// A positive number times powers of symbols.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Monomial {
    /// The number.
    pub coefficient: Rational,
    /// The symbols.
    pub symbols: Arc<[Symbol]>,
    /// The exponent of each symbol.
    pub exponents: Exponents,
}

/// Roots are written as one root of a product below this: its factors are found again by trial.
const LARGEST_RADICAND: i64 = 1_000_000_000_000;

/// Exponents of a few symbols.
pub(crate) type Exponents = SmallVec<[u32; 4]>;

impl Monomial {
    /// As a node, of the simplest kind.
    fn into_node(self) -> Node {
        let mut powers = self.exponents.iter().enumerate().filter(|(_, e)| **e > 0);
        match (powers.next(), powers.next()) {
            (None, _) => Node::Number(self.coefficient),
            (Some((i, exponent)), None) if self.coefficient.is_one() => {
                Node::power(Node::Symbol(self.symbols[i].clone()), *exponent)
            }
            _ => Node::Monomial(self),
        }
    }

    /// The degree in the symbols that are no roots, and the number of roots.
    fn degrees(&self) -> (u32, u32) {
        self.powers().fold((0, 0), |(degree, roots), (x, e)| match x.square() {
            None => (degree + e, roots),
            Some(_) => (degree, roots + e),
        })
    }

    /// As a node that shows its roots together with the number: `3*sqrt(6)/4*x`.
    fn with_roots_apart(mut self) -> Node {
        let (mut roots, mut radicand, mut imaginary) = (Vec::new(), Integer::one(), false);
        for (symbol, exponent) in self.symbols.iter().zip(&mut self.exponents) {
            let Some(square) = symbol.square().filter(|_| *exponent > 0) else { continue };
            *exponent = 0;
            let longer = &radicand * square;
            match square {
                -1 => imaginary = true,
                _ if longer < Integer::from(LARGEST_RADICAND) => radicand = longer,
                _ => roots.push(Node::Root(square.into(), false)),
            }
        }
        if !radicand.is_one() || imaginary {
            roots.insert(0, Node::Root(radicand, imaginary));
        }
        if roots.is_empty() {
            return self.into_node();
        }
        let (top, bottom) = self.coefficient.clone().into_raw();
        self.coefficient = Rational::one();
        if !top.is_one() {
            roots.insert(0, Node::Number(top.into()));
        }
        let mut factors = match bottom.is_one() {
            true => roots,
            false => {
                let (top, bottom) = (Node::product(roots), Node::Number(bottom.into()));
                vec![Node::Quotient(Box::new(top), Box::new(bottom))]
            }
        };
        factors.extend(self.into_node().into_factors());
        Node::product(factors)
    }

    /// The symbols that occur, with their exponents.
    pub fn powers(&self) -> impl Iterator<Item = (&Symbol, u32)> {
        self.symbols.iter().zip(self.exponents.iter().copied()).filter(|(_, e)| *e > 0)
    }
}

/// A term: sign and what follows it.
pub(crate) type Term = (Sign, Node);

impl Node {
    /// Whether it is higher than a line.
    pub(crate) fn is_tall(&self) -> bool {
        match self {
            Node::Number(value) => !value.is_integer(),
            Node::Monomial(monomial) => !monomial.coefficient.is_integer(),
            Node::Quotient(..) => true,
            Node::Sum(terms) | Node::Bracket(terms) => terms.iter().any(|term| term.1.is_tall()),
            Node::Product(factors) => factors.iter().any(Node::is_tall),
            Node::Power(base, _) => base.is_tall(),
            Node::Oscillation(_, angle) => angle.is_tall(),
            Node::Symbol(_)
            | Node::Root(..)
            | Node::Exponential(..)
            | Node::Laguerre(..)
            | Node::Factorial(_) => false,
        }
    }

    /// Whether this is an exponential, a cosine or a sine.
    fn is_wave(&self) -> bool {
        matches!(self, Node::Exponential(..) | Node::Oscillation(..))
    }

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
            let mut parts: Vec<Part> = parts.map(|(wave, p)| (wave, p.into_owned())).collect();
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
                        inner.push((Sign::Plus, Node::Symbol(name.clone())));
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
                    factors.push(Node::Bracket(inner));
                    (Sign::Plus, Node::Product(factors))
                }
            });
        }
        (terms, apart)
    }
}

/// What stands beside a power of the variable: `(1/power!) Σ p e^{λ}`, by ascending exponent.
struct Coefficient {
    power: u32,
    divisor: Integer,
    parts: Vec<Part>,
}

/// An exponential, cosine or sine with its coefficient.
type Part = (Oscillation, Fraction);

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
    let mut groups = BTreeMap::<Oscillation, BTreeMap<u32, Vec<Part>>>::new();
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

/// The exponential, and the cosine or sine, of those that there are.
fn wave_factors(oscillation: &Oscillation) -> Vec<Node> {
    let mut factors = Vec::new();
    if !oscillation.growth.is_zero() {
        let (sign, exponent) = Node::sum(fraction_terms(&oscillation.growth));
        factors.push(Node::Exponential(sign, Box::new(exponent)));
    }
    if let Some((wave, angle)) = &oscillation.angle {
        let (_, angle) = Node::sum(fraction_terms(angle));
        factors.push(Node::Oscillation(*wave, Box::new(angle)));
    }
    factors
}

impl Coefficient {
    fn new(power: u32, parts: Vec<Part>) -> Coefficient {
        Coefficient { power, divisor: factorial(power), parts }
    }

    /// Whether writing it takes a bracket inside a bracket.
    fn is_nested(&self) -> bool {
        let bracket = |(exponent, p): &Part| !exponent.is_one() && p.numerator().term_count() > 1;
        self.parts.iter().any(bracket)
    }

    /// The terms, ascending.
    fn terms(&self) -> Vec<Term> {
        let part = |(exponent, p): &Part| (exponent.clone(), divided_terms(p, &self.divisor));
        sum_of_parts(self.parts.iter().map(part))
    }

    /// `coefficient · x^power`, as `−(1/2) x² (1 + e^{−μ})`.
    fn times_power(&self, x: &Symbol, factored: bool) -> Term {
        let power = Node::power(Node::Symbol(x.clone()), self.power);
        if let [(_, p)] = &self.parts[..]
            && (p.as_polynomial().is_none() || p.numerator().term_count() == 1)
        {
            let (sign, node) = self.terms().remove(0);
            let mut factors = node.into_factors();
            let place = factors.iter().position(Node::is_wave);
            factors.insert(place.unwrap_or(factors.len()), power);
            return (sign, Node::product(factors));
        }
        let (front, terms) = self.over_common_denominator(factored);
        let (sign, inner) = positive_first(terms);
        let mut factors = Vec::new();
        if !front.is_one() {
            factors.push(Node::Number(front));
        }
        factors.push(power);
        match Node::sum(inner) {
            (_, Node::Product(inner)) => factors.extend(inner),
            (_, inner) => factors.push(inner),
        }
        (sign, Node::product(factors))
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
        let part = |(i, (exponent, p)): (usize, &Part)| {
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
fn with_factors(mut inner: Vec<Term>, mut waves: Vec<Node>) -> Term {
    if inner.len() == 1 {
        let (sign, node) = inner.remove(0);
        let mut factors = node.into_factors();
        // A number and symbols stand before the exponentials, cosines and brackets after them.
        for wave in waves {
            let follows = |f: &Node| match (&wave, f) {
                (Node::Exponential(..), Node::Exponential(..)) => true,
                (_, f) => matches!(f, Node::Sum(_) | Node::Oscillation(..)),
            };
            let place = factors.iter().position(follows);
            factors.insert(place.unwrap_or(factors.len()), wave);
        }
        return (sign, Node::product(factors));
    }
    let (sign, inner) = positive_first(inner);
    waves.push(Node::Sum(inner));
    (sign, Node::Product(waves))
}

/// Takes the sign out of a sum, so that what is left starts positive.
fn positive_first(mut terms: Vec<Term>) -> (Sign, Vec<Term>) {
    let sign = terms.first().map_or(Sign::Plus, |term| term.0);
    terms.iter_mut().for_each(|term| term.0 = term.0.times(sign));
    (sign, terms)
}

/// The terms of a fraction: those of the numerator, ascending in the symbols, or one quotient
/// with what is common to the terms of the numerator in front of them.
pub(crate) fn fraction_terms(fraction: &Fraction) -> Vec<Term> {
    divided_terms(fraction, &Integer::one())
}

/// The terms of a fraction over a number.
fn divided_terms(fraction: &Fraction, divisor: &Integer) -> Vec<Term> {
    match fraction.as_polynomial() {
        Some(p) => monomials(p, coefficients(p, divisor)),
        None => vec![quotient(&fraction.scale(&Rational::new(Integer::one(), divisor.clone())))],
    }
}

fn quotient(fraction: &Fraction) -> Term {
    let mut sign = Sign::Plus;
    let positive = |p: &Polynomial| {
        let (own, terms) = positive_first(polynomial_terms(p));
        (own, Node::sum(terms).1)
    };
    // Factors are stored with a positive leading term, and shown with a positive first term.
    let mut power_of = |base: &Polynomial, power: u32| {
        let (own, base) = positive(base);
        if power % 2 == 1 {
            sign = sign.times(own);
        }
        Node::power(base, power)
    };
    let (content, common, rest) = common_factors(fraction.numerator());
    let mut top = common;
    let rest = match linear_power(&rest) {
        Some((base, power)) => power_of(&base, power),
        None => power_of(&rest, 1),
    };
    top.extend(rest.into_factors());
    if !content.numer().is_one() {
        top.insert(0, Node::Number(Rational::from_integer(content.numer().clone())));
    }
    let mut bottom = Vec::new();
    if !content.denom().is_one() {
        bottom.push(Node::Number(Rational::from_integer(content.denom().clone())));
    }
    bottom.extend(fraction.factors().map(|(factor, power)| power_of(factor, power)));
    (sign, Node::Quotient(Box::new(Node::product(top)), Box::new(Node::product(bottom))))
}

/// A polynomial of content 1 in one symbol as a power of a linear one, `±(a x + b)^n` with n > 1,
/// where it is one. The leading coefficients `a^n` and `n a^{n−1} b` give `b/a`.
fn linear_power(p: &Polynomial) -> Option<(Polynomial, u32)> {
    let [x] = p.symbols() else { return None };
    let n = p.degree(x);
    if n < 2 || p.term_count() != n as usize + 1 {
        return None;
    }
    let leading: Vec<Rational> = p.terms().take(2).map(|(_, value)| value).collect();
    let ratio = &leading[1] / (&leading[0] * Rational::from_integer(n.into()));
    let base = (&Polynomial::symbol(x) + &Polynomial::constant(&ratio)).primitive_part().1;
    let power = base.pow(n);
    let minus = -&base;
    match power == *p {
        true => Some((base, n)),
        // Odd powers take the sign in; an even one cannot.
        false => (n % 2 == 1 && minus.pow(n) == *p).then_some((minus, n)),
    }
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

/// The terms of a polynomial by ascending total degree; of one degree, those without roots first.
pub(crate) fn polynomial_terms(p: &Polynomial) -> Vec<Term> {
    monomials(p, coefficients(p, &Integer::one()))
}

/// The reduced coefficients of a polynomial over a number, in the order of its terms.
fn coefficients(p: &Polynomial, divisor: &Integer) -> Vec<Rational> {
    Ordinary::new([p], divisor).coefficients(0).map(|(_, value)| value).collect()
}

/// Terms with the exponents of a polynomial, put in the order of ascending total degree.
fn monomials(p: &Polynomial, coefficients: impl IntoIterator<Item = Rational>) -> Vec<Term> {
    let symbols: Arc<[Symbol]> = p.symbols().into();
    let has_roots = p.roots().next().is_some();
    let (_, terms) = p.divided_terms();
    let mut terms: Vec<((u32, u32), Term)> = terms
        .zip(coefficients)
        .map(|((exponents, _), coefficient)| {
            let sign = Sign::of(&coefficient);
            let coefficient = if sign == Sign::Minus { -coefficient } else { coefficient };
            let (symbols, exponents) = (symbols.clone(), Exponents::from_slice(exponents));
            let monomial = Monomial { coefficient, symbols, exponents };
            if has_roots {
                return (monomial.degrees(), (sign, monomial.with_roots_apart()));
            }
            ((monomial.exponents.iter().sum(), 0), (sign, monomial.into_node()))
        })
        .collect();
    terms.sort_by_key(|(degree, _)| *degree);
    terms.into_iter().map(|(_, term)| term).collect()
}
