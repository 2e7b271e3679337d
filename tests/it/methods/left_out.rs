//! Echoes that are left out for a tolerance: how many there are, and that what they come to is bounded.

use crate::methods::{exact, near, random, ratio};
use num_rational::BigRational;
use num_traits::Signed as _;
use proptest::prelude::RngExt as _;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use wavestep::answer::{Accuracy, Doubles, Method, Tolerance, Way};
use wavestep::problem::{Digits, Problem, Undecided};
use wavestep::signal::{At, EchoCount, Limit};

/// Travel times without a common measure, a step of impedance, and dampers at both ends that throw back a fifth: what
/// is left dies out.
const DAMPED: &str = "scene \"Damped\"\n\
     bar a { impedance = 1, travel = 1, velocity = 1 }\n\
     bar b { impedance = 2, travel = pi/3 }\n\
     support d { damping = 3/2 }\n\
     support e { damping = 3 }\n\
     line free - d - a | b - e - free\n\
     observe force = force(b.left)\n\
     observe velocity = velocity(a.left)\n";

/// The same with a mass between the bars.
const MASS: &str = "scene \"Mass\"\n\
     bar a { impedance = 1, travel = 1, velocity = 1 }\n\
     bar b { impedance = 2, travel = pi/3 }\n\
     mass m { mass = 1 }\n\
     line free - a - m - b - fixed\n\
     observe force = force(b.right)\n\
     observe velocity = velocity(m)\n";

/// A mass on a spring between the bars, which turns: its poles are complex.
const TURNING: &str = "scene \"Turning\"\n\
     bar a { impedance = 1, travel = 1, velocity = 1 }\n\
     bar b { impedance = 2, travel = pi/3 }\n\
     mass m { mass = 1 }\n\
     support s { stiffness = 9 }\n\
     line free - a - m - s - b - fixed\n\
     observe velocity = velocity(m)\n";

/// On a grid: a mass on a bar whose other end throws back a fifth, with the other sign.
const GRID: &str = "scene \"Grid\"\n\
     bar a { impedance = 1, travel = 1, velocity = 1 }\n\
     mass m { mass = 1 }\n\
     support e { damping = 3/2 }\n\
     line free - m - a - e - free\n\
     observe force = force(a.left)\n\
     observe velocity = velocity(a.right)\n";

fn problem(text: &str) -> Problem {
    Problem::of_text("scene", text, &BTreeMap::new()).unwrap_or_else(|error| panic!("{error}"))
}

fn within(problem: &Problem, name: &str, times: &[BigRational], tolerance: Tolerance) -> Doubles {
    problem.doubles(name, times, Limit::Right, Accuracy::Within(tolerance)).expect("values")
}

/// The same values to twenty digits, with all echoes.
fn digits(problem: &Problem, name: &str, times: &[BigRational]) -> (Vec<BigRational>, EchoCount) {
    let digits = Digits {
        count: 20,
        max_bits: 1 << 14,
        limit: Limit::Right,
        count_echoes: true,
        undecided: Undecided::Refused,
    };
    let wanted = problem.wanted(name).expect(name);
    let found = problem.proven(&wanted, times, digits, &|| ()).expect("digits");
    let values = found.values.iter().map(|value| value.decimal(20).0.to_rational()).collect();
    (values, found.echoes.expect("echoes are counted"))
}

fn times(last: i64, count: i64) -> Vec<BigRational> {
    (0..count).map(|i| ratio(last * (2 * i + 1), 2 * count)).collect()
}

#[test]
fn echoes_that_cannot_matter_are_not_worked_out() {
    let (problem, mut table) = (problem(DAMPED), String::new());
    for (name, last) in [("force", 40), ("velocity", 40), ("force", 10)] {
        let times = times(last, 7);
        let (truth, all) = digits(&problem, name, &times);
        let mut before = 0;
        for tolerance in ["1e-3", "1e-6", "1e-9", "1e-12", "abs:1e-6"] {
            let found = within(&problem, name, &times, tolerance.parse().unwrap());
            let EchoCount { expanded, arriving, needed } = found.echoes.expect("echoes");
            let line = format!("{name} until {last}, within {tolerance}");
            writeln!(table, "{line:<36}{expanded:>5}{needed:>5}{arriving:>5}").unwrap();
            assert_eq!(arriving, all.arriving, "{line}");
            assert!(
                expanded <= needed + 1 && needed <= arriving && expanded <= all.expanded,
                "{line}"
            );
            if !tolerance.starts_with("abs") {
                assert!(before <= expanded, "{line}");
                before = expanded;
            }
            let bound = exact(found.bound.expect("a proven bound"));
            let largest = truth.iter().map(|value| value.abs()).max().unwrap();
            let asked: f64 = tolerance.trim_start_matches("abs:").parse().unwrap();
            let asked =
                if tolerance.starts_with("abs") { exact(asked) } else { exact(asked) * largest };
            assert!(bound <= asked, "{line}");
            for (value, truth) in found.values.iter().zip(&truth) {
                let rounding = exact(value.abs().max(1e-300) * f64::EPSILON);
                let error = (exact(*value) - truth).abs();
                assert!(error <= &bound + &rounding, "{line}: {}", near(&error));
            }
        }
    }
    crate::snapshot("work", "left-out", "echoes worked out, needed, arriving", &table);
}

