//! The derivation of a scene's recurrence as a text to be read: sentences and equations.

use crate::export::arrangement::arrange;
use crate::export::formula::{Formula, Head, Right, latex, text};
use crate::export::names::{self, Name, Names};
use crate::export::notation::{Notation, both};
use crate::export::tree::{Sign, Term};
use crate::export::writer::write_flat;
use crate::expression::{Constant, Definition, Expression, Fraction, Root};
use crate::network::{Law, Network, Role, Rule};
use crate::recurrence::{LinearForm, Recurrence, Statement};
use crate::scene::ElementIndex;
use std::sync::Arc;
use wavestep_polynomial::{Rational, Symbol};

/// A part of a derivation.
#[derive(Clone, PartialEq, Eq, Debug)]
enum Block {
    Heading(&'static str),
    /// In text, and in LaTeX.
    Sentence(String, String),
    Equations(Vec<Formula>),
}

/// How a scene becomes a recurrence: its waves, the laws at its nodes, its scales, the recurrence.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Derivation {
    parts: Vec<Block>,
}

/// Writes forms in waves with their index on the n-th period.
struct Writer<'a> {
    recurrence: &'a Recurrence,
    names: Arc<Names>,
}

impl Derivation {
    /// The derivation of a scene on one grid. `decimal` gives constants as numbers, where it can.
    pub fn of(
        network: &Network,
        recurrence: &Recurrence,
        decimal: &dyn Fn(&Definition) -> Option<String>,
    ) -> Derivation {
        let writer = Writer::new(recurrence);
        let mut derivation = Derivation { parts: Vec::new() };
        derivation.scales(network, recurrence.constants(), decimal);
        derivation.waves(network);
        derivation.laws(network, &writer);
        derivation.recurrence(network, &writer);
        derivation
    }

    /// Adds formulas under a heading.
    pub fn add(&mut self, heading: &'static str, formulas: Vec<Formula>) {
        self.parts.push(Block::Heading(heading));
        self.parts.push(Block::Equations(formulas));
    }

    fn sentence(&mut self, sentence: impl AsRef<str>) {
        self.sentence_with(sentence.as_ref(), None);
    }

    /// A sentence, with a value in place of `{}`.
    fn sentence_with(&mut self, sentence: &str, value: Option<&Fraction>) {
        let terms = value.map(|value| arrange(&value.clone().into(), None)).unwrap_or_default();
        let (text, latex) = both(|n| write_flat(&terms, n));
        let text = sentence.replace("{}", &text);
        let latex = prose(sentence).replace("{}", &format!("${latex}$"));
        self.parts.push(Block::Sentence(text, latex));
    }

    /// In which units the scene is written, and the constants that got names.
    fn scales(
        &mut self,
        network: &Network,
        constants: &[Constant],
        decimal: &dyn Fn(&Definition) -> Option<String>,
    ) {
        let (scene, model) = (network.scene(), network.model());
        let name = |element: Option<ElementIndex>| {
            element.map_or("the scene", |element| &scene.elements[element].name)
        };
        if scene.dimensional {
            self.parts.push(Block::Heading("Scales"));
            let (of, moving) = (name(model.scale.reference), name(model.scale.moving));
            let mut units = vec![("Z", "kg/s", &model.scale.impedance, "impedance", of)];
            units.push(("T", "s", &model.scale.time, "time", of));
            units.push(("V", "m/s", &model.scale.velocity, "velocity", moving));
            for (symbol, unit, value, what, of) in units {
                let number = decimal(&value.clone().into());
                let number = number.map_or(String::new(), |n| format!(" = {n} {unit}"));
                self.sentence(format!("The unit of {what} is {symbol}{number}, from `{of}`."));
            }
            self.sentence("Forces are in Z V, displacements in V T.");
        }
        if !constants.is_empty() {
            let constants = constants.iter().map(|constant| {
                let head = Head::both(|n| n.symbol(&constant.symbol));
                let right = definition(&constant.value);
                let number = decimal(&constant.value).map(|number| format!("= {number}"));
                let remark = number.map(|number| (number.clone(), String::new()));
                Formula { head, right, remark }
            });
            let constants = constants.collect();
            self.sentence("In these units, what is no rational number has a name:");
            self.parts.push(Block::Equations(constants));
        }
    }

