//! Text to syntax tree. A *recurrence* states equations between the wave functions of successive
//! periods as one would on paper; a *listing* states the functions themselves; every error says
//! where it is and what to do.
//!
//! ```
//! use wavestep::language::{Source, parse_recurrence};
//!
//! let source = Source::new("mass.wave", r#"
//!     recurrence "Rigid mass on a fixed bar"
//!     symbol μ > 0
//!     period 2*μ, local s, time t
//!     wave f, g                                   # zero for n < 0
//!     equation g[n] = -f[n-1]
//!     equation f[n]' + g[n]' = -(f[n] - g[n])
//!     continuous f[n] + g[n] starts at 1
//!     observe velocity = f[n] + g[n]
//! "#)?;
//! let recurrence = parse_recurrence(&source)?;
//! assert_eq!(recurrence.title.value, "Rigid mass on a fixed bar");
//! assert_eq!(recurrence.statements[0].to_string(), "symbol mu > 0");
//! # Ok::<(), wavestep::language::Diagnostic>(())
//! ```
//!
//! The way of a text: [`Source`] checks bytes, `layout` finds statements, `parser` builds the tree
//! in [`syntax`], `lowering` gives names their meaning, and [`Diagnostic`] is the one error of all.
//! The grammar is `grammar/wavestep.ebnf`, with accepted and rejected texts beside it.
//!
//! Parsing is linear in the length of the text. The parser does not recurse, and nothing that walks
//! the tree recurses deeper than three times [`MAX_NESTING`](crate::limits::MAX_NESTING).

mod constant;
mod diagnostic;
mod layout;
mod lowering;
mod name;
mod number;
mod parameters;
mod parser;
mod print;
mod scene;
mod scope;
mod source;
pub mod syntax;
mod written;

use std::collections::BTreeMap;

use num_rational::BigRational;

use crate::expression;
use crate::recurrence;
use crate::scene as physics;

pub use constant::constant;
pub use diagnostic::{Diagnostic, Label, closest};
pub use lowering::ExactFormula;
pub use name::RESERVED;
pub use source::Source;
pub use syntax::Span;

use syntax::{Expression, Listing, Recurrence, Scene};

/// Reads a recurrence: a title, then statements in any order.
///
/// Whether names are declared, equations suffice, or a period is stated is not checked here.
///
/// # Errors
/// The first place where the text does not follow the grammar or exceeds a limit.
///
/// ```
/// use wavestep::language::{Source, parse_recurrence};
///
/// let text = "recurrence \"Example\"\nwave μ\nequation mu[n] = 2·mu[n−1]\n";
/// let recurrence = parse_recurrence(&Source::new("example.wave", text)?)?;
/// assert_eq!(recurrence.to_string(), text.replace('μ', "mu").replace('·', "*").replace('−', "-"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn parse_recurrence(source: &Source) -> Result<Recurrence, Diagnostic> {
    parser::recurrence(source)
}

/// Reads a listing of formulas `f[3](s) = …`, the form in which exact solutions are printed.
///
/// # Errors
/// As [`parse_recurrence`].
///
/// ```
/// use wavestep::language::{Source, parse_listing};
///
/// let text = "f[0](s) = 1/2*exp(-s)\nf[1](s) = s*exp(-s)\n    - 1/4\n";
/// let listing = parse_listing(&Source::new("listing", text)?)?;
/// assert_eq!(listing.formulas[1].to_string(), "f[1](s) = s*exp(-s) - 1/4");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn parse_listing(source: &Source) -> Result<Listing, Diagnostic> {
    parser::listing(source)
}

/// Reads a text that is one expression.
///
/// # Errors
/// As [`parse_recurrence`].
///
/// ```
/// use wavestep::language::{Source, parse_expression};
///
/// let parse = |text| parse_expression(&Source::new("text", text).unwrap());
/// assert_eq!(parse("-f[n]'^2")?, parse("-((f[n]')^2)")?);
/// assert_ne!(parse("a + b")?, parse("b + a")?); // trees, not values
/// assert_eq!(parse("((a) + (b))*(c)")?.to_string(), "(a + b)*c");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn parse_expression(source: &Source) -> Result<Expression, Diagnostic> {
    parser::expression(source)
}

