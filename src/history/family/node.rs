//! What a node does over a symbol, cell by cell.

use super::compared::loose;
use super::motion::{Loading, TERMS};
use super::on_cell::OnCell;
use super::opening::{Arrived, Bound, Known, Opened, first_zero, half_way, root};
use super::{NotOverSymbol, Outcome};
use crate::ball::{Arithmetic as _, Ball, Magnitude, Number};
use crate::history::passivity::{Block, Passivity, StateError};
use crate::limits::MAX_SYMBOL_BITS as BITS;
use crate::network::{ElementLaw, Node, System, dot};
use crate::signal::Varying;
use std::collections::{BTreeMap, BTreeSet};

/// Why a node does not go on as it does.
pub(super) enum Stop {
    /// A contact opens at this part of a cell, about, and a little later for certain; at its beginning where there is none.
    Opens {
        contact: usize,
        place: Option<[Varying; 2]>,
    },
    /// An open contact closes at this part of a cell, which is known but for a remainder.
    Closes {
        contact: usize,
        place: Varying,
    },
    /// A contact closes about the end of a cell.
    AboutEnd,
    /// What opens comes nearer again on the same cell, which is cut here.
    TooLong(Varying),
    Refused(NotOverSymbol),
}

/// What a node does on a cell.
pub(super) struct Solved {
    /// Which of its ways it goes.
    pub(super) way: usize,
    /// The state, then what acts on it.
    pub(super) both: Vec<OnCell>,
    pub(super) velocities: Vec<OnCell>,
    /// What leaves at its left and at its right.
    pub(super) leaving: [OnCell; 2],
    pub(super) end: NodeState,
}

/// The state of a node at an instant.
pub(super) struct NodeState {
    pub(super) values: Vec<Varying>,
    pub(super) error: NodeError,
    /// The gaps of open contacts.
    pub(super) gaps: BTreeMap<usize, OnCell>,
}

/// The error of a state.
#[derive(Clone)]
pub(super) enum NodeError {
    /// Of each block, of a node whose contacts are known to be as they are taken to be.
    OfBlocks(Vec<StateError>),
    /// Of all of a node of which one contact may be open or closed, in the norm where it is open; and how far it may have
    /// opened while the one that is followed was closed.
    Undecided { contact: usize, size: Magnitude, gap: Magnitude },
}

impl NodeError {
    /// How far a contact may have opened that may be open or closed; none of any other.
    pub(super) fn gap_of(&self, contact: usize) -> Option<Magnitude> {
        match self {
            NodeError::Undecided { contact: own, gap, .. } if *own == contact => Some(*gap),
            _ => None,
        }
    }
}

/// How a node moves while its contacts stay as they are.
pub(super) struct Way {
    /// The cell with which it begins.
    pub(super) from: usize,
    pub(super) system: System<Varying>,
    pub(super) passivity: Passivity,
    pub(super) begins: Begins,
    pub(super) open: Vec<OpenContact>,
}

/// An open contact.
pub(super) struct OpenContact {
    pub(super) contact: usize,
    /// The runs between which its gap is, which move with the runs beside it: as far from it as they are, so that none is
    /// loose.
    runs: [usize; 2],
}

impl OpenContact {
    /// With this run at its left.
    pub(super) fn of(contact: usize, run: usize, system: &System<Varying>) -> OpenContact {
        let with = |own: usize| {
            let group = system.group.iter().enumerate();
            group.filter(move |(_, group)| **group == system.group[own]).map(|(run, _)| run)
        };
        let runs = [with(run).min(), with(run + 1).max()].map(|own| own.expect("itself at least"));
        OpenContact { contact, runs }
    }
}

/// How a node comes to move in a way.
pub(super) enum Begins {
    AtStart,
    Opening(Box<Opened>),
    Closing(Closed),
}

/// A contact that closes, between two ways of a node.
pub(super) struct Closed {
    contact: usize,
    /// For each entry of the closed state the same of the open one; none for a spring that was idle.
    counterparts: Vec<Option<usize>>,
}

/// A node, its state at the start, and its loads.
pub(super) struct SteppedNode {
    pub(super) node: Node<Varying>,
    /// In order of time.
    pub(super) ways: Vec<Way>,
    pub(super) start: NodeState,
    pub(super) loads: Vec<Loading>,
}

