//! The motion of a scene over a symbol, step by step, and what is observed of it.
//!
//! The function of a step is analytic, so it can be continued beyond the end of the step: the nodes obey the same
//! equations, and what arrives at them is the function of an earlier step, continued as far.

use super::on_step::OnStep;
use super::{NotOverSymbol, Outcome};
use crate::ball::{Arithmetic as _, Ball, Magnitude, Number};
use crate::history::passivity::{Block, Passivity, StateError};
use crate::limits::{MAX_STEPS_OVER_SYMBOL, MAX_SYMBOL_BITS as BITS};
use crate::network::{ElementLaw, Field, Lump, Node, Reading, Section, Side, System, dot};
use crate::signal::Varying;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use wavestep_polynomial::Rational;

/// Powers of time kept on a step; no rate of a node, a load or a mode exceeds two per step.
pub(super) const TERMS: usize = 20;

/// What an observable is made of.
pub(super) enum Summand {
    Now(Reading<usize>),
    /// Its integral since the start, in steps.
    SinceStart(Reading<usize>),
    /// The square of a sum with these factors.
    Square(Vec<Varying>, Vec<Summand>),
    /// What a bar holds: the integral of its waves, or of their squares.
    InBar {
        bar: usize,
        of: fn(&OnStep) -> OnStep,
    },
}

pub(super) struct Bar {
    /// The waves to the right and to the left before the start.
    pub(super) before: [OnStep; 2],
    /// How many steps they take; none where the bar is endless.
    pub(super) lag: Option<usize>,
    /// The nodes at its ends.
    pub(super) ends: [Option<usize>; 2],
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
pub(super) struct NodeState {
    values: Vec<Varying>,
    errors: Vec<StateError>,
}

impl NodeState {
    /// At the start springs are unloaded, and masses that collide move on with their common momentum.
    pub(super) fn at_start(
        node: &Node<Varying>,
        system: &System<Varying>,
        passivity: &Passivity,
    ) -> Outcome<NodeState> {
        let mut values = Vec::new();
        for group in &system.heavy {
            let runs = (0..node.runs()).filter(|run| system.group[*run] == *group);
            let (mut mass, mut momentum) = (Varying::zero(), Varying::zero());
            for own in runs.flat_map(|run| node.attached(run)) {
                if let ElementLaw::Mass { mass: own, velocity } = &own.law {
                    mass = mass.add(own, BITS);
                    momentum = momentum.add(&own.multiply(velocity, BITS), BITS);
                }
            }
            let inverse = mass.reciprocal(BITS)?;
            values.push(momentum.multiply(&inverse, BITS));
        }
        values.resize(system.states(), Varying::zero());
        let (values, off): (Vec<Varying>, Vec<Magnitude>) =
            values.iter().map(Varying::split).unzip();
        let off = off.iter().map(|off| Number::Enclosed(Ball::zero().widened(off)));
        Ok(NodeState { values, errors: passivity.errors(&off.collect::<Vec<_>>()) })
    }
}

/// A node, its state at the start, and its loads.
pub(super) struct SteppedNode {
    pub(super) node: Node<Varying>,
    pub(super) system: System<Varying>,
    pub(super) passivity: Passivity,
    pub(super) start: NodeState,
    pub(super) loads: Vec<Loading>,
}

/// A force or a velocity that is given on some steps.
pub(super) struct Loading {
    pub(super) acts: Range<usize>,
    /// The largest `|μ|` of its terms, per step.
    pub(super) rate: Magnitude,
    /// It on each step, as if it acted there.
    pub(super) course: Vec<OnStep>,
}

impl Loading {
    fn on(&self, at: Continued) -> OnStep {
        match self.acts.contains(&at.step) {
            true => self.course[at.step + at.by].clone(),
            false => OnStep::constant(&Varying::zero()),
        }
    }
}

/// The function of a step, continued so many steps beyond its own.
#[derive(Clone, Copy)]
struct Continued {
    step: usize,
    by: usize,
}

impl Continued {
    fn actual(step: usize) -> Continued {
        Continued { step, by: 0 }
    }
}

pub(super) struct Motion {
    bars: Vec<Bar>,
    nodes: Vec<SteppedNode>,
    /// What the nodes do, step by step.
    known: Vec<Vec<Solved>>,
    /// What they do as the function of a step is continued, one step beyond it, two, and so on.
    continued: BTreeMap<usize, Vec<Vec<Solved>>>,
}

impl Motion {
    /// All nodes for so many steps.
    pub(super) fn of(bars: Vec<Bar>, nodes: Vec<SteppedNode>, count: usize) -> Motion {
        let mut motion = Motion { bars, nodes, known: Vec::new(), continued: BTreeMap::new() };
        for step in 0..count {
            let solved = motion.solve(Continued::actual(step));
            motion.known.push(solved);
        }
        motion
    }

