//! Proven bounds on the rounding errors of Horner's scheme on one piece.
//!
//! All bounds hold for every argument with `|u| ≤ r`, the *reach* of the piece, `r ≤ 1`, with and without
//! fused multiply-adds. They are sums of magnitudes, computed in doubles and then widened by more than
//! their own roundings.
//!
//! Notation: `ε = 2⁻⁵³`, `n` the degree, `T_k = Σ_{j≥k} |c_j|`, `û` the rounded argument. What follows is
//! for `r = 1`. Else an error made in the step to `r_k` reaches the result times `|û|^k ≤ r^k`, and
//! `|r_k| r^k ≤ Σ_{j≥k} |c_j| r^j`: everything holds with `|c_k| r^k` and `|low_k| r^k` in place of `|c_k|` and
//! `|low_k|`, and these are the magnitudes that are used. Scaling by
//! powers of two is exact, so `û` is `u` rounded once: `|û − u| ≤ ε |u|`, and `|û| ≤ 1` as well.
//!
//! # Doubles
//! `r_n = c_n`, `r_k = RN(r_{k+1} û + c_k)`, and `|r_k| ≤ T_k` but for factors `1 + ε`. Fused, a step
//! adds an error of `ε |r_k|` at most, and multiplies the errors before it by `|û| ≤ 1`:
//! `ε Σ_{k<n} T_k` together. Unfused, the product is rounded too, by at most
//! `ε |r_{k+1} û| ≤ ε T_{k+1}`: `ε (Σ_{k<n} T_k + Σ_{1≤k≤n} T_k)`. The larger one, the second, is taken.
//! The polynomial itself changes from `û` to `u` by at most `ε Σ k |c_k|`.
//!
//! # Pairs of doubles
//! The value is a pair `h + l`: `h` is a multiple of the grid `g` of the piece, and `l` is small.
//! Above `split` Horner's scheme runs in doubles, and its result is the first `h`; the low parts
//! there are left out. The coefficients below are split anew, `c_k + low_k = C_k + low'_k`, with
//! `C_k` a multiple of `g`. With the *anchor* `σ = 3 · 2⁵¹ g`, a step is
//!
//! ```text
//! t = RN(h û + (σ + C_k)),   P = t − (σ + C_k),   h' = t − σ = P + C_k,
//! m = RN(RN(h û − P) + low'_k),   l' = RN(l û + m)
//! ```
//!
//! Let `2⁵¹ g` be the power of two `M` above all `S_k = Σ_{j≥k} |c_j| r^{j−k}`, `k < split`. Then
//! all `|h'| ≤ M`: splitting and rounding add `g` a step, 64 of them less than the room that `M`
//! leaves. So `σ + C_k`, `t` and all sums in between lie in `2⁵² g … 2⁵³ g`, where the doubles are
//! the multiples of `g`: `P` and `h'` are exact, and `|h û − P| ≤ g/2 = 2 ε M`.
//!
//! Unfused, `p + e = h û` exactly, `t = RN(p + (σ + C_k))`, `p − P` is exact, because it is a
//! multiple of the last bit of `p` not larger than `p` or than `g/2`, and `h û − P` is computed as
//! `(p − P) + e`. So in both cases `h û − P` is at most `ρ = 2 ε M + ε S_{k+1}` and rounded by `ε
//! ρ`, `m` is at most `ρ + |low'_k|` and rounded by `ε` of that, and with `λ` a bound on `|l|`, `λ'
//! = r λ + ρ + |low'_k|`, the two roundings of `l'` are `ε (r λ + λ')` at most. Together they are
//! less than `ε (ρ + 2 λ')`, which reaches the result times `r^k`. Splitting rounds `low'_k`, by `ε
//! |low'_k|`.
//!
//! Where the argument is not exact, `u = û + δ` with `|δ| ≤ ε` known: `δ p'(û)` is added, with `p'`
//! in doubles, from `C_k` and the `c_k` above. Each of the terms `k c_k û^{k−1}` of `p'` meets at
//! most `2n` roundings, so with `D = Σ k (|c_k| + |low_k| + |low'_k|)`, `D₂ = Σ k (k−1) (|c_k| +
//! |low_k|)` the error is at most `ε (2nε D + Σ k (|low_k| + |low'_k|))` for that, `2 ε (λ + ε D)`
//! for product and sum, and `ε² D₂ / 2` for the rest of Taylor's series.
//!
//! # Widening
//! Factors `1 + ε` were dropped, fewer than 600 of them on any term, and fewer than 300 additions of
//! non-negative doubles compute a bound: together a factor below `(1 + ε)^1000 < 1 + 2⁻⁴⁰`. A product
//! that underflows is off by `2⁻¹⁰⁷⁴` or so instead, ten of them a step at most, and the argument
//! likewise, which moves the polynomial by `D · 2⁻¹⁰⁷⁴`.

