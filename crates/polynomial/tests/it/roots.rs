//! Square roots: a ring with one representation, in which division is exact.

use crate::support::*;
use proptest::prelude::*;
use wavestep_polynomial::{Polynomial, Rational, Symbol};

fn root(n: i64) -> Symbol {
    Symbol::square_root(n).expect("-1 or a prime")
}

/// Polynomials in two symbols and three roots.
fn rooted() -> BoxedStrategy<Polynomial> {
    let parts = prop::collection::vec((small_polynomials(), 0_u32..8), 0..4);
    parts
        .prop_map(|parts| {
            let part = |(p, roots): &(Polynomial, u32)| {
                let factors =
                    [-1, 2, 3].into_iter().enumerate().filter(|(i, _)| roots >> i & 1 == 1);
                factors.fold(p.clone(), |p, (_, n)| &p * &Polynomial::symbol(&root(n)))
            };
            valid(parts.iter().map(part).sum())
        })
        .boxed()
}

/// Polynomials `a + b x` with numbers that hold roots.
fn linear() -> BoxedStrategy<Polynomial> {
    prop::collection::vec((-3_i64..4, 0_u32..8, any::<bool>()), 0..4)
        .prop_map(|parts| {
            let part = |(value, roots, with_x): &(i64, u32, bool)| {
                let mut powers: Vec<_> = [-1, 2, 3]
                    .iter()
                    .enumerate()
                    .map(|(i, n)| (root(*n), roots >> i & 1))
                    .collect();
                powers.push((symbol("s"), u32::from(*with_x)));
                monomial(&(rational(*value, 1), powers))
            };
            parts.iter().map(part).sum()
        })
        .boxed()
}

proptest! {
    #[test]
    fn the_ring_laws_hold(a in rooted(), b in rooted(), c in rooted()) {
        let left = valid(&a * &valid(&b + &c));
        prop_assert_eq!(&left, &valid(&valid(&a * &b) + &valid(&a * &c)));
        prop_assert_eq!(valid(&a * &b), valid(&b * &a));
        prop_assert_eq!(valid(&(&a * &b) * &c), valid(&a * &(&b * &c)));
        prop_assert_eq!(valid(a.pow(3)), valid(&(&a * &a) * &a));
    }

    #[test]
    fn conjugation_is_an_automorphism(a in rooted(), b in rooted()) {
        for n in [-1, 2, 3] {
            let image = |p: &Polynomial| valid(p.conjugate(&root(n)));
            prop_assert_eq!(image(&(&a + &b)), &image(&a) + &image(&b));
            prop_assert_eq!(image(&(&a * &b)), &image(&a) * &image(&b));
            prop_assert_eq!(image(&image(&a)), a.clone());
            let minus = -Polynomial::symbol(&root(n));
            prop_assert_eq!(valid(a.substitute(&root(n), &minus)), image(&a));
            prop_assert!((&a * &image(&a)).roots().all(|other| *other != root(n)));
        }
    }

    #[test]
    fn division_undoes_multiplication(p in rooted(), q in linear()) {
        prop_assume!(!q.is_zero());
        prop_assert_eq!((&p * &q).divide(&q).map(valid), Some(p));
    }

    #[test]
    fn a_quotient_times_the_divisor_is_the_dividend(p in linear(), q in linear()) {
        prop_assume!(!q.is_zero());
        if let Some(quotient) = p.divide(&q) {
            prop_assert_eq!(&valid(quotient) * &q, p);
        } else {
            prop_assert!(!q.is_algebraic_number());
        }
    }

    #[test]
    fn substitution_and_shift_agree_with_products(p in small_polynomials(), a in linear(), q in rooted()) {
        let (b, s) = (symbol("b"), symbol("s"));
        let a = a.substitute(&s, &Polynomial::zero());
        let by_powers = |x: &Symbol, value: &Polynomial| -> Polynomial {
            p.coefficients(x).iter().map(|(power, c)| c * &value.pow(*power)).sum()
        };
        prop_assert_eq!(valid(p.substitute(&b, &a)), by_powers(&b, &a));
        for step in [a.clone(), Polynomial::symbol(&root(2)), Polynomial::symbol(&root(-1))] {
            let moved = &Polynomial::symbol(&s) + &step;
            prop_assert_eq!(valid(p.shift(&s, &step)), by_powers(&s, &moved));
            prop_assert_eq!(valid(q.shift(&s, &step).shift(&s, &-&step)), q.clone());
        }
        prop_assert_eq!(valid(q.antiderivative(&s).derivative(&s)), q);
    }

    #[test]
    fn what_is_printed_reads_back(p in rooted()) {
        prop_assert_eq!(read(&p.to_string()), p);
    }

    #[test]
    fn squares_have_square_roots(q in polynomials(), c in non_zero_rationals()) {
        prop_assume!(!q.is_zero());
        let (_, primitive) = q.primitive_part();
        let square = &(&primitive * &primitive) * &c;
        prop_assert_eq!(square.square_root(), Some((c, primitive)));
    }

    #[test]
    fn a_square_root_squares_to_the_polynomial(p in small_polynomials(), q in small_polynomials()) {
        for candidate in [p.clone(), &(&q * &q) + &p] {
            if let Some((c, root)) = candidate.square_root() {
                prop_assert_eq!(&(&root * &root) * &c, candidate);
            }
        }
    }
}

