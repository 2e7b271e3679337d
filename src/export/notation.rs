//! One walk over an arranged formula, in two notations.

use crate::export::lines::Writing;
use crate::export::names::{Name, Names};
use crate::export::tree::{Monomial, Sign, Term, Tree};
use num_traits::One;
use std::collections::BTreeMap;
use wavestep_polynomial::{Integer, Rational, Symbol, decimal};

/// How the parts of a formula are written.
pub(crate) trait Notation {
    /// A number, not negative.
    fn number(&self, value: &Rational) -> String;
    /// A name.
    fn symbol(&self, symbol: &Symbol) -> String;
    /// `base^exponent`, both already written.
    fn power(&self, base: &str, exponent: &str) -> String;
    /// `e^{exponent}`.
    fn exponential(&self, exponent: &str) -> String;
    /// The root of a positive integer; times the imaginary unit if `imaginary`.
    fn root(&self, radicand: &Integer, imaginary: bool) -> String;
    /// `cos(…)`, `sin(…)`.
    fn function(&self, name: &str, argument: &str) -> String;
    /// A quotient; the flags say whether a side needs brackets where it is written in a line.
    fn quotient(&self, numerator: (&str, bool), denominator: (&str, bool)) -> String;
    /// A Laguerre polynomial.
    fn laguerre(&self, index: &str, argument: &str) -> String;
    /// A factorial.
    fn factorial(&self, of: &str, simple: bool) -> String;
    /// The sign before a symbol that is a factor.
    fn times_symbol(&self) -> &'static str;
    /// The name of a symbol that has one of its own, in this notation.
    fn choose<'a>(&self, name: &'a Name) -> &'a str;
    /// The sign between two factors.
    fn times(&self, left: &Tree, right: &Tree) -> &'static str;
    /// Brackets that grow with their contents.
    fn enclosed(&self, text: &str) -> String;
    /// Brackets that lines may be broken in.
    fn brackets(&self, of: &Tree) -> (&'static str, &'static str);
    /// How wide a piece of writing is on the page.
    fn width(&self, text: &str) -> usize;
}

/// A sum of terms as it is written; zero where there are none.
pub(crate) fn write(terms: &[Term], notation: &dyn Notation) -> Writing {
    write_named(terms, notation, &Names::new())
}

/// A sum of terms as it is written, with names for symbols.
pub(crate) fn write_named(terms: &[Term], notation: &dyn Notation, names: &Names) -> Writing {
    let mut writer = Writer::new(notation, names);
    if terms.is_empty() {
        writer.push(&notation.number(&Rational::default()));
    }
    writer.sum(terms, 0);
    writer.writing
}

/// The writing of a sum of terms without line breaks.
pub(crate) fn write_flat(terms: &[Term], notation: &dyn Notation) -> String {
    write(terms, notation).text().to_owned()
}

struct Writer<'a> {
    notation: &'a dyn Notation,
    names: &'a Names,
    writing: Writing,
    /// Powers of symbols as they are written, with their widths.
    powers: BTreeMap<Symbol, Vec<Option<(String, usize)>>>,
}