    /// A sum of these on all steps.
    pub(super) fn sum(&self, factors: &[Varying], summands: &[Summand]) -> Vec<OnStep> {
        let path: Vec<Continued> = (0..self.known.len()).map(Continued::actual).collect();
        self.sum_along(&path, factors, summands)
    }

    /// The same where the function of a step is continued to the end.
    pub(super) fn sum_after(
        &mut self,
        last: usize,
        factors: &[Varying],
        summands: &[Summand],
    ) -> Outcome<Vec<OnStep>> {
        let beyond = self.known.len() - (last + 1);
        let lags: BTreeSet<usize> = self.bars.iter().filter_map(|own| own.lag).collect();
        let mut delays = BTreeSet::from([0]);
        summands.iter().for_each(|own| self.add_delays(own, &mut delays));
        // The steps whose functions are needed, each after those from which its waves arrive.
        let mut needed: BTreeSet<usize> =
            delays.iter().filter_map(|delay| last.checked_sub(*delay)).collect();
        for step in (0..=last).rev() {
            if needed.contains(&step) {
                needed.extend(lags.iter().filter_map(|lag| step.checked_sub(*lag)));
            }
        }
        if needed.len().saturating_mul(beyond) > MAX_STEPS_OVER_SYMBOL {
            return Err(NotOverSymbol::TooManySteps);
        }
        self.continued.clear();
        for step in needed {
            for by in 1..=beyond {
                let solved = self.solve(Continued { step, by });
                self.continued.entry(step).or_default().push(solved);
            }
        }
        let before = (0..last).map(Continued::actual);
        let path = before.chain((0..=beyond).map(|by| Continued { step: last, by }));
        Ok(self.sum_along(&path.collect::<Vec<Continued>>(), factors, summands))
    }

    /// What the nodes do, from the end of the step before.
    fn solve(&self, at: Continued) -> Vec<Solved> {
        let before = match at.by.checked_sub(1) {
            Some(by) => Some(Continued { by, ..at }),
            None => at.step.checked_sub(1).map(Continued::actual),
        };
        let solve = |(number, place): (usize, &SteppedNode)| {
            let state = before.map_or(&place.start, |before| &self.solved(before)[number].end);
            let arriving = [(place.node.left, 0), (place.node.right, 1)];
            let arriving = arriving.map(|(side, direction)| match side {
                Side::Bar(bar) => self.entered((bar, direction), self.bars[bar].lag, at),
                _ => OnStep::constant(&Varying::zero()),
            });
            let loads = place.loads.iter().map(|own| own.on(at));
            place.solve(state, arriving.into_iter().chain(loads).collect())
        };
        self.nodes.iter().enumerate().map(solve).collect()
    }

    fn solved(&self, Continued { step, by }: Continued) -> &[Solved] {
        match by.checked_sub(1) {
            Some(more) => &self.continued[&step][more],
            None => &self.known[step],
        }
    }

    /// A wave that entered its bar so many steps before: before the first it was what it was at the start.
    fn entered(
        &self,
        (bar, direction): (usize, usize),
        delay: Option<usize>,
        at: Continued,
    ) -> OnStep {
        let own = &self.bars[bar];
        match (own.ends[direction], delay.and_then(|delay| at.step.checked_sub(delay))) {
            (Some(node), Some(step)) => {
                self.solved(Continued { step, ..at })[node].leaving[1 - direction].clone()
            }
            _ => own.before[direction].clone(),
        }
    }

