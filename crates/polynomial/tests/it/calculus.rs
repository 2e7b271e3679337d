//! Derivatives, antiderivatives, substitutions, shifts and values obey their laws.

use crate::support::*;
use proptest::prelude::*;
use wavestep_polynomial::{Polynomial, Rational, Symbol, binomial, factorial};

/// The value at a point given by its coordinates for the symbols the strategies use.
fn at(p: &Polynomial, point: &[Rational; 6]) -> Rational {
    let names = ["a", "b", "mu", "s", "x_1", "z"];
    let place = |x: &Symbol| names.iter().position(|name| *name == x.name());
    p.evaluate(|x| place(x).map(|i| point[i].clone())).expect("every symbol has a value")
}

fn points() -> BoxedStrategy<[Rational; 6]> {
    [(); 6].map(|()| rationals()).boxed()
}

proptest! {
    #[test]
    fn derivative_is_linear_and_obeys_leibniz(
        p in polynomials(), q in polynomials(), c in rationals(), x in symbols(),
    ) {
        let (dp, dq) = (valid(p.derivative(&x)), valid(q.derivative(&x)));
        prop_assert_eq!(valid((&p + &q).derivative(&x)), &dp + &dq);
        prop_assert_eq!((&p * &c).derivative(&x), &dp * &c);
        prop_assert_eq!(valid((&p * &q).derivative(&x)), &(&dp * &q) + &(&p * &dq));
    }

    #[test]
    fn partial_derivatives_commute(p in polynomials(), x in symbols(), y in symbols()) {
        prop_assert_eq!(p.derivative(&x).derivative(&y), p.derivative(&y).derivative(&x));
        let twice = p.antiderivative(&x).antiderivative(&y);
        prop_assert_eq!(twice, p.antiderivative(&y).antiderivative(&x));
    }

    #[test]
    fn derivative_undoes_antiderivative(p in polynomials(), x in symbols()) {
        let integral = valid(p.antiderivative(&x));
        prop_assert_eq!(integral.derivative(&x), p.clone());
        prop_assert_eq!(integral.substitute(&x, &Polynomial::zero()), Polynomial::zero());
        let initial = valid(p.substitute(&x, &Polynomial::zero()));
        prop_assert_eq!(&p.derivative(&x).antiderivative(&x) + &initial, p);
    }

    #[test]
    fn derivative_in_ordinary_powers(p in polynomials(), x in symbols()) {
        let lowered = p.coefficients(&x).into_iter().filter(|(e, _)| *e > 0).map(|(e, c)| {
            &(&c * &Polynomial::symbol(&x).pow(e - 1)) * &rational(e.into(), 1)
        });
        prop_assert_eq!(p.derivative(&x), lowered.sum());
    }

    #[test]
    fn substitution_is_a_homomorphism(
        p in polynomials(), q in polynomials(), value in small_polynomials(), x in symbols(),
    ) {
        prop_assume!(p.degree(&x) + q.degree(&x) < 12);
        let (p_at, q_at) = (valid(p.substitute(&x, &value)), valid(q.substitute(&x, &value)));
        prop_assert_eq!((&p + &q).substitute(&x, &value), &p_at + &q_at);
        prop_assert_eq!((&p * &q).substitute(&x, &value), &p_at * &q_at);
        prop_assert_eq!(Polynomial::symbol(&x).substitute(&x, &value), value);
    }

    #[test]
    fn substitution_in_ordinary_powers(
        p in polynomials(), value in small_polynomials(), x in symbols(),
    ) {
        prop_assume!(p.degree(&x) < 12);
        let terms = p.coefficients(&x).into_iter().map(|(e, c)| &c * &value.pow(e));
        prop_assert_eq!(valid(p.substitute(&x, &value)), terms.sum());
    }

    #[test]
    fn substitution_of_a_term_at_any_degree(
        p in polynomials(), c in rationals(), x in symbols(), y in symbols(),
    ) {
        let value = &Polynomial::symbol(&y) * &c;
        let terms = p.coefficients(&x).into_iter().map(|(e, c)| &c * &value.pow(e));
        prop_assert_eq!(valid(p.substitute(&x, &value)), terms.sum());
        prop_assert_eq!(p.substitute(&x, &Polynomial::symbol(&x)), p.clone());
        prop_assert_eq!(p.substitute(&symbol("absent"), &value), p);
    }

    #[test]
    fn chain_rule(p in polynomials(), value in small_polynomials(), x in symbols()) {
        // d/dx p(…, x ← value(x)) = (∂p/∂x)(value) · value'.
        prop_assume!(p.degree(&x) < 12);
        let only_x = p.coefficients(&x).into_iter().map(|(e, c)| {
            &Polynomial::symbol(&x).pow(e) * &c.leading_coefficient()
        });
        let p: Polynomial = only_x.sum();
        let chain = &p.derivative(&x).substitute(&x, &value) * &value.derivative(&x);
        prop_assert_eq!(valid(p.substitute(&x, &value).derivative(&x)), chain);
    }

    #[test]
    fn shifts_add(p in polynomials(), a in small_polynomials(), b in rationals(), x in symbols()) {
        prop_assume!(p.degree(&x) < 5);
        let a = a.substitute(&x, &Polynomial::one());
        let b = &Polynomial::symbol(&symbol("h")) * &b;
        let once = valid(p.shift(&x, &a));
        prop_assert_eq!(valid(once.shift(&x, &b)), p.shift(&x, &(&a + &b)));
        prop_assert_eq!(once.shift(&x, &-&a), p.clone());
        prop_assert_eq!(p.shift(&x, &Polynomial::zero()), p.clone());
        prop_assert_eq!(once.derivative(&x), p.derivative(&x).shift(&x, &a));
    }

    #[test]
    fn dense_shifts_are_substitutions(p in univariates(), k in any::<u32>(), first in any::<bool>()) {
        let (x, y) = (symbol("m"), symbol(if first { "a" } else { "z" }));
        let p = p.to_polynomial(&x);
        let [own, other] = [&x, &y].map(Polynomial::symbol);
        for (step, below) in [(&other, 1), (&other, 3), (&own, 1), (&other.pow(2), 1)] {
            let step = step * &rational(k.into(), below);
            let expected = p.substitute(&x, &(&own + &step));
            prop_assert_eq!(valid(p.shift(&x, &step)), expected);
        }
    }

    #[test]
    fn shift_by_a_multiple_of_a_symbol_makes_no_denominator(
        p in polynomials(), k in -9_i64..10, x in symbols(), y in symbols(),
    ) {
        let shifted = valid(p.shift(&x, &(&Polynomial::symbol(&y) * &rational(k, 1))));
        let before = p.divided_terms().0;
        prop_assert_eq!(before % shifted.divided_terms().0, 0.into());
    }

    #[test]
    fn evaluation_is_a_homomorphism(p in polynomials(), q in polynomials(), point in points()) {
        let (p_at, q_at) = (at(&p, &point), at(&q, &point));
        prop_assert_eq!(at(&(&p + &q), &point), &p_at + &q_at);
        prop_assert_eq!(at(&(&p - &q), &point), &p_at - &q_at);
        prop_assert_eq!(at(&(&p * &q), &point), &p_at * &q_at);
    }

    #[test]
    fn evaluation_is_substitution_of_every_symbol(p in polynomials(), point in points()) {
        let mut constant = p.clone();
        for (name, value) in ["a", "b", "mu", "s", "x_1", "z"].iter().zip(&point) {
            constant = constant.substitute(&symbol(name), &Polynomial::constant(value));
        }
        prop_assert_eq!(constant.as_constant(), Some(at(&p, &point)));
    }

    #[test]
    fn evaluation_adds_up_terms(terms in terms(), value in rationals()) {
        let p: Polynomial = terms.iter().map(monomial).sum();
        let power = |e: &u32| (0..*e).fold(rational(1, 1), |product, _| product * &value);
        let terms = terms.iter().map(|(c, powers)| {
            powers.iter().fold(c.clone(), |product, (_, e)| product * power(e))
        });
        let sum = terms.fold(rational(0, 1), |sum, term| sum + term);
        prop_assert_eq!(p.evaluate(|_| Some(value.clone())), Ok(sum));
    }
}

