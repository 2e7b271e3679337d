//! The motions of a scene for all values of a symbol between two.
//!
//! Time is measured in a *step*, of which every travel time is a whole multiple whatever the symbol is. So what arrives
//! on a step left another node so many steps before, as in the method of steps for one value, but every coefficient
//! of a polynomial in time is a polynomial in the symbol, too. What both leave out is bounded by the energy of each node,
//! as in `passivity`: its matrices hold for all values at once.

use super::over::OverSymbol;
use crate::ball::{Arithmetic, Ball, BallError, Magnitude, Number};
use crate::enclosure::EnclosureError;
use crate::expression::{Fraction, NotAUnit, Root};
use crate::history::on_step::OnStep;
use crate::history::passivity::{Block, Passivity, StateError};
use crate::limits::{MAX_STEPS_OVER_SYMBOL, MAX_SYMBOL_BITS as BITS};
use crate::network::{
    ElementLaw, Elements, Energy, Field, Lump, Measured, MeasuredValue, Node, Reading, ScaledScene,
    Section, Side, System, Term, common_measure, dot,
};
use crate::scene::Drive;
use crate::signal::Varying;
use num_traits::{One as _, ToPrimitive as _, Zero as _};
use wavestep_polynomial::{Rational, Symbol};

/// So many powers of time are kept on a step, on which no rate of a node is above two.
const TERMS: usize = 20;

