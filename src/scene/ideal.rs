//! Bars in which waves do not matter: a rigid one is a mass, one that is strained uniformly is a spring with a share
//! of its mass at each end that can move.
//!
//! Where a bar deforms uniformly its velocity is linear in `ξ`, the share of its length. With one end held its
//! kinetic energy is that of a third of its mass at the other: `½ ∫_0^1 m ξ² v² dξ = ½ (m/3) v²` (Rayleigh).

use crate::expression::{Fraction, NotAUnit, free_name};
use crate::scene::{
    Bar, Body, Dimension, Element, ElementIndex, End, Joint, Kind, Line, Mass, Measure, Observable,
    Place, Position, Scene, Seen, Spring,
};
use wavestep_polynomial::Rational;

/// What a bar is where waves in it are left out.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Ideal {
    /// It does not yield.
    Rigid,
    /// It is strained uniformly at every time.
    Spring {
        /// The share of its mass at each end that can move: a third where one end is held, else a half.
        share: Option<Fraction>,
        /// The rate `ω` at which it swings with the masses at its one moving end, where its stiffness is told by that:
        /// `k = ω² M`.
        rate: Option<Fraction>,
    },
}

/// The elements that a bar has become.
enum Now {
    /// One, which was no such bar or is a mass now.
    One(ElementIndex),
    /// A spring, and masses at the ends that can move.
    Spring { masses: [Option<ElementIndex>; 2], spring: ElementIndex },
}

impl Now {
    fn elements(&self) -> impl Iterator<Item = ElementIndex> + use<> {
        let all = match *self {
            Now::One(own) => [None, Some(own), None],
            Now::Spring { masses: [left, right], spring } => [left, Some(spring), right],
        };
        all.into_iter().flatten()
    }
}

fn number(numerator: i64, denominator: i64) -> Fraction {
    Fraction::constant(&Rational::new(numerator.into(), denominator.into()))
}

/// Mass and stiffness of a finite bar, and what a force is divided by for its strain.
fn properties(body: &Body) -> Result<[Fraction; 3], NotAUnit> {
    let none = Fraction::zero();
    Ok(match body {
        Body::Impedance { impedance, travel } => {
            let travel = travel.as_ref().unwrap_or(&none);
            [impedance * travel, impedance * &travel.inverse()?, impedance.clone()]
        }
        Body::Solid { area, modulus, density, length } => {
            let (length, carries) = (length.as_ref().unwrap_or(&none), area * modulus);
            [&(density * area) * length, &carries * &length.inverse()?, carries]
        }
    })
}

impl Scene {
    /// The same scene with masses and springs in the place of ideal bars.
    ///
    /// # Errors
    /// A length or a travel time that may be zero; [`Scene::faults`] finds it before.
    pub fn expanded(&self) -> Result<Scene, NotAUnit> {
        let is_ideal = |own: &Element| matches!(&own.kind, Kind::Bar(bar) if bar.ideal.is_some());
        if !self.elements.iter().any(is_ideal) {
            return Ok(self.clone());
        }
        let mut elements = Vec::new();
        let mut now = Vec::with_capacity(self.elements.len());
        for index in 0..self.elements.len() {
            now.push(self.expand(index, &mut elements)?);
        }
        let (of_line, joints, gaps) = Default::default();
        let mut line = Line { elements: of_line, joints, gaps, ..self.line };
        for (place, joint) in self.line.joints.iter().enumerate() {
            let gap = self.line.gaps.get(&place);
            line.gaps.extend(gap.map(|gap| (line.joints.len(), gap.clone())));
            line.joints.push(*joint);
            let Some(own) = self.line.elements.get(place) else { break };
            let parts: Vec<_> = now[*own].elements().collect();
            line.joints.extend(parts.iter().skip(1).map(|_| Joint::Bonded));
            line.elements.extend(parts);
        }
        let observables = self.observables.iter().map(|observable| {
            let terms = observable.terms.iter().map(|seen| self.seen(seen, &now));
            let terms = terms.collect::<Result<Vec<_>, _>>()?.concat();
            Ok(Observable { name: observable.name.clone(), terms })
        });
        let observables = observables.collect::<Result<_, _>>()?;
        Ok(Scene { elements, line, observables, ..self.clone() })
    }

