//! The method of steps with proof: nodes are followed from cell to cell, contacts open and close.
//!
//! On a cell all that arrives at a node is known as series, since it left another node a travel time
//! before. The node answers with series of its own. A contact that would pull opens, and one whose gap
//! would become negative closes; the cell ends there, and the next one begins with other equations.
//! Every node has a time of its own and is at most a travel time ahead of its neighbours.

use crate::ball::{Magnitude, Number};
use crate::expression::Fraction;
use crate::history::cells::Cells;
use crate::history::contacts::{Cause, Contact, Guard, Happening};
use crate::history::error::{HistoryError, NotFollowed, Outcome, Question};
use crate::history::leaving::Passing;
use crate::history::load::Course;
use crate::history::moment::{Clock, Moment};
use crate::history::motion::Motion;
use crate::history::part::Source;
use crate::history::passive::ErrorEnergy;
use crate::history::passivity::{Known, Passivity, StateError};
use crate::history::pressing::TooLong;
use crate::history::series::{CellNorm, LONGEST_CELL, Series, Truncation};
use crate::history::track::{Arriving, Track};
use crate::limits::{MAX_CONTACTS, MAX_HISTORY_CELLS, memory, pause, tell_done};
use crate::network::{
    Contacts, ElementLaw, Layout, Lumped, Network, Node, Side, System, Unresisted,
};
use crate::scene::{Dimension, ElementIndex};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep_polynomial::{Rational, Symbol};

/// Doubles tell instants apart that differ by more than this part of the later one.
pub const TOLD_APART: f64 = 1e-12;

/// The most changes of contacts of one node at one instant.
const MAX_CHANGES: usize = 16;

/// So many bits beyond what is known of a node are worked with, and so many at least.
const SPARE_BITS: i64 = 48;
const LEAST_BITS: u64 = 96;

/// Memory and cells are foreseen each time a window has grown by this factor.
const OFTEN: f64 = 1.125;

/// After each so many cells it is asked how long they will be as short as fast motions need.
const SHORT_CELLS: usize = 64;

/// What a node did on one cell.
pub(crate) struct Cell {
    /// Velocities of its runs.
    pub velocities: Vec<Series>,
    /// Displacements of its runs since the start, when it begins.
    pub displacements: Vec<Number>,
    pub length: Magnitude,
    /// The compressions of its springs and local contacts, the displacements of its supports: zero for elements
    /// that have none and for springs that hang on an open contact, minus the gap of an open local contact.
    pub compressions: Vec<Series>,
    /// Forces of its contacts, zero where they are open, in the order of [`Node::contacts`].
    pub forces: Vec<Series>,
    /// Gaps of its contacts, zero where they are closed.
    pub gaps: Vec<Series>,
}

impl Cell {
    /// How many bytes it takes, about.
    pub fn bytes(&self) -> u64 {
        let all = [&self.velocities, &self.compressions, &self.forces, &self.gaps];
        all.into_iter().flatten().map(Series::bytes).sum()
    }
}

/// A force that acts for a while.
pub(crate) struct Load {
    course: Course,
    from: Fraction,
    pub until: Option<Fraction>,
}

impl Load {
    /// Whether it acts no more after an instant.
    pub fn has_ended(&self, clock: &Clock, now: &Moment) -> Outcome<bool> {
        let Some(until) = &self.until else { return Ok(false) };
        Ok(clock.compare(&Moment::at(until.clone()), now)?.is_le())
    }
}

/// How far a cell reaches, and what acts on the node there.
pub(crate) struct Reach {
    end: Moment,
    /// Whether nothing changes at its end: it is as long as the rates allow.
    is_step: bool,
    length: Number,
    pub norm: CellNorm,
    pub inputs: Vec<Series>,
}

/// How long a cell may be.
#[derive(Clone, Copy)]
struct Longest<'a> {
    /// The rate of the free motion, and which share of the cell that it allows is taken.
    rate: Magnitude,
    share: &'a Rational,
    /// Where more is known, a length.
    most: Option<&'a Rational>,
}

