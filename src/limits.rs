//! How much is done at most. Where a limit is met the error names it.

use std::cell::Cell;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

// ---- Texts ---------------------------------------------------------------------------------------

/// Bytes of a text: no scene comes near it.
pub const MAX_SOURCE_BYTES: usize = 1 << 20;

/// Bytes of a lock file, whose formulas a program writes.
pub const MAX_LOCK_BYTES: usize = 16 << 20;

/// Mistakes that are told of one text.
pub const MAX_MISTAKES: usize = 50;

/// Levels of nesting in an expression, so that no recursion over its tree overflows the stack.
pub const MAX_NESTING: u16 = 200;

/// Digits of a number in a text.
pub const MAX_NUMBER_DIGITS: usize = 1000;

/// Places between the decimal point and the last digit of a number in a text.
pub const MAX_DECIMAL_EXPONENT: i64 = 1000;

/// Bits of a constant once it is worked out as a fraction, so that `2^(2^99)` fails at once.
pub const MAX_CONSTANT_BITS: u64 = 1 << 15;

/// The index of a wave in a text, and the number added to one.
pub const MAX_INDEX: u32 = 1_000_000;

/// Periods that an equation looks back: its recurrence keeps the waves of as many.
pub const MAX_LAG: i64 = 1000;

/// Exponents in a text. Degrees go to twice as many.
pub const MAX_EXPONENT: u32 = 1000;

/// Terms of an expression once it is multiplied out.
pub const MAX_TERMS: usize = 100_000;

/// Powers of a unit; no quantity of mechanics has a higher one.
pub const MAX_UNIT_POWER: u8 = 9;

/// Exponents of local contacts. A larger one is a wall: at half of `α_0` the force is below `2^{−100} F_0`,
/// beyond it a rounding of `α` changes the force by more than `10^{−14}` of it.
pub const MAX_CONTACT_EXPONENT: u8 = 100;

// ---- Values --------------------------------------------------------------------------------------

/// Terms that are derived at once.
pub const MAX_DERIVED_TERMS: u128 = 2_000_000;

/// Echoes on a lattice of delays that are derived at once.
pub const MAX_DERIVED_ECHOES: usize = 5_000;

/// Significant digits that are certified.
pub const MAX_DIGITS: usize = 10_000;

/// Significant digits of a symbol for which extrema are equal: each costs more than three pairs of extrema.
pub const MAX_DIGITS_OF_SYMBOL: usize = 60;

/// Bits of working precision for a value, unless more are allowed.
pub const VALUE_BITS: u64 = 1 << 18;

/// Bits of working precision for roots and extrema, unless more are allowed.
pub const SEARCH_BITS: u64 = 1 << 12;

/// Periods before a time where echoes have a closed form: the cost grows with their square.
pub const MAX_ORDER: usize = 2_000;

/// Periods before a time where waves are sequences in closed form, of which one term is worked out.
pub const MAX_ORDER_OF_SEQUENCE: usize = 50_000;

/// Periods before a time where echoes are derived one from another, with ever longer expressions.
pub const MAX_ORDER_WITHOUT_FORM: usize = 400;

/// Echoes of one wave that are worked out on a lattice of delays.
pub const MAX_ECHOES: usize = 20_000;

/// Periods whose pieces are held: their coefficients grow with the square of that.
pub const MAX_PIECES: usize = 2_000;

/// Bytes that the waves of a scene at one precision may take: what [`set_memory`] says; without that a quarter
/// of the machine's memory, or 2 GB where that is not known.
pub fn memory() -> u64 {
    let known = MEMORY.load(Ordering::Relaxed);
    if known > 0 {
        return known;
    }
    let memory = machine().map_or(2_000_000_000, |bytes| bytes / 4);
    MEMORY.store(memory, Ordering::Relaxed);
    memory
}

/// Allows so many bytes for waves, for all that is asked for from now on.
pub fn set_memory(bytes: u64) {
    MEMORY.store(bytes, Ordering::Relaxed);
}

static MEMORY: AtomicU64 = AtomicU64::new(0);

