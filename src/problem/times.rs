//! Times, with units where the scene has them.

use super::{Given, Kind, Problem, ProblemError, number};
use crate::ball::in_decimals;
use crate::enclosure::Numbers;
use crate::expression::Fraction;
use crate::language::{self, Source};
use crate::network::{Model, Network, ObservedValue};
use crate::scene::Dimension;
use crate::signal::{ClosedForm, EvaluateError};
use num_integer::Integer as _;
use num_traits::{Signed as _, ToPrimitive as _};
use wavestep_polynomial::{Rational, fraction};

#[doc(hidden)]
impl Problem {
    /// Whether times and values have units.
    pub fn has_units(&self) -> bool {
        self.scaled().is_ok_and(|scaled| scaled.scene().dimensional)
    }

    /// The unit of times, empty where there is none.
    pub fn time_unit(&self) -> &'static str {
        if self.has_units() { "s" } else { "" }
    }

    /// A time from 0 on, in seconds for scenes with units; errors call it by this name.
    pub fn time(&self, name: &str, time: impl Into<Given>) -> Result<Rational, ProblemError> {
        let time = self.quantity(name, time, Dimension::TIME)?;
        match time.is_negative() {
            true => Err(ProblemError::BeforeStart(self.told_time(&time))),
            false => Ok(time),
        }
    }

    /// A time as it is told: in decimals with its unit, where the scene has units.
    pub fn told_time(&self, time: &Rational) -> String {
        match self.has_units() {
            true => format!("{} s", in_decimals(time)),
            false => time.to_string(),
        }
    }

    /// Two times, the first before the last.
    pub fn between(&self, from: Rational, to: Rational) -> Result<[Rational; 2], ProblemError> {
        if from < to {
            return Ok([from, to]);
        }
        Err(ProblemError::EmptyWindow([from, to].map(|time| self.told_time(&time))))
    }

    /// A number with a unit of this dimension, where the scene has units and this one has a dimension.
    pub fn quantity(
        &self,
        name: &str,
        given: impl Into<Given>,
        dimension: Dimension,
    ) -> Result<Rational, ProblemError> {
        match given.into() {
            Given::Text(text) if self.has_units() && dimension != Dimension::NONE => {
                Ok(language::read_quantity(&Source::new(name, text)?, dimension)?)
            }
            Given::Text(text) => number(name, &text),
            given => given.number(name),
        }
    }

    /// The shortest time after which waves return, in the user's unit, where it is known exactly.
    pub fn shortest_period(&self) -> Option<Rational> {
        match &self.kind {
            Kind::Equations(solution) => solution.recurrence().statement().period.as_constant(),
            Kind::Line { network, .. } if network.local_contact().is_some() => None,
            Kind::Line { network, .. } => {
                let period = network.lattice().periods().first()?.as_constant()?;
                Some(period / network.model().slowness.as_constant()?)
            }
        }
    }
}

/// So many times from the first to the last, over one denominator before they are reduced.
pub fn evenly_spaced(from: &Rational, to: &Rational, points: usize) -> Vec<Rational> {
    let step = (to - from) / Rational::from_integer((points.max(2) - 1).into());
    let denominator = from.denom().lcm(step.denom());
    let [first, stride] = [from, &step].map(|value| value.numer() * (&denominator / value.denom()));
    (0..points).map(|i| fraction(&first + &stride * i, denominator.clone())).collect()
}

/// How many periods make a usual window at least, and how often a wave may pass the whole line in it.
const PERIODS: i64 = 4;
const PASSAGES: i64 = 2;

#[doc(hidden)]
impl Problem {
    /// Refuses stated equations with a symbol that has no value.
    pub(super) fn require_numbers(&self) -> Result<(), ProblemError> {
        let Kind::Equations(solution) = &self.kind else { return Ok(()) };
        match solution.recurrence().symbols().next() {
            Some(symbol) => Err(EvaluateError::MissingValue(symbol.clone()).into()),
            None => Ok(()),
        }
    }

    /// The usual length of a window: some periods, exactly where a period is rational, else a round number
    /// near them.
    pub fn usual_length(&self) -> Result<Rational, ProblemError> {
        self.require_numbers()?;
        let periods = Rational::from_integer(PERIODS.into());
        let network = match &self.kind {
            Kind::Equations(_) => {
                return Ok(self.shortest_period().ok_or(ProblemError::NoEnd)? * periods);
            }
            Kind::Line { network, .. } if network.local_contact().is_some() => {
                return Err(ProblemError::NoEnd);
            }
            Kind::Line { network, .. } => network,
        };
        if self.on_lattice() || network.all_linear().is_err() {
            let passages = travel_time(network)? * PASSAGES as f64;
            return two_figures(passages);
        }
        let period = network.lattice().periods().first().and_then(Fraction::as_constant);
        let periods = match period {
            Some(_) => periods.max(Passages::of(network).count),
            None => periods,
        };
        if let Some(period) = self.shortest_period() {
            return Ok(period * periods);
        }
        let linear = network.observables().iter().find_map(|observed| match &observed.value {
            ObservedValue::Linear(observation) => Some((observation, observed.unit.clone())),
            ObservedValue::Energy(_) => None,
        });
        let (observation, unit) = linear.ok_or(ProblemError::NoEnd)?;
        let form = ClosedForm::of_scene(network, observation, unit, &Rational::default())?;
        let period = form.period().ok_or(ProblemError::NoEnd)?;
        two_figures(period * periods.to_f64().unwrap_or(f64::NAN))
    }

