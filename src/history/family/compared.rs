//! The state in which two motions of a node are compared, of which one has a contact closed and the other has it open.
//!
//! It has the velocities of the open one and the displacements of the closed one.

use super::{NotOverSymbol, Outcome};
use crate::ball::{Arithmetic as _, Magnitude};
use crate::history::passivity::{Passivity, root_of_squares};
use crate::network::{Link, Node, System};
use crate::signal::Varying;
use std::ops::Range;

/// A motion whose contact is closed, and one whose contact is open: where something is kept for both.
pub(super) const CLOSED: usize = 0;
pub(super) const OPEN: usize = 1;

/// Where an entry stands in the closed state, and in the open one: nowhere for the compression of an idle spring.
struct Entry {
    closed: usize,
    open: Option<usize>,
}

impl Entry {
    fn place(&self, of: usize) -> Option<usize> {
        if of == CLOSED { Some(self.closed) } else { self.open }
    }
}

/// What is compared.
pub(super) struct Compared {
    entries: Vec<Entry>,
    /// How many entries either state has.
    states: [usize; 2],
    pub(super) norm: Norm,
}

impl Compared {
    /// The closed system and the open one, and the runs that are loose in this.
    ///
    /// # Errors
    /// [`NotOverSymbol::BesideContact`] where the open one has more.
    pub(super) fn of(
        [closed, open]: [(&System<Varying>, &Passivity); 2],
        loose: &[Range<usize>; 2],
    ) -> Outcome<Compared> {
        let norms = [closed, open].map(|(system, passivity)| Norm::of(system, passivity));
        let (closed, open) = (closed.0, open.0);
        let heavy = |(place, group): (usize, &usize)| {
            let own = (0..open.group.len()).filter(|run| open.group[*run] == *group);
            let firm = own.filter(|run| !loose.iter().any(|own| own.contains(run)));
            Some(Entry { closed: closed.place_of_velocity(firm.min()?)?, open: Some(place) })
        };
        let entries = open.heavy.iter().enumerate().map(heavy).collect::<Option<Vec<Entry>>>();
        let mut entries = entries.ok_or(NotOverSymbol::BesideContact)?;
        let displacements = closed.kept.iter().zip(&open.kept);
        entries.extend(
            displacements
                .filter_map(|(closed, open)| closed.map(|closed| Entry { closed, open: *open })),
        );
        if entries.iter().filter(|own| own.open.is_some()).count() < open.states() {
            return Err(NotOverSymbol::BesideContact);
        }
        let norm = Norm::compared(norms, &entries);
        Ok(Compared { entries, states: [closed.states(), open.states()], norm })
    }

    /// How many entries there are.
    pub(super) fn len(&self) -> usize {
        self.entries.len()
    }

    /// A row of a system, by what is compared.
    pub(super) fn row(&self, row: &[Varying], of: usize) -> Vec<Varying> {
        let (state, inputs) = row.split_at(self.states[of]);
        let mut left = state.to_vec();
        // Of entries that are one in a motion, the first stands for all.
        let entry = |own: &Entry| match own.place(of) {
            Some(place) => std::mem::replace(&mut left[place], Varying::zero()),
            None => Varying::zero(),
        };
        self.entries.iter().map(entry).chain(inputs.iter().cloned()).collect()
    }

    /// The row for the state of a motion that gives what this one does for what is compared.
    pub(super) fn row_in(&self, row: &[Varying], of: usize, bits: u64) -> Vec<Varying> {
        let (entries, inputs) = row.split_at(self.len());
        let mut own = vec![Varying::zero(); self.states[of]];
        for (factor, entry) in entries.iter().zip(&self.entries) {
            if let Some(place) = entry.place(of) {
                own[place] = own[place].add(factor, bits);
            }
        }
        own.extend(inputs.iter().cloned());
        own
    }

    /// The sizes of what is compared, from those of a state.
    pub(super) fn sizes(&self, state: &[Magnitude], of: usize) -> Vec<Magnitude> {
        let size = |own: &Entry| own.place(of).map_or(Magnitude::ZERO, |place| state[place]);
        self.entries.iter().map(size).collect()
    }

