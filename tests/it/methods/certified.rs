//! Certified values are the nearest doubles: some hundred thousand of them, from polynomials in pairs
//! of doubles and from balls, against enclosures of another precision and against symbolic echoes.

use crate::methods::subject::{Subject, with};
use crate::methods::tally::{Tally, ends, is_nearest};
use crate::methods::{LATE_BITS, Values, exact, mass_ratio, random, times};
use num_rational::BigRational;
use proptest::prelude::RngExt as _;
use proptest::test_runner::TestRng;
use wavestep::signal::{Certified, Evaluator as _, Limit, Value};

/// Bits of the enclosures that decide: no double-double, and no precision of Ziv's loop.
const REFERENCE_BITS: u64 = 300;

/// Values a window, enough for polynomials to be used.
const MANY: usize = 2_500;

/// Among how many values one is looked at again in other ways.
const STRIDE: usize = 50;

struct Tallies {
    /// Against enclosures.
    rounded: Tally,
    /// Ends of enclosures as decimals, and rounding by rational arithmetic.
    again: Tally,
    /// Against symbolic echoes with 40 digits.
    by_form: Tally,
}

impl Tallies {
    fn new() -> Tallies {
        Tallies {
            rounded: Tally::new("correctly rounded, by enclosures"),
            again: Tally::new("correctly rounded, by rational arithmetic"),
            by_form: Tally::new("correctly rounded, by symbolic echoes"),
        }
    }

    fn report(&self, least: [usize; 3]) {
        self.rounded.report(least[0]);
        self.again.report(least[1]);
        self.by_form.report(least[2]);
    }

    fn check(&mut self, subject: &Subject<'_>, at: &[f64], values: &[f64]) {
        for (i, (time, value)) in at.iter().zip(values).enumerate() {
            let place = || format!("{time:?} in {}", subject.name);
            let rational = exact(*time);
            let mut ball = subject.enclose(&rational, Limit::Right, REFERENCE_BITS);
            if ball.rounded().is_none() {
                // Zero, or half-way between two doubles; or next to one of these.
                match subject.rational(&rational, Limit::Right) {
                    Some(number) => {
                        self.rounded.nearest(*value, &number, place);
                        continue;
                    }
                    None => ball = subject.enclose(&rational, Limit::Right, LATE_BITS),
                }
            }
            self.rounded.rounded(*value, &[REFERENCE_BITS], |_| ball.clone(), place);
            if i % STRIDE == 0 {
                let (low, high) = ends(&ball);
                self.again.nearest(*value, &low, place);
                self.again.nearest(*value, &high, place);
                self.form(subject, &rational, *value);
            }
        }
    }

    /// Against a decimal that is off by half a unit in its 40th digit at most.
    fn form(&mut self, subject: &Subject<'_>, at: &BigRational, value: f64) {
        let place = || format!("{at} in {}", subject.name);
        match subject.by_form(at, Limit::Right, 40) {
            Value::Exact(number) => self.by_form.nearest(value, &number, place),
            // Next to the smallest doubles forty digits may not decide.
            Value::Certified { .. } if value.abs() < f64::MIN_POSITIVE => {}
            Value::Certified { ball, .. } | Value::Enclosed(ball) => {
                let (low, high) = ends(&ball);
                self.by_form.nearest(value, &low, place);
                self.by_form.nearest(value, &high, place);
            }
        }
    }
}

/// Times without pattern, a tenth of them at arrivals and beside.
fn many_times(subject: &Subject<'_>, random: &mut TestRng, count: usize) -> Vec<f64> {
    let mut at = times::special(subject);
    at.truncate(count / 10);
    let rest = count - at.len();
    at.extend(times::anywhere(subject, random, rest));
    // In no order.
    for i in (1..at.len()).rev() {
        at.swap(i, random.random_range(0..=i));
    }
    at
}

fn check(subject: &Subject<'_>, random: &mut TestRng, count: usize, tallies: &mut Tallies) {
    let certified = Certified::new(subject.signal()).unwrap();
    let at = many_times(subject, random, count);
    let mut values = vec![f64::NAN; at.len()];
    certified.values(&at, &mut values).unwrap_or_else(|error| panic!("{}: {error}", subject.name));
    tallies.check(subject, &at, &values);
}

/// The end of a window so many times as long as a length.
fn end(length: &str, times: i64) -> String {
    let length = wavestep::language::parse_number(length).unwrap();
    (length * BigRational::from_integer(times.into())).to_string()
}

