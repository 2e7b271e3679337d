//! The method of steps: waves in bars as delayed functions, nodes as ordinary differential equations.
//!
//! Time is cut into periods of the common measure of all travel times. On one period all that arrives
//! at a node left another one earlier and is known; the equations of the node are then ordinary ones,
//! which an adaptive method of Dormand and Prince of order 8 solves. What arrives is an input, and what
//! leaves follows from the velocity of the node, so that no delayed derivative occurs, as it does where
//! one writes these problems as neutral equations.
//!
//! Error law (measured, not proven): the largest error over some ten round trips is below ten times the
//! tolerance times the largest value, for tolerances down to 1e-10. Jumps lie on the borders of periods
//! and are exact.
//!
//! It is the one model that takes local contacts, whose force is a power of their compression. Where that
//! power is not smooth, at the first touch and where a contact opens or closes, pieces are halved until
//! their series have converged. Measured for two endless bars: within the tolerance of the closed form, of
//! the largest force, down to 1e-11; within 1e-12 at 1e-13.

use crate::expression::{Fraction, Root};
use crate::limits::MAX_NODE_PERIODS;
use crate::model::Model;
use crate::model::error::{BadSetting, ModelError, NotRepresented, SolverFailure};
use crate::model::junction::{Acting, Junction};
use crate::model::line::{Bar, Law, Line};
use crate::model::track::{DEGREE, Track, points, series};
use crate::network::{Face, Field, Lump, ModelLump, Reading, ScaledScene, Section, Side};
use crate::scene::Drive;
use num_integer::Integer as _;
use num_traits::{Signed, ToPrimitive, Zero};
use ode_solvers::dop_shared::IntegrationError;
use ode_solvers::{DVector, Dop853, OutputType, System};
use wavestep_polynomial::Rational;

const NAME: &str = "method of steps";

/// How often a period is halved before its solution is given up.
const MAX_HALVINGS: u32 = 40;

/// How much finer than the tolerance the solver works.
const MARGIN: f64 = 1e-2;

/// The most steps of the solver between two points.
const MAX_STEPS: u32 = 100_000;

/// Delayed waves, with an adaptive solver at the nodes.
///
/// Cost: for each period and node at least some 300 evaluations of the laws of the node.
///
/// # Invariants
/// All travel times, and the times at which loads begin and end, are whole numbers of periods.
///
/// ```
/// use wavestep::language::{Source, read_scene};
/// use wavestep::model::{Model, Steps};
/// use wavestep::network::Network;
///
/// let text = r#"
///     scene "A mass strikes a bar"
///     mass hammer { mass = 1, velocity = 1 }
///     bar rod { impedance = 1, travel = 1/2 }
///     line free - hammer - rod - fixed
///     observe strain = strain(rod.right)
/// "#;
/// let scene = read_scene(&Source::new("steps.wave", text)?, &Default::default()).unwrap();
/// let model = Steps::new(&Network::new(&scene).unwrap(), 1e-10).unwrap();
/// // -2 f_1(t - mu) with f_1 = exp(-s) (1 - 2s + exp(-2 mu)) and s = t - mu - 2 mu.
/// let s = 0.25;
/// let exact = -2.0 * f64::exp(-s) * (1.0 - 2.0 * s + f64::exp(-1.0));
/// assert!((model.values(0, &[1.75]).unwrap()[0] - exact).abs() < 1e-10);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug)]
pub struct Steps {
    line: Line,
    junctions: Vec<Junction>,
    tolerance: f64,
    /// The common measure; `None` where nothing is delayed.
    period: Option<f64>,
    /// The travel times in periods.
    delays: Vec<i64>,
    /// Of the loads of each node, from which period until which they act.
    acting: Vec<Vec<[i64; 2]>>,
}

