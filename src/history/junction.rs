//! A node in one state of its contacts, as a linear system of differential equations.
//!
//! With `w` the wave that arrives in a bar of impedance `Z`, its force on the node that moves with `v` is
//! `Z (2w − v)`. The state `y` holds the velocities of what has a mass and the compressions of springs and
//! supports, and changes with `y' = A y + B u`; velocities and contact forces are `C y + D u`. The input
//! `u` holds the arriving waves and the loads.

use crate::ball::{Magnitude, Number};
use crate::history::error::{HistoryError, NotFollowed};
use crate::history::node::{Link, Node};
use crate::history::series::{Series, Truncation};

/// A node whose contacts are open or closed.
///
/// # Invariants
/// Runs of one group move together. Every group without mass that is not held is resisted by a bar or a
/// damper.
pub(crate) struct Junction {
    /// The group of each run.
    group: Vec<usize>,
    groups: usize,
    /// The mass of each group.
    mass: Vec<Number>,
    held: Vec<bool>,
    /// Groups with a mass that move freely, in the order of the state.
    heavy: Vec<usize>,
    massless: Vec<usize>,
    /// The inverse of what resists the velocities of groups without mass.
    inverse: Vec<Vec<Number>>,
    /// Which springs and supports have a compression; others are unloaded ends.
    pub active: Vec<bool>,
    /// `[A B]` by rows, and `[C D]`: velocities of runs, then forces of closed contacts.
    change: Vec<Vec<Number>>,
    output: Vec<Vec<Number>>,
    /// The closed contacts with the runs at their left.
    pub closed: Vec<(usize, usize)>,
    bits: u64,
}

/// What a node does on a cell.
pub(crate) struct Motion {
    /// The state.
    pub state: Vec<Series>,
    /// The velocity of each run.
    pub velocities: Vec<Series>,
    /// The force of each closed contact, as they stand in [`Junction::closed`].
    pub forces: Vec<Series>,
}

/// The inverse of a small matrix that is positive definite, by elimination.
fn inverse(mut matrix: Vec<Vec<Number>>, bits: u64) -> Option<Vec<Vec<Number>>> {
    let size = matrix.len();
    let unit = |i, j| if i == j { Number::one() } else { Number::zero() };
    let mut result: Vec<Vec<Number>> =
        (0..size).map(|i| (0..size).map(|j| unit(i, j)).collect()).collect();
    for i in 0..size {
        let pivot = matrix[i][i].reciprocal(bits).ok()?;
        for entry in matrix[i].iter_mut().chain(&mut result[i]) {
            *entry = entry.multiply(&pivot, bits);
        }
        for row in (0..size).filter(|row| *row != i) {
            let factor = matrix[row][i].clone();
            for rows in [&mut matrix, &mut result] {
                let above = rows[i].clone();
                for (entry, above) in rows[row].iter_mut().zip(above) {
                    *entry = entry.subtract(&factor.multiply(&above, bits), bits);
                }
            }
        }
    }
    Some(result)
}

fn dot(row: &[Number], values: &[Number], bits: u64) -> Number {
    let terms = row.iter().zip(values).filter(|(a, b)| !a.is_zero() && !b.is_zero());
    terms.fold(Number::zero(), |sum, (a, b)| sum.add(&a.multiply(b, bits), bits))
}

