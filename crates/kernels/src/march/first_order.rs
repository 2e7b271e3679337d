//! `z' = λ z + r`, `z(0)` given, on Chebyshev coefficients over `[0, 1]`, for real and complex `λ`.
//!
//! Integrated once, with `β = −λ/4` and the constant coefficient counted twice in the row `k = 1`, the
//! rows are `k z_k + β (z_{k−1} − z_{k+1}) = (r_{k−1} − r_{k+1})/4`, `k ≥ 1`. Elimination from the
//! highest row down gives `z_k = s_k − θ_k z_{k−1}` with `θ_k = β/(k + β θ_{k+1})`, the ratio
//! `I_k(2β)/I_{k−1}(2β)` of modified Bessel functions. For real `λ` the pivots `k + β θ_{k+1}` are at
//! least `k`. Zeros of `I_0` lie on the imaginary axis only, the first one at `2β = 2.40 i`: the caller
//! keeps `|Im λ| ≤ 1`, that is `|Im 2β| ≤ 1/2`, which is far from it.

use super::number::Scalar;

/// The factors of the elimination, and the solution `e^{λx}` without `r`.
pub(super) struct FirstOrder<T> {
    beta: T,
    /// `1/(k + β θ_{k+1})` at place `k`; place 0 is not used.
    pivots: Vec<T>,
    /// `θ_k` at place `k`.
    ratios: Vec<T>,
    /// The coefficients of `e^{λx}`.
    exponential: Vec<T>,
    solved: Vec<T>,
}

impl<T: Scalar> FirstOrder<T> {
    /// For one rate `λ`. O(√|λ|).
    pub(super) fn new(rate: T) -> FirstOrder<T> {
        let beta = -rate * T::from(0.25);
        let mut equation = FirstOrder {
            beta,
            pivots: Vec::new(),
            ratios: Vec::new(),
            exponential: Vec::new(),
            solved: Vec::new(),
        };
        let mut exponential = unscaled_exponential(|k| {
            equation.reserve(k);
            equation.ratios[k]
        });
        let at_zero = value_at_zero(&exponential);
        exponential.iter_mut().for_each(|c| *c = *c / at_zero);
        FirstOrder { exponential, ..equation }
    }

    /// Makes the factors for all places up to `k`, each time twice as far.
    fn reserve(&mut self, k: usize) {
        if k < self.ratios.len() {
            return;
        }
        (self.pivots, self.ratios) = factors(self.beta, (k + 1).next_power_of_two().max(32));
    }

    /// The solution with a value at 0, into `solution`; what follows the last coefficient of `r` is
    /// computed down to `threshold`. O(N).
    pub(super) fn solve(&mut self, r: &[T], start: T, threshold: f64, solution: &mut Vec<T>) {
        let last = r.len();
        self.reserve(last + 1);
        let at = |k: usize| r.get(k).copied().unwrap_or(T::ZERO);
        self.solved.clear();
        self.solved.resize(last + 1, T::ZERO);
        let mut above = T::ZERO;
        for k in (1..=last).rev() {
            // The constant coefficient counts twice.
            let before = if k == 1 { at(0) + at(0) } else { at(k - 1) };
            let row = (before - at(k + 1)) * T::from(0.25);
            above = (row + self.beta * above) * self.pivots[k];
            self.solved[k] = above;
        }
        solution.clear();
        solution.push(T::ZERO);
        for k in 1..=last {
            let next = self.solved[k] - self.ratios[k] * solution[k - 1];
            solution.push(next);
        }
        while solution.len() > 1 {
            let k = solution.len();
            self.reserve(k);
            let next = -self.ratios[k] * solution[k - 1];
            if next.size() <= threshold || !next.size().is_finite() {
                break;
            }
            solution.push(next);
        }
        let rest = start - value_at_zero(solution);
        if solution.len() < self.exponential.len() {
            solution.resize(self.exponential.len(), T::ZERO);
        }
        for (c, e) in solution.iter_mut().zip(&self.exponential) {
            *c = *c + rest * *e;
        }
    }
}

/// `1/(k + β θ_{k+1})` and `θ_k` at the places `k < length`; place 0 is not used.
///
/// `θ_k` is about `e^{−arsinh(k/2β)}` for `β > 0`, and an error of the ratio above shrinks by `θ²` a place:
/// by `e^{−50}` over `10√β` places, and faster where `β` is small.
pub(super) fn factors<T: Scalar>(beta: T, length: usize) -> (Vec<T>, Vec<T>) {
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

/// The coefficients of a multiple of `e^{λx}`, from the ratios `θ_k`: `c_0 = 1`, `c_1 = −θ_1 · 2 c_0`,
/// `c_k = −θ_k c_{k−1}`.
pub(super) fn unscaled_exponential<T: Scalar>(mut ratio: impl FnMut(usize) -> T) -> Vec<T> {
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
            let equation = FirstOrder::new(rate);
            for x in [0.0, 0.1, 0.5, 0.9, 1.0] {
                let error = (value(&equation.exponential, x) - exponential(rate, x)).size();
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
            FirstOrder::new(rate).solve(&[one - half, -half], one, 1e-20, &mut z);
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