/// Why motions are not followed over a symbol.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NotOverSymbol {
    #[error("contacts that open and local contacts are not supported over a symbol")]
    Contacts,
    #[error("`{0}` is not supported over a symbol: it is not a constant force")]
    Load(String),
    #[error("the travel times have no common divisor for all values of the symbol")]
    NoCommonMeasure,
    #[error("more than {MAX_STEPS_OVER_SYMBOL} steps")]
    TooManySteps,
    #[error("a joint without mass moves, and nothing resists it")]
    Unresisted,
    #[error("`{0}` is not an observable of the scene")]
    Unknown(String),
    #[error(transparent)]
    Value(#[from] EnclosureError),
    #[error(transparent)]
    Ball(#[from] BallError),
    #[error(transparent)]
    Division(#[from] NotAUnit),
}

impl NotOverSymbol {
    /// Whether fewer values at once may be followed.
    pub fn is_of_width(&self) -> bool {
        use EnclosureError::NotReal;
        use NotOverSymbol::{Ball, Unresisted, Value};
        matches!(self, Unresisted | Ball(_) | Value(EnclosureError::Ball(_) | NotReal))
    }
}

type Outcome<T> = Result<T, NotOverSymbol>;

/// A scene with a symbol, the values that it takes, and what is observed.
pub struct Over<'a> {
    scaled: &'a ScaledScene,
    measured: &'a Measured,
    symbol: OverSymbol<'a>,
}

/// What an observable is made of.
enum Course {
    Now(Reading<usize>),
    /// Its integral since the start, in steps.
    SinceStart(Reading<usize>),
    /// The square of a sum with these factors.
    Square(Vec<Varying>, Vec<Course>),
    /// The integral, over the last travel time, of the waves that entered a bar, or of their squares.
    InBar {
        bar: usize,
        of: fn(&OnStep) -> OnStep,
    },
}

impl<'a> Over<'a> {
    /// # Errors
    /// [`NotOverSymbol`] for what is not followed.
    pub fn new(
        scaled: &'a ScaledScene,
        name: &str,
        (symbol, between): (&'a Symbol, [&'a Rational; 2]),
    ) -> Outcome<Over<'a>> {
        let (scene, model) = (scaled.scene(), scaled.model());
        if scene.contacts_open || scaled.local_contact().is_some() {
            return Err(NotOverSymbol::Contacts);
        }
        for (element, load) in &model.loads {
            let is_constant = model.lumps[element] == ElementLaw::Load(Drive::Force)
                && load.from.is_zero()
                && load.until.is_none()
                && load.course.as_fraction().is_some_and(|own| !own.contains(&scene.time));
            if !is_constant {
                return Err(NotOverSymbol::Load(scene.elements[*element].name.clone()));
            }
        }
        let measured = scaled.measures.iter().find(|own| own.name == name);
        let measured = measured.ok_or_else(|| NotOverSymbol::Unknown(name.to_owned()))?;
        let symbol = OverSymbol { symbol, between, constants: &model.constants };
        Ok(Over { scaled, measured, symbol })
    }

    /// A step that suits these scenes: the largest common measure of their travel times and of the delays of what is
    /// observed, halved until no node is too fast for it.
    ///
    /// # Errors
    /// [`NotOverSymbol::NoCommonMeasure`]; else as [`Over::follow`].
    pub fn step(all: &[Over<'_>]) -> Outcome<Root> {
        let times = all.iter().flat_map(|own| {
            let model = own.scaled.model();
            let travels = model.bars.values().filter_map(|bar| bar.travel.as_ref());
            let terms = match &own.measured.value {
                MeasuredValue::Linear(terms) => &terms[..],
                MeasuredValue::Energy(_) => &[],
            };
            let times = travels.chain(terms.iter().flat_map(|term| term.of.delays()));
            times.map(|time| Root::from(time).times(&model.scale.time))
        });
        let times: Vec<Root> = times.filter(|time| !time.factor().is_zero()).collect();
        let unit = || all[0].scaled.model().scale.time.clone();
        let first = times.first().cloned().unwrap_or_else(unit);
        let mut measure = Rational::one();
        for time in &times {
            measure = common_measure(&measure, &constant(&time.over(&first)?)?);
        }
        let step = |measure: &Rational| first.times(&Fraction::constant(measure).into());
        let mut halvings = 0;
        for own in all {
            let places = own.places(&step(&measure))?;
            let rates = places.iter().filter_map(|place| place.passivity.rate().top());
            halvings = rates.map(|top| top - 1).fold(halvings, i64::max);
        }
        if halvings > i64::from(MAX_STEPS_OVER_SYMBOL.ilog2()) {
            return Err(NotOverSymbol::TooManySteps);
        }
        Ok(step(&(measure / Rational::from_integer((1_i64 << halvings).into()))))
    }

    /// A time of the user's in steps: between which numbers it lies.
    ///
    /// # Errors
    /// As [`OverSymbol::root`].
    pub fn in_steps(&self, time: &Rational, step: &Root) -> Outcome<[Rational; 2]> {
        let steps = self.symbol.root(&Root::from(Fraction::constant(time)).over(step)?)?;
        let (low, high) = steps.range().endpoints();
        Ok([Rational::from(&low).max(Rational::zero()), Rational::from(&high)])
    }

    /// What is observed on the first steps, in the user's unit.
    ///
    /// # Errors
    /// [`NotOverSymbol`].
    pub fn follow(&self, step: &Root, count: usize) -> Outcome<Vec<OnStep>> {
        if count > MAX_STEPS_OVER_SYMBOL {
            return Err(NotOverSymbol::TooManySteps);
        }
        let (factors, courses): (Vec<_>, Vec<_>) = self.observed(step)?.into_iter().unzip();
        let mut motion =
            Motion { bars: self.bars(step)?, places: self.places(step)?, known: Vec::new() };
        motion.follow(count);
        Ok(motion.sum(&factors, &courses))
    }

    /// The step in the scale of the scene.
    fn scaled_step(&self, step: &Root) -> Outcome<Root> {
        Ok(step.over(&self.scaled.model().scale.time)?)
    }

    fn lag(&self, time: &Fraction, step: &Root) -> Outcome<usize> {
        let count = constant(&Root::from(time).over(&self.scaled_step(step)?)?)?;
        let whole = count.is_integer().then(|| count.to_usize()).flatten();
        whole.ok_or(NotOverSymbol::NoCommonMeasure)
    }

    /// The bars, and the waves in them before the start, `(V ± X_0/Z)/2`.
    fn bars(&self, step: &Root) -> Outcome<Vec<Bar>> {
        let bar = |(place, element)| {
            let bar = &self.scaled.model().bars[element];
            let [velocity, force] =
                [&bar.velocity, &bar.force].map(|own| self.symbol.fraction(own));
            let (velocity, pressed) =
                (velocity?, force?.multiply(&self.inverse(&bar.impedance)?, BITS));
            let before = [velocity.add(&pressed, BITS), velocity.subtract(&pressed, BITS)];
            let before = before.map(|own| OnStep::constant(&own.over(2, BITS)));
            let lag = bar.travel.as_ref().map(|travel| self.lag(travel, step)).transpose()?;
            Ok(Bar { before, lag, ends: self.scaled.layout.ends[place] })
        };
        self.scaled.layout.bars.iter().enumerate().map(bar).collect()
    }

    fn inverse(&self, value: &Fraction) -> Outcome<Varying> {
        Ok(self.symbol.fraction(value)?.reciprocal(BITS)?)
    }

    /// The nodes at the start. With a step as the unit of time a mass is so much lighter, and a spring so much stiffer; then
    /// displacements are measured in steps, too.
    fn places(&self, step: &Root) -> Outcome<Vec<Place>> {
        let step = self.symbol.root(&self.scaled_step(step)?)?;
        let inverse = step.reciprocal(BITS)?;
        let place = |exact: &Node<Fraction>| {
            let mut node = exact.map(|value| self.symbol.fraction(value))?;
            for own in &mut node.elements {
                match &mut own.law {
                    ElementLaw::Mass { mass, .. } => *mass = mass.multiply(&inverse, BITS),
                    ElementLaw::Spring { stiffness, .. }
                    | ElementLaw::Support { stiffness, .. } => {
                        *stiffness = stiffness.multiply(&step, BITS);
                    }
                    _ => {}
                }
            }
            let system =
                System::of(&node, |_| true, BITS).map_err(|_| NotOverSymbol::Unresisted)?;
            let numbers = node.map(|value| Ok::<_, NotOverSymbol>(value.number()))?;
            let passivity = Passivity::of(&numbers, &system.map(Varying::number))?;
            let start = NodeState::at_start(&node, &system, &passivity)?;
            let driven = node.elements.iter().filter(|own| own.law.is_driven()).map(|own| {
                let course = self.scaled.model().loads[&own.element].course.as_fraction();
                let course = course.expect("loads are constant");
                Ok::<_, NotOverSymbol>(OnStep::constant(&self.symbol.fraction(&course)?))
            });
            let driven = driven.collect::<Outcome<_>>()?;
            Ok(Place { node, system, passivity, start, driven })
        };
        self.scaled.layout.nodes.iter().map(place).collect()
    }

    /// What is observed, with factors in the user's unit.
    fn observed(&self, step: &Root) -> Outcome<Vec<(Varying, Course)>> {
        let unit = self.symbol.root(&self.measured.unit)?;
        let mut parts = Vec::new();
        match &self.measured.value {
            MeasuredValue::Linear(terms) => {
                for term in terms {
                    parts.extend(self.linear(term, step)?);
                }
            }
            MeasuredValue::Energy(shares) => {
                let (model, layout) = (self.scaled.model(), &self.scaled.layout);
                for (share, element) in shares {
                    let share = self.symbol.fraction(share)?;
                    let energy = Elements { model, layout }.energy(*element);
                    for own in energy.map_err(|_| NotOverSymbol::Contacts)? {
                        let (factor, of) = match own {
                            Energy::Square(term) => {
                                let one = Term { coefficient: Fraction::one(), of: term.of };
                                let (factors, of) = self.linear(&one, step)?.into_iter().unzip();
                                let factor = self.symbol.fraction(&term.coefficient)?;
                                (factor, Course::Square(factors, of))
                            }
                            Energy::InBar(bar) => self.held(bar, OnStep::square, step)?,
                            Energy::Work(..) => return Err(NotOverSymbol::Contacts),
                        };
                        parts.push((factor.multiply(&share, BITS), of));
                    }
                }
            }
        }
        Ok(parts.into_iter().map(|(factor, of)| (factor.multiply(&unit, BITS), of)).collect())
    }

    /// What a bar holds, `Z ∫ (w₊ + w₋) dt` or the same of squares.
    fn held(
        &self,
        bar: usize,
        of: fn(&OnStep) -> OnStep,
        step: &Root,
    ) -> Outcome<(Varying, Course)> {
        let own = &self.scaled.model().bars[&self.scaled.layout.bars[bar]];
        let impedance = self.symbol.fraction(&own.impedance)?;
        let step = self.symbol.root(&self.scaled_step(step)?)?;
        Ok((impedance.multiply(&step, BITS), Course::InBar { bar, of }))
    }

    /// What is linear in the motion, with its delays in steps.
    fn linear(&self, term: &Term, step: &Root) -> Outcome<Vec<(Varying, Course)>> {
        let (model, layout) = (self.scaled.model(), &self.scaled.layout);
        let mut factor = self.symbol.fraction(&term.coefficient)?;
        let in_steps = || self.symbol.root(&self.scaled_step(step)?).map_err(NotOverSymbol::from);
        let of = match &term.of {
            Reading::Force(lump) => {
                let terms = Elements { model, layout }.force(*lump);
                let mut parts = Vec::new();
                for own in terms.ok_or(NotOverSymbol::Contacts)? {
                    let coefficient = &term.coefficient * &own.coefficient;
                    parts.extend(self.linear(&Term { coefficient, of: own.of }, step)?);
                }
                return Ok(parts);
            }
            Reading::Velocity(face) => Course::Now(Reading::Velocity(*face)),
            Reading::Displacement(face) => {
                factor = factor.multiply(&in_steps()?, BITS);
                Course::SinceStart(Reading::Velocity(*face))
            }
            Reading::Compression(lump) => {
                factor = factor.multiply(&in_steps()?, BITS);
                Course::Now(Reading::Compression(*lump))
            }
            Reading::Momentum(bar) => {
                let (held, of) = self.held(*bar, OnStep::clone, step)?;
                factor = factor.multiply(&held, BITS);
                of
            }
            Reading::InBar(field, Section { bar, delays: [right, left] }) => {
                let lag = |delay: &Option<Fraction>| {
                    delay.as_ref().map(|delay| self.lag(delay, step)).transpose()
                };
                let section = Section { bar: *bar, delays: [lag(right)?, lag(left)?] };
                match field {
                    Field::Displacement => {
                        factor = factor.multiply(&in_steps()?, BITS);
                        Course::SinceStart(Reading::InBar(Field::Velocity, section))
                    }
                    Field::Force => {
                        let impedance = &model.bars[&layout.bars[*bar]].impedance;
                        factor = factor.multiply(&self.symbol.fraction(impedance)?, BITS);
                        Course::Now(Reading::InBar(*field, section))
                    }
                    _ => Course::Now(Reading::InBar(*field, section)),
                }
            }
        };
        Ok(vec![(factor, of)])
    }
}

