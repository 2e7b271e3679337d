//! `eval` in doubles: by a tolerance, or by the name of a method.

use super::arguments::{Eval, EvalFormat};
use super::failure::Failure;
use super::input::Subject;
use super::json::SCHEMA_VERSION;
use super::problem::{Titles, is_dimensional, with_problem};
use super::rows::{MAX_POINTS, in_decimals, times};
use num_rational::BigRational;
use serde_json::json;
use std::fmt::Write as _;
use wavestep::answer::{Candidate, Kind, Problem, Promise, Tolerance, Way, Weighed, consider};
use wavestep::evaluate::Limit;

/// The most times at which a method without a proven bound is compared with certified values.
const COMPARED: usize = 50;

/// Evaluates in doubles.
pub fn run(subject: Subject, options: &Eval) -> Result<String, Failure> {
    let kind = options.method.as_deref().map(method).transpose()?;
    let tolerance = options.tol.as_deref().map(tolerance).transpose()?;
    let times = times(options, is_dimensional(&subject))?;
    debug_assert!(times.len() <= MAX_POINTS);
    let window =
        |times: &[BigRational]| Some((times.iter().min()?.clone(), times.iter().max()?.clone()));
    let (first, last) = window(&times).expect("times without any are refused");
    with_problem(subject, &options.quantity, (first, last), |problem, titles| {
        let way = match kind {
            Some(kind) => forced(kind, problem, tolerance, options.explain)?,
            None => picked(problem, times.len(), tolerance.expect("one of both"), options.explain)?,
        };
        let values = way.exact_values(&times, options.side)?;
        if let Some(i) = values.iter().position(|value| !value.is_finite()) {
            let message = format!("{} gives no number at {}", way.kind(), in_decimals(&times[i]));
            return Err(Failure::Computation(message, "use --method certified".to_owned()));
        }
        if let Some(kind) = kind.filter(|_| way.bound().is_none()) {
            compare(kind, problem, tolerance, (&times, options.side, &values))?;
        }
        Ok(written(&way, titles, (&times, &values), options))
    })
}

/// A method by its name and settings.
pub fn method(text: &str) -> Result<Kind, Failure> {
    text.parse().map_err(|error| {
        let names: Vec<&str> = Kind::NAMES.iter().map(|(name, _)| *name).collect();
        Failure::usage(format!("{error}"), format!("give one of {}", names.join(", ")))
    })
}

/// A tolerance as the command line gives it.
pub fn tolerance(text: &str) -> Result<Tolerance, Failure> {
    text.parse().map_err(|error| {
        let remedy = "write 1e-9 (of the largest value), abs:1e-9 or ulp:4";
        Failure::usage(format!("{error}"), remedy)
    })
}

/// The method that is asked for; a bound larger than the tolerance is told.
fn forced<'a>(
    kind: Kind,
    problem: &Problem<'a>,
    tolerance: Option<Tolerance>,
    explain: bool,
) -> Result<Way<'a>, Failure> {
    let absolute = tolerance.map(|tolerance| scaled(tolerance, problem)).transpose()?;
    let way = Way::new(kind, problem, absolute)?;
    if explain {
        eprintln!("{kind}, as asked for: {}", way.law());
    }
    if let (Some(bound), Some(absolute), Some(tolerance)) = (way.bound(), absolute, tolerance)
        && bound > absolute
    {
        eprintln!("warning: {kind} is proven to be within {bound:.1e}, not within {tolerance}");
    }
    Ok(way)
}

/// A tolerance in the unit of the values.
fn scaled(tolerance: Tolerance, problem: &Problem<'_>) -> Result<f64, Failure> {
    Ok(match tolerance {
        Tolerance::Absolute(tolerance) => tolerance,
        relative => match problem.scale()? {
            // Where all is zero any tolerance is met.
            0.0 => f64::MIN_POSITIVE.max(relative.absolute(1.0)),
            scale => relative.absolute(scale),
        },
    })
}

/// The cheapest method that is good enough.
fn picked<'a>(
    problem: &Problem<'a>,
    points: usize,
    tolerance: Tolerance,
    explain: bool,
) -> Result<Way<'a>, Failure> {
    let absolute = scaled(tolerance, problem)?;
    let scale = problem.scale()?;
    let weighed = consider(problem, points, absolute, scale)?;
    if explain {
        eprint!("{}", explained(&weighed, points, tolerance, absolute));
    }
    if !weighed.met {
        let message = format!("no double is proven to be within {tolerance}");
        return Err(Failure::Accuracy(message, "ask for digits instead: --digits 25".to_owned()));
    }
    let way = Way::new(weighed.candidates[0].kind, problem, Some(absolute))?;
    // A promise is kept but where functions are unusually steep.
    match way.bound() {
        Some(bound) if bound <= absolute => Ok(way),
        _ => {
            if explain {
                eprintln!("{} did not keep its promise: certified instead", way.kind());
            }
            Ok(Way::new(Kind::Certified, problem, None)?)
        }
    }
}

