//! Polynomials form a commutative ring, an algebra over the rationals, with one representation
//! for each element.

use crate::support::*;
use proptest::prelude::*;
use wavestep_polynomial::{Polynomial, Rational, binomial};

proptest! {
    #[test]
    fn addition_is_a_commutative_group(
        p in polynomials(), q in polynomials(), r in polynomials(),
    ) {
        let sum = valid(&p + &q);
        prop_assert_eq!(&sum, &(&q + &p));
        prop_assert_eq!(valid(&sum + &r), &p + &(&q + &r));
        prop_assert_eq!(valid(&p + &Polynomial::zero()), p.clone());
        prop_assert_eq!(valid(&Polynomial::zero() + &p), p.clone());
        prop_assert_eq!(valid(&p + &valid(-&p)), Polynomial::zero());
        prop_assert_eq!(-p.clone(), -&p);
    }

    #[test]
    fn subtraction_undoes_addition(p in polynomials(), q in polynomials()) {
        let difference = valid(&p - &q);
        prop_assert_eq!(&difference, &(&p + &-&q));
        prop_assert_eq!(&difference, &-(&q - &p));
        prop_assert_eq!(valid(&difference + &q), p.clone());
        prop_assert_eq!(valid(&p - &p), Polynomial::zero());
        prop_assert_eq!(valid(&Polynomial::zero() - &p), -&p);
    }

    #[test]
    fn assigning_operators_agree(p in polynomials(), q in polynomials()) {
        let mut sum = p.clone();
        sum += &q;
        prop_assert_eq!(valid(sum.clone()), &p + &q);
        sum -= &q;
        prop_assert_eq!(valid(sum), p);
    }

    #[test]
    fn multiplication_is_a_commutative_monoid(
        p in polynomials(), q in polynomials(), r in small_polynomials(),
    ) {
        let product = valid(&p * &q);
        prop_assert_eq!(&product, &(&q * &p));
        prop_assert_eq!(valid(&product * &r), &p * &(&q * &r));
        prop_assert_eq!(valid(&p * &Polynomial::one()), p.clone());
        prop_assert_eq!(valid(&Polynomial::one() * &p), p.clone());
        prop_assert_eq!(valid(&p * &Polynomial::zero()), Polynomial::zero());
        prop_assert_eq!(valid(&Polynomial::zero() * &p), Polynomial::zero());
    }

    #[test]
    fn multiplication_distributes(p in polynomials(), q in polynomials(), r in polynomials()) {
        prop_assert_eq!(valid(&(&p + &q) * &r), &(&p * &r) + &(&q * &r));
    }

    #[test]
    fn no_zero_divisors(p in non_zero_polynomials(), q in non_zero_polynomials()) {
        let product = &p * &q;
        prop_assert_eq!(product.leading_coefficient(), p.leading_coefficient() * q.leading_coefficient());
        prop_assert_eq!(product.total_degree(), p.total_degree() + q.total_degree());
        for x in product.symbols() {
            prop_assert_eq!(product.degree(x), p.degree(x) + q.degree(x));
        }
    }

    #[test]
    fn numbers_scale(p in polynomials(), a in rationals(), b in non_zero_rationals()) {
        let scaled = valid(&p * &a);
        prop_assert_eq!(&scaled, &(&p * &Polynomial::constant(&a)));
        prop_assert_eq!(&scaled, &(&Polynomial::constant(&a) * &p));
        prop_assert_eq!(valid(&p / &b), &p * &b.recip());
        prop_assert_eq!(valid(&(&p * &b) / &b), p);
    }

    #[test]
    fn powers_are_repeated_products(p in small_polynomials(), n in 0_u32..6) {
        let product = (0..n).fold(Polynomial::one(), |product, _| &product * &p);
        prop_assert_eq!(valid(p.pow(n)), product);
    }

    #[test]
    fn order_of_terms_does_not_matter(
        (given, shuffled) in terms().prop_flat_map(|t| (Just(t.clone()), Just(t).prop_shuffle())),
    ) {
        let at_once: Polynomial = given.iter().map(monomial).sum();
        let one_by_one = shuffled.iter().fold(Polynomial::zero(), |sum, term| {
            valid(&sum + &monomial(term))
        });
        prop_assert_eq!(valid(at_once), one_by_one);
    }

    #[test]
    fn powers_of_one_symbol_collect(c in rationals(), x in symbols(), a in 0_u32..9, b in 0_u32..9) {
        let twice = valid(Polynomial::monomial(&c, &[(&x, a), (&x, b)]));
        prop_assert_eq!(&twice, &Polynomial::monomial(&c, &[(&x, a + b)]));
        let factors = Polynomial::symbol(&x).pow(a + b);
        prop_assert_eq!(twice, &factors * &c);
    }

    #[test]
    fn ordinary_and_divided_coefficients_agree(p in polynomials()) {
        let (denominator, divided) = p.divided_terms();
        prop_assert_eq!(p.term_count(), p.terms().count());
        for ((ordinary_powers, ordinary), (powers, numerator)) in p.terms().zip(divided) {
            prop_assert_eq!(ordinary_powers, powers);
            let product = |n: u32| (1..=n).fold(rational(1, 1), |f, i| f * rational(i.into(), 1));
            let factorials = powers.iter().fold(rational(1, 1), |f, e| f * product(*e));
            let value = Rational::new(numerator.clone(), denominator.clone());
            prop_assert_eq!(value, ordinary * factorials);
        }
    }

    #[test]
    fn terms_give_the_polynomial_back(p in polynomials()) {
        let rebuilt = p.terms().map(|(exponents, coefficient)| {
            let powers: Vec<_> = p.symbols().iter().zip(exponents.iter().copied()).collect();
            Polynomial::monomial(&coefficient, &powers)
        });
        prop_assert_eq!(valid(rebuilt.sum()), p.clone());
        let exponents: Vec<_> = p.terms().map(|(exponents, _)| exponents.to_vec()).collect();
        prop_assert!(exponents.is_sorted_by(|a, b| a > b), "terms in the documented order");
        let largest = exponents.iter().map(|exponents| exponents.iter().sum()).max();
        prop_assert_eq!(p.total_degree(), largest.unwrap_or(0));
    }

    #[test]
    fn coefficients_of_one_symbol_give_the_polynomial_back(p in polynomials(), x in symbols()) {
        let power = |e| Polynomial::symbol(&x).pow(e);
        let ordinary = p.coefficients(&x);
        let sum = ordinary.iter().map(|(e, c)| &valid(c.clone()) * &power(*e)).sum::<Polynomial>();
        prop_assert_eq!(&sum, &p);
        prop_assert!(ordinary.is_sorted_by(|a, b| a.0 > b.0));
        prop_assert!(ordinary.iter().all(|(_, c)| !c.is_zero() && c.degree(&x) == 0));
        for ((e, ordinary), (same, divided)) in ordinary.iter().zip(p.divided_coefficients(&x)) {
            prop_assert_eq!(*e, same);
            let factorial = Rational::from_integer(wavestep_polynomial::factorial(*e));
            prop_assert_eq!(valid(divided), ordinary * &factorial);
        }
    }

    #[test]
    fn constants_are_recognised(value in rationals(), p in polynomials()) {
        let constant = valid(Polynomial::constant(&value));
        prop_assert_eq!(constant.as_constant(), Some(value.clone()));
        prop_assert_eq!(constant.is_one(), value == rational(1, 1));
        prop_assert_eq!(constant.is_zero(), value == rational(0, 1));
        prop_assert_eq!(p.as_constant().is_some(), p.symbols().is_empty());
        prop_assert_eq!(p.is_one(), p == Polynomial::one());
    }
}

