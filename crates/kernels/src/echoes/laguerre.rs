//! The polynomials of an echo, index by index, and the echo they make: by the recurrence of three
//! terms, which is the textbook's and loses digits, and by the recurrence of differences, which keeps
//! them.

use super::description::{Echoes, Family};
use super::exponential::exponential;
use crate::double_double::DoubleDouble;
use crate::exponent::scale;

/// `q_j(X)` and `j (q_j − q_{j−1})`, carried from index to index.
///
/// For Laguerre polynomials `(j+1) L_{j+1} = (2j+1−X) L_j − j L_{j−1}` is, with `e_j = j (L_j − L_{j−1})`,
///
/// ```text
/// e_{j+1} = e_j − X L_j,    L_{j+1} = L_j + e_{j+1}/(j+1),
/// ```
///
/// two fused operations a step. Neighbours differ little, so the rounding of a difference is small
/// beside that of the terms of the textbook's recurrence, which are `2j+1` times as large. And
/// `e_j = X L_j'(X)`: the slope is there for nothing. For powers it is `j X^j/j!`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Differences {
    pub index: usize,
    pub value: f64,
    /// `X q_j'(X)`.
    pub slope: f64,
}

impl Differences {
    pub const START: Differences = Differences { index: 0, value: 1.0, slope: 0.0 };

    /// One index further; `reciprocals[j]` is `1/(j+1)`.
    #[inline(always)]
    pub fn step(&mut self, family: Family, argument: f64, reciprocals: &[f64]) {
        let reciprocal = reciprocals[self.index];
        self.index += 1;
        match family {
            Family::Laguerre => {
                self.slope = (-argument).mul_add(self.value, self.slope);
                self.value = self.slope.mul_add(reciprocal, self.value);
            }
            Family::Powers => {
                self.value *= argument * reciprocal;
                self.slope = self.value * self.index as f64;
            }
        }
    }

    /// `q_j(X + δ)` to first order, `δ/X` given. What is left out is `δ²/2` times the second
    /// derivative; with `|δ| ≤ 2^−53 |X|` it is far below a rounding.
    #[inline(always)]
    pub fn corrected(&self, relative: f64) -> f64 {
        self.slope.mul_add(relative, self.value)
    }
}

/// `δ/X` of a pair `X + δ`.
#[inline(always)]
pub(super) fn relative(argument: DoubleDouble) -> f64 {
    if argument.high == 0.0 { 0.0 } else { argument.low / argument.high }
}

/// Echo `k`, `x` after it arrived, by the recurrence of differences.
///
/// Where `e^{−bx}` underflows the echo counts as 0, and where a polynomial overflows it is infinite:
/// both happen long before the echo itself is small or large.
pub(super) fn difference(
    echoes: &Echoes,
    ratio: (DoubleDouble, i64),
    reciprocals: &[f64],
    k: usize,
    since: DoubleDouble,
) -> f64 {
    let (decay, exponent) = exponential(-(since * echoes.rate.pair()));
    let weight = scale((decay * ratio.0).high, exponent + ratio.1);
    if weight == 0.0 {
        return 0.0;
    }
    let argument = since * echoes.scale.pair();
    let relative = relative(argument);
    let mut state = Differences::START;
    let mut sum = 0.0;
    for term in &echoes.terms {
        let Some(index) = k.checked_add_signed(-term.lag) else { continue };
        while state.index < index {
            state.step(echoes.family, argument.high, reciprocals);
        }
        sum = term.coefficient.high().mul_add(state.corrected(relative), sum);
    }
    weight * sum
}

/// Echo `k` as anyone would code it: `T − kD` rounded, three terms a step, no correction. Kept as the
/// reference of what goes wrong.
pub(super) fn plain(echoes: &Echoes, k: usize, time: f64) -> f64 {
    let since = time - k as f64 * echoes.period.high();
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
