//! Source to tree: the only module that knows nom. Parsers follow the grammar rule by rule; they
//! return as soon as anything is wrong, with a message written for the place where it is wrong.
//!
//! A parser comes before its blanks: what it returns ends with the last character of its last token,
//! so that "expected here" points behind the text, not behind the comment after it.

mod complaint;
mod expression;
mod input;
mod lexical;
mod scene;
mod statement;

use crate::limits::MAX_MISTAKES;
use nom::error::{ErrorKind, ParseError};
use nom::{IResult, Input as _};

use super::diagnostic::Diagnostic;
use super::layout;
use super::source::Source;
use super::syntax::{Expression, Listing, Recurrence, Scene, Span, Spanned, Unit};
use input::Input;

type Parsed<'a, T> = IResult<Input<'a>, T, Problem>;

/// What a parser knows about its surroundings.
#[derive(Clone, Copy)]
struct Context<'a> {
    source: &'a Source,
    /// What the text is called in "the end of the …".
    unit: &'static str,
    /// How the whole unit is written, for a remedy.
    form: Option<&'static str>,
    /// The words that begin statements, the title's first, and how each statement is written.
    forms: &'static [(&'static str, &'static str)],
    /// How far an expression goes.
    extent: Extent,
}

impl Context<'_> {
    /// Whether the text is a scene, in which braces and bars are signs.
    fn is_scene(&self) -> bool {
        self.forms[0].0 == scene::FORMS[0].0
    }
}

/// Where an expression ends.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// Where it cannot go on; a word after it is a mistake.
    Whole,
    /// Also before a word, which is the unit of the whole.
    Unit,
    /// After one factor.
    Factor,
}

/// Why a parser failed.
#[derive(Debug)]
enum Problem {
    /// It does not apply here, and another may be tried.
    Inapplicable(Span),
    /// The text is wrong.
    Refused(Diagnostic),
}

impl ParseError<Input<'_>> for Problem {
    fn from_error_kind(input: Input<'_>, _: ErrorKind) -> Self {
        Self::Inapplicable(here(input))
    }

    fn append(_: Input<'_>, _: ErrorKind, other: Self) -> Self {
        other
    }
}

/// The place where the input starts, of no width.
fn here(input: Input<'_>) -> Span {
    Span::new(input.offset, input.offset)
}

/// From the start of one input to the start of a later one.
fn between(from: Input<'_>, to: Input<'_>) -> Span {
    Span::new(from.offset, to.offset)
}

/// The boundary to nom: what a parser found, or what is wrong.
fn finish<T>(source: &Source, parsed: Parsed<'_, T>) -> Result<T, Diagnostic> {
    match parsed {
        Ok((_, value)) => Ok(value),
        Err(nom::Err::Failure(Problem::Refused(diagnostic)))
        | Err(nom::Err::Error(Problem::Refused(diagnostic))) => Err(diagnostic),
        Err(nom::Err::Failure(Problem::Inapplicable(span)))
        | Err(nom::Err::Error(Problem::Inapplicable(span))) => {
            Err(complaint::incomprehensible(source, span))
        }
        // Only parsers of streams ask for more input, and there are none here.
        Err(nom::Err::Incomplete(_)) => {
            let end = source.text().len();
            Err(complaint::incomprehensible(source, Span::new(end, end)))
        }
    }
}

fn whole<'a>(source: &'a Source, unit: &'static str) -> Input<'a> {
    let (form, forms) = (None, &statement::FORMS[..]);
    let context = Context { source, unit, form, forms, extent: Extent::Whole };
    Input { text: source.text(), offset: 0, context }
}

/// The statements of a text, one input each.
fn statements(source: &Source) -> impl Iterator<Item = Input<'_>> {
    let whole = whole(source, "statement");
    let statement = move |Span { start, end }| whole.take_from(start).take(end - start);
    layout::statements(source.text()).into_iter().map(statement)
}

/// See [`parse_recurrence`](super::parse_recurrence).
pub(super) fn recurrence(source: &Source) -> Result<Recurrence, Diagnostic> {
    let mut inputs = statements(source);
    let first =
        inputs.next().ok_or_else(|| complaint::no_statement(source, "recurrence \"Title\""))?;
    let title = finish(source, statement::title(first))?;
    let statements = inputs
        .map(|input| finish(source, statement::statement(input, &title)))
        .collect::<Result<_, _>>()?;
    Ok(Recurrence { source: source.clone(), title, statements })
}

/// See [`parse_scene`](super::parse_scene); all statements that are wrong, in their order.
pub(super) fn scene(source: &Source) -> Result<Scene, Vec<Diagnostic>> {
    let mut inputs = statements(source).map(|mut input| {
        input.context.forms = &scene::FORMS;
        input
    });
    let Some(first) = inputs.next() else {
        return Err(vec![complaint::no_statement(source, "scene \"Title\"")]);
    };
    let title = finish(source, statement::title(first)).map_err(|error| vec![error])?;
    let (mut statements, mut errors) = (Vec::new(), Vec::new());
    for input in inputs {
        match finish(source, scene::statement(input, &title)) {
            Ok(statement) => statements.push(statement),
            Err(error) => errors.push(error),
        }
        // What follows an open brace was probably meant to stand between braces.
        if !errors.is_empty() && scene::leaves_brace_open(input) || errors.len() >= MAX_MISTAKES {
            break;
        }
    }
    if errors.is_empty() {
        Ok(Scene { source: source.clone(), title, statements })
    } else {
        Err(errors)
    }
}

/// The first word of a text, if it begins with one.
pub(super) fn first_word(source: &Source) -> Option<&str> {
    let first = statements(source).next()?;
    let word = lexical::next_word(first)?;
    Some(source.slice(word.span))
}

/// The words that begin statements of recurrences and of scenes.
pub(super) fn keywords() -> [Vec<&'static str>; 2] {
    let words = |forms: &[(&'static str, _)]| forms.iter().map(|(word, _)| *word).collect();
    [words(&statement::FORMS), words(&scene::FORMS)]
}

/// See [`parse_listing`](super::parse_listing).
pub(super) fn listing(source: &Source) -> Result<Listing, Diagnostic> {
    let formulas: Vec<Spanned<_>> = statements(source)
        .map(|input| finish(source, statement::formula(input)))
        .collect::<Result<_, _>>()?;
    if formulas.is_empty() {
        return Err(complaint::no_statement(source, statement::FORMULA_FORM));
    }
    Ok(Listing { source: source.clone(), formulas })
}

/// See [`parse_expression`](super::parse_expression).
pub(super) fn expression(source: &Source) -> Result<Expression, Diagnostic> {
    alone(source, "expression")
}

/// See [`parse_number`](super::parse_number).
pub(super) fn number(source: &Source) -> Result<Expression, Diagnostic> {
    alone(source, "number")
}

/// A text that is one number with a unit, or without.
pub(super) fn quantity(source: &Source) -> Result<(Expression, Option<Unit>), Diagnostic> {
    let input = whole(source, "quantity");
    if lexical::skip_blank(input).text.is_empty() {
        return Err(complaint::nothing(source, "quantity"));
    }
    let quantity = scene::with_unit(input).and_then(|(rest, value)| {
        let (rest, ()) = expression::end(rest)?;
        Ok((rest, value))
    });
    finish(source, quantity)
}

/// A text that is one expression; messages call it `unit`.
fn alone(source: &Source, unit: &'static str) -> Result<Expression, Diagnostic> {
    let input = whole(source, unit);
    if lexical::skip_blank(input).text.is_empty() {
        return Err(complaint::nothing(source, unit));
    }
    finish(source, expression::alone(input))
}
