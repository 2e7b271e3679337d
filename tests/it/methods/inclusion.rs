//! Inclusion: what every method says of its error is so, for scenes of every kind, at times without
//! pattern, at arrivals from both sides, and at the doubles beside them.

use crate::methods::subject::{Subject, with};
use crate::methods::tally::{Tally, ends};
use crate::methods::{
    BITS, LATE_BITS, Values, exact, mass_ratio, near, random, times, unit_in_the_last_place,
};
use num_rational::BigRational;
use proptest::test_runner::TestRng;
use wavestep::signal::{Certified, Evaluator, Limit, Summation, Summed};

/// Comparisons by method.
struct Tallies {
    certified: Tally,
    compiled: Tally,
    compiled_coarse: Tally,
    marched: Tally,
    stable: Tally,
    pairs: Tally,
}

impl Tallies {
    fn new() -> Tallies {
        Tallies {
            certified: Tally::new("certified, correctly rounded"),
            compiled: Tally::new("compiled, of its bound"),
            compiled_coarse: Tally::new("compiled to 1e-9, of its bound"),
            marched: Tally::new("marched, of its bound"),
            stable: Tally::new("stable, of 64 units in the last place"),
            pairs: Tally::new("double-double, of 2 units in the last place"),
        }
    }

    fn report(&self, least: [usize; 5]) {
        let [certified, compiled, marched, stable, pairs] = least;
        self.certified.report(certified);
        self.compiled.report(compiled);
        self.compiled_coarse.report(compiled);
        self.marched.report(marched);
        self.stable.report(stable);
        self.pairs.report(pairs);
    }
}

/// Compares the values of one method with a bound: at doubles, where the bound is all there is, and at
/// exact arrivals from both sides, where the rounding of the result is added.
fn compare(
    method: &dyn Evaluator,
    bound: f64,
    subject: &Subject<'_>,
    at: &[f64],
    tally: &mut Tally,
) {
    let name = &subject.name;
    let mut values = vec![0.0; at.len()];
    method.values(at, &mut values).unwrap_or_else(|error| panic!("{name}: {error}"));
    for (time, value) in at.iter().zip(values) {
        let enclosed = ends(&subject.exact(&exact(*time), Limit::Right));
        tally.within(value, enclosed, &exact(bound), || format!("{time:?} in {name}"));
    }
    for time in times::arrivals(subject) {
        for side in [Limit::Left, Limit::Right] {
            let value = method.value(&time, side).unwrap_or_else(|error| panic!("{name}: {error}"));
            let half = exact(unit_in_the_last_place(value)) / BigRational::from_integer(2.into());
            let enclosed = ends(&subject.exact(&time, side));
            tally.within(value, enclosed, &(exact(bound) + half), || {
                format!("{time} on the {side:?} in {name}")
            });
        }
    }
}

/// All methods on one observable; gives how many have values.
fn all_methods(subject: &Subject<'_>, random: &mut TestRng, tallies: &mut Tallies) {
    let name = &subject.name;
    let mut at = times::special(subject);
    at.extend(times::anywhere(subject, random, 30));
    let certified = Certified::new(subject.signal()).expect(name);
    let mut values = vec![0.0; at.len()];
    certified.values(&at, &mut values).expect(name);
    let rounded = |tally: &mut Tally, value: f64, time: &BigRational, side| {
        let place = || format!("{time} on the {side:?} in {name}");
        match subject.rational(time, side) {
            Some(number) => tally.nearest(value, &number, place),
            None => tally.rounded(
                value,
                &[BITS, LATE_BITS],
                |bits| subject.enclose(time, side, bits),
                place,
            ),
        }
    };
    for (time, value) in at.iter().zip(&values) {
        rounded(&mut tallies.certified, *value, &exact(*time), Limit::Right);
    }
    for time in times::arrivals(subject) {
        for side in [Limit::Left, Limit::Right] {
            let value = certified.value(&time, side).expect(name);
            rounded(&mut tallies.certified, value, &time, side);
        }
    }

    let compiled = subject.compiled(None).expect(name);
    let bound = compiled.bound().expect("compiled values have a bound");
    compare(&compiled, bound, subject, &at, &mut tallies.compiled);
    let tolerance = 1e-9 * subject.scale();
    let coarse = subject.compiled(Some(tolerance)).expect(name);
    let bound = coarse.bound().expect("compiled values have a bound");
    assert!(bound <= tolerance.max(f64::MIN_POSITIVE), "{name}: {bound:e}");
    assert!(coarse.pieces().len() <= compiled.pieces().len(), "{name}");
    compare(&coarse, bound, subject, &at, &mut tallies.compiled_coarse);

    if let Ok(marched) = subject.marched(true)
        && let Some(bound) = marched.bound()
    {
        compare(&marched, bound, subject, &at, &mut tallies.marched);
    }
    let unit = unit_in_the_last_place(subject.scale());
    for (precision, units, tally) in [
        (Summation::Scaled, 64.0, &mut tallies.stable),
        (Summation::DoubleDouble, 2.0, &mut tallies.pairs),
    ] {
        if let Ok(stable) = Summed::new(subject.signal(), precision) {
            assert_eq!(stable.bound(), None);
            compare(&stable, units * unit, subject, &at, tally);
        }
    }
}

