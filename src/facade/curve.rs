//! A window of a signal, made ready for values by the million.

use crate::error::Error;
use crate::signal::{Compiled, Evaluator as _, Table, values_of};

/// A signal on a window as polynomials in doubles, with one bound for all of it; see
/// [`Signal::compiled`](crate::Signal::compiled). It stands alone, and may be used from several threads.
///
/// ```
/// let mass = wavestep::Problem::builtin("rigid-mass")?.with("mu", 1)?;
/// let curve = mass.signal("strain_fixed")?.compiled(0..=10, Some("1e-9".parse()?))?;
/// let mut values = [0.0; 1];
/// curve.values(&[2.0], &mut values)?;
/// assert!((values[0] + 2.0 * (-1_f64).exp()).abs() < 1e-8 && curve.bound() < 1e-8);
/// assert!(curve.values(&[10.5], &mut values).is_err());
/// # Ok::<(), wavestep::Error>(())
/// ```
pub struct Curve {
    table: Table,
    bound: f64,
    law: String,
}

impl Curve {
    pub(super) fn new(compiled: Compiled<'_>) -> Curve {
        let (law, bound) = (compiled.law(), compiled.bound().unwrap_or(f64::INFINITY));
        Curve { table: compiled.into_table(), bound, law }
    }

    /// A proven bound on the absolute error of every value, beyond half a unit in its last place.
    #[must_use]
    pub fn bound(&self) -> f64 {
        self.bound
    }

    /// The same in words.
    #[must_use]
    pub fn law(&self) -> &str {
        &self.law
    }

    /// The first double of the window and the last.
    #[must_use]
    pub fn window(&self) -> [f64; 2] {
        [self.table.start(), self.table.end()]
    }

    /// The values at many times, each of the limit from later times; fastest where they ascend.
    ///
    /// # Errors
    /// A time outside the window.
    ///
    /// # Panics
    /// Where there are not as many times as places for values.
    pub fn values(&self, times: &[f64], values: &mut [f64]) -> Result<(), Error> {
        Ok(values_of(&self.table, times, values)?)
    }
}
