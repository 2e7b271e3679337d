//! Irreducible factors: unique, and what multiplies to the polynomial.

use crate::support::*;
use proptest::prelude::*;
use wavestep_polynomial::Polynomial;

fn factors(text: &str) -> Vec<(String, u32)> {
    let factors = read(text).factors().expect("they are found");
    let mut told: Vec<_> = factors.into_iter().map(|(p, power)| (p.to_string(), power)).collect();
    told.sort();
    told
}

#[test]
fn factors_of_known_polynomials() {
    let one = |text: &str| vec![(text.to_owned(), 1)];
    assert_eq!(factors("7/2"), []);
    assert_eq!(factors("s^3 + s^2 + 1"), one("s^3 + s^2 + 1"));
    assert_eq!(
        factors("4*s^3 + 17*s^2 + 20*s + 4"),
        [("4*s + 1".to_owned(), 1), ("s + 2".to_owned(), 2)]
    );
    assert_eq!(factors("s^2 + 2*s + 1"), [("s + 1".to_owned(), 2)]);
    // These have factors modulo every prime.
    assert_eq!(factors("s^4 + 1"), one("s^4 + 1"));
    assert_eq!(
        factors("s^8 - 40*s^6 + 352*s^4 - 960*s^2 + 576"),
        one("s^8 - 40*s^6 + 352*s^4 - 960*s^2 + 576")
    );
    assert_eq!(factors("s^12 - 1").len(), 6);
    // The second factor alone holds s, and stays irreducible where b is a number.
    assert_eq!(
        factors("b^2*s^2 + 2*b*s^2 + s^2 + b^2 + 2*b + 1"),
        [("b + 1".to_owned(), 2), ("s^2 + 1".to_owned(), 1)]
    );
    let alone = "b^2*s^2 + 3*b^2 + 2*b*s^2 + b + s^2 + 1";
    assert_eq!(factors(alone), one(alone));
    assert_eq!(factors("s^2 - b^2"), [("b + s".to_owned(), 1), ("b - s".to_owned(), 1)]);
    assert_eq!(factors("b^2*s^2 + b*s^2 + mu*b + mu + b^3 + b^2").len(), 2);
    assert_eq!(factors("b^3 + b*mu + s + 2"), one("b^3 + b*mu + s + 2"));
    // Where b is 3 the degree in s drops, and what is left has no factors: that says nothing.
    assert_eq!(factors("b*s^2 - 3*s^2 + b*s - 2*s + 1").len(), 2);
    // The leading coefficient times a factor is larger than any coefficient of the polynomial.
    let two_factors = factors("1208925819614629174706176*s^2 + 4398046511104*s + 3");
    assert_eq!(
        two_factors,
        ["1099511627776*s + 1", "1099511627776*s + 3"].map(|p| (p.to_owned(), 1))
    );
    // Modulo the prime 2^61 - 1 the two factors share a root.
    let shared = "s^5 - 1048576*s^4 - 524288*s + 549755813888";
    assert_eq!(factors(shared), ["s - 1048576", "s^4 - 524288"].map(|p| (p.to_owned(), 1)));
    // What is irreducible modulo a small prime, or by the degrees modulo several, is known at once.
    let long = &read("2*s - 1000").pow(21) + &read("s");
    assert_eq!(long.factors(), Some(vec![(long, 1)]));
    assert!(read("0").factors().is_none());
}

/// Factors in one order.
fn sorted(p: &Polynomial) -> Option<Vec<(Polynomial, u32)>> {
    let mut factors = p.factors()?;
    factors.sort();
    Some(factors)
}

/// Small polynomials in two symbols, no number.
fn small() -> BoxedStrategy<Polynomial> {
    let term = (-3_i64..4, 0_u32..3, 0_u32..2);
    let sum = prop::collection::vec(term, 1..4).prop_map(|terms| {
        let term = |(c, s, b): &(i64, u32, u32)| {
            monomial(&(rational(*c, 1), vec![(symbol("s"), *s), (symbol("b"), *b)]))
        };
        terms.iter().map(term).sum::<Polynomial>()
    });
    sum.prop_filter("no number", |p| p.as_constant().is_none()).boxed()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn factorisation_is_unique(p in small(), q in small()) {
        let (Some(of_p), Some(of_q), Some(of_both)) = (sorted(&p), sorted(&q), sorted(&(&p * &q)))
        else { return Ok(()) };
        let multiplied = of_both.iter().fold(Polynomial::one(), |product, (factor, power)| {
            &product * &factor.pow(*power)
        });
        prop_assert_eq!(&multiplied, &(&p * &q).primitive_part().1);
        let mut merged = of_p;
        for (factor, power) in of_q {
            match merged.iter_mut().find(|(own, _)| *own == factor) {
                Some((_, own)) => *own += power,
                None => merged.push((factor, power)),
            }
        }
        merged.sort();
        prop_assert_eq!(of_both, merged);
    }
}