fn rigid_masses(seed: u8, rounds: i64) {
    let mut random = random(seed);
    let mut tallies = Tallies::new();
    for round in 0..rounds {
        for quantity in ["f", "velocity", "strain_impact", "strain_fixed"] {
            let mu = mass_ratio(&mut random);
            let (from, to) = (end(&mu, 2 * (round % 3)), end(&mu, 5 + 2 * round));
            with("rigid-mass", &[("mu", &mu)], quantity, (&from, &to), |subject| {
                check(subject, &mut random, MANY, &mut tallies);
                check(subject, &mut random, 60, &mut tallies);
            });
        }
    }
    let windows = 4 * rounds as usize;
    tallies.report([windows * (MANY + 60), windows * MANY / 25, windows * MANY / 50]);
}

#[test]
fn a_rigid_mass_is_correctly_rounded() {
    rigid_masses(11, 3);
}

#[test]
fn another_rigid_mass_is_correctly_rounded() {
    rigid_masses(12, 3);
}

#[test]
fn pulses_are_correctly_rounded() {
    let mut random = random(13);
    let mut tallies = Tallies::new();
    for round in 0..6 {
        let mu = mass_ratio(&mut random);
        with("pulse-shape", &[("mu", &mu)], "force", ("0", &end(&mu, 4 + round)), |subject| {
            check(subject, &mut random, MANY, &mut tallies);
            check(subject, &mut random, 60, &mut tallies);
        });
    }
    tallies.report([6 * (MANY + 60), 6 * MANY / 25, 6 * MANY / 50]);
}

/// A scene, its values, and observables with the ends of their windows.
type Scenes<'a> = &'a [(&'a str, Values<'a>, &'a [(&'a str, &'a str)])];

const SCENES: Scenes<'static> = &[
    ("mass-on-fixed-bar", &[("mu", "13/17")], &[("velocity", "8"), ("strain_fixed", "6")]),
    ("struck-free-bar", &[("mu", "3")], &[("far_velocity", "30"), ("middle_force", "20")]),
    ("cushioned-impact", &[("mu", "11/10")], &[("force", "8"), ("compression", "5")]),
    ("striker-on-long-bar", &[("r", "7/3")], &[("force", "20")]),
    ("striker-on-long-bar", &[("r", "1/3")], &[("interface_velocity", "9")]),
    ("pushed-bar", &[], &[("velocity", "40")]),
    ("stepped-striker", &[], &[("pulse", "12"), ("step", "10")]),
    ("pile", &[], &[("toe_force", "4")]),
    ("mass-between-bars", &[("m", "5/4")], &[("velocity", "5")]),
];

const UNITS: Scenes<'static> = &[
    ("hopkinson", &[], &[("gauge_output", "1/2500"), ("force", "1/2000")]),
    ("percussive-drill", &[], &[("gauge", "1/4000")]),
    ("incommensurate", &[], &[("wall_force", "1/4000")]),
];

fn scenes(scenes: Scenes<'_>, seed: u8, points: usize) {
    let mut random = random(seed);
    let mut tallies = Tallies::new();
    let mut windows = 0;
    for (scene, values, quantities) in scenes {
        for (quantity, last) in *quantities {
            with(scene, values, quantity, ("0", last), |subject| {
                check(subject, &mut random, points, &mut tallies);
                check(subject, &mut random, 100, &mut tallies);
            });
            windows += 1;
        }
    }
    tallies.report([windows * points, windows, windows]);
}

#[test]
fn scenes_of_numbers_are_correctly_rounded() {
    scenes(SCENES, 14, MANY);
}

#[test]
fn scenes_in_units_are_correctly_rounded() {
    scenes(UNITS, 15, MANY);
}

/// Sequences whose values are half-way between two doubles, and next to there; and one third, which
/// is no double.
const TIES: &str = r#"
recurrence "Half-way"
period 1, local s, time t
wave f
equation f[n] - f[n-1] = 1
observe even  = 9007199254740992 + f[n]
observe small = 1 + f[n]/9007199254740992
observe third = f[n]/3
observe above = 9007199254740992 + f[n] + 1/1267650600228229401496703205376
observe below = 9007199254740992 + f[n] - 1/1267650600228229401496703205376
"#;

