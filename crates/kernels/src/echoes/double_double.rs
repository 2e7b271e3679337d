//! An echo with every operation on pairs of doubles: the value, rounded once, is as good as right.

use super::description::{Echoes, ExponentialPolynomial, Family};
use super::exponential::exponential;
use crate::double_double::DoubleDouble;
use crate::exponent::scale;

/// The step after which sizes are looked at, and what is large: as in the scaled summation.
const STEPS: usize = 8;
const LARGE: f64 = f64::from_bits((1023 + 200) << 52);
const SHIFT: i64 = 400;

/// Echo `k`, `x` after it arrived, as a pair, by the recurrence of differences.
///
/// A pair has 106 bits, so the roundings that cost the doubles up to some tens of ulps cost `2^−45` of
/// one; what is left is the rounding of the result, and the time since the arrival, good to
/// `2^−103` of itself. The exponent is carried apart as in the scaled summation.
pub(super) fn echo(
    echoes: &Echoes,
    ratio: (DoubleDouble, i64),
    reciprocals: &[DoubleDouble],
    k: usize,
    since: DoubleDouble,
) -> DoubleDouble {
    let (decay, exponent) = exponential(-(since * echoes.rate.pair()));
    let weight = decay * ratio.0;
    let argument = since * echoes.scale.pair();
    let (mut index, mut value, mut slope) = (0, DoubleDouble::ONE, DoubleDouble::ZERO);
    let (mut sum, mut carried) = (DoubleDouble::ZERO, exponent + ratio.1);
    for term in &echoes.terms {
        let Some(target) = k.checked_add_signed(-term.lag) else { continue };
        while index < target {
            let stop = target.min(index + STEPS);
            for reciprocal in &reciprocals[index..stop] {
                match echoes.family {
                    Family::Laguerre => {
                        slope = slope - argument * value;
                        value = value + slope * *reciprocal;
                    }
                    Family::Powers => value = value * argument * *reciprocal,
                }
            }
            index = stop;
            let shift = match value.high.abs() + slope.high.abs() {
                size if size > LARGE => -SHIFT,
                size if size < 1.0 / LARGE && sum.high == 0.0 => SHIFT,
                _ => continue,
            };
            value = value.scaled(shift);
            slope = slope.scaled(shift);
            sum = sum.scaled(shift);
            carried -= shift;
        }
        sum = sum + term.coefficient.pair() * value;
    }
    (weight * sum).scaled(carried)
}

/// A first echo as a pair.
pub(super) fn first(parts: &[ExponentialPolynomial], since: DoubleDouble) -> DoubleDouble {
    parts.iter().fold(DoubleDouble::ZERO, |sum, part| {
        let horner =
            |sum: DoubleDouble, coefficient: &super::Expansion| sum * since + coefficient.pair();
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
