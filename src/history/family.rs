//! The motions of a scene for all values of a symbol between two.
//!
//! Time is measured in a *step*, of which every travel time is a whole multiple whatever the symbol is. So what arrives
//! on a step left another node so many steps before, as in the method of steps for one value, but that every coefficient
//! of a polynomial in time is a polynomial in the symbol, too. What both leave out is bounded by the energy of each node,
//! as in `passivity`: its matrices hold for all values at once.

use crate::ball::{Arithmetic, Magnitude, Number, Varying};
use crate::enclosure::{EnclosureError, OverSymbol};
use crate::expression::{Fraction, NotAUnit, Root};
use crate::history::passivity::{Passivity, StateError};
use crate::limits::{MAX_STEPS_OVER_SYMBOL, MAX_SYMBOL_BITS};
use crate::network::{
    ElementLaw, Elements, Field, Measured, MeasuredValue, Node, Reading, ScaledScene, Section,
    Side, System, Term, dot,
};
use crate::scene::Drive;
use num_integer::Integer as _;
use num_traits::{One as _, ToPrimitive as _, Zero as _};
use std::collections::BTreeMap;
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// So many powers of time are kept on a step, on which no rate of a node is above two.
const TERMS: usize = 20;

/// Why motions are not followed over a symbol.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NotOverSymbol {
    #[error("contacts that open and local contacts are not followed over a symbol")]
    Contacts,
    #[error("`{0}` is not followed over a symbol: it is no constant force")]
    Load(String),
    #[error("energies, momenta and displacements are not followed over a symbol")]
    Integral,
    #[error("travel times have no common measure that is one for all values of the symbol")]
    NoCommonMeasure,
    #[error("more than {MAX_STEPS_OVER_SYMBOL} steps")]
    TooManySteps,
    #[error("something without mass moves, and nothing resists it")]
    Unresisted,
    #[error("`{0}` is no observable of the scene")]
    Unknown(String),
    #[error(transparent)]
    Value(#[from] EnclosureError),
}

impl NotOverSymbol {
    /// Whether fewer values at once may be followed.
    pub fn is_of_width(&self) -> bool {
        use NotOverSymbol::{Unresisted, Value};
        matches!(self, Unresisted | Value(EnclosureError::Ball(_) | EnclosureError::NotReal))
    }
}

impl From<NotAUnit> for NotOverSymbol {
    fn from(error: NotAUnit) -> NotOverSymbol {
        EnclosureError::from(error).into()
    }
}

type Outcome<T> = Result<T, NotOverSymbol>;

/// A function of time on a step, `P(x) + e(x)` for `0 ≤ x ≤ 1`, with `P(x) = Σ_k c_k x^k`.
///
/// # Invariants
/// `|e(x)| ≤ error` for each value of the symbol. Coefficients have no radii.
#[derive(Clone, Debug)]
pub struct OnStep {
    pub coefficients: Vec<Varying>,
    pub error: Magnitude,
}

impl OnStep {
    fn constant(value: &Varying) -> OnStep {
        let (value, error) = value.split();
        OnStep { coefficients: vec![value], error }
    }

    fn coefficient(&self, k: usize) -> Varying {
        self.coefficients.get(k).cloned().unwrap_or_else(Varying::zero)
    }

    /// The difference to another function.
    pub fn less(&self, other: &OnStep) -> OnStep {
        OnStep::sum(&[Varying::one(), Varying::one().negate()], [self, other].into_iter())
    }

    /// A sum with these factors.
    pub fn sum<'p>(factors: &[Varying], parts: impl Iterator<Item = &'p OnStep>) -> OnStep {
        let parts: Vec<(&Varying, &OnStep)> =
            factors.iter().zip(parts).filter(|(factor, _)| !factor.is_zero()).collect();
        let errors = parts.iter().map(|(factor, part)| factor.magnitude().multiply(&part.error));
        let mut error = errors.fold(Magnitude::ZERO, |sum, own| sum.add(&own));
        let count = parts.iter().map(|(_, part)| part.coefficients.len()).max().unwrap_or(0);
        let mut coefficients = Vec::with_capacity(count);
        for k in 0..count {
            let terms = parts.iter().map(|(factor, part)| {
                let own = part.coefficients.get(k);
                own.map_or_else(Varying::zero, |own| factor.multiply(own, MAX_SYMBOL_BITS))
            });
            let sum = terms.fold(Varying::zero(), |sum, own| sum.add(&own, MAX_SYMBOL_BITS));
            let (sum, off) = sum.split();
            coefficients.push(sum);
            error = error.add(&off);
        }
        OnStep { coefficients, error }
    }
}

