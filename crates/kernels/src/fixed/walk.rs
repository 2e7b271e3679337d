//! A march period by period: two periods are held at a time, however many there are.
//!
//! Code that needs only values asks for them on the way. A march of a thousand periods is then never
//! written out, and its two periods stay in the processor's cache.

use super::certificate::Certificate;
use super::error::FixedError;
use super::multiplier::{Fraction, MULTIPLIER_BITS, Multiplier};
use super::position::{POSITION_BITS, Position};
use super::scheme::Scheme;
use super::step::{Stepper, halves};
use super::value::FixedValue;

/// What is proven of a period.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Proof {
    /// Coefficients from here on are zero.
    pub(super) terms: usize,
    /// The bound, in units; not less than those of the periods before.
    pub(super) bound: u128,
}

/// The march on its way: each period follows from the one before.
pub(super) struct Walk {
    scheme: Scheme,
    stepper: Stepper,
    certificate: Certificate,
}

impl Walk {
    /// The march before its first period.
    pub(super) fn new(scheme: Scheme) -> Self {
        Self { scheme, stepper: Stepper::new(scheme), certificate: Certificate::new(scheme) }
    }

    /// Marches through periods up to a last one, each of which is shown to `visit` with its number and its
    /// proof.
    pub(super) fn through(
        mut self,
        last: u32,
        mut visit: impl FnMut(u32, Period<'_>),
    ) -> Result<(), FixedError> {
        let scheme = self.scheme;
        let (mut before, mut current) = (vec![0; scheme.size()], vec![0; scheme.size()]);
        for number in 0..=last {
            let terms = self.stepper.advance(&before, &mut current, number)?;
            let bound = self.certificate.extend(&before, &current, terms)?;
            let proof = Proof { terms, bound };
            visit(number, Period { scheme: &scheme, coefficients: &current, proof });
            std::mem::swap(&mut before, &mut current);
            current.fill(0);
        }
        Ok(())
    }
}

/// One period of a march with its proof.
///
/// # Invariants
/// - There are as many coefficients as the scheme has for a period, and the proof is of them.
#[derive(Clone, Copy)]
pub(super) struct Period<'a> {
    pub(super) scheme: &'a Scheme,
    pub(super) coefficients: &'a [i128],
    pub(super) proof: Proof,
}

impl Period<'_> {
    /// The value at a place, given as the position on this period, with a radius that holds
    /// everything: the bound of the march, the rounding of the sum and that of the position.
    ///
    /// The sum by Horner's rule is off by at most half a unit a product, because `|u| ≤ 1`. A
    /// position that is rounded is off by less than `2^−120` in x and stays in its piece, so u is
    /// off by less than `2S·2^−120`, and `|dp/du| ≤ (M − 1) Σ|c_m| ≤ 63·64`.
    pub(super) fn value(&self, position: &Position) -> FixedValue {
        let Period { scheme, coefficients, proof } = *self;
        let fraction = position.fraction;
        let shift = POSITION_BITS - scheme.pieces.trailing_zeros();
        let piece = (fraction >> shift).min(u128::from(scheme.pieces) - 1);
        // The distance from the centre of the piece, from −2^(shift−1) to 2^(shift−1).
        let distance = (fraction - (piece << shift)) as i128 - (1 << (shift - 1));
        let from = piece as usize * scheme.terms as usize;
        let coefficients = &coefficients[from..from + proof.terms];
        let midpoint = if distance.unsigned_abs() >> (shift - 1) == 1 {
            // At the ends of the piece u is 1 or −1.
            let (even, odd) = halves(coefficients);
            if distance < 0 { even - odd } else { even + odd }
        } else {
            let size = Fraction(distance.unsigned_abs() << (MULTIPLIER_BITS - shift + 1));
            let place = Multiplier { size, negative: distance < 0 };
            coefficients.iter().rev().fold(0, |sum, coefficient| place.times(sum) + coefficient)
        };
        let rounding = proof.terms as u128;
        // 63·64·2^112 · 2S·2^−120 units, rounded upwards.
        let slope = if position.exact { 0 } else { 32 * u128::from(scheme.pieces) };
        FixedValue { midpoint, radius: proof.bound + rounding + slope }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed::{DelayEquation, March, MarchOptions};
    use num_rational::BigRational;

    /// What is seen on the way is what a march holds in the end, with the same proof.
    #[test]
    fn periods_are_those_of_the_march() {
        let rational = |n: i64, d: i64| BigRational::new(n.into(), d.into());
        let (one, period) = (rational(1, 1), rational(3, 2));
        for reflection in [rational(1, 1), rational(-2, 3)] {
            let equation = DelayEquation::new(&period, &one, &one, &reflection).unwrap();
            let march = March::new(&equation, 12, &MarchOptions::default()).unwrap();
            let scheme = Scheme::new(&equation, 12, &MarchOptions::default()).unwrap();
            let mut seen = 0;
            let visit = |number, period: Period<'_>| {
                assert_eq!(number, seen);
                seen += 1;
                for fraction in [0, 1 << 119, (1 << 120) - 1, 1 << 120] {
                    let position = Position::exact(number, fraction).unwrap();
                    let value = period.value(&position);
                    assert_eq!(value, march.value(&position).unwrap());
                    // 63·64·2^112 units change by as much in 2S·2^−120 of a piece, S the number of pieces.
                    let rounded = period.value(&Position { exact: false, ..position });
                    let least = 63 * 64 * 2 * u128::from(period.scheme.pieces) / 256;
                    assert!(rounded.radius >= value.radius + least, "{rounded:?} {value:?}");
                }
                let first = &period.coefficients[..period.proof.terms];
                assert_eq!(Some(first), march.piece(number, 0));
                assert_eq!(Some(period.proof.bound), march.bound_in_units(number));
            };
            Walk::new(scheme).through(11, visit).unwrap();
            assert_eq!(seen, 12);
        }
    }
}
