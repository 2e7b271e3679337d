//! The terms of polynomials and fractions in the order in which a person would write them.

use crate::export::tree::{Exponents, Monomial, Sign, Term, Tree, positive_first};
use crate::expression::Fraction;
use num_traits::One;
use std::sync::Arc;
use wavestep_polynomial::{Integer, Ordinary, Polynomial, Rational, Symbol};

/// The terms of a fraction: those of the numerator, ascending in the symbols, or one quotient
/// with the common factors of the numerator's terms in front.
pub(crate) fn fraction_terms(fraction: &Fraction) -> Vec<Term> {
    divided_terms(fraction, &Integer::one())
}

pub(crate) fn divided_terms(fraction: &Fraction, divisor: &Integer) -> Vec<Term> {
    match fraction.as_polynomial() {
        Some(p) => monomials(p, coefficients(p, divisor)),
        None => vec![quotient(&fraction.scale(&Rational::new(Integer::one(), divisor.clone())))],
    }
}

fn quotient(fraction: &Fraction) -> Term {
    let mut sign = Sign::Plus;
    let positive = |p: &Polynomial| {
        let (own, terms) = positive_first(polynomial_terms(p));
        (own, Tree::sum(terms).1)
    };
    // Factors are stored with a positive leading term, and shown with a positive first term.
    let mut power_of = |base: &Polynomial, power: u32| {
        let (own, base) = positive(base);
        if power % 2 == 1 {
            sign = sign.times(own);
        }
        Tree::power(base, power)
    };
    let (content, common, rest) = common_factors(fraction.numerator());
    let mut top = common;
    let rest = match linear_power(&rest) {
        Some((base, power)) => power_of(&base, power),
        None => power_of(&rest, 1),
    };
    top.extend(rest.into_factors());
    if !content.numer().is_one() {
        top.insert(0, Tree::Number(Rational::from_integer(content.numer().clone())));
    }
    let mut bottom = Vec::new();
    if !content.denom().is_one() {
        bottom.push(Tree::Number(Rational::from_integer(content.denom().clone())));
    }
    bottom.extend(fraction.factors().map(|(factor, power)| power_of(factor, power)));
    (sign, Tree::Quotient(Box::new(Tree::product(top)), Box::new(Tree::product(bottom))))
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
fn common_factors(p: &Polynomial) -> (Rational, Vec<Tree>, Polynomial) {
    let content = p.content();
    let mut rest = p / &content;
    let mut common = Vec::new();
    for symbol in p.symbols() {
        let lowest = rest.coefficients(symbol).last().map_or(0, |(power, _)| *power);
        if lowest > 0 {
            let power = Polynomial::symbol(symbol).pow(lowest);
            rest = rest.divide(&power).expect("the power divides every term");
            common.push(Tree::power(Tree::Symbol(symbol.clone()), lowest));
        }
    }
    (content, common, rest)
}

/// The terms of a polynomial by ascending total degree; of one degree, those without roots first.
fn polynomial_terms(p: &Polynomial) -> Vec<Term> {
    monomials(p, coefficients(p, &Integer::one()))
}

/// The reduced coefficients of a polynomial over a number, in the order of its terms.
fn coefficients(p: &Polynomial, divisor: &Integer) -> Vec<Rational> {
    Ordinary::new([p], divisor).coefficients(0).map(|(_, value)| value).collect()
}

/// Terms with the exponents of a polynomial, put in the order of ascending total degree.
pub(crate) fn monomials(
    p: &Polynomial,
    coefficients: impl IntoIterator<Item = Rational>,
) -> Vec<Term> {
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
            ((monomial.exponents.iter().sum(), 0), (sign, monomial.into_tree()))
        })
        .collect();
    terms.sort_by_key(|(degree, _)| *degree);
    terms.into_iter().map(|(_, term)| term).collect()
}
