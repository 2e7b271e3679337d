//! Why a method has no value.

use crate::evaluate::error::EvaluateError;
use crate::evaluate::taps::NoTaps;
use wavestep_kernels::TableError;
use wavestep_kernels::echoes::EchoError;
use wavestep_kernels::march::{MarchError, ReflectionError, SystemError, WaveMarchError};

/// Why a method has no value.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MethodError {
    /// The exact solution cannot be had.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    /// The method needs waves with one pole and one lag.
    #[error(transparent)]
    NoTaps(#[from] NoTaps),
    /// The polynomials make no table.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The echoes cannot be summed in doubles.
    #[error(transparent)]
    Echoes(#[from] EchoError),
    /// The reflection is none that can be marched.
    #[error(transparent)]
    Reflection(#[from] ReflectionError),
    /// The march of one wave cannot go on.
    #[error(transparent)]
    March(#[from] MarchError),
    /// The waves make no system that can be marched.
    #[error(transparent)]
    System(#[from] SystemError),
    /// The march of several waves cannot go on.
    #[error(transparent)]
    Waves(#[from] WaveMarchError),
    /// A time that is not within the window, or no number.
    #[error("a time outside the window")]
    Outside,
    /// The method takes fewer periods.
    #[error("{}", too_many_periods(*periods, *limit))]
    TooManyPeriods {
        /// How many are asked for; `usize::MAX` where they were not counted.
        periods: usize,
        /// How many are allowed.
        limit: usize,
    },
}

fn too_many_periods(periods: usize, limit: usize) -> String {
    match periods {
        usize::MAX => format!("far more periods than the {limit} that this method takes at most"),
        _ => format!("{periods} periods, where this method takes at most {limit}"),
    }
}
