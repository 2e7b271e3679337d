//! The contacts that open and close, as far as they are known, and the cuts that they make.

use super::grid::Grid;
use super::node::{Begins, Closed, OpenContact, Stop, Way};
use super::opening::{Opened, ends};
use super::{NotOverSymbol, Outcome};
use crate::history::passivity::Passivity;
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::network::{Node, System};
use crate::signal::Varying;
use num_traits::{One as _, Signed as _};
use wavestep_polynomial::Rational;

/// A contact that opens no longer than this before the end of a cell, as a power of two of its length, does at that end.
const NEAR: u32 = 20;

/// A contact that opens beyond the end of a step does so no more than one part of a cell over this number beyond it.
const MOST_BEYOND: i64 = 64;

/// What a contact becomes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Now {
    Open,
    Closed,
}

/// A contact that opens or closes at the beginning of a cell, which is so far into a step.
#[derive(Clone, Debug)]
pub struct Change {
    contact: usize,
    now: Now,
    step: usize,
    at: Varying,
}

/// A grid, and the changes at the beginnings of its cells.
pub(super) struct Plan {
    pub(super) grid: Grid,
    pub(super) changes: Vec<Change>,
}

impl Plan {
    /// Where contacts close.
    pub(super) fn closings(&self) -> Vec<Change> {
        self.changes.iter().filter(|own| own.now == Now::Closed).cloned().collect()
    }

    /// What is followed next, after a node has stopped on a cell.
    ///
    /// # Errors
    /// [`NotOverSymbol`] where that is refused, or not decided.
    pub(super) fn after(mut self, cell: usize, stop: Stop) -> Outcome<Plan> {
        let step = cell / self.grid.cells();
        match stop {
            Stop::Refused(why) => return Err(why),
            Stop::Opens { place: None, .. } if cell == 0 => {
                return Err(NotOverSymbol::BesideContact);
            }
            Stop::Opens { contact, place: None } => self.opens_with(contact, cell),
            Stop::Opens { contact, place: Some(place) } => self.opens(contact, cell, &place)?,
            Stop::AboutEnd => {
                self.grid = self.grid.coarser(cell).ok_or(NotOverSymbol::Undecided)??;
            }
            Stop::TooLong(place) => {
                self.cut(&self.grid.place(cell, &place).split().0)?;
            }
            Stop::Closes { contact, place } => {
                let (at, off) = self.grid.place(cell, &place).split();
                let at = self.cut(&Varying { remainder: off, ..at })?;
                self.changes.push(Change { contact, now: Now::Closed, step, at });
            }
        }
        Ok(self)
    }

    /// A contact that opens at the beginning of a cell.
    fn opens_with(&mut self, contact: usize, cell: usize) {
        let (step, at) = (cell / self.grid.cells(), self.grid.within_step(cell).clone());
        self.changes.push(Change { contact, now: Now::Open, step, at });
    }

    /// A contact that opens at a part of a cell, about, and a little later for certain.
    fn opens(&mut self, contact: usize, cell: usize, [root, later]: &[Varying; 2]) -> Outcome<()> {
        let (grid, step) = (&self.grid, cell / self.grid.cells());
        let [low, high] = ends(root);
        let near = Rational::new(1.into(), (1_i64 << NEAR).into());
        if high <= Rational::one() && Rational::one() - low <= near {
            self.opens_with(contact, cell + 1);
            return Ok(());
        }
        let beyond = &ends(later)[1] - Rational::one();
        if beyond.is_negative() {
            let at = self.cut(&grid.place(cell, later).split().0)?;
            self.changes.push(Change { contact, now: Now::Open, step, at });
            return Ok(());
        }
        if let Some(coarser) = grid.coarser(cell) {
            self.grid = coarser?;
            return Ok(());
        }
        // In the next step, for all values at once.
        let is_last = (cell + 1).is_multiple_of(grid.cells());
        if !is_last || beyond > Rational::new(1.into(), MOST_BEYOND.into()) {
            return Err(NotOverSymbol::Undecided);
        }
        let place = Varying::constant(&(&beyond + &near), BITS);
        let [_, at] = ends(&grid.length(cell).multiply(&place, BITS));
        let at = self.cut(&Varying::constant(&at, BITS).split().0)?;
        self.changes.push(Change { contact, now: Now::Open, step: step + 1, at });
        Ok(())
    }

    /// Cuts each step, and tells where: a cut that it is not told from moves with it.
    fn cut(&mut self, at: &Varying) -> Outcome<Varying> {
        let (grid, at, moved) = self.grid.with_cut(at)?;
        let moved = moved.as_ref();
        self.changes
            .iter_mut()
            .filter(|own| Some(&own.at) == moved)
            .for_each(|own| own.at = at.clone());
        self.grid = grid;
        Ok(at)
    }
}

/// How a node moves: with all contacts closed, and after each change.
pub(super) fn ways(node: &Node<Varying>, grid: &Grid, changes: &[Change]) -> Outcome<Vec<Way>> {
    let numbers = node.map(|value| Ok::<_, NotOverSymbol>(value.number()))?;
    let of = |open: &[(usize, usize)]| {
        let is_closed = |contact| open.iter().all(|(own, _)| *own != contact);
        let system = System::of(node, is_closed, BITS).map_err(|_| NotOverSymbol::Unresisted)?;
        let passivity = Passivity::of(&numbers, &system.map(Varying::number))?;
        Ok::<_, NotOverSymbol>((system, passivity))
    };
    let (system, passivity) = of(&[])?;
    let (begins, mut open) = (Begins::AtStart, Vec::new());
    let mut ways = vec![Way { from: 0, system, passivity, begins, open: Vec::new() }];
    let place = |change: &Change| {
        let run = node.contacts().find(|(own, _)| *own == change.contact)?.1;
        Some((grid.cell_at(change.step, &change.at), change.contact, run, change.now))
    };
    let mut own: Vec<_> = changes.iter().filter_map(place).collect();
    own.sort_unstable_by_key(|(from, ..)| *from);
    for (from, contact, run, now) in own {
        let before = ways.last().expect("one at least");
        let Some(from) = from.filter(|from| *from > before.from) else {
            return Err(NotOverSymbol::Undecided);
        };
        // One that opens again before it has closed was found at another time on another grid.
        if open.iter().any(|(own, _)| *own == contact) == (now == Now::Open) {
            return Err(NotOverSymbol::Undecided);
        }
        match now {
            Now::Open => open.push((contact, run)),
            Now::Closed => open.retain(|(own, _)| *own != contact),
        }
        let (system, passivity) = of(&open)?;
        let begins = match now {
            Now::Open => {
                Begins::Opening(Opened::of(node, before, (contact, (&system, &passivity)))?.into())
            }
            Now::Closed => Begins::Closing(Closed::of(node, contact, (&before.system, &system))?),
        };
        let gaps = open.iter().map(|(contact, run)| OpenContact::of(*contact, *run, &system));
        let open = gaps.collect();
        ways.push(Way { from, system, passivity, begins, open });
    }
    Ok(ways)
}
