//! Values of a wave or an observable at times, with proven digits or in doubles, and fields along the
//! bars.

use super::error::equivalent_spring;
use super::{Kind, Problem, ProblemError, Wanted};
use crate::answer::{self, Accuracy, Doubles, Method, Question, Remark, Tested, Way, WayError};
use crate::expression::Fraction;
use crate::field::FieldEvaluator;
use crate::model::ModelError;
use crate::planner::{self, Purpose, Source};
use crate::signal::{self, ClosedSignal, EvaluateError, Limit, Signal, Value, reaching_a_double};
use num_traits::Signed as _;
use wavestep_polynomial::Rational;

/// How values with proven digits are asked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Digits {
    /// How many significant digits.
    pub count: usize,
    /// The most bits of working precision.
    pub max_bits: u64,
    /// The limit where an echo arrives.
    pub limit: Limit,
    /// Whether echoes are counted, which are worked out one by one then.
    pub count_echoes: bool,
}

/// Values with proven digits.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Proven {
    /// One for each time.
    pub values: Vec<Value>,
    /// How many echoes were worked out, of how many that can reach what is observed, where they were
    /// counted.
    pub echoes: Option<(usize, usize)>,
}

#[doc(hidden)]
impl Problem {
    /// Values with proven digits; `tick` is called after each.
    pub fn proven(
        &self,
        wanted: &Wanted,
        times: &[Rational],
        digits: Digits,
        tick: &dyn Fn(),
    ) -> Result<Proven, ProblemError> {
        let Digits { count, max_bits, limit, count_echoes } = digits;
        let (from, to) = match (times.iter().min(), times.iter().max(), &self.kind) {
            (_, _, Kind::LocalContact(_)) => return Err(self.not_certified(Accuracy::Digits)),
            (Some(from), Some(to), _) => (from, to),
            _ => return Ok(Proven { values: Vec::new(), echoes: None }),
        };
        if count_echoes && !self.has_periods() {
            return Err(ProblemError::NoPeriodsWhereContactsOpen);
        }
        let all = |signal: &dyn Signal| -> Result<Vec<Value>, ProblemError> {
            let mut values = Vec::with_capacity(times.len());
            for time in times {
                match signal::digits(signal, time, limit, count, max_bits) {
                    // More bits than those tried do not help.
                    Err(EvaluateError::AccuracyNotReached { best, .. })
                        if signal.most_bits() < u64::MAX =>
                    {
                        let (name, time) = (wanted.name.clone(), time.clone());
                        let best = best.to_decimal(count).to_string();
                        return Err(ProblemError::Undecided { name, time, best });
                    }
                    value => values.push(value?),
                }
                tick();
            }
            Ok(values)
        };
        let purpose = if count_echoes { Purpose::Echoes } else { Purpose::Values };
        let signal = self.signal_on(wanted, [from, to], purpose)?;
        let values = all(&*signal)?;
        Ok(Proven { values, echoes: if count_echoes { signal.echoes() } else { None } })
    }

    /// Where values with proven digits come from.
    pub fn source(&self) -> Source {
        self.network().map_or(Source::Closed, planner::source)
    }

    /// The method for values in doubles where digits cannot be proven and none is named.
    pub fn usual_method(&self) -> Option<Method> {
        matches!(self.kind, Kind::LocalContact(_)).then_some(Method::Steps { tolerance: 1e-10 })
    }

    /// Values in doubles, by a method or within a tolerance.
    pub fn doubles(
        &self,
        name: &str,
        times: &[Rational],
        limit: Limit,
        accuracy: Accuracy,
    ) -> Result<Doubles, ProblemError> {
        if let Kind::LocalContact(_) = &self.kind {
            return self.by_model(&self.wanted(name)?, times, limit, accuracy);
        }
        let first = times.iter().min().cloned().unwrap_or_default();
        let last = times.iter().max().cloned().unwrap_or_default();
        let question = self.question(name, [first, last])?;
        Ok(answer::doubles(&question, times, limit, accuracy)?)
    }

