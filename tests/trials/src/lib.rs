//! Trials: random scenes and recurrences, each computed in all ways that there are, and by solvers in plain doubles that
//! share nothing with them. A trial is told by its number, from which all of it is drawn.

#![allow(missing_docs, reason = "for the tests of this repository alone")]

pub mod events;
pub mod print;

mod chance;
mod compare;
mod curve;
mod line;
mod node;
mod observe;
mod recurrence;
mod scene;
mod solver;

use chance::Chance;
use std::collections::BTreeMap;

/// What is compared, in the order of [`Tally::compared`].
pub const CHECKS: [&str; 9] =
    ["digits", "doubles", "marched", "solver", "energy", "momentum", "text", "events", "formulas"];

/// The places of checks.
const DIGITS: usize = 0;
const DOUBLES: usize = 1;
const MARCHED: usize = 2;
const SOLVER: usize = 3;
const ENERGY: usize = 4;
const MOMENTUM: usize = 5;
const TEXT: usize = 6;
pub const EVENTS: usize = 7;
const FORMULAS: usize = 8;

/// How much was compared, and what was refused.
#[derive(Clone, Default, Debug)]
pub struct Tally {
    pub compared: [usize; CHECKS.len()],
    /// Errors, with their numbers left out.
    pub refused: BTreeMap<String, usize>,
    /// Scenes whose events doubles do not tell to the end.
    pub untold: usize,
}

impl Tally {
    pub fn add(&mut self, other: &Tally) {
        self.compared.iter_mut().zip(other.compared).for_each(|(sum, own)| *sum += own);
        for (error, count) in &other.refused {
            *self.refused.entry(error.clone()).or_default() += count;
        }
        self.untold += other.untold;
    }

    fn refuse(&mut self, what: &str, error: &dyn std::fmt::Display) {
        let text = without_numbers(&error.to_string());
        *self.refused.entry(format!("{what}: {text}")).or_default() += 1;
    }
}

/// The first line of a message, each number in it as `#`.
pub fn without_numbers(text: &str) -> String {
    let mut plain = String::new();
    for own in text.lines().next().unwrap_or_default().chars() {
        let own = if own.is_ascii_digit() { '#' } else { own };
        if own != '#' || !plain.ends_with('#') {
            plain.push(own);
        }
    }
    plain
}

/// What became of a trial.
#[derive(Debug)]
pub enum Verdict {
    /// It is no scene, for this reason.
    Senseless(String),
    Agrees(Tally),
    Wrong(String),
}

/// Kinds of texts, each with its share of a hundred.
pub const KINDS: [(&str, usize); 7] = [
    ("commensurable", 33),
    ("with units", 18),
    ("with symbols", 12),
    ("incommensurable", 12),
    ("stated recurrence", 20),
    ("contacts open", 4),
    ("open, with units", 1),
];

/// A scene or a recurrence to be compared.
pub struct Trial {
    /// Its place in [`KINDS`].
    pub kind: usize,
    pub text: String,
    subject: Subject,
    chance: Chance,
}

enum Subject {
    Line(scene::Scene),
    Recurrence(recurrence::Stated),
}

impl Trial {
    /// The trial of a number.
    pub fn new(number: u64) -> Trial {
        let mut chance = Chance::of(number);
        let mut share = chance.below(100);
        let kind = KINDS.iter().position(|(_, own)| {
            let is_own = share < *own;
            share = share.saturating_sub(*own);
            is_own
        });
        let kind = kind.expect("shares of a hundred");
        let subject = match KINDS[kind].0 {
            "stated recurrence" => Subject::Recurrence(recurrence::Stated::draw(&mut chance)),
            "contacts open" => Subject::Line(chance.open_scene()),
            "open, with units" => {
                let scene = chance.open_scene();
                Subject::Line(chance.in_units(scene))
            }
            name => {
                let scene = chance.closed_scene();
                Subject::Line(match name {
                    "with units" => {
                        let is_mixed = chance.is(4);
                        let scene = if is_mixed { chance.without_measure(scene) } else { scene };
                        chance.in_units(scene)
                    }
                    "with symbols" => chance.with_symbols(scene),
                    "incommensurable" => chance.without_measure(scene),
                    _ => scene,
                })
            }
        };
        let text = match &subject {
            Subject::Line(scene) => scene.text(),
            Subject::Recurrence(stated) => stated.text(),
        };
        Trial { kind, text, subject, chance }
    }

    /// Computes it in all ways.
    pub fn run(mut self) -> Verdict {
        match &self.subject {
            Subject::Line(scene) => line::compare(scene, &mut self.chance, line::QUICK),
            Subject::Recurrence(stated) => stated.compare(&mut self.chance),
        }
    }
}

/// A random scene whose contacts open, by its number, and its comparison through thirty periods of the longest bar or so
/// many events.
pub fn random_scene(number: u64, events: usize) -> (String, Verdict) {
    let mut chance = Chance::of(number);
    let scene = chance.open_scene();
    let verdict = line::compare(&scene, &mut chance, line::Length { periods: 30, events });
    (scene.text(), verdict)
}
