//! Echoes whose exponential underflows although they do not: `e^{−900} L_500(1800)` is −0.0247…, and
//! `e^{−900}` is no double. A power of two is carried apart from the polynomials and from the
//! exponential, and the two meet at the end.

use super::description::Echoes;
use super::exponential::exponential;
use super::laguerre::{Differences, relative};
use crate::double_double::DoubleDouble;
use crate::exponent::scale;

/// Above this the polynomials are scaled down, below its reciprocal up.
const LARGE: f64 = f64::from_bits((1023 + 200) << 52);
/// By this power of two.
const SHIFT: i64 = 400;
/// After this many steps.
const STEPS: usize = 8;

/// Echo `k`, `x` after it arrived, for every `k` and `x` that a sum admits.
///
/// A step multiplies the larger of `|q_j|` and `|e_j|` by at most `2 + 2|X| ≤ 2^42`, because
/// `|e_{j+1}| ≤ (1 + |X|) m` and `|q_{j+1}| ≤ m + |e_{j+1}|`: eight steps from below `2^200` stay below
/// `2^536`. Laguerre polynomials never shrink by much, as their amplitude falls like `(jX)^{−1/4}`.
/// Divided powers may; eight steps from above `2^−200` stay above `2^−700` for `|X| ≥ 2^−40`, since
/// `j ≤ 2^21`, and for smaller `X` what underflows is below `2^−800`.
pub(super) fn scaled(
    echoes: &Echoes,
    ratio: (DoubleDouble, i64),
    reciprocals: &[f64],
    k: usize,
    since: DoubleDouble,
) -> f64 {
    let (decay, exponent) = exponential(-(since * echoes.rate.pair()));
    let weight = (decay * ratio.0).high;
    let argument = since * echoes.scale.pair();
    let relative = relative(argument);
    let (mut state, mut carried) = (Differences::START, exponent + ratio.1);
    // The sum of the terms so far is `sum · 2^carried`.
    let mut sum = 0.0;
    for term in &echoes.terms {
        let Some(index) = k.checked_add_signed(-term.lag) else { continue };
        while state.index < index {
            let stop = index.min(state.index + STEPS);
            while state.index < stop {
                state.step(echoes.family, argument.high, reciprocals);
            }
            let size = state.value.abs() + state.slope.abs();
            let shift = match size {
                size if size > LARGE => -SHIFT,
                size if size < 1.0 / LARGE && sum == 0.0 => SHIFT,
                _ => continue,
            };
            state.value = scale(state.value, shift);
            state.slope = scale(state.slope, shift);
            sum = scale(sum, shift);
            carried -= shift;
        }
        sum = term.coefficient.high().mul_add(state.corrected(relative), sum);
    }
    scale(weight * sum, carried)
}
