//! One page about a scene: its line, its formulas, events, diagrams, signals, extrema.
//!
//! The page is complete in itself: nothing is loaded, and the same scene gives the same bytes. What a scene
//! has no meaning for is left out with one line that says why. Values under a pointer are doubles nearest to
//! the exact ones.

mod html;
mod line;
mod numbers;
mod told;

use crate::picture::{PictureError, against_time, courses, lagrange, usual_end};
use html::{escape, left_out, list, paragraph, section};
use serde_json::Value as Json;
use std::fmt::Write as _;
use wavestep::export::{Formula, TEXT_WIDTH, assumed_factors, solved_equations};
use wavestep::field::Quantity;
use wavestep::problem::{Form, Orders, Problem, ToDerive};
use wavestep_draw::{Caption, Chart as _};
use wavestep_polynomial::Rational;

/// The last period whose pieces are shown.
const LAST_PIECE: usize = 2;

/// The width of a line of a formula, and the longest formula that is shown, both in characters.
const WIDTH: usize = 84;
const LONGEST: usize = 4_000;

/// What a page says beside what it finds.
#[derive(Clone, Debug, Default)]
pub struct Request {
    pub version: String,
    /// The command that makes the page again.
    pub command: String,
}

/// The page. `notes` tells how long closed contacts are right up to a time.
pub fn page(
    problem: &Problem,
    request: &Request,
    notes: impl Fn(&Rational) -> Vec<String>,
) -> Result<String, PictureError> {
    let zero = Rational::default();
    let end = usual_end(problem, &zero);
    let names = problem.observables();
    let mut body = section("scene", "The scene", &scene(problem));
    body += &section("equations", "The recurrence and its first pieces", &formulas(problem));
    let opens = problem.scaled().is_ok_and(|scaled| scaled.scene().contacts_open);
    body += &section("events", "Events at contacts", &told::events(problem, opens));
    let mut assumed = Vec::new();
    match &end {
        Err(error) => {
            let reason = left_out(error);
            body += &section("signals", "Observables, diagram and extrema", &reason);
        }
        Ok(to) => {
            let window = [&zero, to];
            let shown = |found: Result<String, PictureError>| {
                found.unwrap_or_else(|error| left_out(&error))
            };
            body += &section(
                "signals",
                "Observables against time",
                &shown(signals(problem, &names, to)),
            );
            body += &section("diagram", "Place and time", &shown(diagram(problem, to)));
            let found = match names.is_empty() {
                true => Err(PictureError::NothingObserved),
                false => told::extrema(problem, &names, window),
            };
            body += &section("extrema", "Largest and smallest values", &shown(found));
            body +=
                &section("energies", "Energies", &shown(told::energies(problem, &names, window)));
            let last = wavestep::ball::in_decimals(to);
            let unit = problem.time_unit();
            assumed.push(
                format!("Values are shown for 0 ≤ t ≤ {last} {unit}").trim_end().to_owned() + ".",
            );
            assumed.extend(notes(to));
        }
    }
    assumed.extend(problem.assumptions().iter().map(|one| format!("It is assumed that {one}.")));
    assumed.extend(general_assumptions(problem, opens));
    body += &section("assumptions", "What is assumed", &list(&assumed));
    let _ = write!(
        body,
        "<footer><p>Made by wavestep {}. The command that makes this page again:</p>\n<pre>{}</pre></footer>\n",
        escape(&request.version),
        escape(&request.command)
    );
    let title = escape(problem.title());
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n{body}</main>\n\
         <script>{SCRIPT}</script>\n</body>\n</html>\n"
    ))
}

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// What the text says of itself, the line, and the text.
fn scene(problem: &Problem) -> String {
    let text = problem.source().text();
    let comment = text.lines().take_while(|line| line.starts_with('#'));
    let about: Vec<&str> = comment.map(|line| line.trim_start_matches('#').trim()).collect();
    let mut out = String::new();
    if !about.is_empty() {
        out += &paragraph(&about.join(" "));
    }
    let values: Vec<String> =
        problem.values().iter().map(|(name, value)| format!("{name} = {value}")).collect();
    if !values.is_empty() {
        out += &paragraph(&format!("Values in place of symbols: {}.", values.join(", ")));
    }
    out += &match problem.scaled() {
        Ok(scaled) => line::drawn(scaled),
        Err(_) => left_out(&"the picture of the line, since equations state no bars and elements"),
    };
    let _ = write!(
        out,
        "<details open><summary>The text of the scene</summary>\n<pre tabindex=\"0\">{}</pre></details>\n",
        text.lines().map(escape).collect::<Vec<_>>().join("\n")
    );
    out
}

