//! Marched: the recurrence on Chebyshev coefficients, period by period, for millions of reflections.
//!
//! Where all that is seen has one pole and one lag it is made of delayed copies of one impulse response,
//! and a bound can be proven. All other recurrences are marched through wave by wave, without a bound.

use super::clock::{Clock, Delayed, Place};
use super::doubles::{exactly, inside};
use super::marched_response::Response;
use super::marched_waves::Waves;
use super::{Evaluator, MethodError};
use crate::ball::{Attempt, Ball, ComplexBall, Magnitude, Precisions, rational};
use crate::expression::{Field as _, Fraction, Root, Transform};
use crate::signal::closed::ClosedForm;
use crate::signal::error::EvaluateError;
use crate::signal::signal::{Limit, Signal};
use crate::signal::taps::{Extra, NoTaps, Taps};
use crate::signal::transforms::value_at;
use num_traits::Signed as _;
use wavestep_polynomial::{Rational, Symbol};

/// Bits of the sum of the waves and what is added, whatever their sizes.
const SUM_BITS: u64 = 1 << 12;

/// An observable on a window by a march.
pub struct Marched {
    clock: Clock,
    /// When the waves are seen.
    seen: Vec<Delayed>,
    march: March,
    extras: Extras,
    window: [Rational; 2],
}

/// What is marched through.
enum March {
    Response(Response),
    Waves(Waves),
}

/// What is added to the waves, in the local time and in the unit of the observable.
struct Extras {
    functions: Vec<Extra>,
    local: Symbol,
    unit: Root,
}

impl Marched {
    /// The waves until the end of the window, without a bound. With one pole and one lag some hundred
    /// operations a coefficient for each period, of which there are about `√(2nD)`; else that for each
    /// term of each step.
    pub fn new(signal: &dyn Signal) -> Result<Marched, MethodError> {
        Marched::of_signal(signal, false)
    }

    /// The same, with a bound where there is one pole and one lag: the waves are then marched through at
    /// once, with two or three times as many operations.
    pub fn proven(signal: &dyn Signal) -> Result<Marched, MethodError> {
        Marched::of_signal(signal, true)
    }

    fn of_signal(signal: &dyn Signal, proven: bool) -> Result<Marched, MethodError> {
        let (form, window) = (signal.closed_form()?, signal.window());
        if !form.is_on_grid() {
            return Err(NoTaps::NoGrid.into());
        }
        let Ok(taps) = Taps::of(form) else { return Marched::of_waves(form, window) };
        match Marched::of_response(taps, form, window, proven) {
            // Growing reflections have no certificate; their waves have values as others have.
            Err(error @ MethodError::March(_)) => {
                Marched::of_waves(form, window).map_err(|_| error)
            }
            marched => marched,
        }
    }

    /// By the impulse response.
    fn of_response(
        taps: Taps,
        form: &ClosedForm,
        window: [&Rational; 2],
        proven: bool,
    ) -> Result<Marched, MethodError> {
        let clock = Clock::of(form);
        let mut response = Response::new(&taps, &form.unit, &clock.numbers)?;
        let seen = taps.taps.into_iter().map(|tap| Delayed { delay: tap.delay, since: tap.since });
        let seen: Vec<Delayed> = seen.collect();
        let last = clock.last_period(&seen, window[1])?;
        if proven {
            response.prove(last)?;
        }
        Ok(Marched::made(form, window, clock, (March::Response(response), seen), taps.extras))
    }

    /// By all waves.
    fn of_waves(form: &ClosedForm, window: [&Rational; 2]) -> Result<Marched, MethodError> {
        let mut clock = Clock::of(form);
        let (mut waves, mut seen) = Waves::new(form, &clock)?;
        let end = clock.slowness.scale(window[1]);
        let is_shorter =
            (&clock.period - &end).as_constant().is_some_and(|rest| rest.is_positive());
        if !waves.returns() && window[1].is_positive() && is_shorter {
            clock.period = end;
            (waves, seen) = Waves::new(form, &clock)?;
        }
        clock.last_period(&seen, window[1])?;
        Ok(Marched::made(form, window, clock, (March::Waves(waves), seen), Vec::new()))
    }

    fn made(
        form: &ClosedForm,
        window: [&Rational; 2],
        clock: Clock,
        (march, seen): (March, Vec<Delayed>),
        functions: Vec<Extra>,
    ) -> Marched {
        let local = form.recurrence.statement().local.clone();
        let extras = Extras { functions, local, unit: form.unit.clone() };
        Marched { clock, seen, march, extras, window: window.map(Clone::clone) }
    }

    /// The weighted sums of the waves at all places, for so many values: one march through all periods
    /// that are seen.
    fn sums(&self, places: Vec<Place>, count: usize) -> Result<Vec<f64>, MethodError> {
        match &self.march {
            March::Response(response) => response.sums(places, count),
            March::Waves(waves) => waves.sums(places, count),
        }
    }

    /// What is added to the waves at a time, in a ball whose radius is less than `2^−10` of the bound.
    fn extras(&self, at: &Rational, side: Limit) -> Result<Ball, MethodError> {
        const FIRST_BITS: u64 = 128;
        const MAX_BITS: u64 = 1 << 12;
        let allowed = self.bound().map(|bound| Magnitude::from_double(bound).scale(-10));
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
            let order = numbers.compare(&since, &Fraction::zero())?;
            if order.is_lt() || (order.is_eq() && side == Limit::Left) {
                continue;
            }
            let exact = Transform::of(&extra.function, &self.extras.local);
            let function = Transform::<ComplexBall>::embedded(&exact, &field)?;
            let x = field.embed(&since.into())?;
            let value = value_at(&function, &x, numbers, bits)?;
            sum = sum.add(value.real(), bits);
        }
        let unit = numbers.enclose_root(&self.extras.unit, bits)?;
        Ok(sum.multiply(&unit, bits))
    }
}

impl Evaluator for Marched {
    fn law(&self) -> String {
        match (&self.march, self.bound()) {
            (_, Some(bound)) => format!("at most {bound:.1e} everywhere on the window, proven"),
            (March::Response(_), None) => "no bound; about 1e-15 √n, measured".to_owned(),
            (March::Waves(waves), None) => waves.law(),
        }
    }

    fn bound(&self) -> Option<f64> {
        match &self.march {
            March::Response(response) => response.bound,
            March::Waves(_) => None,
        }
    }

    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        Ok(self.exact_values(std::slice::from_ref(at), side)?[0])
    }

    fn exact_values(&self, at: &[Rational], side: Limit) -> Result<Vec<f64>, MethodError> {
        if at.iter().any(|at| *at < self.window[0] || *at > self.window[1]) {
            return Err(MethodError::Outside);
        }
        let places = self.clock.places(&self.seen, at, side)?;
        let mut values = self.sums(places, at.len())?;
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
        inside(at, self.window.each_ref())?;
        let places = match self.extras.functions.is_empty() {
            true => self.clock.places_of_doubles(&self.seen, at),
            false => None,
        };
        let found = match places {
            Some(places) => self.sums(places, at.len()),
            None => self.exact_values(&exactly(at), Limit::Right),
        };
        values.copy_from_slice(&found?);
        Ok(())
    }
}