/// A value that is one number, whatever the symbol is.
fn constant(value: &Root) -> Outcome<Rational> {
    let value = value.exact().and_then(|value| value.as_constant());
    value.ok_or(NotOverSymbol::NoCommonMeasure)
}

/// The integral of a function since the start.
fn since_start(rate: impl Iterator<Item = OnStep>) -> Vec<OnStep> {
    let mut before = OnStep::constant(&Varying::zero());
    let next = |rate: OnStep| {
        let parts = [&before, &rate.antiderivative()];
        let own = OnStep::sum(&[Varying::one(), Varying::one()], parts.into_iter());
        before = own.at_end();
        own
    };
    rate.map(next).collect()
}

struct Bar {
    /// The waves to the right and to the left before the start.
    before: [OnStep; 2],
    /// How many steps they take; none where the bar is endless.
    lag: Option<usize>,
    /// The nodes at its ends.
    ends: [Option<usize>; 2],
}

/// What a node does on a step.
struct Solved {
    /// The state, then what acts on it.
    both: Vec<OnStep>,
    velocities: Vec<OnStep>,
    /// What leaves at its left and at its right.
    leaving: [OnStep; 2],
    end: NodeState,
}

/// The state of a node at an instant, and the error of each of its blocks.
struct NodeState {
    values: Vec<Varying>,
    errors: Vec<StateError>,
}

