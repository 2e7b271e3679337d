//! Observables of a scene across all phases of its contacts.
//!
//! An observable is a sum of parts: waves with their delays, motions of nodes, compressions of springs.
//! In a bar, at the time `s` from its left end, the wave that left the left end at `t − s` meets the one
//! that left the right end at `t − (τ − s)`. Energies and momenta of bodies are sums over bars instead.

use crate::ball::Number;
use crate::evaluate::EvaluateError;
use crate::expression::{Fraction, Root};
use crate::history::engine::Engine;
use crate::history::error::{HistoryError, NotFollowed};
use crate::history::history::{History, unit};
use crate::history::moment::Moment;
use crate::history::part::{Part, Signal, Source};
use crate::network::{Lumped, Network, Side, bar_roots};
use crate::scene::{Body, ElementIndex, Kind, Measure, Observable, Place, Position, Seen};

type Outcome<T> = Result<T, HistoryError>;

impl History {
    /// The observable of this name.
    pub(crate) fn observable<'a>(
        network: &'a Network,
        name: &str,
    ) -> Result<&'a Observable, HistoryError> {
        let mut observables = network.scene().observables.iter();
        observables
            .find(|own| own.name == name)
            .ok_or_else(|| HistoryError::NoObservable(name.to_owned()))
    }
}

/// A section of a bar: its place in the line, and the time of a wave from the left end, or from the end
/// of an endless bar.
struct Section {
    bar: usize,
    at: Fraction,
}

fn refuse<T>(reason: NotFollowed) -> Outcome<T> {
    Err(reason.into())
}

impl Engine {
    /// What a term of an observable is made of, in the user's units.
    ///
    /// # Errors
    /// [`HistoryError::Refused`] for energies and momenta, and for what is not measured.
    pub fn parts(&self, network: &Network, seen: &Seen) -> Outcome<Vec<Part>> {
        if matches!(seen.measure, Measure::Energy | Measure::Momentum) {
            return refuse(NotFollowed::EnergyOrMomentum);
        }
        let bits = self.cut.bits;
        let coefficient = self.clock.number(&seen.coefficient)?;
        let unit = self.unit_of(network, seen.measure)?.multiply(&coefficient, bits);
        let Some(section) = self.section(network, &seen.place)? else {
            let Place::Element(element) = &seen.place else {
                return refuse(NotFollowed::NoPlace);
            };
            return self.lumped(seen.measure, *element, &unit);
        };
        let end_force = match seen.measure {
            Measure::Force | Measure::Strain | Measure::Stress => self.end_force(&seen.place),
            _ => None,
        };
        let impedance = self.bars[section.bar].0.multiply(&unit, bits);
        let (factors, integrated) = match seen.measure {
            Measure::Velocity => ([unit.clone(), unit], false),
            Measure::Displacement => ([unit.clone(), unit], true),
            Measure::Force => {
                if let Some(sources) = end_force {
                    return Ok(sources.map(|source| Part::of(source, unit.clone())).collect());
                }
                ([impedance.clone(), impedance.negate()], false)
            }
            Measure::Strain | Measure::Stress => {
                let over = self.stiffness_of(network, &section, seen.measure)?.reciprocal(bits)?;
                if let Some(sources) = end_force {
                    let tension = unit.multiply(&over, bits).negate();
                    return Ok(sources.map(|source| Part::of(source, tension.clone())).collect());
                }
                let tension = impedance.multiply(&over, bits);
                ([tension.negate(), tension], false)
            }
            _ => return refuse(NotFollowed::NoMeasure),
        };
        let delays = self.delays(&section).into_iter();
        let parts = delays.zip(factors).enumerate().map(|(direction, (delay, factor))| {
            let source = Source::Wave { bar: section.bar, direction };
            Part { source, delay, factor, integrated }
        });
        Ok(parts.collect())
    }

