//! The method of steps in plain doubles: each node is integrated from break to break by Picard's iteration at
//! Chebyshev points, with what left its neighbours a travel time before. Contacts open where their force falls
//! below zero and close where their gap does; the others stay closed.

use crate::curve::{Curve, POINTS, integral, integrals, points};
use crate::node::{Law, Node, Place, nodes};
use crate::scene::{Element, Scene, Size};
use wavestep::history::EventKind;

/// Forces and gaps below this are zero.
const ZERO: f64 = 2e-12;

/// What is smaller than this, and not zero, may have a sign of its own.
const UNCLEAR: f64 = 1e-9;

/// Which of two events is the first may not be told where they are as near as this.
const NEAR: f64 = 1e-7;

/// Instants closer than this are one.
const SAME: f64 = 1e-12;

/// Looks at a force or gap in a cell.
const LOOKS: usize = 64;

/// The most changes at one instant.
const MOST_CHANGES: usize = 16;

/// What happens at a contact.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Happening {
    pub kind: EventKind,
    pub contact: usize,
    pub time: f64,
}

/// A node on a stretch of time: the velocities of its points, the forces in its links, the force and the power from
/// outside, and the waves that leave to the left and to the right.
struct Cell {
    start: f64,
    length: f64,
    curves: Vec<Curve>,
}

impl Cell {
    fn at(&self, curve: usize, time: f64) -> f64 {
        self.curves[curve].at((2.0 * (time - self.start) / self.length - 1.0).clamp(-1.0, 1.0))
    }
}

/// A node as it was followed.
struct Trace {
    now: f64,
    state: Vec<f64>,
    law: Law,
    cells: Vec<Cell>,
    /// Where its motion may jump, or have a kink.
    breaks: Vec<f64>,
}

struct Contact {
    is_closed: bool,
    /// Whether the force was clear on the last cell.
    was_clear: bool,
    /// Since when there is no force, where it did not fade away.
    idle: Option<f64>,
    since: f64,
}

/// A bar between two nodes, or beyond the last.
struct Bar {
    travel: Option<f64>,
    impedance: f64,
    /// The waves to the right and to the left before the start.
    before: [f64; 2],
    ends: [Option<usize>; 2],
}

pub struct Solver {
    nodes: Vec<Node>,
    places: Vec<Place>,
    bars: Vec<Option<Bar>>,
    traces: Vec<Trace>,
    contacts: Vec<Contact>,
    pub happenings: Vec<Happening>,
    /// From when on doubles may not tell what happens.
    pub doubt: f64,
    longest_cell: f64,
}

/// What a trial of a cell gives.
struct Trial {
    cell: Cell,
    /// The curves of gaps, and the state at the end.
    gaps: Vec<(usize, Curve)>,
    end: Vec<f64>,
    is_resolved: bool,
}

impl Solver {
    /// A scene at its start; none where something without mass meets no resistance. Cells are no longer than a
    /// share of the time in which a node changes.
    pub fn new(scene: &Scene, share: f64) -> Option<Solver> {
        let (nodes, places) = nodes(scene);
        let bar = |(element, place): (&Element, &Place)| match (element, place) {
            (Element::Bar { impedance, travel, velocity, strain }, Place::Bar(ends)) => {
                let (velocity, stretched) = (velocity.value(), strain.value());
                let before = [(velocity - stretched) / 2.0, (velocity + stretched) / 2.0];
                let (travel, impedance) = (travel.map(Size::value), impedance.value());
                Some(Bar { travel, impedance, before, ends: *ends })
            }
            _ => None,
        };
        let bars = scene.elements.iter().zip(&places).map(bar).collect();
        let joints = scene.joints.iter().enumerate();
        let joints = joints.filter(|(_, is_contact)| **is_contact && scene.opens);
        let gaps: Vec<f64> = joints
            .map(|(joint, _)| scene.gaps.get(&joint).map_or(0.0, |gap| gap.value()))
            .collect();
        let is_closed = |gap: &f64| *gap == 0.0;
        let contact = |gap: &f64| Contact {
            is_closed: is_closed(gap),
            was_clear: false,
            idle: None,
            since: 0.0,
        };
        let closed: Vec<bool> = gaps.iter().map(is_closed).collect();
        let mut traces = Vec::new();
        for node in &nodes {
            let mut state = vec![0.0; node.states()];
            for (contact, link) in node.contacts() {
                state[node.points.len() + link] = gaps[contact];
            }
            let law = node.law(&closed)?;
            traces.push(Trace { now: 0.0, state, law, cells: Vec::new(), breaks: vec![0.0] });
        }
        let contacts = gaps.iter().map(contact).collect();
        let mut solver = Solver {
            nodes,
            places,
            bars,
            traces,
            contacts,
            happenings: Vec::new(),
            doubt: f64::INFINITY,
            longest_cell: share,
        };
        for (node, trace) in solver.nodes.iter().zip(&mut solver.traces) {
            for (speed, point) in trace.state.iter_mut().zip(&node.points) {
                *speed = if point.mass > 0.0 { point.momentum / point.mass } else { 0.0 };
            }
        }
        (0..solver.nodes.len()).for_each(|node| solver.join(node));
        Some(solver)
    }

