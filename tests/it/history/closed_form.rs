//! Instants of events in closed form.

use crate::support::fraction;
use wavestep::expression::Expression;
use wavestep::history::closed_form::linear_root;
use wavestep_polynomial::{Rational, Symbol};

#[test]
fn a_line_times_an_exponential_has_one_root() {
    let s = Symbol::new("s").unwrap();
    let power = |text: &str| Expression::exponential(fraction(text));
    // e^{−s} (e^{−2} + 2 − 2 s) is zero at 1 + e^{−2}/2.
    let value = &power("-s").times(&fraction("2 - 2*s")) + &power("-s - 2");
    let half = Rational::new(1.into(), 2.into());
    let root = &Expression::one() + &power("-2").scale(&half);
    assert_eq!(linear_root(&value, &s), Some(root));
    for other in
        [power("-s").times(&fraction("s*s - 1")), &power("-s") - &power("-2*s"), power("s")]
    {
        assert_eq!(linear_root(&other, &s), None);
    }
}
