//! A part of a piece: `p(a + bu)` in fixed-point numbers.

use num_rational::BigRational;

use super::march::March;
use super::multiplier::Multiplier;

impl March {
    /// The piece q of the period n at `a + bu`, for numbers below 1 in size, in units of `2^−112`, and how
    /// far it can be from the solution: the bound of the march, and the rounding here. None if there is no
    /// such piece, or a number leaves the range.
    ///
    /// The error holds where `|a + bu| ≤ 1`; it is that of the shift, less than a unit for each pair of
    /// terms.
    ///
    /// A product of 128 bits for each pair of terms.
    pub fn part(
        &self,
        period: u32,
        piece: u32,
        a: &BigRational,
        b: &BigRational,
    ) -> Option<(Vec<i128>, u128)> {
        let coefficients = self.piece(period, piece)?.to_vec();
        let terms = coefficients.len();
        let coefficients = shifted(coefficients, Multiplier::near(a)?, Multiplier::near(b)?)?;
        Some((coefficients, self.bound_in_units(period)? + (terms * terms) as u128))
    }
}

/// The coefficients of `p(a + bu)`, off by less than a unit for each pair of terms where `|a + bu| ≤ 1`;
/// none if a number leaves the range.
///
/// With `x = a + bu`, stage s of the shift has turned the polynomial into
/// `Σ_{i<s} c_i (x−a)^i + (x−a)^s q_s(x)`. A product there is off by less than a unit, and what it is off
/// by is multiplied with `(x−a)^s x^j`, which is at most 1: there are `M(M−1)/2` of them. Scaling by
/// `b^m` takes m products, together as many. Where a is 0, nothing is shifted.
pub(super) fn shifted(
    mut coefficients: Vec<i128>,
    a: Multiplier,
    b: Multiplier,
) -> Option<Vec<i128>> {
    let terms = coefficients.len();
    let stages = if a.size.0 == 0 { 0 } else { terms };
    for stage in 0..stages {
        for m in (stage..terms - 1).rev() {
            coefficients[m] = coefficients[m].checked_add(a.times(coefficients[m + 1]))?;
            // Products are right up to this size.
            if coefficients[m].unsigned_abs() >> 126 != 0 {
                return None;
            }
        }
    }
    for (m, coefficient) in coefficients.iter_mut().enumerate() {
        for _ in 0..m {
            *coefficient = b.times(*coefficient);
        }
    }
    Some(coefficients)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixed::{DelayEquation, FRACTION_BITS, MarchOptions};
    use num_bigint::BigInt;
    use num_traits::Signed as _;

    /// The part and the piece have the same values, but for the stated rounding.
    #[test]
    fn parts_are_the_piece_elsewhere() {
        let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
        let equation =
            DelayEquation::new(&ratio(2, 1), &ratio(1, 1), &ratio(1, 1), &ratio(1, 1)).unwrap();
        let march = March::new(&equation, 12, &MarchOptions::default()).unwrap();
        let value = |coefficients: &[i128], u: &BigRational| {
            let terms = coefficients.iter().rev();
            terms.fold(ratio(0, 1), |sum, c| sum * u + BigRational::from(BigInt::from(*c)))
        };
        let mut compared = 0;
        for (period, piece) in [(0, 0), (3, 1), (11, 0), (11, march.pieces_per_period() - 1)] {
            let whole = march.piece(period, piece).unwrap();
            for (a, b) in [((-3, 4), (1, 4)), ((1, 3), (2, 3)), ((0, 1), (9, 10)), ((7, 8), (1, 9))]
            {
                let (a, b) = (ratio(a.0, a.1), ratio(b.0, b.1));
                let (part, radius) = march.part(period, piece, &a, &b).unwrap();
                let rounding = radius - march.bound_in_units(period).unwrap();
                for u in -4..=4 {
                    let u = ratio(u, 4);
                    let difference = value(&part, &u) - value(whole, &(&a + &b * &u));
                    let allowed = BigRational::from(BigInt::from(rounding));
                    assert!(difference.abs() <= allowed, "{period} {piece} {a} {b} {u}");
                    compared += 1;
                }
            }
        }
        assert_eq!((compared, FRACTION_BITS), (144, 112));
    }
}
