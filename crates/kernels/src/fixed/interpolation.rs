//! Interpolation at the nodes of Chebyshev, from fixed-point values to coefficients in doubles.
//!
//! Nothing here is proven: the polynomials are compared with the function afterwards.

use super::multiplier::{Fraction, Multiplier};
use super::value::FRACTION_BITS;
use crate::double_double::DoubleDouble;
use std::f64::consts::PI;

/// The highest degree: beyond it the coefficients of powers lose too many digits of pairs of doubles.
const HIGHEST_DEGREE: usize = 31;

/// Nodes `x_j ∈ (−1, 1)`, and the matrix from values there to coefficients of powers.
#[derive(Clone, Debug)]
pub(super) struct Interpolation {
    nodes: Vec<Multiplier>,
    /// Row k gives the coefficient of `x^k`.
    matrix: Vec<Vec<DoubleDouble>>,
}

impl Interpolation {
    /// By polynomials of a degree; none beyond the highest.
    ///
    /// The nodes are the doubles next to `cos(π(j + ½)/N)`, and column j holds the coefficients of
    /// `Π_{i≠j} (x − x_i)/(x_j − x_i)`. O(degree³).
    pub(super) fn new(degree: usize) -> Option<Self> {
        if degree > HIGHEST_DEGREE {
            return None;
        }
        let count = degree + 1;
        let node = |j: usize| -> f64 {
            // The middle one is 0, exactly.
            let place = 2 * j + 1;
            if place == count { 0.0 } else { (PI * place as f64 / (2 * count) as f64).cos() }
        };
        let nodes: Vec<f64> = (0..count).map(node).collect();
        let zero = DoubleDouble::from(0.0);
        let mut matrix = vec![vec![zero; count]; count];
        for (j, &here) in nodes.iter().enumerate() {
            let mut product = vec![zero; count];
            product[0] = DoubleDouble::from(1.0);
            let mut denominator = DoubleDouble::from(1.0);
            let others = nodes.iter().enumerate().filter(|&(i, _)| i != j);
            for (_, &other) in others {
                for k in (0..count).rev() {
                    let below = if k > 0 { product[k - 1] } else { zero };
                    product[k] = below + product[k] * DoubleDouble::from(-other);
                }
                denominator = denominator * DoubleDouble::from_sum(here, -other)?;
            }
            let factor = reciprocal(denominator);
            for (row, entry) in matrix.iter_mut().zip(product) {
                row[j] = entry * factor;
            }
        }
        let in_bits = |x: f64| Multiplier {
            size: Fraction(((x.abs() * 127_f64.exp2()) as u128) << 1),
            negative: x < 0.0,
        };
        Some(Self { nodes: nodes.into_iter().map(in_bits).collect(), matrix })
    }

    /// The coefficients of powers of `u = x half/2^scale_bits`, from values in units at the nodes.
    pub(super) fn coefficients(
        &self,
        value: impl Fn(Multiplier) -> i128,
        half: i128,
        scale_bits: i32,
    ) -> Vec<f64> {
        let unit = (-f64::from(FRACTION_BITS)).exp2();
        let values: Vec<DoubleDouble> =
            self.nodes.iter().map(|&node| scaled(value(node), unit)).collect();
        let stretch = reciprocal(scaled(half, f64::from(-scale_bits).exp2()));
        let mut power = DoubleDouble::from(1.0);
        let mut coefficients = Vec::with_capacity(values.len());
        for row in &self.matrix {
            let products = row.iter().zip(&values).map(|(entry, value)| *entry * *value);
            let sum = products.fold(DoubleDouble::from(0.0), |sum, product| sum + product);
            coefficients.push((sum * power).high());
            power = power * stretch;
        }
        coefficients
    }
}

/// About `value · unit`, for a power of two.
fn scaled(value: i128, unit: f64) -> DoubleDouble {
    let high = value as f64;
    let low = value.saturating_sub(high as i128) as f64;
    DoubleDouble::from_sum(high * unit, low * unit).unwrap_or(DoubleDouble::from(f64::NAN))
}

/// About `1/value`: a step of Newton from the quotient of doubles.
fn reciprocal(value: DoubleDouble) -> DoubleDouble {
    let near = DoubleDouble::from(1.0 / value.high());
    let minus = DoubleDouble::from(-1.0);
    let rest = DoubleDouble::from(1.0) + minus * (value * near);
    near + near * rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials of the degree come out as they are.
    #[test]
    fn powers_are_found() {
        for degree in [0, 1, 2, 5, 12, 13] {
            let interpolation = Interpolation::new(degree).unwrap();
            for power in 0..=degree {
                let value = |node: Multiplier| {
                    (0..power).fold(1_i128 << FRACTION_BITS, |value, _| node.times(value))
                };
                // u = 3/4 x, so x^k = (4/3)^k u^k.
                let coefficients = interpolation.coefficients(value, 3 << 98, 100);
                for (k, coefficient) in coefficients.into_iter().enumerate() {
                    let exact = if k == power { (4.0_f64 / 3.0).powi(k as i32) } else { 0.0 };
                    let error = (coefficient - exact).abs();
                    assert!(error <= 1e-15 * exact + 1e-22, "{degree} {power} {k}: {error:e}");
                }
            }
        }
        assert!(Interpolation::new(32).is_none());
    }
}
