//! Checks of a scene: signs of its properties, ends and lengths that agree, elements that can do something
//! where they stand, and measures that fit their places.

use wavestep_polynomial::{Rational, Symbol};

use crate::expression::{Condition, Fraction, free_name};
use crate::limits::MAX_CONTACT_EXPONENT;
use crate::scene::fault::{Fault, Mistake, Part, Property};
use crate::scene::{
    Bar, Body, Drive, ElementIndex, End, Hertz, Ideal, Joint, Kind, LEAST_EXPONENT_INVERSE, Load,
    Measure, Place, Position, Scene, Seen, Spring,
};

impl Scene {
    /// Everything that makes the scene impossible: first the elements, then the line, then the
    /// observables. A scene with faults in elements or line is not asked about its observables.
    pub fn faults(&self) -> Vec<Fault> {
        let mut check = Check { scene: self, faults: Vec::new() };
        if !check.is_well_formed() {
            check.fault(Mistake::IllFormed, [Part::Line]);
            return check.faults;
        }
        check.elements();
        check.gaps();
        check.membership();
        if check.faults.iter().all(|fault| fault.mistake != Mistake::Repeated) {
            check.ends();
            check.places();
        }
        if check.faults.is_empty() {
            check.motion();
        }
        if check.faults.is_empty() {
            check.observables();
        }
        check.faults
    }
}

impl Scene {
    /// Why a measure cannot be taken at its place; none where it can.
    pub(crate) fn refusal(&self, seen: &Seen) -> Option<Mistake> {
        Check { scene: self, faults: Vec::new() }.observed(seen)
    }
}

struct Check<'a> {
    scene: &'a Scene,
    faults: Vec<Fault>,
}

