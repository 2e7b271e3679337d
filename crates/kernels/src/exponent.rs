//! Powers of two apart from the numbers that they belong to: where products leave the range of doubles,
//! the exponent is carried beside them.

/// The double `2^exponent`, for `−1022 ≤ exponent ≤ 1023`.
fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// `value = mantissa · 2^exponent` with `1 ≤ |mantissa| < 2`; zero and what is not finite keep the
/// exponent 0, and subnormal numbers are lifted first.
pub(crate) fn split(value: f64) -> (f64, i64) {
    if value == 0.0 || !value.is_finite() {
        return (value, 0);
    }
    let (value, lift) = match value.is_subnormal() {
        true => (value * power_of_two(100), -100),
        false => (value, 0),
    };
    let exponent = ((value.to_bits() >> 52) & 0x7ff) as i64 - 1023;
    // Both factors are powers of two in range: |exponent| ≤ 1023 is halved.
    let half = exponent / 2;
    (value * power_of_two(-half) * power_of_two(half - exponent), exponent + lift)
}

/// `2^exponent · value`, rounded at most once: to infinity, to zero or to a subnormal number where
/// the range of doubles ends.
pub(crate) fn scale(value: f64, exponent: i64) -> f64 {
    let (mantissa, own) = split(value);
    match own.saturating_add(exponent) {
        _ if mantissa == 0.0 || !mantissa.is_finite() => mantissa,
        total if total > 1023 => mantissa * f64::INFINITY,
        total if total >= -1022 => mantissa * power_of_two(total),
        total if total < -1080 => mantissa * 0.0,
        // The first product is exact, the second rounds.
        total => mantissa * power_of_two(total + 60) * power_of_two(-60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_apart_and_together() {
        for value in [1.0, -3.75, 1e300, -1e-300, 5e-324, f64::MIN_POSITIVE, f64::MAX] {
            let (mantissa, exponent) = split(value);
            assert!((1.0..2.0).contains(&mantissa.abs()), "{value}");
            assert_eq!(scale(mantissa, exponent), value);
        }
        for value in [0.0, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!((split(value), scale(value, -2000)), ((value, 0), value));
        }
        assert!(scale(f64::NAN, 3).is_nan());
    }

    #[test]
    fn the_end_of_the_range_is_rounded_once() {
        // Half-way between two subnormal numbers, and just above.
        assert_eq!(scale(1.0, -1075), 0.0);
        assert_eq!(scale(1.0_f64.next_up(), -1075), 5e-324);
        assert_eq!((scale(1.0, 1024), scale(-1.0, 5000)), (f64::INFINITY, f64::NEG_INFINITY));
        assert_eq!(scale(-1.0, -5000), 0.0);
    }
}
