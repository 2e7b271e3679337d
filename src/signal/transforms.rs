//! Exponential polynomials in balls: values, and the same function later.
//!
//! A transform stands for the function `f(x) = Σ_λ e^{λx} Σ_j c_{λ,j} x^j/j!`.

use crate::ball::ComplexBall;
use crate::enclosure::Numbers;
use crate::expression::{Field as _, Fraction, Transform};
use crate::signal::error::{EvaluateError, Outcome};
use std::collections::BTreeMap;

/// `Σ_j c_j x^j/j!`, by Horner's rule.
pub(crate) fn in_divided_powers(
    coefficients: &[ComplexBall],
    x: &ComplexBall,
    bits: u64,
) -> ComplexBall {
    let mut value = ComplexBall::zero();
    for (j, coefficient) in coefficients.iter().enumerate().rev() {
        value = value.multiply(x, bits).over(j as u64 + 1, bits).add(coefficient, bits);
    }
    value
}

/// `x^j/j!` for `j < count`.
pub(crate) fn divided_powers(x: &ComplexBall, count: usize, bits: u64) -> Vec<ComplexBall> {
    let mut power = ComplexBall::one();
    let mut powers = Vec::with_capacity(count);
    for j in 0..count {
        powers.push(power.clone());
        power = power.multiply(x, bits).over(j as u64 + 1, bits);
    }
    powers
}

/// `Σ_j c_j p_j`, over as many as there are of both.
pub(crate) fn dot(coefficients: &[ComplexBall], powers: &[ComplexBall], bits: u64) -> ComplexBall {
    ComplexBall::sum_of_products(coefficients.iter().zip(powers), bits)
}

/// `e^{λx}`.
pub(crate) fn exponential(
    pole: &Fraction,
    x: &ComplexBall,
    numbers: &Numbers,
    bits: u64,
) -> Outcome<ComplexBall> {
    if pole.is_zero() {
        return Ok(ComplexBall::one());
    }
    let rate = numbers.field(bits).embed(&pole.clone().into())?;
    rate.multiply(x, bits).exp(bits).map_err(EvaluateError::Ball)
}

/// `f(x)`.
pub fn value_at(
    function: &Transform<ComplexBall>,
    x: &ComplexBall,
    numbers: &Numbers,
    bits: u64,
) -> Outcome<ComplexBall> {
    let mut sum = ComplexBall::zero();
    for (pole, coefficients) in function.poles() {
        let value = in_divided_powers(coefficients, x, bits);
        sum = sum.add(&value.multiply(&exponential(pole, x, numbers, bits)?, bits), bits);
    }
    Ok(sum)
}

/// The function `f(x + τ)` of `x`: `c_i ← e^{λτ} Σ_j c_{i+j} τ^j/j!`.
pub(crate) fn later(
    function: &Transform<ComplexBall>,
    by: &ComplexBall,
    numbers: &Numbers,
    bits: u64,
) -> Outcome<Transform<ComplexBall>> {
    let mut poles = BTreeMap::new();
    for (pole, coefficients) in function.poles() {
        let factor = exponential(pole, by, numbers, bits)?;
        let powers = divided_powers(by, coefficients.len(), bits);
        let shifted = |i: usize| dot(&coefficients[i..], &powers, bits).multiply(&factor, bits);
        poles.insert(pole.clone(), (0..coefficients.len()).map(shifted).collect());
    }
    Ok(Transform::normal(&numbers.field(bits), poles))
}