use crate::double_double::UNIT;

/// Covers the roundings of the bounds themselves and the factors `1 + ε` that they drop.
const WIDENING: f64 = 1.0 + 1.0 / (1_u64 << 40) as f64;

/// More than anything lost to underflow in one step: `2⁻¹⁰⁶⁰`.
const UNDERFLOW: f64 = f64::MIN_POSITIVE / (1_u64 << 38) as f64;

/// Heads are not scaled below this, `2⁻⁹⁶⁰`, where their grid is still far from underflow.
const SMALLEST_HEAD: f64 = f64::MIN_POSITIVE * (1_u64 << 62) as f64;

/// The powers of two that the text above speaks of.
const _: () = {
    assert!(WIDENING.to_bits() == 1_f64.to_bits() + (1 << 12));
    assert!(UNDERFLOW.to_bits() == 1 << (1074 - 1060));
    assert!(SMALLEST_HEAD.to_bits() == (1023 - 960) << 52);
};

/// Magnitudes of the coefficients of a piece, all rows padded to one degree.
pub(crate) struct Magnitudes {
    /// `|low_k| r^k`.
    low: Vec<f64>,
    /// A bound on `|u|`.
    reach: f64,
    /// `S_k = Σ_{j≥k} |c_j| r^{j−k}`, the sizes of Horner's intermediate values.
    sizes: Vec<f64>,
    /// `T_k` for `k = 0 … n`.
    tails: Vec<f64>,
    /// `Σ k (|c_k| + |low_k|)`.
    derivative: f64,
    /// `Σ k (k−1) (|c_k| + |low_k|)`.
    second_derivative: f64,
    /// Whether `u` is exact for every double of the piece.
    exact_argument: bool,
}

/// `Σ_k factor(k) |a_k|`.
fn weighted(values: &[f64], factor: impl Fn(f64) -> f64) -> f64 {
    values.iter().enumerate().map(|(k, value)| factor(k as f64) * value.abs()).sum()
}

/// `Σ_{k<n} T_k + Σ_{1≤k≤n} T_k` of a polynomial with the given tails, 0 of a constant.
fn horner_roundings(tails: &[f64]) -> f64 {
    match tails {
        [] | [_] => 0.0,
        [_, middle @ .., last] => tails[0] + 2.0 * middle.iter().sum::<f64>() + last,
    }
}

impl Magnitudes {
    /// Of coefficients `c_0 … c_n` (at least one) with low parts of the first ones, for `|u| ≤ reach`.
    pub(crate) fn new(coefficients: &[f64], low: &[f64], reach: f64, exact_argument: bool) -> Self {
        let scaled = |values: &[f64]| -> Vec<f64> {
            let powers = std::iter::successors(Some(1.0), |power| Some(power * reach));
            values.iter().zip(powers).map(|(value, power)| value.abs() * power).collect()
        };
        let mut sizes: Vec<f64> = coefficients.iter().map(|value| value.abs()).collect();
        for k in (1..sizes.len()).rev() {
            sizes[k - 1] += reach * sizes[k];
        }
        let (coefficients, low) = (scaled(coefficients), scaled(low));
        let mut tails = coefficients.clone();
        for k in (1..tails.len()).rev() {
            tails[k - 1] += tails[k];
        }
        let derivative = weighted(&coefficients, |k| k) + weighted(&low, |k| k);
        let twice = |k: f64| k * (k - 1.0);
        let second_derivative = weighted(&coefficients, twice) + weighted(&low, twice);
        Self { low, reach, sizes, tails, derivative, second_derivative, exact_argument }
    }

    /// `T_0 ≥ |p|`.
    pub(crate) fn total(&self) -> f64 {
        self.tails[0]
    }

