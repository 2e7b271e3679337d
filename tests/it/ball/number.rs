//! Numbers that stay exact until they are long.

use std::cmp::Ordering;
use wavestep::ball::Number;
use wavestep_polynomial::Rational;

#[test]
fn rationals_stay_exact_until_they_are_long() {
    let third = Number::Exact(Rational::new(1.into(), 3.into()));
    let zero = third.add(&third, 64).subtract(&third, 64).subtract(&third, 64);
    assert!(zero.is_zero() && zero.sign() == Some(Ordering::Equal));
    let mut power = third.clone();
    for _ in 0..2000 {
        power = power.multiply(&third, 64);
    }
    assert!(power.exact().is_none());
    assert_eq!(power.sign(), Some(Ordering::Greater));
    assert!(power.multiply(&Number::zero(), 64).is_zero());
    let product = power.multiply(&power.reciprocal(64).unwrap(), 64);
    assert!(product.ball(64).contains(&Rational::from_integer(1.into())));
    assert_eq!(product.subtract(&Number::one(), 64).sign(), None);
}
