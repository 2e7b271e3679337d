//! What is observed, as delayed waves.
//!
//! In a bar, at the share `ξ` of its length, a wave that left the left end at `t − ξτ` meets one that
//! left the right end at `t − (1−ξ)τ`; the clocks of the two nodes turn these into wave functions.

use crate::expression::{Expression, Fraction, Root};
use crate::network::equations::{Network, Role};
use crate::network::error::{NetworkError, Unobservable};
use crate::network::model::{ModelLump, bar_roots};
use crate::network::node::{Node, Side};
use crate::recurrence::{Observation, ObservedWave, WaveIndex};
use crate::scene::{Body, Dimension, ElementIndex, Kind, Measure, Place, Position, Seen};
use wavestep_polynomial::Rational;

/// An observable of a scene: what it is in the waves, and its unit.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Observed {
    /// What it is called.
    pub name: String,
    /// In the scene's own scales.
    pub value: ObservedValue,
    /// What 1 in these scales is, in metres, kilograms and seconds.
    pub unit: Root,
    /// The dimension of the unit; none for scenes without units.
    pub dimension: Dimension,
}

/// An observable in the scales of its scene.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum ObservedValue {
    /// Linear in the waves.
    Linear(Observation),
    /// A sum of energies.
    Energy(Vec<EnergyTerm>),
}

/// One part of an energy: `c q²`, or `c ∫ q² dt` over the time that a wave needs to leave a bar.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EnergyTerm {
    /// The coefficient `c`.
    pub coefficient: Fraction,
    /// The quantity `q`, zero before the start but for `before`.
    pub of: Observation,
    /// What `q` was before the start.
    pub before: Fraction,
    /// Over which time it is integrated.
    pub window: Window,
}

/// The time over which the square of a wave is integrated.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Window {
    /// None: its value at the time itself.
    Now,
    /// The last travel time.
    Last(Fraction),
    /// All since the start.
    Always,
}

/// What is seen, its unit, and the dimension of it.
type Measured<T> = (T, Root, Dimension);

impl Network {
    /// Forms all observables of the scene.
    pub(crate) fn set_observables(&mut self) -> Result<(), NetworkError> {
        for observable in self.scaled.scene.observables.clone() {
            let energy = observable.terms.iter().any(|seen| seen.measure == Measure::Energy);
            let observed = match energy {
                true => self.energies(&observable.name, &observable.terms)?,
                false => self.linear(&observable.name, &observable.terms)?,
            };
            self.observables.push(observed);
        }
        Ok(())
    }

    /// A sum of linear measures, in the unit of the first.
    fn linear(&mut self, name: &str, terms: &[Seen]) -> Result<Observed, NetworkError> {
        let mut sum = Observation::default();
        let mut first: Option<(Root, Dimension)> = None;
        for (i, seen) in terms.iter().enumerate() {
            let (observation, unit, dimension) = self.measured(name, seen)?;
            let mut coefficient = seen.coefficient.clone();
            if !self.scaled.scene.dimensional {
                // Without units a value is what it is.
                let unit = self.scaled.model.number(&format!("q_{name}_{i}"), unit);
                add(&mut sum, &observation, &(&coefficient * &unit));
                continue;
            }
            match &first {
                None => first = Some((unit, dimension)),
                Some((own, _)) => {
                    let ratio = unit.over(own)?;
                    let ratio = self.scaled.model.number(&format!("q_{name}_{i}"), ratio);
                    coefficient = &coefficient * &ratio;
                }
            }
            add(&mut sum, &observation, &coefficient);
        }
        let (unit, dimension) = first.unwrap_or((Fraction::one().into(), Dimension::NONE));
        let value = ObservedValue::Linear(sum);
        Ok(Observed { name: name.to_owned(), value, unit, dimension })
    }

