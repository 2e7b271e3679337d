//! A network: the nodes of a line, the waves between them, and what a bar brings to the equations of a node.
//!
//! Each node has a clock of its own, ahead by the travel time from a node where something happens at
//! the start. So one of the two waves in a bar is seen at both ends at once, and the other a round
//! trip later: the wave functions of successive periods, as textbooks have them.

use crate::expression::{Expression, Fraction, free_name};
use crate::network::assumed::Assumed;
use crate::network::clocks::Clocks;
use crate::network::delay::Lattice;
use crate::network::error::NetworkError;
use crate::network::node::{ElementLaw, Lumped, Node, Side};
use crate::network::observed::{FieldBar, Observed};
use crate::network::scaled::ScaledScene;
use crate::recurrence::{Fault, InvalidRecurrence, LinearForm, Recurrence, WaveIndex};
use crate::scene::{ElementIndex, Scene};
use std::ops::Deref;
use std::sync::OnceLock;
use wavestep_polynomial::Rational;

/// The meaning of a wave of a network.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Role {
    /// The velocity wave to the right in a bar.
    Right(ElementIndex),
    /// The velocity wave to the left in a bar.
    Left(ElementIndex),
    /// The compression of a spring.
    Compression(ElementIndex),
    /// The displacement of a support.
    Displacement(ElementIndex),
    /// The velocity of a node beside no bar, by the node and the first of its places.
    Velocity(usize, usize),
}

/// A wave of a network.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct WaveRole {
    pub name: String,
    /// Its meaning.
    pub role: Role,
}

/// A scene as nodes, bars and waves, with the delays between them.
#[derive(Clone, Debug)]
pub struct Network {
    pub(crate) scaled: ScaledScene,
    pub(crate) waves: Vec<WaveRole>,
    pub(super) clocks: Clocks,
    /// Waves whose integrals are observed; these follow after `waves`.
    pub(crate) integrals: Vec<WaveIndex>,
    pub(crate) observables: Vec<Observed>,
    /// The recurrence, once it was asked for.
    pub(super) derived: OnceLock<Result<Recurrence, NetworkError>>,
    /// The bars with their waves, once fields were asked for.
    pub(super) fields: OnceLock<Result<Box<FieldBars>, NetworkError>>,
    /// What is taken for granted of the scene.
    pub assumed: Assumed,
}

/// The bars of a scene, from left to right, and its network with the integrals of their waves.
#[derive(Clone, Debug)]
pub(crate) struct FieldBars {
    pub network: Network,
    pub bars: Vec<FieldBar>,
}

impl ScaledScene {
    /// The network of the scene.
    pub fn network(self) -> Result<Network, NetworkError> {
        let mut network = Network {
            clocks: Clocks::of(&self),
            scaled: self,
            waves: Vec::new(),
            integrals: Vec::new(),
            observables: Vec::new(),
            derived: OnceLock::new(),
            fields: OnceLock::new(),
            assumed: Assumed::default(),
        };
        network.name_waves();
        network.set_observables()?;
        Ok(network)
    }
}

/// A network is a scene in its own scales, and more.
impl Deref for Network {
    type Target = ScaledScene;

    fn deref(&self) -> &ScaledScene {
        &self.scaled
    }
}

impl Network {
    /// The network of a scene.
    pub fn new(scene: &Scene) -> Result<Network, NetworkError> {
        ScaledScene::of(scene)?.network()
    }

    /// The network of another scene without symbols, in the scales of this one; its constants keep their names.
    pub fn beside(&self, scene: &Scene) -> Result<Network, NetworkError> {
        ScaledScene::with(scene, self.model().beside(scene)?)?.network()
    }

    /// The times at which waves arrive.
    pub fn lattice(&self) -> &Lattice {
        &self.clocks.lattice
    }

    /// A fault of the recurrence, at its place in the scene.
    pub(crate) fn refused(&self, invalid: InvalidRecurrence) -> NetworkError {
        let Fault::Rates { waves, .. } = invalid.fault else {
            return match self.unresisted() {
                Some(node) => NetworkError::Massless(self.place_in_words(node)),
                None => NetworkError::Recurrence(Box::new(invalid)),
            };
        };
        let place = self.place_of_waves(&waves);
        NetworkError::Rates { place, waves }
    }

