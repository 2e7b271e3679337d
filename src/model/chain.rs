//! The points and links of a line that is cut into cells, and their motion step by step.

use crate::limits::MAX_CELL_UPDATES;
use crate::model::error::{ModelError, NotRepresented};
use crate::model::leapfrog::NAME;
use crate::model::line::{Law, Line};
use crate::network::{Face, Field, Reading, Section, Term};
use crate::scene::Drive;

/// Cells of a bar: from point `first` to point `first + cells`.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Cells {
    first: usize,
    cells: usize,
    impedance: f64,
    /// The time in which a wave crosses a cell.
    crossing: f64,
    velocity: f64,
    force: f64,
}

/// A point of a node: a run of places with one velocity.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Run {
    point: usize,
    /// With the halves of cells beside it.
    mass: f64,
    /// The velocity at the start of all that is joined here.
    velocity: f64,
    /// Of supports.
    stiffness: f64,
    damping: f64,
    /// The force of an endless bar that moves or is pressed from the start, beyond what its damper
    /// takes.
    push: f64,
    held: bool,
}

/// A spring between a run and the next.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Link {
    stiffness: f64,
    damping: f64,
}

/// A node: runs, and the springs between them.
#[derive(Clone, PartialEq, Debug)]
struct Knot {
    runs: Vec<Run>,
    links: Vec<Link>,
    /// The node of the line; none for the end of an endless bar.
    node: Option<usize>,
    /// Whether cells end at the left and begin at the right.
    cells: [bool; 2],
}

/// A line cut into cells.
///
/// # Invariants
/// `0 < step ≤` the crossing time of every cell; each run that is not held has a positive mass.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Chain {
    pub step: f64,
    bars: Vec<Cells>,
    knots: Vec<Knot>,
    /// Which knot a node is.
    knot_of: Vec<usize>,
    points: usize,
}

/// What is read of the motion for one term of an observable.
#[derive(Clone, Debug)]
pub(crate) struct Tap {
    pub coefficient: f64,
    of: Sampled,
    /// The displacement so far.
    sum: f64,
}

#[derive(Clone, Copy, Debug)]
enum Spot {
    /// In a bar, at so many cells from its left end.
    Section { bar: usize, at: f64 },
    /// A run of a node.
    Point(usize),
}

#[derive(Clone, Copy, Debug)]
enum Sampled {
    Velocity(Spot),
    Displacement(Spot),
    /// The force in a bar, at so many cells from its left end.
    Force {
        bar: usize,
        at: f64,
    },
    /// The momentum of a bar.
    Momentum(usize),
    /// Of a spring, by knot and link.
    Compression {
        knot: usize,
        link: usize,
    },
    SpringForce {
        knot: usize,
        link: usize,
    },
    /// Of a support, by knot and run.
    SupportForce {
        knot: usize,
        run: usize,
        stiffness: f64,
        damping: f64,
    },
}

impl Chain {
    /// Cuts a line.
    ///
    /// # Errors
    /// As `Leapfrog::new`.
    pub fn of(line: &Line, cells: usize, courant: f64) -> Result<Chain, ModelError> {
        let refuse = |reason| Err(ModelError::Refused { model: NAME, reason });
        let shortest = line.bars.iter().filter_map(|bar| bar.travel).fold(f64::INFINITY, f64::min);
        if !shortest.is_finite() {
            return refuse(NotRepresented::NoFiniteBar);
        }
        let size = shortest / cells as f64;
        let mut chain = Chain {
            step: f64::INFINITY,
            bars: Vec::new(),
            knots: Vec::new(),
            knot_of: Vec::new(),
            points: 0,
        };
        let count = line.bars.iter().filter_map(|bar| bar.travel).sum::<f64>() / size;
        if count > MAX_CELL_UPDATES {
            let limit = MAX_CELL_UPDATES;
            return Err(ModelError::TooMuch { model: NAME, what: "cells", count, limit });
        }
        let mut nodes = 0..line.nodes.len();
        for (place, bar) in line.bars.iter().enumerate() {
            if chain.knots.is_empty() {
                chain.knot(line, bar.nodes[0].and_then(|_| nodes.next()));
            }
            let (number, crossing) = match bar.travel {
                // A travel time that rounding leaves below a whole number of cells has that number.
                Some(travel) => {
                    let number = (travel / size * (1.0 + 1e-12)).floor().max(1.0);
                    (number, travel / number)
                }
                // As far as it is observed.
                None => ((farthest(line, place) / size).ceil() + 1.0, size),
            };
            chain.step = chain.step.min(crossing);
            let first = chain.points - 1;
            let cells = number as usize;
            let (impedance, velocity, force) = (bar.impedance, bar.velocity, bar.force);
            chain.bars.push(Cells { first, cells, impedance, crossing, velocity, force });
            chain.points += cells - 1;
            chain.knot(line, bar.nodes[1].and_then(|_| nodes.next()));
        }
        chain.step *= courant;
        chain.weigh(line);
        for knot in &chain.knots {
            if let Some(place) = knot.runs.iter().position(|run| !run.held && run.mass <= 0.0) {
                let lumps = &line.nodes[knot.node.expect("bare ends have cells")].lumps;
                let near = lumps.iter().find(|lump| lump.run + 1 >= place).unwrap_or(&lumps[0]);
                return refuse(NotRepresented::Massless(near.name.clone()));
            }
        }
        Ok(chain)
    }

