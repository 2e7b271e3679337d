//! Until when a form with closed contacts is valid, in words.

use wavestep::problem::{Holds, Pressed, Problem, Pulls};
use wavestep::signal::Value;
use wavestep_polynomial::Rational;

/// Significant digits of the instant until which a form holds.
const DIGITS: usize = 12;

/// Until when the form with closed contacts is true that was derived.
pub fn derivation(problem: &Problem) -> Option<String> {
    Some(match problem.holds(DIGITS)? {
        Holds::UntilTheyPart(time, [left, right]) => {
            format!("valid until t = {}, when {left} and {right} separate", text(problem, &time))
        }
        Holds::UntilItPulls(time, [left, right]) => format!(
            "valid until t = {}, when the contact between {left} and {right} goes into tension",
            text(problem, &time)
        ),
        Holds::AtLeastUntil(time) => format!(
            "valid at least until t = {}: no contact goes into tension before",
            text(problem, &time)
        ),
        Holds::AsLongAs(contacts) => {
            let condition = |Pressed { force, between: [left, right] }: &Pressed| {
                let force = force.as_deref().unwrap_or("the force");
                format!("{force} >= 0 at the contact between {left} and {right}")
            };
            let conditions: Vec<String> = contacts.iter().map(condition).collect();
            format!("valid as long as {}", conditions.join(" and "))
        }
    })
}

/// That a contact would pull before a time, when that is found quickly.
pub fn pulling(problem: &Problem, last: &Rational) -> Option<String> {
    Some(match problem.pulls(last, DIGITS)? {
        Pulls::From(time, [left, right]) => format!(
            "from t = {} on, the contact between {left} and {right} is in tension; add `contacts open` and it \
             opens instead",
            text(problem, &time)
        ),
        Pulls::NotKnownFrom(time) => format!(
            "no contact goes into tension before t = {}; later times were not checked: `contacts open` follows contacts that open",
            text(problem, &time)
        ),
    })
}

fn text(problem: &Problem, time: &Value) -> String {
    time.to_text(DIGITS) + if problem.has_units() { " s" } else { "" }
}