    /// The first node with something between springs that has no mass, and no damper or bar beside it.
    fn unresisted(&self) -> Option<usize> {
        let damps = |own: &Lumped<Fraction>| match own.law.resistance() {
            Some([_, damping]) => !damping.is_zero(),
            None => matches!(own.law, ElementLaw::Mass { .. }),
        };
        let is_free = |node: &Node<Fraction>, run: usize| {
            let mut links = (run.saturating_sub(1)..node.links.len().min(run + 1))
                .map(|link| node.spanning(link));
            !node.is_imposed(run)
                && node.sides(run).all(|side| side == Side::Free)
                && !node.attached(run).any(damps)
                && links.all(|link| link.is_some_and(|own| !damps(own)))
        };
        let nodes = &self.scaled.layout.nodes;
        nodes.iter().position(|node| (0..node.runs()).any(|run| is_free(node, run)))
    }

    /// Where waves meet that decay together, in words.
    pub fn place_of_waves(&self, names: &[String]) -> String {
        let roles = self.waves.iter().filter(|wave| names.contains(&wave.name));
        let node = roles.into_iter().find_map(|wave| match wave.role {
            Role::Velocity(node, _) => Some(node),
            Role::Compression(element) | Role::Displacement(element) => {
                self.scaled.layout.node_of(element)
            }
            _ => None,
        });
        node.map_or("in this scene".to_owned(), |node| self.place_in_words(node))
    }

    /// Where a node is, in words.
    pub fn place_in_words(&self, node: usize) -> String {
        let name = |bar: usize| {
            format!("`{}`", self.scaled.scene.elements[self.scaled.layout.bars[bar]].name)
        };
        let Node { left, right, .. } = &self.scaled.layout.nodes[node];
        match (left, right) {
            (Side::Bar(left), Side::Bar(right)) => {
                format!("between {} and {}", name(*left), name(*right))
            }
            (Side::Bar(left), _) => format!("at the right end of {}", name(*left)),
            (_, Side::Bar(right)) => format!("at the left end of {}", name(*right)),
            _ => "between the ends".to_owned(),
        }
    }

    /// The waves, in the order of the recurrence.
    pub fn waves(&self) -> &[WaveRole] {
        &self.waves
    }

    /// A time in seconds in the scale of the scene; a plain number as it is.
    pub fn scaled_time(&self, time: &Rational) -> Fraction {
        self.scaled.model.slowness.scale(time)
    }

