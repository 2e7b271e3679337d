//! The method of steps: waves in bars as delayed functions, nodes as ordinary differential equations.
//!
//! Time is cut into periods of the common measure of all travel times. On one period all that arrives
//! at a node left another one earlier and is known; the equations of the node are then ordinary ones,
//! which are solved by collocation of order 25 (see `collocation`). What arrives is an input, and what
//! leaves follows from the velocity of the node, so that no delayed derivative occurs, as it does where
//! one writes these problems as neutral equations.
//!
//! A period is halved until the last coefficients of the series of all that moves are below the tolerance;
//! the error is well below them. Error law (measured, not proven): the largest error over some ten round
//! trips is below ten times the tolerance times the largest value, for tolerances down to 1e-10. Jumps lie
//! on the borders of periods and are exact.
//!
//! It is the one model that takes local contacts, whose force is a power of their compression. Where that
//! power is not smooth, at the first touch and where a contact opens or closes, pieces are halved until
//! their series have converged. Measured for two endless bars: within the tolerance of the closed form, of
//! the largest force, down to 1e-11; within 1e-12 at 1e-13.

use crate::enclosure::Numbers;
use crate::expression::{Fraction, Root};
use crate::limits::MAX_NODE_PERIODS;
use crate::model::Model;
use crate::model::collocation::{Collocation, Pressing};
use crate::model::course::{double, double_of};
use crate::model::error::{BadSetting, ModelError, NotRepresented};
use crate::model::line::{Bar, Line, LocalContact};
use crate::model::track::{DEGREE, POINTS, Track, Values, points, series};
use crate::network::{
    Face, Field, Lump, ModelLoad, Reading, ScaledScene, Section, Side, System, Unresisted,
};
use crate::scene::ElementIndex;
use num_integer::Integer as _;
use num_traits::{Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;
use wavestep_polynomial::Rational;

const NAME: &str = "method of steps";

/// How often a period is halved before its solution is given up.
const MAX_HALVINGS: u32 = 40;

/// How much finer than the tolerance the forces of local contacts are found.
const MARGIN: f64 = 1e-2;

/// The precision of the laws of nodes before they are rounded to doubles.
const BITS: u64 = 128;

/// Delayed waves, with collocation at the nodes.
///
/// Cost: for each period and node at least the product of a matrix and a vector, of 25 entries for each
/// mass and spring of the node.
///
/// # Invariants
/// All travel times, and the times at which loads begin and end, are whole numbers of periods.
#[derive(Clone, Debug)]
pub struct Steps {
    line: Line,
    /// The systems of the nodes, and the local contacts in them.
    systems: Vec<System<f64>>,
    contacts: Vec<Vec<Pressing>>,
    tolerance: f64,
    /// The common measure; `None` where nothing is delayed.
    period: Option<f64>,
    /// The travel times in periods.
    delays: Vec<i64>,
    /// From which period until which each load acts.
    acting: BTreeMap<ElementIndex, [i64; 2]>,
}

/// The common measure of times, and how often each holds it.
fn measure(times: &[(String, Fraction)]) -> Result<Option<(Fraction, Vec<i64>)>, NotRepresented> {
    let refused = |name: &str| NotRepresented::NoCommonMeasure(name.to_owned());
    let Some((_, first)) = times.iter().find(|(_, time)| !time.is_zero()) else { return Ok(None) };
    let mut ratios: Vec<Rational> = Vec::new();
    for (name, time) in times {
        let ratio = Root::from(time.clone()).over(&Root::from(first.clone())).ok();
        let ratio = ratio.and_then(|ratio| ratio.exact()).and_then(|ratio| ratio.as_constant());
        ratios.push(ratio.ok_or_else(|| refused(name))?);
    }
    let mut common = Rational::zero();
    for ratio in ratios.iter().map(Rational::abs) {
        let numerator = (common.numer() * ratio.denom()).gcd(&(ratio.numer() * common.denom()));
        common = Rational::new(numerator, common.denom() * ratio.denom());
    }
    let counts = ratios.iter().zip(times).map(|(ratio, (name, _))| {
        (ratio / &common).to_integer().to_i64().ok_or_else(|| refused(name))
    });
    Ok(Some((first.scale(&common), counts.collect::<Result<_, _>>()?)))
}

impl Steps {
    pub fn new(scene: &impl AsRef<ScaledScene>, tolerance: f64) -> Result<Steps, ModelError> {
        let scaled = scene.as_ref();
        if !(1e-13..=1e-2).contains(&tolerance) {
            let reason = BadSetting::Tolerance(tolerance);
            return Err(ModelError::Setting { model: NAME, reason });
        }
        let line = Line::of(scaled)?;
        let numbers = Numbers::new(&scaled.model().constants);
        let systems = systems(scaled, &numbers, &line)?;
        let contacts = line.nodes.iter().zip(&systems).map(|(node, system)| {
            let places = node.elements.iter().zip(&system.kept).zip(&system.driven);
            let pressing = places.filter_map(|((own, kept), driven)| {
                let contact = LocalContact::of(&own.law)?;
                Some(Pressing { contact, state: (*kept)?, input: (*driven)? })
            });
            pressing.collect()
        });
        let contacts = contacts.collect();
        let (mut times, mut loads) = (Vec::new(), Vec::new());
        let named = |element: ElementIndex, time: &Option<Fraction>| {
            (line.name(element), time.clone().unwrap_or_else(Fraction::zero))
        };
        times.extend(
            line.bars
                .iter()
                .map(|bar| named(bar.element, &scaled.model().bars[&bar.element].travel)),
        );
        for element in &scaled.scene().line.elements {
            if let Some(ModelLoad { from, until, .. }) = scaled.model().loads.get(element) {
                times.extend([named(*element, &Some(from.clone())), named(*element, until)]);
                loads.push((*element, until.is_some()));
            }
        }
        let refuse = |reason| ModelError::Refused { model: NAME, reason };
        let grid = measure(&times).map_err(refuse)?;
        let counts = grid.as_ref().map_or(vec![0; times.len()], |(_, counts)| counts.clone());
        let (delays, moments) = counts.split_at(line.bars.len());
        let acting = loads.into_iter().zip(moments.chunks(2)).map(|((element, ends), moments)| {
            (element, [moments[0], if ends { moments[1] } else { i64::MAX }])
        });
        let (acting, delays) = (acting.collect(), delays.to_vec());
        let period = grid.map(|(period, _)| double(&numbers, &period)).transpose()?;
        Ok(Steps { line, systems, contacts, tolerance, period, delays, acting })
    }

    fn motion(&self, last: f64) -> Result<Motion<'_>, ModelError> {
        // Without delays one period is as long as what is asked for.
        let period = self.period.unwrap_or(if last > 0.0 { last } else { 1.0 });
        let periods = (last / period * (1.0 + 1e-11)).floor() + 1.0;
        let count = periods * self.systems.len() as f64;
        ModelError::limited(NAME, "periods of nodes", count, MAX_NODE_PERIODS)?;
        let track = |before| Track::new(before, period);
        let tracks = |count: usize| vec![track(0.0); count];
        let speed = self.line.speed();
        let mut motion = Motion {
            steps: self,
            period,
            states: (0..self.systems.len()).map(|node| self.start(node)).collect(),
            scales: (0..self.systems.len()).map(|node| self.scales(node, speed)).collect(),
            waves: self.line.bars.iter().map(|bar| bar.before().map(track)).collect(),
            velocities: self.systems.iter().map(|own| tracks(own.group.len())).collect(),
            displacements: self.systems.iter().map(|own| tracks(own.displacements())).collect(),
            collocations: self.systems.iter().map(|_| BTreeMap::new()).collect(),
            speed,
        };
        for number in 0..periods as i64 {
            motion.step(number)?;
        }
        Ok(motion)
    }

    /// The state of a node at the start: velocities of what has a mass, and no displacements.
    fn start(&self, node: usize) -> Vec<f64> {
        let (node, system) = (&self.line.nodes[node], &self.systems[node]);
        let mut state = vec![0.0; system.states()];
        for run in 0..node.runs() {
            if let Some(place) = system.place_of_velocity(run) {
                let (mass, momentum) = node.mass_of(run);
                state[place] = momentum / mass;
            }
        }
        state
    }

    /// What is large for each state of a node where velocities are about `speed`: displacements in a unit
    /// of time, in local contacts in the time in which these are pressed together.
    fn scales(&self, node: usize, speed: f64) -> Vec<f64> {
        let [left, right] = self.line.nodes[node].impedance;
        let mut scales = vec![speed; self.systems[node].states()];
        for own in &self.contacts[node] {
            scales[own.state] *= own.contact.time(left + right, speed);
        }
        scales
    }
}

