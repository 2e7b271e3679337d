//! Several poles and lags: all waves of a recurrence, marched through in doubles without a bound.

use super::clock::Clock;
use super::doubles::{exactly, inside};
use super::march_system::{SystemBuilder, enclosed, nearest, product, transform};
use super::{Method, MethodError};
use crate::ball::ComplexBall;
use crate::enclosure::Numbers;
use crate::evaluate::error::EvaluateError;
use crate::evaluate::evaluator::Limit;
use crate::evaluate::signal::Signal;
use crate::evaluate::taps::NoTaps;
use crate::expression::{Fraction, Transform};
use crate::recurrence::WaveIndex;
use num_complex::Complex64;
use wavestep_kernels::march::{Scalar, WaveMarch, WaveSystem};
use wavestep_polynomial::Rational;

/// Bits of what weights are multiplied with.
const BITS: u64 = 256;

/// An imaginary part of this size, relative to the largest of the waves that are seen, is more than
/// rounding.
const NOT_REAL: f64 = 1e-6;

/// An observable on a window by a march of all waves.
pub(super) struct MarchedWaves {
    clock: Clock,
    system: System,
    seen: Vec<Seen>,
    from: Rational,
    to: Rational,
}

/// Waves in the numbers that they need.
enum System {
    Real(WaveSystem<f64>),
    Complex(WaveSystem<Complex64>),
}

/// A wave that is seen: `weight · w(t − delay)`, or the same of its slope by period.
struct Seen {
    wave: WaveIndex,
    slope: bool,
    weight: Complex64,
    delay: Fraction,
}

/// A place at which a wave is asked for.
struct Place {
    period: usize,
    /// Which of the waves that are seen.
    seen: usize,
    /// In parts of the period.
    local: f64,
    /// Which of the values it is for.
    value: usize,
}

impl MarchedWaves {
    /// The waves of a signal on a window.
    ///
    /// # Errors
    /// [`MethodError::NoTaps`] off a grid; [`MethodError::TooManyPeriods`]; [`MethodError::Evaluate`]
    /// where a constant cannot be enclosed; [`MethodError::System`] where one is too large.
    ///
    /// # Cost
    /// That of the numbers in balls; the march is made when values are asked for.
    pub fn new(
        signal: &Signal,
        from: &Rational,
        to: &Rational,
    ) -> Result<MarchedWaves, MethodError> {
        if !signal.is_on_grid() {
            return Err(NoTaps::NoGrid.into());
        }
        let recurrence = signal.recurrence();
        let statement = recurrence.statement();
        let numbers = Numbers::new(recurrence.constants());
        let unit = numbers.enclose_root(signal.unit(), BITS).map_err(EvaluateError::from)?;
        let unit = ComplexBall::from(unit);
        let by_period = enclosed(&numbers, &statement.period.clone().into())?;
        let by_period = by_period.reciprocal(BITS).map_err(EvaluateError::Ball)?;
        let mut builder = SystemBuilder::new(recurrence, &numbers)?;
        let observation = signal.observation();
        let mut seen = Vec::new();
        for wave in &observation.waves {
            let mut weight = product(&enclosed(&numbers, &wave.coefficient)?, &unit);
            if wave.slope {
                weight = product(&weight, &by_period);
            }
            let (slope, weight, delay) = (wave.slope, nearest(&weight), wave.delay.clone());
            seen.push(Seen { wave: wave.wave, slope, weight, delay });
        }
        if !observation.forcing.is_zero() {
            let local = Fraction::symbol(&statement.local);
            let function = observation.forcing.substitute(&statement.time, &local);
            let function = function.map_err(|_| NoTaps::Forcing)?;
            let function = transform(&numbers, &Transform::of(&function, &statement.local))?;
            for (wave, weight) in builder.source(&function).map_err(EvaluateError::from)? {
                let weight = nearest(&product(&weight, &unit));
                seen.push(Seen { wave, slope: false, weight, delay: Fraction::zero() });
            }
        }
        let system = builder.build()?;
        let system = system.real().map_or(System::Complex(system), System::Real);
        let (slowness, period) = (signal.slowness().clone(), statement.period.clone());
        let clock = Clock { numbers, slowness, period };
        clock.last_period(seen.iter().map(|seen| &seen.delay), to)?;
        Ok(MarchedWaves { clock, system, seen, from: from.clone(), to: to.clone() })
    }

