//! Where a contact opens, for all values of a symbol.
//!
//! The motion `Z` that is followed lets a contact open at the beginning of a cell, a little later than its force vanishes. When
//! the true motion `Y` does so is known nearly, and whether it parts there once or more often is not. Both are compared while
//! the contact of `Y` may be open or closed: with the size `|y|² = Σ w y²` of a state (`compared`), `F` the force in the
//! contact and `w` the velocity with which it parts, the difference `e = Y − Z` obeys
//!
//! ```text
//! ½ (|e|²)' ≤ Σ_sides Z_s e_s² + |e| |r| + (F_Y − F_Z)(w_Y − w_Z),
//! ```
//!
//! where `e_s` arrives in a bar with the impedance `Z_s`, and `r` is what loads and roundings are off. A closed contact has
//! `w = 0` and an open one `F = 0`, so `F_Y w_Y ≤ 0`, where two bodies that meet lose energy if any.
//!
//! - While `Z` is closed, the last term is `−F_Z w_Y` at most, and zero as long as `Y` is known to be closed. After that
//!   `|F_Z| ≤ f`, and an open `Y` parts with `w_Y = a·Z + a·e`, where `a` is the row of what parts.
//! - While `Z` is open and `w_Z ≥ 0`, it is `−F_Y w_Z ≤ 0`.
//! - While `Z` is open and no more than `w_Z ≥ −δ` is known, it is `δ F_Y` at most. Masses part with a velocity that begins at
//!   zero, where rounding hides its sign. Between masses the force is the same function of the state for both motions, so
//!   `F_Y` is that of `Z` and `c·e`.
//!
//! An undamped spring beside the contact, with nothing else at its end, is unloaded while the contact is open: it is *idle*, and
//! its free end, which is *loose*, moves with its other end. All this holds with its compression as an entry of the state that
//! is zero while it is idle. The compression that is left when `Z` opens counts as an error. The gap grows as the distance of
//! what is not loose does, and by the compression. Where that distance has grown in `Z` by more than its error and the
//! compression of `Y` at the start, `Y` is open: a closed one would be pulled.
//!
//! With `s` the largest `|e|` on a cell of length `h` this gives `s² ≤ s₀² + 2as + 2q`, so `s ≤ s₀ + 2a + √(2q)`. Once the gap of `Z`
//! is larger than its error, `Y` is open for certain.

use super::compared::{CLOSED, Compared, OPEN, loose};
use super::node::{NodeError, NodeState, Way};
use super::on_cell::OnCell;
use super::{NotOverSymbol, Outcome};
use crate::ball::{Arithmetic as _, Ball, Magnitude};
use crate::history::passivity::{Passivity, root_of_squares};
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

/// After its zero a gap must keep falling for `2^-k` of a cell. These `k` are tried: the closer it grazes zero, the shorter
/// it falls.
const FALLS: [u32; 5] = [6, 9, 12, 15, 18];

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

/// What is known of a contact at the start of a cell.
#[derive(Clone, Copy)]
pub(super) enum Known {
    Closed,
    Neither,
}

/// Bounds of errors on a cell on which a contact may be open or closed.
pub(super) struct Bound {
    /// Of the state that is followed.
    pub(super) entries: Vec<Magnitude>,
    /// Of each output, beyond what follows from those of the state.
    pub(super) further: Vec<Magnitude>,
    pub(super) size: Magnitude,
    /// How far the true contact may open while the one that is followed is closed.
    pub(super) gap: Magnitude,
}

/// An output where the contact is closed, where it is open, and how much it changes with a force in the contact.
struct Output {
    /// Its places among the outputs, and its rows.
    places: [usize; 2],
    rows: [Vec<Varying>; 2],
    /// None for the velocity of what is loose: it is another one while the contact is open.
    yielding: Option<Magnitude>,
}

/// A contact of the motion that is followed: what it is like while the true one may be otherwise, and how much outputs change by
/// that.
enum Contact {
    /// The force in it, the velocity with which an open one would part, and for how long, at most.
    Closed {
        force: Magnitude,
        parting: Magnitude,
        time: Magnitude,
        changes: Vec<Magnitude>,
    },
    Open {
        back: Back,
        changes: Vec<Magnitude>,
    },
}