/// Reads one exact rational number, such as a value on a command line: `33/10`, `12.34`, `1e3`.
///
/// # Errors
/// As [`parse_expression`]; also names, waves, functions, division by zero, powers that are no
/// whole numbers, and values longer than [`MAX_CONSTANT_BITS`](crate::limits::MAX_CONSTANT_BITS).
///
/// ```
/// use wavestep::language::parse_number;
///
/// assert_eq!(parse_number("2*3/4")?, parse_number("1.5")?);
/// assert_eq!(parse_number("-0.25")?.to_string(), "-1/4");
/// assert!(parse_number("inf").is_err());
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn parse_number(text: &str) -> Result<BigRational, Diagnostic> {
    read_number(&Source::new("number", text)?)
}

/// Reads a text that is one exact rational number, as [`parse_number`].
///
/// # Errors
/// As [`parse_number`].
///
/// ```
/// use wavestep::language::{Source, parse_number, read_number};
///
/// assert_eq!(read_number(&Source::new("--at", "33/10")?)?, parse_number("3.3")?);
/// // Errors call the text by its name.
/// let error = read_number(&Source::new("--at", "33/0")?).unwrap_err();
/// assert!(error.to_string().contains("--at:1:4"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn read_number(source: &Source) -> Result<BigRational, Diagnostic> {
    constant::constant(&parser::number(source)?, source)
}

/// Reads a number with a unit of the dimension that is needed, in SI units: `120 us` is
/// `3/25000`. A number without a unit is taken to be in SI units.
///
/// # Errors
/// As [`read_number`]; also unknown units, and units of another dimension.
///
/// ```
/// use wavestep::language::{Source, parse_number, read_quantity};
/// use wavestep::scene::Dimension;
///
/// let read = |text| read_quantity(&Source::new("--at", text)?, Dimension::TIME);
/// assert_eq!(read("120 us")?, parse_number("120e-6")?);
/// assert_eq!(read("1/3")?, parse_number("1/3")?);
/// assert!(read("3 mm").unwrap_err().message().contains("a length"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn read_quantity(
    source: &Source,
    needed: physics::Dimension,
) -> Result<BigRational, Diagnostic> {
    let (tree, unit) = parser::quantity(source)?;
    let number = constant::constant(&tree, source)?;
    let Some(unit) = unit else { return Ok(number) };
    let scope = scope::Scope::new(source);
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

/// The name as it is kept: Greek letters spelt out, `μ` as `mu`.
///
/// ```
/// use wavestep::language::normalise_name;
///
/// assert_eq!(normalise_name("ω_0"), "omega_0");
/// assert_eq!(normalise_name("strain"), "strain");
/// ```
#[must_use]
pub fn normalise_name(written: &str) -> String {
    name::normalise(written)
}

/// Reads a recurrence and gives its names their meaning, with `values` in place of symbols from the
/// start.
///
/// # Errors
/// The first place where the text has no meaning, or states what cannot be solved step by step.
///
/// ```
/// use std::collections::BTreeMap;
/// use wavestep::language::{Source, read_recurrence};
///
/// let source = Source::new("pushed.wave", r#"
///     recurrence "Constant force"
///     period 2, local s, time t
///     wave f
///     equation f[n] = f[n-1] + 1
/// "#)?;
/// let recurrence = read_recurrence(&source, &BTreeMap::new())?;
/// assert_eq!(recurrence.statement().waves, ["f"]);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn read_recurrence(
    source: &Source,
    values: &BTreeMap<String, BigRational>,
) -> Result<recurrence::Recurrence, Diagnostic> {
    lowering::recurrence(&parse_recurrence(source)?, values)
}

