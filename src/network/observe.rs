//! Observables as delayed waves: the readings of the table of measures in terms of echoes.
//!
//! In a bar a wave that entered at the left end a delay ago meets one that entered at the right end; the
//! clocks of the two nodes turn these into wave functions, which are differences from the uniform state at
//! the start.

use crate::expression::{Expression, Fraction, Root};
use crate::network::balance::{self, Flow, at_start, flow};
use crate::network::equations::{Network, Role};
use crate::network::error::NetworkError;
use crate::network::measures::MeasuredValue;
use crate::network::node::{ElementLaw, Node, Side};
use crate::network::observed::{
    Balance, EnergySum, EnergyTerm, FlowTerm, Observed, ObservedValue, Squared, Window,
};
use crate::network::reading::{Elements, Energy, Face, Field, Lump, Reading, Section, section};
use crate::recurrence::{Observation, ObservedWave, WaveIndex};
use crate::scene::ElementIndex;
use std::sync::OnceLock;
use wavestep_polynomial::Rational;

impl Network {
    /// Forms all observables of the scene.
    pub(crate) fn set_observables(&mut self) -> Result<(), NetworkError> {
        for (place, measured) in self.scaled.measures.clone().into_iter().enumerate() {
            let mut power = Vec::new();
            let value = match &measured.value {
                MeasuredValue::Linear(terms) => {
                    let mut sum = Observation::default();
                    for term in terms {
                        add(&mut sum, &self.reading(&term.of), &term.coefficient);
                    }
                    ObservedValue::Linear(sum)
                }
                MeasuredValue::Energy { held: elements, passed } => {
                    let mut held = Vec::new();
                    for (coefficient, element) in elements {
                        held.extend(self.energy(&measured.name, coefficient, *element)?);
                    }
                    power = balance::power(&self.scaled, passed);
                    let (start, passed) = (Fraction::zero(), self.flowing(power.clone()));
                    ObservedValue::Energy(EnergySum { start, held, passed })
                }
            };
            let at_start = at_start(&self.scaled, &measured.value, &value);
            let flow = flow(&self.scaled, &self.scaled.scene.observables[place], &power);
            let balance = flow
                .zip(at_start)
                .map(|(flow, at_start)| Balance { at_start, flow: self.flowing(flow) });
            // Of what is summed up since the start anyway, all that cancels is left out.
            let value = match (value, &balance) {
                (ObservedValue::Energy(sum), Some(known)) if !sum.passed.is_empty() => {
                    let (start, passed) = (known.at_start.clone(), known.flow.clone());
                    ObservedValue::Energy(EnergySum { start, held: Vec::new(), passed })
                }
                (value, _) => value,
            };
            let readings = match measured.value {
                MeasuredValue::Linear(terms) => terms,
                MeasuredValue::Energy { .. } => Vec::new(),
            };
            let acts =
                measured.loads.map(|loads| loads.into_iter().map(|load| self.acts(load)).collect());
            let (name, unit, dimension) = (measured.name, measured.unit, measured.dimension);
            let observed = Observed { name, value, readings, balance, acts, unit, dimension };
            self.observables.push(observed);
        }
        Ok(())
    }

    /// When a load begins to act, and when it ends.
    fn acts(&self, load: ElementIndex) -> (Fraction, Option<Fraction>) {
        let load = &self.scaled.model.loads[&load];
        (load.from.clone(), load.until.clone())
    }

    fn flowing(&mut self, flow: Vec<Flow>) -> Vec<FlowTerm> {
        let mut terms = Vec::new();
        for Flow { coefficient, factors, loads, course } in flow {
            let with_waves = |reading| {
                let waves = self.reading(&reading);
                (reading, waves)
            };
            let factors = factors.into_iter().map(with_waves).collect();
            let acts = loads.map(|loads| loads.into_iter().map(|load| self.acts(load)).collect());
            terms.push(FlowTerm { coefficient, factors, acts, course });
        }
        terms
    }

