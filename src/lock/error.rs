//! Why nothing can be locked.

use crate::history::HistoryError;
use crate::planner::SignalError;
use crate::signal::EvaluateError;
use crate::solution::SolveError;

#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LockError {
    #[error(transparent)]
    Solve(#[from] SolveError),
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    #[error(transparent)]
    History(#[from] HistoryError),
    #[error(transparent)]
    Signal(Box<SignalError>),
    #[error("{0} significant digits cannot be certified")]
    Digits(usize),
    /// A number, by its name, that has no proven digits and is not so near to zero that it needs none.
    #[error("accuracy not reached: {0} has no proven digits")]
    AccuracyNotReached(String),
}

impl From<SignalError> for LockError {
    fn from(error: SignalError) -> LockError {
        LockError::Signal(Box::new(error))
    }
}
