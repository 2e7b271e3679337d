//! The readings of the table of measures in terms of what the engine follows, across all phases of the
//! contacts; and what elements hold at an instant.

use crate::ball::Number;
use crate::expression::{Fraction, Root};
use crate::history::energy::Integrand;
use crate::history::engine::Engine;
use crate::history::error::Outcome;
use crate::history::history::unit;
use crate::history::moment::Moment;
use crate::history::part::{NodeQuantity, Part, Source};
use crate::network::{
    Elements, Energy, Field, Link, Lump, Lumped, Network, Reading, Section, Side, Term, Window,
};
use crate::scene::ElementIndex;
use crate::signal::Limit;

impl Engine {
    /// The elements of the scene, with what they hold.
    pub fn elements<'a>(&'a self, network: &'a Network) -> Elements<'a> {
        Elements { model: network.model(), layout: &self.layout }
    }

    /// What readings are the sum of, in a unit of the user's.
    pub fn parts(&self, network: &Network, terms: &[Term], one: &Root) -> Outcome<Vec<Part>> {
        let unit = unit(one, &self.clock.numbers, self.cut.bits)?;
        let mut parts = Vec::new();
        for term in terms {
            let factor = self.clock.number(&term.coefficient)?.multiply(&unit, self.cut.bits);
            parts.extend(self.reading(self.elements(network), &term.of, &factor)?);
        }
        Ok(parts)
    }

    /// A sum of parts at an instant.
    pub fn sum_of(&self, parts: &[Part], (moment, limit): (&Moment, Limit)) -> Outcome<Number> {
        let mut sum = Number::zero();
        for part in parts {
            sum = sum.add(&self.value_of(part, moment, limit)?, self.cut.bits);
        }
        Ok(sum)
    }

    /// What a reading is the sum of, times a factor.
    pub fn reading(
        &self,
        elements: Elements<'_>,
        reading: &Reading,
        factor: &Number,
    ) -> Outcome<Vec<Part>> {
        let bits = self.cut.bits;
        let one =
            |node, quantity| Ok(vec![Part::of(Source::Node { node, quantity }, factor.clone())]);
        match reading {
            Reading::InBar(field, section) => Ok(self.in_bar(*field, section, factor)),
            Reading::Momentum(bar) => {
                let (impedance, travel) = &self.bars[*bar];
                let factor = impedance.multiply(factor, bits);
                let over = travel.clone().map_or(Window::Always, Window::Last);
                let part = |(direction, end): (usize, Option<usize>)| {
                    let delay = end.map(|_| Fraction::zero());
                    let source = Source::Wave { bar: *bar, direction, delay };
                    Part { source, factor: factor.clone(), over: over.clone() }
                };
                Ok((0..).zip(self.layout.ends[*bar]).map(part).collect())
            }
            Reading::Velocity(face) => {
                let node = face.lump().node;
                one(node, NodeQuantity::Velocity(self.nodes[node].run_beside(*face)))
            }
            Reading::Displacement(face) => {
                let node = face.lump().node;
                one(node, NodeQuantity::Displacement(self.nodes[node].run_beside(*face)))
            }
            Reading::Compression(lump) => one(lump.node, NodeQuantity::Compression(lump.place)),
            Reading::Force(lump) => {
                if let Some(place) = self.contact_of_spring(*lump) {
                    return one(lump.node, NodeQuantity::Force(place));
                }
                if let Some([left, right]) = self.contacts_of_support(*lump) {
                    let of = |place, factor| {
                        let quantity = NodeQuantity::Force(place);
                        Part::of(Source::Node { node: lump.node, quantity }, factor)
                    };
                    let left = left.map(|place| of(place, factor.clone()));
                    let right = right.map(|place| of(place, factor.negate()));
                    return Ok(left.into_iter().chain(right).collect());
                }
                let mut parts = Vec::new();
                for term in elements.force(*lump).into_iter().flatten() {
                    let factor = self.clock.number(&term.coefficient)?.multiply(factor, bits);
                    parts.extend(self.reading(elements, &term.of, &factor)?);
                }
                Ok(parts)
            }
        }
    }

    /// What is read in a section of a bar.
    fn in_bar(&self, field: Field, section: &Section, factor: &Number) -> Vec<Part> {
        let (factors, over) = match field {
            Field::Velocity => ([factor.clone(), factor.clone()], Window::Now),
            Field::Displacement => ([factor.clone(), factor.clone()], Window::Always),
            Field::Force => {
                if let Some(force) = self.end_force(section) {
                    let parts = force.into_iter();
                    return parts.map(|source| Part::of(source, factor.clone())).collect();
                }
                let impedance = self.bars[section.bar].0.multiply(factor, self.cut.bits);
                ([impedance.clone(), impedance.negate()], Window::Now)
            }
        };
        let part = |(direction, (delay, factor)): (usize, (&Option<Fraction>, Number))| {
            let source = Source::Wave { bar: section.bar, direction, delay: delay.clone() };
            Part { source, factor, over: over.clone() }
        };
        (0..).zip(section.delays.iter().zip(factors)).map(part).collect()
    }

