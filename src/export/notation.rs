//! The notations of a formula: how its parts are written.

use crate::export::mathml;
use crate::export::names::latex_name;
use crate::export::tree::Tree;
use num_traits::One;
use wavestep_polynomial::{Integer, Rational, Symbol, decimal};

/// In which signs a formula is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Notation {
    /// Plain text: explicit `*`, `exp(…)` and `^`, which the language reads back.
    Text,
    /// LaTeX for amsmath and KaTeX.
    Latex,
    /// MathML Core, for pages.
    MathMl,
}

use Notation::{Latex, MathMl, Text};

/// What is written, as text and in LaTeX.
pub(crate) fn both(write: impl Fn(Notation) -> String) -> (String, String) {
    (write(Text), write(Latex))
}

impl Notation {
    pub(crate) const ALL: [Notation; 3] = [Text, Latex, MathMl];

    /// One of two, by the notation.
    pub fn choose<'a>(self, text: &'a str, latex: &'a str) -> &'a str {
        match (self, text) {
            (Latex, _) => latex,
            (MathMl, "<=") => "≤",
            (MathMl, ">=") => "≥",
            (Text | MathMl, text) => text,
        }
    }

    /// A number, not negative.
    pub fn number(self, value: &Rational) -> String {
        let (top, bottom) = (decimal(value.numer()), decimal(value.denom()));
        match self {
            _ if value.denom().is_one() => top,
            Text => format!("{top}/{bottom}"),
            Latex => format!("\\frac{{{top}}}{{{bottom}}}"),
            MathMl => mathml::element("mfrac", &[&top, &bottom]),
        }
    }

    pub fn symbol(self, symbol: &Symbol) -> String {
        match (self, symbol.square()) {
            (Text, _) => symbol.to_string(),
            (_, None) => self.name(symbol.name()),
            (_, Some(-1)) => self.root(&Integer::one(), true),
            (_, Some(square)) => self.root(&square.into(), false),
        }
    }

    pub fn name(self, name: &str) -> String {
        match self {
            Text => name.to_owned(),
            Latex => latex_name(name, None),
            MathMl => mathml::name(name, None),
        }
    }

    /// A wave on a period: `f[2]`.
    pub fn indexed(self, name: &str, index: &str) -> String {
        match self {
            Text => format!("{name}[{index}]"),
            Latex => latex_name(name, Some(index)),
            MathMl => mathml::name(name, Some(index)),
        }
    }

    /// An echo of a wave: `phi_f[2](s)`.
    pub fn echo(self, wave: &str, index: &str, argument: &str) -> String {
        match self {
            Text => format!("phi_{wave}[{index}]({argument})"),
            Latex => {
                let wave = latex_name(wave, None);
                format!("\\varphi^{{{wave}}}_{{{index}}}({argument})")
            }
            MathMl => {
                let parts = ["φ", index, &self.name(wave)];
                format!("{}({argument})", mathml::element("msubsup", &parts))
            }
        }
    }

    /// The sum of all terms whose number, or delay, lies between 0 and `last`.
    pub fn sum_between(self, what: &str, last: &str, term: &str) -> String {
        match self {
            Text => format!("sum({term}, 0 <= {what} <= {last})"),
            Latex => format!("\\sum_{{0 \\le {what} \\le {last}}} {term}"),
            MathMl => {
                let range = format!("<mrow>0≤{what}≤{last}</mrow>");
                format!("<munder><mo>∑</mo>{range}</munder>{term}")
            }
        }
    }

    /// `base^exponent`, both already written.
    pub fn power(self, base: &str, exponent: &str) -> String {
        match self {
            Text if exponent.chars().all(char::is_alphanumeric) => format!("{base}^{exponent}"),
            Text => format!("{base}^({exponent})"),
            // A subscript and an exponent stand over each other only with braces.
            Latex if base.contains("_{") && !base.starts_with('(') => {
                format!("{{{base}}}^{{{exponent}}}")
            }
            Latex => format!("{base}^{{{exponent}}}"),
            MathMl => mathml::element("msup", &[base, exponent]),
        }
    }

    /// `e^{exponent}`.
    pub fn exponential(self, exponent: &str) -> String {
        match self {
            Text => format!("exp({exponent})"),
            Latex => format!("e^{{{exponent}}}"),
            MathMl => mathml::element("msup", &["e", exponent]),
        }
    }

