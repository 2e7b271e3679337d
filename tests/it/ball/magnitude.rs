//! Magnitudes: every operation rounds up, and hardly.

use super::samples;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One as _, Signed as _};
use proptest::prelude::*;
use wavestep::ball::Magnitude;

fn exact(value: &Magnitude) -> BigRational {
    let (mantissa, exponent) = value.parts();
    let normal = if value.is_zero() { exponent == 0 } else { mantissa >> 31 == 1 };
    assert!(normal, "not normalised: {value:?}");
    BigRational::from(value)
}

/// `exact ≤ bound ≤ exact·(1 + 2^(−30))`.
fn assert_tight(bound: &Magnitude, value: &BigRational) {
    let slack = BigRational::new((BigInt::one() << 30) + 1, BigInt::one() << 30);
    let bound = exact(bound);
    assert!(&bound >= value && bound <= value * slack, "{bound} for {value}");
}

proptest! {
    #[test]
    fn operations_round_up(a in samples::magnitude(), b in samples::magnitude(), n in 1_u64..) {
        let (x, y) = (exact(&a), exact(&b));
        assert_tight(&a.add(&b), &(&x + &y));
        assert_tight(&a.multiply(&b), &(&x * &y));
        assert_tight(&a.divide(n), &(&x / BigInt::from(n)));
        prop_assert_eq!(a.cmp(&b), x.cmp(&y));
        let root = exact(&a.square_root());
        assert_tight(&a.square_root().multiply(&a.square_root()), &(&root * &root));
        prop_assert!(&root * &root >= x);
        prop_assert!(&root * &root <= &x * (BigRational::one() + BigRational::new(BigInt::one(), BigInt::one() << 28)));
        prop_assert_eq!(BigRational::from(&a.to_binary()), x);
    }

    #[test]
    fn powers_round_up(a in samples::magnitude(), n in 0_u64..12) {
        let power = exact(&a.power(n));
        let x = exact(&a);
        let value = (0..n).fold(BigRational::one(), |power, _| power * &x);
        prop_assert!(power >= value);
        let slack = BigRational::new((BigInt::one() << 25) + 1, BigInt::one() << 25);
        prop_assert!(power <= value * slack);
    }

    #[test]
    fn conversions_round_up(n in samples::integer(40), q in samples::rational(40)) {
        assert_tight(&Magnitude::from_integer(&n, 0), &BigRational::from_integer(n.clone()).abs());
        assert_tight(&Magnitude::from_rational(&q), &q.abs());
    }
}

#[test]
fn extreme_exponents_are_kept() {
    let tiny = Magnitude::power_of_two(-(1 << 60));
    assert!(!tiny.is_zero());
    assert!(Magnitude::from_u64(1).add(&tiny) > Magnitude::from_u64(1));
    assert_eq!(Magnitude::from_u64(u64::MAX), Magnitude::power_of_two(64));
    assert_eq!(Magnitude::power_of_two(-5).top(), Some(-4));
}