impl NodeState {
    /// At the start nothing is compressed, and what strikes each other goes on with its momentum.
    fn at_start(
        node: &Node<Varying>,
        system: &System<Varying>,
        passivity: &Passivity,
    ) -> Outcome<NodeState> {
        let mut values = Vec::new();
        for group in &system.heavy {
            let runs = (0..node.runs()).filter(|run| system.group[*run] == *group);
            let (mut mass, mut momentum) = (Varying::zero(), Varying::zero());
            for own in runs.flat_map(|run| node.attached(run)) {
                if let ElementLaw::Mass { mass: own, velocity } = &own.law {
                    mass = mass.add(own, BITS);
                    momentum = momentum.add(&own.multiply(velocity, BITS), BITS);
                }
            }
            let inverse = mass.reciprocal(BITS)?;
            values.push(momentum.multiply(&inverse, BITS));
        }
        values.resize(system.states(), Varying::zero());
        let (values, off): (Vec<Varying>, Vec<Magnitude>) =
            values.iter().map(Varying::split).unzip();
        let off = off.iter().map(|off| Number::Enclosed(Ball::zero().widened(off)));
        Ok(NodeState { values, errors: passivity.errors(&off.collect::<Vec<_>>()) })
    }
}

/// A node, and its state at the start.
struct Place {
    node: Node<Varying>,
    system: System<Varying>,
    passivity: Passivity,
    start: NodeState,
    driven: Vec<OnStep>,
}

