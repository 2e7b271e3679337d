//! Places of doubles in their periods: the quick reduction is the exact one.

use proptest::prelude::*;
use wavestep::ball::rational;
use wavestep::signal::method::clock::DoublePlaces;
use wavestep_kernels::fixed::Reduction;
use wavestep_polynomial::Rational;

/// Times near joints and anywhere: the quick reduction is the exact one.
fn compare(period: f64, delay: u32, time: f64) {
    let exact = rational(period);
    let delayed = &exact * &Rational::from_integer(delay.into());
    let any = DoublePlaces::Any(Reduction::new(&exact, &delayed).unwrap());
    let quick = DoublePlaces::Whole { period, delay };
    let (quick, any) = (quick.of(time).unwrap(), any.of(time).unwrap());
    assert_eq!(quick.map(|place| place.0), any.map(|place| place.0), "{time} by {period}");
    if let (Some((_, quick)), Some((_, any))) = (quick, any) {
        assert!((quick - any).abs() <= 2f64.powi(-53) && quick < 1.0, "{quick} {any}");
    }
}

proptest! {
    #[test]
    fn quick_places_are_exact_places(
        period in 0.01..100.0_f64,
        number in 0..100_000_u32,
        place in 0.0..1.0_f64,
        delay in 0..3_u32,
    ) {
        let joint = f64::from(number) * period;
        for time in [joint, joint.next_up(), joint.next_down(), joint + place * period] {
            compare(period, delay, time);
        }
    }
}

#[test]
fn times_that_have_no_place_are_told() {
    let places = DoublePlaces::Whole { period: 2.0, delay: 1 };
    assert_eq!(places.of(-1.0), Ok(None));
    assert_eq!(places.of(1.0), Ok(None));
    assert_eq!(places.of(2.0), Ok(Some((0, 0.0))));
    for time in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        assert!(places.of(time).is_err(), "{time}");
    }
}
