//! `eval`: values with proven digits, of a recurrence or of a scene.

use super::arguments::Eval;
use super::eval_contact;
use super::eval_doubles;
use super::eval_recurrence::of_recurrence;
use super::eval_scene;
use super::failure::Failure;
use super::input::{self, Readable, Subject};

/// Evaluates what is asked for.
pub fn run(options: &Eval) -> Result<String, Failure> {
    input::digits(options.digits)?;
    let subject = match input::readable(&options.scene)? {
        Readable::WithoutRecurrence(scaled) => return eval_contact::run(&scaled, options),
        Readable::Subject(subject) => subject,
    };
    if options.tol.is_some() || options.method.is_some() {
        return eval_doubles::run(
            subject.with_closed_contacts("eval --tol` and `eval --method")?,
            options,
        );
    }
    if options.explain {
        let message = "--explain tells how values in doubles are computed";
        return Err(Failure::usage(message, "give --tol or --method as well"));
    }
    match subject {
        Subject::Recurrence(recurrence) => of_recurrence(*recurrence, options),
        Subject::Scene(network) => eval_scene::run(&network, options),
    }
}
