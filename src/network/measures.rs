//! The table of measures: what can be observed where, said once for all solvers.
//!
//! A velocity, displacement, strain, stress, force, compression, momentum or energy, in a section of a
//! bar, at its end, of an element or of the whole line, is a sum of a few kinds of [`Reading`]s with exact
//! coefficients, in one unit. Solvers read these sums and say only what each reading is to them: the
//! echoes as delayed waves, the method of steps as series, a rigid body as its motion.

use crate::expression::{Fraction, Root};
use crate::network::error::NetworkError;
use crate::network::layout::Layout;
use crate::network::model::{Model, Scale, bar_roots};
use crate::network::node::{ElementLaw, Lumped, Side};
use crate::network::reading::{Elements, Face, Field, Lump, Reading, Section, Term, section};
use crate::scene::{
    Body, Dimension, Drive, ElementIndex, Joint, Kind, Measure, Mistake, Observable, Place,
    Position, Scene, Seen,
};
use std::collections::BTreeMap;
use wavestep_polynomial::Rational;

/// What an observable is.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum MeasuredValue {
    /// Linear in the motion.
    Linear(Vec<Term>),
    /// Energies, each with its coefficient.
    Energy {
        /// What elements hold; see [`Elements::energy`].
        held: Vec<(Fraction, ElementIndex)>,
        /// What has passed since the start.
        passed: Vec<(Fraction, Passage)>,
    },
}

/// Where energy passes, since the start.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Passage {
    /// A section, to the right: `∫ X v dt`.
    Section(Section),
    /// What the damping of a spring or a support has taken.
    Damper(Lump),
    /// What a load has given.
    Load(Lump),
}

/// An observable of a scene as a sum of readings.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Measured {
    pub name: String,
    /// In the scene's own scales.
    pub value: MeasuredValue,
    /// The loads that it is zero without, by boundary conditions alone, where there are such.
    pub loads: Option<Vec<ElementIndex>>,
    /// What 1 in these scales is, in metres, kilograms and seconds.
    pub unit: Root,
    /// The dimension of the unit; none for scenes without units.
    pub dimension: Dimension,
}

/// What 1 of a measure is, in metres, kilograms and seconds. A strain or a stress is a force over what
/// carries it in the bar.
pub(crate) fn unit(
    scale: &Scale,
    measure: Measure,
    body: Option<&Body>,
) -> Result<Root, NetworkError> {
    let carries = match (measure, body) {
        (Measure::Strain, Some(body)) => bar_roots(body)?.2,
        (Measure::Stress, Some(Body::Solid { area, .. })) => Root::from(area.clone()),
        _ => return Ok(scale.unit(measure.dimension())?),
    };
    Ok(scale.force().over(&carries)?)
}

/// All observables of a scene. Ratios that are not rational are named in the model.
pub(in crate::network) fn measures(
    scene: &Scene,
    layout: &Layout,
    model: &mut Model,
) -> Result<Vec<Measured>, NetworkError> {
    let mut table = Table { scene, layout, model };
    scene.observables.iter().map(|observable| table.measured(observable)).collect()
}

struct Table<'a> {
    scene: &'a Scene,
    layout: &'a Layout,
    model: &'a mut Model,
}

