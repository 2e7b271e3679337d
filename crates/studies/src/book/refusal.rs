//! Why a formula cannot be judged.

use crate::dispersion::DispersionError;
use crate::hertz::HertzError;
use wavestep::ball::BallError;
use wavestep::enclosure::EnclosureError;
use wavestep::language::Diagnostic;
use wavestep::network::NetworkError;
use wavestep::recurrence::InvalidRecurrence;
use wavestep::signal::EvaluateError;
use wavestep::solution::{ObserveError, SolveError};

/// Why a formula of the source cannot be held against a scene.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    #[error("`{0}` is neither a wave nor a name of this section")]
    UnknownName(String),
    #[error("waves may be added, and multiplied or divided by what holds no wave; nothing else")]
    NotLinear,
    #[error("this value must be the same on every period: leave out waves and n")]
    DependsOnPeriod,
    #[error(
        "a divisor is a product of symbols and linear factors, an exponent free of exponentials; write \
         it as such"
    )]
    NotInvertible,
    #[error("the function `{0}` is not understood here; write exponentials")]
    Function(String),
    #[error(transparent)]
    Text(#[from] Diagnostic),
    #[error("`{text}` lacks `{mark}`")]
    NoMark { text: String, mark: String },
    #[error("`{0}` belongs to no equation")]
    StrayItem(String),
    #[error("`{0}` begins no line of a section")]
    UnknownLine(String),
    #[error("`{0}` is no item of an equation")]
    UnknownItem(String),
    #[error("the scene `{0}` has no common period; give bars with commensurable travel times")]
    NoPeriods(String),
    #[error("`{0}` has no value for a witness; list it under `values`")]
    NoValue(String),
    #[error("{0} differs from {1}")]
    Differs(String, String),
    #[error("{0} agrees with {1}")]
    Agrees(String, String),
    #[error("{0}")]
    Problem(String),
    #[error(transparent)]
    Solve(#[from] SolveError),
    #[error(transparent)]
    Observe(#[from] ObserveError),
    #[error(transparent)]
    Network(#[from] NetworkError),
    #[error(transparent)]
    Recurrence(#[from] InvalidRecurrence),
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    #[error(transparent)]
    Enclosure(#[from] EnclosureError),
    #[error(transparent)]
    Ball(#[from] BallError),
    #[error(transparent)]
    Hertz(#[from] HertzError),
    #[error(transparent)]
    Dispersion(#[from] DispersionError),
}
