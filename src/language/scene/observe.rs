//! Observables: measures, and the places where they are taken.

use super::{Lowering, Outcome};
use crate::expression::Fraction;
use crate::language::syntax::{
    Declared, Expression as Tree, Factor, Name, Node, ObservedTerm, Operator, SceneStatementKind,
    Section, Sign, Spanned, Unit,
};
use crate::scene::{Body, Dimension, ElementIndex, Kind, Observable, Place, Position, Seen};

impl Lowering<'_> {
    /// All observables; terms at elements that are wrong themselves are left out.
    pub(super) fn observables(&mut self) -> Vec<Observable> {
        let mut observables = Vec::new();
        for statement in self.statements() {
            let SceneStatementKind::Observe { name, terms } = statement else { continue };
            let mut seen = Vec::new();
            for term in terms {
                if self.is_hopeless() {
                    return observables;
                }
                let outcome = self.seen(&term.value);
                seen.extend(self.keep(outcome).flatten());
            }
            observables.push(Observable { name: name.value.clone(), terms: seen });
        }
        observables
    }

    fn seen(&self, term: &ObservedTerm) -> Outcome<Option<Seen>> {
        let coefficient = self.coefficient(term)?;
        let Some(place) = self.place(term)? else { return Ok(None) };
        let (dimension, measure) = (Dimension::NONE, term.measure.value);
        Ok(Some(Seen { coefficient, dimension, measure, place }))
    }

    fn coefficient(&self, term: &ObservedTerm) -> Outcome<Fraction> {
        let span = match term.factors.first() {
            None => term.place.span,
            Some(Factor { operator: Operator::Divide, .. }) => term.place.span,
            Some(first) => first.value.span,
        };
        term.factors.iter().try_for_each(|factor| self.refuse_strangers(&factor.value))?;
        let product = Spanned::new(Node::Product(term.factors.clone()), span);
        let value = self.scope.lower_fraction(&product, "the factor of a measure")?;
        Ok(if term.sign == Sign::Minus { -&value } else { value })
    }

    fn place(&self, term: &ObservedTerm) -> Outcome<Option<Place>> {
        let place = &term.place.value;
        if place.element.value == "line" {
            return match &place.section {
                None => Ok(Some(Place::Line)),
                Some(_) => Err(self
                    .error("the line as a whole has no sections", term.place.span, "not a bar")
                    .with_remedy("name a bar, as in `rod.left`")),
            };
        }
        let element = self.element(&place.element)?;
        let Some(section) = &place.section else { return Ok(Some(Place::Element(element))) };
        let known = &self.elements[element];
        let kind = known.declaration.kind;
        if kind != Declared::Bar {
            let name = &place.element.value;
            return Err(self
                .error(
                    "only bars have sections",
                    term.place.span,
                    format!("`{name}` is a {}", kind.noun()),
                )
                .with_secondary(known.declaration.name.span, "declared here")
                .with_remedy(format!("write `{name}` alone")));
        }
        match section {
            Section::Left => Ok(Some(Place::Left(element))),
            Section::Right => Ok(Some(Place::Right(element))),
            Section::At { position, unit } => {
                let found = self.position(element, &place.element, position, unit.as_ref())?;
                Ok(found.map(|position| Place::At(element, position)))
            }
        }
    }

    /// A share of a finite bar, or a distance; `None` if the bar is wrong itself.
    fn position(
        &self,
        element: ElementIndex,
        name: &Name,
        tree: &Tree,
        unit: Option<&Unit>,
    ) -> Outcome<Option<Position>> {
        const SHARE: &str = "a share of the length";
        const DISTANCE: &str = "a distance";
        const TRAVEL: &str = "a travel time";
        let Some(Kind::Bar(bar)) = &self.elements[element].kind else { return Ok(None) };
        let (what, needed) = match bar.body {
            Body::Impedance { .. } => (TRAVEL, Dimension::TIME),
            Body::Solid { .. } => (DISTANCE, Dimension::LENGTH),
        };
        if unit.is_some() {
            return self.quantity(tree, unit, needed, what).map(Position::Distance).map(Some);
        }
        let value = self.quantity(tree, None, Dimension::NONE, SHARE)?;
        let is_distance = bar.is_endless() && (self.unit.is_none() || value.is_zero());
        if bar.is_endless() && !is_distance {
            let symbol = needed.unit();
            let shown = self.shown(tree);
            return Err(self
                .error(
                    "an endless bar has no length, so a fraction of it has no meaning",
                    tree.span,
                    "a fraction",
                )
                .with_secondary(
                    self.elements[element].declaration.name.span,
                    format!("`{}` is endless", name.value),
                )
                .with_remedy(format!("give {what} from its end, as in `at({shown} {symbol})`")));
        }
        Ok(Some(match is_distance {
            true => Position::Distance(value),
            false => Position::Share(value),
        }))
    }
}
