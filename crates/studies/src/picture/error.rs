//! Why there is no picture.

use crate::dispersion::DispersionError;
use crate::hertz::HertzError;
use wavestep::field::{FieldError, Quantity};
use wavestep::problem::ProblemError;
use wavestep::signal::EvaluateError;
use wavestep_draw::PlotError;

#[derive(Clone, Debug, thiserror::Error)]
pub enum PictureError {
    #[error("there is no diagram of the {}", .0.name())]
    NoDiagram(Quantity),
    #[error("there is no computed figure {asked}; the computed figures are {known}")]
    NoFigure { asked: String, known: String },
    #[error("the scene has no bar to draw")]
    NoBars,
    #[error("this scene has no observables")]
    NothingObserved,
    #[error("values of {0} are too large for doubles, and cannot be drawn")]
    TooLarge(String),
    #[error(transparent)]
    Problem(Box<ProblemError>),
    #[error(transparent)]
    Hertz(#[from] HertzError),
    #[error(transparent)]
    Dispersion(#[from] DispersionError),
    #[error(transparent)]
    Plot(#[from] PlotError),
}

impl PictureError {
    /// What to do about it, where the problem has no remedy of its own.
    pub fn remedy(&self) -> &'static str {
        match self {
            PictureError::NoDiagram(_) => "give velocity, strain or force",
            PictureError::NoFigure { .. } => "`wavestep figure` lists all figures",
            PictureError::NoBars => "plot a wave or an observable against time",
            PictureError::NothingObserved => "name a wave, or add a line `observe` to the scene",
            PictureError::Plot(PlotError::NotDrawn(_)) => "choose another width",
            _ => "choose another quantity or window",
        }
    }
}

impl From<EvaluateError> for PictureError {
    fn from(error: EvaluateError) -> PictureError {
        ProblemError::from(error).into()
    }
}

impl From<FieldError> for PictureError {
    fn from(error: FieldError) -> PictureError {
        ProblemError::from(error).into()
    }
}

impl From<ProblemError> for PictureError {
    fn from(error: ProblemError) -> PictureError {
        PictureError::Problem(Box::new(error))
    }
}