    fn closed(&self) -> Vec<bool> {
        self.contacts.iter().map(|contact| contact.is_closed).collect()
    }

    /// Points that touch have one velocity.
    fn join(&mut self, node: usize) {
        let groups = self.nodes[node].groups(&self.closed());
        let points = &self.nodes[node].points;
        let state = &mut self.traces[node].state;
        for group in 0..=*groups.last().unwrap() {
            let own = || (0..points.len()).filter(|point| groups[*point] == group);
            let mass: f64 = own().map(|point| points[point].mass).sum();
            let momentum: f64 = own().map(|point| points[point].mass * state[point]).sum();
            let is_held = own().any(|point| points[point].is_wall);
            let speed = if mass > 0.0 && !is_held { momentum / mass } else { 0.0 };
            own().for_each(|point| state[point] = speed);
        }
    }

    /// The wave in a bar, to the right or to the left, as it left its source at a time.
    fn leaving(&self, bar: &Bar, direction: usize, time: f64) -> f64 {
        let source = bar.ends[direction].filter(|_| time > 0.0);
        let cell = source.and_then(|source| {
            let cells = &self.traces[source].cells;
            cells[..cells.partition_point(|cell| cell.start <= time)].last()
        });
        cell.map_or(bar.before[direction], |cell| cell.at(cell.curves.len() - 1 - direction, time))
    }

    /// The wave that arrives at a side of a node.
    fn arriving(&self, node: usize, side: usize, time: f64) -> f64 {
        let bar = self.nodes[node].bars[side].map(|bar| self.bars[bar].as_ref().unwrap());
        bar.map_or(0.0, |bar| match bar.travel {
            Some(travel) => self.leaving(bar, side, time - travel),
            None => bar.before[side],
        })
    }

