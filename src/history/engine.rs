//! The method of steps with proof: nodes are followed from cell to cell, contacts open and close.
//!
//! On a cell all that arrives at a node is known as series, since it left another node a travel time
//! before. The node answers with series of its own. A contact that would pull opens, and one whose gap
//! would become negative closes; the cell ends there, and the next one begins with other equations.
//! Every node has a time of its own and is at most a travel time ahead of its neighbours.

use crate::ball::{Ball, Magnitude, Number};
use crate::expression::Fraction;
use crate::history::contacts::{Cause, Contact, Happening};
use crate::history::error::{HistoryError, NotFollowed, Question};
use crate::history::load::Course;
use crate::history::moment::{Clock, Moment};
use crate::history::motion::Motion;
use crate::history::series::{LONGEST_CELL, Series, Truncation};
use crate::history::track::{Arriving, Track};
use crate::limits::{MAX_CONTACTS, MAX_HISTORY_CELLS};
use crate::network::{Contacts, ElementLaw, Layout, Network, Node, Side, System, Unresisted};
use crate::scene::{Drive, ElementIndex};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep_polynomial::{Rational, Symbol};

/// Doubles tell instants apart that differ by more than this part of the later one.
const TOLD_APART: f64 = 1e-12;

/// The most changes of contacts of one node at one instant.
const MAX_CHANGES: usize = 16;

/// What a node did on one cell.
pub(crate) struct Cell {
    /// Velocities of its runs.
    pub velocities: Vec<Series>,
    /// Displacements of its runs since the start.
    pub displacements: Vec<Series>,
    /// The displacements of its elements: zero for those that have none, and for springs that hang on an
    /// open contact.
    pub compressions: Vec<Series>,
    /// Forces of its contacts, zero where they are open, in the order of [`Node::contacts`].
    pub forces: Vec<Series>,
    /// Gaps of its contacts, zero where they are closed.
    pub gaps: Vec<Series>,
}

/// A force that acts for a while.
pub(crate) struct Load {
    course: Course,
    from: Fraction,
    pub until: Option<Fraction>,
}

/// A node as it is.
pub(crate) struct State {
    pub now: Moment,
    pub system: System<Number>,
    pub state: Vec<Number>,
    arriving: [Arriving; 2],
    displacements: Vec<Number>,
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
    /// What each node did, with the start of each cell.
    pub cells: Vec<Vec<(Moment, Cell)>>,
    pub happenings: Vec<Happening>,
    pub states: Vec<State>,
    pub open: Vec<Contact>,
    pub places: Vec<String>,
    count: usize,
    /// The longest cell; none where nothing has a rate.
    step: Option<Rational>,
}

type Outcome<T> = Result<T, HistoryError>;

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
    let scene = network.scene();
    let mut loads = BTreeMap::new();
    for (element, load) in &network.model().loads {
        if network.model().lumps[element] == ElementLaw::Load(Drive::Velocity) {
            let name = scene.elements[*element].name.clone();
            return Err(NotFollowed::ImposedVelocity(name).into());
        }
        let course = Course::of(&clock.numbers, &load.course, &scene.time, clock.bits)?;
        let (from, until) = (load.from.clone(), load.until.clone());
        loads.insert(*element, Load { course, from, until });
    }
    Ok(loads)
}

