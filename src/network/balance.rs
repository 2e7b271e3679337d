//! What changes energies and momenta: the power or the force that flows in.
//!
//! What a bar holds changes by what enters at its left and leaves at its right: its energy by the power
//! `X v`, its momentum by the force `X`. Where two bars with the same coefficient
//! meet, what leaves one enters the other. In a sum over the whole line with one coefficient all that flows
//! from one element to the next cancels: at an open contact `X = 0`, at a closed one both sides move
//! together, and where bars or springs meet something else no motion is lost at once. What is left is the loss in
//! dampers, or the force of walls and supports.

use crate::expression::{Expression, Fraction};
use crate::network::layout::Layout;
use crate::network::measures::{MeasuredValue, Passage, loads_alone, vanishes};
use crate::network::node::{ElementLaw, Lumped};
use crate::network::observed::{ObservedValue, Squared, Window};
use crate::network::reading::{Face, Field, Lump, Reading, Section, section};
use crate::network::scaled::ScaledScene;
use crate::scene::{
    Drive, ElementIndex, End, Joint, Kind, Measure, Observable, Place, Scene, Seen,
};

/// A coefficient times the product of one or two readings.
#[derive(Clone)]
pub(super) struct Flow {
    pub coefficient: Fraction,
    pub factors: Vec<Reading>,
    /// When it is not zero, where that is known: while one of these loads acts.
    pub loads: Option<Vec<ElementIndex>>,
    /// A function of time that it is multiplied with.
    pub course: Option<Expression>,
}

impl Flow {
    fn new(coefficient: Fraction, factors: Vec<Reading>) -> Flow {
        Flow { coefficient, factors, loads: None, course: None }
    }
}

/// The power that passes a section of a bar is the product of these.
const POWER: [Field; 2] = [Field::Force, Field::Velocity];

/// The terms of the derivative of an observable with respect to time, in the scales of the scene, where it
/// is an energy or a momentum whose balance is known; `power` is that of the work in it.
pub(super) fn flow(
    scaled: &ScaledScene,
    observable: &Observable,
    power: &[Flow],
) -> Option<Vec<Flow>> {
    // The work at a section is in the power.
    let is_held =
        |seen: &&Seen| seen.measure != Measure::Work || matches!(seen.place, Place::Element(_));
    let terms: Vec<&Seen> = observable.terms.iter().filter(is_held).collect();
    if power.is_empty() {
        return into_elements(scaled, &terms, Loads::Together);
    }
    let mut all = power.to_vec();
    // What the line loses apart from what its elements hold, so that what is counted twice cancels.
    let (line, own) = terms.into_iter().partition::<Vec<_>, _>(|seen| seen.place == Place::Line);
    all.extend(into_elements(scaled, &line, Loads::Apart)?);
    let balance = Balance { scaled, measure: Measure::Energy };
    for seen in own {
        let element = seen.place.element()?;
        let through_bar = balance.through_bar(element, [false; 2]);
        let into = through_bar.or_else(|| balance.through_lump(element))?;
        all.extend(times(into, &seen.coefficient));
    }
    Some(joined(all))
}

/// The same with one term for one product; what cancels is left out.
fn joined(terms: Vec<Flow>) -> Vec<Flow> {
    let mut sum: Vec<Flow> = Vec::new();
    for term in terms {
        let is_same = |own: &&mut Flow| {
            (&own.factors, &own.loads, &own.course) == (&term.factors, &term.loads, &term.course)
        };
        match sum.iter_mut().find(is_same) {
            Some(own) => own.coefficient = &own.coefficient + &term.coefficient,
            None => sum.push(term),
        }
    }
    sum.retain(|term| !term.coefficient.is_zero());
    sum
}

/// The power of the work that is done at these places.
pub(super) fn power(scaled: &ScaledScene, passed: &[(Fraction, Passage)]) -> Vec<Flow> {
    let balance = Balance { scaled, measure: Measure::Work };
    let power =
        |(coefficient, passage): &(Fraction, Passage)| times(balance.power(passage), coefficient);
    passed.iter().flat_map(power).collect()
}

