//! Cheaper models of the same scene: modes of vibration, finite differences, and the method of steps in doubles.
//!
//! Each computes in doubles and leaves something out; what that costs is measured against the exact
//! solution. A model refuses what it cannot represent, and says why.

mod chain;
pub mod collocation;
pub mod course;
mod equivalent;
mod error;
mod laws;
mod leapfrog;
pub mod line;
pub(crate) mod modal_line;
mod modes;
pub mod shape;
mod steps;
pub mod track;

pub use equivalent::equivalent_stiffness;
pub use error::{BadSetting, ModelError, NotRepresented, NotSeen};
pub use leapfrog::Leapfrog;
pub use modes::Modes;
pub use steps::Steps;

/// A model of a scene that gives values of its observables.
pub trait Model {
    /// What it leaves out, in one sentence.
    fn assumptions(&self) -> &'static str;

    /// The values of an observable, counted from 0 as in
    /// [`Network::observables`](crate::network::Network::observables), in metres, kilograms and
    /// seconds or as plain numbers, at times in seconds or plain numbers. Where the value jumps it is
    /// the one after the jump; before the start it is zero.
    fn values(&self, observable: usize, times: &[f64]) -> Result<Vec<f64>, ModelError>;
}
