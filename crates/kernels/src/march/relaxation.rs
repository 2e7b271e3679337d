//! `u' + B u = −C g`, `u(0)` given, on Chebyshev coefficients over `[0, 1]`: one step of the march.
//!
//! Integrated once, the equation has no derivative and is well conditioned. With `β = B/4`,
//! `γ = C/4` and the constant coefficient counted twice in the row `k = 1`, its rows are
//!
//! `k u_k + β (u_{k−1} − u_{k+1}) = −γ (g_{k−1} − g_{k+1})`, `k ≥ 1`,
//!
//! and `Σ (−1)^k u_k = u(0)` is the last one. Elimination from the highest row down gives
//! `u_k = s_k − θ_k u_{k−1}` with `θ_k = β/(k + β θ_{k+1})`: all positive, so that nothing cancels.
//! The `θ_k` are the ratios `I_k(B/2)/I_{k−1}(B/2)` of modified Bessel functions. They depend on
//! `B` alone, whatever the number of coefficients, and are made once.

use super::first_order::{factors, unscaled_exponential, value_at_zero};

/// The factors of the elimination, and the solution `e^{−Bx}` of the equation without `g`.
pub(crate) struct Relaxation {
    beta: f64,
    gamma: f64,
    /// `1/(k + β θ_{k+1})`, the reciprocal pivots, at place `k`.
    pivot: Vec<f64>,
    /// `θ_k`, the ratio of neighbours, at place `k`; the next three are products of two and of four
    /// neighbouring ratios, which let four places be solved side by side.
    ratio: Vec<f64>,
    /// `θ_k θ_{k+1}`, and `θ_k … θ_{k+3}`.
    up: [Vec<f64>; 2],
    /// `θ_k θ_{k−1}`, and `θ_k … θ_{k−3}`; zero where the product would reach below `k = 1`.
    down: [Vec<f64>; 2],
    /// The coefficients of `e^{−Bx}`.
    decay: Vec<f64>,
    /// Scratch: `g` with zeros behind it, and `s`.
    padded: Vec<f64>,
    solved: Vec<f64>,
}

/// Places behind the last one, so that a group of four and its neighbours stay inside.
const MARGIN: usize = 12;

impl Relaxation {
    /// The step for `B = rate` and `C = coupling`. O(√B).
    pub fn new(rate: f64, coupling: f64) -> Relaxation {
        let mut step = Relaxation {
            beta: rate / 4.0,
            gamma: coupling / 4.0,
            pivot: Vec::new(),
            ratio: Vec::new(),
            up: Default::default(),
            down: Default::default(),
            decay: Vec::new(),
            padded: Vec::new(),
            solved: Vec::new(),
        };
        step.reserve(64);
        // Scaled to the value 1 at x = 0, where all terms are positive.
        let mut decay = unscaled_exponential(|k| step.ratio(k));
        let scale = 1.0 / value_at_zero(&decay);
        decay.iter_mut().for_each(|c| *c *= scale);
        Relaxation { decay, ..step }
    }

    /// The coefficients of `e^{−Bx}`, value 1 at `x = 0`.
    pub fn decay(&self) -> &[f64] {
        &self.decay
    }

    /// `θ_k`.
    pub fn ratio(&mut self, k: usize) -> f64 {
        self.reserve(k);
        self.ratio[k]
    }

    /// Makes the factors for all places up to `k`. O(k), each time twice as far.
    fn reserve(&mut self, k: usize) {
        if k + MARGIN < self.ratio.len() {
            return;
        }
        let length = (k + MARGIN + 1).next_power_of_two().max(2 * self.ratio.len());
        (self.pivot, self.ratio) = factors(self.beta, length);
        // Products that would reach beyond the last place or below the first are 0.
        let upward = |from: &[f64], step: usize| -> Vec<f64> {
            let other = |k: usize| from.get(k + step).copied().unwrap_or(0.0);
            from.iter().enumerate().map(|(k, own)| own * other(k)).collect()
        };
        let downward = |from: &[f64], step: usize| -> Vec<f64> {
            let other = |k: usize| k.checked_sub(step).map_or(0.0, |k| from[k]);
            from.iter().enumerate().map(|(k, own)| own * other(k)).collect()
        };
        let (up, down) = (upward(&self.ratio, 1), downward(&self.ratio, 1));
        self.up = [up.clone(), upward(&up, 2)];
        self.down = [down.clone(), downward(&down, 2)];
        (self.padded, self.solved) = (vec![0.0; length], vec![0.0; length]);
    }

