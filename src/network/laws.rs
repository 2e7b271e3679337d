//! The equations of a network.

use crate::expression::{Expression, Fraction};
use crate::network::equations::{Network, Role, lag};
use crate::network::error::NetworkError;
use crate::network::layout::{Node, Run, Side};
use crate::network::model::ModelLump;
use crate::network::observe::{Observed, ObservedValue};
use crate::recurrence::{
    Continuity, LinearForm, Observable, Recurrence, SourceNotation, Statement, WaveIndex,
};
use crate::scene::{Drive, ElementIndex};
use wavestep_polynomial::Symbol;

/// What a law says.
///
/// ```
/// use wavestep::language::{Source, read_scene};
/// use wavestep::network::Network;
/// use wavestep::network::Rule;
///
/// let text = wavestep::scenes::find("cushioned-impact").unwrap().text;
/// let scene = read_scene(&Source::new("cushioned-impact", text)?, &Default::default()).unwrap();
/// let network = Network::new(&scene).unwrap();
/// let rules: Vec<Rule> = network.laws().into_iter().map(|law| law.rule).collect();
/// let [_, cushion, _] = network.scene().line.elements[..] else { panic!() };
/// let contact = [Rule::Force, Rule::Spring(cushion), Rule::Shortening(cushion)];
/// assert!(rules[0] == Rule::FreeEnd && contact[1..].iter().all(|rule| rules.contains(rule)));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Rule {
    /// What is joined moves together.
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
///
/// ```
/// use wavestep::language::{Source, read_scene};
/// use wavestep::network::Network;
/// use wavestep::network::{Law, Rule};
/// use wavestep::recurrence::LinearForm;
///
/// let text = wavestep::scenes::find("cushioned-impact").unwrap().text;
/// let scene = read_scene(&Source::new("cushioned-impact", text)?, &Default::default()).unwrap();
/// let network = Network::new(&scene).unwrap();
/// // a' = 1 + f_striker + g_striker − f_long shortens the spring.
/// let shortens = |law: &Law| matches!(law.rule, Rule::Shortening(_));
/// let law = network.laws().into_iter().find(shortens).unwrap();
/// assert_eq!(law.left, LinearForm::slope(3, 0));
/// assert_eq!(law.right.operators().count(), 3);
/// assert_eq!(law.node, Some(1));
/// // The laws are the equations of the recurrence.
/// let recurrence = network.recurrence().unwrap();
/// assert_eq!(recurrence.statement().equations.len(), network.laws().len());
/// assert_eq!(recurrence.statement().local, network.local());
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Law {
    /// The node, counted from the left; none for what belongs to no node.
    pub node: Option<usize>,
    /// What it says.
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
    /// The recurrence of the scene, where all delays lie on one grid.
    ///
    /// # Errors
    /// [`NetworkError::Incommensurate`] where they do not, or what the recurrence refuses.
    pub fn recurrence(&self) -> Result<Recurrence, NetworkError> {
        match self.lattice.periods().len() {
            1 => Recurrence::new(self.statement(&[1])).map_err(|invalid| self.refused(invalid)),
            _ => Err(NetworkError::Incommensurate),
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
        let observables = self.observables.iter().filter_map(linear).collect();
        Statement {
            title: self.scaled.scene.title.clone(),
            assumptions: self.scaled.model.assumptions.clone(),
            constants: self.scaled.model.constants.clone(),
            period: self.lattice.periods()[0].clone(),
            local: self.local(),
            time: self.scaled.scene.time.clone(),
            waves,
            equations: laws.laws.iter().map(|law| difference(&law.left, &law.right)).collect(),
            continuity: laws.continuity,
            observables,
            notation: SourceNotation::default(),
        }
    }

    /// The local time, since a period began or an echo arrived: `s` where that is free.
    pub fn local(&self) -> Symbol {
        let mut local = "s".to_owned();
        let taken = |name: &str| {
            self.scaled.model.assumptions.symbols().any(|(symbol, _)| symbol.name() == name)
                || self.waves.iter().any(|wave| wave.name == name)
        };
        while taken(&local) {
            local.push('_');
        }
        Symbol::new(&local).expect("a name")
    }

    fn all_laws(&self, strides: &[usize]) -> Laws {
        let mut laws = Laws::default();
        for (place, node) in self.layout.nodes.iter().enumerate() {
            self.laws_of(place, node, strides, &mut laws);
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
    ///
    /// # Panics
    /// Where the delays do not lie on one grid.
    pub fn laws(&self) -> Vec<Law> {
        assert_eq!(self.lattice.periods().len(), 1, "a scene on one grid");
        self.all_laws(&[1]).laws
    }

    /// All that is known of the velocity of a run of places, by the node's clock.
    pub(crate) fn velocity_forms(
        &self,
        place: usize,
        node: &Node,
        run: Run,
        strides: &[usize],
    ) -> Vec<LinearForm> {
        let mut forms = Vec::new();
        for element in &node.elements[run.first..run.last] {
            if let ModelLump::Load(Drive::Velocity, ..) = &self.scaled.model.lumps[element] {
                forms.push(self.load(*element, strides));
            }
        }
        forms.extend(node.sides(run).filter_map(|side| match side {
            Side::Bar(bar) => Some(self.bar_forms(place, bar, strides)[0].clone()),
            Side::Fixed => Some(LinearForm::zero()),
            Side::Free => None,
        }));
        if let Some(wave) = self.wave(Role::Velocity(place, run.first)) {
            forms.push(LinearForm::wave(wave, 0));
        }
        forms
    }

    /// The velocity of a run of places, by the node's clock.
    pub(crate) fn velocity_form(
        &self,
        place: usize,
        node: &Node,
        run: Run,
        strides: &[usize],
    ) -> LinearForm {
        self.velocity_forms(place, node, run, strides).swap_remove(0)
    }

    /// The force in a spring: `k α + d (v_left − v_right)`.
    pub(crate) fn spring_force(
        &self,
        place: usize,
        node: &Node,
        i: usize,
        strides: &[usize],
    ) -> LinearForm {
        let element = node.elements[i];
        let ModelLump::Spring(stiffness, damping) = &self.scaled.model.lumps[&element] else {
            unreachable!("asked for springs only");
        };
        let mut force = LinearForm::zero();
        if let Some(wave) = self.wave(Role::Compression(element)) {
            force = scaled(&LinearForm::wave(wave, 0), stiffness);
        }
        if !damping.is_zero() {
            let closing = self.closing(place, node, i, strides);
            force.add_scaled(&closing, &damping.clone().into(), 0);
        }
        force
    }

    /// `v_left − v_right` of the i-th element of a node.
    fn closing(&self, place: usize, node: &Node, i: usize, strides: &[usize]) -> LinearForm {
        let runs = self.velocity_runs(node);
        let velocity = |at: usize| {
            let run = runs.iter().find(|run| run.first <= at && at <= run.last);
            self.velocity_form(place, node, *run.expect("every place is in a run"), strides)
        };
        difference(&velocity(i), &velocity(i + 1))
    }

    /// All that is known of the force in a run of places.
    pub(crate) fn force_forms(
        &self,
        place: usize,
        node: &Node,
        run: Run,
        strides: &[usize],
    ) -> Vec<LinearForm> {
        let of_side = |side| match side {
            Side::Bar(bar) => Some(self.bar_forms(place, bar, strides)[1].clone()),
            Side::Free => Some(LinearForm::zero()),
            Side::Fixed => None,
        };
        let mut forms: Vec<LinearForm> = node.sides(run).filter_map(of_side).collect();
        forms.extend((run.first..run.last).map(|i| self.spring_force(place, node, i, strides)));
        forms
    }

    /// A load by the clock of its node: its course from its beginning, taken away again at its end.
    pub(crate) fn load(&self, element: ElementIndex, strides: &[usize]) -> LinearForm {
        let ModelLump::Load(_, course, from, until) = &self.scaled.model.lumps[&element] else {
            unreachable!("asked for loads only");
        };
        let moments = self.loads.iter().find(|(load, ..)| *load == element);
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

    fn laws_of(&self, place: usize, node: &Node, strides: &[usize], laws: &mut Laws) {
        let time = &self.scaled.scene.time;
        let forces = self.force_runs(node);
        let force_at = |at: usize| {
            let run = forces.iter().find(|run| run.first <= at && at <= run.last);
            let forms =
                self.force_forms(place, node, *run.expect("every place is in a run"), strides);
            forms.into_iter().next()
        };
        let mut add = |rule, left: &LinearForm, right: &LinearForm| {
            let (left, right) = (left.clone(), right.clone());
            laws.laws.push(Law { node: Some(place), rule, left, right });
        };
        let mut starts = Vec::new();
        let nothing = LinearForm::zero();
        for run in self.velocity_runs(node) {
            let forms = self.velocity_forms(place, node, run, strides);
            let elements = &node.elements[run.first..run.last];
            let imposing = elements.iter().find(|element| {
                matches!(self.scaled.model.lumps[element], ModelLump::Load(Drive::Velocity, ..))
            });
            let held = node.sides(run).any(|side| side == Side::Fixed);
            for other in &forms[1..] {
                match (imposing, held) {
                    (Some(load), _) => add(Rule::Imposed(*load), other, &forms[0]),
                    (None, true) if forms[0].is_zero() => add(Rule::FixedEnd, other, &nothing),
                    (None, true) => add(Rule::FixedEnd, &forms[0], other),
                    (None, false) => add(Rule::Velocity, &forms[0], other),
                }
            }
            for element in elements {
                if let Some(wave) = self.wave(Role::Displacement(*element)) {
                    add(Rule::Displacement(*element), &LinearForm::slope(wave, 0), &forms[0]);
                    starts.push(LinearForm::wave(wave, 0));
                }
            }
            if run.first == run.last || imposing.is_some() || held {
                continue;
            }
            // Σ (M v' + d v + k u) = X_left − X_right + F
            let [left, right] = [run.first, run.last].map(|at| force_at(at).expect("a force"));
            let mut acting = difference(&left, &right);
            let mut resisting = LinearForm::zero();
            let velocity = &forms[0];
            let (mut mass, mut momentum) = (Fraction::zero(), Fraction::zero());
            for element in elements {
                match &self.scaled.model.lumps[element] {
                    ModelLump::Mass(m, v) => {
                        mass = &mass + m;
                        momentum = &momentum + &(m * v);
                    }
                    ModelLump::Support(stiffness, damping) => {
                        resisting.add_scaled(velocity, &damping.clone().into(), 0);
                        if let Some(wave) = self.wave(Role::Displacement(*element)) {
                            let own = LinearForm::wave(wave, 0);
                            resisting.add_scaled(&own, &stiffness.clone().into(), 0);
                        }
                    }
                    ModelLump::Load(..) => {
                        acting.add_scaled(&self.load(*element, strides), &one(), 0);
                    }
                    ModelLump::Spring(..) => unreachable!("springs part what moves together"),
                    ModelLump::Hertz(..) => unreachable!("a network holds no local contact"),
                }
            }
            if !mass.is_zero() {
                resisting.add_scaled(&velocity.derivative(time), &mass.clone().into(), 0);
                // M v − Σ m v_0, so that nothing is divided by.
                let start = self.constant(place, &momentum, strides);
                starts.push(difference(&scaled(velocity, &mass), &start));
            }
            add(Rule::Balance(elements.to_vec()), &resisting, &acting);
        }
        for run in forces {
            let springs = &node.elements[run.first..run.last];
            let free = node.sides(run).any(|side| side == Side::Free);
            let forms = self.force_forms(place, node, run, strides);
            let Some((first, others)) = forms.split_first() else { continue };
            let before_springs = forms.len() - springs.len();
            // At a free end the waves themselves are equal, whatever the impedance.
            let end = match (node.left, node.right) {
                (Side::Bar(bar), Side::Free) | (Side::Free, Side::Bar(bar)) => Some(bar),
                _ => None,
            };
            let compliance = end.and_then(|bar| {
                let impedance = &self.scaled.model.bars[&self.layout.bars[bar]].impedance;
                let inverse = Fraction::reciprocal(impedance.numerator()).ok()?;
                Some(&inverse * &Fraction::from(impedance.denominator()))
            });
            let bare = |form: &LinearForm| match &compliance {
                Some(compliance) => scaled(form, compliance),
                None => form.clone(),
            };
            for (i, other) in (1_usize..).zip(others) {
                match i.checked_sub(before_springs) {
                    Some(spring) => add(Rule::Spring(springs[spring]), first, other),
                    None if free && first.is_zero() => add(Rule::FreeEnd, &bare(other), &nothing),
                    None if free => add(Rule::FreeEnd, &bare(first), &bare(other)),
                    None => add(Rule::Force, first, other),
                }
            }
        }
        for (i, element) in node.elements.iter().enumerate() {
            if let Some(wave) = self.wave(Role::Compression(*element)) {
                let closing = self.closing(place, node, i, strides);
                add(Rule::Shortening(*element), &LinearForm::slope(wave, 0), &closing);
                starts.push(LinearForm::wave(wave, 0));
            }
        }
        starts.into_iter().for_each(|form| laws.start(form));
    }
}

impl Laws {
    /// A form that is continuous and starts at 0; a constant in it from time 0 on is its start.
    fn start(&mut self, mut form: LinearForm) {
        let mut start = Expression::zero();
        if let Some(constant) = form.forcing_terms().first().cloned() {
            form.add_scaled(&LinearForm::forcing(constant.clone()), &-&one(), 0);
            start -= &constant;
        }
        self.continuity.push(Continuity { form, start });
    }
}
