//! Why a scene gives no recurrence.

use crate::expression::NotAUnit;
use crate::recurrence::InvalidRecurrence;
use crate::scene::Mistake;

/// Why a scene gives no recurrence.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NetworkError {
    #[error(transparent)]
    Division(#[from] NotAUnit),
    #[error("the travel times are incommensurable, or their common divisor is too small")]
    Incommensurate,
    /// Where, in words.
    #[error("{0}, a joint without mass moves against a spring, and nothing resists it")]
    Massless(String),
    #[error("the equations of this scene cannot be solved for its waves: {0}")]
    Recurrence(#[source] Box<InvalidRecurrence>),
    #[error(
        "{place}, {} decay together at rates that have no short exact form", waves.join(" and ")
    )]
    Rates { place: String, waves: Vec<String> },
    #[error("{name}: {reason}")]
    Unobservable { name: String, reason: Mistake },
    #[error(
        "the force in the local contact `{0}` is a power of its compression, so this scene has no \
         recurrence, and no exact solution after its first contact"
    )]
    NotLinear(String),
    /// Of two bodies.
    #[error("{} and {} do not touch at the start, so this scene has no recurrence", _0[0], _0[1])]
    Apart([String; 2]),
}