    /// How many cells there are.
    pub fn cells(&self) -> usize {
        self.bars.iter().map(|bar| bar.cells).sum()
    }

    /// Adds a node, or the far end of an endless bar.
    fn knot(&mut self, line: &Line, node: Option<usize>) {
        let runs = node.map_or(1, |node| line.nodes[node].runs);
        let run = |place: usize| Run {
            point: self.points + place,
            mass: 0.0,
            velocity: 0.0,
            stiffness: 0.0,
            damping: 0.0,
            push: 0.0,
            held: false,
        };
        let runs = (0..runs).map(run).collect::<Vec<_>>();
        self.points += runs.len();
        if node.is_some() {
            self.knot_of.push(self.knots.len());
        }
        self.knots.push(Knot { runs, links: Vec::new(), node, cells: [false; 2] });
    }

    /// Puts masses, dampers and springs on the points.
    fn weigh(&mut self, line: &Line) {
        let count = self.knots.len();
        for (place, knot) in self.knots.iter_mut().enumerate() {
            knot.cells = [place > 0, place + 1 < count];
            let last = knot.runs.len() - 1;
            let sides = [(place.checked_sub(1), 0), (Some(place), last)];
            for (bar, run) in sides {
                if let Some(bar) = bar.and_then(|bar| self.bars.get(bar)) {
                    let half = bar.impedance * bar.crossing / 2.0;
                    knot.runs[run].mass += half;
                    knot.runs[run].velocity += half * bar.velocity;
                    if knot.node.is_none() {
                        // What goes on for ever: X = X_0 ± Z (v − V).
                        knot.runs[run].damping += bar.impedance;
                        let sign = if place == 0 { 1.0 } else { -1.0 };
                        knot.runs[run].push += bar.impedance * bar.velocity + sign * bar.force;
                    }
                }
            }
            if let Some(node) = knot.node {
                let node = &line.nodes[node];
                for (place, run) in knot.runs.iter_mut().enumerate() {
                    run.held = node.is_held(place);
                    let (mass, momentum) = node.mass_of(place);
                    run.mass += mass;
                    run.velocity += momentum;
                }
                for lump in &node.lumps {
                    match lump.law {
                        Law::Spring { stiffness, damping } => {
                            knot.links.push(Link { stiffness, damping });
                        }
                        Law::Support { stiffness, damping } => {
                            knot.runs[lump.run].stiffness += stiffness;
                            knot.runs[lump.run].damping += damping;
                        }
                        Law::Load { drive: Drive::Velocity, .. } => knot.runs[lump.run].held = true,
                        _ => {}
                    }
                }
            }
            for run in &mut knot.runs {
                run.velocity = match run.held {
                    true => 0.0,
                    false => run.velocity / run.mass,
                };
            }
        }
    }