/// How the loads of one place are told.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Loads {
    /// As one, by the balance of the place.
    Together,
    /// Each as it is given, as in the work of one of them.
    Apart,
}

/// The flow into what elements hold: terms of one measure.
fn into_elements(scaled: &ScaledScene, terms: &[&Seen], loads: Loads) -> Option<Vec<Flow>> {
    let scene = &scaled.scene;
    // The work on a spring without damping is its energy.
    let kind = |seen: &&Seen| if seen.measure.is_energy() { Measure::Energy } else { seen.measure };
    let Some(measure) = terms.first().map(kind) else { return Some(Vec::new()) };
    if terms.iter().any(|seen| kind(seen) != measure) {
        return None;
    }
    let coefficient = |element: &ElementIndex| {
        let mut sum = Fraction::zero();
        for seen in terms {
            if seen.place.element().is_none_or(|own| own == *element) {
                sum = &sum + &seen.coefficient;
            }
        }
        sum
    };
    let elements = &scene.line.elements;
    let own: Vec<(ElementIndex, Fraction)> =
        elements.iter().map(|element| (*element, coefficient(element))).collect();
    let balance = Balance { scaled, measure };
    if own.iter().all(|(_, coefficient)| *coefficient == own[0].1) {
        let terms = match measure {
            Measure::Energy => balance.losses(loads)?,
            Measure::Momentum => balance.outer_forces()?,
            _ => return None,
        };
        return Some(times(terms, &own[0].1));
    }
    let mut all = Vec::new();
    for (place, (element, coefficient)) in own.iter().enumerate() {
        if coefficient.is_zero() {
            continue;
        }
        // What leaves one bar enters the next.
        let goes_on = |neighbour: Option<&(ElementIndex, Fraction)>| {
            neighbour.is_some_and(|(next, other)| {
                other == coefficient && scaled.layout.bar(*next).is_some()
            })
        };
        let left = place.checked_sub(1).and_then(|place| own.get(place));
        let inner = [goes_on(left), goes_on(own.get(place + 1))];
        all.extend(times(balance.through_bar(*element, inner)?, coefficient));
    }
    Some(all)
}

fn times(terms: Vec<Flow>, coefficient: &Fraction) -> Vec<Flow> {
    let times = |own: Flow| Flow { coefficient: &own.coefficient * coefficient, ..own };
    terms.into_iter().map(times).collect()
}

struct Balance<'a> {
    scaled: &'a ScaledScene,
    measure: Measure,
}