    /// A cell of a node from now on.
    fn trial(&self, node: usize, length: f64) -> Trial {
        let (own, trace) = (&self.nodes[node], &self.traces[node]);
        let law = &trace.law;
        let times = points().map(|x| trace.now + (x + 1.0) / 2.0 * length);
        let input: Vec<Vec<f64>> = (times.iter())
            .map(|time| {
                let waves = [0, 1].map(|side| self.arriving(node, side, *time));
                let loads = own.points.iter().map(|point| point.given(*time));
                waves.into_iter().chain(loads).collect()
            })
            .collect();
        let row = |row: &[f64], state: &[f64], input: &[f64]| -> f64 {
            row.iter().zip(state.iter().chain(input)).map(|(a, b)| a * b).sum()
        };
        let mut states = vec![trace.state.clone(); POINTS];
        let mut end = trace.state.clone();
        for _ in 0..60 {
            let slopes: Vec<Vec<f64>> = (states.iter().zip(&input))
                .map(|(state, input)| law.change.iter().map(|own| row(own, state, input)).collect())
                .collect();
            let (mut moved, mut largest) = (0.0_f64, 1.0_f64);
            for (at, weights) in integrals().iter().enumerate() {
                for k in 0..law.states {
                    let sum: f64 = weights.iter().zip(&slopes).map(|(a, slope)| a * slope[k]).sum();
                    let value = trace.state[k] + sum * length / 2.0;
                    let known = states.get_mut(at).map_or(&mut end[k], |state| &mut state[k]);
                    (moved, largest) =
                        (moved.max((value - *known).abs()), largest.max(value.abs()));
                    *known = value;
                }
            }
            if moved < 1e-15 * largest {
                break;
            }
        }
        let curve = |value: &dyn Fn(usize) -> f64| Curve::through(&std::array::from_fn(value));
        let mut curves: Vec<Curve> =
            law.output.iter().map(|own| curve(&|i| row(own, &states[i], &input[i]))).collect();
        let closed = self.closed();
        let flows: Vec<[f64; 2]> = (states.iter().zip(&input))
            .map(|(state, input)| {
                let speeds = law.output[..own.points.len()].iter();
                let speeds: Vec<f64> = speeds.map(|own| row(own, state, input)).collect();
                own.flow(&closed, &speeds, state, input)
            })
            .collect();
        curves.extend([0, 1].map(|k| curve(&|i| flows[i][k])));
        for (side, point) in [(0, 0), (1, own.points.len() - 1)] {
            let outward =
                |i: usize| row(&law.output[point], &states[i], &input[i]) - input[i][side];
            curves.push(curve(&outward));
        }
        let gaps = (own.contacts().filter(|(contact, _)| !self.contacts[*contact].is_closed))
            .map(|(contact, link)| (contact, curve(&|i| states[i][own.points.len() + link])));
        let gaps: Vec<(usize, Curve)> = gaps.collect();
        let is_resolved =
            (curves.iter().chain(gaps.iter().map(|(_, curve)| curve))).all(Curve::is_resolved);
        Trial { cell: Cell { start: trace.now, length, curves }, gaps, end, is_resolved }
    }

    /// How long the next cell may be.
    fn reach(&self, node: usize) -> f64 {
        let (own, trace) = (&self.nodes[node], &self.traces[node]);
        let mut end = trace.now + self.longest_cell / trace.law.rate().max(1.0);
        let mut next = |time: f64| {
            if time > trace.now + SAME * time.max(1.0) {
                end = end.min(time);
            }
        };
        for load in own.points.iter().flat_map(|point| &point.loads) {
            next(load.from.value());
            load.until.iter().for_each(|until| next(until.value()));
        }
        for (side, bar) in own.bars.iter().enumerate() {
            let Some(bar) = bar.and_then(|bar| self.bars[bar].as_ref()) else { continue };
            let (Some(travel), Some(source)) = (bar.travel, bar.ends[side]) else { continue };
            let breaks = &self.traces[source].breaks;
            let known = trace.now - travel;
            let from = breaks.partition_point(|time| *time <= known + SAME * trace.now.max(1.0));
            next(breaks.get(from).map_or(f64::INFINITY, |time| time + travel));
            next(self.traces[source].now + travel);
        }
        end - trace.now
    }

    /// Follows all nodes until a time, or until so many events; none where nothing resists something without mass,
    /// or where contacts change for ever. It tells how far.
    pub fn follow(&mut self, until: f64, events: usize) -> Option<f64> {
        while let Some(node) = (0..self.nodes.len())
            .min_by(|a, b| self.traces[*a].now.total_cmp(&self.traces[*b].now))
            .filter(|node| {
                let Trace { now, cells, .. } = &self.traces[*node];
                *now < until && (self.happenings.len() < events || cells.is_empty())
            })
        {
            self.advance(node)?;
        }
        self.happenings.sort_by(|a, b| a.time.total_cmp(&b.time));
        Some(self.traces.iter().map(|trace| trace.now).fold(until, f64::min))
    }

