//! The laws at the nodes of a network, as equations between wave functions.

use crate::expression::{Expression, Fraction, free_name};
use crate::network::equations::{Network, Role, lag};
use crate::network::error::NetworkError;
use crate::network::model::ModelLoad;
use crate::network::node::{Acting, ElementLaw, Lumped, Node, Side};
use crate::network::observed::{Observed, ObservedValue};
use crate::recurrence::{
    Continuity, LinearForm, Observable, Recurrence, SourceNotation, Statement, WaveIndex,
};
use crate::scene::ElementIndex;
use std::ops::Range;
use wavestep_polynomial::Symbol;

/// The kinds of laws.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Rule {
    /// Joined elements move together.
    Velocity,
    /// Without anything between them the forces on both sides are equal.
    Force,
    /// Nothing presses on a free end.
    FreeEnd,
    /// A fixed end does not move.
    FixedEnd,
    /// The elements named act on the line: masses, supports, loads.
    Balance(Vec<ElementIndex>),
    /// A spring carries the force.
    Spring(ElementIndex),
    /// A spring is shortened by the velocities of its ends.
    Shortening(ElementIndex),
    /// A support is displaced by the velocity of its place.
    Displacement(ElementIndex),
    /// A load imposes its velocity.
    Imposed(ElementIndex),
    /// An integral is followed because it is observed.
    Integral(WaveIndex),
}

/// A law at a node: `left = right`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Law {
    /// The node, counted from the left; none for what belongs to no node.
    pub node: Option<usize>,
    /// Its kind.
    pub rule: Rule,
    /// The left side.
    pub left: LinearForm,
    /// The right side.
    pub right: LinearForm,
}

/// Laws and continuity rules as they are found.
#[derive(Default)]
struct Laws {
    laws: Vec<Law>,
    continuity: Vec<Continuity>,
}

fn one() -> Expression {
    Expression::one()
}

/// `left − right`.
fn difference(left: &LinearForm, right: &LinearForm) -> LinearForm {
    let mut form = left.clone();
    form.add_scaled(right, &-&one(), 0);
    form
}

fn scaled(form: &LinearForm, factor: &Fraction) -> LinearForm {
    form.scaled(&factor.clone().into())
}

impl Network {
    /// The recurrence of the scene, where all delays lie on one grid. It is derived once.
    pub fn recurrence(&self) -> Result<Recurrence, NetworkError> {
        self.all_linear()?;
        let derive = || match self.lattice().periods().len() {
            1 => Recurrence::new(self.statement(&[1])).map_err(|invalid| self.refused(invalid)),
            _ => Err(NetworkError::Incommensurate),
        };
        self.derived.get_or_init(derive).clone()
    }

    /// Refuses a scene with a local contact, whose law is not linear, and one whose contacts begin apart.
    pub(crate) fn all_linear(&self) -> Result<(), NetworkError> {
        let scene = self.scene();
        match (self.local_contact(), scene.line.gaps.keys().next()) {
            (Some(contact), _) => {
                Err(NetworkError::NotLinear(scene.elements[contact].name.clone()))
            }
            (None, Some(joint)) => Err(NetworkError::Apart(scene.names_beside(*joint))),
            (None, None) => Ok(()),
        }
    }

    /// The recurrence of the scene as a statement; `strides` turn counts on the lattice into lags.
    pub(crate) fn statement(&self, strides: &[usize]) -> Statement {
        let laws = self.all_laws(strides);
        let mut waves: Vec<String> = self.waves.iter().map(|wave| wave.name.clone()).collect();
        for wave in &self.integrals {
            waves.push(format!("integral_{}", waves[*wave]));
        }
        let linear = |observed: &Observed| match &observed.value {
            ObservedValue::Linear(observation) => {
                Some(Observable { name: observed.name.clone(), observation: observation.clone() })
            }
            ObservedValue::Energy(_) => None,
        };
        Statement {
            period: self.lattice().periods()[0].clone(),
            waves,
            equations: laws.laws.iter().map(|law| difference(&law.left, &law.right)).collect(),
            continuity: laws.continuity,
            observables: self.observables.iter().filter_map(linear).collect(),
            ..self.nothing()
        }
    }

    /// A recurrence without waves, in the symbols of the scene: of functions of time.
    pub(crate) fn without_waves(&self) -> Result<Recurrence, NetworkError> {
        Recurrence::new(self.nothing()).map_err(|invalid| self.refused(invalid))
    }