    /// What is read for a term; `None` where there is no such thing.
    pub fn tap(&self, line: &Line, term: &Term<f64>) -> Option<Tap> {
        let cells_from_left = |section: &Section<f64>| {
            let cells = self.bars[section.bar];
            let at = (section.distance() / cells.crossing).min(cells.cells as f64);
            // An endless bar to the left is counted from its right end.
            let mirrored = line.bars[section.bar].nodes[0].is_none();
            if mirrored { cells.cells as f64 - at } else { at }
        };
        let point = |face: Face| {
            let knot = &self.knots[self.knot_of[face.lump().node]];
            Spot::Point(knot.runs[line.run(face)].point)
        };
        let of = match &term.of {
            Reading::InBar(field, section) => {
                let (bar, at) = (section.bar, cells_from_left(section));
                match field {
                    Field::Velocity => Sampled::Velocity(Spot::Section { bar, at }),
                    Field::Displacement => Sampled::Displacement(Spot::Section { bar, at }),
                    Field::Force => Sampled::Force { bar, at },
                }
            }
            Reading::Momentum(bar) => Sampled::Momentum(*bar),
            Reading::Velocity(face) => Sampled::Velocity(point(*face)),
            Reading::Displacement(face) => Sampled::Displacement(point(*face)),
            Reading::Compression(lump) | Reading::Force(lump) => {
                let knot = self.knot_of[lump.node];
                let own = &line.nodes[lump.node].lumps[lump.place];
                match (&term.of, &own.law) {
                    (Reading::Compression(_), Law::Spring { .. }) => {
                        Sampled::Compression { knot, link: own.run }
                    }
                    (Reading::Force(_), Law::Spring { .. }) => {
                        Sampled::SpringForce { knot, link: own.run }
                    }
                    (Reading::Force(_), Law::Support { stiffness, damping }) => {
                        let (stiffness, damping) = (*stiffness, *damping);
                        Sampled::SupportForce { knot, run: own.run, stiffness, damping }
                    }
                    _ => return None,
                }
            }
        };
        Some(Tap { coefficient: term.coefficient, of, sum: 0.0 })
    }

    /// The motion at the start.
    pub fn start(&self) -> Motion<'_> {
        let mut velocities = vec![0.0; self.points];
        let mut forces = Vec::new();
        for bar in &self.bars {
            velocities[bar.first..=bar.first + bar.cells].fill(bar.velocity);
            forces.push(vec![bar.force; bar.cells]);
        }
        for run in self.knots.iter().flat_map(|knot| &knot.runs) {
            velocities[run.point] = run.velocity;
        }
        let most = self.knots.iter().map(|knot| knot.runs.len()).max().unwrap_or(0);
        Motion {
            chain: self,
            steps: 0,
            before: velocities.clone(),
            velocities,
            forces,
            compressions: self.knots.iter().map(|knot| vec![0.0; knot.links.len()]).collect(),
            displacements: self.knots.iter().map(|knot| vec![0.0; knot.runs.len()]).collect(),
            right: vec![0.0; most],
            diagonal: vec![0.0; most],
        }
    }
}

/// How far from its end an endless bar is observed.
fn farthest(line: &Line, bar: usize) -> f64 {
    let terms = line.observables.iter().flat_map(|observable| observable.terms());
    let seen = |term: &Term<f64>| match &term.of {
        Reading::InBar(_, section) if section.bar == bar => *section.distance(),
        _ => 0.0,
    };
    terms.map(seen).fold(0.0, f64::max)
}

/// The motion of a chain: forces at `steps · Δt`, velocities half a step before or after.
pub(crate) struct Motion<'a> {
    chain: &'a Chain,
    steps: usize,
    velocities: Vec<f64>,
    /// The velocities a step before.
    before: Vec<f64>,
    /// The force in each cell, by bar.
    forces: Vec<Vec<f64>>,
    /// Of springs, by knot.
    compressions: Vec<Vec<f64>>,
    /// Of runs, by knot.
    displacements: Vec<Vec<f64>>,
    right: Vec<f64>,
    diagonal: Vec<f64>,
}

