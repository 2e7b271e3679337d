//! One equation examined: the verdict, the derived form beside it, and the steps of the proof.

use crate::book::checks::{self, Checked};
use crate::book::entry::{Content, Entry, Equation, Relation, Section};
use crate::book::refusal::Refusal;
use crate::book::stage::{Quantity, Stage};
use crate::book::verdict::{Finding, Ground, Verdict};
use crate::book::{UnknownNumber, find, sections};
use wavestep::export::{Formula, Head, SourceForm, latex_name, solved_equations};
use wavestep::expression::Expression;
use wavestep::language::syntax::{Expression as Tree, Node};

#[derive(Clone, Debug)]
pub struct Examination {
    pub section: &'static Section,
    pub entry: &'static Entry,
    pub verdict: Verdict,
    /// What is derived from the scene in its place.
    pub derived: Vec<Formula>,
    /// How that was found, in sentences.
    pub steps: Vec<String>,
}

/// Examines the equation of this number.
/// Derives the first five periods of the scene; estimates take a search of all extrema for each mass.
pub fn examine(number: &str) -> Result<Examination, UnknownNumber> {
    let (section, entry) = find(number)?;
    let stage = match entry.content {
        Content::Claim(_) | Content::Readings(_) => section.stage(),
        _ => None,
    };
    Ok(examined(section, entry, stage.as_ref()))
}

pub fn examine_all() -> Vec<Examination> {
    let mut all = Vec::new();
    for section in sections() {
        let stage = section.stage();
        let entries = section.entries.iter();
        all.extend(entries.map(|entry| examined(section, entry, stage.as_ref())));
    }
    all
}

fn examined(
    section: &'static Section,
    entry: &'static Entry,
    stage: Option<&Stage>,
) -> Examination {
    let found = match &entry.content {
        Content::Claim(equations) => claim(stage, equations),
        Content::Readings(readings) => readings_of(stage, readings),
        Content::Definition(_) => {
            Ok(Checked { verdict: Verdict::Definition, derived: Vec::new(), steps: Vec::new() })
        }
        Content::Check(name) => checks::run(name),
    };
    let Checked { verdict, derived, steps } =
        found.unwrap_or_else(|error| panic!("equation {}: {error}", entry.number));
    Examination { section, entry, verdict, derived, steps }
}

fn on(stage: Option<&Stage>) -> Result<&Stage, Refusal> {
    stage.ok_or_else(|| Refusal::NoPeriods("none".to_owned()))
}

/// Equations that all have to hold.
fn claim(stage: Option<&Stage>, equations: &[Equation]) -> Result<Checked, Refusal> {
    let stage = on(stage)?;
    let (mut grounds, mut derived, mut steps) = (Vec::new(), Vec::new(), Vec::new());
    let mut refuted = None;
    for equation in equations {
        let finding = stage.judge(equation)?;
        for formula in derived_for(stage, equation, &finding)? {
            if !derived.contains(&formula) {
                derived.push(formula);
            }
        }
        let step = match &finding {
            Finding::Holds(ground) => ground.to_string(),
            Finding::Fails(witness) => {
                format!("the derived left side against the right side as read: {witness}")
            }
        };
        if equations.len() > 1 {
            steps.push(format!("{equation}:"));
        }
        if let Some(difference) = stage.difference(equation) {
            let what = match equation.relation {
                Relation::Equals => "left minus right, in the waves of the scene",
                Relation::Starts => "in the waves of the scene",
            };
            steps.push(format!("{what}: {difference}"));
        }
        steps.push(step);
        match finding {
            Finding::Holds(ground) => grounds.push(ground),
            Finding::Fails(witness) if refuted.is_none() => {
                refuted = Some(Box::new((equation.clone(), *witness)));
            }
            Finding::Fails(_) => {}
        }
    }
    let some = |ground: &&Ground| matches!(ground, Ground::PeriodsThrough(_));
    let verdict = match (refuted, grounds.iter().find(some)) {
        (Some(slip), _) => Verdict::Refuted(slip),
        // What is about every n is not proved by some.
        (None, Some(Ground::PeriodsThrough(last))) => {
            Verdict::Checked(format!("exactly, on the periods 0 to {last}"))
        }
        (None, _) => Verdict::Proved(grounds),
    };
    Ok(Checked { verdict, derived, steps })
}

/// Readings of which one at most can hold.
fn readings_of(stage: Option<&Stage>, readings: &[Equation]) -> Result<Checked, Refusal> {
    let stage = on(stage)?;
    let (mut findings, mut derived, mut steps) = (Vec::new(), Vec::new(), Vec::new());
    for reading in readings {
        let finding = stage.judge(reading)?;
        if derived.is_empty() && finding.holds() {
            derived = derived_for(stage, reading, &finding)?;
        }
        steps.push(match &finding {
            Finding::Holds(ground) => format!("supported: {reading} ({ground})"),
            Finding::Fails(witness) => format!("excluded: {reading} ({witness})"),
        });
        findings.push((reading.clone(), finding));
    }
    Ok(Checked { verdict: Verdict::Unsure(findings), derived, steps })
}

