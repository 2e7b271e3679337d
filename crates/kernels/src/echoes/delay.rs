//! When echoes arrive, and how long ago: `T − kD` without error. A rounding there would cost as many
//! ulps as the echo has reflections behind it, because `φ_k'` is about `−(2k+1)` at a front.

use super::expansion::Expansion;
use crate::Limit;
use crate::double_double::{DoubleDouble, fast_two_sum, two_sum};

/// `kD` for `k = 0 … last`, each as three doubles: exact where `kD` has at most 159 bits, as it has
/// whenever `D` is a double or a sum of two without a gap between them; else with a relative error of
/// at most `2^−156`.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Delays(Vec<[f64; 3]>);

impl Delays {
    pub fn new(period: Expansion, last: usize) -> Delays {
        Delays((0..=last).map(|k| period.times(k as f64).parts()).collect())
    }

    pub fn of(&self, k: usize) -> [f64; 3] {
        self.0[k]
    }

    pub fn last(&self) -> usize {
        self.0.len() - 1
    }

    /// `T − kD`: its sign and its being 0 are those of the difference with the three doubles, and
    /// it has a relative error of at most `2^−103`.
    pub fn since(&self, k: usize, time: DoubleDouble) -> DoubleDouble {
        since(self.0[k], time)
    }

    /// Whether echo `k` has arrived; one that arrives at this very time has, in the limit from the right.
    pub fn has_arrived(&self, k: usize, time: DoubleDouble, limit: Limit) -> bool {
        counts(self.since(k, time).high, limit)
    }
}

/// Whether an echo counts that arrived `since` ago.
#[inline(always)]
pub(super) fn counts(since: f64, limit: Limit) -> bool {
    since > 0.0 || (limit == Limit::Right && since == 0.0)
}

/// `T − delay`.
///
/// Let `s + e = T.high − delay[0]` and `u + v = T.low − delay[1]`, without error. If `e ≠ 0`, the
/// leading parts are not within a factor of two of one another (Sterbenz), so `|s|` is at least half
/// the larger of them, all else is below `2^−51 |s|`, and the roundings of the low part weigh
/// `2^−104`. If `e = 0`, the sum `s + u` is again split without error, and where it is not 0 the parts
/// that remain, `v − delay[2]`, are at most `2^−52` of it or the sum of `s` and `u` is itself exact:
/// then one rounding of `v − delay[2]` is left, and a sum with it.
#[inline(always)]
pub(super) fn since(delay: [f64; 3], time: DoubleDouble) -> DoubleDouble {
    let (lead, error) = two_sum(time.high, -delay[0]);
    let (next, rest) = two_sum(time.low, -delay[1]);
    let (high, low) = two_sum(lead, next);
    let (low, last) = two_sum(low + error, rest - delay[2]);
    // The sum may have cancelled down to the low part: put the larger first again.
    let (high, low) = two_sum(high, low);
    let (low, _) = fast_two_sum(low, last);
    let (high, low) = two_sum(high, low);
    DoubleDouble { high, low }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_of_a_near_arrival_is_exact() {
        // D = 0.1 + 2^−60 is no double; the 200th delay ends 2^−60·200 behind its first part.
        let period = Expansion::new([0.1, 2f64.powi(-60), 0.0]).expect("a number");
        let delays = Delays::new(period, 200);
        let [a, b, c] = delays.of(200);
        assert_eq!(c, 0.0);
        let exact = DoubleDouble::sum(a, b);
        assert_eq!(delays.since(200, exact).high, 0.0);
        assert!(delays.has_arrived(200, exact, Limit::Right));
        assert!(!delays.has_arrived(200, exact, Limit::Left));
        let after = DoubleDouble::sum(a, b.next_up());
        assert_eq!(delays.since(200, after).high, b.next_up() - b);
        let before = DoubleDouble::sum(a, b.next_down());
        assert!(!delays.has_arrived(200, before, Limit::Right));
    }

    #[test]
    fn the_third_double_decides_too() {
        let delays =
            Delays::new(Expansion::new([1.0, 2f64.powi(-60), 2f64.powi(-130)]).unwrap(), 1);
        let time = DoubleDouble::sum(1.0, 2f64.powi(-60));
        assert_eq!(delays.since(1, time).high, -2f64.powi(-130));
    }
}
