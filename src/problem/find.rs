//! Events, fields, and what observables measure.

use super::{Kind, Problem, ProblemError, Wanted};
use crate::evaluate::EvaluateError;
use crate::field::FieldEvaluator;
use crate::history::History;
use crate::scene::{Joint, Measure};
use crate::signal::fields_of_scene;
use wavestep_polynomial::Rational;

#[doc(hidden)]
impl Problem {
    /// That every symbol of stated equations has a value.
    pub(super) fn has_numbers(&self) -> Result<(), ProblemError> {
        let Kind::Equations(solution) = &self.kind else { return Ok(()) };
        match solution.recurrence().symbols().next() {
            Some(symbol) => Err(EvaluateError::MissingValue(symbol.clone()).into()),
            None => Ok(()),
        }
    }

    /// What contacts do until a time; without one until nothing can meet again, at most for a hundred of
    /// the longest travel times.
    pub fn history(
        &self,
        until: Option<&Rational>,
        digits: usize,
    ) -> Result<History, ProblemError> {
        if let Kind::Equations(_) = &self.kind {
            return Err(ProblemError::EquationsHaveNoContacts);
        }
        let network = self.network()?;
        match network.scene().line.joints.contains(&Joint::Contact) {
            true => Ok(History::of(network, until, digits)?),
            false => Err(ProblemError::NoContact),
        }
    }

    /// Velocity, strain, displacement and force along the bars until a time.
    pub fn field_evaluator(&self, last: &Rational) -> Result<FieldEvaluator, ProblemError> {
        Ok(fields_of_scene(self.network()?, last)?)
    }

    /// What an observable measures; none where its terms differ, or where it is a wave.
    pub fn measure(&self, wanted: &Wanted) -> Option<Measure> {
        let mut observables = self.scaled().ok()?.scene().observables.iter();
        let own = observables.find(|own| own.name == wanted.name())?;
        let mut measures = own.terms.iter().map(|term| term.measure);
        let first = measures.next()?;
        measures.all(|other| other == first).then_some(first)
    }
}
