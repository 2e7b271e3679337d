//! Number literals, read exactly: `0.25` is one quarter, never the double nearest to it.

use crate::limits::{MAX_DECIMAL_EXPONENT, MAX_NUMBER_DIGITS};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Pow, ToPrimitive, Zero};
use wavestep_polynomial::fraction;

/// Why a literal is not accepted although its form is right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LiteralError {
    /// More than [`MAX_NUMBER_DIGITS`] digits.
    TooManyDigits,
    /// The last digit stands further than [`MAX_DECIMAL_EXPONENT`] from the decimal point.
    ExponentTooLarge,
}

/// The value of `digits [. digits] [e [sign] digits]`, with digits on at least one side of the point.
///
/// Trailing zeros of the fraction do not count towards the exponent, so `1.0e-1000` is accepted and
/// `1.5e-1000`, which has 1001 decimal places, is not.
///
/// Takes time linear in the length for literals within the limits, which are checked first.
pub(super) fn literal(text: &str) -> Result<BigRational, LiteralError> {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, decimals) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if whole.len() + decimals.len() > MAX_NUMBER_DIGITS {
        return Err(LiteralError::TooManyDigits);
    }
    let decimals = decimals.trim_end_matches('0');
    // The zero in front is the whole number of `.0`, whose digits are all trimmed away.
    let integer = digits(&format!("0{whole}{decimals}"));
    let exponent = signed_exponent(exponent).ok_or(LiteralError::ExponentTooLarge)?;
    let scale = exponent - decimals.len().to_i64().expect("at most MAX_NUMBER_DIGITS");
    if scale.abs() > MAX_DECIMAL_EXPONENT {
        return Err(LiteralError::ExponentTooLarge);
    }
    let power = u32::try_from(scale.unsigned_abs()).expect("at most MAX_DECIMAL_EXPONENT");
    let ten = BigInt::from(10).pow(power);
    Ok(match scale >= 0 {
        true => BigRational::from_integer(integer * ten),
        false => fraction(integer, ten),
    })
}

fn digits(text: &str) -> BigInt {
    BigInt::parse_bytes(text.as_bytes(), 10).expect("at least one digit, and nothing else")
}

/// None if the exponent is out of bounds, however many digits it has.
fn signed_exponent(text: &str) -> Option<i64> {
    let exponent = text.replace('−', "-").parse().ok();
    exponent.filter(|value| (-MAX_DECIMAL_EXPONENT..=MAX_DECIMAL_EXPONENT).contains(value))
}

/// The shortest literal of a value that one literal can say, such that reading it gives the value.
/// A value that is no terminating decimal is written as a quotient in parentheses.
pub(super) fn written(value: &BigRational) -> String {
    match decimal_places(value.denom()) {
        Some(0) => written_integer(value.numer()),
        Some(places) => {
            let scaled = value.numer() * BigInt::from(10).pow(places) / value.denom();
            written_fraction(&scaled.to_string(), places as usize)
        }
        None => format!("({}/{})", value.numer(), value.denom()),
    }
}

/// How many decimal places a fraction with this denominator needs, if finitely many.
fn decimal_places(denominator: &BigInt) -> Option<u32> {
    let twos = denominator.trailing_zeros().unwrap_or(0);
    let mut odd = denominator >> twos;
    let mut fives = 0;
    let five = BigInt::from(5);
    while odd > BigInt::from(1) {
        let (quotient, remainder) = odd.div_rem(&five);
        if !remainder.is_zero() {
            return None;
        }
        odd = quotient;
        fives += 1;
    }
    twos.max(fives).to_u32()
}

/// More digits than this are written with an exponent if that is shorter.
const PLAIN_DIGITS: usize = 20;

fn written_integer(value: &BigInt) -> String {
    let all = value.to_string();
    let significant = all.trim_end_matches('0');
    let zeros = all.len() - significant.len();
    if all.len() <= PLAIN_DIGITS || zeros <= PLAIN_DIGITS {
        return all;
    }
    let exponent = zeros.min(MAX_DECIMAL_EXPONENT as usize);
    format!("{}e{exponent}", &all[..all.len() - exponent])
}

fn written_fraction(digits: &str, places: usize) -> String {
    if places > PLAIN_DIGITS {
        return format!("{digits}e-{places}");
    }
    let padded = format!("{digits:0>width$}", width = places + 1);
    let (whole, fraction) = padded.split_at(padded.len() - places);
    format!("{whole}.{fraction}")
}
