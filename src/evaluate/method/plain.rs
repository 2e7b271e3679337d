//! Plain: echoes by the recurrence of three terms, as libraries have it.
//!
//! `(k+1) L_{k+1} = (2k+1−X) L_k − k L_{k−1}` in doubles, delays rounded. It does not fail as the expanded
//! formula does, but loses some thousand units in the last place by n = 200, most of them behind fronts,
//! where a rounding of a delay costs n units. It is here to be measured.

use super::echo_sums::EchoSums;
use super::{Method, MethodError};
use crate::ball::{Ball, rational};
use crate::evaluate::signal::{Limit, Signal};
use wavestep_kernels::echoes;
use wavestep_polynomial::Rational;

/// An observable on a window by the recurrence of three terms.
pub struct Plain {
    sums: EchoSums,
}

impl Plain {
    /// The echoes that arrive until the end of the window.
    ///
    /// # Errors
    /// [`MethodError::NoTaps`], where echoes have no closed form with one pole.
    ///
    /// # Cost
    /// O(n) for n echoes; for each value O(n²).
    pub fn new(signal: &dyn Signal) -> Result<Plain, MethodError> {
        Ok(Plain { sums: EchoSums::new(signal)? })
    }
}

impl Method for Plain {
    fn name(&self) -> &'static str {
        "plain"
    }

    fn law(&self) -> String {
        "no bound: some thousand units in the last place by n = 200, measured; \
         the whole jump at times within a rounding of an arrival"
            .to_owned()
    }

    fn bound(&self) -> Option<f64> {
        None
    }

    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        let high = Ball::from_rational(at, 128).to_double().0;
        self.sums.value(echoes::Method::Plain, (high, 0.0), &|| at.clone(), side)
    }

    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        assert_eq!(at.len(), values.len(), "a place for each value");
        for (time, value) in at.iter().zip(values) {
            let exact = || rational(*time);
            *value = self.sums.value(echoes::Method::Plain, (*time, 0.0), &exact, Limit::Right)?;
        }
        Ok(())
    }
}
