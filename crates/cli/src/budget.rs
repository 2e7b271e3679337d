//! What a command may take. The library foresees most work that would explode and refuses it before it begins;
//! this watch beside the work holds the rest to its time and its memory.

use super::failure::{COMPUTATION, Failure};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, process, thread};
use wavestep::limits::{followed_share, memory};

/// How often the watch looks.
const TICK: Duration = Duration::from_millis(20);

/// What the program takes beside the waves.
const PROGRAM: u64 = 64_000_000;

/// Held while something is written, so that nothing ends half written.
static WRITING: Mutex<()> = Mutex::new(());

/// Whether the work is done, and nothing is left but to write.
static DONE: AtomicBool = AtomicBool::new(false);

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
            if time.is_some_and(|time| begun.elapsed() >= time) {
                end(&too_long(begun.elapsed()));
            }
            if resident().is_some_and(|bytes| bytes > memory().saturating_add(PROGRAM)) {
                end(&too_much());
            }
        }
    });
}

/// The work is done: what is written now is not cut off.
pub fn done() {
    DONE.store(true, Ordering::SeqCst);
}

/// Nothing ends while this is held.
pub fn writing() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Tells what is being done.
pub fn tell(work: &'static str) {
    *WORK.lock().unwrap_or_else(PoisonError::into_inner) = work;
}

fn end(failure: &Failure) {
    let _written = writing();
    if !DONE.load(Ordering::SeqCst) {
        failure.show();
        process::exit(i32::from(failure.code()));
    }
}

fn too_long(taken: Duration) -> Failure {
    let message =
        format!("no answer within {} s{}", (taken.as_secs_f64() * 10.0).floor() / 10.0, reached());
    Failure::new(
        COMPUTATION,
        message,
        "ask for an earlier time, a shorter window or fewer digits, or allow more with --time-limit",
    )
}

fn too_much() -> Failure {
    let message =
        format!("the answer takes more than {} MB of memory{}", memory() / 1_000_000, reached());
    Failure::new(
        COMPUTATION,
        message,
        "ask for an earlier time, a shorter window or fewer digits, or allow more with --memory",
    )
}

/// How far the work has come.
fn reached() -> String {
    let work = *WORK.lock().unwrap_or_else(PoisonError::into_inner);
    let share = followed_share();
    match (work, share > 0.0) {
        ("", false) => String::new(),
        (work, false) => format!(" ({work})"),
        ("", true) => format!(" ({:.0} % of the window is followed)", 100.0 * share),
        (work, true) => format!(" ({work}, {:.0} % of the window)", 100.0 * share),
    }
}

/// Bytes that the process holds in memory, where Linux tells.
fn resident() -> Option<u64> {
    let told = fs::read_to_string("/proc/self/status").ok()?;
    let held = told.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    Some(held.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok()? * 1024)
}
