//! Enclosures as they are printed.

use super::samples;
use num_traits::Signed as _;
use proptest::prelude::*;
use wavestep::ball::{Ball, Binary, Magnitude};

fn point(mantissa: i64, exponent: i64) -> Ball {
    Ball::new(Binary::new(mantissa.into(), exponent), Magnitude::ZERO)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]
    #[test]
    fn printed_numbers_enclose_every_point(
        (ball, value) in samples::ball_and_point(), most in 1_usize..60,
    ) {
        let printed = ball.to_decimal(most);
        let distance = (printed.midpoint().to_rational() - value).abs();
        prop_assert!(distance <= printed.radius().to_rational(), "{printed} for {ball:?}");
        prop_assert!(printed.midpoint().significant() <= most);
    }

    #[test]
    fn every_proven_digit_is_printed(
        (ball, _) in samples::ball_and_point(), significant in 1_usize..30,
    ) {
        if let Some(decimal) = ball.proven_digits(significant) {
            let printed = ball.to_decimal(200);
            let exact = printed.radius().is_zero();
            prop_assert!(exact || printed.midpoint().significant() >= significant, "{printed} {decimal}");
        }
    }
}

#[test]
fn exact_midpoints_print_alone() {
    assert_eq!(point(0, 0).to_decimal(10).to_string(), "0");
    assert_eq!(point(-3, -2).to_decimal(10).to_string(), "-0.75");
    assert_eq!(point(1, 10).to_decimal(10).to_string(), "1024");
    assert_eq!(point(1, 10).to_decimal(4).to_string(), "1024");
    assert_eq!(point(1, 10).to_decimal(3).to_string(), "1.02e3 ± 1.0e1");
    // However many digits are allowed, none is worked out that is not there.
    assert_eq!(point(1, -1).to_decimal(1 << 40).to_string(), "0.5");
}

#[test]
fn distant_exponents_print() {
    let far = 1 << 40;
    let wide = Ball::new(Binary::new(1.into(), -far), Magnitude::from_u64(1));
    assert_eq!(wide.to_decimal(10).to_string(), "0 ± 1.1e0");
    // 5·2^(−2^40) = 6.2056…·10^(−330985980542), and a fifth of it.
    let tiny = Ball::new(Binary::new(5.into(), -far), Magnitude::power_of_two(-far));
    assert_eq!(tiny.to_decimal(10).to_string(), "6.21e-330985980542 ± 1.3e-330985980542");
}

#[test]
fn midpoints_that_say_nothing_are_zero() {
    let unit = |mantissa, exponent| {
        Ball::new(Binary::new(i64::into(mantissa), exponent), Magnitude::from_u64(1))
    };
    assert_eq!(unit(-1, -2).to_decimal(10).to_string(), "0 ± 1.3e0");
    assert_eq!(unit(257, -10).to_decimal(10).to_string(), "0.25 ± 1.1e0");
}
