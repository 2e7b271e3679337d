//! Certified numbers: binary floating-point numbers of any length that carry a proven bound of
//! their own error.
//!
//! A [`Ball`] is a midpoint and a radius; every operation returns a ball that contains each result
//! its operands allow. [`exp_of_rational`] and [`evaluate_divided`] enclose the two functions that
//! sums of polynomials and exponentials are made of, [`proven_digits`] turns a ball into a decimal
//! if the ball leaves no choice, and [`certify`] raises the precision until it does.
//!
//! ```
//! use num_rational::BigRational;
//! use wavestep::ball::{certify, exp_of_rational};
//!
//! // The exponential of −900 to twenty digits, far below the least double.
//! let x = BigRational::from_integer((-900).into());
//! let proven = certify(20, 1 << 14, |bits| exp_of_rational(&x, bits)).unwrap();
//! assert_eq!(proven.decimal.to_string(), "1.3644772123656827617e-391");
//! ```

#[expect(clippy::module_inception, reason = "the module is named after the type it is built on")]
mod ball;
mod binary;
mod certify;
mod decimal;
mod divided;
mod enclosure;
mod error;
mod exponential;
mod magnitude;
#[cfg(test)]
mod samples;

pub use ball::Ball;
pub use binary::Binary;
pub use certify::{Certified, CertifyError, certify};
pub use decimal::{Decimal, Exactness, proven_digits};
pub use divided::evaluate_divided;
pub use enclosure::DecimalEnclosure;
pub use error::BallError;
pub use exponential::{ARGUMENT_BITS, exp_of_rational};
pub use magnitude::Magnitude;