impl Engine {
    /// The scene at its start.
    ///
    /// # Errors
    /// [`HistoryError::MissingValue`], [`HistoryError::Refused`].
    pub fn new(network: &Network, bits: u64) -> Outcome<Engine> {
        let numbers = crate::enclosure::Numbers::new(&network.model().constants);
        let mut symbols = network.model().assumptions.symbols().map(|(symbol, _)| symbol);
        if let Some(symbol) = symbols.find(|symbol: &&Symbol| numbers.value(symbol, 64).is_none()) {
            return Err(HistoryError::MissingValue(symbol.clone()));
        }
        let clock = Clock::new(numbers, bits);
        let layout = Layout::of(network.scene(), network.model(), Contacts::Links);
        let nodes = layout.nodes.iter().map(|node| node.map(|value| clock.number(value)));
        let nodes = nodes.collect::<Result<Vec<_>, _>>()?;
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
            count: 0,
            step: None,
        };
        engine.set_rate()?;
        engine.begin()?;
        Ok(engine)
    }

    /// The rate of the bound of series, four times the largest norm of a node in any state of its
    /// contacts, and twice the rate of any load.
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
                largest = largest.max(system.norms().0.scale(2));
            }
        }
        for load in self.loads.values() {
            largest = largest.max(load.course.rate().scale(1));
        }
        if let Some(rate) = largest.top() {
            self.cut = Truncation::new(self.cut.bits, rate);
            let step = Magnitude::power_of_two(LONGEST_CELL - rate);
            self.step = Some(Rational::from(&step));
        }
        Ok(())
    }

    /// The nodes at the start, all contacts closed.
    fn begin(&mut self) -> Outcome<()> {
        let start = Moment::at(Fraction::zero());
        let contact = || Contact {
            closed: true,
            gap: Number::zero(),
            rests: false,
            idle: None,
            pressed: false,
        };
        self.open = self.layout.contacts.iter().map(|_| contact()).collect();
        for (number, node) in self.nodes.iter().enumerate() {
            let bits = self.cut.bits;
            let system = self.system(number, |_| true)?;
            let still = vec![Number::zero(); node.elements.len()];
            let velocity = |run: usize| self.starting_velocity(node, run);
            let state = system.state(node, velocity, &still, &self.places[number], bits)?;
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
            self.states.push(State { now, system, state, arriving, displacements });
            self.cells.push(Vec::new());
        }
        Ok(())
    }

    /// The system of a node with these contacts closed.
    pub fn system(
        &self,
        node: usize,
        is_closed: impl Fn(usize) -> bool,
    ) -> Outcome<System<Number>> {
        let system = System::of(&self.nodes[node], is_closed, self.cut.bits);
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
        while let Some((node, now)) = self.behind() {
            if self.clock.compare(now, until)? == Ordering::Greater {
                return Ok(());
            }
            self.advance(node)?;
        }
        Ok(())
    }

    /// The node that was followed the least far, and how far. What arrives there has left the others:
    /// one that is further, however little, may ask for what is not known yet.
    pub fn behind(&self) -> Option<(usize, &Moment)> {
        let now = self.states.iter().map(|state| &state.now).enumerate();
        now.reduce(|least, other| if self.is_earlier(other.1, least.1) { other } else { least })
    }

    /// Which instant is earlier, by doubles where these tell; what nothing tells apart is not earlier.
    fn is_earlier(&self, one: &Moment, other: &Moment) -> bool {
        let [a, b] = [one, other].map(|moment| self.clock.about(moment));
        match (a - b).abs() > TOLD_APART * a.abs().max(b.abs()) {
            true => a < b,
            false => matches!(self.clock.compare(one, other), Ok(Ordering::Less)),
        }
    }

    pub fn ball_at(&self, moment: &Moment) -> Box<Ball> {
        let ball = self.clock.time(moment).map(|time| time.ball(self.cut.bits));
        Box::new(ball.unwrap_or_else(|_| Ball::zero()))
    }

    pub fn undecided<T>(&self, what: Question, at: &Moment, by: Option<&Ball>) -> Outcome<T> {
        let mut at = self.ball_at(at);
        if let Some(by) = by {
            *at = at.add(by, self.cut.bits);
        }
        Err(HistoryError::Undecided { what, at, bits: self.cut.bits })
    }

    /// When the inputs of a node change next, but no later than the longest cell allows.
    fn next_change(&self, node: usize) -> Outcome<Moment> {
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
        // Where nothing has a rate and nothing arrives, a cell is one unit of time.
        let one = Rational::from_integer(1.into());
        match &self.step {
            Some(step) => ends.push(Clock::step(&state.now, step)),
            None if ends.is_empty() => ends.push(Clock::step(&state.now, &one)),
            None => {}
        }
        let mut ends = ends.into_iter();
        let mut first = ends.next().expect("a cell has an end");
        for end in ends {
            first = self.clock.earlier(first, end)?;
        }
        Ok(first)
    }

    /// The loads of a node, from left to right.
    fn loads_of(&self, node: usize) -> impl Iterator<Item = &Load> {
        self.nodes[node].elements.iter().filter_map(|own| self.loads.get(&own.element))
    }

    /// What acts on a node from now on: arriving waves, then its loads.
    fn inputs(&self, node: usize) -> Outcome<Vec<Series>> {
        let state = &self.states[node];
        let mut inputs = Vec::new();
        for arriving in &state.arriving {
            inputs.push(arriving.series(&self.waves, &state.now, &self.clock, &self.cut)?);
        }
        for load in self.loads_of(node) {
            let begun = self.clock.compare(&Moment::at(load.from.clone()), &state.now)?;
            let acts = begun != Ordering::Greater
                && match &load.until {
                    Some(until) => {
                        let until = Moment::at(until.clone());
                        self.clock.compare(&until, &state.now)? == Ordering::Greater
                    }
                    None => true,
                };
            inputs.push(match acts {
                true => load.course.series(&self.clock.time(&state.now)?, &self.cut)?,
                false => Series::zero(),
            });
        }
        Ok(inputs)
    }

    /// Follows a node over one cell.
    ///
    /// # Errors
    /// As [`Engine::follow_until`].
    pub fn advance(&mut self, node: usize) -> Outcome<()> {
        self.count += 1;
        if self.count > MAX_HISTORY_CELLS {
            let at = self.ball_at(&self.states[node].now);
            return Err(HistoryError::TooManyCells { limit: MAX_HISTORY_CELLS, at });
        }
        let inputs = self.inputs(node)?;
        let mut changed = 0;
        let (motion, forces, gaps) = loop {
            let state = &self.states[node];
            let motion = state.system.solve(state.state.clone(), &inputs, &self.cut);
            let (forces, gaps) = self.contact_series(node, &motion);
            let changes = self.changes(node, &forces, &gaps)?;
            if changes.is_empty() {
                break (motion, forces, gaps);
            }
            changed += changes.len();
            if changed > MAX_CHANGES {
                return self.undecided(Question::Simultaneous, &self.states[node].now, None);
            }
            self.change(node, &changes, Cause::Jump)?;
        };
        if self.cells[node].is_empty() {
            self.tell_impacts(node, &forces);
        }
        let mut end = self.next_change(node)?;
        let now = self.states[node].now.clone();
        let length = self.clock.since(&now, &end)?;
        let first = self.first_change(node, [&forces, &gaps], &length)?;
        let length = match &first {
            Some((_, at)) => {
                end = self.clock.later(&now, at)?;
                at.clone()
            }
            None => length,
        };
        self.finish(node, &inputs, motion, [forces, gaps], end, &length)?;
        if let Some((contact, _)) = first {
            self.change(node, &[contact], Cause::Crossing)?;
        }
        Ok(())
    }

    /// Takes over what a node did until an instant.
    fn finish(
        &mut self,
        node: usize,
        inputs: &[Series],
        motion: Motion,
        [forces, gaps]: [Vec<Series>; 2],
        end: Moment,
        length: &Number,
    ) -> Outcome<()> {
        let (cut, bits) = (self.cut, self.cut.bits);
        let own = &self.nodes[node];
        let now = self.states[node].now.clone();
        for (place, (contact, _)) in own.contacts().enumerate() {
            let contact = &mut self.open[contact];
            contact.rests = false;
            contact.gap = gaps[place].value(length, &cut);
            if contact.closed {
                match forces[place].is_zero() {
                    true if contact.pressed => {
                        contact.idle.get_or_insert_with(|| now.clone());
                    }
                    true => {}
                    false => (contact.pressed, contact.idle) = (true, None),
                }
            }
        }
        // What leaves is v − w.
        for (side, run) in own.side_runs().into_iter().enumerate() {
            let bar = if side == 0 { own.left } else { own.right };
            let Side::Bar(bar) = bar else { continue };
            let leaving = motion.velocities[run].subtract(&inputs[side], bits);
            self.waves[bar][1 - side].push(leaving, end.clone(), length.clone());
        }
        let state = &mut self.states[node];
        let mut displacements = Vec::new();
        for (velocity, start) in motion.velocities.iter().zip(&mut state.displacements) {
            let displacement = velocity.integral(start.clone(), &cut);
            *start = displacement.value(length, &cut);
            displacements.push(displacement);
        }
        let compressions = state
            .system
            .kept
            .iter()
            .map(|place| place.map_or_else(Series::zero, |place| motion.state[place].clone()));
        let compressions = compressions.collect();
        state.state = motion.state.iter().map(|series| series.value(length, &cut)).collect();
        for arriving in &mut state.arriving {
            let ends = arriving.end(&self.waves);
            if let (Arriving::Delayed { cell, .. }, Some(ends)) = (arriving, ends)
                && self.clock.compare(&ends, &end)? == Ordering::Equal
            {
                *cell += 1;
            }
        }
        let velocities = motion.velocities;
        let cell = Cell { velocities, displacements, compressions, forces, gaps };
        self.cells[node].push((now, cell));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Source, read_scene};

    /// Doubles see no difference between instants of a bar this short: the order of nodes is exact.
    #[test]
    fn nodes_are_followed_in_order_where_doubles_see_none() {
        for travel in ["1e-401", "1e-30"] {
            let text = format!(
                "scene \"A\"\nbar a {{ impedance = 1, travel = {travel}, velocity = 1 }}\n\
                 mass m {{ mass = 1/2 }}\nbar b {{ impedance = 2, travel = 3/2 }}\n\
                 bar c {{ impedance = 1, travel = 1 }}\nline free - a | m - b | c - free\n\
                 contacts open\nobserve v = velocity(m)"
            );
            let scene = read_scene(&Source::new("scene", &text).unwrap(), &Default::default());
            let network = Network::new(&scene.unwrap()).unwrap();
            let mut engine = Engine::new(&network, 128).unwrap();
            for _ in 0..60 {
                let (node, _) = engine.behind().unwrap();
                engine.advance(node).unwrap();
            }
            assert_eq!(engine.count(), 60, "{travel}");
        }
    }
}
