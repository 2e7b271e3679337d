//! The exponential of a sum of two doubles: in pairs with the power of two apart, and in lanes for
//! arguments whose exponential is a double.

use crate::double_double::{DoubleDouble, two_product};
use crate::lanes::Lanes;
use std::f64::consts::LOG2_E;

/// `ln 2` in three doubles.
const LN_2: [f64; 3] = [std::f64::consts::LN_2, 2.3190468138462996e-17, 5.707708438416212e-34];

/// `e^y = mantissa · 2^exponent`, with the mantissa between 0.7 and 1.42, for `|y| ≤ 2^41`.
///
/// With `n` the integer next to `y/ln 2` and `r = y − n ln 2`, `|r| ≤ 0.35`, the series of
/// `e^{r/512} − 1` is cut after the ninth power, which leaves less than `2^−124`, and
/// `w → 2w + w²` nine times gives `e^r − 1`. Every doubling doubles an absolute error that starts
/// below `2^−113`: about `2^−104` at the end, and `|y|·2^−105` from the argument besides.
pub(super) fn exponential(y: DoubleDouble) -> (DoubleDouble, i64) {
    let multiple = (y.high * LOG2_E).round_ties_even();
    let product = |part: f64| {
        let (high, low) = two_product(part, multiple);
        DoubleDouble { high, low }
    };
    let rest = ((y - product(LN_2[0])) - product(LN_2[1])) - product(LN_2[2]);
    let small = rest.scaled(-9);
    let mut series = small.over(9.0);
    for j in (1..9).rev() {
        series = small.over(j as f64) * (DoubleDouble::ONE + series);
    }
    let mut less_one = series;
    for _ in 0..9 {
        less_one = less_one.times(2.0) + less_one * less_one;
    }
    (DoubleDouble::ONE + less_one, multiple as i64)
}

/// `1/j!` for `j = 2 … 13`.
const INVERSE_FACTORIALS: [f64; 12] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5040.0,
    1.0 / 40320.0,
    1.0 / 362880.0,
    1.0 / 3628800.0,
    1.0 / 39916800.0,
    1.0 / 479001600.0,
    1.0 / 6227020800.0,
];

/// The head of `ln 2`, with 21 zeros at the end: its products with integers below `2^21` are exact.
const LN_2_HEAD: f64 = f64::from_bits(0x3fe6_2e42_fee0_0000);
/// The rest of it.
const LN_2_TAIL: f64 = f64::from_bits(0x3dea_39ef_3579_3c76);
/// `1.5 · 2^52`: a number below `2^51` added to it is rounded to an integer, in the low bits.
const ROUNDER: f64 = 6755399441055744.0;

/// `e^{y + δ}` in lanes, for `|y| ≤ 700` and `|δ| ≤ ulp(y)`; error below one ulp (measured, 0.80).
///
/// `r = y − n ln 2 + δ` is formed with its rounding, `|r| ≤ 0.35`; the series after the power 13
/// leaves less than `2^−57`.
#[inline(always)]
pub(super) fn exponential_lanes<L: Lanes>(y: L, low: L) -> L {
    let shifted = y.fused(L::splat(LOG2_E), L::splat(ROUNDER));
    let multiple = shifted - L::splat(ROUNDER);
    let lead = y - multiple * L::splat(LN_2_HEAD);
    let tail = low - multiple * L::splat(LN_2_TAIL);
    let rest = lead + tail;
    let rounding = (lead - rest) + tail;
    let mut series = L::splat(INVERSE_FACTORIALS[11]);
    for j in (0..11).rev() {
        series = series.fused(rest, L::splat(INVERSE_FACTORIALS[j]));
    }
    let square = rest * rest;
    let mantissa = L::splat(1.0) + (rest + square.fused(series, rounding));
    mantissa.times_power(shifted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exponent::scale;
    use crate::vector::OneByOne;

    type Eight = OneByOne<true>;

    #[test]
    fn the_two_agree_and_keep_the_low_part() {
        let mut worst = 0f64;
        for i in -7000..=7000 {
            let y = f64::from(i) * 0.0997;
            let low = y * 2f64.powi(-54);
            let (mantissa, exponent) = exponential(DoubleDouble { high: y, low });
            assert!(mantissa.high > 0.7 && mantissa.high < 1.42, "{y}");
            let lanes = exponential_lanes(Eight::splat(y), Eight::splat(low)).to_array()[3];
            let off = DoubleDouble::from(scale(lanes, -exponent)) - mantissa;
            let ulp = if mantissa.high < 1.0 { 2f64.powi(-53) } else { 2f64.powi(-52) };
            worst = worst.max(off.high.abs() / ulp);
        }
        println!("14001 exponentials, off by at most {worst:.3} ulp");
        assert!(worst < 1.0);
    }

    #[test]
    fn the_functional_equation_holds_to_a_hundred_bits() {
        for i in 1..2000 {
            let y = DoubleDouble::from(f64::from(i) * 0.37);
            let (one, exponent) = exponential(y);
            let (two, double) = exponential(y.times(2.0));
            let off = (one * one).scaled(2 * exponent - double) - two;
            assert!(off.high.abs() < 2f64.powi(-88), "{i}: {off:?}");
            let (back, negative) = exponential(-y);
            let off = (one * back).scaled(exponent + negative) - DoubleDouble::ONE;
            assert!(off.high.abs() < 2f64.powi(-94), "{i}: {off:?}");
        }
    }
}
