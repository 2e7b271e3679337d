//! `lock` for scenes whose contacts open: events and values instead of pieces.

use super::arguments::Lock as Options;
use super::failure::Failure;
use super::input;
use super::lock::plural;
use super::progress;
use wavestep::lock::{HistoryLock, HistoryRequest, LockError};
use wavestep::network::Network;

/// What is locked of a scene.
pub fn of(network: &Network, options: &Options) -> Result<HistoryLock, Failure> {
    if options.through.is_some() {
        let message = "where contacts open there are no periods of which pieces could be locked";
        let remedy = "leave out --through: events are locked, until --until T";
        return Err(Failure::usage(message, remedy));
    }
    let dimensional = network.scene().dimensional;
    let time = |argument, text: &String| input::time(argument, text, dimensional);
    let request = HistoryRequest {
        until: options.until.as_ref().map(|until| time("--until", until)).transpose()?,
        times: options.at.iter().map(|at| time("--at", at)).collect::<Result<_, _>>()?,
        digits: input::digits(options.digits)?,
        set: input::values(&options.scene.set)?,
    };
    derive(network, &request)
}

/// The history, followed as asked for.
pub fn derive(network: &Network, request: &HistoryRequest) -> Result<HistoryLock, Failure> {
    let _progress = progress::spinner("following contacts");
    HistoryLock::derive(network, request).map_err(|error| match error {
        LockError::History(error) => error.into(),
        LockError::AccuracyNotReached(_) => {
            Failure::Accuracy(error.to_string(), "ask for fewer digits".to_owned())
        }
        error => Failure::usage(error.to_string(), "ask for fewer digits"),
    })
}

/// How much is locked.
pub fn counted(lock: &HistoryLock) -> String {
    let (events, values) = lock.counts();
    match values {
        0 => plural(events, "event"),
        values => format!("{} and {}", plural(events, "event"), plural(values, "value")),
    }
}
