//! Echoes by the recurrence of differences, which keeps the digits that the textbook's loses, in doubles
//! and in pairs of doubles.
//!
//! For Laguerre polynomials `(j+1) L_{j+1} = (2j+1−X) L_j − j L_{j−1}` is, with `e_j = j (L_j − L_{j−1})`,
//!
//! ```text
//! e_{j+1} = e_j − X L_j,    L_{j+1} = L_j + e_{j+1}/(j+1),
//! ```
//!
//! two fused operations a step. Neighbours differ little, so the rounding of a difference is small
//! beside that of the terms of the textbook's recurrence, which are `2j+1` times as large. And
//! `e_j = X L_j'(X)`: the slope costs nothing. For powers it is `j X^j/j!`.
//!
//! The exponential of an echo can underflow although the echo does not: `e^{−900} L_500(1800)` is
//! −0.0247…, and `e^{−900}` is no double. So a power of two is carried apart from the polynomials and
//! from the exponential, and the two meet at the end.

use super::description::{Echoes, ExponentialPolynomial, Family};
use super::expansion::Expansion;
use super::exponential::exponential;
use crate::double_double::DoubleDouble;
use crate::exponent::scale;
use std::ops::{Add, Mul, Neg};

/// Above this the polynomials are scaled down, below its reciprocal up.
const LARGE: f64 = f64::from_bits((1023 + 200) << 52);
/// By this power of two.
const SHIFT: i64 = 400;
/// After this many steps.
const STEPS: usize = 8;

/// The numbers that an echo is computed in.
pub(super) trait Number:
    Copy + From<f64> + Add<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// The number next to a pair.
    fn of(pair: DoubleDouble) -> Self;
    /// What [`of`](Self::of) drops of a pair, relative to it.
    fn dropped(pair: DoubleDouble) -> Self;
    /// `self · factor + addend`, rounded once in doubles.
    fn fused(self, factor: Self, addend: Self) -> Self;
    /// `2^exponent` times the number.
    fn scaled(self, exponent: i64) -> Self;
    /// About the absolute value.
    fn size(self) -> f64;
}

impl Number for f64 {
    fn of(pair: DoubleDouble) -> f64 {
        pair.high
    }

    fn dropped(pair: DoubleDouble) -> f64 {
        if pair.high == 0.0 { 0.0 } else { pair.low / pair.high }
    }

    fn fused(self, factor: f64, addend: f64) -> f64 {
        self.mul_add(factor, addend)
    }

    fn scaled(self, exponent: i64) -> f64 {
        scale(self, exponent)
    }

    fn size(self) -> f64 {
        self.abs()
    }
}

/// A pair has 106 bits, so the roundings that cost the doubles up to some tens of ulps cost `2^−45` of
/// one; what is left is the rounding of the result, and the time since the arrival, good to `2^−103` of
/// itself.
impl Number for DoubleDouble {
    fn of(pair: DoubleDouble) -> DoubleDouble {
        pair
    }

    fn dropped(_: DoubleDouble) -> DoubleDouble {
        DoubleDouble::ZERO
    }

    fn fused(self, factor: DoubleDouble, addend: DoubleDouble) -> DoubleDouble {
        addend + self * factor
    }

    fn scaled(self, exponent: i64) -> DoubleDouble {
        self.scaled(exponent)
    }

    fn size(self) -> f64 {
        self.high.abs()
    }
}

/// Echo `k`, `x` after it arrived, for every `k` and `x` that a sum admits; `reciprocals[j]` is
/// `1/(j+1)`.
///
/// What a double drops of the argument `X` is corrected by the slope: with `|δ| ≤ 2^−53 |X|` the term of
/// second order is far below a rounding.
///
/// A step multiplies the larger of `|q_j|` and `|e_j|` by at most `2 + 2|X| ≤ 2^42`, because
/// `|e_{j+1}| ≤ (1 + |X|) m` and `|q_{j+1}| ≤ m + |e_{j+1}|`: eight steps from below `2^200` stay below
/// `2^536`. Laguerre polynomials never shrink by much, as their amplitude falls like `(jX)^{−1/4}`.
/// Divided powers may; eight steps from above `2^−200` stay above `2^−700` for `|X| ≥ 2^−40`, since
/// `j ≤ 2^21`, and for smaller `X` what underflows is below `2^−800`.
pub(super) fn echo<N: Number>(
    echoes: &Echoes,
    ratio: (DoubleDouble, i64),
    reciprocals: &[N],
    k: usize,
    since: DoubleDouble,
) -> N {
    let (decay, exponent) = exponential(-(since * echoes.rate.pair()));
    let pair = since * echoes.scale.pair();
    let (argument, dropped) = (N::of(pair), N::dropped(pair));
    let (mut index, mut value, mut slope) = (0, N::from(1.0), N::from(0.0));
    // The sum of the terms so far is `sum · 2^carried`.
    let (mut sum, mut carried) = (N::from(0.0), exponent + ratio.1);
    for term in &echoes.terms {
        let Some(target) = k.checked_add_signed(-term.lag) else { continue };
        while index < target {
            let stop = target.min(index + STEPS);
            for reciprocal in &reciprocals[index..stop] {
                match echoes.family {
                    Family::Laguerre => {
                        slope = (-argument).fused(value, slope);
                        value = slope.fused(*reciprocal, value);
                    }
                    Family::Powers => value = value * (argument * *reciprocal),
                }
            }
            index = stop;
            let shift = match value.size() + slope.size() {
                size if size > LARGE => -SHIFT,
                size if size < 1.0 / LARGE && sum.size() == 0.0 => SHIFT,
                _ => continue,
            };
            value = value.scaled(shift);
            slope = slope.scaled(shift);
            sum = sum.scaled(shift);
            carried -= shift;
        }
        let slope = match echoes.family {
            Family::Laguerre => slope,
            Family::Powers => value * N::from(index as f64),
        };
        let corrected = slope.fused(dropped, value);
        sum = N::of(term.coefficient.pair()).fused(corrected, sum);
    }
    (N::of(decay * ratio.0) * sum).scaled(carried)
}

/// A first echo, which does not follow the rule.
pub(super) fn first(parts: &[ExponentialPolynomial], since: DoubleDouble) -> DoubleDouble {
    parts.iter().fold(DoubleDouble::ZERO, |sum, part| {
        let horner = |sum: DoubleDouble, coefficient: &Expansion| sum * since + coefficient.pair();
        let polynomial = part.coefficients.iter().rev().fold(DoubleDouble::ZERO, horner);
        let (decay, exponent) = exponential(-(since * part.rate.pair()));
        sum + (decay * polynomial).scaled(exponent)
    })
}

/// A first echo in doubles: the slope times the low part of the time corrects it, and the exponential
/// is taken apart from its power of two.
pub(super) fn first_rounded(parts: &[ExponentialPolynomial], since: DoubleDouble) -> f64 {
    let mut sum = 0.0;
    for part in parts {
        let (mut value, mut slope) = (0.0, 0.0);
        for coefficient in part.coefficients.iter().rev() {
            slope = slope * since.high + value;
            value = value * since.high + coefficient.high();
        }
        let decay = since * part.rate.pair();
        let value = slope * since.low + value;
        sum += match decay.high.abs() < 700.0 {
            true => (-decay.high).exp() * (value - value * decay.low),
            false => {
                let (mantissa, exponent) = exponential(-decay);
                scale(mantissa.high * value, exponent)
            }
        };
    }
    sum
}