impl<'a> Table<'a> {
    fn elements(&self) -> Elements<'_> {
        Elements { model: self.model, layout: self.layout }
    }

    fn measured(&mut self, observable: &Observable) -> Result<Measured, NetworkError> {
        let Observable { name, terms } = observable;
        let refused = |mistake| NetworkError::Unobservable { name: name.clone(), reason: mistake };
        if let Some(mistake) = terms.iter().find_map(|seen| self.scene.refusal(seen)) {
            return Err(refused(mistake));
        }
        match terms.iter().filter(|seen| seen.measure.is_energy()).count() {
            0 => self.linear(name, terms),
            energies if energies == terms.len() => self.energies(name, terms),
            _ => Err(refused(Mistake::MixedDimensions)),
        }
    }

    /// A sum of energies.
    fn energies(&mut self, name: &str, terms: &[Seen]) -> Result<Measured, NetworkError> {
        let (mut held, mut passed) = (BTreeMap::new(), Vec::new());
        let mut hold = |element: ElementIndex, coefficient: &Fraction| {
            let known = held.entry(element).or_insert_with(Fraction::zero);
            *known = &*known + coefficient;
        };
        for Seen { coefficient, measure, place, .. } in terms {
            let pass = |passage| (coefficient.clone(), passage);
            let Some(element) = place.element() else {
                self.scene.line.elements.iter().for_each(|element| hold(*element, coefficient));
                continue;
            };
            if *measure != Measure::Work {
                hold(element, coefficient);
                continue;
            }
            if let Some(section) = self.section(name, place)? {
                let vanishes = |field| vanishes(self.scene, self.layout, field, &section);
                if ![Field::Force, Field::Velocity].into_iter().any(vanishes) {
                    passed.push(pass(Passage::Section(section)));
                }
                continue;
            }
            let refused = |reason| NetworkError::Unobservable { name: name.to_owned(), reason };
            let lump = self.elements().lump(element).map_err(refused)?;
            match &self.layout.nodes[lump.node].elements[lump.place].law {
                ElementLaw::Load(_) => passed.push(pass(Passage::Load(lump))),
                // What its spring stores, and what its damper takes.
                law => {
                    hold(element, coefficient);
                    let damping = law.resistance().map(|[_, damping]| damping);
                    if damping.is_some_and(|damping| !damping.is_zero()) {
                        passed.push(pass(Passage::Damper(lump)));
                    }
                }
            }
        }
        let held = held.into_iter().filter(|(_, coefficient)| !coefficient.is_zero());
        let held = held.map(|(element, coefficient)| (coefficient, element)).collect();
        let dimension = if self.scene.dimensional { Dimension::ENERGY } else { Dimension::NONE };
        let (name, unit) = (name.to_owned(), unit(&self.model.scale, Measure::Energy, None)?);
        let value = MeasuredValue::Energy { held, passed };
        Ok(Measured { name, value, loads: None, unit, dimension })
    }

    /// A sum of linear measures, in the unit of the first.
    fn linear(&mut self, name: &str, terms: &[Seen]) -> Result<Measured, NetworkError> {
        let mut sum = Vec::new();
        let mut first: Option<(Root, Dimension)> = None;
        for (i, seen) in terms.iter().enumerate() {
            let (readings, unit) = self.readings(name, seen)?;
            // Without units a value is what it is.
            let ratio = match &first {
                _ if !self.scene.dimensional => Some(unit),
                Some((first, _)) => Some(unit.over(first)?),
                None => {
                    first = Some((unit, seen.dimension()));
                    None
                }
            };
            let ratio = ratio.map(|ratio| self.model.number(&format!("q_{name}_{i}"), ratio));
            let factor = &seen.coefficient * &ratio.unwrap_or_else(Fraction::one);
            sum.extend(
                readings.into_iter().map(|Term { coefficient, of }| Term {
                    coefficient: &coefficient * &factor,
                    of,
                }),
            );
        }
        // What is the same by the laws of a node adds up, perhaps to nothing.
        let known: Vec<_> = sum.iter().map(|term: &Term| self.same(&term.of)).collect();
        let cancels = |own: &Option<_>| {
            let total = sum.iter().zip(&known).filter(|(_, other)| *other == own);
            own.is_some()
                && total.fold(Fraction::zero(), |sum, (term, _)| &sum + &term.coefficient).is_zero()
        };
        let cancels: Vec<bool> = known.iter().map(cancels).collect();
        let sum: Vec<Term> =
            sum.into_iter().zip(cancels).filter(|own| !own.1).map(|own| own.0).collect();
        let (unit, dimension) = first.unwrap_or((Fraction::one().into(), Dimension::NONE));
        let loads = sum.iter().map(|term: &Term| match &term.of {
            Reading::InBar(field, section) => loads_alone(self.scene, self.layout, *field, section),
            _ => None,
        });
        let loads = loads.collect::<Option<Vec<_>>>().map(|loads| loads.concat());
        let value = MeasuredValue::Linear(sum);
        Ok(Measured { name: name.to_owned(), value, loads, unit, dimension })
    }

    /// The table itself: what a measure is at a place, and its unit.
    fn readings(&mut self, name: &str, seen: &Seen) -> Result<(Vec<Term>, Root), NetworkError> {
        let refused =
            |mistake| NetworkError::Unobservable { name: name.to_owned(), reason: mistake };
        let body = seen.place.element().and_then(|element| self.body(element));
        let unit = unit(&self.model.scale, seen.measure, body)?;
        let section = self.section(name, &seen.place)?;
        let elements = self.elements();
        let face = |element| elements.lump(element).map(Face::Left);
        let one = |reading| vec![Term::one(reading)];
        let terms = match (seen.measure, &seen.place, section) {
            (_, _, Some(section)) => self.in_bar(seen.measure, section),
            (Measure::Velocity, Place::Element(element), _) => {
                face(*element).map(|face| one(Reading::Velocity(face)))
            }
            (Measure::Displacement, Place::Element(element), _) => {
                face(*element).map(|face| one(Reading::Displacement(face)))
            }
            (Measure::Compression, Place::Element(element), _) => elements.compression(*element),
            (Measure::Force, Place::Element(element), _) => {
                elements.lump(*element).map(|lump| one(Reading::Force(lump)))
            }
            (Measure::Momentum, Place::Element(element), _) => elements.momentum(*element),
            (Measure::Momentum, Place::Line, _) => {
                let all = self.scene.line.elements.iter();
                let all: Result<Vec<_>, _> = all.map(|own| elements.momentum(*own)).collect();
                all.map(|terms| terms.into_iter().flatten().collect())
            }
            _ => Err(Mistake::NotMeasurable),
        };
        Ok((terms.map_err(refused)?, unit))
    }

    /// By what a reading is the same as others by the laws of its node: what is read, the node, and of velocities the run, of
    /// forces the first of the links from which no mass, support or load parts it.
    fn same(&self, reading: &Reading) -> Option<(Field, usize, usize)> {
        let of_run = |field, node, run| (!self.scene.contacts_open).then_some((field, node, run));
        let of_lump = |field, face: &Face| {
            let node = face.lump().node;
            of_run(field, node, self.layout.nodes[node].run_beside(*face))
        };
        let (node, link) = match reading {
            Reading::InBar(field, section) => {
                let side = section.end(Fraction::is_zero)?;
                let node = self.layout.ends[section.bar][side]?;
                // The left end of a bar is at the right side of its node.
                let run = self.layout.nodes[node].side_runs()[1 - side];
                match field {
                    Field::Force => (node, run + 1 - side),
                    _ => return of_run(*field, node, run),
                }
            }
            Reading::Velocity(face) => return of_lump(Field::Velocity, face),
            Reading::Displacement(face) => return of_lump(Field::Displacement, face),
            Reading::Force(Lump { node, place }) => {
                let own = &self.layout.nodes[*node].elements[*place];
                (*node, own.law.is_link().then_some(own.run + 1)?)
            }
            _ => return None,
        };
        let is_bare = |run: &usize| self.layout.nodes[node].attached(*run).next().is_none();
        let bare = (0..link).rev().take_while(is_bare).count();
        Some((Field::Force, node, link - bare))
    }

    fn in_bar(&self, measure: Measure, section: Section) -> Result<Vec<Term>, Mistake> {
        let (sign, field) = match measure {
            Measure::Velocity => (1, Field::Velocity),
            Measure::Displacement => (1, Field::Displacement),
            Measure::Force => (1, Field::Force),
            // Positive where it pulls.
            Measure::Strain | Measure::Stress => (-1, Field::Force),
            _ => return Err(Mistake::NotMeasurable),
        };
        if vanishes(self.scene, self.layout, field, &section) {
            return Ok(Vec::new());
        }
        let coefficient = Fraction::constant(&Rational::from_integer(sign.into()));
        Ok(vec![Term { coefficient, of: Reading::InBar(field, section) }])
    }

    fn body(&self, element: ElementIndex) -> Option<&'a Body> {
        match &self.scene.elements[element].kind {
            Kind::Bar(bar) => Some(&bar.body),
            _ => None,
        }
    }

    /// The section that a place is; none where it is no section of a bar.
    fn section(&mut self, name: &str, place: &Place) -> Result<Option<Section>, NetworkError> {
        let (Place::Left(element) | Place::Right(element) | Place::At(element, _)) = place else {
            return Ok(None);
        };
        let Some((bar, body)) = self.layout.bar(*element).zip(self.body(*element)) else {
            return Ok(None);
        };
        let travel = self.model.bars[element].travel.clone();
        // Sections of an endless bar are counted from its one end.
        let time = match (place, travel) {
            (Place::Right(_), Some(travel)) => travel,
            (Place::At(_, Position::Share(share)), Some(travel)) => share * &travel,
            (Place::At(_, Position::Distance(distance)), travel) => {
                let time = travel_time(body, distance)?;
                let own = match travel {
                    Some(_) => bar_roots(body)?.1,
                    None => Some(self.model.scale.time.clone()),
                };
                let ratio = time.over(&own.unwrap_or_else(|| Fraction::one().into()))?;
                let ratio = self.model.number(&format!("x_{name}"), ratio);
                travel.map_or_else(|| ratio.clone(), |travel| &ratio * &travel)
            }
            _ => Fraction::zero(),
        };
        Ok(Some(section(self.layout, self.model, bar, time)))
    }
}

