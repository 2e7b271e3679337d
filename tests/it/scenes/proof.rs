//! The laws of mechanics, put to a solution as identities of expressions.
//!
//! From the pieces of the waves all velocities and forces are formed anew, on cells so short that every
//! delay is a whole number of them. Then on every cell: velocities agree where things are joined, forces
//! balance, springs and supports yield as fast as their ends move; momentum changes by what acts from
//! outside, and energy is stored, spent or carried away. Over all arrivals, what has mass or yields goes
//! on where it was.

use num_rational::BigRational;
use num_traits::ToPrimitive;
use wavestep::expression::{Expression, Fraction};
use wavestep::network::{ElementLaw, Lattice, ModelBar, ModelLoad, Network, ObservedValue, Role};
use wavestep::recurrence::{Observation, WaveIndex};
use wavestep::scene::{Drive, ElementIndex, End, Kind};
use wavestep::solution::PeriodByPeriod;
use wavestep_polynomial::Symbol;

/// Functions of the time in a cell, one a cell.
type Cells = Vec<Expression>;

struct Proof<'a> {
    network: &'a Network,
    /// The waves of the recurrence on cells, by their own clocks.
    waves: Vec<Cells>,
    local: Symbol,
    /// The length of a cell.
    length: Fraction,
    count: usize,
}

/// A bar: impedance, and its waves where they leave; velocities and forces at its ends.
struct BarMotion {
    impedance: Expression,
    /// The velocity and the force at the left end and at the right end.
    ends: [(Cells, Cells); 2],
    /// The whole wave that enters on each side, and the same when it leaves; none for an endless end.
    passing: [(Option<Cells>, Option<Cells>); 2],
}

fn expression(value: &Fraction) -> Expression {
    value.clone().into()
}

fn add(sum: &mut Cells, other: &Cells, factor: &Expression) {
    for (sum, other) in sum.iter_mut().zip(other) {
        *sum += &(other * factor);
    }
}

fn zeros(count: usize) -> Cells {
    vec![Expression::zero(); count]
}

fn product(left: &Cells, right: &Cells) -> Cells {
    left.iter().zip(right).map(|(left, right)| left * right).collect()
}