/// What is left out leaves room for polynomials, also where more is left out than the tolerance allows while the largest
/// value is looked for.
#[test]
fn every_tolerance_is_met() {
    let scene = wavestep::scenes::find("incommensurate").expect("a built-in scene");
    let problem = problem(scene.text);
    let times: Vec<BigRational> = (1..=40).map(|i| ratio(i, 20_000)).collect();
    let (truth, _) = digits(&problem, "contact_force", &times);
    let largest = truth.iter().map(|value| value.abs()).max().unwrap();
    for exponent in 1..12 {
        let tolerance = format!("1e-{exponent}");
        let found = within(&problem, "contact_force", &times, tolerance.parse().unwrap());
        let most = exact(tolerance.parse().unwrap()) * &largest;
        for (value, truth) in found.values.iter().zip(&truth) {
            assert!((exact(*value) - truth).abs() <= most, "{tolerance}: {value}");
        }
    }
}

/// A mass throws back more than it gets for a while, so that bounds do not fall. What is never there is all that is not
/// worked out.
#[test]
fn with_a_mass_nothing_is_left_out() {
    let problem = problem(MASS);
    let times = times(12, 3);
    let all = digits(&problem, "velocity", &times).1;
    let found = within(&problem, "velocity", &times, Tolerance::Relative(1e-6));
    let EchoCount { expanded, arriving, needed } = found.echoes.expect("echoes");
    assert_eq!((expanded, arriving), (all.expanded, all.arriving));
    assert!(needed <= arriving);
}

/// The formula as it is printed keeps most digits of the first echoes, where these are seen at a delay and of several waves.
#[test]
fn printed_formulas_hold_the_first_echoes() {
    for (text, name) in
        [(DAMPED, "force"), (MASS, "force"), (MASS, "velocity"), (TURNING, "velocity")]
    {
        let (problem, times) = (problem(text), times(9, 40));
        let (truth, _) = digits(&problem, name, &times);
        let printed = Accuracy::Method(Method::Expanded, None);
        let found = problem.doubles(name, &times, Limit::Right, printed).expect("values");
        for ((value, truth), time) in found.values.iter().zip(&truth).zip(&times) {
            let error = (exact(*value) - truth).abs();
            assert!(error < exact(1e-10), "{name} at {}: {}", near(time), near(&error));
        }
    }
}

/// A load that is a small constant and a large exponential, or the other way round, sends echoes as large as both together.
#[test]
fn constants_and_exponentials_of_loads_are_both_counted() {
    for course in ["1/100000 + exp(-8*t)", "1 + exp(-8*t)/100000", "t*exp(-t) - 1/100000"] {
        let text = format!(
            "scene \"Decaying load\"\n\
             bar a {{ impedance = 1, travel = 1 }}\n\
             bar b {{ impedance = 1, travel = pi/3 }}\n\
             support d {{ damping = 3/2 }}\n\
             support e {{ damping = 3/2 }}\n\
             load push {{ force = {course} }}\n\
             line free - push - d - a | b - e - free\n\
             observe force = force(b.right)\n"
        );
        let problem = problem(&text);
        let trip = 1.0 + std::f64::consts::FRAC_PI_3;
        let after = |i: i32| [1e-6, 1.0].map(|by| exact(trip * f64::from(2 * i + 1) + by));
        let times: Vec<BigRational> = (0..5).flat_map(after).collect();
        let (truth, _) = digits(&problem, "force", &times);
        for most in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            let found = within(&problem, "force", &times, Tolerance::Absolute(most));
            for ((value, truth), time) in found.values.iter().zip(&truth).zip(&times) {
                let error = (exact(*value) - truth).abs();
                assert!(
                    error <= exact(most),
                    "{course}, {most:e}, {}: {}",
                    near(time),
                    near(&error)
                );
            }
        }
    }
}

