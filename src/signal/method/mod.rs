//! The ladder of methods: the exact solution in doubles, each with its error law.
//!
//! | method | error | for |
//! |---|---|---|
//! | [`Certified`] | correctly rounded | every observable that is linear in the waves |
//! | [`Compiled`] | proven bound, the same on the whole window | the same |
//! | [`Marched`] | proven bound for passive reflections with one pole and one lag; else measured, without a bound | every observable that is linear in the waves, on a grid |
//! | [`Summed`], stable | measured: some units in the last place of the largest value | waves with one pole and one lag |
//! | [`Summed`], plain | measured: some thousand units by n = 200 | the same |
//! | [`Summed`], expanded | measured: grows without bound | every observable that is linear in the waves |
//!
//! The first two need no closed form, and serve contacts that open as well.

mod certified;
pub mod clock;
mod compiled;
mod doubles;
mod echo_sums;
mod error;
mod march_system;
mod marched;
pub mod marched_response;
mod marched_waves;
mod printed;
mod summed;

pub use certified::Certified;
pub use compiled::Compiled;
pub(crate) use compiled::values_of;
pub use error::MethodError;
pub use marched::Marched;
pub use summed::{StablePrecision, Summed};
pub use wavestep_kernels::Table;
pub use wavestep_kernels::echoes::Method as Summation;

use crate::signal::signal::Limit;
use wavestep_polynomial::Rational;

/// Evaluates an observable in doubles on a window of time, in one way.
pub trait Evaluator {
    /// How far values can be off, in words.
    fn law(&self) -> String;

    /// A proven bound on the absolute error of every value on the window, beyond half a unit in its
    /// last place; `None` where the law is measured only.
    fn bound(&self) -> Option<f64>;

    /// The value at a time.
    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError>;

    /// The values at many exact times.
    fn exact_values(&self, at: &[Rational], side: Limit) -> Result<Vec<f64>, MethodError> {
        at.iter().map(|at| self.value(at, side)).collect()
    }

    /// The values at many times, right limits.
    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError>;
}

/// From now on, polynomials are evaluated with the vector instructions of this name at most: `baseline`, `avx2` or
/// `avx512`. False where there are none of this name.
#[must_use]
pub fn limit_instructions(name: &str) -> bool {
    use wavestep_kernels::Level::{Avx2, Avx512, Baseline};
    let levels = [("baseline", Baseline), ("avx2", Avx2), ("avx512", Avx512)];
    let level = levels.into_iter().find_map(|(own, level)| (own == name).then_some(level));
    level.inspect(|level| level.limit()).is_some()
}

/// The vector instructions that polynomials are evaluated with on this machine.
pub fn instructions() -> String {
    format!("{:?}", wavestep_kernels::Level::best())
}