/// A contact that opens, between two ways of a node.
pub(super) struct Opened {
    pub(super) contact: usize,
    /// The velocity with which it parts while it is open, by state and input.
    parting: Vec<Varying>,
    /// Its force while it is closed.
    force: Vec<Varying>,
    compared: Compared,
    impedances: [Magnitude; 2],
    is_between_masses: bool,
    /// Whether a spring beside it is idle while it is open.
    has_idle: bool,
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
    /// [`NotOverSymbol::BesideContact`] for a load that moves a run, and a load beside the contact without mass.
    pub(super) fn of(
        node: &Node<Varying>,
        before: &Way,
        (contact, open): (usize, (&System<Varying>, &Passivity)),
    ) -> Outcome<Opened> {
        let closed = &before.system;
        let (open, passivity) = open;
        let place = closed.closed.iter().position(|(own, _)| *own == contact);
        let place = place.expect("it is closed");
        let (run, runs) = (closed.closed[place].1, node.runs());
        let loads = || node.elements.iter().filter(|own| own.law.is_driven());
        let is_light = |run: usize| !open.has_inertia(run);
        let moves = |own: &ElementLaw<Varying>| matches!(own, ElementLaw::Load(Drive::Velocity));
        if loads().any(|own| moves(&own.law) || is_light(own.run)) {
            return Err(NotOverSymbol::BesideContact);
        }
        let sides = loose(node, run, open);
        let is_loose = |run: &usize| sides.iter().any(|own| own.contains(run));
        let has_idle = sides.iter().any(|own| !own.is_empty());
        let compared = Compared::of([(closed, &before.passivity), (open, passivity)], &sides)?;
        let force = compared.row(&closed.output[runs + place], CLOSED);
        let parting = compared.row(&subtracted(&open.output[run + 1], &open.output[run]), OPEN);
        let is_between_masses = open.has_inertia(run) && open.has_inertia(run + 1);
        let others = closed.closed.iter().enumerate().filter(|(_, (own, _))| *own != contact);
        let mut places: Vec<(usize, usize)> = (0..runs).map(|run| (run, run)).collect();
        for (number, (own, other)) in others {
            let among = open.closed.iter().position(|(other, _)| other == own);
            if is_loose(other) || is_loose(&(other + 1)) {
                return Err(NotOverSymbol::BesideContact);
            }
            places.push((runs + number, runs + among.expect("it stays closed")));
        }
        let output = |(own, other): (usize, usize)| {
            let rows = [
                compared.row(&closed.output[own], CLOSED),
                compared.row(&open.output[other], OPEN),
            ];
            let yielding = match (is_loose(&own), is_between_masses && !has_idle) {
                (true, _) => None,
                (false, true) => Some(Magnitude::ZERO),
                (false, false) => Some(yielding(&rows[CLOSED], &rows[OPEN], &force)?.magnitude()),
            };
            Ok(Output { places: [own, other], rows, yielding })
        };
        Ok(Opened {
            contact,
            outputs: places.into_iter().map(output).collect::<Outcome<_>>()?,
            count: open.output.len(),
            parting,
            force,
            impedances: node.impedance.each_ref().map(|own| own.magnitude()),
            compared,
            is_between_masses,
            has_idle,
        })
    }

    /// The state with which the contact opens.
    pub(super) fn enter(&self, before: &NodeState, closed: &Way) -> NodeState {
        let (values, dropped) = self.compared.opened(&before.values);
        let dropped = self.compared.norm.size(&dropped);
        let size = self.size_at_start(&before.error, closed).add(&dropped);
        let gap = before.error.gap_of(self.contact).unwrap_or(Magnitude::ZERO);
        let off = gap.add(&self.compared.of_idle(&size));
        let mut gaps = before.gaps.clone();
        gaps.insert(self.contact, OnCell::zero().widened(&off));
        let error = NodeError::Undecided { contact: self.contact, size, gap };
        NodeState { values, error, gaps }
    }

    /// The size of an error, of the node in this way.
    pub(super) fn size_at_start(&self, error: &NodeError, way: &Way) -> Magnitude {
        match error {
            NodeError::Undecided { contact, size, .. } if *contact == self.contact => *size,
            _ => self.size_of(&way.entries_of(&way.errors_of(error)), way),
        }
    }

