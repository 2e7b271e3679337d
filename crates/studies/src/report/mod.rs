//! One page about a scene: its line, its derivation, events, diagrams, signals, extrema.
//!
//! The page is complete in itself: nothing is loaded, and the same scene gives the same bytes. What a scene
//! has no meaning for is left out with one line that says why. Values under a pointer are doubles nearest to
//! the exact ones.

mod html;
mod line;
mod numbers;
mod told;

use crate::picture::{PictureError, against_time, course, lagrange, usual_end};
use crate::told::contacts_open;
use crate::validity;
use html::{escape, left_out, list, paragraph, section, set};
use serde_json::Value as Json;
use wavestep::ball::in_decimals;
use wavestep::export::{Block, Formula, assumed_factors};
use wavestep::field::Quantity;
use wavestep::planner::Purpose;
use wavestep::problem::{Form, Orders, Problem, ToDerive, Wanted};
use wavestep::signal::Signal;
use wavestep_draw::{Caption, Chart as _};
use wavestep_polynomial::Rational;

/// How many sections a page has.
const PARTS: usize = 9;

/// The last period whose pieces are shown of equations that are stated.
const LAST_PIECE: usize = 2;

/// The width of a line of a formula, and the longest formula that is shown, both in characters.
const WIDTH: usize = 72;
const LONGEST: usize = 4_000;

/// Bytes of a figure: with three of them a page stays below 3 MB.
const LARGEST_FIGURE: usize = 900_000;

/// Bytes of a certificate that is attached.
const LARGEST_CERTIFICATE: usize = 300_000;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

type Outcome<T> = Result<T, PictureError>;

/// What a page says beside what it finds.
pub struct Request<'a> {
    pub version: &'a str,
    /// The command that makes the page again.
    pub command: &'a str,
    /// The last time that is shown, where it is not the usual one.
    pub to: Option<&'a Rational>,
    /// A certificate of the derived pieces, or why there is none.
    pub certificate: &'a dyn Fn() -> Result<String, String>,
    /// Is told what is worked out.
    pub progress: &'a dyn Fn(&str),
}

/// An observable, followed once for all that is told of it.
struct Observed<'a> {
    wanted: Wanted,
    signal: Box<dyn Signal + 'a>,
}

/// The page about a problem. It costs what the answers cost that stand on it.
pub fn page(problem: &Problem, request: &Request<'_>) -> String {
    let open = contacts_open(problem);
    let zero = Rational::default();
    let end = request.to.map_or_else(|| usual_end(problem, &zero), |to| Ok(to.clone()));
    let observed = end.as_ref().ok().map(|to| observed(problem, [&zero, to]));
    let seen =
        |show: &dyn Fn(&[Observed<'_>], &Rational) -> Outcome<String>| match (&end, &observed) {
            (Ok(to), Some(Ok(observed))) => {
                show(observed, to).unwrap_or_else(|error| left_out(&error))
            }
            (Err(error), _) | (_, Some(Err(error))) => left_out(error),
            (Ok(_), None) => String::new(),
        };
    let (mut body, mut part) = (String::new(), 0);
    let mut add = |id: &str, heading: &str, contents: &dyn Fn() -> String| {
        part += 1;
        (request.progress)(&format!("{heading}, part {part} of {PARTS}"));
        body += &section(id, heading, &contents());
    };
    add("scene", "The scene", &|| scene(problem));
    add("derivation", "Derivation", &|| derivation(problem));
    add("events", "Events at contacts", &|| told::events(problem, request.to, open == Some(false)));
    add("signals", "Observables against time", &|| seen(&|all, to| signals(problem, all, to)));
    add("diagrams", "Space–time diagrams", &|| match &end {
        Ok(to) => diagrams(problem, to).unwrap_or_else(|error| left_out(&error)),
        Err(error) => left_out(error),
    });
    add("extrema", "Largest and smallest values", &|| {
        seen(&|all, to| told::extrema(problem, all, [&zero, to]))
    });
    add("energies", "Energies", &|| seen(&|all, to| told::energies(problem, all, [&zero, to])));
    add("assumptions", "Assumptions", &|| {
        let of_window = |to| {
            let note = validity::derivation(problem).or_else(|| validity::pulling(problem, to));
            let closed = note.map(|note| format!("The formulas hold for closed contacts: {note}."));
            [until(problem, to)].into_iter().chain(closed)
        };
        let all = end.iter().flat_map(of_window).chain(assumptions(problem, open));
        list(&all.collect::<Vec<_>>())
    });
    add("certificate", "Certificate", &|| certificate(&(request.certificate)()));
    let title = escape(problem.title());
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n{body}\
         <footer><p>Made by wavestep {}. The command that makes this page again:</p>\n\
         <pre tabindex=\"0\">{}</pre></footer>\n</main>\n<script>{SCRIPT}</script>\n</body>\n</html>\n",
        escape(request.version),
        escape(request.command)
    )
}

