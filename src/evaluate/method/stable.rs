//! Stable: the sum of echoes in doubles, as well as doubles can.
//!
//! Laguerre polynomials by the recurrence of their differences, delays formed without error, and the
//! exponent carried beside the mantissa, so that nothing underflows before the echo does. In pairs of
//! doubles the rounding of the sum is all that is left. The laws are measured, not proven.

use super::echo_sums::EchoSums;
use super::{Method, MethodError};
use crate::ball::{Ball, rational};
use crate::evaluate::signal::{Limit, Signal};
use wavestep_kernels::echoes;
use wavestep_polynomial::Rational;

/// In which numbers echoes are summed.
///
/// ```
/// use wavestep::{Method, StablePrecision};
///
/// let named: Method = "double-double".parse()?;
/// assert_eq!(named, Method::Stable(StablePrecision::DoubleDouble));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum StablePrecision {
    /// Doubles.
    Double,
    /// Pairs of doubles, some 106 bits.
    DoubleDouble,
}

/// An observable on a window by the stable sum of its echoes.
pub struct Stable {
    sums: EchoSums,
    precision: StablePrecision,
}

impl Stable {
    /// The echoes that arrive until the end of the window.
    ///
    /// # Errors
    /// [`MethodError::NoTaps`], where echoes have no closed form with one pole.
    ///
    /// # Cost
    /// O(n) for n echoes; for each value O(n²).
    pub fn new(signal: &dyn Signal, precision: StablePrecision) -> Result<Stable, MethodError> {
        Ok(Stable { sums: EchoSums::new(signal)?, precision })
    }

    /// How the kernel sums.
    fn sum(&self) -> echoes::Method {
        match self.precision {
            StablePrecision::Double => echoes::Method::Scaled,
            StablePrecision::DoubleDouble => echoes::Method::DoubleDouble,
        }
    }
}

impl Method for Stable {
    fn name(&self) -> &'static str {
        match self.precision {
            StablePrecision::Double => "stable",
            StablePrecision::DoubleDouble => "double-double",
        }
    }

    fn law(&self) -> String {
        match self.precision {
            StablePrecision::Double => {
                "at most 64 units in the last place of the largest value of each wave that is seen, \
                measured on rigid masses for n ≤ 200 and mu from 1/100 to 10"
            }
            StablePrecision::DoubleDouble => {
                "at most 2 units in the last place of the largest value, \
                measured on rigid masses for n ≤ 200 and mu from 1/100 to 10"
            }
        }
        .to_owned()
    }

    fn bound(&self) -> Option<f64> {
        None
    }

    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        let (high, rest) = Ball::from_rational(at, 128).split();
        self.sums.value(self.sum(), (high, rest.midpoint().to_double()), &|| at.clone(), side)
    }

    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        assert_eq!(at.len(), values.len(), "a place for each value");
        if self.precision == StablePrecision::Double
            && let Some(done) = self.sums.fill(at, values)
        {
            return done;
        }
        for (time, value) in at.iter().zip(values) {
            *value =
                self.sums.value(self.sum(), (*time, 0.0), &|| rational(*time), Limit::Right)?;
        }
        Ok(())
    }
}
