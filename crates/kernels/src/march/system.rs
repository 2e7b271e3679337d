//! A system of waves that drive each other with delays of whole periods.
//!
//! Time is counted in periods. On the `n`-th period, with `x` from 0 to 1, each wave is a sum of earlier
//! pieces, of their derivatives, and of a state of its own that obeys a differential equation of first
//! order:
//!
//! ```text
//! w[n] = z[n] + Σ value · v[n−lag] + Σ slope · v'[n−lag],     z[n]' = λ z[n] + Σ drive · v[n−lag]
//! z[n](0) = z[n−1](1) + Σ jump · (v[n−lag](0) − v[n−lag−1](1)),     z[−1](1) = initial
//! ```
//!
//! Waves are zero for negative periods. Poles of any multiplicity are chains of such states, functions
//! of time that act from outside are states that nothing drives, and pairs of complex poles are states
//! with complex numbers.

use super::error::MarchError;
use super::number::{Complex, Scalar};

/// `weight · v[n−lag]`, or the same of `v'`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Term<T> {
    /// Which wave.
    pub wave: usize,
    /// By how many periods it is delayed.
    pub lag: usize,
    /// The factor.
    pub weight: T,
}

/// The state of a wave: `z' = λ z + Σ drive`.
#[derive(Clone, PartialEq, Debug)]
pub struct State<T> {
    /// The pole `λ`, a period.
    pub rate: T,
    /// What drives it.
    pub drive: Vec<Term<T>>,
    /// The weights with which it jumps where waves jump.
    pub jumps: Vec<Term<T>>,
    /// Its value before the first jump.
    pub initial: T,
}

/// How one wave follows from others.
#[derive(Clone, PartialEq, Debug)]
pub struct WaveStep<T> {
    /// Which wave.
    pub wave: usize,
    /// Earlier pieces that are added.
    pub values: Vec<Term<T>>,
    /// Derivatives of earlier pieces that are added, by period.
    pub slopes: Vec<Term<T>>,
    /// Its state, where it has one.
    pub state: Option<State<T>>,
}

/// Waves in the order in which they follow from each other.
///
/// # Invariants
/// - each wave has one step, and waves are numbered from 0 without a gap;
/// - a step names waves at lag 0 only of steps before it;
/// - all numbers are finite, and there is one wave at least.
#[derive(Clone, PartialEq, Debug)]
pub struct WaveSystem<T> {
    pub(super) steps: Vec<WaveStep<T>>,
}

impl<T: Scalar> WaveSystem<T> {
    /// A system of steps in the order in which they are taken. O(terms).
    pub fn new(steps: Vec<WaveStep<T>>) -> Result<WaveSystem<T>, MarchError> {
        if steps.is_empty() {
            return Err(MarchError::NoWaves);
        }
        let mut known = vec![false; steps.len()];
        for step in &steps {
            let wave = step.wave;
            if wave >= steps.len() || known[wave] {
                return Err(MarchError::Steps(wave));
            }
            let finite = |value: T| value.size().is_finite();
            for term in step.terms() {
                match known.get(term.wave) {
                    None => return Err(MarchError::Steps(term.wave)),
                    Some(false) if term.lag == 0 => {
                        return Err(MarchError::NotYetKnown { wave, other: term.wave });
                    }
                    Some(_) if !finite(term.weight) => return Err(MarchError::WaveNotFinite(wave)),
                    Some(_) => {}
                }
            }
            if step.state.as_ref().is_some_and(|s| !finite(s.rate) || !finite(s.initial)) {
                return Err(MarchError::WaveNotFinite(wave));
            }
            known[wave] = true;
        }
        Ok(WaveSystem { steps })
    }

    /// How many waves there are.
    pub fn waves(&self) -> usize {
        self.steps.len()
    }

    /// The largest lag that is named.
    pub fn largest_lag(&self) -> usize {
        self.steps.iter().flat_map(WaveStep::terms).map(|term| term.lag).max().unwrap_or(0)
    }

    /// The size of the largest pole, a period.
    pub fn fastest_rate(&self) -> f64 {
        let states = self.steps.iter().filter_map(|step| step.state.as_ref());
        states.map(|state| state.rate.size()).fold(0.0, f64::max)
    }
}

impl<T: Scalar> WaveStep<T> {
    /// All terms of the step.
    fn terms(&self) -> impl Iterator<Item = &Term<T>> {
        let state = self.state.iter().flat_map(|state| state.drive.iter().chain(&state.jumps));
        self.values.iter().chain(&self.slopes).chain(state)
    }
}

impl WaveSystem<Complex> {
    /// The same in real numbers, where no number has an imaginary part: a quarter of the work.
    pub fn real(&self) -> Option<WaveSystem<f64>> {
        let real = |value: Complex| (value.im == 0.0).then_some(value.re);
        let terms = |terms: &[Term<Complex>]| -> Option<Vec<Term<f64>>> {
            let term = |t: &Term<Complex>| {
                Some(Term { wave: t.wave, lag: t.lag, weight: real(t.weight)? })
            };
            terms.iter().map(term).collect()
        };
        let step = |step: &WaveStep<Complex>| {
            let state = match &step.state {
                None => None,
                Some(state) => Some(State {
                    rate: real(state.rate)?,
                    drive: terms(&state.drive)?,
                    jumps: terms(&state.jumps)?,
                    initial: real(state.initial)?,
                }),
            };
            let (values, slopes) = (terms(&step.values)?, terms(&step.slopes)?);
            Some(WaveStep { wave: step.wave, values, slopes, state })
        };
        Some(WaveSystem { steps: self.steps.iter().map(step).collect::<Option<_>>()? })
    }
}
