//! The delay equation that is marched: one delay, one real pole.

use num_rational::BigRational;
use num_traits::{One, Signed};

use super::error::FixedError;

/// The equation `(d/dT + b) Y = ρ q (d/dT − a) Y + δ(T)`, in which `q` delays by the period D and
/// `Y = 0` before the start; all four parameters are exact.
///
/// Its solution is its own impulse response, `Y(T) = Σ_k ρ^k e^(−b x_k) L_k((a + b) x_k)` over all
/// `x_k = T − kD ≥ 0`, with the Laguerre polynomials `L_k`. It jumps by `ρ^n` at `T = nD`.
///
/// # Invariants
/// - `D > 0`, `b > 0`, `−1 ≤ ρ ≤ 1`; a is any rational.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct DelayEquation {
    pub(super) period: BigRational,
    rate: BigRational,
    zero: BigRational,
    pub(super) reflection: BigRational,
}

impl DelayEquation {
    /// The equation with the period D, the rate b of the pole, the zero a and the reflection ρ.
    /// D is a time, a and b are reciprocals of times, ρ is a pure number.
    pub fn new(
        period: &BigRational,
        rate: &BigRational,
        zero: &BigRational,
        reflection: &BigRational,
    ) -> Result<Self, FixedError> {
        if !period.is_positive() {
            return Err(FixedError::PeriodNotPositive);
        }
        if !rate.is_positive() {
            return Err(FixedError::RateNotPositive);
        }
        if reflection.abs() > BigRational::one() {
            return Err(FixedError::ReflectionTooLarge);
        }
        Ok(Self {
            period: period.clone(),
            rate: rate.clone(),
            zero: zero.clone(),
            reflection: reflection.clone(),
        })
    }

    /// The decay of a period, `B = bD`.
    pub(super) fn decay(&self) -> BigRational {
        &self.rate * &self.period
    }

    /// The strength of the forcing by the period before, `G = ρ(A + B)`, with `A = aD`.
    pub(super) fn forcing(&self) -> BigRational {
        &self.reflection * self.chirp()
    }

    /// The local frequency scale `A + B` of the echoes.
    pub(super) fn chirp(&self) -> BigRational {
        (&self.zero + &self.rate) * &self.period
    }
}
