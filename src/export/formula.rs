//! Formulas with their heads, one a line, as text or LaTeX.

use crate::export::arrangement::arrange;
use crate::export::lines::Writing;
use crate::export::mathml;
use crate::export::names::{Names, latex_name};
use crate::export::notation::Notation::{self, Latex, MathMl, Text};
use crate::export::notation::both;
use crate::export::tree::Term;
use crate::export::writer::{write, write_flat, write_named};
use crate::expression::{Expression, Fraction};
use crate::recurrence::Statement;
use std::sync::Arc;
use wavestep_polynomial::{Rational, Symbol};

pub const TEXT_WIDTH: usize = 100;

/// The width of a line of LaTeX, in characters on the page.
pub const LATEX_WIDTH: usize = 84;

/// The left-hand side of a formula.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Head {
    pub(crate) text: String,
    latex: String,
    /// None where only the other two are given.
    mathml: Option<String>,
}

/// An exact value in one line.
fn flat(value: &Fraction, notation: Notation, names: &Names) -> String {
    write_named(&arrange(&value.into(), None), notation, names).text().to_owned()
}

/// When a formula holds, and its local time since `start`.
fn remark(
    holds: impl Fn(Notation, &str) -> String,
    start: &Fraction,
    [local, time]: [&Symbol; 2],
    names: &Names,
) -> (String, String) {
    both(|n| {
        let start = flat(start, n, names);
        let [local, time] = [local, time].map(|x| flat(&Fraction::symbol(x), n, names));
        let since = since(&time, &start);
        format!("{}{}{local} = {since}", holds(n, &start), n.choose(", ", ",\\ "))
    })
}

/// `t - start`, with brackets around a sum.
pub(super) fn since(t: &str, start: &str) -> String {
    match start {
        "0" => t.to_owned(),
        sum if sum.contains(['+', '-']) => format!("{t} - ({sum})"),
        start => format!("{t} - {start}"),
    }
}

impl Head {
    pub fn new(text: impl Into<String>, latex: impl Into<String>) -> Head {
        Head { text: text.into(), latex: latex.into(), mathml: None }
    }

    pub(crate) fn both(write: impl Fn(Notation) -> String) -> Head {
        let [text, latex, mathml] = Notation::ALL.map(write);
        Head { text, latex, mathml: Some(mathml) }
    }
}

/// The right-hand side of a formula.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Right {
    /// A sum of terms; zero where there are none.
    Terms(Vec<Term>),
    /// A sum of terms, with names for symbols.
    Named(Vec<Term>, Arc<Names>),
    /// Written as it is, in each notation.
    Written([String; 3]),
}

impl Right {
    /// A right-hand side that is written as it is.
    pub fn both(write: impl Fn(Notation) -> String) -> Right {
        Right::Written(Notation::ALL.map(write))
    }

    pub fn written(&self, notation: Notation) -> Writing {
        match self {
            Right::Terms(terms) => write(terms, notation),
            Right::Named(terms, names) => write_named(terms, notation, names),
            Right::Written(written) => {
                let text = &written[notation as usize];
                let mut solid = Writing::default();
                solid.push(text, notation.width(text));
                solid
            }
        }
    }
}

/// One formula: `head = right`, and a remark.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Formula {
    pub(crate) head: Head,
    pub(crate) right: Right,
    /// A remark in text, and in LaTeX, where it may be empty.
    pub remark: Option<(String, String)>,
}

impl Formula {
    /// A wave on one period: `f[3](s) = …`.
    pub fn piece(wave: &str, n: usize, piece: &Expression, local: &Symbol) -> Formula {
        let n = n.to_string();
        let head = Head::both(|form| format!("{}({})", form.indexed(wave, &n), form.symbol(local)));
        Formula::new(head, piece, local)
    }

    /// An echo of a wave: `phi_f[3](s) = …`, or `phi_f[2,1](s) = …` on a lattice of delays, by how
    /// often each period of the lattice has passed.
    pub fn echo(wave: &str, counts: &[usize], echo: &Expression, local: &Symbol) -> Formula {
        let counts = counts.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
        Formula::new(Head::both(|n| n.echo(wave, &counts, &n.symbol(local))), echo, local)
    }

