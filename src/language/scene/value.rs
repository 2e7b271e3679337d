//! Values with units: what they are worth, and what may not stand in them.

use super::{Lowering, Meaning, Outcome, TIME, units};
use crate::expression::{Expression, Fraction};
use crate::language::linear::Place;
use crate::language::name;
use crate::language::scope::FUNCTIONS;
use crate::language::syntax::{Expression as Tree, Node, Span, Unit};
use crate::scene::Dimension;
use wavestep_polynomial::Rational;

/// What is said of a value without unit, once in a scene.
pub(super) const NEEDS_UNIT: &str = "needs a unit in this scene";

impl Lowering<'_> {
    /// An exact value of a dimension; `what` names it in errors.
    pub(super) fn quantity(
        &self,
        tree: &Tree,
        unit: Option<&Unit>,
        needed: Dimension,
        what: &'static str,
    ) -> Outcome<Fraction> {
        self.refuse_strangers(tree)?;
        let value = self.scope.lower_fraction(tree, what)?;
        let factor = self.unit_factor(tree, unit, needed, what, value.is_zero())?;
        Ok(value.scale(&factor))
    }

    /// The course of a load.
    pub(super) fn course(
        &self,
        tree: &Tree,
        unit: Option<&Unit>,
        needed: Dimension,
        what: &'static str,
    ) -> Outcome<Expression> {
        self.refuse_strangers(tree)?;
        let value = self.scope.lower(tree, Place::Equation)?.rest;
        let factor = self.unit_factor(tree, unit, needed, what, value.is_zero())?;
        Ok(value.scale(&factor))
    }

    /// What the unit of a value is worth, if it measures what is needed.
    fn unit_factor(
        &self,
        tree: &Tree,
        unit: Option<&Unit>,
        needed: Dimension,
        what: &str,
        is_zero: bool,
    ) -> Outcome<Rational> {
        let one = Rational::from_integer(1.into());
        let symbol = needed.unit();
        match (unit, self.unit) {
            (Some(unit), _) => {
                let units::Worth { value, dimension } = units::worth(&self.scope, unit)?;
                if dimension == needed {
                    return Ok(value);
                }
                let found = dimension.described();
                let (message, remedy) = match needed {
                    Dimension::NONE => (
                        format!("{what} is needed, a plain number; this is {found}"),
                        "remove the unit".to_owned(),
                    ),
                    _ => (
                        format!("{what} is needed, {}; this is {found}", needed.units()),
                        format!("give it in {symbol}"),
                    ),
                };
                Err(self.error(message, unit.span, format!("not {what}")).with_remedy(remedy))
            }
            (None, Some(first)) if needed != Dimension::NONE && !is_zero => Err(self
                .error(format!("{what} {NEEDS_UNIT}"), tree.span, "a plain number")
                .with_secondary(first, "this scene has units")
                .with_remedy(format!(
                    "write `{} {symbol}`, or leave out all units",
                    self.shown(tree)
                ))),
            _ => Ok(one),
        }
    }

    /// An expression as it stands in the text, cut if it is long.
    pub(super) fn shown(&self, tree: &Tree) -> &str {
        match self.scope.source.slice(tree.span) {
            text if text.len() <= 20 && !text.contains('\n') => text,
            _ => "…",
        }
    }

    /// Refuses what belongs to recurrences only, and names that are no values.
    pub(super) fn refuse_strangers(&self, tree: &Tree) -> Outcome<()> {
        match &tree.value {
            Node::Name(name) => self.refuse_stranger(name, tree.span),
            Node::Wave(_) | Node::Summation { .. } => Err(self
                .error("a scene has no waves with period indices", tree.span, "not here")
                .with_remedy("use numbers and declared symbols")),
            Node::Call { name, argument } => {
                let word = name.value.as_str();
                if FUNCTIONS.contains(&word) || name::RESERVED.contains(&word) {
                    return self.refuse_strangers(argument);
                }
                let shown = self.shown(tree);
                let remedy = match self.scope.symbols.contains_key(word) {
                    true => format!("write `{word}*(…)` for a product"),
                    false => "use numbers, declared symbols, and `exp`".to_owned(),
                };
                Err(self
                    .error(
                        format!("`{word}` is not a function"),
                        name.span,
                        format!("in `{shown}`"),
                    )
                    .with_remedy(remedy))
            }
            Node::Exponential(operand) | Node::Negate(operand) => self.refuse_strangers(operand),
            Node::Sum(terms) => {
                terms.iter().try_for_each(|term| self.refuse_strangers(&term.value))
            }
            Node::Product(factors) => {
                factors.iter().try_for_each(|factor| self.refuse_strangers(&factor.value))
            }
            Node::Power { base, .. } => self.refuse_strangers(base),
            Node::Number(_) | Node::Function { .. } => Ok(()),
        }
    }

    fn refuse_stranger(&self, name: &str, span: Span) -> Outcome<()> {
        if self.scope.symbols.contains_key(name) || name == TIME {
            return Ok(());
        }
        match self.declared.get(name) {
            None if units::is_unit(name) => {
                let remedy =
                    format!("a unit follows the whole value, without a sign: `3/2 {name}`");
                let error = self.error(format!("unknown name `{name}`"), span, "not declared");
                Err(error.with_remedy(remedy))
            }
            None | Some((_, Meaning::Symbol)) => Ok(()),
            Some((first, meaning)) => {
                let message = format!("`{name}` is {}, not a value", self.described(*meaning));
                Err(self
                    .error(message, span, "not a value")
                    .with_secondary(*first, "declared here")
                    .with_remedy("use numbers and declared symbols"))
            }
        }
    }
}
