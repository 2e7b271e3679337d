//! Values of a wave or an observable at times, with proven digits or in doubles, and fields along the
//! bars.

use super::error::equivalent_spring;
use super::{Kind, Problem, ProblemError, Wanted};
use crate::answer::{self, Accuracy, Doubles, Method, Question, Remark, Tested, Way, WayError};
use crate::expression::Fraction;
use crate::field::FieldEvaluator;
use crate::model::{Model as _, ModelError, Steps};
use crate::network::ScaledScene;
use crate::planner::{self, Origin, Purpose, Together};
use crate::signal::{self, EchoCount, EvaluateError, Limit, Signal, Value, reaching_a_double};
use num_traits::{Signed as _, ToPrimitive as _};
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
    /// What becomes of a value whose digits are not proven.
    pub undecided: Undecided,
}

/// What becomes of a value whose digits are not proven.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Undecided {
    /// It is an error.
    Refused,
    /// It is enclosed, and the others are told as well.
    Enclosed,
}

impl Digits {
    fn purpose(self) -> Purpose {
        match self.count_echoes {
            true => Purpose::Echoes,
            false => Purpose::Values { digits: self.count },
        }
    }
}

/// Values with proven digits.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Proven {
    /// One for each time.
    pub values: Vec<Value>,
    /// How many echoes there are, where they were counted.
    pub echoes: Option<EchoCount>,
    /// Where they come from.
    pub origin: Origin,
}