impl NodeState {
    /// At the start springs are unloaded, and masses that collide move on with their common momentum.
    pub(super) fn at_start(node: &Node<Varying>, way: &Way) -> Outcome<NodeState> {
        let mut values = Vec::new();
        for group in &way.system.heavy {
            let runs = (0..node.runs()).filter(|run| way.system.group[*run] == *group);
            let masses = runs.flat_map(|run| node.attached(run)).filter_map(|own| match &own.law {
                ElementLaw::Mass { mass, velocity } => Some((mass, velocity)),
                _ => None,
            });
            let masses: Vec<(&Varying, &Varying)> = masses.collect();
            // A velocity that all of them have is not rounded: a force that begins at zero may hang on it.
            if let [(_, first), others @ ..] = &masses[..]
                && others.iter().all(|(_, own)| own == first)
            {
                values.push((*first).clone());
                continue;
            }
            let (mut mass, mut momentum) = (Varying::zero(), Varying::zero());
            for (own, velocity) in masses {
                mass = mass.add(own, BITS);
                momentum = momentum.add(&own.multiply(velocity, BITS), BITS);
            }
            let inverse = mass.reciprocal(BITS)?;
            values.push(momentum.multiply(&inverse, BITS));
        }
        values.resize(way.system.states(), Varying::zero());
        let (values, off): (Vec<Varying>, Vec<Magnitude>) =
            values.iter().map(Varying::split).unzip();
        let errors = way.errors_of_entries(&off);
        Ok(NodeState { values, error: NodeError::OfBlocks(errors), gaps: BTreeMap::new() })
    }
}

/// The motion of a node on a cell as polynomials, before their errors are known.
struct Polynomials {
    /// Of the state.
    state: Vec<OnCell>,
    /// What is left of the equations of each entry in all.
    left: Vec<Magnitude>,
    /// The state at the end, and how much it is rounded.
    end: Vec<Varying>,
    rounded: Vec<Magnitude>,
}

impl Way {
    /// The state from `k c_k = h (A c_{k−1} + B u_{k−1})`.
    fn polynomials(&self, start: &[Varying], acting: &[OnCell], length: &Varying) -> Polynomials {
        let mut columns = vec![start.to_vec()];
        let mut left = vec![Magnitude::ZERO; start.len()];
        for k in 0..TERMS {
            let given = acting.iter().map(|own| own.coefficient(k));
            let both: Vec<Varying> = columns[k].iter().cloned().chain(given).collect();
            let change = |row: &Vec<Varying>| times(&dot(row, &both, BITS), length);
            let next = self.system.change.iter().map(change);
            let next = next.map(|own| own.over(k as u64 + 1, BITS));
            let (next, off): (Vec<Varying>, Vec<Magnitude>) = match k + 1 < TERMS {
                true => next.map(|own| own.split()).unzip(),
                false => next.map(|own| (Varying::zero(), own.magnitude())).unzip(),
            };
            left = left.iter().zip(&off).map(|(sum, own)| sum.add(own)).collect();
            columns.push(next);
        }
        columns.truncate(TERMS);
        let entry = |i: usize| {
            let own = columns.iter().map(|column| column[i].clone()).collect();
            OnCell::new(own, Magnitude::ZERO)
        };
        let state: Vec<OnCell> = (0..start.len()).map(entry).collect();
        let at_end = state.iter().map(|own| own.value(&Varying::one()).split());
        let (end, rounded) = at_end.unzip();
        Polynomials { state, left, end, rounded }
    }

    /// The errors of the state on a cell and at its end.
    ///
    /// `P` solves `y' = A y + B u` up to a residual `ρ`, what is rounded and what the last term leaves. So the error
    /// `e = y − P` obeys `e' = A e + B e_u + ρ`: where it begins with `|e| ≤ ε`, it is `ε + ∫|ρ| + |B e_u| ∫|e^(Ax)|` at most,
    /// in the energy norm of a block, in which `|e^(Ax)| ≤ 1`.
    fn with_errors(
        &self,
        own: &Polynomials,
        start: &[StateError],
        acting: &[OnCell],
        length: &Varying,
    ) -> (Vec<OnCell>, Vec<StateError>) {
        let arrived: Vec<Magnitude> = acting.iter().map(|own| own.error).collect();
        let mut state = own.state.clone();
        let mut errors = Vec::with_capacity(start.len());
        let all_of_it = length.magnitude();
        for (block, error) in self.passivity.blocks.iter().zip(start) {
            let memory = block.memory(&all_of_it);
            let added = block.push(&arrived).multiply(&memory).add(&size_of(block, &own.left));
            let (first, most) = (error.size(), error.size().add(&added));
            for (place, member) in block.members.iter().enumerate() {
                let entry = &mut state[*member];
                entry.error = block.entry(place, &most);
                // What is added grows no faster than time goes, unless it was taken to die out.
                entry.at_start = match memory == all_of_it {
                    true => block.entry(place, &first),
                    false => entry.error,
                };
            }
            let added = added.add(&size_of(block, &own.rounded));
            errors.push(error.clone().after(&length.number(), &added, block));
        }
        (state, errors)
    }

