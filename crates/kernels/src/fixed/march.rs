//! The march: the solution as polynomials on pieces, with a proven bound of their error.

use super::equation::DelayEquation;
use super::error::FixedError;
use super::position::Position;
use super::scheme::{MarchOptions, Scheme};
use super::value::{FRACTION_BITS, FixedValue};
use super::walk::{Period, Proof, Walk};

/// The solution Y of a [`DelayEquation`] on its first periods: on every piece a polynomial in
/// `u ∈ [−1, 1]` whose coefficients are integers, in units of `2^−112`.
///
/// # Invariants
/// - On every piece of period n, `|p − Y| ≤ bound_of(n)`; at both ends, p is compared with the
///   limits of Y from inside the period.
/// - The sizes of the coefficients of a piece add up to at most 64.
#[derive(Clone, PartialEq, Debug)]
pub struct March {
    scheme: Scheme,
    /// Period by period, piece by piece; every piece has room for the most terms.
    coefficients: Vec<i128>,
    /// Terms and bound of every period.
    proofs: Vec<Proof>,
}

impl March {
    /// Marches through `periods` periods and proves the bound.
    ///
    /// About three products of 128 bits a coefficient: for the rigid mass with μ = 1, some 600
    /// coefficients a period.
    pub fn new(
        equation: &DelayEquation,
        periods: u32,
        options: &MarchOptions,
    ) -> Result<Self, FixedError> {
        let scheme = Scheme::new(equation, periods, options)?;
        let mut coefficients = Vec::with_capacity(scheme.size() * periods as usize);
        let mut proofs = Vec::with_capacity(periods as usize);
        Walk::new(scheme).through(periods - 1, |_, period| {
            coefficients.extend_from_slice(period.coefficients);
            proofs.push(period.proof);
        })?;
        Ok(Self { scheme, coefficients, proofs })
    }

    /// How many periods there are.
    pub fn periods(&self) -> u32 {
        self.proofs.len() as u32
    }

    /// How many pieces a period is cut into: S, a power of two.
    pub fn pieces_per_period(&self) -> u32 {
        self.scheme.pieces
    }

    /// The absolute bound of the error on all periods, rounded upwards.
    pub fn bound(&self) -> f64 {
        self.proofs.last().map_or(0.0, |proof| units_upwards(proof.bound))
    }

    /// The absolute bound of the error up to the end of a period, rounded upwards; none after the
    /// last period.
    pub fn bound_of(&self, period: u32) -> Option<f64> {
        self.proofs.get(period as usize).map(|proof| units_upwards(proof.bound))
    }

    /// The same in units of `2^−112`.
    pub(super) fn bound_in_units(&self, period: u32) -> Option<u128> {
        self.proofs.get(period as usize).map(|proof| proof.bound)
    }

    /// The coefficients `c_m` of piece q of period n in units of `2^−112`: there `p = Σ c_m u^m`,
    /// with the place `x = (2q + 1 + u)/(2S)` in parts of the period. None if there is no such
    /// piece.
    pub fn piece(&self, period: u32, piece: u32) -> Option<&[i128]> {
        let proof = self.proofs.get(period as usize)?;
        if piece >= self.scheme.pieces {
            return None;
        }
        let index = period as usize * self.scheme.pieces as usize + piece as usize;
        let from = index * self.scheme.terms as usize;
        self.coefficients.get(from..from + proof.terms)
    }

    /// The value at a position, with a radius that holds everything: the bound of the march, the
    /// rounding of the sum and that of the position.
    ///
    /// A product of 128 bits a term, some forty.
    pub fn value(&self, position: &Position) -> Result<FixedValue, FixedError> {
        let period = position.period;
        let beyond = FixedError::BeyondMarch { period, periods: self.periods() };
        let proof = *self.proofs.get(period as usize).ok_or(beyond)?;
        let size = self.scheme.size();
        let coefficients = &self.coefficients[size * period as usize..][..size];
        Ok(Period { scheme: &self.scheme, coefficients, proof }.value(position))
    }
}

/// A count of units of `2^−112`, as a double that is not less.
fn units_upwards(units: u128) -> f64 {
    let double = units as f64;
    let upwards = if double as u128 >= units { double } else { double.next_up() };
    upwards * (-f64::from(FRACTION_BITS)).exp2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed::certificate::Certificate;
    use num_rational::BigRational;

    fn march(periods: u32) -> March {
        let [one, two] =
            [1, 2].map(|value: u32| BigRational::from(num_bigint::BigInt::from(value)));
        let equation = DelayEquation::new(&two, &one, &one, &one).unwrap();
        March::new(&equation, periods, &MarchOptions::default()).unwrap()
    }

    /// The bounds, in units, proven from the coefficients alone.
    fn bounds(march: &March) -> Result<Vec<u128>, FixedError> {
        let size = march.scheme.size();
        let start = vec![0; size];
        let mut certificate = Certificate::new(march.scheme);
        let mut before = &start[..];
        let periods = march.coefficients.chunks_exact(size);
        periods
            .map(|current| {
                let bound = certificate.extend(before, current, march.scheme.terms as usize);
                before = current;
                bound
            })
            .collect()
    }

    /// Any perturbed coefficient, in any piece and power, makes a bound that covers it, from its
    /// period on.
    #[test]
    fn bounds_cover_perturbed_coefficients() {
        let honest = march(12);
        let size = honest.scheme.size();
        let proven = bounds(&honest).unwrap();
        for (place, perturbation) in (0..).zip([1i128 << 30, -(1 << 40), 1 << 60, -(1 << 80)]) {
            for power in 0..20 {
                for period in [0, 4, 11] {
                    let mut false_march = honest.clone();
                    let piece = (5 * place + 3 * power + 1) % honest.scheme.pieces as usize;
                    let index = period * size + piece * honest.scheme.terms as usize + power;
                    false_march.coefficients[index] += perturbation;
                    let bounds = bounds(&false_march).unwrap();
                    assert!(bounds[period] >= perturbation.unsigned_abs(), "{period} {power}");
                    assert!(bounds[period] < 1000 * perturbation.unsigned_abs());
                    let earlier = proven[..period].iter().zip(&bounds);
                    assert!(earlier.into_iter().all(|(proven, bound)| proven == bound));
                    assert!(bounds[period..].is_sorted());
                }
            }
        }
    }

    #[test]
    fn large_coefficients_are_refused() {
        for (perturbation, refused) in [
            (i128::MIN, FixedError::Overflow { period: 2 }),
            (i128::MAX, FixedError::Overflow { period: 2 }),
            (1 << 119, FixedError::Overflow { period: 2 }),
            (1 << 117, FixedError::NotProven { period: 2 }),
            (1 << 101, FixedError::NotProven { period: 2 }),
        ] {
            let mut false_march = march(3);
            let size = false_march.scheme.size();
            false_march.coefficients[2 * size + 3] = perturbation;
            assert_eq!(bounds(&false_march), Err(refused));
        }
    }

    #[test]
    fn doubles_of_bounds_are_not_less() {
        assert_eq!(units_upwards(1 << FRACTION_BITS), 1.0);
        assert_eq!(units_upwards((1 << FRACTION_BITS) + 1), 1f64.next_up());
        assert_eq!(units_upwards((1 << FRACTION_BITS) - 1), 1.0);
    }
}