    /// A sum of these on the steps of a path.
    fn sum_along(
        &self,
        path: &[Continued],
        factors: &[Varying],
        summands: &[Summand],
    ) -> Vec<OnStep> {
        let summands: Vec<Vec<OnStep>> =
            summands.iter().map(|own| self.summand(own, path)).collect();
        let sum = |now| OnStep::sum(factors, summands.iter().map(|own: &Vec<OnStep>| &own[now]));
        (0..path.len()).map(sum).collect()
    }

    fn summand(&self, of: &Summand, path: &[Continued]) -> Vec<OnStep> {
        match of {
            Summand::Now(reading) => path.iter().map(|at| self.reading(reading, *at)).collect(),
            Summand::SinceStart(rate) => {
                let start = OnStep::constant(&Varying::zero());
                integral(start, path.iter().map(|at| self.reading(rate, *at)))
            }
            Summand::Square(factors, of) => {
                self.sum_along(path, factors, of).iter().map(OnStep::square).collect()
            }
            Summand::InBar { bar, of } => self.stored(*bar, *of, path),
        }
    }

    /// The delays of the waves that are read.
    fn add_delays(&self, of: &Summand, delays: &mut BTreeSet<usize>) {
        match of {
            Summand::Now(reading) | Summand::SinceStart(reading) => {
                if let Reading::InBar(_, section) = reading {
                    delays.extend(section.delays.iter().flatten());
                }
            }
            Summand::Square(_, of) => of.iter().for_each(|own| self.add_delays(own, delays)),
            Summand::InBar { bar, .. } => delays.extend(self.bars[*bar].lag),
        }
    }

    /// What a bar holds: at the start what its waves bring in a travel time, then what enters less what arrives. An
    /// endless bar loses nothing; one that holds something at the start is refused when its scene is read.
    fn stored(&self, bar: usize, of: fn(&OnStep) -> OnStep, path: &[Continued]) -> Vec<OnStep> {
        let own = &self.bars[bar];
        let directions = (0..2).filter(|d| own.ends[*d].is_some() || own.lag.is_some());
        let directions: Vec<usize> = directions.collect();
        let sum_of = |factor: &Varying, wave: &dyn Fn(usize) -> OnStep| {
            let parts: Vec<OnStep> = directions.iter().map(|d| of(&wave(*d))).collect();
            OnStep::sum(&vec![factor.clone(); parts.len()], parts.iter())
        };
        let passing = |delay: Option<usize>, at: &Continued| {
            sum_of(&Varying::one(), &|direction| self.entered((bar, direction), delay, *at))
        };
        let rate = |at: &Continued| match own.lag {
            None => passing(Some(0), at),
            lag => passing(Some(0), at).less(&passing(lag, at)),
        };
        let lag = Varying::constant(&Rational::from_integer(own.lag.unwrap_or(0).into()), BITS);
        let start = sum_of(&lag, &|direction| own.before[direction].clone());
        integral(start, path.iter().map(rate))
    }

    /// What is read on a step, of a bar in units of its impedance.
    fn reading(&self, of: &Reading<usize>, at: Continued) -> OnStep {
        match of {
            Reading::Velocity(face) => {
                let node = face.lump().node;
                let run = self.nodes[node].node.run_beside(*face);
                self.solved(at)[node].velocities[run].clone()
            }
            Reading::Compression(Lump { node, place }) => {
                match self.nodes[*node].system.kept[*place] {
                    Some(kept) => self.solved(at)[*node].both[kept].clone(),
                    None => OnStep::constant(&Varying::zero()),
                }
            }
            Reading::InBar(field, Section { bar, delays: [right, left] }) => {
                let waves = [(0, right), (1, left)]
                    .map(|(side, delay)| self.entered((*bar, side), *delay, at));
                let left = match field {
                    Field::Force => Varying::one().negate(),
                    _ => Varying::one(),
                };
                OnStep::sum(&[Varying::one(), left], waves.iter())
            }
            _ => unreachable!("other readings are refused before"),
        }
    }
}

impl SteppedNode {
    /// The state as polynomials, from `k c_k = A c_{k−1} + B u_{k−1}`, and what is left of these equations in all, for each
    /// entry.
    fn polynomials(&self, start: &[Varying], acting: &[OnStep]) -> (Vec<OnStep>, Vec<Magnitude>) {
        let mut columns = vec![start.to_vec()];
        let mut left = vec![Magnitude::ZERO; start.len()];
        for k in 0..TERMS {
            let given = acting.iter().map(|own| own.coefficient(k));
            let both: Vec<Varying> = columns[k].iter().cloned().chain(given).collect();
            let change = &self.system.change;
            let next = change.iter().map(|row| dot(row, &both, BITS).over(k as u64 + 1, BITS));
            let (next, off): (Vec<Varying>, Vec<Magnitude>) = match k + 1 < TERMS {
                true => next.map(|own| own.split()).unzip(),
                false => next.map(|own| (Varying::zero(), own.magnitude())).unzip(),
            };
            left = left.iter().zip(&off).map(|(sum, own)| sum.add(own)).collect();
            columns.push(next);
        }
        columns.truncate(TERMS);
        let entry = |i: usize| OnStep {
            coefficients: columns.iter().map(|column| column[i].clone()).collect(),
            error: Magnitude::ZERO,
        };
        ((0..start.len()).map(entry).collect(), left)
    }

