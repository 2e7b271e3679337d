//! The points and links of a line that is cut into cells, and their motion step by step.

use crate::limits::MAX_CELL_UPDATES;
use crate::model::error::{ModelError, NotRepresented};
use crate::model::line::Line;
use crate::network::{
    Acting, ElementLaw, Face, Field, Link, Lump, Lumped, Node, Reading, Section, Side, Term,
};
use crate::scene::Drive;

pub(crate) const NAME: &str = "leapfrog";

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

/// A node on the points of the chain, or the far end of an endless bar, which is a node with a damper.
#[derive(Clone, PartialEq, Debug)]
struct Station {
    node: Node<f64>,
    /// The point of the first run; those of the others follow.
    first: usize,
    /// The masses of runs with the halves of cells beside them.
    mass: Vec<f64>,
    /// The velocities of runs after the start, when all that is joined there moves together.
    start: Vec<f64>,
    /// The force of an endless bar that moves or is pressed from the start, beyond what its damper
    /// takes.
    push: f64,
    /// The bars whose cells end at the left and begin at the right.
    bars: [Option<usize>; 2],
}

/// A line cut into cells.
///
/// # Invariants
/// `0 < step ≤` the crossing time of every cell; each run that is not held has a positive mass.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Chain {
    pub step: f64,
    bars: Vec<Cells>,
    stations: Vec<Station>,
    /// Which station a node is.
    station_of: Vec<usize>,
    points: usize,
}

impl Chain {
    pub fn of(line: &Line, cells: usize, courant: f64) -> Result<Chain, ModelError> {
        let refuse = |reason| Err(ModelError::Refused { model: NAME, reason });
        let shortest = line.bars.iter().filter_map(|bar| bar.travel).fold(f64::INFINITY, f64::min);
        if !shortest.is_finite() {
            return refuse(NotRepresented::NoFiniteBar);
        }
        let size = shortest / cells as f64;
        let count = line.bars.iter().filter_map(|bar| bar.travel).sum::<f64>() / size;
        ModelError::limited(NAME, "cells", count, MAX_CELL_UPDATES)?;
        let mut chain = Chain {
            step: f64::INFINITY,
            bars: Vec::new(),
            stations: Vec::new(),
            station_of: vec![0; line.nodes.len()],
            points: 0,
        };
        for (place, bar) in line.bars.iter().enumerate() {
            if place == 0 {
                chain.place(line, bar.nodes[0], [None, Some(0)]);
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
            let next = Some(place + 1).filter(|next| *next < line.bars.len());
            chain.place(line, bar.nodes[1], [Some(place), next]);
        }
        chain.step *= courant;
        for station in &mut chain.stations {
            station.weigh(&chain.bars);
            let is_light =
                |run: &usize| !station.node.is_imposed(*run) && station.mass[*run] <= 0.0;
            if let Some(run) = (0..station.mass.len()).find(is_light) {
                let elements = &station.node.elements;
                let near = elements.iter().find(|own| own.run + 1 >= run).unwrap_or(&elements[0]);
                return refuse(NotRepresented::Massless(line.name(near.element)));
            }
        }
        Ok(chain)
    }

    pub fn cells(&self) -> usize {
        self.bars.iter().map(|bar| bar.cells).sum()
    }

    /// Adds a node, or the far end of an endless bar.
    fn place(&mut self, line: &Line, node: Option<usize>, bars: [Option<usize>; 2]) {
        let mut push = 0.0;
        let node = match node {
            Some(node) => {
                self.station_of[node] = self.stations.len();
                line.nodes[node].clone()
            }
            None => {
                // What goes on for ever: X = X_0 ± Z (v − V).
                let sign = if bars[0].is_none() { 1.0 } else { -1.0 };
                let bar = &line.bars[bars[0].or(bars[1]).expect("an end of a bar")];
                push = bar.impedance * bar.velocity + sign * bar.force;
                let law = ElementLaw::Support { stiffness: 0.0, damping: bar.impedance };
                let damper = Lumped { element: bar.element, run: 0, law };
                let (left, right, impedance) = (Side::Free, Side::Free, [0.0; 2]);
                Node { left, right, impedance, elements: vec![damper], links: Vec::new() }
            }
        };
        let (mass, start) = (0..node.runs()).map(|run| node.mass_and_momentum(run)).unzip();
        let first = self.points;
        self.points += node.runs();
        self.stations.push(Station { node, first, mass, start, push, bars });
    }

    /// Whether there is such a thing to read.
    pub fn has(&self, reading: &Reading<f64>) -> bool {
        let law =
            |lump: &Lump| &self.stations[self.station_of[lump.node]].node.elements[lump.place].law;
        match reading {
            Reading::Compression(lump) => matches!(law(lump), ElementLaw::Spring { .. }),
            Reading::Force(lump) => law(lump).resistance().is_some(),
            _ => true,
        }
    }

    pub fn start(&self) -> Motion<'_> {
        let mut velocities = vec![0.0; self.points];
        let mut forces = Vec::new();
        for bar in &self.bars {
            velocities[bar.first..=bar.first + bar.cells].fill(bar.velocity);
            forces.push(vec![bar.force; bar.cells]);
        }
        for station in &self.stations {
            velocities[station.first..][..station.start.len()].copy_from_slice(&station.start);
        }
        let still = |station: &Station| vec![0.0; station.node.elements.len()];
        Motion {
            chain: self,
            steps: 0,
            before: velocities.clone(),
            velocities,
            forces,
            displacements: self.stations.iter().map(still).collect(),
            equations: Equations::default(),
        }
    }
}

