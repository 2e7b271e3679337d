//! Where a contact opens, for all values of a symbol.
//!
//! The motion `Z` that is followed lets a contact open at the beginning of a cell, a little later than its force vanishes. When
//! the true motion `Y` does so is known nearly, and whether it parts there once or more often is not. Both are compared while
//! the contact of `Y` may be open or closed: with the size `|y|² = Σ w y²` of a state where it is open, `F` the force
//! in the contact and `w` the velocity with which it parts, the difference `e = Y − Z` obeys
//!
//! ```text
//! ½ (|e|²)' ≤ Σ_sides Z_s e_s² + |e| |r| + (F_Y − F_Z)(w_Y − w_Z),
//! ```
//!
//! where `e_s` arrives in a bar with the impedance `Z_s`, and `r` is what loads and roundings are off. A closed contact has
//! `w = 0` and an open one `F = 0`, so `F_Y w_Y ≤ 0`, where two bodies that meet lose energy if any.
//!
//! - While `Z` is closed, the last term is `−F_Z w_Y` at most, and zero as long as `Y` is known to be closed. After that
//!   `|F_Z| ≤ f`, and an open `Y` parts with `w_Y = a·e + D (−F_Z)`, where the *yielding* `D` is zero unless a side of the
//!   contact has no mass.
//! - While `Z` is open and `w_Z ≥ 0`, it is `−F_Y w_Z ≤ 0`.
//! - While `Z` is open and no more than `w_Z ≥ −δ` is known, it is `δ F_Y` at most. Masses part with a velocity that begins at
//!   zero, where rounding hides its sign. Between masses the force is the same function of the state for both motions, so
//!   `F_Y` is that of `Z` and `c·e`.
//!
//! With `s` the largest `|e|` on a cell of length `h` this gives `s² ≤ s₀² + 2as + 2q`, so `s ≤ s₀ + 2a + √(2q)`. Once the gap of `Z`
//! is larger than its error, `Y` is open for certain.

use super::node::{NodeError, NodeState, Way};
use super::on_cell::OnCell;
use super::{NotOverSymbol, Outcome};
use crate::ball::{Arithmetic as _, Ball, Magnitude};
use crate::history::passivity::Passivity;
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::network::{ElementLaw, Node, System};
use crate::scene::Drive;
use crate::signal::Varying;
use num_traits::{One as _, Signed as _, Zero as _};
use wavestep_polynomial::Rational;

/// How much later than the root a contact opens, as a part of a cell and a power of two.
const LATER: i64 = -40;

/// Places on a cell at which a change of sign is looked for.
const PLACES: usize = 64;

/// A gap falls for this part of a cell, one over this number, after it is zero.
const FALLS: i64 = 64;

/// Newton's method squares an error; the first guess is a double.
const CORRECTIONS: usize = 4;

/// What acts on a node on a cell: how far off it is, and for how long.
pub(super) struct Arrived {
    pub(super) acting: Vec<Magnitude>,
    pub(super) length: Magnitude,
}

/// How a contact is nearer than it should be while it is open: the velocity with which it comes back, and the force that it
/// would have were it closed, at most.
#[derive(Clone, Copy)]
pub(super) struct Back {
    pub(super) velocity: Magnitude,
    pub(super) force: Magnitude,
}

/// Bounds of errors on a cell on which a contact may be open or closed.
pub(super) struct Bound {
    /// Of the state that is followed.
    pub(super) entries: Vec<Magnitude>,
    /// Of each output, beyond what follows from those of the state.
    pub(super) further: Vec<Magnitude>,
    pub(super) size: Magnitude,
    pub(super) gap: Magnitude,
}

/// An output where the contact is closed, where it is open, and how much it changes with a force in the contact.
struct Output {
    /// Its places among the outputs, and its rows.
    places: [usize; 2],
    rows: [Vec<Varying>; 2],
    yielding: Magnitude,
}

/// A contact of the motion that is followed: the force in it while it is closed.
enum Contact {
    Closed(Magnitude),
    Open(Back),
}

const CLOSED: usize = 0;
const OPEN: usize = 1;

