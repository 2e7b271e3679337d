//! Why a model gives no values.

use crate::enclosure::EnclosureError;
use std::fmt;
use wavestep_polynomial::Symbol;

/// Why a model gives no values.
///
/// ```
/// use wavestep::language::{Source, read_scene};
/// use wavestep::model::{ModelError, RigidBody};
/// use wavestep::network::Network;
///
/// let text = wavestep::scenes::find("hopkinson").unwrap().text;
/// let scene = read_scene(&Source::new("hopkinson", text)?, &Default::default()).unwrap();
/// let refused = RigidBody::new(&Network::new(&scene).unwrap()).err().unwrap();
/// assert!(matches!(refused, ModelError::Refused { model: "rigid body", .. }));
/// assert_eq!(
///     refused.to_string(),
///     "the model \"rigid body\" does not represent this: bar output is endless, so its mass has no bound",
/// );
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum ModelError {
    /// A symbol without a value.
    MissingValue(Symbol),
    /// A value of the scene that cannot be told as a number.
    Value(EnclosureError),
    /// What the model cannot represent.
    Refused {
        /// The model.
        model: &'static str,
        /// What it cannot represent, by the name of the element or the observable.
        reason: String,
    },
    /// A setting that the model does not work with.
    Setting {
        /// The model.
        model: &'static str,
        /// What is wrong, and which values do.
        reason: String,
    },
    /// More work than is done.
    TooMuch {
        /// The model.
        model: &'static str,
        /// What is counted.
        what: &'static str,
        /// How many there would be.
        count: f64,
        /// The most that are done.
        limit: f64,
    },
    /// A time that is no finite number.
    Time(f64),
    /// An observable that the scene does not have.
    NoObservable {
        /// Which was asked for, counted from 0.
        asked: usize,
        /// How many there are.
        count: usize,
    },
    /// The solver of differential equations gave up.
    Solver {
        /// The model.
        model: &'static str,
        /// What the solver says.
        reason: String,
    },
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ModelError::MissingValue(symbol) => {
                write!(f, "the symbol {symbol} has no value; models in doubles need one for each")
            }
            ModelError::Value(error) => write!(f, "a value of the scene is no number: {error}"),
            ModelError::Refused { model, reason } => {
                write!(f, "the model \"{model}\" does not represent this: {reason}")
            }
            ModelError::Setting { model, reason } => {
                write!(f, "the model \"{model}\" does not work with this setting: {reason}")
            }
            ModelError::TooMuch { model, what, count, limit } => write!(
                f,
                "the model \"{model}\" would need {count:.1e} {what}, more than {limit:.0e}; \
                 ask for earlier times or a coarser model"
            ),
            ModelError::Time(time) => write!(f, "the time {time} is no finite number"),
            ModelError::NoObservable { asked, count } => {
                write!(f, "there is no observable {asked}; the scene has {count}, counted from 0")
            }
            ModelError::Solver { model, reason } => write!(
                f,
                "in the model \"{model}\" the solver of differential equations gave up: {}; \
                 try another tolerance",
                reason.trim_end_matches('.')
            ),
        }
    }
}

impl std::error::Error for ModelError {}

impl From<EnclosureError> for ModelError {
    fn from(error: EnclosureError) -> ModelError {
        match error {
            EnclosureError::MissingValue(symbol) => ModelError::MissingValue(symbol),
            other => ModelError::Value(other),
        }
    }
}

impl From<crate::expression::NotAUnit> for ModelError {
    fn from(reason: crate::expression::NotAUnit) -> ModelError {
        ModelError::Value(reason.into())
    }
}