impl Junction {
    /// The system of a node with these contacts closed.
    ///
    /// # Errors
    /// [`HistoryError::Refused`] where something without mass moves against nothing.
    pub fn of(
        node: &Node,
        is_closed: impl Fn(usize) -> bool,
        place: &str,
        bits: u64,
    ) -> Result<Junction, HistoryError> {
        let runs = node.runs();
        let closed: Vec<(usize, usize)> =
            node.contacts().filter(|(contact, _)| is_closed(*contact)).collect();
        let mut joined: Vec<bool> =
            (0..runs - 1).map(|run| closed.iter().any(|(_, own)| *own == run)).collect();
        let mut active: Vec<bool> =
            node.yields().map(|(_, own, _)| !own.stiffness.is_zero()).collect();
        // An undamped spring beside an open contact, with nothing else at its end, carries no force.
        while let Some(run) = loose(node, &joined, bits) {
            let number = node.yields().position(|(own, _, spring)| spring && own == run);
            active[number.expect("a spring")] = false;
            joined[run] = true;
        }
        let mut group = vec![0];
        for run in 1..runs {
            group.push(group[run - 1] + usize::from(!joined[run - 1]));
        }
        let groups = group[runs - 1] + 1;
        let (mut mass, mut held) = (vec![Number::zero(); groups], vec![false; groups]);
        for run in 0..runs {
            mass[group[run]] = mass[group[run]].add(&node.mass_of(run, bits), bits);
            held[group[run]] |= node.held[run];
        }
        let free = |group: &usize| !held[*group];
        let heavy: Vec<usize> =
            (0..groups).filter(free).filter(|group| !mass[*group].is_zero()).collect();
        let massless: Vec<usize> =
            (0..groups).filter(free).filter(|group| mass[*group].is_zero()).collect();
        let mut junction = Junction {
            group,
            groups,
            mass,
            held,
            heavy,
            massless,
            inverse: Vec::new(),
            active,
            change: Vec::new(),
            output: Vec::new(),
            closed,
            bits,
        };
        let resistance = junction.resistance(node);
        let row = |row: &usize| -> Vec<Number> {
            junction.massless.iter().map(|column| resistance[*row][*column].clone()).collect()
        };
        let matrix = junction.massless.iter().map(row).collect();
        junction.inverse = inverse(matrix, bits)
            .ok_or_else(|| NotFollowed::Massless { place: place.to_owned() })?;
        junction.set_matrices(node);
        Ok(junction)
    }

    /// How the forces on groups fall with their velocities.
    fn resistance(&self, node: &Node) -> Vec<Vec<Number>> {
        let bits = self.bits;
        let mut resistance = vec![vec![Number::zero(); self.groups]; self.groups];
        let mut add = |row: usize, column: usize, value: Number| {
            resistance[row][column] = resistance[row][column].add(&value, bits);
        };
        for (run, impedance) in node.side_runs().into_iter().zip(&node.impedance) {
            add(self.group[run], self.group[run], impedance.clone());
        }
        for (run, own, spring) in node.yields() {
            let left = self.group[run];
            add(left, left, own.damping.clone());
            if spring {
                let right = self.group[run + 1];
                add(right, right, own.damping.clone());
                add(left, right, own.damping.negate());
                add(right, left, own.damping.negate());
            }
        }
        resistance
    }

    /// How many entries the state has: velocities, then compressions.
    pub fn states(&self) -> usize {
        self.heavy.len() + self.active.iter().filter(|active| **active).count()
    }

    /// The place of a compression in the state.
    pub fn place_of_yield(&self, number: usize) -> Option<usize> {
        let before = self.active[..number].iter().filter(|active| **active).count();
        self.active[number].then(|| self.heavy.len() + before)
    }

    /// Whether the group of a run has a mass of its own, or is held.
    pub fn has_inertia(&self, run: usize) -> bool {
        let group = self.group[run];
        self.held[group] || self.heavy.contains(&group)
    }

    /// The velocity of a run that moves with a mass.
    pub fn velocity_of(&self, run: usize, state: &[Number]) -> Option<Number> {
        let place = self.heavy.iter().position(|group| *group == self.group[run])?;
        Some(state[place].clone())
    }