/// What a node does on a cell, before it is taken over.
pub(crate) struct Planned {
    pub inputs: Vec<Series>,
    pub motion: Motion,
    guards: Vec<Guard>,
    pub end: Moment,
    pub length: Number,
    /// The contact that changes at the end of the cell, because its force or gap comes to zero.
    first: Option<usize>,
}

impl Planned {
    fn norm(&self, cut: &Truncation) -> CellNorm {
        CellNorm::of_series(self.inputs.iter().chain(&self.motion.state), &self.length, cut)
    }
}

/// A node as it is.
pub(crate) struct State {
    pub now: Moment,
    /// As a double.
    pub about: f64,
    pub system: System<Number>,
    pub passivity: Passivity,
    pub state: Vec<Number>,
    /// Of each block of the state.
    pub errors: Vec<StateError>,
    pub arriving: [Arriving; 2],
    /// Of what leaves at its left and at its right.
    pub passing: [Option<Passing>; 2],
    pub(super) displacements: Vec<Number>,
    /// How long its last cell beside a pressed local contact was allowed to be.
    pressed_for: Option<Rational>,
    /// Whether it is followed no longer.
    pub is_gone: bool,
}

impl State {
    pub fn known(&self) -> Known<'_> {
        self.passivity.known(&self.state, &self.errors)
    }
}

/// Scene, waves and nodes as far as they are known.
pub(crate) struct Engine {
    pub clock: Clock,
    pub cut: Truncation,
    pub layout: Layout,
    pub nodes: Vec<Node<Number>>,
    pub loads: BTreeMap<ElementIndex, Load>,
    /// Of each bar the impedance and the travel time.
    pub bars: Vec<(Number, Option<Fraction>)>,
    /// Of each bar the waves to the right and to the left, as they leave its ends.
    pub waves: Vec<[Track; 2]>,
    /// What each node did.
    pub cells: Vec<Cells<Cell>>,
    pub happenings: Vec<Happening>,
    pub states: Vec<State>,
    pub open: Vec<Contact>,
    pub places: Vec<String>,
    /// Of the elements of the scene.
    names: Vec<String>,
    pub count: usize,
    /// What the cells hold that are kept, about.
    pub bytes: u64,
    /// The time before which nothing is asked for, and that before which nothing tells whether bodies have parted.
    pub asked_from: f64,
    pub watched_from: f64,
    /// Whether bodies are followed no longer: all contacts are open for ever, and nobody asks for their gaps.
    pub has_let_go: bool,
    /// Whether waves are kept that leave for ever.
    pub keeps_departed: bool,
    /// What is asked for; without it all.
    pub asked_sources: Option<Vec<Source>>,
    /// How far it is followed in all, as far as that is known.
    pub whole: f64,
    /// The size of the largest wave so far, at the start of its cell, and of the terms that its values are the sum of.
    pub loudest: Magnitude,
    pub steepest: Magnitude,
    /// The energy of all errors so far; not known where there are local contacts, which are not linear.
    pub errors: Option<ErrorEnergy>,
}

/// The impedance and the two waves of a bar before the start: `(V ± X_0/Z)/2`.
fn before(network: &Network, layout: &Layout, clock: &Clock, bar: usize) -> Outcome<[Number; 2]> {
    let data = &network.model().bars[&layout.bars[bar]];
    let (velocity, force) = (clock.number(&data.velocity)?, clock.number(&data.force)?);
    let pressed =
        force.multiply(&clock.number(&data.impedance)?.reciprocal(clock.bits)?, clock.bits);
    Ok([
        velocity.add(&pressed, clock.bits).over(2, clock.bits),
        velocity.subtract(&pressed, clock.bits).over(2, clock.bits),
    ])
}

/// All loads of a scene.
fn loads(network: &Network, clock: &Clock) -> Outcome<BTreeMap<ElementIndex, Load>> {
    let time = &network.scene().time;
    let mut loads = BTreeMap::new();
    for (element, load) in &network.model().loads {
        let course = Course::of(&clock.numbers, &load.course, time, clock.bits)?;
        let (from, until) = (load.from.clone(), load.until.clone());
        loads.insert(*element, Load { course, from, until });
    }
    Ok(loads)
}

