//! Numbers from exact forms, with every digit proven.
//!
//! A wave at a time is a finite sum `Σ_i r_i e^{λ_i}` with rational numbers, or with square roots of
//! such. Whether it is itself a rational number is decided exactly, first; else balls of rising
//! precision enclose it until the digits asked for are certain.

mod arrivals;
mod cells;
mod contribution;
mod energy;
mod error;
mod evaluator;
mod find;
mod fitted_cells;
mod marched_pieces;
mod method;
mod modular;
mod periods;
mod scene;
mod signal;
mod taps;
mod taylor;
mod transforms;
mod waves;

pub use crate::ball::Value;
pub use arrivals::{Arrival, arrivals};
pub(crate) use cells::scale;
pub use error::EvaluateError;
pub use evaluator::{
    Evaluator, Limit, MAX_DIGITS, MAX_ORDER, MAX_ORDER_OF_SEQUENCE, MAX_ORDER_WITHOUT_FORM,
};
pub use find::{At, ObservedSignal, Piecewise};
pub use find::{Extremum, Goal, MAX_ROOTS, Place, Root, Roots, Search};
pub use method::{
    Certified, Compiled, Expanded, Marched, Method, MethodError, Plain, Recogniser, Stable,
    StablePrecision, instructions,
};
pub use scene::{MAX_ECHOES, SceneEvaluator};
pub use signal::{MAX_PIECES, Signal, Stretch};
pub use taps::{Extra, NoTaps, Tap, Taps};
pub use taylor::Taylor;
pub(crate) use waves::Waves;