    /// What the force at the end of a bar is, where it is known without the waves: that of a contact
    /// without a mass between, and none at a free end.
    fn end_force(&self, place: &Place) -> Option<impl Iterator<Item = Source>> {
        let (element, side) = match place {
            Place::Left(element) => (*element, 0),
            Place::Right(element) => (*element, 1),
            _ => return None,
        };
        let node = self.layout.ends[self.layout.bar(element)?][side]?;
        let own = &self.nodes[node];
        // The bar is at the other side of its node.
        let run = own.side_runs()[1 - side];
        if own.is_held(run) || own.attached(run).next().is_some() {
            return None;
        }
        let force = |place| Source::Node { node, signal: Signal::Force(place) };
        let contact = if side == 1 { own.contact_right_of(run) } else { own.contact_left_of(run) };
        match contact {
            Some(place) => Some(Some(force(place)).into_iter()),
            None if own.links.is_empty() && [own.left, own.right][side] == Side::Free => {
                Some(None.into_iter())
            }
            None => None,
        }
    }

    /// What 1 of a measure is in the user's units.
    fn unit_of(&self, network: &Network, measure: Measure) -> Outcome<Number> {
        let scale = &network.model().scale;
        let root = match measure {
            Measure::Velocity => scale.velocity.clone(),
            Measure::Force | Measure::Strain | Measure::Stress => scale.force(),
            Measure::Displacement | Measure::Compression => scale.velocity.times(&scale.time),
            Measure::Momentum => scale.force().times(&scale.time),
            Measure::Energy => scale.force().times(&scale.velocity).times(&scale.time),
        };
        Ok(unit(&root, &self.clock.numbers, self.cut.bits)?)
    }

    /// What a force in a bar is divided by to be a strain, or a stress.
    fn stiffness_of(
        &self,
        network: &Network,
        section: &Section,
        measure: Measure,
    ) -> Outcome<Number> {
        let element = self.layout.bars[section.bar];
        let Kind::Bar(bar) = &network.scene().elements[element].kind else {
            return refuse(NotFollowed::NotInBar);
        };
        let over = match (&bar.body, measure) {
            (Body::Solid { area, .. }, Measure::Stress) => Root::from(area.clone()),
            (_, Measure::Stress) => return refuse(NotFollowed::NoArea),
            (body, _) => bar_roots(body).map_err(EvaluateError::from)?.2,
        };
        Ok(unit(&over, &self.clock.numbers, self.cut.bits)?)
    }

    /// Velocity, displacement, force or compression of a lumped element, in multiples of a unit.
    fn lumped(&self, measure: Measure, element: ElementIndex, one: &Number) -> Outcome<Vec<Part>> {
        let bits = self.cut.bits;
        let Some(node) = self.layout.node_of(element) else {
            return refuse(NotFollowed::WholeBar);
        };
        let part = |signal, factor| Part::of(Source::Node { node, signal }, factor);
        let own = &self.nodes[node];
        let Lumped { run, law, .. } =
            &own.elements[own.place(element).expect("an element of its node")];
        let run = *run;
        if let Some([stiffness, damping]) = law.resistance() {
            let place = own.yielding().position(|own| own.element == element);
            let yielded = Signal::Yield(place.expect("it yields"));
            match measure {
                // A damper alone has no spring that remembers: what its ends have moved tells.
                Measure::Compression if stiffness.is_zero() => {
                    let mut parts = vec![part(Signal::Displacement(run), one.clone())];
                    if law.is_link() {
                        parts.push(part(Signal::Displacement(run + 1), one.negate()));
                    }
                    return Ok(parts);
                }
                Measure::Compression => return Ok(vec![part(yielded, one.clone())]),
                Measure::Force => {
                    // A contact at a bare end of a spring presses as the spring does.
                    let left = own.contact_left_of(run).filter(|_| own.is_bare(run));
                    let right = || own.contact_right_of(run + 1).filter(|_| own.is_bare(run + 1));
                    if law.is_link()
                        && let Some(place) = left.or_else(right)
                    {
                        return Ok(vec![part(Signal::Force(place), one.clone())]);
                    }
                    let damping = damping.multiply(one, bits);
                    let mut parts = vec![part(yielded, stiffness.multiply(one, bits))];
                    if !damping.is_zero() {
                        if law.is_link() {
                            parts.push(part(Signal::Velocity(run + 1), damping.negate()));
                        }
                        parts.push(part(Signal::Velocity(run), damping));
                    }
                    return Ok(parts);
                }
                _ => {}
            }
        }
        if law.is_link() {
            return Err(NotFollowed::TwoVelocities.into());
        }
        match measure {
            Measure::Velocity => Ok(vec![part(Signal::Velocity(run), one.clone())]),
            Measure::Displacement => Ok(vec![part(Signal::Displacement(run), one.clone())]),
            _ => refuse(NotFollowed::NoMeasure),
        }
    }

