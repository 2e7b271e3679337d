//! The motion of a scene over a symbol, cell by cell, and what is observed of it.
//!
//! The function of a cell is analytic, so it can be continued beyond the end of the cell: the nodes obey the same
//! equations, and what arrives at them is the function of an earlier cell, continued as far.

use super::grid::Grid;
use super::node::{Solved, SteppedNode, Stop, after};
use super::on_cell::OnCell;
use super::{NotOverSymbol, Outcome};
use crate::ball::{Arithmetic as _, Magnitude};
use crate::limits::{MAX_STEPS_OVER_SYMBOL, MAX_SYMBOL_BITS as BITS};
use crate::network::{Field, Lump, Reading, Section, Side};
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
        of: fn(&OnCell) -> OnCell,
    },
}

pub(super) struct Bar {
    /// The waves to the right and to the left before the start.
    pub(super) before: [OnCell; 2],
    /// How many cells they take; none where the bar is endless.
    pub(super) lag: Option<usize>,
    /// The nodes at its ends.
    pub(super) ends: [Option<usize>; 2],
}

/// A force or a velocity that is given on some cells.
pub(super) struct Loading {
    pub(super) acts: Range<usize>,
    /// The largest `|μ|` of its terms, per step.
    pub(super) rate: Magnitude,
    /// It on each cell, as if it acted there.
    pub(super) course: Vec<OnCell>,
}

impl Loading {
    fn on(&self, at: Continued) -> OnCell {
        match self.acts.contains(&at.cell) {
            true => self.course[at.cell + at.by].clone(),
            false => OnCell::zero(),
        }
    }
}

/// The function of a cell, continued so many cells beyond its own.
#[derive(Clone, Copy)]
struct Continued {
    cell: usize,
    by: usize,
}

impl Continued {
    fn actual(cell: usize) -> Continued {
        Continued { cell, by: 0 }
    }
}

pub(super) struct Motion {
    grid: Grid,
    bars: Vec<Bar>,
    nodes: Vec<SteppedNode>,
    /// What the nodes do, cell by cell.
    known: Vec<Vec<Solved>>,
    /// What they do as the function of a cell is continued, one cell beyond it, two, and so on.
    continued: BTreeMap<usize, Vec<Vec<Solved>>>,
}

impl Motion {
    /// All nodes for so many cells, or where they stop.
    pub(super) fn of(
        grid: &Grid,
        bars: Vec<Bar>,
        nodes: Vec<SteppedNode>,
        count: usize,
    ) -> Result<Motion, (usize, Stop)> {
        let (grid, known) = (grid.clone(), Vec::new());
        let mut motion = Motion { grid, bars, nodes, known, continued: BTreeMap::new() };
        for cell in 0..count {
            let solved = motion.solve(Continued::actual(cell)).map_err(|stop| (cell, stop))?;
            motion.known.push(solved);
        }
        Ok(motion)
    }

    /// A sum of these on all cells.
    pub(super) fn sum(&self, factors: &[Varying], summands: &[Summand]) -> Vec<OnCell> {
        let path: Vec<Continued> = (0..self.known.len()).map(Continued::actual).collect();
        self.sum_along(&path, factors, summands)
    }

    /// The same where the function of a cell is continued to the end.
    pub(super) fn sum_after(
        &mut self,
        last: usize,
        factors: &[Varying],
        summands: &[Summand],
    ) -> Outcome<Vec<OnCell>> {
        let beyond = self.known.len() - (last + 1);
        let lags: BTreeSet<usize> = self.bars.iter().filter_map(|own| own.lag).collect();
        let mut delays = BTreeSet::from([0]);
        summands.iter().for_each(|own| self.add_delays(own, &mut delays));
        // The cells whose functions are needed, each after those from which its waves arrive.
        let mut needed: BTreeSet<usize> =
            delays.iter().filter_map(|delay| last.checked_sub(*delay)).collect();
        for cell in (0..=last).rev() {
            if needed.contains(&cell) {
                needed.extend(lags.iter().filter_map(|lag| cell.checked_sub(*lag)));
            }
        }
        if needed.len().saturating_mul(beyond) > MAX_STEPS_OVER_SYMBOL {
            return Err(NotOverSymbol::TooManySteps);
        }
        self.continued.clear();
        for cell in needed {
            for by in 1..=beyond {
                let solved = self.solve(Continued { cell, by });
                let solved = solved.map_err(|_| NotOverSymbol::Undecided)?;
                self.continued.entry(cell).or_default().push(solved);
            }
        }
        let before = (0..last).map(Continued::actual);
        let path = before.chain((0..=beyond).map(|by| Continued { cell: last, by }));
        Ok(self.sum_along(&path.collect::<Vec<Continued>>(), factors, summands))
    }

