//! Signals: functions of time, and what is made of them: digits, doubles, roots and extrema.
//!
//! `signal` says what all of them are asked, `closed` answers for waves in closed form. A wave at a time
//! is a finite sum `Σ_i r_i e^{λ_i}` with rational numbers, or with square roots of such. Whether it is
//! itself a rational number is decided exactly, first; else balls of rising precision enclose it until the
//! digits asked for are certain (`digits`). Sums, products and integrals of signals are signals (`operations`).

mod arrivals;
mod cells;
pub mod closed;
mod digits;
mod error;
pub mod find;
mod marched_pieces;
pub mod method;
mod operations;
#[expect(clippy::module_inception, reason = "the module is named after the trait it is built on")]
mod signal;
mod silence;
mod taps;
pub mod taylor;
pub mod transforms;
mod varying;

pub use crate::ball::Value;
pub use arrivals::{Arrival, LongEcho, arrivals};
pub(crate) use cells::scale;
pub use cells::{first_doubles, reaching_a_double};
pub use closed::{ClosedForm, ClosedSignal};
pub use digits::{digits, value};
pub use error::EvaluateError;
pub(crate) use find::middle_and_half;
pub use find::{Extremum, Goal, Place, Root, Roots, Search};
pub(crate) use method::values_of;
pub use method::{
    Certified, Compiled, Evaluator, Marched, MethodError, StablePrecision, Summation, Summed,
    Table, instructions, limit_instructions,
};
pub use operations::of_recurrence;
pub(crate) use operations::{
    Balanced, Combination, Constant, Difference, Integral, Operation, Product, Scale, Vibrating,
};
pub use signal::{At, EchoCount, Effort, Instant, Limit, Point, Signal, Signed};
pub(crate) use signal::{Enclosure, Known, MAX_FLATNESS, has_begun, last_begun, later, zeros_of};
pub(crate) use silence::Silence;
pub use taps::{NoTaps, Taps};
pub use taylor::{Expansion, Near, Taylor};
pub(crate) use taylor::{divide, divide_often, of_exponential};
pub use varying::{Varying, complex_product};