    /// The waves in each bar, and what else is followed.
    fn waves(&mut self, network: &Network) {
        self.parts.push(Block::Heading("Waves"));
        let scene = network.scene();
        let wave = |role: Role| network.waves().iter().find(|wave| wave.role == role);
        for element in &scene.line.elements {
            let Some(data) = network.model().bars.get(element) else { continue };
            let (right, left) = (wave(Role::Right(*element)), wave(Role::Left(*element)));
            let symbol = |name: &str| Symbol::new(name).expect("names of waves are names");
            let term = |wave: Option<&crate::network::WaveRole>| {
                let value = wave.map(|wave| Expression::symbol(&symbol(&wave.name)));
                value.unwrap_or_else(Expression::zero)
            };
            let (f, g) = (term(right), term(left));
            let impedance = Expression::from(data.impedance.clone());
            let velocity = sum(&[data.velocity.clone().into(), f.clone(), g.clone()]);
            let mut force = sum(&[data.force.clone().into(), &f * &impedance]);
            force.extend(negated(&(&g * &impedance)));
            let name = &scene.elements[*element].name;
            let way = match &data.travel {
                None => "goes on for ever, and nothing returns from there",
                Some(_) => "is passed in {}",
            };
            self.sentence_with(
                &format!("The bar `{name}` {way}. Its velocity v and compressive force X are"),
                data.travel.as_ref(),
            );
            let equation = |head: &str, terms: Vec<Term>| {
                Formula::of(Head::both(|_| head.to_owned()), Right::Terms(terms))
            };
            let equations = vec![equation("v", velocity), equation("X", force)];
            self.parts.push(Block::Equations(equations));
        }
        for wave in network.waves() {
            let (name, what) = match wave.role {
                Role::Compression(e) => (e, "the compression of the spring"),
                Role::Displacement(e) => (e, "the displacement of the support"),
                Role::Velocity(..) => {
                    self.sentence(format!("{} is a velocity that no bar tells.", wave.name));
                    continue;
                }
                _ => continue,
            };
            let name = &scene.elements[name].name;
            self.sentence(format!("{} is {what} `{name}`.", wave.name));
        }
    }

    /// The laws at the nodes.
    fn laws(&mut self, network: &Network, writer: &Writer<'_>) {
        self.parts.push(Block::Heading("Laws at ends and joints"));
        self.sentence_with(
            "A period lasts D = {}. On the n-th, from n D to (n+1) D by the clock of each place, the laws are, \
             with waves that are zero for n < 0:",
            Some(&writer.recurrence.statement().period),
        );
        for law in network.laws() {
            if matches!(law.rule, Rule::Integral(_)) {
                continue;
            }
            self.sentence(told(network, &law));
            self.parts.push(Block::Equations(vec![writer.equation(&law.left, &law.right)]));
        }
    }

    /// The recurrence, solved for one wave after another.
    fn recurrence(&mut self, network: &Network, writer: &Writer<'_>) {
        self.parts.push(Block::Heading("The recurrence"));
        self.sentence("Solved for one wave after another:");
        let (equations, starts) = writer.solved(network.waves().len());
        self.parts.push(Block::Equations(equations));
        if !starts.is_empty() {
            self.sentence("These are continuous from period to period, and start at");
            self.parts.push(Block::Equations(starts));
        }
    }

    pub fn to_text(&self, width: usize) -> String {
        let mut out = String::new();
        for part in &self.parts {
            match part {
                Block::Heading(heading) => {
                    let gap = if out.is_empty() { "" } else { "\n" };
                    let line = "-".repeat(heading.len());
                    out.push_str(&format!("{gap}{heading}\n{line}\n"));
                }
                Block::Sentence(text, _) => out.push_str(&wrapped(text, width)),
                Block::Equations(formulas) => {
                    let lines = text(formulas, width.saturating_sub(4));
                    lines.lines().for_each(|line| out.push_str(&format!("    {line}\n")));
                }
            }
        }
        out
    }

