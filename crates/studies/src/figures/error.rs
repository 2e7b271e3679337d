//! Why a figure is not drawn.

use crate::dispersion::DispersionError;
use crate::hertz::HertzError;
use crate::picture::PictureError;
use wavestep::evaluate::EvaluateError;
use wavestep::field::FieldError;
use wavestep::signal::SignalError;
use wavestep_draw::PlotError;

#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    #[error(
        "there is no figure {} that can be computed; those that can be are {}",
        .0,
        super::FIGURES.each_ref().map(|figure| figure.number).join(", ")
    )]
    Unknown(String),
    #[error(transparent)]
    Hertz(#[from] HertzError),
    #[error(transparent)]
    Dispersion(#[from] DispersionError),
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    #[error(transparent)]
    Signal(#[from] SignalError),
    #[error(transparent)]
    Picture(Box<PictureError>),
    #[error(transparent)]
    Plot(#[from] PlotError),
}

impl From<PictureError> for FigureError {
    fn from(error: PictureError) -> FigureError {
        FigureError::Picture(Box::new(error))
    }
}

impl From<FieldError> for FigureError {
    fn from(error: FieldError) -> FigureError {
        PictureError::from(error).into()
    }
}
