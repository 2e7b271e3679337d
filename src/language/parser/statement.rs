//! Statements: each begins with a word that says what it is.

use nom::Parser;
use nom::combinator::opt;

use super::super::syntax::{
    Condition, Formula, Name, Rewriting, Spanned, Statement, StatementKind, Symbol,
};
use super::expression::{demand_index, end, expression};
use super::lexical::{
    demand, demand_name, keyword, next_word, relation, string, symbol, token, word,
};
use super::{Input, Parsed, between, complaint};

/// How a formula of a listing is written.
pub(super) const FORMULA_FORM: &str = "f[3](s) = exp(-s)*(1 + s)";

/// How parameters are stated.
pub(super) const SYMBOL_FORM: &str = "symbol mu > 0, r";

/// The words that begin statements, and how each statement is written.
pub(super) const FORMS: [(&str, &str); 9] = [
    ("recurrence", "recurrence \"Title\""),
    ("symbol", SYMBOL_FORM),
    ("nonzero", "nonzero a - b"),
    ("period", "period 2*mu, local s, time t"),
    ("wave", "wave f, g"),
    ("equation", "equation g[n] = -f[n-1]"),
    ("continuous", "continuous f[n] + g[n] starts at 1"),
    ("observe", "observe velocity = f[n] + g[n]"),
    ("written", "written f in V/c, s as mu*z/L, constants of f as B"),
];

/// The first word of a statement, and the input after it, which from now on knows its form.
pub(super) fn opening(input: Input<'_>) -> Parsed<'_, Spanned<&'static str>> {
    let Ok((mut rest, found)) = token(word).parse(input) else {
        return Err(complaint::no_keyword(input));
    };
    match input.context.forms.iter().find(|(keyword, _)| *keyword == found.value) {
        Some(&(keyword, form)) => {
            rest.context.form = Some(form);
            Ok((rest, Spanned::new(keyword, found.span)))
        }
        None => Err(complaint::unknown_keyword(input, found.value, found.span)),
    }
}

/// `recurrence "…"` or `scene "…"`, with which every text of statements begins.
pub(super) fn title(input: Input<'_>) -> Parsed<'_, Spanned<String>> {
    let (rest, opening) = opening(input)?;
    if opening.value != input.context.forms[0].0 {
        return Err(complaint::title_missing(input, opening.span));
    }
    let (rest, Some(title)) = opt(string).parse(rest)? else {
        return Err(complaint::expected_title(rest));
    };
    let (rest, ()) = end(rest)?;
    Ok((rest, title))
}

/// Any statement after the title.
pub(super) fn statement<'a>(input: Input<'a>, title: &Spanned<String>) -> Parsed<'a, Statement> {
    let (rest, opening) = opening(input)?;
    let (last, kind) = match opening.value {
        "recurrence" => return Err(complaint::second_title(rest, opening.span, title.span)),
        "symbol" => {
            let (rest, symbols) = listed(rest, parameter)?;
            (rest, StatementKind::Symbols(symbols))
        }
        "nonzero" => {
            let (rest, value) = expression(rest)?;
            (rest, StatementKind::Nonzero(value))
        }
        "period" => period(rest)?,
        "wave" => {
            let (rest, names) = listed(rest, |rest| demand_name("the name of a wave", rest))?;
            (rest, StatementKind::Waves(names))
        }
        "equation" => {
            let (rest, left) = expression(rest)?;
            let (rest, _) = demand("=", rest)?;
            let (rest, right) = expression(rest)?;
            (rest, StatementKind::Equation { left, right })
        }
        "continuous" => {
            let (rest, quantity) = expression(rest)?;
            let (rest, _) = keyword("starts", rest)?;
            let (rest, _) = keyword("at", rest)?;
            let (rest, start) = expression(rest)?;
            (rest, StatementKind::Continuous { quantity, start })
        }
        "written" => {
            let (rest, items) = listed(rest, rewriting)?;
            (rest, StatementKind::Written(items))
        }
        _ => {
            let (rest, name) = demand_name("the name of an observable", rest)?;
            let (rest, _) = demand("=", rest)?;
            let (rest, value) = expression(rest)?;
            (rest, StatementKind::Observe { name, value })
        }
    };
    let span = between(input, last);
    let (rest, ()) = end(last)?;
    Ok((rest, Spanned::new(kind, span)))
}

