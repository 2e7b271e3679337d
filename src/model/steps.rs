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
//!
//! Contacts open where their force would be negative, and close where their gap would: a piece ends at the root of
//! that series, and the node goes on with the law of the other contacts. What such an event sends out is not smooth
//! there, and comes back whole periods later, so pieces end at that place of all later periods.

use crate::enclosure::Numbers;
use crate::expression::{Fraction, Root};
use crate::limits::MAX_NODE_PERIODS;
use crate::model::Model;
use crate::model::collocation::Collocation;
use crate::model::course::double;
use crate::model::error::{BadSetting, ModelError, NotRepresented};
use crate::model::laws::{Law, Laws, NodeState};
use crate::model::line::{Bar, Line, LocalContact, Observable};
use crate::model::track::{DEGREE, POINTS, Track, Values, integral, points, series, sum};
use crate::network::{
    Contacts, Face, Field, Layout, Lump, ModelLoad, Reading, ScaledScene, Section, Side,
    common_measure,
};
use crate::scene::ElementIndex;
use num_traits::{Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;
use wavestep_polynomial::Rational;

pub(super) const NAME: &str = "method of steps";

/// How often a period is halved before its solution is given up.
const MAX_HALVINGS: u32 = 40;

/// How much finer than the tolerance the forces of local contacts are found.
const MARGIN: f64 = 1e-2;

/// The most changes of contacts of a node at one instant.
const MAX_CHANGES: usize = 16;

/// Places of a period where what arrives is not smooth.
const MAX_KINKS: usize = 2_000;

/// Equations that are kept of a node, by their contacts and lengths.
const MAX_COLLOCATIONS: usize = 4_096;

/// How many times a force or a gap is looked at on a piece.
const LOOKS: usize = 64;

/// Halvings of the interval in which one falls below zero.
const ROOT_HALVINGS: usize = 60;

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
    /// Of the nodes.
    laws: Vec<Laws>,
    tolerance: f64,
    /// By which share everything is changed at each change of a contact: zero, but to see what errors become.
    nudge: f64,
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
        common = common_measure(&common, &ratio);
    }
    let counts = ratios.iter().zip(times).map(|(ratio, (name, _))| {
        (ratio / &common).to_integer().to_i64().ok_or_else(|| refused(name))
    });
    Ok(Some((first.scale(&common), counts.collect::<Result<_, _>>()?)))
}

