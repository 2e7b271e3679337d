//! Ziv's loop: the precision is doubled until the digits asked for are proven.

use super::ball::Ball;
use super::decimal::{Decimal, proven_digits};

/// Bits of the first attempt beyond those of the digits.
const SPARE_BITS: u64 = 32;

/// A decimal that is proven, and what it took.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certified {
    /// The correctly rounded value.
    pub decimal: Decimal,
    /// The enclosure that proves it.
    pub ball: Ball,
    /// The precision in bits that sufficed.
    pub bits: u64,
    /// How many precisions were tried.
    pub attempts: u32,
}

/// Why there are no proven digits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CertifyError<E> {
    /// The enclosures up to the limit leave several decimals.
    AccuracyNotReached {
        /// The enclosure of least radius.
        best: Ball,
        /// The highest precision tried, in bits.
        bits: u64,
    },
    /// The enclosure could not be computed.
    Enclosure(E),
}

/// The value enclosed by `enclosure(bits)`, rounded correctly to `digits` significant decimal
/// digits, ties to even.
///
/// `enclosure` must return a ball around the same number whatever the precision; how its radius
/// depends on the precision is its own affair. The precision starts 32 bits above that of the
/// digits and is doubled until [`proven_digits`] succeeds; the last attempt is made at
/// `limit_bits`. A number that is a tie between two decimals, or zero, is never decided by balls
/// of positive radius: decide such cases exactly beforehand.
///
/// # Errors
/// - [`CertifyError::AccuracyNotReached`], with the best enclosure, when the limit does not do.
/// - [`CertifyError::Enclosure`] when an enclosure fails.
///
/// # Panics
/// Panics if `digits` is zero.
///
/// # Cost
/// When the cost of an enclosure grows at least linearly, at most twice that of the last attempt.
pub fn certify<E>(
    digits: usize,
    limit_bits: u64,
    mut enclosure: impl FnMut(u64) -> Result<Ball, E>,
) -> Result<Certified, CertifyError<E>> {
    // log_2 10 < 10/3.
    let mut bits = (10 * digits as u64).div_ceil(3) + SPARE_BITS;
    let mut best: Option<Ball> = None;
    let mut attempts = 0;
    loop {
        bits = bits.min(limit_bits);
        attempts += 1;
        let ball = enclosure(bits).map_err(CertifyError::Enclosure)?;
        if let Some(decimal) = proven_digits(&ball, digits) {
            return Ok(Certified { decimal, ball, bits, attempts });
        }
        let best_yet = match best.take() {
            Some(other) if other.radius() <= ball.radius() => other,
            _ => ball,
        };
        if bits == limit_bits {
            return Err(CertifyError::AccuracyNotReached { best: best_yet, bits });
        }
        best = Some(best_yet);
        bits = bits.saturating_mul(2);
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use num_rational::BigRational;

    use super::super::binary::Binary;
    use super::super::magnitude::Magnitude;
    use super::super::{BallError, exp_of_rational};
    use super::*;

    fn ratio(above: i64, below: i64) -> BigRational {
        BigRational::new(above.into(), below.into())
    }

    #[test]
    fn precision_is_doubled_until_the_digits_are_proven() {
        let mut tried = Vec::new();
        // 1/3 hidden below a term that cancels 200 bits.
        let offset = Ball::new(Binary::new(1.into(), 200), Magnitude::ZERO);
        let proven = certify(15, 1 << 12, |bits| {
            tried.push(bits);
            let third = Ball::from_rational(&ratio(1, 3), bits);
            Ok::<_, Infallible>(third.add(&offset, bits).subtract(&offset, bits))
        })
        .unwrap();
        assert_eq!(proven.decimal.to_string(), "0.333333333333333");
        assert_eq!(tried, [82, 164, 328]);
        assert_eq!((proven.bits, proven.attempts), (328, 3));
        assert!(proven.ball.contains(&ratio(1, 3)));
    }

    #[test]
    fn digits_that_cancel_are_made_up_for() {
        // e^(10^−20) − 1 loses twenty digits.
        let tiny = BigRational::new(1.into(), 10.into()).pow(20);
        let one = Ball::from_integer(&1.into());
        let proven =
            certify(10, 4096, |bits| Ok(exp_of_rational(&tiny, bits)?.subtract(&one, bits)));
        let proven: Result<_, CertifyError<BallError>> = proven;
        let proven = proven.unwrap();
        assert_eq!(proven.decimal.to_string(), "1.000000000e-20");
        assert_eq!(proven.bits, 132);
    }

    #[test]
    fn a_tie_is_never_guessed() {
        // 9.995 is no binary number, so its balls always reach both 9.99 and 10.0.
        let error = certify(3, 1000, |bits| {
            Ok::<_, Infallible>(Ball::from_rational(&ratio(9995, 1000), bits))
        });
        let Err(CertifyError::AccuracyNotReached { best, bits }) = error else {
            panic!("decided: {error:?}");
        };
        assert_eq!(bits, 1000);
        assert!(best.contains(&ratio(9995, 1000)));
        assert!(best.radius() < &Magnitude::power_of_two(-990));
    }

    #[test]
    fn the_best_enclosure_is_kept_and_errors_pass_through() {
        // The radius grows with the precision: the first attempt is the best.
        let mut attempts = 0;
        let error = certify(3, 200, |_| {
            attempts += 1;
            Ok::<_, Infallible>(Ball::new(Binary::zero(), Magnitude::from_u64(attempts)))
        })
        .unwrap_err();
        let best = Ball::new(Binary::zero(), Magnitude::from_u64(1));
        assert_eq!(error, CertifyError::AccuracyNotReached { best, bits: 200 });
        assert_eq!(attempts, 4);
        let error = certify(3, 200, |bits| exp_of_rational(&ratio(1 << 50, 1), bits)).unwrap_err();
        assert_eq!(error, CertifyError::Enclosure(BallError::ArgumentTooLarge));
    }

    #[test]
    fn a_low_limit_is_tried_once() {
        let proven = certify(20, 8, |bits| {
            assert_eq!(bits, 8);
            Ok::<_, Infallible>(Ball::from_integer(&5.into()))
        });
        assert_eq!(proven.unwrap().decimal.to_string(), "5.0000000000000000000");
    }
}
