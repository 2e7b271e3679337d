//! How long the form with closed contacts is true, compared with that form itself and with histories.

use crate::history::{SHIPPED, ball, is_zero, network_of, rational, shipped};
use std::cmp::Ordering;
use wavestep::ball::Ball;
use wavestep::history::{EventKind, History, HistoryError, Validity};
use wavestep::network::Network;
use wavestep::signal::{ClosedSignal, Limit, Value, digits};
use wavestep_polynomial::Rational;

const CELLS: usize = 2_000;

fn until(network: &Network) -> (Value, [String; 2]) {
    match Validity::of(network, None, 20, CELLS).unwrap() {
        Validity::Until { time, between } => (time, between),
        Validity::Followed(time) => panic!("followed until {}", time.to_text(9)),
    }
}

/// The sign of an observable of closed contacts.
fn sign(network: &Network, name: &str, time: &Rational, side: Limit) -> Ordering {
    let observed = network.observables().iter().find(|own| own.name == name).unwrap();
    let signal = ClosedSignal::of_scene(network, observed, [time, time]).unwrap();
    match digits(&signal.echo_by_echo(), time, side, 9, 1 << 12).unwrap() {
        Value::Exact(value) => value.cmp(&Rational::default()),
        other => other.decimal(9).0.to_rational().cmp(&Rational::default()),
    }
}

/// In the closed form itself the force is positive before that instant and negative after it.
#[test]
fn the_closed_form_pulls_from_then_on() {
    let scene = wavestep::scenes::find("saint-venant").unwrap().text;
    let closed = scene.replace("contacts open\n", "observe force = force(rod.left)\n");
    for mu in ["1/2", "1", "3"] {
        let network = network_of(&closed, &[("mu", mu)]);
        let (time, between) = until(&network);
        assert_eq!(between, ["hammer", "rod"]);
        let Value::Certified { decimal, .. } = time else { panic!("no rational") };
        let (time, near) = (decimal.to_rational(), rational(1, 1_000_000));
        for step in 1..=20 {
            let before = &time * rational(step, 20) - &near;
            assert_eq!(sign(&network, "force", &before, Limit::Right), Ordering::Greater, "{mu}");
        }
        assert_eq!(sign(&network, "force", &(time + near), Limit::Right), Ordering::Less, "{mu}");
    }
}

/// 3 + e^(−2)/2, whether the scene lets contacts open or not.
#[test]
fn a_known_instant_is_met() {
    let scene = wavestep::scenes::find("saint-venant").unwrap().text;
    let power = Ball::from_rational(&rational(-2, 1), 300).exp(300).unwrap();
    let half = power.multiply_rational(&rational(1, 2), 300);
    let exact = half.add(&Ball::from_rational(&rational(3, 1), 300), 300);
    for text in [scene.to_owned(), scene.replace("contacts open\n", "")] {
        let (time, _) = until(&network_of(&text, &[("mu", "1")]));
        assert!(is_zero(&ball(&time).subtract(&exact, 300)));
    }
}

/// Equal bars: the force is zero from 2 on, and pulls when the tension of the free end comes at 4. A history
/// says of such a contact that it touches without force from 2 on, and separates at 4.
#[test]
fn what_has_no_force_does_not_pull() {
    let text = "scene \"A\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
                bar b { impedance = 1, travel = 2 }\nline free - a | b - free\n\
                observe force = force(b.left)\n";
    let network = network_of(text, &[]);
    assert_eq!(until(&network), (Value::Exact(rational(4, 1)), ["a".into(), "b".into()]));
    let forces = [(1, 1), (3, 1), (9, 2)]
        .map(|(above, below)| sign(&network, "force", &rational(above, below), Limit::Right));
    assert_eq!(forces, [Ordering::Greater, Ordering::Equal, Ordering::Less]);
    let history = History::of(&network, None, 12).unwrap();
    let time = |kind: EventKind| {
        let mut events = history.events.iter().filter(|event| event.kind == kind);
        events.next().unwrap().time.to_text(9)
    };
    assert_eq!([EventKind::Release, EventKind::Opening].map(time), ["2", "4"]);
    // What is left of the impulse and of the time it was closed ends with the force.
    assert_eq!(history.contacts[0].durations[0].as_ref().unwrap().to_text(9), "2");
}