impl<'a> Writer<'a> {
    fn new(notation: &'a dyn Notation, names: &'a Names) -> Writer<'a> {
        Writer { notation, names, writing: Writing::default(), powers: BTreeMap::new() }
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        match self.names.get(symbol) {
            Some(name) => self.notation.choose(name).to_owned(),
            None => self.notation.symbol(symbol),
        }
    }

    /// Whether the name of a symbol takes brackets as a factor or a base.
    fn is_compound(&self, symbol: &Symbol) -> bool {
        self.names.get(symbol).is_some_and(|name| name.compound)
    }

    fn push(&mut self, text: &str) {
        self.writing.push(text, self.notation.width(text));
    }

    fn sum(&mut self, terms: &[Term], depth: usize) {
        for (i, (sign, tree)) in terms.iter().enumerate() {
            match (i, sign) {
                (0, Sign::Plus) => {}
                (0, Sign::Minus) => self.push("-"),
                (_, sign) => {
                    // The space before a sign belongs to the line before.
                    self.push(" ");
                    self.writing.allow_break(depth);
                    self.push(if *sign == Sign::Plus { "+ " } else { "- " });
                }
            }
            self.term(tree, depth);
        }
    }

    fn term(&mut self, tree: &Tree, depth: usize) {
        let factors = match tree {
            Tree::Product(factors) => &factors[..],
            other => std::slice::from_ref(other),
        };
        for (i, factor) in factors.iter().enumerate() {
            if i > 0 {
                self.push(self.notation.times(&factors[i - 1], factor));
            }
            let last = i + 1 == factors.len();
            match factor {
                Tree::Sum(terms) | Tree::Bracket(terms) => {
                    let (open, close) = self.notation.brackets(factor);
                    self.push(open);
                    self.sum(terms, depth + 1);
                    self.push(close);
                }
                Tree::Monomial(monomial) => self.monomial(monomial, i == 0, last),
                Tree::Symbol(symbol) => self.power(symbol, 1, i == 0, last),
                other => {
                    let text = self.flat(other);
                    self.push(&text);
                }
            }
        }
    }

    /// A number and powers; `first` and `last` say that no factor stands before, and none after.
    fn monomial(&mut self, monomial: &Monomial, mut first: bool, last: bool) {
        let has_number = !monomial.coefficient.is_one();
        if has_number {
            self.push(&self.notation.number(&monomial.coefficient));
            first = false;
        }
        let mut powers = monomial.powers().peekable();
        let mut separated = !has_number;
        while let Some((symbol, exponent)) = powers.next() {
            if !separated {
                self.push(self.notation.times_symbol());
            }
            separated = false;
            self.power(symbol, exponent, first, last && powers.peek().is_none());
            first = false;
        }
    }

    /// A power of a symbol. A compound name is bracketed where a factor follows, and after a factor
    /// where it begins with a number or a sign.
    fn power(&mut self, symbol: &Symbol, exponent: u32, first: bool, last: bool) {
        let n = self.notation;
        if let Some(name) = self.names.get(symbol).filter(|name| name.compound && exponent == 1) {
            let brackets = !last || (name.leads && !first);
            let text = n.choose(name);
            return self.push(&if brackets { n.enclosed(text) } else { text.to_owned() });
        }
        let known = self.powers.entry(symbol.clone()).or_default();
        if known.len() <= exponent as usize {
            known.resize(exponent as usize + 1, None);
        }
        let (text, width) = known[exponent as usize].get_or_insert_with(|| {
            let tree = Tree::power(Tree::Symbol(symbol.clone()), exponent);
            let text = Writer::new(n, self.names).flat(&tree);
            let width = n.width(&text);
            (text, width)
        });
        self.writing.push(text, *width);
    }

    /// A sum inside something else, in one line.
    fn inner(&self, terms: &[Term]) -> String {
        let mut writer = Writer::new(self.notation, self.names);
        writer.sum(terms, 0);
        writer.writing.text().to_owned()
    }

    /// A tree in one line.
    fn flat(&self, tree: &Tree) -> String {
        let n = self.notation;
        match tree {
            Tree::Number(value) => n.number(value),
            Tree::Symbol(symbol) => self.symbol(symbol),
            Tree::Root(radicand, imaginary) => n.root(radicand, *imaginary),
            Tree::Oscillation(wave, angle) => n.function(wave.name(), &self.flat(angle)),
            Tree::Sum(terms) | Tree::Bracket(terms) => self.inner(terms),
            Tree::Monomial(_) | Tree::Product(_) => {
                let mut writer = Writer::new(self.notation, self.names);
                writer.term(tree, 0);
                writer.writing.text().to_owned()
            }
            Tree::Quotient(top, bottom) => {
                let side = |tree: &Tree| self.flat(tree);
                let top_brackets = matches!(**top, Tree::Sum(_));
                let bottom_brackets = match &**bottom {
                    Tree::Sum(_) | Tree::Product(_) | Tree::Monomial(_) | Tree::Quotient(..) => {
                        true
                    }
                    Tree::Symbol(symbol) => self.is_compound(symbol),
                    _ => false,
                };
                n.quotient((&side(top), top_brackets), (&side(bottom), bottom_brackets))
            }
            Tree::Power(base, exponent) => {
                let text = self.flat(base);
                let simple = match &**base {
                    Tree::Symbol(symbol) => !self.is_compound(symbol),
                    Tree::Number(value) => value.denom().is_one(),
                    Tree::Root(radicand, imaginary) => radicand.is_one() || !imaginary,
                    _ => false,
                };
                let base = if simple { text } else { n.enclosed(&text) };
                let text = self.flat(exponent);
                n.power(&base, &text)
            }
            Tree::Exponential(sign, exponent) => {
                let minus = if *sign == Sign::Minus { "-" } else { "" };
                let brackets = matches!(**exponent, Tree::Sum(_)) && *sign == Sign::Minus;
                let text = self.flat(exponent);
                let text = if brackets { n.enclosed(&text) } else { text };
                n.exponential(&format!("{minus}{text}"))
            }
            Tree::Laguerre(index, argument) => n.laguerre(&self.flat(index), &self.flat(argument)),
            Tree::Factorial(of) => {
                n.factorial(&self.flat(of), matches!(**of, Tree::Symbol(_) | Tree::Number(_)))
            }
        }
    }
}

