//! The tree as text again, with no more parentheses than it takes to read the same tree back.

use std::fmt::{self, Display, Formatter, Write};

use super::number;
use super::syntax::{
    Condition, Expression, Factor, Formula, Function, Index, Listing, Name, Node, Operator,
    Recurrence, Relation, Rewriting, Sign, Spanned, Statement, StatementKind, Symbol, Term, Wave,
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

fn sum(terms: &[Term], f: &mut Formatter<'_>) -> fmt::Result {
    for (position, Term { sign, value }) in terms.iter().enumerate() {
        match (position, sign) {
            (0, Sign::Plus) => {}
            (0, Sign::Minus) => f.write_char('-')?,
            (_, Sign::Plus) => f.write_str(" + ")?,
            (_, Sign::Minus) => f.write_str(" - ")?,
        }
        Within(value, Tightness::Product).fmt(f)?;
    }
    Ok(())
}

pub(super) fn product(factors: &[Factor], f: &mut Formatter<'_>) -> fmt::Result {
    for (position, Factor { operator, value }) in factors.iter().enumerate() {
        match (position, operator) {
            (0, Operator::Multiply) => {}
            (0, Operator::Divide) => f.write_str("1/")?,
            (_, Operator::Multiply) => f.write_char('*')?,
            (_, Operator::Divide) => f.write_char('/')?,
        }
        Within(value, Tightness::Sign).fmt(f)?;
    }
    Ok(())
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

impl Display for Recurrence {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "recurrence \"{}\"", self.title)?;
        self.statements.iter().try_for_each(|statement: &Statement| writeln!(f, "{statement}"))
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
            Self::Waves(names) => write!(f, "wave {}", Listed::<Name>(names)),
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
pub(super) struct Listed<'a, T>(pub(super) &'a [T]);

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

impl Display for Relation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Greater => ">",
            Self::GreaterOrEqual => ">=",
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::NotEqual => "!=",
        })
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