    /// A displacement that is known to be zero at the start of a cell. Its error begins at zero too, and grows no faster than
    /// by those of all that changes it.
    fn starting_at_zero(
        &self,
        place: usize,
        own: &Polynomials,
        both: &[OnCell],
        length: &Varying,
    ) -> OnCell {
        let terms = self.system.change[place].iter().zip(both);
        let rate = terms.fold(Magnitude::ZERO, |sum, (row, entry)| {
            sum.add(&row.magnitude().multiply(&entry.error))
        });
        let error = rate.multiply(&length.magnitude()).add(&own.left[place]);
        OnCell { error, at_start: Magnitude::ZERO, ..both[place].clone() }
    }

    fn opened(&self) -> Option<&Opened> {
        match &self.begins {
            Begins::Opening(opened) => Some(opened),
            _ => None,
        }
    }

    /// The errors of a state with entries that are off by these.
    fn errors_of_entries(&self, off: &[Magnitude]) -> Vec<StateError> {
        let off = off.iter().map(|off| Number::Enclosed(Ball::zero().widened(off)));
        self.passivity.errors(&off.collect::<Vec<_>>())
    }

    /// How far off the entries of the state are.
    pub(super) fn entries_of(&self, errors: &[StateError]) -> Vec<Magnitude> {
        let mut entries = vec![Magnitude::ZERO; self.system.states()];
        for (block, error) in self.passivity.blocks.iter().zip(errors) {
            for (place, member) in block.members.iter().enumerate() {
                entries[*member] = block.entry(place, &error.size());
            }
        }
        entries
    }

    pub(super) fn errors_of(&self, error: &NodeError) -> Vec<StateError> {
        match error {
            NodeError::OfBlocks(errors) => errors.clone(),
            NodeError::Undecided { size, .. } => {
                self.passivity.blocks.iter().map(|_| StateError::new(*size)).collect()
            }
        }
    }
}

impl SteppedNode {
    /// What the node does on a cell that begins with this state, where waves arrive from both sides and loads act.
    pub(super) fn solve(
        &self,
        (cell, length): (usize, &Varying),
        before: &NodeState,
        acting: Vec<OnCell>,
    ) -> Result<Solved, Stop> {
        assert!(acting.iter().all(|own| own.coefficients.len() <= TERMS));
        let place = self.ways.partition_point(|way| way.from <= cell) - 1;
        let way = &self.ways[place];
        let (system, states) = (&way.system, way.system.states());
        let entered = match &way.begins {
            Begins::Opening(opened) if way.from == cell => {
                Some(opened.enter(before, &self.ways[place - 1]))
            }
            Begins::Closing(closed) if way.from == cell => {
                Some(closed.enter(before, (&self.ways[place - 1], way)))
            }
            _ => None,
        };
        let before = entered.as_ref().unwrap_or(before);
        let own = way.polynomials(&before.values, &acting, length);
        let (state, errors) = way.with_errors(&own, &way.errors_of(&before.error), &acting, length);
        let mut both: Vec<OnCell> = state.into_iter().chain(acting).collect();
        if let Begins::Closing(closed) = &way.begins
            && way.from == cell
        {
            for place in closed.idle_before() {
                both[place] = way.starting_at_zero(place, &own, &both, length);
            }
        }
        let mut error = NodeError::OfBlocks(errors);
        let (mut undecided, mut further) = (None, vec![Magnitude::ZERO; system.output.len()]);
        if let Some((opened, bound)) =
            self.undecided((place, cell), before, (&own, &both), length)?
        {
            for (entry, size) in both.iter_mut().zip(&bound.entries) {
                *entry = entry.polynomial().widened(size);
            }
            (undecided, further) = (Some(opened.contact), bound.further);
            let size = bound.size.add(&opened.size_of(&own.rounded, way));
            let before = before.error.gap_of(opened.contact).unwrap_or(Magnitude::ZERO);
            let gap = before.add(&bound.gap);
            error = NodeError::Undecided { contact: opened.contact, size, gap };
        }
        let output =
            |row: &[Varying], place: usize| OnCell::sum(row, both.iter()).widened(&further[place]);
        let runs = system.group.len();
        let outputs = system.output.iter().enumerate();
        let mut velocities: Vec<OnCell> = outputs.map(|(place, row)| output(row, place)).collect();
        let forces = velocities.split_off(runs);
        let leaving = [(0, 0), (1, runs - 1)].map(|(side, run)| {
            // What arrives is taken off the row, before rounding.
            let mut row = system.output[run].clone();
            let arriving = &mut row[states + side];
            *arriving = arriving.subtract(&Varying::one(), BITS);
            output(&row, run)
        });
        let gaps = way.gaps(before, &velocities, length);
        if let Some(undecided) = undecided {
            let forces = system.closed.iter().map(|(contact, _)| contact).zip(&forces);
            let mut others = forces.chain(&gaps).filter(|(contact, _)| **contact != undecided);
            if others.any(|(_, own)| !own.is_not_negative()) {
                return Err(Stop::Refused(NotOverSymbol::Undecided));
            }
        }
        let gaps = gaps.into_iter().map(|(contact, gap)| (contact, gap.at_end())).collect();
        let end = NodeState { values: own.end, error, gaps };
        Ok(Solved { way: place, both, velocities, leaving, end })
    }

