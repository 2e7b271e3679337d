//! `u' + B u = −C g`, `u(0)` given, on Chebyshev coefficients over `[0, 1]`, for real and complex `B`.
//!
//! Integrated once, the equation has no derivative and is well conditioned. With `β = B/4`,
//! `γ = C/4` and the constant coefficient counted twice in the row `k = 1`, its rows are
//!
//! `k u_k + β (u_{k−1} − u_{k+1}) = −γ (g_{k−1} − g_{k+1})`, `k ≥ 1`,
//!
//! and `Σ (−1)^k u_k = u(0)` is the last one. Elimination from the highest row down gives
//! `u_k = s_k − θ_k u_{k−1}` with `θ_k = β/(k + β θ_{k+1})`. The `θ_k` are the ratios
//! `I_k(B/2)/I_{k−1}(B/2)` of modified Bessel functions. They depend on `B` alone, whatever the number of
//! coefficients, and are made once.
//!
//! For positive `B` all of them are positive, so that nothing cancels; for real `B` the pivots
//! `k + β θ_{k+1}` are at least `k`. Zeros of `I_0` lie on the imaginary axis only, the first one at
//! `B/2 = 2.40 i`: the caller keeps `|Im B| ≤ 1`, which is far from it.

use super::number::Scalar;

/// The factors of the elimination, and the solution `e^{−Bx}` of the equation without `g`.
pub(crate) struct Relaxation<T> {
    beta: T,
    gamma: T,
    /// `1/(k + β θ_{k+1})`, the reciprocal pivots, at place `k`.
    pivot: Vec<T>,
    /// `θ_k`, the ratio of neighbours, at place `k`; the next three are products of two and of four
    /// neighbouring ratios, which let four places be solved side by side.
    ratio: Vec<T>,
    /// `θ_k θ_{k+1}`, and `θ_k … θ_{k+3}`.
    up: [Vec<T>; 2],
    /// `θ_k θ_{k−1}`, and `θ_k … θ_{k−3}`; zero where the product would reach below `k = 1`.
    down: [Vec<T>; 2],
    /// The coefficients of `e^{−Bx}`.
    decay: Vec<T>,
    /// Scratch: `g` with zeros behind it, and `s`.
    padded: Vec<T>,
    solved: Vec<T>,
}

/// Places behind the last one, so that a group of four and its neighbours stay inside.
const MARGIN: usize = 12;

impl<T: Scalar> Relaxation<T> {
    /// The step for `B = rate` and `C = coupling`. O(√B).
    pub fn new(rate: T, coupling: T) -> Relaxation<T> {
        let quarter = T::from(0.25);
        let mut step = Relaxation {
            beta: rate * quarter,
            gamma: coupling * quarter,
            pivot: Vec::new(),
            ratio: Vec::new(),
            up: Default::default(),
            down: Default::default(),
            decay: Vec::new(),
            padded: Vec::new(),
            solved: Vec::new(),
        };
        step.reserve(64);
        // Scaled to the value 1 at x = 0, where all terms are positive if B is.
        let mut decay = unscaled_exponential(|k| step.ratio(k));
        let scale = T::ONE / value_at_zero(&decay);
        decay.iter_mut().for_each(|c| *c = *c * scale);
        Relaxation { decay, ..step }
    }

    /// The coefficients of `e^{−Bx}`, value 1 at `x = 0`.
    pub fn decay(&self) -> &[T] {
        &self.decay
    }

    /// `θ_k`.
    pub fn ratio(&mut self, k: usize) -> T {
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
        let upward = |from: &[T], step: usize| -> Vec<T> {
            let other = |k: usize| from.get(k + step).copied().unwrap_or(T::ZERO);
            from.iter().enumerate().map(|(k, own)| *own * other(k)).collect()
        };
        let downward = |from: &[T], step: usize| -> Vec<T> {
            let other = |k: usize| k.checked_sub(step).map_or(T::ZERO, |k| from[k]);
            from.iter().enumerate().map(|(k, own)| *own * other(k)).collect()
        };
        let (up, down) = (upward(&self.ratio, 1), downward(&self.ratio, 1));
        self.up = [up.clone(), upward(&up, 2)];
        self.down = [down.clone(), downward(&down, 2)];
        (self.padded, self.solved) = (vec![T::ZERO; length], vec![T::ZERO; length]);
    }