/// The systems of all nodes, with their contacts closed.
fn systems(
    scaled: &ScaledScene,
    numbers: &Numbers,
    line: &Line,
) -> Result<Vec<System<f64>>, ModelError> {
    let mut systems = Vec::new();
    for node in &scaled.layout.nodes {
        let node = node.map(|value| numbers.number(value, BITS))?;
        let system = System::of(&node, |_| true, BITS).map_err(|Unresisted| {
            let near = node.elements.first().map(|own| line.name(own.element));
            let near = near.unwrap_or_else(|| "an end".to_owned());
            ModelError::Refused { model: NAME, reason: NotRepresented::Unresisted(near) }
        })?;
        systems.push(system.map(double_of));
    }
    Ok(systems)
}

/// All functions of time of a line, as far as they are known.
struct Motion<'a> {
    steps: &'a Steps,
    period: f64,
    states: Vec<Vec<f64>>,
    /// What is large for each state of each node.
    scales: Vec<Vec<f64>>,
    /// Of each bar the waves that leave its left end to the right, and its right end to the left.
    waves: Vec<[Track; 2]>,
    /// Of each node the velocities of its runs, and the displacements in its state.
    velocities: Vec<Vec<Track>>,
    displacements: Vec<Vec<Track>>,
    /// Of each node its equations, by how often a period is halved; none where they have no solution.
    collocations: Vec<BTreeMap<u32, Option<Collocation<'a>>>>,
    /// About the largest velocity, which tells what a small error is.
    speed: f64,
}

