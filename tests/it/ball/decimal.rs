//! Decimals: the digits of a ball that are proven, and of a rational.

use super::samples;
use num_bigint::BigInt;
use num_integer::Integer as _;
use num_rational::BigRational;
use num_traits::{One as _, Signed as _};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use std::cell::Cell;
use wavestep::ball::decimal::{half_even, round_scaled, rounded_up, scale_far};
use wavestep::ball::{Ball, Binary, Bound, Decimal, Exactness, Magnitude, in_decimals};

fn ratio(above: i64, below: i64) -> BigRational {
    BigRational::new(above.into(), below.into())
}

fn text(value: &BigRational, significant: usize) -> String {
    Decimal::from_rational(value, significant).0.to_string()
}

/// The decimal of a single binary point.
fn of_point(mantissa: i64, exponent: i64, significant: usize) -> String {
    let point = Ball::new(Binary::new(mantissa.into(), exponent), Magnitude::ZERO);
    point.proven_digits(significant).unwrap().to_string()
}

/// `|value − decimal|` is at most half a unit of the last digit, and a tie is even.
fn assert_nearest(decimal: &Decimal, value: &BigRational) {
    let rounded = decimal.to_rational();
    let unit = BigRational::from_integer(10.into()).pow(decimal.place() as i32);
    let doubled = (&rounded - value).abs() * BigInt::from(2);
    assert!(doubled <= unit, "{decimal} for {value}");
    if doubled == unit {
        assert!((rounded / unit).to_integer().is_even(), "{decimal} for {value}");
    }
}

#[test]
fn rationals_round_to_even() {
    assert_eq!(text(&ratio(1, 3), 5), "0.33333");
    assert_eq!(text(&ratio(-2, 3), 5), "-0.66667");
    assert_eq!(text(&ratio(125, 1000), 2), "0.12");
    assert_eq!(text(&ratio(375, 1000), 2), "0.38");
    assert_eq!(text(&ratio(-5, 2), 1), "-2");
    assert_eq!(text(&ratio(9999, 1000), 3), "10.0");
    assert_eq!(text(&ratio(9995, 1000), 3), "10.0");
    assert_eq!(text(&ratio(9985, 1000), 3), "9.98");
    assert_eq!(text(&ratio(123_456, 1), 3), "1.23e5");
    assert_eq!(text(&ratio(1, 3_000_000), 3), "3.33e-7");
    assert_eq!(text(&ratio(1200, 1), 10), "1200");
    assert_eq!(text(&ratio(1, 4), 10), "0.25");
    assert_eq!(text(&ratio(0, 1), 10), "0");
    assert_eq!(text(&BigRational::from_integer(BigInt::from(10).pow(30)), 20), "1e30");
}

/// Decimals where few of them are all, else the fraction.
#[test]
fn fractions_without_an_end_stay_fractions() {
    let told =
        [(1, 4), (1, 3), (-7, 1), (22, 7)].map(|(above, below)| in_decimals(&ratio(above, below)));
    assert_eq!(told, ["0.25", "1/3", "-7", "22/7"]);
    // 2^-24 has 17 digits, 2^-25 one more.
    let [short, long] = [24, 25].map(|power| in_decimals(&ratio(1, 1 << power)));
    assert_eq!([short.as_str(), long.as_str()], ["5.9604644775390625e-8", "1/33554432"]);
}

#[test]
fn points_round_to_even() {
    assert_eq!(of_point(1, -3, 2), "0.12");
    assert_eq!(of_point(3, -3, 2), "0.38");
    assert_eq!(of_point(-1, -3, 2), "-0.12");
    assert_eq!(of_point(1, -3, 5), "0.12500");
    assert_eq!(of_point(-123, -1, 4), "-61.50");
    assert_eq!(of_point(639, -6, 2), "10");
    assert_eq!(of_point(639, -6, 3), "9.98");
    assert_eq!(of_point(0, 0, 3), "0.00");
    assert_eq!(of_point(1, 10, 2), "1.0e3");
    assert_eq!(of_point(1, -100, 3), "7.89e-31");
}

#[test]
fn digits_beyond_the_radius_are_undecided() {
    let ball = Ball::from_rational(&ratio(2, 3), 32);
    assert_eq!(ball.proven_digits(6).unwrap().to_string(), "0.666667");
    assert_eq!(ball.proven_digits(12), None);
}

