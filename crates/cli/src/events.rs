//! `events`: when contacts open and close, as a time line.

use super::arguments::{Events, Format};
use super::failure::Failure;
use super::found::number;
use super::input;
use super::json::SCHEMA_VERSION;
use super::progress;
use super::table::Table;
use serde_json::{Value as Json, json};
use std::fmt::Write as _;
use std::time::{Duration, Instant};
use wavestep::export::expression_text;
use wavestep::history::{Body, Ending, History};
use wavestep::problem::Problem;
use wavestep::scene::Dimension;
use wavestep::signal::Value;
use wavestep_studies::told::{Teller, contacts_open};

pub fn run(options: &Events) -> Result<String, Failure> {
    input::digits(options.digits)?;
    let problem = input::problem(&options.scene)?;
    let to = options.to.as_deref();
    let until = to.map(|to| problem.time("--to", to)).transpose()?;
    let begin = Instant::now();
    let history = {
        let _progress = progress::spinner("following contacts");
        problem.history(until.as_ref(), options.digits)?
    };
    if options.explain {
        explain(&history, begin.elapsed(), options.digits);
    }
    let told = Told { options, problem: &problem, history: &history };
    Ok(match options.format {
        Format::Json => format!("{}\n", told.json()),
        Format::Csv => Table::of(&told.json()).csv(),
        Format::Latex => told.latex(),
        _ => told.text(),
    })
}

/// Says on standard error how events were found, at which cost, and how sure they are.
fn explain(history: &History, took: Duration, digits: usize) {
    if history.ending == Ending::NoContact {
        eprintln!("nothing to follow: no contact can open");
        return;
    }
    let History { cells, bits, .. } = history;
    eprintln!(
        "followed from cell to cell: {cells} cells with {bits} bits, {:.1} s\n  bound: proven for every \
         cell that nothing else happens; numbers are correctly rounded to {digits} digits",
        took.as_secs_f64()
    );
}

struct Told<'a> {
    options: &'a Events,
    problem: &'a Problem,
    history: &'a History,
}

impl Told<'_> {
    fn text(&self) -> String {
        let teller = Teller {
            problem: self.problem,
            digits: self.options.digits,
            longest_fraction: usize::MAX,
        };
        let mut text = format!("{}\n", self.problem.title());
        if contacts_open(self.problem) == Some(false) {
            text += "Contacts open here when they would go into tension; the scene keeps them closed.\n";
        }
        for (sentence, lines) in teller.history(self.history) {
            let _ = write!(text, "\n{sentence}");
            if matches!(self.history.ending, Ending::Followed(_)) && lines.is_empty() {
                text += " --to sets another end.";
            }
            text.push('\n');
            text.extend(lines.iter().map(|line| format!("  {line}\n")));
        }
        text
    }

    fn json(&self) -> Json {
        let optional = |value: &Option<Value>| value.as_ref().map(number);
        let pair = |pair: &[Value; 2]| pair.each_ref().map(number);
        let body = |body: &Body| {
            json!({
                "elements": body.elements,
                "energy": optional(&body.energy),
                "momentum": optional(&body.momentum),
                "mean_velocity": optional(&body.velocity),
                "vibration": optional(&body.vibration),
            })
        };
        let events = self.history.events.iter().map(|event| {
            let mut time = number(&event.time);
            if let Some(exact) = &event.exact {
                time["expression"] = expression_text(exact).into();
            }
            json!({
                "kind": event.kind.word(),
                "between": event.between,
                "time": time,
                "force": pair(&event.forces),
                "velocities": { "before": pair(&event.velocities[0]),
                                "after": pair(&event.velocities[1]) },
                "bodies": event.bodies.iter().map(body).collect::<Vec<_>>(),
            })
        });
        let contacts = self.history.contacts.iter().map(|contact| {
            json!({
                "between": contact.between,
                "durations": contact.durations.iter().map(optional).collect::<Vec<_>>(),
                "impulses": contact.impulses.iter().map(number).collect::<Vec<_>>(),
                "restitution": optional(&contact.restitution),
            })
        });
        let ending: Json = match &self.history.ending {
            Ending::Parted => json!({ "kind": "parted" }),
            Ending::Followed(time) => json!({ "kind": "followed", "until": number(time) }),
            Ending::NoContact => json!({ "kind": "no contact" }),
        };
        let mut document = json!({
            "schema_version": SCHEMA_VERSION,
            "title": self.problem.title(),
            "set": self.options.scene.set,
            "digits": self.options.digits,
            "bits": self.history.bits,
            "events": events.collect::<Vec<_>>(),
            "contacts": contacts.collect::<Vec<_>>(),
            "ending": ending,
            "assumptions": self.history.assumptions,
        });
        if self.problem.has_units() {
            document["units"] = json!({
                "time": "s",
                "force": Dimension::FORCE.unit(),
                "velocity": Dimension::VELOCITY.unit(),
                "energy": Dimension::ENERGY.unit(),
                "momentum": Dimension::MOMENTUM.unit(),
            });
        }
        document
    }

    fn latex(&self) -> String {
        let escaped = |name: &str| name.replace('_', r"\_");
        let decimals = |value: &Value| match value {
            Value::Enclosed(_) => value.to_text(self.options.digits).replace('±', r"\pm"),
            _ => value.decimal(self.options.digits).0.to_string(),
        };
        let mut text = String::from("\\begin{tabular}{llrrrr}\n");
        text += "event & contact & $t$ & force before & after & left, right after \\\\\n\\hline\n";
        for event in &self.history.events {
            let [left, right] = event.between.each_ref().map(|name| escaped(name));
            let [before, after] = event.forces.each_ref().map(decimals);
            let [u, v] = event.velocities[1].each_ref().map(decimals);
            let _ = writeln!(
                text,
                "{} & {left}, {right} & ${}$ & ${before}$ & ${after}$ & ${u}$, ${v}$ \\\\",
                event.kind.word(),
                decimals(&event.time),
            );
        }
        text + "\\end{tabular}\n"
    }
}