fn observed<'a>(problem: &'a Problem, window: [&Rational; 2]) -> Outcome<Vec<Observed<'a>>> {
    let names = problem.observables().into_iter();
    let wanted: Vec<Wanted> = names.map(|name| problem.wanted(name)).collect::<Result<_, _>>()?;
    let signals = problem.signals_on(&wanted, window, Purpose::Search);
    let all = wanted.into_iter().zip(signals);
    let all = all.map(|(wanted, signal)| Ok(Observed { wanted, signal: signal? }));
    let all = all.collect::<Outcome<Vec<_>>>()?;
    if all.is_empty() { Err(PictureError::NothingObserved) } else { Ok(all) }
}

/// What the text says of itself, the line, and the text.
fn scene(problem: &Problem) -> String {
    let text = problem.source().text();
    let comment = text.lines().take_while(|line| line.starts_with('#'));
    let about: Vec<&str> = comment.map(|line| line.trim_start_matches('#').trim()).collect();
    let mut out = match about.is_empty() {
        true => String::new(),
        false => paragraph(&about.join(" ")),
    };
    let values: Vec<String> =
        problem.values().iter().map(|(name, value)| format!("{name} = {value}")).collect();
    if !values.is_empty() {
        out += &paragraph(&format!("Values of symbols: {}.", values.join(", ")));
    }
    out += &match problem.scaled() {
        Ok(scaled) => line::drawn(scaled),
        Err(_) => left_out(&"the picture of the line, since equations have no bars or elements"),
    };
    let lines = text.lines().map(escape).collect::<Vec<_>>().join("\n");
    out + &format!(
        "<details open><summary>The text of the scene</summary>\n<pre tabindex=\"0\">{lines}</pre></details>\n"
    )
}

/// How a scene becomes a recurrence, and that its pieces, step by step.
fn derivation(problem: &Problem) -> String {
    match (problem.explanation(None, 0, Form::Period, false), problem.first_contact()) {
        (Ok(derivation), _) => derivation.parts().iter().map(part).collect(),
        (Err(error), Ok(Some(formulas))) => {
            left_out(&error) + &with_constants(problem, "The first contact", &formulas)
        }
        (Err(error), Err(reason)) => left_out(&error) + &left_out(&reason),
        (Err(error), Ok(None)) => left_out(&error) + &pieces(problem),
    }
}

fn part(part: &Block) -> String {
    match part {
        Block::Heading(text) | Block::Part(text) => format!("<h3>{}</h3>\n", escape(text)),
        Block::Text(text) => format!("<pre>{}</pre>\n", escape(text)),
        Block::Gap => String::new(),
        Block::Sentence([.., markup]) => format!("<p>{markup}</p>\n"),
        Block::Equations(formulas, _) => mathematics(formulas),
    }
}

fn pieces(problem: &Problem) -> String {
    let orders = Orders::Through(0, LAST_PIECE);
    let derived = problem.functions(ToDerive::Waves, orders, Form::Period);
    match derived.and_then(|derived| problem.formulas(&derived, Form::Piecewise)) {
        Ok(found) => {
            let all: Vec<Formula> = found.into_iter().flat_map(|(_, formulas)| formulas).collect();
            with_constants(problem, "The first pieces", &all)
        }
        Err(error) => left_out(&format!("the first pieces: {error}")),
    }
}

/// Formulas with what the constants in them are.
fn with_constants(problem: &Problem, heading: &str, formulas: &[Formula]) -> String {
    let text: String = formulas.iter().map(|formula| formula.to_line() + "\n").collect();
    let constants = problem.constants(Some(&text)).unwrap_or_default();
    let constants = if constants.is_empty() { String::new() } else { list(&constants) };
    format!("<h3>{heading}</h3>\n{}{constants}", mathematics(formulas))
}

fn mathematics(formulas: &[Formula]) -> String {
    let one = |formula: &Formula| {
        let line = formula.to_line();
        if line.len() > LONGEST {
            let name = line.split(" = ").next().unwrap_or_default();
            return left_out(&format!("{name}, which has {} characters", line.len()));
        }
        let remark = formula.remark.as_ref().map_or(String::new(), |(text, _)| {
            format!("<span class=\"remark\">{}</span>", set(text))
        });
        format!("<div class=\"formula\">{}{remark}</div>\n", formula.to_mathml(WIDTH))
    };
    let all: String = formulas.iter().map(one).collect();
    format!(
        "<div class=\"wide\" role=\"group\" aria-label=\"Formulas\" tabindex=\"0\">\n{all}</div>\n"
    )
}

