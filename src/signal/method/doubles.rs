//! Exact constants and polynomials in doubles, with what is left of them, and doubles as the numbers
//! that they are.

use super::MethodError;
use crate::ball::{Ball, at_or_after, at_or_before, rational};
use crate::enclosure::{EnclosureError, Numbers};
use crate::expression::Fraction;
use crate::signal::cells::Pieces;
use wavestep_kernels::Table;
use wavestep_polynomial::Rational;

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

/// Refuses times that are not all in a window, its ends included.
pub(super) fn inside(at: &[f64], [from, to]: [&Rational; 2]) -> Result<(), MethodError> {
    let window = at_or_after(from)..=at_or_before(to);
    if at.iter().all(|time| window.contains(time)) { Ok(()) } else { Err(MethodError::Outside) }
}

/// Doubles as the numbers that they are.
pub(super) fn exactly(at: &[f64]) -> Vec<Rational> {
    at.iter().map(|time| rational(*time)).collect()
}

/// Polynomials as a table; refused where there are none.
pub(super) fn table(pieces: &Pieces) -> Result<Table, MethodError> {
    match pieces.all.is_empty() {
        true => Err(MethodError::Outside),
        false => Ok(Table::new(&pieces.all, pieces.end)?),
    }
}