    /// The contact that may be open or closed on a cell, and what bounds the errors then.
    ///
    /// A contact is known to stay closed where its force, less its error, is not negative on all of the cell; and to stay
    /// open where its gap is not. In between, where it opens, it may be either.
    fn undecided(
        &self,
        (place, cell): (usize, usize),
        before: &NodeState,
        (own, both): (&Polynomials, &[OnCell]),
        length: &Varying,
    ) -> Result<Option<(&Opened, Bound)>, Stop> {
        let way = &self.ways[place];
        if way.system.closed.is_empty() && way.open.is_empty() {
            return Ok(None);
        }
        let outputs: Vec<OnCell> =
            way.system.output.iter().map(|row| OnCell::sum(row, both.iter())).collect();
        let acting = both[way.system.states()..].iter().map(|own| own.error).collect();
        let arrived = Arrived { acting, length: length.magnitude() };
        let next = self.ways.get(place + 1);
        let closes = next.filter(|next| next.from == cell + 1);
        // Where it may open at the end of a step it does so on the first cell of the next.
        let opens_soon = next.filter(|next| next.from <= cell + 2).and_then(Way::opened);
        let mut opens = None;
        for (number, (contact, _)) in way.system.closed.iter().enumerate() {
            let force = &outputs[way.system.group.len() + number];
            if force.is_not_negative() && before.error.gap_of(*contact).is_none() {
                continue;
            }
            let opened = opens_soon.filter(|next| next.contact == *contact);
            opens = Some((opened.ok_or_else(|| opening(*contact, force))?, force));
        }
        let mut may_close = None;
        for (contact, gap) in way.gaps(before, &outputs, length) {
            let closes = closes.is_some_and(
                |next| matches!(&next.begins, Begins::Closing(own) if own.contact == contact),
            );
            // Whether it is open at the start is not told by its gap, which is zero there.
            let is_new = way.from == cell && way.opened().is_some_and(|own| own.contact == contact);
            if closes || (gap.is_not_negative() && !is_new) {
                continue;
            }
            let opened = way.opened().filter(|own| own.contact == contact);
            match opened.filter(|_| before.error.gap_of(contact).is_some()) {
                Some(opened) => may_close = Some((opened, gap)),
                None => return Err(closing(contact, &gap)),
            }
        }
        let start = |opened: &Opened| opened.size_at_start(&before.error, way);
        let both: Vec<OnCell> = both.iter().map(OnCell::polynomial).collect();
        match (opens, may_close) {
            (Some(_), Some(_)) => Err(Stop::Refused(NotOverSymbol::Undecided)),
            (Some((next, force)), None) => {
                let known = match before.error.gap_of(next.contact) {
                    None => Known::Closed,
                    Some(_) => Known::Neither,
                };
                let left = next.size_of(&own.left, way);
                let force = (force, known);
                Ok(Some((next, next.while_closed(start(next), left, force, &both, &arrived))))
            }
            (None, Some((opened, gap))) => {
                let parting = opened.parting(&both);
                let Some(back) = opened.back(&parting, &both) else {
                    if gap.is_positive_at_start() {
                        return Err(closing(opened.contact, &gap));
                    }
                    let half = half_way(&parting).map(Stop::TooLong);
                    return Err(half.unwrap_or_else(Stop::Refused));
                };
                let left = opened.size_of(&own.left, way);
                let bound = opened.while_open(start(opened), left, back, &both, &arrived);
                Ok(Some((opened, bound)))
            }
            (None, None) => Ok(None),
        }
    }
}