#[test]
fn a_symbol_without_value_is_named() {
    let p = read("b*mu + s");
    let only_b = |x: &Symbol| (x.name() == "b").then(|| rational(1, 1));
    assert_eq!(p.evaluate(only_b), Err(symbol("mu")));
}

/// `L_k(2x) = Σ_j C(k, j) (−2)^j x^j/j!`.
fn laguerre(k: u32) -> Polynomial {
    let x = symbol("x");
    let term = |j| {
        let numerator = binomial(k, j) * wavestep_polynomial::Integer::from(-2).pow(j);
        monomial(&(Rational::new(numerator, factorial(j)), vec![(x.clone(), j)]))
    };
    valid((0..=k).map(term).sum())
}

#[test]
fn laguerre_polynomials_of_twice_x() {
    let x = symbol("x");
    assert_eq!(laguerre(2), read("1 - 4*x + 2*x^2"));
    for k in 1..20 {
        let l = laguerre(k);
        let (slope, index) = (l.derivative(&x), rational(k.into(), 1));
        assert_eq!(*l.divided_terms().0, 1.into(), "integers in divided powers");

        // Rodrigues: with D = d/dx and y = 2x, k! L_k(y) = (d/dy − 1)^k y^k.
        let two_x = read("2*x");
        let rodrigues =
            (0..k).fold(two_x.pow(k), |f, _| &(&f.derivative(&x) / &rational(2, 1)) - &f);
        assert_eq!(&rodrigues / &Rational::from_integer(factorial(k)), l);

        // Laguerre's equation y L'' + (1 − y) L' + k L = 0 in y = 2x.
        let equation = &(&read("1/2*x") * &slope.derivative(&x))
            + &(&(&read("1/2 - x") * &slope) + &(&l * &index));
        assert_eq!(valid(equation), Polynomial::zero());

        // d/dx (L_k − L_{k−1}) = −2 L_{k−1}, and so ∫_0^x L_{k−1}.
        let before = laguerre(k - 1);
        let difference = &l - &before;
        assert_eq!(difference.derivative(&x), &before * &rational(-2, 1));
        assert_eq!(before.antiderivative(&x), &difference / &rational(-2, 1));
    }
}

#[test]
fn taylor_series_of_a_power() {
    let expected = "h^3 + 3*h^2*x + 3*h*x^2 + x^3";
    assert_eq!(read("x^3").shift(&symbol("x"), &read("h")).to_string(), expected);
    assert_eq!(read("x^2").shift(&symbol("x"), &read("1")), read("x^2 + 2*x + 1"));
}
