//! Waves and observables by name.

use super::{Kind, Problem, ProblemError};
use crate::expression::{Expression, Fraction, Root};
use crate::language;
use crate::network::{Network, Observed, ObservedValue};
use crate::recurrence::{Observation, ObservedWave};
use crate::scene::{Dimension, Measure};

/// A wave or an observable of a problem.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Wanted {
    pub name: String,
    /// The dimension of its values; none for waves, and in scenes without units.
    pub dimension: Dimension,
    /// What it is in waves; `None` for a sum of products of those of a recurrence.
    pub(super) observed: Option<Observed>,
    /// Its place among the observables of a scene.
    pub(super) place: Option<usize>,
}

impl Wanted {
    /// The unit of its values, empty where there is none.
    pub fn unit(&self) -> String {
        self.dimension.unit()
    }

    /// What it is where it is linear in the waves.
    pub fn observation(&self) -> Option<&Observation> {
        match &self.observed.as_ref()?.value {
            ObservedValue::Linear(observation) => Some(observation),
            ObservedValue::Energy(_) => None,
        }
    }

    fn of_observed(observed: Observed, place: Option<usize>) -> Wanted {
        let (name, dimension) = (observed.name.clone(), observed.dimension);
        Wanted { name, dimension, observed: Some(observed), place }
    }

    fn linear(name: &str, observation: Observation) -> Wanted {
        let value = ObservedValue::Linear(observation);
        let (name, readings, unit) = (name.to_owned(), Vec::new(), Root::from(Fraction::one()));
        let (balance, dimension) = (None, Dimension::NONE);
        let observed = Observed { name, value, readings, balance, acts: None, unit, dimension };
        Wanted::of_observed(observed, None)
    }
}

impl Problem {
    /// What is observed, in the order of the text.
    pub fn observables(&self) -> Vec<&str> {
        match self.stated() {
            Err(equations) => equations.observed(),
            Ok(scene) => scene.observables.iter().map(|own| own.name.as_str()).collect(),
        }
    }

    /// The waves that are stated or derived; none where there is a local contact.
    pub fn waves(&self) -> Vec<&str> {
        match &self.kind {
            Kind::Equations(solution) => {
                solution.recurrence().statement().waves.iter().map(String::as_str).collect()
            }
            Kind::Line { network, .. } if network.local_contact().is_some() => Vec::new(),
            Kind::Line { network, .. } => {
                network.waves().iter().map(|wave| wave.name.as_str()).collect()
            }
        }
    }
}

#[doc(hidden)]
impl Problem {
    /// The wave or observable of this name.
    pub fn wanted(&self, name: &str) -> Result<Wanted, ProblemError> {
        let known = language::normalise_name(name);
        let found = match &self.kind {
            Kind::Equations(solution) => {
                let recurrence = solution.recurrence();
                let quadratic = || {
                    let (name, dimension) = (known.clone(), Dimension::NONE);
                    recurrence.quadratic(&known)?;
                    Some(Wanted { name, dimension, observed: None, place: None })
                };
                let observation = recurrence.observation(&known);
                observation
                    .map(|observation| Wanted::linear(&known, observation))
                    .or_else(quadratic)
            }
            Kind::Line { network, .. } => {
                let found = of_network(network, &known);
                if !self.has_periods() && found.as_ref().is_some_and(|found| found.place.is_none())
                {
                    return Err(ProblemError::WaveOfClosedContacts(known));
                }
                found
            }
        };
        found.ok_or_else(|| self.unknown(name))
    }

    /// What an observable measures; none where its terms differ, or where it is a wave.
    pub fn measure(&self, wanted: &Wanted) -> Option<Measure> {
        let mut observables = self.scaled().ok()?.scene().observables.iter();
        let own = observables.find(|own| own.name == wanted.name)?;
        let mut measures = own.terms.iter().map(|term| term.measure);
        let first = measures.next()?;
        measures.all(|other| other == first).then_some(first)
    }

    /// Why nothing is known of this name.
    pub(crate) fn unknown(&self, name: &str) -> ProblemError {
        let names = self.names().map(str::to_owned).collect();
        ProblemError::Unknown { name: name.to_owned(), names }
    }

    /// What is looked at where nothing is named: the first observable, or the first wave.
    pub fn usual_quantity(&self) -> Option<&str> {
        self.observables().first().or(self.waves().first()).copied()
    }

    /// All that can be asked for, in the order of the statements it comes from.
    fn names(&self) -> impl Iterator<Item = &str> {
        let (mut first, mut then) = (self.observables(), self.waves());
        match self.kind {
            Kind::Equations(_) => std::mem::swap(&mut first, &mut then),
            // Its waves are those of closed contacts.
            Kind::Line { .. } if !self.has_periods() => then.clear(),
            Kind::Line { .. } => {}
        }
        first.into_iter().chain(then)
    }
}

fn of_network(network: &Network, name: &str) -> Option<Wanted> {
    let observables = network.observables();
    if let Some(place) = observables.iter().position(|observed| observed.name == name) {
        return Some(Wanted::of_observed(observables[place].clone(), Some(place)));
    }
    let wave = network.waves().iter().position(|wave| wave.name == name)?;
    let seen = ObservedWave::new(wave, Fraction::zero(), &Fraction::one());
    let observation = Observation { waves: vec![seen], forcing: Expression::zero() };
    Some(Wanted::linear(name, observation))
}