#[test]
fn known_values() {
    // The golden ratio, and the sixth root of unity.
    let golden = read("1/2 + 1/2*sqrt(5)");
    assert_eq!(valid(golden.pow(2)), &golden + &Polynomial::one());
    let sixth = read("1/2 + 1/2*sqrt(-1)*sqrt(3)");
    assert_eq!(valid(sixth.pow(6)), Polynomial::one());
    assert_eq!(valid(sixth.pow(3)), Polynomial::integer(-1));
    // 1/(1 + √2 + √3) = (2 + √2 − √6)/4.
    let inverse = Polynomial::one().divide(&read("1 + sqrt(2) + sqrt(3)")).map(valid);
    assert_eq!(inverse, Some(read("1/2 + 1/4*sqrt(2) - 1/4*sqrt(2)*sqrt(3)")));
    assert_eq!(read("x^2 - 2").divide(&read("x - sqrt(2)")), Some(read("x + sqrt(2)")));
    assert_eq!(read("x^2 + 1").divide(&read("x - sqrt(2)")), None);
    assert_eq!(read("sqrt(2)^3*x*sqrt(2)"), read("4*x"));
    assert_eq!(read("x").square_root(), None);
    assert_eq!(read("4*x^2 + 4*x + 2").square_root(), None);
    assert_eq!(read("sqrt(2)").square_root(), None);
    assert_eq!(read("-12").square_root(), Some((rational(-12, 1), Polynomial::one())));
}

#[test]
fn a_root_has_no_rational_value() {
    let any = |_: &Symbol| Some(Rational::from_integer(1.into()));
    assert_eq!(read("x*sqrt(2) + y").evaluate(any), Err(root(2)));
    assert_eq!(read("sqrt(2)*sqrt(2)").evaluate(any), Ok(rational(2, 1)));
}

#[test]
fn only_primes_and_minus_one_have_symbols() {
    for n in [-4, -2, 0, 1, 4, 6, 9, 1_000_000_007 * 3, 2_000_000_000_003] {
        assert_eq!(Symbol::square_root(n), None, "{n}");
    }
    for n in [-1, 2, 3, 97, 1_000_000_007, 999_999_999_989] {
        let symbol = root(n);
        assert_eq!((symbol.square(), Symbol::new(symbol.name())), (Some(n), None));
    }
}

#[test]
fn norms_are_free_of_roots() {
    let p = read("1 + sqrt(2) + sqrt(3)");
    assert!(p.is_algebraic_number() && !read("1 + sqrt(2)*x").is_algebraic_number());
    let (multiplier, norm) = p.norm();
    assert_eq!(norm, Polynomial::integer(-8));
    assert_eq!(&p * &multiplier, norm);
}