    fn advance(&mut self, node: usize) -> Option<()> {
        let now = self.traces[node].now;
        let is_first = self.traces[node].cells.is_empty();
        let mut changes = 0;
        let (trial, first) = loop {
            let mut trial = self.trial(node, self.reach(node));
            while !trial.is_resolved && trial.cell.length > 1e-7 {
                trial = self.trial(node, trial.cell.length / 2.0);
            }
            let (at_once, first) = self.decide(node, &trial);
            let at_once = self.yielding(node, at_once);
            if at_once.is_empty() {
                break match first {
                    Some((contact, time)) => (self.trial(node, time - now), Some(contact)),
                    None => (trial, None),
                };
            }
            changes += at_once.len();
            if changes > MOST_CHANGES {
                return None;
            }
            self.change(node, &at_once)?;
        };
        self.finish(node, trial, is_first);
        match first {
            Some(contact) => self.change(node, &[contact]),
            None => Some(()),
        }
    }

    /// The force in a closed contact, the gap of an open one.
    fn guard<'a>(&self, node: usize, trial: &'a Trial, contact: usize, link: usize) -> &'a Curve {
        let gap = trial.gaps.iter().find(|(own, _)| *own == contact);
        gap.map_or(&trial.cell.curves[self.nodes[node].points.len() + link], |(_, curve)| curve)
    }

    /// Which contacts change at once, and the first that does within the cell.
    fn decide(&mut self, node: usize, trial: &Trial) -> (Vec<usize>, Option<(usize, f64)>) {
        let Cell { start, length, .. } = trial.cell;
        let time = |x: f64| start + (x + 1.0) / 2.0 * length;
        let (mut at_once, mut crossings, mut doubt) = (Vec::new(), Vec::new(), self.doubt);
        for (contact, link) in self.nodes[node].contacts() {
            let guard = self.guard(node, trial, contact, link);
            let looks: Vec<(f64, f64)> = (0..=LOOKS)
                .map(|k| (2.0 * k as f64 / LOOKS as f64 - 1.0, k))
                .map(|(x, _)| (x, guard.at(x)))
                .collect();
            let largest = looks.iter().fold(0.0, |most: f64, (_, value)| most.max(value.abs()));
            let own = &self.contacts[contact];
            let settled = own.is_closed && length > 1e-6 || start > own.since + 0.1;
            if largest > ZERO && largest < UNCLEAR && settled {
                doubt = doubt.min(start);
            }
            let Some(clear) = looks.iter().position(|(_, value)| value.abs() > ZERO) else {
                continue;
            };
            if looks[clear].1 < 0.0 {
                at_once.push(contact);
                continue;
            }
            let is_risen = |k: usize| looks[..k].iter().any(|(_, value)| *value > 10.0 * UNCLEAR);
            for k in clear + 1..LOOKS {
                let [before, here, after] = [k - 1, k, k + 1].map(|k| looks[k].1);
                if is_risen(k) && here <= before && here < after && here.abs() < UNCLEAR {
                    doubt = doubt.min(time(looks[k].0));
                }
            }
            let Some(below) = (clear..=LOOKS).find(|k| looks[*k].1 < -ZERO) else { continue };
            let (mut low, mut high) = (looks[below - 1].0, looks[below].0);
            for _ in 0..60 {
                let middle = (low + high) / 2.0;
                if guard.at(middle) > 0.0 { low = middle } else { high = middle }
            }
            let slope = (looks[below].1 - looks[below - 1].1) * LOOKS as f64 / length;
            if slope.abs() < 1e-5 {
                doubt = doubt.min(time(low));
            }
            crossings.push((contact, time(low)));
        }
        crossings.sort_by(|a: &(usize, f64), b| a.1.total_cmp(&b.1));
        if let [one, other, ..] = crossings[..]
            && other.1 - one.1 < NEAR
        {
            doubt = doubt.min(one.1);
        }
        self.doubt = doubt;
        (at_once, crossings.first().copied())
    }

    /// Without a contact beside what supports alone would hold, if they press it.
    fn yielding(&self, node: usize, at_once: Vec<usize>) -> Vec<usize> {
        let own = &self.nodes[node];
        let is_closed =
            |(contact, own): (usize, &Contact)| own.is_closed != at_once.contains(&contact);
        let closed: Vec<bool> = self.contacts.iter().enumerate().map(is_closed).collect();
        let pushes = own.pushes_alone(&closed, &self.traces[node].state);
        let is_pressed = |contact: &usize| {
            let (_, link) = own.contacts().find(|(own, _)| own == contact).expect("its own");
            pushes.iter().any(|([first, last], push)| {
                *push < 0.0 && *first == link + 1 || *push > 0.0 && *last == link
            })
        };
        at_once.iter().copied().filter(|contact| !is_pressed(contact)).collect()
    }

    /// Opens closed contacts and closes open ones, now.
    fn change(&mut self, node: usize, changes: &[usize]) -> Option<()> {
        let now = self.traces[node].now;
        for contact in changes {
            let own = &mut self.contacts[*contact];
            let time = own.idle.take().unwrap_or(now);
            (own.is_closed, own.was_clear, own.since) = (!own.is_closed, false, now);
            let kind = match own.is_closed {
                true => EventKind::Closing,
                false => EventKind::Opening,
            };
            let undone = self.happenings.iter().rposition(|one| one.contact == *contact);
            let undone = undone.filter(|at| {
                let one = &self.happenings[*at];
                now > 0.0 && (one.time - time).abs() < SAME && one.kind != kind
            });
            match undone {
                Some(at) => drop(self.happenings.remove(at)),
                None => self.happenings.push(Happening { kind, contact: *contact, time }),
            }
        }
        let points = self.nodes[node].points.len();
        for (contact, link) in self.nodes[node].contacts() {
            if changes.contains(&contact) {
                self.traces[node].state[points + link] = 0.0;
            }
        }
        self.join(node);
        self.traces[node].law = self.nodes[node].law(&self.closed())?;
        let breaks = &mut self.traces[node].breaks;
        if breaks.last().is_none_or(|last| *last < now) {
            breaks.push(now);
        }
        Some(())
    }

    fn finish(&mut self, node: usize, trial: Trial, is_first: bool) {
        let start = trial.cell.start;
        for (contact, link) in self.nodes[node].contacts() {
            let largest = points().map(|x| self.guard(node, &trial, contact, link).at(x).abs());
            let largest = largest.into_iter().fold(0.0, f64::max);
            let own = &mut self.contacts[contact];
            if !own.is_closed {
                continue;
            }
            if largest > ZERO {
                (own.was_clear, own.idle) = (largest > UNCLEAR, None);
                if is_first {
                    self.happenings.push(Happening { kind: EventKind::Impact, contact, time: 0.0 });
                }
            } else if own.was_clear {
                own.idle.get_or_insert(start);
            }
        }
        let trace = &mut self.traces[node];
        trace.now = start + trial.cell.length;
        trace.state = trial.end;
        trace.cells.push(trial.cell);
        self.mark(node);
    }

    /// Notes whether what arrives now may jump, and so what leaves.
    fn mark(&mut self, node: usize) {
        let now = self.traces[node].now;
        let is_now = |time: f64| (time - now).abs() <= SAME * now.max(1.0);
        let arrives = |(side, bar): (usize, &Option<usize>)| {
            let bar = bar.and_then(|bar| self.bars[bar].as_ref());
            bar.is_some_and(|bar| {
                let (Some(travel), Some(source)) = (bar.travel, bar.ends[side]) else {
                    return false;
                };
                let breaks = &self.traces[source].breaks;
                let after = breaks.partition_point(|time| *time + travel < now);
                [after.wrapping_sub(1), after]
                    .iter()
                    .any(|k| breaks.get(*k).is_some_and(|time| is_now(time + travel)))
            })
        };
        let own = &self.nodes[node];
        let mut loads = own.points.iter().flat_map(|point| &point.loads);
        let begins = |load: &super::scene::Load| {
            is_now(load.from.value()) || load.until.is_some_and(|until| is_now(until.value()))
        };
        if own.bars.iter().enumerate().any(arrives) || loads.any(begins) {
            self.traces[node].breaks.push(now);
        }
    }

    /// The velocity of an element of a point, of a bar at its left or right end.
    pub fn velocity(&self, element: usize, side: usize, time: f64) -> f64 {
        let (node, point) = self.point(element, side);
        self.seen(node, point, time)
    }

    fn point(&self, element: usize, side: usize) -> (usize, usize) {
        match self.places[element] {
            Place::Point { node, point } => (node, point),
            Place::Bar(nodes) => {
                let node = nodes[side].expect("an end");
                (node, if side == 0 { self.nodes[node].points.len() - 1 } else { 0 })
            }
            Place::Link { .. } => unreachable!("springs have no velocity"),
        }
    }

    /// The force in a spring, in a bar at its left or right end.
    pub fn force(&self, element: usize, side: usize, time: f64) -> f64 {
        match self.places[element] {
            Place::Link { node, link } => {
                self.seen(node, self.nodes[node].points.len() + link, time)
            }
            Place::Bar(nodes) => {
                // X = Z (v − 2w) at the left end, Z (2w − v) at the right.
                let node = nodes[side].expect("an end");
                let bar = self.bars[element].as_ref().unwrap();
                let surplus =
                    self.velocity(element, side, time) - 2.0 * self.arriving(node, 1 - side, time);
                bar.impedance * if side == 0 { surplus } else { -surplus }
            }
            Place::Point { .. } => unreachable!("what has one place has no force of its own"),
        }
    }

    /// The velocity and the force in a bar at a share of its length.
    pub fn within(&self, element: usize, share: f64, time: f64) -> [f64; 2] {
        let bar = self.bars[element].as_ref().unwrap();
        let passed = [share, 1.0 - share].map(|share| share * bar.travel.expect("a length"));
        let [right, left] = [0, 1].map(|side| self.leaving(bar, side, time - passed[side]));
        [right + left, bar.impedance * (right - left)]
    }

    /// How far a section of a bar has moved.
    pub fn moved_within(&self, element: usize, share: f64, time: f64) -> f64 {
        let bar = self.bars[element].as_ref().unwrap();
        let passed = [share, 1.0 - share].map(|share| share * bar.travel.expect("a length"));
        let moved = |side: usize| {
            let since = time - passed[side];
            let sent = bar.ends[side].filter(|_| since > 0.0).map_or(0.0, |node| {
                let leaving = self.traces[node].cells[0].curves.len() - 1 - side;
                self.sum(node, leaving, since)
            });
            bar.before[side] * time.min(passed[side]) + sent
        };
        moved(0) + moved(1)
    }

    /// How far an element of a point, or an end of a bar, has moved.
    pub fn moved(&self, element: usize, side: usize, time: f64) -> f64 {
        let (node, point) = self.point(element, side);
        self.sum(node, point, time)
    }

    /// How far a spring is compressed.
    pub fn compression(&self, element: usize, time: f64) -> f64 {
        let Place::Link { node, link } = self.places[element] else { unreachable!("a spring") };
        self.sum(node, link, time) - self.sum(node, link + 1, time)
    }

    /// The impulse and the work that came from outside.
    pub fn given(&self, time: f64) -> [f64; 2] {
        let own = |node: usize| self.nodes[node].points.len() + self.nodes[node].links.len();
        let nodes = 0..self.nodes.len();
        [0, 1].map(|k| nodes.clone().map(|node| self.sum(node, own(node) + k, time)).sum())
    }

    /// The integral of a curve since the start.
    fn sum(&self, node: usize, curve: usize, time: f64) -> f64 {
        let begun = self.traces[node].cells.iter().take_while(|cell| cell.start < time);
        let part = |cell: &Cell| {
            let x = (2.0 * (time - cell.start) / cell.length - 1.0).min(1.0);
            let own = &cell.curves[curve];
            (integral(own, x) - integral(own, -1.0)) * cell.length / 2.0
        };
        begun.map(part).sum()
    }

    /// How fast the fastest node changes.
    pub fn rate(&self) -> f64 {
        self.traces.iter().map(|trace| trace.law.rate()).fold(0.0, f64::max)
    }

    fn seen(&self, node: usize, curve: usize, time: f64) -> f64 {
        let cells = &self.traces[node].cells;
        let after = cells.partition_point(|cell| cell.start <= time);
        cells[after.max(1) - 1].at(curve, time)
    }

    /// The nodes at the ends of a bar.
    pub fn ends(&self, element: usize) -> [bool; 2] {
        match self.places[element] {
            Place::Bar(nodes) => nodes.map(|node| node.is_some()),
            _ => [true, false],
        }
    }
}
