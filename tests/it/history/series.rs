//! Taylor series with a bound of their rest.

use super::squares::{exponentials, truncation};
use proptest::prelude::*;
use wavestep::ball::{Ball, Magnitude, Number};
use wavestep::history::series::{CellNorm, Roughness, Series, Truncation};
use wavestep_polynomial::Rational;

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// `e^{−x}` and its bound, with N terms.
fn decay(cut: &Truncation) -> Series {
    exponentials(&[(rational(1, 1), rational(-1, 1))], cut)
}

fn exponential(x: &Rational) -> Ball {
    Ball::from_rational(&-x, 900).exp(900).unwrap()
}

fn encloses(wide: &Number, narrow: &Ball, bits: i64) -> bool {
    let difference = wide.ball(900).subtract(narrow, 900);
    let close = difference.magnitude() <= Magnitude::power_of_two(-bits);
    difference.contains_zero() && close
}

#[test]
fn an_exponential_is_shifted_integrated_and_squared() {
    for rate in [2, 0, 3] {
        let cut = truncation(128, rate);
        let f = decay(&cut);
        let h = Number::Exact(rational(4, 1 << rate));
        let (a, b) = (Number::Exact(rational(1, 3 << rate)), Number::Exact(rational(1, 7 << rate)));
        let sum = rational(10, 21 << rate);
        assert!(encloses(&f.value(&h, &cut), &exponential(h.exact().unwrap()), 100));
        let shifted = f.shift(&a, &cut);
        assert!(encloses(&shifted.value(&b, &cut), &exponential(&sum), 100));
        let h = Magnitude::power_of_two(-3 - rate);
        let (near, rest) = f.about(&a, &h, 9, &cut);
        let last = near[8].magnitude();
        assert!(rest <= last.multiply(&(0..8).fold(h, |power, _| power.multiply(&h))));
        for (near, shifted) in near.iter().zip(&shifted.coefficients) {
            assert_eq!(near.subtract(shifted, 256).sign(), None);
        }
        let end = Number::Exact(rational(1, 8 << rate));
        let close = Series::new(near, Magnitude::ZERO).value(&end, &cut).widened(&rest, 128);
        let far = rational(1, 3 << rate) + rational(1, 8 << rate);
        assert!(encloses(&close, &exponential(&far), 30));
        let again = shifted.shift(&b, &cut).shift(&a, &cut);
        let third = exponential(&(sum + rational(1, 3 << rate)));
        assert!(encloses(&again.value(&Number::zero(), &cut), &third, 90));
        // f' = −f, at any place and with the bound of its rest.
        let none = f.derivative(&cut).add(&f, cut.bits).value(&a, &cut).ball(900);
        assert!(none.contains_zero() && none.magnitude() < Magnitude::power_of_two(-90));
        // 1 − e^{−x} and (1 − e^{−2x})/2.
        let integral = f.integral(Number::zero(), &cut).value(&a, &cut);
        let one = Ball::from_rational(&rational(1, 1), 9);
        let place = a.exact().unwrap();
        let expected = one.subtract(&exponential(place), 900);
        assert!(encloses(&integral, &expected, 100));
        let expected = one.subtract(&exponential(&(place + place)), 900);
        let expected = expected.multiply_rational(&rational(1, 2), 900);
        assert!(encloses(&f.energy(&cut).value(&a), &expected, 100));
    }
}

/// The slope of e^{−x} is −e^{−x}, of two terms as well as of many; that of an integral is what was
/// integrated.
#[test]
fn slopes_are_enclosed() {
    let x = rational(1, 2);
    let at = Number::Exact(x.clone());
    for rate in [2, 0, 1] {
        let cut = truncation(128, rate);
        let slope = decay(&cut).derivative(&cut);
        assert!(encloses(&slope.value(&at, &cut).negate(), &exponential(&x), 90));
        let again = decay(&cut).integral(Number::one(), &cut).derivative(&cut);
        assert!(encloses(&again.value(&at, &cut), &exponential(&x), 90));
    }
    let few = Truncation { order: 2, ..truncation(128, 1) };
    let slope = decay(&few).derivative(&few).value(&at, &few).ball(128);
    assert!(slope.add(&exponential(&x), 900).contains_zero());
    assert!(!slope.subtract(&exponential(&rational(-9, 1)), 900).contains_zero());
    let line = Series::new(vec![Number::one(), Number::integer(5)], Magnitude::ZERO);
    assert_eq!(line.derivative(&few), Series::constant(Number::integer(5)));
}

/// Moved to an enclosed place, or seen there, a series is what it is at every place of the enclosure.
#[test]
fn enclosed_places_are_enclosed() {
    let cut = truncation(128, 0);
    let f = decay(&cut);
    let by = rational(1, 1000);
    let place = |part: i64| rational(1, 3) + &by * rational(part, 4);
    let ball = Number::Enclosed(Ball::between(&place(-4), &place(4), 128));
    let shifted = f.shift(&ball, &cut);
    let x = rational(1, 5);
    for part in -4..=4 {
        let told = f.value(&ball, &cut).ball(900);
        assert!(told.subtract(&exponential(&place(part)), 900).contains_zero(), "{part}");
        assert!(told.magnitude() < Magnitude::from_u64(1));
        let told = shifted.value(&Number::Exact(x.clone()), &cut).ball(900);
        let there = exponential(&(place(part) + &x));
        assert!(told.subtract(&there, 900).contains_zero(), "{part}");
        assert!(told.magnitude() < Magnitude::from_u64(1));
    }
}