    /// The solution that has no constant coefficient, for the right side `−C g`, into `solution`:
    /// places `0 ..= g.len()`. O(N), without a division.
    ///
    /// The two passes are first-order recurrences, each step waiting for the one before. Written
    /// over four steps, `s_k = h_k + θ_k … θ_{k+3} s_{k+4}`, four places wait together.
    #[inline(always)]
    pub fn particular(&mut self, g: &[f64], solution: &mut Vec<f64>) {
        let last = g.len();
        self.reserve(last);
        // The places 1 ..= 4·groups are solved.
        let groups = last.div_ceil(4);
        let end = 4 * groups + 1;
        let Relaxation { gamma, pivot, ratio, up, down, padded, solved, .. } = self;
        padded[..last].copy_from_slice(g);
        padded[last..end + 1].fill(0.0);
        // The constant coefficient counts twice.
        padded[0] *= 2.0;
        // Downward: h from the rows, pairs h_k + θ_k h_{k+1}, then s_k.
        let (mut next, mut pairs, mut above) = (0.0, [0.0; 4], [0.0; 4]);
        for group in (0..groups).rev() {
            let k = 4 * group + 1;
            let near: &[f64; 6] = at(padded, k - 1);
            let (pivot, ratio): (&[f64; 4], &[f64; 4]) = (at(pivot, k), at(ratio, k));
            let (two, four): (&[f64; 4], &[f64; 4]) = (at(&up[0], k), at(&up[1], k));
            let h: [f64; 4] = std::array::from_fn(|i| *gamma * (near[i + 2] - near[i]) * pivot[i]);
            let after = [h[1], h[2], h[3], next];
            let pair: [f64; 4] = std::array::from_fn(|i| h[i] + ratio[i] * after[i]);
            let far = [pair[2], pair[3], pairs[0], pairs[1]];
            above = std::array::from_fn(|i| (pair[i] + two[i] * far[i]) + four[i] * above[i]);
            solved[k..k + 4].copy_from_slice(&above);
            (next, pairs) = (h[0], pair);
        }
        // Upward: u_k = s_k − θ_k u_{k−1}, u_0 = 0, in the same way.
        solution.resize(end, 0.0);
        solution[0] = 0.0;
        let (mut next, mut pairs, mut below) = (0.0, [0.0; 4], [0.0; 4]);
        for group in 0..groups {
            let k = 4 * group + 1;
            let (s, ratio): (&[f64; 4], &[f64; 4]) = (at(solved, k), at(ratio, k));
            let (two, four): (&[f64; 4], &[f64; 4]) = (at(&down[0], k), at(&down[1], k));
            let before = [next, s[0], s[1], s[2]];
            let pair: [f64; 4] = std::array::from_fn(|i| s[i] - ratio[i] * before[i]);
            let far = [pairs[2], pairs[3], pair[0], pair[1]];
            below = std::array::from_fn(|i| (pair[i] + two[i] * far[i]) + four[i] * below[i]);
            solution[k..k + 4].copy_from_slice(&below);
            (next, pairs) = (s[3], pair);
        }
        solution.truncate(last + 1);
    }
}

/// The `N` places from `k` on.
#[inline(always)]
fn at<const N: usize>(places: &[f64], k: usize) -> &[f64; N] {
    places[k..].first_chunk().expect("the factors reach beyond the last place")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest residual of the rows, for the solution of a right side of any length.
    fn worst_row(rate: f64, g: &[f64]) -> f64 {
        let mut step = Relaxation::new(rate, 3.0);
        let mut u = Vec::new();
        step.particular(g, &mut u);
        assert_eq!(u.len(), g.len() + 1);
        // The places behind continue by the ratio alone.
        for k in u.len()..u.len() + 40 {
            let next = -step.ratio(k) * u[k - 1];
            u.push(next);
        }
        let at = |c: &[f64], k: usize| match k {
            0 => 2.0 * c[0],
            k => c.get(k).copied().unwrap_or(0.0),
        };
        let row = |k: usize| {
            let left = k as f64 * u[k] + rate / 4.0 * (at(&u, k - 1) - at(&u, k + 1));
            (left + 0.75 * (at(g, k - 1) - at(g, k + 1))).abs()
        };
        (1..u.len() - 2).map(row).fold(0.0, f64::max)
    }

    #[test]
    fn rows_are_satisfied_for_every_length() {
        for length in 1..40 {
            let g: Vec<f64> = (0..length).map(|k| (k as f64 * 1.3).cos()).collect();
            for rate in [0.01, 2.0, 9.0, 300.0, 3e4] {
                let worst = worst_row(rate, &g);
                assert!(worst < 3e-15 * (1.0 + rate / 4.0), "{length} {rate}: {worst:e}");
            }
        }
    }

    #[test]
    fn decay_is_the_exponential() {
        for rate in [0.1f64, 2.0, 40.0, 5000.0] {
            let step = Relaxation::new(rate, 1.0);
            for x in [0.0, 0.3, 0.9, 1.0] {
                let found = crate::march::chebyshev::value(step.decay(), x);
                assert!((found - (-rate * x).exp()).abs() < 1e-15, "{rate} {x}");
            }
        }
    }
}