/// The recurrence solved for one wave after another, and pieces.
fn formulas(problem: &Problem) -> String {
    let mut out = String::new();
    // What constants are is told of those that occur.
    let mut text = String::new();
    let mut show = |out: &mut String, sentence: &str, formulas: &[Formula]| {
        text.extend(formulas.iter().map(|formula| formula.to_line() + "\n"));
        *out += &(paragraph(sentence) + &mathematics(formulas));
    };
    match problem.recurrence() {
        Err(error) if problem.local_contact().is_some() => return left_out(&error),
        Err(error) => out += &left_out(&error),
        Ok(recurrence) => {
            let (equations, starts) = solved_equations(recurrence, problem.waves().len());
            let sentence =
                "Waves on the n-th period, solved for one after another; they are zero for n < 0:";
            show(&mut out, sentence, &equations);
            if !starts.is_empty() {
                show(&mut out, "Continuous from period to period, these start at", &starts);
            }
        }
    }
    let orders = Orders::Through(0, LAST_PIECE);
    let derived = problem.functions(ToDerive::Waves, orders, Form::Period);
    match derived.and_then(|derived| problem.formulas(&derived, Form::Piecewise)) {
        Ok(found) => {
            let all: Vec<Formula> = found.into_iter().flat_map(|(_, formulas)| formulas).collect();
            let sentence = "The first pieces, in local time s, with the times at which they hold:";
            show(&mut out, sentence, &all);
        }
        Err(error) => out += &left_out(&format!("the first pieces: {error}")),
    }
    match problem.constants(Some(&text)) {
        Ok(constants) if !constants.is_empty() => out + &list(&constants),
        _ => out,
    }
}

fn mathematics(formulas: &[Formula]) -> String {
    let one = |formula: &Formula| {
        let line = formula.to_line();
        if line.len() > LONGEST {
            let name = line.split(" = ").next().unwrap_or_default();
            return left_out(&format!("{name}, which has {} characters", line.len()));
        }
        let remark = formula.remark.as_ref().map_or(String::new(), |(text, _)| {
            let text =
                text.replace("<=", "≤").replace(">=", "≥").replace('*', "·").replace('-', "−");
            format!("<span class=\"remark\">{}</span>", escape(&text))
        });
        format!(
            "<div class=\"formula\">{}{remark}</div>\n",
            formula.to_mathml(WIDTH.min(TEXT_WIDTH))
        )
    };
    let all: String = formulas.iter().map(one).collect();
    format!(
        "<div class=\"wide\" role=\"group\" aria-label=\"Formulas\" tabindex=\"0\">\n{all}</div>\n"
    )
}

/// Observables as curves, with values at a time that is pointed at.
fn signals(problem: &Problem, names: &[&str], to: &Rational) -> Result<String, PictureError> {
    let zero = Rational::default();
    let courses = courses(problem, &[], [&zero, to])?;
    let ends = (0.0, crate::nearest(to));
    let figure = against_time("", &courses, problem.has_units(), ends, Caption::default())?;
    let samples = numbers::samples(problem, names, to)?;
    let svg = figure.svg_named("observables");
    Ok(explored("observables", &svg, &samples, (to, problem.has_units()), "x"))
}

/// The diagram of place and time, with values of the field at a node that is pointed at.
fn diagram(problem: &Problem, to: &Rational) -> Result<String, PictureError> {
    let zero = Rational::default();
    let evaluator = problem.field_evaluator(to)?;
    let mut out = String::new();
    for quantity in [Quantity::Velocity, Quantity::Force] {
        let diagram = lagrange(&evaluator, quantity, [&zero, to], Caption::default())?.titled("");
        let fields = numbers::fields(&evaluator, quantity, to)?;
        let name = format!("field-{}", quantity.name());
        let svg = diagram.svg_named(&name);
        out += &explored(&name, &svg, &fields, (to, problem.has_units()), "y");
    }
    Ok(out)
}

/// A picture that can be pointed at and zoomed along its axis of time, with its data.
fn explored(
    name: &str,
    svg: &str,
    data: &Json,
    (to, dimensional): (&Rational, bool),
    axis: &str,
) -> String {
    let (end, factor) = numbers::shown(to, dimensional);
    // No text of the data ends the element.
    let data = data.to_string().replace('<', "\\u003c");
    format!(
        "<figure class=\"explored\" data-axis=\"{axis}\" data-end=\"{end}\" data-factor=\"{factor}\">\n{svg}\
         <script type=\"application/json\" id=\"{name}-data\">{data}</script>\n</figure>\n"
    )
}

fn general_assumptions(problem: &Problem, opens: bool) -> Vec<String> {
    let mut all = Vec::new();
    if let Ok(scaled) = problem.scaled() {
        let contact = wavestep::scene::Joint::Contact;
        if scaled.scene().line.joints.contains(&contact) && !opens {
            all.push("Contacts are kept closed, also where they would pull.".to_owned());
        }
        if opens {
            all.push("Contacts carry compression only: they open, and close again.".to_owned());
        }
        all.push(
            "Bars are uniform and carry plane longitudinal waves without dispersion; displacement and \
             velocity are positive to the right, forces where they compress, strains where they pull."
                .to_owned(),
        );
    }
    if let Ok(recurrence) = problem.recurrence() {
        let factors = assumed_factors(&recurrence.statement().assumptions);
        if !factors.is_empty() {
            all.push(format!("Taken to be non-zero: {}.", factors.join(", ")));
        }
    }
    all.push(format!(
        "Pieces are shown up to n = {LAST_PIECE}. Where a value jumps, the limit from later times is shown."
    ));
    all
}
