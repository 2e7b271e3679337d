//! Sums of products, rounded once: they hold the exact sum, and are no wider than sums that round each time.

use super::samples;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero as _;
use proptest::prelude::*;
use wavestep::ball::{Ball, Binary, Magnitude, Number};

type Term = (u64, (Ball, BigRational), (Ball, BigRational));

fn terms() -> impl Strategy<Value = Vec<Term>> {
    let weight = prop_oneof![Just(1_u64), 1_u64..1000, 1_u64..1 << 62];
    let term = (weight, samples::ball_and_point(), samples::ball_and_point());
    prop::collection::vec(term, 0..12)
}

proptest! {
    #[test]
    fn sums_hold_the_exact_sum(terms in terms(), precision in 2_u64..400) {
        let balls = terms.iter().map(|(weight, (x, _), (y, _))| (*weight, x, y));
        let told = Ball::sum_of_products(balls, precision);
        let (mut exact, mut stepwise) = (BigRational::zero(), Ball::zero());
        let mut sizes = Magnitude::ZERO;
        for (weight, (x, x_point), (y, y_point)) in &terms {
            let weight = BigRational::from_integer(BigInt::from(*weight));
            exact += &weight * x_point * y_point;
            let product = x.multiply(y, 1000).multiply_rational(&weight, 1000);
            sizes = sizes.add(&product.midpoint().magnitude());
            stepwise = stepwise.add(&product, 1000);
        }
        prop_assert!(told.contains(&exact));
        let rounding = sizes.scale(2 - precision as i64);
        let slack = stepwise.radius().add(&stepwise.radius().scale(-20)).add(&rounding);
        prop_assert!(*told.radius() <= slack, "{:?} and {slack:?}", told.radius());
    }

    #[test]
    fn rational_factors_may_stand_anywhere(terms in terms(), exact in any::<u16>()) {
        let number = |(ball, point): &(Ball, BigRational), place: usize| match exact >> place & 1 {
            0 => Number::Enclosed(ball.clone()),
            _ => Number::Exact(point.clone()),
        };
        let numbers: Vec<(u64, Number, Number)> = (terms.iter().enumerate())
            .map(|(place, (weight, x, y))| (*weight, number(x, place), number(y, 15 - place)))
            .collect();
        let sum = Number::sum_of_products(numbers.iter().map(|(w, x, y)| (*w, x, y)), 300);
        let exact: BigRational = (terms.iter())
            .map(|(weight, (_, x), (_, y))| x * y * BigRational::from_integer(BigInt::from(*weight)))
            .sum();
        prop_assert!(sum.ball(300).contains(&exact));
    }
}

/// What is far below the largest product is counted as an error, and takes no room.
#[test]
fn small_products_are_an_error() {
    let power = |exponent: i64| Ball::new(Binary::new(1.into(), exponent), Magnitude::ZERO);
    let (one, far, lost) = (power(0), power(-300), power(-(1 << 50)));
    for (other, kept) in [(&far, 400), (&far, 64), (&lost, 64)] {
        let sum = Ball::sum_of_products([(1, &one, &one), (3, other, &one)].into_iter(), kept);
        assert_eq!(sum.is_exact(), kept == 400);
        assert!(sum.radius().top().is_none_or(|top| top < -60));
    }
    // 2^64 − 2^64 + 2^-300, of which the first two are far larger than what is left.
    let large = power(32);
    let minus = large.clone().negate();
    let sum = [(1, &large, &large), (1, &large, &minus), (1, &far, &one)];
    assert_eq!(Ball::sum_of_products(sum.into_iter(), 400), far);
}