struct Motion {
    bars: Vec<Bar>,
    places: Vec<Place>,
    /// What the nodes do, step by step.
    known: Vec<Vec<Solved>>,
}

impl Motion {
    /// Follows all nodes for so many steps.
    fn follow(&mut self, count: usize) {
        for now in 0..count {
            let solve = |(number, place): (usize, &Place)| {
                let state = self.known.last().map_or(&place.start, |before| &before[number].end);
                let arriving = [(place.node.left, 0), (place.node.right, 1)];
                let arriving = arriving.map(|(side, direction)| match side {
                    Side::Bar(bar) => self.entered((bar, direction), self.bars[bar].lag, now),
                    _ => OnStep::constant(&Varying::zero()),
                });
                place.solve(state, &arriving)
            };
            let solved = self.places.iter().enumerate().map(solve).collect();
            self.known.push(solved);
        }
    }

    /// A wave that entered its bar so many steps before: before the first it was what it was at the start.
    fn entered(
        &self,
        (bar, direction): (usize, usize),
        delay: Option<usize>,
        now: usize,
    ) -> OnStep {
        let own = &self.bars[bar];
        match (own.ends[direction], delay.and_then(|delay| now.checked_sub(delay))) {
            (Some(node), Some(step)) => self.known[step][node].leaving[1 - direction].clone(),
            _ => own.before[direction].clone(),
        }
    }

    /// A sum of these on all steps.
    fn sum(&self, factors: &[Varying], courses: &[Course]) -> Vec<OnStep> {
        let courses: Vec<Vec<OnStep>> = courses.iter().map(|own| self.course(own)).collect();
        let sum = |now| OnStep::sum(factors, courses.iter().map(|own: &Vec<OnStep>| &own[now]));
        (0..self.known.len()).map(sum).collect()
    }

    fn course(&self, of: &Course) -> Vec<OnStep> {
        let steps = 0..self.known.len();
        match of {
            Course::Now(reading) => steps.map(|now| self.reading(reading, now)).collect(),
            Course::SinceStart(rate) => since_start(steps.map(|now| self.reading(rate, now))),
            Course::Square(factors, of) => {
                self.sum(factors, of).iter().map(OnStep::square).collect()
            }
            Course::InBar { bar, of } => self.held(*bar, *of),
        }
    }

    /// What entered a bar during its last travel time: from a part of the step so many steps before until now. An endless
    /// bar keeps all; one that holds something at the start is refused when its scene is read.
    fn held(&self, bar: usize, of: fn(&OnStep) -> OnStep) -> Vec<OnStep> {
        let Some(lag) = self.bars[bar].lag else {
            let end = usize::from(self.bars[bar].ends[0].is_none());
            let entered = |now| of(&self.entered((bar, end), Some(0), now));
            return since_start((0..self.known.len()).map(entered));
        };
        let entered = |direction: usize| {
            let before = self.bars[bar].before[direction].clone();
            let after =
                (0..self.known.len()).map(|now| self.entered((bar, direction), Some(0), now));
            let all = std::iter::repeat_n(before, lag).chain(after);
            let all = all.map(|own| of(&own).antiderivative());
            all.map(|own| (own.at_end(), own)).collect::<Vec<(OnStep, OnStep)>>()
        };
        let both = [0, 1].map(entered);
        let held = |now: usize| {
            let parts = both.iter().flat_map(|all| {
                let (whole, first) = &all[now];
                let between = all[now + 1..now + lag].iter().map(|(whole, _)| whole.clone());
                between.chain([whole.less(first), all[now + lag].1.clone()])
            });
            let parts: Vec<OnStep> = parts.collect();
            OnStep::sum(&vec![Varying::one(); parts.len()], parts.iter())
        };
        (0..self.known.len()).map(held).collect()
    }

