//! `lock`: what is derived now, in a file to compare with later.

use super::arguments::Lock as Options;
use super::failure::{COMPUTATION, Failure};
use super::input;
use super::output::{plural, write_whole};
use super::progress;
use super::validity::{note_derivation, note_pulling};
use num_rational::BigRational;
use std::fs;
use std::path::Path;
use wavestep::language::Source;
use wavestep::limits::MAX_LOCK_BYTES;
use wavestep::lock::{Extent, Lock};
use wavestep::problem::{LockRefusal, ProblemError, ToLock};

pub fn run(options: &Options) -> Result<String, Failure> {
    let problem = input::problem(&options.scene)?;
    let digits = input::digits(options.digits)?;
    let until = options.to.as_deref().map(|to| problem.time("--to", to)).transpose()?;
    let times = options.at.iter().map(|at| problem.time("--at", at.as_str()));
    let times = times.collect::<Result<Vec<BigRational>, ProblemError>>()?;
    let asked = ToLock { through: options.through, until, times, digits };
    let lock = {
        let _progress = progress::spinner("deriving");
        problem.lock(&asked).map_err(refused)?
    };
    match asked.times.iter().max() {
        Some(last) => note_pulling(&problem, last),
        None => note_derivation(&problem),
    }
    write(options, &lock)
}

fn refused(error: ProblemError) -> Failure {
    match error {
        ProblemError::TooManyTerms(_) => {
            Failure::from(error).with_remedy("use a smaller --through")
        }
        error => error.into(),
    }
}

/// Writes what is locked, where it can be read back and no scene is replaced by it.
fn write(options: &Options, lock: &Lock) -> Result<String, Failure> {
    let text = lock.to_text();
    if text.len() > MAX_LOCK_BYTES {
        let message = format!("this file would have {} bytes", text.len());
        let remedy = format!("the limit is {MAX_LOCK_BYTES}: use a smaller --through");
        return Err(Failure::usage(message, remedy));
    }
    // What cannot be read back, such as numbers of a thousand digits, is not written.
    let source = Source::with_limit("lock", &text, MAX_LOCK_BYTES);
    if !source.is_ok_and(|text| Lock::read(&text).is_ok_and(|read| read == *lock)) {
        let message = "the numbers or powers in these pieces are too long to be read back";
        return Err(Failure::usage(message, "use a smaller --through, or fewer digits"));
    }
    let Some(file) = options.output.output.as_ref().filter(|file| *file != "-") else {
        return Ok(text);
    };
    if fs::canonicalize(file)
        .is_ok_and(|file| fs::canonicalize(&options.scene.scene).ok() == Some(file))
    {
        return Err(Failure::usage("this would overwrite the scene", "name another file with -o"));
    }
    write_whole(Path::new(file), text.as_bytes())?;
    Ok(format!("{file}: locked {}\n", counted(lock)))
}

/// What a differing scene is to be treated with.
const AGAIN: &str = "undo the change of the scene, or lock it again";

pub fn check(scene: &str, file: &str) -> Result<String, Failure> {
    let bytes = input::bytes(file, MAX_LOCK_BYTES).map_err(|error| {
        let remedy = format!("write it with `wavestep lock {scene} --through N -o {file}`");
        Failure::usage(format!("the file `{file}` cannot be read: {error}"), remedy)
    })?;
    let locked = Lock::read(&Source::with_limit(file, bytes, MAX_LOCK_BYTES)?)?;
    let problem = input::problem_with(scene, &locked.request().set)?;
    let progress = progress::spinner("deriving");
    let differences = problem.differences(&locked).map_err(|error| match error {
        ProblemError::NoLock(LockRefusal::PiecesLocked) => Failure::usage(
            format!("{file} contains pieces, but contacts now open in {scene}"),
            AGAIN,
        ),
        ProblemError::NoLock(LockRefusal::EventsLocked) => {
            let message = format!("{file} contains events, but no contact opens in {scene} now");
            Failure::usage(message, AGAIN)
        }
        error => Failure::from(error).with_remedy(AGAIN),
    })?;
    drop(progress);
    if differences.is_empty() {
        return Ok(format!("{file}: {} as locked\n", counted(&locked)));
    }
    let report: String = differences.iter().map(ToString::to_string).collect();
    let count = plural(differences.len(), "place");
    let message = format!("{scene} differs in {count} from {file}");
    let remedy = "if the change is intended, lock again; otherwise undo it";
    Err(Failure::new(COMPUTATION, message, remedy).with_report(report))
}

fn counted(lock: &Lock) -> String {
    let (count, values) = lock.counts();
    let what = match lock.extent() {
        Extent::Pieces { .. } => "piece",
        Extent::Events { .. } => "event",
    };
    match values {
        0 => plural(count, what),
        values => format!("{} and {}", plural(count, what), plural(values, "value")),
    }
}
