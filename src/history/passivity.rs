//! What a node makes of errors.
//!
//! A node without loads takes energy up or passes it on to its bars, and never gives any: with the masses and
//! stiffnesses `w` of its state the *size* `|y| = √Σ w y²` does not grow, `|e^(Ax) y| ≤ |y|`, and what arrives
//! changes it by `|B u|` in a unit of time at most. An error of the state obeys the same equations. So it is
//! bounded by one number, which grows with what arrives and dies out as the motion itself does, however
//! many cells the time is cut into.
//!
//! A local contact that is pressed counts as a spring about as stiff as it is where a cell begins; `pressing` adds what
//! it differs from that.

use crate::ball::{Ball, BallError, Magnitude, Number};
use crate::history::pressing::Pressed;
use crate::history::separation::{Rows, Separation};
use crate::history::series::{LONGEST_CELL, Truncation};
use crate::network::{Node, System};

/// The precision of the matrices here: bounds need few digits.
const BITS: u64 = 64;

/// The terms of an exponential `e^A`, `‖A‖ ≤ 2`: `2^24/24! · e²` is below `2^(−50)`.
const TERMS: u64 = 24;
const TERMS_LEFT_OUT: i64 = -50;

/// An error that does not halve in `2^16` units of the time of a block is taken to stay.
const MOST_DOUBLINGS: i64 = 16;

type Matrix = Vec<Vec<Ball>>;

fn product(one: &Matrix, other: &Matrix) -> Matrix {
    let entry = |row: &Vec<Ball>, j: usize| {
        let terms = row.iter().zip(other).map(|(a, b)| a.multiply(&b[j], BITS));
        terms.fold(Ball::zero(), |sum, term| sum.add(&term, BITS))
    };
    one.iter().map(|row| (0..other.len()).map(|j| entry(row, j)).collect()).collect()
}

