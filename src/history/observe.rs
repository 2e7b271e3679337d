//! Observables of a scene across all phases of its contacts.
//!
//! In a bar, at the time `s` from its left end, the wave that left the left end at `t − s` meets the one
//! that left the right end at `t − (τ − s)`.

use crate::evaluate::{Determined, Side};
use crate::expression::{Fraction, Root};
use crate::history::engine::Engine;
use crate::history::error::HistoryError;
use crate::history::history::{History, MAX_BITS, determined, unit};
use crate::history::moment::Moment;
use crate::history::number::Number;
use crate::history::track::Limit;
use crate::network::{Network, bar_roots};
use crate::scene::{Body, ElementIndex, Kind, Measure, Observable, Place, Position, Seen};
use wavestep_polynomial::Rational;

type Outcome<T> = Result<T, HistoryError>;

impl History {
    /// Values of an observable at times in the user's units, in metres, kilograms and seconds or as plain
    /// numbers, with the digits asked for; contacts open and close on the way. At a jump the side tells
    /// which limit is meant.
    ///
    /// # Errors
    /// As [`History::of`]; [`HistoryError::Refused`] for places that are no exact share of a travel time.
    ///
    /// ```
    /// use wavestep::evaluate::Side;
    /// use wavestep::history::History;
    /// use wavestep::language::{Source, parse_number, read_scene};
    /// use wavestep::network::Network;
    ///
    /// let text = r#"
    ///     scene "A bar strikes a wall"
    ///     bar rod { impedance = 1, travel = 1, velocity = 1 }
    ///     line free - rod | fixed
    ///     contacts open
    ///     observe v = velocity(rod.at(1/2))
    /// "#;
    /// let network = Network::new(&read_scene(&Source::new("text", text)?, &Default::default()).unwrap());
    /// let times = ["0", "1", "3"].map(|time| parse_number(time).unwrap());
    /// let values = History::values(&network.unwrap(), "v", &times, Side::Right, 9).unwrap();
    /// let told: Vec<String> = values.iter().map(|value| value.to_text(9)).collect();
    /// assert_eq!(told, ["1", "0", "-1"]);
    /// # Ok::<(), wavestep::language::Diagnostic>(())
    /// ```
    pub fn values(
        network: &Network,
        observable: &str,
        times: &[Rational],
        side: Side,
        digits: usize,
    ) -> Result<Vec<Determined>, HistoryError> {
        let observables = &network.scene().observables;
        let seen = observables.iter().find(|own| own.name == observable);
        let seen = seen.ok_or_else(|| {
            HistoryError::Refused(format!("`{observable}` is no observable of this scene"))
        })?;
        let limit = if side == Side::Left { Limit::Before } else { Limit::After };
        let mut bits = 128 + 4 * digits as u64;
        loop {
            let last = 2 * bits > MAX_BITS.max(16 * digits as u64);
            match values_with(network, seen, times, limit, bits) {
                Ok(values) => {
                    let told = values.iter().map(|value| determined(value, digits));
                    let told: Vec<Determined> = told.collect();
                    let known = |value: &Determined| matches!(value, Determined::Digits(_));
                    if last || told.iter().all(known) {
                        return Ok(told);
                    }
                }
                Err(HistoryError::Undecided { .. }) if !last => {}
                Err(error) => return Err(error),
            }
            bits *= 2;
        }
    }
}

fn values_with(
    network: &Network,
    seen: &Observable,
    times: &[Rational],
    limit: Limit,
    bits: u64,
) -> Outcome<Vec<Number>> {
    let mut engine = Engine::new(network, bits)?;
    if let Some(last) = times.iter().max() {
        engine.follow_until(&Moment::at(network.scaled_time(last)))?;
    }
    let value = |time: &Rational| {
        let moment = Moment::at(network.scaled_time(time));
        let mut sum = Number::zero();
        for term in &seen.terms {
            let coefficient = engine.clock.number(&term.coefficient)?;
            let value = engine.measured(network, term, &moment, limit)?;
            sum = sum.add(&coefficient.multiply(&value, bits), bits);
        }
        Ok(sum)
    };
    times.iter().map(value).collect()
}

/// A section of a bar: its place in the line, and the time of a wave from the left end, or from the end
/// of an endless bar.
struct Section {
    bar: usize,
    at: Fraction,
}

fn refuse<T>(reason: &str) -> Outcome<T> {
    Err(HistoryError::Refused(reason.to_owned()))
}

