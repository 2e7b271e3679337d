//! One pole and one lag: the march of the impulse response, with a proven bound.
//!
//! The impulse response is a polynomial on each period, whose length grows as the fronts sharpen. A
//! certificate looks at the polynomials alone and proves how far they are from the exact response
//! ([`wavestep_kernels::march`]); the bound of an observable is that, times the sum of the weights with
//! which the response is seen.

use super::clock::Clock;
use super::doubles::{exactly, inside, near};
use super::held_waves::HeldWaves;
use super::{Method, MethodError};
use crate::ball::{Ball, ComplexBall, Magnitude};
use crate::enclosure::Numbers;
use crate::evaluate::cells::rational;
use crate::evaluate::error::EvaluateError;
use crate::evaluate::evaluator::Limit;
use crate::evaluate::signal::Signal;
use crate::evaluate::taps::Taps;
use crate::evaluate::transforms::value_at;
use crate::expression::{Field as _, Fraction, Root, Transform};
use wavestep_kernels::march::chebyshev::{self, Samples};
use wavestep_kernels::march::{Bounds, March, MarchOptions, Parameter, Reflection};
use wavestep_polynomial::{Rational, Symbol};

/// Bits of the sum of the response and what is added, whatever their sizes.
const SUM_BITS: u64 = 1 << 12;

/// An observable on a window by a march of the response.
pub(super) struct MarchedResponse {
    taps: Taps,
    clock: Clock,
    local: Symbol,
    reflection: Reflection,
    unit: Root,
    from: Rational,
    to: Rational,
    /// The proven bound on the window, where one is asked for and proven.
    bound: Option<f64>,
    /// The waves that it was proven of, where there is room for them.
    held: Option<HeldWaves>,
}

/// A place at which the response is asked for.
struct Place {
    period: usize,
    /// In parts of the period.
    local: f64,
    /// Which of the values it is for, and the weight there.
    value: usize,
    weight: f64,
}

impl MarchedResponse {
    /// The response until the end of the window; where `proven`, it is marched through at once and
    /// a bound is proven.
    ///
    /// # Errors
    /// [`MethodError::March`] where waves grow without bound.
    ///
    /// # Cost
    /// For each period some hundred operations a coefficient, of which there are about `√(2nD)`; two
    /// or three times as many with a bound.
    pub fn new(
        taps: Taps,
        signal: &Signal,
        from: &Rational,
        to: &Rational,
        proven: bool,
    ) -> Result<MarchedResponse, MethodError> {
        let numbers = Numbers::new(signal.recurrence().constants());
        let reflection = {
            let parameter = |value: &Fraction| -> Result<Parameter, MethodError> {
                let (value, radius) = near(&numbers, value).map_err(EvaluateError::from)?;
                Ok(Parameter::within(value, radius)?)
            };
            let rate = parameter(&(&taps.rate * &taps.period))?;
            let zero = parameter(&(&taps.zero * &taps.period))?;
            Reflection::new(rate, zero, parameter(&taps.ratio)?)?
        };
        let mut marched = MarchedResponse {
            clock: Clock {
                numbers,
                slowness: signal.slowness().clone(),
                period: taps.period.clone(),
            },
            taps,
            local: signal.recurrence().statement().local.clone(),
            reflection,
            unit: signal.unit().clone(),
            from: from.clone(),
            to: to.clone(),
            bound: None,
            held: None,
        };
        let delays = marched.taps.taps.iter().map(|tap| &tap.delay);
        let last = marched.clock.last_period(delays, to)?;
        if proven {
            (marched.bound, marched.held) = marched.prove(last)?;
        }
        Ok(marched)
    }

