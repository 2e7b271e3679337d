//! What leaves a node: waves into its bars, on as few cells as they need.
//!
//! A node begins a cell whenever something new arrives at any of its sides. Where its sides have nothing to do with
//! each other, at an open contact, a wave that comes back goes on through such a beginning unchanged. Told apart for
//! ever, the cells of one side would be cut at those of the other on each passage, and ever more of them would travel.
//! So what goes on joins the cell that it goes on from, unless the node at the other end has passed that already.

use crate::ball::Number;
use crate::history::engine::{Engine, Planned};
use crate::history::error::Outcome;
use crate::history::moment::Moment;
use crate::history::motion::combined;
use crate::history::passive::Passage;
use crate::history::series::{CellNorm, Series};
use crate::history::track::Track;
use crate::network::Side;
use std::cmp::Ordering;

/// Cells are short below this part of the longest, as a power of two: to work a series out for longer than it lasts
/// costs as much as some cells do.
const SHORT: i64 = 4;

/// What the last cell of a leaving wave is made of, where that is nothing but what arrives.
pub(crate) struct Passing {
    /// Until when its series holds.
    until: Moment,
    /// Of what arrives at the left and at the right.
    factors: [Number; 2],
    /// The cells that arrive, where their factors are not zero.
    cells: [Option<usize>; 2],
}

impl Passing {
    fn is_same(&self, later: &Passing) -> bool {
        self.factors == later.factors && self.cells == later.cells
    }
}

/// How a leaving wave follows on its last cell.
pub(crate) enum Next {
    /// With a cell of its own, of a series that holds at least for so long as the passage tells.
    Cell(Series, Passage),
    /// With such a cell in place of the last one, from the same start.
    Joined(Series, Passage),
    /// The series of the last cell holds on.
    Longer,
}

/// A wave that leaves into a bar.
pub(crate) struct Leaving {
    bar: usize,
    /// 0 to the right, 1 to the left.
    direction: usize,
    side: usize,
    pub next: Next,
    /// From the start of its last cell to the end.
    length: Number,
    passing: Option<Passing>,
}

impl Engine {
    /// What leaves a node on a cell.
    pub fn leaving(
        &self,
        node: usize,
        planned: &Planned,
        norm: &CellNorm,
    ) -> Outcome<Vec<Leaving>> {
        let own = &self.nodes[node];
        let mut leaving = Vec::with_capacity(2);
        for (side, run) in own.side_runs().into_iter().enumerate() {
            let bar = if side == 0 { own.left } else { own.right };
            if let Side::Bar(bar) = bar {
                leaving.push(self.leaving_at(node, (bar, side, run), (planned, norm))?);
            }
        }
        Ok(leaving)
    }

    fn leaving_at(
        &self,
        node: usize,
        (bar, side, run): (usize, usize, usize),
        (planned, norm): (&Planned, &CellNorm),
    ) -> Outcome<Leaving> {
        let (cut, direction) = (&self.cut, 1 - side);
        let row = self.states[node].system.leaving_row((side, run), cut.bits);
        let passing = self.passing(node, &row, &planned.end)?;
        let track = &self.waves[bar][direction];
        let leaving =
            |next, length, passing| Leaving { bar, direction, side, next, length, passing };
        let so_far = |next, passing| {
            Ok(leaving(next, self.clock.since(&track.last().0, &planned.end)?, passing))
        };
        let is_used = self.is_used(bar, direction);
        if let (Some(new), false) = (&passing, is_used)
            && let Some((next, until)) = self.joined(node, (bar, side), new, planned)?
        {
            return so_far(next, passing.map(|own| Passing { until, ..own }));
        }
        let parts = planned.motion.state.iter().chain(&planned.inputs);
        let wave = combined(&row, parts, cut.bits).settled(norm, cut);
        if !is_used && self.continues(track, &wave)? {
            return so_far(Next::Longer, None);
        }
        let next = Next::Cell(wave, Passage::of(&self.bars[bar].0, &planned.length));
        let passing = passing.map(|own| Passing { until: planned.end.clone(), ..own });
        Ok(leaving(next, planned.length.clone(), passing))
    }

    /// Whether a wave is the same polynomial as the last cell before it, where both are known exactly.
    fn continues(&self, track: &Track, wave: &Series) -> Outcome<bool> {
        let (start, last) = track.last();
        if !wave.is_exact() || !last.series().is_exact() {
            return Ok(false);
        }
        let length = self.clock.since(start, &track.end)?;
        let is_same = last.series().shift(&length, &self.cut).coefficients == wave.coefficients;
        Ok(is_same && length.exact().is_some())
    }

