//! Sums and products of doubles without loss, and numbers of about 106 bits made of two doubles.
//!
//! A rounded sum or product has an error that is a double itself; the functions here return both.
//! Throughout, `ε` is [`UNIT`] and roundings go to nearest, ties to even.

use crate::exponent::scale;

/// The unit roundoff `ε = 2⁻⁵³`: a rounded result `r` is off by at most `ε |r|`, and by at most
/// `ε |x|` where `x` is the exact result, unless it underflows.
pub const UNIT: f64 = f64::EPSILON / 2.0;

/// `(s, e)` with `s` the rounded sum and `s + e = a + b` exactly, `|e| ≤ ε |s|`: Knuth's 2Sum.
///
/// Exact for all finite arguments whose sum does not overflow, underflow included; the arguments may
/// have any order. Six additions.
#[inline(always)]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let from_a = sum - b;
    let from_b = sum - from_a;
    (sum, (a - from_a) + (b - from_b))
}

/// `(s, e)` as of [`two_sum`], if `|a| ≥ |b|` or `a = 0`: Dekker's Fast2Sum. Three additions.
#[inline(always)]
pub fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// The factor of Veltkamp's splitting, `2²⁷ + 1`.
pub(crate) const SPLITTER: f64 = 134_217_729.0;

/// `(h, l)` with `h + l = a`, each of at most 26 bits: Veltkamp's splitting, `|a| < 2⁹⁹⁶`.
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let scaled = SPLITTER * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

/// `(p, e)` with `p` the rounded product and `p + e = a b` exactly, `|e| ≤ ε |p|`: Dekker's product.
///
/// Exact if `|a|, |b| < 2⁹⁹⁵`, `|a b| < 2¹⁰²⁰`, and `a b` is a multiple of `2⁻¹⁰⁷⁴`; the last holds
/// wherever `|a b| ≥ 2⁻⁹⁶⁸`, and where one factor is an integer. 17 operations, none of them fused.
#[inline(always)]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (product, error)
}

/// A number of about 106 bits: the sum of two doubles.
///
/// # Invariants
/// `high` is `high + low` rounded to nearest, so `|low| ≤ ε |high|`, as long as no result leaves the
/// range of doubles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl DoubleDouble {
    pub(crate) const ZERO: Self = Self { high: 0.0, low: 0.0 };
    pub(crate) const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// The sum of any two doubles, exactly; none if it is not finite.
    pub fn from_sum(a: f64, b: f64) -> Option<Self> {
        let sum = Self::sum(a, b);
        (sum.high.is_finite() && sum.low.is_finite()).then_some(sum)
    }

    /// The same, whatever it is.
    #[inline(always)]
    pub(crate) fn sum(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, b);
        Self { high, low }
    }

    /// The nearest double.
    pub fn high(self) -> f64 {
        self.high
    }

    /// What the nearest double leaves.
    pub fn low(self) -> f64 {
        self.low
    }

    /// The sum of two doubles, the first not the smaller.
    #[inline(always)]
    fn quick(a: f64, b: f64) -> Self {
        let (high, low) = fast_two_sum(a, b);
        Self { high, low }
    }

    /// The product with a double; relative error at most `2 ε²`: theorem 4.1 (for `DWTimesFP1`) of the
    /// paper named at [`add`](Self::add).
    #[inline(always)]
    pub(crate) fn times(self, factor: f64) -> Self {
        let (product, error) = two_product(self.high, factor);
        let (high, low) = fast_two_sum(product, self.low * factor);
        Self::quick(high, low + error)
    }

    /// The quotient by a double; relative error at most `3 ε²`: `DWDivFP3` of that paper.
    #[inline(always)]
    pub(crate) fn over(self, divisor: f64) -> Self {
        let quotient = self.high / divisor;
        let (product, error) = two_product(quotient, divisor);
        let rest = (((self.high - product) - error) + self.low) / divisor;
        Self::quick(quotient, rest)
    }

    /// `2^exponent` times the number, exact unless something underflows.
    pub(crate) fn scaled(self, exponent: i64) -> Self {
        Self { high: scale(self.high, exponent), low: scale(self.low, exponent) }
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

impl std::ops::Neg for DoubleDouble {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl std::ops::Add for DoubleDouble {
    type Output = Self;

    /// The sum; relative error at most `3 ε² + 13 ε³ < 3.0001 · 2⁻¹⁰⁶`: theorem 3.1 (for
    /// `AccurateDWPlusDW`) of M. Joldes, J.-M. Muller and V. Popescu, *Tight and rigorous error
    /// bounds for basic building blocks of double-word arithmetic*, ACM TOMS 44 (2017).
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let (high, high_error) = two_sum(self.high, other.high);
        let (low, low_error) = two_sum(self.low, other.low);
        let (high, error) = fast_two_sum(high, high_error + low);
        Self::quick(high, low_error + error)
    }
}

impl std::ops::Sub for DoubleDouble {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl std::ops::Mul for DoubleDouble {
    type Output = Self;

    /// The product; relative error at most `7 ε²`, if nothing under- or overflows: theorem 5.1 (for
    /// `DWTimesDW1`) of the paper named at `add`.
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (product, error) = two_product(self.high, other.high);
        let mixed = self.high * other.low + self.low * other.high;
        Self::quick(product, error + mixed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_in_two_doubles() {
        // 3⁶⁰ has 96 bits: two doubles hold it.
        let power = (0..60).fold(DoubleDouble::ONE, |power, _| power.times(3.0));
        let exact = 3i128.pow(60);
        let lost = exact - power.high as i128 - power.low as i128;
        assert!(lost.unsigned_abs() as f64 <= 120.0 * UNIT * UNIT * exact as f64, "{lost}");
    }

    #[test]
    fn quotients_times_their_divisors_are_what_was_divided() {
        for divisor in 1..500 {
            let (divisor, number) = (f64::from(divisor), DoubleDouble::sum(2.0, 1e-17));
            let back = number.over(divisor).times(divisor) - number;
            assert!(back.high.abs() <= 2.0 * 5.6 * UNIT * UNIT, "{divisor}: {back:?}");
        }
    }

    #[test]
    fn powers_of_two_are_exact() {
        let number = DoubleDouble::sum(1.5, -1e-18);
        assert_eq!(number.scaled(-900).scaled(900), number);
        assert_eq!(number + -number, DoubleDouble::ZERO);
    }
}