    /// The size of a state with entries of these sizes, of the node in this way.
    pub(super) fn size_of(&self, entries: &[Magnitude], way: &Way) -> Magnitude {
        let is_open = way.open.iter().any(|own| own.contact == self.contact);
        let of = if is_open { OPEN } else { CLOSED };
        self.compared.norm.size(&self.compared.sizes(entries, of))
    }

    /// A sum over what is compared, of functions on a cell in a motion whose contact is closed, or open.
    fn in_motion(&self, row: &[Varying], own: usize, both: &[OnCell]) -> OnCell {
        OnCell::sum(&self.compared.row_in(row, own, BITS), both.iter())
    }

    /// The velocity with which it parts in a motion that is open, on a cell where its state and what acts are these.
    pub(super) fn parting(&self, both: &[OnCell]) -> OnCell {
        self.in_motion(&self.parting, OPEN, both)
    }

    /// A bound of a sum over state and input.
    fn sum(&self, row: &[Varying], sizes: &[Magnitude]) -> Magnitude {
        let terms = row.iter().zip(sizes).map(|(own, size)| own.magnitude().multiply(size));
        terms.fold(Magnitude::ZERO, |sum, own| sum.add(&own))
    }

    /// While the motion that is followed is closed, with this force on these functions, and the true one may be open; `begins`
    /// tells what is known at the start of the cell.
    pub(super) fn while_closed(
        &self,
        start: Magnitude,
        left: Magnitude,
        (force, begins): (&OnCell, Known),
        both: &[OnCell],
        arrived: &Arrived,
    ) -> Bound {
        let positive_until = |force: &OnCell| match begins {
            Known::Closed => force.positive_until(),
            Known::Neither => Rational::zero(),
        };
        // The end of the cell, about which the bounds are much closer.
        let near = positive_until(force);
        let force = force.after(&near);
        let from = positive_until(&force);
        let largest =
            |row: &[Varying]| self.in_motion(row, CLOSED, both).after(&near).largest_from(&from);
        let change = |own: &Output| largest(&subtracted(&own.rows[OPEN], &own.rows[CLOSED]));
        let rest = (Rational::one() - &near) * (Rational::one() - &from);
        let contact = Contact::Closed {
            force: force.largest_from(&from),
            parting: largest(&self.parting),
            time: arrived.length.multiply(&Magnitude::from_rational(&rest)),
            changes: self.outputs.iter().map(change).collect(),
        };
        self.bound((start, left), arrived, contact)
    }

    /// While the motion that is followed is open, and the true one may be closed.
    pub(super) fn while_open(
        &self,
        start: Magnitude,
        left: Magnitude,
        back: Back,
        both: &[OnCell],
        arrived: &Arrived,
    ) -> Bound {
        let changes = self.outputs.iter().map(|own| match own.yielding {
            Some(_) => Magnitude::ZERO,
            None => {
                let change = subtracted(&own.rows[CLOSED], &own.rows[OPEN]);
                self.in_motion(&change, OPEN, both).largest_from(&Rational::zero())
            }
        });
        let contact = Contact::Open { back, changes: changes.collect() };
        self.bound((start, left), arrived, contact)
    }

    /// How the contact comes back in a motion that is open, on a cell where its state and what acts are these polynomials. None
    /// where it truly does, or between bodies of which one has no mass: these part at once.
    pub(super) fn back(&self, parting: &OnCell, both: &[OnCell]) -> Option<Back> {
        let force = || self.in_motion(&self.force, OPEN, both).largest_from(&Rational::zero());
        if parting.is_not_negative() {
            // A spring that is idle has no force but by rounding. Between others the force of what parts would pull.
            let force = if self.has_idle { force() } else { Magnitude::ZERO };
            return Some(Back { velocity: Magnitude::ZERO, force });
        }
        // Twice what it is below zero leaves room for the rounding of this sum.
        let velocity = parting.below_zero_at_start().scale(1);
        let raised = OnCell::total([parting, &OnCell::constant(&size(&velocity))].into_iter());
        let is_hidden = self.is_between_masses && !self.has_idle && raised.is_not_negative();
        is_hidden.then(|| Back { velocity, force: force() })
    }

