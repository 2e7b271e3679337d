//! The course of a load in doubles: `Σ Re(p(t) e^{λt})` with complex polynomials and rates.

use crate::ball::{ComplexBall, Number};
use crate::enclosure::{EnclosureError, Numbers, enclose_expression};
use crate::expression::{Expression, Fraction, Root, Transform};
use num_traits::ToPrimitive;
use wavestep_polynomial::Symbol;

/// The precision at which exact values are enclosed before they are rounded to doubles.
const BITS: u64 = 96;

/// A complex number as its two parts.
type Complex = [f64; 2];

#[derive(Clone, PartialEq, Debug)]
pub struct Course {
    /// Rate `λ` and the coefficients of `p`, lowest power first.
    terms: Vec<(Complex, Vec<Complex>)>,
}

/// A real value, rounded.
pub fn double(numbers: &Numbers, value: &Fraction) -> Result<f64, EnclosureError> {
    match value.as_constant() {
        Some(number) => Ok(number.to_f64().unwrap_or(f64::NAN)),
        None => numbers.enclose(value, BITS).map(|ball| ball.midpoint().to_double()),
    }
}

pub fn double_of(value: &Number) -> f64 {
    match value {
        Number::Exact(value) => value.to_f64().unwrap_or(f64::NAN),
        Number::Enclosed(ball) => ball.midpoint().to_double(),
    }
}

/// A factor times a root, rounded.
pub fn double_root(numbers: &Numbers, value: &Root) -> Result<f64, EnclosureError> {
    numbers.enclose_root(value, BITS).map(|ball| ball.midpoint().to_double())
}

fn complex(numbers: &Numbers, value: &Expression) -> Result<Complex, EnclosureError> {
    let values = |symbol: &Symbol, bits: u64| numbers.value(symbol, bits);
    let ball: ComplexBall = enclose_expression(value, &values, BITS)?;
    Ok([ball.real().midpoint().to_double(), ball.imaginary().midpoint().to_double()])
}

impl Course {
    /// The course as a function of one symbol.
    pub fn of(
        numbers: &Numbers,
        course: &Expression,
        time: &Symbol,
    ) -> Result<Course, EnclosureError> {
        let mut terms = Vec::new();
        for (rate, coefficients) in Transform::of(course, time).poles() {
            let (mut polynomial, mut factorial) = (Vec::new(), 1.0);
            for c in coefficients {
                polynomial.push(complex(numbers, c)?.map(|part| part / factorial));
                factorial *= polynomial.len() as f64;
            }
            terms.push((complex(numbers, &rate.clone().into())?, polynomial));
        }
        Ok(Course { terms })
    }

    pub fn value(&self, time: f64) -> f64 {
        let mut sum = 0.0;
        for ([decay, turn], polynomial) in &self.terms {
            let (mut re, mut im) = (0.0, 0.0);
            for [x, y] in polynomial.iter().rev() {
                (re, im) = (re * time + x, im * time + y);
            }
            let (sine, cosine) = (turn * time).sin_cos();
            sum += (decay * time).exp() * (re * cosine - im * sine);
        }
        sum
    }
}
