//! Source to tree. Functions follow the grammar rule by rule: each takes what it reads from the front of
//! an [`Input`], and returns as soon as anything is wrong, with a message written for the place where it
//! is wrong.

mod complaint;
mod expression;
mod forms;
mod input;
mod lexical;
mod scene;
mod statement;

use crate::limits::MAX_MISTAKES;

use super::diagnostic::Diagnostic;
use super::layout;
use super::source::Source;
use super::syntax::{Expression, Listing, Recurrence, Scene, Spanned, Text, Unit};
use forms::Form;
use input::{Context, Extent, Input};

type Outcome<T> = Result<T, Diagnostic>;

/// The statements of a text, one input each.
fn statements<'a>(
    source: &'a Source,
    forms: &'static [Form],
) -> impl Iterator<Item = Input<'a>> + use<'a> {
    let context = Context { source, unit: "statement", form: None, forms, extent: Extent::Whole };
    layout::statements(source.text()).into_iter().map(move |span| Input {
        text: source.slice(span),
        offset: span.start,
        context,
    })
}

/// A title and statements, each as `kind` reads it after its first word; or all mistakes, in their order.
fn text<K>(
    source: &Source,
    forms: &'static [Form],
    kind: impl Fn(&mut Input<'_>, &str) -> Outcome<K>,
) -> Result<Text<K>, Vec<Diagnostic>> {
    let mut inputs = statements(source, forms);
    let Some(first) = inputs.next() else {
        return Err(vec![complaint::no_statement(source, forms[0].1)]);
    };
    let title = statement::title(first).map_err(|error| vec![error])?;
    let (mut statements, mut errors) = (Vec::new(), Vec::new());
    for input in inputs {
        match statement::statement(input, &title, &kind) {
            Ok(statement) => statements.push(statement),
            Err(error) => errors.push(error),
        }
        // What follows an open brace was probably meant to stand between braces.
        if !errors.is_empty() && scene::leaves_brace_open(input) || errors.len() >= MAX_MISTAKES {
            break;
        }
    }
    match errors.is_empty() {
        true => Ok(Text { source: source.clone(), title, statements }),
        false => Err(errors),
    }
}

/// A title and the statements of a recurrence; or all mistakes, in their order.
pub(super) fn recurrence(source: &Source) -> Result<Recurrence, Vec<Diagnostic>> {
    text(source, &forms::RECURRENCE, statement::kind)
}

/// A title and the statements of a scene; or all mistakes, in their order.
pub(super) fn scene(source: &Source) -> Result<Scene, Vec<Diagnostic>> {
    text(source, &forms::SCENE, scene::kind)
}

/// The first word of a text, if it begins with one.
pub(super) fn first_word(source: &Source) -> Option<&str> {
    Some(statements(source, &forms::RECURRENCE).next()?.next_word()?.value)
}

/// The words that begin statements of recurrences and of scenes.
pub(super) fn keywords() -> [Vec<&'static str>; 2] {
    let words = |forms: &[Form]| forms.iter().map(|(word, _)| *word).collect();
    [words(&forms::RECURRENCE), words(&forms::SCENE)]
}

/// A text of formulas.
pub(super) fn listing(source: &Source) -> Outcome<Listing> {
    let formulas = statements(source, &forms::RECURRENCE).map(statement::formula);
    let formulas = formulas.collect::<Outcome<Vec<Spanned<_>>>>()?;
    match formulas.is_empty() {
        true => Err(complaint::no_statement(source, forms::FORMULA)),
        false => Ok(Listing { source: source.clone(), formulas }),
    }
}

/// A text that is one expression; messages call it `unit`.
pub(super) fn expression(source: &Source, unit: &'static str) -> Outcome<Expression> {
    alone(source, unit, expression::expression)
}

/// A text that is one number with a unit, or without.
pub(super) fn quantity(source: &Source) -> Outcome<(Expression, Option<Unit>)> {
    alone(source, "quantity", scene::with_unit)
}

/// A text with one thing in it and nothing after it.
fn alone<'a, T>(
    source: &'a Source,
    unit: &'static str,
    read: impl Fn(&mut Input<'a>) -> Outcome<T>,
) -> Outcome<T> {
    let (form, forms) = (None, &forms::RECURRENCE);
    let context = Context { source, unit, form, forms, extent: Extent::Whole };
    let mut input = Input { text: source.text(), offset: 0, context };
    if input.after_blanks().text.is_empty() {
        return Err(complaint::nothing(source, unit));
    }
    let found = read(&mut input).and_then(|found| expression::end(input).map(|()| found));
    found.map_err(|error| error.or_remedy(complaint::example(unit)))
}