/// The common measure of times, and how often each holds it.
///
/// # Errors
/// [`NotRepresented::NoCommonMeasure`] of the time that has none with those before.
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
    /// The method of steps with a relative tolerance.
    ///
    /// # Errors
    /// [`ModelError::Setting`] where the tolerance is not in `[1e-13, 1e-2]`;
    /// [`ModelError::Refused`] where travel times, and times of loads, have no common measure, and
    /// where something without mass moves against nothing; [`ModelError::MissingValue`] for symbols
    /// without values.
    pub fn new(scene: &impl AsRef<ScaledScene>, tolerance: f64) -> Result<Steps, ModelError> {
        let scaled = scene.as_ref();
        if !(1e-13..=1e-2).contains(&tolerance) {
            let reason = BadSetting::Tolerance(tolerance);
            return Err(ModelError::Setting { model: NAME, reason });
        }
        let line = Line::of(scaled)?;
        let speed = line.speed();
        let junctions = line.nodes.iter().map(|node| Junction::of(NAME, node, &line.bars, speed));
        let junctions = junctions.collect::<Result<Vec<_>, _>>()?;
        let mut times = Vec::new();
        let scene = scaled.scene();
        let named = |element: usize| scene.elements[element].name.clone();
        let bars = scene.line.elements.iter().filter_map(|element| {
            let travel = scaled.model().bars.get(element)?.travel.clone();
            Some((named(*element), travel.unwrap_or_else(Fraction::zero)))
        });
        times.extend(bars);
        for element in &scene.line.elements {
            if let Some(ModelLump::Load(_, _, from, until)) = scaled.model().lumps.get(element) {
                times.push((named(*element), from.clone()));
                times.push((named(*element), until.clone().unwrap_or_else(Fraction::zero)));
            }
        }
        let refuse = |reason| ModelError::Refused { model: NAME, reason };
        let grid = measure(&times).map_err(refuse)?;
        let counts = grid.as_ref().map_or(vec![0; times.len()], |(_, counts)| counts.clone());
        let mut moments = counts[line.bars.len()..].chunks(2);
        let acting = line.nodes.iter().map(|node| {
            let loads = node.lumps.iter().filter_map(|lump| match lump.law {
                Law::Load { until, .. } => Some(until),
                _ => None,
            });
            let moment = |until: f64| {
                let moment = moments.next().expect("two moments a load");
                [moment[0], if until.is_finite() { moment[1] } else { i64::MAX }]
            };
            loads.map(moment).collect()
        });
        let acting = acting.collect();
        let period = match &grid {
            Some((period, _)) => {
                let numbers = crate::enclosure::Numbers::new(&scaled.model().constants);
                Some(crate::model::course::double(&numbers, period)?)
            }
            None => None,
        };
        let delays = counts[..line.bars.len()].to_vec();
        Ok(Steps { line, junctions, tolerance, period, delays, acting })
    }

    /// The motion until a time.
    fn motion(&self, last: f64) -> Result<Motion<'_>, ModelError> {
        // Without delays one period is as long as what is asked for.
        let period = self.period.unwrap_or(if last > 0.0 { last } else { 1.0 });
        let periods = (last / period * (1.0 + 1e-11)).floor() + 1.0;
        let count = periods * self.junctions.len() as f64;
        if count > MAX_NODE_PERIODS {
            let limit = MAX_NODE_PERIODS;
            return Err(ModelError::TooMuch {
                model: NAME,
                what: "periods of nodes",
                count,
                limit,
            });
        }
        let track = |before| Track::new(before, period);
        let mut motion = Motion {
            steps: self,
            period,
            states: self.junctions.iter().map(Junction::start).collect(),
            waves: self.line.bars.iter().map(|bar| bar.before().map(track)).collect(),
            velocities: (self.junctions.iter())
                .map(|junction| vec![track(0.0); junction.runs()])
                .collect(),
            yields: (self.junctions.iter())
                .map(|junction| vec![track(0.0); junction.yields()])
                .collect(),
            scale: self.line.speed(),
        };
        for number in 0..periods as i64 {
            motion.step(number)?;
        }
        Ok(motion)
    }
}

/// All functions of time of a line, as far as they are known.
struct Motion<'a> {
    steps: &'a Steps,
    period: f64,
    states: Vec<Vec<f64>>,
    /// Of each bar the waves that leave its left end to the right, and its right end to the left.
    waves: Vec<[Track; 2]>,
    /// Of each node the velocities of its runs, and the displacements of springs and supports.
    velocities: Vec<Vec<Track>>,
    yields: Vec<Vec<Track>>,
    /// The largest velocity so far, which tells what a small error is.
    scale: f64,
}