#[test]
fn binomial_theorem() {
    let (x, y) = (symbol("x"), symbol("y"));
    for n in [0, 1, 2, 7, 40] {
        let term = |k| {
            let coefficient = Rational::from_integer(binomial(n, k));
            monomial(&(coefficient, vec![(x.clone(), n - k), (y.clone(), k)]))
        };
        assert_eq!(valid(read("x + y").pow(n)), (0..=n).map(term).sum());
    }
}

#[test]
fn neutral_elements() {
    assert_eq!(valid(Polynomial::zero()), Polynomial::integer(0));
    assert_eq!(valid(Polynomial::one()), Polynomial::integer(1));
    assert!(!Polynomial::symbol(&symbol("x")).is_one());
    assert_eq!(Polynomial::zero().pow(0), Polynomial::one());
    assert_eq!(Polynomial::default(), Polynomial::zero());
    assert_eq!(std::iter::empty::<Polynomial>().sum::<Polynomial>(), Polynomial::zero());
    assert_eq!(Polynomial::zero().leading_coefficient(), rational(0, 1));
    assert!(Polynomial::zero().coefficients(&symbol("x")).is_empty());
}

#[test]
fn symbols_that_cancel_are_gone() {
    let difference = valid(&read("x*y + z") - &read("x*y"));
    assert_eq!(difference.symbols(), [symbol("z")]);
    assert_eq!(difference, Polynomial::symbol(&symbol("z")));
}

#[test]
fn exponents_are_bounded() {
    let x = symbol("x");
    let highest = valid(Polynomial::monomial(&rational(1, 1), &[(&x, Polynomial::MAX_EXPONENT)]));
    assert_eq!(highest.degree(&x), 4095);
    assert_eq!(highest.derivative(&x).antiderivative(&x), highest);
    let panics = |operation: &dyn Fn() -> Polynomial| {
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(operation)).is_err()
    };
    let one = rational(1, 1);
    assert!(panics(&|| Polynomial::monomial(&one, &[(&x, 4096)])));
    assert!(panics(&|| Polynomial::monomial(&one, &[(&x, u32::MAX), (&x, u32::MAX)])));
    assert!(panics(&|| &highest * &Polynomial::symbol(&x)));
    assert!(panics(&|| highest.antiderivative(&x)));
    assert!(panics(&|| Polynomial::symbol(&x).pow(4096)));
}