    /// How far the clock of each node is ahead: what happens at a time shows later by so much.
    pub fn leads(&self) -> impl Iterator<Item = &Fraction> + '_ {
        self.clocks.leads.iter()
    }

    /// Whether something happens at a node at the start or by a load; else what moves with a velocity of its own there is
    /// followed as a difference from its velocity at the start.
    pub fn is_disturbed(&self, node: usize) -> bool {
        self.clocks.counted[node].is_some()
    }

    /// The observables of the scene.
    pub fn observables(&self) -> &[Observed] {
        &self.observables
    }

    /// The largest lag in each direction of the lattice.
    pub(crate) fn largest_lags(&self) -> Vec<usize> {
        let mut largest = vec![0_i64; self.lattice().periods().len()];
        for counts in self.clocks.all_counts() {
            for (largest, count) in largest.iter_mut().zip(counts) {
                *largest = (*largest).max(*count);
            }
        }
        largest.into_iter().map(|lag| usize::try_from(lag).expect("not early")).collect()
    }

    /// Whether nothing beside a run gives its velocity.
    fn is_unknown(node: &Node<Fraction>, run: usize) -> bool {
        node.sides(run).all(|side| side == Side::Free)
    }

    fn name_waves(&mut self) {
        let elements = &self.scaled.scene.elements;
        let name = |element: ElementIndex| &elements[element].name;
        let mut waves = Vec::new();
        let lone = self.scaled.layout.bars.len() == 1;
        for (bar, element) in self.scaled.layout.bars.iter().enumerate() {
            let [left, right] = self.scaled.layout.ends[bar];
            let called = |letter: &str| match lone {
                true => letter.to_owned(),
                false => format!("{letter}_{}", name(*element)),
            };
            if left.is_some() {
                waves.push((called("f"), Role::Right(*element)));
            }
            if right.is_some() {
                waves.push((called("g"), Role::Left(*element)));
            }
        }
        for (place, node) in self.scaled.layout.nodes.iter().enumerate() {
            for own in &node.elements {
                match &own.law {
                    ElementLaw::Spring { stiffness, .. } if !stiffness.is_zero() => {
                        waves.push((name(own.element).clone(), Role::Compression(own.element)));
                    }
                    ElementLaw::Support { stiffness, .. } if !stiffness.is_zero() => {
                        let name = format!("u_{}", name(own.element));
                        waves.push((name, Role::Displacement(own.element)));
                    }
                    _ => {}
                }
            }
            for run in (0..node.runs()).filter(|run| Network::is_unknown(node, *run)) {
                let first = node.first_place(run);
                let mut masses = node.attached(run);
                let mass = masses.find(|own| matches!(own.law, ElementLaw::Mass { .. }));
                let name = match mass.or(node.attached(run).next()) {
                    Some(named) => format!("v_{}", name(named.element)),
                    None => format!("v_joint_{first}"),
                };
                waves.push((name, Role::Velocity(place, first)));
            }
        }
        for (name, role) in waves {
            let Scene { observables, time, .. } = &self.scaled.scene;
            let name = free_name(name, |name| {
                self.scaled.model.assumptions.declares(name)
                    || self.waves.iter().any(|wave| wave.name == name)
                    || observables.iter().any(|observable| observable.name == name)
                    || name == time.name()
            });
            self.waves.push(WaveRole { name, role });
        }
    }

    pub(crate) fn wave(&self, role: Role) -> Option<WaveIndex> {
        self.waves.iter().position(|wave| wave.role == role)
    }

    /// A constant that acts from the start, by the clock of a node. Where nothing starts, all that
    /// moves has the same velocity, and only differences from it are followed.
    pub(crate) fn constant(&self, node: usize, value: &Fraction, strides: &[usize]) -> LinearForm {
        let Some(clock) = self.clocks.counted[node].as_ref().filter(|_| !value.is_zero()) else {
            return LinearForm::zero();
        };
        let mut form = LinearForm::zero();
        let constant = LinearForm::forcing(value.clone().into());
        form.add_scaled(&constant, &Expression::one(), lag(clock, strides));
        form
    }

    /// Velocity and force of a bar at a node, by the node's clock.
    pub(crate) fn bar_forms(&self, node: usize, bar: usize, strides: &[usize]) -> [LinearForm; 2] {
        let element = self.scaled.layout.bars[bar];
        let data = &self.scaled.model.bars[&element];
        let [left, right] = self.scaled.layout.ends[bar];
        let trip = self.clocks.round_trips[bar].as_ref().map_or(0, |trip| lag(trip, strides));
        // The wave that leaves the node farther from the reference is seen there and here at once.
        let ahead = |node: usize| node.abs_diff(self.clocks.reference);
        let outward = |at: Option<usize>, other: Option<usize>| {
            at.zip(other).is_none_or(|(at, other)| ahead(at) < ahead(other))
        };
        let at_left = left == Some(node);
        let (f_lag, g_lag) = match at_left {
            // At the left end f leaves and g arrives.
            true => (0, if outward(left, right) { 0 } else { trip }),
            false => (if outward(right, left) { 0 } else { trip }, 0),
        };
        let mut waves = [LinearForm::zero(), LinearForm::zero()];
        for (role, lag, sign) in
            [(Role::Right(element), f_lag, 1), (Role::Left(element), g_lag, -1)]
        {
            if let Some(wave) = self.wave(role) {
                let form = LinearForm::wave(wave, lag);
                waves[0].add_scaled(&form, &Expression::one(), 0);
                let impedance = Expression::from(data.impedance.clone());
                waves[1].add_scaled(
                    &form,
                    &impedance.scale(&Rational::from_integer(sign.into())),
                    0,
                );
            }
        }
        for (form, constant) in waves.iter_mut().zip([&data.velocity, &data.force]) {
            form.add_scaled(&self.constant(node, constant, strides), &Expression::one(), 0);
        }
        waves
    }
}

/// The lag of a count on the lattice.
pub(crate) fn lag(counts: &[i64], strides: &[usize]) -> usize {
    let parts = counts.iter().zip(strides);
    parts.map(|(count, stride)| usize::try_from(*count).expect("not early") * stride).sum()
}
