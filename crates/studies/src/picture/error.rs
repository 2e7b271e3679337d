//! Why there is no picture.

use std::fmt;
use wavestep::evaluate::EvaluateError;
use wavestep::field::{FieldError, Quantity};
use wavestep_draw::PlotError;

/// Why there is no picture.
///
/// ```
/// use wavestep_studies::picture::PictureError;
/// use wavestep_draw::PlotError;
///
/// let error = PictureError::from(PlotError::Empty { title: "Nothing".into() });
/// assert!(error.to_string().contains("nothing to draw"));
/// ```
#[derive(Clone, PartialEq, Debug)]
pub enum PictureError {
    /// A field that has no diagram of place and time: it is not constant along characteristics.
    NoDiagram(Quantity),
    /// The scene has no bars.
    NoBars,
    /// What is shown cannot be evaluated.
    Evaluate(EvaluateError),
    /// Fields cannot be given.
    Field(FieldError),
    /// Numbers cannot be drawn.
    Plot(PlotError),
}

impl fmt::Display for PictureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PictureError::NoDiagram(quantity) => write!(
                f,
                "there is no diagram of the {}: give velocity, strain or force",
                quantity.name()
            ),
            PictureError::NoBars => f.write_str("the scene has no bar along which to draw"),
            PictureError::Evaluate(error) => error.fmt(f),
            PictureError::Field(error) => error.fmt(f),
            PictureError::Plot(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for PictureError {}

impl From<EvaluateError> for PictureError {
    fn from(error: EvaluateError) -> PictureError {
        PictureError::Evaluate(error)
    }
}

impl From<FieldError> for PictureError {
    fn from(error: FieldError) -> PictureError {
        match error {
            FieldError::Evaluate(error) => PictureError::Evaluate(error),
            error => PictureError::Field(error),
        }
    }
}

impl From<PlotError> for PictureError {
    fn from(error: PlotError) -> PictureError {
        PictureError::Plot(error)
    }
}
