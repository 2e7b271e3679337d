//! Functions of time on one step, for all values of a symbol between two.

use crate::ball::{Arithmetic as _, Magnitude};
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::network::dot;
use crate::signal::Varying;

/// A function of time on a step, `P(x) + e(x)` for `0 ≤ x ≤ 1`, with `P(x) = Σ_k c_k x^k`.
///
/// # Invariants
/// `|e(x)| ≤ error` for each value of the symbol. Coefficients have no radii.
#[derive(Clone, Debug)]
pub struct OnStep {
    pub coefficients: Vec<Varying>,
    pub error: Magnitude,
}

impl OnStep {
    pub fn constant(value: &Varying) -> OnStep {
        let (value, error) = value.split();
        OnStep { coefficients: vec![value], error }
    }

    pub fn coefficient(&self, k: usize) -> Varying {
        self.coefficients.get(k).cloned().unwrap_or_else(Varying::zero)
    }

    /// The difference to another function.
    pub fn less(&self, other: &OnStep) -> OnStep {
        OnStep::sum(&[Varying::one(), Varying::one().negate()], [self, other].into_iter())
    }

    pub fn total<'p>(parts: impl Iterator<Item = &'p OnStep>) -> OnStep {
        let parts: Vec<&OnStep> = parts.collect();
        OnStep::sum(&vec![Varying::one(); parts.len()], parts.into_iter())
    }

    /// A sum with these factors.
    pub fn sum<'p>(factors: &[Varying], parts: impl Iterator<Item = &'p OnStep>) -> OnStep {
        let (factors, parts): (Vec<Varying>, Vec<&OnStep>) =
            factors.iter().cloned().zip(parts).filter(|(factor, _)| !factor.is_zero()).unzip();
        let errors = factors.iter().zip(&parts);
        let errors = errors.map(|(factor, part)| factor.magnitude().multiply(&part.error));
        let mut error = errors.fold(Magnitude::ZERO, |sum, own| sum.add(&own));
        let count = parts.iter().map(|part| part.coefficients.len()).max().unwrap_or(0);
        let coefficient = |k| {
            let column: Vec<Varying> = parts.iter().map(|part| part.coefficient(k)).collect();
            let (sum, off) = dot(&factors, &column, BITS).split();
            error = error.add(&off);
            sum
        };
        OnStep { coefficients: (0..count).map(coefficient).collect(), error }
    }

    /// The integral from the beginning of the step on.
    pub fn antiderivative(&self) -> OnStep {
        let (mut coefficients, mut error) = (vec![Varying::zero()], self.error);
        for (k, own) in self.coefficients.iter().enumerate() {
            let (own, off) = own.over(k as u64 + 1, BITS).split();
            coefficients.push(own);
            error = error.add(&off);
        }
        OnStep { coefficients, error }
    }

    /// The value at the end of the step, as a constant.
    pub fn at_end(&self) -> OnStep {
        let sum = self.coefficients.iter().fold(Varying::zero(), |sum, c| sum.add(c, BITS));
        let (value, off) = sum.split();
        OnStep { coefficients: vec![value], error: self.error.add(&off) }
    }

    pub fn square(&self) -> OnStep {
        let own = &self.coefficients;
        let size = own.iter().fold(Magnitude::ZERO, |sum, c| sum.add(&c.magnitude()));
        let mut error = size.scale(1).add(&self.error).multiply(&self.error);
        let coefficient = |k: usize| {
            let first = (k + 1).saturating_sub(own.len());
            let some = &own[first..=k.min(own.len() - 1)];
            let others: Vec<Varying> = some.iter().rev().cloned().collect();
            let (sum, off) = dot(some, &others, BITS).split();
            error = error.add(&off);
            sum
        };
        let coefficients = (0..(2 * own.len()).saturating_sub(1)).map(coefficient).collect();
        OnStep { coefficients, error }
    }
}