/// A scene with a symbol, the values that it takes, and what is observed.
pub struct Over<'a> {
    scaled: &'a ScaledScene,
    measured: &'a Measured,
    terms: &'a [Term],
    symbol: OverSymbol<'a>,
}

impl<'a> Over<'a> {
    /// # Errors
    /// [`NotOverSymbol`] for what is not followed.
    pub fn new(
        scaled: &'a ScaledScene,
        name: &str,
        (symbol, between): (&'a Symbol, [&'a Rational; 2]),
    ) -> Outcome<Over<'a>> {
        let scene = scaled.scene();
        if scene.contacts_open || scaled.local_contact().is_some() {
            return Err(NotOverSymbol::Contacts);
        }
        for (element, load) in &scaled.model().loads {
            let is_force = scaled.model().lumps[element] == ElementLaw::Load(Drive::Force);
            let always = load.from.is_zero() && load.until.is_none();
            if !is_force
                || !always
                || load.course.as_fraction().is_none_or(|own| own.contains(&scene.time))
            {
                return Err(NotOverSymbol::Load(scene.elements[*element].name.clone()));
            }
        }
        let measured = scaled.measures.iter().find(|own| own.name == name);
        let measured = measured.ok_or_else(|| NotOverSymbol::Unknown(name.to_owned()))?;
        let MeasuredValue::Linear(terms) = &measured.value else {
            return Err(NotOverSymbol::Integral);
        };
        let constants = &scaled.model().constants;
        let symbol = OverSymbol { symbol, between, constants, bits: MAX_SYMBOL_BITS };
        Ok(Over { scaled, measured, terms, symbol })
    }

    /// Travel times and the delays of what is observed, in the user's unit.
    fn times(&self) -> Vec<Root> {
        let unit = &self.scaled.model().scale.time;
        let travels = self.scaled.model().bars.values().filter_map(|bar| bar.travel.as_ref());
        let delays = self.terms.iter().flat_map(|term| term.of.delays());
        travels
            .chain(delays)
            .filter(|time| !time.is_zero())
            .map(|time| Root::from(time).times(unit))
            .collect()
    }

    /// A step that suits these scenes: the largest common measure of their times, halved until no node is too fast for it.
    ///
    /// # Errors
    /// [`NotOverSymbol::NoCommonMeasure`]; else as [`Over::follow`].
    pub fn step(all: &[Over<'_>]) -> Outcome<Root> {
        let times: Vec<Root> = all.iter().flat_map(Over::times).collect();
        let scale = || {
            all.first().map_or_else(
                || Root::from(Fraction::one()),
                |own| own.scaled.model().scale.time.clone(),
            )
        };
        let first = times.first().cloned().unwrap_or_else(scale);
        let mut measure = Rational::one();
        for time in &times {
            let ratio = constant(&time.over(&first)?)?;
            let denominator = measure.denom().lcm(ratio.denom());
            let counts =
                [&measure, &ratio].map(|own| own * Rational::from_integer(denominator.clone()));
            let [one, other] = counts.map(|count| count.to_integer());
            measure = Rational::new(one.gcd(&other), denominator);
        }
        let step = |measure: &Rational| first.times(&Fraction::constant(measure).into());
        let mut fastest = 0;
        for own in all {
            let places = own.places(&step(&measure))?;
            let rates = places.iter().filter_map(|place| place.passivity.rate().top());
            fastest = rates.map(|top| top - 1).fold(fastest, i64::max);
        }
        let halvings = fastest.min(i64::from(MAX_STEPS_OVER_SYMBOL.ilog2()) + 1);
        Ok(step(&(measure / Rational::from_integer((1_i64 << halvings).into()))))
    }

    /// A time of the user's in steps: between which numbers it lies. The ends are exact for a power of the symbol.
    ///
    /// # Errors
    /// As [`OverSymbol::root`].
    pub fn in_steps(&self, time: &Rational, step: &Root) -> Outcome<[Rational; 2]> {
        let steps = Root::from(Fraction::constant(time)).over(step)?;
        let is_power = |value: &Fraction| {
            let only = |p: &Polynomial| {
                p.term_count() == 1 && p.symbols().iter().all(|own| own == self.symbol.symbol)
            };
            only(value.numerator()) && value.factors().all(|(factor, _)| only(factor))
        };
        if let Some(power) = steps.exact().filter(is_power) {
            let at = |value: &Rational| power.evaluate(&|_: &Symbol| Some(value.clone()));
            if let [Ok(one), Ok(other)] = self.symbol.between.map(at) {
                return Ok(if one < other { [one, other] } else { [other, one] });
            }
        }
        let (low, high) = self.symbol.root(&steps)?.range().endpoints();
        Ok([Rational::from(&low).max(Rational::zero()), Rational::from(&high)])
    }

    /// How many whole steps a time is, where the symbol has but one value.
    ///
    /// # Errors
    /// [`NotOverSymbol::NoCommonMeasure`] where it is not known to be a whole number; else as [`OverSymbol::root`].
    pub fn steps_until(&self, time: &Rational, step: &Root) -> Outcome<usize> {
        let [low, high] = self.in_steps(time, step)?;
        let whole = high.floor();
        let count = whole.to_usize().filter(|_| low <= whole && high < low + Rational::one());
        count.ok_or(NotOverSymbol::NoCommonMeasure)
    }

    /// What is observed on the first steps, in the user's unit; from one of them on as if nothing more arrived, where that is
    /// asked for.
    ///
    /// # Errors
    /// [`NotOverSymbol`].
    pub fn follow(&self, step: &Root, count: usize, last: Option<usize>) -> Outcome<Vec<OnStep>> {
        if count > MAX_STEPS_OVER_SYMBOL {
            return Err(NotOverSymbol::TooManySteps);
        }
        let seen = self.seen(step)?;
        let (waves, places) = (self.waves(step)?, self.places(step)?);
        let mut motion = Motion { waves, places, known: BTreeMap::new() };
        motion.follow(Course::Whole, count);
        if let Some(last) = last {
            let delays = seen.iter().filter_map(|(_, seen)| seen.delay());
            for first in delays.chain([0]).filter_map(|delay| last.checked_sub(delay)) {
                motion.follow(Course::From(first), count);
            }
        }
        let observed = |now: usize| {
            let course = last.filter(|last| now >= *last).map_or(Course::Whole, Course::From);
            let (factors, parts): (Vec<_>, Vec<_>) = seen
                .iter()
                .map(|(factor, seen)| (factor.clone(), motion.part(seen, course, now)))
                .unzip();
            OnStep::sum(&factors, parts.iter())
        };
        Ok((0..count).map(observed).collect())
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

    /// The bars: what was in them before the start, and how long waves take.
    fn waves(&self, step: &Root) -> Outcome<Vec<Bar>> {
        let bar = |(place, element): (usize, _)| {
            let bar = &self.scaled.model().bars[element];
            let [velocity, force, impedance] =
                [&bar.velocity, &bar.force, &bar.impedance].map(|own| self.symbol.fraction(own));
            let (velocity, force, impedance) = (velocity?, force?, impedance?);
            let bits = self.symbol.bits;
            let pressed =
                force.multiply(&impedance.reciprocal(bits).map_err(EnclosureError::from)?, bits);
            let before = [velocity.add(&pressed, bits), velocity.subtract(&pressed, bits)];
            let before = before.map(|own| OnStep::constant(&own.over(2, bits)));
            let lag = bar.travel.as_ref().map(|travel| self.lag(travel, step)).transpose()?;
            Ok(Bar { before, lag, ends: self.scaled.layout.ends[place] })
        };
        self.scaled.layout.bars.iter().enumerate().map(bar).collect()
    }

    /// The nodes at the start.
    fn places(&self, step: &Root) -> Outcome<Vec<Place>> {
        let bits = self.symbol.bits;
        let step = self.symbol.root(&self.scaled_step(step)?)?;
        let inverse = step.reciprocal(bits).map_err(EnclosureError::from)?;
        let mut places = Vec::new();
        for exact in &self.scaled.layout.nodes {
            let mut node = exact.map(|value| self.symbol.fraction(value))?;
            for own in &mut node.elements {
                match &mut own.law {
                    ElementLaw::Mass { mass, .. } => *mass = mass.multiply(&inverse, bits),
                    ElementLaw::Spring { stiffness, .. }
                    | ElementLaw::Support { stiffness, .. } => {
                        *stiffness = stiffness.multiply(&step, bits);
                    }
                    _ => {}
                }
            }
            let system =
                System::of(&node, |_| true, bits).map_err(|_| NotOverSymbol::Unresisted)?;
            let numbers = node.map(|value| Ok::<_, NotOverSymbol>(value.number()))?;
            let passivity = Passivity::of(&numbers, &system.map(Varying::number));
            let passivity = passivity.map_err(EnclosureError::from)?;
            let start = self.start(&node, &system, &passivity)?;
            let driven = node.elements.iter().filter(|own| own.law.is_driven());
            let driven = driven.map(|own| {
                let course = self.scaled.model().loads[&own.element].course.as_fraction();
                Ok(OnStep::constant(&self.symbol.fraction(&course.unwrap_or_else(Fraction::zero))?))
            });
            let driven = driven.collect::<Outcome<_>>()?;
            places.push(Place { node, system, passivity, start, driven });
        }
        Ok(places)
    }

    /// The state of a node at the start, with its errors.
    fn start(
        &self,
        node: &Node<Varying>,
        system: &System<Varying>,
        passivity: &Passivity,
    ) -> Outcome<NodeState> {
        let bits = self.symbol.bits;
        let (mut values, mut off) = (Vec::new(), Vec::new());
        for group in &system.heavy {
            let runs = (0..node.runs()).filter(|run| system.group[*run] == *group);
            let masses = runs.flat_map(|run| node.attached(run)).filter_map(|own| match &own.law {
                ElementLaw::Mass { mass, velocity } => Some((mass, velocity)),
                _ => None,
            });
            // What strikes each other goes on with its momentum.
            let (mut mass, mut momentum) = (Varying::zero(), Varying::zero());
            for (own, velocity) in masses {
                mass = mass.add(own, bits);
                momentum = momentum.add(&own.multiply(velocity, bits), bits);
            }
            let inverse = mass.reciprocal(bits).map_err(EnclosureError::from)?;
            let (velocity, error) = momentum.multiply(&inverse, bits).split();
            values.push(velocity);
            off.push(error);
        }
        values.resize(system.states(), Varying::zero());
        off.resize(system.states(), Magnitude::ZERO);
        let errors = passivity
            .blocks
            .iter()
            .map(|block| StateError::new(block.size(block.members.iter().map(|i| off[*i]))));
        Ok(NodeState { values, errors: errors.collect() })
    }

    /// What is observed as parts of a motion, with factors.
    fn seen(&self, step: &Root) -> Outcome<Vec<(Varying, Seen)>> {
        let bits = self.symbol.bits;
        let unit = self.symbol.root(&self.measured.unit)?;
        let (model, layout) = (self.scaled.model(), &self.scaled.layout);
        let mut seen = Vec::new();
        let mut left: Vec<(Fraction, Reading)> =
            self.terms.iter().map(|term| (term.coefficient.clone(), term.of.clone())).collect();
        while let Some((coefficient, reading)) = left.pop() {
            let factor = self.symbol.fraction(&coefficient)?.multiply(&unit, bits);
            match reading {
                Reading::Velocity(face) => {
                    let node = face.lump().node;
                    let run = layout.nodes[node].run_beside(face);
                    seen.push((factor, Seen::Velocity { node, run }));
                }
                Reading::Compression(lump) => {
                    // A length in steps, in the scale of the scene.
                    let step = self.symbol.root(&self.scaled_step(step)?)?;
                    let place = lump.place;
                    seen.push((
                        factor.multiply(&step, bits),
                        Seen::Compression { node: lump.node, place },
                    ));
                }
                Reading::Force(lump) => {
                    let terms =
                        Elements { model, layout }.force(lump).ok_or(NotOverSymbol::Contacts)?;
                    left.extend(
                        terms.into_iter().map(|term| (&coefficient * &term.coefficient, term.of)),
                    );
                }
                Reading::InBar(
                    field @ (Field::Velocity | Field::Force),
                    Section { bar, delays },
                ) => {
                    let sign = if field == Field::Force { factor.negate() } else { factor.clone() };
                    let impedance = match field {
                        Field::Force => {
                            self.symbol.fraction(&model.bars[&layout.bars[bar]].impedance)?
                        }
                        _ => Varying::one(),
                    };
                    for (direction, (factor, delay)) in
                        [factor, sign].into_iter().zip(delays).enumerate()
                    {
                        let delay = delay.map(|delay| self.lag(&delay, step)).transpose()?;
                        seen.push((
                            factor.multiply(&impedance, bits),
                            Seen::Wave { bar, direction, delay },
                        ));
                    }
                }
                _ => return Err(NotOverSymbol::Integral),
            }
        }
        Ok(seen)
    }
}

/// A value that is one number, whatever the symbol is.
fn constant(value: &Root) -> Outcome<Rational> {
    let value = value.exact().and_then(|value| value.as_constant());
    value.ok_or(NotOverSymbol::NoCommonMeasure)
}

/// Something that is observed of a motion.
enum Seen {
    Velocity {
        node: usize,
        run: usize,
    },
    Compression {
        node: usize,
        place: usize,
    },
    /// So many steps after it entered the bar.
    Wave {
        bar: usize,
        direction: usize,
        delay: Option<usize>,
    },
}

impl Seen {
    fn delay(&self) -> Option<usize> {
        match self {
            Seen::Wave { delay, .. } => *delay,
            _ => None,
        }
    }
}

struct Bar {
    /// The waves to the right and to the left.
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

/// A node, and its state at the start.
struct Place {
    node: Node<Varying>,
    system: System<Varying>,
    passivity: Passivity,
    start: NodeState,
    driven: Vec<OnStep>,
}

/// What is followed: the motion itself, or how it would go on if from a step on nothing more arrived.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Course {
    Whole,
    From(usize),
}

impl Course {
    /// The course on which a wave is that left so long before; none where it was there before the start.
    fn before(self, delay: usize) -> Option<Course> {
        match self {
            Course::Whole => Some(Course::Whole),
            Course::From(step) => step.checked_sub(delay).map(Course::From),
        }
    }

    /// Its first step.
    fn first(self) -> usize {
        match self {
            Course::Whole => 0,
            Course::From(step) => step,
        }
    }
}

struct Motion {
    waves: Vec<Bar>,
    places: Vec<Place>,
    /// What each node does, step by step.
    known: BTreeMap<Course, Vec<Vec<Solved>>>,
}

impl Motion {
    /// Follows a course until so many steps have passed since the start.
    fn follow(&mut self, course: Course, count: usize) {
        if self.known.contains_key(&course) {
            return;
        }
        let first = course.first();
        let lags: Vec<usize> = self.waves.iter().filter_map(|bar| bar.lag).collect();
        for earlier in
            lags.into_iter().filter_map(|lag| course.before(lag)).filter(|own| *own != course)
        {
            self.follow(earlier, count);
        }
        self.known.insert(course, Vec::new());
        for now in first..count {
            let solve = |(number, place): (usize, &Place)| {
                let state = match now.checked_sub(1) {
                    None => &place.start,
                    Some(ended) if now == first => &self.solved(Course::Whole, ended)[number].end,
                    Some(ended) => &self.solved(course, ended)[number].end,
                };
                place.solve(state, &self.arriving(&place.node, course, now))
            };
            let solved = self.places.iter().enumerate().map(solve).collect();
            self.known.get_mut(&course).expect("it is followed").push(solved);
        }
    }

    /// What the nodes do on a step.
    fn solved(&self, course: Course, step: usize) -> &[Solved] {
        &self.known[&course][step - course.first()]
    }

    /// A wave that entered its bar so many steps before: before the first it was what it was at the start.
    fn entered(
        &self,
        (bar, direction): (usize, usize),
        delay: Option<usize>,
        course: Course,
        now: usize,
    ) -> OnStep {
        let own = &self.waves[bar];
        let entered =
            delay.and_then(|delay| Some((course.before(delay)?, now.checked_sub(delay)?)));
        match (own.ends[direction], entered) {
            (Some(node), Some((course, step))) => {
                self.solved(course, step)[node].leaving[1 - direction].clone()
            }
            _ => own.before[direction].clone(),
        }
    }

    /// The waves that arrive at the left and at the right of a node.
    fn arriving(&self, node: &Node<Varying>, course: Course, now: usize) -> [OnStep; 2] {
        [(node.left, 0), (node.right, 1)].map(|(side, direction)| match side {
            Side::Bar(bar) => self.entered((bar, direction), self.waves[bar].lag, course, now),
            _ => OnStep::constant(&Varying::zero()),
        })
    }

    fn part(&self, seen: &Seen, course: Course, now: usize) -> OnStep {
        match seen {
            Seen::Velocity { node, run } => {
                self.solved(course, now)[*node].velocities[*run].clone()
            }
            Seen::Compression { node, place } => {
                let kept = self.places[*node].system.kept[*place];
                let own = kept.map(|kept| self.solved(course, now)[*node].both[kept].clone());
                own.unwrap_or_else(|| OnStep::constant(&Varying::zero()))
            }
            Seen::Wave { bar, direction, delay } => {
                self.entered((*bar, *direction), *delay, course, now)
            }
        }
    }
}

impl Place {
    /// What the node does on a step that begins with this state.
    ///
    /// `P` solves `y' = A y + B u` up to a residual `ρ`, what is rounded and what the last term leaves. So the error
    /// `e = y − P` obeys `e' = A e + B e_u + ρ`: where it begins with `|e| ≤ ε`, it is `ε + ∫|ρ| + |B e_u| ∫|e^(Ax)|` at most.
    fn solve(&self, start: &NodeState, arriving: &[OnStep; 2]) -> Solved {
        let (system, bits) = (&self.system, MAX_SYMBOL_BITS);
        debug_assert!(arriving.iter().all(|own| own.coefficients.len() <= TERMS));
        let blocks = &self.passivity.blocks;
        let acting: Vec<&OnStep> = arriving.iter().chain(&self.driven).collect();
        let mut off = vec![Magnitude::ZERO; blocks.len()];
        let mut columns = vec![start.values.clone()];
        for k in 0..TERMS {
            let both: Vec<Varying> = columns[k]
                .iter()
                .cloned()
                .chain(acting.iter().map(|own| own.coefficient(k)))
                .collect();
            let next =
                system.change.iter().map(|row| dot(row, &both, bits).over(k as u64 + 1, bits));
            let (next, left): (Vec<Varying>, Vec<Magnitude>) = match k + 1 < TERMS {
                true => next.map(|own| own.split()).unzip(),
                false => next.map(|own| (Varying::zero(), own.magnitude())).unzip(),
            };
            for (off, block) in off.iter_mut().zip(blocks) {
                *off = off.add(&block.size(block.members.iter().map(|i| left[*i])));
            }
            columns.push(next);
        }
        columns.pop();
        let sums = (0..system.states()).map(|i| {
            columns.iter().fold(Varying::zero(), |sum, column| sum.add(&column[i], bits)).split()
        });
        let (values, rounded): (Vec<Varying>, Vec<Magnitude>) = sums.unzip();
        let mut on_step = vec![Magnitude::ZERO; system.states()];
        let mut errors = Vec::with_capacity(blocks.len());
        let one = Number::one();
        let arrived: Vec<Magnitude> = acting.iter().map(|own| own.error).collect();
        for ((block, error), off) in blocks.iter().zip(&start.errors).zip(off) {
            let added = off.add(&block.push(&arrived).multiply(&block.memory(&one.magnitude())));
            let most = error.size().add(&added);
            for (place, member) in block.members.iter().enumerate() {
                on_step[*member] = block.entry(place, &most);
            }
            let rounded = block.size(block.members.iter().map(|i| rounded[*i]));
            errors.push(error.clone().after(&one, &added.add(&rounded), block));
        }
        let own = on_step.into_iter().enumerate().map(|(i, error)| OnStep {
            coefficients: columns.iter().map(|column| column[i].clone()).collect(),
            error,
        });
        let both: Vec<OnStep> = own.chain(acting.into_iter().cloned()).collect();
        let runs = system.group.len();
        let velocities =
            system.output[..runs].iter().map(|row| OnStep::sum(row, both.iter())).collect();
        let leaving = [(0, 0), (1, runs - 1)].map(|(side, run)| {
            let mut row = system.output[run].clone();
            let own = &mut row[system.states() + side];
            *own = own.subtract(&Varying::one(), bits);
            OnStep::sum(&row, both.iter())
        });
        Solved { both, velocities, leaving, end: NodeState { values, errors } }
    }
}
