//! Several waves with several poles and lags, period by period on Chebyshev coefficients.
//!
//! Each period is cut into equal spans so short that no pole turns by more than about 1 on a span. On
//! each span every wave is a polynomial whose degree follows what it has to hold: what is `2^−66` of the
//! largest coefficient of that wave so far is dropped. Only as many periods are kept as the largest lag
//! needs. Nothing is proven of the results: they are compared with exact ones, in the tests.

use super::chebyshev;
use super::error::MarchError;
use super::number::{Complex, Scalar};
use super::relaxation::{Relaxation, differentiate, value_at_one, value_at_zero};
use super::system::{State, Term, WaveStep, WaveSystem};
use std::borrow::Cow;
use std::collections::VecDeque;

/// Trailing coefficients of this size are dropped, relative to the largest of a wave so far.
const THRESHOLD: f64 = 1.0 / (1u128 << 66) as f64;

/// The most spans of a period.
const MAX_SPANS: usize = 1 << 12;

/// The most coefficients of a polynomial.
const MAX_COEFFICIENTS: usize = 1 << 13;

/// A wave on a period.
struct Piece<T> {
    /// The coefficients, span by span.
    spans: Vec<Vec<T>>,
    /// The limits at the ends of the period.
    start: T,
    end: T,
}

/// The waves of a [`WaveSystem`] on the current period.
pub struct WaveMarch<T> {
    system: WaveSystem<T>,
    /// By step, where it has a state: how it is solved on a span, and `z` at the end of the last one.
    states: Vec<Option<(Relaxation<T>, T)>>,
    spans: usize,
    period: usize,
    /// The pieces of this period, then of those before: `kept[lag][wave]`.
    kept: VecDeque<Vec<Piece<T>>>,
    depth: usize,
    /// The largest coefficient of each wave so far.
    largest: Vec<f64>,
    /// About what the roundings of a period amount to in each wave, at most so far.
    noise: Vec<f64>,
    /// Room for one span: what drives a state, the state, and a slope.
    scratch: [Vec<T>; 3],
}

impl<T: Scalar> WaveMarch<T> {
    /// The march on its first period, 0. The cost is that of [`WaveMarch::advance`].
    pub fn new(system: WaveSystem<T>) -> Result<WaveMarch<T>, MarchError> {
        let fastest = system.steps.iter().filter_map(|step| step.state.as_ref());
        let fastest = fastest.map(|state| turning(state.rate)).fold(0.0, f64::max);
        if fastest > MAX_SPANS as f64 {
            return Err(MarchError::TooManySpans { limit: MAX_SPANS });
        }
        // A power of two: places on spans follow from those on periods without rounding.
        let spans = (fastest.ceil() as usize).next_power_of_two();
        let part = T::from(1.0 / spans as f64);
        let state = |step: &WaveStep<T>| {
            let state = step.state.as_ref()?;
            Some((Relaxation::new(-(state.rate * part), -T::ONE), state.initial))
        };
        let mut march = WaveMarch {
            states: system.steps.iter().map(state).collect(),
            spans,
            period: 0,
            kept: VecDeque::new(),
            // A jump needs the end of the period before.
            depth: system.largest_lag() + 2,
            largest: vec![0.0; system.waves()],
            noise: vec![0.0; system.waves()],
            scratch: Default::default(),
            system,
        };
        march.solve()?;
        Ok(march)
    }

    /// The number of the current period.
    pub fn period(&self) -> usize {
        self.period
    }

    /// How many spans a period is cut into.
    pub fn spans(&self) -> usize {
        self.spans
    }

    /// The largest coefficient of a wave so far, its state's included: what its roundings are relative
    /// to.
    pub fn largest(&self, wave: usize) -> f64 {
        self.largest[wave]
    }

    /// About what the roundings of one period amount to in a wave, at most so far: where large parts cancel, they are large
    /// beside what is left.
    pub fn noise(&self, wave: usize) -> f64 {
        self.noise[wave]
    }

    /// Goes on to the next period. O(SMN) for `S` spans, `M` terms and polynomials of degree `N`.
    ///
    /// After an error the march is of no further use.
    pub fn advance(&mut self) -> Result<(), MarchError> {
        self.period += 1;
        self.solve()
    }

