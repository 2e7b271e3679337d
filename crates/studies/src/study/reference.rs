//! Times drawn by a seed, and values there that are far finer than doubles.

use wavestep::answer::Question;
use wavestep::ball::{Attempt, Precisions};
use wavestep::signal::{At, EvaluateError, Limit};
use wavestep_polynomial::Rational;

/// The bits of balls tried first, and the most.
const FIRST_BITS: u64 = 192;
const MAX_BITS: u64 = 1 << 14;

/// The radius of references that is aimed at, in parts of the largest value: `2^−100`.
const FINENESS: f64 = 1.0 / (1_u128 << 100) as f64;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Sampling {
    pub points: usize,
    pub seed: u64,
}

impl Sampling {
    /// Ascending times from one time to another: one in each of equal parts, uniform there.
    pub fn times(&self, from: f64, to: f64) -> Vec<f64> {
        let mut state = self.seed;
        let width = (to - from) / self.points.max(1) as f64;
        let draw = |i: usize| {
            let share = (split_mix(&mut state) >> 11) as f64 / (1_u64 << 53) as f64;
            (from + width * (i as f64 + share)).clamp(from, to)
        };
        (0..self.points).map(draw).collect()
    }

    pub fn law(&self) -> String {
        format!("{} times, one in each of equal parts of the window, uniform there", self.points)
    }
}

/// The generator SplitMix64 (Steele, Lea and Flood 2014): 64 bits from a counter.
fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Values at times, as sums of two doubles.
#[derive(Clone, PartialEq, Debug)]
pub struct Reference {
    times: Vec<f64>,
    values: Vec<(f64, f64)>,
    scale: f64,
    radius: f64,
}

impl Reference {
    /// The values of a question, just after arrivals.
    pub fn new(question: &Question<'_>, times: &[f64]) -> Result<Reference, EvaluateError> {
        let signal = &*question.signal;
        let scale = question.scale()?;
        let mut values = Vec::with_capacity(times.len());
        let mut radius = 0.0_f64;
        // Bits that did once do again, and more are needed for later times.
        let mut bits = FIRST_BITS;
        for time in times {
            let at = Rational::from_float(*time).ok_or(EvaluateError::AfterLast)?;
            let stretch = signal.stretch_at(&at, Limit::Right)?.ok_or(EvaluateError::AfterLast)?;
            let precisions = Precisions::doubling(bits, MAX_BITS);
            let attempt = |more| {
                bits = more;
                let told = signal.enclose(stretch, 0, At::Time(&at), bits)?.two_doubles();
                Ok::<_, EvaluateError>(Attempt::of(told, told.2 <= FINENESS * scale))
            };
            let (high, low, distance) = precisions.raise(attempt)?.best();
            values.push((high, low));
            radius = radius.max(distance);
        }
        let largest = values.iter().map(|(high, _)| high.abs()).fold(0.0, f64::max);
        Ok(Reference { times: times.to_vec(), values, scale: scale.max(largest), radius })
    }

    pub fn times(&self) -> &[f64] {
        &self.times
    }

    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// What errors are told in parts of: the largest value, or 1 where all are zero.
    pub(crate) fn unit(&self) -> f64 {
        if self.scale == 0.0 { 1.0 } else { self.scale }
    }

    pub(crate) fn sizes(&self) -> Vec<f64> {
        self.values.iter().map(|(high, _)| high.abs() / self.unit()).collect()
    }

    /// How far off values can be, in parts of the largest.
    pub fn radius(&self) -> f64 {
        self.radius / self.unit()
    }

    /// `|computed − reference|` in parts of the largest value, at all times or the first ones; infinite
    /// for what is no number.
    pub fn errors(&self, computed: &[f64]) -> Vec<f64> {
        assert!(computed.len() <= self.values.len(), "one value a time");
        let error = |(value, (high, low)): (&f64, &(f64, f64))| match value.is_finite() {
            true => ((value - high) - low).abs() / self.unit(),
            false => f64::INFINITY,
        };
        computed.iter().zip(&self.values).map(error).collect()
    }
}
