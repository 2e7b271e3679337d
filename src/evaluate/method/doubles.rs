//! Exact constants as doubles with what is left of them.

use crate::ball::Ball;
use crate::enclosure::{EnclosureError, Numbers};
use crate::expression::Fraction;

/// Bits of the balls that are rounded.
const BITS: u64 = 256;

/// A number as three doubles, the largest first: some 159 bits.
pub(super) fn three(numbers: &Numbers, value: &Fraction) -> Result<[f64; 3], EnclosureError> {
    Ok(three_of(numbers.enclose(value, BITS)?))
}

/// The same of an enclosure.
pub(super) fn three_of(ball: Ball) -> [f64; 3] {
    let (first, rest) = ball.split();
    let (second, rest) = rest.split();
    [first, second, rest.midpoint().to_double()]
}

/// A number as the nearest double, and a bound on the distance.
pub(super) fn near(numbers: &Numbers, value: &Fraction) -> Result<(f64, f64), EnclosureError> {
    let (double, distance) = numbers.enclose(value, BITS)?.to_double();
    Ok((double, distance.to_double()))
}
