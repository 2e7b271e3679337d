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
use crate::network::node::Side;
use crate::network::reading::{Elements, Face, Field, Reading, Section, Term, section};
use crate::scene::{
    Body, Dimension, ElementIndex, Joint, Kind, Measure, Mistake, Observable, Place, Position,
    Scene, Seen,
};
use wavestep_polynomial::Rational;

/// What an observable is.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum MeasuredValue {
    /// Linear in the motion.
    Linear(Vec<Term>),
    /// The energies of elements, with their coefficients; see [`Elements::energy`].
    Energy(Vec<(Fraction, ElementIndex)>),
}

/// An observable of a scene as a sum of readings.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Measured {
    pub name: String,
    /// In the scene's own scales.
    pub value: MeasuredValue,
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
        let energies = terms.iter().filter(|seen| seen.measure == Measure::Energy).count();
        match energies {
            0 => self.linear(name, terms),
            _ if energies == terms.len() => {
                let value = terms.iter().flat_map(|seen| self.energies(seen)).collect();
                let value = MeasuredValue::Energy(value);
                let dimension =
                    if self.scene.dimensional { Dimension::ENERGY } else { Dimension::NONE };
                let unit = unit(&self.model.scale, Measure::Energy, None)?;
                Ok(Measured { name: name.clone(), value, unit, dimension })
            }
            _ => Err(refused(Mistake::MixedDimensions)),
        }
    }

    /// The elements whose energies are added.
    fn energies(&self, seen: &Seen) -> Vec<(Fraction, ElementIndex)> {
        let elements = match seen.place.element() {
            Some(element) => vec![element],
            None => self.scene.line.elements.clone(),
        };
        elements.into_iter().map(|element| (seen.coefficient.clone(), element)).collect()
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
                    first = Some((unit, seen.measure.dimension()));
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
        let (unit, dimension) = first.unwrap_or((Fraction::one().into(), Dimension::NONE));
        let value = MeasuredValue::Linear(sum);
        Ok(Measured { name: name.to_owned(), value, unit, dimension })
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
    let Some(side) = section.end(Fraction::is_zero) else { return false };
    let Some(node) = layout.ends[section.bar][side] else { return false };
    let node = &layout.nodes[node];
    let joints = &scene.line.joints;
    let joint = if side == 0 { joints.first() } else { joints.last() };
    let may_open = scene.contacts_open && joint == Some(&Joint::Contact);
    let beyond = [node.left, node.right][side];
    node.elements.is_empty()
        && match field {
            Field::Force => beyond == Side::Free,
            Field::Velocity | Field::Displacement => beyond == Side::Fixed && !may_open,
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Source, read_scene};
    use crate::network::ScaledScene;
    use crate::network::reading::{Energy, Lump};

    fn scaled(text: &str) -> ScaledScene {
        let source = Source::new("scene", text).expect("a text");
        ScaledScene::of(&read_scene(&source, &Default::default()).expect("a scene"))
            .expect("scales")
    }

    fn number(numerator: i64, denominator: i64) -> Fraction {
        Fraction::constant(&Rational::new(numerator.into(), denominator.into()))
    }

    fn at(bar: usize, delays: [Option<(i64, i64)>; 2]) -> Section {
        Section { bar, delays: delays.map(|delay| delay.map(|(p, q)| number(p, q))) }
    }

    /// An observable, its unit, and its terms by coefficient and reading.
    type Row = (&'static str, Fraction, Vec<(Fraction, Reading)>);

    fn assert_table(scene: &ScaledScene, rows: Vec<Row>) {
        assert_eq!(scene.measures.len(), rows.len());
        for (measured, (name, unit, terms)) in scene.measures.iter().zip(rows) {
            assert_eq!((measured.name.as_str(), &measured.unit), (name, &unit.into()));
            let MeasuredValue::Linear(found) = &measured.value else { panic!("{name}: linear") };
            let found: Vec<(Fraction, Reading)> =
                found.iter().map(|term| (term.coefficient.clone(), term.of.clone())).collect();
            assert_eq!(found, terms, "{name}");
        }
    }

    /// `c` is 5000 m/s: the units are 20000 kg/s of impedance, 1/5000 s, and 1/4 m/s, to which 5 kN push.
    #[test]
    fn measures_in_units_have_those_of_the_scene() {
        let scene = scaled(
            "scene \"A\"\nload push { force = 5 kN }\n\
             bar rod { modulus = 200 GPa, density = 8000 kg/m^3, area = 5 cm^2, length = 1 m }\n\
             spring end { stiffness = 20 MN/m }\nline free - push - rod - end - fixed\n\
             observe v = velocity(rod.at(1/4))\nobserve u = displacement(rod.right)\n\
             observe F = force(rod.left)\nobserve e = strain(rod.at(1/2))\n\
             observe s = stress(rod.at(250 mm))\nobserve c = compression(end)\n\
             observe P = momentum(rod)/2\nobserve X = force(end) + force(rod.at(1/4))\n",
        );
        let quarter = || at(0, [Some((1, 4)), Some((3, 4))]);
        let (left, right) =
            (at(0, [Some((0, 1)), Some((1, 1))]), at(0, [Some((1, 1)), Some((0, 1))]));
        let (middle, end) = (at(0, [Some((1, 2)); 2]), Lump { node: 1, place: 0 });
        let one = || number(1, 1);
        let rows = vec![
            ("v", number(1, 4), vec![(one(), Reading::InBar(Field::Velocity, quarter()))]),
            ("u", number(1, 20_000), vec![(one(), Reading::InBar(Field::Displacement, right))]),
            ("F", number(5000, 1), vec![(one(), Reading::InBar(Field::Force, left))]),
            ("e", number(1, 20_000), vec![(-&one(), Reading::InBar(Field::Force, middle))]),
            ("s", number(10_000_000, 1), vec![(-&one(), Reading::InBar(Field::Force, quarter()))]),
            ("c", number(1, 20_000), vec![(one(), Reading::Compression(end))]),
            ("P", number(1, 1), vec![(number(1, 2), Reading::Momentum(0))]),
            (
                "X",
                number(5000, 1),
                vec![
                    (one(), Reading::Force(end)),
                    (one(), Reading::InBar(Field::Force, quarter())),
                ],
            ),
        ];
        assert_table(&scene, rows);
    }

    /// Endless bars are counted from their one end; a damper alone is as short as its ends tell.
    #[test]
    fn measures_without_units_are_plain_numbers() {
        let scene = scaled(
            "scene \"A\"\nbar a { impedance = 2 }\nmass m { mass = 3, velocity = 1 }\n\
             spring d { damping = 5 }\nsupport g { stiffness = 7, damping = 11 }\n\
             bar b { impedance = 4 }\nline endless - a - m - d - g - b - endless\n\
             observe F = force(a.right) - force(b.at(6))\nobserve e = strain(a.at(5))\n\
             observe v = 2*velocity(m)\nobserve u = displacement(m)\n\
             observe c = compression(d)\nobserve P = momentum(line)\n",
        );
        let lump = |place| Lump { node: 0, place };
        let (one, minus_one) = (number(1, 1), number(-1, 1));
        let in_bar = |bar, delays| Reading::InBar(Field::Force, at(bar, delays));
        let rows = vec![
            (
                "F",
                vec![
                    (one.clone(), in_bar(0, [None, Some((0, 1))])),
                    (minus_one.clone(), in_bar(1, [Some((6, 1)), None])),
                ],
            ),
            ("e", vec![(number(-1, 2), in_bar(0, [None, Some((5, 1))]))]),
            ("v", vec![(number(2, 1), Reading::Velocity(Face::Left(lump(0))))]),
            ("u", vec![(one.clone(), Reading::Displacement(Face::Left(lump(0))))]),
            (
                "c",
                vec![
                    (one.clone(), Reading::Displacement(Face::Left(lump(1)))),
                    (minus_one, Reading::Displacement(Face::Right(lump(1)))),
                ],
            ),
            (
                "P",
                vec![
                    (one.clone(), Reading::Momentum(0)),
                    (number(3, 1), Reading::Velocity(Face::Left(lump(0)))),
                    (one.clone(), Reading::Momentum(1)),
                ],
            ),
        ];
        assert_table(
            &scene,
            rows.into_iter().map(|(name, terms)| (name, one.clone(), terms)).collect(),
        );
        let elements = Elements { model: scene.model(), layout: &scene.layout };
        let force = |place| {
            let terms = elements.force(lump(place)).expect("a linear law");
            terms.into_iter().map(|term| (term.coefficient, term.of)).collect::<Vec<_>>()
        };
        let closing = [Face::Left(lump(1)), Face::Right(lump(1))].map(Reading::Velocity);
        assert_eq!(
            force(1),
            [number(5, 1), number(-5, 1)].into_iter().zip(closing).collect::<Vec<_>>()
        );
        let moved = Reading::Velocity(Face::Left(lump(2)));
        assert_eq!(
            force(2),
            [(number(7, 1), Reading::Compression(lump(2))), (number(11, 1), moved)]
        );
        let energy = |name: &str| {
            let element = scene.scene().elements.iter().position(|element| element.name == name);
            elements.energy(element.expect("an element")).expect("an energy")
        };
        let square =
            |p, q, of| vec![Energy::Square(Box::new(Term { coefficient: number(p, q), of }))];
        assert_eq!(energy("m"), square(3, 2, Reading::Velocity(Face::Left(lump(0)))));
        assert_eq!((energy("d"), energy("a")), (Vec::new(), vec![Energy::InBar(0)]));
        assert_eq!(energy("g"), square(7, 2, Reading::Compression(lump(2))));
    }

    /// What cannot be measured is refused for the reason that the scene has.
    #[test]
    fn refusals_have_their_reasons() {
        let text = "scene \"A\"\nbar a { impedance = 2, velocity = 1 }\nline fixed - a - endless\n\
                    observe v = velocity(a.left)\n";
        let source = Source::new("scene", text).expect("a text");
        let mut scene = read_scene(&source, &Default::default()).expect("a scene");
        for (measure, place, mistake) in [
            (Measure::Momentum, Place::Line, Mistake::Infinite),
            (Measure::Energy, Place::Element(0), Mistake::Infinite),
            (Measure::Stress, Place::Left(0), Mistake::NoArea),
            (Measure::Force, Place::Right(0), Mistake::NoSuchEnd),
            (
                Measure::Velocity,
                Place::At(0, Position::Share(number(1, 2))),
                Mistake::ShareOfEndless,
            ),
            (Measure::Compression, Place::Element(0), Mistake::NotMeasurable),
        ] {
            scene.observables[0].terms[0] = Seen { coefficient: number(1, 1), measure, place };
            let refused = ScaledScene::of(&scene);
            assert_eq!(
                refused,
                Err(NetworkError::Unobservable { name: "v".to_owned(), reason: mistake })
            );
        }
    }
}
