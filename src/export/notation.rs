//! One walk over an arranged formula, in two notations.

use crate::export::arrangement::{Node, Sign, Term};
use crate::export::lines::Atom;
use num_traits::One;
use wavestep_polynomial::{Rational, Symbol};

/// How the parts of a formula are written.
pub trait Notation {
    /// A number, not negative.
    fn number(&self, value: &Rational) -> String;
    /// A name.
    fn symbol(&self, symbol: &Symbol) -> String;
    /// `base^exponent`, both already written.
    fn power(&self, base: &str, exponent: &str) -> String;
    /// `e^{exponent}`.
    fn exponential(&self, exponent: &str) -> String;
    /// A quotient; the flags say whether a side needs brackets where it is written in a line.
    fn quotient(&self, numerator: (&str, bool), denominator: (&str, bool)) -> String;
    /// A Laguerre polynomial.
    fn laguerre(&self, index: &str, argument: &str) -> String;
    /// A factorial.
    fn factorial(&self, of: &str, simple: bool) -> String;
    /// What stands between two factors.
    fn times(&self, left: &Node, right: &Node) -> &'static str;
    /// Brackets that grow with what is in them.
    fn enclosed(&self, text: &str) -> String;
    /// Brackets at a depth of nesting, 0 outermost.
    fn brackets(&self, depth: usize) -> (&'static str, &'static str);
    /// How wide a piece of writing is on the page.
    fn width(&self, text: &str) -> usize;
}

/// The atoms of a sum of terms; zero where there are none.
pub fn write(terms: &[Term], notation: &dyn Notation) -> Vec<Atom> {
    let mut writer = Writer { notation, atoms: Vec::new() };
    if terms.is_empty() {
        writer.push(notation.number(&Rational::default()), None);
    }
    writer.sum(terms, 0);
    writer.atoms
}

/// The writing of a sum of terms without line breaks.
pub(crate) fn write_flat(terms: &[Term], notation: &dyn Notation) -> String {
    write(terms, notation).into_iter().map(|atom| atom.text).collect()
}

struct Writer<'a> {
    notation: &'a dyn Notation,
    atoms: Vec<Atom>,
}

impl Writer<'_> {
    fn push(&mut self, text: String, break_before: Option<usize>) {
        let width = self.notation.width(&text);
        self.atoms.push(Atom { text, width, break_before });
    }

    fn sum(&mut self, terms: &[Term], depth: usize) {
        for (i, (sign, node)) in terms.iter().enumerate() {
            match (i, sign) {
                (0, Sign::Plus) => {}
                (0, Sign::Minus) => self.push("-".to_owned(), None),
                // The space before a sign belongs to the atom before, the line ends without it.
                (_, sign) => {
                    self.push(" ".to_owned(), None);
                    let sign = if *sign == Sign::Plus { "+ " } else { "- " };
                    self.push(sign.to_owned(), Some(depth));
                }
            }
            self.term(node, depth);
        }
    }

    fn term(&mut self, node: &Node, depth: usize) {
        let factors = match node {
            Node::Product(factors) => &factors[..],
            other => std::slice::from_ref(other),
        };
        for (i, factor) in factors.iter().enumerate() {
            if i > 0 {
                let times = self.notation.times(&factors[i - 1], factor);
                self.push(times.to_owned(), None);
            }
            match factor {
                Node::Sum(terms) => {
                    let (open, close) = self.notation.brackets(depth);
                    self.push(open.to_owned(), None);
                    self.sum(terms, depth + 1);
                    self.push(close.to_owned(), None);
                }
                other => {
                    let text = self.flat(other);
                    self.push(text, None);
                }
            }
        }
    }

    /// A node in one line.
    fn flat(&self, node: &Node) -> String {
        let n = self.notation;
        match node {
            Node::Number(value) => n.number(value),
            Node::Symbol(symbol) => n.symbol(symbol),
            Node::Sum(terms) => write_inner(terms, n),
            Node::Product(_) => write_inner(&[(Sign::Plus, node.clone())], n),
            Node::Quotient(top, bottom) => {
                let side = |node: &Node| self.flat(node);
                let top_brackets = matches!(**top, Node::Sum(_));
                let bottom_brackets = matches!(**bottom, Node::Sum(_) | Node::Product(_));
                n.quotient((&side(top), top_brackets), (&side(bottom), bottom_brackets))
            }
            Node::Power(base, exponent) => {
                let text = self.flat(base);
                let simple = matches!(&**base, Node::Symbol(_))
                    || matches!(&**base, Node::Number(value) if value.denom().is_one());
                let base = if simple { text } else { n.enclosed(&text) };
                let text = self.flat(exponent);
                n.power(&base, &text)
            }
            Node::Exponential(sign, exponent) => {
                let minus = if *sign == Sign::Minus { "-" } else { "" };
                let brackets = matches!(**exponent, Node::Sum(_)) && *sign == Sign::Minus;
                let text = self.flat(exponent);
                let text = if brackets { n.enclosed(&text) } else { text };
                n.exponential(&format!("{minus}{text}"))
            }
            Node::Laguerre(index, argument) => n.laguerre(&self.flat(index), &self.flat(argument)),
            Node::Factorial(of) => {
                n.factorial(&self.flat(of), matches!(**of, Node::Symbol(_) | Node::Number(_)))
            }
        }
    }
}