impl Balance<'_> {
    fn layout(&self) -> &Layout {
        &self.scaled.layout
    }

    /// The lumped elements with their laws.
    fn lumps(&self) -> impl Iterator<Item = (Lump, &ElementLaw<Fraction>)> {
        (0..).zip(&self.layout().nodes).flat_map(|(node, own)| {
            let lump = move |place| Lump { node, place };
            (0..).zip(&own.elements).map(move |(place, own)| (lump(place), &own.law))
        })
    }

    /// What loads add to the energy of the line, and what dampers take from it; none where a mass may meet another or a wall
    /// with nothing between them that gives way.
    fn losses(&self, loads: Loads) -> Option<Vec<Flow>> {
        if has_hard_contacts(&self.scaled.scene) {
            return None;
        }
        let mut terms = Vec::new();
        for (lump, law) in self.lumps() {
            match law {
                ElementLaw::Load(drive) => {
                    let node = &self.layout().nodes[lump.node];
                    let is_imposed = node.is_imposed(node.elements[lump.place].run);
                    let force = match loads {
                        Loads::Apart if !is_imposed && !self.is_alone(lump) => {
                            vec![self.given(lump)]
                        }
                        _ => self.pushed(lump, *drive)?,
                    };
                    terms.extend(Balance::supplied(force, lump))
                }
                _ => terms.extend(self.damper(lump)),
            }
        }
        Some(terms)
    }

    /// The power that passes a place, or that a damper takes, or a load gives.
    fn power(&self, passage: &Passage) -> Vec<Flow> {
        match passage {
            Passage::Section(section) => {
                self.through(section, &POWER, Fraction::one()).into_iter().collect()
            }
            Passage::Damper(lump) => times(self.damper(*lump), &-&Fraction::one()),
            Passage::Load(lump) => {
                let law = &self.layout().nodes[lump.node].elements[lump.place].law;
                let ElementLaw::Load(drive) = law else { return Vec::new() };
                let force = if self.is_alone(*lump) { self.pushed(*lump, *drive) } else { None };
                Balance::supplied(force.unwrap_or_else(|| vec![self.given(*lump)]), *lump)
            }
        }
    }

    /// Whether a load is the only one of its place.
    fn is_alone(&self, lump: Lump) -> bool {
        let node = &self.layout().nodes[lump.node];
        let all = node.attached(node.elements[lump.place].run);
        all.filter(|own| matches!(own.law, ElementLaw::Load(_))).count() == 1
    }

    /// The power of a force that acts at a place.
    fn supplied(mut force: Vec<Flow>, lump: Lump) -> Vec<Flow> {
        force.iter_mut().for_each(|term| term.factors.push(Reading::Velocity(Face::Left(lump))));
        force
    }

    /// What the damping of a spring or a support takes from its energy.
    fn damper(&self, lump: Lump) -> Vec<Flow> {
        let [left, right] = [Face::Left(lump), Face::Right(lump)].map(Reading::Velocity);
        let law = &self.layout().nodes[lump.node].elements[lump.place].law;
        let Some([_, damping]) = law.resistance().filter(|[_, damping]| !damping.is_zero()) else {
            return Vec::new();
        };
        let mut terms = vec![Flow::new(-damping, vec![left.clone(), left.clone()])];
        if law.is_link() {
            terms.push(Flow::new(damping + damping, vec![left, right.clone()]));
            terms.push(Flow::new(-damping, vec![right.clone(), right]));
        }
        terms
    }

    /// What flows into the energy of a spring, a local contact or a support; a load has none.
    fn through_lump(&self, element: ElementIndex) -> Option<Vec<Flow>> {
        let node = self.layout().node_of(element)?;
        let lump = Lump { node, place: self.layout().nodes[node].place(element)? };
        match self.layout().nodes[node].elements[lump.place].law {
            ElementLaw::Mass { .. } => None,
            ElementLaw::Load(_) => Some(Vec::new()),
            ref law => {
                let power = |sign, face| {
                    Flow::new(sign, vec![Reading::Force(lump), Reading::Velocity(face)])
                };
                let mut into = vec![power(Fraction::one(), Face::Left(lump))];
                if law.is_link() {
                    into.push(power(-&Fraction::one(), Face::Right(lump)));
                }
                into.extend(self.damper(lump));
                Some(into)
            }
        }
    }

    /// The force of a load: by the balance of its place, which leaves out what does not move, or else as it is given.
    fn pushed(&self, lump: Lump, drive: Drive) -> Option<Vec<Flow>> {
        self.balanced(lump).or_else(|| (drive == Drive::Force).then(|| vec![self.given(lump)]))
    }

    /// The force of a load as it is given.
    fn given(&self, lump: Lump) -> Flow {
        let load = self.layout().nodes[lump.node].elements[lump.place].element;
        let course = Some(self.scaled.model.loads[&load].course.clone());
        Flow { loads: Some(vec![load]), course, ..Flow::new(Fraction::one(), Vec::new()) }
    }

    /// The total force of the loads of a place, by the balance there: what bars, springs and supports take up. Nothing for all
    /// but the first load of the place; `None` where a mass takes up some of it, or may do so across a contact.
    fn balanced(&self, lump: Lump) -> Option<Vec<Flow>> {
        let node = &self.layout().nodes[lump.node];
        let own: Vec<(usize, &Lumped<Fraction>)> = (0..)
            .zip(&node.elements)
            .filter(|(_, other)| other.run == node.elements[lump.place].run && !other.law.is_link())
            .collect();
        let (mut loads, mut forces, mut first_load) = (Vec::new(), Vec::new(), None);
        for (place, other) in &own {
            match &other.law {
                ElementLaw::Load(_) => {
                    first_load.get_or_insert(*place);
                    loads.push(other.element);
                }
                ElementLaw::Support { .. } => {
                    forces.push((Fraction::one(), Reading::Force(Lump { place: *place, ..lump })));
                }
                _ => return None,
            }
        }
        let line = &self.scaled.scene.line;
        let place_of = |element| line.elements.iter().position(|other| *other == element);
        let places: Vec<usize> =
            own.iter().map(|(_, other)| place_of(other.element)).collect::<Option<_>>()?;
        let (first, last) = (*places.iter().min()?, *places.iter().max()?);
        let beside = [(first.checked_sub(1), line.left), (Some(last + 1), line.right)];
        for (side, (next, end)) in (0..).zip(beside) {
            match next.and_then(|next| line.elements.get(next)) {
                // The right side of what is at the left, and the other way round.
                Some(element) => {
                    let sign = if side == 0 { -&Fraction::one() } else { Fraction::one() };
                    forces.push((sign, self.force_at_end(*element, 1 - side)?));
                }
                None if end == End::Free => {}
                None => return None,
            }
        }
        if first_load != Some(lump.place) {
            return Some(Vec::new());
        }
        let flow = |(coefficient, force)| {
            let loads = Some(loads.clone());
            Flow { loads, ..Flow::new(coefficient, vec![force]) }
        };
        Some(forces.into_iter().map(flow).collect())
    }

    /// The forces of walls, supports and loads on the line; none where a load imposes a velocity.
    fn outer_forces(&self) -> Option<Vec<Flow>> {
        let line = &self.scaled.scene.line;
        let mut terms = Vec::new();
        for (side, end, element) in
            [(0, line.left, line.elements.first()), (1, line.right, line.elements.last())]
        {
            if end == End::Fixed {
                let sign = if side == 0 { Fraction::one() } else { -&Fraction::one() };
                terms.push(Flow::new(sign, vec![self.force_at_end(*element?, side)?]));
            }
        }
        for (lump, law) in self.lumps() {
            match law {
                // What imposes a velocity holds its place before and after.
                ElementLaw::Load(Drive::Velocity) => return None,
                ElementLaw::Load(drive) => terms.extend(self.pushed(lump, *drive)?),
                ElementLaw::Support { .. } => {
                    terms.push(Flow::new(-&Fraction::one(), vec![Reading::Force(lump)]));
                }
                _ => {}
            }
        }
        Some(terms)
    }

    /// The force at the left (0) or right (1) side of a bar or a spring.
    fn force_at_end(&self, element: ElementIndex, side: usize) -> Option<Reading> {
        if let Some(bar) = self.layout().bar(element) {
            return Some(Reading::InBar(Field::Force, self.end(bar, side)));
        }
        let node = self.layout().node_of(element)?;
        let place = self.layout().nodes[node].place(element)?;
        let is_spring = matches!(self.scaled.scene.elements[element].kind, Kind::Spring(_));
        is_spring.then_some(Reading::Force(Lump { node, place }))
    }

    /// The section at the left (0) or right (1) end of a bar.
    fn end(&self, bar: usize, side: usize) -> Section {
        let travel = &self.scaled.model.bars[&self.layout().bars[bar]].travel;
        let time = travel.clone().filter(|_| side == 1).unwrap_or_else(Fraction::zero);
        section(self.layout(), &self.scaled.model, bar, time)
    }

    /// What enters a bar at its left and leaves at its right, except at inner ends.
    fn through_bar(&self, element: ElementIndex, inner: [bool; 2]) -> Option<Vec<Flow>> {
        let bar = self.layout().bar(element)?;
        let fields: &[Field] = match self.measure {
            Measure::Energy => &POWER,
            Measure::Momentum => &[Field::Force],
            _ => return None,
        };
        let mut terms = Vec::new();
        let is_outer = |side: &usize| self.layout().ends[bar][*side].is_some() && !inner[*side];
        for side in (0..2).filter(is_outer) {
            let sign = if side == 0 { Fraction::one() } else { -&Fraction::one() };
            terms.extend(self.through(&self.end(bar, side), fields, sign));
        }
        Some(terms)
    }

    /// What passes a section to the right, the product of these fields; none where a boundary condition makes it zero.
    fn through(&self, section: &Section, fields: &[Field], sign: Fraction) -> Option<Flow> {
        let (scene, layout) = (&self.scaled.scene, self.layout());
        if fields.iter().any(|field| vanishes(scene, layout, *field, section)) {
            return None;
        }
        let loads = loads_alone(scene, layout, Field::Force, section);
        let factors = fields.iter().map(|field| Reading::InBar(*field, section.clone())).collect();
        Some(Flow { loads, ..Flow::new(sign, factors) })
    }
}

