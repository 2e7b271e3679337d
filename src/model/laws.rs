//! The laws of a node, one for each choice of the contacts in it that are closed.

use crate::enclosure::Numbers;
use crate::expression::Fraction;
use crate::limits::MAX_CONTACTS;
use crate::model::collocation::Pressing;
use crate::model::course::double_of;
use crate::model::error::{ModelError, NotRepresented};
use crate::model::line::{Line, LocalContact};
use crate::model::steps::NAME;
use crate::network::{Link, Node, System, Unresisted};

/// The precision of laws before they are rounded to doubles.
const BITS: u64 = 128;

/// What counts as no difference of velocities, as a share of the largest.
const NO_DIFFERENCE: f64 = 1e-9;

/// A node with some of its contacts closed.
#[derive(Clone, Debug)]
pub struct Law {
    pub system: System<f64>,
    /// The local contacts, which press or not as their compression is.
    pub pressing: Vec<Pressing>,
    /// What is large for each state: displacements in a unit of time, in local contacts in the time in which these
    /// are pressed together.
    pub scales: Vec<f64>,
}

/// The laws of a node.
#[derive(Clone, Debug)]
pub struct Laws {
    /// The runs at the left of the contacts that open.
    pub contacts: Vec<usize>,
    /// How far apart they begin.
    gaps: Vec<f64>,
    /// The elements with a displacement, by their places.
    pub springs: Vec<usize>,
    /// By the closed contacts, a bit for each; none where something without mass is resisted by nothing.
    by_closed: Vec<Option<Law>>,
}

/// What moves at a node.
#[derive(Clone, Debug)]
pub struct NodeState {
    /// The closed contacts, a bit for each.
    pub closed: usize,
    pub state: Vec<f64>,
    /// Of each contact that opens, zero where it is closed.
    pub gaps: Vec<f64>,
}

impl Laws {
    /// The laws of a node of a line in which velocities are about `speed`, with the gaps at the start of all contacts of the line.
    pub fn of(
        number: usize,
        line: &Line,
        node: &Node<Fraction>,
        (numbers, gaps): (&Numbers, &[f64]),
        speed: f64,
    ) -> Result<Laws, ModelError> {
        let refused = |reason| ModelError::Refused { model: NAME, reason };
        let node = node.map(|value| numbers.number(value, BITS))?;
        let opening: Vec<(usize, usize)> = node
            .contacts()
            .filter(|(_, run)| matches!(node.links[*run], Link::Contact(_)))
            .collect();
        if opening.len() > MAX_CONTACTS {
            return Err(refused(NotRepresented::TooManyContacts(opening.len())));
        }
        let own = &line.nodes[number];
        let law = |closed: usize| {
            let is_closed = |contact: usize| {
                let place = opening.iter().position(|own| own.0 == contact);
                place.is_none_or(|place| closed >> place & 1 == 1)
            };
            let system = System::of(&node, is_closed, BITS)?.map(double_of);
            let places = own.elements.iter().zip(&system.kept).zip(&system.driven);
            let pressing = places.filter_map(|((own, kept), driven)| {
                let contact = LocalContact::of(&own.law)?;
                Some(Pressing { contact, state: (*kept)?, input: (*driven)? })
            });
            let pressing: Vec<Pressing> = pressing.collect();
            let mut scales = vec![speed; system.states()];
            for own_contact in &pressing {
                let [left, right] = own.impedance;
                scales[own_contact.state] *= own_contact.contact.time(left + right, speed);
            }
            Ok::<Law, Unresisted>(Law { system, pressing, scales })
        };
        let by_closed: Vec<Option<Law>> =
            (0..1 << opening.len()).map(|closed| law(closed).ok()).collect();
        let Some(Some(all)) = by_closed.last() else {
            let near = own.elements.first().map(|own| line.name(own.element));
            let near = near.unwrap_or_else(|| "an end".to_owned());
            return Err(refused(NotRepresented::Unresisted(near)));
        };
        let is_kept = |place: &usize| all.system.kept[*place].is_some();
        let springs = (0..own.elements.len()).filter(is_kept).collect();
        let gaps = opening.iter().map(|(contact, _)| gaps[*contact]).collect();
        let contacts = opening.into_iter().map(|(_, run)| run).collect();
        Ok(Laws { contacts, gaps, springs, by_closed })
    }

    /// The law with these contacts closed.
    pub fn law(&self, closed: usize) -> Option<&Law> {
        self.by_closed[closed].as_ref()
    }

    /// The node at the start, all contacts closed but those that begin apart.
    pub fn start(&self, node: &Node<f64>, speed: f64) -> Option<NodeState> {
        let gaps = self.gaps.iter().enumerate();
        let closed = gaps.map(|(place, gap)| usize::from(*gap == 0.0) << place).sum();
        let velocity = |run: usize| match node.mass_and_momentum(run) {
            (mass, momentum) if mass > 0.0 => Some(momentum / mass),
            _ => None,
        };
        let state = self.state(node, closed, velocity, |_| 0.0, speed)?;
        Some(NodeState { closed, state, gaps: self.gaps.clone() })
    }

    /// The node after one of its contacts has changed; `None` where rigid masses of different velocities meet.
    pub fn changed(
        &self,
        node: &Node<f64>,
        before: &NodeState,
        contact: usize,
        speed: f64,
    ) -> Option<NodeState> {
        let old = &self.law(before.closed)?.system;
        let closed = before.closed ^ 1 << contact;
        let velocity = |run: usize| match old.place_of_velocity(run) {
            Some(place) => Some(before.state[place]),
            None if old.held[old.group[run]] => Some(0.0),
            None => None,
        };
        let displacement = |place: usize| old.kept[place].map_or(0.0, |state| before.state[state]);
        let state = self.state(node, closed, velocity, displacement, speed)?;
        let mut gaps = before.gaps.clone();
        gaps[contact] = 0.0;
        Some(NodeState { closed, state, gaps })
    }

    fn state(
        &self,
        node: &Node<f64>,
        closed: usize,
        velocity: impl Fn(usize) -> Option<f64>,
        displacement: impl Fn(usize) -> f64,
        speed: f64,
    ) -> Option<Vec<f64>> {
        let system = &self.law(closed)?.system;
        let mut state = vec![0.0; system.states()];
        for (group, held) in system.held.iter().enumerate() {
            let own = (0..node.runs()).filter(|run| system.group[*run] == group);
            let own = own.filter(|run| node.mass_and_momentum(*run).0 > 0.0);
            let mut velocities = own.filter_map(&velocity);
            let Some(first) = velocities.next() else { continue };
            let is_wall = |run: usize| system.group[run] == group && node.is_held(run);
            let is_held = !self.contacts.is_empty() && *held && (0..node.runs()).any(is_wall);
            let common = if is_held { 0.0 } else { first };
            let differs = |own: f64| (own - common).abs() > NO_DIFFERENCE * speed;
            if differs(first) || velocities.any(differs) {
                return None;
            }
            if let Some(place) = system.heavy.iter().position(|heavy| *heavy == group) {
                state[place] = first;
            }
        }
        for (place, kept) in system.kept.iter().enumerate() {
            if let Some(kept) = kept {
                state[*kept] = displacement(place);
            }
        }
        Some(state)
    }
}