/// The size `|y|` of a state.
struct Norm {
    /// The roots of the weights, and their inverses.
    roots: Vec<Magnitude>,
    inverse_roots: Vec<Magnitude>,
    /// `|B_j|` of each load.
    driven: Vec<Magnitude>,
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

    fn states(&self) -> usize {
        self.roots.len()
    }

    fn size(&self, entries: &[Magnitude]) -> Magnitude {
        root_of_squares(self.roots.iter().zip(entries).map(|(root, own)| root.multiply(own)))
    }
}

/// A contact that opens, between two ways of a node.
pub(super) struct Opened {
    pub(super) contact: usize,
    /// The velocity with which it parts while it is open, by state and input.
    pub(super) parting: Vec<Varying>,
    /// Its force while it is closed.
    force: Vec<Varying>,
    /// For each entry of the open state the same of the closed one.
    counterparts: Vec<usize>,
    closed_states: usize,
    norm: Norm,
    impedances: [Magnitude; 2],
    /// How fast it parts for each unit of force.
    yielding: Magnitude,
    /// All but its own force, and how many these are.
    outputs: Vec<Output>,
    count: usize,
}

/// How an output changes with the force in a contact: what opening adds to one input or state it adds to all.
fn yielding(closed: &[Varying], open: &[Varying], force: &[Varying]) -> Outcome<Varying> {
    let size = |own: &Varying| own.coefficient(0).magnitude();
    let largest = (0..force.len()).max_by_key(|place| size(&force[*place]));
    let place = largest.ok_or(NotOverSymbol::BesideContact)?;
    let change = closed[place].subtract(&open[place], BITS);
    Ok(change.multiply(&force[place].reciprocal(BITS)?, BITS))
}

impl Opened {
    /// A contact that is closed in one way, and open in the next.
    ///
    /// # Errors
    /// [`NotOverSymbol::BesideContact`] for a load that moves a run, a load beside the contact without mass, and a spring
    /// that ends at the contact.
    pub(super) fn of(
        node: &Node<Varying>,
        before: &Way,
        (contact, open): (usize, (&System<Varying>, &Passivity)),
    ) -> Outcome<Opened> {
        let closed = &before.system;
        let (open, passivity) = open;
        let place = closed.closed.iter().position(|(own, _)| *own == contact);
        let run = closed.closed[place.ok_or(NotOverSymbol::BesideContact)?].1;
        let loads = || node.elements.iter().filter(|own| own.law.is_driven());
        let is_light = |run: usize| !open.has_inertia(run);
        let moves = |own: &ElementLaw<Varying>| matches!(own, ElementLaw::Load(Drive::Velocity));
        if loads().any(|own| moves(&own.law) || is_light(own.run))
            || open.displacements() != closed.displacements()
        {
            return Err(NotOverSymbol::BesideContact);
        }
        let heavy = |group: &usize| {
            let run = open.group.iter().position(|own| own == group)?;
            closed.place_of_velocity(run)
        };
        let counterparts = open.heavy.iter().map(heavy).collect::<Option<Vec<usize>>>();
        let mut counterparts = counterparts.ok_or(NotOverSymbol::BesideContact)?;
        counterparts.extend(closed.heavy.len()..closed.states());
        // The rows of the closed system by the states of the open one.
        let opened = |row: &[Varying]| -> Vec<Varying> {
            let mut row = row.to_vec();
            let mut own: Vec<Varying> = Vec::with_capacity(counterparts.len());
            for counterpart in &counterparts {
                own.push(std::mem::replace(&mut row[*counterpart], Varying::zero()));
            }
            own.extend(row.drain(closed.states()..));
            own
        };
        let runs = node.runs();
        let force = opened(&closed.output[runs + place.expect("it is closed")]);
        let parting = subtracted(&open.output[run + 1], &open.output[run]);
        let is_heavy = open.has_inertia(run) && open.has_inertia(run + 1);
        let yields = |of: &[Varying], by: &[Varying]| match is_heavy {
            true => Ok(Magnitude::ZERO),
            false => yielding(of, by, &force).map(|own| own.magnitude()),
        };
        let zero = vec![Varying::zero(); parting.len()];
        let others = closed.closed.iter().enumerate().filter(|(_, (own, _))| *own != contact);
        let others = others.map(|(number, (own, _))| {
            let among = open.closed.iter().position(|(other, _)| other == own);
            (runs + number, runs + among.expect("it stays closed"))
        });
        let outputs = (0..runs).map(|run| (run, run)).chain(others);
        let output = |(of_closed, of_open): (usize, usize)| {
            let rows = [opened(&closed.output[of_closed]), open.output[of_open].clone()];
            let yielding = yields(&rows[CLOSED], &rows[OPEN])?;
            Ok(Output { places: [of_closed, of_open], rows, yielding })
        };
        Ok(Opened {
            contact,
            yielding: yields(&zero, &parting)?,
            outputs: outputs.map(output).collect::<Outcome<_>>()?,
            count: open.output.len(),
            parting,
            force,
            closed_states: closed.states(),
            norm: Norm::of(open, passivity),
            impedances: node.impedance.each_ref().map(|own| own.magnitude()),
            counterparts,
        })
    }

