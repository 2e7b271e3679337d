//! The law of a node as a linear system of differential equations, in numbers.
//!
//! With `w` the wave that arrives in a bar of impedance `Z`, the force of the bar on a run that moves with
//! `v` is `Z (2w − v)`, and what leaves is `v − w`: no derivative of a delayed function occurs. The state `y`
//! holds the velocities of what has a mass and the displacements of what yields, and changes with
//! `y' = A y + B u`; velocities of runs and forces of closed contacts are `C y + D u`. The input `u` holds
//! the two arriving waves, then what each load does and the force in each local contact.

use crate::ball::Arithmetic;
use crate::network::node::{Acting, ElementLaw, Link, Lumped, Node};
use crate::scene::Drive;

/// Something without mass moves, and nothing resists it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Unresisted;

/// A node whose contacts are open or closed.
///
/// # Invariants
/// The rows of `change` belong to the state: the velocities of `heavy` groups, then the displacements that
/// are `kept`. The rows of `output` are the velocities of all runs, then the forces of `closed` contacts. All
/// rows are as long as state and input together.
#[derive(Clone, Debug)]
pub struct System<V> {
    /// The group of each run: runs of one group move together.
    pub group: Vec<usize>,
    /// The groups that are held, or moved by a load.
    pub held: Vec<bool>,
    /// Groups with a mass that move freely.
    pub heavy: Vec<usize>,
    /// Where the displacement of each element of the node stands in the state. Dampers alone have none,
    /// and springs without load and local contacts that are open.
    pub kept: Vec<Option<usize>>,
    /// Where each load and local contact of the node stands in the input.
    pub driven: Vec<Option<usize>>,
    /// `[A B]` by rows.
    pub change: Vec<Vec<V>>,
    /// `[C D]` by rows.
    pub output: Vec<Vec<V>>,
    /// The closed contacts with the runs at their left.
    pub closed: Vec<(usize, usize)>,
}

impl<V> System<V> {
    /// How many entries the state has.
    pub fn states(&self) -> usize {
        self.change.len()
    }

    /// How many entries the input has.
    pub fn inputs(&self) -> usize {
        2 + self.driven.iter().flatten().count()
    }

    /// The place of the velocity of a run in the state, where it moves with a mass.
    pub fn place_of_velocity(&self, run: usize) -> Option<usize> {
        self.heavy.iter().position(|group| *group == self.group[run])
    }

    /// The same system with other numbers.
    pub fn map<W>(&self, value: impl Fn(&V) -> W) -> System<W> {
        let rows = |rows: &[Vec<V>]| -> Vec<Vec<W>> {
            rows.iter().map(|row| row.iter().map(&value).collect()).collect()
        };
        System {
            group: self.group.clone(),
            held: self.held.clone(),
            heavy: self.heavy.clone(),
            kept: self.kept.clone(),
            driven: self.driven.clone(),
            change: rows(&self.change),
            output: rows(&self.output),
            closed: self.closed.clone(),
        }
    }

    /// Whether a run moves with a mass, or is held.
    pub fn has_inertia(&self, run: usize) -> bool {
        self.held[self.group[run]] || self.place_of_velocity(run).is_some()
    }
}

