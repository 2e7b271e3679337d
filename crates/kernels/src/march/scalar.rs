//! One wave, period by period.
//!
//! With `v_n = y_n − ρ y_{n−1}` the recurrence `y_n' + B y_n = ρ (y_{n−1}' − A y_{n−1})` becomes
//! `v_n' + B v_n = −C y_{n−1}`, `C = ρ (A + B)`: the derivative of the older wave cancels. The jump
//! of `Y` at the time `n` is `ρⁿ`, so `V = Y − ρ q Y` jumps at the time 0 only, by 1: `v_0(0) = 1`
//! and `v_n(0) = v_{n−1}(1)`.
//!
//! Every front carries a chirp like `J_0(2√(2nBx))`, so the number of coefficients has to grow with
//! `n`: with a fixed one the answer becomes wrong without a sign. Here a period takes as many
//! coefficients as lie above a threshold. High coefficients are computed from their neighbours,
//! which are as small, so their relative errors stay small and no level of noise hides the decay.

use super::bound::Certificate;
use super::chebyshev;
use super::error::MarchError;
use super::reflection::Reflection;
use super::relaxation::Relaxation;
use crate::lanes::{Lanes, WIDTH, padded};
use crate::vector::{Work, widest};

/// Whether a march proves bounds as it goes, at some two or three times the cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bounds {
    /// No bounds: values only.
    None,
    /// A [`Certificate`] follows the march.
    #[default]
    Proven,
}

/// The share of a wrong jump that the next period takes back. The rounding of the ends would let
/// the jumps drift from `ρⁿ`, by `2·10⁻¹²` after 10⁵ periods. A small share averages over what the
/// jump itself is measured with.
const RESTORE: f64 = 1.0 / 64.0;

/// How a march is run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarchOptions {
    /// Whether bounds are proven.
    pub bounds: Bounds,
    /// Trailing coefficients at most this large are dropped; relative to the largest coefficient
    /// where that is above 1. What is dropped is part of the proven bound.
    pub threshold: f64,
    /// The most coefficients that a period may take, below 2²⁰.
    pub limit: usize,
}

impl Default for MarchOptions {
    /// Proven bounds, a threshold of `2⁻⁶⁶`, at most 65536 coefficients.
    fn default() -> MarchOptions {
        MarchOptions { bounds: Bounds::Proven, threshold: 2f64.powi(-66), limit: 1 << 16 }
    }
}

/// The wave of a [`Reflection`] on the current period, as Chebyshev coefficients on `[0, 1]`.
///
/// # Invariants
/// At least one coefficient and at most the limit; all of them finite.
pub struct March {
    ratio: f64,
    options: MarchOptions,
    period: usize,
    /// `y_n`.
    wave: Vec<f64>,
    /// `v_n = y_n − ρ y_{n−1}`.
    increment: Vec<f64>,
    /// `v_n(1)`.
    end: f64,
    /// `e^{−B}`.
    decay_end: f64,
    /// `y_n(1)`, the jump `ρⁿ` that `Y` has at `n`, and what the computed jump has beyond it.
    wave_end: f64,
    front: f64,
    drift: f64,
    largest: f64,
    step: Relaxation<f64>,
    certificate: Option<Certificate>,
    failed: Option<MarchError>,
}

impl March {
    /// The march on its first period, 0, where `y_0 = e^{−Bx}`. O(√B).
    pub fn new(reflection: &Reflection, options: MarchOptions) -> Result<March, MarchError> {
        let threshold = options.threshold;
        if !(threshold.is_finite() && threshold > 0.0 && (1..1 << 20).contains(&options.limit)) {
            return Err(MarchError::Options);
        }
        let (rate, ratio) = (reflection.rate.value, reflection.ratio.value);
        // e^{−Bx} takes more than √B coefficients: refused before the factors are made.
        if rate.sqrt() > options.limit as f64 {
            return Err(MarchError::TooManyCoefficients { period: 0, limit: options.limit });
        }
        let coupling = ratio * (reflection.zero.value + rate);
        let step = Relaxation::new(rate, coupling);
        let mut increment = step.decay().to_vec();
        trim(&mut increment, threshold);
        let wave_end = widest(Sums(&increment)).1;
        let mut march = March {
            ratio,
            options,
            period: 0,
            wave: increment.clone(),
            end: wave_end,
            decay_end: widest(Sums(step.decay())).1,
            wave_end,
            front: 1.0,
            drift: 0.0,
            increment,
            largest: 1.0,
            step,
            certificate: (options.bounds == Bounds::Proven).then(|| Certificate::new(reflection)),
            failed: None,
        };
        march.check()?;
        if let Some(certificate) = &mut march.certificate {
            certificate.record(&march.increment, &march.wave);
        }
        Ok(march)
    }

    /// The number of the current period. O(1).
    pub fn period(&self) -> usize {
        self.period
    }

    /// The Chebyshev coefficients of `y_n` on the current period. O(1).
    pub fn coefficients(&self) -> &[f64] {
        &self.wave
    }

    /// The Chebyshev coefficients of `v_n = y_n − ρ y_{n−1}`, the part without jumps. O(1).
    pub fn increment(&self) -> &[f64] {
        &self.increment
    }

    /// Moves on by one period. O(N), N the number of coefficients, about
    /// `z + 4 z^{1/3} + 40`, `z = √(2nB)`, for the rigid mass.
    ///
    /// After an error every later call fails in the same way, and nothing is proven any more.
    pub fn advance(&mut self) -> Result<(), MarchError> {
        if let Some(error) = self.failed {
            return Err(error);
        }
        widest(Advance(self))
    }

