//! The dispersion relation `ω(k)`: which frequency a wave of wavenumber `k` has, and so how fast its
//! crests and its envelope travel.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::{FromPrimitive as _, Signed as _};
use wavestep_polynomial::{Rational, Symbol};

use super::error::{DispersionError, NoGrid, place};
use super::formula::{Formula, pi, wave_number};
use wavestep::ball::{Ball, Value};
use wavestep::field::Bounded;

const SAMPLE_BITS: u64 = 80;

/// What is known of a wave from its wavenumber.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// `ω`.
    Frequency,
    /// `c_p = ω/k`; at `k = 0` its limit, where `ω(0) = 0`.
    PhaseVelocity,
    /// `c_g = dω/dk`.
    GroupVelocity,
}

/// A dispersion relation with its two velocities, derived once.
///
/// # Invariants
/// - The frequency depends on `k`; the velocities are `ω/k` and `dω/dk`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Relation {
    frequency: Formula,
    phase_velocity: Formula,
    group_velocity: Formula,
}

impl Relation {
    pub fn new(frequency: Formula) -> Result<Relation, DispersionError> {
        if !frequency.symbols().contains(&wave_number()) {
            return Err(DispersionError::NoWaveNumber);
        }
        let phase_velocity = frequency.divide(&Formula::wave_number())?;
        let group_velocity = frequency.derivative();
        Ok(Relation { frequency, phase_velocity, group_velocity })
    }

    /// `ω`.
    pub fn frequency(&self) -> &Formula {
        &self.frequency
    }

    pub fn formula(&self, quantity: Quantity) -> &Formula {
        match quantity {
            Quantity::Frequency => &self.frequency,
            Quantity::PhaseVelocity => &self.phase_velocity,
            Quantity::GroupVelocity => &self.group_velocity,
        }
    }

    /// The parameters that have no value yet.
    pub fn parameters(&self) -> BTreeSet<Symbol> {
        let mut symbols = self.frequency.symbols();
        symbols.remove(&wave_number());
        symbols.remove(&pi());
        symbols
    }

    pub fn with_values(
        &self,
        values: &BTreeMap<String, Rational>,
    ) -> Result<Relation, DispersionError> {
        let parameters = self.parameters();
        let mut formulas = BTreeMap::new();
        for (name, value) in values {
            let Some(symbol) = parameters.iter().find(|symbol| symbol.name() == name) else {
                return Err(DispersionError::UnknownParameter(name.clone()));
            };
            if !value.is_positive() {
                return Err(DispersionError::ParameterNotPositive(name.clone(), value.clone()));
            }
            formulas.insert(symbol.clone(), Formula::number(value));
        }
        Relation::new(self.frequency.substitute(&formulas)?)
    }

    /// An enclosure for all `k` of a ball.
    pub fn enclose(&self, what: Quantity, k: &Ball, bits: u64) -> Result<Ball, DispersionError> {
        let formula = match what {
            // With ω(0) = 0, the limit of ω/k is the derivative.
            Quantity::PhaseVelocity if k.is_exact() && k.midpoint().is_zero() => {
                let at_zero = value(&self.frequency, k, bits)?;
                if !at_zero.contains_zero() {
                    return Err(DispersionError::DivisionByZero(place(k)));
                }
                &self.group_velocity
            }
            other => self.formula(other),
        };
        value(formula, k, bits)
    }

    /// The value at an exact wavenumber, rounded correctly to so many significant digits. A value that
    /// lies midway between two decimals is never decided: ask [`Relation::exact`] first.
    pub fn digits(
        &self,
        what: Quantity,
        k: &Rational,
        digits: usize,
        limit_bits: u64,
    ) -> Result<Value, DispersionError> {
        let enclosure = |bits| self.enclose(what, &Ball::from_rational(k, bits), bits);
        certified(digits, limit_bits, enclosure)
    }

    /// The value at an exact wavenumber where it is a rational number by the rules of formulas.
    pub fn exact(&self, what: Quantity, k: &Rational) -> Option<Rational> {
        let at = [(wave_number(), Formula::number(k))].into();
        self.formula(what).substitute(&at).ok()?.as_number().cloned()
    }

    /// The value with a bound, for a double taken as it is.
    pub fn sample(&self, what: Quantity, k: f64) -> Result<Bounded, DispersionError> {
        let Some(exact) = Rational::from_f64(k) else {
            return Err(NoGrid::WaveNumber.into());
        };
        let ball = self.enclose(what, &Ball::from_rational(&exact, SAMPLE_BITS), SAMPLE_BITS)?;
        let (value, bound) = ball.to_double();
        Ok(Bounded { value, bound: bound.to_double() })
    }
}

/// A formula for all `k` of a ball.
pub(super) fn value(formula: &Formula, k: &Ball, bits: u64) -> Result<Ball, DispersionError> {
    formula.enclose(k, bits).map_err(|fault| DispersionError::at(fault, k))
}

pub(super) fn certified(
    digits: usize,
    limit_bits: u64,
    enclosure: impl FnMut(u64) -> Result<Ball, DispersionError>,
) -> Result<Value, DispersionError> {
    match Value::certify(digits, limit_bits, enclosure)? {
        Value::Enclosed(best) => {
            let best = Some(Box::new(best));
            Err(DispersionError::AccuracyNotReached { best, bits: limit_bits })
        }
        value => Ok(value),
    }
}
