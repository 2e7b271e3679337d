//! Why a figure is not drawn.

use crate::dispersion::DispersionError;
use crate::hertz::HertzError;
use crate::picture::PictureError;
use wavestep::evaluate::EvaluateError;
use wavestep::field::FieldError;
use wavestep::history::HistoryError;
use wavestep_draw::PlotError;

/// Why a figure is not drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// There is no figure of this number, or none that can be computed.
    #[error(
        "there is no figure {} that can be computed; those that can be are {}",
        .0,
        super::FIGURES.each_ref().map(|figure| figure.number).join(", ")
    )]
    Unknown(String),
    /// A contact could not be computed.
    #[error(transparent)]
    Hertz(#[from] HertzError),
    /// A velocity could not be computed.
    #[error(transparent)]
    Dispersion(#[from] DispersionError),
    /// A value could not be computed.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    /// A scene could not be followed through the phases of its contacts.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// A scene could not be drawn.
    #[error(transparent)]
    Picture(Box<PictureError>),
    /// A chart could not be drawn.
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