    /// The same as a function of the symbols; none unless the scene has one period of which every travel time and delay is a
    /// known multiple.
    pub(super) fn usual_length_of_symbols(&self) -> Option<Fraction> {
        let network = self.network().ok()?;
        let [period] = network.lattice().periods() else { return None };
        let Passages { count, is_exact: true } = Passages::of(network) else { return None };
        let length = period * &network.model().slowness.inverse().ok()?;
        Some(length.scale(&count.max(Rational::from_integer(PERIODS.into()))))
    }

    /// Whether the usual length is the same for all values of symbols: no travel time, period, delay or unit of time contains
    /// one.
    pub(super) fn has_one_usual_length(&self) -> bool {
        let Ok(network) = self.network() else { return false };
        let Model { bars, constants, slowness, .. } = network.model();
        let numbers = Numbers::new(constants);
        let travels = bars.values().filter_map(|bar| bar.travel.as_ref());
        let times = travels.chain(network.lattice().periods()).chain(delays(network));
        let mut times = times.chain([slowness]);
        times.all(|time| numbers.enclose(time, f64::MANTISSA_DIGITS.into()).is_ok())
    }

    /// So many of the shortest period; where there is none, of the time that a wave needs for the line.
    pub fn some_periods(&self, count: i64) -> Result<Rational, ProblemError> {
        if let Some(period) = self.shortest_period() {
            return Ok(period * Rational::from_integer(count.into()));
        }
        match self.network() {
            Ok(network) if self.on_lattice() => two_figures(travel_time(network)? * count as f64),
            _ => match self.recurrence()?.symbols().next() {
                Some(symbol) => Err(EvaluateError::MissingValue(symbol.clone()).into()),
                None => Err(ProblemError::NoEnd),
            },
        }
    }
}

/// A length with two figures, and not less.
pub fn two_figures(length: f64) -> Result<Rational, ProblemError> {
    if !length.is_normal() {
        return Err(ProblemError::NoEnd);
    }
    let exponent = length.log10().floor() as i32 - 1;
    let steps = (length / 10_f64.powi(exponent)).ceil().to_i64().ok_or(ProblemError::NoEnd)?;
    Ok(Rational::from_integer(10.into()).pow(exponent) * Rational::from_integer(steps.into()))
}

/// How long a wave needs to pass the whole line, in the user's time.
fn travel_time(network: &Network) -> Result<f64, ProblemError> {
    let Model { constants, slowness, .. } = network.model();
    let numbers = Numbers::new(constants);
    let double = |value: &Fraction| -> Result<f64, ProblemError> {
        Ok(numbers
            .enclose(value, f64::MANTISSA_DIGITS.into())
            .map_err(EvaluateError::from)?
            .to_double()
            .0)
    };
    let travel = travel_of_line(network);
    Ok(double(&travel)? / double(slowness)?)
}

/// The delays of the waves of which observables are made.
fn delays(network: &Network) -> impl Iterator<Item = &Fraction> {
    let waves = network.observables().iter().flat_map(|observed| match &observed.value {
        ObservedValue::Linear(observation) => observation.waves.iter(),
        ObservedValue::Energy(_) => [].iter(),
    });
    waves.map(|wave| &wave.delay)
}

/// How long a wave needs from one end of the line to the other, in its scale.
fn travel_of_line(network: &Network) -> Fraction {
    let travels = network.model().bars.values().filter_map(|bar| bar.travel.as_ref());
    travels.fold(Fraction::zero(), |sum, own| &sum + own)
}

/// In how many periods a wave has passed the whole line twice and come to all places observed.
#[derive(Default)]
struct Passages {
    /// As far as it is known; else none.
    count: Rational,
    /// Whether every travel time and delay is a known multiple of the period.
    is_exact: bool,
}

impl Passages {
    fn of(network: &Network) -> Passages {
        let Some(period) = network.lattice().periods().first() else { return Passages::default() };
        let Ok(frequency) = period.inverse() else { return Passages::default() };
        let in_periods = |time: &Fraction| (time * &frequency).as_constant();
        let Some(travel) = in_periods(&travel_of_line(network)) else { return Passages::default() };
        let delays: Vec<Option<Rational>> = delays(network).map(in_periods).collect();
        let is_exact = delays.iter().all(Option::is_some);
        let latest = delays.into_iter().flatten().max().unwrap_or_default();
        let count = (travel * Rational::from_integer(PASSAGES.into()) + latest).ceil();
        Passages { count, is_exact }
    }
}
