//! The proof of a march: residuals and mismatches of its polynomials, counted in units, upwards.
//!
//! The certificate reads nothing but the coefficients, so it holds however they came about. The
//! derivation is in the documentation of [`fixed`](super).

use super::error::FixedError;
use super::march::FRACTION_BITS;
use super::multiplier::Multiplier;
use super::scheme::{Forcing, MOST_TERMS, Scheme};

/// The most that the sizes of the coefficients of a piece may add up to, in units: 64.
///
/// `(m + 1) |w_{m+1}| ≤ 64 · 2 · 2^118 = 2^125` then fits, and two products with it.
pub(super) const LARGEST_SUM: u128 = 1 << (FRACTION_BITS + 6);
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
    ///
    /// # Errors
    /// [`FixedError::Overflow`] if the sizes of a piece's coefficients add up to more than
    /// [`LARGEST_SUM`], [`FixedError::NotProven`] if the faults add up to more than `2^−12`.
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
        let decay = self.scheme.decay;
        match self.scheme.forcing {
            Forcing::Multiple(multiple) => self
                .read(before, current, terms, |free, before| decay.times(free + multiple * before)),
            Forcing::Separate(forcing) => self.read(before, current, terms, |free, before| {
                Multiplier::times(decay, free) + forcing.times(before)
            }),
        }
        self.periods += 1;
        self.bound().ok_or(FixedError::NotProven { period })
    }

    /// Adds the faults of a period, whose coefficients are in range. `slope` gives
    /// `hB w_m + hG g_m`, off by at most two units.
    #[inline(always)]
    fn read(
        &mut self,
        before: &[i128],
        current: &[i128],
        terms: usize,
        slope: impl Fn(i128, i128) -> i128,
    ) {
        let (stride, reflection) = (self.scheme.terms as usize, self.scheme.reflection);
        let slack = reflection.slack();
        let mut residuals = [0u128; MOST_TERMS as usize];
        let mut mismatches = 0u128;
        for (own, before) in current.chunks_exact(stride).zip(before.chunks_exact(stride)) {
            let (own, before) = (&own[..terms], &before[..terms]);
            let free = |m: usize| own[m] - reflection.times(before[m]);
            let mut next = free(0);
            let mut sums = [0i128; 2];
            for m in 0..terms {
                let here = next;
                next = if m + 1 < terms { free(m + 1) } else { 0 };
                sums[m & 1] += here;
                let residual = (m as i128 + 1) * next + slope(here, before[m]);
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