    /// The state with which the contact opens.
    pub(super) fn enter(&self, before: &NodeState, closed: &Way) -> NodeState {
        let values = self.counterparts.iter().map(|own| before.values[*own].clone()).collect();
        let size = self.size_at_start(&before.error, closed);
        let gap = before.error.gap_of(self.contact).unwrap_or(Magnitude::ZERO);
        let mut gaps = before.gaps.clone();
        gaps.insert(self.contact, OnCell::zero().widened(&gap));
        let error = NodeError::Undecided { contact: self.contact, size, gap };
        NodeState { values, error, gaps }
    }

    /// The size of an error, of the node in this way.
    pub(super) fn size_at_start(&self, error: &NodeError, way: &Way) -> Magnitude {
        match error {
            NodeError::Undecided { contact, size, .. } if *contact == self.contact => *size,
            _ => self.size_of(&way.entries_of(&way.errors_of(error))),
        }
    }

    /// The size of a state with entries of these sizes, those of the open one or of the closed one.
    pub(super) fn size_of(&self, entries: &[Magnitude]) -> Magnitude {
        if entries.len() == self.norm.states() {
            return self.norm.size(entries);
        }
        let own: Vec<Magnitude> = self.counterparts.iter().map(|own| entries[*own]).collect();
        self.norm.size(&own)
    }

    /// A bound of a sum over state and input.
    fn sum(&self, row: &[Varying], sizes: &[Magnitude]) -> Magnitude {
        let terms = row.iter().zip(sizes).map(|(own, size)| own.magnitude().multiply(size));
        terms.fold(Magnitude::ZERO, |sum, own| sum.add(&own))
    }

    /// While the motion that is followed is closed, with no larger force, and the true one may be open.
    pub(super) fn while_closed(
        &self,
        start: Magnitude,
        left: &[Magnitude],
        force: Magnitude,
        arrived: &Arrived,
    ) -> Bound {
        self.bound((start, self.size_of(left)), arrived, Contact::Closed(force))
    }

    /// While the motion that is followed is open, and the true one may be closed.
    pub(super) fn while_open(
        &self,
        start: Magnitude,
        left: &[Magnitude],
        back: Back,
        arrived: &Arrived,
    ) -> Bound {
        self.bound((start, self.size_of(left)), arrived, Contact::Open(back))
    }

    /// How the contact comes back in a motion that is open, on a cell where its state and what acts are these polynomials. None
    /// where it truly does, or between bodies of which one has no mass: these part at once.
    pub(super) fn back(&self, parting: &OnCell, both: &[OnCell]) -> Option<Back> {
        if parting.is_not_negative() {
            return Some(Back { velocity: Magnitude::ZERO, force: Magnitude::ZERO });
        }
        // Twice what it is below zero leaves room for the rounding of this sum.
        let velocity = parting.below_zero_at_start().scale(1);
        let raised = OnCell::total([parting, &OnCell::constant(&size(&velocity))].into_iter());
        let is_hidden = self.yielding.is_zero() && raised.is_not_negative();
        let force = || OnCell::sum(&self.force, both.iter()).largest_from(&Rational::zero());
        is_hidden.then(|| Back { velocity, force: force() })
    }

