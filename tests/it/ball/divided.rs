//! Enclosures of polynomials in divided powers.

use super::samples;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One as _, Signed as _, Zero as _};
use proptest::prelude::*;
use wavestep::ball::divided::Argument;
use wavestep::ball::{Ball, Binary, evaluate_divided};

/// The exact value and the largest term.
fn exact(coefficients: &[BigInt], x: &BigRational) -> (BigRational, BigRational) {
    let mut power = BigRational::one();
    let (mut sum, mut largest) = (BigRational::zero(), BigRational::zero());
    for (index, coefficient) in coefficients.iter().enumerate() {
        let term = &power * coefficient;
        sum += &term;
        largest = largest.max(term.abs());
        power = power * x / BigInt::from(index + 1);
    }
    (sum, largest)
}

fn assert_encloses(coefficients: &[BigInt], x: &BigRational, precision: u64) {
    let ball = evaluate_divided(&coefficients.iter().collect(), x, precision);
    let (value, largest) = exact(coefficients, x);
    assert!(ball.contains(&value), "{coefficients:?} at {x} with {precision}: {ball}, {value}");
    let bound = largest * BigRational::new(4.into(), BigInt::one() << precision);
    assert!(BigRational::from(ball.radius()) <= bound, "{coefficients:?} at {x}: {ball}");
}

fn arguments() -> BoxedStrategy<BigRational> {
    prop_oneof![
        3 => samples::rational(1),
        2 => samples::rational(4),
        1 => samples::rational(8),
        3 => samples::rational(20),
    ]
    .boxed()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]
    #[test]
    fn encloses_the_exact_value(
        coefficients in prop::collection::vec(samples::integer(20), 0..30),
        x in arguments(),
        precision in 2_u64..200,
    ) {
        assert_encloses(&coefficients, &x, precision);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn each_step_keeps_its_bound(
        start in samples::integer(40), x in arguments(), index in 1_u64..600, rise in -80_i64..80,
        bits in 2_u64..300,
    ) {
        let argument = Argument::new(&x, 600, bits);
        let mut result = start.clone();
        let lost = argument.step(&mut result, index, rise);
        let power = BigRational::from(&Binary::new(BigInt::one(), rise));
        let value = BigRational::from(start) * x * power / BigInt::from(index);
        let distance = (value - BigRational::from(result)).abs();
        prop_assert!(distance <= BigRational::from(&lost));
    }
}

#[test]
fn encloses_exponential_series() {
    // The signs alternate and the terms reach e^40: 58 bits cancel twice.
    let x = BigRational::from_integer(40.into());
    let coefficients: Vec<BigInt> = (0..300).map(|j| BigInt::from(1 - 2 * (j % 2))).collect();
    for precision in [64, 128, 256] {
        assert_encloses(&coefficients, &x, precision);
    }
    let ball = evaluate_divided(&coefficients.iter().collect(), &x, 256);
    assert!(ball.to_string().starts_with("4.24835425529158899532923478285865801787956"), "{ball}");
}

/// `1 − 4x + 8x²/2!` is `1/4` at one quarter, and 0 at one half, where its terms cancel.
#[test]
fn encloses_a_sum_that_cancels() {
    let coefficients = [1, -4, 8].map(BigInt::from);
    for (x, value) in [((1, 4), (1, 4)), ((1, 2), (0, 1))] {
        let [x, value] = [x, value].map(|(p, q)| BigRational::new(p.into(), q.into()));
        assert!(evaluate_divided(&coefficients.iter().collect(), &x, 64).contains(&value));
    }
}

#[test]
fn extreme_arguments() {
    let coefficients: Vec<BigInt> = (0..40).map(|j| BigInt::from(j * j - 7)).collect();
    let huge = BigRational::from_integer(BigInt::one() << 100_u32);
    for x in [huge.clone(), huge.recip(), -huge.recip(), BigRational::zero()] {
        assert_encloses(&coefficients, &x, 100);
    }
    assert_encloses(&[], &huge, 100);
    assert_encloses(&[BigInt::zero(), BigInt::zero()], &huge, 100);
    assert_encloses(&[BigInt::zero(), BigInt::one()], &BigRational::zero(), 100);
    let constant = evaluate_divided(&[BigInt::from(5)].iter().collect(), &huge, 64);
    assert_eq!(constant, Ball::from_integer(&5.into()));
}