/// Observables as curves, with values at a time that is pointed at.
fn signals(problem: &Problem, observed: &[Observed<'_>], to: &Rational) -> Outcome<String> {
    let drawn = |one: &Observed<'_>| course(problem, &one.wanted, &*one.signal);
    let courses = observed.iter().map(drawn).collect::<Result<Vec<_>, _>>()?;
    let (ends, dimensional) = ((0.0, crate::nearest(to)), problem.has_units());
    let figure = against_time("", &courses, dimensional, ends, Caption::default())?;
    let samples = numbers::samples(observed, to, dimensional);
    Ok(explored("observables", &figure.svg_named("observables"), &samples, "x"))
}

/// Diagrams of place and time, with values of the field at a node that is pointed at.
fn diagrams(problem: &Problem, to: &Rational) -> Outcome<String> {
    let zero = Rational::default();
    let evaluator = problem.field_evaluator(to)?;
    let quantities = [Quantity::Velocity, Quantity::Force];
    let data = numbers::fields(&evaluator, &quantities, to)?;
    let figure = |(quantity, data): (&Quantity, &Json)| -> Outcome<String> {
        let diagram = lagrange(&evaluator, *quantity, [&zero, to], Caption::default())?.titled("");
        let name = format!("field-{}", quantity.name());
        Ok(explored(&name, &diagram.svg_named(&name), data, "y"))
    };
    quantities.iter().zip(&data).map(figure).collect()
}

/// A picture that can be pointed at and zoomed along its axis of time, with its data.
fn explored(name: &str, svg: &str, data: &Json, axis: &str) -> String {
    // No text of the data ends the element.
    let data = data.to_string().replace('<', "\\u003c");
    if svg.len() + data.len() > LARGEST_FIGURE {
        let size = (svg.len() + data.len()).div_ceil(1_000_000);
        return left_out(&format!("the figure {name}, which has {size} MB; `plot` draws it"));
    }
    format!(
        "<figure class=\"explored\" data-axis=\"{axis}\">\n{svg}\
         <script type=\"application/json\" id=\"{name}-data\">{data}</script>\n</figure>\n"
    )
}

/// The certificate as a file to save, with how it is verified.
fn certificate(certificate: &Result<String, String>) -> String {
    match certificate {
        Ok(text) if text.len() > LARGEST_CERTIFICATE => left_out(
            &"the certificate is too long for a page; `wavestep certify SCENE -o certificate.json` writes it",
        ),
        Ok(text) => format!(
            "<p>Anyone can verify, without wavestep, that the pieces above and no others satisfy the equations \
             of the scene: save <a download=\"certificate.json\" href=\"data:application/json,{}\">\
             certificate.json</a> ({} kB) and run <code>python3 checkers/check.py certificate.json</code>. The \
             checker is a short program that comes with the source of wavestep.</p>\n",
            in_address(text),
            text.len().div_ceil(1_000)
        ),
        Err(reason) => left_out(reason),
    }
}

/// A text within an address.
fn in_address(text: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-_.~!*'(),:/[]".contains(&byte);
    let written = |byte: u8| match plain(byte) {
        true => char::from(byte).to_string(),
        false => format!("%{byte:02X}"),
    };
    text.bytes().map(written).collect()
}

fn until(problem: &Problem, to: &Rational) -> String {
    let shown =
        format!("Values are shown for 0 <= t <= {} {}", in_decimals(to), problem.time_unit());
    shown.trim_end().to_owned() + "; at a jump, the limit from later times."
}

fn assumptions(problem: &Problem, open: Option<bool>) -> Vec<String> {
    let found = problem.assumptions();
    let mut all: Vec<String> = found.iter().map(|one| format!("Assumed: {one}.")).collect();
    if problem.scaled().is_ok() {
        all.extend(open.map(|open| match open {
            true => "Contacts carry compression only: they open, and close again.".to_owned(),
            false => "Contacts stay closed, even when they would go into tension.".to_owned(),
        }));
        all.push(
            "Bars are uniform and carry plane longitudinal waves without dispersion. Displacement and velocity are \
             positive to the right, force is positive in compression, stress and strain in tension."
                .to_owned(),
        );
    }
    if let Ok(recurrence) = problem.recurrence() {
        let factors = assumed_factors(&recurrence.statement().assumptions);
        if !factors.is_empty() {
            all.push(format!("Assumed nonzero: {}.", factors.join(", ")));
        }
    }
    all
}
