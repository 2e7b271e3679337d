//! The tree as text again, with no more parentheses than it takes to read the same tree back.

use std::fmt::{self, Display, Formatter, Write};

use super::number;
use super::syntax::{
    Condition, Declaration, Declared, Expression, Factor, Formula, Function, Index, Line, Listing,
    Node, ObservedPlace, ObservedTerm, Operator, Property, Recurrence, Rewriting, Scene,
    SceneStatementKind, Section, Sign, Spanned, StatementKind, Symbol, Term, Text, Unit, Wave,
};

impl<T: Display> Display for Spanned<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}

/// How tightly a node holds together. A part is put in parentheses if its place asks for more.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Tightness {
    Sum,
    Product,
    Sign,
    Power,
    Atom,
}

impl Node {
    fn tightness(&self) -> Tightness {
        match self {
            Self::Sum(_) => Tightness::Sum,
            Self::Product(_) => Tightness::Product,
            Self::Negate(_) => Tightness::Sign,
            Self::Power { .. } => Tightness::Power,
            Self::Number(_)
            | Self::Name(_)
            | Self::Wave(_)
            | Self::Call { .. }
            | Self::Exponential(_)
            | Self::Function { .. }
            | Self::Summation { .. } => Tightness::Atom,
        }
    }
}

/// An expression in a place that holds at least this tightly.
struct Within<'a>(&'a Expression, Tightness);

impl Display for Within<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(expression, place) = self;
        if expression.value.tightness() < *place {
            write!(f, "({expression})")
        } else {
            expression.fmt(f)
        }
    }
}

impl Display for Node {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(value) => f.write_str(&number::written(value)),
            Self::Name(name) => f.write_str(name),
            Self::Wave(wave) => wave.fmt(f),
            Self::Call { name, argument } => write!(f, "{name}({argument})"),
            Self::Exponential(argument) => write!(f, "exp({argument})"),
            Self::Function { function, argument } => write!(f, "{function}({argument})"),
            Self::Summation { term, index, bound } => write!(f, "sum({term}, {index} < {bound})"),
            Self::Sum(terms) => sum(terms, f),
            Self::Product(factors) => Factors(factors).fmt(f),
            Self::Negate(operand) => write!(f, "-{}", Within(operand, Tightness::Sign)),
            Self::Power { base, exponent } => {
                let base = Within(base, Tightness::Atom);
                write!(f, "{base}^{}", Within(exponent, Tightness::Sign))
            }
        }
    }
}

impl Display for Function {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cosine => "cos",
            Self::Sine => "sin",
            Self::SquareRoot => "sqrt",
        })
    }
}

/// Parts with their signs between them; the first sign stands alone.
fn joined<'a>(
    parts: impl Iterator<Item = ([&'static str; 2], &'a Expression)>,
    place: Tightness,
    f: &mut Formatter<'_>,
) -> fmt::Result {
    for (position, ([first, later], value)) in parts.enumerate() {
        f.write_str(if position == 0 { first } else { later })?;
        Within(value, place).fmt(f)?;
    }
    Ok(())
}

fn sum(terms: &[Term], f: &mut Formatter<'_>) -> fmt::Result {
    let signs = |sign| if sign == Sign::Plus { ["", " + "] } else { ["-", " - "] };
    let parts = terms.iter().map(|term| (signs(term.sign), &term.value));
    joined(parts, Tightness::Product, f)
}

/// A product; one that begins with a divisor is written `1/a`.
struct Factors<'a>(&'a [Factor]);

impl Display for Factors<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let signs = |operator| match operator {
            Operator::Multiply => ["", "*"],
            Operator::Divide => ["1/", "/"],
        };
        let parts = self.0.iter().map(|factor| (signs(factor.operator), &factor.value));
        joined(parts, Tightness::Sign, f)
    }
}

impl Display for Wave {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}]", self.name, self.index)?;
        (0..self.primes).try_for_each(|_| f.write_char('\''))
    }
}

