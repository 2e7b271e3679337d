//! Errors in dispersion relations, in pulses, and in what is asked of them.

use wavestep_polynomial::{Rational, Symbol};

use super::formula::FormulaError;
use super::series::Fault;
use wavestep::ball::{Ball, BallError, DecimalEnclosure};

/// Digits of places in messages.
const PLACE_DIGITS: usize = 8;

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DispersionError {
    #[error("the formula does not depend on the wavenumber k")]
    NoWaveNumber,
    #[error("the parameter {0} has no value")]
    MissingValue(Symbol),
    #[error("the relation has no parameter `{0}`")]
    UnknownParameter(String),
    #[error("`{0}` is {1}, which is not positive")]
    ParameterNotPositive(String, Rational),
    #[error("{0} is {1}, which is not positive")]
    NotPositive(&'static str, Rational),
    #[error("with these values there is {0}")]
    Formula(#[from] FormulaError),
    #[error("ω is negative at k = {0}, so it is not a frequency")]
    NegativeFrequency(Box<DecimalEnclosure>),
    #[error("the formula is not real at k = {0}")]
    NotReal(Box<DecimalEnclosure>),
    #[error("a divisor in the formula may be zero at k = {0}")]
    DivisionByZero(Box<DecimalEnclosure>),
    #[error("the formula may have no derivative at k = {0}: a root of zero")]
    NotDifferentiable(Box<DecimalEnclosure>),
    #[error("ω(k)·τ = 2π has no root for 0 < k ≤ {through}; larger k are not searched")]
    NoCutOff { through: Box<DecimalEnclosure> },
    #[error("undecided whether ω(k)·τ = 2π has a root near k = {0}")]
    UndecidedCutOff(Box<DecimalEnclosure>),
    #[error("∫ U k² dk may be zero, so the pulse has no peak to follow")]
    NoPeak,
    #[error("the requested digits are not reached with {bits} bits{}", best_known(best.as_deref()))]
    AccuracyNotReached { best: Option<Box<Ball>>, bits: u64 },
    #[error(transparent)]
    Ball(BallError),
    #[error(transparent)]
    Grid(#[from] NoGrid),
}

/// A place in a message.
pub(super) fn place(k: &Ball) -> Box<DecimalEnclosure> {
    Box::new(k.to_decimal(PLACE_DIGITS))
}

impl DispersionError {
    /// The error of a formula near a wavenumber.
    pub(super) fn at(fault: Fault, k: &Ball) -> DispersionError {
        match fault {
            Fault::MissingValue(symbol) => DispersionError::MissingValue(symbol),
            Fault::Divisor => DispersionError::DivisionByZero(place(k)),
            Fault::NotReal => DispersionError::NotReal(place(k)),
            Fault::RootOfZero => DispersionError::NotDifferentiable(place(k)),
            Fault::Ball(error) => DispersionError::Ball(error),
        }
    }

    pub fn remedy(&self) -> String {
        match self {
            Self::NoWaveNumber => "write ω as a formula in k, such as 2*sin(k/2)".to_owned(),
            Self::MissingValue(symbol) => format!("set it: --set {symbol}=1"),
            Self::UnknownParameter(_) => "remove it, or use it in the relation".to_owned(),
            Self::NotPositive(..) | Self::ParameterNotPositive(..) => {
                "give a positive number".to_owned()
            }
            Self::Formula(_) => "give other values".to_owned(),
            Self::NegativeFrequency(_) => {
                "stay below this wavenumber, with a longer pulse where there is one, or take another relation".to_owned()
            }
            Self::NotReal(_) | Self::DivisionByZero(_) | Self::NotDifferentiable(_) => {
                "stay where the formula is smooth: take a longer pulse, or another formula"
                    .to_owned()
            }
            Self::NoCutOff { .. } => "use a longer duration, or a pulse given in space".to_owned(),
            Self::UndecidedCutOff(_) => {
                "change the duration a little: 2π/τ may be a maximum of ω".to_owned()
            }
            Self::NoPeak => "give a spectrum that is positive".to_owned(),
            Self::AccuracyNotReached { .. } => "use fewer digits".to_owned(),
            Self::Ball(_) => "use smaller wavenumbers".to_owned(),
            Self::Grid(reason) => reason.remedy().to_owned(),
        }
    }
}

fn best_known(best: Option<&Ball>) -> String {
    best.map_or_else(String::new, |best| format!("; the best enclosure is {best}"))
}

/// Why times and counts make no grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoGrid {
    #[error("the wavenumber is not a finite number")]
    WaveNumber,
    #[error("the time of travel is not positive")]
    Time,
    #[error("the grid would need more than {limit} points")]
    TooLong { limit: usize },
    #[error("the grid needs more than {least} points, and at most {limit}")]
    Points { least: usize, limit: usize },
}

impl NoGrid {
    fn remedy(self) -> &'static str {
        match self {
            Self::WaveNumber => "give a finite wavenumber",
            Self::Time => "give a positive time",
            Self::TooLong { .. } => "give a shorter time of travel, or a longer pulse",
            Self::Points { .. } => "give other --points, or none",
        }
    }
}
