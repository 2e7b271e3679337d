//! Values at times: which times are asked for, and how the values are written.

use super::arguments::{Eval, Format};
use super::failure::Failure;
use super::json::SCHEMA_VERSION;
use num_rational::BigRational;
use num_traits::{Signed as _, ToPrimitive as _};
use serde_json::{Value as Json, json};
use wavestep::ball::{Decimal, Exactness};
use wavestep::problem::{self, Problem, Wanted, evenly_spaced};
use wavestep::scene::Dimension;
use wavestep::signal::{Limit, Value};
use wavestep_studies::told::Teller;

/// The most times that are evaluated at once.
const MAX_POINTS: usize = 1_000_000;

/// Times whose fraction is longer are written in decimals: all of them where these are no more, else with at least those of
/// a double.
const MAX_FRACTION: usize = 40;
const TIME_DIGITS: usize = 17;

/// More digits than a ball of the highest precision has.
pub const ALL_DIGITS: usize = 1 << 30;

/// What is told of one quantity or of several: lines below each other, columns with the name before each row, a list of
/// documents.
pub struct Told {
    format: Format,
    several: bool,
    parts: Vec<String>,
}

impl Told {
    pub fn new(format: Format, count: usize) -> Told {
        Told { format, several: count > 1, parts: Vec::new() }
    }

    pub fn add(&mut self, name: &str, told: String) {
        let is_first = self.parts.is_empty();
        self.parts.push(match self.format {
            Format::Csv if self.several => {
                let rows = told.lines().enumerate().filter(|(row, _)| is_first || *row > 0);
                let named = |(row, line)| match row {
                    0 => format!("quantity,{line}\n"),
                    _ => format!("{name},{line}\n"),
                };
                rows.map(named).collect()
            }
            _ => told,
        });
    }

    pub fn all(self) -> String {
        match self.format {
            Format::Json if self.several => {
                let documents: Vec<&str> = self.parts.iter().map(|part| part.trim_end()).collect();
                format!("[{}]\n", documents.join(",\n"))
            }
            _ => self.parts.concat(),
        }
    }
}

pub fn times(problem: &Problem, name: &str, options: &Eval) -> Result<Vec<BigRational>, Failure> {
    if let (Some(n), Some(local)) = (options.piece, &options.local) {
        let wanted = problem.wanted(name)?;
        let local = problem::number("--local", local)?;
        return Ok(vec![problem.time_on_period(&wanted, n, &local, options.side)?]);
    }
    if let (Some(from), Some(to)) = (&options.from, &options.to) {
        let from = problem.time("--from", from.as_str())?;
        let to = problem.time("--to", to.as_str())?;
        // One instant will do.
        if from != to {
            problem.between(from.clone(), to.clone())?;
        }
        let quantity = |step: &String| problem.quantity("--step", step.as_str(), Dimension::TIME);
        let step = options.step.as_ref().map(quantity).transpose()?;
        let points = match &step {
            Some(step) => steps(&(&to - &from), step)? + 1,
            None => options.points.unwrap_or(0),
        };
        if points == 0 || points > MAX_POINTS {
            let message = format!("{points} points cannot be evaluated at once");
            return Err(Failure::usage(message, format!("give 1 to {MAX_POINTS} points")));
        }
        let last = step.map(|step| &from + step * BigRational::from_integer((points - 1).into()));
        return Ok(evenly_spaced(&from, last.as_ref().unwrap_or(&to), points));
    }
    if options.at.is_empty() {
        let remedy =
            "give --at T, or --from T --to T with --points N or --step DT, or --piece N --local S";
        return Err(Failure::usage("no times are given", remedy));
    }
    if options.at.iter().any(|time| time.trim().is_empty()) {
        let remedy = "write them with single commas between: --at 1,2";
        return Err(Failure::usage("a time is missing in --at", remedy));
    }
    options.at.iter().map(|time| Ok(problem.time("--at", time.as_str())?)).collect()
}

/// How many steps fit into a window; as many as are refused, where they are more.
fn steps(length: &BigRational, step: &BigRational) -> Result<usize, Failure> {
    if !step.is_positive() {
        return Err(Failure::usage("the step is not positive", "write --step 1/10"));
    }
    Ok((length / step).to_integer().to_usize().unwrap_or(MAX_POINTS))
}