/// The equations of one node on one period.
struct Problem<'a> {
    motion: &'a Motion<'a>,
    node: usize,
    number: i64,
}

impl Problem<'_> {
    /// What acts on the node, some time after the period began.
    fn acting(&self, since: f64) -> Acting {
        let steps = self.motion.steps;
        let node = &steps.line.nodes[self.node];
        let mut acting = Acting {
            arriving: [0.0; 2],
            forces: vec![0.0; node.runs],
            imposed: vec![0.0; node.runs],
        };
        for (i, side) in [node.left, node.right].into_iter().enumerate() {
            if let Side::Bar(bar) = side {
                // From the left arrives what runs to the right. From an endless bar comes what was
                // there before.
                let delay = steps.delays[bar];
                let number = if delay == 0 { -1 } else { self.number - delay };
                acting.arriving[i] = self.motion.waves[bar][i].within(number, since);
            }
        }
        let loads = node.lumps.iter().filter_map(|lump| match &lump.law {
            Law::Load { drive, course, .. } => Some((lump.run, drive, course)),
            _ => None,
        });
        for ((run, drive, course), [from, until]) in loads.zip(&steps.acting[self.node]) {
            if *from <= self.number && self.number < *until {
                let value = course.value(self.number as f64 * self.motion.period + since);
                match drive {
                    Drive::Force => acting.forces[run] += value,
                    Drive::Velocity => acting.imposed[run] = value,
                }
            }
        }
        acting
    }
}

/// Time is the last state, with slope 1: version 0.6.2 of the solver evaluates the last stage of a step
/// at the beginning of the step instead of its end, which is wrong for inputs that vary in time. To
/// equations without time it makes no difference.
impl System<f64, DVector<f64>> for &Problem<'_> {
    fn system(&self, _: f64, state: &DVector<f64>, slope: &mut DVector<f64>) {
        let junction = &self.motion.steps.junctions[self.node];
        let [state @ .., since] = state.as_slice() else { unreachable!("time is a state") };
        let [slope @ .., one] = slope.as_mut_slice() else { unreachable!("time is a state") };
        junction.slope(state, &self.acting(*since), slope);
        *one = 1.0;
    }
}

/// The values of one function at the points of a piece.
type Values = [f64; DEGREE + 1];

/// The state of a node at the points of a piece.
struct Solved {
    start: f64,
    length: f64,
    /// Velocities of runs, displacements, and what leaves to the left and to the right.
    rows: Vec<Values>,
    /// The state at the end.
    last: Vec<f64>,
}