/// The share of the work at hand that is done, and of what it is a share, for who shows how work goes on; 0 where
/// nothing is counted.
pub fn share_done() -> (f64, &'static str) {
    *DONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on, work on this thread tells no share: it is one of several that work at once.
pub fn count_nothing_here() {
    COUNTS.set(false);
}

thread_local! {
    static COUNTS: Cell<bool> = const { Cell::new(true) };
}

/// Tells that share.
pub(crate) fn tell_done(share: f64, of: &'static str) {
    if !COUNTS.get() {
        return;
    }
    *DONE.lock().unwrap_or_else(PoisonError::into_inner) = (share, of);
}

static DONE: Mutex<(f64, &'static str)> = Mutex::new((0.0, ""));

/// Counts through a range and tells how much of it is done.
pub(crate) struct Counted {
    range: Range<usize>,
    count: usize,
    of: &'static str,
}

pub(crate) fn counted(range: Range<usize>, of: &'static str) -> Counted {
    Counted { count: range.len(), range, of }
}

impl Iterator for Counted {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        tell_done(1.0 - self.range.len() as f64 / self.count.max(1) as f64, self.of);
        self.range.next()
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        tell_done(0.0, "");
    }
}

/// Lets long work be stopped: `pause` is called between its steps, on the thread that works, and ends it by unwinding.
/// Only the first one that is given counts.
///
/// ```standalone_crate
/// use std::panic::{catch_unwind, resume_unwind};
/// use wavestep::{Problem, limits};
///
/// limits::stop_by(|| resume_unwind(Box::new("stopped")));
/// let force = || Problem::builtin("hopkinson")?.signal("force")?.at("400 us", 9);
/// assert!(catch_unwind(force).is_err_and(|reason| reason.is::<&str>()));
/// ```
pub fn stop_by(pause: fn()) {
    let _ = PAUSE.set(pause);
}

/// A moment between two steps of long work.
pub(crate) fn pause() {
    if let Some(pause) = PAUSE.get() {
        pause();
    }
}

static PAUSE: OnceLock<fn()> = OnceLock::new();

/// Bytes that the process holds in memory, where Linux tells.
pub fn resident() -> Option<u64> {
    let told = std::fs::read_to_string("/proc/self/status").ok()?;
    let held = told.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    Some(held.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok()? * 1024)
}

/// The memory of the machine, where Linux tells.
fn machine() -> Option<u64> {
    let told = std::fs::read_to_string("/proc/meminfo").ok()?;
    let total = told.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    Some(total.trim().strip_suffix(" kB")?.parse::<u64>().ok()? * 1024)
}

/// Echoes that are summed for a value in doubles: the cost grows with the square.
pub const MAX_SUMMED_ECHOES: usize = 5_000;

/// Periods that are marched through.
pub const MAX_MARCHED_PERIODS: u64 = 10_000_000;

/// Polynomials that follow a function on a window.
pub const MAX_POLYNOMIALS: usize = 400_000;

/// Times that polynomials are worked out for one stretch of a search: each shows several roots, so that a function
/// which needs more has more roots than are told, or a rate with which its cells cannot keep up.
pub const MAX_EXPANSIONS: usize = 20_000;

/// Roots, or places of extrema, in a window.
pub const MAX_ROOTS: usize = 10_000;

/// Cells of a bar at which a field is given.
pub const MAX_FIELD_CELLS: usize = 100_000;

// ---- Contacts that open --------------------------------------------------------------------------

/// Contacts in one place; all states of a place, two for each contact, are looked at.
pub const MAX_CONTACTS: usize = 6;

/// Events: a contact that rattles would have more and more of them.
pub const MAX_EVENTS: usize = 1_000;

/// Cells of waves.
pub const MAX_HISTORY_CELLS: usize = 400_000;

/// Bits with which contacts are followed.
pub const MAX_HISTORY_BITS: u64 = 1 << 11;

// ---- Values of a symbol that are followed at once ---------------------------------------------------

/// Steps of time, of all travel times a common measure.
pub const MAX_STEPS_OVER_SYMBOL: usize = 2048;

/// The precision of coefficients: bounds of differences need few digits more than tolerances have.
pub const MAX_SYMBOL_BITS: u64 = 96;

/// Parts of a range of values, each proven by itself.
pub const MAX_PARTS_OVER_SYMBOL: usize = 256;

// ---- Models --------------------------------------------------------------------------------------

/// Modes of a line.
pub const MAX_MODES: usize = 1_000_000;

/// Modes times times of one observable: one cosine each.
pub const MAX_MODE_TERMS: f64 = 1e9;

/// Cells times steps of finite differences: a few seconds of work.
pub const MAX_CELL_UPDATES: f64 = 1e9;

/// Nodes times periods of the method of steps, each of which is integrated anew.
pub const MAX_NODE_PERIODS: f64 = 2e6;
