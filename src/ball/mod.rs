//! Certified numbers: binary floating-point numbers of any length that carry a proven bound of
//! their own error.
//!
//! A [`Ball`] is a midpoint and a radius; every operation returns a ball that contains each result
//! its operands allow. A `ComplexBall` is a pair of balls, a `Number` an exact rational or a ball.
//! A [`Decimal`] has a definite count of digits, a [`DecimalEnclosure`] is a ball as a person reads it,
//! and a [`Value`] is a number with proven digits. [`Precisions`] is the one loop that raises precision.

mod arithmetic;
#[expect(clippy::module_inception, reason = "the module is named after the type it is built on")]
mod ball;
mod binary;
mod complex;
pub mod decimal;
pub mod divided;
mod double;
mod enclosure;
mod error;
mod exponential;
mod logarithm;
mod magnitude;
mod number;
mod precision;
mod products;
mod root;
mod trigonometry;
mod value;

pub use arithmetic::{Arithmetic, Trigonometric};
pub use ball::Ball;
pub use binary::Binary;
pub use complex::ComplexBall;
pub use decimal::{Bound, Decimal, Exactness, in_decimals};
pub use divided::evaluate_divided;
pub use double::rational;
pub(crate) use double::{at_or_after, at_or_before, unit_in_the_last_place};
pub use enclosure::DecimalEnclosure;
pub use error::BallError;
pub use exponential::exp_of_rational;
pub use magnitude::Magnitude;
pub use number::Number;
pub use precision::{Attempt, Precisions};
pub(crate) use value::NEGLIGIBLE_BITS;
pub use value::Value;
