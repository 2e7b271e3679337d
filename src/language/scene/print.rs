//! The tree of a scene as text again, such that reading it gives the same tree.

use std::fmt::{self, Display, Formatter, Write};

use super::tree::{
    Declaration, Declared, Line, ObservedPlace, ObservedTerm, Property, Scene, SceneStatement,
    SceneStatementKind, Section, Unit,
};
use crate::language::print::{Listed, product};
use crate::language::syntax::{Operator, Sign, Spanned};
use crate::scene::Joint;

impl Display for Scene {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "scene \"{}\"", self.title)?;
        self.statements.iter().try_for_each(|statement: &SceneStatement| writeln!(f, "{statement}"))
    }
}

impl Display for SceneStatementKind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Symbols(symbols) => write!(f, "symbol {}", Listed(symbols)),
            Self::Nonzero(expression) => write!(f, "nonzero {expression}"),
            Self::Declaration(declaration) => declaration.fmt(f),
            Self::Line(line) => line.fmt(f),
            Self::ContactsOpen => f.write_str("contacts open"),
            Self::Observe { name, terms } => {
                write!(f, "observe {name} =")?;
                for (position, term) in terms.iter().enumerate() {
                    let text = term.to_string();
                    f.write_str(match (position, term.value.sign) {
                        // A minus here would be the sign of the term.
                        (0, Sign::Plus) if text.starts_with('-') => " +",
                        (0, Sign::Plus) => " ",
                        (0, Sign::Minus) => " -",
                        (_, Sign::Plus) => " + ",
                        (_, Sign::Minus) => " - ",
                    })?;
                    f.write_str(&text)?;
                }
                Ok(())
            }
        }
    }
}

impl Display for Declaration {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { kind, name, properties } = self;
        match properties.is_empty() {
            true => write!(f, "{kind} {name} {{}}"),
            false => write!(f, "{kind} {name} {{ {} }}", Listed(properties)),
        }
    }
}

impl Display for Declared {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Material => "material",
            Self::Bar => "bar",
            Self::Mass => "mass",
            Self::Spring => "spring",
            Self::Hertz => "hertz",
            Self::Support => "support",
            Self::Load => "load",
        })
    }
}

impl Declared {
    /// What is declared, in a sentence.
    pub(super) fn noun(self) -> String {
        match self {
            Self::Hertz => "local contact".to_owned(),
            _ => self.to_string(),
        }
    }
}

impl Display for Property {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}{}", self.name, self.value, AfterValue(self.unit.as_ref()))
    }
}

/// A unit behind a value.
struct AfterValue<'a>(Option<&'a Unit>);

impl Display for AfterValue<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (position, factor) in self.0.iter().flat_map(|unit| &unit.value).enumerate() {
            f.write_char(match (position, factor.operator) {
                (0, _) => ' ',
                (_, Operator::Multiply) => '*',
                (_, Operator::Divide) => '/',
            })?;
            factor.name.fmt(f)?;
            if factor.power != 1 {
                write!(f, "^{}", factor.power)?;
            }
        }
        Ok(())
    }
}

impl Display for Line {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "line {}", self.left.value.word())?;
        let elements = self.elements.iter().map(|name| name.value.as_str());
        let names = elements.chain([self.right.value.word()]);
        self.joints.iter().zip(names).try_for_each(|(joint, name)| {
            let sign = match joint.value {
                Joint::Bonded => '-',
                Joint::Contact => '|',
            };
            write!(f, " {sign} {name}")
        })
    }
}

/// Without the sign, which depends on the place in the sum.
impl Display for ObservedTerm {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Spanned { value: measure, .. } = self.measure;
        let reading = format!("{}({})", measure.word(), self.place);
        match self.factors.first().map(|factor| factor.operator) {
            None => f.write_str(&reading),
            Some(Operator::Multiply) => {
                product(&self.factors, f)?;
                write!(f, "*{reading}")
            }
            Some(Operator::Divide) => {
                // A product that begins with a divisor is written behind what it divides.
                let mut divisors = String::new();
                write!(divisors, "{}", Factors(self))?;
                let divisors = divisors.strip_prefix('1').unwrap_or(&divisors);
                write!(f, "{reading}{divisors}")
            }
        }
    }
}

/// The factors of a term as a product.
struct Factors<'a>(&'a ObservedTerm);

impl Display for Factors<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        product(&self.0.factors, f)
    }
}

impl Display for ObservedPlace {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.element.fmt(f)?;
        match &self.section {
            None => Ok(()),
            Some(Section::Left) => f.write_str(".left"),
            Some(Section::Right) => f.write_str(".right"),
            Some(Section::At { position, unit }) => {
                write!(f, ".at({position}{})", AfterValue(unit.as_ref()))
            }
        }
    }
}