    /// `head = expression`, arranged by `variable`.
    pub fn new(head: Head, expression: &Expression, variable: &Symbol) -> Formula {
        Formula::of(head, Right::Terms(arrange(expression, Some(variable))))
    }

    /// `head = right`, without a remark.
    pub(crate) fn of(head: Head, right: Right) -> Formula {
        Formula { head, right, remark: None }
    }

    /// The formula with the interval on which a piece holds as its remark: with periods that
    /// begin at `o`, `o + nD <= t < o + (n+1)D, s = t - (o + nD)`.
    pub fn on_period(self, n: usize, offset: &Fraction, statement: &Statement) -> Formula {
        self.on_named_period(n, offset, statement, &Names::new())
    }

    /// The same with names for symbols.
    pub(crate) fn on_named_period(
        self,
        n: usize,
        offset: &Fraction,
        statement: &Statement,
        names: &Names,
    ) -> Formula {
        let bound = |n: usize| offset + &statement.period.scale(&Rational::from_integer(n.into()));
        self.between_named(&bound(n), &bound(n + 1), statement, names)
    }

    /// The formula with the interval on which it holds as its remark: `from <= t < to, s = t - from`.
    pub fn between(self, from: &Fraction, to: &Fraction, statement: &Statement) -> Formula {
        self.between_named(from, to, statement, &Names::new())
    }

    fn between_named(
        mut self,
        from: &Fraction,
        to: &Fraction,
        statement: &Statement,
        names: &Names,
    ) -> Formula {
        let Statement { local, time, .. } = statement;
        let holds = |n: Notation, start: &str| {
            let (at_most, t) = (n.choose("<=", "\\le"), flat(&Fraction::symbol(time), n, names));
            format!("{start} {at_most} {t} < {}", flat(to, n, names))
        };
        self.remark = Some(remark(holds, from, [local, time], names));
        self
    }

    /// Plain text in one line, without the remark.
    pub fn to_line(&self) -> String {
        format!("{} = {}", self.head.text, self.right.written(Text).text())
    }

    /// The formula of an echo on a lattice, with its arrival as a remark.
    pub fn of_arrival(
        wave: &str,
        counts: &[usize],
        delay: &Fraction,
        echo: &Expression,
        local: &Symbol,
        time: &Symbol,
    ) -> Formula {
        let holds = |n: Notation, start: &str| {
            format!("{} {} {start}", n.symbol(time), n.choose(">=", "\\ge"))
        };
        let remark = Some(remark(holds, delay, [local, time], &Names::new()));
        Formula { remark, ..Formula::echo(wave, counts, echo, local) }
    }

    /// Plain text in lines of at most `width` characters where it can be broken; continuation lines
    /// and a remark are indented.
    pub fn to_text(&self, width: usize) -> String {
        let head = format!("{} = ", self.head.text);
        let right = self.right.written(Text);
        let lines = right.lines(width, head.chars().count(), 4);
        let mut text = format!("{head}{}\n", lines.join("\n    "));
        if let Some((remark, _)) = &self.remark {
            text.push_str(&format!("    # {remark}\n"));
        }
        text
    }

    /// The formula as a `math` element in lines of at most `width` characters, without the remark.
    pub fn to_mathml(&self, width: usize) -> String {
        let head = self.head.mathml.clone();
        let head = head.unwrap_or_else(|| mathml::element("mtext", &[&self.head.text]));
        let used = MathMl.width(&head) + 3;
        let right = self.right.written(MathMl);
        let mut rows = String::new();
        for (i, line) in right.lines(width, used, used + 2).into_iter().enumerate() {
            let (head, front) = match i {
                0 => (mathml::tokens(&head), "<mo>=</mo>"),
                _ => (String::new(), "<mspace width=\"3em\"/>"),
            };
            let line = mathml::tokens(&format!("{front}{line}"));
            rows += &format!("<mtr><mtd>{head}</mtd><mtd>{line}</mtd></mtr>");
        }
        format!("<math display=\"block\"><mtable displaystyle=\"true\">{rows}</mtable></math>")
    }