    /// All lumped masses.
    fn masses(&self) -> Fraction {
        let masses = self.elements.iter().filter_map(|own| match &own.kind {
            Kind::Mass(mass) => Some(&mass.mass),
            _ => None,
        });
        masses.fold(Fraction::zero(), |sum, mass| &sum + mass)
    }

    /// `ω² = k/(M + m/3)`, where the line is one bar with a held end and masses at the other.
    pub(crate) fn square_of_rate(&self) -> Option<Result<Fraction, NotAUnit>> {
        let mut bar = None;
        for (index, element) in self.elements.iter().enumerate() {
            match &element.kind {
                Kind::Bar(own) if bar.is_none() => bar = Some((index, own)),
                Kind::Mass(_) => {}
                _ => return None,
            }
        }
        let (index, bar) = bar.filter(|(index, _)| self.is_held(*index) != [false; 2])?;
        let of = |[mass, stiffness, _]: [Fraction; 3]| {
            let whole = &(&mass * &number(1, 3)) + &self.masses();
            Ok(&stiffness * &whole.inverse()?)
        };
        (self.is_held(index) != [true; 2]).then(|| properties(&bar.body).and_then(of))
    }

    /// Whether the left and the right end of an element are joined to a fixed end of the line.
    pub(super) fn is_held(&self, element: ElementIndex) -> [bool; 2] {
        let Line { left, elements, right, .. } = &self.line;
        let at =
            |end: &End, last: Option<&ElementIndex>| *end == End::Fixed && last == Some(&element);
        [at(left, elements.first()), at(right, elements.last())]
    }

    /// Whether a contact between an element and a fixed end may open.
    pub(super) fn may_part_from_a_wall(&self, element: ElementIndex) -> bool {
        let joints = [self.line.joints.first(), self.line.joints.last()];
        let mut ends = self.is_held(element).into_iter().zip(joints);
        self.contacts_open && ends.any(|(held, joint)| held && joint == Some(&Joint::Contact))
    }

    fn expand(&self, index: ElementIndex, elements: &mut Vec<Element>) -> Result<Now, NotAUnit> {
        let Element { name, kind } = &self.elements[index];
        let mut add = |name: String, kind| {
            elements.push(Element { name, kind });
            elements.len() - 1
        };
        let Kind::Bar(bar @ Bar { ideal: Some(ideal), velocity, .. }) = kind else {
            return Ok(Now::One(add(name.clone(), kind.clone())));
        };
        let [mass, stiffness, _] = properties(&bar.body)?;
        let velocity = velocity.clone();
        let (share, rate) = match ideal {
            Ideal::Rigid => {
                let mass = Kind::Mass(Mass { mass, velocity });
                return Ok(Now::One(add(name.clone(), mass)));
            }
            Ideal::Spring { share, rate } => (share, rate),
        };
        let held = self.is_held(index);
        let usual = if held == [false; 2] { number(1, 2) } else { number(1, 3) };
        let share = &mass * share.as_ref().unwrap_or(&usual);
        let stiffness = match rate {
            Some(rate) => &rate.pow(2) * &(&share + &self.masses()),
            None => stiffness,
        };
        let masses = [0, 1].map(|side: usize| {
            let own = format!("{name}_{}", ["left", "right"][side]);
            let own = free_name(own, |own| self.elements.iter().any(|other| other.name == own));
            let mass = Mass { mass: share.clone(), velocity: velocity.clone() };
            (!held[side]).then(|| add(own, Kind::Mass(mass)))
        });
        let spring = Kind::Spring(Spring { stiffness, damping: Fraction::zero() });
        Ok(Now::Spring { masses, spring: add(name.clone(), spring) })
    }

