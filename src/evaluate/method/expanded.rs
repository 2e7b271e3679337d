//! Expanded: the formula as it is printed, in doubles.
//!
//! Echoes in powers of time with alternating coefficients, by Horner's scheme, delays rounded. Terms
//! reach about `e^{2√(2nx)}`, for x small against n, before they cancel to a value of order 1, so that digits are lost from
//! n = 15 or so on. It is here because it is what one would write, and to be measured.

use super::echo_sums::EchoSums;
use super::printed::PrintedEchoes;
use super::{Method, MethodError};
use crate::ball::{Ball, rational};
use crate::evaluate::signal::{Limit, Signal};
use wavestep_kernels::echoes;
use wavestep_polynomial::Rational;

/// An observable on a window by the formula as printed.
pub struct Expanded {
    sums: Sums,
}

/// Echoes with one pole in closed form, or any others as they are derived.
enum Sums {
    Closed(Box<EchoSums>),
    Derived(PrintedEchoes),
}

impl Expanded {
    /// The echoes that arrive until the end of the window.
    ///
    /// # Errors
    /// [`MethodError`], where too many echoes without a closed form would have to be derived.
    ///
    /// # Cost
    /// O(n) for n echoes in closed form, O(n³) for others; for each value O(n²).
    pub fn new(signal: &dyn Signal) -> Result<Expanded, MethodError> {
        let sums = match EchoSums::new(signal) {
            Err(MethodError::NoTaps(_)) => Sums::Derived(PrintedEchoes::new(signal)?),
            sums => Sums::Closed(Box::new(sums?)),
        };
        Ok(Expanded { sums })
    }

    fn at(&self, time: f64, exact: &dyn Fn() -> Rational, side: Limit) -> Result<f64, MethodError> {
        match &self.sums {
            Sums::Closed(sums) => sums.value(echoes::Method::Expanded, (time, 0.0), exact, side),
            Sums::Derived(echoes) => Ok(echoes.value(time, side)),
        }
    }
}

impl Method for Expanded {
    fn name(&self) -> &'static str {
        "expanded"
    }

    fn law(&self) -> String {
        "no bound: about 2^−53 e^{2√(2nx)} where terms cancel, measured".to_owned()
    }

    fn bound(&self) -> Option<f64> {
        None
    }

    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        let high = Ball::from_rational(at, 128).to_double().0;
        self.at(high, &|| at.clone(), side)
    }

    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        assert_eq!(at.len(), values.len(), "a place for each value");
        for (time, value) in at.iter().zip(values) {
            *value = self.at(*time, &|| rational(*time), Limit::Right)?;
        }
        Ok(())
    }
}
