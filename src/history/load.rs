//! The course of a load as a series on a cell.
//!
//! A course is a sum of polynomials times exponentials of the time since the start, with complex rates
//! where it oscillates.

use crate::ball::{Ball, ComplexBall, Magnitude, Number};
use crate::enclosure::{EnclosureError, Numbers, enclose_expression};
use crate::expression::{Expression, Fraction};
use crate::history::series::{CellNorm, Series, Truncation};
use wavestep_polynomial::{Rational, Symbol};

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
        let polynomial = polynomial_of(course, time, bits);
        let at_zero = |value: &Fraction| value.substitute(time, &Fraction::zero());
        let values = |symbol: &Symbol, bits: u64| numbers.value(symbol, bits);
        let enclose = |value: Fraction| enclose_expression(&value.into(), &values, bits);
        let mut terms = Vec::new();
        for (exponent, coefficient) in course.terms() {
            let rate = enclose(at_zero(&exponent.derivative(time))?)?;
            let size = enclose(at_zero(exponent)?)?.exp(bits)?;
            let (mut polynomial, mut derivative) = (Vec::new(), coefficient.clone());
            let mut factorial = Rational::from_integer(1.into());
            while !derivative.is_zero() {
                let value = enclose(at_zero(&derivative)?)?;
                let value = value.multiply_rational(&factorial.recip(), bits);
                polynomial.push(value.multiply(&size, bits));
                let count = num_bigint::BigInt::from(polynomial.len());
                factorial *= Rational::from_integer(count);
                derivative = derivative.derivative(time);
            }
            terms.push((rate, polynomial));
        }
        Ok(Course { terms, polynomial })
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
            for first in 0..shifted.len() {
                for k in (first..shifted.len() - 1).rev() {
                    shifted[k] = shifted[k].add(&shifted[k + 1].multiply(&now, bits), bits);
                }
            }
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
        let real = |value: ComplexBall| -> Number { Number::Enclosed(value.real().clone()) };
        let zero = |ball: &Ball| ball.is_exact() && ball.contains_zero();
        let number = |value: ComplexBall| match zero(value.real()) {
            true => Number::zero(),
            false => real(value),
        };
        Ok(Series::new(sum.into_iter().map(number).collect(), rest))
    }
}

/// A course that is a polynomial with rational coefficients; `None` for others.
fn polynomial_of(course: &Expression, time: &Symbol, bits: u64) -> Option<Series> {
    let (mut coefficients, mut derivative) = (Vec::new(), course.clone());
    let mut factorial = Rational::from_integer(1.into());
    while !derivative.is_zero() {
        if coefficients.len() == MAX_DEGREE {
            return None;
        }
        let value = derivative.substitute(time, &Fraction::zero()).ok()?.as_constant()?;
        coefficients.push(Number::of_rational(value / &factorial, bits));
        factorial *= Rational::from_integer(coefficients.len().into());
        derivative = derivative.derivative(time);
    }
    Some(Series::new(coefficients, Magnitude::ZERO))
}
