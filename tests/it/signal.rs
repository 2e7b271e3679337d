//! Signals against values of scenes, which are had in another way.
//!
//! A signal is enclosed from pieces of waves, or from the echoes that have arrived; a scene's value
//! from its echoes one by one, exactly where it is rational.

use num_traits::Signed as _;
use std::collections::BTreeMap;
use wavestep::Method;
use wavestep::language::parse_number;
use wavestep::network::Network;
use wavestep::planner::{Origin, Purpose, Together, origin};
use wavestep::problem::Problem;
use wavestep::scenes::SCENES;
use wavestep::signal::{At, ClosedSignal, EvaluateError, Limit, Signal as _, digits};
use wavestep_polynomial::Rational;

/// The shipped linear scenes with numbers for their symbols.
fn networks() -> impl Iterator<Item = (&'static str, Network)> {
    SCENES.iter().filter_map(|scene| {
        let third = parse_number("4/3").unwrap();
        let values = ["mu", "r", "m"].map(|name| (name.to_owned(), third.clone()));
        let named = |name: &str| scene.text.contains(&format!("symbol {name} "));
        let values: BTreeMap<_, _> = values.into_iter().filter(|(name, _)| named(name)).collect();
        let problem = Problem::of_text(scene.name, scene.text, &values).unwrap();
        // A local contact has no closed form.
        let network = problem.network().ok().filter(|network| network.local_contact().is_none())?;
        Some((scene.name, network.clone()))
    })
}

/// Scenes whose contacts stay closed, followed all the same: the two sources share neither the law of a node nor a
/// series.
#[test]
fn closed_scenes_that_are_followed_have_the_values_of_their_closed_forms() {
    let mut compared = 0;
    for (name, network) in networks() {
        let unit =
            Rational::new(1.into(), if network.scene().dimensional { 5000 } else { 1 }.into());
        if network.scene().contacts_open {
            continue;
        }
        let last = &unit * Rational::from_integer(5.into());
        for observed in network.observables() {
            let purpose = Purpose::Values { digits: 20 };
            let [closed, followed] = [Origin::Closed, Origin::Followed].map(|origin| {
                let window = [&Rational::default(), &last];
                Together::new(&network, &[observed], window, purpose)
                    .of_origin(origin, observed)
                    .unwrap()
            });
            for i in [1, 38, 79] {
                let at = &last * Rational::new(i.into(), 80.into());
                let [one, other] = [&closed, &followed].map(|signal| {
                    digits(&**signal, &at, Limit::Right, 20, 1 << 12).unwrap().to_text(20)
                });
                let place = format!("{name} {} {at}", observed.name);
                assert!(is_same(&one, &other), "{place}: {one} and {other}");
                compared += 1;
            }
        }
    }
    assert!(compared > 150, "{compared}");
}

/// Whether two values are told alike; one of them may be known exactly.
fn is_same(one: &str, other: &str) -> bool {
    let number = |text: &str| parse_number(text.split(' ').next().unwrap()).unwrap();
    let (one, other) = (number(one), number(other));
    (&one - &other).abs() <= one.abs() * Rational::new(1.into(), 10_i64.pow(18).into())
}

/// From where following is cheaper on both sources give the same digits.
#[test]
fn late_values_of_closed_scenes_are_followed() {
    for (name, observable, at) in [
        ("mass-on-fixed-bar", "velocity", Rational::from_integer(1600.into())),
        ("hopkinson", "force", Rational::new(3.into(), 20.into())),
    ] {
        let (_, network) = networks().find(|(own, _)| *own == name).unwrap();
        let observed = network.observables().iter().find(|own| own.name == observable).unwrap();
        let window = [&at, &at];
        let few = Purpose::Values { digits: 20 };
        assert_eq!(origin(&network, &at, few), Origin::Followed, "{name}");
        for purpose in [Purpose::Values { digits: 500 }, Purpose::Stretches, Purpose::Echoes] {
            assert_eq!(origin(&network, &at, purpose), Origin::Closed, "{name}");
        }
        for purpose in [Purpose::Polynomials, Purpose::Search] {
            assert_eq!(origin(&network, &at, purpose), Origin::Followed, "{name}");
        }
        let together = [observed];
        let together = Together::new(&network, &together, window, few);
        let told = [Origin::Followed, Origin::Closed]
            .map(|origin| together.of_origin(origin, observed).unwrap())
            .map(|signal| digits(&*signal, &at, Limit::Right, 20, 1 << 12).unwrap().to_text(20));
        assert_eq!(told[0], told[1], "{name}");
    }
}