impl Motion<'_> {
    /// Solves one period at all nodes.
    fn step(&mut self, number: i64) -> Result<(), ModelError> {
        let mut all = Vec::new();
        for node in 0..self.states.len() {
            all.push(self.solve(node, number)?);
        }
        self.waves.iter_mut().flatten().for_each(Track::begin);
        self.velocities.iter_mut().flatten().for_each(Track::begin);
        self.yields.iter_mut().flatten().for_each(Track::begin);
        for (node, pieces) in all.into_iter().enumerate() {
            for Solved { start, length, rows, last } in pieces {
                let mut rows = rows.iter().map(series);
                for track in self.velocities[node].iter_mut().chain(&mut self.yields[node]) {
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
    fn solve(&self, node: usize, number: i64) -> Result<Vec<Solved>, ModelError> {
        let mut solved: Vec<Solved> = Vec::new();
        let mut state = self.states[node].clone();
        let (mut start, mut halvings) = (0_u64, 0_u32);
        // `start` counts pieces of the present length.
        loop {
            let length = self.period / f64::from(halvings).exp2();
            let piece = self.piece(node, number, start as f64 * length, length, &state)?;
            if !self.is_resolved(node, &piece.rows) {
                if halvings >= MAX_HALVINGS {
                    let reason = SolverFailure::NotSmooth(number);
                    return Err(ModelError::Solver { model: NAME, reason });
                }
                (start, halvings) = (2 * start, halvings + 1);
                continue;
            }
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

    /// Whether the last coefficients are below the tolerance.
    fn is_resolved(&self, node: usize, rows: &[Values]) -> bool {
        let junction = &self.steps.junctions[node];
        let (runs, yields) = (junction.runs(), junction.yields());
        rows.iter().enumerate().all(|(number, row)| {
            let own = match number.checked_sub(runs) {
                Some(number) if number < yields => self.scale * junction.time(number),
                _ => self.scale,
            };
            let most = row.iter().fold(own, |most, value| most.max(value.abs()));
            let small = |c: &f64| c.abs() <= self.steps.tolerance * most;
            series(row)[DEGREE - 2..].iter().all(small)
        })
    }

    fn piece(
        &self,
        node: usize,
        number: i64,
        start: f64,
        length: f64,
        from: &[f64],
    ) -> Result<Solved, ModelError> {
        let junction = &self.steps.junctions[node];
        let problem = Problem { motion: self, node, number };
        let mut state = from.to_vec();
        let count = junction.runs() + junction.yields() + 2;
        let mut rows = vec![[0.0; DEGREE + 1]; count];
        let mut before = start;
        for (j, share) in points().into_iter().enumerate() {
            let now = start + length * share;
            if now > before && !state.is_empty() {
                state = self.advance(&problem, before, now, state)?;
            }
            before = now;
            let acting = problem.acting(now);
            let velocities = junction.velocities(&state, &acting);
            let displaced =
                (0..junction.yields()).map(|number| junction.displacement(&state, number));
            let left = velocities[0] - acting.arriving[0];
            let right = velocities[velocities.len() - 1] - acting.arriving[1];
            let values = velocities.iter().copied().chain(displaced).chain([left, right]);
            for (row, value) in rows.iter_mut().zip(values) {
                row[j] = value;
            }
        }
        Ok(Solved { start, length, rows, last: state })
    }

    /// The state a little later, by the solver.
    fn advance(
        &self,
        problem: &Problem<'_>,
        from: f64,
        to: f64,
        mut state: Vec<f64>,
    ) -> Result<Vec<f64>, ModelError> {
        let relative = (self.steps.tolerance * MARGIN).max(1e-14);
        let absolute = relative * self.scale;
        let length = to - from;
        state.push(from);
        let state = DVector::from_vec(state);
        let mut solver = Dop853::from_param(
            problem,
            from,
            to,
            length,
            state,
            relative,
            absolute,
            0.9,
            0.0,
            0.333,
            6.0,
            length,
            length,
            MAX_STEPS,
            1000,
            OutputType::Sparse,
        );
        if let Err(error) = solver.integrate() {
            let reason = match error {
                IntegrationError::MaxNumStepReached { x, n_step } => {
                    SolverFailure::TooManySteps { at: x, limit: n_step }
                }
                IntegrationError::StepSizeUnderflow { x } => SolverFailure::StepTooShort(x),
                IntegrationError::StiffnessDetected { x } => SolverFailure::Stiff(x),
            };
            return Err(ModelError::Solver { model: NAME, reason });
        }
        let last = solver.y_out().last().expect("the last point");
        Ok(last.as_slice()[..last.len() - 1].to_vec())
    }

    /// The value of a reading at a time.
    fn value(&self, reading: &Reading<f64>, time: f64) -> f64 {
        let line = &self.steps.line;
        let velocity = |face: Face| &self.velocities[face.lump().node][line.run(face)];
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
                match &line.nodes[lump.node].lumps[lump.place].law {
                    Law::Hertz(contact) => contact.force_at(compression),
                    Law::Spring { stiffness, damping } => {
                        let closing = velocity(left).value(time) - velocity(right).value(time);
                        stiffness * compression + damping * closing
                    }
                    Law::Support { stiffness, damping } => {
                        stiffness * compression + damping * velocity(left).value(time)
                    }
                    Law::Mass { .. } | Law::Load { .. } => {
                        unreachable!("the table of measures has no force of masses and loads")
                    }
                }
            }
        }
    }

    /// The compression of a spring or a local contact, or the displacement of a support.
    fn compression(&self, lump: Lump, time: f64) -> f64 {
        let lumps = &self.steps.line.nodes[lump.node].lumps;
        let number = lumps[..lump.place].iter().filter(|lump| lump.law.yields()).count();
        self.yields[lump.node][number].value(time)
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
    fn name(&self) -> &'static str {
        NAME
    }

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
