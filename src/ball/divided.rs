//! Enclosures of polynomials in the divided-power basis.
//!
//! The basis `x^j/j!` keeps the coefficients of derivatives, integrals and exponential series
//! integer. The evaluation is Horner's rule in integers of one fixed length, with a counter of
//! everything that was cut off.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use wavestep_polynomial::IntegerRow;

use super::ball::Ball;
use super::binary::{Binary, LEAST_PRECISION};
use super::magnitude::Magnitude;

/// Encloses `Σ_j c_j x^j/j!`, `c_j = coefficients[j]`: the true value lies in the ball, and for
/// precision `p`
///
/// `radius ≤ 2^(2−p)·max_j |c_j x^j/j!|`,
///
/// so that the cancellation of the terms decides how many digits of the value are proven.
///
/// # Method
/// Let `g_j` be integers with `|x|^j/j! ≤ 2^(g_j)`. The partial sum
/// `s_j = Σ_(i≥j) c_i x^(i−j) j!/i! = c_j + s_(j+1)·x/(j+1)` is held as an integer `A_j` in units
/// of `2^(−f_j)`, `f_j = f + g_j`: in the final sum one of these units counts `x^j/j!·2^(−f_j)`,
/// at most `2^(−f)`. The step
///
/// `A_j = ⌊c_j·2^(f_j)⌋ + trunc(A_(j+1)·x·2^(f_j − f_(j+1))/(j+1))`
///
/// loses `δ_j` of its units: less than one for the division, less than one for the coefficient
/// if `f_j < 0`, and as much as the argument's rounding may move the product when `x` does not
/// fit machine words. Hence
///
/// `|Σ_j c_j x^j/j! − A_0·2^(−f_0)| ≤ 2^(−f)·Σ_j δ_j`.
///
/// The unit `f` is chosen so that the largest term keeps the `p` bits after all `n` steps.
///
/// A step multiplies, divides and adds integers of about `p + log_2 n` bits, whatever the length of
/// the coefficients; one with a numerator and a denominator of `x` below some `2^40` costs no more
/// than a few machine operations for each word of these.
pub fn evaluate_divided(coefficients: &IntegerRow, x: &BigRational, precision: u64) -> Ball {
    let precision = precision.max(LEAST_PRECISION);
    let weights = weights(x, coefficients.len());
    // 2^(largest) exceeds every term: |c| < 2^bits(c).
    let largest = coefficients
        .iter()
        .zip(&weights)
        .filter(|(coefficient, _)| !coefficient.is_zero())
        .map(|(coefficient, weight)| coefficient.bits() as i64 + weight)
        .max();
    let Some(largest) = largest else {
        return Ball::zero();
    };
    // At most four units are lost in a step.
    let guard = i64::from((4 * coefficients.len() as u64 + 4).ilog2()) + 2;
    let unit = precision as i64 + guard - largest;
    let argument = Argument::new(x, coefficients.len(), precision + 2 * guard as u64 + 8);
    let mut accumulator = BigInt::zero();
    let mut lost = Magnitude::ZERO;
    for index in (0..weights.len()).rev() {
        let coefficient = coefficients.get(index);
        let scale = unit + weights[index];
        if !accumulator.is_zero() {
            let rise = weights[index] - weights[index + 1];
            lost = lost.add(&argument.step(&mut accumulator, index as u64 + 1, rise));
        }
        if coefficient.is_zero() {
            continue;
        }
        if scale >= 0 {
            accumulator += coefficient.to_integer() << scale as u64;
        } else {
            lost = lost.add(&Magnitude::from_u64(1));
            let cut = scale.unsigned_abs();
            if cut < coefficient.bits() {
                accumulator += coefficient.to_integer() >> cut;
            }
        }
    }
    let scale = unit + weights.first().copied().unwrap_or(0);
    Ball::new(Binary::new(accumulator, -scale), lost.scale(-unit))
}

/// The `g_j`, `j < count`, with `|x|^j/j! ≤ 2^(g_j)`; they end early where `x = 0`.
fn weights(x: &BigRational, count: usize) -> Vec<i64> {
    let size = Magnitude::from_rational(x);
    let mut term = Magnitude::from_u64(1);
    let mut weights = Vec::with_capacity(count);
    for index in 1..=count as u64 {
        let Some(top) = term.top() else { break };
        weights.push(top);
        term = term.multiply(&size).divide(index);
    }
    weights
}

/// The argument of a polynomial, prepared for the multiplication of long integers.
pub enum Argument {
    /// `±numerator/denominator`; the denominator times any index fits a machine word.
    Words { negative: bool, numerator: u64, denominator: u64 },
    /// `y = mantissa·2^exponent` with `|x − y| ≤ 2^(2−bits)·|y|`.
    Long { mantissa: BigInt, exponent: i64, bits: u64 },
}

impl Argument {
    pub fn new(x: &BigRational, count: usize, bits: u64) -> Self {
        let words = x.numer().magnitude().to_u64().zip(x.denom().to_u64());
        if let Some((numerator, denominator)) = words
            && denominator.checked_mul(count as u64).is_some()
        {
            return Self::Words { negative: x.is_negative(), numerator, denominator };
        }
        let (rounded, _) = Binary::quotient(x.numer(), x.denom(), 0, bits);
        let (mantissa, exponent) = (rounded.mantissa(), rounded.exponent());
        Self::Long { mantissa, exponent, bits }
    }

    /// Replaces `a` by an integer `q` near `a·x·2^rise/index` and returns a `δ` with
    /// `|a·x·2^rise/index − q| ≤ δ`.
    pub fn step(&self, accumulator: &mut BigInt, index: u64, rise: i64) -> Magnitude {
        match self {
            Self::Words { negative, numerator, denominator } => {
                if *negative {
                    *accumulator = -std::mem::take(accumulator);
                }
                let divisor = denominator * index;
                let shift = rise.unsigned_abs();
                if rise >= 0 && shift <= u64::from((numerator | 1).leading_zeros()) {
                    *accumulator *= numerator << shift;
                    *accumulator /= divisor;
                    Magnitude::from_u64(1)
                } else if rise < 0 && shift <= u64::from(divisor.leading_zeros()) {
                    *accumulator *= *numerator;
                    *accumulator /= divisor << shift;
                    Magnitude::from_u64(1)
                } else {
                    // Less than one for each of the roundings.
                    *accumulator *= *numerator;
                    shift_by(accumulator, rise);
                    *accumulator /= divisor;
                    Magnitude::from_u64(2)
                }
            }
            Self::Long { mantissa, exponent, bits } => {
                *accumulator *= mantissa;
                shift_by(accumulator, exponent + rise);
                *accumulator /= index;
                // Two roundings; and |a·y·2^rise/index| ≤ |q| + 2 ≤ 2^(bits(q)+1), of which the
                // rounding of x moves a share of 2^(2−bits).
                let reach = accumulator.bits() as i64 + 3 - *bits as i64;
                Magnitude::from_u64(2).add(&Magnitude::power_of_two(reach))
            }
        }
    }
}

/// `⌊value·2^shift⌋`.
fn shift_by(value: &mut BigInt, shift: i64) {
    if shift >= 0 {
        *value <<= shift.unsigned_abs();
    } else {
        *value >>= shift.unsigned_abs();
    }
}
