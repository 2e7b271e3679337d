//! How time is cut: into steps, and each step into cells.
//!
//! Every travel time is a whole number of steps, and all steps are cut alike. So what arrives on a cell left another node on
//! one cell, however many steps before. Where a contact opens or closes, a cut is made that moves with the symbol: the waves
//! that leave there have it in every step that they arrive in.

use super::opening::size;
use super::{NotOverSymbol, Outcome};
use crate::ball::Arithmetic as _;
use crate::expression::Root;
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::signal::Varying;
use std::cmp::Ordering;
use std::collections::BTreeSet;
use wavestep_polynomial::Rational;

/// Two cuts that are no further apart, as a power of two, are made as one.
const TOGETHER: i64 = -20;

/// Steps, and the cells that each is cut into.
///
/// # Invariants
/// `starts[0] = 0`, and the cells follow each other for every value of the symbol. Only a cut where a
/// contact closes has a remainder.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    pub step: Root,
    /// Each step is cut into so many equal parts, but for the cuts that are left out.
    parts: usize,
    left_out: BTreeSet<usize>,
    /// Further cuts, where contacts open or close.
    cuts: Vec<Varying>,
    starts: Vec<Varying>,
    lengths: Vec<Varying>,
}

impl Grid {
    /// Steps in equal parts.
    ///
    /// # Errors
    /// [`NotOverSymbol::Undecided`] where cuts are not known to follow each other, which equal parts do.
    pub fn new(step: Root, parts: usize) -> Outcome<Grid> {
        Grid::cut((step, parts), BTreeSet::new(), Vec::new())
    }

    fn cut(
        (step, parts): (Root, usize),
        left_out: BTreeSet<usize>,
        cuts: Vec<Varying>,
    ) -> Outcome<Grid> {
        let even = |part: usize| Varying::constant(&Rational::new(part.into(), parts.into()), BITS);
        let mut starts: Vec<Varying> =
            (0..parts).filter(|part| !left_out.contains(part)).map(even).collect();
        starts.extend(cuts.iter().cloned());
        starts.sort_by_key(|start| Rational::from(start.coefficient(0).midpoint()));
        starts.dedup();
        let ends = starts.iter().skip(1).cloned().chain([Varying::one()]);
        let lengths: Vec<Varying> =
            starts.iter().zip(ends).map(|(start, end)| end.subtract(start, BITS)).collect();
        match lengths.iter().all(|own| own.range().sign() == Some(Ordering::Greater)) {
            true => Ok(Grid { step, parts, left_out, cuts, starts, lengths }),
            false => Err(NotOverSymbol::Undecided),
        }
    }

    /// The same steps with each cell in so many equal parts, for functions to be expanded on: it cannot be cut further, and
    /// what begins after a contact closes has the remainder of that.
    pub fn split(&self, count: usize) -> Grid {
        let (mut starts, mut lengths) = (Vec::new(), Vec::new());
        for (start, length) in self.starts.iter().zip(&self.lengths) {
            let length = length.over(count as u64, BITS);
            for part in 0..count {
                let part = Varying::constant(&Rational::from_integer(part.into()), BITS);
                starts.push(start.add(&length.multiply(&part, BITS), BITS));
                lengths.push(length.clone());
            }
        }
        Grid { starts, lengths, ..self.clone() }
    }

    /// Into how many cells a step is cut.
    pub fn cells(&self) -> usize {
        self.starts.len()
    }

    /// Where a cell begins, in steps since the start.
    pub fn start(&self, cell: usize) -> Varying {
        let step = Varying::constant(&Rational::from_integer((cell / self.cells()).into()), BITS);
        step.add(&self.starts[cell % self.cells()], BITS)
    }

    /// How long a cell is, in steps.
    pub fn length(&self, cell: usize) -> &Varying {
        &self.lengths[cell % self.cells()]
    }

    /// Where a cell begins, in steps since its step does.
    pub fn within_step(&self, cell: usize) -> &Varying {
        &self.starts[cell % self.cells()]
    }

    /// A place on a cell, given as a part of it, in steps since its step began.
    pub fn place(&self, cell: usize, place: &Varying) -> Varying {
        let within = self.length(cell).multiply(place, BITS);
        self.within_step(cell).add(&within, BITS)
    }

    /// The cell that begins so far into a step; none where none begins there.
    pub fn cell_at(&self, step: usize, at: &Varying) -> Option<usize> {
        let place = self.starts.iter().position(|start| start == at)?;
        Some(step * self.cells() + place)
    }

    /// With a further cut. Where it is not known whether it is before another one, both are made as one, at the later: with
    /// this other.
    ///
    /// # Errors
    /// [`NotOverSymbol::Undecided`] where two such cuts are far apart, or where it is beyond the step.
    pub fn with_cut(&self, at: &Varying) -> Outcome<(Grid, Varying, Option<Varying>)> {
        let mut cuts = self.cuts.clone();
        let off = |own: &Varying| {
            let off = own.subtract(at, BITS);
            off.range().contains_zero().then(|| off.magnitude())
        };
        let near = cuts.iter_mut().find_map(|own| Some((off(own)?, own)));
        let (at, moved) = match near {
            // Where a contact closes is where it is.
            Some((off, own))
                if off.top().is_some_and(|top| top > TOGETHER)
                    || !own.remainder.is_zero()
                    || !at.remainder.is_zero() =>
            {
                return Err(NotOverSymbol::Undecided);
            }
            Some((off, own)) => {
                let later = own.add(&size(&off), BITS).split().0;
                (later.clone(), Some(std::mem::replace(own, later)))
            }
            None => {
                cuts.push(at.clone());
                (at.clone(), None)
            }
        };
        let grid = Grid::cut((self.step.clone(), self.parts), self.left_out.clone(), cuts)?;
        Ok((grid, at, moved))
    }

    /// Without the cut at the end of a cell; none where that is the end of a step, or where a contact opens or closes.
    pub fn coarser(&self, cell: usize) -> Option<Outcome<Grid>> {
        let end = self.starts.get(cell % self.cells() + 1)?;
        if self.cuts.contains(end) {
            return None;
        }
        let end = Rational::from(end.coefficient(0).midpoint());
        let end = end * Rational::from_integer(self.parts.into());
        let mut left_out = self.left_out.clone();
        left_out.insert(usize::try_from(end.to_integer()).ok()?);
        Some(Grid::cut((self.step.clone(), self.parts), left_out, self.cuts.clone()))
    }
}