    /// The same place of an element that has another number now; a bar that has become a mass has no sections.
    fn moved(&self, place: &Place, own: ElementIndex, before: ElementIndex) -> Place {
        let is_rigid = matches!(&self.elements[before].kind, Kind::Bar(bar) if bar.ideal.is_some());
        match place {
            Place::Left(_) if !is_rigid => Place::Left(own),
            Place::Right(_) if !is_rigid => Place::Right(own),
            Place::At(_, position) if !is_rigid => Place::At(own, position.clone()),
            _ => Place::Element(own),
        }
    }

    /// A term of an observable by what is there now.
    fn seen(&self, seen: &Seen, now: &[Now]) -> Result<Vec<Seen>, NotAUnit> {
        let Some(element) = seen.place.element() else {
            // The momentum of a line is that of its elements, since a share of a mass does not have that of a bar.
            let is_spring = |own: &Now| matches!(own, Now::Spring { .. });
            if seen.measure != Measure::Momentum || !now.iter().any(is_spring) {
                return Ok(vec![seen.clone()]);
            }
            let moves = |own: &&ElementIndex| {
                matches!(self.elements[**own].kind, Kind::Bar(_) | Kind::Mass(_))
            };
            let own = |own: &ElementIndex| Seen { place: Place::Element(*own), ..seen.clone() };
            let terms = self.line.elements.iter().filter(moves).map(own);
            let terms = terms.map(|seen| self.seen(&seen, now));
            return Ok(terms.collect::<Result<Vec<_>, _>>()?.concat());
        };
        let at = |place| Seen { place, ..seen.clone() };
        let (masses, spring) = match &now[element] {
            Now::Spring { masses, spring } => (*masses, *spring),
            Now::One(own) => return Ok(vec![at(self.moved(&seen.place, *own, element))]),
        };
        let Kind::Bar(bar) = &self.elements[element].kind else { return Ok(vec![seen.clone()]) };
        let [mass, _, carries] = properties(&bar.body)?;
        let weighted = |measure, own, factor: &Fraction, dimension: Dimension| Seen {
            coefficient: &seen.coefficient * factor,
            dimension: seen.dimension.times(dimension),
            measure,
            place: Place::Element(own),
        };
        let ends = |measure, factors: [Fraction; 2], dimension| {
            let both =
                masses.into_iter().zip(factors).filter_map(|(own, factor)| Some((own?, factor)));
            both.map(|(own, factor)| weighted(measure, own, &factor, dimension)).collect()
        };
        let pulls = |carries: &Fraction, dimension| {
            let factor = -&carries.inverse()?;
            Ok(vec![weighted(Measure::Force, spring, &factor, dimension)])
        };
        match seen.measure {
            Measure::Velocity | Measure::Displacement => {
                let share = section(bar, &seen.place)?;
                let factors = [&Fraction::one() - &share, share];
                Ok(ends(seen.measure, factors, Dimension::NONE))
            }
            Measure::Momentum => {
                let half = mass.scale(&Rational::new(1.into(), 2.into()));
                Ok(ends(Measure::Velocity, [half.clone(), half], Dimension::MASS))
            }
            Measure::Energy => {
                Ok(now[element].elements().map(|own| at(Place::Element(own))).collect())
            }
            Measure::Strain => pulls(&carries, Dimension::FORCE.inverse()),
            Measure::Stress => match &bar.body {
                Body::Solid { area, .. } => pulls(area, Dimension::AREA.inverse()),
                Body::Impedance { .. } => Ok(vec![seen.clone()]),
            },
            Measure::Force | Measure::Compression => Ok(vec![at(Place::Element(spring))]),
            // Refused before.
            Measure::Work => Ok(vec![seen.clone()]),
        }
    }
}

/// The share of the length of a bar at which a section lies.
fn section(bar: &Bar, place: &Place) -> Result<Fraction, NotAUnit> {
    Ok(match place {
        Place::Right(_) => Fraction::one(),
        Place::At(_, Position::Share(share)) => share.clone(),
        Place::At(_, Position::Distance(distance)) => {
            let length = bar.extent().cloned().unwrap_or_else(Fraction::zero);
            distance * &length.inverse()?
        }
        Place::Left(_) | Place::Element(_) | Place::Line => Fraction::zero(),
    })
}