/// The inverse of a small matrix, by elimination; none where it is not known to have one.
pub fn inverse<V: Arithmetic>(mut matrix: Vec<Vec<V>>, bits: u64) -> Option<Vec<Vec<V>>> {
    let size = matrix.len();
    let unit = |i, j| if i == j { V::one() } else { V::zero() };
    let mut result: Vec<Vec<V>> =
        (0..size).map(|i| (0..size).map(|j| unit(i, j)).collect()).collect();
    for i in 0..size {
        let largest = (i..size).max_by_key(|row| matrix[*row][i].magnitude())?;
        matrix.swap(i, largest);
        result.swap(i, largest);
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

/// A row times a column.
pub fn dot<V: Arithmetic>(row: &[V], column: &[V], bits: u64) -> V {
    let terms = row.iter().zip(column).filter(|(a, b)| !a.is_zero() && !b.is_zero());
    terms.fold(V::zero(), |sum, (a, b)| sum.add(&a.multiply(b, bits), bits))
}

impl<V: Arithmetic> Node<V> {
    pub fn mass_of(&self, run: usize, bits: u64) -> V {
        let masses = self.attached(run).filter_map(|own| match &own.law {
            ElementLaw::Mass { mass, .. } => Some(mass),
            _ => None,
        });
        masses.fold(V::zero(), |sum, mass| sum.add(mass, bits))
    }
}

impl<V: Arithmetic> ElementLaw<V> {
    /// Whether its displacement is part of the state: not that of a damper alone.
    fn remembers(&self) -> bool {
        match self {
            ElementLaw::LocalContact { .. } => true,
            _ => self.resistance().is_some_and(|[stiffness, _]| !stiffness.is_zero()),
        }
    }
}

impl<V: Arithmetic> System<V> {
    /// The system of a node with these contacts closed.
    pub fn of(
        node: &Node<V>,
        is_closed: impl Fn(usize) -> bool,
        bits: u64,
    ) -> Result<System<V>, Unresisted> {
        let closed: Vec<(usize, usize)> = (node.contacts())
            .filter(|(contact, run)| {
                matches!(node.links[*run], Link::Contact(_)) && is_closed(*contact)
            })
            .collect();
        let mut joined: Vec<bool> =
            (0..node.links.len()).map(|link| closed.iter().any(|(_, own)| *own == link)).collect();
        let mut idle = vec![false; node.elements.len()];
        for link in &node.links {
            if let Link::Local { contact, place } = link {
                idle[*place] = !is_closed(*contact);
            }
        }
        // An undamped spring beside an open contact, with nothing else at its end, carries no force.
        while let Some(link) = loose(node, &joined) {
            if let Link::Element(place) = node.links[link] {
                idle[place] = true;
            }
            joined[link] = true;
        }
        let mut group = vec![0];
        for (run, joined) in joined.iter().enumerate() {
            group.push(group[run] + usize::from(!joined));
        }
        // What undamped supports alone hold goes back to where they carry no force, and rests there.
        let resting: Vec<usize> =
            (0..=group[joined.len()]).filter(|own| is_propped(node, &group, &idle, *own)).collect();
        for (own, idle) in node.elements.iter().zip(&mut idle) {
            *idle |= !own.law.is_link() && resting.contains(&group[own.run]);
        }
        let mut law = Law::of(node, group, &idle, bits);
        resting.into_iter().for_each(|group| law.held[group] = true);
        law.system(closed)
    }
}

/// The balances of a node while its system is made.
struct Law<'a, V> {
    node: &'a Node<V>,
    group: Vec<usize>,
    groups: usize,
    /// The mass of each group.
    mass: Vec<V>,
    held: Vec<bool>,
    heavy: Vec<usize>,
    kept: Vec<Option<usize>>,
    driven: Vec<Option<usize>>,
    bits: u64,
}

/// The motion that one entry of state and input goes with.
struct Motion<'a, V> {
    state: &'a [V],
    input: &'a [V],
    /// The velocity of each group.
    velocities: Vec<V>,
}