    fn nothing(&self) -> Statement {
        Statement {
            title: self.scaled.scene.title.clone(),
            assumptions: self.scaled.model.assumptions.clone(),
            constants: self.scaled.model.constants.clone(),
            period: Fraction::one(),
            local: self.local(),
            time: self.scaled.scene.time.clone(),
            waves: Vec::new(),
            equations: Vec::new(),
            continuity: Vec::new(),
            observables: Vec::new(),
            quadratics: Vec::new(),
            notation: SourceNotation::default(),
        }
    }

    /// The local time, since a period began or an echo arrived: `s` where that is free.
    pub fn local(&self) -> Symbol {
        let local = free_name("s", |name| {
            self.scaled.model.assumptions.declares(name)
                || self.waves.iter().any(|wave| wave.name == name)
        });
        Symbol::new(&local).expect("a name")
    }

    fn all_laws(&self, strides: &[usize]) -> Laws {
        let mut laws = Laws::default();
        for place in 0..self.scaled.layout.nodes.len() {
            NodeLaws::of(self, place, strides).add_to(&mut laws);
        }
        for (i, wave) in self.integrals.iter().enumerate() {
            let integral = self.waves.len() + i;
            laws.laws.push(Law {
                node: None,
                rule: Rule::Integral(*wave),
                left: LinearForm::slope(integral, 0),
                right: LinearForm::wave(*wave, 0),
            });
            laws.start(LinearForm::wave(integral, 0));
        }
        laws
    }

    /// The laws at the nodes, with lags on a grid of one period.
    pub fn laws(&self) -> Vec<Law> {
        assert_eq!(self.lattice().periods().len(), 1, "a scene on one grid");
        self.all_laws(&[1]).laws
    }

    /// A load by the clock of its node: its course from its beginning, taken away again at its end.
    pub(crate) fn load(&self, element: ElementIndex, strides: &[usize]) -> LinearForm {
        let ModelLoad { course, from, until } = &self.scaled.model.loads[&element];
        let moments = self.clocks.loads.iter().find(|(load, ..)| *load == element);
        let (_, begins, ends) = moments.expect("every load has its moments");
        let time = &self.scaled.scene.time;
        let later = |by: &Fraction| {
            LinearForm::forcing(course.shift(time, by).expect("loads have no time in denominators"))
        };
        let mut form = LinearForm::zero();
        form.add_scaled(&later(from), &one(), lag(begins, strides));
        if let (Some(until), Some(ends)) = (until, ends) {
            form.add_scaled(&later(until), &-&one(), lag(ends, strides));
        }
        form
    }
}

/// Elements that pass the same force on: links with nothing but joints between them, and the sides of the node
/// that they reach.
struct Chain {
    links: Range<usize>,
    sides: Vec<Side>,
}

/// The chains of a node from left to right; elements that act on the line stand between two of them.
fn chains(node: &Node<Fraction>) -> Vec<Chain> {
    let mut chains = vec![Chain { links: 0..0, sides: vec![node.left] }];
    for run in 0..node.runs() {
        if node.attached(run).next().is_some() {
            chains.push(Chain { links: run..run, sides: Vec::new() });
        }
        let last = chains.last_mut().expect("one at least");
        if run < node.links.len() { last.links.end = run + 1 } else { last.sides.push(node.right) }
    }
    chains
}

/// The laws of one node in wave functions, by the clock of the node.
///
/// The system of equations in numbers solves for velocities and forces. A derivation states each law as a
/// book does instead: equal velocities and forces one by one, and the balance of a run, whose terms and
/// signs are those of [`Node::acting`], with the force of the bar beside a spring rather than that of the
/// spring.
struct NodeLaws<'a> {
    network: &'a Network,
    place: usize,
    node: &'a Node<Fraction>,
    strides: &'a [usize],
    chains: Vec<Chain>,
    laws: Vec<Law>,
    /// Forms that are continuous and start at 0.
    starts: Vec<LinearForm>,
}