impl<'a> Proof<'a> {
    fn new(network: &'a Network, cells: usize) -> Proof<'a> {
        let recurrence = network.recurrence().unwrap_or_else(|error| panic!("{error}"));
        let statement = recurrence.statement();
        let delays = network.observables().iter().filter_map(|observed| match &observed.value {
            ObservedValue::Linear(seen) if observed.name == "momentum" => Some(seen),
            _ => None,
        });
        let delays = delays.flat_map(|seen| seen.waves.iter().map(|wave| wave.delay.clone()));
        let travels = network.model().bars.values().filter_map(|bar| bar.travel.clone());
        let loads = network.model().loads.values();
        let moments =
            loads.flat_map(|load| std::iter::once(load.from.clone()).chain(load.until.clone()));
        let mut times = vec![statement.period.clone()];
        times.extend(network.leads().cloned().chain(delays).chain(travels).chain(moments));
        times.retain(|time| !time.is_zero());
        let (lattice, counts) = Lattice::spanned_by(&times);
        assert_eq!(lattice.periods().len(), 1, "a grid");
        let length = lattice.periods()[0].clone();
        let each = counts[0][0].unsigned_abs() as usize;
        // A node is late by so many cells; its waves are needed that much further.
        let late = network.leads().map(|late| Proof::count(&length, late)).max().unwrap_or(0);
        let periods = (cells + late.unsigned_abs() as usize).div_ceil(each) + 1;
        let mut solver = PeriodByPeriod::new(&recurrence);
        (0..periods).for_each(|_| solver.advance().unwrap_or_else(|error| panic!("{error}")));
        let on_cells = |wave: &Vec<wavestep::expression::Expression>| {
            let cell = |n: usize| {
                let shift = length.scale(&BigRational::from_integer((n % each).into()));
                wave[n / each].shift(&statement.local, &shift).expect("a shift")
            };
            (0..periods * each).map(cell).collect()
        };
        let waves = solver.pieces().iter().map(on_cells).collect();
        Proof { network, waves, local: statement.local.clone(), length, count: cells }
    }

    fn count(length: &Fraction, time: &Fraction) -> i64 {
        if time.is_zero() {
            return 0;
        }
        let ratio = expression(time).proportion(&expression(length)).expect("on the grid");
        assert!(ratio.is_integer());
        ratio.to_integer().to_i64().unwrap()
    }

    /// A wave later by a delay, zero before its start.
    fn delayed(&self, wave: WaveIndex, delay: &Fraction) -> Cells {
        let delay = Proof::count(&self.length, delay);
        let cell = |n: usize| match usize::try_from(n as i64 - delay) {
            Ok(own) => self.waves[wave][own].clone(),
            Err(_) => Expression::zero(),
        };
        // Nothing happens by the clock of a node before it does by that of the scene.
        for early in 0..usize::try_from(-delay).unwrap_or(0) {
            assert!(self.waves[wave][early].is_zero(), "a wave starts too early");
        }
        (0..self.count).map(cell).collect()
    }

    /// The wave with a role, by the clock of the scene.
    fn role(&self, role: Role, node: usize) -> Option<Cells> {
        let wave = self.network.waves().iter().position(|wave| wave.role == role)?;
        let late = self.network.leads().nth(node).expect("a node");
        Some(self.delayed(wave, &-late))
    }

    /// What is observed, zero-based at the start of the scene.
    fn observed(&self, observation: &Observation) -> Cells {
        let cell = |n: usize| {
            let start = self.length.scale(&BigRational::from_integer(n.into()));
            let now = &Fraction::symbol(&self.local) + &start;
            let time = &self.network.scene().time;
            observation.forcing.substitute(time, &now).expect("a time")
        };
        let mut sum: Cells = (0..self.count).map(cell).collect();
        for seen in &observation.waves {
            add(&mut sum, &self.delayed(seen.wave, &seen.delay), &seen.coefficient);
        }
        sum
    }

    fn constant(&self, value: &Fraction) -> Cells {
        vec![expression(value); self.count]
    }

    fn derivative(&self, cells: &Cells) -> Cells {
        cells.iter().map(|cell| cell.derivative(&self.local)).collect()
    }

    /// The values between cells are the same from both sides, and the first is as told.
    fn assert_goes_on(&self, cells: &Cells, start: &Fraction, what: &str) {
        let mut before = expression(start);
        for (n, cell) in cells.iter().enumerate() {
            assert!(cell.at_zero(&self.local) == before, "{what} jumps before cell {n}");
            before = cell.substitute(&self.local, &self.length).expect("a length");
        }
    }

    fn assert_zero(&self, cells: &Cells, what: &str) {
        for (n, cell) in cells.iter().enumerate() {
            assert!(cell.is_zero(), "{}: {what} on cell {n}: {cell:?}", self.network.scene().title);
        }
    }

    fn load(&self, element: ElementIndex) -> Cells {
        let ModelLoad { course, from, until } = &self.network.model().loads[&element];
        let from = Proof::count(&self.length, from);
        let until = until.as_ref().map(|until| Proof::count(&self.length, until));
        let cell = |n: usize| {
            let acts = n as i64 >= from && until.is_none_or(|until| (n as i64) < until);
            if !acts {
                return Expression::zero();
            }
            let start = self.length.scale(&BigRational::from_integer(n.into()));
            let now = &Fraction::symbol(&self.local) + &start;
            course.substitute(&self.network.scene().time, &now).expect("a time")
        };
        (0..self.count).map(cell).collect()
    }

    fn bar(&self, element: ElementIndex, nodes: [Option<usize>; 2]) -> BarMotion {
        let data = &self.network.model().bars[&element];
        let impedance = expression(&data.impedance);
        let half = BigRational::new(1.into(), 2.into());
        let pressed = match data.force.is_zero() {
            true => Fraction::zero(),
            false => {
                let inverse = Fraction::reciprocal(data.impedance.numerator()).expect("positive");
                &(&data.force * &inverse) * &data.impedance.denominator().into()
            }
        };
        let before = [&data.velocity + &pressed, &data.velocity - &pressed].map(|b| b.scale(&half));
        let roles = [Role::Right(element), Role::Left(element)];
        let late = data.travel.as_ref().map_or(0, |travel| Proof::count(&self.length, travel));
        let late = usize::try_from(late).unwrap();
        let passing = [0, 1].map(|way| {
            let uniform = self.constant(&before[way]);
            let Some(node) = nodes[way] else {
                // It comes from where the bar goes on for ever.
                return (None, Some(uniform));
            };
            let mut enters = self.role(roles[way], node).expect("a wave");
            add(&mut enters, &uniform, &Expression::one());
            let leaves = data.travel.as_ref().map(|_| {
                let mut leaves: Cells = uniform[..late.min(self.count)].to_vec();
                leaves.extend(enters[..self.count.saturating_sub(late)].iter().cloned());
                leaves
            });
            (Some(enters), leaves)
        });
        let [(right_enters, right_leaves), (left_enters, left_leaves)] = &passing;
        let end = |right: &Option<Cells>, left: &Option<Cells>| match (right, left) {
            (Some(right), Some(left)) => {
                let mut velocity = right.clone();
                add(&mut velocity, left, &Expression::one());
                let mut force = zeros(self.count);
                add(&mut force, right, &impedance);
                add(&mut force, left, &-&impedance);
                (velocity, force)
            }
            _ => (Vec::new(), Vec::new()),
        };
        let ends = [end(right_enters, left_leaves), end(right_leaves, left_enters)];
        BarMotion { impedance, ends, passing }
    }
}

/// Proves the solution of a scene on so many cells, and that its linear observables are what they are
/// called.
pub fn assert_laws_hold(network: &Network, cells: usize) {
    let proof = Proof::new(network, cells);
    let scene = network.scene();
    let model = network.model();
    let one = Expression::one();
    let count = scene.line.elements.len();
    let is_bar = |place: usize| {
        let element = scene.line.elements[place];
        matches!(scene.elements[element].kind, Kind::Bar(_))
    };
    // The node of each joint: those between two bars have the same.
    let first = usize::from(scene.line.left == End::Endless);
    let node_of = |joint: usize| (0..joint).filter(|place| is_bar(*place)).count() - first;
    let mut bars: Vec<Option<BarMotion>> = Vec::new();
    for (place, element) in scene.line.elements.iter().enumerate() {
        bars.push(is_bar(place).then(|| {
            let left = (place > 0 || scene.line.left != End::Endless).then(|| node_of(place));
            let right =
                (place + 1 < count || scene.line.right != End::Endless).then(|| node_of(place + 1));
            proof.bar(*element, [left, right])
        }));
    }
    // Velocity and force on both sides of every joint between what moves as one.
    let lump = |place: usize| model.lumps.get(&scene.line.elements[place]);
    let is_spring = |place: usize| matches!(lump(place), Some(ElementLaw::Spring { .. }));
    let mut joints: Vec<Option<Cells>> = vec![None; count + 1];
    let mut outside = zeros(proof.count); // what acts on the line from outside
    let mut momentum_rate = zeros(proof.count);
    let mut energy_rate = zeros(proof.count); // stored, spent and carried away, less the work done
    let mut start = 0;
    let mut runs = Vec::new();
    for joint in 0..=count {
        let ends = joint == count || is_bar(joint) || is_spring(joint);
        if ends {
            runs.push((start, joint));
            start = joint + 1;
        }
    }
    for (from, to) in &runs {
        let (from, to) = (*from, *to);
        let endless = (from == 0 && scene.line.left == End::Endless && is_bar(0))
            || (to == count && from == count && scene.line.right == End::Endless);
        if endless {
            continue;
        }
        let node = node_of(from);
        let mut known = Vec::new();
        if from > 0
            && let Some(bar) = &bars[from - 1]
        {
            known.push(bar.ends[1].0.clone());
        }
        if to < count
            && let Some(bar) = &bars[to]
        {
            known.push(bar.ends[0].0.clone());
        }
        let held = (from == 0 && scene.line.left == End::Fixed)
            || (to == count && scene.line.right == End::Fixed);
        if held {
            known.push(zeros(proof.count));
        }
        for place in from..to {
            if let Some(ElementLaw::Load(Drive::Velocity)) = lump(place) {
                known.push(proof.load(scene.line.elements[place]));
            }
        }
        let masses: Vec<_> = (from..to)
            .filter_map(|place| match lump(place) {
                Some(ElementLaw::Mass { mass, velocity }) => Some((mass, velocity)),
                _ => None,
            })
            .collect();
        let total = masses.iter().fold(Fraction::zero(), |sum, (mass, _)| &sum + mass);
        let momentum = masses.iter().fold(Fraction::zero(), |sum, (m, v)| &sum + &(*m * *v));
        if known.is_empty() {
            // Its own wave, by the place of the run in its node; it may tell the difference from the
            // velocity at the start only.
            let roles = network.waves().iter().filter_map(|wave| match wave.role {
                Role::Velocity(own, place) if own == node => Some((place, wave.role)),
                _ => None,
            });
            let begins = (0..from).rev().find(|place| is_bar(*place)).map_or(0, |place| place + 1);
            let (_, role) = roles.into_iter().find(|(place, _)| *place == from - begins).unwrap();
            let mut velocity = proof.role(role, node).unwrap();
            if let Some((_, own)) = masses.first()
                && velocity[0].at_zero(&proof.local).is_zero()
            {
                add(&mut velocity, &proof.constant(own), &one);
            }
            known.push(velocity);
        }
        let velocity = known[0].clone();
        for other in &known[1..] {
            let mut difference = velocity.clone();
            add(&mut difference, other, &-&one);
            proof.assert_zero(&difference, "what is joined moves apart");
        }
        (from..=to).for_each(|joint| joints[joint] = Some(velocity.clone()));
        let driven =
            (from..to).any(|place| matches!(lump(place), Some(ElementLaw::Load(Drive::Velocity))));
        if !total.is_zero() && !driven && !held {
            let mut momenta = zeros(proof.count);
            add(&mut momenta, &velocity, &expression(&total));
            proof.assert_goes_on(&momenta, &momentum, "the momentum of a mass");
        }
    }
    let velocity_at = |joint: usize| joints[joint].clone().expect("a velocity");
    // Forces in springs.
    let mut spring_forces: Vec<Option<Cells>> = vec![None; count];
    for place in (0..count).filter(|place| is_spring(*place)) {
        let element = scene.line.elements[place];
        let Some(ElementLaw::Spring { stiffness, damping }) = lump(place) else { unreachable!() };
        let mut closing = velocity_at(place);
        add(&mut closing, &velocity_at(place + 1), &-&one);
        let mut force = zeros(proof.count);
        add(&mut force, &closing, &expression(damping));
        add(&mut energy_rate, &product(&closing, &closing), &expression(damping));
        if let Some(compression) = proof.role(Role::Compression(element), node_of(place)) {
            let mut rest = proof.derivative(&compression);
            add(&mut rest, &closing, &-&one);
            proof.assert_zero(&rest, "a spring yields otherwise than its ends move");
            proof.assert_goes_on(&compression, &Fraction::zero(), "a compression");
            add(&mut force, &compression, &expression(stiffness));
            let power = product(&compression, &proof.derivative(&compression));
            add(&mut energy_rate, &power, &expression(stiffness));
        } else {
            assert!(stiffness.is_zero());
        }
        spring_forces[place] = Some(force);
    }
    for (from, to) in &runs {
        let (from, to) = (*from, *to);
        if joints[from].is_none() {
            continue;
        }
        let velocity = velocity_at(from);
        let left = match from.checked_sub(1) {
            None if scene.line.left == End::Free => Some(zeros(proof.count)),
            None => None,
            Some(before) => match &bars[before] {
                Some(bar) => Some(bar.ends[1].1.clone()),
                None => spring_forces[before].clone(),
            },
        };
        let right = match to == count {
            true if scene.line.right == End::Free => Some(zeros(proof.count)),
            true => None,
            false => match &bars[to] {
                Some(bar) => Some(bar.ends[0].1.clone()),
                None => spring_forces[to].clone(),
            },
        };
        // What is left of the run's own force when all others are taken away.
        let mut rest = zeros(proof.count);
        let mut acting = zeros(proof.count);
        for place in from..to {
            let element = scene.line.elements[place];
            match lump(place).expect("a lump") {
                ElementLaw::Mass { mass, .. } => {
                    let slope = proof.derivative(&velocity);
                    add(&mut rest, &slope, &-&expression(mass));
                    add(&mut momentum_rate, &slope, &expression(mass));
                    add(&mut energy_rate, &product(&velocity, &slope), &expression(mass));
                }
                ElementLaw::Support { stiffness, damping } => {
                    add(&mut acting, &velocity, &-&expression(damping));
                    let power = product(&velocity, &velocity);
                    add(&mut energy_rate, &power, &expression(damping));
                    let displacement = proof.role(Role::Displacement(element), node_of(place));
                    if let Some(displacement) = displacement {
                        let mut difference = proof.derivative(&displacement);
                        add(&mut difference, &velocity, &-&one);
                        proof.assert_zero(&difference, "a support yields otherwise than it moves");
                        proof.assert_goes_on(&displacement, &Fraction::zero(), "a displacement");
                        add(&mut acting, &displacement, &-&expression(stiffness));
                        let power = product(&displacement, &velocity);
                        add(&mut energy_rate, &power, &expression(stiffness));
                    } else {
                        assert!(stiffness.is_zero());
                    }
                }
                ElementLaw::Load(Drive::Force) => {
                    let load = proof.load(element);
                    add(&mut energy_rate, &product(&load, &velocity), &-&one);
                    add(&mut acting, &load, &one);
                }
                ElementLaw::Load(Drive::Velocity) => {}
                ElementLaw::Spring { .. } | ElementLaw::LocalContact { .. } => unreachable!(),
            }
        }
        add(&mut rest, &acting, &one);
        match (&left, &right) {
            (Some(left), Some(right)) => {
                add(&mut rest, left, &one);
                add(&mut rest, right, &-&one);
            }
            // A wall gives what is wanted.
            (None, Some(right)) => rest = right.iter().map(|force| -force).collect(),
            (Some(left), None) => rest = left.clone(),
            (None, None) => unreachable!("a line between two walls has a bar or a spring"),
        }
        let driven =
            (from..to).any(|place| matches!(lump(place), Some(ElementLaw::Load(Drive::Velocity))));
        if driven || left.is_none() || right.is_none() {
            // What gives the motion acts as is wanted, and works.
            add(&mut energy_rate, &product(&rest, &velocity), &one);
            add(&mut outside, &rest, &-&one);
        } else {
            proof.assert_zero(&rest, "forces are not balanced");
        }
        add(&mut outside, &acting, &one);
    }
    for (enters, leaves, impedance) in (bars.iter().flatten())
        .flat_map(|bar| bar.passing.iter().map(|(in_, out)| (in_, out, &bar.impedance)))
    {
        for (wave, side) in [(enters, impedance.clone()), (leaves, -impedance)] {
            if let Some(wave) = wave {
                add(&mut momentum_rate, wave, &side);
                add(&mut energy_rate, &product(wave, wave), &side);
            }
        }
    }
    let is_quiet = |bar: &ModelBar| bar.velocity.is_zero() && bar.force.is_zero();
    if model.bars.values().all(|bar| bar.travel.is_some() || is_quiet(bar)) {
        let mut rest = momentum_rate.clone();
        add(&mut rest, &outside, &-&one);
        proof.assert_zero(&rest, "momentum changes by itself");
        proof.assert_zero(&energy_rate, "energy changes by itself");
    }
    for observed in network.observables() {
        let ObservedValue::Linear(observation) = &observed.value else { continue };
        if observed.name == "momentum" {
            let mut rate = proof.derivative(&proof.observed(observation));
            add(&mut rate, &momentum_rate, &-&one);
            proof.assert_zero(&rate, "the momentum observed is another one");
            let bars = model.bars.values().map(|bar| match &bar.travel {
                Some(travel) => &(&bar.impedance * travel) * &bar.velocity,
                None => Fraction::zero(),
            });
            let lumps = model.lumps.values().map(|lump| match lump {
                ElementLaw::Mass { mass, velocity } => mass * velocity,
                _ => Fraction::zero(),
            });
            let start = bars.chain(lumps).fold(Fraction::zero(), |sum, part| &sum + &part);
            proof.assert_goes_on(&proof.observed(observation), &start, "the momentum observed");
        }
    }
}