    /// Energy or momentum of an element or of the whole line, in the user's units.
    pub fn held_in(&self, network: &Network, seen: &Seen, moment: &Moment) -> Outcome<Number> {
        let line = &network.scene().line.elements;
        let part = match &seen.place {
            Place::Element(element) => {
                let place = line.iter().position(|other| other == element);
                let place = place.expect("an element of the line");
                place..place + 1
            }
            _ => 0..line.len(),
        };
        let held = self.held_by(network, &part, moment)?;
        let value = match seen.measure {
            Measure::Energy => held.energy,
            _ => held.momentum,
        };
        let Some(value) = value else {
            return refuse(NotFollowed::InfiniteEnergy);
        };
        let coefficient = self.clock.number(&seen.coefficient)?;
        let unit = self.unit_of(network, seen.measure)?.multiply(&coefficient, self.cut.bits);
        Ok(value.multiply(&unit, self.cut.bits))
    }

    /// Where a place is; none where it is no section of a bar.
    fn section(&self, network: &Network, place: &Place) -> Outcome<Option<Section>> {
        let (element, position) = match place {
            Place::Left(element) => (element, None),
            Place::Right(element) | Place::At(element, _) => (element, Some(place)),
            Place::Element(_) | Place::Line => return Ok(None),
        };
        let Some(bar) = self.layout.bar(*element) else { return Ok(None) };
        let travel = &self.bars[bar].1;
        let at = match (position, travel) {
            (None, _) | (Some(Place::Right(_)), None) => Fraction::zero(),
            (Some(Place::At(_, Position::Share(share))), Some(travel)) => share * travel,
            (Some(Place::At(_, Position::Distance(distance))), _) => {
                let Kind::Bar(own) = &network.scene().elements[*element].kind else {
                    return Ok(None);
                };
                let time = match &own.body {
                    Body::Impedance { .. } => Root::from(distance.clone()),
                    Body::Solid { modulus, density, .. } => {
                        let slowness = Root::of(density.clone()).over(&Root::of(modulus.clone()));
                        let Ok(slowness) = slowness else {
                            return refuse(NotFollowed::NoWaveSpeed);
                        };
                        Root::from(distance.clone()).times(&slowness)
                    }
                };
                let scaled = time.over(&network.model().scale.time).ok();
                match scaled.and_then(|time| time.exact()) {
                    Some(exact) => exact,
                    None => {
                        return refuse(NotFollowed::IrrationalSection);
                    }
                }
            }
            (_, Some(travel)) => travel.clone(),
            (_, None) => Fraction::zero(),
        };
        Ok(Some(Section { bar, at }))
    }

    /// The delays of the waves to the right and to the left at a section; none for what arrives in an
    /// endless bar.
    fn delays(&self, section: &Section) -> [Option<Fraction>; 2] {
        let ends = &self.layout.ends[section.bar];
        match &self.bars[section.bar].1 {
            Some(travel) => [Some(section.at.clone()), Some(travel - &section.at)],
            None => ends.map(|end| end.map(|_| section.at.clone())),
        }
    }
}