/// The nodes of a line in numbers.
fn nodes(network: &Network, layout: &Layout, clock: &Clock) -> Outcome<Vec<Node<Number>>> {
    let model = network.model();
    let of_masses = model.lumps.values().filter_map(|law| match law {
        ElementLaw::Mass { velocity, .. } => Some(velocity),
        _ => None,
    });
    let velocities = model.bars.values().map(|bar| &bar.velocity).chain(of_masses);
    let mut fastest = 0.0_f64;
    for velocity in velocities {
        fastest = fastest.max(clock.number(velocity)?.ball(64).to_double().0.abs());
    }
    let fastest = if fastest > 0.0 { fastest } else { 1.0 };
    let mut nodes = Vec::with_capacity(layout.nodes.len());
    for node in &layout.nodes {
        let node = node.map(|value| clock.number(value))?;
        if let Some(load) = node.imposed_beside_inertia() {
            let name = network.scene().elements[load.element].name.clone();
            return Err(NotFollowed::ImposedVelocity(name).into());
        }
        nodes.push(node.with_typical_compressions(fastest, clock.bits)?);
    }
    Ok(nodes)
}

impl Engine {
    /// The scene at its start.
    pub fn new(network: &Network, contacts: Contacts, bits: u64) -> Outcome<Engine> {
        let numbers = crate::enclosure::Numbers::new(&network.model().constants);
        let mut symbols = network.model().assumptions.symbols().map(|(symbol, _)| symbol);
        if let Some(symbol) = symbols.find(|symbol: &&Symbol| numbers.value(symbol, 64).is_none()) {
            return Err(HistoryError::MissingValue(symbol.clone()));
        }
        let clock = Clock::new(numbers, bits, &network.assumed);
        let layout = Layout::of(network.scene(), network.model(), contacts);
        let nodes = nodes(network, &layout, &clock)?;
        let loads = loads(network, &clock)?;
        let mut bars = Vec::new();
        let mut waves = Vec::new();
        for (bar, element) in layout.bars.iter().enumerate() {
            let data = &network.model().bars[element];
            bars.push((clock.number(&data.impedance)?, data.travel.clone()));
            let time = data.travel.clone().unwrap_or_else(Fraction::one);
            let values = before(network, &layout, &clock, bar)?;
            let [right, left] = values.map(|value| Track::new(value, &time, &clock));
            waves.push([right?, left?]);
        }
        let places: Vec<String> =
            (0..nodes.len()).map(|node| format!("{}:", network.place_in_words(node))).collect();
        let names = network.scene().elements.iter().map(|element| element.name.clone()).collect();
        let mut engine = Engine {
            clock,
            cut: Truncation::new(bits, 0),
            layout,
            nodes,
            loads,
            bars,
            waves,
            cells: Vec::new(),
            happenings: Vec::new(),
            states: Vec::new(),
            open: Vec::new(),
            places,
            names,
            count: 0,
            bytes: 0,
            asked_from: 0.0,
            watched_from: f64::INFINITY,
            has_let_go: false,
            keeps_departed: false,
            asked_sources: None,
            whole: 0.0,
            loudest: Magnitude::ZERO,
            steepest: Magnitude::ZERO,
            errors: network.local_contact().is_none().then_some(ErrorEnergy::NONE),
        };
        let seconds = if network.scene().dimensional { " s" } else { "" };
        engine.clock.tell_in(engine.unit(network, Dimension::TIME)?, seconds);
        engine.set_rate()?;
        engine.begin()?;
        Ok(engine)
    }

    /// Why rigid masses of two runs cannot meet, or one of the first with the wall at the second.
    pub fn impact(
        &self,
        node: &Node<Number>,
        [left, right]: [usize; 2],
        now: Option<&Moment>,
    ) -> NotFollowed {
        let masses = |run: usize| {
            let masses = node.elements.iter().filter(move |own| own.run == run);
            masses.filter(|own| matches!(own.law, ElementLaw::Mass { .. }))
        };
        let name = |mass: Option<&Lumped<Number>>| {
            self.names[mass.expect("the run has a mass").element].clone()
        };
        let time = now.and_then(|now| self.clock.time(now).ok());
        let at =
            time.map_or_else(String::new, |time| format!(" at t = {}", self.clock.told(&time)));
        if node.is_held(right) {
            return NotFollowed::ImpactOnWall { mass: name(masses(left).next()), at };
        }
        let masses = [masses(left).next_back(), masses(right).next()];
        NotFollowed::RigidImpact { masses: masses.map(name), at }
    }

