//! The zero of an exact expression of one symbol, enclosed by Newton's method with balls.

use super::error::EnclosureError;
use super::expression::{enclose_expression, real_part};
use crate::ball::{Attempt, Ball, Precisions};
use crate::expression::Expression;
use std::cmp::Ordering;
use wavestep_polynomial::{Rational, Symbol};

/// Bits of the first look at a sign, and of the last one.
const FIRST_BITS: u64 = 64;
const LAST_BITS: u64 = 1 << 12;

/// How often an interval is halved until the derivative has one sign on it.
const MAX_HALVINGS: u32 = 200;

/// Why no zero is enclosed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ZeroError {
    #[error("the expression has no certain change of sign between these bounds; take others")]
    SameSign,
    #[error("the zero may be double, and cannot be enclosed by signs")]
    NotSimple,
    #[error(transparent)]
    Enclosure(#[from] EnclosureError),
}

/// A function, or its derivative, on a ball with so many bits.
type Enclosures<'a> = dyn Fn(Order, &Ball, u64) -> Result<Ball, EnclosureError> + 'a;

/// What is enclosed of a function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Order {
    Value,
    Slope,
}

/// The sign at a number; `None` where it is not decided.
fn sign(function: &Enclosures<'_>, x: &Rational) -> Result<Option<Ordering>, ZeroError> {
    let attempt = |bits| {
        let value = function(Order::Value, &Ball::from_rational(x, bits), bits)?;
        let sign = value.sign().filter(|sign| sign.is_ne());
        Ok(Attempt::of(sign, sign.is_some()))
    };
    Precisions::doubling(FIRST_BITS, LAST_BITS).raise(attempt).map(Attempt::best)
}

/// A zero between two bounds at which an expression has different signs, to about `bits` bits: found by halving
/// until its derivative is known well enough for Newton's method.
pub fn enclose_zero(
    expression: &Expression,
    symbol: &Symbol,
    ends: &[Rational; 2],
    bits: u64,
) -> Result<Ball, ZeroError> {
    let derivative = expression.derivative(symbol);
    let function = |order, x: &Ball, bits| {
        let expression = if order == Order::Value { expression } else { &derivative };
        let at = |own: &Symbol, _| (own == symbol).then(|| x.clone());
        real_part(enclose_expression(expression, &at, bits)?)
    };
    enclose_zero_of(&function, ends, bits)
}

/// A zero between two bounds at which a function has different signs, to about `bits` bits.
///
/// The interval is halved, keeping a change of sign, until the derivative is known to a quarter on it: it then
/// holds exactly one zero. From there on `m − f(m)/f'(X)` encloses that zero, by the mean value
/// theorem, and is about twice as exact as the interval X around m. That there is only one zero
/// between the given bounds is not proven.
pub fn enclose_zero_of(
    function: &Enclosures<'_>,
    ends: &[Rational; 2],
    bits: u64,
) -> Result<Ball, ZeroError> {
    let mut interval = single_zero(function, ends)?;
    let precisions = Precisions::doubling(FIRST_BITS, 2 * bits + LAST_BITS);
    let mut working = precisions.first();
    loop {
        let middle = Rational::from(interval.midpoint());
        let point = Ball::from_rational(&middle, 2 * working + 64);
        let slope = function(Order::Slope, &interval, working)?;
        let inverse = slope.reciprocal(working).map_err(EnclosureError::Ball)?;
        let value = function(Order::Value, &point, 2 * working)?;
        let next = point.subtract(&value.multiply(&inverse, 2 * working), 2 * working + 32);
        let is_smaller = next.radius().scale(1) < *interval.radius();
        if is_smaller {
            interval = next;
        }
        let fine = interval.magnitude().scale(-(bits as i64));
        if *interval.radius() <= fine {
            return Ok(interval);
        }
        match precisions.after(working) {
            Some(more) => working = more,
            None if is_smaller => {}
            None => return Err(ZeroError::NotSimple),
        }
    }
}

/// An interval with exactly one zero, on which the derivative is known to a quarter.
fn single_zero(function: &Enclosures<'_>, [low, high]: &[Rational; 2]) -> Result<Ball, ZeroError> {
    let (mut low, mut high) = (low.clone(), high.clone());
    let first = sign(function, &low)?.ok_or(ZeroError::SameSign)?;
    if sign(function, &high)? != Some(first.reverse()) {
        return Err(ZeroError::SameSign);
    }
    for _ in 0..=MAX_HALVINGS {
        let interval = Ball::between(&low, &high, FIRST_BITS);
        // With a slope that is known to a quarter, Newton's step less than halves the interval: its radius
        // is at most (5/4)(1/4)/(3/4) of it.
        if let Ok(slope) = function(Order::Slope, &interval, FIRST_BITS)
            && slope.radius().scale(2) < slope.midpoint().magnitude()
        {
            return Ok(interval);
        }
        // A zero in the middle itself is met by cutting elsewhere.
        let cuts = [(1, 2), (3, 7)].map(|(a, b)| Rational::new(a.into(), b.into()));
        let signed = cuts.iter().find_map(|share| {
            let cut = &low + (&high - &low) * share;
            match sign(function, &cut) {
                Ok(Some(sign)) => Some(Ok((cut, sign))),
                Ok(None) => None,
                Err(error) => Some(Err(error)),
            }
        });
        let (cut, sign) = signed.ok_or(ZeroError::NotSimple)??;
        if sign == first { low = cut } else { high = cut }
    }
    Err(ZeroError::NotSimple)
}
