//! Bodies that have parted for ever: nothing is followed any longer of which nothing is asked.
//!
//! Once it is proven that no two bodies meet again, each goes on as if the others were not there. A body that no reading
//! is of is let go: its own nodes stand still, and at a contact that it shared with another body nothing arrives from it.

use crate::ball::Number;
use crate::history::body::parts;
use crate::history::engine::{Engine, TOLD_APART};
use crate::history::error::Outcome;
use crate::history::moment::Moment;
use crate::history::part::{NodeQuantity, Source};
use crate::history::story::longest;
use crate::history::track::Arriving;
use crate::network::Network;
use std::cell::RefCell;
use std::cmp::Ordering;
use std::ops::Range;
use wavestep_polynomial::Rational;

/// Whether all has parted is asked again after a part of the time that has passed, one in so many, or a travel time if that is
/// longer.
const PARTS: u64 = 4;

impl Engine {
    /// Whether nothing can meet again after an instant.
    pub fn has_parted(&self, network: &Network, moment: &Moment) -> Outcome<bool> {
        let count = self.layout.contacts.len();
        // What happens a little later is known already; then the instant tells nothing.
        for happening in &self.happenings {
            if self.clock.compare(&happening.moment, moment)? == Ordering::Greater {
                return Ok(false);
            }
        }
        let apart = |contact: usize| self.is_open(contact) || self.is_idle(contact);
        if count == 0 || !(0..count).all(apart) {
            return Ok(count == 0);
        }
        for contact in 0..count {
            let [left, right] = self.bodies_beside(network, contact);
            if !self.never_meets(network, contact, [&left, &right], moment)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The parts of the line if all contacts were open.
    fn bodies(&self, network: &Network) -> Vec<Range<usize>> {
        let joints = self.layout.contacts.iter().map(|contact| contact.joint);
        parts(network, &joints.collect::<Vec<_>>())
    }

    /// Those at the left and at the right of a contact; an empty one for a wall.
    pub fn bodies_beside(&self, network: &Network, contact: usize) -> [Range<usize>; 2] {
        let (bodies, joint) = (self.bodies(network), self.layout.contacts[contact].joint);
        let side = |is_beside: &dyn Fn(&Range<usize>) -> bool| {
            bodies.iter().find(|body| is_beside(body)).cloned().unwrap_or_default()
        };
        [side(&|body| body.end == joint), side(&|body| body.start == joint)]
    }

    /// Follows the scene until an instant; bodies of which nothing is asked, until all has parted if that can be proven. When
    /// that is, is kept for the next time that the scene is followed.
    pub fn follow_asked(
        &mut self,
        network: &Network,
        until: &Moment,
        parted: &RefCell<Option<Moment>>,
    ) -> Outcome<()> {
        let unasked = self.unasked(network);
        if unasked.is_empty() {
            return self.follow_until(until);
        }
        let leaving: Vec<usize> = self.nodes_in(network, &unasked).map(|(node, _)| node).collect();
        self.foresee_cells(until, |node| !self.has_contacts(node) && !leaving.contains(&node))?;
        self.whole = self.clock.about(until);
        let travel = longest(self)?;
        let mut count = 1;
        loop {
            let known = parted.borrow().clone();
            let next = known
                .clone()
                .unwrap_or_else(|| Moment::at(travel.scale(&Rational::from_integer(count.into()))));
            if self.clock.compare(&next, until)? != Ordering::Less {
                self.watched_from = f64::INFINITY;
                return self.follow_until(until);
            }
            self.watched_from =
                self.clock.about(&next) * (1.0 - TOLD_APART) - self.longest_travel();
            self.follow_until(&next)?;
            // What is not decided is not proven.
            if known.is_some() || self.all_open() && self.has_parted(network, &next) == Ok(true) {
                self.let_go(network, &unasked);
                *parted.borrow_mut() = Some(next);
                return self.follow_until(until);
            }
            count += (count / PARTS).max(1);
        }
    }

    /// Whether no contact touches.
    fn all_open(&self) -> bool {
        (0..self.layout.contacts.len()).all(|contact| self.is_open(contact))
    }

    /// The bodies of which nothing is asked; none where a gap may be.
    fn unasked(&self, network: &Network) -> Vec<Range<usize>> {
        let Some(sources) = &self.asked_sources else { return Vec::new() };
        let mut bodies = self.bodies(network);
        if bodies.len() < 2 {
            return Vec::new();
        }
        let line = &network.scene().line.elements;
        let contacts = &self.layout.contacts;
        let mut asked = Vec::new();
        for source in sources {
            let (node, quantity) = match source {
                Source::Wave { bar, .. } => {
                    asked.push(self.layout.bars[*bar]);
                    continue;
                }
                Source::Node { node, quantity } => (*node, *quantity),
            };
            match quantity {
                // Nothing presses any more.
                NodeQuantity::Force(_) => {}
                NodeQuantity::Compression(place) => {
                    let mut own = self.nodes[node].contacts();
                    if own.any(|(own, _)| self.nodes[node].local_contact(own) == Some(place)) {
                        return Vec::new();
                    }
                    asked.push(self.nodes[node].elements[place].element);
                }
                NodeQuantity::Velocity(run) | NodeQuantity::Displacement(run) => {
                    // A run is beside a contact of its node, or all of the node belongs to one body.
                    let own = contacts.iter().filter(|own| own.node == node);
                    let left = own.clone().rfind(|own| own.run < run);
                    let left = left.and_then(|own| line.get(own.joint).copied());
                    let right = own.clone().find(|own| own.run >= run);
                    let right = right.and_then(|own| Some(line[own.joint.checked_sub(1)?]));
                    match left.or(right).or_else(|| self.element_of(node)) {
                        Some(element) => asked.push(element),
                        None => return Vec::new(),
                    }
                }
            }
        }
        let is_asked =
            |body: &Range<usize>| line[body.clone()].iter().any(|own| asked.contains(own));
        bodies.retain(|body| !is_asked(body));
        bodies
    }

    /// An element of a node without contacts, or a bar beside it.
    fn element_of(&self, node: usize) -> Option<usize> {
        let own = self.nodes[node].elements.first().map(|own| own.element);
        let bar = self.layout.ends.iter().position(|ends| ends.contains(&Some(node)));
        own.or_else(|| bar.map(|bar| self.layout.bars[bar]))
    }

    fn has_contacts(&self, node: usize) -> bool {
        self.nodes[node].contacts().next().is_some()
    }

    /// The nodes that bodies touch, each with the side at which a bar of theirs ends there, if one does.
    fn nodes_in<'a>(
        &'a self,
        network: &'a Network,
        bodies: &'a [Range<usize>],
    ) -> impl Iterator<Item = (usize, Option<usize>)> + 'a {
        let line = &network.scene().line.elements;
        bodies.iter().flat_map(|body| &line[body.clone()]).flat_map(|element| {
            let ends = match self.layout.bar(*element) {
                // The left end of a bar is at the right of a node.
                Some(bar) => [1, 0].map(Some).into_iter().zip(self.layout.ends[bar]),
                None => [None; 2].into_iter().zip([self.layout.node_of(*element), None]),
            };
            ends.filter_map(|(side, node)| Some((node?, side)))
        })
    }

    /// Follows these bodies no longer: no contact closes again.
    fn let_go(&mut self, network: &Network, bodies: &[Range<usize>]) {
        (self.watched_from, self.has_let_go) = (f64::INFINITY, true);
        let nodes: Vec<_> = self.nodes_in(network, bodies).collect();
        for (node, side) in nodes {
            if !self.has_contacts(node) {
                self.states[node].is_gone = true;
            } else if let Some(side) = side {
                self.states[node].arriving[side] = Arriving::Constant(Number::zero());
            }
        }
    }
}