    /// The root of a positive integer; times the imaginary unit if `imaginary`.
    pub fn root(self, radicand: &Integer, imaginary: bool) -> String {
        let radicand = decimal(radicand);
        match (self, &*radicand, imaginary) {
            (Text, _, true) => self.root_of(&format!("-{radicand}")),
            (Latex, "1", true) => "\\mathrm{i}".to_owned(),
            (MathMl, "1", true) => "i".to_owned(),
            (MathMl, _, true) => format!("i{}", self.root_of(&radicand)),
            (Latex | MathMl, "1", false) => String::new(),
            (Latex, _, true) => format!("\\mathrm{{i}}{}", self.root_of(&radicand)),
            (_, _, false) => self.root_of(&radicand),
        }
    }

    pub fn root_of(self, radicand: &str) -> String {
        match self {
            Text => format!("sqrt({radicand})"),
            Latex => format!("\\sqrt{{{radicand}}}"),
            MathMl => mathml::element("msqrt", &[radicand]),
        }
    }

    /// `cos(…)`, `sin(…)`.
    pub fn function(self, name: &str, argument: &str) -> String {
        format!("{}{name}{}", self.choose("", "\\"), self.enclosed(argument))
    }

    /// A quotient; the flags say whether a side needs brackets where it is written in a line.
    pub fn quotient(self, top: (&str, bool), bottom: (&str, bool)) -> String {
        let side = |(text, brackets): (&str, bool)| match brackets {
            true => format!("({text})"),
            false => text.to_owned(),
        };
        match self {
            Text => format!("{}/{}", side(top), side(bottom)),
            Latex => format!("\\frac{{{}}}{{{}}}", top.0, bottom.0),
            MathMl => mathml::element("mfrac", &[top.0, bottom.0]),
        }
    }

    /// A Laguerre polynomial, or with a prime its derivative.
    pub fn laguerre(self, name: &Symbol, prime: &str, index: &str, argument: &str) -> String {
        let (name, argument) = (self.symbol(name), self.enclosed(argument));
        match self {
            Text => format!("{name}{prime}[{index}]{argument}"),
            Latex => format!("{name}_{{{index}}}{prime}{argument}"),
            MathMl => {
                format!("{}{prime}{argument}", mathml::element("msub", &[&name, index]))
            }
        }
    }

    /// The sign before a symbol that is a factor.
    pub fn times_symbol(self) -> &'static str {
        match self {
            Text => "*",
            Latex => " ",
            MathMl => mathml::TIMES,
        }
    }

    /// The sign between two factors.
    pub(crate) fn times(self, left: &Tree, right: &Tree) -> &'static str {
        match (self, left, right) {
            (Text, ..) => "*",
            (MathMl, ..) => mathml::TIMES,
            (_, left, Tree::Sum(_) | Tree::Bracket(_)) if left.is_wave() => "",
            (_, _, Tree::Sum(_)) => "\\,",
            _ => " ",
        }
    }

    /// Brackets that grow with their contents.
    pub fn enclosed(self, text: &str) -> String {
        match self {
            Latex if text.contains("\\frac") => format!("\\left({text}\\right)"),
            MathMl if text.contains("<mfrac") => {
                format!("<mrow><mo>(</mo>{text}<mo>)</mo></mrow>")
            }
            _ => format!("({text})"),
        }
    }

    /// Brackets that lines may be broken in.
    pub(crate) fn brackets(self, of: &Tree) -> (&'static str, &'static str) {
        const OPEN: &str = "<mo minsize=\"1.9em\" maxsize=\"1.9em\">(</mo>";
        const CLOSE: &str = "<mo minsize=\"1.9em\" maxsize=\"1.9em\">)</mo>";
        match (of, self == Latex && of.is_tall()) {
            (_, false) if self == MathMl && of.is_tall() => (OPEN, CLOSE),
            (Tree::Bracket(_), true) => ("\\Bigl[", "\\Bigr]"),
            (Tree::Bracket(_), false) if self == Latex => ("\\bigl[", "\\bigr]"),
            (_, true) => ("\\Bigl(", "\\Bigr)"),
            _ => ("(", ")"),
        }
    }

    /// How wide a piece of writing is on the page. In LaTeX commands count as one character, braces and
    /// fraction bars as none, a sign with its space as two.
    pub fn width(self, text: &str) -> usize {
        if self == Text {
            return text.chars().count();
        }
        if self == MathMl {
            return mathml::width(text);
        }
        if text.bytes().all(|byte| byte.is_ascii_digit()) {
            return text.len();
        }
        let mut width = 0;
        let mut characters = text.chars().peekable();
        while let Some(character) = characters.next() {
            width += match character {
                '\\' => {
                    let mut length = 0;
                    while characters.next_if(char::is_ascii_alphabetic).is_some() {
                        length += 1;
                    }
                    usize::from(length > 0)
                }
                '{' | '}' | '^' | '_' | ' ' => 0,
                '+' | '-' => 2,
                _ => 1,
            };
        }
        width
    }
}