/// `item { "," item }`
pub(super) fn listed<'a, T>(
    input: Input<'a>,
    item: impl Fn(Input<'a>) -> Parsed<'a, T>,
) -> Parsed<'a, Vec<T>> {
    let (mut rest, first) = item(input)?;
    let mut items = vec![first];
    while let (after, Some(_)) = opt(symbol(",")).parse(rest)? {
        let (after, next) = item(after)?;
        items.push(next);
        rest = after;
    }
    Ok((rest, items))
}

/// `mu`, `mu > 0`
pub(super) fn parameter(input: Input<'_>) -> Parsed<'_, Symbol> {
    let (rest, name) = demand_name("the name of a symbol", input)?;
    let (rest, condition) = match opt(token(relation)).parse(rest)? {
        (rest, None) => (rest, None),
        (rest, Some(relation)) => {
            let (rest, bound) = expression(rest)?;
            (rest, Some(Condition { relation, bound }))
        }
    };
    Ok((rest, Symbol { name, condition }))
}

/// `f in V/c`, `s as mu*z/L`, `constants of f as B`, `ends of a`
fn rewriting(input: Input<'_>) -> Parsed<'_, Rewriting> {
    let (rest, name) = demand_name("the name of a wave, a time or a symbol", input)?;
    let follows = next_word(rest).map(|word| word.value);
    match (name.value.as_str(), follows) {
        (_, Some("in")) => {
            let (rest, _) = keyword("in", rest)?;
            let (rest, unit) = expression(rest)?;
            Ok((rest, Rewriting::Unit { wave: name, unit }))
        }
        ("ends", Some("of")) => {
            let (rest, _) = keyword("of", rest)?;
            let (rest, wave) = demand_name("the name of a wave", rest)?;
            Ok((rest, Rewriting::Ends(wave)))
        }
        ("constants", Some("of")) => {
            let (rest, _) = keyword("of", rest)?;
            let (rest, wave) = demand_name("the name of a wave", rest)?;
            let (rest, _) = keyword("as", rest)?;
            let (rest, name) = demand_name("the name of the constants", rest)?;
            Ok((rest, Rewriting::Constants { wave, name }))
        }
        (_, Some("as")) => {
            let (rest, _) = keyword("as", rest)?;
            let (rest, written) = expression(rest)?;
            Ok((rest, Rewriting::Name { name, written }))
        }
        _ => Err(complaint::expected(rest, "`in` or `as`")),
    }
}

/// What follows `period`.
fn period(input: Input<'_>) -> Parsed<'_, StatementKind> {
    let (rest, length) = expression(input)?;
    let (rest, local) = role(rest, "local", "the name of the local time")?;
    let (rest, time) = role(rest, "time", "the name of the scene time")?;
    let kind = StatementKind::Period { length, local, time };
    Ok((rest, kind))
}

/// `, local s`
fn role<'a>(input: Input<'a>, wanted: &'static str, what: &str) -> Parsed<'a, Name> {
    let (rest, _) = demand(",", input)?;
    let (rest, _) = keyword(wanted, rest)?;
    demand_name(what, rest)
}

/// `f[3](s) = …`
pub(super) fn formula(mut input: Input<'_>) -> Parsed<'_, Spanned<Formula>> {
    input.context.unit = "formula";
    input.context.form = Some(FORMULA_FORM);
    let (rest, wave) = demand_name("the name of a wave", input)?;
    let (rest, _) = demand("[", rest)?;
    let (rest, index) = demand_index(rest)?;
    let (rest, _) = demand("]", rest)?;
    let (rest, _) = demand("(", rest)?;
    let (rest, argument) = demand_name("the name of the argument", rest)?;
    let (rest, _) = demand(")", rest)?;
    let (rest, _) = demand("=", rest)?;
    let (last, value) = expression(rest)?;
    let span = between(input, last);
    let (rest, ()) = end(last)?;
    let formula = Formula { wave, index, argument, value };
    Ok((rest, Spanned::new(formula, span)))
}