/// A bound of `|M y|/|y|`, at most `n^(1/16)` times too large: with `G = w⁻¹ Mᵀ w M`, which has the squares of
/// the stretches of `M` as its eigenvalues, these are at most `(trace G⁸)^(1/8)`.
fn norm(matrix: &Matrix, weights: &[Ball], inverses: &[Ball]) -> Magnitude {
    let size = matrix.len();
    let entry = |i: usize, j: usize| {
        let terms = (0..size).map(|k| {
            let both = matrix[k][i].multiply(&matrix[k][j], BITS);
            both.multiply(&weights[k], BITS).multiply(&inverses[i], BITS)
        });
        terms.fold(Ball::zero(), |sum, term| sum.add(&term, BITS))
    };
    let gram: Matrix = (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect();
    let eighth = (0..3).fold(gram, |power, _| product(&power, &power));
    let trace = (0..size).fold(Magnitude::ZERO, |sum, i| sum.add(&eighth[i][i].magnitude()));
    (0..4).fold(trace, |root, _| root.square_root())
}

pub(super) fn root_of_squares(all: impl Iterator<Item = Magnitude>) -> Magnitude {
    all.fold(Magnitude::ZERO, |sum, own| sum.add(&own.multiply(&own))).square_root()
}

/// States of a node that act on each other.
pub struct Block {
    /// Their places in the state.
    pub members: Vec<usize>,
    /// Bounds of `√w` and of `1/√w`.
    roots: Vec<Magnitude>,
    inverse_roots: Vec<Magnitude>,
    /// `‖A‖`.
    pub rate: Magnitude,
    /// `|B_j|` for each input.
    driven: Vec<Magnitude>,
    /// A time, as a power of two, and what is left of an error after it, where it dies out.
    pub decay: Option<(i64, Magnitude)>,
    /// Its slow motions apart from its fast ones, the slowest first; none where a local contact is pressed.
    pub separations: Vec<Separation>,
    /// The local contacts that are pressed, whose compressions are members.
    pub pressed: Vec<Pressed>,
}

/// Whether a motion with such a rate is too fast for a Taylor polynomial on a cell.
fn is_stiff(rate: &Magnitude, length: &Magnitude) -> bool {
    // A little above the longest cell, whose length is rounded.
    rate.multiply(length) > Magnitude::from_u64((1 << LONGEST_CELL) + 1)
}

/// The blocks of a node whose contacts are as they are.
pub struct Passivity {
    pub blocks: Vec<Block>,
}

impl Passivity {
    /// With the largest spring for each local contact: its rate bounds that of every softer one, which scales the
    /// matrix of the norm down.
    ///
    /// # Errors
    /// [`BallError::DivisorMayBeZero`] for a mass or a stiffness of which it is not known.
    pub fn of(node: &Node<Number>, system: &System<Number>) -> Result<Passivity, BallError> {
        Passivity::with_springs(Pressed::all(node, system, None)?, node, system)
    }

    /// With springs about as stiff as the local contacts are at this state, and what is slow apart from what is fast,
    /// with so many bits.
    pub fn at(
        node: &Node<Number>,
        system: &System<Number>,
        (now, bits): (&[Number], u64),
    ) -> Result<Passivity, BallError> {
        let pressed = Pressed::all(node, system, Some(now))?;
        let mut own = Passivity::with_springs(pressed, node, system)?;
        for block in own.blocks.iter_mut().filter(|block| block.pressed.is_empty()) {
            let entry = |i: &usize, j: &usize| system.change[*i][*j].clone();
            let row = |i: &usize| block.members.iter().map(|j| entry(i, j)).collect();
            let change: Rows = block.members.iter().map(row).collect();
            block.separations = Separation::all_of(&change, |rows| block.norm_of(rows), bits);
        }
        Ok(own)
    }

    fn with_springs(
        pressed: Vec<Pressed>,
        node: &Node<Number>,
        system: &System<Number>,
    ) -> Result<Passivity, BallError> {
        let stiffened;
        let system = match pressed.is_empty() {
            true => system,
            false => {
                stiffened = system.stiffened(&pressed, BITS);
                &stiffened
            }
        };
        let weights = weights(node, system, &pressed);
        let states = system.states();
        let joined =
            |i: usize, j: usize| !system.change[i][j].is_zero() || !system.change[j][i].is_zero();
        let mut left: Vec<usize> = (0..states).collect();
        let mut blocks = Vec::new();
        while let Some(first) = left.first().copied() {
            let mut members = vec![first];
            let mut next = 0;
            while next < members.len() {
                let own = members[next];
                left.retain(|other| !members.contains(other));
                members.extend(left.iter().filter(|other| joined(own, **other)));
                next += 1;
            }
            left.retain(|other| !members.contains(other));
            members.sort_unstable();
            blocks.push(Block::new(system, members, &weights)?.with_pressed(&pressed));
        }
        Ok(Passivity { blocks })
    }

    /// The errors of a state of which enclosures are known.
    pub fn errors(&self, state: &[Number]) -> Vec<StateError> {
        self.blocks.iter().map(|block| StateError::of(block, &block.of(state))).collect()
    }

    /// With the state of the node at the start of a cell, and its errors.
    pub fn known<'a>(&'a self, state: &'a [Number], errors: &'a [StateError]) -> Known<'a> {
        Known { passivity: self, state, errors }
    }

    /// Whether the springs that stand for local contacts are about as stiff as these at a state.
    pub fn is_near(&self, now: &[Number]) -> bool {
        self.blocks.iter().flat_map(|block| &block.pressed).all(|pressed| pressed.is_near(now))
    }

    /// The same errors in the norms of these springs, of the same system: larger by at most the root of the ratio of
    /// stiffnesses.
    pub fn carried(&self, before: &Passivity, errors: &[StateError]) -> Vec<StateError> {
        let both = self.blocks.iter().zip(&before.blocks).zip(errors);
        both.map(|((block, before), error)| match block.pressed.is_empty() {
            true => error.clone(),
            false => StateError::new(error.size().multiply(&block.stretch_of(before))),
        })
        .collect()
    }

    /// The largest norm of a block.
    pub fn rate(&self) -> Magnitude {
        self.blocks.iter().map(|block| block.rate).max().unwrap_or(Magnitude::ZERO)
    }
}

/// What is known of a node at the start of a cell.
#[derive(Clone, Copy)]
pub struct Known<'a> {
    pub passivity: &'a Passivity,
    pub state: &'a [Number],
    /// Of each block of the state.
    pub errors: &'a [StateError],
}

impl<'a> Known<'a> {
    /// Each block with its part of the state and its error.
    pub fn blocks(self) -> impl Iterator<Item = (&'a Block, Vec<Number>, &'a StateError)> {
        let blocks = self.passivity.blocks.iter().zip(self.errors);
        blocks.map(move |(block, error)| (block, block.of(self.state), error))
    }
}

/// The masses and stiffnesses of a state: it holds the energy `½ Σ w y²`.
fn weights(node: &Node<Number>, system: &System<Number>, pressed: &[Pressed]) -> Vec<Number> {
    let mass = |group: &usize| {
        let runs = (0..node.runs()).filter(|run| system.group[*run] == *group);
        runs.fold(Number::zero(), |sum, run| sum.add(&node.mass_of(run, BITS), BITS))
    };
    let mut weights: Vec<Number> = system.heavy.iter().map(mass).collect();
    for (own, kept) in node.elements.iter().zip(&system.kept) {
        let Some(kept) = kept else { continue };
        weights.push(match pressed.iter().find(|pressed| pressed.state == *kept) {
            Some(pressed) => pressed.stiffness.clone(),
            None => own.law.resistance().expect("what is kept is elastic")[0].clone(),
        });
    }
    weights
}

