//! Recurrences solved, twice: period by period, and echo by echo; and in general n where it can be.
//!
//! [`PeriodByPeriod`] works in time with the integrating factor and constants by continuity;
//! [`EchoByEcho`] works in the Laplace domain and expands in the shift `q = e^{−pD}`. From
//! the ordered steps on they share the ring arithmetic and nothing else, so that their agreement
//! speaks for both. [`GeneralForm`]
//! holds what is known for every n at once. [`Solution`] puts them together.

mod consequence;
mod demand;
mod echo;
mod elimination;
mod error;
mod general;
mod geometric;
mod observed;
mod period;
mod solved;
mod step;
mod table;
mod template;

pub use demand::Demand;
pub use echo::EchoByEcho;
pub use error::{SolveError, Unsolvable};
pub use general::{GeneralForm, Proof, Unknown};
pub use geometric::{Geometric, GeometricTerm};
pub use observed::{ObserveError, ObservedPieces, ObservedStretch};
pub use period::{KeptEnds, PeriodByPeriod};
pub use solved::Solution;
pub(crate) use step::{FieldForm, FieldStep};
pub use table::{EchoRow, EchoTable, ExpandedTerm, OrdinaryTable, OrdinaryTerm};
pub use template::{EchoTemplate, Family};