impl Motion<'_> {
    /// Velocities half a step after the forces, from those half a step before; from the start itself
    /// in the first step, which is half as long.
    pub fn advance(&mut self, line: &Line) {
        let step = self.chain.step;
        let length = if self.steps == 0 { step / 2.0 } else { step };
        self.before.copy_from_slice(&self.velocities);
        for (bar, forces) in self.chain.bars.iter().zip(&self.forces) {
            let factor = length / (bar.impedance * bar.crossing);
            let inner = &mut self.velocities[bar.first + 1..bar.first + bar.cells];
            for (velocity, pair) in inner.iter_mut().zip(forces.windows(2)) {
                *velocity += factor * (pair[0] - pair[1]);
            }
        }
        for knot in 0..self.chain.knots.len() {
            self.turn(line, knot, length);
        }
    }

    /// The velocities of a knot: with `δ = v⁺ − v⁻`,
    /// `(m/Δt + d/2 + kΔt/4) δ = F − d v⁻ − k u`; in the first half step dampers act with `v⁺`.
    fn turn(&mut self, line: &Line, place: usize, length: f64) {
        let chain = self.chain;
        let knot = &chain.knots[place];
        let (share, spring) = if self.steps == 0 { (1.0, 0.0) } else { (0.5, length / 4.0) };
        let count = knot.runs.len();
        let now = self.steps as f64 * self.chain.step;
        let span = [(now - self.chain.step / 2.0).max(0.0), now + self.chain.step / 2.0];
        let reach = [place.checked_sub(1), Some(place).filter(|_| knot.cells[1])];
        let resisting = |link: &Link| share * link.damping + spring * link.stiffness;
        for (i, run) in knot.runs.iter().enumerate() {
            let own = share * run.damping + spring * run.stiffness;
            self.diagonal[i] = run.mass / length + own;
            let resisted = run.damping * self.before[run.point];
            self.right[i] = run.push - resisted - run.stiffness * self.displacements[place][i];
        }
        if let [Some(bar), _] = reach {
            self.right[0] += self.forces[bar].last().expect("a cell");
        }
        if let [_, Some(bar)] = reach {
            self.right[count - 1] -= self.forces[bar][0];
        }
        for (i, link) in knot.links.iter().enumerate() {
            let [left, right] = [knot.runs[i].point, knot.runs[i + 1].point];
            let closing = self.before[left] - self.before[right];
            let force = link.stiffness * self.compressions[place][i] + link.damping * closing;
            self.right[i] -= force;
            self.right[i + 1] += force;
            self.diagonal[i] += resisting(link);
            self.diagonal[i + 1] += resisting(link);
        }
        let mut imposed = vec![0.0; count];
        if let Some(node) = knot.node {
            for lump in &line.nodes[node].lumps {
                let Law::Load { drive, course, from, until } = &lump.law else { continue };
                match drive {
                    Drive::Force => {
                        let acting = [span[0].max(*from), span[1].min(*until)];
                        let share = (acting[1] - acting[0]) / (span[1] - span[0]);
                        if share > 0.0 {
                            let middle = acting[0].midpoint(acting[1]);
                            self.right[lump.run] += share * course.value(middle);
                        }
                    }
                    Drive::Velocity => {
                        let at = span[1];
                        if *from <= at && at < *until {
                            imposed[lump.run] = course.value(at);
                        }
                    }
                }
            }
        }
        // Elimination from the left: the matrix is symmetric, with springs beside its diagonal.
        for (i, run) in knot.runs.iter().enumerate() {
            if run.held {
                // A known change counts at both neighbours.
                let change = imposed[i] - self.before[run.point];
                if i > 0 {
                    self.right[i - 1] += resisting(&knot.links[i - 1]) * change;
                }
                if i + 1 < count {
                    self.right[i + 1] += resisting(&knot.links[i]) * change;
                }
            }
        }
        let free = |i: usize| !knot.runs[i].held;
        for i in 1..count {
            if free(i - 1) && free(i) {
                let factor = resisting(&knot.links[i - 1]) / self.diagonal[i - 1];
                self.diagonal[i] -= factor * resisting(&knot.links[i - 1]);
                self.right[i] += factor * self.right[i - 1];
            }
        }
        for i in (0..count).rev() {
            let point = knot.runs[i].point;
            if !free(i) {
                self.velocities[point] = imposed[i];
                continue;
            }
            if i + 1 < count && free(i + 1) {
                let next = knot.runs[i + 1].point;
                let change = self.velocities[next] - self.before[next];
                self.right[i] += resisting(&knot.links[i]) * change;
            }
            self.velocities[point] = self.before[point] + self.right[i] / self.diagonal[i];
        }
    }

    /// A sample and its time: forces and displacements at the time of the forces, velocities and
    /// momentum half a step later.
    pub fn sample(&self, tap: &mut Tap) -> (f64, f64) {
        let now = self.steps as f64 * self.chain.step;
        let later = now + self.chain.step / 2.0;
        match tap.of {
            Sampled::Velocity(spot) => (later, self.velocity(spot)),
            Sampled::Displacement(spot) => {
                let sum = tap.sum;
                tap.sum += self.chain.step * self.velocity(spot);
                (now, sum)
            }
            Sampled::Momentum(bar) => {
                let bar = &self.chain.bars[bar];
                let all = &self.velocities[bar.first..=bar.first + bar.cells];
                let ends = (all[0] + all[bar.cells]) / 2.0;
                let sum = all.iter().sum::<f64>() - ends;
                (later, bar.impedance * bar.crossing * sum)
            }
            Sampled::Compression { knot, link } => (now, self.compressions[knot][link]),
            Sampled::SpringForce { knot, link } => {
                let runs = &self.chain.knots[knot].runs;
                let Link { stiffness, damping } = self.chain.knots[knot].links[link];
                let closing = self.now(runs[link].point) - self.now(runs[link + 1].point);
                (now, stiffness * self.compressions[knot][link] + damping * closing)
            }
            Sampled::SupportForce { knot, run, stiffness, damping } => {
                let velocity = self.now(self.chain.knots[knot].runs[run].point);
                (now, stiffness * self.displacements[knot][run] + damping * velocity)
            }
            Sampled::Force { bar, at } => (now, self.force(bar, at)),
        }
    }

    /// The velocity of a point at the time of the forces.
    fn now(&self, point: usize) -> f64 {
        match self.steps {
            0 => self.velocities[point],
            _ => self.before[point].midpoint(self.velocities[point]),
        }
    }

    fn velocity(&self, spot: Spot) -> f64 {
        match spot {
            Spot::Section { bar, at } => {
                let bar = &self.chain.bars[bar];
                let whole = (at.floor() as usize).min(bar.cells - 1);
                let share = at - whole as f64;
                let pair = &self.velocities[bar.first + whole..];
                pair[0] + share * (pair[1] - pair[0])
            }
            Spot::Point(point) => self.velocities[point],
        }
    }

    /// The force in a bar, between the middles of cells; at its ends with the force that moves half a
    /// cell, `X_end = X ± Zh/2 · v'`.
    fn force(&self, place: usize, at: f64) -> f64 {
        let (bar, forces) = (&self.chain.bars[place], &self.forces[place]);
        let end = |point: usize, sign: f64, force: f64| {
            let step = self.chain.step;
            let change = match self.steps {
                0 => (self.velocities[point] - bar.velocity) / (step / 2.0),
                _ => (self.velocities[point] - self.before[point]) / step,
            };
            force + sign * bar.impedance * bar.crossing / 2.0 * change
        };
        let between = |from: f64, to: f64, share: f64| from + share * (to - from);
        let last = bar.cells - 1;
        let at = at - 0.5;
        if at < 0.0 {
            return between(end(bar.first, 1.0, forces[0]), forces[0], 1.0 + 2.0 * at);
        }
        if at >= last as f64 {
            let whole = end(bar.first + bar.cells, -1.0, forces[last]);
            return between(forces[last], whole, 2.0 * (at - last as f64));
        }
        let whole = at.floor() as usize;
        between(forces[whole], forces[whole + 1], at - whole as f64)
    }

    /// Forces a step later, from the velocities in between.
    pub fn settle(&mut self) {
        let step = self.chain.step;
        for (bar, forces) in self.chain.bars.iter().zip(&mut self.forces) {
            let factor = step * bar.impedance / bar.crossing;
            let velocities = &self.velocities[bar.first..=bar.first + bar.cells];
            for (force, pair) in forces.iter_mut().zip(velocities.windows(2)) {
                *force += factor * (pair[0] - pair[1]);
            }
        }
        for (place, knot) in self.chain.knots.iter().enumerate() {
            for (displacement, run) in self.displacements[place].iter_mut().zip(&knot.runs) {
                *displacement += step * self.velocities[run.point];
            }
            for (compression, pair) in self.compressions[place].iter_mut().zip(knot.runs.windows(2))
            {
                let [left, right] = [pair[0].point, pair[1].point];
                *compression += step * (self.velocities[left] - self.velocities[right]);
            }
        }
        self.steps += 1;
    }
}
