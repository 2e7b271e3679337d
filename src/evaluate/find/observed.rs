//! A wave or an observable as what roots and extrema are looked for in.
//!
//! It is held twice: as a [`Signal`], which is enclosed in balls, and as what is asked for exact values
//! where a ball cannot decide because the answer is zero.

use crate::ball::{Ball, Magnitude, Value};
use crate::evaluate::error::EvaluateError;
use crate::evaluate::evaluator::{Evaluator, Limit};
use crate::evaluate::find::piecewise::{At, Piecewise};
use crate::evaluate::find::search::{FIRST_BITS, SIGN_BITS};
use crate::evaluate::scene::SceneEvaluator;
use crate::evaluate::signal::{Signal, Stretch};
use crate::evaluate::taylor::Taylor;
use crate::expression::{Field as _, Fraction};
use crate::network::{Network, Observed, ObservedValue};
use crate::recurrence::Observation;
use crate::solution::Solution;
use std::borrow::Cow;
use std::cell::OnceCell;
use wavestep_polynomial::Rational;

/// Digits of what is only compared with a rational number.
const FEW_DIGITS: usize = 6;

/// The most exact zeros that are asked for to see whether a function vanishes.
const MAX_ZEROS: usize = 48;

/// The precision of the scale of time.
const SCALE_BITS: u64 = 64;

/// An observable on a window of the user's time; every symbol has a value, its arrivals are known.
pub struct ObservedSignal<'a> {
    signal: Signal,
    exact: Exact<'a>,
    stretches: Vec<Stretch>,
    window: [Rational; 2],
}

/// Where exact values come from.
enum Exact<'a> {
    /// There are none.
    Nowhere,
    Recurrence {
        evaluator: Box<Evaluator<'a>>,
        value: Observation,
    },
    Scene {
        network: &'a Network,
        observed: Box<Observed>,
        evaluator: OnceCell<Prepared<'a>>,
    },
}

/// An evaluator, unless too many echoes arrive to make one.
type Prepared<'a> = Option<Box<SceneEvaluator<'a>>>;

impl<'a> ObservedSignal<'a> {
    /// A wave or observable of a recurrence.
    pub fn of_recurrence(
        solution: &'a Solution,
        observation: &Observation,
        window: [&Rational; 2],
    ) -> Result<Self, EvaluateError> {
        let signal = Signal::of_recurrence(solution.recurrence(), observation)?;
        let evaluator = Box::new(Evaluator::new(solution)?);
        let value = observation.clone();
        ObservedSignal::new(signal, Exact::Recurrence { evaluator, value }, window)
    }

    /// A signal, without what tells exact values.
    pub fn of_signal(signal: Signal, window: [&Rational; 2]) -> Result<Self, EvaluateError> {
        ObservedSignal::new(signal, Exact::Nowhere, window)
    }

    /// An observable of a scene.
    pub fn of_scene(
        network: &'a Network,
        observed: &Observed,
        window: [&Rational; 2],
    ) -> Result<Self, EvaluateError> {
        let signal = Signal::of_scene(network, observed, window[1])?;
        let observed = Box::new(observed.clone());
        let exact = Exact::Scene { network, observed, evaluator: OnceCell::new() };
        ObservedSignal::new(signal, exact, window)
    }

    fn new(
        signal: Signal,
        exact: Exact<'a>,
        [from, to]: [&Rational; 2],
    ) -> Result<Self, EvaluateError> {
        let stretches = signal.audible(signal.stretches(from, to)?, FIRST_BITS)?;
        Ok(ObservedSignal { signal, exact, stretches, window: [from.clone(), to.clone()] })
    }

