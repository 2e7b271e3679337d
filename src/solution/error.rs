//! Why a wave cannot be given exactly.

use crate::expression::{InexactDivision, NotAUnit, NotInvertible};
use crate::recurrence::{Recurrence, WaveIndex};
use wavestep_polynomial::Polynomial;

/// Why a piece or an echo cannot be given exactly.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unsolvable {
    /// Something would have to be divided by that is not known to be non-zero.
    #[error("it needs {0}")]
    NotInvertible(#[from] NotInvertible),
    /// A denominator cannot be carried through a substitution.
    #[error(transparent)]
    NotAUnit(#[from] NotAUnit),
    /// Polynomials of a higher degree than are worked with.
    #[error("its degree may exceed {}", Polynomial::MAX_EXPONENT)]
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

impl From<InexactDivision> for Unsolvable {
    fn from(reason: InexactDivision) -> Unsolvable {
        match reason {
            InexactDivision::NotInvertible(reason) => reason.into(),
            InexactDivision::NotAUnit(reason) => reason.into(),
        }
    }
}

/// A wave that cannot be solved for exactly on some period.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{wave}[{order}] cannot be given exactly: {reason}")]
pub struct SolveError {
    pub wave: String,
    pub order: usize,
    #[source]
    pub reason: Unsolvable,
}

impl SolveError {
    pub(crate) fn new(
        recurrence: &Recurrence,
        wave: WaveIndex,
        order: usize,
        reason: Unsolvable,
    ) -> SolveError {
        SolveError { wave: recurrence.wave_name(wave), order, reason }
    }
}