impl<V: Arithmetic> Law<'_, V> {
    fn of<'a>(node: &'a Node<V>, group: Vec<usize>, idle: &[bool], bits: u64) -> Law<'a, V> {
        let groups = group.last().expect("one run at least") + 1;
        let (mut mass, mut held) = (vec![V::zero(); groups], vec![false; groups]);
        for (run, group) in group.iter().enumerate() {
            mass[*group] = mass[*group].add(&node.mass_of(run, bits), bits);
            held[*group] |= node.is_imposed(run);
        }
        let free = |group: &usize| !held[*group] && !mass[*group].is_zero();
        let heavy: Vec<usize> = (0..groups).filter(free).collect();
        let mut states = heavy.len()..;
        let kept = |(own, idle): (&Lumped<V>, &bool)| {
            (own.law.remembers() && !idle).then(|| states.next().expect("without end"))
        };
        let kept = node.elements.iter().zip(idle).map(kept).collect();
        let mut inputs = 2..;
        let driven =
            |own: &Lumped<V>| own.law.is_driven().then(|| inputs.next().expect("without end"));
        let driven = node.elements.iter().map(driven).collect();
        Law { node, group, groups, mass, held, heavy, kept, driven, bits }
    }

    /// The sum over the runs of a group.
    fn sum(&self, values: &[V], group: usize) -> V {
        let own = values.iter().zip(&self.group).filter(|(_, own)| **own == group);
        own.fold(V::zero(), |sum, (value, _)| sum.add(value, self.bits))
    }

    /// How fast the displacement of an element grows.
    fn rate(&self, own: &Lumped<V>, motion: &Motion<'_, V>) -> V {
        let velocity = |run: usize| &motion.velocities[self.group[run]];
        match own.law.is_link() {
            true => velocity(own.run).subtract(velocity(own.run + 1), self.bits),
            false => velocity(own.run).clone(),
        }
    }

    /// The force of an element: in a spring or a local contact the one that compresses it.
    fn force_of(&self, place: usize, motion: &Motion<'_, V>) -> V {
        let own = &self.node.elements[place];
        if let Some(input) = self.driven[place] {
            return motion.input[input].clone();
        }
        let Some([stiffness, damping]) = own.law.resistance() else { return V::zero() };
        let damped = damping.multiply(&self.rate(own, motion), self.bits);
        match self.kept[place] {
            Some(state) => {
                damped.add(&stiffness.multiply(&motion.state[state], self.bits), self.bits)
            }
            None => damped,
        }
    }

    /// The forces on runs: all terms of their balances but inertia and the forces of contacts.
    fn forces(&self, motion: &Motion<'_, V>) -> Vec<V> {
        let bits = self.bits;
        let compressive = |run: usize, acting: Acting| match acting {
            Acting::Side(side) => {
                // X = Z (2w − v) at the left and −Z (2w − v) at the right.
                let twice = motion.input[side].add(&motion.input[side], bits);
                let moved = twice.subtract(&motion.velocities[self.group[run]], bits);
                let force = self.node.impedance[side].multiply(&moved, bits);
                if side == 0 { force } else { force.negate() }
            }
            Acting::Link(link) => match self.node.links[link] {
                Link::Contact(_) => V::zero(),
                Link::Element(place) | Link::Local { place, .. } => self.force_of(place, motion),
            },
            Acting::Element(place) => self.force_of(place, motion),
        };
        let force = |run: usize| {
            self.node.acting(run).fold(V::zero(), |sum, (sign, acting)| {
                let term = compressive(run, acting);
                if sign > 0 { sum.add(&term, bits) } else { sum.subtract(&term, bits) }
            })
        };
        (0..self.node.runs()).map(force).collect()
    }

    /// The groups without mass, and the inverse of how the forces on them fall with their velocities.
    fn massless(&self) -> Result<(Vec<usize>, Vec<Vec<V>>), Unresisted> {
        let free = |group: &usize| !self.held[*group] && self.mass[*group].is_zero();
        let massless: Vec<usize> = (0..self.groups).filter(free).collect();
        let nothing = vec![V::zero(); self.columns()];
        let resistance = |moving: &usize| -> Vec<V> {
            let mut velocities = vec![V::zero(); self.groups];
            velocities[*moving] = V::one();
            let motion = Motion { state: &nothing, input: &nothing, velocities };
            let forces = self.forces(&motion);
            massless.iter().map(|group| self.sum(&forces, *group).negate()).collect()
        };
        // The matrix is symmetric.
        let inverse = inverse(massless.iter().map(resistance).collect(), self.bits);
        Ok((massless, inverse.ok_or(Unresisted)?))
    }

    fn states(&self) -> usize {
        self.heavy.len() + self.kept.iter().flatten().count()
    }

    fn columns(&self) -> usize {
        self.states() + 2 + self.driven.iter().flatten().count()
    }

    /// The matrices, column by column.
    fn system(self, closed: Vec<(usize, usize)>) -> Result<System<V>, Unresisted> {
        let bits = self.bits;
        let (massless, inverse) = self.massless()?;
        let (states, runs) = (self.states(), self.node.runs());
        let reciprocal = |group: &usize| self.mass[*group].reciprocal(bits);
        let lightness: Vec<V> =
            self.heavy.iter().map(reciprocal).collect::<Result<_, _>>().map_err(|_| Unresisted)?;
        let mut change = vec![Vec::new(); states];
        let mut output = vec![Vec::new(); runs + closed.len()];
        for column in 0..self.columns() {
            let mut unit = vec![V::zero(); self.columns()];
            unit[column] = V::one();
            let (state, input) = unit.split_at(states);
            let mut motion = Motion { state, input, velocities: self.given(state, input) };
            let forces = self.forces(&motion);
            let rest: Vec<V> = massless.iter().map(|group| self.sum(&forces, *group)).collect();
            for (group, row) in massless.iter().zip(&inverse) {
                motion.velocities[*group] = dot(row, &rest, bits);
            }
            let forces = self.forces(&motion);
            let mut accelerations = vec![V::zero(); self.groups];
            for ((row, group), lightness) in change.iter_mut().zip(&self.heavy).zip(&lightness) {
                accelerations[*group] = self.sum(&forces, *group).multiply(lightness, bits);
                row.push(accelerations[*group].clone());
            }
            for (own, row) in self.node.elements.iter().zip(&self.kept) {
                if let Some(row) = row {
                    change[*row].push(self.rate(own, &motion));
                }
            }
            for (run, group) in self.group.iter().enumerate() {
                output[run].push(motion.velocities[*group].clone());
            }
            for (row, (_, run)) in closed.iter().enumerate() {
                let force = self.contact_force(*run, &forces, &accelerations);
                output[runs + row].push(force);
            }
        }
        let Law { group, held, heavy, kept, driven, .. } = self;
        Ok(System { group, held, heavy, kept, driven, change, output, closed })
    }

    /// The velocities of groups that are states or inputs; zero for the others.
    fn given(&self, state: &[V], input: &[V]) -> Vec<V> {
        let mut velocities = vec![V::zero(); self.groups];
        for (group, value) in self.heavy.iter().zip(state) {
            velocities[*group] = value.clone();
        }
        for (own, driven) in self.node.elements.iter().zip(&self.driven) {
            if let (ElementLaw::Load(Drive::Velocity), Some(driven)) = (&own.law, driven) {
                let velocity = &mut velocities[self.group[own.run]];
                *velocity = velocity.add(&input[*driven], self.bits);
            }
        }
        velocities
    }

    /// The force of a closed contact: what presses on the runs at its left, less what accelerates them. From the right
    /// where the left is held; and where the right alone has no mass, so that nothing cancels.
    fn contact_force(&self, run: usize, forces: &[V], accelerations: &[V]) -> V {
        let group = self.group[run];
        let member = |other: &usize| self.group[*other] == group;
        let [left, right]: [Vec<usize>; 2] = [
            (0..=run).filter(member).collect(),
            (run + 1..self.node.runs()).filter(member).collect(),
        ];
        let is_held = |side: &[usize]| side.iter().any(|run| self.node.is_imposed(*run));
        let mass = |run: &usize| self.node.mass_of(*run, self.bits);
        let is_massless = |side: &[usize]| side.iter().all(|run| mass(run).is_zero());
        let is_light = is_massless(&right) && !is_held(&right) && !is_massless(&left);
        let from_right = is_held(&left) || is_light;
        let mut sum = V::zero();
        for run in if from_right { right } else { left } {
            let inertia = mass(&run).multiply(&accelerations[group], self.bits);
            sum = sum.add(&forces[run], self.bits).subtract(&inertia, self.bits);
        }
        if from_right { sum.negate() } else { sum }
    }
}

