//! Values in doubles: how they are asked for, what is said of them, and how they are written.

use super::arguments::{Eval, Format};
use super::failure::Failure;
use super::json::SCHEMA_VERSION;
use super::rows::{csv, lines, with_units};
use num_rational::BigRational;
use serde_json::json;
use std::fmt::Write as _;
use wavestep::answer::{
    Candidate, Doubles, Method, Promise, Remark, Tested, Tolerance, WayError, Weighed,
};
use wavestep::ball::in_decimals;
use wavestep::language;
use wavestep::problem::{Problem, ProblemError, Wanted};
use wavestep::signal::{EchoCount, Limit};

pub fn method(text: &str) -> Result<Method, Failure> {
    text.parse().map_err(|error| {
        let names: Vec<&str> = Method::NAMES.iter().map(|(name, _)| *name).collect();
        let word = text.split(':').next().unwrap_or_default();
        let bare = names.iter().map(|name| name.split(':').next().unwrap_or_default());
        let likely = language::closest(word, bare).filter(|likely| *likely != word);
        let remedy = match likely {
            Some(likely) => format!("did you mean `{}`?", text.replacen(word, likely, 1)),
            None => format!("give one of {}", names.join(", ")),
        };
        Failure::usage(format!("{error}"), remedy)
    })
}

pub fn tolerance(text: &str) -> Result<Tolerance, Failure> {
    text.parse().map_err(|error| {
        let remedy = "write 1e-9 (of the largest value), abs:1e-9 or ulp:4";
        Failure::usage(format!("{error}"), remedy)
    })
}

/// Says on standard error what is to be known of values; with `explain` also how they were computed.
pub fn tell(found: &Doubles, points: usize, tolerance: Option<Tolerance>, explain: bool) {
    let method = found.method;
    let tolerance = tolerance.map_or_else(String::new, |tolerance| tolerance.to_string());
    for remark in &found.remarks {
        match remark {
            Remark::Tested(tested) => note_tested(tested),
            Remark::BoundTooLarge(bound) => {
                eprintln!("warning: {method} is proven to within {bound:.1e}, not to {tolerance}");
            }
            Remark::Off(error, time) => eprintln!(
                "warning: {method} is off by {error:.1e} at {}, more than {tolerance}",
                in_decimals(time)
            ),
            Remark::OffAtMost(error, compared) => eprintln!(
                "note: {method} is off by at most {error:.1e} at {compared} of the times, which proves \
                 nothing about the others"
            ),
            _ if !explain => {}
            Remark::Weighed(weighed, absolute) => {
                eprint!("{}", explained(weighed, points, &tolerance, *absolute));
            }
            Remark::AsAskedFor => eprintln!("{method}, as requested: {}", found.law),
            Remark::Law => eprintln!("{method}: {}", found.law),
            Remark::PromiseNotKept(method) => {
                eprintln!("{method} failed its check; certified is used instead");
            }
            Remark::NearSpring(spring) => {
                eprintln!("the exact solution with the equivalent spring is close: {spring}");
            }
        }
    }
}

/// Says on standard error how many echoes of a quantity there are.
pub fn count(name: &str, echoes: Option<EchoCount>) {
    let Some(EchoCount { expanded, arriving, needed }) = echoes else {
        return eprintln!(
            "echoes computed for {name}: none; values come from a closed form or from whole pieces"
        );
    };
    let needed = match needed == arriving {
        true => String::new(),
        false => format!(", of which the tolerance needs {needed}"),
    };
    eprintln!(
        "echoes computed for {name}: {expanded} of {arriving} that reach the observed place{needed}"
    );
}

/// Says on standard error how sure values with a local contact, or with contacts that open, are.
fn note_tested(Tested { contact, tolerance, differs }: &Tested) {
    let why = match contact {
        Some(contact) => format!("`{contact}` is a local contact"),
        None => "contacts open".to_owned(),
    };
    eprintln!(
        "note: {why}; these values are tested, not certified: computed to \
         {tolerance:e} of the largest value"
    );
    if let Some(differs) = differs {
        eprintln!(
            "note: a change of {:e} at each opening and closing changes them by at most {differs:.1e}",
            Tested::NUDGE
        );
    }
}

/// Why there are no values in doubles; with `explain` the methods that were weighed are told.
pub fn refused(error: ProblemError, points: usize, explain: bool) -> Failure {
    if let ProblemError::Way(way) = &error
        && let WayError::NotMet { weighed, tolerance, absolute } = &**way
        && explain
    {
        eprint!("{}", explained(weighed, points, &tolerance.to_string(), *absolute));
    }
    error.into()
}

fn explained(weighed: &Weighed, points: usize, tolerance: &str, absolute: f64) -> String {
    let mut text = format!(
        "{points} value{} within {tolerance}, that is {absolute:.1e}\n",
        if points == 1 { "" } else { "s" }
    );
    let costs = &weighed.costs;
    let _ = writeln!(text, "  {:<14} {:>12} {:>10}  by {costs}", "method", "expected", "seconds");
    for Candidate { method, promise, seconds, verdict } in &weighed.candidates {
        let promise = match promise {
            Some(Promise::Proven(bound)) => format!("≤ {bound:.1e}"),
            Some(Promise::Measured(error)) => format!("~ {error:.1e}"),
            Some(Promise::Nothing) | None => "–".to_owned(),
        };
        let seconds = format!("{seconds:.0e}");
        let _ =
            writeln!(text, "  {:<14} {promise:>12} {seconds:>10}  {verdict}", method.to_string());
    }
    text
}

/// Half a unit in the last place of the largest of some values.
fn half_a_unit(values: &[f64]) -> f64 {
    let largest = values.iter().map(|value| value.abs()).fold(0.0, f64::max);
    (largest.next_up() - largest) / 2.0
}

/// A double so that it reads back as it is.
fn double(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if (1e-5..1e17).contains(&size) || !size.is_finite() => value.to_string(),
        _ => format!("{value:e}"),
    }
}

pub fn written(
    found: &Doubles,
    problem: &Problem,
    wanted: &Wanted,
    times: &[BigRational],
    options: &Eval,
) -> String {
    let rows = times.iter().zip(&found.values);
    match options.format {
        Format::Csv => {
            let rows = rows.map(|(time, value)| (time, double(*value)));
            csv(problem, wanted, (rows, "value"), options)
        }
        Format::Json => {
            let row = |(time, value): (&BigRational, &f64)| json!({"time": time.to_string(), "value": value});
            let document = json!({
                "schema_version": SCHEMA_VERSION,
                "title": problem.title(),
                "quantity": wanted.name,
                "set": options.scene.set,
                "side": if options.side == Limit::Left { "left" } else { "right" },
                "method": found.method.to_string(),
                "law": found.law,
                "bound": found.bound.map(|bound| bound + half_a_unit(&found.values)),
                "tolerance": options.tol,
                "values": rows.map(row).collect::<Vec<_>>(),
            });
            format!("{}\n", with_units(document, problem, wanted))
        }
        _ => {
            let rows = rows.map(|(time, value)| (time, double(*value)));
            lines(problem, wanted, rows, options)
        }
    }
}
