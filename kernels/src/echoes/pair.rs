//! Sums of two doubles: error-free sums and products, and the little arithmetic on pairs that the
//! echoes need. A pair carries about 106 bits.

pub(super) use crate::double_double::{fast_two_sum, two_sum};
use std::ops::{Add, Mul, Neg, Sub};

/// The unevaluated sum `high + low` with `|low| ≤ ulp(high)/2`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Pair {
    pub high: f64,
    pub low: f64,
}

/// `(p, e)` with `p = fl(ab)` and `p + e = ab` exactly, unless something underflows.
#[inline(always)]
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

impl Pair {
    pub const ZERO: Pair = Pair { high: 0.0, low: 0.0 };
    pub const ONE: Pair = Pair { high: 1.0, low: 0.0 };

    /// The sum of two doubles, the first not the smaller.
    #[inline(always)]
    pub fn quick(a: f64, b: f64) -> Pair {
        let (high, low) = fast_two_sum(a, b);
        Pair { high, low }
    }

    #[inline(always)]
    pub fn value(self) -> f64 {
        self.high + self.low
    }

    #[inline(always)]
    pub fn times(self, factor: f64) -> Pair {
        let (high, low) = two_product(self.high, factor);
        Pair::quick(high, self.low.mul_add(factor, low))
    }

    #[inline(always)]
    pub fn over(self, divisor: f64) -> Pair {
        let quotient = self.high / divisor;
        let (product, error) = two_product(quotient, divisor);
        let rest = ((self.high - product) - error + self.low) / divisor;
        Pair::quick(quotient, rest)
    }

    /// `2^exponent` times the pair, exact unless something underflows.
    pub fn scaled(self, exponent: i64) -> Pair {
        Pair { high: scale(self.high, exponent), low: scale(self.low, exponent) }
    }
}

impl From<f64> for Pair {
    #[inline(always)]
    fn from(high: f64) -> Pair {
        Pair { high, low: 0.0 }
    }
}

impl Neg for Pair {
    type Output = Pair;
    #[inline(always)]
    fn neg(self) -> Pair {
        Pair { high: -self.high, low: -self.low }
    }
}

impl Add for Pair {
    type Output = Pair;
    /// Relative error at most `3·2^−106`, whatever the signs.
    #[inline(always)]
    fn add(self, other: Pair) -> Pair {
        let (high, error) = two_sum(self.high, other.high);
        let (low, rest) = two_sum(self.low, other.low);
        let (high, error) = fast_two_sum(high, error + low);
        Pair::quick(high, error + rest)
    }
}

impl Sub for Pair {
    type Output = Pair;
    #[inline(always)]
    fn sub(self, other: Pair) -> Pair {
        self + -other
    }
}

impl Mul for Pair {
    type Output = Pair;
    /// Relative error at most `5·2^−106`.
    #[inline(always)]
    fn mul(self, other: Pair) -> Pair {
        let (high, error) = two_product(self.high, other.high);
        let cross = self.high.mul_add(other.low, self.low * other.high);
        Pair::quick(high, error + cross)
    }
}

/// The double `2^exponent`, for `−1022 ≤ exponent ≤ 1023`.
fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// `value = mantissa · 2^exponent` with `1 ≤ |mantissa| < 2`; zero and what is not finite keep the
/// exponent 0, and subnormal numbers are lifted first.
pub(super) fn split(value: f64) -> (f64, i64) {
    if value == 0.0 || !value.is_finite() {
        return (value, 0);
    }
    let (value, lift) = match value.is_subnormal() {
        true => (value * power_of_two(100), -100),
        false => (value, 0),
    };
    let exponent = ((value.to_bits() >> 52) & 0x7ff) as i64 - 1023;
    // Both factors are powers of two in range: |exponent| ≤ 1023 is halved.
    let half = exponent / 2;
    (value * power_of_two(-half) * power_of_two(half - exponent), exponent + lift)
}

/// `2^exponent · value`, rounded at most once: to infinity, to zero or to a subnormal number where
/// the range of doubles ends.
pub(super) fn scale(value: f64, exponent: i64) -> f64 {
    let (mantissa, own) = split(value);
    match own.saturating_add(exponent) {
        _ if mantissa == 0.0 => mantissa,
        total if total > 1023 => mantissa * f64::INFINITY,
        total if total >= -1022 => mantissa * power_of_two(total),
        total if total < -1080 => mantissa * 0.0,
        // The first product is exact, the second rounds.
        total => mantissa * power_of_two(total + 60) * power_of_two(-60),
    }
}
