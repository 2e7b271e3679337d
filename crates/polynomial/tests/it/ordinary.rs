//! Ordinary powers over one denominator, and fractions of words.

use num_integer::Integer as _;
use num_traits::One as _;
use proptest::prelude::*;
use wavestep_polynomial::{Integer, Ordinary, Polynomial, Rational, WordRatio};

const TEXTS: [&str; 6] =
    ["0", "7/3", "x", "4/3*x^3 - 1/6*x", "1/2*x^2*y^5 + 3/35*x*y - 9/8", "6*x^9 - 12*y^4"];

/// Alone and together, the coefficients are those of the polynomials, over the least
/// denominator.
#[test]
fn coefficients_are_those_of_the_polynomials() {
    let all: Vec<Polynomial> = TEXTS.iter().map(|text| text.parse().unwrap()).collect();
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

fn words() -> impl Strategy<Value = u32> {
    prop_oneof![4 => any::<u32>(), 4 => 1..30_u32, 1 => Just(u32::MAX), 1 => Just(0)]
}

proptest! {
    #[test]
    fn products_stay_reduced(
        start in (prop_oneof![9 => any::<i128>(), 1 => Just(0)], 1..=i128::MAX),
        steps in prop::collection::vec((words(), words()), 0..12),
    ) {
        let mut exact = Rational::new(start.0.into(), start.1.into());
        let mut value = WordRatio::from(&exact);
        for (a, b) in steps {
            let b = b.max(1);
            value.multiply(a, b);
            exact *= Rational::new(a.into(), b.into());
            prop_assert_eq!(value.to_rational(), exact.clone());
            // Reduced, and no limb too many: the only representation.
            prop_assert_eq!(&value, &WordRatio::from(&exact));
            let mut copy = WordRatio::from(&Rational::from_integer(7.into()));
            copy.clone_from(&value);
            prop_assert_eq!(&copy, &value);
        }
    }
}
