//! A node of the line with its exact numbers: what moves together, and what parts it.
//!
//! The elements between two bars, or between a bar and an end, are parted into *runs* by springs and by
//! contacts. Masses, supports and loads belong to a run.

use crate::ball::Number;
use crate::enclosure::EnclosureError;
use crate::expression::Fraction;
use crate::history::error::{HistoryError, NotFollowed};
use crate::history::load::Course;
use crate::history::moment::Clock;
use crate::network::{Layout, ModelLump, Network, Side};
use crate::scene::{Drive, ElementIndex, Joint};

/// What parts two runs.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Link {
    /// A contact, by its number in the scene.
    Contact(usize),
    /// A spring.
    Spring(Yield),
}

/// What yields: a spring or a support.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Yield {
    pub element: ElementIndex,
    pub stiffness: Number,
    pub damping: Number,
}

/// A force on a run.
pub(crate) struct Load {
    pub element: ElementIndex,
    pub run: usize,
    pub course: Course,
    pub from: Fraction,
    pub until: Option<Fraction>,
}

/// A rigid mass.
pub(crate) struct Mass {
    pub element: ElementIndex,
    pub run: usize,
    pub mass: Number,
    pub velocity: Number,
}

/// A contact of the scene.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct ContactPlace {
    /// The names of what is at its left and at its right.
    pub names: [String; 2],
    /// Its node, and the run at its left.
    pub node: usize,
    pub run: usize,
    /// The joint of the line.
    pub joint: usize,
}

/// A node.
///
/// # Invariants
/// `links[i]` is between the runs `i` and `i + 1`; there is one more run than there are links.
pub(crate) struct Node {
    pub left: Side,
    pub right: Side,
    /// The impedances at the left and at the right, zero where there is no bar.
    pub impedance: [Number; 2],
    pub masses: Vec<Mass>,
    pub held: Vec<bool>,
    pub links: Vec<Link>,
    pub supports: Vec<(usize, Yield)>,
    pub loads: Vec<Load>,
}

impl Node {
    /// How many runs there are.
    pub fn runs(&self) -> usize {
        self.links.len() + 1
    }

    /// The side that a run reaches: 0 for the left, 1 for the right; both where it is the only one.
    pub fn side_runs(&self) -> [usize; 2] {
        [0, self.links.len()]
    }

    /// Whether nothing acts on a run but the links beside it: no mass, load, support, bar or wall.
    pub fn is_bare(&self, run: usize) -> bool {
        !self.held[run]
            && self.masses.iter().all(|mass| mass.run != run)
            && self.loads.iter().all(|load| load.run != run)
            && self.supports.iter().all(|(support, _)| *support != run)
            && !self.reaches_bar(run)
    }

    /// Whether a bar begins or ends at a run.
    pub fn reaches_bar(&self, run: usize) -> bool {
        let mut sides = self.side_runs().into_iter().zip([self.left, self.right]);
        sides.any(|(end, side)| end == run && matches!(side, Side::Bar(_)))
    }

    /// The contact beside a run, at its left or at its right, with its place among those of the node.
    pub fn contact_beside(&self, run: usize, right: bool) -> Option<usize> {
        let link = if right { Some(run) } else { run.checked_sub(1) };
        let Some(Link::Contact(contact)) = link.and_then(|link| self.links.get(link)) else {
            return None;
        };
        self.contacts().position(|(own, _)| own == *contact)
    }

    /// The mass of a run.
    pub fn mass_of(&self, run: usize, bits: u64) -> Number {
        let own = self.masses.iter().filter(|mass| mass.run == run);
        own.fold(Number::zero(), |sum, mass| sum.add(&mass.mass, bits))
    }

    /// All springs and supports: the run at the left or below, and whether the next one is at the right.
    pub fn yields(&self) -> impl Iterator<Item = (usize, &Yield, bool)> {
        let springs = self.links.iter().enumerate().filter_map(|(run, link)| match link {
            Link::Spring(spring) => Some((run, spring, true)),
            Link::Contact(_) => None,
        });
        springs.chain(self.supports.iter().map(|(run, support)| (*run, support, false)))
    }