/// Whether undamped supports, with springs that are idle, are all that holds runs that move as one.
fn is_propped<V: Arithmetic>(
    node: &Node<V>,
    groups: &[usize],
    idle: &[bool],
    group: usize,
) -> bool {
    let mut runs = (0..node.runs()).filter(|run| groups[*run] == group);
    let is_tied = node.elements.iter().zip(idle).any(|(own, idle)| {
        let ends = [own.run, own.run + 1].map(|run| groups.get(run) == Some(&group));
        own.law.is_link() && !idle && ends[0] != ends[1]
    });
    !is_tied
        && runs.clone().any(|run| node.is_propped(run))
        && runs.all(|run| node.is_bare(run) || node.is_propped(run))
}

/// An undamped spring that has nothing but open contacts at one end, by the run at its left.
fn loose<V: Arithmetic>(node: &Node<V>, joined: &[bool]) -> Option<usize> {
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
        let others = node.elements.iter().any(|own| {
            let leaves = inside(own.run) != inside(own.run + 1);
            own.law.is_link() && own.run != spring && leaves
        });
        (first..=last).all(|run| node.is_bare(run)) && !others
    };
    let mut springs = (0..joined.len()).filter(|link| {
        let law = node.spanning(*link).map(|own| &own.law);
        let undamped = matches!(law, Some(ElementLaw::Spring { damping, .. }) if damping.is_zero());
        undamped && !joined[*link]
    });
    // One that is bare at both ends would fly alone.
    springs.find(|link| is_bare(group_of(*link), *link) != is_bare(group_of(link + 1), *link))
}