    fn measured(&mut self, name: &str, seen: &Seen) -> Result<Measured<Observation>, NetworkError> {
        let refuse = |reason| Err(NetworkError::Unobservable { name: name.to_owned(), reason });
        let scale = self.scaled.model.scale.clone();
        let length = scale.velocity.times(&scale.time);
        let unit = match seen.measure {
            Measure::Velocity => scale.velocity.clone(),
            Measure::Force | Measure::Strain | Measure::Stress => scale.force(),
            Measure::Displacement | Measure::Compression => length,
            Measure::Momentum => scale.force().times(&scale.time),
            Measure::Energy => unreachable!("energies are not linear"),
        };
        let section = match &seen.place {
            Place::Left(bar) => Some((*bar, Fraction::zero())),
            // An endless bar to the left has one end, from which its sections are counted.
            Place::Right(bar) if self.scaled.model.bars[bar].travel.is_none() => {
                Some((*bar, Fraction::zero()))
            }
            Place::Right(bar) => Some((*bar, Fraction::one())),
            Place::At(bar, position) => Some((*bar, self.share(name, *bar, position)?)),
            Place::Element(_) | Place::Line => None,
        };
        let (observation, unit) = match (seen.measure, &seen.place, section) {
            (Measure::Velocity, _, Some((bar, share))) => (self.velocity_in(bar, &share), unit),
            (Measure::Force, _, Some((bar, share))) => (self.force_in(bar, &share), unit),
            (Measure::Strain | Measure::Stress, _, Some((bar, share))) => {
                let Kind::Bar(data) = &self.scaled.scene.elements[bar].kind else {
                    return refuse(Unobservable::NotInBar);
                };
                let over = match (&data.body, seen.measure) {
                    (Body::Solid { area, .. }, Measure::Stress) => Root::from(area.clone()),
                    (_, Measure::Stress) => return refuse(Unobservable::NoArea),
                    (body, _) => bar_roots(body)?.2,
                };
                let mut pulled = Observation::default();
                add(&mut pulled, &self.force_in(bar, &share), &-&Fraction::one());
                (pulled, unit.over(&over)?)
            }
            (Measure::Displacement, _, Some((bar, share))) => {
                (self.displacement_in(bar, &share), unit)
            }
            (Measure::Velocity, Place::Element(element), _) => {
                let Some(velocity) = self.velocity_of(*element) else {
                    return refuse(Unobservable::TwoVelocities);
                };
                (velocity, unit)
            }
            (Measure::Displacement, Place::Element(element), _) => {
                let Some(velocity) = self.velocity_of(*element) else {
                    return refuse(Unobservable::TwoDisplacements);
                };
                (self.integrated(&velocity), unit)
            }
            (Measure::Compression, Place::Element(element), _) => {
                let Some(compression) = self.compression_of(*element) else {
                    return refuse(Unobservable::NotCompressible);
                };
                (compression, unit)
            }
            (Measure::Force, Place::Element(element), _) => {
                let Some(force) = self.force_of(*element) else {
                    return refuse(Unobservable::NoForce);
                };
                (force, unit)
            }
            (Measure::Momentum, Place::Element(element), _) => {
                let Some(momentum) = self.momentum_of(*element) else {
                    return refuse(Unobservable::NoMomentum);
                };
                (momentum, unit)
            }
            (Measure::Momentum, Place::Line, _) => {
                let mut sum = Observation::default();
                for element in self.scaled.scene.line.elements.clone() {
                    let has = matches!(
                        self.scaled.scene.elements[element].kind,
                        Kind::Bar(_) | Kind::Mass(_)
                    );
                    if !has {
                        continue;
                    }
                    let Some(momentum) = self.momentum_of(element) else {
                        return refuse(Unobservable::InfiniteMomentum);
                    };
                    add(&mut sum, &momentum, &Fraction::one());
                }
                (sum, unit)
            }
            _ => return refuse(Unobservable::NoSuchPlace),
        };
        Ok((observation, unit, seen.measure.dimension()))
    }