impl Steps {
    pub fn new(scaled: &ScaledScene, tolerance: f64) -> Result<Steps, ModelError> {
        if !(1e-13..=1e-2).contains(&tolerance) {
            let reason = BadSetting::Tolerance(tolerance);
            return Err(ModelError::Setting { model: NAME, reason });
        }
        let opening;
        let layout = match scaled.scene().contacts_open {
            true => {
                opening = Layout::of(scaled.scene(), scaled.model(), Contacts::Links);
                &opening
            }
            false => &scaled.layout,
        };
        let line = Line::laid_out(scaled, layout)?;
        let numbers = Numbers::new(&scaled.model().constants);
        let gaps = layout.contacts.iter().map(|own| double(&numbers, &own.gap));
        let gaps = gaps.collect::<Result<Vec<f64>, _>>()?;
        let laws = layout.nodes.iter().enumerate();
        let known = (&numbers, &gaps[..]);
        let laws = laws.map(|(place, node)| Laws::of(place, &line, node, known, line.speed()));
        let laws = laws.collect::<Result<_, _>>()?;
        let (mut times, mut loads) = (Vec::new(), Vec::new());
        let named = |what: &str, element: ElementIndex, time: &Option<Fraction>| {
            let name = format!("the {what} of {}", line.name(element));
            (name, time.clone().unwrap_or_else(Fraction::zero))
        };
        times.extend(line.bars.iter().map(|bar| {
            named("travel time", bar.element, &scaled.model().bars[&bar.element].travel)
        }));
        for element in &scaled.scene().line.elements {
            if let Some(ModelLoad { from, until, .. }) = scaled.model().loads.get(element) {
                times.extend([
                    named("beginning", *element, &Some(from.clone())),
                    named("end", *element, until),
                ]);
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
        Ok(Steps { line, laws, tolerance, nudge: 0.0, period, delays, acting })
    }

    /// The same model with instants and velocities changed by this share whenever a contact opens or closes: how far its
    /// values are from those without tells what becomes of errors of that size.
    #[must_use]
    pub fn nudged(self, nudge: f64) -> Steps {
        Steps { nudge, ..self }
    }

    /// The line at the start, for a motion until a time.
    fn motion(&self, last: f64) -> Result<Motion<'_>, ModelError> {
        // Without delays one period is as long as what is asked for.
        let period = self.period.unwrap_or(if last > 0.0 { last } else { 1.0 });
        let track = |before| Track::new(before, period);
        let tracks = |count: usize| vec![track(0.0); count];
        let (line, speed) = (&self.line, self.line.speed());
        let start = |(laws, node): (&Laws, _)| laws.start(node, speed);
        let states: Option<Vec<NodeState>> = self.laws.iter().zip(&line.nodes).map(start).collect();
        let states = states
            .ok_or(ModelError::Refused { model: NAME, reason: NotRepresented::RigidImpact })?;
        Ok(Motion {
            steps: self,
            period,
            states,
            waves: line.bars.iter().map(|bar| bar.before().map(track)).collect(),
            velocities: line.nodes.iter().map(|node| tracks(node.runs())).collect(),
            displacements: self.laws.iter().map(|laws| tracks(laws.springs.len())).collect(),
            collocations: self.laws.iter().map(|_| BTreeMap::new()).collect(),
            kinks: Vec::new(),
            speed,
        })
    }

    /// How many periods it takes to a time.
    fn periods(&self, motion: &Motion<'_>, last: f64) -> Result<i64, ModelError> {
        let periods = (last / motion.period * (1.0 + 1e-11)).floor() + 1.0;
        let count = periods * self.laws.len() as f64;
        ModelError::limited(NAME, "periods of nodes", count, MAX_NODE_PERIODS)?;
        Ok(periods as i64)
    }
}

/// All functions of time of a line, as far as they are known and still needed.
struct Motion<'a> {
    steps: &'a Steps,
    period: f64,
    states: Vec<NodeState>,
    /// Of each bar the waves that leave its left end to the right, and its right end to the left.
    waves: Vec<[Track; 2]>,
    /// Of each node the velocities of its runs, and the displacements of its springs.
    velocities: Vec<Vec<Track>>,
    displacements: Vec<Vec<Track>>,
    /// Of each node its equations, by its closed contacts and the length of a piece; none where they have no solution.
    collocations: Vec<BTreeMap<(usize, u64), Option<Collocation<'a>>>>,
    /// Times since the beginning of a period at which a contact changed, in order: what arrives is not smooth there.
    kinks: Vec<f64>,
    /// About the largest velocity, which tells what a small error is.
    speed: f64,
}

struct Solved {
    start: f64,
    length: f64,
    /// The series of velocities of runs, displacements of springs, and what leaves to the left and to the right.
    rows: Vec<Values>,
    /// The series of the force of each contact that opens, or of its gap.
    guards: Vec<Vec<f64>>,
    last: NodeState,
}

/// A node on its way through a period.
struct Passage {
    node: usize,
    number: i64,
    state: NodeState,
    solved: Vec<Solved>,
    kinks: Vec<f64>,
}

impl<'a> Motion<'a> {
    fn step(&mut self, number: i64) -> Result<(), ModelError> {
        let mut all = Vec::new();
        for node in 0..self.states.len() {
            all.push(self.pass(node, number)?);
        }
        self.waves.iter_mut().flatten().for_each(Track::begin);
        self.velocities.iter_mut().flatten().for_each(Track::begin);
        self.displacements.iter_mut().flatten().for_each(Track::begin);
        let known = self.kinks.len();
        for Passage { node, state, solved, kinks, .. } in all {
            for Solved { start, length, rows, .. } in solved {
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
            }
            self.states[node] = state;
            self.kinks.extend(kinks);
        }
        if self.kinks.len() > known {
            self.kinks.sort_by(f64::total_cmp);
            self.kinks.dedup();
            ModelError::limited(
                NAME,
                "kinks in a period",
                self.kinks.len() as f64,
                MAX_KINKS as f64,
            )?;
        }
        Ok(())
    }

    /// How many periods back an observable is seen, and waves arrive.
    fn reach(&self, observable: &Observable) -> i64 {
        let late = observable.terms().iter().flat_map(|term| match &term.of {
            Reading::InBar(_, section) => section.delays,
            _ => [None; 2],
        });
        let late = late.flatten().fold(0.0, f64::max) / self.period;
        let delays = self.steps.delays.iter().copied();
        delays.fold(late.ceil() as i64, i64::max) + 1
    }

    /// Lets go of all periods before one.
    fn forget(&mut self, before: i64) {
        let Ok(before) = usize::try_from(before) else { return };
        self.waves.iter_mut().flatten().for_each(|track| track.forget(before));
        self.velocities.iter_mut().flatten().for_each(|track| track.forget(before));
        self.displacements.iter_mut().flatten().for_each(|track| track.forget(before));
    }