    /// What is read on a step, of a bar in units of its impedance.
    fn reading(&self, of: &Reading<usize>, now: usize) -> OnStep {
        match of {
            Reading::Velocity(face) => {
                let node = face.lump().node;
                let run = self.places[node].node.run_beside(*face);
                self.known[now][node].velocities[run].clone()
            }
            Reading::Compression(Lump { node, place }) => {
                match self.places[*node].system.kept[*place] {
                    Some(kept) => self.known[now][*node].both[kept].clone(),
                    None => OnStep::constant(&Varying::zero()),
                }
            }
            Reading::InBar(field, Section { bar, delays: [right, left] }) => {
                let waves = [(0, right), (1, left)]
                    .map(|(side, delay)| self.entered((*bar, side), *delay, now));
                let left = match field {
                    Field::Force => Varying::one().negate(),
                    _ => Varying::one(),
                };
                OnStep::sum(&[Varying::one(), left], waves.iter())
            }
            _ => unreachable!("other readings are refused before"),
        }
    }
}

impl Place {
    /// What the node does on a step that begins with this state.
    ///
    /// `P` solves `y' = A y + B u` up to a residual `ρ`, what is rounded and what the last term leaves. So the error
    /// `e = y − P` obeys `e' = A e + B e_u + ρ`: where it begins with `|e| ≤ ε`, it is `ε + ∫|ρ| + |B e_u| ∫|e^(Ax)|` at most.
    fn solve(&self, start: &NodeState, arriving: &[OnStep; 2]) -> Solved {
        let (system, blocks) = (&self.system, &self.passivity.blocks);
        let acting: Vec<&OnStep> = arriving.iter().chain(&self.driven).collect();
        debug_assert!(acting.iter().all(|own| own.coefficients.len() <= TERMS));
        let sizes = |left: &[Magnitude]| -> Vec<Magnitude> {
            blocks.iter().map(|own| own.size(own.members.iter().map(|i| left[*i]))).collect()
        };
        // ∫|ρ| + |B e_u| ∫|e^(Ax)| of each block.
        let arrived: Vec<Magnitude> = acting.iter().map(|own| own.error).collect();
        let step = Number::one();
        let drive = |own: &Block| own.push(&arrived).multiply(&own.memory(&step.magnitude()));
        let mut added: Vec<Magnitude> = blocks.iter().map(drive).collect();
        let mut columns = vec![start.values.clone()];
        for k in 0..TERMS {
            let given = acting.iter().map(|own| own.coefficient(k));
            let both: Vec<Varying> = columns[k].iter().cloned().chain(given).collect();
            let next =
                system.change.iter().map(|row| dot(row, &both, BITS).over(k as u64 + 1, BITS));
            let (next, left): (Vec<Varying>, Vec<Magnitude>) = match k + 1 < TERMS {
                true => next.map(|own| own.split()).unzip(),
                false => next.map(|own| (Varying::zero(), own.magnitude())).unzip(),
            };
            added = added.iter().zip(sizes(&left)).map(|(sum, own)| sum.add(&own)).collect();
            columns.push(next);
        }
        columns.truncate(TERMS);
        let mut own =
            vec![OnStep { coefficients: Vec::new(), error: Magnitude::ZERO }; system.states()];
        for (i, own) in own.iter_mut().enumerate() {
            own.coefficients = columns.iter().map(|column| column[i].clone()).collect();
        }
        let at_end = own.iter().map(|own| {
            own.coefficients.iter().fold(Varying::zero(), |sum, c| sum.add(c, BITS)).split()
        });
        let (values, rounded): (Vec<Varying>, Vec<Magnitude>) = at_end.unzip();
        let mut errors = Vec::with_capacity(blocks.len());
        let each = blocks.iter().zip(&start.errors).zip(added.iter().zip(sizes(&rounded)));
        for ((block, error), (added, rounded)) in each {
            let most = error.size().add(added);
            for (place, member) in block.members.iter().enumerate() {
                own[*member].error = block.entry(place, &most);
            }
            errors.push(error.clone().after(&step, &added.add(&rounded), block));
        }
        let both: Vec<OnStep> = own.into_iter().chain(acting.into_iter().cloned()).collect();
        let runs = system.group.len();
        let velocities =
            system.output[..runs].iter().map(|row| OnStep::sum(row, both.iter())).collect();
        // What arrives is taken off before it is rounded and bounded.
        let leaving = [(0, 0), (1, runs - 1)].map(|(side, run)| {
            let mut row = system.output[run].clone();
            let own = &mut row[system.states() + side];
            *own = own.subtract(&Varying::one(), BITS);
            OnStep::sum(&row, both.iter())
        });
        Solved { both, velocities, leaving, end: NodeState { values, errors } }
    }
}