/// On a grid the first pieces are worked out; after the last of them no more comes that matters. So a window of fifteen
/// thousand periods costs no more than one of fifty.
#[test]
fn pieces_that_cannot_matter_are_not_worked_out() {
    let (problem, mut table) = (problem(GRID), String::new());
    for (name, last) in [("force", 200), ("velocity", 200), ("force", 15_000)] {
        let mut times = times(20, 40);
        times.push(ratio(last, 1));
        let count = Digits {
            count: 20,
            max_bits: 1 << 14,
            limit: Limit::Right,
            count_echoes: false,
            undecided: Undecided::Refused,
        };
        let wanted = problem.wanted(name).expect(name);
        let truth = problem.proven(&wanted, &times[..40], count, &|| ()).expect("digits");
        let truth: Vec<_> =
            truth.values.iter().map(|value| value.decimal(20).0.to_rational()).collect();
        let largest = truth.iter().map(|value| value.abs()).max().unwrap();
        let mut before = 0;
        for tolerance in ["1e-3", "1e-6", "1e-9"] {
            let found = within(&problem, name, &times, tolerance.parse().unwrap());
            let EchoCount { expanded, arriving, needed } = found.echoes.expect("echoes");
            let line = format!("{name} until {last}, within {tolerance}");
            writeln!(table, "{line:<36}{expanded:>5}{needed:>5}{arriving:>9}").unwrap();
            assert!(before < expanded && expanded <= needed + 1 && needed < arriving, "{line}");
            before = expanded;
            let bound = exact(found.bound.expect("a proven bound"));
            assert!(bound <= exact(tolerance.parse().unwrap()) * &largest, "{line}");
            for (value, truth) in found.values.iter().zip(&truth) {
                let rounding = exact(value.abs().max(1e-300) * f64::EPSILON);
                let error = (exact(*value) - truth).abs();
                assert!(error <= &bound + &rounding, "{line}: {}", near(&error));
            }
            assert!(exact(found.values[40].abs()) <= bound, "{line}");
        }
    }
    crate::snapshot("work", "left-out-of-pieces", "echoes worked out, needed, arriving", &table);
}

/// A line of random bars between random ends, with something between them.
fn random_scene(random: &mut proptest::test_runner::TestRng) -> String {
    let mut number = |most: i64| ratio(random.random_range(1..=most), random.random_range(1..=4));
    let mut text = "scene \"Random\"\n".to_owned();
    for (name, travel) in [("a", "1"), ("b", "pi/3"), ("c", "pi/4")] {
        let (impedance, velocity) = (number(4), number(3));
        writeln!(
            text,
            "bar {name} {{ impedance = {impedance}, travel = {travel}, velocity = {velocity} }}"
        )
        .unwrap();
    }
    let mut line = String::new();
    for (i, end) in ["a", "b", "c", ""].into_iter().enumerate() {
        let kind = number(8).numer().to_string().parse::<i64>().unwrap() + i as i64;
        let (one, other) = (number(3), number(3));
        let element = match kind % 6 {
            0 => format!("mass e{i} {{ mass = {one}, velocity = {other} }}\n"),
            1 => format!("support e{i} {{ damping = {one} }}\n"),
            2 => format!("support e{i} {{ damping = {one}, stiffness = {other} }}\n"),
            3 if i == 1 || i == 2 => format!("spring e{i} {{ stiffness = {one} }}\n"),
            4 if i == 1 || i == 2 => {
                format!("spring e{i} {{ stiffness = {one}, damping = {other} }}\n")
            }
            _ => String::new(),
        };
        let joint = if element.is_empty() { " | ".to_owned() } else { format!(" - e{i} - ") };
        text += &element;
        line += match (i, element.is_empty()) {
            (0, true) => " - ",
            (3, true) => " - ",
            _ => &joint,
        };
        line += end;
    }
    let load = match number(2).is_integer() {
        true => "load push { force = 1 + 2*t*exp(-t/2) - exp(-t), from = 1/2, until = 3 }\n",
        false => "",
    };
    let push = if load.is_empty() { "" } else { " - push" };
    text + load
        + &format!("line free{push}{line}free\n")
        + "observe u = force(b.left)\nobserve v = velocity(b.right)\nobserve w = displacement(b.left)\n"
}

