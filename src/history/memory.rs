//! What following takes: cells and memory, foreseen, and what is forgotten because nobody will ask for it.

use crate::ball::Number;
use crate::expression::Fraction;
use crate::history::cells::Cells;
use crate::history::engine::{Engine, Reach, State, TOLD_APART};
use crate::history::error::{HistoryError, Outcome, When};
use crate::history::moment::Moment;
use crate::history::part::Source;
use crate::history::series::LONGEST_CELL;
use crate::history::track::{Arriving, Track};
use crate::limits::{MAX_HISTORY_CELLS, memory};
use crate::network::{Network, Observed, Reading, Side};
use std::cell::RefCell;
use wavestep_polynomial::Rational;

/// Memory and cells are foreseen once this share of the limit is used.
const TELLING: f64 = 1.0 / 16.0;

/// What short cells take is known to this factor at best.
const MUCH_MORE: usize = 4;

/// What is asked for of a motion that is followed.
pub struct Asked {
    /// Nothing before this time of the scene, but for waves that entered a bar a travel time before, or one of these
    /// delays.
    from: Fraction,
    delays: Vec<Fraction>,
    /// Whether integrals of waves since the start are.
    is_integrated: bool,
    /// Nothing but these readings, and these waves as they enter bars, to the right (0) or to the left (1); without them all.
    seen: Option<(Vec<Reading>, Vec<[usize; 2]>)>,
    /// From when on nothing meets again, once that is known.
    pub parted: RefCell<Option<Moment>>,
}

impl Asked {
    /// For observables from a time of the user's on; without any list of them, for all of it.
    pub fn of(network: &Network, observed: Option<&[&Observed]>, from: &Rational) -> Asked {
        let all = || observed.into_iter().flatten();
        let readings = || all().flat_map(|own| own.all_readings());
        let entering = || all().flat_map(|own| own.entering());
        Asked {
            from: network.scaled_time(from),
            delays: readings().flat_map(Reading::delays).cloned().collect(),
            is_integrated: observed.is_none() || readings().any(Reading::is_integral),
            seen: observed.map(|_| (readings().cloned().collect(), entering().collect())),
            parted: RefCell::default(),
        }
    }
}

impl Engine {
    /// From now on forgets what is not asked for.
    ///
    /// # Errors
    /// [`HistoryError::MissingValue`] for a symbol without a value.
    pub fn ask_for(&mut self, network: &Network, asked: &Asked) -> Outcome<()> {
        let Asked { from, delays, is_integrated, seen, .. } = asked;
        let about = |time: &Fraction| self.clock.about(&Moment::at(time.clone()));
        let back = delays.iter().map(about).fold(self.longest_travel(), f64::max);
        self.asked_from = about(from) * (1.0 - TOLD_APART) - back;
        if !is_integrated {
            self.waves.iter_mut().flatten().for_each(Track::forget_integral);
        }
        if let Some((readings, entering)) = seen {
            let wave = |[bar, direction]: &[usize; 2]| Source::Wave {
                bar: *bar,
                direction: *direction,
                delay: None,
            };
            let mut sources: Vec<Source> = entering.iter().map(wave).collect();
            for reading in readings {
                let parts = self.reading(self.elements(network), reading, &Number::one())?;
                sources.extend(parts.into_iter().map(|part| part.source));
            }
            self.asked_sources = Some(sources);
        }
        Ok(())
    }

    /// The time before which nothing of a node or a wave is needed.
    fn needed_from(&self, is_read: impl Fn(&Source) -> bool) -> f64 {
        match &self.asked_sources {
            Some(sources) if !sources.iter().any(is_read) => self.watched_from,
            _ => self.asked_from.min(self.watched_from),
        }
    }

    /// From now on forgets all before an instant less the longest travel time, but for waves that leave for ever: an
    /// endless bar holds their energy.
    pub fn forget_before(&mut self, moment: &Moment) {
        self.asked_from = self.clock.about(moment) * (1.0 - TOLD_APART) - self.longest_travel();
        self.keeps_departed = true;
        for ((_, travel), waves) in self.bars.iter().zip(&mut self.waves) {
            if travel.is_some() {
                waves.iter_mut().for_each(Track::forget_integral);
            }
        }
    }

    /// The longest travel time, for choices that need no proof.
    pub fn longest_travel(&self) -> f64 {
        let travels = self.bars.iter().filter_map(|(_, travel)| travel.clone());
        travels.map(|travel| self.clock.about(&Moment::at(travel))).fold(0.0, f64::max)
    }

    /// Forgets cells of a node, of what arrives there, and of what leaves it for ever.
    pub fn forget(&mut self, node: usize) {
        let about = self.states[node].about;
        let has_passed = |end: &Moment, from: f64| about < from || self.clock.about(end) < from;
        let from = self.needed_from(|source| source.is_at(node));
        if from > 0.0 {
            while let Some(cell) = self.cells[node].forget(|end| has_passed(end, from)) {
                self.bytes -= cell.bytes();
            }
        }
        let own = &self.nodes[node];
        for (side, arriving) in self.states[node].arriving.iter().enumerate() {
            let (bar, direction, number) = match (arriving, [own.left, own.right][side]) {
                (Arriving::Delayed { bar, direction, cell, .. }, _) => (*bar, *direction, *cell),
                (_, Side::Bar(bar)) if !self.keeps_departed => (bar, 1 - side, usize::MAX),
                _ => continue,
            };
            let from = self.needed_from(|source| source.is_wave(bar, direction));
            if from > 0.0 {
                let track = &mut self.waves[bar][direction];
                self.bytes -= track.forget(number, |end| has_passed(end, from), &self.cut);
            }
        }
    }