impl Engine {
    /// What is measured, in the user's units.
    fn measured(
        &self,
        network: &Network,
        seen: &Seen,
        moment: &Moment,
        limit: Limit,
    ) -> Outcome<Number> {
        let bits = self.cut.bits;
        let scale = &network.model().scale;
        let root = match seen.measure {
            Measure::Velocity => scale.velocity.clone(),
            Measure::Force | Measure::Strain | Measure::Stress => scale.force(),
            Measure::Displacement | Measure::Compression => scale.velocity.times(&scale.time),
            Measure::Momentum => scale.force().times(&scale.time),
            Measure::Energy => scale.force().times(&scale.velocity).times(&scale.time),
        };
        let mut unit_of_it = unit(&root, &self.clock.numbers, bits)?;
        let section = self.section(network, &seen.place)?;
        let value = match (seen.measure, &seen.place, section) {
            (Measure::Velocity, _, Some(section)) => {
                let [right, left] = self.waves_at(&section, moment, limit)?;
                right.add(&left, bits)
            }
            (Measure::Force, _, Some(section)) => self.force_at(&section, moment, limit)?,
            (Measure::Strain | Measure::Stress, _, Some(section)) => {
                let element = self.layout.bars[section.bar];
                let Kind::Bar(bar) = &network.scene().elements[element].kind else {
                    return refuse("strain and stress are seen in bars");
                };
                let over = match (&bar.body, seen.measure) {
                    (Body::Solid { area, .. }, Measure::Stress) => Root::from(area.clone()),
                    (_, Measure::Stress) => return refuse("stress needs a bar with an area"),
                    (body, _) => match bar_roots(body) {
                        Ok((_, _, stiffness)) => stiffness,
                        Err(error) => return refuse(&error.to_string()),
                    },
                };
                let over = unit(&over, &self.clock.numbers, bits)?.reciprocal(bits)?;
                unit_of_it = unit_of_it.multiply(&over, bits);
                self.force_at(&section, moment, limit)?.negate()
            }
            (Measure::Displacement, _, Some(section)) => self.displacement_at(&section, moment)?,
            (Measure::Energy | Measure::Momentum, place, _) => {
                let line = &network.scene().line.elements;
                let part = match place {
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
                match value {
                    Some(value) => value,
                    None => return refuse("an endless bar that moves has no finite energy"),
                }
            }
            (measure, Place::Element(element), _) => {
                self.lumped(measure, *element, moment, limit)?
            }
            _ => return refuse("nothing is measured there"),
        };
        Ok(value.multiply(&unit_of_it, bits))
    }

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
                        let Ok(slowness) = slowness else { return refuse("no wave speed") };
                        Root::from(distance.clone()).times(&slowness)
                    }
                };
                let scaled = time.over(&network.model().scale.time).ok();
                match scaled.and_then(|time| time.exact()) {
                    Some(exact) => exact,
                    None => {
                        return refuse(
                            "the distance of a section is no rational number of travel times: give \
                             it as a share of the length",
                        );
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

    fn waves_at(&self, section: &Section, moment: &Moment, limit: Limit) -> Outcome<[Number; 2]> {
        let mut values = Vec::new();
        let delays = self.delays(section);
        for (track, delay) in self.waves[section.bar].iter().zip(&delays) {
            values.push(match delay {
                Some(delay) => track.value(&self.clock, &moment.before(delay), limit, &self.cut)?,
                None => track.cells[0].1.coefficient(0),
            });
        }
        Ok(values.try_into().expect("two waves"))
    }

    fn force_at(&self, section: &Section, moment: &Moment, limit: Limit) -> Outcome<Number> {
        let [right, left] = self.waves_at(section, moment, limit)?;
        let bits = self.cut.bits;
        Ok(right.subtract(&left, bits).multiply(&self.bars[section.bar].0, bits))
    }

    fn displacement_at(&self, section: &Section, moment: &Moment) -> Outcome<Number> {
        let bits = self.cut.bits;
        let start = Moment::at(Fraction::zero());
        let delays = self.delays(section);
        let mut sum = Number::zero();
        for (track, delay) in self.waves[section.bar].iter().zip(&delays) {
            let part = match delay {
                Some(delay) => {
                    let window = [&start.before(delay), &moment.before(delay)];
                    track.integral(&self.clock, window, &self.cut)?
                }
                None => {
                    let time = self.clock.time(moment)?;
                    track.cells[0].1.coefficient(0).multiply(&time, bits)
                }
            };
            sum = sum.add(&part, bits);
        }
        Ok(sum)
    }

    /// Velocity, displacement, force or compression of a lumped element.
    fn lumped(
        &self,
        measure: Measure,
        element: ElementIndex,
        moment: &Moment,
        limit: Limit,
    ) -> Outcome<Number> {
        let bits = self.cut.bits;
        let Some(node) = self.layout.node_of(element) else {
            return refuse("a bar as a whole has no one velocity: name a section");
        };
        let own = &self.nodes[node];
        let (start, cell) = self.cell(node, moment, limit)?;
        let time = self.clock.since(start, moment)?;
        let mut yields = own.yields().zip(&cell.yields);
        let yields = yields.find(|((_, own, _), _)| own.element == element);
        if let (Some(((run, own, spring), series)), Measure::Force | Measure::Compression) =
            (&yields, measure)
        {
            let yielded = series.value(&time, &self.cut);
            if measure == Measure::Compression {
                return Ok(yielded);
            }
            let mut rate = cell.velocities[*run].clone();
            if *spring {
                rate = rate.subtract(&cell.velocities[run + 1], bits);
            }
            let damped = rate.value(&time, &self.cut).multiply(&own.damping, bits);
            return Ok(yielded.multiply(&own.stiffness, bits).add(&damped, bits));
        }
        let mass = own.masses.iter().find(|mass| mass.element == element).map(|mass| mass.run);
        let load = own.loads.iter().find(|load| load.element == element).map(|load| load.run);
        let support = yields.and_then(|((run, _, spring), _)| (!spring).then_some(run));
        let Some(run) = mass.or(load).or(support) else {
            return refuse("a spring has two ends with two velocities");
        };
        match measure {
            Measure::Velocity => Ok(cell.velocities[run].value(&time, &self.cut)),
            Measure::Displacement => Ok(cell.displacements[run].value(&time, &self.cut)),
            _ => refuse("nothing of that kind is measured there"),
        }
    }
}
