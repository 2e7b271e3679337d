//! Recurrences solved in two ways, period by period and echo by echo; and for general n where possible.
//!
//! [`PeriodByPeriod`] works in time with the integrating factor and constants by continuity;
//! [`EchoByEcho`] works in the Laplace domain and expands in the shift `q = e^{−pD}`. From
//! the ordered steps on they share nothing but the ring arithmetic, so that their agreement
//! is evidence for both. [`GeneralForm`] holds a wave for every n at once. [`Solution`] puts
//! them together.

mod consequence;
mod demand;
mod echo;
mod elimination;
mod error;
mod general;
mod geometric;
mod observed;
mod period;
mod rise;
mod solved;
mod step;
mod steps;
mod table;
mod template;

pub(crate) use demand::Demand;
pub use echo::EchoByEcho;
pub use error::{SolveError, Unsolvable};
pub use general::{GeneralForm, Proof, Unknown};
pub use geometric::Geometric;
pub(crate) use geometric::GeometricTerm;
pub use observed::{ObserveError, ObservedPieces, ObservedStretch};
pub(crate) use period::KeptEnds;
pub use period::PeriodByPeriod;
pub use rise::Rise;
pub use solved::Solution;
pub(crate) use step::{FieldForm, FieldStep};
pub use steps::{Integration, PieceSteps, SequenceStep, Solved, solved_for_waves};
pub(crate) use table::EchoRow;
pub use table::EchoTable;
pub use template::{EchoTemplate, Family, laplace};