impl Station {
    /// Adds the halves of cells to the masses, and turns momenta into velocities.
    fn weigh(&mut self, bars: &[Cells]) {
        for (bar, run) in self.bars.into_iter().zip(self.node.side_runs()) {
            if let Some(bar) = bar.map(|bar| &bars[bar]) {
                let half = bar.impedance * bar.crossing / 2.0;
                self.mass[run] += half;
                self.start[run] += half * bar.velocity;
            }
        }
        for (run, (start, mass)) in self.start.iter_mut().zip(&self.mass).enumerate() {
            *start = if self.node.is_imposed(run) { 0.0 } else { *start / mass };
        }
    }

    /// What the velocities of two runs make of the displacement of an element, or the velocity of one.
    fn rate(&self, own: &Lumped<f64>, velocity: impl Fn(usize) -> f64) -> f64 {
        match own.law.is_link() {
            true => velocity(own.run) - velocity(own.run + 1),
            false => velocity(own.run),
        }
    }
}

/// The equations of the runs of a node for the changes of their velocities in a step: a matrix with one
/// diagonal beside the main one.
#[derive(Default)]
struct Equations {
    diagonal: Vec<f64>,
    /// What resists the difference of the velocities beside each link.
    beside: Vec<f64>,
    right: Vec<f64>,
    /// The velocities of runs that are held or imposed.
    imposed: Vec<Option<f64>>,
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

impl Equations {
    /// Moves the known changes of runs that are held or imposed to the right side of their neighbours.
    fn hold(&mut self, before: &[f64]) {
        for (run, imposed) in self.imposed.iter().enumerate() {
            let Some(change) = imposed.map(|velocity| velocity - before[run]) else { continue };
            if run > 0 {
                self.right[run - 1] += self.beside[run - 1] * change;
            }
            if run < self.beside.len() {
                self.right[run + 1] += self.beside[run] * change;
            }
        }
    }