    /// One period at one node, from kink to kink.
    fn pass(&mut self, node: usize, number: i64) -> Result<Passage, ModelError> {
        let state = self.states[node].clone();
        let (solved, kinks) = (Vec::new(), Vec::new());
        let mut passage = Passage { node, number, state, solved, kinks };
        let ends: Vec<f64> = self.kinks.iter().copied().chain([self.period]).collect();
        let mut from = 0.0;
        for to in ends {
            self.cover(&mut passage, [from, to], 0)?;
            from = to;
        }
        Ok(passage)
    }

    /// A part of a period, halved until the series of each piece has converged, and cut where a contact changes.
    fn cover(
        &mut self,
        passage: &mut Passage,
        [from, to]: [f64; 2],
        halvings: u32,
    ) -> Result<(), ModelError> {
        let mut from = from;
        let mut changes = 0;
        while from < to {
            self.prepare(passage, to - from);
            let Some(piece) = self.piece(passage, [from, to]) else {
                return self.halve(passage, [from, to], halvings);
            };
            let Some((contact, share)) = self.first_change(&piece) else {
                passage.state = piece.last.clone();
                passage.solved.push(piece);
                return Ok(());
            };
            let end = from + share * piece.length * (1.0 - self.steps.nudge);
            if end > from {
                changes = 0;
                self.prepare(passage, end - from);
                let Some(piece) = self.piece(passage, [from, end]) else {
                    return self.halve(passage, [from, to], halvings);
                };
                passage.state = piece.last.clone();
                passage.solved.push(piece);
                passage.kinks.push(end);
                from = end;
            }
            changes += 1;
            if changes > MAX_CHANGES {
                return Err(ModelError::NotSmooth { model: NAME, period: passage.number });
            }
            let (laws, own) =
                (&self.steps.laws[passage.node], &self.steps.line.nodes[passage.node]);
            let changed = laws.changed(own, &passage.state, contact, self.speed);
            let mut changed = changed
                .ok_or(ModelError::Refused { model: NAME, reason: NotRepresented::RigidImpact })?;
            changed.state.iter_mut().for_each(|own| *own *= 1.0 + self.steps.nudge);
            passage.state = changed;
        }
        Ok(())
    }

    fn halve(
        &mut self,
        passage: &mut Passage,
        [from, to]: [f64; 2],
        halvings: u32,
    ) -> Result<(), ModelError> {
        if halvings >= MAX_HALVINGS {
            return Err(ModelError::NotSmooth { model: NAME, period: passage.number });
        }
        let middle = from + (to - from) / 2.0;
        self.cover(passage, [from, middle], halvings + 1)?;
        self.cover(passage, [middle, to], halvings + 1)
    }