/// What the scene gives for the waves that an equation is about: their pieces, their general forms, or
/// the equations that hold between them.
fn derived_for(
    stage: &Stage,
    equation: &Equation,
    finding: &Finding,
) -> Result<Vec<Formula>, Refusal> {
    let mut waves = Vec::new();
    waves_of(&equation.left, &mut waves);
    let fixed = waves.iter().all(|(_, n)| n.is_some());
    if waves.is_empty() {
        return named(stage, equation);
    }
    let mut formulas = Vec::new();
    if fixed {
        for (name, n) in &waves {
            formulas.extend(piece(stage, name, n.unwrap_or_default())?);
        }
        return Ok(formulas);
    }
    if *finding == Finding::Holds(Ground::EveryPower) {
        for (name, _) in &waves {
            formulas.extend(general(stage, stage.quantity(name)?));
        }
        if !formulas.is_empty() {
            return Ok(formulas);
        }
    }
    let (equations, starts) = solved_equations(stage.solution().recurrence());
    let starts = starts.into_iter().map(|mut formula| {
        let text = "at the start, and continuous from period to period";
        formula.remark = Some((text.to_owned(), format!("\\text{{{text}}}")));
        formula
    });
    Ok(equations.into_iter().chain(starts).collect())
}

/// The waves that a formula names, with the period where it is a certain one.
fn waves_of(tree: &Tree, waves: &mut Vec<(String, Option<usize>)>) {
    match &tree.value {
        Node::Number(_) | Node::Name(_) | Node::Call { .. } => {}
        Node::Wave(wave) => {
            let index = &wave.index.value;
            let n = index.base.is_none().then(|| usize::try_from(index.offset).unwrap_or_default());
            let found = (wave.name.value.clone(), n);
            if !waves.contains(&found) {
                waves.push(found);
            }
        }
        Node::Exponential(inner) | Node::Negate(inner) => waves_of(inner, waves),
        Node::Function { argument, .. } => waves_of(argument, waves),
        Node::Summation { term, .. } => waves_of(term, waves),
        Node::Sum(terms) => terms.iter().for_each(|term| waves_of(&term.value, waves)),
        Node::Product(factors) => factors.iter().for_each(|f| waves_of(&f.value, waves)),
        Node::Power { base, .. } => waves_of(base, waves),
    }
}

/// A name that the section defines by waves, such as a constant of integration.
fn named(stage: &Stage, equation: &Equation) -> Result<Vec<Formula>, Refusal> {
    let Node::Name(name) = &equation.left.value else { return Ok(Vec::new()) };
    if stage.definition(name).is_none() {
        return Ok(Vec::new());
    }
    let head = Head::new(name.clone(), latex_name(name, None));
    Ok(vec![Formula::new(head, &stage.expression(&equation.left)?, stage.local())])
}

/// The unit that the source's notation gives a wave.
fn is_in_unit_of_source(stage: &Stage, quantity: &Quantity) -> Option<usize> {
    let (wave, unit) = stage.wave_of(quantity)?;
    let units = &stage.solution().recurrence().statement().notation;
    let own = units.units.get(&wave).map(|unit| Expression::from(unit.to_fraction()));
    (own.unwrap_or_else(Expression::one) == unit).then_some(wave)
}

/// A piece as the source would write it: in its symbols, with its constants or its values at the ends
/// of periods.
fn piece(stage: &Stage, name: &str, n: usize) -> Result<Vec<Formula>, Refusal> {
    let quantity = stage.quantity(name)?;
    let solution = stage.solution();
    let notation = &solution.recurrence().statement().notation;
    if let Some(wave) = is_in_unit_of_source(stage, quantity).filter(|_| !notation.is_empty()) {
        if notation.ends.contains(&wave) {
            let (pieces, kept) = solution.pieces_by_ends(n, &notation.ends)?;
            let form = SourceForm::new(solution.recurrence(), Some(&kept));
            return Ok(form.piece(wave, n, &pieces[wave][n]));
        }
        let value = solution.pieces(wave, n, n)?.remove(0);
        return Ok(SourceForm::new(solution.recurrence(), None).piece(wave, n, &value));
    }
    let head = Head::new(format!("{name}[{n}]"), latex_name(name, Some(&n.to_string())));
    let value = stage.on_period(&quantity.form, n)?;
    Ok(vec![Formula::new(head, &value, stage.local())])
}

/// The general forms of the waves in a quantity as the source would write them.
fn general(stage: &Stage, quantity: &Quantity) -> Vec<Formula> {
    let solution = stage.solution();
    let source = SourceForm::new(solution.recurrence(), None);
    let notation = &solution.recurrence().statement().notation;
    let of_wave = |(wave, _)| {
        let form = solution.general(wave).ok().filter(|_| notation.units.contains_key(&wave))?;
        Some(source.general(wave, form))
    };
    quantity.form.operators().filter_map(of_wave).flatten().collect()
}