    /// The velocities after the step, by elimination from the left.
    fn solve(&mut self, before: &[f64], velocities: &mut [f64]) {
        let Equations { diagonal, beside, right, imposed } = self;
        let count = diagonal.len();
        for run in 1..count {
            if imposed[run - 1].is_none() && imposed[run].is_none() {
                let factor = beside[run - 1] / diagonal[run - 1];
                diagonal[run] -= factor * beside[run - 1];
                right[run] += factor * right[run - 1];
            }
        }
        for run in (0..count).rev() {
            if let Some(velocity) = imposed[run] {
                velocities[run] = velocity;
                continue;
            }
            if run + 1 < count && imposed[run + 1].is_none() {
                right[run] += beside[run] * (velocities[run + 1] - before[run + 1]);
            }
            velocities[run] = before[run] + right[run] / diagonal[run];
        }
    }
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
    /// Of the elements of each station.
    displacements: Vec<Vec<f64>>,
    equations: Equations,
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
        for station in 0..self.chain.stations.len() {
            self.turn(line, station, length);
        }
    }

    /// The velocities of a station: with `δ = v⁺ − v⁻`,
    /// `(m/Δt + d/2 + kΔt/4) δ = F − d v⁻ − k u`; in the first half step dampers act with `v⁺`.
    fn turn(&mut self, line: &Line, number: usize, length: f64) {
        let station = &self.chain.stations[number];
        let mut equations = std::mem::take(&mut self.equations);
        self.resist(station, length, &mut equations);
        self.load(line, number, &mut equations);
        let before = &self.before[station.first..];
        equations.hold(before);
        equations.solve(before, &mut self.velocities[station.first..]);
        self.equations = equations;
    }

    /// The left side: masses, and what resists the change of a velocity.
    fn resist(&self, station: &Station, length: f64, equations: &mut Equations) {
        let (share, spring) = if self.steps == 0 { (1.0, 0.0) } else { (0.5, length / 4.0) };
        let Equations { diagonal, beside, .. } = equations;
        diagonal.clear();
        diagonal.extend(station.mass.iter().map(|mass| mass / length));
        beside.clear();
        beside.resize(station.node.links.len(), 0.0);
        for own in &station.node.elements {
            let Some([stiffness, damping]) = own.law.resistance() else { continue };
            let resisting = share * damping + spring * stiffness;
            diagonal[own.run] += resisting;
            if own.law.is_link() {
                diagonal[own.run + 1] += resisting;
                beside[own.run] += resisting;
            }
        }
    }

    /// The right side: the balance of each run but for inertia, and the velocities that are imposed.
    fn load(&self, line: &Line, number: usize, equations: &mut Equations) {
        let station = &self.chain.stations[number];
        let Equations { right, imposed, .. } = equations;
        right.clear();
        imposed.clear();
        for run in 0..station.node.runs() {
            let force = |(sign, acting)| sign as f64 * self.acting(line, number, acting);
            right.push(station.push + station.node.acting(run).map(force).sum::<f64>());
            imposed.push(station.node.is_imposed(run).then(|| {
                let end = self.span()[1];
                let loads = station.node.imposing(run).map(|own| &line.loads[&own.element]);
                let acting = loads.filter(|load| load.from <= end && end < load.until);
                acting.map(|load| load.course.value(end)).sum()
            }));
        }
    }

    /// The step from the velocities before to those after.
    fn span(&self) -> [f64; 2] {
        let (now, half) = (self.steps as f64 * self.chain.step, self.chain.step / 2.0);
        [(now - half).max(0.0), now + half]
    }

    /// A term of the balance of a run at a station; masses are on the left side.
    fn acting(&self, line: &Line, number: usize, acting: Acting) -> f64 {
        let station = &self.chain.stations[number];
        let place = match acting {
            Acting::Side(side) => {
                let forces = station.bars[side].map(|bar| &self.forces[bar]);
                let end = |forces: &Vec<f64>| match side {
                    0 => forces.last().copied(),
                    _ => forces.first().copied(),
                };
                return forces.and_then(end).unwrap_or(0.0);
            }
            Acting::Link(link) => match station.node.links[link] {
                Link::Element(place) | Link::Local { place, .. } => place,
                Link::Contact(_) => return 0.0,
            },
            Acting::Element(place) => place,
        };
        match station.node.elements[place] {
            Lumped { element, law: ElementLaw::Load(Drive::Force), .. } => {
                let (load, [from, to]) = (&line.loads[&element], self.span());
                let acting = [from.max(load.from), to.min(load.until)];
                let share = (acting[1] - acting[0]) / (to - from);
                let middle = acting[0].midpoint(acting[1]);
                if share > 0.0 { share * load.course.value(middle) } else { 0.0 }
            }
            _ => self.resistance(number, place, |point| self.before[point]),
        }
    }