/// Reads a scene: a title, then statements in any order.
///
/// Whether names are declared, properties are complete, or units fit is not checked here.
///
/// # Errors
/// As [`parse_recurrence`].
///
/// ```
/// use wavestep::language::{Source, parse_scene};
///
/// let text = "scene \"Rod\"\nbar rod { impedance = 2·μ, travel = 3 }\nline free − rod - fixed\n";
/// let scene = parse_scene(&Source::new("rod.wave", text)?)?;
/// assert_eq!(scene.to_string(), text.replace('μ', "mu").replace('·', "*").replace('−', "-"));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn parse_scene(source: &Source) -> Result<Scene, Diagnostic> {
    parser::scene(source).map_err(|errors| errors.into_iter().next().expect("at least one error"))
}

/// Reads a scene and gives its names their meaning, with `values` in place of symbols from the
/// start.
///
/// # Errors
/// All independent mistakes that one reading finds, in the order of the text; at least one, and no
/// more than fifty.
///
/// ```
/// use std::collections::BTreeMap;
/// use wavestep::language::{Source, read_scene};
///
/// let source = Source::new("strike.wave", r#"
///     scene "A mass strikes a rod"
///     mass ram { mass = 2 kg, velocity = 1 m/s }
///     bar  rod { modulus = 210 GPa, density = 7850 kg/m^3, area = 4 cm^2, length = 3/2 m }
///     line free - ram | rod - fixed
///     observe F = force(rod.right)
/// "#)?;
/// let scene = read_scene(&source, &BTreeMap::new()).unwrap();
/// assert_eq!((scene.elements[1].name.as_str(), scene.dimensional), ("rod", true));
/// // A pressure is no mass, and metres are no seconds.
/// let source = Source::new("wrong.wave", source.text().replace("2 kg", "2 Pa").replace("m/s", "m"))?;
/// let errors = read_scene(&source, &BTreeMap::new()).unwrap_err();
/// assert_eq!(errors[0].message(), "a mass is needed, kg; this is a pressure, Pa = N/m^2");
/// assert_eq!(errors.len(), 2);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
///
/// # Errors
/// As [`read_recurrence`] and [`read_scene`].
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
///
/// # Errors
/// The first place where the text does not follow the grammar, or divides by what it cannot.
///
/// ```
/// use wavestep::language::{Source, read_expression, read_listing};
///
/// let text = "f[0](s) = exp(-s)\nf[1](s) = exp(-s)*(-2*s + 1 + exp(-2*mu))\n";
/// let listing = read_listing(&Source::new("listing", text)?)?;
/// assert_eq!(listing[0].expression, read_expression(&Source::new("6.78", "exp(-s)")?)?);
/// assert_eq!((listing[1].wave.as_str(), listing[1].n), ("f", 1));
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn read_listing(source: &Source) -> Result<Vec<ExactFormula>, Diagnostic> {
    lowering::listing(&parse_listing(source)?)
}

/// Reads one exact expression; every name is a symbol.
///
/// # Errors
/// As [`read_listing`].
///
/// ```
/// use wavestep::language::{Source, read_expression};
///
/// let read = |text| read_expression(&Source::new("text", text).unwrap());
/// assert_eq!(read("exp(-mu)*exp(mu)")?, read("1")?);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn read_expression(source: &Source) -> Result<expression::Expression, Diagnostic> {
    lowering::expression(&parse_expression(source)?, source)
}

#[cfg(test)]
mod tests {
    use super::{Source, states_a_scene};

    #[test]
    fn texts_are_told_apart() {
        for (text, expected) in [
            ("", false),
            ("recurrence \"A\"", false),
            ("  # scene\n  scene \"A\"", true),
            ("Scene \"A\"", true),
            ("scen", true),
            ("bar rod {}", true),
            ("wave f", false),
            ("reccurence \"A\"", false),
            ("f[n] = 1", false),
            ("\"A\"", false),
        ] {
            let source = Source::new("text", text).expect("a text");
            assert_eq!(states_a_scene(&source), expected, "{text}");
        }
    }
}