    /// The rate of the norm of cells: above the norm of each node in any state of its contacts, and the
    /// rate of any load.
    fn set_rate(&mut self) -> Outcome<()> {
        let mut largest = Magnitude::ZERO;
        for (number, node) in self.nodes.iter().enumerate() {
            let contacts: Vec<usize> = node.contacts().map(|(contact, _)| contact).collect();
            if contacts.len() > MAX_CONTACTS {
                let place = self.places[number].clone();
                let (contacts, limit) = (contacts.len(), MAX_CONTACTS);
                return Err(NotFollowed::ContactsInOnePlace { place, contacts, limit }.into());
            }
            for choice in 0..1_u32 << contacts.len() {
                let closed = |contact: usize| {
                    let place = contacts.iter().position(|own| *own == contact);
                    place.is_some_and(|place| choice >> place & 1 == 1)
                };
                // A state that is refused is refused when it comes.
                let Ok(system) = System::of(node, closed, self.cut.bits) else { continue };
                largest = largest.max(Passivity::of(node, &system)?.rate());
            }
        }
        for load in self.loads.values() {
            largest = largest.max(load.course.rate());
        }
        self.cut = Truncation::new(self.cut.bits, largest.top().unwrap_or(0));
        Ok(())
    }

    /// The nodes at the start, all contacts closed but those that begin apart.
    fn begin(&mut self) -> Outcome<()> {
        let start = Moment::at(Fraction::zero());
        let gaps = self.layout.contacts.iter().map(|own| self.clock.number(&own.gap));
        self.open = gaps.map(|gap| Ok(Contact::begun(gap?))).collect::<Outcome<_>>()?;
        for (number, node) in self.nodes.iter().enumerate() {
            let bits = self.cut.bits;
            let system = self.system(number, |contact| self.open[contact].closed)?;
            let still = vec![Number::zero(); node.elements.len()];
            let velocity = |run: usize| self.starting_velocity(node, run);
            let impact = |runs| self.impact(node, runs, None);
            let state = system.state(node, velocity, &still, impact, bits)?;
            let passivity = Passivity::at(node, &system, (&state, bits))?;
            let errors = passivity.errors(&state);
            if let Some(all) = &mut self.errors {
                errors.iter().for_each(|own| all.add_state(&own.size()));
            }
            let arriving = [node.left, node.right].into_iter().zip([0, 1]);
            let arriving = arriving.map(|(side, direction)| match side {
                Side::Bar(bar) => match &self.bars[bar].1 {
                    Some(travel) => {
                        Arriving::Delayed { bar, direction, travel: travel.clone(), cell: 0 }
                    }
                    None => {
                        let before = self.waves[bar][direction].before();
                        Arriving::Constant(before.coefficient(0))
                    }
                },
                _ => Arriving::Nothing,
            });
            let arriving: Vec<Arriving> = arriving.collect();
            let Ok(arriving) = <[Arriving; 2]>::try_from(arriving) else { unreachable!() };
            let displacements = vec![Number::zero(); node.runs()];
            let now = start.clone();
            self.states.push(State {
                now,
                about: 0.0,
                system,
                passivity,
                state,
                errors,
                arriving,
                passing: [None, None],
                displacements,
                pressed_for: None,
                is_gone: false,
            });
            self.cells.push(Cells::default());
        }
        Ok(())
    }

    /// The system of a node with these contacts closed.
    pub fn system(
        &self,
        node: usize,
        is_closed: impl Fn(usize) -> bool,
    ) -> Outcome<System<Number>> {
        let system = System::of(&self.nodes[node], is_closed, self.clock.bits);
        let place = || self.places[node].clone();
        Ok(system.map_err(|Unresisted| NotFollowed::Massless { place: place() })?)
    }

