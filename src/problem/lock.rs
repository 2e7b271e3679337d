//! What is locked of a problem: pieces and values, or events where contacts open.

use super::bounds::refuse_pieces;
use super::{Kind, Problem, ProblemError};
use crate::lock::{Difference, HistoryLock, HistoryRequest, Lock, Locked, Request};
use wavestep_polynomial::{Rational, Symbol};

/// What is to be locked.
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

/// Why a problem is not locked as asked for.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum LockRefusal {
    /// Periods were asked for where contacts open.
    #[error("where contacts open there are no periods of which pieces could be locked")]
    PeriodsWhereContactsOpen,
    /// Events were asked for where no contacts open.
    #[error("there are no events here: no contacts open")]
    NoEvents,
    /// Values were asked for in a scene with units.
    #[error("values are not locked in scenes with units")]
    ValuesWithUnits,
    /// Values were asked for in a scene with this named constant.
    #[error("values are not locked in scenes with constants such as {0}")]
    ValuesWithConstants(Symbol),
    /// The last period is not given.
    #[error("it is not said through which period the pieces are to be locked")]
    NoLastPeriod,
    /// The lock holds pieces, and contacts open now.
    #[error("pieces are locked, and contacts open now")]
    PiecesLocked,
    /// The lock holds events, and no contacts open now.
    #[error("events are locked, and no contacts open now")]
    EventsLocked,
}

impl Problem {
    /// What is locked: derived now.
    ///
    /// # Errors
    /// [`ProblemError::Lock`] where there is no such thing to lock; [`ProblemError`] where it cannot be
    /// derived.
    pub fn lock(&self, asked: &ToLock) -> Result<Locked, ProblemError> {
        let ToLock { through, until, times, digits } = asked.clone();
        let set = self.values.clone();
        if self.contacts_open() {
            if through.is_some() {
                return Err(LockRefusal::PeriodsWhereContactsOpen.into());
            }
            let request = HistoryRequest { until, times, digits, set };
            return Ok(Locked::History(self.events_to_lock(&request)?));
        }
        if until.is_some() {
            return Err(LockRefusal::NoEvents.into());
        }
        if self.has_units() && !times.is_empty() {
            return Err(LockRefusal::ValuesWithUnits.into());
        }
        let through = through.ok_or(LockRefusal::NoLastPeriod)?;
        let constant = self.recurrence()?.constants().first();
        if let Some(constant) = constant.filter(|_| !times.is_empty()) {
            return Err(LockRefusal::ValuesWithConstants(constant.symbol.clone()).into());
        }
        Ok(Locked::Pieces(self.pieces_to_lock(&Request { through, times, digits, set })?))
    }

    /// In what the same that is locked, derived now, differs.
    ///
    /// # Errors
    /// As [`Problem::lock`].
    pub fn differences(&self, locked: &Locked) -> Result<Vec<Difference>, ProblemError> {
        match (locked, self.contacts_open()) {
            (Locked::Pieces(locked), false) => {
                Ok(locked.differences(&self.pieces_to_lock(locked.request())?))
            }
            (Locked::History(locked), true) => {
                Ok(locked.differences(&self.events_to_lock(locked.request())?))
            }
            (Locked::Pieces(_), true) => Err(LockRefusal::PiecesLocked.into()),
            (Locked::History(_), false) => Err(LockRefusal::EventsLocked.into()),
        }
    }

    fn pieces_to_lock(&self, request: &Request) -> Result<Lock, ProblemError> {
        let solution = self.solution()?;
        refuse_pieces(solution.recurrence(), request.through)?;
        Ok(Lock::derive(solution, request)?)
    }

    fn events_to_lock(&self, request: &HistoryRequest) -> Result<HistoryLock, ProblemError> {
        let Kind::Line { network, .. } = &self.kind else {
            return Err(LockRefusal::EventsLocked.into());
        };
        Ok(HistoryLock::derive(network, request)?)
    }
}
