//! Until when a form with closed contacts is valid, as a note on standard error.

use num_rational::BigRational;
use wavestep::problem::Problem;
pub use wavestep_studies::validity::{derivation, pulling};

/// Says until when the form with closed contacts is true that was derived.
pub fn note_derivation(problem: &Problem) {
    if let Some(note) = derivation(problem) {
        eprintln!("note: {note}");
    }
}

/// Warns where a contact would pull before a time, when that is found quickly.
pub fn note_pulling(problem: &Problem, last: &BigRational) {
    if let Some(note) = pulling(problem, last) {
        eprintln!("note: {note}");
    }
}