/// The methods that were weighed, as a table.
fn explained(weighed: &Weighed, points: usize, tolerance: Tolerance, absolute: f64) -> String {
    let mut text = format!(
        "{points} value{} within {tolerance}, that is {absolute:.1e}\n",
        if points == 1 { "" } else { "s" }
    );
    let _ = writeln!(text, "  {:<14} {:>12} {:>10}", "method", "expected", "seconds");
    for Candidate { kind, promise, seconds, verdict } in &weighed.candidates {
        let promise = match promise {
            Some(Promise::Proven(bound)) => format!("≤ {bound:.1e}"),
            Some(Promise::Measured(error)) => format!("~ {error:.1e}"),
            Some(Promise::Nothing) | None => "–".to_owned(),
        };
        let seconds = format!("{seconds:.0e}");
        let _ = writeln!(text, "  {:<14} {promise:>12} {seconds:>10}  {verdict}", kind.to_string());
    }
    text
}

/// Compares a method without a proven bound with certified values, and tells what was seen.
fn compare(
    kind: Kind,
    problem: &Problem<'_>,
    tolerance: Option<Tolerance>,
    (times, side, values): (&[BigRational], Limit, &[f64]),
) -> Result<(), Failure> {
    let Some(tolerance) = tolerance else { return Ok(()) };
    let certified = Way::new(Kind::Certified, problem, None)?;
    let stride = times.len().div_ceil(COMPARED);
    let mut worst = (0.0, 0);
    let mut scale = 0.0_f64;
    for i in (0..times.len()).step_by(stride) {
        let exact = certified.value(&times[i], side)?;
        scale = scale.max(exact.abs());
        // What is no number is off by more than any.
        let error = if values[i].is_finite() { (values[i] - exact).abs() } else { f64::INFINITY };
        if error > worst.0 {
            worst = (error, i);
        }
    }
    let absolute = match tolerance {
        Tolerance::Absolute(tolerance) => tolerance,
        relative => relative.absolute(problem.scale().unwrap_or(scale).max(scale)),
    };
    let (error, i) = worst;
    if error > absolute {
        eprintln!(
            "warning: {kind} is off by {error:.1e} at {}, more than {tolerance}",
            in_decimals(&times[i])
        );
    } else {
        eprintln!(
            "note: {kind} is off by at most {error:.1e} at {} of the times, which proves nothing of \
             the others",
            times.len().div_ceil(stride)
        );
    }
    Ok(())
}

/// Half a unit in the last place of the largest of some values.
fn half_a_unit(values: &[f64]) -> f64 {
    let largest = values.iter().map(|value| value.abs()).fold(0.0, f64::max);
    (largest.next_up() - largest) / 2.0
}

/// A double so that it reads back as it is.
pub fn double(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if (1e-5..1e17).contains(&size) || !size.is_finite() => value.to_string(),
        _ => format!("{value:e}"),
    }
}

/// Values in the format asked for.
pub fn written(
    way: &Way<'_>,
    titles: &Titles,
    (times, values): (&[BigRational], &[f64]),
    options: &Eval,
) -> String {
    let name = &options.quantity;
    let rows = times.iter().zip(values);
    match options.format {
        EvalFormat::Text => {
            let limit = if options.side == Limit::Left { "-" } else { "" };
            let spaced =
                |unit: &str| if unit.is_empty() { String::new() } else { format!(" {unit}") };
            let (unit, time_unit) = (spaced(&titles.unit), spaced(&titles.time_unit));
            let line = |(time, value): (&BigRational, &f64)| {
                let time = match titles.time_unit.is_empty() {
                    true => time.to_string(),
                    false => in_decimals(time),
                };
                format!("{name}({time}{time_unit}{limit}) = {}{unit}\n", double(*value))
            };
            rows.map(line).collect()
        }
        EvalFormat::Csv => {
            let line = |(time, value): (&BigRational, &f64)| {
                format!("{time},{},{}\n", in_decimals(time), double(*value))
            };
            std::iter::once("time,time_decimal,value\n".to_owned()).chain(rows.map(line)).collect()
        }
        EvalFormat::Json => {
            let row = |(time, value): (&BigRational, &f64)| json!({"time": time.to_string(), "value": value});
            let mut document = json!({
                "schema_version": SCHEMA_VERSION,
                "title": titles.title,
                "quantity": name,
                "set": options.scene.set,
                "side": if options.side == Limit::Left { "left" } else { "right" },
                "method": way.kind().to_string(),
                "law": way.law(),
                "bound": way.bound().map(|bound| bound + half_a_unit(values)),
                "tolerance": options.tol,
                "values": rows.map(row).collect::<Vec<_>>(),
            });
            if !titles.time_unit.is_empty() {
                document["unit"] = json!(titles.unit);
                document["time_unit"] = json!(titles.time_unit);
            }
            format!("{document}\n")
        }
    }
}