    /// The time from the left end to a section, as a share of the travel time; for an endless bar,
    /// the time from its end.
    fn share(
        &mut self,
        name: &str,
        bar: ElementIndex,
        position: &Position,
    ) -> Result<Fraction, NetworkError> {
        let Kind::Bar(data) = &self.scaled.scene.elements[bar].kind else {
            return Err(NetworkError::Unobservable {
                name: name.to_owned(),
                reason: Unobservable::NotInBar,
            });
        };
        let travel = self.scaled.model.bars[&bar].travel.clone();
        let distance = match (position, travel) {
            (Position::Share(share), Some(_)) => return Ok(share.clone()),
            (Position::Share(_), None) => {
                let reason = Unobservable::ShareOfEndless;
                return Err(NetworkError::Unobservable { name: name.to_owned(), reason });
            }
            (Position::Distance(distance), travel) => (distance, travel),
        };
        let (distance, travel) = distance;
        let time = match &data.body {
            Body::Impedance { .. } => Root::from(distance.clone()),
            Body::Solid { modulus, density, .. } => {
                let slowness = Root::of(density.clone()).over(&Root::of(modulus.clone()))?;
                Root::from(distance.clone()).times(&slowness)
            }
        };
        let own = match (&data.body, travel) {
            (_, None) => self.scaled.model.scale.time.clone(),
            (body, Some(_)) => bar_roots(body)?.1.expect("a bar with a travel time"),
        };
        let ratio = time.over(&own)?;
        Ok(self.scaled.model.number(&format!("x_{name}"), ratio))
    }

    /// The waves `f` and `g` at a section of a bar: where they are seen, and how late.
    fn waves_in(&self, bar: ElementIndex, share: &Fraction) -> [Option<(WaveIndex, Fraction)>; 2] {
        let place = self.layout.bar(bar).expect("a bar of the line");
        let [left, right] = self.layout.ends[place];
        let travel = self.scaled.model.bars[&bar].travel.clone();
        let rest = &Fraction::one() - share;
        let time = |share: &Fraction, near_end: bool| match &travel {
            Some(travel) => share * travel,
            // The distance from the end of an endless bar is a time already.
            None if near_end => share.clone(),
            None => Fraction::zero(),
        };
        // An endless bar to the left has its end at the right.
        let (from_left, from_right) = match (left, right) {
            (None, _) => (Fraction::zero(), time(share, true)),
            (_, None) => (time(share, true), Fraction::zero()),
            _ => (time(share, false), time(&rest, false)),
        };
        let seen = |role, node: Option<usize>, later: Fraction| {
            Some((self.wave(role)?, &later - &self.leads[node?]))
        };
        [seen(Role::Right(bar), left, from_left), seen(Role::Left(bar), right, from_right)]
    }

    fn velocity_in(&self, bar: ElementIndex, share: &Fraction) -> Observation {
        let mut velocity = constant(&self.scaled.model.bars[&bar].velocity);
        for (wave, delay) in self.waves_in(bar, share).into_iter().flatten() {
            velocity.waves.push(seen(wave, delay, &Fraction::one()));
        }
        velocity
    }

    fn force_in(&self, bar: ElementIndex, share: &Fraction) -> Observation {
        let data = &self.scaled.model.bars[&bar];
        let mut force = constant(&data.force);
        let signs = [data.impedance.clone(), -&data.impedance];
        for (wave, sign) in self.waves_in(bar, share).into_iter().zip(signs) {
            if let Some((wave, delay)) = wave {
                force.waves.push(seen(wave, delay, &sign));
            }
        }
        force
    }