    fn law(&self, node: usize, closed: usize) -> Option<&'a Law> {
        self.steps.laws[node].law(closed)
    }

    /// Makes the equations of a node on a piece of a length.
    fn prepare(&mut self, passage: &Passage, length: f64) {
        let (node, closed) = (passage.node, passage.state.closed);
        let law = self.law(node, closed);
        let known = &mut self.collocations[node];
        if known.len() > MAX_COLLOCATIONS {
            known.clear();
        }
        known.entry((closed, length.to_bits())).or_insert_with(|| {
            law.and_then(|law| Collocation::of(&law.system, &law.pressing, length))
        });
    }

    /// A piece of a period; `None` where it is too long.
    fn piece(&self, passage: &Passage, [start, end]: [f64; 2]) -> Option<Solved> {
        let length = end - start;
        let (node, from) = (passage.node, &passage.state);
        let law = self.law(node, from.closed)?;
        let system = &law.system;
        let mut times = points().map(|share| start + length * share);
        times[POINTS - 1] = end;
        let mut input = self.input(node, passage.number, times);
        let accuracy = (self.steps.tolerance * MARGIN).max(1e-13);
        let collocation = self.collocations[node][&(from.closed, length.to_bits())].as_ref()?;
        let states = collocation.solve(&from.state, &mut input, &law.scales, accuracy)?;
        let known: Vec<&Values> = states.iter().chain(&input).collect();
        let output = |row: &Vec<f64>| -> Values {
            std::array::from_fn(|j| row.iter().zip(&known).map(|(c, own)| c * own[j]).sum())
        };
        let runs = system.group.len();
        let mut rows: Vec<Values> = system.output.iter().take(runs).map(output).collect();
        let leaving = [0, runs - 1].into_iter().zip(&input).map(|(run, arriving)| -> Values {
            std::array::from_fn(|j| rows[run][j] - arriving[j])
        });
        let leaving: Vec<Values> = leaving.collect();
        let laws = &self.steps.laws[node];
        let displacement =
            |place: &usize| system.kept[*place].map_or([0.0; POINTS], |kept| states[kept]);
        rows.extend(laws.springs.iter().map(displacement));
        rows.extend(leaving);
        let rows = self.resolved(node, law, &rows)?;
        let mut forces = system.output[runs..].iter();
        let mut guards = Vec::with_capacity(laws.contacts.len());
        let mut gaps = from.gaps.clone();
        for (contact, run) in laws.contacts.iter().enumerate() {
            guards.push(match from.closed >> contact & 1 == 1 {
                true => series(&output(forces.next().expect("a force for each closed contact")))
                    .to_vec(),
                false => {
                    let apart: Values = std::array::from_fn(|k| rows[run + 1][k] - rows[*run][k]);
                    let mut gap = integral(&apart).map(|c| c * length).to_vec();
                    gap[0] += gaps[contact];
                    gaps[contact] = sum(&gap, 1.0);
                    gap
                }
            });
        }
        let state = states.iter().map(|state| state[POINTS - 1]).collect();
        let last = NodeState { closed: from.closed, state, gaps };
        Some(Solved { start, length, rows, guards, last })
    }

    /// Which contact changes first on a piece, and at which share of it: the force of a closed one, or the gap of an
    /// open one, falls below zero.
    fn first_change(&self, piece: &Solved) -> Option<(usize, f64)> {
        let floor = self.steps.tolerance * self.speed;
        // The share, and how far below zero what is so at once: what pulls most is let go first.
        let mut first: Option<(usize, (f64, f64))> = None;
        for (contact, guard) in piece.guards.iter().enumerate() {
            let most = guard.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
            let floor = -floor.min(most);
            if let Some(share) = falls_below(guard, floor) {
                let own = (share, if share > 0.0 { 0.0 } else { sum(guard, -1.0) });
                if first.is_none_or(|(_, earliest)| own < earliest) {
                    first = Some((contact, own));
                }
            }
        }
        first.map(|(contact, (share, _))| (contact, share))
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
            self.waves[bar][way].on(number, &times)
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
    fn resolved(&self, node: usize, law: &Law, rows: &[Values]) -> Option<Vec<Values>> {
        let springs = &self.steps.laws[node].springs;
        let series = |(number, row): (usize, &Values)| {
            let number = number.checked_sub(law.system.group.len());
            let place = number.and_then(|number| law.system.kept[*springs.get(number)?]);
            let scale = place.map_or(&self.speed, |state| &law.scales[state]);
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
        let springs = &self.steps.laws[lump.node].springs;
        let known = springs.iter().position(|place| *place == lump.place);
        known.map_or(0.0, |spring| self.displacements[lump.node][spring].value(time))
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
        let mut motion = self.motion(last)?;
        let mut order: Vec<usize> = (0..times.len()).filter(|i| times[*i] >= 0.0).collect();
        order.sort_by(|i, j| times[*j].total_cmp(&times[*i]));
        let mut values = vec![0.0; times.len()];
        let (periods, reach) = (self.periods(&motion, last)?, motion.reach(observable));
        for number in 0..periods {
            motion.step(number)?;
            // A time within a rounding of the next period belongs to that.
            let end = (number + 1) as f64 * (1.0 - 1e-11);
            let is_last = number + 1 == periods;
            while let Some(next) = order.pop_if(|i| is_last || times[*i] / motion.period < end) {
                for term in observable.terms() {
                    values[next] += term.coefficient * motion.value(&term.of, times[next]);
                }
            }
            motion.forget(number - reach);
        }
        Ok(values)
    }
}

/// At which share of a piece a series falls below a floor, and from zero on.
fn falls_below(guard: &[f64], floor: f64) -> Option<f64> {
    let value = |share: f64| sum(guard, 2.0 * share - 1.0);
    let share = |look: usize| look as f64 / LOOKS as f64;
    let below = (0..=LOOKS).find(|look| value(share(*look)) < floor)?;
    let Some(above) = below.checked_sub(1) else { return Some(0.0) };
    let [mut above, mut below] = [share(above), share(below)];
    if value(above) <= 0.0 {
        return Some(above);
    }
    for _ in 0..ROOT_HALVINGS {
        let middle = above.midpoint(below);
        if value(middle) > 0.0 { above = middle } else { below = middle }
    }
    Some(above)
}
