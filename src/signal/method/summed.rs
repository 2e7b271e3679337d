//! Summed: echoes added up in doubles, in three ways.
//!
//! - *Stable*: as well as doubles can. Laguerre polynomials by the recurrence of their differences, delays
//!   formed without error, and the exponent carried beside the mantissa, so that nothing underflows before
//!   the echo does. In pairs of doubles the rounding of the sum is all that is left.
//! - *Plain*: `(k+1) L_{k+1} = (2k+1−X) L_k − k L_{k−1}`, delays rounded, as libraries have it. It loses some
//!   thousand units in the last place by n = 200, most of them behind fronts, where a rounding of a delay
//!   costs n units.
//! - *Expanded*: the formula as it is printed, in powers of time with alternating coefficients, by Horner's
//!   scheme, delays rounded. Terms reach about `e^{2√(2nx)}`, for x small against n, before they cancel to a
//!   value of order 1, so that digits are lost from n = 15 or so on.
//!
//! The last two are what one would write, and here to be measured. All laws are measured, not proven.

use super::echo_sums::EchoSums;
use super::printed::PrintedEchoes;
use super::{Evaluator, MethodError, Summation};
use crate::ball::{Ball, rational};
use crate::signal::signal::{Limit, Signal};
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

impl From<StablePrecision> for Summation {
    fn from(precision: StablePrecision) -> Summation {
        match precision {
            StablePrecision::Double => Summation::Scaled,
            StablePrecision::DoubleDouble => Summation::DoubleDouble,
        }
    }
}

/// An observable on a window by the sum of its echoes.
pub struct Summed {
    echoes: Echoes,
    summation: Summation,
}

/// Echoes with one pole in closed form, or any others as they are derived.
enum Echoes {
    Closed(Box<EchoSums>),
    Derived(PrintedEchoes),
}

impl Summed {
    /// The echoes that arrive until the end of the window: O(n) for n echoes in closed form, O(n³) for
    /// others; for each value O(n²).
    pub fn new(signal: &dyn Signal, summation: Summation) -> Result<Summed, MethodError> {
        let echoes = match EchoSums::new(signal) {
            Err(MethodError::NoTaps(_)) if summation == Summation::Expanded => {
                Echoes::Derived(PrintedEchoes::new(signal)?)
            }
            sums => Echoes::Closed(Box::new(sums?)),
        };
        Ok(Summed { echoes, summation })
    }

    /// The value at a time near the sum of two doubles.
    fn at(
        &self,
        (high, low): (f64, f64),
        exact: &dyn Fn() -> Rational,
        side: Limit,
    ) -> Result<f64, MethodError> {
        let sums = match &self.echoes {
            Echoes::Closed(sums) => sums,
            Echoes::Derived(echoes) => return Ok(echoes.value(high, side)),
        };
        let low = match self.summation {
            Summation::Scaled | Summation::DoubleDouble => low,
            Summation::Plain | Summation::Expanded => 0.0,
        };
        sums.value(self.summation, (high, low), exact, side)
    }
}

impl Evaluator for Summed {
    fn law(&self) -> String {
        match self.summation {
            Summation::Scaled => {
                "at most 64 units in the last place of the largest value of each wave that is seen, \
                measured on rigid masses for n ≤ 200 and mu from 1/100 to 10"
            }
            Summation::DoubleDouble => {
                "at most 2 units in the last place of the largest value, \
                measured on rigid masses for n ≤ 200 and mu from 1/100 to 10"
            }
            Summation::Plain => {
                "no bound: some thousand units in the last place by n = 200, measured; \
                the whole jump at times within a rounding of an arrival"
            }
            Summation::Expanded => {
                "no bound: about 2^−53 e^{2√(2nx)} where terms cancel, measured"
            }
        }
        .to_owned()
    }

    fn bound(&self) -> Option<f64> {
        None
    }

    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        let (high, rest) = Ball::from_rational(at, 128).split();
        self.at((high, rest.midpoint().to_double()), &|| at.clone(), side)
    }

    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        assert_eq!(at.len(), values.len(), "a place for each value");
        if let (Echoes::Closed(sums), Summation::Scaled) = (&self.echoes, self.summation)
            && let Some(done) = sums.fill(at, values)
        {
            return done;
        }
        for (time, value) in at.iter().zip(values) {
            *value = self.at((*time, 0.0), &|| rational(*time), Limit::Right)?;
        }
        Ok(())
    }
}