    /// A time in the scale of the waves.
    fn scaled(&self, stretch: usize, at: At<'_>) -> Cow<'_, Fraction> {
        match at {
            At::Time(time) => Cow::Owned(self.signal.slowness().scale(time)),
            At::End(Limit::Right) => Cow::Borrowed(self.stretches[stretch].from()),
            At::End(Limit::Left) => Cow::Borrowed(self.stretches[stretch].to()),
        }
    }

    /// The value at a time in the scale of the waves, where it is rational.
    fn exact_value(&self, at: &Fraction, side: Limit) -> Result<Option<Rational>, EvaluateError> {
        let value = match &self.exact {
            Exact::Nowhere => return Ok(None),
            Exact::Recurrence { evaluator, value } => {
                let Some(at) = at.as_constant() else { return Ok(None) };
                evaluator.value(value, &at, side, FEW_DIGITS, SIGN_BITS)
            }
            Exact::Scene { network, observed, evaluator } => {
                let last = self.signal.slowness().scale(&self.window[1]);
                let evaluator = evaluator
                    .get_or_init(|| SceneEvaluator::new(network, &last).ok().map(Box::new));
                let value = evaluator
                    .as_ref()
                    .map(|known| known.value(observed, at, side, FEW_DIGITS, SIGN_BITS));
                match value {
                    Some(value @ Ok(Value::Exact(_))) => value,
                    // With the echoes until then alone, exact arithmetic may be within reach.
                    _ => SceneEvaluator::new(network, at).and_then(|evaluator| {
                        evaluator.value(observed, at, side, FEW_DIGITS, SIGN_BITS)
                    }),
                }
            }
        };
        match value {
            Ok(Value::Exact(value)) => Ok(Some(value)),
            Ok(Value::Certified { .. } | Value::Enclosed(_))
            | Err(
                EvaluateError::AccuracyNotReached { .. }
                | EvaluateError::TooManyPeriods { .. }
                | EvaluateError::TooManyEchoes { .. }
                | EvaluateError::Solve(_)
                | EvaluateError::Network(_),
            ) => Ok(None),
            Err(error) => Err(error),
        }
    }
}

impl Piecewise for ObservedSignal<'_> {
    fn count(&self) -> usize {
        self.stretches.len()
    }

    fn is_instant(&self, stretch: usize) -> bool {
        self.stretches[stretch].from() == self.stretches[stretch].to()
    }

    fn is_zero(&self, stretch: usize) -> bool {
        self.stretches[stretch].is_silent()
    }

    fn exact_time(&self, stretch: usize, end: Limit) -> Option<Rational> {
        let at = self.scaled(stretch, At::End(end));
        let slowness = self.signal.slowness();
        let own = self.window.iter().rev().find(|time| slowness.scale(time) == *at);
        own.cloned().or_else(|| Some(at.as_constant()? / slowness.as_constant()?))
    }

    fn time(&self, stretch: usize, end: Limit, bits: u64) -> Result<Ball, EvaluateError> {
        let numbers = self.signal.numbers();
        let slowness = numbers.enclose(self.signal.slowness(), bits)?;
        let inverse = slowness.reciprocal(bits).map_err(EvaluateError::Ball)?;
        let at = self.scaled(stretch, At::End(end));
        Ok(numbers.enclose(&at, bits)?.multiply(&inverse, bits))
    }

    fn enclose(
        &self,
        stretch: usize,
        order: usize,
        at: At<'_>,
        bits: u64,
    ) -> Result<Ball, EvaluateError> {
        let at = self.scaled(stretch, at);
        self.signal.enclose(&self.stretches[stretch], order, &at, bits)
    }

    fn taylor(
        &self,
        stretch: usize,
        order: usize,
        place: (&Rational, &Rational),
        terms: usize,
        bits: u64,
    ) -> Result<Taylor, EvaluateError> {
        self.signal.taylor(&self.stretches[stretch], order, place, terms, bits)
    }

    fn size(
        &self,
        stretch: usize,
        order: usize,
        at: &Rational,
        bits: u64,
    ) -> Result<(Magnitude, Magnitude), EvaluateError> {
        let (size, error) = self.signal.size(&self.stretches[stretch], order, at, bits)?;
        let slowness = self.signal.numbers().enclose(self.signal.slowness(), SCALE_BITS)?;
        let slowness = slowness.magnitude();
        let scaled =
            |value| (0..order).fold(value, |value: Magnitude, _| value.multiply(&slowness));
        Ok((scaled(size), scaled(error)))
    }

