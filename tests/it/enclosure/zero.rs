//! Enclosed zeros.

use crate::support::fraction;
use wavestep::ball::Ball;
use wavestep::enclosure::enclose_zero;
use wavestep::enclosure::zero::ZeroError;
use wavestep::expression::{Expression, Fraction};
use wavestep_polynomial::{Rational, Symbol};

fn x() -> Symbol {
    Symbol::new("x").unwrap()
}

fn ends(low: i64, high: i64) -> [Rational; 2] {
    [low, high].map(|end| Rational::from_integer(end.into()))
}

fn polynomial(text: &str) -> Expression {
    fraction(text).into()
}

#[test]
fn roots_of_polynomials_are_enclosed() {
    let zero = enclose_zero(&polynomial("x^2 - 2"), &x(), &ends(1, 2), 300).unwrap();
    let root = Ball::square_root(&Rational::from_integer(2.into()), 400).unwrap();
    assert!(zero.subtract(&root, 400).contains_zero());
    assert!(*zero.radius() <= zero.magnitude().scale(-300) && !zero.contains(&ends(1, 2)[0]));
    // x e^x = 1 has the omega constant for its solution.
    let power = Expression::exponential(Fraction::symbol(&x())).times(&Fraction::symbol(&x()));
    let omega = enclose_zero(&(&power - &Expression::one()), &x(), &ends(0, 1), 100).unwrap();
    assert!(omega.to_string().starts_with("0.567143290409783872999968662"));
    // A zero in the middle, where the sign is not decided.
    let zero = enclose_zero(&polynomial("x^3 + x - 2"), &x(), &ends(0, 2), 80);
    assert!(zero.unwrap().contains(&ends(1, 1)[0]));
}

#[test]
fn double_roots_and_none_are_refused() {
    assert_eq!(
        enclose_zero(&polynomial("x^2 + 1"), &x(), &ends(0, 1), 60),
        Err(ZeroError::SameSign)
    );
    let triple = enclose_zero(&polynomial("3*x^3 - 3*x^2 + x - 1/9"), &x(), &ends(0, 1), 60);
    assert_eq!(triple, Err(ZeroError::NotSimple));
    let two = Expression::symbol(&Symbol::new("y").unwrap());
    assert!(matches!(enclose_zero(&two, &x(), &ends(0, 1), 60), Err(ZeroError::Enclosure(_))));
}
