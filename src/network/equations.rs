//! The laws at the nodes as equations between waves.
//!
//! Each node has a clock of its own, ahead by the travel time from a node where something happens at
//! the start. So of the two waves in a bar one is seen at both ends at once, and the other a round
//! trip later: the wave functions of successive periods, as textbooks have them.

use crate::expression::{Expression, Fraction};
use crate::network::clocks::Clocks;
use crate::network::delay::Lattice;
use crate::network::error::NetworkError;
use crate::network::model::Model;
use crate::network::node::{ElementLaw, Node, Side};
use crate::network::observe::Observed;
use crate::network::scaled::ScaledScene;
use crate::recurrence::{Fault, InvalidRecurrence, LinearForm, Recurrence, WaveIndex};
use crate::scene::{ElementIndex, Scene};
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
    /// The integral of a wave over time.
    Integral(WaveIndex),
}

/// A wave of a network.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct WaveRole {
    /// Its name.
    pub name: String,
    /// Its meaning.
    pub role: Role,
}

/// A scene as nodes, bars and waves, with the delays between them.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Network {
    pub(crate) scaled: ScaledScene,
    pub(crate) waves: Vec<WaveRole>,
    pub(crate) lattice: Lattice,
    /// The round trip in each bar, counted on the lattice.
    round_trips: Vec<Option<Vec<i64>>>,
    /// The node whose clock is not ahead.
    reference: usize,
    /// How far the clock of each node is ahead, counted on the lattice; `None` where nothing starts there
    /// and the count is not needed.
    clocks: Vec<Option<Vec<i64>>>,
    /// The same as a time.
    pub(crate) leads: Vec<Fraction>,
    /// Waves whose integrals are observed; these follow after `waves`.
    pub(crate) integrals: Vec<WaveIndex>,
    pub(crate) observables: Vec<Observed>,
    /// When loads begin and end, by the clock of their node, counted on the lattice.
    pub(crate) loads: Vec<(ElementIndex, Vec<i64>, Option<Vec<i64>>)>,
    pub(super) derived: Derived,
}

/// The recurrence of a network, once it was asked for; networks are the same with and without it.
#[derive(Clone, Default, Debug)]
pub(super) struct Derived(pub OnceLock<Result<Recurrence, NetworkError>>);

impl PartialEq for Derived {
    fn eq(&self, _: &Derived) -> bool {
        true
    }
}

impl Eq for Derived {}

impl Network {
    /// The network of a scene.
    pub fn new(scene: &Scene) -> Result<Network, NetworkError> {
        ScaledScene::of(scene)?.network()
    }

    /// The network of a scene in its own scales.
    pub(super) fn of_scaled(scaled: ScaledScene) -> Result<Network, NetworkError> {
        if let Some(contact) = scaled.local_contact() {
            return Err(NetworkError::NotLinear(scaled.scene.elements[contact].name.clone()));
        }
        let (bars, nodes) = (scaled.layout.bars.len(), scaled.layout.nodes.len());
        let mut network = Network {
            scaled,
            waves: Vec::new(),
            lattice: Lattice::spanned_by(&[]).0,
            round_trips: vec![None; bars],
            reference: 0,
            integrals: Vec::new(),
            observables: Vec::new(),
            clocks: vec![None; nodes],
            leads: Vec::new(),
            loads: Vec::new(),
            derived: Derived::default(),
        };
        network.set_clocks();
        network.name_waves();
        network.set_observables()?;
        Ok(network)
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scaled.scene
    }

    /// The scene in its own scales.
    pub fn model(&self) -> &Model {
        &self.scaled.model
    }

    /// The times at which waves arrive.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// A fault of the recurrence, at its place in the scene.
    pub(crate) fn refused(&self, invalid: InvalidRecurrence) -> NetworkError {
        let Fault::Rates { waves, .. } = invalid.fault else {
            return NetworkError::Recurrence(Box::new(invalid));
        };
        let place = self.place_of_waves(&waves);
        NetworkError::Rates { place, waves }
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
        self.leads.iter()
    }

    /// The observables of the scene.
    pub fn observables(&self) -> &[Observed] {
        &self.observables
    }

    /// The largest lag in each direction of the lattice.
    pub(crate) fn largest_lags(&self) -> Vec<usize> {
        let mut largest = vec![0_i64; self.lattice.periods().len()];
        let moments =
            self.loads.iter().flat_map(|(_, from, until)| std::iter::once(from).chain(until));
        let all = self.round_trips.iter().flatten().chain(self.clocks.iter().flatten());
        for counts in all.chain(moments) {
            for (largest, count) in largest.iter_mut().zip(counts) {
                *largest = (*largest).max(*count);
            }
        }
        largest.into_iter().map(|lag| usize::try_from(lag).expect("not early")).collect()
    }

