//! Doubles where contacts open: certified values are the nearest to proven digits, compiled ones keep their
//! bound, on every shipped scene of this kind.

use crate::methods::{Values, exact, random, unit_in_the_last_place};
use num_rational::BigRational;
use num_traits::{ToPrimitive as _, Zero as _};
use proptest::prelude::RngExt as _;
use wavestep::answer::{Accuracy, Method, Question, Tolerance, Way, WayError};
use wavestep::problem::Problem;
use wavestep::signal::{EvaluateError, Limit, MethodError, Value, digits};

/// Scenes whose contacts open, with their linear observables and the end of a window in which they do.
const SCENES: &[(&str, Values<'static>, &[&str], &str)] = &[
    ("bars-of-equal-length", &[], &["force", "left", "right"], "5"),
    ("bars-of-unequal-length", &[], &["force", "left", "momentum"], "7"),
    ("bars-that-part", &[("r", "2/3")], &["force", "left", "right", "momentum"], "7"),
    ("cushion-with-release", &[("mu", "3")], &["force", "compression"], "12"),
    ("hopkinson-with-release", &[], &["force", "gauge"], "1/500"),
    ("mass-on-free-bar", &[("m", "1")], &["velocity", "force", "far"], "9"),
    ("mass-that-bounces", &[], &["velocity", "displacement", "strain_fixed"], "30"),
    ("saint-venant", &[("mu", "1")], &["velocity", "strain_impact", "strain_fixed"], "8"),
];

/// Digits that tell the nearest double, but for ties.
const DIGITS: usize = 25;
const LIMIT_BITS: u64 = 1 << 12;

fn problem(scene: &str, values: Values<'_>) -> Problem {
    let problem = Problem::builtin(scene).unwrap();
    values.iter().fold(problem, |problem, (name, value)| problem.with(name, *value).unwrap())
}

fn number(text: &str) -> BigRational {
    wavestep::language::parse_number(text).unwrap()
}

/// Calls `work` with each quantity on a window from 0.
fn each(mut work: impl FnMut(&str, &Question<'_>)) {
    for (scene, values, quantities, last) in SCENES {
        let problem = problem(scene, values);
        for quantity in *quantities {
            let name = format!("{quantity} of {scene}");
            let question = problem.question(quantity, [BigRational::zero(), number(last)]);
            work(&name, &question.unwrap_or_else(|error| panic!("{name}: {error}")));
        }
    }
}

/// Times without pattern.
fn doubles(question: &Question<'_>, seed: u8, count: usize) -> Vec<f64> {
    let last = question.signal.window()[1].to_f64().unwrap().next_down();
    let mut random = random(seed);
    (0..count).map(|_| random.random_range(0.0..=last)).collect()
}

/// The ends of stretches that are known exactly.
fn breaks(question: &Question<'_>) -> Vec<BigRational> {
    let count = question.signal.count().unwrap();
    (0..count).filter_map(|stretch| question.signal.exact_time(stretch, Limit::Right)).collect()
}

fn told(question: &Question<'_>, at: &BigRational, side: Limit) -> Value {
    digits(&*question.signal, at, side, DIGITS, LIMIT_BITS).unwrap()
}

/// The double nearest to a value.
fn nearest(value: &Value) -> f64 {
    match value {
        Value::Exact(value) => value.to_f64().unwrap(),
        value if value.ball(200).contains_zero() => 0.0,
        value => value.ball(200).rounded().expect("digits that decide"),
    }
}

#[test]
fn certified_values_are_nearest_to_digits() {
    let mut zeros = 0;
    each(|name, question| {
        let way = Way::new(Method::Certified, question, None).unwrap();
        let times = doubles(question, 91, 200);
        let values = way.values(&times).unwrap_or_else(|error| panic!("{name}: {error}"));
        for (time, value) in times.iter().zip(values) {
            let known = nearest(&told(question, &exact(*time), Limit::Right));
            assert_eq!(value, known, "{name} at {time}");
            zeros += usize::from(known == 0.0);
        }
        for time in breaks(question) {
            for side in [Limit::Left, Limit::Right] {
                let known = nearest(&told(question, &time, side));
                assert_eq!(way.value(&time, side), Ok(known), "{name} at {time}, {side:?}");
            }
        }
    });
    println!("{zeros} values are zero");
    assert!(zeros > 100);
}

/// Many values come from polynomials.
#[test]
fn many_certified_values_are_those_that_come_one_by_one() {
    for (scene, values, quantity, last) in [
        ("saint-venant", &[("mu", "1")][..], "velocity", "8"),
        ("mass-that-bounces", &[], "strain_fixed", "30"),
    ] {
        let problem = problem(scene, values);
        let question = problem.question(quantity, [BigRational::zero(), number(last)]).unwrap();
        let way = Way::new(Method::Certified, &question, None).unwrap();
        let times = doubles(&question, 92, 3000);
        let values = way.values(&times).unwrap();
        for (time, value) in times.iter().zip(values).step_by(20) {
            assert_eq!(way.value(&exact(*time), Limit::Right), Ok(value), "{scene} at {time}");
        }
    }
}

#[test]
fn compiled_values_keep_their_bound() {
    each(|name, question| {
        let times = doubles(question, 93, 200);
        let known = |at: &BigRational, side| {
            BigRational::from(told(question, at, side).ball(200).midpoint())
        };
        let inside: Vec<BigRational> =
            times.iter().map(|time| known(&exact(*time), Limit::Right)).collect();
        let sides = [Limit::Left, Limit::Right];
        let breaks = breaks(question).into_iter();
        let ends = breaks.map(|time| (sides.map(|side| known(&time, side)), time));
        let ends: Vec<([BigRational; 2], BigRational)> = ends.collect();
        let scale = question.scale().unwrap();
        for tolerance in [None, Some(1e-9 * scale)] {
            let way = Way::new(Method::Compiled, question, tolerance);
            let way = way.unwrap_or_else(|error| panic!("{name}: {error}"));
            let bound = way.bound().unwrap();
            let most = tolerance.unwrap_or(4.0 * unit_in_the_last_place(scale));
            assert!(bound <= most, "{name}: {bound:e} beyond {most:e}");
            let near = |value: f64, known: &BigRational, at: &dyn std::fmt::Display| {
                let bound = exact(bound) + exact(unit_in_the_last_place(value) / 2.0);
                let off = exact(value) - known;
                assert!(off <= bound && -&off <= bound, "{name} at {at}: off by {off}");
            };
            for ((time, value), known) in times.iter().zip(way.values(&times).unwrap()).zip(&inside)
            {
                near(value, known, time);
            }
            for (known, time) in &ends {
                for (side, known) in sides.into_iter().zip(known) {
                    near(way.value(time, side).unwrap(), known, time);
                }
            }
        }
    });
}

/// The chooser weighs what needs no closed form, and says of the others why not.
#[test]
fn a_tolerance_is_met_without_a_closed_form() {
    let problem = problem("saint-venant", &[("mu", "1")]);
    let times: Vec<BigRational> = (0..40).map(|i| number(&format!("{i}/5"))).collect();
    let within = Accuracy::Within(Tolerance::Relative(1e-9));
    let found = problem.doubles("strain_impact", &times, Limit::Right, within).unwrap();
    assert!(matches!(found.method, Method::Certified | Method::Compiled));
    assert_eq!(found.values[39], 0.0, "after the mass has left");
    let refused = |quantity, name: &str| {
        let question = problem.question(quantity, [times[0].clone(), times[30].clone()]);
        Way::new(name.parse().unwrap(), &question.unwrap(), None).err()
    };
    let reason = |error| Some(WayError::Method(MethodError::Evaluate(error)));
    for name in ["stable", "double-double", "marched", "plain", "expanded"] {
        assert_eq!(refused("velocity", name), reason(EvaluateError::NoClosedForm), "{name}");
    }
    for name in ["modes", "rigid"] {
        assert_eq!(refused("velocity", name), Some(WayError::NeedsClosedContacts(name)));
    }
    for name in ["stable", "marched", "plain", "expanded"] {
        assert_eq!(refused("energy", name), reason(EvaluateError::NotLinear), "{name}");
    }
}

/// What is not known to stay closed is not answered as if it did: a bar that is held between walls presses on them for
/// ever, but is not followed for ever.
#[test]
fn contacts_are_followed_before_they_count_as_closed() {
    let text = "scene \"Held\"\nbar rod { impedance = 1, travel = 1, velocity = 1/10, strain = -1 }\n\
        line fixed | rod - fixed\ncontacts open\nobserve v = velocity(rod.at(1/2))";
    let problem = Problem::read("held.wave", text).unwrap();
    let three = Accuracy::Method("modes:3".parse().unwrap(), None);
    let at = |time| problem.doubles("v", &[number(time)], Limit::Right, three);
    let (early, late) = (at("20").unwrap().values[0], at("200").unwrap().values[0]);
    assert!((early - late).abs() < 1e-12, "{early} {late}: a period later all is the same");
    let refused = at("20001/2").unwrap_err().to_string();
    assert!(refused.starts_with("more than 5000 cells"), "{refused}");
}

/// A single time, also one before which and after which all is zero.
#[test]
fn single_times_have_values() {
    let problem = problem("saint-venant", &[("mu", "1")]);
    for at in ["0", "1/3", "1", "31/10", "7"] {
        let at = number(at);
        for quantity in ["velocity", "strain_impact", "strain_fixed"] {
            let question = problem.question(quantity, [at.clone(), at.clone()]).unwrap();
            for side in [Limit::Left, Limit::Right] {
                let known = nearest(&told(&question, &at, side));
                for method in [Method::Certified, Method::Compiled] {
                    let way = Way::new(method, &question, None).unwrap();
                    let value = way.value(&at, side).unwrap();
                    let most = way.bound().unwrap() + unit_in_the_last_place(known);
                    assert!((value - known).abs() <= most, "{quantity} at {at} by {method}");
                }
            }
        }
    }
}