/// Whether a boundary condition alone makes a field zero: the force at a free end, the motion at a fixed
/// one that cannot open.
pub(super) fn vanishes(scene: &Scene, layout: &Layout, field: Field, section: &Section) -> bool {
    loads_alone(scene, layout, field, section).is_some_and(|loads| loads.is_empty())
}

/// The loads that by a boundary condition are all that a field is made of: at a free end they are the force.
pub(super) fn loads_alone(
    scene: &Scene,
    layout: &Layout,
    field: Field,
    section: &Section,
) -> Option<Vec<ElementIndex>> {
    let side = section.end(Fraction::is_zero)?;
    let node = &layout.nodes[layout.ends[section.bar][side]?];
    let joints = &scene.line.joints;
    let joint = if side == 0 { joints.first() } else { joints.last() };
    let may_open = scene.contacts_open && joint == Some(&Joint::Contact);
    let beyond = [node.left, node.right][side];
    let is_force = |own: &Lumped<Fraction>| matches!(own.law, ElementLaw::Load(Drive::Force));
    let is_told = match field {
        Field::Force => beyond == Side::Free && node.elements.iter().all(is_force),
        Field::Velocity | Field::Displacement => {
            beyond == Side::Fixed && !may_open && node.elements.is_empty()
        }
    };
    is_told.then(|| node.elements.iter().map(|own| own.element).collect())
}

/// The time in which a wave goes a distance; in bars given by impedance distances are times.
fn travel_time(body: &Body, distance: &Fraction) -> Result<Root, NetworkError> {
    let distance = Root::from(distance.clone());
    Ok(match body {
        Body::Impedance { .. } => distance,
        Body::Solid { modulus, density, .. } => {
            let slowness = Root::of(density.clone()).over(&Root::of(modulus.clone()))?;
            distance.times(&slowness)
        }
    })
}