    /// The velocity of the masses of a run before the start.
    pub fn starting_velocity(&self, node: &Node<Number>, run: usize) -> Option<Number> {
        let bits = self.cut.bits;
        let masses = node.attached(run).filter_map(|own| match &own.law {
            ElementLaw::Mass { mass, velocity } => Some((mass, velocity)),
            _ => None,
        });
        let mut masses = masses.peekable();
        let first = masses.peek()?.1.clone();
        let mut momentum = Number::zero();
        let mut same = true;
        for (mass, velocity) in masses {
            same &= *velocity == first;
            momentum = momentum.add(&mass.multiply(velocity, bits), bits);
        }
        if same {
            return Some(first);
        }
        let inverse = node.mass_of(run, bits).reciprocal(bits).ok()?;
        Some(momentum.multiply(&inverse, bits))
    }

    /// Follows all nodes to an instant and a little further.
    ///
    /// # Errors
    /// [`HistoryError`], all kinds but [`HistoryError::AfterLast`].
    pub fn follow_until(&mut self, until: &Moment) -> Outcome<()> {
        let followed = self.foresee_cells(until, |_| true).and_then(|()| self.follow_all(until));
        tell_done(0.0, "");
        followed
    }

    fn follow_all(&mut self, until: &Moment) -> Outcome<()> {
        let (mut looked, end) = (Vec::new(), self.clock.about(until));
        self.whole = self.whole.max(end);
        while let Some((node, now)) = self.behind() {
            if self.clock.compare(now, until)? == Ordering::Greater {
                break;
            }
            pause();
            let passed = self.states[node].about / end;
            tell_done(self.states[node].about / self.whole, "of the window");
            if looked.last().is_none_or(|(last, _)| passed > OFTEN * last) {
                looked.push((passed, self.count));
                self.foresee_memory(node, until)?;
                self.foresee_growth(node, &looked)?;
            }
            self.advance(node)?;
        }
        Ok(())
    }

    /// The node that was followed the least far, and how far. What arrives there has left the others:
    /// one that is further, however little, may ask for what is not known yet.
    pub fn behind(&self) -> Option<(usize, &Moment)> {
        let states = self.states.iter().enumerate().filter(|(_, state)| !state.is_gone);
        let behind = states
            .reduce(|least, other| if self.is_earlier(other.1, least.1) { other } else { least });
        behind.map(|(node, state)| (node, &state.now))
    }

    /// Which node was followed less far, by doubles where these tell; what nothing tells apart is not earlier.
    fn is_earlier(&self, one: &State, other: &State) -> bool {
        let (a, b) = (one.about, other.about);
        match (a - b).abs() > TOLD_APART * a.abs().max(b.abs()) {
            true => a < b,
            false => matches!(self.clock.compare(&one.now, &other.now), Ok(Ordering::Less)),
        }
    }

    /// When the inputs of a node change next, but no later than a cell may be long; and whether that is what ends it.
    fn next_change(
        &self,
        node: usize,
        Longest { rate, share, most }: Longest<'_>,
    ) -> Outcome<(Moment, bool)> {
        let state = &self.states[node];
        let mut ends: Vec<Moment> =
            state.arriving.iter().filter_map(|arriving| arriving.end(&self.waves)).collect();
        for load in self.loads_of(node) {
            for time in std::iter::once(&load.from).chain(&load.until) {
                let time = Moment::at(time.clone());
                if self.clock.compare(&time, &state.now)? == Ordering::Greater {
                    ends.push(time);
                }
            }
        }
        let mut first: Option<Moment> = None;
        for end in ends {
            first = Some(match first {
                Some(first) => self.clock.earlier(first, end)?,
                None => end,
            });
        }
        let rates = self.loads_of(node).map(|load| load.course.rate());
        // Where hardly anything has a rate and nothing arrives, a cell is as long as all before it, and a unit of time at least.
        let so_long = || Rational::from_float(state.about.max(1.0).floor()).expect("a finite time");
        let by_rate = |top| Rational::from(&Magnitude::power_of_two(LONGEST_CELL - top));
        let longest = match (most, rates.fold(rate, Magnitude::max).top(), &first) {
            (Some(most), ..) => most.clone(),
            (_, Some(top), Some(_)) => by_rate(top) * share,
            (_, Some(top), None) => by_rate(top).min(so_long()) * share,
            (None, None, None) => so_long() * share,
            (None, None, Some(first)) => return Ok((first.clone(), false)),
        };
        let step = Clock::step(&state.now, &longest);
        Ok(match first {
            Some(first) if self.clock.compare(&first, &step)? != Ordering::Greater => {
                (first, false)
            }
            _ => (step, true),
        })
    }

