//! The simplest fraction between two.

use wavestep::signal::find::refine::simplest;
use wavestep_polynomial::Rational;

#[test]
fn simplest_fractions_are_simplest() {
    let ratio = |p: i64, q: i64| Rational::new(p.into(), q.into());
    for (from, to) in [((1, 7), (2, 9)), ((31, 10), (32, 10)), ((5, 3), (5, 3)), ((0, 1), (1, 9))] {
        let (from, to) = (ratio(from.0, from.1), ratio(to.0, to.1));
        let found = simplest(&from, &to);
        assert!(from <= found && found <= to);
        for q in 1..found.denom().try_into().unwrap() {
            let above = (&from * ratio(q, 1)).ceil() / ratio(q, 1);
            assert!(above > to, "{above} is simpler than {found}");
        }
    }
}
