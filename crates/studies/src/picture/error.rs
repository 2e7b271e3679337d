//! Why there is no picture.

use wavestep::evaluate::EvaluateError;
use wavestep::field::{FieldError, Quantity};
use wavestep::problem::ProblemError;
use wavestep_draw::PlotError;

/// Why there is no picture.
#[derive(Clone, Debug, thiserror::Error)]
pub enum PictureError {
    /// A field that has no diagram of place and time: it is not constant along characteristics.
    #[error("there is no diagram of the {}: give velocity, strain or force", .0.name())]
    NoDiagram(Quantity),
    /// The scene has no bars.
    #[error("the scene has no bar along which to draw")]
    NoBars,
    /// The scene observes nothing.
    #[error("nothing is observed in this scene")]
    NothingObserved,
    /// What is asked for has no course.
    #[error(transparent)]
    Problem(Box<ProblemError>),
    /// Numbers cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
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
