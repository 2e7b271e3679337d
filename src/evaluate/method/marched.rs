//! Marched: the recurrence on Chebyshev coefficients, period by period, for millions of reflections.
//!
//! Where all that is seen has one pole and one lag it is made of delayed copies of one impulse response,
//! and a bound can be proven. All other recurrences are marched through wave by wave, without a bound.

use super::clock::{Clock, Delayed, Place};
use super::doubles::{exactly, inside};
use super::marched_response::{Response, reflection, weights};
use super::marched_waves::Waves;
use super::{Evaluator, MethodError};
use crate::ball::{Attempt, Ball, ComplexBall, Magnitude, Precisions, rational};
use crate::enclosure::Numbers;
use crate::evaluate::closed::ClosedForm;
use crate::evaluate::error::EvaluateError;
use crate::evaluate::signal::{Limit, Signal};
use crate::evaluate::taps::{Extra, NoTaps, Taps};
use crate::evaluate::transforms::value_at;
use crate::expression::{Field as _, Fraction, Root, Transform};
use wavestep_kernels::march::Bounds;
use wavestep_polynomial::{Rational, Symbol};

/// Bits of the sum of the waves and what is added, whatever their sizes.
const SUM_BITS: u64 = 1 << 12;

/// An observable on a window by a march.
///
/// Waves with several poles have values without a bound:
pub struct Marched {
    clock: Clock,
    /// When the waves are seen.
    seen: Vec<Delayed>,
    march: Box<dyn March>,
    extras: Extras,
    from: Rational,
    to: Rational,
}

/// What is marched through.
pub(super) trait March {
    /// How far values can be off, in words.
    fn law(&self) -> String;

    /// A proven bound on the window, where one is asked for and proven.
    fn bound(&self) -> Option<f64>;

    /// The weighted sums of the waves at all places, for so many values: one march through all periods
    /// that are seen.
    fn sums(&self, places: Vec<Place>, count: usize) -> Result<Vec<f64>, MethodError>;
}

/// What is added to the waves, in the local time and in the unit of the observable.
struct Extras {
    functions: Vec<Extra>,
    local: Symbol,
    unit: Root,
}

impl Marched {
    /// The waves until the end of the window, without a bound.
    ///
    /// # Errors
    /// [`MethodError::NoTaps`], where arrivals lie on no common grid; [`MethodError::TooManyPeriods`];
    /// [`MethodError::Echoes`], where a number is none that doubles can hold.
    ///
    /// # Cost
    /// With one pole and one lag some hundred operations a coefficient for each period, of which there
    /// are about `√(2nD)`. Otherwise that for each term of each step.
    pub fn new(signal: &dyn Signal) -> Result<Marched, MethodError> {
        Marched::of_signal(signal, Bounds::None)
    }

    /// The same, with a bound where there is one pole and one lag: the waves are then marched through at
    /// once, with two or three times as many operations.
    ///
    /// # Errors
    /// As [`Marched::new`].
    pub fn proven(signal: &dyn Signal) -> Result<Marched, MethodError> {
        Marched::of_signal(signal, Bounds::Proven)
    }

    fn of_signal(signal: &dyn Signal, bounds: Bounds) -> Result<Marched, MethodError> {
        let (form, window) = (signal.closed_form()?, signal.window());
        let taps = match Taps::of(form) {
            Ok(taps) => taps,
            Err(NoTaps::NoGrid) => return Err(NoTaps::NoGrid.into()),
            Err(_) => return Marched::of_waves(form, window),
        };
        match Marched::of_response(taps, form, window, bounds) {
            // Growing reflections have no certificate; their waves have values as others have.
            Err(error @ (MethodError::Reflection(_) | MethodError::March(_))) => {
                Marched::of_waves(form, window).map_err(|_| error)
            }
            marched => marched,
        }
    }

    /// By the impulse response.
    fn of_response(
        taps: Taps,
        signal: &ClosedForm,
        [from, to]: [&Rational; 2],
        bounds: Bounds,
    ) -> Result<Marched, MethodError> {
        let numbers = Numbers::new(signal.recurrence().constants());
        let reflection = reflection(&taps, &numbers)?;
        let weights = weights(&taps.taps, signal.unit(), &numbers)?;
        let Taps { period, taps, extras: functions, .. } = taps;
        let clock = Clock { numbers, slowness: signal.slowness().clone(), period };
        let seen = taps.into_iter().map(|tap| Delayed { delay: tap.delay, since: tap.since });
        let seen: Vec<Delayed> = seen.collect();
        let last = clock.last_period(&seen, to)?;
        let proven_to = matches!(bounds, Bounds::Proven).then_some(last);
        let march = Response::new(reflection, weights, proven_to)?;
        let local = signal.recurrence().statement().local.clone();
        let extras = Extras { functions, local, unit: signal.unit().clone() };
        let (from, to) = (from.clone(), to.clone());
        Ok(Marched { clock, seen, march: Box::new(march), extras, from, to })
    }