    /// The velocities of groups from the state and the inputs.
    fn velocities(&self, node: &Node, state: &[Number], input: &[Number]) -> Vec<Number> {
        let bits = self.bits;
        let mut velocities = vec![Number::zero(); self.groups];
        for (group, value) in self.heavy.iter().zip(state) {
            velocities[*group] = value.clone();
        }
        let forces = self.forces(node, &velocities, state, input);
        let rest: Vec<Number> = (self.massless.iter())
            .map(|group| {
                let own = (0..node.runs()).filter(|run| self.group[*run] == *group);
                own.fold(Number::zero(), |sum, run| sum.add(&forces[run], bits))
            })
            .collect();
        for (group, row) in self.massless.iter().zip(&self.inverse) {
            velocities[*group] = dot(row, &rest, bits);
        }
        velocities
    }

    /// The forces on runs, but for those of contacts.
    fn forces(
        &self,
        node: &Node,
        velocities: &[Number],
        state: &[Number],
        input: &[Number],
    ) -> Vec<Number> {
        let bits = self.bits;
        let mut forces = input[2..].to_vec();
        let two = Number::integer(2);
        for (side, run) in node.side_runs().into_iter().enumerate() {
            let moved = input[side].multiply(&two, bits);
            let moved = moved.subtract(&velocities[self.group[run]], bits);
            let force = node.impedance[side].multiply(&moved, bits);
            forces[run] = forces[run].add(&force, bits);
        }
        for (number, (run, own, spring)) in node.yields().enumerate() {
            let mut rate = velocities[self.group[run]].clone();
            if spring {
                rate = rate.subtract(&velocities[self.group[run + 1]], bits);
            }
            let mut force = own.damping.multiply(&rate, bits);
            if let Some(place) = self.place_of_yield(number) {
                force = force.add(&own.stiffness.multiply(&state[place], bits), bits);
            }
            forces[run] = forces[run].subtract(&force, bits);
            if spring {
                forces[run + 1] = forces[run + 1].add(&force, bits);
            }
        }
        forces
    }

    /// The matrices, column by column.
    fn set_matrices(&mut self, node: &Node) {
        let bits = self.bits;
        let (states, inputs) = (self.states(), 2 + node.runs());
        let rows = node.runs() + self.closed.len();
        let mut change = vec![Vec::new(); states];
        let mut output = vec![Vec::new(); rows];
        for column in 0..states + inputs {
            let unit = |i: usize| if i == column { Number::one() } else { Number::zero() };
            let state: Vec<Number> = (0..states).map(unit).collect();
            let input: Vec<Number> = (states..states + inputs).map(unit).collect();
            let velocities = self.velocities(node, &state, &input);
            let forces = self.forces(node, &velocities, &state, &input);
            let mut accelerations = vec![Number::zero(); self.groups];
            for group in &self.heavy {
                let own = (0..node.runs()).filter(|run| self.group[*run] == *group);
                let sum = own.fold(Number::zero(), |sum, run| sum.add(&forces[run], bits));
                let inverse = self.mass[*group].reciprocal(bits).expect("a positive mass");
                accelerations[*group] = sum.multiply(&inverse, bits);
            }
            for (row, group) in self.heavy.iter().enumerate() {
                change[row].push(accelerations[*group].clone());
            }
            for (number, (run, _, spring)) in node.yields().enumerate() {
                let Some(row) = self.place_of_yield(number) else { continue };
                let mut rate = velocities[self.group[run]].clone();
                if spring {
                    rate = rate.subtract(&velocities[self.group[run + 1]], bits);
                }
                change[row].push(rate);
            }
            for run in 0..node.runs() {
                output[run].push(velocities[self.group[run]].clone());
            }
            for (row, (_, run)) in self.closed.iter().enumerate() {
                let force = self.contact_force(node, *run, &forces, &accelerations);
                output[node.runs() + row].push(force);
            }
        }
        (self.change, self.output) = (change, output);
    }

