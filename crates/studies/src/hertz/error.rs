//! What can be wrong with a contact.

use std::fmt;
use wavestep::ball::BallError;
use wavestep::enclosure::EnclosureError;

/// Why there is no answer.
///
/// ```
/// use wavestep_studies::hertz::{HertzError, PowerLaw};
/// use wavestep_polynomial::Rational;
///
/// let zero = Rational::from_integer(0.into());
/// assert_eq!(PowerLaw::new(zero), Err(HertzError::Exponent("0".to_owned())));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HertzError {
    /// The exponent m is above [`PowerLaw::MOST`](super::PowerLaw::MOST), or below the inverse of
    /// [`PowerLaw::LEAST_INVERSE`](super::PowerLaw::LEAST_INVERSE).
    Exponent(String),
    /// A share of the largest force is not from 0 to below 1.
    Share(String),
    /// A time is negative.
    Time(String),
    /// A quantity that must be positive is not: its name, and its value.
    NotPositive(&'static str, String),
    /// A Poisson ratio is not above −1 and at most 1/2.
    Poisson(String),
    /// A scene has no contact that closed forms describe.
    Scene(&'static str),
    /// A value of the scene is not known.
    Enclosure(EnclosureError),
    /// An enclosure failed.
    Ball(BallError),
}

impl fmt::Display for HertzError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exponent(value) => write!(
                f,
                "the exponent m of X = k α^m is {value}; it must be positive, from 1/10 to 100 \
                 (3/2 is Hertz's, 1 a spring)"
            ),
            Self::Share(value) => write!(
                f,
                "{value} of the largest force: a share must be from 0 to below 1, since the largest \
                 force is never reached"
            ),
            Self::Time(value) => write!(f, "the time {value} is before the impact, at 0"),
            Self::NotPositive(name, value) => write!(f, "{name} is {value}; it must be positive"),
            Self::Poisson(value) => write!(
                f,
                "a Poisson ratio of {value}: it must be above -1 and at most 1/2, as 3/10 for steel"
            ),
            Self::Scene(reason) => f.write_str(reason),
            Self::Enclosure(error) => error.fmt(f),
            Self::Ball(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for HertzError {}

impl From<BallError> for HertzError {
    fn from(error: BallError) -> HertzError {
        HertzError::Ball(error)
    }
}

impl From<EnclosureError> for HertzError {
    fn from(error: EnclosureError) -> HertzError {
        HertzError::Enclosure(error)
    }
}
