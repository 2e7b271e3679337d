//! The course of a load as a series on a cell.
//!
//! A course is a sum of polynomials times exponentials of the time since the start, with complex rates
//! where it oscillates.

use crate::ball::{Ball, ComplexBall, Magnitude, Number};
use crate::enclosure::{EnclosureError, Numbers, enclose_expression};
use crate::expression::{Expression, Fraction, Transform};
use crate::history::series::{CellNorm, Series, Truncation};
use crate::signal::divide;
use std::iter::successors;
use wavestep_polynomial::{Rational, Symbol, factorial};

/// Polynomials of this degree or a higher one are not kept exactly.
const MAX_DEGREE: usize = 16;

/// The fewest terms of an exponential.
const LEAST_ORDER: usize = 32;

/// A course `Σ p(t) e^(λt)`.
pub struct Course {
    /// Of each term its rate `λ` and the coefficients of `p`, lowest first.
    terms: Vec<(ComplexBall, Vec<ComplexBall>)>,
    /// It as a polynomial in the time since the start, where its coefficients are rational.
    polynomial: Option<Series>,
    /// It as it is written.
    written: (Expression, Symbol),
}

impl Course {
    /// The course as a function of one symbol.
    ///
    /// # Errors
    /// [`EnclosureError`] where a symbol has no value.
    pub fn of(
        numbers: &Numbers,
        course: &Expression,
        time: &Symbol,
        bits: u64,
    ) -> Result<Course, EnclosureError> {
        let written = (course.clone(), time.clone());
        let course = Transform::of(course, time);
        let values = |symbol: &Symbol, bits: u64| numbers.value(symbol, bits);
        let enclose = |value: &Expression| enclose_expression(value, &values, bits);
        let mut terms = Vec::new();
        for (rate, coefficients) in course.poles() {
            let mut polynomial = Vec::with_capacity(coefficients.len());
            for (c, own) in coefficients.iter().zip(over_factorials()) {
                polynomial.push(enclose(c)?.multiply_rational(&own, bits));
            }
            terms.push((enclose(&rate.clone().into())?, polynomial));
        }
        Ok(Course { terms, polynomial: polynomial_of(&course, bits), written })
    }

    /// A bound of its rates.
    pub fn rate(&self) -> Magnitude {
        let rates = self.terms.iter().map(|(rate, _)| rate.magnitude());
        rates.max().unwrap_or(Magnitude::ZERO)
    }

    /// The series on a cell that begins at an instant `t` after the start.
    ///
    /// With `p(t + x) = Σ_j p_j x^j` the coefficient of `x^k` is `Σ_j p_j λ^(k−j)/(k−j)!`. From `N ≥ 2j` terms on each
    /// adds at most half as much to the norm as the one before, since `γ ≥ 8|λ|` and `|λ| h ≤ 8 ≤ N/4`: all of
    /// them add twice the first.
    ///
    /// # Errors
    /// [`EnclosureError`] where an exponential is too large.
    pub fn series(
        &self,
        t: &Number,
        norm: &CellNorm,
        cut: &Truncation,
    ) -> Result<Series, EnclosureError> {
        if let Some(polynomial) = &self.polynomial {
            return Ok(polynomial.shift(t, cut));
        }
        let bits = cut.bits;
        let now = ComplexBall::from(t.ball(bits));
        let longest = self.terms.iter().map(|(_, polynomial)| polynomial.len()).max();
        let order = cut.order.max(2 * longest.unwrap_or(0)).max(LEAST_ORDER);
        let mut sum = vec![ComplexBall::zero(); order];
        let mut rest = Magnitude::ZERO;
        for (rate, polynomial) in &self.terms {
            let mut shifted = polynomial.clone();
            divide(&mut shifted, |c, next| c.add(&next.multiply(&now, bits), bits));
            let size = rate.multiply(&now, bits).exp(bits)?;
            let mut power = ComplexBall::one();
            for i in 0..=order {
                for (j, c) in shifted.iter().enumerate() {
                    let term = c.multiply(&power, bits).multiply(&size, bits);
                    match i + j {
                        k if k < order => sum[k] = sum[k].add(&term, bits),
                        k if k == order => {
                            rest = rest.add(&norm.of_term(k, &term.magnitude()).scale(1));
                        }
                        _ => {}
                    }
                }
                power = power.multiply(rate, bits).over(i as u64 + 1, bits);
            }
        }
        let flat = self.zeros_at(t, |k| sum.get(k).is_some_and(|own| own.real().contains_zero()));
        let zero = |ball: &Ball| ball.is_exact() && ball.contains_zero();
        let number = |value: ComplexBall| match zero(value.real()) {
            true => Number::zero(),
            false => Number::Enclosed(value.real().clone()),
        };
        let steady = flat.saturating_sub(1);
        Ok(Series { flat, steady, ..Series::new(sum.into_iter().map(number).collect(), rest) })
    }

    /// How many derivatives, from the function itself on, are exactly zero at an instant, of those that may be: a sine begins
    /// with zero, which no enclosure tells.
    fn zeros_at(&self, t: &Number, may_be: impl Fn(usize) -> bool) -> usize {
        let Number::Exact(t) = t else { return 0 };
        let (written, time) = &self.written;
        let t = Fraction::constant(t);
        let derivatives = successors(Some(written.clone()), |own| Some(own.derivative(time)));
        let is_zero = |own: &Expression| own.substitute(time, &t).is_ok_and(|own| own.is_zero());
        derivatives.enumerate().take_while(|(k, own)| may_be(*k) && is_zero(own)).count()
    }
}

/// 1/j! for all j.
fn over_factorials() -> impl Iterator<Item = Rational> {
    (0..).map(|j| Rational::new(1.into(), factorial(j)))
}

/// A course that is a polynomial with rational coefficients; `None` for others.
fn polynomial_of(course: &Transform, bits: u64) -> Option<Series> {
    let mut poles = course.poles();
    let coefficients = match (poles.next(), poles.next()) {
        (None, _) => &[],
        (Some((rate, own)), None) if rate.is_zero() && own.len() <= MAX_DEGREE => own,
        _ => return None,
    };
    let rational = coefficients.iter().zip(over_factorials());
    let rational = rational.map(|(c, own)| Some(Number::of_rational(c.as_constant()? * own, bits)));
    Some(Series::new(rational.collect::<Option<_>>()?, Magnitude::ZERO))
}
