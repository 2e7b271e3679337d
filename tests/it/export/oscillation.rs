//! Real expressions as sums of oscillations.

use crate::support::fraction as read;
use wavestep::export::oscillation::oscillations;
use wavestep::export::tree::Circular;
use wavestep::expression::Expression;
use wavestep_polynomial::Symbol;

/// The sum of `p · e^{growth} · cos angle` and the like is the expression again.
#[test]
fn the_parts_add_up_to_the_expression() {
    let i = Symbol::square_root(-1).unwrap();
    let exponents = ["0", "-s", "s*sqrt(-1)", "2*mu - 1/2*s*sqrt(-1)*sqrt(3)", "3*sqrt(-1)"];
    let factors = ["1", "s - sqrt(2)", "sqrt(-1)", "mu*s^2 - 3*sqrt(-1)*sqrt(2)"];
    let mut whole = Expression::zero();
    for exponent in exponents.map(read) {
        for factor in factors.map(read) {
            whole.add_term(exponent.clone(), factor);
        }
        let real = &whole + &whole.conjugate(&i);
        let mut sum = Expression::zero();
        for (oscillation, p) in oscillations(&real) {
            assert_eq!(&p.conjugate(&i), &*p);
            let wave = match &oscillation.angle {
                None => Expression::one(),
                Some((Circular::Cosine, angle)) => Expression::cosine(angle),
                Some((Circular::Sine, angle)) => Expression::sine(angle),
            };
            sum += &wave.times(&p).times_exponential(&oscillation.growth);
        }
        assert_eq!(sum, real);
        assert!(oscillations(&real).iter().all(|(o, _)| o.growth.roots().all(|r| *r != i)));
    }
    // Expressions that are not real stay as they are.
    assert!(oscillations(&whole).iter().all(|(oscillation, _)| oscillation.angle.is_none()));
}
