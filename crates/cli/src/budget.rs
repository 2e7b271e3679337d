//! What a command may take. The library foresees most work that would explode and refuses it before it begins;
//! this watch beside the work holds the rest to its time and its memory.

use super::failure::{COMPUTATION, Failure};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use std::{process, thread};
use wavestep::limits::{memory, resident, share_done};

/// How often the watch looks.
const TICK: Duration = Duration::from_millis(20);

/// What the program takes beside the waves.
const PROGRAM: u64 = 64_000_000;

/// Held while something is written, so that nothing ends half written; whether nothing is left but to write.
static DONE: Mutex<bool> = Mutex::new(false);

/// What is being done, for whoever is told that it took too long.
static WORK: Mutex<&str> = Mutex::new("");

/// Ends the process, from another thread, where its work takes longer than `time` or more than the memory that
/// waves may take.
pub fn watch(time: Option<Duration>) {
    let begun = Instant::now();
    // A machine without threads to spare works unwatched.
    let _ = thread::Builder::new().spawn(move || {
        loop {
            thread::sleep(TICK);
            let taken = begun.elapsed();
            if time.is_some_and(|time| taken >= time) {
                let seconds = (taken.as_secs_f64() * 10.0).floor() / 10.0;
                end(&format!("no answer within {seconds} s"), "--time-limit");
            }
            if resident().is_some_and(|bytes| bytes > memory().saturating_add(PROGRAM)) {
                let megabytes = memory() / 1_000_000;
                end(&format!("the answer takes more than {megabytes} MB of memory"), "--memory");
            }
        }
    });
}

/// The work is done: what is written now is not cut off.
pub fn done() {
    *held(&DONE) = true;
}

/// Nothing ends while this is held.
pub fn writing() -> MutexGuard<'static, bool> {
    held(&DONE)
}

/// Tells what is being done.
pub fn tell(work: &'static str) {
    *held(&WORK) = work;
}

/// What is held stays true where a thread that held it has panicked.
fn held<T>(mutex: &'static Mutex<T>) -> MutexGuard<'static, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the process, unless the work has been done meanwhile.
fn end(exceeded: &str, option: &str) {
    let done = held(&DONE);
    if !*done {
        let failure = Failure::new(
            COMPUTATION,
            exceeded.to_owned() + &reached(),
            format!(
                "ask for an earlier time, a shorter window or fewer digits, or allow more with {option}"
            ),
        );
        failure.show();
        process::exit(i32::from(failure.code()));
    }
}

/// How far the work has come.
fn reached() -> String {
    let work = *held(&WORK);
    let (share, of) = share_done();
    match (work, share > 0.0) {
        ("", false) => String::new(),
        (work, false) => format!(" ({work})"),
        ("", true) => format!(" ({:.0} % {of} done)", 100.0 * share),
        (work, true) => format!(" ({work}, {:.0} % {of})", 100.0 * share),
    }
}
