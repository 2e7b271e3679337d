//! What contacts do, and how long forms with closed contacts are true.

use super::{Kind, Problem, ProblemError};
use crate::history::{History, Validity};
use crate::network::Network;
use crate::scene::{Joint, Kind as ElementKind, Scene};
use crate::signal::Value;
use wavestep_polynomial::Rational;

/// How many cells are followed beside a derivation.
const CELLS: usize = 500;

/// How many cells are followed beside a search, which is not to wait for it.
const FEW_CELLS: usize = 200;

/// How long forms with closed contacts are true.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Holds {
    /// Until these two part.
    UntilTheyPart(Value, [String; 2]),
    /// Until the contact between these two would pull.
    UntilItPulls(Value, [String; 2]),
    /// Until this time at least.
    AtLeastUntil(Value),
    /// As long as these contacts are pressed.
    AsLongAs(Vec<Pressed>),
}

impl Holds {
    /// Whether it holds at no time at all.
    pub fn never(&self) -> bool {
        let zero = Value::Exact(Rational::default());
        matches!(self, Holds::UntilTheyPart(time, _) | Holds::UntilItPulls(time, _) if *time == zero)
    }
}

/// Whether a contact that stays closed would pull.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Pulls {
    /// From this time on, the one between these two.
    From(Value, [String; 2]),
    /// None does before this time; what comes later takes longer to know.
    NotKnownFrom(Value),
}

/// A contact that has to be pressed.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Pressed {
    /// Its force as a scene states it, where a bar or a spring is beside it.
    pub force: Option<String>,
    /// What is at its left and right.
    pub between: [String; 2],
}

#[doc(hidden)]
impl Problem {
    /// What contacts do until a time; without one until nothing can meet again, at most for a hundred of
    /// the longest travel times.
    pub fn history(
        &self,
        until: Option<&Rational>,
        digits: usize,
    ) -> Result<History, ProblemError> {
        match (&self.kind, self.with_contacts()) {
            (Kind::Line { network, .. }, _) if network.local_contact().is_some() => {
                Ok(History::of(network, until, digits)?)
            }
            (_, Some(network)) => Ok(History::of(network, until, digits)?),
            (_, None) => Ok(History::without_contacts()),
        }
    }

    /// What the answers so far took for granted, because no precision decides it.
    pub fn assumptions(&self) -> Vec<String> {
        match &self.kind {
            Kind::Line { network, .. } => network.assumed.all(),
            _ => Vec::new(),
        }
    }

    /// How long forms with closed contacts are true; `None` where there are no contacts, or no such forms.
    pub fn holds(&self, digits: usize) -> Option<Holds> {
        let network = self.with_contacts().filter(|network| network.all_linear().is_ok())?;
        Some(match Validity::of(network, None, digits, CELLS) {
            Ok(Validity::Until { time, between }) => match self.has_periods() {
                true => Holds::UntilItPulls(time, between),
                false => Holds::UntilTheyPart(time, between),
            },
            Ok(Validity::Followed(time)) => Holds::AtLeastUntil(time),
            Err(_) => Holds::AsLongAs(pressed(network.scene())),
        })
    }

    /// Whether a contact that stays closed would pull before a time, as far as that is soon known; `None` where none does.
    pub fn pulls(&self, before: &Rational, digits: usize) -> Option<Pulls> {
        let network = self.with_contacts().filter(|_| self.has_periods())?;
        match Validity::of(network, Some(before), digits, FEW_CELLS) {
            Ok(Validity::Until { time, between }) => Some(Pulls::From(time, between)),
            Ok(Validity::Followed(time)) => {
                let [_, until] = time.bounds();
                (until < *before).then_some(Pulls::NotKnownFrom(time))
            }
            Err(_) => None,
        }
    }

    fn with_contacts(&self) -> Option<&Network> {
        let Kind::Line { network, .. } = &self.kind else { return None };
        network.scene().line.joints.contains(&Joint::Contact).then_some(network)
    }
}

/// The contacts of a scene, with the forces of bars or springs beside them.
fn pressed(scene: &Scene) -> Vec<Pressed> {
    let line = &scene.line;
    let contacts = line.joints.iter().enumerate().filter(|(_, joint)| **joint == Joint::Contact);
    let pressed = |(joint, _): (usize, &Joint)| {
        let left = joint.checked_sub(1).map(|place| &scene.elements[line.elements[place]]);
        let right = line.elements.get(joint).map(|place| &scene.elements[*place]);
        let force = [(left, "right"), (right, "left")].into_iter().find_map(|(element, end)| {
            let element = element?;
            match element.kind {
                ElementKind::Bar(_) => Some(format!("force({}.{end})", element.name)),
                ElementKind::Spring(_) => Some(format!("force({})", element.name)),
                _ => None,
            }
        });
        Pressed { force, between: scene.names_beside(joint) }
    };
    contacts.map(pressed).collect()
}