/// Of several contacts the first that would pull counts, though another node is followed further before.
#[test]
fn the_first_of_several_contacts_counts() {
    for (first, second, expected) in
        [("travel = 1", "travel = 5", "2"), ("travel = 3", "travel = 1/2", "6")]
    {
        let text = format!(
            "scene \"A\"\nbar a {{ impedance = 1/2, {first}, velocity = 1 }}\n\
             bar b {{ impedance = 1, travel = 1/7 }}\nbar c {{ impedance = 1, {second} }}\n\
             line free - a - b | c | fixed\n"
        );
        let network = network_of(&text, &[]);
        let (time, between) = until(&network);
        let history = History::of(&network, None, 20).unwrap();
        let mut openings = history.events.iter().filter(|event| event.kind == EventKind::Opening);
        let opening = openings.next().unwrap();
        assert_eq!((&time, &between), (&opening.time, &opening.between), "{expected}");
        assert!(openings.next().is_some(), "several contacts open");
    }
}

/// Two nodes whose contacts open one soon after the other within a cell: whichever is followed first.
#[test]
fn an_earlier_opening_that_is_found_later_counts() {
    for masses in [["1", "99/100"], ["99/100", "1"]] {
        let [left, right] = masses;
        let text = format!(
            "scene \"A\"\nmass a {{ mass = {left}, velocity = 1 }}\n\
             bar rod {{ impedance = 1, travel = 2 }}\nmass b {{ mass = {right}, velocity = -1 }}\n\
             line free - a | rod | b - free\n"
        );
        let network = network_of(&text, &[]);
        let (time, between) = until(&network);
        let history = History::of(&network, Some(&rational(4, 1)), 20).unwrap();
        let mut openings = history.events.iter().filter(|event| event.kind == EventKind::Opening);
        let (first, second) = (openings.next().unwrap(), openings.next().unwrap());
        assert_ne!(first.contact, second.contact);
        assert_eq!((time, between), (first.time.clone(), first.between.clone()), "{masses:?}");
    }
}

/// In the shipped scenes the first opening is that of the history.
#[test]
fn the_first_opening_is_that_of_the_history() {
    for (name, values) in SHIPPED {
        let network = shipped(name, values);
        let history = History::of(&network, None, 20).unwrap();
        let opening = history.events.iter().find(|event| event.kind == EventKind::Opening);
        match (Validity::of(&network, None, 20, CELLS).unwrap(), opening) {
            (Validity::Until { time, between }, Some(opening)) => {
                assert_eq!(between, opening.between, "{name}");
                assert!(is_zero(&ball(&time).subtract(&ball(&opening.time), 300)), "{name}");
            }
            (Validity::Followed(_), None) => {}
            (told, opening) => panic!("{name}: {told:?}, {opening:?}"),
        }
    }
}

#[test]
fn limits_are_kept() {
    let network = shipped("saint-venant", &[("mu", "1")]);
    let exactly = |time: i64| Validity::Followed(Value::Exact(rational(time, 1)));
    assert_eq!(Validity::of(&network, Some(&rational(3, 1)), 12, CELLS), Ok(exactly(3)));
    assert_eq!(Validity::of(&network, None, 12, 0), Ok(exactly(0)));
    // Too few cells to get there: nothing is said of what comes later.
    let Ok(Validity::Followed(Value::Exact(time))) = Validity::of(&network, None, 12, 4) else {
        panic!("4 cells")
    };
    assert!(time > rational(0, 1) && time < rational(3, 1), "{time}");
    assert!(matches!(Validity::of(&network, None, 12, CELLS), Ok(Validity::Until { .. })));
    let error = Validity::of(&shipped("saint-venant", &[]), None, 12, CELLS);
    assert!(matches!(error, Err(HistoryError::MissingValue(_))));
}
