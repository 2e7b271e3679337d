//! Certified numbers: binary floating-point numbers of any length that carry a proven bound of
//! their own error.
//!
//! A [`Ball`] is a midpoint and a radius; every operation returns a ball that contains each result
//! its operands allow. A [`ComplexBall`] is a pair of balls, a `Number` an exact rational or a ball.
//! A [`Decimal`] has a definite count of digits, a [`DecimalEnclosure`] is a ball as a person reads it,
//! and a [`Certified`] value is a decimal with the ball that proves it.
//!
//! Values of waves come as [`Certified`] from [`evaluate`](crate::evaluate); balls may be
//! calculated with further.

#[expect(clippy::module_inception, reason = "the module is named after the type it is built on")]
mod ball;
mod binary;
mod certify;
mod complex;
mod decimal;
mod divided;
mod double;
mod enclosure;
mod error;
mod exponential;
mod logarithm;
mod magnitude;
mod number;
mod root;
#[cfg(test)]
mod samples;
mod trigonometry;

pub use ball::Ball;
pub use binary::Binary;
pub use certify::{Certified, CertifyError, certify};

pub use complex::ComplexBall;
pub use decimal::{Decimal, Exactness};
pub(crate) use divided::evaluate_divided;
pub use enclosure::DecimalEnclosure;
pub use error::BallError;
pub(crate) use exponential::exp_of_rational;
pub use magnitude::Magnitude;
pub(crate) use number::Number;
