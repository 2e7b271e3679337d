//! Shares of a largest value, told so that what is claimed of them holds.

use num_rational::BigRational;
use wavestep::ball::{Bound, Decimal, in_decimals};

/// One over a share that is not told from nothing.
const NOTHING: u64 = 1_000_000_000_000_000;

/// Digits of a share.
const DIGITS: usize = 3;

/// The most digits of a share that is hardly above a tolerance.
const MOST_DIGITS: usize = 17;

/// A bound of a share in per cent; none where it is less than 1e-13 %.
pub fn percent(value: &BigRational, bound: Bound) -> Option<String> {
    (*value >= nothing()).then(|| bounded(value, bound))
}

/// What a share is at most, in per cent, told so that it meets its tolerance.
pub fn at_most(share: &BigRational, tolerance: &BigRational) -> String {
    match *share >= nothing() || *tolerance < nothing() {
        true => format!("at most {}", bounded(share, Bound::Upper)),
        false => "less than 1e-13 %".to_owned(),
    }
}

/// Below this share nothing is told but that.
fn nothing() -> BigRational {
    BigRational::new(1.into(), NOTHING.into())
}

fn bounded(value: &BigRational, bound: Bound) -> String {
    format!("{} %", Decimal::bound(&in_percent(value), DIGITS, bound))
}

/// A lower bound of a share above a tolerance, in per cent, with as many digits as show that it is above.
pub fn percent_above(value: &BigRational, tolerance: &BigRational) -> String {
    let [value, tolerance] = [value, tolerance].map(in_percent);
    let bounds = (DIGITS..MOST_DIGITS).map(|digits| Decimal::bound(&value, digits, Bound::Lower));
    let above = bounds.into_iter().find(|bound| bound.to_rational() > tolerance);
    let told = above.unwrap_or_else(|| Decimal::bound(&value, MOST_DIGITS, Bound::Lower));
    format!("{told} %")
}

fn in_percent(share: &BigRational) -> BigRational {
    share * BigRational::from_integer(100.into())
}

/// A tolerance as it is: in per cent, or as a fraction.
pub fn whole(tolerance: &BigRational) -> String {
    let decimals = in_decimals(&in_percent(tolerance));
    if decimals.contains('/') { tolerance.to_string() } else { format!("{decimals} %") }
}
