//! Numbers as they are given: as text, or exactly.

use super::ProblemError;
use crate::language::{self, Source};
use wavestep_polynomial::Rational;

/// A number as it is given, a value, a time or a level: text, an integer, a rational number, or a double.
///
/// Text is exact: `33/10`, `12.34`, `1e-3`; in scenes with units times and levels as text have one, as in
/// `2 ms`, and numbers are in SI units. A double stands for its exact value, so `0.1` is not a tenth.
///
/// ```
/// let bars = wavestep::Problem::builtin("hopkinson")?;
/// let force = bars.signal("force")?;
/// assert_eq!(force.at("400 us", 9)?, force.at("0.4 ms", 9)?);
/// assert_ne!(force.at(4e-4, 30)?, force.at("4e-4 s", 30)?);
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub enum Given {
    /// Text such as `33/10` or `12.34`; times of scenes with units have one.
    Text(String),
    /// An exact number.
    Exact(Rational),
    /// A double that is no number, or infinite.
    NotFinite(f64),
}

#[doc(hidden)]
impl Given {
    /// The number, which errors call by this name.
    pub fn number(self, name: &str) -> Result<Rational, ProblemError> {
        match self {
            Given::Text(text) => number(name, &text),
            Given::Exact(number) => Ok(number),
            Given::NotFinite(value) => Err(ProblemError::NotFinite(value)),
        }
    }
}

/// Reads an exact number, which errors call by this name.
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

impl From<String> for Given {
    fn from(text: String) -> Given {
        Given::Text(text)
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

macro_rules! from_integers {
    ($($integer:ty),*) => {$(
        impl From<$integer> for Given {
            fn from(number: $integer) -> Given {
                Given::Exact(Rational::from_integer(number.into()))
            }
        }
    )*};
}

from_integers!(i32, i64, u32, u64, usize);

impl From<f64> for Given {
    fn from(number: f64) -> Given {
        Rational::from_float(number).map_or(Given::NotFinite(number), Given::Exact)
    }
}