    /// Whether the polynomial is 0, and computed as 0.
    fn is_zero(&self) -> bool {
        self.total() == 0.0 && self.low.iter().all(|&low| low == 0.0)
    }

    fn underflow(&self) -> f64 {
        UNDERFLOW * (self.tails.len() as f64 + 1.0 + self.derivative)
    }

    /// `|computed − f|` in doubles, for `|p − f| ≤ error`.
    pub(crate) fn of_doubles(&self, error: f64) -> f64 {
        if self.is_zero() {
            return error;
        }
        let argument = if self.exact_argument { 0.0 } else { self.derivative };
        let rounding = UNIT * (horner_roundings(&self.tails) + argument);
        (error + weighted(&self.low, |_| 1.0) + rounding + self.underflow()) * WIDENING
    }

    /// What is lost where neither pairs nor low parts begin before `split`.
    fn above(&self, split: usize) -> f64 {
        let low = self.low.get(split..).unwrap_or(&[]);
        let tails = self.tails.get(split..).unwrap_or(&[]);
        UNIT * horner_roundings(tails) + weighted(low, |_| 1.0)
    }

    /// The least number of pairs of doubles such that the doubles before them cost `allowed` at
    /// most.
    pub(crate) fn split(&self, allowed: f64) -> usize {
        let length = self.tails.len();
        (0..length).find(|&split| self.above(split) <= allowed).unwrap_or(length)
    }

    /// `M`, a power of two larger than all of Horner's intermediate values from `split` on
    /// downwards.
    pub(crate) fn largest_head(&self, split: usize) -> f64 {
        let largest = self.sizes[..split].iter().copied().fold(SMALLEST_HEAD, f64::max) * WIDENING;
        2.0 * f64::from_bits(largest.to_bits() & f64::INFINITY.to_bits())
    }

