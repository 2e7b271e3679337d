//! `eval`: values with proven digits, of a recurrence or of a scene.

use super::arguments::Eval;
use super::eval_recurrence::of_recurrence;
use super::eval_scene;
use super::failure::Failure;
use super::input::{self, Subject};

/// Evaluates what is asked for.
pub fn run(options: &Eval) -> Result<String, Failure> {
    input::digits(options.digits)?;
    match input::subject(&options.scene)? {
        Subject::Recurrence(recurrence) => of_recurrence(*recurrence, options),
        Subject::Scene(network) => eval_scene::run(&network, options),
    }
}
