//! The derivation of a scene's recurrence as a text to be read: sentences and equations.

use crate::export::arrangement::arrange;
use crate::export::forms::{Told, Writer};
use crate::export::formula::{Formula, Head, Right, numbered, text};
use crate::export::general::free_name;
use crate::export::mathml::{self, element};
use crate::export::notation::{Notation, both};
use crate::export::prose::{capitalised, wrapped};
use crate::export::tree::{Sign, Term};
use crate::export::writer::write_flat;
use crate::expression::{Constant, Definition, Expression, Fraction, Root};
use crate::network::{Law, Network, Role, Rule};
use crate::recurrence::{LinearForm, Recurrence, Statement};
use crate::scene::ElementIndex;
use wavestep_polynomial::Symbol;

/// The label of the equations of a recurrence in LaTeX.
pub(super) const RECURRENCE: &str = "recurrence";

/// What introduces the definitions of constants.
const NAMED: &str = "Numbers that are not rational have names:";

/// A part of a derivation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Block {
    /// The question of an exercise, or the answer.
    Part(&'static str),
    Heading(&'static str),
    /// A text of the language as it stands.
    Text(String),
    /// An empty line: a new paragraph.
    Gap,
    /// In text, in LaTeX, and as markup of a page.
    Sentence([String; 3]),
    /// With a label in LaTeX, where they are referred to.
    Equations(Vec<Formula>, Option<&'static str>),
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
        derivation.scales(network, decimal);
        derivation.waves(network);
        derivation.laws(network, &writer);
        derivation.heading("The recurrence");
        let known = &network.model().constants;
        let rates = recurrence.constants().iter().filter(|constant| !known.contains(constant));
        derivation.constants(&rates.cloned().collect::<Vec<_>>(), decimal);
        derivation.solved(&writer, network.waves().len());
        derivation
    }

    /// The derivation of what a stated recurrence leads to.
    pub fn of_recurrence(
        recurrence: &Recurrence,
        decimal: &dyn Fn(&Definition) -> Option<String>,
    ) -> Derivation {
        let mut derivation = Derivation { parts: Vec::new() };
        let Statement { waves, equations, .. } = recurrence.statement();
        derivation.heading("The recurrence");
        derivation.periods(recurrence);
        derivation.sentence("Waves are zero for $n < 0$.");
        let sums = |form: &LinearForm| *form != form.without_sums();
        if equations.iter().any(sums) {
            derivation.sentence(
                "Sums over earlier periods cancel when the equation of the period before is subtracted.",
            );
        }
        derivation.constants(recurrence.constants(), decimal);
        derivation.solved(&Writer::new(recurrence), waves.len());
        derivation
    }

    /// Its parts in their order.
    pub fn parts(&self) -> &[Block] {
        &self.parts
    }

    /// The answer to an exercise, after its question: a text, with what is asked of it.
    #[must_use]
    pub fn as_exercise(mut self, text: &str, asked: impl Fn(Notation) -> String) -> Derivation {
        let answer = std::mem::take(&mut self.parts);
        self.parts.extend([Block::Part("Question"), Block::Text(text.trim_end().to_owned())]);
        self.tell(asked);
        self.parts.push(Block::Part("Answer"));
        self.parts.extend(answer);
        self
    }

    pub(super) fn heading(&mut self, heading: &'static str) {
        self.parts.push(Block::Heading(heading));
    }

    /// A new paragraph.
    pub(super) fn gap(&mut self) {
        if !matches!(self.parts.last(), Some(Block::Heading(_))) {
            self.parts.push(Block::Gap);
        }
    }

    pub(super) fn equations(&mut self, formulas: Vec<Formula>) {
        self.parts.push(Block::Equations(formulas, None));
    }

    /// Equations after a sentence, or with those that already stand there after the same.
    pub(super) fn after(&mut self, sentence: &str, formulas: Vec<Formula>) {
        match &mut self.parts[..] {
            [.., Block::Sentence([told, ..]), Block::Equations(known, _)] if told == sentence => {
                known.extend(formulas);
            }
            _ => {
                self.sentence(sentence);
                self.equations(formulas);
            }
        }
    }

    /// A sentence written in all notations, formulas between dollars.
    pub(super) fn tell(&mut self, write: impl Fn(Notation) -> String) {
        let [text, latex, markup] = Notation::ALL.map(write);
        let text = text.replace('$', "");
        self.parts.push(Block::Sentence([text, prose(&latex), mathml::sentence(&markup)]));
    }

    pub(super) fn sentence(&mut self, sentence: impl AsRef<str>) {
        self.tell(|_| sentence.as_ref().to_owned());
    }

    /// A sentence, with a value in place of `{}`.
    fn sentence_with(&mut self, sentence: &str, value: Option<&Fraction>) {
        let terms = value.map(|value| arrange(&value.clone().into(), None)).unwrap_or_default();
        self.tell(|n| sentence.replace("{}", &format!("${}$", write_flat(&terms, n))));
    }

    /// In which units the scene is written, and the constants that got names.
    fn scales(&mut self, network: &Network, decimal: &dyn Fn(&Definition) -> Option<String>) {
        let (scene, model) = (network.scene(), network.model());
        let constants = &*model.constants;
        let name = |element: Option<ElementIndex>| {
            element.map_or("the scene", |element| &scene.elements[element].name)
        };
        if scene.dimensional {
            self.heading("Scales");
            let (of, moving) = (name(model.scale.reference), name(model.scale.moving));
            let mut units = vec![("Z", "kg/s", &model.scale.impedance, "impedance", of)];
            units.push(("T", "s", &model.scale.time, "time", of));
            units.push(("V", "m/s", &model.scale.velocity, "velocity", moving));
            for (symbol, unit, value, what, of) in units {
                let number = decimal(&value.clone().into());
                let number = number.map_or(String::new(), |n| format!(" $= {n}$ {unit}"));
                self.sentence(format!("The unit of {what} is ${symbol}${number}, from `{of}`."));
            }
            self.sentence("Forces are in $Z V$, displacements in $V T$.");
        }
        self.constants(constants, decimal);
    }

    /// The definitions of constants that got names.
    fn constants(&mut self, all: &[Constant], decimal: &dyn Fn(&Definition) -> Option<String>) {
        if all.is_empty() {
            return;
        }
        let formula = |constant: &Constant| {
            let head = Head::both(|n| n.symbol(&constant.symbol));
            let number = decimal(&constant.value);
            let remark = number.map(|number| (format!("= {number}"), format!("\\approx {number}")));
            Formula { remark, ..Formula::of(head, definition(&constant.value)) }
        };
        self.sentence(NAMED);
        self.equations(all.iter().map(formula).collect());
    }

    /// Leaves out constants that stand nowhere but in their own definition.
    pub fn drop_unused_constants(&mut self) {
        let text = self.to_text(usize::MAX);
        let words = || text.split(|c: char| !c.is_alphanumeric() && c != '_');
        let is_used =
            |formula: &Formula| words().filter(|word| *word == formula.head.text).count() > 1;
        let mut at = 0;
        while at + 1 < self.parts.len() {
            if let [Block::Sentence([told, ..]), Block::Equations(formulas, _), ..] =
                &mut self.parts[at..]
                && told == NAMED
            {
                formulas.retain(is_used);
                if formulas.is_empty() {
                    self.parts.drain(at..at + 2);
                    continue;
                }
            }
            at += 1;
        }
    }

    /// The waves in each bar, and what else is followed.
    fn waves(&mut self, network: &Network) {
        self.heading("Waves");
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
                None => "The bar `{name}` has no end from which waves return.",
                Some(_) => "A wave crosses the bar `{name}` in {}{unit}.",
            };
            let unit = if scene.dimensional { " $T$" } else { "" };
            let way = way.replace("{name}", name).replace("{unit}", unit);
            self.sentence_with(&way, data.travel.as_ref());
            self.sentence("Its velocity $v$ and compressive force $X$ are");
            let equation = |head: &str, terms: Vec<Term>| {
                Formula::of(Head::both(|_| head.to_owned()), Right::Terms(terms))
            };
            let equations = vec![equation("v", velocity), equation("X", force)];
            self.equations(equations);
        }
        for wave in network.waves() {
            let (name, what) = match wave.role {
                Role::Compression(e) => (e, "the compression of the spring"),
                Role::Displacement(e) => (e, "the displacement of the support"),
                Role::Velocity(..) => {
                    self.tell(|n| {
                        format!(
                            "${}$ is the velocity of a part that touches no bar.",
                            n.name(&wave.name)
                        )
                    });
                    continue;
                }
                _ => continue,
            };
            let name = &scene.elements[name].name;
            self.tell(|n| format!("${}$ is {what} `{name}`.", n.name(&wave.name)));
        }
    }

    fn laws(&mut self, network: &Network, writer: &Writer<'_>) {
        self.heading("Laws at ends and joints");
        self.periods(writer.recurrence);
        self.sentence("Time is by the clock of each place, and waves are zero for $n < 0$.");
        for law in network.laws() {
            if matches!(law.rule, Rule::Integral(_)) {
                continue;
            }
            self.sentence(told(network, &law));
            self.equations(vec![writer.equation(&law.left, &law.right)]);
        }
    }

    /// What a period is.
    fn periods(&mut self, recurrence: &Recurrence) {
        let Statement { period, local, time, .. } = recurrence.statement();
        let (lasts, d) = (arrange(&period.into(), None), free_name(recurrence, &["D", "P"]));
        self.tell(|n| {
            let [s, t, d] = [local, time, &d].map(|symbol| n.symbol(symbol));
            format!(
                "Period $n$ lasts from ${t} = n {d}$ to ${t} = (n+1) {d}$ with ${d} = {}$; its local time is \
                 ${s} = {t} - n {d}$.",
                write_flat(&lasts, n)
            )
        });
    }

    /// The recurrence, solved for one wave after another.
    fn solved(&mut self, writer: &Writer<'_>, shown: usize) {
        let recurrence = writer.recurrence;
        let told = |wave| Told::of(recurrence, wave, shown);
        let together: Vec<usize> = (0..shown).filter(|wave| told(*wave) == Told::Result).collect();
        let (equations, mut starts) = writer.solved(|wave| told(wave) == Told::Steps);
        if !equations.is_empty() {
            self.sentence("Solved for one wave after another:");
            self.parts.push(Block::Equations(equations, Some(RECURRENCE)));
        }
        if !recurrence.coupled().is_empty() && together.is_empty() {
            self.sentence(
                "Modes are combinations of waves in which derivatives are no longer coupled.",
            );
        }
        if recurrence.steps().iter().any(|step| step.equation.forcing_terms().reach() > 1) {
            self.tell(|n| {
                format!("$[n {} m]$ is 1 from period $m$ on, and 0 before.", n.choose(">=", "\\ge"))
            });
        }
        if !together.is_empty() {
            self.tell(|n| {
                let name = |wave: &usize| format!("${}$", n.name(&recurrence.wave_name(*wave)));
                let names = together.iter().map(name).collect::<Vec<_>>().join(" and ");
                format!(
                    "The equations of {names} are coupled by derivatives and have complex rates: they are \
                     solved together."
                )
            });
            let of = |form: &LinearForm| form.operators().any(|(wave, _)| together.contains(&wave));
            let others = recurrence.statement().continuity.iter().filter(|own| of(&own.form));
            starts.extend(others.map(|own| writer.start(&own.form, &own.start)));
        }
        if !starts.is_empty() {
            self.sentence("These are continuous from period to period, and start at");
            self.equations(starts);
        }
    }

    pub fn to_text(&self, width: usize) -> String {
        let mut out = String::new();
        for part in &self.parts {
            match part {
                Block::Heading(heading) | Block::Part(heading) => {
                    let gap = if out.is_empty() { "" } else { "\n" };
                    let line = if matches!(part, Block::Part(_)) { "=" } else { "-" };
                    out.push_str(&format!("{gap}{heading}\n{}\n", line.repeat(heading.len())));
                }
                Block::Text(text) => out.push_str(&format!("{text}\n\n")),
                Block::Gap => out.push('\n'),
                Block::Sentence([text, ..]) => out.push_str(&wrapped(text, width, "")),
                Block::Equations(formulas, _) => {
                    let lines = text(formulas, width.saturating_sub(4));
                    lines.lines().for_each(|line| out.push_str(&format!("    {line}\n")));
                }
            }
        }
        out
    }

    /// LaTeX: sections, sentences and numbered equations in `align` environments.
    pub fn to_latex(&self, width: usize) -> String {
        let mut out = String::new();
        for part in &self.parts {
            match part {
                Block::Part(heading) => out.push_str(&format!("\\section*{{{heading}}}\n")),
                Block::Heading(heading) => out.push_str(&format!("\\subsection*{{{heading}}}\n")),
                Block::Text(text) => {
                    out.push_str("{\\footnotesize\n\\begin{verbatim}\n");
                    out.push_str(&format!("{}\n\\end{{verbatim}}\n}}\n", verbatim(text)));
                }
                Block::Gap => out.push('\n'),
                Block::Sentence([_, latex, _]) => out.push_str(&format!("{latex}\n")),
                Block::Equations(formulas, label) => {
                    out.push_str(&numbered(formulas, *label, width))
                }
            }
        }
        out
    }
}