/// Rational values are rounded as such: ties to even, and what is beside a tie by no more than
/// `2^−100` to its own side.
#[test]
fn ties_go_to_the_even_double() {
    let mut tally = Tally::new("rational values");
    for quantity in ["even", "small", "third", "above", "below"] {
        with(TIES, &[], quantity, ("0", "24"), |subject| {
            let certified = Certified::new(subject.signal()).unwrap();
            let mut random = random(16);
            for count in [200, MANY] {
                let at = many_times(subject, &mut random, count);
                let mut values = vec![f64::NAN; at.len()];
                certified.values(&at, &mut values).unwrap();
                for (time, value) in at.iter().zip(&values) {
                    let whole = exact(time.floor() + 1.0);
                    let unit = exact(2f64.powi(53));
                    let beside = exact(2f64.powi(-100));
                    let number = match quantity {
                        "even" => unit + whole,
                        "small" => exact(1.0) + whole / unit,
                        "third" => whole / exact(3.0),
                        "above" => unit + whole + beside,
                        _ => unit + whole - beside,
                    };
                    tally.nearest(*value, &number, || format!("{time} of {quantity}"));
                }
            }
            // From the left an arrival has not come yet.
            let at = |side| certified.value(&exact(3.0), side).unwrap();
            let differ = matches!(quantity, "third" | "below");
            assert_eq!(at(Limit::Left) < at(Limit::Right), differ, "{quantity}");
        });
    }
    tally.report(5 * (MANY + 200));
}

/// Nothing is seen before a front: exactly zero, also before time begins.
#[test]
fn nothing_comes_before_the_front() {
    for (scene, values, quantity) in [
        ("rigid-mass", &[("mu", "3")][..], "strain_fixed"),
        ("rigid-mass", &[("mu", "3")], "f"),
        ("mass-on-fixed-bar", &[("mu", "3")], "strain_fixed"),
    ] {
        with(scene, values, quantity, ("-2", "4"), |subject| {
            let certified = Certified::new(subject.signal()).unwrap();
            let front: f64 = if quantity == "f" { 0.0 } else { 3.0 };
            for count in [100, MANY] {
                let mut at = times::anywhere(subject, &mut random(17), count);
                at.extend([-2.0, front.next_down(), front, -f64::MIN_POSITIVE]);
                let mut values = vec![f64::NAN; at.len()];
                certified.values(&at, &mut values).unwrap();
                for (time, value) in at.iter().zip(values) {
                    assert_eq!(value == 0.0, *time < front, "{quantity} at {time}");
                }
            }
        });
    }
}

/// A double next to a rounded value is not nearest: the comparison tells them apart.
#[test]
fn values_are_no_neighbours() {
    with("rigid-mass", &[("mu", "1")], "f", ("0", "9"), |subject| {
        let certified = Certified::new(subject.signal()).unwrap();
        for time in times::anywhere(subject, &mut random(18), 100) {
            let value = certified.value(&exact(time), Limit::Right).unwrap();
            let (low, high) = ends(&subject.exact(&exact(time), Limit::Right));
            assert!(is_nearest(value, &low) && is_nearest(value, &high));
            assert!(!is_nearest(value.next_up(), &low) && !is_nearest(value.next_down(), &high));
        }
    });
}

/// Exact times that are no doubles, and arrivals on both sides: what a march in integers gives is nearest
/// to both ends of a ball.
#[test]
fn exact_times_are_correctly_rounded() {
    let mut compared = 0;
    for (scene, values, quantity) in [
        ("rigid-mass", &[("mu", "1/3")][..], "f"),
        ("rigid-mass", &[("mu", "5")], "strain_fixed"),
        ("mass-on-fixed-bar", &[("mu", "2/7")], "velocity"),
    ] {
        with(scene, values, quantity, ("0", "30"), |subject| {
            let mut random = random(19);
            let mut at = times::arrivals(subject);
            let places = 60 - at.len().min(30);
            at.extend((0..places).map(|_| {
                let denominator = random.random_range(1..1_000_i64);
                BigRational::new(
                    random.random_range(0..30 * denominator).into(),
                    denominator.into(),
                )
            }));
            at.retain(|time| (&subject.from..=&subject.to).contains(&time));
            let certified = Certified::new(subject.signal()).unwrap();
            for side in [Limit::Left, Limit::Right] {
                let together = certified.exact_values(&at, side).unwrap();
                for (time, value) in at.iter().zip(together) {
                    let (low, high) = ends(&subject.exact(time, side));
                    let is_right = is_nearest(value, &low) && is_nearest(value, &high);
                    assert!(is_right, "{quantity} at {time}: {value}");
                    assert_eq!(certified.value(time, side), Ok(value));
                    compared += 1;
                }
            }
        });
    }
    println!("{compared} values");
    assert!(compared > 200);
}