    /// By all waves.
    fn of_waves(signal: &ClosedForm, [from, to]: [&Rational; 2]) -> Result<Marched, MethodError> {
        if !signal.is_on_grid() {
            return Err(NoTaps::NoGrid.into());
        }
        let statement = signal.recurrence().statement();
        let numbers = Numbers::new(signal.recurrence().constants());
        let (march, seen) = Waves::new(signal, &numbers)?;
        let (slowness, period) = (signal.slowness().clone(), statement.period.clone());
        let clock = Clock { numbers, slowness, period };
        clock.last_period(&seen, to)?;
        let local = statement.local.clone();
        let extras = Extras { functions: Vec::new(), local, unit: signal.unit().clone() };
        let (from, to) = (from.clone(), to.clone());
        Ok(Marched { clock, seen, march: Box::new(march), extras, from, to })
    }

    /// What is added to the waves at a time, in a ball whose radius is less than `2^−10` of the bound.
    fn extras(&self, at: &Rational, side: Limit) -> Result<Ball, MethodError> {
        const FIRST_BITS: u64 = 128;
        const MAX_BITS: u64 = 1 << 12;
        let allowed = self.march.bound().map(|bound| Magnitude::from_double(bound).scale(-10));
        let attempt = |bits| {
            let sum = self.extras_in(at, side, bits)?;
            if allowed.is_none_or(|allowed| *sum.radius() <= allowed) {
                return Ok(Attempt::Done(sum));
            }
            let best = Box::new(sum);
            Ok(Attempt::NotYet(EvaluateError::AccuracyNotReached { best, bits }.into()))
        };
        Precisions::doubling(FIRST_BITS, MAX_BITS).raise(attempt).and_then(Attempt::done)
    }

    /// The same with so many bits.
    fn extras_in(&self, at: &Rational, side: Limit, bits: u64) -> Result<Ball, MethodError> {
        let Clock { numbers, slowness, .. } = &self.clock;
        let field = numbers.field(bits);
        let mut sum = Ball::zero();
        for extra in &self.extras.functions {
            let since = &slowness.scale(at) - &extra.origin;
            let order = numbers.compare(&since, &Fraction::zero()).map_err(EvaluateError::from)?;
            if order.is_lt() || (order.is_eq() && side == Limit::Left) {
                continue;
            }
            let exact = Transform::of(&extra.function, &self.extras.local);
            let function =
                Transform::<ComplexBall>::embedded(&exact, &field).map_err(EvaluateError::from)?;
            let x = field.embed(&since.into()).map_err(EvaluateError::from)?;
            let value = value_at(&function, &x, numbers, bits)?;
            sum = sum.add(value.real(), bits);
        }
        let unit = numbers.enclose_root(&self.extras.unit, bits).map_err(EvaluateError::from)?;
        Ok(sum.multiply(&unit, bits))
    }
}

impl Evaluator for Marched {
    fn law(&self) -> String {
        self.march.law()
    }

    fn bound(&self) -> Option<f64> {
        self.march.bound()
    }

    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        Ok(self.exact_values(std::slice::from_ref(at), side)?[0])
    }

    fn exact_values(&self, at: &[Rational], side: Limit) -> Result<Vec<f64>, MethodError> {
        if at.iter().any(|at| *at < self.from || *at > self.to) {
            return Err(MethodError::Outside);
        }
        let places = self.clock.places(&self.seen, at, side)?;
        let mut values = self.march.sums(places, at.len())?;
        if !self.extras.functions.is_empty() {
            // What is added can be much larger than the waves: the sum is rounded once.
            for (value, at) in values.iter_mut().zip(at) {
                let waves = Ball::from_rational(&rational(*value), 64);
                *value = waves.add(&self.extras(at, side)?, SUM_BITS).to_double().0;
            }
        }
        Ok(values)
    }

    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        assert_eq!(at.len(), values.len(), "a place for each value");
        inside(at, [&self.from, &self.to])?;
        let places = match self.extras.functions.is_empty() {
            true => self.clock.places_of_doubles(&self.seen, at),
            false => None,
        };
        let found = match places {
            Some(places) => self.march.sums(places, at.len()),
            None => self.exact_values(&exactly(at), Limit::Right),
        };
        values.copy_from_slice(&found?);
        Ok(())
    }
}
