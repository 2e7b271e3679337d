//! Sums carried in two doubles, as far as the ends of a polynomial need them: jumps between periods
//! are differences of nearly equal sums, and their errors add up over a million periods.

use crate::double_double::two_sum;

/// An unevaluated sum of two doubles. `high` is usually the sum rounded; nothing depends on it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pair {
    pub high: f64,
    pub low: f64,
}

impl Pair {
    pub fn new(high: f64) -> Pair {
        Pair { high, low: 0.0 }
    }

    /// The sum of both parts, rounded.
    pub fn value(self) -> f64 {
        self.high + self.low
    }

    /// `self + other`. The two additions of low parts round: the error is at most 3ε times the low
    /// parts' sum, where a low part is at most ε times the numbers that went in.
    pub fn plus(self, other: Pair) -> Pair {
        let (high, error) = two_sum(self.high, other.high);
        Pair { high, low: error + (self.low + other.low) }
    }

    /// `self − other`, as [`Pair::plus`].
    pub fn minus(self, other: Pair) -> Pair {
        self.plus(Pair { high: -other.high, low: -other.low })
    }

    /// `self · factor` for a double. The error is at most `2⁻¹⁰³` times the product's size: the
    /// product of the high parts is exact in two doubles, and what rounds is of size ε.
    pub fn times(self, factor: f64) -> Pair {
        let (product, error) = two_product(self.high, factor);
        let low = error + self.low * factor;
        let (high, low) = two_sum(product, low);
        Pair { high, low }
    }
}

/// `a · b` rounded, and what the rounding lost, exactly where nothing underflows.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// The values of a Chebyshev series at both ends of its interval, and the sum of absolute values.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ends {
    /// At `x = 0`: `Σ (−1)^k c_k`.
    pub left: Pair,
    /// At `x = 1`: `Σ c_k`.
    pub right: Pair,
    /// How far either value is from the exact sum.
    pub radius: f64,
    /// `Σ |c_k|`.
    pub absolute: f64,
}

/// The ends of the series, summed in two doubles. O(N).
///
/// Four lanes are summed apart; even and odd coefficients never share one. With `m = N/4 + 1` terms
/// a lane and `A = Σ|c_k|`, every partial sum is at most `A (1 + mε)`, so the exact errors of the
/// additions sum to at most `mεA (1 + mε)` in absolute value, and adding those up rounds by at most
/// `mε` times as much: `m²ε²A`. Joining the lanes, and later a difference with such a sum, rounds
/// low parts of at most `mεA` a dozen times: `12 m ε² A`. Both are far within `2 ((m + 8) ε)² A`.
pub(crate) fn ends(coefficients: &[f64]) -> Ends {
    let (mut sum, mut lost, mut absolute) = ([0.0; 4], [0.0; 4], [0.0; 4]);
    let mut add = |group: &[f64; 4]| {
        for lane in 0..4 {
            let (s, e) = two_sum(sum[lane], group[lane]);
            sum[lane] = s;
            lost[lane] += e;
            absolute[lane] += group[lane].abs();
        }
    };
    let (groups, rest) = coefficients.as_chunks::<4>();
    groups.iter().for_each(&mut add);
    let mut last = [0.0; 4];
    last[..rest.len()].copy_from_slice(rest);
    add(&last);
    let lane = |l: usize| Pair { high: sum[l], low: lost[l] };
    let (even, odd) = (lane(0).plus(lane(2)), lane(1).plus(lane(3)));
    let absolute = absolute.iter().sum::<f64>();
    let unit = (coefficients.len() as f64 / 4.0 + 9.0) * (f64::EPSILON / 2.0);
    Ends {
        left: even.minus(odd),
        right: even.plus(odd),
        radius: 2.0 * unit * unit * absolute,
        absolute,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cancelled_terms_leave_the_small_ones() {
        // 1 + 2⁻⁸⁰ − 1 on even places of one lane, 2⁻⁷⁰ on an odd one.
        let (small, odd) = (2f64.powi(-80), 2f64.powi(-70));
        let found = ends(&[1.0, odd, 0.0, 0.0, small, 0.0, 0.0, 0.0, -1.0]);
        assert!((found.right.value() - (small + odd)).abs() <= found.radius);
        assert!((found.left.value() - (small - odd)).abs() <= found.radius);
        assert_eq!(found.right.value(), small + odd);
        assert_eq!(found.absolute, 2.0 + odd);
    }

    #[test]
    fn a_power_in_two_doubles() {
        // 3⁶⁰ has 96 bits: two doubles hold it.
        let power = (0..60).fold(Pair::new(1.0), |power, _| power.times(3.0));
        let exact = 3i128.pow(60);
        let lost = exact - power.high as i128 - power.low as i128;
        assert!(lost.unsigned_abs() as f64 <= 60.0 * 2f64.powi(-103) * exact as f64, "{lost}");
    }
}
