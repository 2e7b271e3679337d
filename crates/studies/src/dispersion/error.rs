//! What can be wrong with a dispersion relation, a pulse, or what is asked of them.

use std::fmt;

use wavestep_polynomial::{Rational, Symbol};

use super::formula::FormulaError;
use super::series::Fault;
use wavestep::ball::{Ball, BallError, DecimalEnclosure};

/// Digits of places in messages.
const PLACE_DIGITS: usize = 8;

/// Why there is no answer.
///
/// ```
/// use wavestep_studies::dispersion::{Builtin, DispersionError, Pulse, Shape, peak_velocity};
/// use wavestep_polynomial::Rational;
///
/// // 2 sin(k/2) never exceeds 2: nothing oscillates 2π/2 times in a unit of time.
/// let lattice = Builtin::Lattice.relation();
/// let pulse = Pulse::in_time(Shape::Square, &Rational::from_integer(2.into()))?;
/// let error = peak_velocity(&lattice, &pulse, 10, 1000).unwrap_err();
/// assert!(matches!(error, DispersionError::NoCutOff { .. }));
/// assert!(error.to_string().starts_with("ω(k)·τ = 2π has no root"));
/// assert!(error.remedy().contains("longer duration"));
/// # Ok::<(), DispersionError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DispersionError {
    /// A formula for ω that does not depend on `k`.
    NoWaveNumber,
    /// A parameter without a value.
    MissingValue(Symbol),
    /// A value that is given for what is no parameter of the relation.
    UnknownParameter(String),
    /// A value of a parameter that is not positive.
    ParameterNotPositive(String, Rational),
    /// A length, a duration or a time that is not positive.
    NotPositive(&'static str, Rational),
    /// A formula that has no value once values are put in.
    Formula(FormulaError),
    /// ω is negative at this wavenumber: it is no frequency.
    NegativeFrequency(Box<DecimalEnclosure>),
    /// The formula has no real value at this wavenumber.
    NotReal(Box<DecimalEnclosure>),
    /// A divisor vanishes at this wavenumber, or near it.
    DivisionByZero(Box<DecimalEnclosure>),
    /// A root has no derivative at this wavenumber, or near it.
    NotDifferentiable(Box<DecimalEnclosure>),
    /// `ω(k) τ = 2π` has no root for `0 < k ≤ through`.
    NoCutOff {
        /// How far was looked, or where ω stops being positive.
        through: Box<DecimalEnclosure>,
    },
    /// Whether there is a root near this wavenumber is not decided.
    UndecidedCutOff(Box<DecimalEnclosure>),
    /// The spectrum's second moment may be zero, so no peak is defined.
    NoPeak,
    /// The digits asked for are not reached.
    AccuracyNotReached {
        /// The best enclosure, where there is one.
        best: Option<Box<Ball>>,
        /// The precision tried last, in bits.
        bits: u64,
    },
    /// The balls could not be computed.
    Ball(BallError),
    /// A grid that cannot hold the pulse.
    Grid(&'static str),
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

    /// What can be done about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::NoWaveNumber => "write ω as a formula in k, such as 2*sin(k/2)".to_owned(),
            Self::MissingValue(symbol) => format!("give it one: --set {symbol}=1"),
            Self::UnknownParameter(_) => "leave it out, or write it in the relation".to_owned(),
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
            Self::NoCutOff { .. } => "take a longer duration, or a pulse given in space".to_owned(),
            Self::UndecidedCutOff(_) => {
                "change the duration a little: 2π/τ may be a maximum of ω".to_owned()
            }
            Self::NoPeak => "give a spectrum that is positive".to_owned(),
            Self::AccuracyNotReached { .. } => "ask for fewer digits".to_owned(),
            Self::Ball(_) => "ask for smaller wavenumbers".to_owned(),
            Self::Grid(_) => "give a positive time, shorter or with fewer points where the grid is too large".to_owned(),
        }
    }
}

impl fmt::Display for DispersionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoWaveNumber => f.write_str("the formula does not depend on the wavenumber k"),
            Self::MissingValue(symbol) => write!(f, "the parameter {symbol} has no value"),
            Self::UnknownParameter(name) => write!(f, "the relation has no parameter `{name}`"),
            Self::ParameterNotPositive(name, value) => {
                write!(f, "`{name}` is {value}, which is not positive")
            }
            Self::NotPositive(what, value) => write!(f, "{what} is {value}, which is not positive"),
            Self::Formula(error) => write!(f, "with these values there is {error}"),
            Self::NegativeFrequency(k) => {
                write!(f, "ω is negative at k = {k}, so it is no frequency")
            }
            Self::NotReal(k) => write!(f, "the formula is not real at k = {k}"),
            Self::DivisionByZero(k) => {
                write!(f, "the formula divides by what may be zero at k = {k}")
            }
            Self::NotDifferentiable(k) => {
                write!(f, "the formula may have no derivative at k = {k}: a root of zero")
            }
            Self::NoCutOff { through } => {
                write!(
                    f,
                    "ω(k)·τ = 2π has no root for 0 < k ≤ {through}, and none is looked for beyond"
                )
            }
            Self::UndecidedCutOff(k) => {
                write!(f, "whether ω(k)·τ = 2π has a root near k = {k} is not decided")
            }
            Self::NoPeak => {
                f.write_str("∫ U k² dk may be zero, so the pulse has no peak to follow")
            }
            Self::AccuracyNotReached { best: Some(best), bits } => {
                write!(f, "the digits asked for are not reached with {bits} bits; known is {best}")
            }
            Self::AccuracyNotReached { best: None, bits } => {
                write!(f, "the digits asked for are not reached with {bits} bits")
            }
            Self::Ball(error) => error.fmt(f),
            Self::Grid(what) => f.write_str(what),
        }
    }
}

impl std::error::Error for DispersionError {}

impl From<FormulaError> for DispersionError {
    fn from(error: FormulaError) -> DispersionError {
        DispersionError::Formula(error)
    }
}