/// Plain text: explicit `*`, `exp(…)` and `^`, which the language reads back.
pub(crate) struct Text;

impl Notation for Text {
    fn number(&self, value: &Rational) -> String {
        match value.denom().is_one() {
            true => decimal(value.numer()),
            false => format!("{}/{}", decimal(value.numer()), decimal(value.denom())),
        }
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        symbol.to_string()
    }

    fn choose<'a>(&self, name: &'a Name) -> &'a str {
        &name.text
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        let simple = exponent.chars().all(char::is_alphanumeric);
        if simple { format!("{base}^{exponent}") } else { format!("{base}^({exponent})") }
    }

    fn exponential(&self, exponent: &str) -> String {
        format!("exp({exponent})")
    }

    fn root(&self, radicand: &Integer, imaginary: bool) -> String {
        let sign = if imaginary { "-" } else { "" };
        format!("sqrt({sign}{})", decimal(radicand))
    }

    fn function(&self, name: &str, argument: &str) -> String {
        format!("{name}({argument})")
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

    fn times_symbol(&self) -> &'static str {
        "*"
    }

    fn times(&self, _: &Tree, _: &Tree) -> &'static str {
        "*"
    }

    fn enclosed(&self, text: &str) -> String {
        format!("({text})")
    }

    fn brackets(&self, _: &Tree) -> (&'static str, &'static str) {
        ("(", ")")
    }

    fn width(&self, text: &str) -> usize {
        text.chars().count()
    }
}

/// LaTeX for amsmath and KaTeX.
pub(crate) struct Latex;

/// Names that have a command of their own.
const GREEK: [&str; 34] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
    "lambda", "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi",
    "omega", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi",
    "Omega",
];

/// Endings of names that are accents in LaTeX.
const ACCENTS: [&str; 5] = ["tilde", "bar", "hat", "dot", "prime"];

impl Latex {
    /// A name: Greek letters as such, one letter in italics, a word upright, `a_1` as subscript,
    /// `a_tilde` with an accent, `a_prime` with a prime.
    pub fn name(name: &str) -> String {
        let (letter, subscript) = Latex::parts(name);
        subscript.map_or_else(|| letter.clone(), |subscript| format!("{letter}_{{{subscript}}}"))
    }

    /// A name with an index, which joins a subscript that is there already: `f_{1,2}`.
    pub(crate) fn indexed(name: &str, index: &str) -> String {
        let (letter, subscript) = Latex::parts(name);
        let before = subscript.map_or_else(String::new, |subscript| format!("{subscript},"));
        format!("{letter}_{{{before}{index}}}")
    }

