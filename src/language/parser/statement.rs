//! Statements: each begins with a word that says what it is.

use super::super::syntax::{
    Condition, Formula, Name, Rewriting, Span, Spanned, StatementKind, Symbol,
};
use super::expression::{demand_index, end, expression};
use super::forms::FORMULA;
use super::{Input, Outcome, complaint};

/// The first word of a statement; the input from now on knows the form of the statement.
fn opening(input: &mut Input<'_>) -> Outcome<Spanned<&'static str>> {
    let before = *input;
    let Some(found) = input.word() else { return Err(complaint::no_keyword(before)) };
    match before.context.forms.iter().find(|(keyword, _)| *keyword == found.value) {
        Some(&(keyword, form)) => {
            input.context.form = Some(form);
            Ok(Spanned::new(keyword, found.span))
        }
        None => Err(complaint::unknown_keyword(before, found.value, found.span)),
    }
}

/// `recurrence "…"` or `scene "…"`, with which every text of statements begins.
pub(super) fn title(mut input: Input<'_>) -> Outcome<Spanned<String>> {
    let opening = opening(&mut input)?;
    if opening.value != input.context.forms[0].0 {
        return Err(complaint::title_missing(input, opening.span));
    }
    let Some(title) = input.string()? else {
        return Err(complaint::expected(input, "a title in quotation marks"));
    };
    end(input)?;
    Ok(title)
}

/// Any statement after the title; `kind` reads what follows its first word.
pub(super) fn statement<K>(
    mut input: Input<'_>,
    title: &Spanned<String>,
    kind: impl Fn(&mut Input<'_>, &str) -> Outcome<K>,
) -> Outcome<Spanned<K>> {
    let start = input.offset;
    let opening = opening(&mut input)?;
    if opening.value == input.context.forms[0].0 {
        return Err(complaint::second_title(input, opening.span, title.span));
    }
    let kind = kind(&mut input, opening.value)?;
    end(input)?;
    Ok(Spanned::new(kind, Span::new(start, input.offset)))
}

/// What follows the first word of a statement of a recurrence.
pub(super) fn kind(input: &mut Input<'_>, word: &str) -> Outcome<StatementKind> {
    Ok(match word {
        "symbol" => StatementKind::Symbols(listed(input, parameter)?),
        "nonzero" => StatementKind::Nonzero(expression(input)?),
        "period" => StatementKind::Period {
            length: expression(input)?,
            local: role(input, "local", "the name of the local time")?,
            time: role(input, "time", "the name of the scene time")?,
        },
        "wave" => StatementKind::Waves(listed(input, |input| input.name("the name of a wave"))?),
        "equation" => {
            let left = expression(input)?;
            input.demand("=")?;
            StatementKind::Equation { left, right: expression(input)? }
        }
        "continuous" => {
            let quantity = expression(input)?;
            input.keyword("starts")?;
            input.keyword("at")?;
            StatementKind::Continuous { quantity, start: expression(input)? }
        }
        "written" => StatementKind::Written(listed(input, rewriting)?),
        _ => {
            let name = input.name("the name of an observable")?;
            input.demand("=")?;
            StatementKind::Observe { name, value: expression(input)? }
        }
    })
}

/// `item { "," item }`
pub(super) fn listed<'a, T>(
    input: &mut Input<'a>,
    item: impl Fn(&mut Input<'a>) -> Outcome<T>,
) -> Outcome<Vec<T>> {
    let mut items = vec![item(input)?];
    while input.symbol(",").is_some() {
        items.push(item(input)?);
    }
    Ok(items)
}

/// `mu`, `mu > 0`
pub(super) fn parameter(input: &mut Input<'_>) -> Outcome<Symbol> {
    let name = input.name("the name of a symbol")?;
    let condition = match input.relation() {
        None => None,
        Some(relation) => Some(Condition { relation, bound: expression(input)? }),
    };
    Ok(Symbol { name, condition })
}

/// `f in V/c`, `s as mu*z/L`, `constants of f as B`, `ends of a`
fn rewriting(input: &mut Input<'_>) -> Outcome<Rewriting> {
    const WAVE: &str = "the name of a wave";
    let name = input.name("the name of a wave, a time or a symbol")?;
    let follows = input.next_word().map(|word| word.value);
    match (name.value.as_str(), follows) {
        (_, Some("in")) => {
            input.keyword("in")?;
            Ok(Rewriting::Unit { quantity: name, unit: expression(input)? })
        }
        ("ends", Some("of")) => {
            input.keyword("of")?;
            Ok(Rewriting::Ends(input.name(WAVE)?))
        }
        ("constants", Some("of")) => {
            input.keyword("of")?;
            let wave = input.name(WAVE)?;
            input.keyword("as")?;
            Ok(Rewriting::Constants { wave, name: input.name("the name of the constants")? })
        }
        (_, Some("as")) => {
            input.keyword("as")?;
            Ok(Rewriting::Name { name, written: expression(input)? })
        }
        _ => Err(complaint::expected(*input, "`in` or `as`")),
    }
}

/// `, local s`
fn role(input: &mut Input<'_>, wanted: &str, what: &str) -> Outcome<Name> {
    input.demand(",")?;
    input.keyword(wanted)?;
    input.name(what)
}

/// `f[3](s) = …`
pub(super) fn formula(mut input: Input<'_>) -> Outcome<Spanned<Formula>> {
    let start = input.offset;
    input.context.unit = "formula";
    input.context.form = Some(FORMULA);
    let wave = input.name("the name of a wave")?;
    input.demand("[")?;
    let counts = listed(&mut input, demand_index)?;
    input.demand("]")?;
    input.demand("(")?;
    let argument = input.name("the name of the argument")?;
    input.demand(")")?;
    input.demand("=")?;
    let value = expression(&mut input)?;
    end(input)?;
    let formula = Formula { wave, counts, argument, value };
    Ok(Spanned::new(formula, Span::new(start, input.offset)))
}