/// Whether two masses, or a mass and a wall, may hit each other with nothing between them that gives way: energy is lost
/// at once then.
fn has_hard_contacts(scene: &Scene) -> bool {
    let line = &scene.line;
    // Whether a mass or a wall comes before, with nothing that gives way since; whether a contact that opens does.
    let (mut meets, mut opens) = (line.left == End::Fixed, false);
    let kinds = line.elements.iter().map(|element| Some(&scene.elements[*element].kind));
    for (joint, kind) in line.joints.iter().zip(kinds.chain([None])) {
        opens |= scene.contacts_open && *joint == Joint::Contact;
        let is_hard = match kind {
            Some(Kind::Bar(_) | Kind::Spring(_) | Kind::Hertz(_)) => {
                (meets, opens) = (false, false);
                continue;
            }
            Some(Kind::Support(_) | Kind::Load(_)) => continue,
            Some(Kind::Mass(_)) => true,
            None => line.right == End::Fixed,
        };
        if is_hard && meets && opens {
            return true;
        }
        (meets, opens) = (true, false);
    }
    false
}

/// A momentum or an energy at the start, when springs are relaxed; `None` where the velocity of masses that begin together
/// cannot be given.
pub(super) fn at_start(
    scaled: &ScaledScene,
    value: &MeasuredValue,
    parts: &ObservedValue,
) -> Option<Fraction> {
    let mut sum = Fraction::zero();
    if let MeasuredValue::Linear(terms) = value {
        for term in terms {
            sum = &sum + &(&term.coefficient * &reading_at_start(scaled, &term.of)?);
        }
    }
    if let ObservedValue::Energy(energies) = parts {
        for part in &energies.held {
            let square = match (&part.window, &part.squared) {
                (Window::Last(travel), _) => &part.before.pow(2) * travel,
                // A local contact is not compressed.
                (Window::Now, Squared::Reading(own)) if part.times.is_none() => {
                    reading_at_start(scaled, own)?.pow(2)
                }
                (Window::Now | Window::Always, _) => Fraction::zero(),
            };
            sum = &sum + &(&part.coefficient * &square);
        }
    }
    Some(sum)
}