    /// How many cells of nodes and of waves are kept.
    pub fn kept(&self) -> usize {
        let waves = self.waves.iter().flatten().map(|track| track.cells.kept());
        self.cells.iter().map(Cells::kept).chain(waves).sum()
    }

    /// How long a time is kept of what was followed until a time.
    fn kept_until(&self, time: f64) -> f64 {
        time.min((time - self.asked_from).max(self.longest_travel()))
    }

    /// Refuses at once what takes too many cells of these nodes: a node is at most a travel time ahead of its neighbours, so
    /// that none of its cells is longer than two of these.
    pub fn foresee_cells(&self, until: &Moment, is_counted: impl Fn(usize) -> bool) -> Outcome<()> {
        let mut cells = self.count as f64;
        let counted = |(node, state): &(usize, &State)| is_counted(*node) && !state.is_gone;
        for (_, state) in self.states.iter().enumerate().filter(counted) {
            let left = self.clock.since(&state.now, until)?;
            let mut most = 0.0_f64;
            for arriving in &state.arriving {
                let Arriving::Delayed { travel, .. } = arriving else { continue };
                let rate = self.clock.number(travel)?.reciprocal(self.cut.bits)?;
                let passages = left.multiply(&rate, self.cut.bits).ball(64).to_double().0;
                most = most.max(passages / 2.0);
            }
            cells += most;
        }
        match (cells > MAX_HISTORY_CELLS as f64, self.behind()) {
            (true, Some((node, _))) => Err(self.too_many_cells(node)?),
            _ => Ok(()),
        }
    }

    /// Refuses what will take too many cells because a fast motion goes on for long, a light mass that rings on a spring:
    /// as many as it takes to die out, or to come to the end.
    pub fn foresee_short_cells(&self, node: usize, reach: &Reach) -> Outcome<()> {
        let state = &self.states[node];
        // What presses evenly is held constant over long cells, as soon as it does.
        if state.passivity.blocks.iter().any(|block| !block.pressed.is_empty()) {
            return Ok(());
        }
        let rate = state.passivity.rate().scale(-LONGEST_CELL).to_double();
        let enough = (MUCH_MORE * MAX_HISTORY_CELLS) as f64;
        if (self.whole - state.about) * rate <= enough {
            return Ok(());
        }
        let cell = (&reach.norm, &self.cut);
        let gone = state.system.cells_until_gone(state.known(), &reach.inputs, cell);
        match gone.is_some_and(|cells| cells <= enough) {
            true => Ok(()),
            false => Err(self.too_many_cells(node)?),
        }
    }

    /// Refuses a window that will take far too many cells, once there are many: without a common measure of travel times ever more
    /// echoes arrive. `looked` has shares of the window with the number of cells until then; that is assumed to grow on by the power of
    /// time that it had for some while.
    pub fn foresee_growth(&self, node: usize, looked: &[(f64, usize)]) -> Outcome<()> {
        let most = MAX_HISTORY_CELLS as f64;
        let until = |share: f64| {
            let (share, count) = looked.iter().rev().find(|(own, _)| *own <= share)?;
            (*share > 0.0).then_some((*share, *count as f64))
        };
        let Some(now) = until(1.0).filter(|(_, count)| *count > most * TELLING) else {
            return Ok(());
        };
        let (Some(half), Some(quarter)) = (until(now.0 / 2.0), until(now.0 / 4.0)) else {
            return Ok(());
        };
        let power = |(early, few): (f64, f64), (late, many): (f64, f64)| {
            (many / few).ln() / (late / early).ln()
        };
        // What only begins late, and dies out, has none before.
        let power = power(half, now).min(power(quarter, half));
        match now.1 * now.0.recip().powf(power) > MUCH_MORE as f64 * most {
            true => Err(self.too_many_cells(node)?),
            false => Ok(()),
        }
    }

    /// Refuses what will take too much memory, once some of it is taken. What a time takes is assumed to grow in
    /// proportion to when it is: cells hold more and more, and there may be more of them.
    pub fn foresee_memory(&self, node: usize, until: &Moment) -> Outcome<()> {
        let (taken, most) = (self.bytes as f64, memory() as f64);
        let (now, end) = (self.states[node].about, self.clock.about(until));
        let grown = (end / now) * (self.kept_until(end) / self.kept_until(now));
        match taken > most * TELLING && taken * grown > most {
            true => Err(self.too_much_memory(node)?),
            false => Ok(()),
        }
    }

    /// How far a node was followed, as it is told.
    fn reached(&self, node: usize) -> Outcome<When> {
        Ok(self.clock.told(&self.clock.time(&self.states[node].now)?))
    }

    pub fn too_much_memory(&self, node: usize) -> Outcome<HistoryError> {
        let (megabytes, when) = (memory() / 1_000_000, self.reached(node)?);
        Ok(HistoryError::TooMuchMemory { megabytes, when })
    }

    pub fn too_many_cells(&self, node: usize) -> Outcome<HistoryError> {
        Ok(HistoryError::TooManyCells { limit: MAX_HISTORY_CELLS, when: self.reached(node)? })
    }
}
