//! Why a formula cannot be judged.

use std::fmt;
use wavestep::language::Diagnostic;
use wavestep::solution::{ObserveError, SolveError};

/// Why a formula of the source cannot be held against a scene.
///
/// ```
/// use wavestep_studies::book::{Equation, Refusal, find};
///
/// let (section, _) = find("6.80").unwrap();
/// let stage = section.stage().unwrap();
/// let refused = |text| stage.judge(&Equation::read(text).unwrap()).unwrap_err();
/// assert_eq!(refused("h[n] = 1"), Refusal::UnknownName("h".to_owned()));
/// assert_eq!(refused("f[n]*g[n] = 1"), Refusal::NotLinear);
/// assert!(refused("f[n] = sin(z)").to_string().contains("`sin`"));
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Refusal {
    /// A name that neither the source nor the scene knows.
    UnknownName(String),
    /// A product of waves.
    NotLinear,
    /// A value that has to be free of waves and of n is not.
    DependsOnPeriod,
    /// A divisor, or an exponent, that has no exact inverse here.
    NotInvertible,
    /// A function that formulas of the source do not need.
    Function(String),
    /// The text of a formula or of a scene.
    Text(String),
    /// The scene has no periods.
    NoPeriods(String),
    /// A piece cannot be derived.
    Underivable(String),
    /// A symbol needs a value for a witness.
    NoValue(String),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::UnknownName(name) => {
                write!(f, "`{name}` is neither a wave nor a name of this section")
            }
            Refusal::NotLinear => f.write_str(
                "waves may be added, and multiplied or divided by what holds no wave; nothing else",
            ),
            Refusal::DependsOnPeriod => {
                f.write_str("this value must be the same on every period: leave out waves and n")
            }
            Refusal::NotInvertible => f.write_str(
                "a divisor is a product of symbols and linear factors, an exponent free of \
                 exponentials; write it as such",
            ),
            Refusal::Function(name) => {
                write!(f, "the function `{name}` is not understood here; write exponentials")
            }
            Refusal::Text(text) => f.write_str(text),
            Refusal::NoPeriods(scene) => {
                write!(f, "the scene `{scene}` has no common period; give commensurate bars")
            }
            Refusal::Underivable(reason) => f.write_str(reason),
            Refusal::NoValue(symbol) => {
                write!(f, "`{symbol}` has no value for a witness; list it under `values`")
            }
        }
    }
}

impl std::error::Error for Refusal {}

impl From<Diagnostic> for Refusal {
    fn from(diagnostic: Diagnostic) -> Refusal {
        Refusal::Text(diagnostic.to_string())
    }
}

impl From<SolveError> for Refusal {
    fn from(error: SolveError) -> Refusal {
        Refusal::Underivable(error.to_string())
    }
}

impl From<ObserveError> for Refusal {
    fn from(error: ObserveError) -> Refusal {
        Refusal::Underivable(error.to_string())
    }
}
