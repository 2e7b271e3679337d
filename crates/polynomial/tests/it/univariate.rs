//! `Univariate` agrees with `Polynomial` in every operation.

use crate::support::*;
use proptest::prelude::*;
use wavestep_polynomial::{Integer, Polynomial, Univariate};

/// The same polynomial in the symbol `x`, both forms valid.
fn sparse(p: &Univariate) -> Polynomial {
    assert!(p.is_valid(), "invariants broken: {p:?}");
    valid(p.to_polynomial(&symbol("x")))
}

proptest! {
    #[test]
    fn conversions_are_inverse(p in univariates()) {
        let x = symbol("x");
        prop_assert_eq!(Univariate::from_polynomial(&sparse(&p), &x), Some(p.clone()));
        let other = symbol("y");
        let read_as_other = Univariate::from_polynomial(&sparse(&p), &other);
        prop_assert_eq!(read_as_other.is_some(), p.coefficients().len() <= 1);
    }

    #[test]
    fn ring_operations_agree(p in univariates(), q in univariates()) {
        let (a, b) = (sparse(&p), sparse(&q));
        prop_assert_eq!(sparse(&(&p + &q)), &a + &b);
        prop_assert_eq!(sparse(&p.scale(&rational(-7, 3))), &a * &rational(-7, 3));
        prop_assert_eq!(sparse(&(&p + &p.scale(&rational(-1, 1)))), Polynomial::zero());
    }

    #[test]
    fn calculus_agrees(p in univariates(), h in rationals()) {
        let (a, x) = (sparse(&p), symbol("x"));
        prop_assert_eq!(sparse(&p.derivative()), a.derivative(&x));
        prop_assert_eq!(Ok(p.evaluate(&h)), a.evaluate(|_| Some(h.clone())));
    }

    #[test]
    fn queries_agree(p in univariates(), value in rationals()) {
        let (a, x) = (sparse(&p), symbol("x"));
        prop_assert_eq!(p.is_zero(), a.is_zero());
        prop_assert_eq!(p.coefficients().len().saturating_sub(1), a.degree(&x) as usize);
        prop_assert_eq!(p.coefficients().is_empty(), p.is_zero());
        prop_assert_eq!(p.denominator(), a.divided_terms().0);
        prop_assert_eq!(sparse(&Univariate::constant(&value)), Polynomial::constant(&value));
    }

    #[test]
    fn equal_values_have_one_representation(p in univariates(), c in integers(), zeros in 0_usize..3) {
        prop_assume!(c != Integer::from(0));
        let scaled = p.coefficients().iter().map(|value| value.to_integer() * &c);
        let scaled = scaled.chain(std::iter::repeat_n(Integer::from(0), zeros));
        prop_assert_eq!(Univariate::new(scaled, p.denominator() * &c), p);
    }
}

#[test]
fn zero() {
    assert!(Univariate::zero().is_zero());
    assert!(Univariate::zero().coefficients().is_empty());
    assert_eq!(Univariate::new(vec![0.into()], (-6).into()), Univariate::zero());
}

#[test]
fn another_symbol_is_refused() {
    assert_eq!(Univariate::from_polynomial(&read("x + y"), &symbol("x")), None);
    assert_eq!(Univariate::from_polynomial(&read("y"), &symbol("x")), None);
}

#[test]
fn the_exponential_series_is_its_own_derivative_but_for_the_last_term() {
    let series = |n: usize| Univariate::new(vec![1.into(); n], 1.into());
    assert_eq!(series(9).derivative(), series(8));
    assert_eq!(series(4).evaluate(&rational(1, 1)), rational(8, 3));
}

#[test]
#[should_panic(expected = "denominator zero")]
fn the_denominator_is_not_zero() {
    let _ = Univariate::new(vec![1.into()], 0.into());
}

#[test]
#[should_panic(expected = "an exponent exceeds 4095")]
fn the_sparse_form_bounds_the_degree() {
    let series = |length: usize| Univariate::new(vec![1.into(); length], 1.into());
    assert_eq!(series(4096).to_polynomial(&symbol("x")).degree(&symbol("x")), 4095);
    let _ = series(4097).to_polynomial(&symbol("x"));
}