    /// What the nodes do, from the end of the cell before.
    fn solve(&self, at: Continued) -> Result<Vec<Solved>, Stop> {
        let before = match at.by.checked_sub(1) {
            Some(by) => Some(Continued { by, ..at }),
            None => at.cell.checked_sub(1).map(Continued::actual),
        };
        let solve = |(number, place): (usize, &SteppedNode)| {
            let state = before.map_or(&place.start, |before| &self.solved(before)[number].end);
            let arriving = [(place.node.left, 0), (place.node.right, 1)];
            let arriving = arriving.map(|(side, direction)| match side {
                Side::Bar(bar) => self.entered((bar, direction), self.bars[bar].lag, at),
                _ => OnCell::zero(),
            });
            let loads = place.loads.iter().map(|own| own.on(at));
            let acting = arriving.into_iter().chain(loads).collect();
            place.solve((at.cell, self.grid.length(at.cell)), state, acting)
        };
        self.nodes.iter().enumerate().map(solve).collect()
    }

    fn solved(&self, Continued { cell, by }: Continued) -> &[Solved] {
        match by.checked_sub(1) {
            Some(more) => &self.continued[&cell][more],
            None => &self.known[cell],
        }
    }

    /// A wave that entered its bar so many cells before: before the first it was what it was at the start.
    fn entered(
        &self,
        (bar, direction): (usize, usize),
        delay: Option<usize>,
        at: Continued,
    ) -> OnCell {
        let own = &self.bars[bar];
        match (own.ends[direction], delay.and_then(|delay| at.cell.checked_sub(delay))) {
            (Some(node), Some(cell)) => {
                self.solved(Continued { cell, ..at })[node].leaving[1 - direction].clone()
            }
            _ => own.before[direction].clone(),
        }
    }

    /// A sum of these on the cells of a path.
    fn sum_along(
        &self,
        path: &[Continued],
        factors: &[Varying],
        summands: &[Summand],
    ) -> Vec<OnCell> {
        let summands: Vec<Vec<OnCell>> =
            summands.iter().map(|own| self.summand(own, path)).collect();
        let sum = |now| OnCell::sum(factors, summands.iter().map(|own: &Vec<OnCell>| &own[now]));
        (0..path.len()).map(sum).collect()
    }

    fn summand(&self, of: &Summand, path: &[Continued]) -> Vec<OnCell> {
        match of {
            Summand::Now(reading) => path.iter().map(|at| self.reading(reading, *at)).collect(),
            Summand::SinceStart(rate) => {
                let rates = path.iter().map(|at| self.reading(rate, *at));
                self.integral(OnCell::zero(), path, rates)
            }
            Summand::Square(factors, of) => {
                self.sum_along(path, factors, of).iter().map(OnCell::square).collect()
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
    fn stored(&self, bar: usize, of: fn(&OnCell) -> OnCell, path: &[Continued]) -> Vec<OnCell> {
        let own = &self.bars[bar];
        let directions = (0..2).filter(|d| own.ends[*d].is_some() || own.lag.is_some());
        let directions: Vec<usize> = directions.collect();
        let sum_of = |factor: &Varying, wave: &dyn Fn(usize) -> OnCell| {
            let parts: Vec<OnCell> = directions.iter().map(|d| of(&wave(*d))).collect();
            OnCell::sum(&vec![factor.clone(); parts.len()], parts.iter())
        };
        let passing = |delay: Option<usize>, at: &Continued| {
            sum_of(&Varying::one(), &|direction| self.entered((bar, direction), delay, *at))
        };
        let rate = |at: &Continued| match own.lag {
            None => passing(Some(0), at),
            lag => passing(Some(0), at).less(&passing(lag, at)),
        };
        let travel = Rational::new(own.lag.unwrap_or(0).into(), self.grid.cells().into());
        let travel = Varying::constant(&travel, BITS);
        let start = sum_of(&travel, &|direction| own.before[direction].clone());
        self.integral(start, path, path.iter().map(rate))
    }

    /// The integral of a function from the start on, in steps, and what is there at the start.
    fn integral(
        &self,
        start: OnCell,
        path: &[Continued],
        rates: impl Iterator<Item = OnCell>,
    ) -> Vec<OnCell> {
        let mut before = start;
        let next = |(at, rate): (&Continued, OnCell)| {
            let own = after(&before, &rate, self.grid.length(at.cell));
            before = own.at_end();
            own
        };
        path.iter().zip(rates).map(next).collect()
    }

    /// What is read on a cell, of a bar in units of its impedance.
    fn reading(&self, of: &Reading<usize>, at: Continued) -> OnCell {
        match of {
            Reading::Velocity(face) => {
                let node = face.lump().node;
                let run = self.nodes[node].node.run_beside(*face);
                self.solved(at)[node].velocities[run].clone()
            }
            Reading::Compression(Lump { node, place }) => {
                let solved = &self.solved(at)[*node];
                match self.nodes[*node].ways[solved.way].system.kept[*place] {
                    Some(kept) => solved.both[kept].clone(),
                    None => OnCell::zero(),
                }
            }
            Reading::InBar(field, Section { bar, delays: [right, left] }) => {
                let waves = [(0, right), (1, left)]
                    .map(|(side, delay)| self.entered((*bar, side), *delay, at));
                let left = match field {
                    Field::Force => Varying::one().negate(),
                    _ => Varying::one(),
                };
                OnCell::sum(&[Varying::one(), left], waves.iter())
            }
            _ => unreachable!("other readings are refused before"),
        }
    }
}
