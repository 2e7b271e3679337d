//! `derive`: exact wave functions, of a recurrence or of a scene.

use super::arguments::Derive;
use super::derive_recurrence::of_recurrence;
use super::derive_scene;
use super::failure::Failure;
use super::input::{self, Subject};
use super::validity;

/// Derives what is asked for.
pub fn run(options: &Derive) -> Result<String, Failure> {
    match input::subject(&options.scene)? {
        Subject::Recurrence(_) if options.explain => Err(Failure::usage(
            "a recurrence is its own explanation: nothing was derived to get it",
            "ask for --explain with a scene of bars and elements, or leave it out",
        )),
        Subject::Recurrence(recurrence) => {
            let shown = recurrence.statement().waves.len();
            of_recurrence(*recurrence, shown, options)
        }
        Subject::Scene(network) => {
            let derived = derive_scene::run(&network, options)?;
            validity::note_derivation(&network);
            Ok(derived)
        }
    }
}
