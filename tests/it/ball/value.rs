//! Values: precision is raised until the digits are proven.

use std::convert::Infallible;
use wavestep::ball::{Ball, BallError, Binary, Magnitude, Number, Value, exp_of_rational};
use wavestep_polynomial::Rational;

fn ratio(above: i64, below: i64) -> Rational {
    Rational::new(above.into(), below.into())
}

#[test]
fn precision_is_doubled_until_the_digits_are_proven() {
    let mut tried = Vec::new();
    // 1/3 hidden below a term that cancels 200 bits.
    let offset = Ball::new(Binary::new(1.into(), 200), Magnitude::ZERO);
    let proven = Value::certify(15, 1 << 12, |bits| {
        tried.push(bits);
        let third = Ball::from_rational(&ratio(1, 3), bits);
        Ok::<_, Infallible>(third.add(&offset, bits).subtract(&offset, bits))
    });
    let Ok(Value::Certified { decimal, ball }) = proven else { panic!("{proven:?}") };
    assert_eq!(decimal.to_string(), "0.333333333333333");
    assert_eq!(tried, [82, 164, 328]);
    assert!(ball.contains(&ratio(1, 3)));
}

#[test]
fn digits_that_cancel_are_made_up_for() {
    // e^(10^−20) − 1 loses twenty digits.
    let tiny = ratio(1, 10).pow(20);
    let one = Ball::from_integer(&1.into());
    let mut last = 0;
    let proven: Result<_, BallError> = Value::certify(10, 4096, |bits| {
        last = bits;
        Ok(exp_of_rational(&tiny, bits)?.subtract(&one, bits))
    });
    assert_eq!(proven.unwrap().to_text(10), "1.000000000e-20");
    assert_eq!(last, 132);
}

#[test]
fn a_tie_is_never_guessed() {
    // 9.995 is no binary number, so its balls always reach both 9.99 and 10.0.
    let value = Value::certify(3, 1000, |bits| {
        Ok::<_, Infallible>(Ball::from_rational(&ratio(9995, 1000), bits))
    });
    let Ok(Value::Enclosed(best)) = value else { panic!("decided: {value:?}") };
    assert!(best.contains(&ratio(9995, 1000)));
    assert!(best.radius() < &Magnitude::power_of_two(-990));
}

#[test]
fn the_best_enclosure_is_kept_and_errors_pass_through() {
    // The radius grows with the precision: the first attempt is the best.
    let mut attempts = 0;
    let value = Value::certify(3, 200, |_| {
        attempts += 1;
        Ok::<_, Infallible>(Ball::new(Binary::zero(), Magnitude::from_u64(attempts)))
    });
    let first = Ball::new(Binary::zero(), Magnitude::from_u64(1));
    assert_eq!(value, Ok(Value::Enclosed(first)));
    assert_eq!(attempts, 4);
    let error = Value::certify(3, 200, |bits| exp_of_rational(&ratio(1 << 50, 1), bits));
    assert_eq!(error, Err(BallError::ArgumentTooLarge));
}

#[test]
fn a_low_limit_is_tried_once() {
    let proven = Value::certify(20, 8, |bits| {
        assert_eq!(bits, 8);
        Ok::<_, Infallible>(Ball::from_integer(&5.into()))
    });
    let proven = proven.unwrap();
    assert_eq!(proven.to_text(20), "5.0000000000000000000");
    assert_eq!(proven.exact_if_known(), Value::Exact(ratio(5, 1)));
}

#[test]
fn values_are_written_as_far_as_they_are_known() {
    assert_eq!(Value::Exact(ratio(1, 2)).to_text(9), "0.5 = 1/2");
    assert_eq!(Value::Exact(ratio(1, 3)).to_f64(), 1.0 / 3.0);
    let third = Number::Enclosed(Ball::from_rational(&ratio(1, 3), 20));
    assert_eq!(Value::of(&third, 9).to_text(9), "0.333333492 ± 4.8e-7");
    assert_eq!(Value::of(&third, 4).to_text(4), "0.3333");
    let half = Number::Enclosed(Ball::from_rational(&ratio(1, 2), 20));
    assert_eq!(Value::of(&half, 4), Value::Exact(ratio(1, 2)));
}