pub fn written(
    problem: &Problem,
    wanted: &Wanted,
    rows: (&[BigRational], &[Value]),
    options: &Eval,
) -> String {
    match options.format {
        Format::Csv => {
            let line = |value: &Value| match value {
                Value::Enclosed(_) => ",undecided".to_owned(),
                _ => {
                    let (decimal, exactness) = value.decimal(options.digits);
                    format!("{decimal},{}", exactness == Exactness::Exact)
                }
            };
            let rows = rows.0.iter().zip(rows.1.iter().map(line));
            csv(problem, wanted, (rows, "value,exact"), options)
        }
        Format::Json => json_document(problem, wanted, rows, options),
        _ => {
            let teller = Teller { problem, digits: options.digits, longest_fraction: usize::MAX };
            let values = rows.1.iter().map(|value| teller.number(value));
            lines(problem, wanted, rows.0.iter().zip(values), options)
        }
    }
}

pub fn lines<'a>(
    problem: &Problem,
    wanted: &Wanted,
    rows: impl Iterator<Item = (&'a BigRational, String)>,
    options: &Eval,
) -> String {
    let limit = if options.side == Limit::Left { "-" } else { "" };
    let spaced = |unit: &str| if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let (unit, second) = (spaced(&wanted.unit()), spaced(problem.time_unit()));
    let line = |(time, value): (&BigRational, String)| {
        let fraction = time.to_string();
        let is_short = second.is_empty() && fraction.len() <= MAX_FRACTION;
        let time = match Decimal::from_rational(time, MAX_FRACTION) {
            _ if is_short => fraction,
            (decimal, Exactness::Exact) => decimal.to_string(),
            _ => rounded(time, options.digits).to_string(),
        };
        format!("{}({time}{second}{limit}) = {value}{unit}\n", wanted.name)
    };
    rows.map(line).collect()
}

/// A row for each time, with the unit of its value where the scene has units.
pub fn csv<'a>(
    problem: &Problem,
    wanted: &Wanted,
    (rows, columns): (impl Iterator<Item = (&'a BigRational, String)>, &str),
    options: &Eval,
) -> String {
    let [header, unit] = match problem.has_units() {
        true => [",unit".to_owned(), format!(",{}", wanted.unit())],
        false => Default::default(),
    };
    let line = |(time, values): (&BigRational, String)| {
        format!("{time},{},{values}{unit}\n", rounded(time, options.digits))
    };
    std::iter::once(format!("time,time_decimal,{columns}{header}\n"))
        .chain(rows.map(line))
        .collect()
}

/// A time in decimals, with so many digits and at least those of a double.
fn rounded(time: &BigRational, digits: usize) -> Decimal {
    Decimal::from_rational(time, digits.max(TIME_DIGITS)).0
}

fn json_document(
    problem: &Problem,
    wanted: &Wanted,
    (times, values): (&[BigRational], &[Value]),
    options: &Eval,
) -> String {
    let rows = times.iter().zip(values);
    let values: Vec<Json> =
        rows.map(|(time, value)| json_value(time, value, options.digits)).collect();
    let document = json!({
        "schema_version": SCHEMA_VERSION,
        "title": problem.title(),
        "quantity": wanted.name,
        "set": options.scene.set,
        "digits": options.digits,
        "side": if options.side == Limit::Left { "left" } else { "right" },
        "values": values,
    });
    format!("{}\n", with_units(document, problem, wanted))
}

/// A document with the units of values and times, where the scene has units.
pub fn with_units(mut document: Json, problem: &Problem, wanted: &Wanted) -> Json {
    if problem.has_units() {
        document["unit"] = json!(wanted.unit());
        document["time_unit"] = json!(problem.time_unit());
    }
    document
}

/// `value` has the digits asked for, correctly rounded. `midpoint` and `radius` enclose the number
/// with every digit that is proven; an exact value is given as a fraction instead, and one that stays undecided has no
/// `value`.
fn json_value(time: &BigRational, value: &Value, digits: usize) -> Json {
    let (decimal, _) = value.decimal(digits);
    let (time, decimal) = (time.to_string(), decimal.to_string());
    match value {
        Value::Exact(value) => {
            json!({"time": time, "value": decimal, "exact": value.to_string(), "radius": "0"})
        }
        Value::Certified { ball, .. } | Value::Enclosed(ball) => {
            let enclosure = ball.to_decimal(ALL_DIGITS);
            let is_decided = !matches!(value, Value::Enclosed(_));
            json!({
                "time": time,
                "value": is_decided.then_some(decimal),
                "midpoint": enclosure.midpoint().to_string(),
                "radius": format!("{:e}", enclosure.radius()),
            })
        }
    }
}
