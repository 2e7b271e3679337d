//! Why a scene gives no recurrence.

use crate::expression::NotAUnit;
use crate::recurrence::InvalidRecurrence;
use crate::scene::Mistake;

/// Why a scene gives no recurrence.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NetworkError {
    /// A value that cannot be divided by.
    #[error(transparent)]
    Division(#[from] NotAUnit),
    /// The travel times have no common measure, or too fine a one, so that no period suits them all.
    #[error("the travel times have no common measure, or too fine a one")]
    Incommensurate,
    /// The laws at the nodes cannot be solved for the waves.
    #[error("the laws of this scene cannot be solved for its waves: {0}")]
    Recurrence(#[source] Box<InvalidRecurrence>),
    /// Waves decay together at rates that are not known exactly.
    #[error(
        "{place}, {} decay together at rates that are not known exactly", waves.join(" and ")
    )]
    Rates {
        /// Where, in words.
        place: String,
        /// The waves.
        waves: Vec<String>,
    },
    /// An observable that cannot be formed.
    #[error("{name}: {reason}")]
    Unobservable {
        /// The observable.
        name: String,
        /// Why not.
        reason: Mistake,
    },
    /// A local contact, by its name: its force is a power of its compression, so that waves do not
    /// add up and nothing that recurs can be stated.
    #[error(
        "the local contact `{0}` only pushes, with a power of its compression, so this scene has no \
         recurrence and no exact solution"
    )]
    NotLinear(String),
}