    /// The values of a wave at places on the current period, from 0 to 1. O(N) a point.
    pub fn values(&self, wave: usize, points: &[f64]) -> Vec<Complex> {
        let spans = &self.kept[0][wave].spans;
        self.sampled(points, |span| Cow::Borrowed(&spans[span]))
    }

    /// The slopes of a wave by period, as [`WaveMarch::values`].
    pub fn slopes(&self, wave: usize, points: &[f64]) -> Vec<Complex> {
        let spans = &self.kept[0][wave].spans;
        self.sampled(points, |span| {
            let mut slope = Vec::new();
            differentiate(&spans[span], &mut slope);
            let per_period = T::from(self.spans as f64);
            slope.iter_mut().for_each(|c| *c = *c * per_period);
            Cow::Owned(slope)
        })
    }

    /// The values at places of what has these coefficients on the spans.
    fn sampled<'a>(
        &self,
        points: &[f64],
        coefficients: impl Fn(usize) -> Cow<'a, [T]>,
    ) -> Vec<Complex>
    where
        T: 'a,
    {
        let count = self.spans as f64;
        let span_of = |point: f64| ((point * count) as usize).min(self.spans - 1);
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by_key(|place| span_of(points[*place]));
        let mut values = vec![Complex::ZERO; points.len()];
        let (mut local, mut found) = (Vec::new(), Vec::new());
        for group in order.chunk_by(|a, b| span_of(points[*a]) == span_of(points[*b])) {
            let span = span_of(points[group[0]]);
            let coefficients = coefficients(span);
            local.clear();
            local.extend(group.iter().map(|place| points[*place] * count - span as f64));
            found.resize(local.len(), 0.0);
            let parts: [fn(&mut Complex) -> &mut f64; 2] = [|c| &mut c.re, |c| &mut c.im];
            for part in parts {
                let c: Vec<f64> = coefficients.iter().map(|c| *part(&mut c.complex())).collect();
                if c.iter().all(|c| *c == 0.0) {
                    continue;
                }
                chebyshev::values(&c, &local, &mut found);
                let places = group.iter().zip(&found);
                places.for_each(|(place, value)| *part(&mut values[*place]) = *value);
            }
        }
        values
    }

    /// The piece of a wave some periods ago; there is none before the first.
    fn piece(&self, wave: usize, lag: usize) -> Option<&Piece<T>> {
        self.kept.get(lag)?.get(wave)
    }

    /// All waves on the current period, in the order of the steps.
    fn solve(&mut self) -> Result<(), MarchError> {
        self.kept.truncate(self.depth - 1);
        let empty = || Piece { spans: Vec::new(), start: T::ZERO, end: T::ZERO };
        let pieces = (0..self.system.waves()).map(|_| empty()).collect();
        self.kept.push_front(pieces);
        for place in 0..self.system.waves() {
            let mut scratch = std::mem::take(&mut self.scratch);
            let mut state = self.states[place].take();
            let step = &self.system.steps[place];
            let wave = step.wave;
            let solved = self.wave(step, state.as_mut(), self.largest[wave], &mut scratch);
            (self.scratch, self.states[place]) = (scratch, state);
            let (piece, largest) = solved?;
            self.largest[wave] = largest;
            self.noise[wave] = self.noise[wave].max(self.noise_of(place));
            self.kept[0][wave] = piece;
        }
        Ok(())
    }

    /// What the roundings of this period amount to in the wave of a step: its own, and those of the waves of this period that it
    /// is made of. What came from periods before is taken as given.
    fn noise_of(&self, step: usize) -> f64 {
        let step = &self.system.steps[step];
        let sum = |terms: &[Term<T>]| {
            let noise = |term: &Term<T>| {
                let own = f64::EPSILON * self.largest[term.wave];
                let before = if term.lag == 0 { self.noise[term.wave] } else { 0.0 };
                term.weight.size() * own.max(before)
            };
            terms.iter().map(noise).sum::<f64>()
        };
        let state = step.state.as_ref().map_or(0.0, |state| {
            // A decaying state holds what drives it no longer than its rate says.
            let held = (-state.rate.complex().re).max(1.0);
            sum(&state.drive) / held + sum(&state.jumps)
        });
        f64::EPSILON * self.largest[step.wave] + sum(&step.values) + state
    }

    /// A wave on the current period, and its largest coefficient so far.
    fn wave(
        &self,
        step: &WaveStep<T>,
        state: Option<&mut (Relaxation<T>, T)>,
        mut largest: f64,
        [right, z, slope]: &mut [Vec<T>; 3],
    ) -> Result<(Piece<T>, f64), MarchError> {
        let mut state = step.state.as_ref().zip(state);
        if let Some((State { jumps, .. }, (_, end))) = &mut state {
            *end = *end + self.jump(jumps);
        }
        let mut piece =
            Piece { spans: Vec::with_capacity(self.spans), start: T::ZERO, end: T::ZERO };
        // The limits are sums of those of the parts: what is continuous then has no jump at all.
        let mut limits = (state.as_ref().map_or(T::ZERO, |(_, (_, z))| *z), T::ZERO);
        for term in &step.values {
            if let Some(other) = self.piece(term.wave, term.lag) {
                limits.0 = limits.0 + other.start * term.weight;
                limits.1 = limits.1 + other.end * term.weight;
            }
        }
        let per_period = self.spans as f64;
        for span in 0..self.spans {
            let mut coefficients = vec![T::ZERO];
            self.add(&step.values, span, &mut coefficients);
            for term in &step.slopes {
                let Some(other) = self.piece(term.wave, term.lag) else { continue };
                differentiate(&other.spans[span], slope);
                let weight = term.weight * T::from(per_period);
                if span == 0 {
                    limits.0 = limits.0 + value_at_zero(slope) * weight;
                }
                if span + 1 == self.spans {
                    limits.1 = limits.1 + value_at_one(slope) * weight;
                }
                add_scaled(&mut coefficients, slope, weight);
            }
            if let Some((State { drive, .. }, (equation, end))) = &mut state {
                right.clear();
                right.push(T::ZERO);
                self.add(drive, span, right);
                right.iter_mut().for_each(|c| *c = *c / T::from(per_period));
                equation.solve(right, *end, THRESHOLD * largest.max(end.size()), z);
                *end = value_at_one(z);
                add_scaled(&mut coefficients, z, T::ONE);
            }
            // Where parts cancel, their roundings are the noise.
            let sizes = coefficients.iter().chain(z.iter().filter(|_| state.is_some()));
            for size in sizes.map(|c| c.size()) {
                if !size.is_finite() {
                    return Err(MarchError::Overflow { period: self.period });
                }
                largest = largest.max(size);
            }
            while coefficients.len() > 1
                && coefficients.last().is_some_and(|c| c.size() <= THRESHOLD * largest)
            {
                coefficients.pop();
            }
            if coefficients.len() > MAX_COEFFICIENTS {
                let (period, limit) = (self.period, MAX_COEFFICIENTS);
                return Err(MarchError::TooManyTerms { period, limit });
            }
            piece.spans.push(coefficients);
        }
        if let Some((_, (_, end))) = &state {
            limits.1 = limits.1 + *end;
        }
        (piece.start, piece.end) = limits;
        Ok((piece, largest))
    }

    /// By how much a state jumps at the start of the current period.
    fn jump(&self, jumps: &[Term<T>]) -> T {
        let mut sum = T::ZERO;
        for term in jumps {
            let start = self.piece(term.wave, term.lag).map_or(T::ZERO, |piece| piece.start);
            let end = self.piece(term.wave, term.lag + 1).map_or(T::ZERO, |piece| piece.end);
            sum = sum + (start - end) * term.weight;
        }
        sum
    }

    /// Adds pieces on a span of the current period.
    fn add(&self, terms: &[Term<T>], span: usize, sum: &mut Vec<T>) {
        for term in terms {
            if let Some(piece) = self.piece(term.wave, term.lag) {
                add_scaled(sum, &piece.spans[span], term.weight);
            }
        }
    }
}

/// How many spans of a period a pole needs. Decay needs none: its polynomials are as short.
fn turning<T: Scalar>(rate: T) -> f64 {
    let Complex { re, im } = rate.complex();
    im.abs().max(if re > 0.0 { rate.size() } else { 0.0 })
}

/// `sum += other · weight`.
fn add_scaled<T: Scalar>(sum: &mut Vec<T>, other: &[T], weight: T) {
    if sum.len() < other.len() {
        sum.resize(other.len(), T::ZERO);
    }
    for (sum, other) in sum.iter_mut().zip(other) {
        *sum = *sum + *other * weight;
    }
}