impl Block {
    fn new(
        system: &System<Number>,
        members: Vec<usize>,
        weights: &[Number],
    ) -> Result<Block, BallError> {
        let states = system.states();
        let own: Vec<Ball> = members.iter().map(|i| weights[*i].ball(BITS)).collect();
        let inverses = own.iter().map(|weight| weight.reciprocal(BITS));
        let inverses = inverses.collect::<Result<Vec<Ball>, _>>()?;
        let entry = |i: usize, j: usize| system.change[i][j].ball(BITS);
        let matrix: Matrix =
            members.iter().map(|i| members.iter().map(|j| entry(*i, *j)).collect()).collect();
        let column = |j: usize| {
            let squares = members.iter().zip(&own).map(|(i, weight)| {
                let size = system.change[*i][j].magnitude();
                size.multiply(&size).multiply(&weight.magnitude())
            });
            squares.fold(Magnitude::ZERO, |sum, square| sum.add(&square)).square_root()
        };
        let rate = norm(&matrix, &own, &inverses);
        Ok(Block {
            roots: own.iter().map(|weight| weight.magnitude().square_root()).collect(),
            inverse_roots: inverses
                .iter()
                .map(|inverse| inverse.magnitude().square_root())
                .collect(),
            driven: (states..states + system.inputs()).map(column).collect(),
            decay: decay(matrix, &rate, &own, &inverses),
            rate,
            members,
            separations: Vec::new(),
            pressed: Vec::new(),
        })
    }

    /// With those of these contacts that belong to it.
    fn with_pressed(mut self, pressed: &[Pressed]) -> Block {
        let own = pressed.iter().filter(|pressed| self.members.contains(&pressed.state));
        self.pressed = own.cloned().collect();
        self
    }

    /// The largest ratio of a size in these weights to that in others, at least one.
    fn stretch_of(&self, before: &Block) -> Magnitude {
        let both = self.roots.iter().zip(&before.inverse_roots);
        let stretches = both.map(|(root, inverse)| root.multiply(inverse));
        stretches.fold(Magnitude::ZERO, Magnitude::max)
    }

    /// Its part of a state.
    fn of(&self, state: &[Number]) -> Vec<Number> {
        self.members.iter().map(|member| state[*member].clone()).collect()
    }

    /// `|B_j|` of an input.
    pub fn pushed_by(&self, input: usize) -> &Magnitude {
        &self.driven[input]
    }

    /// Whether nothing changes it.
    pub fn is_still(&self) -> bool {
        self.rate.is_zero() && self.driven.iter().all(Magnitude::is_zero)
    }

    /// Whether an input acts on it.
    pub fn is_driven_by(&self, input: usize) -> bool {
        !self.driven[input].is_zero()
    }

    /// How long what drives it during this time is felt at the end, `∫ |e^(Ax)| dx` at most: with a time `τ` after
    /// which half is left, `2τ`.
    pub fn memory(&self, length: &Magnitude) -> Magnitude {
        match &self.decay {
            Some((time, _)) => (*length).min(Magnitude::power_of_two(time + 1)),
            None => *length,
        }
    }

    /// The slow motions for a cell that is too long for a Taylor polynomial of all: as many as it is not too long for.
    pub fn separation_on(&self, length: &Magnitude) -> Option<&Separation> {
        let slow = || self.separations.iter().rev().find(|own| !is_stiff(&own.rate, length));
        if self.is_stiff_on(length) { slow() } else { None }
    }

    /// Whether a cell is too long for a Taylor polynomial.
    pub fn is_stiff_on(&self, length: &Magnitude) -> bool {
        is_stiff(&self.rate, length)
    }

    /// The size of a small matrix, `√Σ (√wᵢ Mᵢⱼ/√wⱼ)²`.
    fn norm_of(&self, rows: &Rows) -> Magnitude {
        let row = |row: &Vec<Number>| {
            let entries = row.iter().zip(&self.inverse_roots);
            root_of_squares(entries.map(|(entry, root)| entry.magnitude().multiply(root)))
        };
        self.size(rows.iter().map(row))
    }

    /// `|B u|` for inputs of these sizes.
    pub fn push(&self, sizes: &[Magnitude]) -> Magnitude {
        let terms = self.driven.iter().zip(sizes).map(|(column, size)| column.multiply(size));
        terms.fold(Magnitude::ZERO, |sum, term| sum.add(&term))
    }

    /// The size of a state, by the sizes of its entries.
    pub fn size(&self, entries: impl Iterator<Item = Magnitude>) -> Magnitude {
        root_of_squares(self.roots.iter().zip(entries).map(|(root, entry)| root.multiply(&entry)))
    }