    fn exact(&self, stretch: usize, at: At<'_>) -> Result<Option<Rational>, EvaluateError> {
        let side = match at {
            At::Time(_) => Limit::Right,
            At::End(side) => side,
        };
        self.exact_value(&self.scaled(stretch, at), side)
    }

    /// For observables that see no derivatives and no function of time themselves.
    fn slope_vanishes(&self, stretch: usize, end: Limit) -> Result<bool, EvaluateError> {
        let at = self.scaled(stretch, At::End(end));
        let value = match &self.exact {
            Exact::Nowhere => return Ok(false),
            Exact::Recurrence { evaluator, value } => {
                let Some((slope, at)) = slope_of(value).zip(at.as_constant()) else {
                    return Ok(false);
                };
                evaluator.value(&slope, &at, end, FEW_DIGITS, SIGN_BITS)
            }
            Exact::Scene { network, observed, .. } => {
                let ObservedValue::Linear(value) = &observed.value else { return Ok(false) };
                let Some(slope) = slope_of(value) else { return Ok(false) };
                let slope =
                    Observed { value: ObservedValue::Linear(slope), ..(**observed).clone() };
                let Ok(evaluator) = SceneEvaluator::new(network, &at) else { return Ok(false) };
                evaluator.value(&slope, &at, end, FEW_DIGITS, SIGN_BITS)
            }
        };
        Ok(matches!(value, Ok(Value::Exact(value)) if value == Rational::default()))
    }

    /// A real function `Σ_λ e^{λx} Σ_j c_j x^j/j!` with N coefficients, of which the value is one, solves
    /// a linear equation of order N with constant real coefficients. If it is not zero everywhere, it
    /// has at most `N − 1` roots on any interval where λ are real (Pólya and Szegő, *Problems and
    /// Theorems* V.75), and on intervals shorter than `π/ω` with `ω = max |Im λ|` otherwise: there
    /// each factor `(d/dx − σ)² + ω²` has solutions without two roots, and so no product of factors
    /// of order N has one with N roots. N exact zeros therefore prove it.
    fn equals(
        &self,
        stretch: usize,
        value: &Rational,
        [from, to]: &[Rational; 2],
        bits: u64,
    ) -> Result<bool, EvaluateError> {
        let mut rates = self.signal.rates(&self.stretches[stretch], bits)?;
        rates.entry(Fraction::zero()).or_insert(1);
        let count: usize = rates.values().sum();
        if count > MAX_ZEROS {
            return Ok(false);
        }
        let field = self.signal.numbers().field(bits);
        let mut fastest = Magnitude::ZERO;
        for rate in rates.keys() {
            fastest = fastest.max(field.embed(&rate.clone().into())?.imaginary().magnitude());
        }
        // Rates are those of the waves' own time.
        let slowness = self.signal.numbers().enclose(self.signal.slowness(), bits)?.magnitude();
        let fastest = Rational::from(&fastest.multiply(&slowness));
        let mut length = to - from;
        if fastest > Rational::default() {
            length = length.min(Rational::from_integer(3.into()) / fastest);
        }
        for i in 1..=count {
            let share = Rational::new(i.into(), (count + 1).into());
            let at = self.signal.slowness().scale(&(from + &length * share));
            if self.exact_value(&at, Limit::Right)?.as_ref() != Some(value) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// The observable's derivative between arrivals.
fn slope_of(value: &Observation) -> Option<Observation> {
    if !value.forcing.is_zero() || value.waves.iter().any(|seen| seen.slope) {
        return None;
    }
    let mut slope = value.clone();
    slope.waves.iter_mut().for_each(|seen| seen.slope = true);
    Some(slope)
}
