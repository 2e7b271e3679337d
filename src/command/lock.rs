//! `lock`: what is derived now, in a file to compare with later.

use super::arguments::Lock as Options;
use super::bounds;
use super::failure::Failure;
use super::input;
use super::progress;
use std::fs;
use std::path::{Path, PathBuf};
use wavestep::evaluate::MAX_DIGITS;
use wavestep::language::Source;
use wavestep::lock::{Lock, MAX_FILE_BYTES, Request};
use wavestep::solution::Solution;

/// Locks a scene.
pub fn run(options: &Options) -> Result<String, Failure> {
    let recurrence = input::recurrence(&options.scene)?;
    if options.digits == 0 || options.digits > MAX_DIGITS {
        let message = format!("{} significant digits cannot be certified", options.digits);
        return Err(Failure::usage(message, format!("ask for 1 to {MAX_DIGITS} digits")));
    }
    let times = options.at.iter().map(|time| input::time("--at", time));
    let request = Request {
        through: options.through,
        times: times.collect::<Result<_, _>>()?,
        digits: options.digits,
        set: input::values(&options.scene.set)?,
    };
    bounds::refuse_pieces(&recurrence, options.through, "ask for a smaller --through")?;
    let lock = {
        let _progress = progress::spinner("deriving");
        Lock::derive(&Solution::new(recurrence), &request)?
    };
    let Some(file) = &options.output else { return Ok(lock.to_text()) };
    write_whole(Path::new(file), &lock.to_text())?;
    Ok(format!("{file}: locked {}\n", counted(&lock)))
}

/// Compares a scene with what is locked.
pub fn check(scene: &str, file: &str) -> Result<String, Failure> {
    let bytes = fs::read(file).map_err(|error| {
        let message = format!("the file `{file}` cannot be read: {error}");
        Failure::usage(
            message,
            format!("write it with `wavestep lock {scene} --through N -o {file}`"),
        )
    })?;
    let locked = Lock::read(&Source::with_limit(file, bytes, MAX_FILE_BYTES)?)?;
    let request = locked.request();
    let recurrence = input::recurrence_with(scene, &request.set)?;
    bounds::refuse_pieces(&recurrence, request.through, "lock fewer periods")?;
    let now = {
        let _progress = progress::spinner("deriving");
        Lock::derive(&Solution::new(recurrence), request)?
    };
    let differences = locked.differences(&now);
    if differences.is_empty() {
        return Ok(format!("{file}: {} as locked\n", counted(&locked)));
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

fn counted(lock: &Lock) -> String {
    let plural = |count: usize, what: &str| match count {
        1 => format!("1 {what}"),
        count => format!("{count} {what}s"),
    };
    let (pieces, values) = lock.counts();
    match values {
        0 => plural(pieces, "piece"),
        values => format!("{} and {}", plural(pieces, "piece"), plural(values, "value")),
    }
}

/// Writes a file as a whole or not at all: beside it first, then in its place.
fn write_whole(file: &Path, text: &str) -> Result<(), Failure> {
    let mut beside = file.as_os_str().to_owned();
    beside.push(".part");
    let beside = PathBuf::from(beside);
    let written = fs::write(&beside, text).and_then(|()| fs::rename(&beside, file));
    written.map_err(|error| {
        let _ = fs::remove_file(&beside);
        let message = format!("the file `{}` cannot be written: {error}", file.display());
        Failure::usage(message, "name a file in a folder that exists and can be written to")
    })
}