    /// The bounds with the names of the head of this file.
    fn bound(
        &self,
        (start, left): (Magnitude, Magnitude),
        Arrived { acting, length }: &Arrived,
        contact: Contact,
    ) -> Bound {
        let (norm, states) = (&self.norm, self.norm.states());
        // How much a row changes with the size of a state.
        let by_size = |row: &[Varying]| {
            let both = norm.inverse_roots.iter().zip(row);
            root_of_squares(both.map(|(root, own)| root.multiply(&own.magnitude())))
        };
        let (own, f, back) = match contact {
            Contact::Closed(force) => (CLOSED, force, Magnitude::ZERO),
            Contact::Open(back) => (OPEN, Magnitude::ZERO, back.velocity),
        };
        let of_state = by_size(&self.parting);
        // What parts by inputs alone, and by the force.
        let of_others = self.sum(&self.parting[states..], acting).add(&self.yielding.multiply(&f));
        let loads = norm.driven.iter().zip(&acting[2..]).map(|(driven, own)| driven.multiply(own));
        let by_contact = of_state.multiply(&f).add(&back.multiply(&by_size(&self.force)));
        let pushed = loads.fold(by_contact, |sum, own| sum.add(&own));
        let a = left.add(&pushed.multiply(length));
        let arriving = self.impedances.iter().zip(acting);
        let arriving = arriving.map(|(z, own)| z.multiply(&own.multiply(own)));
        let by_contact = match contact {
            Contact::Closed(force) => force.multiply(&of_others),
            Contact::Open(back) => {
                let others = self.sum(&self.force[states..], acting);
                back.velocity.multiply(&back.force.add(&others))
            }
        };
        let q = arriving.fold(by_contact, |sum, own| sum.add(&own)).multiply(length);
        let size = start.add(&a.scale(1)).add(&q.scale(1).square_root());
        let mut sizes: Vec<Magnitude> =
            norm.inverse_roots.iter().map(|root| root.multiply(&size)).collect();
        sizes.extend(acting);
        // A true force in the contact is as far off.
        let force_is_off = match contact {
            Contact::Closed(force) => force,
            Contact::Open(_) => self.sum(&self.force, &sizes),
        };
        let mut further = vec![Magnitude::ZERO; self.count + 1 - own];
        for output in &self.outputs {
            let other = self.sum(&output.rows[1 - own], &sizes);
            further[output.places[own]] = other.add(&output.yielding.multiply(&force_is_off));
        }
        let entries = match contact {
            Contact::Open(_) => sizes[..states].to_vec(),
            // What moves together is as far off as either.
            Contact::Closed(_) => {
                (0..self.closed_states).map(|entry| self.largest_of(entry, &sizes)).collect()
            }
        };
        let parts = of_state.multiply(&size).add(&of_others);
        Bound { entries, further, size, gap: parts.multiply(length) }
    }

    /// The largest of the entries that are this one while the contact is closed.
    fn largest_of(&self, entry: usize, sizes: &[Magnitude]) -> Magnitude {
        let both = self.counterparts.iter().zip(sizes).filter(|(own, _)| **own == entry);
        both.map(|(_, size)| *size).max().unwrap_or(Magnitude::ZERO)
    }
}

fn root_of_squares(all: impl Iterator<Item = Magnitude>) -> Magnitude {
    all.fold(Magnitude::ZERO, |sum, own| sum.add(&own.multiply(&own))).square_root()
}

fn subtracted(one: &[Varying], other: &[Varying]) -> Vec<Varying> {
    one.iter().zip(other).map(|(one, other)| one.subtract(other, BITS)).collect()
}

