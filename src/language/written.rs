//! `written` statements: how the source of a recurrence writes it.

use num_traits::{ToPrimitive, Zero};

use super::constant::constant;
use super::diagnostic::Diagnostic;
use super::scope::{Scope, symbol, with_likely};
use super::syntax::{
    Expression, Node, Operator, Recurrence, Rewriting, Span, Spanned, StatementKind,
};
use crate::recurrence::{SourceNotation, SourceProduct, WaveIndex};

type Outcome<T> = Result<T, Diagnostic>;

/// The largest power of a symbol.
const MAX_POWER: i32 = 100;

/// Lowers all `written` statements. Names that mean nothing in the recurrence are symbols of the
/// source.
pub(super) fn notation(
    tree: &Recurrence,
    scope: &Scope,
    observed: &[&str],
) -> Outcome<SourceNotation> {
    let mut notation = SourceNotation::default();
    let items = || {
        tree.statements.iter().flat_map(|statement| match &statement.value {
            StatementKind::Written(items) => &items[..],
            _ => &[],
        })
    };
    for item in items() {
        let (name, again) = match item {
            Rewriting::Unit { quantity: name, unit } if observed.contains(&&*name.value) => {
                let unit = scope.product(unit)?;
                (name, notation.observables.insert(name.value.clone(), unit).is_some())
            }
            Rewriting::Unit { quantity: name, unit } => {
                let unit = scope.product(unit)?;
                (name, notation.units.insert(scope.wave(name)?, unit).is_some())
            }
            Rewriting::Ends(name) => (name, !notation.ends.insert(scope.wave(name)?)),
            Rewriting::Constants { wave, name } => {
                let constants = &mut notation.constants;
                let again = constants.insert(scope.wave(wave)?, name.value.clone()).is_some();
                (wave, again)
            }
            Rewriting::Name { name, written } => {
                (name, scope.rename(name, written, &mut notation)?)
            }
        };
        if again {
            let message = format!("`{}` is written in two ways", name.value);
            return Err(scope
                .error(message, name.span, "again here")
                .with_remedy("give one notation for it"));
        }
    }
    items().try_for_each(|item| scope.check_names(item, &notation))?;
    Ok(notation)
}

impl Scope {
    /// Refuses names of the source that mean something else already: they would make its formulas
    /// ambiguous.
    fn check_names(&self, item: &Rewriting, notation: &SourceNotation) -> Outcome<()> {
        let (name, tree) = match item {
            Rewriting::Ends(_) => return Ok(()),
            Rewriting::Constants { name, .. } => (Some(&name.value), None),
            Rewriting::Unit { unit, .. } => (None, Some(unit)),
            Rewriting::Name { written, .. } => match &written.value {
                Node::Name(name) => (Some(name), Some(written)),
                _ => (None, Some(written)),
            },
        };
        let span = match item {
            Rewriting::Constants { name, .. } => name.span,
            _ => tree.map_or(Span::new(0, 0), |tree| tree.span),
        };
        let free = "choose a name that is not a wave, symbol, time or other item";
        let refuse = |name: &str, what: &str, remedy: &str| {
            let message = format!("`{name}` already means something");
            Err(self.error(message, span, what).with_remedy(remedy))
        };
        if let Some(name) = name {
            let same = |other: &&str| *other == name || is_constant(other, name, item);
            if let Some(other) = self.known_names().chain(["n"]).find(same) {
                return refuse(other, "a name of the recurrence", free);
            }
            let plain = |product: &SourceProduct| match product.powers() {
                [(symbol, 1)] => Some(symbol.name().to_owned()),
                _ => None,
            };
            let waves = notation.waves.values().chain(notation.constants.values()).cloned();
            let all = waves.chain(notation.symbols.values().filter_map(plain));
            if all.filter(|other| other == name).count() > 1 {
                return refuse(name, "used for two things", free);
            }
        }
        let mut product = SourceProduct::one();
        let tree = tree.filter(|_| name.is_none());
        tree.map_or(Ok(()), |tree| self.multiply(&mut product, tree, 1))?;
        let source = "use the source's own symbols here";
        for (symbol, _) in product.powers() {
            let is_time = [&self.local, &self.time].into_iter().flatten().any(|x| x == symbol);
            if is_time || symbol.name() == "n" {
                return refuse(symbol.name(), "a time, or the number of the period", source);
            }
            if notation.symbols.contains_key(symbol) {
                return refuse(symbol.name(), "written otherwise by another item", source);
            }
        }
        Ok(())
    }

