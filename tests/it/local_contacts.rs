//! Local contacts followed with proof: against the exact solution of a spring, against collocation, and what of the
//! law, of the balances and of the bounds has to hold.

use num_traits::ToPrimitive as _;
use wavestep::answer::Accuracy;
use wavestep::ball::{Ball, Magnitude, Number};
use wavestep::history::series::{CellNorm, Roughness, Series, Truncation};
use wavestep::signal::Limit;
use wavestep::{Method, Problem};
use wavestep_polynomial::Rational;

fn problem(text: &str) -> Problem {
    Problem::read("test.wave", format!("scene \"A\"\n{text}")).unwrap()
}

fn value(problem: &Problem, name: &str, time: &str, digits: usize) -> String {
    let value = problem.signal(name).unwrap().at(time, digits).unwrap();
    value.to_text(digits)
}

/// A steel ball between two bars, one of them with a mass, all of unlike impedances.
const WITH_MASSES: &str = "bar a { impedance = 2, travel = 3/2, velocity = 1 }\n\
    mass m { mass = 1/3, velocity = 1 }\nTIP\nmass anvil { mass = 1/2 }\n\
    bar b { impedance = 1, travel = 5/4 }\nline free - a - m - tip - anvil - b - fixed\n\
    observe force = force(tip)\nobserve compression = compression(tip)\nobserve velocity = velocity(b.left)\n\
    observe strain = velocity(a.at(1/2))";

/// With the exponent 1 a local contact is a spring while it pushes: twenty digits of two engines that share
/// neither the series nor the bound of their errors.
#[test]
fn with_exponent_one_it_is_a_spring() {
    for text in [WITH_MASSES, &WITH_MASSES.replace(" - m", "").replace(" - anvil", "")] {
        let text: String = (text.lines())
            .filter(|line| text.contains(" - m") || !line.starts_with("mass"))
            .map(|line| format!("{line}\n"))
            .collect();
        let local = problem(&text.replace("TIP", "hertz tip { stiffness = 7/3, exponent = 1 }"));
        let spring = problem(&text.replace("TIP", "spring tip { stiffness = 7/3 }"));
        for (name, time) in [("force", "1/3"), ("strain", "1")] {
            let [one, other] = [&local, &spring].map(|own| value(own, name, time, 20));
            assert_eq!(one, other, "{name} at {time}");
        }
    }
}

/// Contacts that begin, end and begin again, beside bars, masses and walls, with exponents on both sides of one.
#[test]
fn values_are_those_of_collocation() {
    let bars = "bar a { impedance = 3, travel = 5/4, velocity = 1 }\nTIP\n\
        bar b { impedance = 1, travel = 1/2 }\nline free - a - tip - b - fixed\n\
        observe force = force(tip)\nobserve compression = compression(tip)\nobserve velocity = velocity(b.left)\n\
        observe strain = velocity(a.at(1/2))";
    let wall = "mass m { mass = 2, velocity = 3 }\nTIP\nline free - m - tip - fixed\n\
        observe force = force(tip)\nobserve compression = compression(tip)\nobserve velocity = velocity(m)";
    let cases = [
        (bars, "stiffness = 40, exponent = 3/2", "3/2"),
        (bars, "stiffness = 40, exponent = 5/2", "3/4"),
        (bars, "stiffness = 3, exponent = 4/5", "3/4"),
        (WITH_MASSES, "stiffness = 4, exponent = 3/2", "3/2"),
        (wall, "stiffness = 5", "3/4"),
    ];
    for (text, law, time) in cases {
        let local = problem(&text.replace("TIP", &format!("hertz tip {{ {law} }}")));
        let proven: f64 =
            value(&local, "force", time, 15).split(' ').next().unwrap().parse().unwrap();
        let accuracy = Accuracy::Method(Method::Steps { tolerance: 1e-13 }, None);
        let exact = local.time("time", time).unwrap();
        let tested = local.doubles("force", &[exact], Limit::Right, accuracy).unwrap().values[0];
        assert!((proven - tested).abs() < 1e-11, "{law}: {proven} and {tested}");
    }
}

/// Where both bars are free the momentum is what it was; what is in the contact and in the bars is told by `events`.
#[test]
fn nothing_is_lost_between_free_bars() {
    let text = "bar a { impedance = 3, travel = 5/4, velocity = 1 }\nhertz tip { stiffness = 40 }\n\
        bar b { impedance = 1, travel = 1/2 }\nline free - a - tip - b - free";
    let history = problem(text).events(12).unwrap();
    let parted = history.events.last().unwrap();
    assert_eq!(parted.kind, wavestep::EventKind::Opening);
    let sum = |of: fn(&wavestep::Body) -> f64| parted.bodies.iter().map(of).sum::<f64>();
    let energy = sum(|body| body.energy.as_ref().unwrap().to_f64());
    let momentum = sum(|body| body.momentum.as_ref().unwrap().to_f64());
    assert!((energy - 3.75 / 2.0).abs() < 1e-11, "{energy}");
    assert!((momentum - 3.75).abs() < 1e-11, "{momentum}");
}

/// A bar that moves with the other, and one that moves away, are never pressed.
#[test]
fn what_does_not_meet_has_no_force() {
    for velocity in ["1", "2"] {
        let text = format!(
            "bar a {{ impedance = 3, travel = 5/4, velocity = 1 }}\nhertz tip {{ stiffness = 40 }}\n\
             bar b {{ impedance = 1, travel = 1/2, velocity = {velocity} }}\n\
             line free - a - tip - b - free\nobserve force = force(tip)"
        );
        assert_eq!(value(&problem(&text), "force", "2", 12), "0");
    }
}

/// `1/(1 + x)` is bounded near its cell, but its derivatives grow as factorials.
#[test]
fn rough_series_bound_values_and_derivatives() {
    let mut cut = Truncation::new(128, 0);
    cut.longest = Magnitude::power_of_two(-3);
    let roughness = Roughness::within(&Magnitude::power_of_two(-2), &cut);
    assert_eq!(roughness, Roughness::within(&Magnitude::power_of_two(-9), &cut).min(roughness));
    let norm = CellNorm::new(cut.longest, &cut).of_roughness(Some(roughness));
    let signs = (0..12).map(|k| Number::integer(if k % 2 == 0 { 1 } else { -1 }));
    // What is left out is `x^12/(1 + x)`, of which the factor is at most 2 nearby.
    let rest = norm.of_term(12, &Magnitude::from_u64(2));
    let f = Series::new(signs.collect(), rest).of_roughness(Some(roughness));
    let x = Rational::new(1.into(), 16.into());
    let inverse = (Rational::from_integer(1.into()) + &x).recip();
    let mut exact = inverse.clone();
    let mut derivative = f;
    for order in 1..4_i64 {
        let told = derivative.value(&Number::Exact(x.clone()), &cut).ball(256);
        assert!(told.contains(&exact), "{order}");
        let start: Ball = derivative.start(0, &cut).ball(256);
        assert!(start.radius().to_double().is_finite(), "{order}");
        exact = -exact * &inverse * Rational::from_integer(order.into());
        derivative = derivative.derivative(&cut);
    }
    let shifted = derivative.shift(&Number::Exact(x), &cut);
    assert_eq!((shifted.rest, shifted.roughness), (derivative.rest, derivative.roughness));
    assert!(derivative.rest.to_double().to_f64().unwrap() > 0.0);
}
