//! Integers: greatest common divisors of unequal lengths, long products, reduced fractions.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// The greatest common divisor, not negative. One remainder makes the lengths equal before the
/// binary algorithm, whose cost is the square of the *longer* length; words have one of their own.
pub(crate) fn gcd(a: &BigInt, b: &BigInt) -> BigInt {
    let (short, long) = if a.bits() < b.bits() { (a, b) } else { (b, a) };
    if short.is_zero() {
        return long.abs();
    }
    match short.magnitude().to_u64() {
        Some(short) => {
            let rest = (long.magnitude() % short).to_u64().expect("less than a word");
            short.gcd(&rest).into()
        }
        None => short.gcd(&(long % short)),
    }
}

/// The least common multiple of positive integers.
pub(crate) fn lcm(a: &BigInt, b: &BigInt) -> BigInt {
    if a == b || b.is_one() { a.clone() } else { a / gcd(a, b) * b }
}

/// The fraction in lowest terms; `denominator` is positive. The same as `Rational::new`, which takes
/// some ten times as long where the numbers are words.
pub fn fraction(numerator: BigInt, denominator: BigInt) -> BigRational {
    let common = gcd(&numerator, &denominator);
    if common.is_one() {
        BigRational::new_raw(numerator, denominator)
    } else {
        BigRational::new_raw(numerator / &common, denominator / common)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_plain_algorithms() {
        let values = [0_i64, 1, -1, 6, -35, 1 << 40, 3 << 50, i64::MAX, i64::MIN];
        let powers = values.map(|value| BigInt::from(value).pow(7));
        for a in values.map(BigInt::from).iter().chain(&powers) {
            for b in values.map(BigInt::from).iter().chain(&powers) {
                assert_eq!(gcd(a, b), a.gcd(b));
                assert_eq!(gcd(b, a), a.gcd(b));
                if b.is_positive() {
                    assert_eq!(
                        fraction(a.clone(), b.clone()),
                        BigRational::new(a.clone(), b.clone())
                    );
                    assert_eq!(lcm(&(a.abs() + 1), b), (a.abs() + 1_u32).lcm(b));
                }
            }
        }
    }
}
