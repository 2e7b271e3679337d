//! `derive`: exact wave functions, of a recurrence or of a scene.

use super::arguments::Derive;
use super::derive_recurrence::of_recurrence;
use super::derive_scene;
use super::failure::Failure;
use super::input::{self, Subject};
use wavestep::history::{Event, EventKind, History};
use wavestep::network::Network;

/// Significant digits of the instant until which a form holds.
const DIGITS: usize = 12;

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
            if network.scene().contacts_open {
                eprintln!("note: {}", validity(&network));
            }
            Ok(derived)
        }
    }
}

/// Until when the form with closed contacts holds.
fn validity(network: &Network) -> String {
    let parts = |event: &&Event| matches!(event.kind, EventKind::Opening | EventKind::Release);
    let history = History::of(network, None, DIGITS).ok();
    let first = history.as_ref().and_then(|history| history.events.iter().find(parts));
    match (&history, first) {
        (_, Some(event)) => {
            let second = if network.scene().dimensional { " s" } else { "" };
            let [left, right] = &event.between;
            let time = event.time.to_text(DIGITS);
            format!("this holds until t = {time}{second}, when {left} and {right} part")
        }
        (Some(_), None) => {
            "no contact was seen to open: this holds as far as it was followed".into()
        }
        (None, _) => "this holds until a contact opens: `wavestep events` tells when".into(),
    }
}