    /// How a wave that is nothing but what arrives joins its last cell, and until when the series of that holds then:
    /// it goes on while it holds; after that another takes its place, for as long as what arrives stays the same, if
    /// both cells are short.
    fn joined(
        &self,
        node: usize,
        (bar, side): (usize, usize),
        new: &Passing,
        planned: &Planned,
    ) -> Outcome<Option<(Next, Moment)>> {
        let (cut, track) = (&self.cut, &self.waves[bar][1 - side]);
        let old = self.states[node].passing[side].as_ref().filter(|old| old.is_same(new));
        let Some(old) = old else { return Ok(None) };
        if self.clock.compare(&planned.end, &old.until)? != Ordering::Greater {
            return Ok(Some((Next::Longer, old.until.clone())));
        }
        let (start, last) = track.last();
        let is_long = |length: &Number| length.magnitude().scale(SHORT) > cut.longest;
        if is_long(last.length()) || is_long(&planned.length) {
            return Ok(None);
        }
        let reach = self.clock.since(start, &new.until)?;
        let arriving = self.states[node].arriving.iter();
        let parts = arriving.map(|own| own.series(&self.waves, start, &self.clock, cut));
        let parts = parts.collect::<Result<Vec<_>, _>>()?;
        let norm = CellNorm::of_series(parts.iter(), &reach, cut);
        let wave = combined(&old.factors, parts.iter(), cut.bits).settled(&norm, cut);
        let passage = Passage::of(&self.bars[bar].0, &reach);
        Ok(Some((Next::Joined(wave, passage), new.until.clone())))
    }

    /// What leaves by a row of the system, until what arrives changes; none where the motion of the node itself or its
    /// loads are part of it. What never changes is told to the end of the cell.
    fn passing(&self, node: usize, row: &[Number], end: &Moment) -> Outcome<Option<Passing>> {
        let state = &self.states[node];
        let (own, given) = row.split_at(state.system.states());
        let (arriving, lumps) = given.split_at(2);
        if !own.iter().chain(lumps).all(Number::is_zero) {
            return Ok(None);
        }
        let (mut cells, mut until) = ([None; 2], None::<Moment>);
        for (side, own) in state.arriving.iter().enumerate() {
            let Some(end) = own.end(&self.waves).filter(|_| !arriving[side].is_zero()) else {
                continue;
            };
            cells[side] = own.cell();
            until = Some(match until {
                Some(until) => self.clock.earlier(until, end)?,
                None => end,
            });
        }
        let factors = [0, 1].map(|side: usize| arriving[side].clone());
        Ok(Some(Passing { until: until.unwrap_or_else(|| end.clone()), factors, cells }))
    }

    /// Whether the node at the other end has passed the last cell of a wave, or that is the one before the start.
    fn is_used(&self, bar: usize, direction: usize) -> bool {
        let last = self.waves[bar][direction].cells.count() - 1;
        let receiver = self.layout.ends[bar][1 - direction];
        let next = receiver.and_then(|node| self.states[node].arriving[direction].cell());
        last == 0 || next.is_some_and(|next| next > last)
    }

    /// Counts what is new of leaving waves: how loud they are, and their fresh errors.
    pub fn count_leaving(&mut self, leaving: &[Leaving]) {
        for own in leaving {
            let (Next::Cell(wave, passage) | Next::Joined(wave, passage)) = &own.next else {
                continue;
            };
            let length = &passage.length;
            self.loudest = self.loudest.max(wave.coefficient(0).magnitude());
            self.steepest = self.steepest.max(wave.size_from(0, length));
            if let Some(errors) = &mut self.errors {
                errors.add_wave(&wave.fresh_on(length, self.cut.bits), passage);
            }
        }
    }

    /// Takes over what leaves, its error no larger than all errors so far allow.
    pub fn send(&mut self, node: usize, leaving: Vec<Leaving>, end: &Moment) {
        for Leaving { bar, direction, side, next, length, passing } in leaving {
            let settled = |wave: Series, passage: &Passage| match &self.errors {
                Some(errors) => errors.settle(wave, passage, &self.cut),
                None => wave,
            };
            let track = &mut self.waves[bar][direction];
            match next {
                Next::Cell(wave, passage) => {
                    let wave = settled(wave, &passage);
                    self.bytes += wave.bytes();
                    track.push(wave, end.clone(), length);
                }
                Next::Joined(wave, passage) => {
                    let wave = settled(wave, &passage);
                    self.bytes += wave.bytes();
                    self.bytes -= track.lengthen(Some(wave), end.clone(), length);
                }
                Next::Longer => {
                    track.lengthen(None, end.clone(), length);
                }
            }
            self.states[node].passing[side] = passing;
        }
    }
}
