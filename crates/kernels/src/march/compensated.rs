//! Sums carried in two doubles, as far as the ends of a polynomial need them: jumps between periods
//! are differences of nearly equal sums, and their errors add up over a million periods.

use crate::double_double::DoubleDouble;
use crate::lanes::{Lanes, padded};

/// The values of a Chebyshev series at both ends of its interval, and the sum of absolute values.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ends {
    /// At `x = 0`: `Σ (−1)^k c_k`.
    pub left: DoubleDouble,
    /// At `x = 1`: `Σ c_k`.
    pub right: DoubleDouble,
    /// How far either value is from the exact sum.
    pub radius: f64,
    /// `Σ |c_k|`.
    pub absolute: f64,
}

/// The ends of the series, summed in two doubles. O(N).
///
/// Eight lanes are summed apart; even and odd coefficients never share one. With `m = N/8 + 1` terms
/// a lane and `A = Σ|c_k|`, every partial sum is at most `A (1 + mε)`, so the exact errors of the
/// additions sum to at most `mεA (1 + mε)` in absolute value, and adding those up rounds by at most
/// `mε` times as much: `m²ε²A`. Joining the lanes takes seven sums of pairs, each off by at most
/// `3.1 ε²A`: `22 ε²A`. Both are far within `2 ((m + 8) ε)² A`.
#[inline(always)]
pub(crate) fn ends<L: Lanes>(coefficients: &[f64]) -> Ends {
    let zero = L::splat(0.0);
    let (mut sum, mut lost, mut absolute) = (zero, zero, zero);
    let (groups, rest) = coefficients.as_chunks();
    for group in groups.iter().chain([&padded(rest)]) {
        let group = L::from_array(*group);
        let (s, e) = sum.two_sum(group);
        (sum, lost) = (s, lost + e);
        absolute = absolute + group.abs();
    }
    let (sum, lost) = (sum.to_array(), lost.to_array());
    let lane = |l: usize| DoubleDouble::sum(sum[l], lost[l]);
    let four = |l: usize| (lane(l) + lane(l + 4)) + (lane(l + 2) + lane(l + 6));
    let (even, odd) = (four(0), four(1));
    let absolute = absolute.sum();
    let unit = (coefficients.len() as f64 / 8.0 + 9.0) * (f64::EPSILON / 2.0);
    Ends { left: even - odd, right: even + odd, radius: 2.0 * unit * unit * absolute, absolute }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::OneByOne;

    #[test]
    fn cancelled_terms_leave_the_small_ones() {
        // 1 + 2⁻⁸⁰ − 1 in one lane of even places, 2⁻⁷⁰ in an odd one.
        let (small, odd) = (2f64.powi(-80), 2f64.powi(-70));
        let mut coefficients = [0.0; 17];
        (coefficients[0], coefficients[8], coefficients[16]) = (1.0, small, -1.0);
        coefficients[1] = odd;
        let found = ends::<OneByOne<false>>(&coefficients);
        assert_eq!(found.right.high, small + odd);
        assert_eq!(found.left.high, small - odd);
        assert_eq!(found.absolute, 2.0 + odd);
        assert!(found.radius < 1e-28);
    }
}
