//! Taylor polynomials: what is left out is within the remainder.

use wavestep::ball::{Ball, ComplexBall, Magnitude};
use wavestep::enclosure::Numbers;
use wavestep::expression::{Expression, Field as _, Fraction, Transform};
use wavestep::signal::transforms::value_at;
use wavestep::signal::{Expansion, Taylor};
use wavestep_polynomial::{Rational, Symbol};

const BITS: u64 = 200;

fn rational(n: i64, d: i64) -> Rational {
    Rational::new(n.into(), d.into())
}

/// However few the terms, what they leave out is within the remainder, and the remainder is not
/// much more than that.
#[test]
fn what_is_left_out_is_within_the_remainder() {
    let numbers = Numbers::new(&[]);
    let field = numbers.field(BITS);
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
                weighted(&function, (&centre, &half), &taylor, (terms, &numbers));
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

/// Times `e^(−wu)` the same function has another polynomial, and a bound as good as its own.
fn weighted(
    function: &Transform<ComplexBall>,
    (centre, half): (&Rational, &Rational),
    plain: &Taylor,
    (terms, numbers): (usize, &Numbers),
) {
    for weight in [rational(-2, 1), rational(1, 3)] {
        let weight = Ball::from_rational(&(half * weight), BITS);
        let place = [centre, half].map(|value| ComplexBall::from(Ball::from_rational(value, BITS)));
        let mut expansion = Expansion::new((&place[1], &weight), terms, numbers, BITS);
        expansion.add(function, &place[0], &ComplexBall::one());
        let taylor = expansion.sum().unwrap().real().unwrap();
        for u in [-1, 0, 1].map(|u| rational(u, 1)) {
            let u = Ball::from_rational(&u, BITS);
            let factor = weight.clone().negate().multiply(&u, BITS).exp(BITS).unwrap();
            let value = plain.value(&u, BITS).multiply(&factor, BITS);
            let off = taylor.value(&u, BITS).subtract(&value, BITS);
            assert!(off.contains_zero(), "{terms} terms about {centre}: {off}");
        }
    }
}

/// What decays a million times on a cell is bounded by what it is at the beginning of that, and has a sign.
#[test]
fn a_fast_decay_is_small_and_has_a_sign() {
    let (symbol, numbers) = (Symbol::new("x").unwrap(), Numbers::new(&[]));
    let rate = Fraction::symbol(&symbol).scale(&rational(-1_000_000, 1));
    let decay = Expression::from(Fraction::one()).times_exponential(&rate);
    let exact = Transform::of(&decay, &symbol);
    let function = Transform::<ComplexBall>::embedded(&exact, &numbers.field(BITS)).unwrap();
    let [x, h] = [3, 1].map(|value| ComplexBall::from(Ball::from_integer(&value.into())));
    let taylor = Taylor::of(&function, &x, &h, 20, &numbers, BITS).unwrap();
    // e^(−2·10⁶) = 2^(−2.885·10⁶).
    let size = taylor.real().unwrap().value(&Ball::zero(), BITS).magnitude();
    assert!(size < Magnitude::power_of_two(-2_880_000), "{size:?}");
    let weight = Ball::from_integer(&(-1_000_000).into());
    let mut signed = Expansion::new((&h, &weight), 20, &numbers, BITS);
    signed.add(&function, &x, &ComplexBall::one());
    let value =
        signed.sum().unwrap().real().unwrap().value(&Ball::symmetric(&rational(1, 1)), BITS);
    assert_eq!(value.sign(), Some(std::cmp::Ordering::Greater));
}

/// Functions about places of their own, of which some have the same rates, add up to what they are one by one.
#[test]
fn functions_about_several_places_add_up() {
    let (symbol, numbers) = (Symbol::new("x").unwrap(), Numbers::new(&[]));
    let field = numbers.field(BITS);
    let x = Fraction::symbol(&symbol);
    let times = |factor: Fraction, rate: Rational| {
        Expression::from(factor).times_exponential(&x.scale(&rate))
    };
    let ball = |value: &Rational| field.embed(&Fraction::constant(value).into()).unwrap();
    let (h, weight) = (ball(&rational(1, 3)), Ball::zero());
    let parts = [
        (times(x.pow(2), rational(-1, 1)), rational(1, 2), rational(3, 1)),
        (times(Fraction::one(), rational(-1, 1)), rational(5, 4), rational(-2, 7)),
        (Expression::from(x.pow(3)), rational(2, 1), rational(1, 5)),
        (
            &times(x.clone(), rational(2, 1)) + &Expression::from(x.clone()),
            rational(0, 1),
            rational(1, 1),
        ),
    ];
    let mut together = Expansion::new((&h, &weight), 12, &numbers, BITS);
    let mut each = Vec::new();
    for (function, place, factor) in &parts {
        let exact = Transform::of(function, &symbol);
        let function = Transform::<ComplexBall>::embedded(&exact, &field).unwrap();
        together.add(&function, &ball(place), &ball(factor));
        each.push((function, place, factor));
    }
    let together = together.sum().unwrap().real().unwrap();
    for u in [-1, 0, 1].map(|u| rational(u, 1)) {
        let mut sum = Ball::zero();
        for (function, place, factor) in &each {
            let at = ball(&(*place + &u * rational(1, 3)));
            let value = value_at(function, &at, &numbers, BITS).unwrap();
            sum = sum.add(value.multiply(&ball(factor), BITS).real(), BITS);
        }
        let value = together.value(&Ball::from_rational(&u, BITS), BITS);
        assert!(value.subtract(&sum, BITS).contains_zero(), "at {u}: {value} and {sum}");
        assert!(*value.radius() < Magnitude::power_of_two(-20), "at {u}: {value}");
    }
}