    /// The force `k u + d u'` in a spring or a support, with these velocities of points.
    fn resistance(&self, number: usize, place: usize, velocity: impl Fn(usize) -> f64) -> f64 {
        let station = &self.chain.stations[number];
        let own = &station.node.elements[place];
        let Some([stiffness, damping]) = own.law.resistance() else { return 0.0 };
        let rate = station.rate(own, |run| velocity(station.first + run));
        stiffness * self.displacements[number][place] + damping * rate
    }

    /// A sample of a reading and its time: forces and displacements at the time of the forces, velocities
    /// and momentum half a step later. Displacements are summed up in `moved`.
    pub fn sample(&self, line: &Line, of: &Reading<f64>, moved: &mut f64) -> (f64, f64) {
        let now = self.steps as f64 * self.chain.step;
        let later = now + self.chain.step / 2.0;
        let mut displacement = |velocity: f64| {
            let before = *moved;
            *moved += self.chain.step * velocity;
            (now, before)
        };
        match of {
            Reading::InBar(Field::Velocity, section) => (later, self.in_bar(line, section)),
            Reading::InBar(Field::Displacement, section) => {
                displacement(self.in_bar(line, section))
            }
            Reading::InBar(Field::Force, section) => {
                (now, self.force(section.bar, self.cells_from_left(line, section)))
            }
            Reading::Momentum(bar) => {
                let bar = &self.chain.bars[*bar];
                let all = &self.velocities[bar.first..=bar.first + bar.cells];
                let ends = (all[0] + all[bar.cells]) / 2.0;
                let sum = all.iter().sum::<f64>() - ends;
                (later, bar.impedance * bar.crossing * sum)
            }
            Reading::Velocity(face) => (later, self.beside(*face)),
            Reading::Displacement(face) => displacement(self.beside(*face)),
            Reading::Compression(Lump { node, place }) => {
                (now, self.displacements[self.chain.station_of[*node]][*place])
            }
            Reading::Force(Lump { node, place }) => {
                let station = self.chain.station_of[*node];
                (now, self.resistance(station, *place, |point| self.now(point)))
            }
        }
    }

    /// The velocity of a point at the time of the forces.
    fn now(&self, point: usize) -> f64 {
        match self.steps {
            0 => self.velocities[point],
            _ => self.before[point].midpoint(self.velocities[point]),
        }
    }

    /// At how many cells from the left end of its bar a section lies.
    fn cells_from_left(&self, line: &Line, section: &Section<f64>) -> f64 {
        let bar = &self.chain.bars[section.bar];
        let at = (section.distance() / bar.crossing).min(bar.cells as f64);
        // An endless bar to the left is counted from its right end.
        let mirrored = line.bars[section.bar].nodes[0].is_none();
        if mirrored { bar.cells as f64 - at } else { at }
    }

    fn in_bar(&self, line: &Line, section: &Section<f64>) -> f64 {
        let (bar, at) = (&self.chain.bars[section.bar], self.cells_from_left(line, section));
        let whole = (at.floor() as usize).min(bar.cells - 1);
        let pair = &self.velocities[bar.first + whole..];
        pair[0] + (at - whole as f64) * (pair[1] - pair[0])
    }

    /// The velocity of the run beside an element.
    fn beside(&self, face: Face) -> f64 {
        let station = &self.chain.stations[self.chain.station_of[face.lump().node]];
        self.velocities[station.first + station.node.run_beside(face)]
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
        for (station, displacements) in self.chain.stations.iter().zip(&mut self.displacements) {
            for (displacement, own) in displacements.iter_mut().zip(&station.node.elements) {
                *displacement +=
                    step * station.rate(own, |run| self.velocities[station.first + run]);
            }
        }
        self.steps += 1;
    }
}
