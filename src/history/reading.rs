//! What is read off nodes and contacts, once they have been followed to an instant.

use crate::ball::Number;
use crate::expression::Fraction;
use crate::history::engine::{Cell, Engine};
use crate::history::error::Outcome;
use crate::history::moment::Moment;
use crate::history::series::Series;
use crate::network::{Contact, Node, Side};
use crate::signal::Limit;
use std::cmp::Ordering;

impl Engine {
    /// The force of a contact and the velocities beside it at an instant.
    pub fn beside(
        &self,
        contact: usize,
        moment: &Moment,
        limit: Limit,
    ) -> Outcome<(Number, [Number; 2])> {
        let Contact { node, run, .. } = self.layout.contacts[contact];
        let own = &self.nodes[node];
        let start = Moment::at(Fraction::zero());
        if limit == Limit::Left && self.clock.compare(moment, &start)? == Ordering::Equal {
            let value = |run: usize| self.velocity_before(own, run);
            return Ok((Number::zero(), [value(run), value(run + 1)]));
        }
        let (start, cell) = self.cell(node, moment, limit)?;
        let length = self.clock.since(start, moment)?;
        let place = own.contacts().position(|(own, _)| own == contact);
        let force = &cell.forces[place.expect("a contact of the node")];
        let value = |series: &Series| series.value(&length, &self.cut);
        let velocities = [value(&cell.velocities[run]), value(&cell.velocities[run + 1])];
        Ok((value(force), velocities))
    }

    /// The gap of a contact at an instant.
    pub fn gap(&self, contact: usize, moment: &Moment) -> Outcome<Number> {
        let node = self.layout.contacts[contact].node;
        let (start, cell) = self.cell(node, moment, Limit::Right)?;
        let place = self.nodes[node].contacts().position(|(own, _)| own == contact);
        let gap = &cell.gaps[place.expect("a contact of the node")];
        Ok(gap.value(&self.clock.since(start, moment)?, &self.cut))
    }

    /// `∫ F dt` of a contact from one instant to another.
    pub fn impulse(&self, contact: usize, [from, to]: [&Moment; 2]) -> Outcome<Number> {
        let node = self.layout.contacts[contact].node;
        let place = self.nodes[node].contacts().position(|(own, _)| own == contact);
        let place = place.expect("a contact of the node");
        let mut sum = Number::zero();
        let first = self.cell_number(node, from, Limit::Right)?;
        let last = self.cell_number(node, to, Limit::Left)?;
        for number in first..=last {
            let (start, cell) = self.cells[node].get(number);
            let force = &cell.forces[place];
            if force.is_zero() {
                continue;
            }
            let begin = if number == first { from } else { start };
            let end = if number == last { to } else { self.end_of(node, number) };
            let shifted = force.shift(&self.clock.since(start, begin)?, &self.cut);
            let length = self.clock.since(begin, end)?;
            let part = shifted.integral(Number::zero(), &self.cut).value(&length, &self.cut);
            sum = sum.add(&part, self.cut.bits);
        }
        Ok(sum)
    }

    /// The cell of a node at an instant, with its start.
    pub fn cell(&self, node: usize, moment: &Moment, limit: Limit) -> Outcome<(&Moment, &Cell)> {
        let (start, cell) = self.cells[node].get(self.cell_number(node, moment, limit)?);
        Ok((start, cell))
    }

    /// Where the n-th cell of a node ends.
    fn end_of(&self, node: usize, number: usize) -> &Moment {
        self.cells[node].end_of(number, self.now(node))
    }

    fn cell_number(&self, node: usize, moment: &Moment, limit: Limit) -> Outcome<usize> {
        self.cells[node].find(&self.clock, (moment, limit), self.now(node))
    }

    /// The velocity beside a contact before the start: of a mass, a bar or a wall; of a spring, that of what it rests on,
    /// and zero between two contacts.
    fn velocity_before(&self, node: &Node<Number>, run: usize) -> Number {
        if node.is_held(run) {
            return Number::zero();
        }
        if let Some(velocity) = self.starting_velocity(node, run) {
            return velocity;
        }
        let is_bar = |side: &Side| matches!(side, Side::Bar(_));
        if let Some(Side::Bar(bar)) = node.sides(run).find(is_bar) {
            let [right, left] = &self.waves[bar];
            let sum = right.before().add(left.before(), self.cut.bits);
            return sum.coefficient(0);
        }
        let mut springs = node.elements.iter().filter(|own| own.law.is_link());
        let next = springs.find_map(|own| match run {
            run if run == own.run => Some(own.run + 1),
            run if run == own.run + 1 => Some(own.run),
            _ => None,
        });
        let is_known = |next: &usize| {
            node.sides(*next).any(|side| side != Side::Free)
                || self.starting_velocity(node, *next).is_some()
        };
        next.filter(is_known).map_or_else(Number::zero, |next| self.velocity_before(node, next))
    }
}
