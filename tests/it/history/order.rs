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
