//! One period of the march: from the polynomials of a period to those of the next.
//!
//! Nothing here is trusted: the certificate reads the polynomials themselves. Rounding is kept to
//! a few units nevertheless, because the bound counts it.

use super::error::FixedError;
use super::multiplier::{Fraction, Multiplier};
use super::scheme::{FEWEST_PIECES, Forcing, LARGEST_SUM, Scheme};
use super::value::FRACTION_BITS;

/// Pieces worked on at once: a product takes longer than the processor needs to begin the next.
const LANES: usize = FEWEST_PIECES as usize;
/// The most that `v(1)` can be while y stays in its range, with room for rounding.
const LARGEST_END: u128 = 2 * LARGEST_SUM + (1 << 16);
/// Terms that a period may have more than the one before.
const GROWTH: usize = 3;

/// The state of a march between two periods.
///
/// On a piece, `v = Σ c_m u^m` with `(m + 1) c_{m+1} = −(hB c_m + hG g_m)`, where `g_m` are the
/// coefficients of the period before. The solution with `c₀ = 0` does not depend on the other
/// pieces; to it comes `c₀ e^(−hBu)`, and the value at the left end gives `c₀`.
pub(super) struct Stepper {
    scheme: Scheme,
    /// `hB/(m + 1)`.
    decay: Vec<Fraction>,
    /// `hG/(m + 1)`; empty if the forcing is a multiple of the decay.
    forcing: Vec<Multiplier>,
    /// The sizes of the coefficients of `e^(−hBu)` from the first power on, as far as they count.
    exponential: Vec<Fraction>,
    /// `e^(−hB)`.
    fading: Fraction,
    /// The value of v at the right end of the period done last.
    end: i128,
    /// The count of terms of the period done last.
    terms: usize,
}

impl Stepper {
    /// The state before the first period.
    pub(super) fn new(scheme: Scheme) -> Self {
        let decay: Vec<_> = (1..scheme.terms).map(|m| scheme.decay.divided_by(m)).collect();
        // e^(−hB) in units of 2^−126, from the coefficients of e^(−hBu).
        let (mut power, mut fading) = (1i128 << 126, 1i128 << 126);
        let mut exponential = Vec::new();
        for part in &decay {
            power = part.times(power);
            if power < 1 << 8 {
                break;
            }
            exponential.push(Fraction(power.unsigned_abs() << 2));
            fading += if exponential.len() % 2 == 1 { -power } else { power };
        }
        Self {
            scheme,
            decay,
            forcing: match scheme.forcing {
                Forcing::Multiple(_) => Vec::new(),
                Forcing::Separate(whole) => {
                    (1..scheme.terms).map(|m| whole.divided_by(m)).collect()
                }
            },
            exponential,
            fading: Fraction(fading.unsigned_abs() << 2),
            end: 1 << FRACTION_BITS,
            terms: scheme.terms as usize,
        }
    }

    /// Writes the coefficients of the next period, which are zeros before, and returns the most
    /// terms that a piece has.
    ///
    /// `before` are the coefficients of the period before, at most [`LARGEST_SUM`] in sum for each
    /// piece. Then no sum here leaves its range: with `hB ≤ 1/2` and `|hG| ≤ 1/2` the coefficients
    /// with `c₀ = 0` add up to at most `2(LARGEST_SUM + 64)`, hence `|c₀| ≤ 2^121`, and nothing
    /// exceeds `2^123`.
    pub(super) fn advance(
        &mut self,
        before: &[i128],
        current: &mut [i128],
        period: u32,
    ) -> Result<usize, FixedError> {
        let stride = self.scheme.terms as usize;
        let terms = if period == 0 { stride } else { stride.min(self.terms + GROWTH) };
        let blocks = current.chunks_exact_mut(LANES * stride);
        for (own, before) in blocks.zip(before.chunks_exact(LANES * stride)) {
            let (decay, forcing) = (&self.decay[..terms - 1], &self.forcing[..]);
            match self.scheme.forcing {
                // Doubling is faster than a product of 128 bits.
                Forcing::Multiple(2) => fill(own, before, stride, terms, |m, own, before| {
                    decay[m].times(-own - (before << 1))
                }),
                Forcing::Multiple(multiple) => {
                    fill(own, before, stride, terms, |m, own, before| {
                        decay[m].times(-own - multiple * before)
                    })
                }
                Forcing::Separate(_) => fill(own, before, stride, terms, |m, own, before| {
                    -decay[m].times(own) - forcing[m].times(before)
                }),
            }
        }
        let reflection = self.scheme.reflection;
        for (own, before) in current.chunks_exact_mut(stride).zip(before.chunks_exact(stride)) {
            let (even, odd) = halves(&own[..terms]);
            let centre = self.fading.times(self.end - (even - odd));
            self.end = self.fading.times(centre) + even + odd;
            if self.end.unsigned_abs() > LARGEST_END {
                return Err(FixedError::Overflow { period });
            }
            own[0] = centre;
            let mut signed = -centre;
            for (own, power) in own[1..terms].iter_mut().zip(&self.exponential) {
                *own += power.times(signed);
                signed = -signed;
            }
            for (own, before) in own[..terms].iter_mut().zip(before) {
                *own += reflection.times(*before);
            }
        }
        let length = |piece: &[i128]| piece.iter().rposition(|&own| own != 0).map_or(1, |m| m + 1);
        let longest = current.chunks_exact(stride).map(|piece| length(&piece[..terms])).max();
        self.terms = longest.unwrap_or(1).max(if period == 0 { 1 } else { self.terms });
        Ok(self.terms)
    }
}

/// Fills the coefficients of some pieces at once from `c₀ = 0`.
#[inline(always)]
fn fill(
    own: &mut [i128],
    before: &[i128],
    stride: usize,
    terms: usize,
    next: impl Fn(usize, i128, i128) -> i128,
) {
    let mut coefficients = [0; LANES];
    for m in 0..terms - 1 {
        for (lane, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient = next(m, *coefficient, before[lane * stride + m]);
            own[lane * stride + m + 1] = *coefficient;
        }
    }
}

/// The sums of the coefficients of even and of odd powers.
#[inline]
pub(super) fn halves(coefficients: &[i128]) -> (i128, i128) {
    let mut sums = [0, 0];
    for (m, coefficient) in coefficients.iter().enumerate() {
        sums[m & 1] += coefficient;
    }
    (sums[0], sums[1])
}