    /// The loads of a node, from left to right.
    fn loads_of(&self, node: usize) -> impl Iterator<Item = &Load> {
        self.nodes[node].elements.iter().filter_map(|own| self.loads.get(&own.element))
    }

    /// What acts on a node on a cell of a length from now on: arriving waves, then its loads and, nothing yet, its
    /// local contacts; and the norm of the cell, as rough as these are.
    fn inputs(&self, node: usize, length: Magnitude) -> Outcome<(Vec<Series>, CellNorm)> {
        let state = &self.states[node];
        let arriving = |own: &Arriving| own.series(&self.waves, &state.now, &self.clock, &self.cut);
        let arriving = state.arriving.iter().map(arriving).collect::<Result<Vec<_>, _>>()?;
        let roughness = arriving.iter().filter_map(|series| series.roughness).max();
        let mut norm = CellNorm::new(length, &self.cut);
        norm.roughness = roughness;
        let settled = arriving.iter().map(|series| series.settled(&norm, &self.cut));
        let mut inputs: Vec<Series> = settled.collect();
        for own in self.nodes[node].elements.iter().filter(|own| own.law.is_driven()) {
            let Some(load) = self.loads.get(&own.element) else {
                inputs.push(Series::zero());
                continue;
            };
            let begun = self.clock.compare(&Moment::at(load.from.clone()), &state.now)?;
            inputs.push(match begun.is_le() && !load.has_ended(&self.clock, &state.now)? {
                true => load.course.series(&self.clock.time(&state.now)?, &norm, &self.cut)?,
                false => Series::zero(),
            });
        }
        Ok((inputs, norm))
    }

    /// Follows a node over one cell.
    pub fn advance(&mut self, node: usize) -> Outcome<()> {
        self.count += 1;
        if self.count > MAX_HISTORY_CELLS {
            return Err(self.too_many_cells(node)?);
        }
        if self.bytes > memory() {
            return Err(self.too_much_memory(node)?);
        }
        let all = self.cut.bits;
        self.cut.bits = self.bits_of(node);
        let advanced = self.advance_over(node);
        self.cut.bits = all;
        self.forget(node);
        advanced
    }

    fn advance_over(&mut self, node: usize) -> Outcome<()> {
        self.follow_stiffness(node)?;
        let whole = Rational::from_integer(1.into());
        let planned = match self.plan(node, &whole)? {
            Ok(planned) => planned,
            // By chance a force or gap becomes zero just where the longest cell ends: a shorter one tells.
            Err(_) => self.plan(node, &Rational::new(7.into(), 8.into()))??,
        };
        if self.cells[node].is_empty() {
            self.tell_impacts(node, &planned.guards);
        }
        let first = planned.first;
        self.finish(node, planned)?;
        if let Some(contact) = first {
            self.change(node, &[contact], Cause::Crossing)?;
        }
        Ok(())
    }

    /// The precision that is of use for the next cell of a node: errors that have come together since the start hide
    /// what is far below them, but for what the terms of series lose where they cancel. A local contact begins below any of them.
    fn bits_of(&self, node: usize) -> u64 {
        let is_local = |law: &ElementLaw<Number>| matches!(law, ElementLaw::LocalContact { .. });
        if self.nodes[node].elements.iter().any(|own| is_local(&own.law)) {
            return self.cut.bits;
        }
        let state = &self.states[node];
        let own = state.errors.iter().map(|error| (error.size(), self.cut.largest));
        let arrives = state.arriving.iter().map(|own| (own.error(&self.waves), self.loudest));
        let known = own.chain(arrives).filter_map(|(error, size)| Some(size.top()? - error.top()?));
        let cancelled = match (self.steepest.top(), self.loudest.top()) {
            (Some(terms), Some(wave)) => terms - wave,
            _ => 0,
        };
        known.min().map_or(self.cut.bits, |bits| {
            let bits = bits.saturating_add(cancelled + SPARE_BITS);
            let bits = u64::try_from(bits).unwrap_or(0);
            bits.max(LEAST_BITS).min(self.cut.bits)
        })
    }

