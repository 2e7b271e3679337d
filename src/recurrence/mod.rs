//! Linear recurrences between the pieces of wave functions on successive periods.
//!
//! A [`Statement`] is what a person writes down: equations, continuity, observables. A
//! [`Recurrence`] is a statement that has been checked and put in solving order: each [`Step`]
//! determines one wave on the n-th period from what is known by then, algebraically or by one
//! first-order differential equation.

mod coupled;
mod form;
mod guess;
mod naming;
mod notation;
mod ordering;
#[expect(clippy::module_inception, reason = "the file is named for the type it holds")]
mod recurrence;
mod roots;
mod statement;

pub use form::{Lags, LinearForm, Operator};
pub use notation::SourceNotation;
pub(crate) use notation::SourceProduct;
pub use ordering::{Coupled, Start, Step};
pub use recurrence::Recurrence;
pub(crate) use recurrence::{put_in, right_of};
pub use statement::{
    Clause, Continuity, Fault, InvalidRecurrence, Observable, Observation, ObservedWave,
    ProductTerm, Quadratic, Statement,
};

/// The place of a wave among the waves of a recurrence.
pub type WaveIndex = usize;
