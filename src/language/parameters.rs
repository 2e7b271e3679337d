//! Parameters, which recurrences and scenes declare alike: symbols with conditions, values given for
//! them, and factors that are not zero.

use std::collections::BTreeMap;

use wavestep_polynomial::Rational;

use super::constant::constant;
use super::diagnostic::Diagnostic;
use super::scope::{Scope, symbol, with_likely};
use super::syntax::{self, Expression, Name, Span};
use crate::expression::{Condition, Fraction};

type Outcome<T> = Result<T, Diagnostic>;

/// Declares a symbol in the scope, with the value given for it. It is known afterwards even if it
/// is refused, without its value, so that its uses are not refused too.
pub(super) fn declare(
    scope: &mut Scope,
    declared: &syntax::Symbol,
    values: &BTreeMap<String, Rational>,
) -> Outcome<()> {
    let syntax::Symbol { name, condition } = declared;
    let value = values.get(&name.value).cloned();
    scope.symbols.insert(name.value.clone(), value.clone());
    let condition = match condition {
        None => None,
        Some(condition) => Some(Condition {
            relation: condition.relation.value,
            bound: constant(&condition.bound, &scope.source).map_err(|error| {
                error.or_remedy(format!("write a bound such as `{} > 1/2`", name.value))
            })?,
        }),
    };
    let refused = match (&value, &condition) {
        (Some(value), Some(condition)) if !condition.holds(value) => {
            Some(outside(scope, name, value, condition))
        }
        (Some(_), _) => return Ok(()),
        (None, _) => None,
    };
    scope.symbols.insert(name.value.clone(), None);
    scope.assumptions.declare_symbol(symbol(&name.value), condition);
    refused.map_or(Ok(()), Err)
}

fn outside(scope: &Scope, name: &Name, value: &Rational, condition: &Condition) -> Diagnostic {
    let message = format!("{} = {value} is outside the range of the symbol", name.value);
    scope
        .error(message, name.span, "declared here")
        .with_remedy(format!("give a value with {} {condition}", name.value))
}

/// Checks that all values are given for symbols of the scope; `whole` is what the text states.
pub(super) fn all_known(
    scope: &Scope,
    values: &BTreeMap<String, Rational>,
    whole: &str,
    title: Span,
) -> Outcome<()> {
    let Some(unknown) = values.keys().find(|name| !scope.symbols.contains_key(*name)) else {
        return Ok(());
    };
    let names: Vec<String> = scope.symbols.keys().cloned().collect();
    let choice = match &names[..] {
        [] => format!("this {whole} has no symbols"),
        _ => format!("its symbols are {}", names.join(", ")),
    };
    let error = scope.error(
        format!("`{unknown}` has a value, but is not a symbol here"),
        title,
        format!("of this {whole}"),
    );
    Err(with_likely(error, unknown, names.iter().map(String::as_str)).or_remedy(choice))
}

/// The reciprocal of a factor that is stated to be non-zero. Where values given make it a number,
/// it says nothing: the answer is derived with the values in.
pub(super) fn nonzero(
    scope: &Scope,
    tree: &Expression,
    values: &BTreeMap<String, Rational>,
) -> Outcome<Option<Fraction>> {
    let value = scope.lower_constant(tree, "a non-zero factor")?;
    let polynomial = value.as_fraction().map(|fraction| fraction.numerator().clone());
    let reciprocal = match &polynomial {
        Some(p) if p.as_constant().is_some() && !values.is_empty() => return Ok(None),
        Some(p) => Fraction::reciprocal(p).ok(),
        None => None,
    };
    if reciprocal.is_some() {
        return Ok(reciprocal);
    }
    let (label, remedy) = match value.is_zero() {
        true => ("this is zero", "check its signs, or remove the statement"),
        false => ("its factors were not found", "declare its factors, one per statement"),
    };
    Err(scope.error("this cannot be declared non-zero", tree.span, label).with_remedy(remedy))
}