    /// How far the next cell of a node reaches, no longer than `most`. Where that or the rate of its free motion is what
    /// ends the cell, and the fastest of that has died out, a second look finds a longer one.
    fn next_cell(
        &mut self,
        node: usize,
        share: &Rational,
        most: Option<&Rational>,
    ) -> Outcome<Reach> {
        let fastest = self.states[node].passivity.rate();
        let reach = self.reach(node, Longest { rate: fastest, share, most })?;
        if !reach.is_step {
            return Ok(reach);
        }
        let state = &self.states[node];
        let cell = (&reach.norm, &self.cut);
        let free = state.system.free_rate(state.known(), &reach.inputs, cell);
        if free.scale(1) < fastest {
            return self.reach(node, Longest { rate: free, share, most: None });
        }
        if self.count.is_multiple_of(SHORT_CELLS) {
            self.foresee_short_cells(node, &reach)?;
        }
        Ok(reach)
    }

    /// How far a cell reaches that is no longer than it may be.
    fn reach(&mut self, node: usize, longest: Longest<'_>) -> Outcome<Reach> {
        let (end, is_step) = self.next_change(node, longest)?;
        let length = self.clock.since(&self.states[node].now, &end)?;
        self.cut.longest = self.cut.longest.max(length.magnitude());
        let (inputs, norm) = self.inputs(node, length.magnitude())?;
        Ok(Reach { end, is_step, length, norm, inputs })
    }

    /// How far the next cell of a node reaches, and what the node does there. Beside a pressed local contact it is as
    /// short as the motion can be followed at once.
    fn answer(&mut self, node: usize, share: &Rational) -> Outcome<(Reach, Motion)> {
        let rate = self.states[node].passivity.rate();
        // What was short enough before tells about how long the next cell may be.
        let before = self.states[node].pressed_for.take();
        let most = before.map(|length| length * Rational::from_integer(2.into()));
        let mut reach = self.next_cell(node, share, most.as_ref())?;
        loop {
            let state = &self.states[node];
            let cell = (&reach.norm, &self.cut);
            match state.system.solve(state.known(), &mut reach.inputs, cell) {
                Ok(motion) => return Ok((reach, motion)),
                Err(TooLong(most)) => {
                    reach = self.reach(node, Longest { rate, share, most: Some(&most) })?;
                    self.states[node].pressed_for = Some(most);
                }
            }
        }
    }

    /// What a node does on its next cell, no longer than this share of the longest. The inner error is that
    /// of a cell that a shorter one may mend.
    fn plan(&mut self, node: usize, share: &Rational) -> Outcome<Outcome<Planned>> {
        let (mut changed, mut is_lengthened) = (0, false);
        loop {
            let (Reach { end, is_step, length, norm, inputs }, motion) =
                self.answer(node, share)?;
            let guards = self.guards(node, &motion, &inputs, &norm);
            let changes = self.changes(node, &guards)?;
            if changes.is_empty() {
                return Ok(match self.first_change(node, &guards, (&length, is_step), &norm) {
                    Ok(None) => Ok(Planned { inputs, motion, guards, end, length, first: None }),
                    Ok(Some((contact, length))) => {
                        let end = self.clock.later(&self.states[node].now, &length)?;
                        Ok(Planned { inputs, motion, guards, end, length, first: Some(contact) })
                    }
                    // A contact comes to its end near that of the cell, which may be longer where it is light.
                    Err(HistoryError::Undecided { .. })
                        if is_step && !is_lengthened && guards.iter().any(Guard::is_light) =>
                    {
                        is_lengthened = true;
                        self.states[node].pressed_for = Some(Rational::from(&norm.length.scale(2)));
                        continue;
                    }
                    Err(error) if is_step && error.is_at_an_end() => Err(error),
                    Err(error) => return Err(error),
                });
            }
            changed += changes.len();
            if changed > MAX_CHANGES {
                let now = self.clock.time(&self.states[node].now)?;
                return Err(self.clock.undecided(Question::Simultaneous, &now));
            }
            let changes = self.yielding(node, changes)?;
            self.change(node, &changes, Cause::Jump)?;
        }
    }