#[test]
fn recurrences_at_random() {
    let mut random = random(1);
    let mut tallies = Tallies::new();
    for round in 0..3 {
        let mu = mass_ratio(&mut random);
        let value = wavestep::language::parse_number(&mu).unwrap();
        let last = (&value * BigRational::from_integer((6 + 5 * round).into())).to_string();
        for quantity in ["f", "g", "velocity", "strain_impact", "strain_fixed"] {
            let window = ("0", last.as_str());
            with("rigid-mass", &[("mu", &mu)], quantity, window, |subject| {
                all_methods(subject, &mut random, &mut tallies);
            });
        }
        let mu = mass_ratio(&mut random);
        let value = wavestep::language::parse_number(&mu).unwrap();
        let last = (&value * BigRational::from_integer((4 + 3 * round).into())).to_string();
        for quantity in ["a", "force"] {
            with("pulse-shape", &[("mu", &mu)], quantity, ("0", &last), |subject| {
                all_methods(subject, &mut random, &mut tallies);
            });
        }
    }
    tallies.report([1500, 1500, 1000, 1500, 1500]);
}

/// Scenes with their values, observables and windows.
type Windows<'a> = &'a [(&'a str, Values<'a>, &'a [&'a str], &'a str)];

const NUMBERS: Windows<'static> = &[
    ("cushioned-impact", &[("mu", "7/5")], &["force", "compression", "momentum"], "6"),
    (
        "mass-on-fixed-bar",
        &[("mu", "3/11")],
        &["velocity", "strain_impact", "strain_fixed", "momentum"],
        "4",
    ),
    (
        "struck-free-bar",
        &[("mu", "9/4")],
        &["velocity", "far_velocity", "impact_force", "middle_force"],
        "19",
    ),
    ("striker-on-long-bar", &[("r", "7/3")], &["interface_velocity", "force"], "13"),
    ("pushed-bar", &[], &["velocity", "momentum"], "11"),
    ("stepped-striker", &[], &["pulse", "velocity", "step"], "9"),
    ("pile", &[], &["ram_velocity", "head_force", "toe_force", "penetration"], "5"),
    ("mass-between-bars", &[("m", "5/4")], &["velocity", "force_west", "force_wall"], "7"),
];

const UNITS: Windows<'static> = &[
    ("hopkinson", &[], &["gauge_incident", "gauge_output", "force", "compression"], "1/2000"),
    ("percussive-drill", &[], &["gauge", "rock_force", "penetration"], "1/2500"),
    ("incommensurate", &[], &["contact_force", "contact_velocity", "wall_force"], "1/2500"),
];

fn every(windows: Windows<'_>, seed: u8, least: [usize; 5]) {
    let mut random = random(seed);
    let mut tallies = Tallies::new();
    for (scene, values, quantities, last) in windows {
        for quantity in *quantities {
            with(scene, values, quantity, ("0", last), |subject| {
                all_methods(subject, &mut random, &mut tallies);
            });
        }
    }
    tallies.report(least);
}

#[test]
fn scenes_of_numbers() {
    every(NUMBERS, 2, [1500, 1500, 500, 500, 500]);
}

#[test]
fn scenes_in_units() {
    every(UNITS, 3, [500, 500, 0, 0, 0]);
}

/// A window that begins late has values of its own alone, and refuses all others.
#[test]
fn windows_end_where_they_end() {
    let values: Values<'_> = &[("mu", "2/3")];
    with("rigid-mass", values, "velocity", ("10/3", "13/2"), |subject| {
        let (first, last) = times::ends(subject);
        let certified = Certified::new(subject.signal()).unwrap();
        let compiled = subject.compiled(None).unwrap();
        let marched = subject.marched(true).unwrap();
        let stable = Summed::new(subject.signal(), Summation::Scaled).unwrap();
        let methods: [(&str, &dyn Evaluator); 4] = [
            ("certified", &certified),
            ("compiled", &compiled),
            ("marched", &marched),
            ("stable", &stable),
        ];
        for (name, method) in methods {
            for outside in [first.next_down(), last.next_up(), f64::NAN, f64::INFINITY, -1.0] {
                let mut values = [0.0; 3];
                let refused = method.values(&[first, outside, last], &mut values);
                assert!(refused.is_err(), "{name} has a value at {outside}");
            }
            for outside in [
                crate::methods::ratio(33, 10),
                crate::methods::ratio(66, 10),
                crate::methods::ratio(-1, 1),
            ] {
                assert!(method.value(&outside, Limit::Right).is_err(), "{name}: {outside}");
            }
            let mut values = [0.0; 2];
            method.values(&[first, last], &mut values).unwrap();
            for (time, value) in [first, last].into_iter().zip(values) {
                let error = value - near(&ends(&subject.exact(&exact(time), Limit::Right)).0);
                assert!(error.abs() < 1e-14, "{name} at {time}: {error:e}");
            }
        }
    });
}