    /// Whether constants act at a node from the start.
    pub(crate) fn has_clock(&self, node: usize) -> bool {
        self.clocks[node].is_some()
    }

    /// Whether something happens at a node at the start, or later by a load.
    fn starts(&self, node: &Node<Fraction>) -> bool {
        let velocity = |run| {
            let mut all = self.initial_velocities(node, run);
            all.dedup();
            (all.len() <= 1).then(|| all.into_iter().next().unwrap_or_else(Fraction::zero))
        };
        let velocities: Vec<Option<Fraction>> = (0..node.runs()).map(velocity).collect();
        let uneven = velocities.iter().any(Option::is_none);
        let apart = velocities.windows(2).any(|pair| pair[0] != pair[1]);
        let forced = |side: Side| match side {
            Side::Bar(bar) => {
                !self.scaled.model.bars[&self.scaled.layout.bars[bar]].force.is_zero()
            }
            _ => false,
        };
        let pressed = forced(node.left) || forced(node.right);
        let moved = velocities.iter().flatten().any(|velocity| !velocity.is_zero());
        let held = node.elements.iter().any(|own| match own.law {
            ElementLaw::Load(_) => true,
            ElementLaw::Support { .. } => moved,
            _ => false,
        });
        uneven || apart || pressed || held
    }

    /// The velocities at the start of all that moves together.
    pub(crate) fn initial_velocities(&self, node: &Node<Fraction>, run: usize) -> Vec<Fraction> {
        let of_side = |side: Side| match side {
            Side::Bar(bar) => {
                Some(self.scaled.model.bars[&self.scaled.layout.bars[bar]].velocity.clone())
            }
            Side::Fixed => Some(Fraction::zero()),
            Side::Free => None,
        };
        let masses = node.attached(run).filter_map(|own| match &own.law {
            ElementLaw::Mass { velocity, .. } => Some(velocity.clone()),
            _ => None,
        });
        node.sides(run).filter_map(of_side).chain(masses).collect()
    }

    /// Finds the clocks of the nodes, and the lattice on which all delays can be counted.
    fn set_clocks(&mut self) {
        let starting: Vec<bool> =
            self.scaled.layout.nodes.iter().map(|node| self.starts(node)).collect();
        let clocks = Clocks::of(&self.scaled.layout, &self.scaled.model, &starting);
        (self.reference, self.lattice, self.leads) =
            (clocks.reference, clocks.lattice, clocks.leads);
        (self.round_trips, self.clocks) = (clocks.round_trips, clocks.counted);
        self.loads = clocks.loads;
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
        for (mut name, role) in waves {
            let taken = |name: &str| {
                let symbols = self.scaled.model.assumptions.symbols();
                symbols.map(|(symbol, _)| symbol.name()).any(|other| other == name)
                    || self.waves.iter().any(|wave| wave.name == name)
                    || self
                        .scaled
                        .scene
                        .observables
                        .iter()
                        .any(|observable| observable.name == name)
                    || name == self.scaled.scene.time.name()
            };
            while taken(&name) {
                name.push('_');
            }
            self.waves.push(WaveRole { name, role });
        }
    }

    /// The wave with this role.
    pub(crate) fn wave(&self, role: Role) -> Option<WaveIndex> {
        self.waves.iter().position(|wave| wave.role == role)
    }

    /// A constant that acts from the start, by the clock of a node. Where nothing starts, all that
    /// moves has the same velocity, and only differences from it are followed.
    pub(crate) fn constant(&self, node: usize, value: &Fraction, strides: &[usize]) -> LinearForm {
        let Some(clock) = self.clocks[node].as_ref().filter(|_| !value.is_zero()) else {
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
        let trip = self.round_trips[bar].as_ref().map_or(0, |trip| lag(trip, strides));
        // The wave that leaves the node farther from the reference is seen there and here at once.
        let outward = |at: Option<usize>, other: Option<usize>| match (at, other) {
            (Some(at), Some(other)) => self.is_nearer(at, other),
            _ => true,
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

    /// Whether the clock of one node is less ahead than that of its neighbour.
    pub(crate) fn is_nearer(&self, node: usize, other: usize) -> bool {
        node.abs_diff(self.reference) < other.abs_diff(self.reference)
    }
}

/// The lag of a count on the lattice.
pub(crate) fn lag(counts: &[i64], strides: &[usize]) -> usize {
    let parts = counts.iter().zip(strides);
    parts.map(|(count, stride)| usize::try_from(*count).expect("not early") * stride).sum()
}