impl Way {
    /// The gaps of open contacts.
    fn gaps(
        &self,
        before: &NodeState,
        velocities: &[OnCell],
        length: &Varying,
    ) -> BTreeMap<usize, OnCell> {
        let gap = |OpenContact { contact, runs: [left, right] }: &OpenContact| {
            let parting = velocities[*right].less(&velocities[*left]);
            (*contact, after(&before.gaps[contact], &parting, length))
        };
        self.open.iter().map(gap).collect()
    }
}

impl Closed {
    /// A contact that is open in one way, and closed in the next.
    ///
    /// # Errors
    /// [`NotOverSymbol::BesideContact`] for a load that moves a run, and for masses that meet.
    pub(super) fn of(
        node: &Node<Varying>,
        contact: usize,
        (open, closed): (&System<Varying>, &System<Varying>),
    ) -> Outcome<Closed> {
        let is_moved = (0..node.runs()).any(|run| node.imposing(run).next().is_some());
        let run = node.contacts().find(|(own, _)| *own == contact).map(|(_, run)| run);
        let run = run.filter(|_| !is_moved).ok_or(NotOverSymbol::BesideContact)?;
        let loose = loose(node, run, open);
        let only = |group: &usize| {
            let is_firm = |run: &usize| loose.iter().all(|own| !own.contains(run));
            let runs = (0..node.runs()).filter(|run| closed.group[*run] == *group);
            let places = runs.filter(is_firm).filter_map(|run| open.place_of_velocity(run));
            let places: BTreeSet<usize> = places.collect();
            places.first().copied().filter(|_| places.len() == 1)
        };
        let counterparts = closed.heavy.iter().map(|group| only(group).map(Some));
        let counterparts = counterparts.collect::<Option<Vec<Option<usize>>>>();
        let mut counterparts = counterparts.ok_or(NotOverSymbol::BesideContact)?;
        let displacements = closed.kept.iter().zip(&open.kept);
        counterparts.extend(displacements.filter(|(own, _)| own.is_some()).map(|(_, open)| *open));
        Ok(Closed { contact, counterparts })
    }

    /// The displacements of springs that were idle, in the closed state.
    fn idle_before(&self) -> impl Iterator<Item = usize> {
        let all = self.counterparts.iter().enumerate();
        all.filter(|(_, own)| own.is_none()).map(|(place, _)| place)
    }

    fn enter(&self, before: &NodeState, (open, closed): (&Way, &Way)) -> NodeState {
        let off = open.entries_of(&open.errors_of(&before.error));
        let entry = |own: &Option<usize>| match own {
            Some(own) => (before.values[*own].clone(), off[*own]),
            None => (Varying::zero(), Magnitude::ZERO),
        };
        let (values, off): (Vec<Varying>, Vec<Magnitude>) =
            self.counterparts.iter().map(entry).unzip();
        let mut gaps = before.gaps.clone();
        gaps.remove(&self.contact);
        NodeState { values, error: NodeError::OfBlocks(closed.errors_of_entries(&off)), gaps }
    }
}

/// How the force in a closed contact ends that is not known to press on all of a cell.
fn opening(contact: usize, force: &OnCell) -> Stop {
    if force.falls_below_zero_at_once() {
        return Stop::Opens { contact, place: None };
    }
    match root(force) {
        Ok(place) => Stop::Opens { contact, place: Some(place) },
        Err(error) => Stop::Refused(error),
    }
}

/// How an open contact closes whose gap is not known to be positive on all of a cell.
fn closing(contact: usize, gap: &OnCell) -> Stop {
    match first_zero(gap) {
        Ok(Some(place)) => Stop::Closes { contact, place },
        Ok(None) => Stop::AboutEnd,
        Err(error) => Stop::Refused(error),
    }
}

/// A number times a length, which may be one.
fn times(value: &Varying, length: &Varying) -> Varying {
    match length.coefficients.len() {
        1 if *length == Varying::one() => value.clone(),
        _ => value.multiply(length, BITS),
    }
}

/// The integral of a function on a cell of this length, and what was there at its start.
pub(super) fn after(before: &OnCell, rate: &OnCell, length: &Varying) -> OnCell {
    OnCell::sum(&[Varying::one(), length.clone()], [before, &rate.antiderivative()].into_iter())
}

/// The size of a block in a state with entries of these sizes.
fn size_of(block: &Block, sizes: &[Magnitude]) -> Magnitude {
    block.size(block.members.iter().map(|i| sizes[*i]))
}