    /// The solution that has no constant coefficient, for the right side `−C g`, into `solution`:
    /// places `0 ..= g.len()`. O(N), without a division.
    ///
    /// The two passes are first-order recurrences, each step waiting for the one before. Written
    /// over four steps, `s_k = h_k + θ_k … θ_{k+3} s_{k+4}`, four places wait together.
    #[inline(always)]
    pub fn particular(&mut self, g: &[T], solution: &mut Vec<T>) {
        let last = g.len();
        self.reserve(last);
        // The places 1 ..= 4·groups are solved.
        let groups = last.div_ceil(4);
        let end = 4 * groups + 1;
        let Relaxation { gamma, pivot, ratio, up, down, padded, solved, .. } = self;
        padded[..last].copy_from_slice(g);
        padded[last..end + 1].fill(T::ZERO);
        // The constant coefficient counts twice.
        padded[0] = padded[0] + padded[0];
        // Downward: h from the rows, pairs h_k + θ_k h_{k+1}, then s_k.
        let (mut next, mut pairs, mut above) = (T::ZERO, [T::ZERO; 4], [T::ZERO; 4]);
        for group in (0..groups).rev() {
            let k = 4 * group + 1;
            let near: &[T; 6] = at(padded, k - 1);
            let (pivot, ratio): (&[T; 4], &[T; 4]) = (at(pivot, k), at(ratio, k));
            let (two, four): (&[T; 4], &[T; 4]) = (at(&up[0], k), at(&up[1], k));
            let h: [T; 4] = std::array::from_fn(|i| *gamma * (near[i + 2] - near[i]) * pivot[i]);
            let after = [h[1], h[2], h[3], next];
            let pair: [T; 4] = std::array::from_fn(|i| h[i] + ratio[i] * after[i]);
            let far = [pair[2], pair[3], pairs[0], pairs[1]];
            above = std::array::from_fn(|i| (pair[i] + two[i] * far[i]) + four[i] * above[i]);
            solved[k..k + 4].copy_from_slice(&above);
            (next, pairs) = (h[0], pair);
        }
        // Upward: u_k = s_k − θ_k u_{k−1}, u_0 = 0, in the same way.
        solution.resize(end, T::ZERO);
        solution[0] = T::ZERO;
        let (mut next, mut pairs, mut below) = (T::ZERO, [T::ZERO; 4], [T::ZERO; 4]);
        for group in 0..groups {
            let k = 4 * group + 1;
            let (s, ratio): (&[T; 4], &[T; 4]) = (at(solved, k), at(ratio, k));
            let (two, four): (&[T; 4], &[T; 4]) = (at(&down[0], k), at(&down[1], k));
            let before = [next, s[0], s[1], s[2]];
            let pair: [T; 4] = std::array::from_fn(|i| s[i] - ratio[i] * before[i]);
            let far = [pairs[2], pairs[3], pair[0], pair[1]];
            below = std::array::from_fn(|i| (pair[i] + two[i] * far[i]) + four[i] * below[i]);
            solution[k..k + 4].copy_from_slice(&below);
            (next, pairs) = (s[3], pair);
        }
        solution.truncate(last + 1);
    }

    /// The solution with a value at 0, into `solution`; what follows the last coefficient of `g` is
    /// computed down to `threshold`. O(N).
    pub fn solve(&mut self, g: &[T], start: T, threshold: f64, solution: &mut Vec<T>) {
        self.particular(g, solution);
        while solution.len() > 1 {
            let k = solution.len();
            let next = -self.ratio(k) * solution[k - 1];
            if next.size() <= threshold || !next.size().is_finite() {
                break;
            }
            solution.push(next);
        }
        let rest = start - value_at_zero(solution);
        if solution.len() < self.decay.len() {
            solution.resize(self.decay.len(), T::ZERO);
        }
        for (c, e) in solution.iter_mut().zip(&self.decay) {
            *c = *c + rest * *e;
        }
    }
}

/// The `N` places from `k` on.
#[inline(always)]
fn at<T, const N: usize>(places: &[T], k: usize) -> &[T; N] {
    places[k..].first_chunk().expect("the factors reach beyond the last place")
}

/// `1/(k + β θ_{k+1})` and `θ_k` at the places `k < length`; place 0 is not used.
///
/// `θ_k` is about `e^{−arsinh(k/2β)}` for `β > 0`, and an error of the ratio above shrinks by `θ²` a place:
/// by `e^{−50}` over `10√β` places, and faster where `β` is small.
fn factors<T: Scalar>(beta: T, length: usize) -> (Vec<T>, Vec<T>) {
    let start = length + 64 + (10.0 * beta.size().sqrt()) as usize;
    let (mut pivots, mut ratios) = (vec![T::ZERO; length], vec![T::ZERO; length]);
    let mut above = T::ZERO;
    for k in (1..start).rev() {
        let pivot = T::ONE / (T::from(k as f64) + beta * above);
        above = beta * pivot;
        if k < length {
            (pivots[k], ratios[k]) = (pivot, above);
        }
    }
    (pivots, ratios)
}