    /// Takes over what a node did until an instant.
    fn finish(&mut self, node: usize, mut planned: Planned) -> Outcome<()> {
        // With a tie a contact may open at the end of any cell.
        let opens = planned.first.is_some() || self.clock.has_ties();
        let Planned { inputs, motion, guards, .. } = &mut planned;
        let pushes = !guards.iter().any(Guard::may_be_idle);
        let forces = guards.iter_mut().filter_map(Guard::force_mut);
        for series in forces.chain(inputs).chain(&mut motion.velocities) {
            series.keep_sign(pushes, opens);
        }
        let cut = self.cut;
        let norm = planned.norm(&cut);
        let leaving = self.leaving(node, &planned, &norm)?;
        self.count_leaving(&leaving);
        let Planned { motion, guards, end, length, .. } = planned;
        let length = &length;
        let own = &self.nodes[node];
        let now = self.states[node].now.clone();
        for (guard, (contact, _)) in guards.iter().zip(own.contacts()) {
            let is_unloaded = self.is_unloaded(guard, &norm);
            let contact = &mut self.open[contact];
            contact.flat = 0;
            contact.gap = guard.gap_after(length, cut.bits);
            if contact.closed {
                match is_unloaded {
                    true if !contact.pressed => {}
                    false if contact.pressed || !guard.may_be_idle() => contact.push(&now),
                    // No force any more, or none yet that is known of.
                    _ => {
                        contact.idle.get_or_insert_with(|| now.clone());
                    }
                }
            }
        }
        let state = &mut self.states[node];
        let displacements = state.displacements.clone();
        for (velocity, start) in motion.velocities.iter().zip(&mut state.displacements) {
            let displacement = velocity.integral_over(start.clone(), &norm.length, &cut);
            *start = velocity.integrated(&displacement, length, cut.bits);
        }
        let compressions = state
            .system
            .kept
            .iter()
            .map(|place| place.map_or_else(Series::zero, |place| motion.state[place].clone()));
        let mut compressions: Vec<Series> = compressions.collect();
        for (guard, (contact, _)) in guards.iter().zip(own.contacts()) {
            if let Some(place) = own.local_contact(contact) {
                guard.complete(&mut compressions[place], cut.bits);
            }
        }
        let errors = (&state.errors[..], &mut self.errors);
        (state.state, state.errors) =
            state.system.ended(&state.passivity, &motion, errors, length, &cut);
        for block in &state.passivity.blocks {
            let own = block.members.iter().map(|member| state.state[*member].magnitude());
            self.cut.largest = self.cut.largest.max(block.size(own));
        }
        for arriving in &mut state.arriving {
            let ends = arriving.end(&self.waves);
            if let (Arriving::Delayed { cell, .. }, Some(ends)) = (arriving, ends)
                && self.clock.compare(&ends, &end)? == Ordering::Equal
            {
                *cell += 1;
            }
        }
        self.send(node, leaving, &end);
        let velocities = motion.velocities;
        let (forces, gaps) = guards.into_iter().map(Guard::into_force_and_gap).unzip();
        let length = norm.length;
        let cell = Cell { velocities, displacements, length, compressions, forces, gaps };
        self.bytes += cell.bytes();
        self.cells[node].push(now, cell);
        self.states[node].about = self.clock.about(&end);
        self.states[node].now = end;
        Ok(())
    }

    /// Until when a node was followed.
    pub fn now(&self, node: usize) -> &Moment {
        &self.states[node].now
    }

    /// How many cells were worked out.
    pub fn count(&self) -> usize {
        self.count
    }
}