    /// The bounds with the names of the head of this file.
    fn bound(
        &self,
        (start, left): (Magnitude, Magnitude),
        Arrived { acting, length }: &Arrived,
        contact: Contact,
    ) -> Bound {
        let (norm, states) = (&self.compared.norm, self.compared.len());
        // How much a row changes with the size of a state.
        let by_size = |row: &[Varying]| {
            let both = norm.inverse_roots.iter().zip(row);
            root_of_squares(both.map(|(root, own)| root.multiply(&own.magnitude())))
        };
        let (of_state, of_inputs) =
            (by_size(&self.parting), self.sum(&self.parting[states..], acting));
        // What the contact adds to a and to q.
        let [pushed, worked] = match &contact {
            Contact::Closed { force, parting, time, .. } => {
                let others = parting.add(&of_inputs);
                [&of_state, &others].map(|own| own.multiply(force).multiply(time))
            }
            Contact::Open { back, .. } => {
                let others = back.force.add(&self.sum(&self.force[states..], acting));
                [&by_size(&self.force), &others]
                    .map(|own| own.multiply(&back.velocity).multiply(length))
            }
        };
        let loads = norm.driven.iter().zip(&acting[2..]).map(|(driven, own)| driven.multiply(own));
        let loads = loads.fold(Magnitude::ZERO, |sum, own| sum.add(&own)).multiply(length);
        let a = left.add(&pushed).add(&loads);
        let arriving = self.impedances.iter().zip(acting);
        let arriving = arriving.map(|(z, own)| z.multiply(&own.multiply(own)));
        let arriving = arriving.fold(Magnitude::ZERO, |sum, own| sum.add(&own)).multiply(length);
        let q = arriving.add(&worked);
        let size = start.add(&a.scale(1)).add(&q.scale(1).square_root());
        let mut sizes: Vec<Magnitude> =
            norm.inverse_roots.iter().map(|root| root.multiply(&size)).collect();
        sizes.extend(acting);
        let (own, changes) = match &contact {
            Contact::Closed { changes, .. } => (CLOSED, changes),
            Contact::Open { changes, .. } => (OPEN, changes),
        };
        let mut further = vec![Magnitude::ZERO; self.count + 1 - own];
        for (output, change) in self.outputs.iter().zip(changes) {
            let other = self.sum(&output.rows[1 - own], &sizes).add(change);
            further[output.places[own]] = match (&contact, output.yielding) {
                // A true force in the contact is as far off.
                (Contact::Open { back, .. }, Some(yielding)) => {
                    let force = self.sum(&self.force, &sizes).add(&back.force);
                    other.add(&yielding.multiply(&force))
                }
                _ => other,
            };
        }
        let gap = match &contact {
            Contact::Closed { parting, time, .. } => {
                of_state.multiply(&size).add(&of_inputs).add(parting).multiply(time)
            }
            Contact::Open { .. } => Magnitude::ZERO,
        };
        let entries = self.compared.sizes_in(&sizes[..states], own);
        Bound { entries, further, size, gap }
    }
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
    if high >= Rational::one() {
        return Ok(None);
    }
    let from = gap.positive_until().min(low);
    if from.is_negative() {
        return Err(NotOverSymbol::Undecided);
    }
    let size = gap.error.add(&gap.value(&place).magnitude());
    let left = (Rational::one() - &high) / Rational::from_integer(2.into());
    for exponent in FALLS {
        let part = Rational::new(1.into(), (1_i64 << exponent).into());
        let until = &high + part.min(left.clone());
        let slope = gap.largest_slope([&from, &until]);
        if !slope.is_negative() {
            continue;
        }
        let off = size.multiply(&Magnitude::from_rational(&slope.recip())).scale(1);
        let zero = Varying { remainder: off, ..place.clone() };
        if ends(&zero)[1] <= until {
            return Ok(Some(zero));
        }
    }
    // About the end of the cell: without the cut there it may be decided.
    match left < Rational::new(1.into(), (1_i64 << FALLS[0]).into()) {
        true => Ok(None),
        false => Err(NotOverSymbol::Undecided),
    }
}

/// Between which numbers a number lies.
pub(super) fn ends(value: &Varying) -> [Rational; 2] {
    value.range().bounds()
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
    let at_middle = |part: usize| own.at_middle(part as f64 / PLACES as f64);
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
