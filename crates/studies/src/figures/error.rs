//! Why a figure is not drawn.

use crate::dispersion::DispersionError;
use crate::hertz::HertzError;
use crate::picture::PictureError;
use std::fmt;
use wavestep::evaluate::EvaluateError;
use wavestep::field::FieldError;
use wavestep::history::HistoryError;
use wavestep_draw::PlotError;

/// Why a figure is not drawn.
///
/// ```
/// use wavestep_studies::figures::{FigureError, find};
///
/// assert!(matches!(find("7.1"), Err(FigureError::Unknown(_))));
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub enum FigureError {
    /// There is no figure of this number, or none that can be computed.
    Unknown(String),
    /// A contact could not be computed.
    Hertz(HertzError),
    /// A velocity could not be computed.
    Dispersion(Box<DispersionError>),
    /// A value could not be computed.
    Evaluate(Box<EvaluateError>),
    /// A scene could not be followed through the phases of its contacts.
    History(Box<HistoryError>),
    /// A scene could not be drawn.
    Picture(Box<PictureError>),
    /// A chart could not be drawn.
    Plot(PlotError),
}

impl fmt::Display for FigureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(number) => {
                let numbers: Vec<&str> =
                    super::FIGURES.iter().map(|figure| figure.number).collect();
                write!(
                    f,
                    "there is no figure {number} that can be computed; those that can be are {}",
                    numbers.join(", ")
                )
            }
            Self::Hertz(error) => error.fmt(f),
            Self::Dispersion(error) => error.fmt(f),
            Self::Evaluate(error) => error.fmt(f),
            Self::History(error) => error.fmt(f),
            Self::Picture(error) => error.fmt(f),
            Self::Plot(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for FigureError {}

macro_rules! from {
    ($error:ty, $variant:ident) => {
        impl From<$error> for FigureError {
            fn from(error: $error) -> FigureError {
                FigureError::$variant(error.into())
            }
        }
    };
}

from!(HertzError, Hertz);
from!(DispersionError, Dispersion);
from!(EvaluateError, Evaluate);
from!(HistoryError, History);
from!(PictureError, Picture);
from!(PlotError, Plot);

impl From<FieldError> for FigureError {
    fn from(error: FieldError) -> FigureError {
        PictureError::from(error).into()
    }
}
