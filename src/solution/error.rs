//! Why a wave cannot be given exactly.

use crate::expression::{InexactDivision, NotAUnit, NotInvertible};
use crate::recurrence::{Recurrence, WaveIndex};
use std::fmt;
use wavestep_polynomial::Polynomial;

/// Why a piece or an echo cannot be given exactly.
///
/// ```
/// use wavestep::language::{Source, read_recurrence};
/// use wavestep::solution::{Solution, Unsolvable};
///
/// let text = "recurrence \"Two rates\"\nsymbol a > 0, b > 0\nperiod 1, local s, time t\n\
///     wave f\nequation f[n]' + a*f[n] = exp(-b*t)\ncontinuous f[n] starts at 0\n";
/// let read = |text| read_recurrence(&Source::new("two rates", text)?, &Default::default());
/// // (exp(-b*s) - exp(-a*s))/(a - b): that a differs from b has to be stated.
/// let error = Solution::new(read(text.to_owned())?).pieces(0, 0, 0).unwrap_err();
/// assert!(matches!(error.reason, Unsolvable::NotInvertible(_)));
/// let stated = text.replace("period", "nonzero a - b\nperiod");
/// assert!(Solution::new(read(stated)?).pieces(0, 0, 0).is_ok());
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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

impl From<InexactDivision> for Unsolvable {
    fn from(reason: InexactDivision) -> Unsolvable {
        match reason {
            InexactDivision::NotInvertible(reason) => reason.into(),
            InexactDivision::NotAUnit(reason) => reason.into(),
        }
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
///
/// ```
/// use wavestep::language::{Source, read_recurrence};
/// use wavestep::solution::{Solution, Unsolvable};
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let source = Source::new("rigid-mass", text)?;
/// let solution = Solution::new(read_recurrence(&source, &Default::default())?);
/// let error = solution.pieces(0, 5000, 5000).unwrap_err();
/// assert_eq!((error.wave.as_str(), error.order), ("f", 5000));
/// assert_eq!(error.reason, Unsolvable::DegreeTooHigh);
/// let message = "f[5000] cannot be given exactly: its degree may exceed 4095";
/// assert_eq!(error.to_string(), message);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
        SolveError { wave: recurrence.wave_name(wave), order, reason }
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