    /// The force of a closed contact: what presses on the runs at its left, less what accelerates them;
    /// from the right where the left is held.
    fn contact_force(
        &self,
        node: &Node,
        run: usize,
        forces: &[Number],
        accelerations: &[Number],
    ) -> Number {
        let bits = self.bits;
        let group = self.group[run];
        let member = |other: &usize| self.group[*other] == group;
        let held_left = (0..=run).filter(member).any(|run| node.held[run]);
        let side: Vec<usize> = match held_left {
            false => (0..=run).filter(member).collect(),
            true => (run + 1..node.runs()).filter(member).collect(),
        };
        let mut sum = Number::zero();
        for run in side {
            let inertia = node.mass_of(run, bits).multiply(&accelerations[group], bits);
            sum = sum.add(&forces[run], bits).subtract(&inertia, bits);
        }
        if held_left { sum.negate() } else { sum }
    }

    /// A bound of `‖A‖` and of what loads and waves of size 1 change, `‖B‖`, in the maximum norm.
    pub fn norms(&self) -> (Magnitude, Magnitude) {
        let states = self.states();
        let sum = |row: &[Number]| {
            row.iter().fold(Magnitude::ZERO, |sum, entry| sum.add(&entry.magnitude()))
        };
        let largest = |part: fn(&[Number], usize) -> &[Number]| {
            let rows = self.change.iter().map(|row| sum(part(row, states)));
            rows.max().unwrap_or(Magnitude::ZERO)
        };
        (largest(|row, n| &row[..n]), largest(|row, n| &row[n..]))
    }

    /// Solves the equations on a cell: `(k+1) y_(k+1) = A y_k + B u_k`.
    ///
    /// The rest: `|u_k| ≤ m γ^k/k!` and `|y_k| ≤ M γ^k/k!` give
    /// `|y_(k+1)| ≤ (‖A‖ M + ‖B‖ m)/γ · γ^(k+1)/(k+1)!`; with `γ ≥ 4‖A‖` the bound goes on from one
    /// coefficient to the next where `M ≥ ‖B‖ m · 4/(3γ)` and `M ≥ |y_N| N!/γ^N`.
    ///
    /// # Cost
    /// N times the products of small matrices with vectors.
    pub fn solve(&self, state: Vec<Number>, input: &[Series], cut: &Truncation) -> Motion {
        let polynomial = input.iter().all(|series| series.rest.is_zero());
        let degree = input.iter().map(|series| series.coefficients.len()).max().unwrap_or(0);
        let exact = state.iter().all(|value| value.exact().is_some())
            && input.iter().all(Series::is_exact)
            && degree <= 4;
        if exact || state.is_empty() {
            let few = if state.is_empty() { cut.order } else { degree + 4 };
            let (columns, next) = self.columns(state.clone(), input, few.min(cut.order));
            if state.is_empty() || next.iter().all(Number::is_zero) && polynomial {
                return self.motion(columns, Magnitude::ZERO, input, cut);
            }
        }
        let state = state.iter().map(|value| value.enclosed(cut.bits)).collect();
        let (columns, next) = self.columns(state, input, cut.order);
        let rest = input.iter().map(|series| series.rest).max().unwrap_or(Magnitude::ZERO);
        let (_, norm) = self.norms();
        let forced = norm.multiply(&rest).scale(2 - cut.rate).divide(3);
        let next = next.iter().map(Number::magnitude).max().unwrap_or(Magnitude::ZERO);
        self.motion(columns, forced.max(cut.factor(&next)), input, cut)
    }

    /// The first coefficients of the state, and the next one.
    fn columns(
        &self,
        state: Vec<Number>,
        input: &[Series],
        order: usize,
    ) -> (Vec<Vec<Number>>, Vec<Number>) {
        let mut columns: Vec<Vec<Number>> = Vec::with_capacity(order);
        let mut next = state;
        for k in 0..order {
            let mut both = next.clone();
            both.extend(input.iter().map(|series| series.coefficient(k)));
            let changed = self.change.iter();
            let after: Vec<Number> = changed
                .map(|row| dot(row, &both, self.bits).over(k as u64 + 1, self.bits))
                .collect();
            columns.push(std::mem::replace(&mut next, after));
        }
        (columns, next)
    }