/// The coefficients of a multiple of `e^{−Bx}`, from the ratios `θ_k`: `c_0 = 1`, `c_1 = −θ_1 · 2 c_0`,
/// `c_k = −θ_k c_{k−1}`.
fn unscaled_exponential<T: Scalar>(mut ratio: impl FnMut(usize) -> T) -> Vec<T> {
    let mut coefficients = vec![T::ONE];
    let mut term = T::from(2.0);
    for k in 1.. {
        term = -ratio(k) * term;
        if term.size() < 1e-40 {
            break;
        }
        coefficients.push(term);
    }
    coefficients
}

/// `Σ (−1)^k c_k`, the smallest first.
pub(super) fn value_at_zero<T: Scalar>(coefficients: &[T]) -> T {
    let signed = coefficients.iter().enumerate().rev();
    signed.fold(T::ZERO, |sum, (k, c)| if k % 2 == 0 { sum + *c } else { sum - *c })
}

/// `Σ c_k`, the smallest first.
pub(super) fn value_at_one<T: Scalar>(coefficients: &[T]) -> T {
    coefficients.iter().rev().fold(T::ZERO, |sum, c| sum + *c)
}

/// The coefficients of the derivative by `x`, into `derivative`: `b_{k−1} = b_{k+1} + 4k c_k`, the
/// constant one halved.
pub(super) fn differentiate<T: Scalar>(coefficients: &[T], derivative: &mut Vec<T>) {
    derivative.clear();
    derivative.resize(coefficients.len().max(2) - 1, T::ZERO);
    for k in (1..coefficients.len()).rev() {
        let above = derivative.get(k + 1).copied().unwrap_or(T::ZERO);
        derivative[k - 1] = above + coefficients[k] * T::from(4.0 * k as f64);
    }
    derivative[0] = derivative[0] * T::from(0.5);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::march::number::Complex;

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

    fn value(coefficients: &[Complex], x: f64) -> Complex {
        let part = |part: fn(&Complex) -> f64| {
            let c: Vec<f64> = coefficients.iter().map(part).collect();
            crate::march::chebyshev::value(&c, x)
        };
        Complex { re: part(|c| c.re), im: part(|c| c.im) }
    }

    /// `e^{λx}`.
    fn exponential(rate: Complex, x: f64) -> Complex {
        let (sin, cos) = (rate.im * x).sin_cos();
        Complex { re: cos, im: sin } * (rate.re * x).exp().into()
    }

    #[test]
    fn exponentials_are_found() {
        for (re, im) in
            [(0.0, 0.0), (-1e-9, 0.0), (0.5, 1.0), (0.0, 1.0), (-30.0, 1.0), (-4e3, 0.3)]
        {
            let rate = Complex { re, im };
            let equation = Relaxation::new(-rate, -Complex::ONE);
            for x in [0.0, 0.1, 0.5, 0.9, 1.0] {
                let error = (value(&equation.decay, x) - exponential(rate, x)).size();
                assert!(error < 2e-15, "{rate:?} {x}: {error:e}");
            }
        }
    }

    /// `z = e^{λx} + x`: the right side is `1 − λ x`, and its derivative `λ e^{λx} + 1`.
    #[test]
    fn driven_solutions_and_their_slopes_are_found() {
        for (re, im) in [(0.0, 0.0), (-2.0, 0.0), (0.9, 0.0), (-3.0, 1.0), (-200.0, 0.0)] {
            let (rate, one) = (Complex { re, im }, Complex::ONE);
            let half = rate * 0.5.into();
            let (mut z, mut slope) = (Vec::new(), Vec::new());
            Relaxation::new(-rate, -one).solve(&[one - half, -half], one, 1e-20, &mut z);
            differentiate(&z, &mut slope);
            assert!((value_at_zero(&z) - one).size() < 4e-15, "{rate:?}");
            let end = exponential(rate, 1.0) + one;
            assert!((value_at_one(&z) - end).size() < 4e-15, "{rate:?}");
            for x in [0.0, 0.2, 0.7, 1.0] {
                let e = exponential(rate, x);
                assert!((value(&z, x) - e - x.into()).size() < 4e-15, "{rate:?} {x}");
                let error = (value(&slope, x) - rate * e - one).size();
                assert!(error < 1e-14 * (1.0 + rate.size().powi(2)), "{rate:?} {x}: {error:e}");
            }
        }
    }
}