    /// Writes the lines of the formula in an `align*` environment, without the environment.
    /// `end` stands before what ends a line within the formula.
    fn write_latex(&self, width: usize, end: &str, out: &mut String) {
        let head = &self.head.latex;
        let used = Latex.width(head) + 3;
        let right = self.right.written(Latex);
        let lines = right.lines(width, used, used + 2);
        for (i, line) in lines.iter().enumerate() {
            match i {
                0 => out.extend([head, " &= ", line]),
                _ => out.extend([end, " \\\\\n&\\quad {}", line]),
            }
        }
        let remark = self.remark.as_ref().filter(|(_, latex)| !latex.is_empty());
        if let (Some((_, remark)), Some(last)) = (remark, lines.last()) {
            let fits = used + 2 + Latex.width(last) + Latex.width(remark) < width;
            match fits {
                true => out.push_str(", \\qquad "),
                false => out.extend([",", end, " \\\\\n&\\qquad "]),
            }
            out.push_str(remark);
        }
    }

    /// The lines of a case: the right-hand side in one cell, the remark in the next.
    fn latex_case(&self, width: usize) -> String {
        let remark = self.remark.as_ref().map_or("", |(_, latex)| latex);
        let right = self.right.written(Latex);
        // The columns stand two quads apart, and the brace takes some room.
        let lines = right.lines(width.saturating_sub(Latex.width(remark) + 6), 0, 2);
        let body = match &lines[..] {
            [line] => format!("{line},"),
            _ => format!(
                "\\begin{{aligned}}[t] &{}, \\end{{aligned}}",
                lines.join(" \\\\ &\\quad {}")
            ),
        };
        format!("{body} & {remark}")
    }
}

/// An expression as plain text in one line, which the language reads back.
pub fn expression_text(expression: &Expression) -> String {
    write_flat(&arrange(expression, None), Text)
}

/// Formulas as plain text, one a line; longer ones go on in further lines.
pub fn text(formulas: &[Formula], width: usize) -> String {
    formulas.iter().map(|formula| formula.to_text(width)).collect()
}

/// Formulas in an `align*` environment; lines of at most `width` characters on the page.
pub fn latex(formulas: &[Formula], width: usize) -> String {
    let mut out = String::from("\\begin{align*}\n");
    for (i, formula) in formulas.iter().enumerate() {
        if i > 0 {
            out.push_str(" \\\\\n");
        }
        formula.write_latex(width, "", &mut out);
    }
    out.push_str("\n\\end{align*}\n");
    out
}

/// Formulas in an `align` environment, each with a number; with labels that are counted where one is given.
pub(crate) fn numbered(formulas: &[Formula], label: Option<&str>, width: usize) -> String {
    let line = |(i, formula): (usize, &Formula)| {
        let mut out = String::new();
        formula.write_latex(width, " \\nonumber", &mut out);
        out + &label.map_or(String::new(), |label| format!(" \\label{{{label}-{}}}", i + 1))
    };
    let lines: Vec<String> = formulas.iter().enumerate().map(line).collect();
    format!("\\begin{{align}}\n{}\n\\end{{align}}\n", lines.join(" \\\\\n"))
}

/// Formulas with remarks as the cases of one function, `name(variable) = …`.
pub fn latex_cases(name: &str, variable: &Symbol, formulas: &[Formula], width: usize) -> String {
    let head = format!("{}({})", latex_name(name, None), Latex.symbol(variable));
    let left = width.saturating_sub(Latex.width(&head) + 3);
    let cases: Vec<String> = formulas.iter().map(|formula| formula.latex_case(left)).collect();
    let cases = cases.join(" \\\\\n");
    format!(
        "\\begin{{align*}}\n{head} &= \\begin{{cases}}\n{cases}\n\\end{{cases}}\n\\end{{align*}}\n"
    )
}
