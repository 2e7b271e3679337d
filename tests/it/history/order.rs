//! Nodes are followed in the order of time, however near their instants are.

use super::network_of;
use wavestep::history::History;
use wavestep::language::parse_number;
use wavestep_polynomial::Rational;

/// Doubles see no difference between instants of a bar this short: the order of nodes is exact. What
/// arrives at a node that is followed too early is not known yet.
#[test]
fn nodes_are_followed_in_order_where_doubles_see_none() {
    for travel in ["1e-401", "1e-30"] {
        let text = format!(
            "scene \"A\"\nbar a {{ impedance = 1, travel = {travel}, velocity = 1 }}\n\
             mass m {{ mass = 1/2 }}\nbar b {{ impedance = 2, travel = 3/2 }}\n\
             bar c {{ impedance = 1, travel = 1 }}\nline free - a | m - b | c - free\n\
             contacts open\nobserve v = velocity(m)"
        );
        let network = network_of(&text, &[]);
        let until = parse_number(travel).unwrap() * Rational::from_integer(30.into());
        assert!(History::of(&network, Some(&until), 15).is_ok(), "{travel}");
    }
}

/// With both contacts open the damper would be left behind, with the left one open it is pushed: what opens and closes while
/// others settle has done neither.
#[test]
fn a_contact_that_settles_at_one_instant_has_one_event() {
    let text = "scene \"Settling\"
bar a { impedance = 1, velocity = -10 }
support s { damping = 1 }
bar b { impedance = 1, velocity = -1 }
line endless - a | s | b - endless
contacts open";
    let history = wavestep::Problem::read("settling.wave", text).unwrap();
    let history = history.events_until(3, 12).unwrap();
    let told: Vec<_> = history.events.iter().map(|own| (own.contact, own.kind)).collect();
    assert_eq!(told, [(0, wavestep::EventKind::Opening), (1, wavestep::EventKind::Impact)]);
    // The damper moves with half the velocity of the bar.
    assert_eq!(history.events[1].forces[1].to_text(3), "0.5 = 1/2");
    assert_eq!(history.events[1].velocities[1][0].to_text(3), "-0.5 = -1/2");
    assert_eq!(history.contacts[1].impulses[0].to_text(3), "1.5 = 3/2");
}
