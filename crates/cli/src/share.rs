//! Shares of a largest value, told so that what is claimed of them holds.

use num_rational::BigRational;
use wavestep::ball::{Bound, Decimal, in_decimals};

/// One over a share that is not told from nothing.
const NOTHING: u64 = 1_000_000_000_000_000;

/// Digits of a share.
const DIGITS: usize = 3;

/// A bound of a share in per cent; none where it is less than 1e-13 %.
pub fn percent(value: &BigRational, bound: Bound) -> Option<String> {
    if *value < BigRational::new(1.into(), NOTHING.into()) {
        return None;
    }
    let hundredth = BigRational::from_integer(100.into());
    Some(format!("{} %", Decimal::bound(&(value * hundredth), DIGITS, bound)))
}

/// A tolerance as it is: in per cent, or as a fraction.
pub fn whole(tolerance: &BigRational) -> String {
    let percent = tolerance * BigRational::from_integer(100.into());
    let decimals = in_decimals(&percent);
    if decimals.contains('/') { tolerance.to_string() } else { format!("{decimals} %") }
}