    /// A state without radii, and the size of those of its exact entries: the radius of an enclosure is within the error
    /// of the block.
    pub fn rounded(&self, own: &[Number], bits: u64) -> (Vec<Number>, Magnitude) {
        let (middles, radii): (Vec<Number>, Vec<Magnitude>) =
            own.iter().map(|value| value.split(bits)).unzip();
        let of_exact = own.iter().zip(radii).map(|(value, radius)| match value.exact() {
            Some(_) => radius,
            None => Magnitude::ZERO,
        });
        (middles, self.size(of_exact))
    }

    /// What an entry is at most in a state of this size.
    pub fn entry(&self, place: usize, size: &Magnitude) -> Magnitude {
        self.inverse_roots[place].multiply(size)
    }
}

/// After which time an error of a state is at most half as large, and how large it is then.
fn decay(
    mut matrix: Matrix,
    rate: &Magnitude,
    weights: &[Ball],
    inverses: &[Ball],
) -> Option<(i64, Magnitude)> {
    let time = 1 - rate.top()?;
    let scale = Ball::new(Magnitude::power_of_two(time).to_binary(), Magnitude::ZERO);
    for entry in matrix.iter_mut().flatten() {
        *entry = entry.multiply(&scale, BITS);
    }
    let size = matrix.len();
    let unit = |i: usize, j: usize| Ball::from_integer(&i32::from(i == j).into());
    let mut sum: Matrix = (0..size).map(|i| (0..size).map(|j| unit(i, j)).collect()).collect();
    let mut power = sum.clone();
    for k in 1..TERMS {
        let inverse = Ball::from_integer(&k.into()).reciprocal(BITS).ok()?;
        power = product(&power, &matrix);
        for (power, sum) in power.iter_mut().flatten().zip(sum.iter_mut().flatten()) {
            *power = power.multiply(&inverse, BITS);
            *sum = sum.add(power, BITS);
        }
    }
    // e^(2A) = (e^A)², of which twice as much is left out, and a little.
    for doubled in 0..MOST_DOUBLINGS {
        let left_out = Magnitude::power_of_two(TERMS_LEFT_OUT + 2 * doubled);
        let after = norm(&sum, weights, inverses).add(&left_out);
        if after <= Magnitude::power_of_two(-1) {
            return Some((time + doubled, after));
        }
        sum = product(&sum, &sum);
    }
    None
}

/// A bound of the size of an error of the state of a block, as it goes from cell to cell: what it was at an
/// earlier instant, how long ago that is at least, and what came since.
#[derive(Clone, Debug)]
pub struct StateError {
    earlier: Magnitude,
    since: f64,
    added: Magnitude,
}

impl StateError {
    pub fn new(size: Magnitude) -> StateError {
        StateError { earlier: size, since: 0.0, added: Magnitude::ZERO }
    }

    /// That of a state of which enclosures are known.
    pub fn of(block: &Block, values: &[Number]) -> StateError {
        let radius = |value: &Number| match value {
            Number::Exact(_) => Magnitude::ZERO,
            Number::Enclosed(ball) => *ball.radius(),
        };
        StateError::new(block.size(values.iter().map(radius)))
    }

    /// The same, of which it is known that it is no larger than this.
    pub fn at_most(self, size: &Magnitude) -> StateError {
        if self.size() > *size { StateError::new(*size) } else { self }
    }

    /// Now.
    pub fn size(&self) -> Magnitude {
        self.earlier.add(&self.added)
    }

    /// After a time, and with what came meanwhile.
    pub fn after(mut self, length: &Number, added: &Magnitude, block: &Block) -> StateError {
        self.added = self.added.add(added);
        let Some((time, left)) = &block.decay else { return self };
        let (length, bound) = length.ball(BITS).to_double();
        self.since += ((length - bound.to_double()) * (1.0 - f64::EPSILON)).max(0.0);
        // Less than what roundings of the sum may have added.
        let times = self.since / (*time as f64).exp2() * (1.0 - 1e-9);
        if times.is_finite() && times >= 1.0 {
            let earlier = (0..(times as u64).min(MOST_TIMES))
                .fold(self.earlier, |earlier, _| earlier.multiply(left));
            return StateError::new(earlier.add(&self.added));
        }
        self
    }
}

/// What is left after so many of these times is nothing to speak of.
const MOST_TIMES: u64 = 64;

impl Truncation {
    /// A bound of the norm of the error of a block on a cell, by its size there and by what drives it: for
    /// `y' = A y + B u` with `4 ‖A‖ ≤ γ` the derivatives obey
    /// `|y^(j+1)|/γ^(j+1) ≤ |y^(j)|/γ^j/4 + ‖B u‖/γ`.
    pub fn driven(&self, largest: &Magnitude, drive: &Magnitude) -> Magnitude {
        (*largest).max(drive.multiply(&Magnitude::from_u64(4)).divide(3).scale(-self.rate))
    }
}