    /// A wave or an observable on a window, for methods and models in doubles; where no double lies in the
    /// window, it is begun at the one before.
    pub fn question(
        &self,
        name: &str,
        window: [Rational; 2],
    ) -> Result<Question<'_>, ProblemError> {
        let wanted = self.wanted(name)?;
        let window = reaching_a_double(window);
        let signal = self.signal_on(&wanted, window.each_ref(), Purpose::Stretches)?;
        Ok(Question { signal, scene: self.network().ok().zip(wanted.place) })
    }

    /// A wave or an observable as a function of time on a window.
    pub fn signal_on(
        &self,
        wanted: &Wanted,
        window: [&Rational; 2],
        purpose: Purpose,
    ) -> Result<Box<dyn Signal + '_>, ProblemError> {
        match (&self.kind, &wanted.observed) {
            (Kind::Line { network, .. }, Some(observed)) => {
                Ok(planner::of_scene(network, observed, window, purpose)?)
            }
            (Kind::Equations(solution), _) => {
                let observation = wanted.observation().expect("it is linear");
                Ok(Box::new(ClosedSignal::of_recurrence(solution, observation, window)?))
            }
            _ => Err(ProblemError::local_contact(self.scaled()?)),
        }
    }

    /// Velocity, strain, displacement and force along the bars until a time.
    pub fn field_evaluator(&self, last: &Rational) -> Result<FieldEvaluator<'_>, ProblemError> {
        Ok(FieldEvaluator::new(self.network()?, last)?)
    }

    /// The time at which so many periods of a quantity are over, and a local time has passed on the next.
    pub fn time_on_period(
        &self,
        wanted: &Wanted,
        n: usize,
        local: &Rational,
        limit: Limit,
    ) -> Result<Rational, ProblemError> {
        if let Kind::LocalContact(_) = &self.kind {
            return Err(ProblemError::NoPeriodsWithLocalContact(self.local_contact()));
        }
        if !self.has_periods() {
            return Err(ProblemError::NoPeriodsWhereContactsOpen);
        }
        let refuse = || ProblemError::NoPeriods(wanted.name.clone());
        let observation = wanted.observation().filter(|_| !self.has_units() && !self.on_lattice());
        let observation = observation.ok_or_else(refuse)?;
        let solution = self.solution()?;
        if let Some(symbol) = solution.recurrence().symbols().next() {
            return Err(EvaluateError::MissingValue(symbol.clone()).into());
        }
        let number = |value: &Fraction| value.as_constant().ok_or_else(refuse);
        let offset = number(&solution.offset(observation).ok_or_else(refuse)?)?;
        let period = number(&solution.recurrence().statement().period)?;
        let inside =
            !local.is_negative() && (*local < period || (*local == period && limit == Limit::Left));
        if !inside {
            return Err(ProblemError::OutsidePeriod(Box::new([local.clone(), period])));
        }
        Ok(offset + period * Rational::from_integer(n.into()) + local)
    }

    /// Values by a model of a scene that has no exact solution.
    fn by_model(
        &self,
        wanted: &Wanted,
        times: &[Rational],
        limit: Limit,
        accuracy: Accuracy,
    ) -> Result<Doubles, ProblemError> {
        let Accuracy::Method(method, None) = accuracy else {
            return Err(self.not_certified(accuracy));
        };
        let scaled = self.scaled()?;
        let place = wanted.place.expect("an observable of the scene");
        let way = Way::of_model(method, scaled, place).map_err(|error| match error {
            WayError::Model(error @ ModelError::Refused { .. }) => {
                ProblemError::ModelOfLocalContact(error)
            }
            error => error.into(),
        })?;
        let values = way.exact_values(times, limit)?;
        let tested = match method {
            Method::Steps { tolerance } => {
                Some(Remark::Tested(Tested { contact: self.local_contact(), tolerance }))
            }
            _ => None,
        };
        let spring = equivalent_spring(scaled).map(Remark::NearSpring);
        let remarks = tested.into_iter().chain([Remark::Law]).chain(spring).collect();
        Ok(Doubles { method, law: way.law(), bound: way.bound(), values, remarks })
    }

    /// The name of the local contact.
    pub(super) fn local_contact(&self) -> String {
        match self.network() {
            Err(ProblemError::LocalContact { contact, .. }) => contact,
            _ => String::new(),
        }
    }

    fn not_certified(&self, accuracy: Accuracy) -> ProblemError {
        let contact = self.local_contact();
        match accuracy {
            Accuracy::Within(tolerance) | Accuracy::Method(_, Some(tolerance)) => {
                ProblemError::NoProof(contact, tolerance)
            }
            Accuracy::Digits | Accuracy::Method(_, None) => ProblemError::NoDigits(contact),
        }
    }
}