    /// Marches to the end with a certificate. The bound of the response is `b`, and a place is off by
    /// `2^−53` of a period at most, which the steepest slope `Σ 2k² |c_k|` of a period turns into an
    /// error of the value. The waves are held where there is room for all of them.
    fn prove(&self, last: u64) -> Result<(Option<f64>, Option<HeldWaves>), MethodError> {
        let options = MarchOptions { bounds: Bounds::Proven, ..MarchOptions::default() };
        let mut march = March::new(&self.reflection, options)?;
        let mut slope = 0.0_f64;
        let mut sum = 0.0_f64;
        let mut bound = 0.0_f64;
        let mut held = Some(HeldWaves::default());
        loop {
            let sizes = chebyshev::sizes(march.coefficients());
            slope = slope.max(sizes.slope);
            sum = sum.max(sizes.absolute);
            held = held.and_then(|held| held.with_period(march.coefficients()));
            // Evaluation loses most where the polynomial is largest, which need not be at the end.
            match march.bound_by(&sizes) {
                Some(here) => bound = bound.max(here),
                None => return Ok((None, None)),
            }
            if march.period() as u64 >= last {
                break;
            }
            march.advance()?;
        }
        let weights = self.weights()?;
        let total: f64 = weights.iter().map(|weight| weight.abs()).sum();
        // The weighted sum itself, with an eighth to spare for the rounding of this line, and for the
        // enclosure of what is added.
        let roundings = (weights.len() + 4) as f64 * f64::EPSILON * sum;
        Ok((Some((bound + slope * f64::EPSILON + roundings) * total * 1.125), held))
    }

    /// The weights of the taps in the unit of the observable.
    fn weights(&self) -> Result<Vec<f64>, MethodError> {
        let unit = self.clock.numbers.enclose_root(&self.unit, 128).map_err(EvaluateError::from)?;
        let weight = |tap: &crate::evaluate::taps::Tap| {
            let weight =
                self.clock.numbers.enclose(&tap.weight, 128).map_err(EvaluateError::from)?;
            Ok(weight.multiply(&unit, 128).to_double().0)
        };
        self.taps.taps.iter().map(weight).collect()
    }

    /// What is added to the taps at a time, in a ball whose radius is less than `2^−10` of the bound.
    fn extras(&self, at: &Rational, side: Limit) -> Result<Ball, MethodError> {
        const FIRST_BITS: u64 = 128;
        const MAX_BITS: u64 = 1 << 12;
        let allowed = self.bound.map(|bound| Magnitude::from_double(bound).scale(-10));
        let mut bits = FIRST_BITS;
        loop {
            let sum = self.extras_in(at, side, bits)?;
            if allowed.is_none_or(|allowed| *sum.radius() <= allowed) {
                return Ok(sum);
            }
            if bits >= MAX_BITS {
                let best = Box::new(sum);
                return Err(EvaluateError::AccuracyNotReached { best, bits }.into());
            }
            bits *= 2;
        }
    }

    /// The same with so many bits.
    fn extras_in(&self, at: &Rational, side: Limit, bits: u64) -> Result<Ball, MethodError> {
        let field = self.clock.numbers.field(bits);
        let mut sum = Ball::zero();
        for extra in &self.taps.extras {
            let since = &self.clock.slowness.scale(at) - &extra.origin;
            let order = self
                .clock
                .numbers
                .compare(&since, &Fraction::zero())
                .map_err(EvaluateError::from)?;
            if order.is_lt() || (order.is_eq() && side == Limit::Left) {
                continue;
            }
            let exact = Transform::of(&extra.function, &self.local);
            let function =
                Transform::<ComplexBall>::embedded(&exact, &field).map_err(EvaluateError::from)?;
            let x = field.embed(&since.into()).map_err(EvaluateError::from)?;
            let value = value_at(&function, &x, &self.clock.numbers, bits)?;
            sum = sum.add(value.real(), bits);
        }
        let unit =
            self.clock.numbers.enclose_root(&self.unit, bits).map_err(EvaluateError::from)?;
        Ok(sum.multiply(&unit, bits))
    }

