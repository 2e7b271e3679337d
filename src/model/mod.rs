//! Cheaper models of the same scene: a rigid body, a spring with a third of the bar's mass, modes of
//! vibration, finite differences, and the method of steps with a solver of differential equations.
//!
//! Each computes in doubles and leaves something out; what that costs is measured against the exact
//! solution. A model refuses what it cannot represent, and says why.

mod chain;
mod course;
mod equivalent;
mod error;
mod junction;
mod leapfrog;
mod line;
mod modes;
mod rigid;
mod shape;
mod steps;
mod third;
mod track;

pub use equivalent::equivalent_stiffness;
pub use error::{BadSetting, ModelError, NotRepresented, NotSeen, SolverFailure};
pub use leapfrog::Leapfrog;
pub use modes::Modes;
pub use rigid::RigidBody;
pub use steps::Steps;
pub use third::{StartingVelocity, ThirdOfMass};

/// A model of a scene that gives values of its observables.
///
/// ```
/// use wavestep::language::{Source, read_scene};
/// use wavestep::model::{Leapfrog, Model, Modes, Steps};
/// use wavestep::network::Network;
///
/// let text = r#"
///     scene "A mass strikes a bar"
///     mass hammer { mass = 1, velocity = 1 }
///     bar rod { impedance = 1, travel = 1 }
///     line free - hammer - rod - fixed
///     observe v = velocity(hammer)
/// "#;
/// let scene = read_scene(&Source::new("mass.wave", text)?, &Default::default()).unwrap();
/// let network = Network::new(&scene).unwrap();
/// let models: [(Box<dyn Model>, f64); 3] = [
///     (Box::new(Modes::new(&network, 100).unwrap()), 1e-2),
///     (Box::new(Leapfrog::new(&network, 100, 1.0).unwrap()), 1e-4),
///     (Box::new(Steps::new(&network, 1e-9).unwrap()), 1e-9),
/// ];
/// // Until the first wave returns the mass is slowed down by the bar alone: v = exp(-t).
/// for (model, error) in models {
///     let value = model.values(0, &[1.25]).unwrap()[0];
///     assert!((value - f64::exp(-1.25)).abs() < error, "{}: {value}", model.name());
///     assert!(!model.assumptions().is_empty());
/// }
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub trait Model {
    /// What it is called.
    fn name(&self) -> &'static str;

    /// What it leaves out, in one sentence.
    fn assumptions(&self) -> &'static str;

    /// The values of an observable, counted from 0 as in
    /// [`Network::observables`](crate::network::Network::observables), in metres, kilograms and
    /// seconds or as plain numbers, at times in seconds or plain numbers. Where the value jumps it is
    /// the one after the jump; before the start it is zero.
    ///
    /// # Errors
    /// [`ModelError`] for what the model does not represent, and where it would be too much work.
    fn values(&self, observable: usize, times: &[f64]) -> Result<Vec<f64>, ModelError>;
}