    /// What the node does on a step that begins with this state, where waves arrive from both sides and loads act.
    ///
    /// `P` solves `y' = A y + B u` up to a residual `ρ`, what is rounded and what the last term leaves. So the error
    /// `e = y − P` obeys `e' = A e + B e_u + ρ`: where it begins with `|e| ≤ ε`, it is `ε + ∫|ρ| + |B e_u| ∫|e^(Ax)|` at most,
    /// in the energy norm of a block, in which `|e^(Ax)| ≤ 1`.
    fn solve(&self, start: &NodeState, acting: Vec<OnStep>) -> Solved {
        let (system, blocks) = (&self.system, &self.passivity.blocks);
        debug_assert!(acting.iter().all(|own| own.coefficients.len() <= TERMS));
        let (mut own, left) = self.polynomials(&start.values, &acting);
        // ∫|ρ| + |B e_u| ∫|e^(Ax)| of each block.
        let arrived: Vec<Magnitude> = acting.iter().map(|own| own.error).collect();
        let step = Number::one();
        let drive = |own: &Block| own.push(&arrived).multiply(&own.memory(&step.magnitude()));
        let added = blocks.iter().map(|own| drive(own).add(&size_of(own, &left)));
        let added: Vec<Magnitude> = added.collect();
        let at_end = own.iter().map(|own| {
            own.coefficients.iter().fold(Varying::zero(), |sum, c| sum.add(c, BITS)).split()
        });
        let (values, rounded): (Vec<Varying>, Vec<Magnitude>) = at_end.unzip();
        let mut errors = Vec::with_capacity(blocks.len());
        for ((block, error), added) in blocks.iter().zip(&start.errors).zip(&added) {
            let most = error.size().add(added);
            for (place, member) in block.members.iter().enumerate() {
                own[*member].error = block.entry(place, &most);
            }
            let added = added.add(&size_of(block, &rounded));
            errors.push(error.clone().after(&step, &added, block));
        }
        let both: Vec<OnStep> = own.into_iter().chain(acting).collect();
        let runs = system.group.len();
        let velocities =
            system.output[..runs].iter().map(|row| OnStep::sum(row, both.iter())).collect();
        // What arrives is taken off the row, before rounding.
        let leaving = [(0, 0), (1, runs - 1)].map(|(side, run)| {
            let mut row = system.output[run].clone();
            let own = &mut row[system.states() + side];
            *own = own.subtract(&Varying::one(), BITS);
            OnStep::sum(&row, both.iter())
        });
        Solved { both, velocities, leaving, end: NodeState { values, errors } }
    }
}

/// The size of a block in a state with entries of these sizes.
fn size_of(block: &Block, sizes: &[Magnitude]) -> Magnitude {
    block.size(block.members.iter().map(|i| sizes[*i]))
}

/// The integral of a function from the start on, and what is there at the start.
fn integral(start: OnStep, rate: impl Iterator<Item = OnStep>) -> Vec<OnStep> {
    let mut before = start;
    let next = |rate: OnStep| {
        let own = OnStep::total([&before, &rate.antiderivative()].into_iter());
        before = own.at_end();
        own
    };
    rate.map(next).collect()
}