    fn wave(&self, name: &Spanned<String>) -> Outcome<WaveIndex> {
        self.waves.get(&name.value).copied().ok_or_else(|| {
            let message = format!("`{}` is not a wave of this recurrence", name.value);
            let names: Vec<&str> = self.waves.keys().map(String::as_str).collect();
            let error = self.error(message, name.span, "not a wave");
            with_likely(error, &name.value, names.iter().copied())
                .or_remedy(format!("its waves are {}", names.join(", ")))
        })
    }

    /// Notes what the source writes for a name; whether it was noted before.
    fn rename(
        &self,
        name: &Spanned<String>,
        written: &Expression,
        notation: &mut SourceNotation,
    ) -> Outcome<bool> {
        if let Some(wave) = self.waves.get(&name.value) {
            let Node::Name(other) = &written.value else {
                return Err(self
                    .error("a wave is written as a name", written.span, "not a name")
                    .with_remedy(format!("write its unit as `{} in …`", name.value)));
            };
            return Ok(notation.waves.insert(*wave, other.clone()).is_some());
        }
        let times = [&self.local, &self.time];
        let is_time = times.into_iter().flatten().any(|time| time.name() == name.value);
        match self.symbols.get(&name.value) {
            None if !is_time => Err(self
                .error(format!("unknown name `{}`", name.value), name.span, "not declared")
                .with_remedy("name a wave, a symbol or a time of this recurrence")),
            // A symbol that has a value is no longer written.
            Some(Some(_)) => self.product(written).map(|_| false),
            _ => {
                let product = self.product(written)?;
                Ok(notation.symbols.insert(symbol(&name.value), product).is_some())
            }
        }
    }

    /// A product of numbers and powers of symbols, in its order.
    fn product(&self, tree: &Expression) -> Outcome<SourceProduct> {
        let mut product = SourceProduct::one();
        self.multiply(&mut product, tree, 1)?;
        Ok(product)
    }

    fn multiply(&self, product: &mut SourceProduct, tree: &Expression, power: i32) -> Outcome<()> {
        let refuse = |label: &str| {
            Err(self
                .error("this is not a notation of a source", tree.span, label)
                .with_remedy("write a product of numbers and powers of symbols, such as `V/c`"))
        };
        match &tree.value {
            Node::Number(value) if value.is_zero() => refuse("zero"),
            Node::Number(value) => {
                product.scale(&value.pow(power));
                Ok(())
            }
            Node::Name(name) if self.waves.contains_key(name) => refuse("a wave"),
            Node::Name(name) => match self.symbols.get(name) {
                Some(Some(value)) if value.is_zero() => refuse("zero"),
                Some(Some(value)) => {
                    product.scale(&value.pow(power));
                    Ok(())
                }
                _ => {
                    let symbol = symbol(name);
                    product.multiply(symbol.clone(), power);
                    let all = product.powers().iter().find(|(other, _)| *other == symbol);
                    match all.is_none_or(|(_, power)| power.abs() <= MAX_POWER) {
                        true => Ok(()),
                        false => refuse("with the others a power that is too high"),
                    }
                }
            },
            Node::Product(factors) => factors.iter().try_for_each(|factor| {
                let sign = if factor.operator == Operator::Divide { -1 } else { 1 };
                self.multiply(product, &factor.value, sign * power)
            }),
            Node::Power { base, exponent } => {
                let value = constant(exponent, &self.source)?;
                let whole = value.is_integer().then(|| value.to_integer().to_i32()).flatten();
                let total = whole.and_then(|whole| whole.checked_mul(power));
                match total.filter(|total| total.abs() <= MAX_POWER) {
                    Some(total) => self.multiply(product, base, total),
                    None => refuse("not a small whole power"),
                }
            }
            _ => refuse("not a product"),
        }
    }
}

/// Whether a name is that of a constant `B_2`, where constants are called `B`.
fn is_constant(other: &str, name: &str, item: &Rewriting) -> bool {
    let index = other.strip_prefix(name).and_then(|rest| rest.strip_prefix('_'));
    matches!(item, Rewriting::Constants { .. })
        && index.is_some_and(|index| index.chars().all(|c| c.is_ascii_digit()))
}