impl Check<'_> {
    fn fault(&mut self, mistake: Mistake, parts: impl Into<Vec<Part>>) {
        self.faults.push(Fault { mistake, parts: parts.into(), value: None });
    }

    fn wrong_sign(&mut self, mistake: Mistake, part: Part, value: &Fraction) {
        self.faults.push(Fault { mistake, parts: vec![part], value: Some(value.clone()) });
    }

    fn is_well_formed(&self) -> bool {
        let Scene { elements, line, observables, .. } = self.scene;
        let exists = |element: &ElementIndex| *element < elements.len();
        let seen = observables.iter().flat_map(|observable| &observable.terms);
        !line.elements.is_empty()
            && line.joints.len() == line.elements.len() + 1
            && line.gaps.keys().all(|joint| line.joints.get(*joint) == Some(&Joint::Contact))
            && line.elements.iter().all(exists)
            && seen.filter_map(|seen| seen.place.element()).all(|element| exists(&element))
    }

    /// Whether a value is certainly zero or positive: then any positive number makes it positive.
    fn is_not_negative(&self, value: &Fraction) -> bool {
        let name = free_name("x", |name| self.scene.assumptions.declares(name));
        let small = Symbol::new(&name).expect("a plain name");
        let mut known = self.scene.assumptions.clone();
        known.declare_symbol(small.clone(), Some(Condition::above(0)));
        known.is_positive(&(value + &Fraction::symbol(&small)))
    }

    fn positive(&mut self, element: ElementIndex, property: Property, value: &Fraction) {
        if !self.scene.assumptions.is_positive(value) {
            self.wrong_sign(Mistake::NotPositive, Part::Property(element, property), value);
        }
    }

    fn not_negative(&mut self, element: ElementIndex, property: Property, value: &Fraction) {
        if !self.is_not_negative(value) {
            self.wrong_sign(Mistake::Negative, Part::Property(element, property), value);
        }
    }

    /// The signs of all properties.
    fn elements(&mut self) {
        let scene = self.scene;
        for (index, element) in scene.elements.iter().enumerate() {
            match &element.kind {
                Kind::Bar(bar) => self.bar(index, bar),
                Kind::Mass(mass) => self.positive(index, Property::Mass, &mass.mass),
                Kind::Spring(spring) | Kind::Support(spring) => self.spring(index, spring),
                Kind::Hertz(hertz) => self.hertz(index, hertz),
                Kind::Load(load) => self.load(index, load),
            }
        }
    }

    fn bar(&mut self, index: ElementIndex, bar: &Bar) {
        self.ideal(index, bar);
        match &bar.body {
            Body::Impedance { impedance, travel } => {
                self.positive(index, Property::Impedance, impedance);
                if let Some(travel) = travel {
                    self.positive(index, Property::Travel, travel);
                }
                if self.scene.dimensional && !bar.strain.is_zero() {
                    self.fault(
                        Mistake::NoWaveSpeed,
                        [Part::Property(index, Property::Strain), Part::Element(index)],
                    );
                }
            }
            Body::Solid { area, modulus, density, length } => {
                self.positive(index, Property::Area, area);
                self.positive(index, Property::Modulus, modulus);
                self.positive(index, Property::Density, density);
                if let Some(length) = length {
                    self.positive(index, Property::Length, length);
                }
            }
        }
    }

    /// A bar without waves is finite and not strained at the start, and something of it can move.
    fn ideal(&mut self, index: ElementIndex, bar: &Bar) {
        let Some(ideal) = &bar.ideal else { return };
        let held = self.scene.is_held(index);
        let refuse = |mistake| (mistake, vec![Part::Property(index, Property::As)]);
        if let Ideal::Spring { share, rate } = ideal {
            share.iter().for_each(|share| self.positive(index, Property::Share, share));
            rate.iter().for_each(|rate| self.positive(index, Property::Rate, rate));
        }
        let mistake = match ideal {
            _ if bar.is_endless() => refuse(Mistake::IdealEndless),
            _ if !bar.strain.is_zero() => {
                (Mistake::IdealStrained, vec![Part::Property(index, Property::Strain)])
            }
            _ if self.scene.may_part_from_a_wall(index) => refuse(Mistake::IdealAtWall),
            Ideal::Rigid if held != [false; 2] => refuse(Mistake::IdealHeld),
            Ideal::Spring { .. } if held == [true; 2] => refuse(Mistake::IdealHeld),
            _ => return,
        };
        self.fault(mistake.0, mistake.1);
    }

    fn spring(&mut self, index: ElementIndex, Spring { stiffness, damping }: &Spring) {
        // A support without both resists nothing; a spring would be no link.
        let is_link = matches!(self.scene.elements[index].kind, Kind::Spring(_));
        if is_link && stiffness.is_zero() && damping.is_zero() {
            return self.fault(Mistake::NoStiffness, [Part::Element(index)]);
        }
        // Of a spring what is given is positive; what is left out is zero.
        if !is_link {
            self.not_negative(index, Property::Stiffness, stiffness);
        } else if !stiffness.is_zero() {
            self.positive(index, Property::Stiffness, stiffness);
        }
        if !damping.is_zero() {
            self.not_negative(index, Property::Damping, damping);
        }
    }

    fn hertz(&mut self, index: ElementIndex, hertz: &Hertz) {
        self.positive(index, Property::Force, &hertz.force);
        self.positive(index, Property::Compression, &hertz.compression);
        let exponent = [Part::Property(index, Property::Exponent)];
        if hertz.exponent < Rational::new(1.into(), LEAST_EXPONENT_INVERSE.into()) {
            self.fault(Mistake::ExponentTooSmall, exponent);
        } else if hertz.exponent > Rational::from_integer(MAX_CONTACT_EXPONENT.into()) {
            self.fault(Mistake::ExponentTooLarge, exponent);
        }
    }

    fn load(&mut self, index: ElementIndex, load: &Load) {
        self.not_negative(index, Property::From, &load.from);
        if let Some(until) = &load.until
            && !self.scene.assumptions.is_positive(&(until - &load.from))
        {
            let parts = [Property::Until, Property::From].map(|at| Part::Property(index, at));
            self.fault(Mistake::EndsBeforeBegin, parts);
        }
    }

    /// Gaps are wide, and may close.
    fn gaps(&mut self) {
        let scene = self.scene;
        for (joint, gap) in &scene.line.gaps {
            if !scene.assumptions.is_positive(gap) {
                self.wrong_sign(Mistake::NoGap, Part::Joint(*joint), gap);
            } else if !scene.contacts_open {
                self.fault(Mistake::GapStaysClosed, [Part::Joint(*joint)]);
            }
        }
    }

    /// Each element stands in the line once.
    fn membership(&mut self) {
        let line = &self.scene.line.elements;
        for (position, element) in line.iter().enumerate() {
            if let Some(first) = line[..position].iter().position(|before| before == element) {
                let parts = [Part::Position(position), Part::Position(first)];
                self.fault(Mistake::Repeated, parts);
            }
        }
        for element in 0..self.scene.elements.len() {
            if !line.contains(&element) {
                self.fault(Mistake::Unused, [Part::Element(element), Part::Line]);
            }
        }
    }

    fn kind_at(&self, position: usize) -> &Kind {
        &self.scene.elements[self.scene.line.elements[position]].kind
    }

    /// Ends agree with what stands beside them, and inner bars have lengths.
    fn ends(&mut self) {
        let line = &self.scene.line;
        let last = line.elements.len() - 1;
        let sides = [(0, line.left, Part::Left), (last, line.right, Part::Right)];
        if last == 0
            && sides.iter().all(|(_, end, _)| *end == End::Endless)
            && matches!(self.kind_at(0), Kind::Bar(_))
        {
            let parts = [Part::Position(0), Part::Left, Part::Right];
            return self.fault(Mistake::EndlessBothSides, parts);
        }
        for (side, (position, end, part)) in sides.into_iter().enumerate() {
            let joint = side * (line.joints.len() - 1);
            if line.joints[joint] == Joint::Contact && end != End::Fixed {
                self.fault(Mistake::ContactAtEnd, [Part::Joint(joint), part]);
            }
            if end == End::Endless {
                match self.kind_at(position) {
                    Kind::Bar(bar) if bar.is_endless() => {}
                    Kind::Bar(bar) => {
                        let property = match bar.body {
                            Body::Impedance { .. } => Property::Travel,
                            Body::Solid { .. } => Property::Length,
                        };
                        let element = line.elements[position];
                        let length = Part::Property(element, property);
                        let parts = [part, Part::Position(position), length];
                        self.fault(Mistake::EndlessWithLength, parts);
                    }
                    _ => {
                        let parts = [part, Part::Position(position)];
                        self.fault(Mistake::EndlessWithoutBar, parts);
                    }
                }
            }
        }
        for position in 0..=last {
            let Kind::Bar(bar) = self.kind_at(position) else { continue };
            let goes_on = position == 0 && line.left == End::Endless
                || position == last && line.right == End::Endless;
            if bar.is_endless() && !goes_on {
                let mut parts =
                    vec![Part::Position(position), Part::Element(line.elements[position])];
                if position == last && position > 0 {
                    parts.push(Part::Right);
                } else if position == 0 && last > 0 {
                    parts.push(Part::Left);
                }
                self.fault(Mistake::NoLength, parts);
            }
        }
    }

    /// Bars, springs and local contacts part the line into places that move as one; what stands at each of them can
    /// do something.
    fn places(&mut self) {
        let line = &self.scene.line;
        let count = line.elements.len();
        let parts_line = |position: &usize| {
            matches!(self.kind_at(*position), Kind::Bar(_) | Kind::Spring(_) | Kind::Hertz(_))
        };
        let mut borders: Vec<usize> = (0..count).filter(parts_line).collect();
        borders.push(count);
        let mut start = 0;
        for border in borders {
            let here = start..border;
            let left = (start == 0).then_some((line.left, Part::Left));
            let right = (border == count).then_some((line.right, Part::Right));
            self.one_place(here.clone(), left, right);
            let before = start.checked_sub(1);
            let after = (border < count).then_some(border);
            let sides = [(left, after), (right, before)];
            for (end, spring) in sides {
                if let (Some((End::Free, end)), Some(spring)) = (end, spring)
                    && here.is_empty()
                    && matches!(self.kind_at(spring), Kind::Spring(_) | Kind::Hertz(_))
                {
                    self.fault(Mistake::Idle, [Part::Position(spring), end]);
                }
            }
            start = border + 1;
        }
    }

    fn one_place(
        &mut self,
        here: std::ops::Range<usize>,
        left: Option<(End, Part)>,
        right: Option<(End, Part)>,
    ) {
        let ends = [left, right].into_iter().flatten();
        let fixed = ends.filter_map(|(end, part)| (end == End::Fixed).then_some(part));
        let fixed: Vec<Part> = fixed.collect();
        let mut imposed = None;
        for position in here {
            if let Some(end) = fixed.iter().find(|end| !self.may_leave(position, **end)) {
                self.fault(Mistake::Held, [Part::Position(position), *end]);
                continue;
            }
            if let (Some(end), Kind::Mass(mass)) = (fixed.first(), self.kind_at(position))
                && !mass.velocity.is_zero()
                && !self.is_apart(position, *end)
            {
                self.fault(Mistake::MovesAtWall, [Part::Position(position), *end]);
            }
            let Kind::Load(load) = self.kind_at(position) else { continue };
            if load.drive == Drive::Velocity {
                match imposed {
                    None => imposed = Some(position),
                    Some(first) => {
                        let parts = [Part::Position(position), Part::Position(first)];
                        self.fault(Mistake::TwoVelocities, parts);
                    }
                }
            }
        }
    }

    /// Whether an element stands behind a contact that may open from a fixed end. What has its velocity imposed may not: while
    /// the contact is closed it would have two.
    fn may_leave(&self, position: usize, end: Part) -> bool {
        let line = &self.scene.line;
        let mut between = match end {
            Part::Left => line.joints[..=position].iter(),
            _ => line.joints[position + 1..].iter(),
        };
        let is_imposed =
            matches!(self.kind_at(position), Kind::Load(load) if load.drive == Drive::Velocity);
        self.scene.contacts_open && !is_imposed && between.any(|joint| *joint == Joint::Contact)
    }

    /// Whether a gap is between an element and an end.
    fn is_apart(&self, position: usize, end: Part) -> bool {
        let mut gaps = self.scene.line.gaps.keys();
        gaps.any(|joint| (*joint <= position) == (end == Part::Left))
    }

    /// Something sets the line in motion.
    fn motion(&mut self) {
        let mut kinds = self.scene.elements.iter().map(|element| &element.kind);
        let moves = kinds.any(|kind| match kind {
            Kind::Bar(bar) => !bar.velocity.is_zero() || !bar.strain.is_zero(),
            Kind::Mass(mass) => !mass.velocity.is_zero(),
            Kind::Load(load) => !load.course.is_zero(),
            Kind::Spring(_) | Kind::Hertz(_) | Kind::Support(_) => false,
        });
        if !moves {
            self.fault(Mistake::NothingMoves, [Part::Line]);
        }
    }

    /// Measures fit their places, and terms each other.
    fn observables(&mut self) {
        let scene = self.scene;
        for (observable, seen) in scene.observables.iter().enumerate() {
            for (term, part) in seen.terms.iter().enumerate() {
                let here = Part::Term { observable, term };
                if let Some(mistake) = self.observed(part) {
                    let mut parts = vec![here];
                    if mistake == Mistake::Infinite {
                        parts.extend(self.infinite_bar(part).map(Part::Element));
                    }
                    self.fault(mistake, parts);
                }
                let first = &seen.terms[0];
                let energy = |seen: &Seen| seen.measure.is_energy();
                let differ = part.dimension() != first.dimension();
                if (scene.dimensional && differ) || energy(part) != energy(first) {
                    let parts = [here, Part::Term { observable, term: 0 }];
                    self.fault(Mistake::MixedDimensions, parts);
                }
            }
        }
    }

    fn observed(&self, seen: &Seen) -> Option<Mistake> {
        let Seen { measure, place, .. } = seen;
        let Some(element) = place.element() else { return self.of_line(seen) };
        let kind = &self.scene.elements[element].kind;
        if !is_measurable(*measure, kind, place) {
            return Some(Mistake::NotMeasurable);
        }
        let Kind::Bar(bar) = kind else { return None };
        if bar.ideal == Some(Ideal::Rigid)
            && matches!(measure, Measure::Force | Measure::Strain | Measure::Stress)
        {
            return Some(Mistake::NoForceInRigid);
        }
        if bar.ideal.is_some() && *measure == Measure::Work {
            return Some(Mistake::NoWorkInIdeal);
        }
        if matches!(place, Place::Element(_)) {
            return self.infinite_bar(seen).map(|_| Mistake::Infinite);
        }
        match (&bar.body, measure) {
            (Body::Impedance { .. }, Measure::Stress) => Some(Mistake::NoArea),
            (Body::Impedance { .. }, Measure::Strain) if self.scene.dimensional => {
                Some(Mistake::NoWaveSpeed)
            }
            _ => self.section(element, bar, place),
        }
    }

    fn section(&self, element: ElementIndex, bar: &Bar, place: &Place) -> Option<Mistake> {
        let line = &self.scene.line;
        let goes_on_left = bar.is_endless()
            && line.left == End::Endless
            && line.elements.first() == Some(&element);
        let inside = |value: &Fraction, end: Option<&Fraction>| {
            let before_end = end.is_none_or(|end| self.is_not_negative(&(end - value)));
            if self.is_not_negative(value) && before_end { None } else { Some(Mistake::OutsideBar) }
        };
        match place {
            Place::Left(_) if goes_on_left => Some(Mistake::NoSuchEnd),
            Place::Right(_) if bar.is_endless() && !goes_on_left => Some(Mistake::NoSuchEnd),
            Place::At(_, Position::Share(_)) if bar.is_endless() => Some(Mistake::ShareOfEndless),
            Place::At(_, Position::Share(share)) => inside(share, Some(&Fraction::one())),
            Place::At(_, Position::Distance(distance)) => inside(distance, bar.extent()),
            _ => None,
        }
    }

    fn of_line(&self, seen: &Seen) -> Option<Mistake> {
        match seen.measure {
            Measure::Energy | Measure::Momentum => {
                self.infinite_bar(seen).map(|_| Mistake::Infinite)
            }
            _ => Some(Mistake::NotMeasurable),
        }
    }

    /// An endless bar with infinite energy or momentum, where it or the line is observed.
    fn infinite_bar(&self, seen: &Seen) -> Option<ElementIndex> {
        let observed = seen.place.element();
        let mut elements = self.scene.elements.iter().enumerate();
        let found = elements.find(|(index, element)| match &element.kind {
            Kind::Bar(bar) if observed.is_none_or(|observed| observed == *index) => {
                bar.is_endless() && is_infinite(seen.measure, bar)
            }
            _ => false,
        });
        found.map(|(index, _)| index)
    }
}

