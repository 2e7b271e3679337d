//! Expressions as text again, with no more parentheses than it takes to read the same tree back.

use std::fmt::{self, Display, Formatter, Write};

use super::number;
use super::syntax::{
    Declared, Expression, Factor, Function, Index, Node, Operator, Sign, Spanned, Term, Wave,
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
            Self::Product(factors) => product(factors, f),
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
fn product(factors: &[Factor], f: &mut Formatter<'_>) -> fmt::Result {
    let signs = |operator| match operator {
        Operator::Multiply => ["", "*"],
        Operator::Divide => ["1/", "/"],
    };
    let parts = factors.iter().map(|factor| (signs(factor.operator), &factor.value));
    joined(parts, Tightness::Sign, f)
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

impl Declared {
    /// The words that begin statements, in the order of the kinds.
    const WORDS: [(&'static str, Self); 7] = [
        ("material", Self::Material),
        ("bar", Self::Bar),
        ("mass", Self::Mass),
        ("spring", Self::Spring),
        ("hertz", Self::Hertz),
        ("support", Self::Support),
        ("load", Self::Load),
    ];

    /// What a statement that begins with this word declares.
    pub(super) fn of(word: &str) -> Option<Self> {
        Self::WORDS.into_iter().find(|(own, _)| *own == word).map(|(_, kind)| kind)
    }

    /// What is declared, in a sentence.
    pub(super) const fn noun(self) -> &'static str {
        if matches!(self, Self::Hertz) { "local contact" } else { Self::WORDS[self as usize].0 }
    }
}

impl Display for Declared {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(Self::WORDS[*self as usize].0)
    }
}
