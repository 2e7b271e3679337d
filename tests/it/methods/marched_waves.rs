//! Marches of all waves: several poles and lags, complex and repeated poles, loads; compared with
//! enclosures, and refused on a lattice.

use crate::methods::subject::{Subject, with};
use crate::methods::tally::{Tally, ends};
use crate::methods::{Values, exact, random, times};
use proptest::prelude::RngExt as _;
use proptest::test_runner::TestRng;
use wavestep::signal::{EvaluateError, Evaluator as _, Limit, MethodError, NoTaps, Taps};

/// The largest error, relative to the largest value.
const ALLOWED: f64 = 1e-13;

/// Scenes and recurrences with numbers, observables, and the ends of their windows.
const SUBJECTS: [(&str, Values<'static>, &str, &str); 20] = [
    ("mass-between-bars", &[("m", "1")], "velocity", "30"),
    ("mass-between-bars", &[("m", "3/7")], "force_wall", "30"),
    ("mass-between-bars", &[("m", "1/50")], "force_west", "12"),
    ("pulse-shape", &[("mu", "1")], "force", "30"),
    ("pulse-shape", &[("mu", "5")], "a", "60"),
    ("cushioned-impact", &[("mu", "2/3")], "force", "20"),
    ("cushioned-impact", &[("mu", "4")], "compression", "40"),
    ("percussive-drill", &[], "rock_force", "1/500"),
    ("percussive-drill", &[], "penetration", "1/500"),
    ("percussive-drill", &[], "gauge", "1/500"),
    ("pile", &[], "toe_force", "30"),
    ("pile", &[], "head_force", "30"),
    ("pile", &[], "penetration", "30"),
    ("stepped-striker", &[], "pulse", "20"),
    ("stepped-striker", &[], "step", "20"),
    ("two-bars", &[("r", "1/3")], "force", "40"),
    ("two-bars", &[("r", "3")], "g", "40"),
    ("hopkinson", &[], "force", "1/1000"),
    ("hopkinson", &[], "compression", "1/1000"),
    ("hopkinson", &[], "gauge_incident", "1/1000"),
];

/// Complex and repeated poles, loads that turn and grow, lags of several periods, and slopes, one of them
/// of a wave that has no equation of its own to integrate, at whose jumps another one jumps.
const RECURRENCE: &str = r#"
recurrence "Many poles"
period 3/2, local s, time t
wave u, v, w, x, y, z
equation u[n]' + u[n]/4 + 2*v[n] = u[n-2]/3 + exp(-t/5)*t
equation v[n]' - 2*u[n] + v[n]/4 = w[n-1]' - w[n-3]/5
equation w[n]' + w[n] = y[n] - w[n-1]/2
equation x[n]' + 2*x[n] = u[n]
equation y[n]' + y[n] = u[n-1]/3 + 1
equation z[n] = w[n-1]'/2 - y[n]' + u[n-2]
continuous u[n] starts at 1
continuous v[n] - w[n-1] starts at 0
continuous w[n] starts at 1/2
continuous x[n] + z[n] starts at 0
continuous y[n] - u[n-1]/4 starts at 0
observe mixed = u[n] - 3*v(t - 1/3) + w[n-2] + t/10
observe slope = w[n]' + y[n-1]
observe follows = z[n] - z[n-1]/3
"#;

/// Compares at arrivals from both sides and anywhere; gives the largest value.
fn compare(subject: &Subject<'_>, random: &mut TestRng, bits: u64, tally: &mut Tally) -> f64 {
    let name = &subject.name;
    let marched = subject.marched(true).unwrap_or_else(|error| panic!("{name}: {error}"));
    let at = times::anywhere(subject, random, 40);
    let mut values = vec![f64::NAN; at.len()];
    marched.values(&at, &mut values).unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut pairs: Vec<_> = at.iter().map(|time| (exact(*time), Limit::Right)).collect();
    let mut arrivals = times::arrivals(subject);
    arrivals.truncate(25);
    for side in [Limit::Left, Limit::Right] {
        values.extend(marched.exact_values(&arrivals, side).unwrap());
        pairs.extend(arrivals.iter().map(|time| (time.clone(), side)));
    }
    let scale = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    for ((time, side), value) in pairs.iter().zip(&values) {
        let enclosed = ends(&subject.enclose(time, *side, bits));
        let place = || format!("{time} on the {side:?} in {name}");
        tally.within(*value, enclosed, &exact(ALLOWED * scale), place);
    }
    if Taps::of(subject.form()).is_err() {
        assert_eq!(marched.bound(), None, "{name}");
        assert!(marched.law().contains("no bound"), "{}", marched.law());
    }
    scale
}

#[test]
fn scenes_are_as_enclosed() {
    let mut random = random(51);
    let mut tally = Tally::new("marched waves, of 1e-13 of the largest value");
    let mut without_taps = 0;
    for (scene, values, quantity, last) in SUBJECTS {
        with(scene, values, quantity, ("0", last), |subject| {
            without_taps += usize::from(Taps::of(subject.form()).is_err());
            assert!(compare(subject, &mut random, crate::methods::BITS, &mut tally) > 0.0);
        });
    }
    assert!(without_taps >= 12, "{without_taps} need all waves");
    tally.report(1_000);
}

#[test]
fn many_poles_and_loads_are_as_enclosed() {
    let mut random = random(52);
    let mut tally = Tally::new("marched, many poles, of 1e-13 of the largest value");
    for quantity in ["u", "v", "w", "x", "y", "z", "mixed", "slope", "follows"] {
        with(RECURRENCE, &[], quantity, ("0", "24"), |subject| {
            compare(subject, &mut random, crate::methods::BITS, &mut tally)
        });
    }
    tally.report(300);
}

/// Two or three bars with something at each joint and at the ends.
fn scene(random: &mut TestRng) -> String {
    let mut pick = |from: &[&str]| from[random.random_range(0..from.len())].to_owned();
    const VALUES: [&str; 6] = ["1/3", "1/2", "1", "3/2", "2", "5"];
    const TRAVEL: [&str; 3] = ["1/2", "1", "3/2"];
    let count = if pick(&["two", "three"]) == "two" { 2 } else { 3 };
    let mut text = "scene \"At random\"\n".to_owned();
    let mut line = format!("line {}", pick(&["free", "fixed"]));
    for i in 0..count {
        let velocity = if i == 0 { ", velocity = 1" } else { "" };
        let (impedance, travel) = (pick(&VALUES), pick(&TRAVEL));
        text += &format!("bar b{i} {{ impedance = {impedance}, travel = {travel}{velocity} }}\n");
        line += &format!(" {} b{i}", if i == 1 { "|" } else { "-" });
        let value = pick(&VALUES);
        let element = match pick(&["mass", "spring", "support", "none"]).as_str() {
            "mass" => format!("mass e{i} {{ mass = {value} }}\n"),
            "spring" if i + 1 < count => {
                let damping = pick(&["0", "1/4", "1"]);
                let damping =
                    if damping == "0" { String::new() } else { format!(", damping = {damping}") };
                format!("spring e{i} {{ stiffness = {value}{damping} }}\n")
            }
            "support" => format!("support e{i} {{ stiffness = {value}, damping = 1/2 }}\n"),
            _ => continue,
        };
        text += &element;
        line += &format!(" - e{i}");
    }
    let ends = ["free", "endless", "fixed"];
    // At a fixed end nothing else can act.
    match pick(if line.ends_with(&format!("b{}", count - 1)) { &ends } else { &ends[..2] }).as_str()
    {
        "endless" => {
            text += &format!("bar far {{ impedance = {} }}\n", pick(&VALUES));
            line += " - far - endless\n";
        }
        end => line += &format!(" - {end}\n"),
    }
    text + &line + "observe force = force(b1.left)\nobserve velocity = velocity(b0.right)\n"
}

#[test]
fn scenes_at_random_are_as_enclosed() {
    let mut random = random(53);
    let mut tally = Tally::new("marched, scenes at random, of 1e-13 of the largest value");
    let mut without_taps = 0;
    for _ in 0..40 {
        let text = scene(&mut random);
        for quantity in ["force", "velocity"] {
            with(&text, &[], quantity, ("0", "8"), |subject| {
                without_taps += usize::from(Taps::of(subject.form()).is_err());
                compare(subject, &mut random, crate::methods::BITS, &mut tally);
            });
        }
    }
    println!("{without_taps} of 80 need all waves");
    assert!(without_taps >= 30, "{without_taps} need all waves");
    tally.report(2_000);
}

/// The errors after many periods, at a few places.
#[test]
fn errors_stay_small_through_many_periods() {
    let mut random = random(54);
    let mut tally = Tally::new("marched through 400 periods, of 1e-13 of the largest value");
    for (scene, values, quantity, last) in [
        ("mass-between-bars", &[("m", "1")][..], "force_wall", "400"),
        ("pulse-shape", &[("mu", "2")], "force", "800"),
    ] {
        with(scene, values, quantity, ("0", last), |subject| {
            let marched = subject.marched(false).unwrap();
            let at = times::anywhere(subject, &mut random, 400);
            let mut values = vec![f64::NAN; at.len()];
            marched.values(&at, &mut values).unwrap();
            let scale = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            for (time, value) in at.iter().zip(values).take(60) {
                let enclosed = ends(&subject.enclose(&exact(*time), Limit::Right, 4096));
                let place = || format!("{time:?} in {}", subject.name);
                tally.within(value, enclosed, &exact(ALLOWED * scale), place);
            }
        });
    }
    tally.report(120);
}

/// Arrivals off a grid are refused by reason.
#[test]
fn lattices_are_refused() {
    with("incommensurate", &[], "wall_force", ("0", "1/4000"), |subject| {
        let refused = subject.marched(false);
        assert_eq!(refused.err(), Some(MethodError::NoTaps(NoTaps::NoGrid)));
    });
}

/// A mode of a pair is no real number, and is not given as one.
#[test]
fn what_is_not_real_is_refused() {
    let text = r#"
recurrence "Half a pair"
period 1, local s, time t
wave u
equation u[n]' + sqrt(-1)*u[n] = 0
continuous u[n] starts at 1
"#;
    with(text, &[], "u", ("0", "9"), |subject| {
        let refused = subject.marched(false).unwrap().value(&exact(1.0), Limit::Right);
        assert_eq!(refused, Err(MethodError::Evaluate(EvaluateError::NotReal)));
    });
}

/// Two waves that turn into each other, with a pair of imaginary poles.
#[test]
fn turning_waves_are_cosines() {
    let text = r#"
recurrence "A pair"
period 1, local s, time t
wave u, v
equation u[n]' + 2*v[n] = 0
equation v[n]' - 2*u[n] = 0
continuous u[n] starts at 1
continuous v[n] starts at 0
"#;
    let mut tally = Tally::new("marched, turning, of 1e-13 of the largest value");
    with(text, &[], "u", ("0", "9"), |subject| {
        compare(subject, &mut random(55), crate::methods::BITS, &mut tally);
        let cosine = subject.marched(false).unwrap().value(&exact(1.0), Limit::Right).unwrap();
        assert!((cosine - 2f64.cos()).abs() < 1e-15, "{cosine}");
    });
}