    /// The contacts with the runs at their left.
    pub fn contacts(&self) -> impl Iterator<Item = (usize, usize)> {
        self.links.iter().enumerate().filter_map(|(run, link)| match link {
            Link::Contact(contact) => Some((*contact, run)),
            Link::Spring(_) => None,
        })
    }
}

/// The nodes of a network and its contacts.
///
/// # Errors
/// [`HistoryError::Refused`] for imposed velocities; [`HistoryError::MissingValue`].
pub(crate) fn nodes(
    network: &Network,
    layout: &Layout,
    clock: &Clock,
) -> Result<(Vec<Node>, Vec<ContactPlace>), HistoryError> {
    let mut contacts = Vec::new();
    let mut nodes = Vec::new();
    for number in 0..layout.nodes.len() {
        nodes.push(node(network, layout, clock, number, &mut contacts)?);
    }
    Ok((nodes, contacts))
}

fn node(
    network: &Network,
    layout: &Layout,
    clock: &Clock,
    number: usize,
    contacts: &mut Vec<ContactPlace>,
) -> Result<Node, HistoryError> {
    let (scene, model) = (network.scene(), network.model());
    let own = &layout.nodes[number];
    let line = &scene.line;
    let position = |element| line.elements.iter().position(|other| *other == element);
    let first = match own.left {
        Side::Bar(bar) => position(layout.bars[bar]).expect("a bar of the line") + 1,
        _ => 0,
    };
    let name = |joint: usize| -> [String; 2] {
        let at = |place: Option<usize>| match place.and_then(|place| line.elements.get(place)) {
            Some(element) => scene.elements[*element].name.clone(),
            None => "wall".to_owned(),
        };
        [at(joint.checked_sub(1)), at(Some(joint))]
    };
    let mut node = Node {
        left: own.left,
        right: own.right,
        impedance: [Number::zero(), Number::zero()],
        masses: Vec::new(),
        held: vec![own.left == Side::Fixed],
        links: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    };
    for place in 0..=own.elements.len() {
        let joint = first + place;
        if line.joints[joint] == Joint::Contact {
            let run = node.links.len();
            let names = name(joint);
            node.links.push(Link::Contact(contacts.len()));
            node.held.push(false);
            contacts.push(ContactPlace { names, node: number, run, joint });
        }
        let Some(element) = own.elements.get(place).copied() else { continue };
        let run = node.links.len();
        let value = |value: &Fraction| clock.number(value);
        let yields = |stiffness: &Fraction, damping: &Fraction| -> Result<Yield, EnclosureError> {
            Ok(Yield { element, stiffness: value(stiffness)?, damping: value(damping)? })
        };
        match &model.lumps[&element] {
            ModelLump::Mass(mass, velocity) => {
                let (mass, velocity) = (value(mass)?, value(velocity)?);
                node.masses.push(Mass { element, run, mass, velocity });
            }
            ModelLump::Spring(stiffness, damping) => {
                node.links.push(Link::Spring(yields(stiffness, damping)?));
                node.held.push(false);
            }
            ModelLump::Support(stiffness, damping) => {
                node.supports.push((run, yields(stiffness, damping)?));
            }
            ModelLump::Load(Drive::Force, course, from, until) => {
                let course = Course::of(&clock.numbers, course, &scene.time, clock.bits)?;
                let (from, until) = (from.clone(), until.clone());
                node.loads.push(Load { element, run, course, from, until });
            }
            ModelLump::Hertz(..) => {
                let name = &scene.elements[element].name;
                return Err(NotFollowed::LocalContact(name.clone()).into());
            }
            ModelLump::Load(Drive::Velocity, ..) => {
                let name = &scene.elements[element].name;
                return Err(NotFollowed::ImposedVelocity(name.clone()).into());
            }
        }
    }
    if own.right == Side::Fixed {
        *node.held.last_mut().expect("a run") = true;
    }
    for (side, place) in [(own.left, 0), (own.right, 1)] {
        if let Side::Bar(bar) = side {
            node.impedance[place] = clock.number(&model.bars[&layout.bars[bar]].impedance)?;
        }
    }
    Ok(node)
}
