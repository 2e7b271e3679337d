//! Why a formula cannot be judged.

use crate::dispersion::DispersionError;
use crate::hertz::HertzError;
use wavestep::ball::BallError;
use wavestep::enclosure::EnclosureError;
use wavestep::evaluate::EvaluateError;
use wavestep::language::Diagnostic;
use wavestep::network::NetworkError;
use wavestep::recurrence::InvalidRecurrence;
use wavestep::solution::{ObserveError, SolveError};

/// Why a formula of the source cannot be held against a scene.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// A name that neither the source nor the scene knows.
    #[error("`{0}` is neither a wave nor a name of this section")]
    UnknownName(String),
    /// A product of waves.
    #[error("waves may be added, and multiplied or divided by what holds no wave; nothing else")]
    NotLinear,
    /// A value that has to be free of waves and of n is not.
    #[error("this value must be the same on every period: leave out waves and n")]
    DependsOnPeriod,
    /// A divisor, or an exponent, that has no exact inverse here.
    #[error(
        "a divisor is a product of symbols and linear factors, an exponent free of exponentials; write \
         it as such"
    )]
    NotInvertible,
    /// A function that formulas of the source do not need.
    #[error("the function `{0}` is not understood here; write exponentials")]
    Function(String),
    /// The text of a formula or of a scene.
    #[error(transparent)]
    Text(#[from] Diagnostic),
    /// A text without a mark that parts it.
    #[error("`{text}` lacks `{mark}`")]
    NoMark {
        /// The text.
        text: String,
        /// The mark.
        mark: String,
    },
    /// An item before the first equation of a section.
    #[error("`{0}` belongs to no equation")]
    StrayItem(String),
    /// A word that begins no line of a section.
    #[error("`{0}` begins no line of a section")]
    UnknownLine(String),
    /// A word that begins no item of an equation.
    #[error("`{0}` is no item of an equation")]
    UnknownItem(String),
    /// The scene has no periods.
    #[error("the scene `{0}` has no common period; give commensurate bars")]
    NoPeriods(String),
    /// A symbol needs a value for a witness.
    #[error("`{0}` has no value for a witness; list it under `values`")]
    NoValue(String),
    /// Two sides of a check that should agree.
    #[error("{0} differs from {1}")]
    Differs(String, String),
    /// Two sides of a check that should differ.
    #[error("{0} agrees with {1}")]
    Agrees(String, String),
    /// A piece cannot be derived.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// An observable cannot be derived.
    #[error(transparent)]
    Observe(#[from] ObserveError),
    /// The scene gives no waves.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// A notation does not suit its recurrence.
    #[error(transparent)]
    Recurrence(#[from] InvalidRecurrence),
    /// A value cannot be computed.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    /// A value cannot be enclosed.
    #[error(transparent)]
    Enclosure(#[from] EnclosureError),
    /// Enclosures have no quotient.
    #[error(transparent)]
    Ball(#[from] BallError),
    /// A contact cannot be computed.
    #[error(transparent)]
    Hertz(#[from] HertzError),
    /// A velocity cannot be computed.
    #[error(transparent)]
    Dispersion(#[from] DispersionError),
}
