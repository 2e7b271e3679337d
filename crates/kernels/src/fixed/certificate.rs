//! The proof of a march: residuals and mismatches of its polynomials, counted in units, upwards.
//!
//! The certificate reads nothing but the coefficients, so it holds however they came about. The
//! derivation is in the documentation of [`fixed`](super).

use super::error::FixedError;
use super::scheme::{Forcing, LARGEST_SUM, MOST_TERMS, Reflection, Scheme};
use super::value::FRACTION_BITS;

/// The most units of residual and mismatch with which a bound is proven: `2^−12`.
const LARGEST_FAULT: u128 = 1 << (FRACTION_BITS - 12);
/// Fraction bits of the largest value, as it is multiplied with.
const VALUE_BITS: u32 = 16;

/// What is proven of the periods read so far.
pub(super) struct Certificate {
    scheme: Scheme,
    /// Units of `∫|residual| + Σ|mismatch|`, rounded upwards.
    fault: u128,
    /// The largest sum of the sizes of a piece's coefficients, in units.
    largest: u128,
    /// The value of `p − ρ p₋` at the right end of the period read last, in units; one before the
    /// first.
    end: i128,
    /// How many periods have been read.
    periods: u32,
}

impl Certificate {
    /// The certificate of nothing: before the start the solution is zero, and `p − ρ p₋` must begin
    /// with one.
    pub(super) fn new(scheme: Scheme) -> Self {
        Self { scheme, fault: 0, largest: 0, end: 1 << FRACTION_BITS, periods: 0 }
    }

    /// Reads the next period and returns the bound, in units, that holds from the start to its end.
    ///
    /// `before` and `current` are the coefficients of a period and the next; those from `terms` on
    /// are zero in both.
    pub(super) fn extend(
        &mut self,
        before: &[i128],
        current: &[i128],
        terms: usize,
    ) -> Result<u128, FixedError> {
        let period = self.periods;
        let stride = self.scheme.terms as usize;
        for piece in current.chunks_exact(stride) {
            let sum = piece.iter().try_fold(0u128, |sum, own| sum.checked_add(own.unsigned_abs()));
            match sum {
                Some(sum) if sum <= LARGEST_SUM => self.largest = self.largest.max(sum),
                _ => return Err(FixedError::Overflow { period }),
            }
        }
        let (decay, reflection) = (self.scheme.decay, self.scheme.reflection);
        match self.scheme.forcing {
            // The same as below, without products of 128 bits that are not needed.
            Forcing::Multiple(2) if reflection == Reflection::One => {
                let slope = |free, before: i128| decay.times(free + (before << 1));
                self.read(before, current, terms, |before| before, slope);
            }
            Forcing::Multiple(multiple) => {
                let slope = |free, before| decay.times(free + multiple * before);
                self.read(before, current, terms, |before| reflection.times(before), slope);
            }
            Forcing::Separate(forcing) => {
                let slope = |free, before| decay.times(free) + forcing.times(before);
                self.read(before, current, terms, |before| reflection.times(before), slope);
            }
        }
        self.periods += 1;
        self.bound().ok_or(FixedError::NotProven { period })
    }

    /// Adds the faults of a period, whose coefficients are in range. `reflected` gives `ρ g_m`, off
    /// by at most the slack, and `slope` gives `hB w_m + hG g_m`, off by at most two units.
    #[inline(always)]
    fn read(
        &mut self,
        before: &[i128],
        current: &[i128],
        terms: usize,
        reflected: impl Fn(i128) -> i128,
        slope: impl Fn(i128, i128) -> i128,
    ) {
        let stride = self.scheme.terms as usize;
        let slack = self.scheme.reflection.slack();
        let mut residuals = [0u128; MOST_TERMS as usize];
        let mut mismatches = 0u128;
        for (own, before) in current.chunks_exact(stride).zip(before.chunks_exact(stride)) {
            let (own, before) = (&own[..terms], &before[..terms]);
            let free = |m: usize| own[m] - reflected(before[m]);
            let mut next = free(0);
            let mut sums = [0i128; 2];
            for m in 0..terms {
                let here = next;
                next = if m + 1 < terms { free(m + 1) } else { 0 };
                sums[m & 1] += here;
                // A factor that is seen to be short makes a shorter product.
                let slope_of_next = next.wrapping_mul(i128::from(m as u32 + 1));
                let residual = slope_of_next + slope(here, before[m]);
                residuals[m] = residuals[m].saturating_add(residual.unsigned_abs());
            }
            mismatches = mismatches.saturating_add((sums[0] - sums[1]).abs_diff(self.end));
            self.end = sums[0] + sums[1];
        }
        let pieces = u128::from(self.scheme.pieces);
        mismatches = mismatches.saturating_add(2 * slack * terms as u128 * pieces);
        self.fault = self.fault.saturating_add(mismatches);
        for (m, residual) in (1u128..).zip(&residuals[..terms]) {
            let error = pieces * (m * slack + slack + 2);
            let integral = residual.saturating_add(error).saturating_mul(2).div_ceil(m);
            self.fault = self.fault.saturating_add(integral);
        }
    }

