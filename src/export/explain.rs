//! The derivation of a scene's recurrence as a text to be read: sentences and equations.

use crate::export::arrangement::arrange;
use crate::export::forms::Writer;
use crate::export::formula::{Formula, Head, Right, latex, text};
use crate::export::mathml::element;
use crate::export::notation::{Notation, both};
use crate::export::prose::{capitalised, wrapped};
use crate::export::tree::{Sign, Term};
use crate::export::writer::write_flat;
use crate::expression::{Constant, Definition, Expression, Fraction, Root};
use crate::network::{Law, Network, Role, Rule};
use crate::recurrence::Recurrence;
use crate::scene::ElementIndex;
use wavestep_polynomial::Symbol;

/// A part of a derivation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Block {
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

    /// Its parts in their order.
    pub fn parts(&self) -> &[Block] {
        &self.parts
    }

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
                Block::Sentence(text, _) => out.push_str(&wrapped(text, width, "")),
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

fn sum(parts: &[Expression]) -> Vec<Term> {
    parts.iter().flat_map(|part| arrange(part, None)).collect()
}

fn negated(part: &Expression) -> Vec<Term> {
    let flip = |(sign, tree): Term| (sign.times(Sign::Minus), tree);
    arrange(part, None).into_iter().map(flip).collect()
}

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

fn polynomial_in_x(coefficients: &[Fraction]) -> Vec<Term> {
    let x = Fraction::symbol(&Symbol::new("x").expect("a name"));
    flat(&coefficients.iter().fold(Fraction::zero(), |sum, c| &(&sum * &x) + c), "x")
}

fn definition(value: &Definition) -> Right {
    match value {
        Definition::Root(value) => root(value),
        Definition::ComplexZero { polynomial, imaginary, .. } => {
            let part = if *imaginary { "imaginary" } else { "real" };
            let (text, latex) = both(|n| write_flat(&polynomial_in_x(polynomial), n));
            let plain = format!("the {part} part of an x with {text} = 0");
            let latex = format!("\\text{{the {part} part of an }} x \\text{{ with }} {latex} = 0");
            Right::Written([plain.clone(), latex, element("mtext", &[&plain])])
        }
        Definition::Zero { polynomial, between: [lower, upper] } => {
            let (text, latex) = both(|n| write_flat(&polynomial_in_x(polynomial), n));
            let plain = format!("the x between {lower} and {upper} with {text} = 0");
            let latex = format!("x \\in ({lower}, {upper}),\\ {latex} = 0");
            Right::Written([plain.clone(), latex, element("mtext", &[&plain])])
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
            (Notation::Latex | Notation::MathMl, false) => front,
        };
        front + &n.root_of(&under)
    })
}

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
