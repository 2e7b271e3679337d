//! The method of steps with proof: nodes are followed from cell to cell, contacts open and close.
//!
//! On a cell all that arrives at a node is known as series, since it left another node a travel time
//! before. The node answers with series of its own. A contact that would pull opens, and one whose gap
//! would become negative closes; the cell ends there, and the next one begins with other equations.
//! Every node has a time of its own and is at most a travel time ahead of its neighbours.

use crate::ball::{Ball, Magnitude};
use crate::expression::Fraction;
use crate::history::crossing::{Beginning, Course, beginning, follow};
use crate::history::error::HistoryError;
use crate::history::junction::{Junction, Motion};
use crate::history::moment::{Clock, Moment};
use crate::history::node::{ContactPlace, Node, nodes};
use crate::history::number::Number;
use crate::history::series::{LONGEST_CELL, Series, Truncation};
use crate::history::track::{Arriving, Track};
use crate::network::{Layout, Network, Side};
use std::cmp::Ordering;
use wavestep_polynomial::{Rational, Symbol};

/// The most events that are followed.
pub(crate) const MAX_EVENTS: usize = 1_000;

/// The most cells of all nodes together.
pub(crate) const MAX_CELLS: usize = 100_000;

/// The most contacts in one node.
const MAX_CONTACTS: usize = 6;

/// The most changes of contacts of one node at one instant.
const MAX_CHANGES: usize = 16;

/// What a node did on one cell.
pub(crate) struct Cell {
    /// Velocities of its runs.
    pub velocities: Vec<Series>,
    /// Displacements of its runs since the start.
    pub displacements: Vec<Series>,
    /// Compressions of its springs and supports; zero for springs that hang on an open contact.
    pub yields: Vec<Series>,
    /// Forces of its contacts, zero where they are open, in the order of [`Node::contacts`].
    pub forces: Vec<Series>,
    /// Gaps of its contacts, zero where they are closed.
    pub gaps: Vec<Series>,
}

/// That a contact closed or opened.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Happening {
    /// Whether the contact closed.
    pub closes: bool,
    /// Whether its force or its gap came to zero by itself, not by a jump of what arrives.
    pub smooth: bool,
    pub contact: usize,
    pub moment: Moment,
    /// When the contact would have pulled, or the gap have become negative: later than the moment where a
    /// contact had had no force for a while.
    pub forced: Moment,
}

/// A contact as it is.
struct Contact {
    closed: bool,
    gap: Number,
    /// Whether the gap begins to open with velocity zero, exactly.
    rests: bool,
    /// Since when the force is exactly zero, after it was positive.
    idle: Option<Moment>,
    pressed: bool,
}

/// A node as it is.
struct State {
    now: Moment,
    junction: Junction,
    state: Vec<Number>,
    arriving: [Arriving; 2],
    displacements: Vec<Number>,
}

