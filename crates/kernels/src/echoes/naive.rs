//! Echoes as anyone would code them, kept to show what goes wrong.
//!
//! `T − kD` is rounded, and at a front a rounding there costs as many ulps as the echo has reflections
//! behind it. The formula as a textbook prints it, expanded in powers and evaluated by Horner's scheme,
//! fails altogether: terms of alternating sign reach `e^{2√(jX)}` before they cancel to a value of order 1.
//! The recurrence of three terms only loses digits.

use super::description::{Echoes, Family};

/// Echo `k`, so long after it arrived, by Horner's scheme on its expanded row.
pub(super) fn expanded(echoes: &Echoes, k: usize, since: f64) -> f64 {
    let row = expanded_row(echoes, k);
    let polynomial = row.iter().rev().fold(0.0, |sum, coefficient| sum * since + coefficient);
    (-since * echoes.rate.high()).exp() * polynomial
}

/// The coefficients of echo `k` in powers of `x`, rounded: `Σ_i c_i ρ^k q_{k−i}(cx)`, by the recurrence
/// `a_{j+1} = −a_j c (k−j)/(j+1)²` on `L_k(cx) = Σ_j C(k,j) (−c)^j x^j/j!`. The echo is that polynomial
/// times `e^{−bx}`.
fn expanded_row(echoes: &Echoes, k: usize) -> Vec<f64> {
    let scale = echoes.scale.high();
    let ratio = echoes.ratio.high().powi(k as i32);
    let mut row = vec![0.0; echoes.largest_index(k).map_or(0, |index| index + 1)];
    for term in &echoes.terms {
        let Some(index) = k.checked_add_signed(-term.lag) else { continue };
        let mut coefficient = term.coefficient.high() * ratio;
        for (j, place) in row[..=index].iter_mut().enumerate() {
            let next = (j + 1) as f64;
            match echoes.family {
                Family::Laguerre => {
                    *place += coefficient;
                    coefficient *= -scale * (index - j) as f64 / (next * next);
                }
                Family::Powers => {
                    *place += if j == index { coefficient } else { 0.0 };
                    coefficient *= scale / next;
                }
            }
        }
    }
    row
}

/// Echo `k` by the recurrence of three terms.
pub(super) fn plain(echoes: &Echoes, k: usize, since: f64) -> f64 {
    let argument = since * echoes.scale.high();
    let (mut index, mut value, mut before) = (0usize, 1.0, 0.0);
    let mut sum = 0.0;
    for term in &echoes.terms {
        let Some(target) = k.checked_add_signed(-term.lag) else { continue };
        while index < target {
            let j = index as f64;
            let next = match echoes.family {
                Family::Laguerre => ((2.0 * j + 1.0 - argument) * value - j * before) / (j + 1.0),
                Family::Powers => value * argument / (j + 1.0),
            };
            (before, value, index) = (value, next, index + 1);
        }
        sum += term.coefficient.high() * value;
    }
    sum * (-since * echoes.rate.high()).exp() * echoes.ratio.high().powi(k as i32)
}
