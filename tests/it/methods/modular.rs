//! Arithmetic modulo a prime.

use num_bigint::BigInt;
use wavestep::signal::closed::modular::{PRIME, Residue, evaluate};
use wavestep_polynomial::{Rational, Univariate};

#[test]
fn residues_agree_with_exact_values() {
    let x = Rational::new((-7).into(), 12.into());
    for degree in 0..40 {
        let coefficients = (0..=degree).map(|j| BigInt::from(3 * j - 50));
        let p = Univariate::new(coefficients, 1.into());
        let exact = p.evaluate(&x);
        let row = p.coefficients().iter().map(Residue::of_entry);
        let residue = evaluate(row, Residue::of_rational(&x).unwrap());
        assert_eq!(Residue::of_rational(&exact), Some(residue));
    }
}

#[test]
fn inverses_multiply_to_one() {
    let residue = |value: u64| Residue::of_integer(&value.into());
    assert_eq!(residue(0).inverse(), None);
    for value in [1, 2, 3, PRIME - 1, 1 << 60].map(residue) {
        assert_eq!(value.times(value.inverse().unwrap()), residue(1));
    }
}
