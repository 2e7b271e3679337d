//! Why a scene gives no recurrence.

use crate::expression::NotAUnit;
use crate::recurrence::InvalidRecurrence;

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
    #[error("{name} {reason}")]
    Unobservable {
        /// The observable.
        name: String,
        /// Why not.
        reason: Unobservable,
    },
    /// A local contact, by its name: its force is a power of its compression, so that waves do not
    /// add up and nothing that recurs can be stated.
    #[error(
        "the local contact `{0}` only pushes, with a power of its compression, so this scene has no \
         recurrence and no exact solution"
    )]
    NotLinear(String),
}

/// Why an observable cannot be formed: the end of a sentence that its name begins.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Unobservable {
    /// Strain or stress of what is no bar.
    #[error("is not seen in a bar")]
    NotInBar,
    /// Stress of a bar that is given by its impedance.
    #[error("needs a bar with an area")]
    NoArea,
    /// Velocity of an element whose ends move apart.
    #[error("has two ends with two velocities")]
    TwoVelocities,
    /// Displacement of an element whose ends move apart.
    #[error("has two ends with two displacements")]
    TwoDisplacements,
    /// Compression of what does not yield.
    #[error("is no compression of a spring")]
    NotCompressible,
    /// Force of an element that has no one force.
    #[error("is seen in bars, springs and supports only")]
    NoForce,
    /// Momentum of what has no mass, or an infinite one.
    #[error("is that of a mass or of a bar that is at rest where it is endless")]
    NoMomentum,
    /// Momentum of a line in which an endless bar moves.
    #[error("is infinite: an endless bar moves from the start")]
    InfiniteMomentum,
    /// Energy of an endless bar in motion, or under strain.
    #[error("is infinite: an endless bar moves or is strained from the start")]
    InfiniteEnergy,
    /// A sum of an energy and something else.
    #[error("adds an energy to something else")]
    MixedEnergy,
    /// Energy of a section.
    #[error("is an energy of a whole element, or of the line")]
    EnergyOfSection,
    /// A section at a share of the length of an endless bar.
    #[error("is asked for at a share of the length of an endless bar")]
    ShareOfEndless,
    /// A place that has no such measure.
    #[error("is measured at no such place")]
    NoSuchPlace,
}