/// Where a force becomes negative, about, and a little later, as parts of its cell and polynomials in the symbol. They may be
/// beyond the end of the cell.
///
/// # Errors
/// [`NotOverSymbol::Undecided`] where it may be negative at the start, or does not fall clearly.
pub(super) fn root(force: &OnCell) -> Outcome<[Varying; 2]> {
    let place = zero_of_polynomial(force)?;
    let [_, slope] = ends(&force.slope(&place));
    if !slope.is_negative() || ends(&place)[0].is_negative() {
        return Err(NotOverSymbol::Undecided);
    }
    let off = Magnitude::from_rational(&slope.recip()).multiply(&force.value(&place).magnitude());
    let later = off.scale(1).add(&Magnitude::power_of_two(LATER));
    let later = place.add(&size(&later), BITS).split().0;
    Ok([place, later])
}

/// A bound as a number.
pub(super) fn size(bound: &Magnitude) -> Varying {
    Ball::new(bound.to_binary(), Magnitude::ZERO).into()
}

/// Where a gap is zero for the first time: a polynomial in the symbol and a remainder. None where that may be about the end of
/// the cell, or beyond.
///
/// Up to a place `x₁` the gap less its error is positive. From there on, or from an earlier place, its polynomial `P` falls with
/// `σ` at least until a place `x₂`. So about a place `r` in between the gap is positive until `r − τ`, and negative at `r + τ`,
/// where `στ` is more than its error and `|P(r)|`, if `r + τ` is not beyond `x₂`.
///
/// # Errors
/// [`NotOverSymbol::Undecided`] where it does not fall clearly.
pub(super) fn first_zero(gap: &OnCell) -> Outcome<Option<Varying>> {
    let place = zero_of_polynomial(gap)?;
    let [low, high] = ends(&place);
    let from = gap.positive_until().min(low);
    let until = &high + Rational::new(1.into(), FALLS.into());
    if until > Rational::one() {
        return Ok(None);
    }
    if from.is_negative() {
        return Err(NotOverSymbol::Undecided);
    }
    let slope = gap.largest_slope([&from, &until]);
    if !slope.is_negative() {
        return Err(NotOverSymbol::Undecided);
    }
    let off = gap.error.add(&gap.value(&place).magnitude());
    let off = off.multiply(&Magnitude::from_rational(&slope.recip())).scale(1);
    let zero = Varying { remainder: off, ..place };
    match ends(&zero)[1] <= until {
        true => Ok(Some(zero)),
        false => Err(NotOverSymbol::Undecided),
    }
}

/// Between which numbers a number lies.
pub(super) fn ends(value: &Varying) -> [Rational; 2] {
    let (low, high) = value.range().endpoints();
    [Rational::from(&low), Rational::from(&high)]
}

/// About half way to where a velocity that is positive at first changes its sign, one place for all values of the symbol.
///
/// # Errors
/// [`NotOverSymbol::Undecided`] where that is not on its cell.
pub(super) fn half_way(velocity: &OnCell) -> Outcome<Varying> {
    let place = Rational::from(zero_of_polynomial(velocity)?.coefficient(0).midpoint());
    match place.is_positive() && place < Rational::one() {
        true => Ok(Varying::constant(&(place / Rational::from_integer(2.into())), BITS).split().0),
        false => Err(NotOverSymbol::Undecided),
    }
}

/// The first place at which a polynomial changes its sign, by Newton's method, without a bound.
fn zero_of_polynomial(own: &OnCell) -> Outcome<Varying> {
    let at_middle = |part: usize| {
        let x = part as f64 / PLACES as f64;
        let own = own.coefficients.iter().rev();
        own.fold(0.0, |sum, own| sum * x + own.coefficient(0).midpoint().to_double())
    };
    if at_middle(0) < 0.0 {
        return Err(NotOverSymbol::Undecided);
    }
    let after = (1..=PLACES).find(|part| at_middle(*part) < 0.0);
    let near = after.map_or(2 * PLACES, |after| 2 * after - 1);
    let near = Rational::new(near.into(), (2 * PLACES).into());
    let mut place = Varying::constant(&near, BITS);
    for _ in 0..CORRECTIONS {
        let correction = own.value(&place).quotient(&own.slope(&place), BITS)?;
        place = place.subtract(&correction, BITS).split().0;
    }
    Ok(place)
}
