//! Why a wave cannot be given exactly.

use crate::expression::{NotAUnit, NotInvertible};
use crate::recurrence::{Recurrence, WaveIndex};
use std::fmt;
use wavestep_polynomial::Polynomial;

/// Why a piece or an echo cannot be given exactly.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Unsolvable {
    /// Something would have to be divided by that is not known to be non-zero.
    NotInvertible(NotInvertible),
    /// A denominator cannot be carried through a substitution.
    NotAUnit(NotAUnit),
    /// Polynomials of a higher degree than are worked with.
    DegreeTooHigh,
}

/// Refuses orders whose polynomials may have too high a degree.
pub(crate) fn check_degree(
    recurrence: &Recurrence,
    wave: WaveIndex,
    order: usize,
) -> Result<(), SolveError> {
    match recurrence.degree_estimate(order) <= u64::from(Polynomial::MAX_EXPONENT) {
        true => Ok(()),
        false => Err(SolveError::new(recurrence, wave, order, Unsolvable::DegreeTooHigh)),
    }
}

impl From<NotInvertible> for Unsolvable {
    fn from(reason: NotInvertible) -> Unsolvable {
        Unsolvable::NotInvertible(reason)
    }
}

impl From<NotAUnit> for Unsolvable {
    fn from(reason: NotAUnit) -> Unsolvable {
        Unsolvable::NotAUnit(reason)
    }
}

/// A wave that cannot be solved for exactly on some period.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SolveError {
    /// The wave.
    pub wave: String,
    /// The period or echo.
    pub order: usize,
    /// What stands in the way.
    pub reason: Unsolvable,
}

impl SolveError {
    pub(crate) fn new(
        recurrence: &Recurrence,
        wave: WaveIndex,
        order: usize,
        reason: Unsolvable,
    ) -> SolveError {
        SolveError { wave: recurrence.statement().waves[wave].clone(), order, reason }
    }
}

impl fmt::Display for SolveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SolveError { wave, order, reason } = self;
        write!(f, "{wave}[{order}] cannot be given exactly: ")?;
        match reason {
            Unsolvable::NotInvertible(reason) => write!(f, "it needs {reason}"),
            Unsolvable::NotAUnit(reason) => write!(f, "{reason}"),
            Unsolvable::DegreeTooHigh => {
                write!(f, "its degree may exceed {}", Polynomial::MAX_EXPONENT)
            }
        }
    }
}

impl std::error::Error for SolveError {}
