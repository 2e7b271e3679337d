//! Why a method has no value.

use crate::ball::BallError;
use crate::enclosure::EnclosureError;
use crate::signal::error::EvaluateError;
use crate::signal::taps::NoTaps;
use wavestep_kernels::TableError;
use wavestep_kernels::echoes::EchoError;
use wavestep_kernels::march::MarchError;

/// Why a method has no value.
#[expect(missing_docs, reason = "the messages say it")]
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MethodError {
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    #[error(transparent)]
    NoTaps(#[from] NoTaps),
    #[error(transparent)]
    Table(#[from] TableError),
    #[error(transparent)]
    Echoes(#[from] EchoError),
    #[error(transparent)]
    March(#[from] MarchError),
    /// By such a part of the largest value.
    #[error("rounding can change values by {0:.0e} of the largest one, since large parts cancel")]
    Cancels(f64),
    #[error("a time outside the window")]
    Outside,
    /// So many are asked for; `usize::MAX` where they were not counted.
    #[error("{}", too_many_periods(*periods, *limit))]
    TooManyPeriods { periods: usize, limit: usize },
}

impl From<EnclosureError> for MethodError {
    fn from(error: EnclosureError) -> MethodError {
        MethodError::Evaluate(error.into())
    }
}

impl From<BallError> for MethodError {
    fn from(error: BallError) -> MethodError {
        MethodError::Evaluate(error.into())
    }
}

fn too_many_periods(periods: usize, limit: usize) -> String {
    match periods {
        usize::MAX => format!("far more periods than the {limit} that this method supports"),
        _ => format!("{periods} periods; this method supports at most {limit}"),
    }
}
