//! Several poles and lags: all waves of a recurrence, marched through in doubles without a bound.

use super::MethodError;
use super::clock::{Clock, Delayed, Place};
use super::march_system::{BITS, SystemBuilder, nearest};
use crate::ball::ComplexBall;
use crate::expression::{Field as _, Fraction, Transform};
use crate::recurrence::WaveIndex;
use crate::signal::closed::ClosedForm;
use crate::signal::error::EvaluateError;
use crate::signal::taps::NoTaps;
use wavestep_kernels::march::{Complex, Scalar, WaveMarch, WaveSystem};

/// An imaginary part of this size, relative to the largest of the waves that are seen, is more than
/// rounding.
const NOT_REAL: f64 = 1e-6;

/// The error that was measured in most scenes and in stiff ones, in parts of the largest wave.
const MEASURED: f64 = 1e-12;
const STIFF: f64 = 1e-8;

/// All waves of a recurrence, and those that are seen.
pub(super) struct Waves {
    system: System,
    seen: Vec<Seen>,
}

/// Waves in the numbers that they need.
enum System {
    Real(WaveSystem<f64>),
    Complex(WaveSystem<Complex>),
}

/// A wave that is seen with a weight, or its slope by period.
struct Seen {
    wave: WaveIndex,
    slope: bool,
    weight: Complex,
}

impl Waves {
    /// The waves of a signal on a grid, and when they are seen.
    pub fn new(signal: &ClosedForm, clock: &Clock) -> Result<(Waves, Vec<Delayed>), MethodError> {
        let numbers = &clock.numbers;
        let (recurrence, field) = (&signal.recurrence, numbers.field(BITS));
        let statement = recurrence.statement();
        let unit = ComplexBall::from(numbers.enclose_root(&signal.unit, BITS)?);
        let by_period = field.embed(&clock.period.clone().into())?.reciprocal(BITS)?;
        let mut builder = SystemBuilder::new(recurrence, clock)?;
        let observation = &signal.observation;
        let (mut seen, mut delays) = (Vec::new(), Vec::new());
        for wave in &observation.waves {
            let mut weight = field.embed(&wave.coefficient)?.multiply(&unit, BITS);
            if wave.slope {
                weight = weight.multiply(&by_period, BITS);
            }
            seen.push(Seen { wave: wave.wave, slope: wave.slope, weight: nearest(&weight) });
            delays.push(Delayed::at_once(wave.delay.clone()));
        }
        if !observation.forcing.is_zero() {
            let local = Fraction::symbol(&statement.local);
            let function = observation.forcing.substitute(&statement.time, &local);
            let function = function.map_err(|_| NoTaps::Forcing)?;
            let function = Transform::of(&function, &statement.local);
            let function = Transform::<ComplexBall>::embedded(&function, &field)?;
            for (wave, weight) in builder.source(&function)? {
                let weight = nearest(&weight.multiply(&unit, BITS));
                seen.push(Seen { wave, slope: false, weight });
                delays.push(Delayed::at_once(Fraction::zero()));
            }
        }
        let system = builder.build()?;
        let system = system.real().map_or(System::Complex(system), System::Real);
        Ok((Waves { system, seen }, delays))
    }

    fn sums_in<T: Scalar>(
        &self,
        system: &WaveSystem<T>,
        mut places: Vec<Place>,
        count: usize,
    ) -> Result<Vec<f64>, MethodError> {
        let mut sums = vec![(Complex::ZERO, 0.0, 0.0); count];
        places.sort_by_key(|place| (place.period, place.seen));
        if places.is_empty() {
            return Ok(vec![0.0; count]);
        }
        let mut march = WaveMarch::new(system.clone())?;
        for group in places.chunk_by(|a, b| (a.period, a.seen) == (b.period, b.seen)) {
            while march.period() < group[0].period {
                march.advance()?;
            }
            let Seen { wave, slope, weight } = &self.seen[group[0].seen];
            let points: Vec<f64> = group.iter().map(|place| place.local).collect();
            let values = match slope {
                false => march.values(*wave, &points),
                true => march.slopes(*wave, &points),
            };
            for (place, value) in group.iter().zip(values) {
                let (sum, size, noise) = &mut sums[place.value];
                *sum = *sum + value * *weight;
                *size += march.largest(*wave) * weight.size();
                *noise += march.noise(*wave) * weight.size();
            }
        }
        if sums.iter().any(|(sum, size, _)| sum.im.abs() > NOT_REAL * size) {
            return Err(EvaluateError::NotReal.into());
        }
        let largest = sums.iter().map(|(_, size, _)| *size).fold(0.0, f64::max);
        // Where parts of usual sizes cancel, nothing is lost.
        let usual = (0..system.waves()).map(|wave| march.largest(wave)).fold(0.0, f64::max);
        let allowed = (STIFF * largest).max(MEASURED * usual * self.weight());
        let noise = sums.iter().map(|(_, _, noise)| *noise).fold(0.0, f64::max);
        if noise > allowed {
            return Err(MethodError::Cancels(noise / largest));
        }
        Ok(sums.into_iter().map(|(sum, ..)| sum.re).collect())
    }

    /// The sum of the weights.
    fn weight(&self) -> f64 {
        self.seen.iter().map(|seen| seen.weight.size()).sum()
    }

    /// Whether anything returns, so that the length of periods matters.
    pub fn returns(&self) -> bool {
        let largest_lag = match &self.system {
            System::Real(system) => system.largest_lag(),
            System::Complex(system) => system.largest_lag(),
        };
        largest_lag > 0
    }

    /// How far values may be off, in words: what was measured, or else what the rounding of a place on the period changes
    /// of the fastest wave.
    pub fn law(&self) -> String {
        let rate = match &self.system {
            System::Real(system) => system.fastest_rate(),
            System::Complex(system) => system.fastest_rate(),
        };
        let rounding = rate * f64::EPSILON;
        match rounding <= STIFF {
            true => format!(
                "no bound; measured below {STIFF:.0e} of the largest wave through 400 periods, below {MEASURED:.0e} in most scenes"
            ),
            false => format!(
                "no bound; expected below {rounding:.0e} of the largest wave, since the fastest rate is {rate:.1e} a period"
            ),
        }
    }

    /// The weighted sums at all places, for so many values.
    pub fn sums(&self, places: Vec<Place>, count: usize) -> Result<Vec<f64>, MethodError> {
        match &self.system {
            System::Real(system) => self.sums_in(system, places, count),
            System::Complex(system) => self.sums_in(system, places, count),
        }
    }
}