/// A sum inside something else: its brackets are inner ones.
fn write_inner(terms: &[Term], notation: &dyn Notation) -> String {
    let mut writer = Writer { notation, atoms: Vec::new() };
    writer.sum(terms, 1);
    writer.atoms.into_iter().map(|atom| atom.text).collect()
}

/// Plain text: explicit `*`, `exp(…)` and `^`, which the language reads back.
pub struct Text;

impl Notation for Text {
    fn number(&self, value: &Rational) -> String {
        value.to_string()
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        symbol.to_string()
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        let simple = exponent.chars().all(char::is_alphanumeric);
        if simple { format!("{base}^{exponent}") } else { format!("{base}^({exponent})") }
    }

    fn exponential(&self, exponent: &str) -> String {
        format!("exp({exponent})")
    }

    fn quotient(&self, numerator: (&str, bool), denominator: (&str, bool)) -> String {
        let side = |(text, brackets): (&str, bool)| {
            if brackets { format!("({text})") } else { text.to_owned() }
        };
        format!("{}/{}", side(numerator), side(denominator))
    }

    fn laguerre(&self, index: &str, argument: &str) -> String {
        format!("L[{index}]({argument})")
    }

    fn factorial(&self, of: &str, simple: bool) -> String {
        if simple { format!("{of}!") } else { format!("({of})!") }
    }

    fn times(&self, _: &Node, _: &Node) -> &'static str {
        "*"
    }

    fn enclosed(&self, text: &str) -> String {
        format!("({text})")
    }

    fn brackets(&self, _: usize) -> (&'static str, &'static str) {
        ("(", ")")
    }

    fn width(&self, text: &str) -> usize {
        text.chars().count()
    }
}

/// LaTeX for amsmath and KaTeX.
pub struct Latex;

/// Names that have a command of their own.
const GREEK: [&str; 34] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi",
    "omega", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi",
    "Omega",
];

impl Latex {
    /// A name: Greek letters as such, one letter in italics, a word upright, `a_1` as subscript.
    pub fn name(name: &str) -> String {
        if GREEK.contains(&name) {
            return format!("\\{name}");
        }
        if let Some((base, subscript)) = name.split_once('_')
            && !base.is_empty()
            && !subscript.is_empty()
        {
            let subscript = match GREEK.contains(&subscript) || subscript.len() == 1 {
                true => Latex::name(subscript),
                false => format!("\\mathrm{{{}}}", subscript.replace('_', "\\_")),
            };
            return format!("{}_{{{subscript}}}", Latex::name(base));
        }
        let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
        if letters.len() < name.len() && !letters.is_empty() {
            return format!("{}_{{{}}}", Latex::name(letters), &name[letters.len()..]);
        }
        match name.chars().count() {
            1 => name.to_owned(),
            _ => format!("\\mathrm{{{}}}", name.replace('_', "\\_")),
        }
    }
}

impl Notation for Latex {
    fn number(&self, value: &Rational) -> String {
        match value.denom().is_one() {
            true => value.numer().to_string(),
            false => format!("\\frac{{{}}}{{{}}}", value.numer(), value.denom()),
        }
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        Latex::name(symbol.name())
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        let base = if base.contains("_{") { format!("{{{base}}}") } else { base.to_owned() };
        format!("{base}^{{{exponent}}}")
    }

    fn exponential(&self, exponent: &str) -> String {
        format!("e^{{{exponent}}}")
    }

    fn quotient(&self, numerator: (&str, bool), denominator: (&str, bool)) -> String {
        format!("\\frac{{{}}}{{{}}}", numerator.0, denominator.0)
    }

    fn laguerre(&self, index: &str, argument: &str) -> String {
        format!("L_{{{index}}}({argument})")
    }

    fn factorial(&self, of: &str, simple: bool) -> String {
        if simple { format!("{of}!") } else { format!("({of})!") }
    }

    fn times(&self, left: &Node, right: &Node) -> &'static str {
        match (left, right) {
            (Node::Exponential(..), Node::Sum(_)) => "",
            (_, Node::Sum(_)) => "\\,",
            _ => " ",
        }
    }

    fn enclosed(&self, text: &str) -> String {
        let tall = text.contains("\\frac");
        if tall { format!("\\left({text}\\right)") } else { format!("({text})") }
    }

    fn brackets(&self, depth: usize) -> (&'static str, &'static str) {
        if depth == 0 { ("\\bigl[", "\\bigr]") } else { ("(", ")") }
    }

    /// Commands count as one character, braces and fraction bars as none.
    fn width(&self, text: &str) -> usize {
        let mut width = 0;
        let mut characters = text.chars().peekable();
        while let Some(character) = characters.next() {
            match character {
                '\\' => {
                    let mut length = 0;
                    while characters.next_if(char::is_ascii_alphabetic).is_some() {
                        length += 1;
                    }
                    width += usize::from(length > 0);
                }
                '{' | '}' | '^' | '_' | ' ' => {}
                '+' | '-' => width += 2,
                _ => width += 1,
            }
        }
        width
    }
}
