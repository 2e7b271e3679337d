//! Numbers rounded to doubles, and doubles as numbers.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{FromPrimitive as _, One as _, Signed as _};
use proptest::prelude::*;
use wavestep::ball::{Ball, Binary, Magnitude};

fn exact(value: f64) -> BigRational {
    BigRational::from_f64(value).expect("a finite number")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// No neighbour is nearer, and of two that are as near the result is even.
    #[test]
    fn rounding_is_correct(
        high in any::<i64>(), low in any::<u64>(), tie in any::<bool>(), exponent in -1250_i64..890,
    ) {
        let low = if tie { 1 << 63 } else { low };
        let mantissa = (BigInt::from(high >> 9) << 64) + low;
        let value = Binary::new(mantissa << 8, exponent);
        let number = BigRational::from(&value);
        let double = value.to_double();
        let distance = (exact(double) - &number).abs();
        for neighbour in [double.next_up(), double.next_down()] {
            let other = (exact(neighbour) - &number).abs();
            prop_assert!(distance <= other);
            prop_assert!(distance < other || double.to_bits() & 1 == 0);
        }
        let (split, rest) = Ball::new(value.clone(), Magnitude::ZERO).split();
        prop_assert_eq!(BigRational::from(rest.midpoint()) + exact(split), number);
    }

    #[test]
    fn doubles_come_back(bits in any::<u64>()) {
        let double = f64::from_bits(bits);
        match Binary::from_double(double) {
            None => prop_assert!(!double.is_finite()),
            Some(binary) => {
                prop_assert_eq!(BigRational::from(&binary), exact(double));
                prop_assert_eq!(binary.to_double(), double);
            }
        }
    }
}

#[test]
fn ends_that_round_differently_decide_nothing() {
    let around =
        |radius| Ball::new(Binary::from_double(1.0).unwrap(), Magnitude::power_of_two(radius));
    assert_eq!(around(-60).rounded(), Some(1.0));
    assert_eq!(around(-54).rounded(), Some(1.0)); // 1 − 2^−54 is a tie, and goes to the even one
    assert_eq!(around(-53).rounded(), None);
    assert!(Magnitude::power_of_two(1 << 20).to_double().is_infinite());
    assert!(Magnitude::power_of_two(-(1 << 20)).to_double() > 0.0);
    assert_eq!(BigRational::one(), exact(Magnitude::power_of_two(0).to_double()));
}