/// Whatever is left out, enclosures hold the value, also where all is left out that can be: then what is told of it is a
/// bound of the signal itself.
#[test]
fn what_is_left_out_is_bounded() {
    let mut random = random(77);
    let (mut compared, mut tight) = (0, 0.0_f64);
    let renamed = |text: &str| {
        let text = text.replace("force = force", "u = force").replace("velocity = v", "v = v");
        text + "observe w = displacement(b.left)\n"
    };
    let scenes = [DAMPED, MASS].map(renamed);
    let more: Vec<String> = (0..24).map(|_| random_scene(&mut random)).collect();
    for text in scenes.into_iter().chain(more) {
        let problem = problem(&text);
        for name in ["u", "v", "w"] {
            let question = problem.question(name, [ratio(0, 1), ratio(5, 1)]).expect("a question");
            let signal = &*question.signal;
            signal.count().expect("stretches");
            for most in [1e300, 1.0, 1e-2, 1e-5] {
                let cut = question.within(most).expect("arrivals").expect("on a lattice");
                let cut = &*cut.signal;
                cut.count().expect("stretches");
                let rest = BigRational::from(&cut.left_out());
                assert!(near(&rest) <= most, "{text}");
                for _ in 0..8 {
                    let at = ratio(random.random_range(0..5000), 1000);
                    let value = |signal: &dyn wavestep::signal::Signal| {
                        let stretch = signal.stretch_at(&at, Limit::Right).unwrap().unwrap();
                        let ball = signal.enclose(stretch, 0, At::Time(&at), 256).expect("a value");
                        crate::methods::tally::ends(&ball)
                    };
                    let ((low, high), (from, to)) = (value(signal), value(cut));
                    // Both hold the value; that of all echoes is known to many digits.
                    let rounding = (low.abs() + ratio(1, 1)) / ratio(1 << 62, 1);
                    assert!(&high - &low < rounding, "{name} at {at}: {text}");
                    assert!(from <= high && low <= to, "{name} at {at}, {most:e}: {text}");
                    if near(&rest) > 0.0 {
                        let middle = (&from + &to) / ratio(2, 1);
                        tight = tight.max(near(&((middle - low).abs() / &rest)));
                        compared += 1;
                    }
                }
            }
        }
    }
    println!("{compared} values with echoes left out, off by at most {tight:.2} of the bound");
    assert!(compared > 500 && tight > 0.9, "{compared} {tight}");
}

/// Polynomials and balls of what is left keep their bounds, at many times and on both sides.
#[test]
fn bounds_count_what_is_left_out() {
    let mut random = random(78);
    for (text, to) in [(DAMPED, 20), (MASS, 20), (GRID, 200)] {
        let problem = problem(text);
        let window = [ratio(0, 1), ratio(to, 1)];
        let whole = problem.question("velocity", window.clone()).expect("a question");
        let exact_values = Way::new(Method::Certified, &whole, None).expect("certified");
        for tolerance in [0.5, 1e-1, 1e-2, 1e-5] {
            let cut = whole
                .within(tolerance / 8.0)
                .expect("arrivals")
                .expect("bounds that fall, or a lattice");
            let left_out = near(&BigRational::from(&cut.signal.left_out()));
            assert!(text == MASS || left_out > 0.0, "{tolerance}");
            for method in [Method::Certified, Method::Compiled] {
                let way = Way::new(method, &cut, Some(tolerance)).expect("a way");
                let bound = way.bound().expect("a bound");
                assert!(left_out <= bound && bound <= tolerance, "{method}: {bound:e}");
                assert_eq!(
                    way.law().contains("correctly rounded"),
                    method == Method::Certified && left_out == 0.0
                );
                let at: Vec<_> =
                    (0..60).map(|_| ratio(random.random_range(0..20_000), 1000)).collect();
                for side in [Limit::Left, Limit::Right] {
                    let truth = exact_values.exact_values(&at, side).expect("values");
                    let values = way.exact_values(&at, side).expect("values");
                    for ((value, truth), at) in values.iter().zip(truth).zip(&at) {
                        let error = (value - truth).abs();
                        assert!(error <= bound + 1e-15, "{method} at {at}: {error:e} > {bound:e}");
                    }
                }
                let doubles: Vec<f64> = at.iter().map(near).collect();
                let values = way.values(&doubles).expect("values");
                let truth = exact_values.values(&doubles).expect("values");
                assert!(
                    values
                        .iter()
                        .zip(truth)
                        .all(|(value, truth)| (value - truth).abs() <= bound + 1e-15)
                );
            }
        }
    }
}
