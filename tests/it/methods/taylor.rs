//! Taylor polynomials: what is left out is within the remainder.

use wavestep::ball::{Ball, ComplexBall, Magnitude};
use wavestep::enclosure::Numbers;
use wavestep::expression::{Expression, Field as _, Fraction, Transform};
use wavestep::signal::Taylor;
use wavestep::signal::transforms::value_at;
use wavestep_polynomial::{Rational, Symbol};

const BITS: u64 = 200;

/// However few the terms, what they leave out is within the remainder, and the remainder is not
/// much more than that.
#[test]
fn what_is_left_out_is_within_the_remainder() {
    let numbers = Numbers::new(&[]);
    let field = numbers.field(BITS);
    let rational = |n: i64, d: i64| Rational::new(n.into(), d.into());
    let ball = |value: &Rational| field.embed(&Fraction::constant(value).into()).unwrap();
    let symbol = Symbol::new("x").unwrap();
    let mut compared = 0;
    let x = Fraction::symbol(&symbol);
    let whole = |value: i64| Fraction::constant(&rational(value, 1));
    let times = |factor: Fraction, rate: Rational| {
        Expression::from(factor).times_exponential(&x.scale(&rate))
    };
    let mut sum = times(&(&whole(1) - &x.scale(&rational(3, 1))) + &x.pow(4), rational(-2, 1));
    sum += &Expression::from(x.pow(3));
    for (text, expression) in [
        ("exp(-x)", times(whole(1), rational(-1, 1))),
        ("x^5 - 2*x", Expression::from(&x.pow(5) - &x.scale(&rational(2, 1)))),
        ("(1 - 3*x + x^4)*exp(-2*x) + x^3", sum),
        ("x^6*exp(x/3)", times(x.pow(6), rational(1, 3))),
    ] {
        let exact = Transform::of(&expression, &symbol);
        let function = Transform::<ComplexBall>::embedded(&exact, &field).unwrap();
        for (terms, half) in
            [(1, (1, 9)), (2, (1, 2)), (2, (1, 1 << 40)), (3, (1, 1)), (5, (1, 2)), (6, (3, 2))]
        {
            for centre in [rational(1, 3), rational(5, 2), rational(7, 1)] {
                let half = rational(half.0, half.1);
                let (x, h) = (ball(&centre), ball(&half));
                let taylor = Taylor::of(&function, &x, &h, terms, &numbers, BITS).unwrap();
                let taylor = taylor.real().unwrap();
                let known = Taylor { remainder: Magnitude::ZERO, ..taylor.clone() };
                let mut worst = Magnitude::ZERO;
                for u in [-4, -3, -1, 0, 2, 4].map(|u| rational(u, 4)) {
                    let at = ball(&(&centre + &half * &u));
                    let value = value_at(&function, &at, &numbers, BITS).unwrap();
                    let rest = known.value(&Ball::from_rational(&u, BITS), BITS);
                    let rest = rest.subtract(value.real(), BITS).magnitude();
                    assert!(
                        rest <= taylor.remainder.add(&Magnitude::power_of_two(-150)),
                        "{text} with {terms} terms about {centre}, at {u}"
                    );
                    worst = worst.max(rest);
                    compared += 1;
                }
                let most = worst.add(&Magnitude::power_of_two(-150)).scale(12);
                assert!(taylor.remainder <= most, "{text} with {terms} terms about {centre}");
            }
        }
    }
    assert_eq!(compared, 432);
}