    fn displacement_in(&mut self, bar: ElementIndex, share: &Fraction) -> Observation {
        let velocity = self.velocity_in(bar, share);
        self.integrated(&velocity)
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
                self.integrals.len() - 1
            })
    }

    /// The velocity of a run of a node.
    fn velocity_of_run(&self, place: usize, node: &Node<Fraction>, run: usize) -> Observation {
        let side = |side: Side, share: Fraction| match side {
            Side::Bar(bar) => Some(self.velocity_at_end(self.layout.bars[bar], &share)),
            Side::Fixed => Some(Observation::default()),
            Side::Free => None,
        };
        let [first, last] = node.side_runs();
        let left = (run == first).then(|| side(node.left, Fraction::one())).flatten();
        let right = || (run == last).then(|| side(node.right, Fraction::zero())).flatten();
        if let Some(known) = left.or_else(right) {
            return known;
        }
        let wave =
            self.wave(Role::Velocity(place, node.first_place(run))).expect("else it is known");
        let mut velocity = Observation::default();
        if !self.has_clock(place) {
            let common = self.initial_velocities(node, run).into_iter().next();
            velocity = constant(&common.unwrap_or_else(Fraction::zero));
        }
        let delay = -&self.leads[place];
        velocity.waves.push(seen(wave, delay, &Fraction::one()));
        velocity
    }

    /// The velocity of a bar at the right end (share 1) or the left end (0), endless or not.
    fn velocity_at_end(&self, bar: ElementIndex, share: &Fraction) -> Observation {
        match self.scaled.model.bars[&bar].travel {
            Some(_) => self.velocity_in(bar, share),
            None => self.velocity_in(bar, &Fraction::zero()),
        }
    }

    /// The node of an element, and its run there; of a spring the one at its left.
    fn place_of(&self, element: ElementIndex) -> Option<(usize, &Node<Fraction>, usize)> {
        let place = self.layout.node_of(element)?;
        let node = &self.layout.nodes[place];
        Some((place, node, node.elements[node.place(element)?].run))
    }

    /// The velocity of what moves as one: a mass, a support, a load.
    fn velocity_of(&self, element: ElementIndex) -> Option<Observation> {
        let (place, node, run) = self.place_of(element)?;
        let spring = matches!(self.scaled.model.lumps[&element], ModelLump::Spring(..));
        (!spring).then(|| self.velocity_of_run(place, node, run))
    }

    /// How fast a spring shortens.
    pub(crate) fn closing_of(&self, element: ElementIndex) -> Option<Observation> {
        let (place, node, run) = self.place_of(element)?;
        let mut closing = self.velocity_of_run(place, node, run);
        add(&mut closing, &self.velocity_of_run(place, node, run + 1), &-&Fraction::one());
        Some(closing)
    }

    fn compression_of(&mut self, element: ElementIndex) -> Option<Observation> {
        if !matches!(self.scaled.model.lumps.get(&element)?, ModelLump::Spring(..)) {
            return None;
        }
        match self.own_wave(Role::Compression(element), element) {
            Some(compression) => Some(compression),
            None => {
                let closing = self.closing_of(element)?;
                Some(self.integrated(&closing))
            }
        }
    }

    /// The wave of an element, as seen at its node.
    fn own_wave(&self, role: Role, element: ElementIndex) -> Option<Observation> {
        let wave = self.wave(role)?;
        let place = self.layout.node_of(element)?;
        let waves = vec![seen(wave, -&self.leads[place], &Fraction::one())];
        Some(Observation { waves, forcing: Expression::zero() })
    }

    fn force_of(&self, element: ElementIndex) -> Option<Observation> {
        let mut force = Observation::default();
        let (role, stiffness, damping, velocity) = match self.scaled.model.lumps.get(&element)? {
            ModelLump::Spring(k, d) => {
                (Role::Compression(element), k, d, self.closing_of(element)?)
            }
            ModelLump::Support(k, d) => {
                (Role::Displacement(element), k, d, self.velocity_of(element)?)
            }
            _ => return None,
        };
        if let Some(wave) = self.own_wave(role, element) {
            add(&mut force, &wave, stiffness);
        }
        if !damping.is_zero() {
            add(&mut force, &velocity, damping);
        }
        Some(force)
    }

    fn momentum_of(&mut self, element: ElementIndex) -> Option<Observation> {
        if let Some(ModelLump::Mass(mass, _)) = self.scaled.model.lumps.get(&element) {
            let mass = mass.clone();
            let mut momentum = Observation::default();
            add(&mut momentum, &self.velocity_of(element)?, &mass);
            return Some(momentum);
        }
        let data = self.scaled.model.bars.get(&element)?.clone();
        let mut momentum = match &data.travel {
            Some(travel) => constant(&(&(&data.impedance * travel) * &data.velocity)),
            None if data.velocity.is_zero() && data.force.is_zero() => Observation::default(),
            None => return None,
        };
        let place = self.layout.bar(element)?;
        let [left, right] = self.layout.ends[place];
        for (role, node) in [(Role::Right(element), left), (Role::Left(element), right)] {
            let (Some(wave), Some(node)) = (self.wave(role), node) else { continue };
            let integral = self.integral(wave);
            let entered = -&self.leads[node];
            momentum.waves.push(seen(integral, entered.clone(), &data.impedance));
            if let Some(travel) = &data.travel {
                momentum.waves.push(seen(integral, &entered + travel, &-&data.impedance));
            }
        }
        Some(momentum)
    }

    /// A sum of energies.
    fn energies(&mut self, name: &str, terms: &[Seen]) -> Result<Observed, NetworkError> {
        let refuse = |reason| Err(NetworkError::Unobservable { name: name.to_owned(), reason });
        let mut parts = Vec::new();
        for term in terms {
            if term.measure != Measure::Energy {
                return refuse(Unobservable::MixedEnergy);
            }
            let elements = match &term.place {
                Place::Element(element) => vec![*element],
                Place::Line => self.scaled.scene.line.elements.clone(),
                _ => return refuse(Unobservable::EnergyOfSection),
            };
            for element in elements {
                let Some(energy) = self.energy_of(element) else {
                    return refuse(Unobservable::InfiniteEnergy);
                };
                parts.extend(energy.into_iter().map(|part| EnergyTerm {
                    coefficient: &part.coefficient * &term.coefficient,
                    ..part
                }));
            }
        }
        let scale = &self.scaled.model.scale;
        let unit = scale.force().times(&scale.velocity).times(&scale.time);
        let dimension =
            if self.scaled.scene.dimensional { Dimension::ENERGY } else { Dimension::NONE };
        Ok(Observed { name: name.to_owned(), value: ObservedValue::Energy(parts), unit, dimension })
    }

    /// Kinetic and elastic energy: `M v²/2`, `k α²/2`, and in a bar `Z ∫ (w₊² + w₋²) dt` over the
    /// waves that are on their way.
    pub(crate) fn energy_of(&self, element: ElementIndex) -> Option<Vec<EnergyTerm>> {
        let half = Rational::new(1.into(), 2.into());
        let now = |coefficient: &Fraction, of: Observation| EnergyTerm {
            coefficient: coefficient.scale(&half),
            of,
            before: Fraction::zero(),
            window: Window::Now,
        };
        let Some(lump) = self.scaled.model.lumps.get(&element) else {
            return self.energy_in(element);
        };
        Some(match lump {
            ModelLump::Mass(mass, _) => vec![now(mass, self.velocity_of(element)?)],
            ModelLump::Spring(stiffness, _) => {
                let wave = self.own_wave(Role::Compression(element), element);
                wave.map(|wave| now(stiffness, wave)).into_iter().collect()
            }
            ModelLump::Support(stiffness, _) => {
                let wave = self.own_wave(Role::Displacement(element), element);
                wave.map(|wave| now(stiffness, wave)).into_iter().collect()
            }
            ModelLump::Load(..) => Vec::new(),
            ModelLump::Hertz(..) => return None,
        })
    }

    fn energy_in(&self, bar: ElementIndex) -> Option<Vec<EnergyTerm>> {
        let data = &self.scaled.model.bars[&bar];
        let still = data.velocity.is_zero() && data.force.is_zero();
        if data.travel.is_none() && !still {
            return None;
        }
        let place = self.layout.bar(bar)?;
        let [left, right] = self.layout.ends[place];
        let half = Rational::new(1.into(), 2.into());
        // The uniform state at the start as two waves: (V ± X_0/Z)/2.
        let pressed = match data.force.is_zero() {
            true => Fraction::zero(),
            false => Root::from(data.force.clone())
                .over(&Root::from(data.impedance.clone()))
                .ok()?
                .exact()?,
        };
        let ways = [
            (Role::Right(bar), left, (&data.velocity + &pressed).scale(&half)),
            (Role::Left(bar), right, (&data.velocity - &pressed).scale(&half)),
        ];
        let parts = ways.into_iter().filter_map(|(role, node, before)| {
            let mut of = constant(&before);
            of.waves.push(seen(self.wave(role)?, -&self.leads[node?], &Fraction::one()));
            let window = data.travel.clone().map_or(Window::Always, Window::Last);
            Some(EnergyTerm { coefficient: data.impedance.clone(), of, before, window })
        });
        Some(parts.collect())
    }
}

fn constant(value: &Fraction) -> Observation {
    Observation { waves: Vec::new(), forcing: value.clone().into() }
}

fn seen(wave: WaveIndex, delay: Fraction, coefficient: &Fraction) -> ObservedWave {
    ObservedWave { coefficient: coefficient.clone().into(), wave, slope: false, delay }
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
