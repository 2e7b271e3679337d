//! Proofs that a polynomial is positive.

use num_traits::{Signed as _, Zero as _};
use proptest::prelude::*;
use wavestep::ball::{Magnitude, Number, rational as exactly};
use wavestep::history::positive::positive_until;
use wavestep::history::series::Series;
use wavestep_polynomial::Rational;

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

proptest! {
    /// What is told positive is positive, less the error, and little is left untold: until close to the first
    /// root, or to where the function is as small as the error.
    #[test]
    fn positive_is_positive(
        c in prop::collection::vec(-50_i64..60, 1..9), first in 1_i64..60, length in 1_i64..40,
        exponent in prop::sample::select(vec![-900_i64, -3, 0, 40]), small in 0_i64..3,
    ) {
        let unit = Magnitude::power_of_two(exponent);
        let size = Magnitude::from_u64(length as u64).multiply(&unit).scale(-4);
        let h = Rational::from(&size);
        let mut c = c;
        c[0] = first;
        // In units of the length: Σ c_k (x/h)^k.
        let mut scale = rational(1, 1);
        let coefficients = c.iter().map(|c| {
            let own = rational(*c, 1) / &scale;
            scale = &scale * &h;
            Number::Exact(own)
        });
        let f = Series::new(coefficients.collect(), Magnitude::ZERO);
        let error = Magnitude::from_u64(small as u64).scale(-10);
        let until = positive_until(&f, &[error, Magnitude::ZERO], &size);
        let value = |t: &Rational| c.iter().rev().fold(Rational::zero(), |sum, c| sum * t + rational(*c, 1));
        let told = until.map_or(rational(1, 1), exactly);
        for part in 0..=64 {
            let t = &told * rational(part, 64);
            prop_assert!(value(&t) > Rational::from(&error) || part == 64 && until.is_some());
        }
        if until.is_some() {
            let near = (0..=64).map(|part| &told + rational(part, 64 << 11));
            let lowest = near.map(|t| value(&t)).min().unwrap();
            prop_assert!(lowest < Rational::from(&error) + rational(1, 4), "{until:?} {lowest}");
            prop_assert!(!told.is_negative());
        }
    }
}
