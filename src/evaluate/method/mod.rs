//! The ladder of methods: the exact solution in doubles, each with its error law.
//!
//! | method | error | for |
//! |---|---|---|
//! | [`Certified`] | correctly rounded | every observable that is linear in the waves |
//! | [`Compiled`] | proven bound, the same on the whole window | the same |
//! | [`Marched`] | proven bound for passive reflections with one pole and one lag; else measured, without a bound | every observable that is linear in the waves, on a grid |
//! | [`Stable`] | measured: some units in the last place of the largest value | waves with one pole and one lag |
//! | [`Plain`] | measured: some thousand units by n = 200 | the same |
//! | [`Expanded`] | measured: grows without bound | every observable that is linear in the waves |

mod certified;
mod clock;
mod compiled;
mod doubles;
mod echo_sums;
mod expanded;
mod held_waves;
mod march_system;
mod marched;
mod marched_response;
mod marched_waves;
mod plain;
mod printed;
mod stable;

pub use certified::{Certified, Recogniser};
pub use compiled::Compiled;
pub use expanded::Expanded;
pub use marched::Marched;
pub use plain::Plain;
pub use stable::{Stable, StablePrecision};

use crate::evaluate::evaluator::{EvaluateError, Limit};
use crate::evaluate::taps::NoTaps;
use std::fmt;
use wavestep_kernels::TableError;
use wavestep_polynomial::Rational;

/// One way to values of an observable in doubles, on a window of time.
///
/// ```
/// use wavestep::evaluate::{Compiled, Method, Limit, Signal};
/// use wavestep::language::{Source, parse_number, read_recurrence};
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = [("mu".to_owned(), parse_number("1")?)].into();
/// let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// let (from, to) = (parse_number("0")?, parse_number("20")?);
/// let compiled = Compiled::new(&signal, &from, &to, None).unwrap();
/// // f(1) = e^{−1}; just before the echo at 2 it is e^{−2}, just after 1 + e^{−2}.
/// let at = |t, side| compiled.value(&parse_number(t).unwrap(), side).unwrap();
/// let bound = compiled.bound().unwrap();
/// assert!(bound < 1e-15);
/// assert!((at("1", Limit::Right) - (-1f64).exp()).abs() <= 2.0 * bound);
/// assert!((at("2", Limit::Right) - at("2", Limit::Left) - 1.0).abs() <= 2.0 * bound);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub trait Method {
    /// What it is called on the command line.
    fn name(&self) -> &'static str;

    /// How far values can be off, in words.
    fn law(&self) -> String;

    /// A proven bound on the absolute error of every value on the window, beyond half a unit in its
    /// last place; `None` where the law is measured only.
    fn bound(&self) -> Option<f64>;

    /// The value at a time.
    ///
    /// # Errors
    /// [`MethodError`] outside the window, and where there is no value.
    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError>;

    /// The values at many exact times.
    ///
    /// # Errors
    /// As [`Method::value`].
    fn exact_values(&self, at: &[Rational], side: Limit) -> Result<Vec<f64>, MethodError> {
        at.iter().map(|at| self.value(at, side)).collect()
    }

    /// The values at many times, right limits.
    ///
    /// # Errors
    /// As [`Method::value`].
    ///
    /// # Panics
    /// Where there are not as many places for values as times.
    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError>;
}

/// The vector instructions that polynomials are evaluated with on this machine.
///
/// ```
/// assert!(["Baseline", "Avx2", "Avx512"].contains(&wavestep::evaluate::instructions().as_str()));
/// ```
pub fn instructions() -> String {
    format!("{:?}", wavestep_kernels::Level::best())
}

/// Why a method has no value.
///
/// ```
/// use wavestep::evaluate::{Compiled, Method as _, MethodError};
/// # use wavestep::evaluate::Signal;
/// # use wavestep::language::{Source, parse_number, read_recurrence};
/// # let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// # let values = [("mu".to_owned(), parse_number("1")?)].into();
/// # let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// # let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// # let (from, to) = (parse_number("0")?, parse_number("2")?);
/// let compiled = Compiled::new(&signal, &from, &to, None).unwrap();
/// let late = compiled.values(&[1.0, 3.0], &mut [0.0; 2]);
/// assert_eq!(late, Err(MethodError::Outside));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub enum MethodError {
    /// The exact solution cannot be had.
    Evaluate(EvaluateError),
    /// The method needs waves with one pole and one lag.
    NoTaps(NoTaps),
    /// The polynomials make no table.
    Table(TableError),
    /// A kernel cannot go on: its own words.
    Kernel(String),
    /// A time that is not within the window, or no number.
    Outside,
    /// The method takes fewer periods.
    TooManyPeriods {
        /// How many are asked for.
        periods: usize,
        /// How many are allowed.
        limit: usize,
    },
}

impl fmt::Display for MethodError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MethodError::Evaluate(error) => error.fmt(f),
            MethodError::NoTaps(error) => error.fmt(f),
            MethodError::Table(error) => error.fmt(f),
            MethodError::Kernel(reason) => f.write_str(reason),
            MethodError::Outside => f.write_str("a time outside the window"),
            MethodError::TooManyPeriods { periods: usize::MAX, limit } => {
                write!(f, "far more periods than the {limit} that this method takes at most")
            }
            MethodError::TooManyPeriods { periods, limit } => {
                write!(f, "{periods} periods, where this method takes at most {limit}")
            }
        }
    }
}

impl std::error::Error for MethodError {}

impl From<EvaluateError> for MethodError {
    fn from(error: EvaluateError) -> MethodError {
        MethodError::Evaluate(error)
    }
}

impl From<NoTaps> for MethodError {
    fn from(error: NoTaps) -> MethodError {
        MethodError::NoTaps(error)
    }
}

impl From<TableError> for MethodError {
    fn from(error: TableError) -> MethodError {
        MethodError::Table(error)
    }
}