    /// The values at times: one march through all periods that are seen.
    fn at(&self, times: &[Rational], side: Limit) -> Result<Vec<f64>, MethodError> {
        if times.iter().any(|at| *at < self.from || *at > self.to) {
            return Err(MethodError::Outside);
        }
        let weights = self.weights()?;
        let mut places = Vec::new();
        for (value, at) in times.iter().enumerate() {
            for (tap, weight) in self.taps.taps.iter().zip(&weights) {
                let seen = self.clock.place(&tap.since, at, side)?;
                let found = self.clock.place(&tap.delay, at, side)?;
                if let (Some(_), Some((period, local))) = (seen, found) {
                    let period = usize::try_from(period).unwrap_or(usize::MAX);
                    places.push(Place { period, local, value, weight: *weight });
                }
            }
        }
        let mut values = self.march(places, times.len())?;
        if !self.taps.extras.is_empty() {
            // What is added can be much larger than the response: the sum is rounded once.
            for (value, at) in values.iter_mut().zip(times) {
                let response = Ball::from_rational(&rational(*value), 64);
                *value = response.add(&self.extras(at, side)?, SUM_BITS).to_double().0;
            }
        }
        Ok(values)
    }

    /// The same for doubles, just after arrivals, where periods and delays are rational numbers and
    /// nothing is added: their places are found in integers.
    fn at_doubles(&self, times: &[f64]) -> Option<Result<Vec<f64>, MethodError>> {
        if !self.taps.extras.is_empty() {
            return None;
        }
        let mut delays = Vec::new();
        for tap in &self.taps.taps {
            if tap.since != tap.delay {
                return None;
            }
            delays.push(self.clock.double_places(&tap.delay)?);
        }
        let weights = match self.weights() {
            Ok(weights) => weights,
            Err(error) => return Some(Err(error)),
        };
        let mut places = Vec::with_capacity(times.len() * weights.len());
        for (value, time) in times.iter().enumerate() {
            for (delay, &weight) in delays.iter().zip(&weights) {
                if let Some((period, local)) = delay.of(*time).ok()? {
                    places.push(Place { period, local, value, weight });
                }
            }
        }
        Some(self.march(places, times.len()))
    }

    /// The weighted sums of the response at all places, for so many values.
    fn march(&self, mut places: Vec<Place>, count: usize) -> Result<Vec<f64>, MethodError> {
        places.sort_by_key(|place| place.period);
        let points: Vec<f64> = places.iter().map(|place| place.local).collect();
        let mut responses = vec![0.0; points.len()];
        let groups = places.chunk_by(|a, b| a.period == b.period);
        let (mut points, mut found) = (&points[..], &mut responses[..]);
        let groups = groups.map(|group| {
            let (points, found) = (
                points.split_off(..group.len()).unwrap_or_default(),
                found.split_off_mut(..group.len()).unwrap_or_default(),
            );
            (group[0].period, points, found)
        });
        match &self.held {
            Some(held) => chebyshev::values_of(groups.map(|(period, points, values)| Samples {
                coefficients: held.period(period),
                points,
                values,
            })),
            None => {
                let options = MarchOptions { bounds: Bounds::None, ..MarchOptions::default() };
                let mut march = March::new(&self.reflection, options)?;
                for (period, points, values) in groups {
                    while march.period() < period {
                        march.advance()?;
                    }
                    march.values(points, values);
                }
            }
        }
        let mut values = vec![0.0; count];
        for (place, response) in places.iter().zip(&responses) {
            values[place.value] += place.weight * response;
        }
        Ok(values)
    }
}

impl Method for MarchedResponse {
    fn name(&self) -> &'static str {
        "marched"
    }

    fn law(&self) -> String {
        match self.bound {
            Some(bound) => format!("at most {bound:.1e} everywhere on the window, proven"),
            None => "no bound; about 1e-15 √n, measured".to_owned(),
        }
    }

    fn bound(&self) -> Option<f64> {
        self.bound
    }

    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        Ok(self.at(std::slice::from_ref(at), side)?[0])
    }

    fn exact_values(&self, at: &[Rational], side: Limit) -> Result<Vec<f64>, MethodError> {
        self.at(at, side)
    }

    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        assert_eq!(at.len(), values.len(), "a place for each value");
        inside(at, [&self.from, &self.to])?;
        let found = self.at_doubles(at).unwrap_or_else(|| self.at(&exactly(at), Limit::Right));
        values.copy_from_slice(&found?);
        Ok(())
    }
}