    fn motion(
        &self,
        columns: Vec<Vec<Number>>,
        rest: Magnitude,
        input: &[Series],
        cut: &Truncation,
    ) -> Motion {
        let bits = cut.bits;
        let state = |i: usize| {
            // On what nothing acts, nothing changes: it has no rest.
            let (own, forced) = self.change[i].split_at(self.states());
            let mut forced = forced.iter().zip(input);
            let still = own.iter().all(Number::is_zero)
                && forced.all(|(c, input)| c.is_zero() || input.is_zero());
            let rest = match still {
                true => Magnitude::ZERO,
                false => rest,
            };
            Series::new(columns.iter().map(|column| column[i].clone()).collect(), rest)
        };
        let states: Vec<Series> = (0..self.states()).map(state).collect();
        let mut outputs = self.output.iter().map(|row| {
            let parts = states.iter().chain(input).zip(row).filter(|(_, c)| !c.is_zero());
            parts.fold(Series::zero(), |sum, (part, c)| sum.combine(&Number::one(), part, c, bits))
        });
        let velocities = outputs.by_ref().take(self.group.len()).collect();
        let forces = outputs.collect();
        Motion { state: states, velocities, forces }
    }

    /// The state that continues with these velocities of runs and compressions.
    ///
    /// # Errors
    /// [`HistoryError::Refused`] where rigid masses of different velocities meet.
    pub fn state(
        &self,
        node: &Node,
        velocity: impl Fn(usize) -> Option<Number>,
        yielded: &[Number],
        place: &str,
    ) -> Result<Vec<Number>, HistoryError> {
        let mut state = Vec::with_capacity(self.states());
        for group in &self.heavy {
            let own = (0..node.runs()).filter(|run| self.group[*run] == *group);
            let mut own = own.filter(|run| !node.mass_of(*run, self.bits).is_zero());
            let first = own.next().and_then(&velocity).expect("a mass has a velocity");
            for run in own {
                if velocity(run).is_none_or(|other| other != first) {
                    return Err(NotFollowed::RigidImpact { place: place.to_owned() }.into());
                }
            }
            state.push(first);
        }
        let active = yielded.iter().zip(&self.active).filter(|(_, active)| **active);
        state.extend(active.map(|(value, _)| value.clone()));
        Ok(state)
    }
}

/// An undamped spring that has nothing but open contacts at one end, by the run at its left.
fn loose(node: &Node, joined: &[bool], bits: u64) -> Option<usize> {
    // The first and the last run that move with one.
    let group_of = |run: usize| {
        let (mut first, mut last) = (run, run);
        while first > 0 && joined[first - 1] {
            first -= 1;
        }
        while last < joined.len() && joined[last] {
            last += 1;
        }
        (first, last)
    };
    let is_bare = |(first, last): (usize, usize), spring: usize| {
        let inside = |run: usize| first <= run && run <= last;
        let mut sides = node.side_runs().into_iter().zip(&node.impedance);
        let resisted = sides.any(|(run, impedance)| inside(run) && !impedance.is_zero());
        let heavy = (first..=last).any(|run| !node.mass_of(run, bits).is_zero() || node.held[run]);
        let others = node.yields().any(|(run, _, is_spring)| {
            let touches = inside(run) || is_spring && inside(run + 1);
            let within = is_spring && inside(run) && inside(run + 1);
            touches && !within && !(is_spring && run == spring)
        });
        let loaded = node.loads.iter().any(|load| inside(load.run));
        !(resisted || heavy || others || loaded)
    };
    let springs = node.links.iter().enumerate().filter_map(|(run, link)| match link {
        Link::Spring(own) if own.damping.is_zero() && !joined[run] => Some(run),
        _ => None,
    });
    // One that is bare at both ends would fly alone.
    springs
        .into_iter()
        .find(|run| is_bare(group_of(*run), *run) != is_bare(group_of(run + 1), *run))
}