/// How far values by the method of steps are at most from those of the same motion, changed by [`Tested::NUDGE`] at each
/// change of a contact.
fn differing(
    scaled: &ScaledScene,
    (tolerance, place): (f64, usize),
    times: &[Rational],
    values: &[f64],
) -> Result<f64, ProblemError> {
    let times: Vec<f64> = times.iter().map(|time| time.to_f64().unwrap_or(f64::NAN)).collect();
    let nudged = Steps::new(scaled, tolerance).map(|steps| steps.nudged(Tested::NUDGE));
    let others = nudged.and_then(|steps| steps.values(place, &times)).map_err(WayError::from)?;
    let off = values.iter().zip(others).map(|(one, other)| (one - other).abs());
    Ok(off.fold(0.0, f64::max))
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
        let Digits { count, max_bits, limit, count_echoes, undecided } = digits;
        let (Some(from), Some(to)) = (times.iter().min(), times.iter().max()) else {
            let (echoes, origin) = (None, Origin::Closed);
            return Ok(Proven { values: Vec::new(), echoes, origin });
        };
        if count_echoes && !self.has_periods() {
            return Err(ProblemError::NoPeriodsWhereContactsOpen);
        }
        let all = |signal: &dyn Signal| -> Result<Vec<Value>, ProblemError> {
            let mut values = Vec::with_capacity(times.len());
            for time in times {
                match signal::digits(signal, time, limit, count, max_bits) {
                    Err(EvaluateError::AccuracyNotReached { best, .. })
                        if undecided == Undecided::Enclosed =>
                    {
                        values.push(Value::Enclosed(*best));
                    }
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
        let (window, purpose) = ([from, to], digits.purpose());
        let (Kind::Line { network, .. }, Some(observed)) = (&self.kind, &wanted.observed) else {
            let signal = self.signal_on(wanted, window, purpose)?;
            let values = all(&*signal)?;
            let echoes = if count_echoes { signal.echoes() } else { None };
            return Ok(Proven { values, echoes, origin: Origin::Closed });
        };
        let alone = [observed];
        let together = Together::new(network, &alone, window, purpose);
        let (origin, signal) = together.chosen(observed)?;
        match all(&*signal) {
            // On a lattice it shows late that a closed form is too much.
            Err(error) if error.is_too_much_of_a_closed_form() && !count_echoes => {
                let origin = Origin::Followed;
                let followed = together.of_origin(origin, observed);
                let values = all(&*followed.map_err(|_| error)?)?;
                Ok(Proven { values, echoes: None, origin })
            }
            values => {
                let values = values?;
                let echoes = if count_echoes { signal.echoes() } else { None };
                Ok(Proven { values, echoes, origin })
            }
        }
    }

    /// How values with proven digits are found, in words.
    pub fn how_found(&self, origin: Origin) -> &'static str {
        match origin {
            Origin::Closed => "in closed form: the sum of the echoes that have arrived",
            Origin::Followed if self.has_periods() => {
                "followed from cell to cell, which is cheaper here than the closed form"
            }
            Origin::Followed if self.local_contact().is_some() => {
                "followed from cell to cell, since a local contact is not linear"
            }
            Origin::Followed => "followed from cell to cell, since contacts open",
        }
    }

    /// Values in doubles, by a method or within a tolerance.
    pub fn doubles(
        &self,
        name: &str,
        times: &[Rational],
        limit: Limit,
        accuracy: Accuracy,
    ) -> Result<Doubles, ProblemError> {
        if let Accuracy::Method(method, None) = accuracy {
            let contact = self.local_contact();
            let is_stepped = matches!(method, Method::Steps { .. }) && !self.has_periods();
            if is_stepped || method.is_model() && contact.is_some() {
                return self.by_model(&self.wanted(name)?, (method, contact), times, limit);
            }
        }
        let first = times.iter().min().cloned().unwrap_or_default();
        let last = times.iter().max().cloned().unwrap_or_default();
        let purpose = match accuracy {
            Accuracy::Method(method, _) if method.needs_closed_contacts() => {
                Purpose::ClosedContacts
            }
            _ => Purpose::Polynomials,
        };
        let question = self.question_for(name, [first, last], purpose)?;
        Ok(answer::doubles(&question, times, limit, accuracy)?)
    }

    /// A wave or an observable on a window, for methods and models in doubles; where no double lies in the
    /// window, it is begun at the one before.
    pub fn question(
        &self,
        name: &str,
        window: [Rational; 2],
    ) -> Result<Question<'_>, ProblemError> {
        self.question_for(name, window, Purpose::Stretches)
    }

    /// The same for what is prepared for a purpose.
    pub fn question_for(
        &self,
        name: &str,
        window: [Rational; 2],
        purpose: Purpose,
    ) -> Result<Question<'_>, ProblemError> {
        let wanted = self.wanted(name)?;
        let window = reaching_a_double(window);
        let signal = self.signal_on(&wanted, window.each_ref(), purpose)?;
        let scene = self.network().ok().zip(wanted.place);
        let contacts_open = !self.has_periods() && purpose != Purpose::ClosedContacts;
        Ok(Question { signal, scene, contacts_open, costs: &self.costs })
    }

    /// Observables or waves on one window, in their order: a motion that is followed is followed once for all of them.
    ///
    /// # Errors
    /// Each as [`Problem::signal_on`].
    pub fn signals_on(
        &self,
        wanted: &[Wanted],
        window: [&Rational; 2],
        purpose: Purpose,
    ) -> Vec<Result<Box<dyn Signal + '_>, ProblemError>> {
        let observed: Option<Vec<_>> = wanted.iter().map(|one| one.observed.as_ref()).collect();
        match (&self.kind, observed) {
            (Kind::Line { network, .. }, Some(observed)) => {
                let together = Together::new(network, &observed, window, purpose);
                observed.iter().map(|own| Ok(together.chosen(own)?.1)).collect()
            }
            _ => wanted.iter().map(|one| self.signal_on(one, window, purpose)).collect(),
        }
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
                let signal = signal::of_recurrence(solution, &wanted.name, window)?;
                signal.ok_or_else(|| self.unknown(&wanted.name))
            }
            _ => Err(self.unknown(&wanted.name)),
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
        if let Some(contact) = self.local_contact() {
            return Err(ProblemError::NoPeriodsWithLocalContact(contact));
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

    /// Values by a model of a scene with a local contact.
    fn by_model(
        &self,
        wanted: &Wanted,
        (method, contact): (Method, Option<String>),
        times: &[Rational],
        limit: Limit,
    ) -> Result<Doubles, ProblemError> {
        let scaled = self.scaled()?;
        let place = wanted.place.expect("an observable of the scene");
        let none = Rational::default();
        let window = [times.iter().min(), times.iter().max()].map(|time| time.unwrap_or(&none));
        let way = Way::of_model(method, (scaled, place), window).map_err(|error| match error {
            WayError::Model(error @ ModelError::Refused { .. }) if contact.is_some() => {
                ProblemError::ModelOfLocalContact(error)
            }
            error => error.into(),
        })?;
        let values = way.exact_values(times, limit)?;
        let spring = contact.as_ref().and_then(|_| equivalent_spring(scaled));
        let tested = match method {
            Method::Steps { tolerance } => {
                let differs = match scaled.scene().contacts_open {
                    true => Some(differing(scaled, (tolerance, place), times, &values)?),
                    false => None,
                };
                Some(Remark::Tested(Tested { contact, tolerance, differs }))
            }
            _ => None,
        };
        let spring = spring.map(Remark::NearSpring);
        let remarks = tested.into_iter().chain([Remark::Law]).chain(spring).collect();
        Ok(Doubles { method, law: way.law(), bound: way.bound(), values, echoes: None, remarks })
    }
}
