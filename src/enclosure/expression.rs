//! Enclosures of exact expressions whose symbols are known as balls.

use crate::ball::{Ball, BallError, ComplexBall};
use crate::enclosure::error::EnclosureError;
use crate::expression::{Expression, Fraction, PI};
use std::collections::BTreeMap;
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// The powers `x^0, x^1, …` of the symbols of an expression.
type Powers = BTreeMap<Symbol, Vec<ComplexBall>>;

/// Encloses the value of an expression with about `bits` bits.
///
/// Square roots and π are known; every other symbol has the value that `values` gives, with the bits that
/// are wanted. An expression that is real, such as a sum of conjugate terms, has an imaginary part
/// whose enclosure contains 0.
///
/// A product of complex balls for each symbol of each term, and an exponential for each exponent.
pub fn enclose_expression(
    expression: &Expression,
    values: &dyn Fn(&Symbol, u64) -> Option<Ball>,
    bits: u64,
) -> Result<ComplexBall, EnclosureError> {
    let mut powers = Powers::new();
    for symbol in expression.symbols() {
        let value = match symbol.square() {
            Some(square) => root(square, bits),
            None if symbol.name() == PI => Ball::pi(bits).into(),
            None => match values(&symbol, bits) {
                Some(value) => value.into(),
                None => return Err(EnclosureError::MissingValue(symbol)),
            },
        };
        let degree = expression
            .terms()
            .map(|(exponent, p)| degree_of(exponent, &symbol).max(degree_of(p, &symbol)));
        let mut row = vec![one()];
        for _ in 0..degree.max().unwrap_or(0) {
            row.push(row[row.len() - 1].multiply(&value, bits));
        }
        powers.insert(symbol, row);
    }
    let mut sum = ComplexBall::zero();
    for (exponent, p) in expression.terms() {
        let mut term = fraction(p, &powers, bits)?;
        if !exponent.is_zero() {
            let exponent = fraction(exponent, &powers, bits)?;
            let exponential = exponent.exp(bits)?;
            term = term.multiply(&exponential, bits);
        }
        sum = sum.add(&term, bits);
    }
    Ok(sum)
}

fn one() -> ComplexBall {
    Ball::from_rational(&Rational::from_integer(1.into()), 2).into()
}

/// The root of −1 or of a prime.
fn root(square: i64, bits: u64) -> ComplexBall {
    let size = Rational::from_integer(square.abs().into());
    let size = Ball::square_root(&size, bits).expect("a size is not negative");
    if square < 0 { ComplexBall::new(Ball::zero(), size) } else { size.into() }
}

fn degree_of(fraction: &Fraction, x: &Symbol) -> u32 {
    let parts = std::iter::once(fraction.numerator()).chain(fraction.factors().map(|f| f.0));
    parts.map(|p| p.degree(x)).max().unwrap_or(0)
}

fn fraction(value: &Fraction, powers: &Powers, bits: u64) -> Result<ComplexBall, BallError> {
    let mut enclosure = polynomial(value.numerator(), powers, bits);
    for (factor, power) in value.factors() {
        let inverse = polynomial(factor, powers, bits).reciprocal(bits)?;
        for _ in 0..power {
            enclosure = enclosure.multiply(&inverse, bits);
        }
    }
    Ok(enclosure)
}

fn polynomial(p: &Polynomial, powers: &Powers, bits: u64) -> ComplexBall {
    let rows: Vec<&Vec<ComplexBall>> = p.symbols().iter().map(|x| &powers[x]).collect();
    let mut sum = ComplexBall::zero();
    for (exponents, coefficient) in p.terms() {
        let factors = rows.iter().zip(exponents).filter(|(_, e)| **e > 0);
        let product =
            factors.fold(one(), |product, (row, e)| product.multiply(&row[*e as usize], bits));
        sum = sum.add(&product.multiply_rational(&coefficient, bits), bits);
    }
    sum
}

/// The real part of a value that is real: zero lies in the enclosure of its imaginary part.
pub(crate) fn real_part(value: ComplexBall) -> Result<Ball, EnclosureError> {
    match value.imaginary().contains_zero() {
        true => Ok(value.real().clone()),
        false => Err(EnclosureError::NotReal),
    }
}