fn reading_at_start(scaled: &ScaledScene, reading: &Reading) -> Option<Fraction> {
    Some(match reading {
        Reading::Momentum(bar) => {
            let bar = &scaled.model.bars[&scaled.layout.bars[*bar]];
            let held = bar.travel.as_ref().map(|travel| &bar.impedance * travel);
            held.map_or_else(Fraction::zero, |held| &held * &bar.velocity)
        }
        Reading::Velocity(face) => velocity_at_start(&scaled.layout, *face)?,
        _ => Fraction::zero(),
    })
}

/// That of the masses of a run, which begin with the momentum that they have together.
fn velocity_at_start(layout: &Layout, face: Face) -> Option<Fraction> {
    let node = &layout.nodes[face.lump().node];
    let run = node.run_beside(face);
    if node.is_held(run) {
        return Some(Fraction::zero());
    }
    let (mut total, mut momentum, mut velocities) =
        (Fraction::zero(), Fraction::zero(), Vec::new());
    for own in node.attached(run) {
        if let ElementLaw::Mass { mass, velocity } = &own.law {
            total = &total + mass;
            momentum = &momentum + &(mass * velocity);
            velocities.push(velocity);
        }
    }
    match velocities.split_first() {
        None => Some(Fraction::zero()),
        Some((first, others)) if others.iter().all(|own| own == first) => Some((*first).clone()),
        Some(_) => Some(&momentum * &total.inverse().ok()?),
    }
}
