//! What the method of steps keeps of a function.

use wavestep::model::track::{Track, points, series};

/// `e^{−x}` on two unequal pieces: values and integrals.
#[test]
fn values_and_integrals_are_those_of_an_exponential() {
    let mut track = Track::new(7.0, 2.0);
    for period in 0..2 {
        track.begin();
        for (start, length) in [(0.0, 0.5), (0.5, 1.5)] {
            let at = |x: f64| f64::exp(-(f64::from(period) * 2.0 + start + length * x));
            track.push(start, length, series(&points().map(at)));
        }
    }
    for t in [0.0, 0.3, 0.5, 1.9, 2.0, 2.2, 3.99, 4.0] {
        assert!((track.value(t) - f64::exp(-t)).abs() < 1e-15, "{t}");
        assert!((track.integral(t) + f64::exp_m1(-t)).abs() < 1e-15, "{t}");
    }
    assert_eq!((track.value(-0.5), track.integral(-0.5)), (7.0, -3.5));
    assert_eq!(track.within(-1, 0.3), 7.0);
    assert!((track.within(0, 2.0) - f64::exp(-2.0)).abs() < 1e-15);
}
