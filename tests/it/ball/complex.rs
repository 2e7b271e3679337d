//! Complex balls hold the exact results.

use super::samples;
use num_rational::BigRational;
use num_traits::Zero as _;
use proptest::prelude::*;
use wavestep::ball::{Ball, ComplexBall};

/// A complex ball and one of its points.
fn ball_and_point() -> BoxedStrategy<(ComplexBall, (BigRational, BigRational))> {
    (samples::ball_and_point(), samples::ball_and_point())
        .prop_map(|((re, x), (im, y))| (ComplexBall::new(re, im), (x, y)))
        .boxed()
}

fn contains(ball: &ComplexBall, (x, y): &(BigRational, BigRational)) -> bool {
    ball.real().contains(x) && ball.imaginary().contains(y)
}

proptest! {
    #[test]
    fn operations_include_the_exact_result(
        (a, (ax, ay)) in ball_and_point(), (b, (bx, by)) in ball_and_point(),
        factor in samples::rational(20), precision in 2_u64..200,
    ) {
        prop_assert!(contains(&a.add(&b, precision), &(&ax + &bx, &ay + &by)));
        let product = (&ax * &bx - &ay * &by, &ax * &by + &ay * &bx);
        prop_assert!(contains(&a.multiply(&b, precision), &product));
        let scaled = (&ax * &factor, &ay * &factor);
        prop_assert!(contains(&a.multiply_rational(&factor, precision), &scaled));
        let norm = &ax * &ax + &ay * &ay;
        if let Ok(inverse) = a.reciprocal(precision) {
            prop_assert!(contains(&inverse, &(&ax / &norm, -&ay / &norm)));
        }
    }

    #[test]
    fn sums_of_products_include_the_exact_sum(
        pairs in prop::collection::vec((ball_and_point(), ball_and_point()), 0..8),
        precision in 2_u64..200,
    ) {
        let sum =
            ComplexBall::sum_of_products(pairs.iter().map(|((a, _), (b, _))| (a, b)), precision);
        let (mut re, mut im) = (BigRational::zero(), BigRational::zero());
        for ((_, (ax, ay)), (_, (bx, by))) in &pairs {
            re += ax * bx - ay * by;
            im += ax * by + ay * bx;
        }
        prop_assert!(contains(&sum, &(re, im)));
        // Real numbers have a real sum.
        let real = |ball: &ComplexBall| ComplexBall::from(ball.real().clone());
        let reals: Vec<_> = pairs.iter().map(|((a, _), (b, _))| (real(a), real(b))).collect();
        let sum = ComplexBall::sum_of_products(reals.iter().map(|(a, b)| (a, b)), precision);
        let exact = pairs.iter().map(|((_, (ax, _)), (_, (bx, _)))| ax * bx).sum();
        prop_assert!(contains(&sum, &(exact, BigRational::zero())));
        prop_assert!(sum.imaginary().is_exact());
    }

    #[test]
    fn sums_of_exponents_give_products(
        a in prop::array::uniform2(samples::rational(2)),
        b in prop::array::uniform2(samples::rational(2)),
        precision in 2_u64..200,
    ) {
        let small = |x: &BigRational| x.numer().bits() <= x.denom().bits() + 6;
        prop_assume!(a.iter().chain(&b).all(small));
        let point = |[x, y]: &[BigRational; 2]| {
            let ball = |value| Ball::from_rational(value, precision);
            ComplexBall::new(ball(x), ball(y))
        };
        let (a, b) = (point(&a), point(&b));
        let product = a.exp(precision).unwrap().multiply(&b.exp(precision).unwrap(), precision);
        let minus = BigRational::from_integer((-1).into());
        let sum = a.add(&b, precision).exp(precision).unwrap();
        let difference = product.add(&sum.multiply_rational(&minus, precision), precision);
        prop_assert!(contains(&difference, &(BigRational::zero(), BigRational::zero())));
    }
}

#[test]
fn zero_has_no_reciprocal() {
    let error = ComplexBall::zero().reciprocal(64).unwrap_err();
    assert_eq!(error.to_string(), "the enclosure of a divisor contains zero");
}
