//! Trees of formulas as LaTeX, arranged as they were read.

use crate::book::entry::{Equation, Relation};
use wavestep::export::latex_name;
use wavestep::language::syntax::{
    Expression as Tree, Factor, Function, Node, Operator, Sign, Term, Wave,
};

/// An equation as LaTeX, in the order of what was read.
pub fn of_equation(equation: &Equation) -> String {
    let (left, right) = (of(&equation.left), of(&equation.right));
    let relation = match equation.relation {
        Relation::Equals => "=",
        Relation::Starts => "\\text{ continuous, starting at }",
    };
    let condition = equation.condition.as_ref().map(|(name, value)| {
        format!(" \\quad \\text{{for }} {} = {}", latex_name(name, None), of(value))
    });
    format!("{left} {relation} {right}{}", condition.unwrap_or_default())
}

/// A formula as LaTeX, with fractions over each other.
pub(super) fn of(tree: &Tree) -> String {
    Writer { inline: false }.write(tree)
}

struct Writer {
    /// Whether fractions stand on one line, as in exponents.
    inline: bool,
}

/// Brackets as high as what they hold.
fn bracketed(text: &str) -> String {
    let high = ["\\frac", "\\sum", "\\left"].iter().any(|mark| text.contains(mark));
    if high { format!("\\left( {text} \\right)") } else { format!("({text})") }
}

impl Writer {
    fn write(&self, tree: &Tree) -> String {
        match &tree.value {
            Node::Number(value) if value.is_integer() => value.to_string(),
            Node::Number(value) => {
                self.fraction(&value.numer().to_string(), &value.denom().to_string())
            }
            Node::Name(name) => latex_name(name, None),
            Node::Wave(wave) => self.wave(wave),
            Node::Call { name, argument } => {
                let argument = Writer { inline: true }.write(argument);
                format!("{}({argument})", self.piece_name(&name.value))
            }
            Node::Exponential(argument) => {
                format!("e^{{{}}}", Writer { inline: true }.write(argument))
            }
            Node::Function { function, argument } => {
                let argument = self.write(argument);
                match function {
                    Function::Cosine => format!("\\cos{}", bracketed(&argument)),
                    Function::Sine => format!("\\sin{}", bracketed(&argument)),
                    Function::SquareRoot => format!("\\sqrt{{{argument}}}"),
                }
            }
            Node::Summation { term, index, bound } => {
                format!("\\sum_{{{}<{}}} {}", index.value, bound.value, self.factor(term))
            }
            Node::Sum(terms) => self.sum(terms),
            Node::Product(factors) => self.product(factors),
            Node::Negate(operand) => format!("-{}", self.factor(operand)),
            Node::Power { base, exponent } => {
                let text = self.write(base);
                let simple = matches!(base.value, Node::Number(_) | Node::Name(_) | Node::Wave(_));
                let base = if simple { text } else { bracketed(&text) };
                let base = if base.contains('_') && simple { format!("{{{base}}}") } else { base };
                format!("{base}^{{{}}}", Writer { inline: true }.write(exponent))
            }
        }
    }

    /// `f_prime[n-1]`, with dots for derivatives by a time and primes for others.
    fn wave(&self, wave: &Wave) -> String {
        let name = latex_name(&wave.name.value, Some(&wave.index.to_string()));
        format!("{name}{}", "'".repeat(usize::try_from(wave.primes).unwrap_or_default()))
    }

    /// `f_2` as the wave f on period 2.
    fn piece_name(&self, name: &str) -> String {
        match name.rsplit_once('_') {
            Some((wave, n)) if n.chars().all(|c| c.is_ascii_digit()) => latex_name(wave, Some(n)),
            _ => latex_name(name, None),
        }
    }

    fn sum(&self, terms: &[Term]) -> String {
        let mut text = String::new();
        for (i, Term { sign, value }) in terms.iter().enumerate() {
            text.push_str(match (i, sign) {
                (0, Sign::Plus) => "",
                (0, Sign::Minus) => "-",
                (_, Sign::Plus) => " + ",
                (_, Sign::Minus) => " - ",
            });
            text.push_str(&match value.value {
                Node::Sum(_) => bracketed(&self.write(value)),
                _ => self.write(value),
            });
        }
        text
    }

    /// A part of a product: in brackets where it is a sum, or begins with a sign.
    fn factor(&self, tree: &Tree) -> String {
        let text = self.write(tree);
        match tree.value {
            Node::Sum(_) | Node::Negate(_) => bracketed(&text),
            _ => text,
        }
    }

    /// Fractions and factors from left to right: `V/c*exp(x)` is `V/c` as a fraction, then `e^x`.
    fn product(&self, factors: &[Factor]) -> String {
        let (mut parts, mut above, mut below) = (Vec::new(), Vec::new(), Vec::new());
        let mut flush = |above: &mut Vec<&Tree>, below: &mut Vec<&Tree>| {
            if !above.is_empty() || !below.is_empty() {
                parts.push(self.quotient(above, below));
            }
            above.clear();
            below.clear();
        };
        for Factor { operator, value } in factors {
            match operator {
                Operator::Divide => below.push(value),
                Operator::Multiply => {
                    if !below.is_empty() {
                        flush(&mut above, &mut below);
                    }
                    above.push(value);
                }
            }
        }
        flush(&mut above, &mut below);
        parts.join(" ")
    }

    fn quotient(&self, above: &[&Tree], below: &[&Tree]) -> String {
        // A sign in front goes in front of the fraction.
        let (sign, first) = match above.first().map(|tree| &tree.value) {
            Some(Node::Negate(operand)) => ("-", Some(&**operand)),
            _ => ("", above.first().copied()),
        };
        let rest = above.iter().skip(1).copied();
        let above: Vec<&Tree> = first.into_iter().chain(rest).collect();
        let row = |trees: &[&Tree]| match trees {
            [] => "1".to_owned(),
            [one] if !below.is_empty() && !self.inline => self.write(one),
            many => many.iter().map(|tree| self.factor(tree)).collect::<Vec<_>>().join(" "),
        };
        match below.is_empty() {
            true => format!("{sign}{}", row(&above)),
            false => format!("{sign}{}", self.fraction(&row(&above), &row(below))),
        }
    }

    fn fraction(&self, above: &str, below: &str) -> String {
        match self.inline {
            false => format!("\\frac{{{above}}}{{{below}}}"),
            true => {
                let many = below.contains(' ') && !below.starts_with('(');
                let below = if many { bracketed(below) } else { below.to_owned() };
                format!("{above}/{below}")
            }
        }
    }
}

/// A text for LaTeX, its special characters written as such.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::new();
    for character in text.chars() {
        match character {
            '_' | '%' | '&' | '#' | '{' | '}' | '$' => {
                out.push('\\');
                out.push(character);
            }
            '^' => out.push_str("\\^{}"),
            '<' | '>' => out.push_str(&format!("${character}$")),
            '`' => out.push('\''),
            _ => out.push(character),
        }
    }
    out
}
