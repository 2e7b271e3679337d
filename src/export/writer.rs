//! One walk over an arranged formula.

use crate::export::lines::Writing;
use crate::export::names::Names;
use crate::export::notation::Notation;
use crate::export::tree::{Monomial, Sign, Term, Tree};
use num_traits::One;
use std::collections::BTreeMap;
use wavestep_polynomial::{Rational, Symbol};

/// A sum of terms as it is written; zero where there are none.
pub(crate) fn write(terms: &[Term], notation: Notation) -> Writing {
    write_named(terms, notation, &Names::new())
}

/// A sum of terms as it is written, with names for symbols.
pub(crate) fn write_named(terms: &[Term], notation: Notation, names: &Names) -> Writing {
    let mut writer = Writer::new(notation, names);
    if terms.is_empty() {
        writer.push(&notation.number(&Rational::default()));
    }
    writer.sum(terms, 0);
    writer.writing
}

/// The writing of a sum of terms without line breaks.
pub(crate) fn write_flat(terms: &[Term], notation: Notation) -> String {
    write(terms, notation).text().to_owned()
}

/// Whether other factors stand beside one.
#[derive(Clone, Copy)]
struct Beside {
    before: bool,
    after: bool,
}

struct Writer<'a> {
    notation: Notation,
    names: &'a Names,
    writing: Writing,
    /// Powers of symbols as they are written, with their widths.
    powers: BTreeMap<Symbol, Vec<Option<(String, usize)>>>,
}

impl<'a> Writer<'a> {
    fn new(notation: Notation, names: &'a Names) -> Writer<'a> {
        Writer { notation, names, writing: Writing::default(), powers: BTreeMap::new() }
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        match self.names.get(symbol) {
            Some(name) => name.written(self.notation).to_owned(),
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
            let beside = Beside { before: i > 0, after: i + 1 < factors.len() };
            match factor {
                Tree::Sum(terms) | Tree::Bracket(terms) => {
                    let (open, close) = self.notation.brackets(factor);
                    self.push(open);
                    self.sum(terms, depth + 1);
                    self.push(close);
                }
                Tree::Monomial(monomial) => self.monomial(monomial, beside),
                Tree::Symbol(symbol) => self.power(symbol, 1, beside),
                other => {
                    let text = self.flat(other);
                    self.push(&text);
                }
            }
        }
    }

    /// A number and powers.
    fn monomial(&mut self, monomial: &Monomial, Beside { mut before, after }: Beside) {
        let has_number = !monomial.coefficient.is_one();
        if has_number {
            self.push(&self.notation.number(&monomial.coefficient));
            before = true;
        }
        let mut powers = monomial.powers().peekable();
        let mut separated = !has_number;
        while let Some((symbol, exponent)) = powers.next() {
            if !separated {
                self.push(self.notation.times_symbol());
            }
            separated = false;
            let after = after || powers.peek().is_some();
            self.power(symbol, exponent, Beside { before, after });
            before = true;
        }
    }

    /// A power of a symbol. A compound name is bracketed where a factor follows, and after a factor
    /// where it begins with a number or a sign.
    fn power(&mut self, symbol: &Symbol, exponent: u32, beside: Beside) {
        let n = self.notation;
        if let Some(name) = self.names.get(symbol).filter(|name| name.compound && exponent == 1) {
            let brackets = beside.after || (name.leads && beside.before);
            let text = name.written(n);
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

    fn flat(&self, tree: &Tree) -> String {
        let n = self.notation;
        match tree {
            Tree::Number(value) => n.number(value),
            Tree::Symbol(symbol) => self.symbol(symbol),
            Tree::Root(radicand, imaginary) => n.root(radicand, *imaginary),
            Tree::Oscillation(wave, angle) => n.function(wave.name(), &self.flat(angle)),
            Tree::Function(name, argument) => n.function(name, &self.flat(argument)),
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
            Tree::Laguerre(name, index, argument) => {
                n.laguerre(name, "", &self.flat(index), &self.flat(argument))
            }
            Tree::Factorial(of) => {
                let text = self.flat(of);
                match **of {
                    Tree::Symbol(_) | Tree::Number(_) => format!("{text}!"),
                    _ => format!("({text})!"),
                }
            }
        }
    }
}
