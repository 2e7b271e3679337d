//! Exact division finds the quotient where there is one, and only there.

use crate::support::*;
use proptest::prelude::*;
use wavestep_polynomial::{Polynomial, Rational};

proptest! {
    #[test]
    fn division_undoes_multiplication(p in polynomials(), q in non_zero_polynomials()) {
        prop_assert_eq!((&p * &q).divide(&q).map(valid), Some(p));
    }

    #[test]
    fn a_quotient_times_the_divisor_is_the_dividend(
        p in small_polynomials(), q in small_polynomials(),
    ) {
        prop_assume!(!q.is_zero());
        if let Some(quotient) = p.divide(&q) {
            prop_assert_eq!(&valid(quotient) * &q, p);
        }
    }

    #[test]
    fn a_remainder_is_seen(p in polynomials(), q in polynomials(), c in non_zero_rationals()) {
        prop_assume!(!q.symbols().is_empty());
        let not_divisible = &(&p * &q) + &Polynomial::constant(&c);
        prop_assert_eq!(not_divisible.divide(&q), None);
        // A multiple of q plus something of lower degree in a symbol of q.
        let x = &q.symbols()[0];
        let lower = q.derivative(x);
        prop_assert_eq!((&(&p * &q) + &lower).divide(&q), None);
    }

    #[test]
    fn numbers_divide_everything(p in polynomials(), c in non_zero_rationals()) {
        prop_assert_eq!(p.divide(&Polynomial::constant(&c)).map(valid), Some(&p / &c));
        prop_assert_eq!(Polynomial::zero().divide(&(&p + &read("new"))), Some(Polynomial::zero()));
    }

    #[test]
    fn content_and_primitive_part(p in non_zero_polynomials(), c in non_zero_rationals()) {
        let content = p.content();
        prop_assert!(content > rational(0, 1));
        let integers: Vec<_> = p.terms().map(|(_, value)| value / &content).collect();
        prop_assert!(integers.iter().all(Rational::is_integer));
        for prime in [2, 3, 5, 7, 11, 13, 17, 19, 23] {
            prop_assert!(!integers.iter().all(|i| (i / rational(prime, 1)).is_integer()));
        }

        let (signed, primitive) = p.primitive_part();
        prop_assert!(primitive.leading_coefficient() > rational(0, 1));
        prop_assert_eq!(&valid(primitive.clone()) * &signed, p.clone());
        prop_assert_eq!(if signed < rational(0, 1) { -&signed } else { signed.clone() }, content);
        prop_assert_eq!((&p * &c).primitive_part(), (&signed * &c, primitive.clone()));
        prop_assert_eq!(primitive.content(), rational(1, 1));
    }

    #[test]
    fn content_is_multiplicative(p in polynomials(), q in polynomials()) {
        // Gauss's lemma.
        prop_assert_eq!((&p * &q).content(), p.content() * q.content());
    }
}

#[test]
fn known_quotients() {
    let geometric = read("x^9 + x^8 + x^7 + x^6 + x^5 + x^4 + x^3 + x^2 + x + 1");
    assert_eq!(read("x^10 - 1").divide(&read("x - 1")), Some(geometric));
    assert_eq!(read("x^10 + 1").divide(&read("x - 1")), None);
    assert_eq!(read("x^2 + y^2").divide(&read("x + y")), None);
    assert_eq!(read("x^2 + x").divide(&read("2*x + 1")), None, "fractions would be needed");
    assert_eq!(read("1/3*x*y").divide(&read("2*y")), Some(read("1/6*x")));
    assert_eq!(read("x").divide(&read("y")), None);
    assert_eq!(Polynomial::zero().primitive_part(), (rational(0, 1), Polynomial::zero()));
    assert_eq!(Polynomial::zero().content(), rational(0, 1));
}

#[test]
fn a_division_that_fails_does_so_early() {
    // Followed to its end, the first would have millions of terms.
    assert_eq!(read("a^2000*b*c*d").divide(&read("a - b - c - d")), None);
    assert_eq!(read("x^4000*y^9 + y").divide(&read("x - y^2")), None);
}

#[test]
#[should_panic(expected = "division by the zero polynomial")]
fn nothing_is_divided_by_zero() {
    let _ = Polynomial::one().divide(&Polynomial::zero());
}
