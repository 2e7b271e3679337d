//! Why there is no value.

use crate::ball::{Ball, BallError};
use crate::enclosure::EnclosureError;
use crate::expression::NotAUnit;
use crate::network::NetworkError;
use crate::solution::SolveError;
use wavestep_polynomial::{Integer, Symbol};

/// A value, or why there is none.
pub(crate) type Outcome<T> = Result<T, EvaluateError>;

/// Why there is no value.
#[expect(missing_docs, reason = "the messages say it")]
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluateError {
    #[error("the symbol {0} has no value")]
    MissingValue(Symbol),
    #[error("{}", too_many_periods(periods, *limit))]
    TooManyPeriods { periods: Integer, limit: usize },
    #[error(transparent)]
    Solve(#[from] SolveError),
    #[error(
        "accuracy not reached with {bits} bits; the best enclosure has radius {}", best.radius()
    )]
    AccuracyNotReached { best: Box<Ball>, bits: u64 },
    #[error("{bits} bits do not tell whether two instants are one")]
    InstantsUndecided { bits: u64 },
    #[error(transparent)]
    Ball(#[from] BallError),
    /// About so many arrive; `u128::MAX` where they were not counted.
    #[error("{}", too_many_echoes(*echoes, *limit))]
    TooManyEchoes { echoes: u128, limit: usize },
    #[error(
        "the waves until this time would take about {megabytes} MB of memory; they fit until about \
         {percent} % of it"
    )]
    TooMuchMemory { megabytes: u64, percent: u64 },
    #[error("the time is after the prepared window")]
    AfterLast,
    /// Waves that are followed from event to event, where sums of echoes or steps of periods are asked for.
    #[error(
        "this method needs waves in closed form; those of this scene are followed from event to event"
    )]
    NoClosedForm,
    #[error(transparent)]
    Division(#[from] NotAUnit),
    #[error(transparent)]
    Network(Box<NetworkError>),
    #[error("the window needs more than {limit} polynomials")]
    TooManyCells { limit: usize },
    #[error("this window has more than {limit} roots")]
    TooManyRoots { limit: usize },
    /// For searches, also a single time.
    #[error("the window is empty, or begins before time 0")]
    EmptyWindow,
    #[error("the function is too steep for polynomials between neighbouring doubles")]
    TooSteep,
    #[error("this method is for sums of waves, and this quantity is quadratic in them")]
    NotLinear,
    #[error(
        "with {bits} bits the scene is followed only up to an earlier time, and fewer bits do not decide this"
    )]
    NotFollowed { bits: u64 },
    /// The waves have one pole of a complex pair each.
    #[error("the value is not real")]
    NotReal,
}

fn too_many_periods(periods: &Integer, limit: usize) -> String {
    if periods.bits() > 64 {
        return format!(
            "there are far more periods before this time than the {limit} that are computed"
        );
    }
    format!("there are {periods} periods before this time; at most {limit} are computed")
}

fn too_many_echoes(echoes: u128, limit: usize) -> String {
    if echoes == u128::MAX {
        return format!(
            "far more echoes arrive until this time than the {limit} that are computed"
        );
    }
    format!("about {echoes} echoes arrive until this time; at most {limit} are computed")
}

impl EvaluateError {
    /// Whether a search ended before it was decided: what is known until then holds.
    pub(crate) fn is_unsettled(&self) -> bool {
        use EvaluateError::{
            AccuracyNotReached, InstantsUndecided, NotFollowed, TooManyCells, TooManyRoots,
        };
        matches!(
            self,
            AccuracyNotReached { .. }
                | InstantsUndecided { .. }
                | NotFollowed { .. }
                | TooManyCells { .. }
                | TooManyRoots { .. }
        )
    }

    /// Whether the closed form of waves takes more work or memory than is allowed.
    pub(crate) fn is_too_much(&self) -> bool {
        use EvaluateError::{TooManyEchoes, TooManyPeriods, TooMuchMemory};
        matches!(self, TooManyPeriods { .. } | TooManyEchoes { .. } | TooMuchMemory { .. })
    }
}

impl From<EnclosureError> for EvaluateError {
    fn from(error: EnclosureError) -> EvaluateError {
        match error {
            EnclosureError::MissingValue(symbol) => EvaluateError::MissingValue(symbol),
            EnclosureError::Ball(error) => EvaluateError::Ball(error),
            EnclosureError::NotReal => EvaluateError::NotReal,
            EnclosureError::Division(reason) => EvaluateError::Division(reason),
            EnclosureError::Undecided { best, bits } => {
                EvaluateError::AccuracyNotReached { best, bits }
            }
        }
    }
}

impl From<NetworkError> for EvaluateError {
    fn from(error: NetworkError) -> EvaluateError {
        match error {
            NetworkError::Division(reason) => EvaluateError::Division(reason),
            other => EvaluateError::Network(Box::new(other)),
        }
    }
}