/// Scene, waves and nodes as far as they are known.
pub(crate) struct Engine {
    pub clock: Clock,
    pub cut: Truncation,
    pub layout: Layout,
    pub nodes: Vec<Node>,
    pub contacts: Vec<ContactPlace>,
    /// Of each bar the impedance and the travel time.
    pub bars: Vec<(Number, Option<Fraction>)>,
    /// Of each bar the waves to the right and to the left, as they leave its ends.
    pub waves: Vec<[Track; 2]>,
    /// What each node did, with the start of each cell.
    pub cells: Vec<Vec<(Moment, Cell)>>,
    pub happenings: Vec<Happening>,
    states: Vec<State>,
    open: Vec<Contact>,
    places: Vec<String>,
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
        let layout = Layout::of(network.scene());
        let (nodes, contacts) = nodes(network, &layout, &clock)?;
        let mut bars = Vec::new();
        let mut waves = Vec::new();
        for (bar, element) in layout.bars.iter().enumerate() {
            let data = &network.model().bars[element];
            bars.push((clock.number(&data.impedance)?, data.travel.clone()));
            let time = data.travel.clone().unwrap_or_else(Fraction::one);
            let values = before(network, &layout, &clock, bar)?;
            waves.push(values.map(|value| Track::before(value, &time)));
        }
        let places: Vec<String> =
            (0..nodes.len()).map(|node| format!("{}:", network.place_in_words(node))).collect();
        let mut engine = Engine {
            clock,
            cut: Truncation::new(bits, 0),
            layout,
            nodes,
            contacts,
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
                let reason = format!(
                    "{} {} contacts meet, and at most {MAX_CONTACTS} in one place are followed",
                    self.places[number],
                    contacts.len()
                );
                return Err(HistoryError::Refused(reason));
            }
            for choice in 0..1_u32 << contacts.len() {
                let closed = |contact: usize| {
                    let place = contacts.iter().position(|own| *own == contact);
                    place.is_some_and(|place| choice >> place & 1 == 1)
                };
                // A state that is refused is refused when it comes.
                let Ok(junction) = Junction::of(node, closed, "", self.cut.bits) else { continue };
                largest = largest.max(junction.norms().0.scale(2));
            }
            for load in &node.loads {
                largest = largest.max(load.course.rate().scale(1));
            }
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
        self.open = self.contacts.iter().map(|_| contact()).collect();
        for (number, node) in self.nodes.iter().enumerate() {
            let bits = self.cut.bits;
            let junction = Junction::of(node, |_| true, &self.places[number], bits)?;
            let yielded = vec![Number::zero(); node.yields().count()];
            let velocity = |run: usize| self.starting_velocity(node, run);
            let state = junction.state(node, velocity, &yielded, &self.places[number])?;
            let arriving = [node.left, node.right].into_iter().zip([0, 1]);
            let arriving = arriving.map(|(side, direction)| match side {
                Side::Bar(bar) => match &self.bars[bar].1 {
                    Some(travel) => {
                        Arriving::Delayed { bar, direction, travel: travel.clone(), cell: 0 }
                    }
                    None => {
                        let (_, series) = &self.waves[bar][direction].cells[0];
                        Arriving::Constant(series.coefficient(0))
                    }
                },
                _ => Arriving::Nothing,
            });
            let arriving: Vec<Arriving> = arriving.collect();
            let Ok(arriving) = <[Arriving; 2]>::try_from(arriving) else { unreachable!() };
            let displacements = vec![Number::zero(); node.runs()];
            let now = start.clone();
            self.states.push(State { now, junction, state, arriving, displacements });
            self.cells.push(Vec::new());
        }
        Ok(())
    }

    /// The velocity of the masses of a run before the start.
    pub fn starting_velocity(&self, node: &Node, run: usize) -> Option<Number> {
        let bits = self.cut.bits;
        let mut own = node.masses.iter().filter(|mass| mass.run == run).peekable();
        let first = own.peek()?.velocity.clone();
        let mut momentum = Number::zero();
        let mut same = true;
        for mass in own {
            same &= mass.velocity == first;
            momentum = momentum.add(&mass.mass.multiply(&mass.velocity, bits), bits);
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

    /// The node that was followed the least far, and how far.
    pub fn behind(&self) -> Option<(usize, &Moment)> {
        let now = self.states.iter().map(|state| &state.now).enumerate();
        now.min_by(|a, b| self.clock.about(a.1).total_cmp(&self.clock.about(b.1)))
    }

    fn ball_at(&self, moment: &Moment) -> Box<Ball> {
        let ball = self.clock.time(moment).map(|time| time.ball(self.cut.bits));
        Box::new(ball.unwrap_or_else(|_| Ball::zero()))
    }

    fn undecided<T>(&self, what: String, at: &Moment, by: Option<&Ball>) -> Outcome<T> {
        let mut at = self.ball_at(at);
        if let Some(by) = by {
            *at = at.add(by, self.cut.bits);
        }
        Err(HistoryError::Undecided { what, at, bits: self.cut.bits })
    }

    fn between(&self, contact: usize) -> String {
        let [left, right] = &self.contacts[contact].names;
        format!("between {left} and {right}")
    }

    /// When the inputs of a node change next, but no later than the longest cell allows.
    fn next_change(&self, node: usize) -> Outcome<Moment> {
        let state = &self.states[node];
        let mut ends: Vec<Moment> =
            state.arriving.iter().filter_map(|arriving| arriving.end(&self.waves)).collect();
        for load in &self.nodes[node].loads {
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

    /// What acts on a node from now on: arriving waves, then the load of each run.
    fn inputs(&self, node: usize) -> Outcome<Vec<Series>> {
        let state = &self.states[node];
        let mut inputs = Vec::new();
        for arriving in &state.arriving {
            inputs.push(arriving.series(&self.waves, &state.now, &self.clock, &self.cut)?);
        }
        inputs.resize(2 + self.nodes[node].runs(), Series::zero());
        for load in &self.nodes[node].loads {
            let begun = self.clock.compare(&Moment::at(load.from.clone()), &state.now)?;
            let acts = begun != Ordering::Greater
                && match &load.until {
                    Some(until) => {
                        let until = Moment::at(until.clone());
                        self.clock.compare(&until, &state.now)? == Ordering::Greater
                    }
                    None => true,
                };
            if acts {
                let series = load.course.series(&self.clock.time(&state.now)?, &self.cut)?;
                let own = &mut inputs[2 + load.run];
                *own = own.add(&series, self.cut.bits);
            }
        }
        Ok(inputs)
    }

    /// Forces and gaps of the contacts of a node on a cell.
    fn contact_series(&self, node: usize, motion: &Motion) -> (Vec<Series>, Vec<Series>) {
        let (mut forces, mut gaps) = (Vec::new(), Vec::new());
        for (contact, run) in self.nodes[node].contacts() {
            let closed = self.states[node].junction.closed.iter().position(|own| own.0 == contact);
            let Some(row) = closed else {
                let apart =
                    motion.velocities[run + 1].subtract(&motion.velocities[run], self.cut.bits);
                let own = &self.open[contact];
                let mut gap = apart.integral(own.gap.clone(), &self.cut);
                if own.rests && gap.coefficients.len() > 1 {
                    gap.coefficients[1] = Number::zero();
                }
                forces.push(Series::zero());
                gaps.push(gap);
                continue;
            };
            forces.push(motion.forces[row].clone());
            gaps.push(Series::zero());
        }
        (forces, gaps)
    }

    /// Which contacts of a node change at once: those that would pull, and those whose gap would become
    /// negative.
    fn changes(&self, node: usize, forces: &[Series], gaps: &[Series]) -> Outcome<Vec<usize>> {
        let mut changes = Vec::new();
        for (place, (contact, _)) in self.nodes[node].contacts().enumerate() {
            let closed = self.open[contact].closed;
            let series = if closed { &forces[place] } else { &gaps[place] };
            match beginning(series) {
                Beginning::Positive | Beginning::Zero => {}
                Beginning::Negative => changes.push(contact),
                Beginning::Undecided => {
                    let what = if closed { "whether the force" } else { "whether the gap" };
                    let what = format!("{what} {} is positive", self.between(contact));
                    return self.undecided(what, &self.states[node].now, None);
                }
            }
        }
        Ok(changes)
    }

    /// Follows a node over one cell.
    ///
    /// # Errors
    /// As [`Engine::follow_until`].
    pub fn advance(&mut self, node: usize) -> Outcome<()> {
        self.count += 1;
        if self.count > MAX_CELLS {
            let at = self.ball_at(&self.states[node].now);
            return Err(HistoryError::TooManyCells { limit: MAX_CELLS, at });
        }
        let inputs = self.inputs(node)?;
        let mut changed = 0;
        let (motion, forces, gaps) = loop {
            let state = &self.states[node];
            let motion = state.junction.solve(state.state.clone(), &inputs, &self.cut);
            let (forces, gaps) = self.contact_series(node, &motion);
            let changes = self.changes(node, &forces, &gaps)?;
            if changes.is_empty() {
                break (motion, forces, gaps);
            }
            changed += changes.len();
            if changed > MAX_CHANGES {
                let what = "which contacts are closed after several change at once".to_owned();
                return self.undecided(what, &self.states[node].now, None);
            }
            self.change(node, &changes, false)?;
        };
        if self.cells[node].is_empty() {
            self.tell_impacts(node, &forces);
        }
        let mut end = self.next_change(node)?;
        let now = self.states[node].now.clone();
        let length = self.clock.since(&now, &end)?;
        let mut first: Option<(usize, Number)> = None;
        for (place, (contact, _)) in self.nodes[node].contacts().enumerate() {
            let closed = self.open[contact].closed;
            let series = if closed { &forces[place] } else { &gaps[place] };
            if series.is_zero() {
                continue;
            }
            let quantity = if closed { "the force" } else { "the gap" };
            let at = match follow(series, &length, &self.cut) {
                Course::Positive => continue,
                Course::Falls(at) => at,
                Course::Undecided(at) => {
                    let between = self.between(contact);
                    let what = format!("whether {quantity} {between} becomes zero");
                    return self.undecided(what, &now, Some(&at));
                }
            };
            match at.subtract(&length, self.cut.bits).sign() {
                Some(Ordering::Less) => {}
                Some(_) => continue,
                None => {
                    let between = self.between(contact);
                    let what = format!(
                        "whether {quantity} {between} becomes zero before something arrives there"
                    );
                    return self.undecided(what, &now, Some(&at.ball(self.cut.bits)));
                }
            }
            first = Some(match first {
                None => (contact, at),
                Some((other, earliest)) => match at.subtract(&earliest, self.cut.bits).sign() {
                    Some(Ordering::Less) => (contact, at),
                    Some(Ordering::Greater) => (other, earliest),
                    _ => {
                        let (one, two) = (self.between(other), self.between(contact));
                        let what = format!("whether the contact {one} or {two} changes first");
                        return self.undecided(what, &now, Some(&at.ball(self.cut.bits)));
                    }
                },
            });
        }
        let length = match &first {
            Some((_, at)) => {
                end = self.clock.later(&now, at)?;
                at.clone()
            }
            None => length,
        };
        self.finish(node, &inputs, motion, [forces, gaps], end, &length)?;
        if let Some((contact, _)) = first {
            self.change(node, &[contact], true)?;
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
            self.waves[bar][1 - side].push(leaving, end.clone());
        }
        let state = &mut self.states[node];
        let mut displacements = Vec::new();
        for (velocity, start) in motion.velocities.iter().zip(&mut state.displacements) {
            let displacement = velocity.integral(start.clone(), &cut);
            *start = displacement.value(length, &cut);
            displacements.push(displacement);
        }
        let yields = (0..own.yields().count()).map(|number| {
            let place = state.junction.place_of_yield(number);
            place.map_or_else(Series::zero, |place| motion.state[place].clone())
        });
        let yields = yields.collect();
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
        let cell = Cell { velocities, displacements, yields, forces, gaps };
        self.cells[node].push((now, cell));
        self.states[node].now = end;
        Ok(())
    }

    /// Opens closed contacts and closes open ones at the time of a node; `smooth` where a force or a gap
    /// came to zero by itself, and not by a jump of what arrives.
    fn change(&mut self, node: usize, changes: &[usize], smooth: bool) -> Outcome<()> {
        let bits = self.cut.bits;
        let now = self.states[node].now.clone();
        let own = &self.nodes[node];
        if self.happenings.len() + changes.len() > MAX_EVENTS {
            let at = self.ball_at(&now);
            return Err(HistoryError::TooManyEvents { limit: MAX_EVENTS, at });
        }
        for contact in changes {
            let known = &mut self.open[*contact];
            let moment = known.idle.take().unwrap_or_else(|| now.clone());
            known.closed = !known.closed;
            known.gap = Number::zero();
            known.pressed = false;
            let (closes, contact, forced) = (known.closed, *contact, now.clone());
            self.happenings.push(Happening { closes, smooth, contact, moment, forced });
        }
        let state = &self.states[node];
        let open = &self.open;
        let junction = Junction::of(own, |contact| open[contact].closed, &self.places[node], bits)?;
        let yielded: Vec<Number> = (0..state.junction.active.len())
            .map(|number| {
                let place = state.junction.place_of_yield(number);
                place.map_or_else(Number::zero, |place| state.state[place].clone())
            })
            .collect();
        let velocity = |run: usize| state.junction.velocity_of(run, &state.state);
        let next = junction.state(own, velocity, &yielded, &self.places[node])?;
        let loosened = junction.active != state.junction.active;
        for contact in changes {
            let run = self.contacts[*contact].run;
            let inert = junction.has_inertia(run) && junction.has_inertia(run + 1);
            let own = &mut self.open[*contact];
            own.rests = !own.closed && (inert || smooth && !loosened);
        }
        let state = &mut self.states[node];
        (state.junction, state.state) = (junction, next);
        Ok(())
    }

    /// Contacts that press from the start close then.
    fn tell_impacts(&mut self, node: usize, forces: &[Series]) {
        for (place, (contact, _)) in self.nodes[node].contacts().enumerate() {
            if self.open[contact].closed && !forces[place].is_zero() {
                let moment = self.states[node].now.clone();
                let forced = moment.clone();
                self.happenings.push(Happening {
                    closes: true,
                    smooth: false,
                    contact,
                    moment,
                    forced,
                });
            }
        }
    }

    /// Whether a contact is open, or touches without force since an instant.
    pub fn is_open(&self, contact: usize) -> bool {
        !self.open[contact].closed
    }

    /// Since when a closed contact has had no force.
    pub fn idle_since(&self, contact: usize) -> Option<&Moment> {
        self.open[contact].idle.as_ref()
    }

    /// Whether a closed contact has no force now.
    pub fn is_idle(&self, contact: usize) -> bool {
        let own = &self.open[contact];
        own.closed && (own.idle.is_some() || !own.pressed)
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
