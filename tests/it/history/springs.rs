//! Springs and dampers beside contacts that open.

use crate::history::{ball, is_zero, network_of, rational, values};
use wavestep::evaluate::{Limit, Value};
use wavestep::history::{EventKind, History};
use wavestep_polynomial::Rational;

/// A mass strikes a fixed bar through a damper, and leaves it.
const DAMPED: &str = "scene \"A damper\"\nmass m { mass = 1, velocity = 1 }\n\
    spring s { damping = 1 }\nbar b { impedance = 1, travel = 1 }\nline free - m | s - b - fixed\n\
    observe c = compression(s)\nobserve F = force(s)\nobserve um = displacement(m)\n\
    observe ub = displacement(b.left)\n";

/// What a damper is compressed by is what its ends have moved; `1 − e^{−t/2}` until a wave returns, the same
/// as with closed contacts until the first opening, and constant without force from then on.
#[test]
fn a_damper_is_compressed_and_stays_so() {
    let open = network_of(&format!("{DAMPED}contacts open"), &[]);
    let told = |name, times: &[Rational]| {
        let told = values(&open, name, times, Limit::Right, 12);
        told.iter().map(ball).collect::<Vec<_>>()
    };
    let one = rational(1, 1);
    let exact = wavestep::ball::Ball::from_rational(&rational(-1, 2), 200).exp(200).unwrap();
    let sum = told("c", std::slice::from_ref(&one))[0].add(&exact, 200);
    assert!(is_zero(&sum.subtract(&wavestep::ball::Ball::from_rational(&one, 200), 200)));
    let history = History::of(&open, None, 12).unwrap();
    let opening = history.events.iter().find(|event| event.kind == EventKind::Opening).unwrap();
    let after = Rational::from_float(ball(&opening.time).rounded().unwrap()).unwrap() + &one;
    let times = [rational(4, 1), after.clone(), &after + &one];
    let compressed = told("c", &times);
    assert!(is_zero(&compressed[1].subtract(&compressed[2], 200)));
    assert!(!is_zero(&compressed[0]));
    let [um, ub] = ["um", "ub"].map(|name| told(name, &times[..1]).remove(0));
    // The end of the bar is the other end of the damper.
    assert!(is_zero(&um.subtract(&ub, 200).subtract(&compressed[0], 200)));
    let force = values(&open, "F", &times[1..], Limit::Right, 12);
    assert_eq!(force, vec![Value::Exact(rational(0, 1)); 2]);
}

/// The force of a spring with damping is exactly zero once its contact is open.
#[test]
fn a_damped_spring_is_without_force_after_an_opening() {
    let text = DAMPED.replace("{ damping = 1 }", "{ stiffness = 2, damping = 1/2 }");
    let open = network_of(&format!("{text}contacts open"), &[]);
    let history = History::of(&open, None, 12).unwrap();
    let opening = history.events.iter().find(|event| event.kind == EventKind::Opening).unwrap();
    let after = Rational::from_float(ball(&opening.time).rounded().unwrap()).unwrap();
    let times = [&after + rational(1, 100), &after + rational(1, 10)];
    let force = values(&open, "F", &times, Limit::Right, 12);
    assert_eq!(force, vec![Value::Exact(rational(0, 1)); 2]);
}

/// Both sides of a closed contact move alike: their difference is zero as far as can be told.
#[test]
fn a_difference_that_is_zero_is_told_as_that() {
    let text = "scene \"Together\"\nmass m { mass = 1, velocity = 1 }\n\
        bar b { impedance = 1, travel = 1 }\nline free - m | b - free\n\
        observe apart = displacement(b.left) - displacement(m)\ncontacts open";
    let network = network_of(text, &[]);
    let times = [rational(1, 2), rational(1, 1)];
    for value in values(&network, "apart", &times, Limit::Right, 9) {
        assert!(value.to_text(9).starts_with("0 ± "), "{value:?}");
        assert!(ball(&value).contains(&rational(0, 1)));
    }
}