    /// The values at times: one march through all periods that are seen.
    fn at(&self, times: &[Rational], side: Limit) -> Result<Vec<f64>, MethodError> {
        if times.iter().any(|at| *at < self.from || *at > self.to) {
            return Err(MethodError::Outside);
        }
        let mut places = Vec::new();
        for (value, at) in times.iter().enumerate() {
            for (seen, Seen { delay, .. }) in self.seen.iter().enumerate() {
                if let Some((period, local)) = self.clock.place(delay, at, side)? {
                    let period = usize::try_from(period).unwrap_or(usize::MAX);
                    places.push(Place { period, seen, local, value });
                }
            }
        }
        self.march(places, times.len())
    }

    /// The same for doubles, just after arrivals, where periods and delays are rational numbers: their
    /// places are found in integers.
    fn at_doubles(&self, times: &[f64]) -> Option<Result<Vec<f64>, MethodError>> {
        let delays = self.seen.iter().map(|seen| self.clock.double_places(&seen.delay));
        let delays: Vec<_> = delays.collect::<Option<_>>()?;
        let mut places = Vec::with_capacity(times.len() * delays.len());
        for (value, time) in times.iter().enumerate() {
            for (seen, delay) in delays.iter().enumerate() {
                if let Some((period, local)) = delay.of(*time).ok()? {
                    places.push(Place { period, seen, local, value });
                }
            }
        }
        Some(self.march(places, times.len()))
    }

    fn march(&self, places: Vec<Place>, count: usize) -> Result<Vec<f64>, MethodError> {
        match &self.system {
            System::Real(system) => self.march_in(system, places, count),
            System::Complex(system) => self.march_in(system, places, count),
        }
    }

    /// The weighted sums of the waves at all places, for so many values.
    fn march_in<T: Scalar>(
        &self,
        system: &WaveSystem<T>,
        mut places: Vec<Place>,
        count: usize,
    ) -> Result<Vec<f64>, MethodError> {
        let mut sums = vec![(Complex64::ZERO, 0.0); count];
        places.sort_by_key(|place| (place.period, place.seen));
        let Some(last) = places.last() else { return Ok(vec![0.0; count]) };
        let last = last.period;
        let mut march = WaveMarch::new(system.clone())?;
        let (mut points, mut real, mut imaginary) = (Vec::new(), Vec::new(), Vec::new());
        for group in places.chunk_by(|a, b| (a.period, a.seen) == (b.period, b.seen)) {
            while march.period() < group[0].period {
                march.advance()?;
            }
            let Seen { wave, slope, weight, .. } = &self.seen[group[0].seen];
            points.clear();
            points.extend(group.iter().map(|place| place.local));
            real.resize(points.len(), 0.0);
            imaginary.resize(points.len(), 0.0);
            march.values(*wave, *slope, &points, &mut real, &mut imaginary);
            for (place, (real, imaginary)) in group.iter().zip(real.iter().zip(&imaginary)) {
                let value = Complex64::new(*real, *imaginary) * weight;
                let (sum, size) = &mut sums[place.value];
                *sum += value;
                *size += march.largest(*wave) * weight.norm();
            }
        }
        debug_assert_eq!(march.period(), last);
        if sums.iter().any(|(sum, size)| sum.im.abs() > NOT_REAL * size) {
            return Err(EvaluateError::NotReal.into());
        }
        Ok(sums.into_iter().map(|(sum, _)| sum.re).collect())
    }
}

impl Method for MarchedWaves {
    fn name(&self) -> &'static str {
        "marched"
    }

    fn law(&self) -> String {
        "no bound; measured below 1e-13 of the largest value through 400 periods".to_owned()
    }

    fn bound(&self) -> Option<f64> {
        None
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
