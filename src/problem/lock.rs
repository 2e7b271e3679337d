//! Locks of a problem: pieces and values, or events where contacts open.

use super::bounds::refuse_pieces;
use super::{Kind, LockRefusal, Problem, ProblemError};
use crate::lock::{Difference, Extent, Lock, Request};
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
        if self.has_units() && !request.times.is_empty() {
            return Err(LockRefusal::ValuesWithUnits.into());
        }
        let through = through.ok_or(LockRefusal::NoLastPeriod)?;
        let constant = self.recurrence()?.constants().first();
        if let Some(constant) = constant.filter(|_| !request.times.is_empty()) {
            return Err(LockRefusal::ValuesWithConstants(constant.symbol.clone()).into());
        }
        self.pieces_to_lock(through, &request)
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

    fn pieces_to_lock(&self, through: usize, request: &Request) -> Result<Lock, ProblemError> {
        let solution = self.solution()?;
        refuse_pieces(solution.recurrence(), through)?;
        Ok(Lock::of_pieces(solution, through, request)?)
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
