//! `lock`: what is derived now, in a file to compare with later.

use super::arguments::Lock as Options;
use super::bounds;
use super::failure::Failure;
use super::input::{self, Subject};
use super::lock_history;
use super::output::write_whole;
use super::progress;
use std::fs;
use std::path::Path;
use wavestep::evaluate::EvaluateError;
use wavestep::language::Source;
use wavestep::limits::MAX_LOCK_BYTES;
use wavestep::lock::{HistoryLock, Lock, LockError, Locked, Request};
use wavestep::recurrence::Recurrence;
use wavestep::solution::Solution;

/// Locks a scene.
pub fn run(options: &Options) -> Result<String, Failure> {
    let subject = input::subject(&options.scene)?;
    match &subject {
        Subject::Scene(network) if network.scene().contacts_open => {
            let lock = lock_history::of(network, options)?;
            let read = |text: &Source| HistoryLock::read(text).is_ok_and(|read| read == lock);
            return write(options, lock.to_text(), read, &lock_history::counted(&lock));
        }
        _ if options.until.is_some() => {
            let message = "there are no events here: no contacts open";
            return Err(Failure::usage(
                message,
                "give --through N for pieces and --at T for values",
            ));
        }
        Subject::Scene(network) if network.scene().dimensional && !options.at.is_empty() => {
            let message = "values are not locked in scenes with units";
            let remedy = "leave out --at: pieces are locked, without units";
            return Err(Failure::usage(message, remedy));
        }
        _ => {}
    }
    let Some(through) = options.through else {
        let message = "it is not said through which period the pieces are to be locked";
        return Err(Failure::usage(message, "give --through N, for the periods 0 … N"));
    };
    let recurrence = subject.into_recurrence()?;
    if let Some(constant) = recurrence.constants().first().filter(|_| !options.at.is_empty()) {
        let message =
            format!("values are not locked in scenes with constants such as {}", constant.symbol);
        return Err(Failure::usage(
            message,
            "leave out --at: pieces are locked with their symbols",
        ));
    }
    let times = options.at.iter().map(|time| input::time("--at", time, false));
    let request = Request {
        through,
        times: times.collect::<Result<_, _>>()?,
        digits: input::digits(options.digits)?,
        set: input::values(&options.scene.set)?,
    };
    let lock = derive(recurrence, &request)?;
    let read = |text: &Source| Lock::read(text).is_ok_and(|read| read == lock);
    write(options, lock.to_text(), read, &counted(&lock))
}

/// Writes what is locked, where it can be read back and no scene is replaced by it.
fn write(
    options: &Options,
    text: String,
    is_read_back: impl FnOnce(&Source) -> bool,
    counted: &str,
) -> Result<String, Failure> {
    if text.len() > MAX_LOCK_BYTES {
        let message = format!("this would be a file of {} bytes", text.len());
        let remedy = format!("files have at most {MAX_LOCK_BYTES}: ask for a smaller --through");
        return Err(Failure::usage(message, remedy));
    }
    // What cannot be read back, such as numbers of a thousand digits, is not written.
    if !Source::with_limit("lock", &text, MAX_LOCK_BYTES).is_ok_and(|text| is_read_back(&text)) {
        let message = "the numbers or powers in these pieces are too long to be read back";
        return Err(Failure::usage(message, "ask for a smaller --through, or shorter values"));
    }
    let Some(file) = options.output.as_ref().filter(|file| *file != "-") else { return Ok(text) };
    if fs::canonicalize(file)
        .is_ok_and(|file| fs::canonicalize(&options.scene.scene).ok() == Some(file))
    {
        return Err(Failure::usage(
            "the scene itself would be replaced",
            "name another file with -o",
        ));
    }
    write_whole(Path::new(file), text.as_bytes())?;
    Ok(format!("{file}: locked {counted}\n"))
}

/// What a differing scene is to be treated with.
const AGAIN: &str = "undo what was changed in the scene, or lock it again";

/// Compares a scene with what is locked.
pub fn check(scene: &str, file: &str) -> Result<String, Failure> {
    let bytes = input::bytes(file, MAX_LOCK_BYTES).map_err(|error| {
        let remedy = format!("write it with `wavestep lock {scene} --through N -o {file}`");
        Failure::usage(format!("the file `{file}` cannot be read: {error}"), remedy)
    })?;
    let locked = Locked::read(&Source::with_limit(file, bytes, MAX_LOCK_BYTES)?)?;
    let set = match &locked {
        Locked::Pieces(locked) => &locked.request().set,
        Locked::History(locked) => &locked.request().set,
    };
    let subject = input::subject_with(scene, set)?;
    let opening = match &subject {
        Subject::Scene(network) if network.scene().contacts_open => Some(network),
        _ => None,
    };
    let (differences, counted) = match (&locked, opening) {
        (Locked::Pieces(locked), None) => {
            let now = derive(subject.into_recurrence()?, locked.request());
            let now = now.map_err(|failure| failure.with_remedy(AGAIN))?;
            (locked.differences(&now), counted(locked))
        }
        (Locked::History(locked), Some(network)) => {
            let now = lock_history::derive(network, locked.request());
            let now = now.map_err(|failure| failure.with_remedy(AGAIN))?;
            (locked.differences(&now), lock_history::counted(locked))
        }
        (Locked::Pieces(_), Some(_)) => {
            let message = format!("{file} holds pieces, and contacts open in {scene} now");
            return Err(Failure::usage(message, AGAIN));
        }
        (Locked::History(_), None) => {
            let message = format!("{file} holds events, and no contacts open in {scene} now");
            return Err(Failure::usage(message, AGAIN));
        }
    };
    if differences.is_empty() {
        return Ok(format!("{file}: {counted} as locked\n"));
    }
    let report: String = differences.iter().map(ToString::to_string).collect();
    let count = match differences.len() {
        1 => "1 place".to_owned(),
        count => format!("{count} places"),
    };
    Err(Failure::Difference {
        report,
        message: format!("{scene} differs in {count} from {file}"),
        remedy: "if that is meant, lock again; else undo what was changed in the scene".to_owned(),
    })
}

fn derive(recurrence: Recurrence, request: &Request) -> Result<Lock, Failure> {
    bounds::refuse_pieces(&recurrence, request.through, "ask for a smaller --through")?;
    let _progress = progress::spinner("deriving");
    Lock::derive(&Solution::new(recurrence), request).map_err(|error| match error {
        LockError::Solve(error) => error.into(),
        LockError::Evaluate(error @ EvaluateError::AccuracyNotReached { .. }) => {
            Failure::from(error).with_remedy("ask for fewer digits")
        }
        LockError::Evaluate(error) => error.into(),
        error => Failure::usage(error.to_string(), "ask for fewer digits"),
    })
}

fn counted(lock: &Lock) -> String {
    let (pieces, values) = lock.counts();
    match values {
        0 => plural(pieces, "piece"),
        values => format!("{} and {}", plural(pieces, "piece"), plural(values, "value")),
    }
}

/// So many things.
pub fn plural(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        count => format!("{count} {what}s"),
    }
}