#[test]
fn zero_and_ties_within_are_undecided() {
    let ball = |mantissa: i64, exponent: i64, radius: i64| {
        Ball::new(Binary::new(mantissa.into(), exponent), Magnitude::power_of_two(radius))
    };
    assert_eq!(ball(0, 0, -1000).proven_digits(1), None);
    assert_eq!(ball(1, 0, 0).proven_digits(1), None);
    // 0.125 is a tie of two digits, 9.995 lies between 9.99 and 10.0.
    assert_eq!(ball(1, -3, -1000).proven_digits(2), None);
    assert_eq!(ball(1, -3, -1000).proven_digits(3).unwrap().to_string(), "0.125");
    let near = Ball::from_rational(&ratio(9995, 1000), 200);
    assert_eq!(near.proven_digits(3), None);
    assert_eq!(near.proven_digits(4).unwrap().to_string(), "9.995");
    // Both ends of 10 ± 2^(−40) round to 10.0.
    assert_eq!(ball(10, 0, -40).proven_digits(3).unwrap().to_string(), "10.0");
    assert_eq!(ball(-10, 0, -40).proven_digits(3).unwrap().to_string(), "-10.0");
}

#[test]
fn every_point_rounds_to_the_proven_decimal() {
    let undecided = Cell::new(0);
    let cases = 2000;
    let mut runner = TestRunner::new(ProptestConfig::with_cases(cases));
    runner
        .run(&(samples::ball_and_point(), 1_usize..40), |((ball, point), significant)| {
            let (lower, upper) = ball.endpoints();
            let ends = [BigRational::from(&lower), BigRational::from(&upper)];
            match ball.proven_digits(significant) {
                Some(decimal) => {
                    assert_eq!(decimal.significant(), significant);
                    for value in [&ends[0], &ends[1], &point] {
                        assert_nearest(&decimal, value);
                    }
                }
                None => {
                    undecided.set(undecided.get() + 1);
                    let [low, high] = ends.map(|end| Decimal::from_rational(&end, significant).0);
                    assert!(ball.contains_zero() || low != high, "{low} {high}");
                }
            }
            Ok(())
        })
        .unwrap();
    println!("undecided: {} of {cases} balls", undecided.get());
    assert!(undecided.get() < cases * 9 / 10);
}

proptest! {
    #[test]
    fn rationals_round_to_nearest(value in samples::rational(30), significant in 1_usize..50) {
        let (decimal, exactness) = Decimal::from_rational(&value, significant);
        let same = decimal.to_rational() == value;
        prop_assert_eq!(same, exactness == Exactness::Exact);
        prop_assert!(decimal.significant() <= significant);
        if !same {
            prop_assert_eq!(decimal.significant(), significant);
            assert_nearest(&decimal, &value);
        }
    }

    #[test]
    fn rounded_powers_agree_with_exact_ones(
        mantissa in samples::integer(16), exponent in -400_i64..400, places in -100_i64..100,
    ) {
        let value = Binary::new(mantissa, exponent);
        let exact = round_scaled(&value, places, half_even);
        let (low, high) = scale_far(&value, places, half_even);
        prop_assert!(low <= exact && exact <= high && &high - &low <= BigInt::one());
    }

    #[test]
    fn rounded_powers_do_not_decide_ties(odd in 0_i64..1_000_000, places in 1_u32..9) {
        // An odd multiple of 10^k/2, divided by 10^k.
        let tie = BigInt::from(2 * odd + 1) * BigInt::from(10).pow(places) / 2;
        let (low, high) = scale_far(&Binary::new(tie, 0), -i64::from(places), half_even);
        prop_assert_eq!((low, high), (odd.into(), (odd + 1).into()));
    }

    #[test]
    fn bounds_print_rounded_up(bound in samples::magnitude()) {
        let printed = rounded_up(&bound).to_rational();
        let bound = BigRational::from(&bound);
        prop_assert!(printed >= bound && &printed * BigInt::from(10) <= bound * BigInt::from(11));
    }
}

#[test]
fn bounds_print_at_any_exponent() {
    assert_eq!(Magnitude::ZERO.to_string(), "0");
    assert_eq!(Magnitude::from_u64(1).to_string(), "1.0e0");
    assert_eq!(Magnitude::from_u64(99).to_string(), "9.9e1");
    assert_eq!(Magnitude::from_u64(991).to_string(), "1.0e3");
    assert_eq!(Magnitude::power_of_two(-100).to_string(), "7.9e-31");
    // log_10 2^(10^12) = 301029995663.981…
    assert_eq!(Magnitude::power_of_two(1_000_000_000_000).to_string(), "9.6e301029995663");
}

#[test]
fn bounds_lie_on_their_side() {
    let mut value = BigRational::new(1.into(), 7.into());
    for _ in 0..200 {
        value *= BigRational::new((-13).into(), 11.into());
        for digits in [1, 3, 9] {
            let told = |bound| Decimal::bound(&value, digits, bound).to_rational();
            let (low, high) = (told(Bound::Lower), told(Bound::Upper));
            assert!(low <= value && value <= high, "{value}: {low} {high}");
            let unit = BigRational::from_integer(10.into()).pow(1 - digits as i32);
            assert!(&high - &low <= value.abs() * unit * BigRational::from_integer(2.into()));
        }
    }
    let five = BigRational::from_integer(5.into());
    assert_eq!(Decimal::bound(&five, 3, Bound::Upper).to_rational(), five);
}
