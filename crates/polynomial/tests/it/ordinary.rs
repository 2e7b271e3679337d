//! Ordinary powers over one denominator.

use crate::support::read;
use num_integer::Integer as _;
use num_traits::One as _;
use wavestep_polynomial::{Integer, Ordinary, Polynomial, Rational};

const TEXTS: [&str; 6] =
    ["0", "7/3", "x", "4/3*x^3 - 1/6*x", "1/2*x^2*y^5 + 3/35*x*y - 9/8", "6*x^9 - 12*y^4"];

/// Alone and together, the coefficients are those of the polynomials, over the least
/// denominator.
#[test]
fn coefficients_are_those_of_the_polynomials() {
    let all: Vec<Polynomial> = TEXTS.iter().map(|text| read(text)).collect();
    let groups = (0..all.len()).map(|i| &all[i..=i]).chain([&all[..], &all[2..5]]);
    for (polynomials, divisor) in groups.flat_map(|group| [1, 2, 12, 35].map(|d| (group, d))) {
        let ordinary = Ordinary::new(polynomials, &divisor.into());
        let mut least = Integer::one();
        for (i, p) in polynomials.iter().enumerate() {
            let divided = p / &Rational::from_integer(divisor.into());
            assert!(ordinary.coefficients(i).eq(divided.terms()), "({p})/{divisor}");
            let back = ordinary.integers(i).iter();
            let back = back.map(|n| Rational::new(n.clone(), ordinary.denominator().clone()));
            assert!(back.eq(divided.terms().map(|(_, c)| c)), "({p})/{divisor}");
            least = divided.terms().fold(least, |d, (_, c)| d.lcm(c.denom()));
        }
        assert_eq!(*ordinary.denominator(), least, "over {divisor}");
    }
}

#[test]
#[should_panic(expected = "coefficients over 0")]
fn the_divisor_is_positive() {
    let _ = Ordinary::new([&Polynomial::one()], &Integer::ZERO);
}