    /// LaTeX: sections, sentences and `align*` environments.
    pub fn to_latex(&self, width: usize) -> String {
        let mut out = String::new();
        for part in &self.parts {
            match part {
                Block::Heading(heading) => out.push_str(&format!("\\subsection*{{{heading}}}\n")),
                Block::Sentence(_, latex) => out.push_str(&format!("{latex}\n")),
                Block::Equations(formulas) => out.push_str(&latex(formulas, width)),
            }
        }
        out
    }
}

/// The equations of a recurrence, solved for one wave after another, waves that are given by others
/// put in; then what is continuous from period to period, with the value at which it starts.
#[must_use]
pub fn solved_equations(recurrence: &Recurrence) -> (Vec<Formula>, Vec<Formula>) {
    Writer::new(recurrence).solved(recurrence.statement().waves.len())
}

/// A linear form in the waves of a recurrence on the n-th period, as text; sums over earlier periods are
/// left out.
#[must_use]
pub fn form_text(recurrence: &Recurrence, form: &LinearForm) -> String {
    match Writer::new(recurrence).written(form) {
        Head::Written(text, _) => text,
        _ => String::new(),
    }
}

/// A name as LaTeX: Greek letters as such, one letter in italics, a word upright, `a_1` with a
/// subscript, `a_tilde` with an accent; with an index beside the subscript where one is given.
#[must_use]
pub fn latex_name(name: &str, index: Option<&str>) -> String {
    index.map_or_else(|| names::latex_name(name), |index| names::latex_indexed(name, index))
}