    /// The letter with its accent, and the subscript.
    fn parts(name: &str) -> (String, Option<String>) {
        let accented = ACCENTS.iter().find_map(|accent| {
            let base = name.strip_suffix(accent)?.strip_suffix('_')?;
            (!base.is_empty()).then_some((base, accent))
        });
        if let Some((base, accent)) = accented {
            let (letter, subscript) = Latex::parts(base);
            let letter = match *accent {
                "prime" => format!("{letter}'"),
                accent => format!("\\{accent}{{{letter}}}"),
            };
            return (letter, subscript);
        }
        if GREEK.contains(&name) {
            return (format!("\\{name}"), None);
        }
        if let Some((base, subscript)) = name.split_once('_')
            && !base.is_empty()
            && !subscript.is_empty()
        {
            let subscript = match GREEK.contains(&subscript) || subscript.len() == 1 {
                true => Latex::name(subscript),
                false => format!("\\mathrm{{{}}}", subscript.replace('_', "\\_")),
            };
            let (letter, digits) = Latex::parts(base);
            let before = digits.map_or_else(String::new, |digits| format!("{digits},"));
            return (letter, Some(before + &subscript));
        }
        let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
        if letters.len() < name.len() && !letters.is_empty() {
            return (Latex::name(letters), Some(name[letters.len()..].to_owned()));
        }
        match name.chars().count() {
            1 => (name.to_owned(), None),
            _ => (format!("\\mathrm{{{}}}", name.replace('_', "\\_")), None),
        }
    }
}

impl Notation for Latex {
    fn root(&self, radicand: &Integer, imaginary: bool) -> String {
        let root = if radicand.is_one() {
            String::new()
        } else {
            format!("\\sqrt{{{}}}", decimal(radicand))
        };
        let unit = if imaginary { "\\mathrm{i}" } else { "" };
        format!("{unit}{root}")
    }

    fn function(&self, name: &str, argument: &str) -> String {
        format!("\\{name}{}", self.enclosed(argument))
    }

    fn number(&self, value: &Rational) -> String {
        match value.denom().is_one() {
            true => decimal(value.numer()),
            false => format!("\\frac{{{}}}{{{}}}", decimal(value.numer()), decimal(value.denom())),
        }
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        match symbol.square() {
            None => Latex::name(symbol.name()),
            Some(-1) => self.root(&Integer::one(), true),
            Some(square) => self.root(&square.into(), false),
        }
    }

    fn choose<'a>(&self, name: &'a Name) -> &'a str {
        &name.latex
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        // A subscript and an exponent stand over each other only with braces.
        let braces = base.contains("_{") && !base.starts_with('(');
        let base = if braces { format!("{{{base}}}") } else { base.to_owned() };
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

    fn times_symbol(&self) -> &'static str {
        " "
    }

    fn times(&self, left: &Tree, right: &Tree) -> &'static str {
        match (left, right) {
            (Tree::Exponential(..) | Tree::Oscillation(..), Tree::Sum(_) | Tree::Bracket(_)) => "",
            (_, Tree::Sum(_)) => "\\,",
            _ => " ",
        }
    }

    fn enclosed(&self, text: &str) -> String {
        let tall = text.contains("\\frac");
        if tall { format!("\\left({text}\\right)") } else { format!("({text})") }
    }

    fn brackets(&self, of: &Tree) -> (&'static str, &'static str) {
        match of {
            Tree::Bracket(_) if of.is_tall() => ("\\Bigl[", "\\Bigr]"),
            Tree::Bracket(_) => ("\\bigl[", "\\bigr]"),
            of if of.is_tall() => ("\\Bigl(", "\\Bigr)"),
            _ => ("(", ")"),
        }
    }

    /// Commands count as one character, braces and fraction bars as none.
    fn width(&self, text: &str) -> usize {
        if text.bytes().all(|byte| byte.is_ascii_digit()) {
            return text.len();
        }
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
