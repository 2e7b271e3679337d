//! Why there is no value.

use crate::ball::{Ball, BallError};
use crate::enclosure::EnclosureError;
use crate::expression::NotAUnit;
use crate::network::NetworkError;
use crate::solution::SolveError;
use wavestep_polynomial::{Integer, Symbol};

/// Why there is no value.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluateError {
    /// A symbol without a value.
    #[error("the symbol {0} has no value")]
    MissingValue(Symbol),
    /// The time has more periods before it than are worked out.
    #[error("{}", too_many_periods(periods, *limit))]
    TooManyPeriods {
        /// How many periods lie before the time.
        periods: Integer,
        /// How many are allowed.
        limit: usize,
    },
    /// An echo cannot be given exactly.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The precision allowed does not do.
    #[error(
        "accuracy not reached with {bits} bits; the best enclosure has radius {}", best.radius()
    )]
    AccuracyNotReached {
        /// The best enclosure.
        best: Box<Ball>,
        /// The precision tried last, in bits.
        bits: u64,
    },
    /// An enclosure could not be computed.
    #[error(transparent)]
    Ball(BallError),
    /// More echoes arrive until a time than are worked out.
    #[error("{}", too_many_echoes(*echoes, *limit))]
    TooManyEchoes {
        /// About how many; `u128::MAX` where they were not counted.
        echoes: u128,
        /// How many are allowed.
        limit: usize,
    },
    /// Echoes or pieces until a time would take more memory than is used for them.
    #[error(
        "the waves until this time would take about {gigabytes} GB of memory; until about {percent} % of \
         it they fit"
    )]
    TooMuchMemory {
        /// About how much memory they would take.
        gigabytes: u64,
        /// About what share of the time can be had.
        percent: u64,
    },
    /// A time after the last one that an evaluator was made for.
    #[error("the time is after the last one that was prepared for")]
    AfterLast,
    /// Waves that are followed from event to event, where sums of echoes or steps of periods are asked for.
    #[error("this method needs a closed form of the waves, and there is none")]
    NoClosedForm,
    /// A value that cannot be divided by.
    #[error(transparent)]
    Division(#[from] NotAUnit),
    /// The scene gives no recurrence.
    #[error(transparent)]
    Network(Box<NetworkError>),
    /// A window that would be cut into more cells than are made.
    #[error("the window needs more than {limit} polynomials: ask for a shorter one")]
    TooManyCells {
        /// How many are allowed.
        limit: usize,
    },
    /// More roots, or places of extrema, in a window than are listed.
    #[error("more than {limit} roots lie in this window")]
    TooManyRoots {
        /// How many are allowed.
        limit: usize,
    },
    /// A window that ends before it begins, or begins before time 0; for searches, also a single time.
    #[error("the window is empty, or begins before time 0")]
    EmptyWindow,
    /// A function that no polynomial of the degree allowed follows, however short the cell.
    #[error("the function is too steep for polynomials between neighbouring doubles")]
    TooSteep,
    /// An energy, where sums of echoes or steps of periods are asked for.
    #[error("this method sums waves; an energy is quadratic in them")]
    NotLinear,
    /// The openings of contacts cannot be followed with the precision that is needed.
    #[error("the openings of the contacts cannot be followed with {bits} bits")]
    NotFollowed {
        /// The precision in bits.
        bits: u64,
    },
    /// The value is a complex number that is not real: waves with one pole of a complex pair each.
    #[error("the value is not real")]
    NotReal,
}

fn too_many_periods(periods: &Integer, limit: usize) -> String {
    match periods.bits() > 64 {
        true => {
            format!("far more than the {limit} periods that are worked out lie before this time")
        }
        false => {
            format!("{periods} periods lie before this time, and at most {limit} are worked out")
        }
    }
}

fn too_many_echoes(echoes: u128, limit: usize) -> String {
    match echoes {
        u128::MAX => {
            format!("far more echoes arrive until this time than the {limit} that are worked out")
        }
        _ => {
            format!(
                "about {echoes} echoes arrive until this time, and at most {limit} are worked out"
            )
        }
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