    #[inline(always)]
    fn step<L: Lanes>(&mut self) -> Result<(), MarchError> {
        self.period += 1;
        let before = self.end - RESTORE * self.ratio * self.drift;
        let March { wave, increment, step, .. } = self;
        step.particular(wave, increment);
        // v = particular + (v(0) − particular(0)) e^{−Bx}.
        let (left, right) = sums::<L>(increment);
        let start = before - left;
        let mut end = right + start * self.decay_end;
        // The particular solution behind its last place, where it has no right side.
        for k in increment.len()..step.decay().len() {
            let next = -step.ratio(k) * increment[k - 1];
            increment.push(next);
            end += next;
        }
        for (to, decay) in increment.iter_mut().zip(step.decay()) {
            *to += start * decay;
        }
        let threshold = self.options.threshold * self.largest;
        for k in increment.len()..=self.options.limit {
            let last = increment[k - 1];
            // Not-a-number ends the loop as well, and is reported below.
            if last.abs() <= 0.125 * threshold || last.is_nan() {
                break;
            }
            let next = -step.ratio(k) * last;
            increment.push(next);
            end += next;
        }
        self.end = end;
        wave.resize(increment.len(), 0.0);
        let largest = advance_wave::<L>(self.ratio, wave, increment);
        trim(wave, threshold);
        let (left, right) = sums::<L>(wave);
        self.front *= self.ratio;
        self.drift = left - self.wave_end - self.front;
        self.wave_end = right;
        self.largest = if largest < 1.0 { 1.0 } else { largest };
        self.failed = self.check().err();
        match (self.failed, &mut self.certificate) {
            (Some(error), _) => return Err(error),
            (None, Some(certificate)) => certificate.take::<L>(&self.increment, &self.wave),
            (None, None) => {}
        }
        Ok(())
    }

    /// The checks at the end of a step.
    fn check(&self) -> Result<(), MarchError> {
        let (period, limit) = (self.period, self.options.limit);
        if !(self.largest.is_finite() && self.end.is_finite()) {
            return Err(MarchError::NotFinite { period });
        }
        if self.wave.len() > limit {
            return Err(MarchError::TooManyCoefficients { period, limit });
        }
        Ok(())
    }

    /// `y_n(x)`, `x` in `[0, 1]` the time since the period's beginning, in periods. O(N).
    pub fn value(&self, x: f64) -> f64 {
        chebyshev::value(&self.wave, x)
    }

    /// `y_n` at all `points` of `[0, 1]` into `values`; faster than one by one. O(N · points).
    pub fn values(&self, points: &[f64], values: &mut [f64]) {
        chebyshev::values(&self.wave, points, values);
    }

    /// How far [`March::value`] can be from the true wave anywhere on this period, the rounding of
    /// the evaluation included; `None` where nothing is proven. O(N).
    pub fn bound(&self) -> Option<f64> {
        self.certificate.as_ref()?;
        self.bound_by(&chebyshev::sizes(&self.wave))
    }

    /// The same from the sizes of the coefficients, where these are known already. O(1).
    pub fn bound_by(&self, sizes: &chebyshev::Sizes) -> Option<f64> {
        if self.failed.is_some() {
            return None;
        }
        let bound = self.certificate.as_ref()?.bound()?;
        Some((bound + sizes.evaluation_error()).next_up())
    }
}

/// One period further.
struct Advance<'a>(&'a mut March);

impl Work for Advance<'_> {
    type Output = Result<(), MarchError>;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Result<(), MarchError> {
        self.0.step::<L>()
    }
}

/// Drops trailing coefficients up to the threshold; one always stays.
#[inline(always)]
fn trim(coefficients: &mut Vec<f64>, threshold: f64) {
    let kept = coefficients.iter().rposition(|c| c.abs() > threshold || c.is_nan()).unwrap_or(0);
    coefficients.truncate(kept + 1);
}

/// The values of a series at both ends.
struct Sums<'a>(&'a [f64]);

impl Work for Sums<'_> {
    type Output = (f64, f64);

    #[inline(always)]
    fn run<L: Lanes>(self) -> (f64, f64) {
        sums::<L>(self.0)
    }
}

#[inline(always)]
fn sums<L: Lanes>(coefficients: &[f64]) -> (f64, f64) {
    let mut sums = L::splat(0.0);
    let (groups, rest) = coefficients.as_chunks();
    for group in groups.iter().chain([&padded(rest)]) {
        sums = sums + L::from_array(*group);
    }
    let [a, b, c, d, e, f, g, h] = sums.to_array();
    let (even, odd) = ((a + e) + (c + g), (b + f) + (d + h));
    (even - odd, even + odd)
}

/// `w ← ρ w + u`, both of one length; gives the largest absolute value, or not-a-number if one of them is
/// not finite.
#[inline(always)]
fn advance_wave<L: Lanes>(ratio: f64, wave: &mut [f64], increment: &[f64]) -> f64 {
    let (mut largest, mut zeros) = (L::splat(0.0), L::splat(0.0));
    let whole = increment.len() / WIDTH * WIDTH;
    let mut last = padded(&wave[whole..increment.len()]);
    let last_added = padded(&increment[whole..]);
    let groups = wave[..whole].as_chunks_mut().0.iter_mut().chain([&mut last]);
    for (group, added) in groups.zip(increment.as_chunks().0.iter().chain([&last_added])) {
        let new = L::splat(ratio) * L::from_array(*group) + L::from_array(*added);
        largest = largest.greater(new.abs());
        // What is not finite times 0 is no number, and stays so in a sum.
        zeros = zeros + new * L::splat(0.0);
        *group = new.to_array();
    }
    wave[whole..increment.len()].copy_from_slice(&last[..increment.len() - whole]);
    largest.to_array().into_iter().fold(0.0, f64::max) + zeros.sum()
}