/// A text as LaTeX takes it verbatim: nothing in it ends the environment, Greek letters are spelt, and other letters that
/// are not Latin are left out.
fn verbatim(text: &str) -> String {
    let spelt = |letter: char| match letter {
        _ if (letter as u32) < 0x180 => letter.to_string(),
        _ => mathml::spelt(letter).unwrap_or("?").to_owned(),
    };
    text.replace("\\end", "\\ end").chars().map(spelt).collect()
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
            let balance = if names.len() == 1 { "balances" } else { "balance" };
            format!("{place}, {} {balance} the forces:", names.join(" and "))
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

/// The definition of a constant in one line: `2*k/(105*pi)`.
pub fn definition_text(value: &Definition) -> String {
    definition(value).written(Notation::Text).text().to_owned()
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

/// A sentence in LaTeX: element names between backticks, formulas between dollars.
fn prose(sentence: &str) -> String {
    let mut out = String::new();
    let (mut quoted, mut formula) = (false, false);
    for character in sentence.chars() {
        match character {
            '$' => {
                out.push('$');
                formula = !formula;
            }
            other if formula => out.push(other),
            '`' => {
                out.push_str(if quoted { "}" } else { "\\texttt{" });
                quoted = !quoted;
            }
            '_' => out.push_str("\\_"),
            other => out.push(other),
        }
    }
    out
}