impl<'a> Writer<'a> {
    fn new(recurrence: &'a Recurrence) -> Writer<'a> {
        let mut names = Names::new();
        let forms = recurrence.steps().iter().flat_map(|step| {
            let continuous = step.start.as_ref().map(|start| &start.continuous);
            std::iter::once(&step.equation).chain(continuous)
        });
        let statement = recurrence.statement();
        let stated = statement.equations.iter();
        let lags = forms.chain(stated).flat_map(|form| form.operators());
        let most = lags.map(|(_, operator)| operator.value().len().max(operator.slope().len()));
        let forced = |form: &LinearForm| form.forcing_terms().len();
        let loads = statement.equations.iter().map(forced).max().unwrap_or(0);
        let most = most.max().unwrap_or(0).max(loads) + 1;
        for wave in 0..recurrence.wave_count() {
            for lag in 0..=most {
                for slope in [false, true] {
                    let name = recurrence.wave_name(wave);
                    let index = if lag == 0 { "n".to_owned() } else { format!("n-{lag}") };
                    let prime = if slope { "'" } else { "" };
                    let written = both(|n| format!("{}{prime}", n.indexed(&name, &index)));
                    names.insert(stand_in(wave, lag, slope), Name::plain(written));
                }
            }
        }
        for lag in 1..=most {
            let written = both(|n| format!("[n{}{lag}]", n.choose(">=", " \\ge ")));
            names.insert(from_period(lag), Name::plain(written));
        }
        Writer { recurrence, names: Arc::new(names) }
    }

    /// A form as terms, slopes first and newest first.
    fn terms(&self, form: &LinearForm) -> Vec<Term> {
        let mut terms = Vec::new();
        for slope in [true, false] {
            let reach = form.operators().map(|(_, o)| o.value().len().max(o.slope().len()));
            for lag in 0..reach.max().unwrap_or(0) {
                for (wave, operator) in form.operators() {
                    let row = if slope { operator.slope() } else { operator.value() };
                    let Some(factor) = row.get(lag).filter(|factor| !factor.is_zero()) else {
                        continue;
                    };
                    let symbol = Expression::symbol(&stand_in(wave, lag, slope));
                    terms.extend(arrange(&(&symbol * factor), None));
                }
            }
        }
        for (lag, function) in form.forcing_terms().iter().enumerate() {
            if function.is_zero() {
                continue;
            }
            let Statement { time, period, .. } = self.recurrence.statement();
            let late = period.scale(&Rational::from_integer(lag.into()));
            let function = function.substitute(time, &(&Fraction::symbol(time) - &late));
            let function = function.expect("no denominator of a load holds the time");
            let function = match lag {
                0 => function,
                _ => &function * &Expression::symbol(&from_period(lag)),
            };
            terms.extend(arrange(&function, Some(time)));
        }
        terms
    }

    /// The recurrence solved for one wave after another, and what is continuous with its start, of
    /// the first `shown` waves and those that were added to uncouple them.
    fn solved(&self, shown: usize) -> (Vec<Formula>, Vec<Formula>) {
        let mut equations = Vec::new();
        let mut starts = Vec::new();
        let mut explicit: Vec<(usize, LinearForm)> = Vec::new();
        let time = &self.recurrence.statement().time;
        for step in self.recurrence.steps() {
            let added = step.wave >= self.recurrence.statement().waves.len();
            if step.wave >= shown && !added {
                continue;
            }
            // Waves that are given by others are put in.
            let mut equation = step.equation.clone();
            for (wave, solved) in explicit.iter().rev() {
                let mut put_in = equation.clone();
                if put_in.replace(*wave, solved, time) {
                    equation = put_in;
                }
            }
            let (mut left, mut right) = (LinearForm::zero(), -&equation);
            let own = match &step.start {
                None => vec![(LinearForm::wave(step.wave, 0), Expression::one())],
                Some(start) => vec![
                    (LinearForm::slope(step.wave, 0), Expression::one()),
                    (LinearForm::wave(step.wave, 0), start.rate.clone().into()),
                ],
            };
            for (form, factor) in own {
                left.add_scaled(&form, &factor, 0);
                right.add_scaled(&form, &factor, 0);
            }
            if step.start.is_none() && !right.operators().any(|(wave, _)| wave == step.wave) {
                explicit.push((step.wave, right.clone()));
            }
            equations.push(self.equation(&left, &right));
            if let Some(start) = &step.start {
                let head = self.written(&start.continuous);
                let right = Right::Terms(arrange(&start.initial, None));
                starts.push(Formula::of(head, right));
            }
        }
        (equations, starts)
    }

    fn equation(&self, left: &LinearForm, right: &LinearForm) -> Formula {
        let right = Right::Named(self.terms(right), self.names.clone());
        Formula::of(self.written(left), right)
    }

    /// A form as the left side of an equation.
    fn written(&self, form: &LinearForm) -> Head {
        let whole = Right::Named(self.terms(form), self.names.clone());
        Head::both(|n| whole.written(n).text().to_owned())
    }
}

/// A sentence in lines of at most `width` characters.
fn wrapped(sentence: &str, width: usize) -> String {
    let (mut out, mut used) = (String::new(), 0);
    for word in sentence.split(' ') {
        let length = word.chars().count();
        if used > 0 && used + 1 + length > width {
            out.push('\n');
            used = 0;
        } else if used > 0 {
            out.push(' ');
            used += 1;
        }
        out.push_str(word);
        used += length;
    }
    out.push('\n');
    out
}

/// A symbol in place of a wave at a lag, or of its slope.
fn stand_in(wave: usize, lag: usize, slope: bool) -> Symbol {
    let name = format!("wave_{wave}_{lag}_{}", u8::from(slope));
    Symbol::new(&name).expect("a name with letters in front")
}

/// A symbol for a step: 1 from a period on, and 0 before.
fn from_period(lag: usize) -> Symbol {
    Symbol::new(&format!("from_{lag}")).expect("a name with letters in front")
}

fn sum(parts: &[Expression]) -> Vec<Term> {
    parts.iter().flat_map(|part| arrange(part, None)).collect()
}

fn negated(part: &Expression) -> Vec<Term> {
    let flip = |(sign, tree): Term| (sign.times(Sign::Minus), tree);
    arrange(part, None).into_iter().map(flip).collect()
}

/// A law in a sentence.
fn told(network: &Network, law: &Law) -> String {
    let scene = network.scene();
    let name = |element: &ElementIndex| format!("`{}`", scene.elements[*element].name);
    let place = law.node.map_or(String::new(), |node| network.place_in_words(node));
    let place = capitalised(&place);
    match &law.rule {
        Rule::Velocity => format!("{place}, what is joined moves together:"),
        Rule::Force => format!("{place}, the forces on both sides are equal:"),
        Rule::FreeEnd => format!("{place}, nothing presses on the free end:"),
        Rule::FixedEnd => format!("{place}, the end does not move:"),
        Rule::Balance(elements) => {
            let names: Vec<String> = elements.iter().map(name).collect();
            format!("{place}, {} balances the forces:", names.join(" and "))
        }
        Rule::Spring(spring) => format!("{place}, {} carries the force:", name(spring)),
        Rule::Shortening(spring) => {
            format!("{place}, {} is shortened as its ends approach:", name(spring))
        }
        Rule::Displacement(support) => format!("{place}, {} moves with the line:", name(support)),
        Rule::Imposed(load) => format!("{place}, {} imposes its velocity:", name(load)),
        Rule::Integral(_) => String::new(),
    }
}

/// A value, arranged by a variable.
fn flat(value: &Fraction, variable: &str) -> Vec<Term> {
    let variable = Symbol::new(variable).expect("a name");
    arrange(&value.clone().into(), Some(&variable))
}

/// The terms of a polynomial in x.
fn polynomial_in_x(coefficients: &[Fraction]) -> Vec<Term> {
    let x = Fraction::symbol(&Symbol::new("x").expect("a name"));
    flat(&coefficients.iter().fold(Fraction::zero(), |sum, c| &(&sum * &x) + c), "x")
}

/// A text that begins with a capital letter.
fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

/// A definition as a right side.
fn definition(value: &Definition) -> Right {
    match value {
        Definition::Root(value) => root(value),
        Definition::ComplexZero { polynomial, imaginary, .. } => {
            let part = if *imaginary { "imaginary" } else { "real" };
            let (text, latex) = both(|n| write_flat(&polynomial_in_x(polynomial), n));
            Right::Written(
                format!("the {part} part of an x with {text} = 0"),
                format!("\\text{{the {part} part of an }} x \\text{{ with }} {latex} = 0"),
            )
        }
        Definition::Zero { polynomial, between: (lower, upper) } => {
            let (text, latex) = both(|n| write_flat(&polynomial_in_x(polynomial), n));
            Right::Written(
                format!("the x between {lower} and {upper} with {text} = 0"),
                format!("x \\in ({lower}, {upper}),\\ {latex} = 0"),
            )
        }
    }
}

/// A factor and a root as the right side of a definition.
fn root(value: &Root) -> Right {
    let [factor, under] = [value.factor(), value.radicand()].map(|part| flat(part, "pi"));
    Right::both(|n| {
        let (front, under) = (write_flat(&factor, n), write_flat(&under, n));
        if value.radicand().is_one() {
            return front;
        }
        let front = match (n, value.factor().is_one()) {
            (_, true) => String::new(),
            (Notation::Text, false) => format!("({front})*"),
            (Notation::Latex, false) => front,
        };
        match n {
            Notation::Text => format!("{front}sqrt({under})"),
            Notation::Latex => format!("{front}\\sqrt{{{under}}}"),
        }
    })
}

/// A sentence in LaTeX.
fn prose(sentence: &str) -> String {
    let mut out = String::new();
    let mut quoted = false;
    for character in sentence.chars() {
        match character {
            '`' => {
                out.push_str(if quoted { "}" } else { "\\texttt{" });
                quoted = !quoted;
            }
            '_' => out.push_str("\\_"),
            '<' => out.push_str("$<$"),
            '^' => out.push_str("\\^{}"),
            other => out.push(other),
        }
    }
    out.replace("$<$=", "$\\le$")
}
