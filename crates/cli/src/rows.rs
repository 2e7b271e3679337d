//! Values at times: which times are asked for, and how the values are written.

use super::arguments::{Eval, EvalFormat};
use super::failure::Failure;
use super::input;
use super::json::SCHEMA_VERSION;
use num_integer::Integer as _;
use num_rational::BigRational;
use num_traits::Signed as _;
use serde_json::{Value as Json, json};
use wavestep::ball::{Decimal, Exactness};
use wavestep::evaluate::{Limit, Value};
use wavestep_polynomial::fraction;

/// The most times that are evaluated at once.
pub const MAX_POINTS: usize = 1_000_000;

/// The most digits of a time in decimals.
const TIME_DIGITS: usize = 17;

/// More digits than a ball of the highest precision has.
pub const ALL_DIGITS: usize = 1 << 30;

/// One value with its time.
pub struct Row {
    /// The time.
    pub time: BigRational,
    /// The value then.
    pub value: Value,
}

/// `n` periods and the local time on the next.
pub fn time_on_period(
    n: usize,
    local: &str,
    period: &BigRational,
    side: Limit,
) -> Result<BigRational, Failure> {
    let local = input::number("--local", local)?;
    let inside =
        !local.is_negative() && (local < *period || (local == *period && side == Limit::Left));
    if !inside {
        let message = format!("the local time {local} lies outside the period");
        let remedy = format!("give 0 <= S < {period}, or S = {period} with --side left");
        return Err(Failure::usage(message, remedy));
    }
    Ok(period * BigRational::from_integer(n.into()) + local)
}

/// The scene times asked for.
pub fn times(options: &Eval, dimensional: bool) -> Result<Vec<BigRational>, Failure> {
    if let (Some(from), Some(to), Some(points)) = (&options.from, &options.to, options.points) {
        let (from, to) =
            (input::time("--from", from, dimensional)?, input::time("--to", to, dimensional)?);
        if to < from {
            let message = format!("the window from {from} to {to} is empty");
            return Err(Failure::usage(message, "give --from before --to"));
        }
        if points == 0 || points > MAX_POINTS {
            let message = format!("{points} points cannot be evaluated at once");
            return Err(Failure::usage(message, format!("ask for 1 to {MAX_POINTS} points")));
        }
        return Ok(evenly_spaced(&from, &to, points));
    }
    if options.at.is_empty() {
        let remedy = "give --at T, or --from T --to T --points N, or --piece N --local S";
        return Err(Failure::usage("no time is given", remedy));
    }
    options.at.iter().map(|time| input::time("--at", time, dimensional)).collect()
}

/// So many times from the first to the last, over one denominator before they are reduced.
fn evenly_spaced(from: &BigRational, to: &BigRational, points: usize) -> Vec<BigRational> {
    let step = (to - from) / BigRational::from_integer((points.max(2) - 1).into());
    let denominator = from.denom().lcm(step.denom());
    let [first, stride] = [from, &step].map(|value| value.numer() * (&denominator / value.denom()));
    (0..points).map(|i| fraction(&first + &stride * i, denominator.clone())).collect()
}

/// Rows in the format asked for, with the unit of time, the unit after a space, and the unit.
pub fn written(
    rows: &[Row],
    title: &str,
    [second, spaced, unit]: [&str; 3],
    options: &Eval,
) -> String {
    match options.format {
        EvalFormat::Text => text(rows, options, [second, spaced]),
        EvalFormat::Csv => csv(rows, options.digits),
        EvalFormat::Json => json_document(title, rows, options, unit),
    }
}

/// A time with a unit, in decimals where these are exact.
pub fn in_decimals(time: &BigRational) -> String {
    match Decimal::from_rational(time, TIME_DIGITS) {
        (decimal, Exactness::Exact) => decimal.to_string(),
        _ => time.to_string(),
    }
}

/// Lines of text, with the units of time and value.
fn text(rows: &[Row], options: &Eval, [second, unit]: [&str; 2]) -> String {
    let limit = if options.side == Limit::Left { "-" } else { "" };
    let line = |row: &Row| {
        let value = row.value.to_text(options.digits);
        let time = match second.is_empty() {
            true => row.time.to_string(),
            false => in_decimals(&row.time),
        };
        format!("{}({time}{second}{limit}) = {value}{unit}\n", options.quantity)
    };
    rows.iter().map(line).collect()
}

/// Columns with a heading.
fn csv(rows: &[Row], digits: usize) -> String {
    let line = |row: &Row| {
        let (decimal, exactness) = row.value.decimal(digits);
        let exact = exactness == Exactness::Exact;
        let time = Decimal::from_rational(&row.time, digits.max(17)).0;
        format!("{},{time},{decimal},{exact}\n", row.time)
    };
    std::iter::once("time,time_decimal,value,exact\n".to_owned())
        .chain(rows.iter().map(line))
        .collect()
}

/// Decimal strings with proven radii.
fn json_document(title: &str, rows: &[Row], options: &Eval, unit: &str) -> String {
    let values: Vec<Json> = rows.iter().map(|row| json_value(row, options.digits)).collect();
    let mut document = json!({
        "schema_version": SCHEMA_VERSION,
        "title": title,
        "quantity": options.quantity,
        "set": options.scene.set,
        "digits": options.digits,
        "side": if options.side == Limit::Left { "left" } else { "right" },
        "values": values,
    });
    if !unit.is_empty() {
        document["unit"] = json!(unit);
        document["time_unit"] = json!("s");
    }
    format!("{document}\n")
}

/// `value` has the digits asked for, correctly rounded. `midpoint` and `radius` enclose the number
/// with every digit that is proven; an exact value is given as a fraction instead.
fn json_value(row: &Row, digits: usize) -> Json {
    let (decimal, _) = row.value.decimal(digits);
    let (time, decimal) = (row.time.to_string(), decimal.to_string());
    match &row.value {
        Value::Exact(value) => {
            json!({"time": time, "value": decimal, "exact": value.to_string(), "radius": "0"})
        }
        Value::Certified { ball, .. } | Value::Enclosed(ball) => {
            let enclosure = ball.to_decimal(ALL_DIGITS);
            json!({
                "time": time,
                "value": decimal,
                "midpoint": enclosure.midpoint().to_string(),
                "radius": format!("{:e}", enclosure.radius()),
            })
        }
    }
}
