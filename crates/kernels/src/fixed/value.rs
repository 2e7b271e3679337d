//! Values in fixed point with a radius, and the doubles that they certify.

use crate::exponent::scale;

/// Fraction bits of coefficients and values: their unit is `2^−112`.
pub const FRACTION_BITS: u32 = 112;

/// The digits of a double's significand.
const SIGNIFICAND: i64 = 53;
/// The spacing of the smallest doubles is `2^−1074`.
const LEAST_PLACE: i64 = -1074;
/// Doubles are below `2^1024`.
const LARGEST_PLACE: i64 = 1024;

/// A real number within `radius` of `midpoint`, both in units of `2^−112`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct FixedValue {
    /// The middle of the interval.
    pub midpoint: i128,
    /// Half the length of the interval.
    pub radius: u128,
}

/// The double to which every real number of the interval
/// `(value ± radius)·2^−fraction_bits` rounds, to nearest; none if there is no such double.
///
/// Undecided, hence none: an interval with a number halfway between two doubles, also as an end
/// point; one that contains zero, unless it is zero alone, which gives `+0.0`; one that reaches the
/// numbers that round to infinity. An interval of numbers so small that they round to zero gives a
/// zero with their sign.
///
/// Proof: the smaller end is rounded with ties downwards, the larger one with ties upwards, and
/// both give the same double d. Rounding is monotone under either rule, so every number between
/// rounds to at least d and at most d. A tie between would round to different doubles under the two
/// rules.
///
/// Some ten instructions on words of 128 bits.
pub fn round_to_double(value: i128, radius: u128, fraction_bits: i64) -> Option<f64> {
    let size = value.unsigned_abs();
    if size <= radius {
        return (size == 0 && radius == 0).then_some(0.0);
    }
    let smaller = nearest(size - radius, Ties::Downwards, fraction_bits)?;
    let larger = nearest(size.checked_add(radius)?, Ties::Upwards, fraction_bits)?;
    (smaller == larger).then_some(if value < 0 { -smaller } else { smaller })
}

/// The direction in which a number halfway between two doubles is rounded.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ties {
    Downwards,
    Upwards,
}

/// The double nearest to `size·2^−fraction_bits`, for a positive size; none if it is infinite.
///
/// With `2^s` units between neighbouring doubles there, the number is `⌊size/2^s⌋` steps, and one
/// more if the rest exceeds half a step. A result of `2^53` steps is a power of two, and a double.
#[inline]
fn nearest(size: u128, ties: Ties, fraction_bits: i64) -> Option<f64> {
    let length = i64::from(u128::BITS - size.leading_zeros());
    let shift = (length - SIGNIFICAND).max(LEAST_PLACE.saturating_add(fraction_bits)).max(0);
    let steps = match shift {
        0 => size,
        1..=127 => {
            let (half, rest) = (1 << (shift - 1), size & ((1 << shift) - 1));
            let up = if ties == Ties::Upwards { rest >= half } else { rest > half };
            (size >> shift) + u128::from(up)
        }
        128 if ties == Ties::Upwards => size >> 127,
        128 => u128::from(size > 1 << 127),
        // Half a step is 2^128 units at least.
        _ => 0,
    };
    let place = shift.saturating_sub(fraction_bits);
    let digits = i64::from(u128::BITS - steps.leading_zeros());
    if place.saturating_add(digits) > LARGEST_PLACE {
        return None;
    }
    Some(scale(steps as f64, place))
}
