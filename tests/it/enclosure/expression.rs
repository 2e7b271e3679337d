//! Enclosed expressions.

use crate::support::fraction as read;
use wavestep::ball::{Ball, BallError};
use wavestep::enclosure::{EnclosureError, enclose_expression};
use wavestep::expression::{Expression, Fraction};
use wavestep_polynomial::{Rational, Symbol};

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// `y'' + y' + y = 0` for `y = e^{λs} + e^{λ̄s}`, `λ = −1/2 + i√3/2`.
#[test]
fn a_solution_satisfies_its_equation_in_numbers() {
    let s = Symbol::new("s").unwrap();
    let rates = ["-1/2*s + 1/2*s*sqrt(-1)*sqrt(3)", "-1/2*s - 1/2*s*sqrt(-1)*sqrt(3)"];
    let [up, down] = rates.map(|rate| Expression::exponential(read(rate)));
    let y = &up + &down;
    let slope = y.derivative(&s);
    let at = |f: &Expression, x: &Rational| {
        let x = |_: &Symbol, bits| Some(Ball::from_rational(x, bits));
        enclose_expression(f, &x, 120).unwrap()
    };
    for x in [rational(0, 1), rational(7, 3), rational(-50, 9)] {
        let parts = [&y, &slope, &slope.derivative(&s)].map(|f| at(f, &x));
        let sum = parts[0].add(&parts[1], 120).add(&parts[2], 120);
        assert!(sum.real().contains(&rational(0, 1)) && sum.imaginary().contains(&rational(0, 1)));
        assert!(parts[0].imaginary().contains(&rational(0, 1)));
    }
    // y(0) = 2, y'(0) = −1.
    let zero = rational(0, 1);
    assert!(at(&y, &zero).real().contains(&rational(2, 1)));
    assert!(at(&slope, &zero).real().contains(&rational(-1, 1)));
}

#[test]
fn denominators_are_divided_by() {
    let inverse = Fraction::reciprocal(read("r - 3").numerator()).unwrap();
    let value = Expression::from(&read("2 + 2*sqrt(2)") * &inverse.pow(2));
    let at = |value: i64| {
        let ball = move |_: &Symbol, bits| Some(Ball::from_rational(&rational(value, 1), bits));
        enclose_expression(&inverse.pow(2).into(), &ball, 64)
    };
    assert!(at(5).unwrap().real().contains(&rational(1, 4)));
    assert_eq!(at(3), Err(EnclosureError::Ball(BallError::DivisorMayBeZero)));
    let five = |_: &Symbol, bits| Some(Ball::from_rational(&rational(5, 1), bits));
    let root = enclose_expression(&value, &five, 64).unwrap();
    // (1 + √2)/2 is a root of 4x² − 4x − 1.
    let x = root.real();
    let four = x.multiply(x, 64).subtract(x, 64).multiply_rational(&rational(4, 1), 64);
    assert!(four.contains(&rational(1, 1)));
}