/// Both enclose the same number, to forty bits at least.
#[test]
fn signals_enclose_the_values_of_scenes() {
    let mut compared = 0;
    let fine = Rational::new(1.into(), (1_i64 << 40).into());
    for (name, network) in networks() {
        let unit =
            Rational::new(1.into(), if network.scene().dimensional { 5000 } else { 1 }.into());
        let last = &unit * Rational::from_integer(7.into());
        for observed in network.observables() {
            let exact = ClosedSignal::of_scene(&network, observed, [&Rational::default(), &last]);
            let exact = match exact {
                Err(EvaluateError::NotLinear) => continue,
                exact => exact.unwrap().echo_by_echo(),
            };
            for i in 0..12 {
                let at = &last * Rational::new((7 * i + 1).into(), 80.into());
                let stretch = exact.stretch_at(&at, Limit::Right).unwrap().unwrap();
                let value = exact.enclose(stretch, 0, At::Time(&at), 200).unwrap();
                let told = digits(&exact, &at, Limit::Right, 30, 1 << 12).unwrap();
                let told = told.ball(300);
                let place = format!("{name} {} {at}", observed.name);
                assert!(value.subtract(&told, 200).contains(&Rational::default()), "{place}");
                // An enclosure that is wide would agree with anything.
                let decimals = value.to_decimal(100);
                let radius = decimals.radius().to_rational();
                let size = decimals.midpoint().to_rational().abs().max(fine.clone());
                assert!(radius <= size * &fine, "{place} {value}");
                compared += 1;
            }
        }
    }
    assert!(compared > 300, "{compared}");
}

/// A mass on an endless bar: `e^(−2t)`, one function at all times, however long the window is. Beyond a bar between two
/// endless ones a single wave comes. A load that begins and ends comes twice.
#[test]
fn without_returns_little_arrives() {
    let mass = "scene \"No return\"\nmass m { mass = 1, velocity = 1 }\nbar b { impedance = 2 }\n\
        line free - m - b - endless\nobserve v = velocity(m)";
    let passing = "scene \"Passing\"\nbar a { impedance = 2 }\nmass m { mass = 1, velocity = 1 }\n\
        bar c { impedance = 1, travel = 1 }\nbar b { impedance = 1 }\n\
        line endless - a - m - c - b - endless\nobserve v = velocity(b.left)";
    let late = "scene \"Late\"\nbar a { impedance = 1 }\nmass m { mass = 3 }\n\
        load p { force = 6, from = 2, until = 3 }\nbar b { impedance = 2 }\n\
        line endless - a - m - p - b - endless\nobserve v = velocity(m)";
    let pushed = |t: f64| match t {
        ..2.0 => 0.0,
        ..3.0 => 2.0 - 2.0 * f64::exp(2.0 - t),
        _ => (2.0 - 2.0 * f64::exp(-1.0)) * f64::exp(3.0 - t),
    };
    let cases: [(_, _, _, &dyn Fn(f64) -> f64); 3] = [
        (mass, 0, 2.0, &|t| f64::exp(-2.0 * t)),
        (passing, 1, 3.0, &|t| if t < 1.0 { 0.0 } else { f64::exp(-3.0 * (t - 1.0)) }),
        (late, 2, 1.0, &pushed),
    ];
    for (text, arrivals, rate, expected) in cases {
        let problem = Problem::read("no-return.wave", text).unwrap();
        let network = problem.network().unwrap();
        let (wanted, from) = (&network.observables()[0], Rational::default());
        for to in [7, 1_000_000] {
            let to = Rational::from_integer(to.into());
            let signal = ClosedSignal::of_scene(network, wanted, [&from, &to]).unwrap();
            assert_eq!(signal.count().unwrap(), 1 + arrivals, "{text}");
        }
        let (signal, times) = (problem.signal("v").unwrap(), [0.5, 2.0, 2.5, 3.0, 5.0, 7.0]);
        let compiled = signal.values_by(&times, Method::Compiled).unwrap().values;
        for (time, value) in times.into_iter().zip(compiled) {
            let expected = expected(time);
            assert!((value - expected).abs() < 2e-15, "{time}: {value} {expected}");
            let digits = signal.at(time, 15).unwrap().to_f64();
            assert!((digits - expected).abs() < 2e-15, "{time}: {digits} {expected}");
        }
        // Long after the last arrival all digits are told.
        let [late, later] = [100, 101].map(|time| signal.at(time, 15).unwrap().to_f64());
        assert!(((later / late).ln() + rate).abs() < 1e-12, "{text}: {late} {later}");
    }
}