proptest! {
    /// The norm of a cell bounds every derivative of a polynomial on the cell; what is settled or cut to few
    /// terms is still the same function.
    #[test]
    fn the_norm_bounds_all_derivatives(
        c in prop::collection::vec(-9_i64..10, 1..7), place in 0_i64..9, rate in -2_i64..3,
        order in 1_usize..5,
    ) {
        let cut = truncation(64, rate);
        let norm = CellNorm::new(cut.longest, &cut);
        let sizes: Vec<Magnitude> =
            c.iter().map(|c| Magnitude::from_u64(c.unsigned_abs())).collect();
        let bound = norm.of_sizes(&sizes);
        let x = Number::Exact(Rational::from(&cut.longest) * rational(place, 8));
        let whole: Vec<Number> = c.iter().map(|c| Number::integer(*c)).collect();
        let mut f = Series::new(whole.clone(), Magnitude::ZERO);
        for j in 0..8 {
            let size = f.value(&x, &cut).magnitude();
            prop_assert!(size <= bound.scale(cut.rate * j), "{j}");
            f = f.derivative(&cut);
        }
        // A polynomial of which the first terms only are kept, and one with radii.
        let exact = Series::new(whole.clone(), Magnitude::ZERO).value(&x, &cut).ball(900);
        let kept = whole.iter().take(order).cloned().collect();
        let low: Vec<Magnitude> = (0..sizes.len())
            .map(|k| if k < order { Magnitude::ZERO } else { sizes[k] })
            .collect();
        let few = Series::new(kept, norm.of_sizes(&low));
        let tenth = Magnitude::from_rational(&rational(1, 10));
        let wide: Vec<Number> = whole.iter().map(|c| c.widened(&tenth, 64)).collect();
        let wide = Series::new(wide, Magnitude::ZERO).bare(&norm, &cut);
        prop_assert!(wide.coefficients.iter().all(|c| c.split(64).1.is_zero()));
        for one in [few, wide] {
            let off = one.value(&x, &cut).ball(900).subtract(&exact, 900);
            prop_assert!(off.contains_zero());
        }
    }
}

/// Beyond its cell a series still encloses, with a wider bound.
#[test]
fn a_series_goes_on_beyond_its_cell() {
    let cut = Truncation { order: 9, ..truncation(128, 0) };
    let f = decay(&cut);
    let by = rational(1, 16);
    let x = Rational::from(&cut.longest) + &by;
    let far = f.extended(&Magnitude::from_rational(&by), &cut);
    let value = far.value(&Number::Exact(x.clone()), &cut).ball(900);
    assert!(value.subtract(&exponential(&x), 900).contains_zero());
    assert!(far.rest > f.rest);
}

#[test]
fn polynomials_with_rational_coefficients_stay_exact() {
    let cut = truncation(64, 0);
    let number = |n| Number::Exact(rational(n, 3));
    let f = Series::new(vec![number(1), number(2), number(5), Number::zero()], Magnitude::ZERO);
    assert!(f.is_exact() && f.coefficients.len() == 3);
    let value = f.shift(&number(1), &cut).value(&number(2), &cut);
    assert_eq!(value, Number::Exact(rational(8, 3)));
    assert!(f.subtract(&f, 64).is_zero());
    assert_eq!(f.settled(&CellNorm::new(cut.longest, &cut), &cut), f);
}

/// The integral encloses `∫(P + e)`, and its derivative is off by no more than `e`, whatever is known of derivatives:
/// also shifted, as a part of a sum, and of rough functions a little beyond the cell.
#[test]
fn errors_are_integrated() {
    let cut = Truncation { longest: Magnitude::power_of_two(0), ..Truncation::new(128, 2) };
    let (off, length) = (rational(1, 1000), Magnitude::power_of_two(0));
    for roughness in [None, Some(Roughness::Within(12)), Some(Roughness::Values)] {
        let polynomial = vec![Number::integer(2), Number::integer(-3)];
        let rest = Magnitude::from_rational(&off);
        let mut f = Series::new(polynomial, rest);
        f.roughness = roughness;
        let integral = f.integral_over(Number::integer(1), &length, &cut);
        let twice = integral.add(&integral.shift(&Number::zero(), &cut), cut.bits);
        for x in [rational(1, 4), rational(1, 2), rational(7, 8)] {
            let at = Number::Exact(x.clone());
            for sign in [-1, 1] {
                let error = &off * rational(sign, 1);
                let slope = rational(2, 1) - &x * rational(3, 1) + &error;
                let value = rational(1, 1) + &x * (rational(2, 1) - &x * rational(3, 2) + error);
                let holds = |series: &Series, wanted: &Rational, times: i64| {
                    let wanted = Ball::from_rational(&(wanted * rational(times, 1)), 300);
                    let off = series.value(&at, &cut).ball(128).subtract(&wanted, 300);
                    off.contains_zero() && off.magnitude().to_double() < 0.01
                };
                assert!(holds(&integral, &value, 1) && holds(&twice, &value, 2), "{roughness:?}");
                for series in
                    [integral.derivative(&cut), integral.shift(&at, &cut).derivative(&cut)]
                {
                    let error = series.error.to_double();
                    assert!((0.001..0.002).contains(&error), "{roughness:?}: {error}");
                }
                assert!(holds(&integral.derivative(&cut), &slope, 1), "{roughness:?} at {x}");
                assert!(holds(&twice.derivative(&cut), &slope, 2), "{roughness:?} at {x}");
            }
        }
        let beyond = integral.derivative(&cut).extended(&Magnitude::power_of_two(-6), &cut);
        assert!(beyond.error.to_double() >= 0.001);
        assert!(roughness.is_none() || beyond.error.to_double() < 0.002, "{roughness:?}");
    }
}
