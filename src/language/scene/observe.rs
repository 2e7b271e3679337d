//! Observables: measures, and the places where they are taken.

use super::tree::{ObservedTerm, SceneStatementKind, Section, Unit};
use super::{Lowering, Outcome};
use crate::expression::Fraction;
use crate::language::syntax::{Expression as Tree, Name, Node, Operator, Sign, Spanned};
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
        Ok(Some(Seen { coefficient, measure: term.measure.value, place }))
    }

    fn coefficient(&self, term: &ObservedTerm) -> Outcome<Fraction> {
        const WHAT: &str = "the factor of a measure";
        let mut factors = term.factors.clone();
        if factors.first().is_some_and(|first| first.operator == Operator::Divide) {
            let one = Tree::new(
                Node::Number(wavestep_polynomial::Rational::from_integer(1.into())),
                term.place.span,
            );
            let first =
                crate::language::syntax::Factor { operator: Operator::Multiply, value: one };
            factors.insert(0, first);
        }
        let value = match factors.len() {
            0 => Fraction::one(),
            _ => {
                for factor in &factors {
                    self.refuse_strangers(&factor.value)?;
                }
                let span = factors[0].value.span;
                let product = Spanned::new(Node::Product(factors), span);
                let value = self.scope.lower_constant(&product, WHAT)?;
                value.as_fraction().ok_or_else(|| {
                    self.scope
                        .error(format!("{WHAT} holds no exponential"), span, "holds an exponential")
                        .with_remedy("introduce a symbol for it")
                })?
            }
        };
        Ok(if term.sign == Sign::Minus { -&value } else { value })
    }

    fn place(&self, term: &ObservedTerm) -> Outcome<Option<Place>> {
        let place = &term.place.value;
        if place.element.value == "line" {
            return match &place.section {
                None => Ok(Some(Place::Line)),
                Some(_) => Err(self
                    .scope
                    .error("the line as a whole has no sections", term.place.span, "not a bar")
                    .with_remedy("name a bar, as in `rod.left`")),
            };
        }
        let element = self.element(&place.element)?;
        let Some(section) = &place.section else { return Ok(Some(Place::Element(element))) };
        let known = &self.elements[element];
        let kind = known.declaration.kind;
        if kind != super::Declared::Bar {
            let name = &place.element.value;
            return Err(self
                .scope
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
                .scope
                .error("an endless bar has no length to take a share of", tree.span, "a share")
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
