//! The dispersion relation `ω(k)`: which frequency a wave of wavenumber `k` has, and so how fast its
//! crests and its envelope travel.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::{FromPrimitive as _, Signed as _};
use wavestep_polynomial::{Rational, Symbol};

use super::error::{DispersionError, NoGrid, place};
use super::formula::{Formula, Function, pi, wave_number};
use super::series::Series;
use wavestep::ball::{Ball, Value};

/// The precision of samples in doubles.
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

/// A double with a bound: the true value is at most `bound` away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    pub value: f64,
    /// How far it is off at most.
    pub bound: f64,
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
    /// The relation `ω = frequency`.
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

    /// `c_p = ω/k`.
    pub fn phase_velocity(&self) -> &Formula {
        &self.phase_velocity
    }

    /// `c_g = dω/dk`.
    pub fn group_velocity(&self) -> &Formula {
        &self.group_velocity
    }

    /// One of the three formulas.
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

    /// The relation with values in place of parameters.
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
    pub fn sample(&self, what: Quantity, k: f64) -> Result<Sample, DispersionError> {
        let Some(exact) = Rational::from_f64(k) else {
            return Err(NoGrid::WaveNumber.into());
        };
        let ball = self.enclose(what, &Ball::from_rational(&exact, SAMPLE_BITS), SAMPLE_BITS)?;
        let (value, bound) = ball.to_double();
        Ok(Sample { value, bound: bound.to_double() })
    }
}

/// A formula for all `k` of a ball.
pub(super) fn value(formula: &Formula, k: &Ball, bits: u64) -> Result<Ball, DispersionError> {
    let series = Series::wave_number(k, &Ball::zero(), 1);
    let value = formula.series(&series, bits).map_err(|fault| DispersionError::at(fault, k))?;
    Ok(value.coefficients()[0].clone())
}

/// Proven digits.
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

/// Relations that have names. Lengths and times are in units in which long waves of the string have
/// velocity 1, unless another is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builtin {
    /// `ω = k`.
    String,
    /// `ω = 2 sin(k/2)`: masses on springs, at unit distances.
    Lattice,
    /// `ω = k − k³/12`: two terms of a relation that is concave downwards.
    Cubic,
    /// `ω = k √(1 + k²/12)`: a string with bending stiffness, concave upwards.
    StiffString,
    /// `ω = k²`: Euler's and Bernoulli's beam in units of its own, `EI/(ρA) = 1`.
    Beam,
    /// `ω = k/√(1 + κk²)`, `κ = ν² r²`: a bar with the inertia of its lateral motion, `ν` Poisson's
    /// ratio, `r` the polar radius of gyration.
    Love,
}

impl Builtin {
    pub const ALL: [Builtin; 6] =
        [Self::String, Self::Lattice, Self::Cubic, Self::StiffString, Self::Beam, Self::Love];

    pub const fn name(self) -> &'static str {
        match self {
            Self::String => "string",
            Self::Lattice => "lattice",
            Self::Cubic => "cubic",
            Self::StiffString => "stiff-string",
            Self::Beam => "beam",
            Self::Love => "love",
        }
    }

    pub const fn title(self) -> &'static str {
        match self {
            Self::String => "a string, or a bar of long waves: no dispersion",
            Self::Lattice => "a chain of masses and springs at unit distances",
            Self::Cubic => "two terms of a relation that is concave downwards",
            Self::StiffString => "a string with bending stiffness, concave upwards",
            Self::Beam => "bending waves of a thin beam",
            Self::Love => {
                "a bar with lateral inertia, kappa = (Poisson's ratio · polar radius of gyration)^2"
            }
        }
    }

    pub fn find(name: &str) -> Option<Builtin> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }

    pub fn relation(self) -> Relation {
        let k = Formula::wave_number();
        let number = |a: i64, b: i64| Formula::number(&Rational::new(a.into(), b.into()));
        let power = |base: &Formula, a: i64, b: i64| {
            base.power(&Rational::new(a.into(), b.into())).expect("no power of zero")
        };
        let square = k.multiply(&k);
        let frequency = match self {
            Self::String => k,
            Self::Lattice => {
                number(2, 1).multiply(&k.multiply(&number(1, 2)).apply(Function::Sine))
            }
            Self::Cubic => k.subtract(&number(1, 12).multiply(&power(&k, 3, 1))),
            Self::StiffString => {
                k.multiply(&power(&number(1, 1).add(&number(1, 12).multiply(&square)), 1, 2))
            }
            Self::Beam => square,
            Self::Love => {
                let kappa = Formula::symbol(&Symbol::new("kappa").expect("a name"));
                k.multiply(&power(&number(1, 1).add(&kappa.multiply(&square)), -1, 2))
            }
        };
        Relation::new(frequency).expect("a formula in k")
    }
}