    /// What the force at the end of a bar is, where it is known without the waves: that of a contact
    /// without a mass between, or with nothing but a spring, and `Some(None)`, nothing, at a free end.
    fn end_force(&self, section: &Section) -> Option<Option<Source>> {
        let side = section.end(Fraction::is_zero)?;
        let node = self.layout.ends[section.bar][side]?;
        let own = &self.nodes[node];
        // The bar is at the other side of its node.
        let run = own.side_runs()[1 - side];
        if own.is_held(run) || own.attached(run).next().is_some() {
            return None;
        }
        let (contact, link) = match side {
            1 => (own.contact_right_of(run), Some(run)),
            _ => (own.contact_left_of(run), run.checked_sub(1)),
        };
        let spring = link.and_then(|link| match own.links.get(link)? {
            Link::Element(place) => self.contact_of_spring(Lump { node, place: *place }),
            _ => None,
        });
        match contact.or(spring) {
            Some(place) => Some(Some(Source::Node { node, quantity: NodeQuantity::Force(place) })),
            None if own.links.is_empty() && [own.left, own.right][side] == Side::Free => Some(None),
            None => None,
        }
    }

    /// The contact at a bare end of a spring, which presses as the spring does, or the one that a local contact is, by
    /// its place among those of the node.
    pub fn contact_of_spring(&self, lump: Lump) -> Option<usize> {
        let node = &self.nodes[lump.node];
        let Lumped { run, law, .. } = &node.elements[lump.place];
        if let Link::Local { .. } = node.links.get(*run)? {
            return node.contact_right_of(*run).filter(|_| law.is_link());
        }
        let left = || node.contact_left_of(*run).filter(|_| node.is_bare(*run));
        let right = || node.contact_right_of(run + 1).filter(|_| node.is_bare(run + 1));
        law.is_link().then(|| left().or_else(right)).flatten()
    }

    /// The contacts at the left and the right of a support that stands alone between them, or between one and a free end: its
    /// force is theirs, and nothing, exactly, while they are open.
    fn contacts_of_support(&self, lump: Lump) -> Option<[Option<usize>; 2]> {
        let node = &self.nodes[lump.node];
        let Lumped { run, law, .. } = &node.elements[lump.place];
        let is_contact = |link: usize| matches!(node.links.get(link), Some(Link::Contact(_)));
        let links = [run.checked_sub(1), Some(*run).filter(|run| *run < node.links.len())];
        let is_alone = !law.is_link()
            && node.attached(*run).count() == 1
            && node.sides(*run).all(|side| side == Side::Free)
            && links.into_iter().flatten().all(is_contact);
        is_alone.then(|| [node.contact_left_of(*run), node.contact_right_of(*run)])
    }

    /// The energy of an element at an instant, by the table of measures; none where it is infinite.
    pub fn energy_of(
        &self,
        elements: Elements<'_>,
        element: ElementIndex,
        (moment, limit): (&Moment, Limit),
        square: Integrand,
    ) -> Outcome<Option<Number>> {
        let bits = self.cut.bits;
        let Ok(parts) = elements.energy(element) else { return Ok(None) };
        let read = |reading: &Reading| {
            let parts = self.reading(elements, reading, &Number::one())?;
            self.sum_of(&parts, (moment, limit))
        };
        let mut energy = Number::zero();
        for part in parts {
            let value = match part {
                Energy::Square(term) => {
                    let value = read(&term.of)?;
                    let square = value.multiply(&value, bits);
                    square.multiply(&self.clock.number(&term.coefficient)?, bits)
                }
                Energy::Work(share, lump) => {
                    let work = read(&Reading::Force(lump))?;
                    let work = work.multiply(&read(&Reading::Compression(lump))?, bits);
                    work.multiply(&self.clock.number(&share)?, bits)
                }
                Energy::InBar(bar) => self.energy_in(bar, moment, square)?,
            };
            energy = energy.add(&value, bits);
        }
        Ok(Some(energy))
    }

    /// The energy of a bar, of the waves that entered in the last travel time; what comes from the far side of
    /// an endless bar is nothing.
    fn energy_in(&self, bar: usize, moment: &Moment, square: Integrand) -> Outcome<Number> {
        let (impedance, travel) = &self.bars[bar];
        let start = match travel {
            Some(travel) => moment.before(travel),
            None => Moment::at(Fraction::zero()),
        };
        let mut energy = Number::zero();
        for (track, end) in self.waves[bar].iter().zip(self.layout.ends[bar]) {
            if end.is_some() {
                let window = [&start, moment];
                let own = track.integral(square, &self.clock, window, &self.cut)?;
                energy = energy.add(&own, self.cut.bits);
            }
        }
        Ok(energy.multiply(impedance, self.cut.bits))
    }
}