    /// The bound `M̃F/(1 − F)` in units, rounded upwards, if `F ≤ 2^−12`: then
    /// `1/(1 − F) ≤ 1 + 2^−11`. The product is below `2^(23 + 100)`.
    fn bound(&self) -> Option<u128> {
        if self.fault > LARGEST_FAULT {
            return None;
        }
        let largest = self.largest.div_ceil(1 << (FRACTION_BITS - VALUE_BITS));
        let product = (largest * self.fault).div_ceil(1 << VALUE_BITS);
        Some(product + product.div_ceil(1 << 11))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed::equation::DelayEquation;
    use crate::fixed::scheme::MarchOptions;
    use num_rational::BigRational;

    const ONE: i128 = 1 << FRACTION_BITS;

    /// Four pieces of two terms, `B = 1`, `A = 1`.
    fn scheme(reflection: (i64, i64)) -> Scheme {
        let one = BigRational::new(1.into(), 1.into());
        let reflection = BigRational::new(reflection.0.into(), reflection.1.into());
        let equation = DelayEquation::new(&one, &one, &one, &reflection).unwrap();
        let options = MarchOptions { pieces: Some(4), terms: Some(2) };
        Scheme::new(&equation, 2, &options).unwrap()
    }

    /// The faults of polynomials whose residuals and jumps are found by hand.
    #[test]
    fn faults_are_counted_in_full() {
        // P = 1 begins rightly and has the residual B, so that F = 1. To each integral come two
        // units for every R_m: 4·2·2 and 4·2·2/2.
        let constant = [ONE, 0].repeat(4);
        let mut certificate = Certificate::new(scheme((1, 1)));
        let refused = certificate.extend(&[0; 8], &constant, 2).unwrap_err();
        assert_eq!(refused, FixedError::NotProven { period: 0 });
        assert_eq!(certificate.fault, (1 << FRACTION_BITS) + 24);
        assert_eq!(certificate.largest, 1 << FRACTION_BITS);

        // P = 2 on the next period: V = 1 is continuous, and V' + B V + 2 B P₋ = 3.
        let two = [2 * ONE, 0].repeat(4);
        certificate.extend(&constant, &two, 2).unwrap_err();
        assert_eq!(certificate.fault, (4 << FRACTION_BITS) + 48);

        // P = 1 + u on the first piece, 1 on the others: it begins with 0 and falls from 2 to 1. On
        // the piece, h = 1/8 and ∫|9/8| + |u/8| = 19/8; on the others there is 2/8.
        let ramp: Vec<i128> = [ONE, ONE].into_iter().chain([ONE, 0].repeat(3)).collect();
        let mut certificate = Certificate::new(scheme((1, 1)));
        certificate.extend(&[0; 8], &ramp, 2).unwrap_err();
        assert_eq!(certificate.fault, ((2 << FRACTION_BITS) + (25 << (FRACTION_BITS - 3))) + 24);
        assert_eq!(certificate.largest, 2 << FRACTION_BITS);

        // With a rounded reflection, 4(1 + 1 + 2)·2 and 4(2 + 1 + 2)·2/2 units are added to the
        // integrals, and 2·2 to each of four jumps.
        let mut certificate = Certificate::new(scheme((1, 2)));
        certificate.extend(&[0; 8], &constant, 2).unwrap_err();
        assert_eq!(certificate.fault, (1 << FRACTION_BITS) + 32 + 20 + 16);
    }

    /// `M̃F/(1 − F)`, upwards.
    #[test]
    fn bounds_are_rounded_upwards() {
        let mut certificate = Certificate::new(scheme((1, 1)));
        (certificate.largest, certificate.fault) = (3 << FRACTION_BITS, 1000);
        assert_eq!(certificate.bound(), Some(3002));
        (certificate.largest, certificate.fault) = ((3 << FRACTION_BITS) + 1, LARGEST_FAULT);
        let least = 3.0 * (LARGEST_FAULT as f64) / (1.0 - (-12f64).exp2());
        assert!(certificate.bound().unwrap() as f64 >= least);
        certificate.fault += 1;
        assert_eq!(certificate.bound(), None);
    }
}
