//! Locks of a problem: pieces and values, or events where contacts open.

use super::bounds::{refuse_echoes, refuse_pieces};
use super::{Kind, LockRefusal, Problem, ProblemError};
use crate::lock::{Derivable, Difference, Extent, Lock, Request};
use wavestep_polynomial::Rational;

/// The results to lock.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ToLock {
    /// The last period of which pieces are locked.
    pub through: Option<usize>,
    /// Until when events are locked, where contacts open.
    pub until: Option<Rational>,
    /// When values are locked.
    pub times: Vec<Rational>,
    /// How many significant digits they have.
    pub digits: usize,
}

#[doc(hidden)]
impl Problem {
    /// What is locked: derived now.
    pub fn lock(&self, asked: &ToLock) -> Result<Lock, ProblemError> {
        let ToLock { through, until, times, digits } = asked.clone();
        let request = Request { times, digits, set: self.values.clone() };
        if !self.has_periods() {
            if through.is_some() {
                return Err(LockRefusal::PeriodsWhereContactsOpen.into());
            }
            return self.events_to_lock(until, &request);
        }
        if until.is_some() {
            return Err(LockRefusal::NoEvents.into());
        }
        match through.is_none() && request.times.is_empty() {
            true => Err(LockRefusal::NoLastPeriod.into()),
            false => self.pieces_to_lock(through, &request),
        }
    }

    /// How the problem, derived now, differs from a lock.
    pub fn differences(&self, locked: &Lock) -> Result<Vec<Difference>, ProblemError> {
        let now = match (locked.extent(), self.has_periods()) {
            (Extent::Pieces { through }, true) => self.pieces_to_lock(through, locked.request())?,
            (Extent::Events { until }, false) => self.events_to_lock(until, locked.request())?,
            (Extent::Pieces { .. }, false) => return Err(LockRefusal::PiecesLocked.into()),
            (Extent::Events { .. }, true) => return Err(LockRefusal::EventsLocked.into()),
        };
        Ok(locked.differences(&now))
    }

    fn pieces_to_lock(
        &self,
        through: Option<usize>,
        request: &Request,
    ) -> Result<Lock, ProblemError> {
        let network = self.network().ok();
        if let (Some(network), true) = (network, self.on_lattice()) {
            if let Some(through) = through {
                refuse_echoes(network, network.waves().len(), through)?;
            }
            return Ok(Lock::of_pieces(Derivable::Scene(network, None), through, request)?);
        }
        let solution = self.solution()?;
        if let Some(through) = through {
            refuse_pieces(solution.recurrence(), through)?;
        }
        let from = match network {
            Some(network) => Derivable::Scene(network, Some(solution)),
            None => Derivable::Equations(solution),
        };
        Ok(Lock::of_pieces(from, through, request)?)
    }

    fn events_to_lock(
        &self,
        until: Option<Rational>,
        request: &Request,
    ) -> Result<Lock, ProblemError> {
        let Kind::Line { network, .. } = &self.kind else {
            return Err(LockRefusal::EventsLocked.into());
        };
        Ok(Lock::of_events(network, until, request)?)
    }
}
