//! `events`: when contacts open and close, as a time line.

use super::arguments::{Events, Format};
use super::failure::Failure;
use super::found::number;
use super::input;
use super::json::SCHEMA_VERSION;
use super::progress;
use serde_json::{Value as Json, json};
use std::fmt::Write as _;
use std::time::{Duration, Instant};
use wavestep::ball::in_decimals;
use wavestep::export::expression_text;
use wavestep::history::{Body, Ending, Event, EventKind, History};
use wavestep::problem::Problem;
use wavestep::scene::Dimension;
use wavestep::signal::Value;

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
        Format::Json => told.json(),
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
        "followed from cell to cell: {cells} cells with {bits} bits, {:.1} s\n  bound: on every cell \
         it is proven that nothing else happens; numbers are correctly rounded to {digits} digits",
        took.as_secs_f64()
    );
}

struct Told<'a> {
    options: &'a Events,
    problem: &'a Problem,
    history: &'a History,
}

impl Told<'_> {
    fn value(&self, value: &Value, dimension: Dimension) -> String {
        let dimensional = self.problem.has_units();
        let text = match value {
            Value::Exact(value) if dimensional => in_decimals(value),
            other => other.to_text(self.options.digits),
        };
        match dimensional {
            true if dimension == Dimension::TIME => format!("{text} s"),
            true => format!("{text} {}", dimension.unit()),
            false => text,
        }
    }

    fn pair(&self, [before, after]: &[Value; 2], dimension: Dimension) -> String {
        let (before, after) = (self.value(before, dimension), self.value(after, dimension));
        if before == after { before } else { format!("{before} -> {after}") }
    }

    fn sentence(&self, event: &Event) -> String {
        let [left, right] = &event.between;
        match event.kind {
            EventKind::Impact => format!("{left} and {right} press on each other"),
            EventKind::Opening => format!("{left} and {right} part"),
            EventKind::Release => format!("{left} and {right} touch without force from now on"),
            EventKind::Closing => format!("{left} and {right} meet again"),
        }
    }

    fn text(&self) -> String {
        let mut text = format!("{}\n", self.problem.title());
        for event in &self.history.events {
            let mut time = self.value(&event.time, Dimension::TIME);
            if let Some(exact) = &event.exact {
                let _ = write!(time, " = {}", expression_text(exact));
            }
            let [left, right] = &event.between;
            let _ = write!(text, "\nt = {time}: {}\n", self.sentence(event));
            let _ = writeln!(text, "  force    {}", self.pair(&event.forces, Dimension::FORCE));
            let [[l0, r0], [l1, r1]] = event.velocities.clone();
            for (name, pair) in [(left, [l0, l1]), (right, [r0, r1])] {
                if name != "wall" {
                    let velocity = self.pair(&pair, Dimension::VELOCITY);
                    let _ = writeln!(text, "  velocity {velocity} of {name}");
                }
            }
            for body in &event.bodies {
                let _ = writeln!(text, "  {}", self.body(body));
            }
        }
        for contact in &self.history.contacts {
            let [left, right] = &contact.between;
            let _ = write!(text, "\nBetween {left} and {right}\n");
            if contact.impulses.is_empty() {
                let _ = writeln!(text, "  no force until the end");
            }
            for (duration, impulse) in contact.durations.iter().zip(&contact.impulses) {
                let impulse = self.value(impulse, Dimension::MOMENTUM);
                let _ = match duration {
                    Some(duration) => {
                        let duration = self.value(duration, Dimension::TIME);
                        writeln!(text, "  closed for {duration}, impulse {impulse}")
                    }
                    None => writeln!(text, "  closed still, impulse so far {impulse}"),
                };
            }
            if let Some(restitution) = &contact.restitution {
                let restitution = restitution.to_text(self.options.digits);
                let _ = writeln!(text, "  coefficient of restitution {restitution}");
            }
        }
        let _ = write!(text, "\n{}\n", self.ending());
        text
    }

    fn ending(&self) -> String {
        match &self.history.ending {
            Ending::Parted => {
                "Nothing meets again: the bodies move apart, or rest, and their energy of vibration \
                 does not\nsuffice to bring them together."
                    .to_owned()
            }
            Ending::Followed(end) => {
                let end = self.value(end, Dimension::TIME);
                format!(
                    "Followed until t = {end}; what comes later is not known. --until asks for another end."
                )
            }
            Ending::NoContact => "Nothing can open: there is no contact.".to_owned(),
        }
    }

    fn body(&self, body: &Body) -> String {
        let named = [
            ("energy", &body.energy, Dimension::ENERGY),
            ("of vibration", &body.vibration, Dimension::ENERGY),
            ("momentum", &body.momentum, Dimension::MOMENTUM),
            ("mean velocity", &body.velocity, Dimension::VELOCITY),
        ];
        let told = named.into_iter().filter_map(|(name, value, dimension)| {
            Some(format!("{name} {}", self.value(value.as_ref()?, dimension)))
        });
        format!("{}: {}", body.elements.join(" - "), told.collect::<Vec<_>>().join(", "))
    }

    fn json(&self) -> String {
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
        document.to_string() + "\n"
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