    /// The sizes of a state, from those of what is compared: what moves together is as large as either.
    pub(super) fn sizes_in(&self, sizes: &[Magnitude], of: usize) -> Vec<Magnitude> {
        let mut state = vec![Magnitude::ZERO; self.states[of]];
        for (size, entry) in sizes.iter().zip(&self.entries) {
            if let Some(place) = entry.place(of) {
                state[place] = state[place].max(*size);
            }
        }
        state
    }

    /// The open state with what the closed one has, and the sizes of what it drops.
    pub(super) fn opened(&self, closed: &[Varying]) -> (Vec<Varying>, Vec<Magnitude>) {
        let mut values = vec![Varying::zero(); self.states[OPEN]];
        let mut dropped = vec![Magnitude::ZERO; self.len()];
        for (entry, dropped) in self.entries.iter().zip(&mut dropped) {
            match entry.open {
                Some(place) => values[place] = closed[entry.closed].clone(),
                None => *dropped = closed[entry.closed].magnitude(),
            }
        }
        (values, dropped)
    }

    /// A bound of the compressions of idle springs in all, in a state of this size.
    pub(super) fn of_idle(&self, size: &Magnitude) -> Magnitude {
        let all = self.entries.iter().zip(&self.norm.inverse_roots);
        let idle = all.filter(|(own, _)| own.open.is_none());
        idle.fold(Magnitude::ZERO, |sum, (_, root)| sum.add(&root.multiply(size)))
    }
}

/// The runs at the left and at the right of an open contact that are loose, where it has this run at its left.
pub(super) fn loose(node: &Node<Varying>, run: usize, open: &System<Varying>) -> [Range<usize>; 2] {
    let is_joined = |link: &usize| open.group[*link] == open.group[link + 1];
    let is_idle = |link: &usize| matches!(node.links[*link], Link::Element(_));
    let left = (0..run).rev().take_while(is_joined).filter(is_idle).last();
    let right = (run + 1..node.links.len()).take_while(is_joined).filter(is_idle).last();
    [left.unwrap_or(run) + 1..run + 1, run + 1..right.unwrap_or(run) + 1]
}

/// The size `|y|` of a state.
pub(super) struct Norm {
    /// The roots of the weights, and their inverses.
    roots: Vec<Magnitude>,
    pub(super) inverse_roots: Vec<Magnitude>,
    /// `|B_j|` of each load.
    pub(super) driven: Vec<Magnitude>,
}

impl Norm {
    fn of(system: &System<Varying>, passivity: &Passivity) -> Norm {
        let (one, states) = (Magnitude::from_u64(1), system.states());
        let mut roots = vec![Magnitude::ZERO; states];
        let mut inverse_roots = roots.clone();
        for block in &passivity.blocks {
            for (place, member) in block.members.iter().enumerate() {
                let unit = |own: &usize| if own == member { one } else { Magnitude::ZERO };
                roots[*member] = block.size(block.members.iter().map(unit));
                inverse_roots[*member] = block.entry(place, &one);
            }
        }
        let driven = |input: usize| {
            let blocks = passivity.blocks.iter();
            root_of_squares(blocks.map(|own| *own.pushed_by(input)))
        };
        let driven = (2..system.inputs()).map(driven).collect();
        Norm { roots, inverse_roots, driven }
    }

    /// Of the entries that are compared: as in the open system, but for the compressions of idle springs.
    fn compared([closed, open]: [Norm; 2], entries: &[Entry]) -> Norm {
        let all = |closed: &[Magnitude], open: &[Magnitude]| {
            entries.iter().map(|own| own.open.map_or(closed[own.closed], |own| open[own])).collect()
        };
        Norm {
            roots: all(&closed.roots, &open.roots),
            inverse_roots: all(&closed.inverse_roots, &open.inverse_roots),
            driven: open.driven,
        }
    }

    pub(super) fn size(&self, entries: &[Magnitude]) -> Magnitude {
        root_of_squares(self.roots.iter().zip(entries).map(|(root, own)| root.multiply(own)))
    }
}