impl<'a> NodeLaws<'a> {
    fn of(network: &'a Network, place: usize, strides: &'a [usize]) -> NodeLaws<'a> {
        let node = &network.scaled.layout.nodes[place];
        let (chains, laws, starts) = (chains(node), Vec::new(), Vec::new());
        NodeLaws { network, place, node, strides, chains, laws, starts }
    }

    fn add_to(mut self, laws: &mut Laws) {
        for run in 0..self.node.runs() {
            self.motion(run);
        }
        for chain in std::mem::take(&mut self.chains) {
            self.force(&chain);
        }
        self.shortenings();
        laws.laws.extend(self.laws);
        self.starts.into_iter().for_each(|form| laws.start(form));
    }

    fn add(&mut self, rule: Rule, left: LinearForm, right: LinearForm) {
        self.laws.push(Law { node: Some(self.place), rule, left, right });
    }

    fn load(&self, element: ElementIndex) -> LinearForm {
        self.network.load(element, self.strides)
    }

    /// All that is known of the velocity of a run.
    fn velocity_forms(&self, run: usize) -> Vec<LinearForm> {
        let imposing = self.node.imposing(run).map(|own| self.load(own.element));
        let sides = self.node.sides(run).filter_map(|side| match side {
            Side::Bar(bar) => {
                Some(self.network.bar_forms(self.place, bar, self.strides)[0].clone())
            }
            Side::Fixed => Some(LinearForm::zero()),
            Side::Free => None,
        });
        let role = Role::Velocity(self.place, self.node.first_place(run));
        let own = self.network.wave(role).map(|wave| LinearForm::wave(wave, 0));
        imposing.chain(sides).chain(own).collect()
    }

    fn velocity(&self, run: usize) -> LinearForm {
        self.velocity_forms(run).swap_remove(0)
    }

    /// `v_left − v_right` of a link.
    fn closing(&self, link: usize) -> LinearForm {
        difference(&self.velocity(link), &self.velocity(link + 1))
    }

    /// The force in a spring: `k α + d (v_left − v_right)`.
    fn spring_force(&self, link: usize) -> LinearForm {
        let mut force = LinearForm::zero();
        let Some(Lumped { element, law: ElementLaw::Spring { stiffness, damping }, .. }) =
            self.node.spanning(link)
        else {
            return force;
        };
        if let Some(wave) = self.network.wave(Role::Compression(*element)) {
            force = scaled(&LinearForm::wave(wave, 0), stiffness);
        }
        if !damping.is_zero() {
            force.add_scaled(&self.closing(link), &damping.clone().into(), 0);
        }
        force
    }

    /// All that is known of the force in a chain: of its sides, then of its springs.
    fn force_forms(&self, chain: &Chain) -> Vec<LinearForm> {
        let of_side = |side: &Side| match side {
            Side::Bar(bar) => {
                Some(self.network.bar_forms(self.place, *bar, self.strides)[1].clone())
            }
            Side::Free => Some(LinearForm::zero()),
            Side::Fixed => None,
        };
        let springs = chain.links.clone().map(|link| self.spring_force(link));
        chain.sides.iter().filter_map(of_side).chain(springs).collect()
    }

    /// The laws of a run of elements that move together.
    fn motion(&mut self, run: usize) {
        let forms = self.velocity_forms(run);
        let imposing = self.node.imposing(run).next().map(|own| own.element);
        let held = self.node.is_held(run);
        let (first, nothing) = (forms[0].clone(), LinearForm::zero());
        for other in &forms[1..] {
            let (first, other) = (first.clone(), other.clone());
            match (imposing, held) {
                (Some(load), _) => self.add(Rule::Imposed(load), other, first),
                (None, true) if first.is_zero() => {
                    self.add(Rule::FixedEnd, other, nothing.clone());
                }
                (None, true) => self.add(Rule::FixedEnd, first, other),
                (None, false) => self.add(Rule::Velocity, first, other),
            }
        }
        let node = self.node;
        for own in node.attached(run) {
            if let Some(wave) = self.network.wave(Role::Displacement(own.element)) {
                let rule = Rule::Displacement(own.element);
                self.add(rule, LinearForm::slope(wave, 0), first.clone());
                self.starts.push(LinearForm::wave(wave, 0));
            }
        }
        if node.attached(run).next().is_some() && imposing.is_none() && !held {
            self.balance(run, &first);
        }
    }

    /// `Σ (M v' + d v + k u) = X_left − X_right + F`.
    fn balance(&mut self, run: usize, velocity: &LinearForm) {
        let (mut acting, mut resisting) = (LinearForm::zero(), LinearForm::zero());
        let (mut mass, mut momentum) = (Fraction::zero(), Fraction::zero());
        for (sign, own) in self.node.acting(run) {
            let own = match own {
                Acting::Side(_) | Acting::Link(_) => {
                    let forms = self.force_forms(self.chain(own));
                    acting.add_scaled(&forms[0], &Expression::integer(sign), 0);
                    continue;
                }
                Acting::Element(place) => &self.node.elements[place],
            };
            match &own.law {
                ElementLaw::Mass { mass: own, velocity } => {
                    mass = &mass + own;
                    momentum = &momentum + &(own * velocity);
                }
                ElementLaw::Support { stiffness, damping } => {
                    resisting.add_scaled(velocity, &damping.clone().into(), 0);
                    if let Some(wave) = self.network.wave(Role::Displacement(own.element)) {
                        let displacement = LinearForm::wave(wave, 0);
                        resisting.add_scaled(&displacement, &stiffness.clone().into(), 0);
                    }
                }
                _ => acting.add_scaled(&self.load(own.element), &Expression::integer(sign), 0),
            }
        }
        if !mass.is_zero() {
            let time = &self.network.scaled.scene.time;
            resisting.add_scaled(&velocity.derivative(time), &mass.clone().into(), 0);
            // M v − Σ m v_0, so that nothing is divided by.
            let start = self.network.constant(self.place, &momentum, self.strides);
            self.starts.push(difference(&scaled(velocity, &mass), &start));
        }
        let elements = self.node.attached(run).map(|own| own.element).collect();
        self.add(Rule::Balance(elements), resisting, acting);
    }

    /// The chain that a side or a link of the node is in.
    fn chain(&self, acting: Acting) -> &Chain {
        let place = match acting {
            Acting::Link(link) => self.chains.iter().position(|own| own.links.contains(&link)),
            Acting::Side(0) => Some(0),
            _ => None,
        };
        &self.chains[place.unwrap_or(self.chains.len() - 1)]
    }

    /// Elements that pass the same force on.
    fn force(&mut self, chain: &Chain) {
        let forms = self.force_forms(chain);
        let Some((first, others)) = forms.split_first() else { return };
        let free = chain.sides.contains(&Side::Free);
        let springs: Vec<ElementIndex> = chain
            .links
            .clone()
            .filter_map(|link| self.node.spanning(link).map(|own| own.element))
            .collect();
        let before_springs = forms.len() - springs.len();
        // At a free end the waves themselves are equal, whatever the impedance.
        let compliance = self.end_compliance();
        let bare = |form: &LinearForm| match &compliance {
            Some(compliance) => scaled(form, compliance),
            None => form.clone(),
        };
        for (i, other) in (1_usize..).zip(others) {
            match i.checked_sub(before_springs) {
                Some(spring) => {
                    self.add(Rule::Spring(springs[spring]), first.clone(), other.clone());
                }
                None if free && first.is_zero() => {
                    self.add(Rule::FreeEnd, bare(other), LinearForm::zero());
                }
                None if free => self.add(Rule::FreeEnd, bare(first), bare(other)),
                None => self.add(Rule::Force, first.clone(), other.clone()),
            }
        }
    }

    /// `1/Z` of the bar with a free end at this node.
    fn end_compliance(&self) -> Option<Fraction> {
        let impedance = match (self.node.left, self.node.right) {
            (Side::Bar(_), Side::Free) => &self.node.impedance[0],
            (Side::Free, Side::Bar(_)) => &self.node.impedance[1],
            _ => return None,
        };
        impedance.inverse().ok()
    }

    /// How springs are shortened.
    fn shortenings(&mut self) {
        let node = self.node;
        for link in 0..node.links.len() {
            let Some(own) = node.spanning(link) else { continue };
            if let Some(wave) = self.network.wave(Role::Compression(own.element)) {
                let closing = self.closing(link);
                self.add(Rule::Shortening(own.element), LinearForm::slope(wave, 0), closing);
                self.starts.push(LinearForm::wave(wave, 0));
            }
        }
    }
}

impl Laws {
    /// A form that is continuous and starts at 0; a constant in it from time 0 on is its start.
    fn start(&mut self, mut form: LinearForm) {
        let mut start = Expression::zero();
        if let Some(constant) = form.forcing_terms().get(0).cloned() {
            form.add_scaled(&LinearForm::forcing(constant.clone()), &-&one(), 0);
            start -= &constant;
        }
        self.continuity.push(Continuity { form, start });
    }
}
