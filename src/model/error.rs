//! Why a model gives no values.

use crate::enclosure::EnclosureError;
use crate::expression::NotAUnit;
use wavestep_polynomial::Symbol;

#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    #[error("the symbol {0} has no value; models in doubles need one for each")]
    MissingValue(Symbol),
    #[error("a value of the scene is not a number: {0}")]
    Value(#[source] EnclosureError),
    #[error("the model \"{model}\" does not support this scene: {reason}")]
    Refused { model: &'static str, reason: NotRepresented },
    #[error("bad setting for the model \"{model}\": {reason}")]
    Setting { model: &'static str, reason: BadSetting },
    #[error(
        "the model \"{model}\" would need {count:.1e} {what}, more than {limit:.0e}; choose earlier \
         times or a coarser model"
    )]
    TooMuch { model: &'static str, what: &'static str, count: f64, limit: f64 },
    #[error("the time {0} is not a finite number")]
    Time(f64),
    #[error("there is no observable {asked}; the scene has {count}, counted from 0")]
    NoObservable { asked: usize, count: usize },
    #[error(
        "in the model \"{model}\" the solver of differential equations gave up: no piece of period \
         {period} is smooth; try another tolerance"
    )]
    NotSmooth { model: &'static str, period: i64 },
}

impl ModelError {
    /// Whether the method of steps refuses travel times without a common measure.
    #[doc(hidden)]
    pub fn is_of_measure(&self) -> bool {
        matches!(self, ModelError::Refused { reason: NotRepresented::NoCommonMeasure(_), .. })
    }
}

/// What a model cannot represent. Elements are given by their names.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NotRepresented {
    #[error(
        "it needs linear elements, and the force in the local contact {0} is a power of its \
         compression; use the method of steps"
    )]
    LocalContact(String),
    #[error("a joint without mass moves next to {0}")]
    Massless(String),
    #[error("a joint without mass moves next to {0}, and nothing resists it")]
    Unresisted(String),
    #[error("{0} contacts that open meet at one place")]
    TooManyContacts(usize),
    #[error("rigid masses of different velocities meet")]
    RigidImpact,
    #[error("no bar has a finite length that could set the size of a cell")]
    NoFiniteBar,
    #[error("bar {0} is endless, so waves leave and do not vibrate")]
    EndlessVibration(String),
    #[error("it needs at least one bar")]
    NoBar,
    #[error("{0} damps the motion")]
    Damping(String),
    #[error("load {0} acts from outside")]
    Load(String),
    #[error("{0} has no common measure with the times before it")]
    NoCommonMeasure(String),
    #[error("{observable} observes {term}")]
    Observable { observable: String, term: NotSeen },
}

/// A term of an observable that a model does not know.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NotSeen {
    #[error("an energy, which the model does not compute")]
    Energy,
    #[error("the momentum of an endless bar")]
    EndlessMomentum,
    #[error("a quantity that the model does not have")]
    Other,
}

/// A setting that a model does not work with.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BadSetting {
    #[error("it needs at least one cell")]
    NoCells,
    #[error(
        "a Courant number of {0} is unstable: a wave would cross more than a cell in a step; take at \
         most 1"
    )]
    Unstable(f64),
    #[error("the Courant number {0} is not positive; take 1 or less")]
    NoStep(f64),
    #[error("it needs at least one mode")]
    NoModes,
    #[error("the tolerance {0:e} is not between 1e-13 and 1e-2")]
    Tolerance(f64),
}

impl ModelError {
    /// Refuses more work than the limit.
    pub(super) fn limited(
        model: &'static str,
        what: &'static str,
        count: f64,
        limit: f64,
    ) -> Result<(), ModelError> {
        if count > limit { Err(ModelError::TooMuch { model, what, count, limit }) } else { Ok(()) }
    }
}

impl From<EnclosureError> for ModelError {
    fn from(error: EnclosureError) -> ModelError {
        match error {
            EnclosureError::MissingValue(symbol) => ModelError::MissingValue(symbol),
            other => ModelError::Value(other),
        }
    }
}

impl From<NotAUnit> for ModelError {
    fn from(reason: NotAUnit) -> ModelError {
        ModelError::Value(reason.into())
    }
}