    fn elements(&self) -> Elements<'_> {
        Elements { model: &self.scaled.model, layout: &self.scaled.layout }
    }

    /// A reading in terms of waves.
    fn reading(&mut self, reading: &Reading) -> Observation {
        match reading {
            Reading::InBar(Field::Velocity, section) => self.velocity_in(section),
            Reading::InBar(Field::Displacement, section) => {
                let velocity = self.velocity_in(section);
                self.integrated(&velocity)
            }
            Reading::InBar(Field::Force, section) => self.force_in(section),
            Reading::Momentum(bar) => self.momentum_of(*bar),
            Reading::Velocity(face) => self.velocity_at(*face),
            Reading::Displacement(face) => {
                let velocity = self.velocity_at(*face);
                self.integrated(&velocity)
            }
            Reading::Compression(lump) => self.compression_of(*lump),
            Reading::Force(lump) => {
                let mut force = Observation::default();
                for term in self.elements().force(*lump).into_iter().flatten() {
                    add(&mut force, &self.reading(&term.of), &term.coefficient);
                }
                force
            }
        }
    }

    /// The waves to the right and to the left in a bar, with how far the clocks of their nodes are ahead;
    /// none for what comes from the far side of an endless bar.
    pub(super) fn waves_of(&self, bar: usize) -> [Option<(WaveIndex, &Fraction)>; 2] {
        let (element, [left, right]) = (self.scaled.layout.bars[bar], self.scaled.layout.ends[bar]);
        let wave = |role, node: Option<usize>| Some((self.wave(role)?, &self.clocks.leads[node?]));
        [wave(Role::Right(element), left), wave(Role::Left(element), right)]
    }

    /// The waves at a section of a bar, with coefficients for the one to the right and the one to the left.
    fn waves_in(&self, section: &Section, coefficients: [&Fraction; 2]) -> Vec<ObservedWave> {
        let waves = self.waves_of(section.bar).into_iter().zip(&section.delays).zip(coefficients);
        let waves = waves.filter_map(|((wave, delay), coefficient)| {
            let ((wave, lead), delay) = (wave?, delay.as_ref()?);
            Some(ObservedWave::new(wave, delay - lead, coefficient))
        });
        waves.collect()
    }

    fn velocity_in(&self, section: &Section) -> Observation {
        let data = &self.scaled.model.bars[&self.scaled.layout.bars[section.bar]];
        let one = Fraction::one();
        let waves = self.waves_in(section, [&one, &one]);
        Observation { waves, forcing: data.velocity.clone().into() }
    }

    fn force_in(&self, section: &Section) -> Observation {
        let data = &self.scaled.model.bars[&self.scaled.layout.bars[section.bar]];
        let waves = self.waves_in(section, [&data.impedance, &-&data.impedance]);
        Observation { waves, forcing: data.force.clone().into() }
    }

    /// The integral of an observation over time from the start.
    fn integrated(&mut self, observation: &Observation) -> Observation {
        let time = self.scaled.scene.time.clone();
        let mut integral = Observation::default();
        for term in &observation.waves {
            let wave = self.integral(term.wave);
            integral.waves.push(ObservedWave { wave, ..term.clone() });
        }
        let rate = observation.forcing.as_fraction().expect("constants only");
        integral.forcing = (&rate * &Fraction::symbol(&time)).into();
        integral
    }

    /// The wave that is the integral of another.
    pub(crate) fn integral(&mut self, wave: WaveIndex) -> WaveIndex {
        let place = self.integrals.iter().position(|known| *known == wave);
        self.waves.len()
            + place.unwrap_or_else(|| {
                self.integrals.push(wave);
                self.derived = OnceLock::new();
                self.integrals.len() - 1
            })
    }

    /// The velocity of a run of a node.
    fn velocity_of_run(&self, place: usize, node: &Node<Fraction>, run: usize) -> Observation {
        let end = |bar: usize, time: Option<&Fraction>| {
            let time = time.cloned().unwrap_or_else(Fraction::zero);
            self.velocity_in(&section(&self.scaled.layout, &self.scaled.model, bar, time))
        };
        let travel =
            |bar: usize| self.scaled.model.bars[&self.scaled.layout.bars[bar]].travel.as_ref();
        for (side, own) in [node.left, node.right].into_iter().zip(node.side_runs()) {
            match side {
                _ if own != run => {}
                // A bar at the left of its node ends there.
                Side::Bar(bar) if self.scaled.layout.ends[bar][1] == Some(place) => {
                    return end(bar, travel(bar));
                }
                Side::Bar(bar) => return end(bar, None),
                Side::Fixed => return Observation::default(),
                Side::Free => {}
            }
        }
        let wave =
            self.wave(Role::Velocity(place, node.first_place(run))).expect("else it is known");
        let mut velocity = Observation::default();
        if self.clocks.counted[place].is_none() {
            let common = self.scaled.initial_velocities(node, run).into_iter().next();
            velocity = constant(&common.unwrap_or_else(Fraction::zero));
        }
        let delay = -&self.clocks.leads[place];
        velocity.waves.push(ObservedWave::new(wave, delay, &Fraction::one()));
        velocity
    }

    /// The velocity beside a lumped element.
    fn velocity_at(&self, face: Face) -> Observation {
        let place = face.lump().node;
        let node = &self.scaled.layout.nodes[place];
        self.velocity_of_run(place, node, node.run_beside(face))
    }

    /// The wave that is the compression of a spring, or the displacement of a support.
    fn compression_of(&self, lump: Lump) -> Observation {
        let own = &self.scaled.layout.nodes[lump.node].elements[lump.place];
        let role = match own.law {
            ElementLaw::Support { .. } => Role::Displacement(own.element),
            _ => Role::Compression(own.element),
        };
        let wave = self.wave(role).map(|wave| (wave, -&self.clocks.leads[lump.node]));
        let waves = wave.map(|(wave, delay)| ObservedWave::new(wave, delay, &Fraction::one()));
        Observation { waves: waves.into_iter().collect(), forcing: Expression::zero() }
    }

    fn momentum_of(&mut self, bar: usize) -> Observation {
        let data = self.scaled.model.bars[&self.scaled.layout.bars[bar]].clone();
        let mut momentum = match &data.travel {
            Some(travel) => constant(&(&(&data.impedance * travel) * &data.velocity)),
            None => Observation::default(),
        };
        let waves = self.waves_of(bar).map(|wave| wave.map(|(wave, lead)| (wave, -lead)));
        for (wave, entered) in waves.into_iter().flatten() {
            let integral = self.integral(wave);
            momentum.waves.push(ObservedWave::new(integral, entered.clone(), &data.impedance));
            if let Some(travel) = &data.travel {
                momentum.waves.push(ObservedWave::new(
                    integral,
                    &entered + travel,
                    &-&data.impedance,
                ));
            }
        }
        momentum
    }

    /// The energy of an element, times a coefficient.
    fn energy(
        &mut self,
        name: &str,
        coefficient: &Fraction,
        element: ElementIndex,
    ) -> Result<Vec<EnergyTerm>, NetworkError> {
        let refused =
            |mistake| NetworkError::Unobservable { name: name.to_owned(), reason: mistake };
        let mut terms = Vec::new();
        for part in self.elements().energy(element).map_err(refused)? {
            match part {
                Energy::Square(term) => {
                    let of = self.reading(&term.of);
                    let coefficient = coefficient * &term.coefficient;
                    let (before, window) = (Fraction::zero(), Window::Now);
                    let (squared, times) = (Squared::Reading(term.of), None);
                    terms.push(EnergyTerm { coefficient, squared, times, of, before, window });
                }
                Energy::Work(share, lump) => terms.push(EnergyTerm {
                    coefficient: coefficient * &share,
                    squared: Squared::Reading(Reading::Force(lump)),
                    times: Some(Reading::Compression(lump)),
                    of: Observation::default(),
                    before: Fraction::zero(),
                    window: Window::Now,
                }),
                Energy::InBar(bar) => terms.extend(self.energy_in(coefficient, bar)?),
            }
        }
        Ok(terms)
    }

    fn energy_in(
        &self,
        coefficient: &Fraction,
        bar: usize,
    ) -> Result<Vec<EnergyTerm>, NetworkError> {
        let data = &self.scaled.model.bars[&self.scaled.layout.bars[bar]];
        // The uniform state at the start as two waves: (V ± X_0/Z)/2.
        let pressed = match data.force.is_zero() {
            true => Root::from(Fraction::zero()),
            false => Root::from(data.force.clone()).over(&Root::from(data.impedance.clone()))?,
        };
        let half = |sum: Fraction| sum.scale(&Rational::new(1.into(), 2.into()));
        let before = [&data.velocity + pressed.factor(), &data.velocity - pressed.factor()];
        let ways = self.waves_of(bar).into_iter().zip(before.map(half)).enumerate();
        let parts = ways.filter_map(|(direction, (wave, before))| {
            let (wave, lead) = wave?;
            let mut of = constant(&before);
            of.waves.push(ObservedWave::new(wave, -lead, &Fraction::one()));
            let window = data.travel.clone().map_or(Window::Always, Window::Last);
            let squared = Squared::Entering { bar, direction };
            let coefficient = coefficient * &data.impedance;
            Some(EnergyTerm { coefficient, squared, times: None, of, before, window })
        });
        Ok(parts.collect())
    }
}

fn constant(value: &Fraction) -> Observation {
    Observation { waves: Vec::new(), forcing: value.clone().into() }
}

/// Adds `factor · other`; waves that are seen twice are joined.
fn add(sum: &mut Observation, other: &Observation, factor: &Fraction) {
    for term in &other.waves {
        let coefficient = term.coefficient.times(factor);
        let known = sum.waves.iter_mut().find(|known| {
            (known.wave, known.slope, &known.delay) == (term.wave, term.slope, &term.delay)
        });
        match known {
            Some(known) => known.coefficient += &coefficient,
            None => sum.waves.push(ObservedWave { coefficient, ..term.clone() }),
        }
    }
    sum.waves.retain(|term| !term.coefficient.is_zero());
    sum.forcing += &other.forcing.times(factor);
}