struct Solved {
    start: f64,
    length: f64,
    /// The series of velocities of runs, displacements, and what leaves to the left and to the right.
    rows: Vec<Values>,
    last: Vec<f64>,
}

impl Motion<'_> {
    fn step(&mut self, number: i64) -> Result<(), ModelError> {
        let mut all = Vec::new();
        for node in 0..self.states.len() {
            all.push(self.solve(node, number)?);
        }
        self.waves.iter_mut().flatten().for_each(Track::begin);
        self.velocities.iter_mut().flatten().for_each(Track::begin);
        self.displacements.iter_mut().flatten().for_each(Track::begin);
        for (node, pieces) in all.into_iter().enumerate() {
            for Solved { start, length, rows, last } in pieces {
                let mut rows = rows.into_iter();
                let own = self.velocities[node].iter_mut().chain(&mut self.displacements[node]);
                for track in own {
                    track.push(start, length, rows.next().expect("a row for each"));
                }
                let ends = &self.steps.line.nodes[node];
                for (side, way) in [(ends.left, 1), (ends.right, 0)] {
                    let row = rows.next().expect("a row for each");
                    if let Side::Bar(bar) = side {
                        self.waves[bar][way].push(start, length, row);
                    }
                }
                self.states[node] = last;
            }
        }
        Ok(())
    }

    /// One period at one node, halved until the series of each piece has converged.
    fn solve(&mut self, node: usize, number: i64) -> Result<Vec<Solved>, ModelError> {
        let mut solved: Vec<Solved> = Vec::new();
        let mut state = self.states[node].clone();
        let (mut start, mut halvings) = (0_u64, 0_u32);
        // `start` counts pieces of the present length.
        loop {
            let length = self.period / f64::from(halvings).exp2();
            let (system, contacts) = (&self.steps.systems[node], &self.steps.contacts[node]);
            let known = self.collocations[node].entry(halvings);
            known.or_insert_with(|| Collocation::of(system, contacts, length));
            let Some(piece) = self.piece(node, number, (start, halvings), &state) else {
                if halvings >= MAX_HALVINGS {
                    return Err(ModelError::NotSmooth { model: NAME, period: number });
                }
                (start, halvings) = (2 * start, halvings + 1);
                continue;
            };
            state.clone_from(&piece.last);
            solved.push(piece);
            start += 1;
            while halvings > 0 && start % 2 == 0 {
                (start, halvings) = (start / 2, halvings - 1);
            }
            if halvings == 0 && start == 1 {
                return Ok(solved);
            }
        }
    }

    /// A piece of a period, the n-th of so many halvings; `None` where it is too long.
    fn piece(
        &self,
        node: usize,
        number: i64,
        (place, halvings): (u64, u32),
        from: &[f64],
    ) -> Option<Solved> {
        let system = &self.steps.systems[node];
        let length = self.period / f64::from(halvings).exp2();
        let start = place as f64 * length;
        let mut input = self.input(node, number, points().map(|share| start + length * share));
        let accuracy = (self.steps.tolerance * MARGIN).max(1e-13);
        let collocation = self.collocations[node][&halvings].as_ref()?;
        let states = collocation.solve(from, &mut input, &self.scales[node], accuracy)?;
        let known: Vec<&Values> = states.iter().chain(&input).collect();
        let velocity = |row: &Vec<f64>| -> Values {
            std::array::from_fn(|j| row.iter().zip(&known).map(|(c, own)| c * own[j]).sum())
        };
        let mut rows: Vec<Values> =
            system.output.iter().take(system.group.len()).map(velocity).collect();
        let leaving =
            [0, rows.len() - 1].into_iter().zip(&input).map(|(run, arriving)| -> Values {
                std::array::from_fn(|j| rows[run][j] - arriving[j])
            });
        let leaving: Vec<Values> = leaving.collect();
        rows.extend_from_slice(&states[system.heavy.len()..]);
        rows.extend(leaving);
        let last = states.iter().map(|state| state[POINTS - 1]).collect();
        let rows = self.resolved(node, &rows)?;
        Some(Solved { start, length, rows, last })
    }

    /// What acts on a node at these times since a period began: the waves that arrive, loads, and no forces
    /// of local contacts yet.
    fn input(&self, node: usize, number: i64, times: Values) -> Vec<Values> {
        let steps = self.steps;
        let node = &steps.line.nodes[node];
        let arriving = [node.left, node.right].into_iter().enumerate().map(|(way, side)| {
            let Side::Bar(bar) = side else { return [0.0; POINTS] };
            // From the left arrives what runs to the right. From an endless bar comes what was there
            // before.
            let delay = steps.delays[bar];
            let number = if delay == 0 { -1 } else { number - delay };
            times.map(|since| self.waves[bar][way].within(number, since))
        });
        let driven = node.elements.iter().filter(|own| own.law.is_driven()).map(|own| {
            let acts = |[from, until]: &[i64; 2]| *from <= number && number < *until;
            match steps.acting.get(&own.element).is_some_and(acts) {
                true => {
                    let course = &steps.line.loads[&own.element].course;
                    times.map(|since| course.value(number as f64 * self.period + since))
                }
                false => [0.0; POINTS],
            }
        });
        arriving.chain(driven).collect()
    }

    /// The series through these values; `None` where their last coefficients are not below the tolerance.
    fn resolved(&self, node: usize, rows: &[Values]) -> Option<Vec<Values>> {
        let system = &self.steps.systems[node];
        let displacements = &self.scales[node][system.heavy.len()..];
        let series = |(number, row): (usize, &Values)| {
            let number = number.checked_sub(system.group.len());
            let scale = number.and_then(|number| displacements.get(number)).unwrap_or(&self.speed);
            let most = row.iter().fold(*scale, |most, value| most.max(value.abs()));
            let series = series(row);
            let small = |c: &f64| c.abs() <= self.steps.tolerance * most;
            series[DEGREE - 2..].iter().all(small).then_some(series)
        };
        rows.iter().enumerate().map(series).collect()
    }

    fn value(&self, reading: &Reading<f64>, time: f64) -> f64 {
        let line = &self.steps.line;
        let velocity = |face: Face| {
            let node = face.lump().node;
            &self.velocities[node][line.nodes[node].run_beside(face)]
        };
        match reading {
            Reading::InBar(field, section) => self.in_bar(*field, section, time),
            Reading::Momentum(bar) => {
                let Bar { impedance, travel, nodes, .. } = &line.bars[*bar];
                let sent = self.waves[*bar].iter().zip(nodes).filter(|(_, node)| node.is_some());
                let entered = |wave: &Track| match travel {
                    Some(travel) => wave.integral(time) - wave.integral(time - travel),
                    None => wave.integral(time),
                };
                impedance * sent.map(|(wave, _)| entered(wave)).sum::<f64>()
            }
            Reading::Velocity(face) => velocity(*face).value(time),
            Reading::Displacement(face) => velocity(*face).integral(time),
            Reading::Compression(lump) => self.compression(*lump, time),
            Reading::Force(lump) => {
                let compression = self.compression(*lump, time);
                let [left, right] = [Face::Left(*lump), Face::Right(*lump)];
                let law = &line.nodes[lump.node].elements[lump.place].law;
                if let Some(contact) = LocalContact::of(law) {
                    return contact.force_at(compression);
                }
                let Some([stiffness, damping]) = law.resistance() else {
                    unreachable!("the table of measures has no force of masses and loads")
                };
                let rate = match law.is_link() {
                    true => velocity(left).value(time) - velocity(right).value(time),
                    false => velocity(left).value(time),
                };
                stiffness * compression + damping * rate
            }
        }
    }

    /// The compression of a spring or a local contact, or the displacement of a support; zero where none is
    /// kept.
    fn compression(&self, lump: Lump, time: f64) -> f64 {
        let system = &self.steps.systems[lump.node];
        match system.kept[lump.place] {
            Some(state) => self.displacements[lump.node][state - system.heavy.len()].value(time),
            None => 0.0,
        }
    }

    fn in_bar(&self, field: Field, section: &Section<f64>, time: f64) -> f64 {
        let (bar, waves) = (&self.steps.line.bars[section.bar], &self.waves[section.bar]);
        let before = bar.before();
        let wave = |way: usize| match section.delays[way] {
            Some(late) => waves[way].value(time - late),
            None => before[way],
        };
        let moved = |way: usize| match section.delays[way] {
            Some(late) => waves[way].integral(time - late) - waves[way].integral(-late),
            None => before[way] * time,
        };
        match field {
            Field::Velocity => wave(0) + wave(1),
            Field::Force => bar.impedance * (wave(0) - wave(1)),
            Field::Displacement => moved(0) + moved(1),
        }
    }
}

impl Model for Steps {
    fn assumptions(&self) -> &'static str {
        "Nothing is left out but what the tolerance of the solver allows."
    }

    fn values(&self, observable: usize, times: &[f64]) -> Result<Vec<f64>, ModelError> {
        let observable = self.line.observable(NAME, observable)?;
        let times = self.line.scaled(times)?;
        let last = times.iter().copied().fold(0.0, f64::max);
        let motion = self.motion(last)?;
        let mut values = vec![0.0; times.len()];
        for (value, time) in values.iter_mut().zip(times) {
            for term in observable.terms().iter().filter(|_| time >= 0.0) {
                *value += term.coefficient * motion.value(&term.of, time);
            }
        }
        Ok(values)
    }
}
