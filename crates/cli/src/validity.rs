//! How long a form with closed contacts is true, as a note on standard error.

use num_rational::BigRational;
use std::fmt::Write as _;
use wavestep::history::Validity;
use wavestep::network::Network;
use wavestep::scene::{Joint, Kind, Scene};

/// Significant digits of the instant until which a form holds.
const DIGITS: usize = 12;

/// How many cells are followed beside a derivation.
const CELLS: usize = 500;

/// How many cells are followed beside a search, which is not to wait for it.
const FEW_CELLS: usize = 200;

/// Says until when the form with closed contacts is true that was derived.
pub fn note_derivation(network: &Network) {
    let scene = network.scene();
    if !scene.line.joints.contains(&Joint::Contact) {
        return;
    }
    let note = match Validity::of(network, None, DIGITS, CELLS) {
        Ok(Validity::Until { time, between: [left, right] }) => {
            let time = with_unit(scene, time.to_text(DIGITS));
            match scene.contacts_open {
                true => format!("this holds until t = {time}, when {left} and {right} part"),
                false => format!(
                    "this holds until t = {time}, when the contact between {left} and {right} would pull"
                ),
            }
        }
        Ok(Validity::Followed(time)) => {
            let time = with_unit(scene, time.to_text(DIGITS));
            format!("this holds until t = {time} at least: no contact would pull before")
        }
        Err(_) => condition(scene),
    };
    eprintln!("note: {note}");
}

/// Says that a search until this time goes beyond the form with closed contacts, where that is soon known.
pub fn note_search(network: &Network, last: &BigRational) {
    let scene = network.scene();
    if scene.contacts_open || !scene.line.joints.contains(&Joint::Contact) {
        return;
    }
    if let Ok(Validity::Until { time, between: [left, right] }) =
        Validity::of(network, Some(last), DIGITS, FEW_CELLS)
    {
        let time = with_unit(scene, time.to_text(DIGITS));
        eprintln!(
            "note: from t = {time} on the contact between {left} and {right} would pull; with `contacts open` \
             it opens then"
        );
    }
}

fn with_unit(scene: &Scene, mut time: String) -> String {
    if scene.dimensional {
        time.push_str(" s");
    }
    time
}

/// What must be so, in forces of the scene where bars or springs are beside the contacts.
fn condition(scene: &Scene) -> String {
    let line = &scene.line;
    let mut told = String::from("this is valid as long as ");
    let contacts = line.joints.iter().enumerate().filter(|(_, joint)| **joint == Joint::Contact);
    for (count, (joint, _)) in contacts.enumerate() {
        let left = joint.checked_sub(1).map(|place| &scene.elements[line.elements[place]]);
        let right = line.elements.get(joint).map(|place| &scene.elements[*place]);
        let force = [(left, "right"), (right, "left")].into_iter().find_map(|(element, end)| {
            let element = element?;
            match element.kind {
                Kind::Bar(_) => Some(format!("force({}.{end})", element.name)),
                Kind::Spring(_) => Some(format!("force({})", element.name)),
                _ => None,
            }
        });
        let name = |element: Option<&wavestep::scene::Element>| {
            element.map_or("wall", |element| element.name.as_str()).to_owned()
        };
        if count > 0 {
            told.push_str(" and ");
        }
        let force = force.unwrap_or_else(|| "the force".to_owned());
        let _ =
            write!(told, "{force} >= 0 at the contact between {} and {}", name(left), name(right));
    }
    told
}
