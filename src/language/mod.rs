//! Text to recurrences and scenes. A *recurrence* states equations between the wave functions of successive
//! periods as one would on paper; a *scene* states bars and lumped elements on a line; a *listing* states
//! wave functions themselves. Every error says where it is and what to do.
//!
//! The way of a text: [`Source`] checks bytes, `layout` finds statements, `parser` builds the tree
//! in [`syntax`], `lowering` and `scene` give names their meaning, and [`Diagnostic`] is the one error of all.
//! The grammar is `grammar/wavestep.ebnf`, with accepted and rejected texts beside it.
//!
//! Parsing is linear in the length of the text. The parser does not recurse, and nothing that walks
//! the tree recurses deeper than three times [`MAX_NESTING`](crate::limits::MAX_NESTING).

mod change;
mod constant;
mod diagnostic;
mod layout;
mod linear;
mod lowering;
mod name;
mod number;
mod parameters;
mod parser;
mod print;
mod products;
mod scene;
mod scope;
mod source;
pub mod syntax;
mod written;

use std::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::Zero as _;

use crate::expression;
use crate::recurrence;
use crate::scene as physics;

pub use change::{Beyond, Change, ChangeError, changed, elements};
pub use constant::constant;
pub use diagnostic::{Diagnostic, Label, closest, did_you_mean};
pub use lowering::ExactFormula;
pub use name::{RESERVED, normalise as normalise_name};
pub use source::{Source, Span};

use syntax::{Expression, Listing, Recurrence, Scene};

/// The first of several mistakes.
fn first<T>(outcome: Result<T, Vec<Diagnostic>>) -> Result<T, Diagnostic> {
    outcome.map_err(|errors| errors.into_iter().next().expect("at least one error"))
}

/// Reads a recurrence: a title, then statements in any order.
///
/// Whether names are declared, equations suffice, or a period is stated is not checked here.
pub fn parse_recurrence(source: &Source) -> Result<Recurrence, Diagnostic> {
    first(parser::recurrence(source))
}

/// Reads a listing of formulas `f[3](s) = …`, the form in which exact solutions are printed.
pub fn parse_listing(source: &Source) -> Result<Listing, Diagnostic> {
    parser::listing(source)
}

/// Reads a text that is one expression.
pub fn parse_expression(source: &Source) -> Result<Expression, Diagnostic> {
    parser::expression(source, "expression")
}

/// Reads one exact rational number, such as a value on a command line: `33/10`, `12.34`, `1e3`.
pub fn parse_number(text: &str) -> Result<BigRational, Diagnostic> {
    read_number(&Source::new("number", text)?)
}

/// Reads a text that is one exact rational number, as [`parse_number`].
pub fn read_number(source: &Source) -> Result<BigRational, Diagnostic> {
    constant::constant(&parser::expression(source, "number")?, source)
}

/// Reads a number with a unit of the dimension that is needed, in SI units: `120 us` is
/// `3/25000`. Nothing but zero goes without a unit.
pub fn read_quantity(
    source: &Source,
    needed: physics::Dimension,
) -> Result<BigRational, Diagnostic> {
    let (tree, unit) = parser::quantity(source)?;
    let number = constant::constant(&tree, source)?;
    let scope = scope::Scope::new(source);
    let Some(unit) = unit else {
        let described = needed.described();
        let what = described.split(", ").next().unwrap_or(&described);
        let message = format!("{what} needs a unit in this scene");
        let remedy = format!("write `{} {}`, for example", source.text().trim(), needed.unit());
        return match number.is_zero() {
            true => Ok(number),
            false => Err(scope.error(message, tree.span, "a plain number").with_remedy(remedy)),
        };
    };
    let scene::units::Worth { value, dimension } = scene::units::worth(&scope, &unit)?;
    match dimension == needed {
        true => Ok(number * value),
        false => Err(scope
            .error(
                format!("{} is needed; this is {}", needed.described(), dimension.described()),
                unit.span,
                "another dimension",
            )
            .with_remedy(format!("give it in {}", needed.unit()))),
    }
}

/// Reads a recurrence and gives its names their meaning, with `values` in place of symbols from the
/// start.
pub fn read_recurrence(
    source: &Source,
    values: &BTreeMap<String, BigRational>,
) -> Result<recurrence::Recurrence, Diagnostic> {
    lowering::recurrence(&parse_recurrence(source)?, values)
}

/// Reads a scene: a title, then statements in any order.
///
/// Whether names are declared, properties are complete, or units fit is not checked here.
pub fn parse_scene(source: &Source) -> Result<Scene, Diagnostic> {
    first(parser::scene(source))
}

/// Reads a scene and gives its names their meaning, with `values` in place of symbols from the start; or
/// all independent mistakes in the order of the text, from one to fifty.
pub fn read_scene(
    source: &Source,
    values: &BTreeMap<String, BigRational>,
) -> Result<physics::Scene, Vec<Diagnostic>> {
    scene::scene(&parser::scene(source)?, values)
}

/// What a text states.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Stated {
    /// The equations between the wave functions of successive periods.
    Recurrence(Box<recurrence::Recurrence>),
    /// Bars and lumped elements on a line.
    Scene(Box<physics::Scene>),
}

/// Reads what a text states, with `values` in place of symbols from the start. Its first word says what
/// it is: a word that is misspelt, and a statement that stands where the title should, count for what
/// they most resemble; whatever else is taken for a recurrence.
pub fn read(
    source: &Source,
    values: &BTreeMap<String, BigRational>,
) -> Result<Stated, Vec<Diagnostic>> {
    match states_a_scene(source) {
        true => Ok(Stated::Scene(Box::new(read_scene(source, values)?))),
        false => match read_recurrence(source, values) {
            Ok(recurrence) => Ok(Stated::Recurrence(Box::new(recurrence))),
            Err(diagnostic) => Err(vec![diagnostic]),
        },
    }
}

fn states_a_scene(source: &Source) -> bool {
    let Some(word) = parser::first_word(source) else { return false };
    let [recurrence, scene] = parser::keywords();
    let word = word.to_ascii_lowercase();
    let found = closest(&word, recurrence.iter().chain(&scene).copied());
    found.is_some_and(|found| !recurrence.contains(&found))
}

/// Reads a listing of formulas as exact expressions; every name is a symbol.
pub fn read_listing(source: &Source) -> Result<Vec<ExactFormula>, Diagnostic> {
    lowering::listing(&parse_listing(source)?)
}

/// Reads one exact expression; every name is a symbol.
pub fn read_expression(source: &Source) -> Result<expression::Expression, Diagnostic> {
    lowering::expression(&parse_expression(source)?, source)
}