/// Whether an endless bar holds infinitely much of it from the start.
fn is_infinite(measure: Measure, bar: &Bar) -> bool {
    matches!(measure, Measure::Energy | Measure::Momentum)
        && !(bar.velocity.is_zero() && bar.strain.is_zero())
}

/// Whether an element as a whole, or a section of it, has a measure.
fn is_measurable(measure: Measure, kind: &Kind, place: &Place) -> bool {
    use Measure::{Compression, Displacement, Energy, Force, Momentum, Velocity, Work};
    match (kind, place) {
        (Kind::Bar(_), Place::Element(_)) => matches!(measure, Energy | Momentum),
        (Kind::Bar(_), _) => !matches!(measure, Compression | Energy | Momentum),
        (Kind::Mass(_), Place::Element(_)) => {
            matches!(measure, Velocity | Displacement | Energy | Momentum)
        }
        (Kind::Spring(_) | Kind::Hertz(_), Place::Element(_)) => {
            matches!(measure, Force | Compression | Energy | Work)
        }
        (Kind::Support(_), Place::Element(_)) => {
            matches!(measure, Velocity | Displacement | Force | Energy | Work)
        }
        (Kind::Load(load), Place::Element(_)) => {
            matches!(measure, Velocity | Displacement)
                || measure == Work && load.drive == Drive::Force
        }
        _ => false,
    }
}
