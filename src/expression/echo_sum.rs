//! Functions given as a sum of delayed echoes.

use crate::expression::fraction::{Fraction, NotAUnit};
use crate::expression::sum::Expression;
use num_traits::ToPrimitive;
use wavestep_polynomial::{Rational, Symbol};

/// A function of all time as a sum of echoes, one arriving every period `D`:
///
/// ```text
/// w(T) = Σ_{k: kD ≤ T} φ_k(T − kD)
/// ```
///
/// One short polynomial an echo, and no symbol of the period in it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EchoSum {
    pub(crate) period: Fraction,
    pub(crate) local: Symbol,
    pub echoes: Vec<Expression>,
}

impl EchoSum {
    /// The piece on the n-th period, in the local variable: `Σ_{k ≤ n} φ_k(s + (n−k)D)`; the
    /// echoes up to the n-th are known.
    pub fn piece(&self, n: usize) -> Result<Expression, NotAUnit> {
        let mut sum = Expression::zero();
        for (k, echo) in self.echoes[..=n].iter().enumerate() {
            let delay = Rational::from_integer((n - k).to_u64().expect("a count").into());
            sum += &echo.shift(&self.local, &self.period.scale(&delay))?;
        }
        Ok(sum)
    }
}