    /// `|computed − f|` in pairs of doubles with the low parts `low'_k`, for `|p − f| ≤ error`, and
    /// `2 ε² (T_0 + λ)` more, which is what the rounding test `high + (low ± bound)` rounds away.
    pub(crate) fn of_pairs(&self, low: &[f64], error: f64) -> f64 {
        if self.is_zero() {
            return error;
        }
        let split = low.len();
        let half_grid = 2.0 * UNIT * self.largest_head(split);
        let (mut size, mut rounding) = (0.0, 0.0);
        for (k, low) in low.iter().enumerate().rev() {
            let rest = half_grid + UNIT * self.sizes.get(k + 1).copied().unwrap_or(0.0);
            size = self.reach * size + rest + low.abs();
            rounding = self.reach * rounding + UNIT * (rest + 2.0 * size + low.abs());
        }
        rounding += self.above(split);
        if !self.exact_argument {
            let low = weighted(&self.low, |k| k) + weighted(low, |k| k);
            let steps = 2.0 * self.tails.len() as f64;
            rounding += UNIT * low + 2.0 * UNIT * size;
            rounding += UNIT * UNIT * (steps * (self.derivative + low) + self.second_derivative);
        }
        let test = 2.0 * UNIT * UNIT * (self.total() + size);
        (error + rounding + test + self.underflow()) * WIDENING
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the sums that the definition states.
    #[test]
    fn tails_are_counted_as_often_as_they_are_rounded() {
        let tails = [1.0, 2.0, 4.0, 8.0, 16.0];
        for n in 1..tails.len() {
            let stated: f64 = tails[..n].iter().sum::<f64>() + tails[1..=n].iter().sum::<f64>();
            assert_eq!(horner_roundings(&tails[..=n]), stated, "{n}");
        }
        assert_eq!(horner_roundings(&tails[..1]), 0.0);
    }

    /// All magnitudes of one polynomial, counted by hand: `1 − 2 u + 4 u² + 8 u³` for `|u| ≤ 1/2`.
    #[test]
    fn magnitudes_are_those_of_the_definitions() {
        let low = [1e-20, 0.0, -4e-20];
        let own = Magnitudes::new(&[1.0, -2.0, 4.0, 8.0], &low, 0.5, false);
        // c_k r^k = 1, 1, 1, 1 and low_k r^k = 1e-20, 0, 1e-20
        assert_eq!((own.total(), &own.tails[..]), (4.0, &[4.0, 3.0, 2.0, 1.0][..]));
        assert_eq!(own.sizes, [4.0, 6.0, 8.0, 8.0]);
        assert_eq!((own.derivative, own.second_derivative), (6.0 + 2e-20, 8.0 + 2e-20));
        assert_eq!(own.underflow(), UNDERFLOW * (4.0 + 1.0 + 6.0));
        let near = |bound: f64, stated: f64| {
            assert!(bound >= stated && bound <= stated * (1.0 + 1e-11), "{bound:e}, {stated:e}");
        };
        near(own.of_doubles(1e-16), 1e-16 + 2e-20 + UNIT * (9.0 + 6.0 + 6.0));
        let exact = Magnitudes::new(&[1.0, -2.0, 4.0, 8.0], &low, 0.5, true);
        near(exact.of_doubles(0.0), 2e-20 + UNIT * (9.0 + 6.0));
        assert_eq!(
            [own.largest_head(1), own.largest_head(2), own.largest_head(4)],
            [8.0, 8.0, 16.0]
        );
        let allowed = [UNIT * 15.0 + 2e-20, UNIT * 8.0 + 1e-20, UNIT * 3.0 + 1e-20, 0.0];
        for (split, allowed) in allowed.into_iter().enumerate() {
            assert_eq!(own.split(allowed), split, "{allowed:e}");
        }
        // Two pairs, whose grid is 16 ε: ρ₁ = 16 ε + 8 ε and ρ₀ = 16 ε + 6 ε, with λ₁ = ρ₁ and λ₀ = ρ₁/2 + ρ₀.
        let (first, second) = (24.0 * UNIT, 22.0 * UNIT);
        let size = first / 2.0 + second;
        let rounding = (3.0 * first / 2.0 + second + 2.0 * size) * UNIT + 3.0 * UNIT + 1e-20;
        let test = 2.0 * UNIT * UNIT * (4.0 + size);
        near(exact.of_pairs(&[0.0, 0.0], 0.0), rounding + test);
        let moved =
            UNIT * 2e-20 + 2.0 * UNIT * size + UNIT * UNIT * (8.0 * (6.0 + 2e-20) + 8.0 + 2e-20);
        near(own.of_pairs(&[0.0, 0.0], 1e-25), 1e-25 + rounding + test + moved);
    }

    /// Where all coefficients are pairs, nothing but squares of `ε` is left: `1 − 2 u + 4 u²` with low parts `3 ε`, `2 ε`, `ε`,
    /// for `|u| ≤ 1/2`.
    #[test]
    fn pairs_count_squares() {
        let own = Magnitudes::new(&[1.0, -2.0, 4.0], &[0.0, 2e-17], 0.5, false);
        assert_eq!((&own.sizes[..], own.largest_head(3)), (&[3.0, 4.0, 4.0][..], 8.0));
        let low = [3.0 * UNIT, 2.0 * UNIT, UNIT];
        let (mut size, mut rounding) = (0.0, 0.0);
        // The grid is 16 ε, and Horner's value before each step at most 0, 4 and 4.
        for (rest, low) in [(16.0, 1.0), (20.0, 2.0), (20.0, 3.0)] {
            size = size / 2.0 + rest + low;
            rounding = rounding / 2.0 + rest + 2.0 * size + low;
        }
        let (total, derivative, second_derivative) = (3.0, 3.0, 2.0);
        let in_units = 1e-17 / UNIT + 2.0 + 2.0;
        let moved = in_units + 2.0 * size + 6.0 * derivative + second_derivative;
        let stated = UNIT * UNIT * (rounding + moved + 2.0 * total);
        let bound = own.of_pairs(&low, 0.0);
        assert!(bound >= stated && bound <= stated * (1.0 + 1e-11), "{bound:e}, {stated:e}");
    }

    /// Next to the smallest doubles only what underflows is left.
    #[test]
    fn what_underflows_counts() {
        let own = Magnitudes::new(&[0.0, 5e-324], &[], 1.0, true);
        for bound in [own.of_doubles(0.0), own.of_pairs(&[0.0, 0.0], 0.0)] {
            assert!(bound >= 3.0 * UNDERFLOW, "{bound:e}");
        }
    }
}