impl Display for Index {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.base {
            None => self.offset.fmt(f),
            Some(base) if self.offset == 0 => base.fmt(f),
            Some(base) => write!(f, "{base}{:+}", self.offset),
        }
    }
}

impl<K: Display> Text<K> {
    fn write(&self, whole: &str, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{whole} \"{}\"", self.title)?;
        self.statements.iter().try_for_each(|statement| writeln!(f, "{statement}"))
    }
}

impl Display for Recurrence {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.write("recurrence", f)
    }
}

impl Display for Scene {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.write("scene", f)
    }
}

impl Display for StatementKind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Symbols(symbols) => write!(f, "symbol {}", Listed(symbols)),
            Self::Nonzero(expression) => write!(f, "nonzero {expression}"),
            Self::Period { length, local, time } => {
                write!(f, "period {length}, local {local}, time {time}")
            }
            Self::Waves(names) => write!(f, "wave {}", Listed(names)),
            Self::Equation { left, right } => write!(f, "equation {left} = {right}"),
            Self::Continuous { quantity, start } => {
                write!(f, "continuous {quantity} starts at {start}")
            }
            Self::Written(items) => write!(f, "written {}", Listed(items)),
            Self::Observe { name, value } => write!(f, "observe {name} = {value}"),
        }
    }
}

impl Display for Rewriting {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unit { wave, unit } => write!(f, "{wave} in {unit}"),
            Self::Name { name, written } => write!(f, "{name} as {written}"),
            Self::Constants { wave, name } => write!(f, "constants of {wave} as {name}"),
            Self::Ends(wave) => write!(f, "ends of {wave}"),
        }
    }
}

/// Things with commas between them.
struct Listed<'a, T>(&'a [T]);

impl<T: Display> Display for Listed<'_, T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (position, item) in self.0.iter().enumerate() {
            if position > 0 {
                f.write_str(", ")?;
            }
            item.fmt(f)?;
        }
        Ok(())
    }
}

impl Display for Symbol {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.condition {
            None => self.name.fmt(f),
            Some(Condition { relation, bound }) => write!(f, "{} {relation} {bound}", self.name),
        }
    }
}

impl Display for Listing {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.formulas.iter().try_for_each(|formula| writeln!(f, "{formula}"))
    }
}

impl Display for Formula {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { wave, index, argument, value } = self;
        write!(f, "{wave}[{index}]({argument}) = {value}")
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

impl Declared {
    pub(super) const ALL: [Self; 7] = [
        Self::Material,
        Self::Bar,
        Self::Mass,
        Self::Spring,
        Self::Hertz,
        Self::Support,
        Self::Load,
    ];

    /// The word that begins its statement.
    pub(super) const fn word(self) -> &'static str {
        match self {
            Self::Material => "material",
            Self::Bar => "bar",
            Self::Mass => "mass",
            Self::Spring => "spring",
            Self::Hertz => "hertz",
            Self::Support => "support",
            Self::Load => "load",
        }
    }

    /// What is declared, in a sentence.
    pub(super) const fn noun(self) -> &'static str {
        if matches!(self, Self::Hertz) { "local contact" } else { self.word() }
    }
}

impl Display for Declared {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
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
        self.joints
            .iter()
            .zip(names)
            .try_for_each(|(joint, name)| write!(f, " {} {name}", joint.value.sign()))
    }
}

/// Without the sign, which depends on the place in the sum.
impl Display for ObservedTerm {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let reading = format!("{}({})", self.measure.value.word(), self.place);
        let factors = Factors(&self.factors).to_string();
        match self.factors.first().map(|factor| factor.operator) {
            None => f.write_str(&reading),
            Some(Operator::Multiply) => write!(f, "{factors}*{reading}"),
            // A product that begins with a divisor, `1/a`, is written behind what it divides.
            Some(Operator::Divide) => write!(f, "{reading}{}", &factors[1..]),
        }
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
