//! Numbers as they are given: as text, or exactly.

use super::ProblemError;
use crate::language::{self, Source};
use wavestep_polynomial::Rational;

/// A number as text, or as it is; a double stands for its exact value.
#[derive(Clone, PartialEq, Debug)]
pub enum Given {
    /// Text such as `33/10` or `12.34`; times of scenes with units may have one.
    Text(String),
    /// An exact number.
    Exact(Rational),
    /// A double that is no number, or infinite.
    NotFinite(f64),
}

impl Given {
    /// The number, which errors call by this name.
    ///
    /// # Errors
    /// [`ProblemError::Text`], [`ProblemError::NoNumber`], [`ProblemError::NotFinite`].
    pub fn number(self, name: &str) -> Result<Rational, ProblemError> {
        match self {
            Given::Text(text) => number(name, &text),
            Given::Exact(number) => Ok(number),
            Given::NotFinite(value) => Err(ProblemError::NotFinite(value)),
        }
    }
}

/// Reads an exact number, which errors call by this name.
///
/// # Errors
/// [`ProblemError::Text`]; [`ProblemError::NoNumber`] where there is nothing.
pub fn number(name: &str, text: &str) -> Result<Rational, ProblemError> {
    match text.trim().is_empty() {
        true => Err(ProblemError::NoNumber(name.to_owned())),
        false => Ok(language::read_number(&Source::new(name, text)?)?),
    }
}

impl From<&str> for Given {
    fn from(text: &str) -> Given {
        Given::Text(text.to_owned())
    }
}

impl From<Rational> for Given {
    fn from(number: Rational) -> Given {
        Given::Exact(number)
    }
}

impl From<&Rational> for Given {
    fn from(number: &Rational) -> Given {
        Given::Exact(number.clone())
    }
}

impl From<i64> for Given {
    fn from(number: i64) -> Given {
        Given::Exact(Rational::from_integer(number.into()))
    }
}

impl From<f64> for Given {
    fn from(number: f64) -> Given {
        Rational::from_float(number).map_or(Given::NotFinite(number), Given::Exact)
    }
}
