//! The steps of a recurrence as a system that doubles can march through, with periods as the unit of
//! time.
//!
//! A step `w' − λ w = Σ (d v' + c v)` is taken by its state `z = w − Σ d v`, in which no derivative is
//! left: `z' = λ z + Σ (c + λ d) v`. Where the continuous form is `w − Σ κ v`, the state jumps by
//! `Σ (κ − d) [v]`, with `[v]` the jumps of what it holds. All these numbers are worked out in balls and
//! rounded once, so that what is zero is zero. A function of time that acts from outside becomes waves,
//! too: `m_j' = λ m_j + m_{j−1}` is solved by `e^{λx} x^j/j!`.

use super::MethodError;
use super::clock::Clock;
use crate::ball::{Ball, ComplexBall};
use crate::enclosure::{EnclosureError, Numbers};
use crate::expression::{Field as _, Fraction, Transform};
use crate::recurrence::{Recurrence, WaveIndex};
use crate::solution::{FieldForm, FieldStep};
use std::collections::BTreeMap;
use wavestep_kernels::march::{Complex, Scalar as _, State, Term, WaveStep, WaveSystem};

/// Bits of the balls that are rounded.
pub(super) const BITS: u64 = 256;

/// Weights by wave and lag.
type Weights = BTreeMap<(WaveIndex, usize), ComplexBall>;

/// Steps in the making.
pub(super) struct SystemBuilder<'a> {
    numbers: &'a Numbers,
    period: ComplexBall,
    /// The waves of the recurrence; those that stand for functions of time come after them.
    count: usize,
    /// `m_0, m_1 …` of each pole.
    sources: BTreeMap<Fraction, Vec<WaveIndex>>,
    /// Their steps: functions of time follow from themselves alone, and come first.
    source_steps: Vec<WaveStep<Complex>>,
    steps: Vec<WaveStep<Complex>>,
}

impl<'a> SystemBuilder<'a> {
    /// The steps of a recurrence without symbols, in the periods of a clock.
    pub fn new(
        recurrence: &Recurrence,
        clock: &'a Clock,
    ) -> Result<SystemBuilder<'a>, MethodError> {
        let numbers = &clock.numbers;
        let field = numbers.field(BITS);
        let period = field.embed(&clock.period.clone().into())?;
        let mut builder = SystemBuilder {
            numbers,
            period,
            count: recurrence.wave_count(),
            sources: BTreeMap::new(),
            source_steps: Vec::new(),
            steps: Vec::new(),
        };
        for step in FieldStep::all(recurrence, &field)? {
            let step = builder.step(&step)?;
            builder.steps.push(step);
        }
        Ok(builder)
    }

    /// The system; nothing can be added any more.
    pub fn build(self) -> Result<WaveSystem<Complex>, MethodError> {
        let steps = self.source_steps.into_iter().chain(self.steps).collect();
        Ok(WaveSystem::new(steps)?)
    }

    /// A function of time by waves, each with its weight.
    pub fn source(
        &mut self,
        function: &Transform<ComplexBall>,
    ) -> Result<Vec<(WaveIndex, ComplexBall)>, EnclosureError> {
        let field = self.numbers.field(BITS);
        let mut found = Vec::new();
        for (pole, coefficients) in function.poles() {
            let rate = field.embed(&pole.clone().into())?.multiply(&self.period, BITS);
            let rate = nearest(&rate);
            let known = self.sources.entry(pole.clone()).or_default();
            while known.len() < coefficients.len() {
                let wave = self.count;
                self.count += 1;
                let before = known.last().map(|m| Term { wave: *m, lag: 0, weight: Complex::ONE });
                let initial = if before.is_none() { Complex::ONE } else { Complex::ZERO };
                let drive = before.into_iter().collect();
                let state = Some(State { rate, drive, jumps: Vec::new(), initial });
                let step = WaveStep { wave, values: Vec::new(), slopes: Vec::new(), state };
                self.source_steps.push(step);
                known.push(wave);
            }
            // In periods the j-th is smaller by the j-th power of the period.
            let mut scale = ComplexBall::one();
            for (wave, coefficient) in known.iter().zip(coefficients) {
                found.push((*wave, coefficient.multiply(&scale, BITS)));
                scale = scale.multiply(&self.period, BITS);
            }
        }
        Ok(found)
    }

    fn step(&mut self, step: &FieldStep<ComplexBall>) -> Result<WaveStep<Complex>, EnclosureError> {
        let field = self.numbers.field(BITS);
        let FieldStep { wave, equation, start } = step;
        let forcing = self.forcing(equation)?;
        let (mut values, mut slopes) = (Weights::new(), Weights::new());
        let Some((pole, continuous, initial)) = start else {
            values.extend(forcing);
            let inverse = self.period.reciprocal(BITS)?;
            for term in &equation.terms {
                let place = (term.wave, term.lag);
                if let Some(value) = &term.value {
                    add(&mut values, place, value);
                }
                if let Some(slope) = &term.slope {
                    add(&mut slopes, place, &slope.multiply(&inverse, BITS));
                }
            }
            let (values, slopes) = (rounded(&values), rounded(&slopes));
            return Ok(WaveStep { wave: *wave, values, slopes, state: None });
        };
        let rate = field.embed(&pole.clone().into())?;
        let mut drive = forcing;
        let mut jumps: Weights = self.forcing(continuous)?;
        for term in &equation.terms {
            let place = (term.wave, term.lag);
            if let Some(value) = &term.value {
                add(&mut drive, place, value);
            }
            if let Some(slope) = &term.slope {
                add(&mut drive, place, &slope.multiply(&rate, BITS));
                add(&mut jumps, place, &slope.clone().negate());
                add(&mut values, place, slope);
            }
        }
        for term in &continuous.terms {
            if let Some(value) = &term.value {
                add(&mut jumps, (term.wave, term.lag), value);
            }
        }
        for weight in drive.values_mut() {
            *weight = weight.multiply(&self.period, BITS);
        }
        let state = State {
            rate: nearest(&rate.multiply(&self.period, BITS)),
            drive: rounded(&drive),
            jumps: rounded(&jumps),
            initial: nearest(initial),
        };
        Ok(WaveStep {
            wave: *wave,
            values: rounded(&values),
            slopes: Vec::new(),
            state: Some(state),
        })
    }

    /// What acts from outside, by waves.
    fn forcing(&mut self, form: &FieldForm<ComplexBall>) -> Result<Weights, EnclosureError> {
        let mut weights = Weights::new();
        for (lag, function) in &form.forcing {
            for (wave, weight) in self.source(function)? {
                add(&mut weights, (wave, *lag), &weight);
            }
        }
        Ok(weights)
    }
}

fn add(weights: &mut Weights, place: (WaveIndex, usize), weight: &ComplexBall) {
    let sum = weights.entry(place).or_insert_with(ComplexBall::zero);
    *sum = sum.add(weight, BITS);
}

/// The weights that are not zero.
fn rounded(weights: &Weights) -> Vec<Term<Complex>> {
    let terms = weights.iter().map(|((wave, lag), weight)| {
        let (wave, lag, weight) = (*wave, *lag, nearest(weight));
        Term { wave, lag, weight }
    });
    terms.filter(|term| term.weight != Complex::ZERO).collect()
}

/// The nearest doubles. What may be zero to so many bits is zero.
pub(super) fn nearest(value: &ComplexBall) -> Complex {
    let part = |part: &Ball| if part.contains_zero() { 0.0 } else { part.to_double().0 };
    Complex { re: part(value.real()), im: part(value.imaginary()) }
}
