//! `find --equal`: the value of a symbol for which extrema in two windows are equal.

use super::arguments::{Find, Format};
use super::failure::{ACCURACY, Failure};
use super::input;
use super::json::SCHEMA_VERSION;
use super::progress;
use num_rational::BigRational;
use serde_json::json;
use wavestep::ball::{Ball, Decimal};
use wavestep::language;
use wavestep::problem::{Crossing, EqualExtrema, number};
use wavestep::signal::Goal;

pub fn run(options: &Find) -> Result<String, Failure> {
    let (goal, name) = options.extremum().expect("arguments conflict with roots");
    let (symbol, range) = symbol(options.equal.as_deref().unwrap_or_default())?;
    let times = options.between.as_deref().unwrap_or_default();
    let times: Vec<&str> = times.split(',').map(str::trim).collect();
    let Ok(times) = <[&str; 3]>::try_from(times) else {
        let message = "`--between` needs three times";
        return Err(Failure::usage(message, "write --between T1,T2,T3"));
    };
    let mut values = input::values(&options.scene.set)?;
    if values.insert(symbol.clone(), range[0].clone()).is_some() {
        return Err(input::two_values(&symbol));
    }
    let problem = input::problem_with(&options.scene.scene, &values)?;
    let (symbol, digits) = (&*symbol, options.digits);
    let asked = EqualExtrema { name, goal, symbol, range, times, times_name: "--between", digits };
    let found = {
        let _progress = progress::spinner("bisecting");
        problem.equal_extrema(&asked)?
    };
    let report = written(&asked, &found, options);
    match found.undecided {
        None => Ok(report),
        Some(bits) => {
            let message = format!("extrema cannot be told apart with {bits} bits in this range");
            Err(Failure::new(ACCURACY, message, "use fewer digits").with_report(report))
        }
    }
}

/// `SYMBOL=LOW..HIGH`.
fn symbol(text: &str) -> Result<(String, [BigRational; 2]), Failure> {
    let parts =
        text.split_once('=').and_then(|(name, range)| Some((name, range.split_once("..")?)));
    let Some((name, (low, high))) = parts.filter(|(name, _)| !name.trim().is_empty()) else {
        let message = format!("`--equal {text}` is not a symbol with a range");
        return Err(Failure::usage(message, "write --equal SYMBOL=LOW..HIGH"));
    };
    let (low, high) = (number("--equal", low)?, number("--equal", high)?);
    if high <= low {
        let message = format!("the range from {low} to {high} is empty");
        return Err(Failure::usage(message, "give the lower bound first"));
    }
    Ok((language::normalise_name(name.trim()), [low, high]))
}

fn written(asked: &EqualExtrema<'_>, found: &Crossing, options: &Find) -> String {
    let (low, high) = (&found.low, &found.high);
    let digits = asked.digits;
    let bits = 8 * digits as u64 + 64;
    let which = if asked.goal == Goal::Largest { "largest" } else { "smallest" };
    let (quantity, name) = (asked.name, asked.symbol);
    let [first, second, third] = asked.times;
    let enclosure = Ball::between(low, high, bits).to_decimal(digits + 2);
    match options.format {
        Format::Json => {
            let (low, high) = (low.to_string(), high.to_string());
            let document = json!({
                "schema_version": SCHEMA_VERSION,
                "quantity": quantity,
                "goal": which,
                "symbol": name,
                "set": options.scene.set,
                "between": asked.times,
                "low": low,
                "high": high,
            });
            format!("{document}\n")
        }
        Format::Csv => {
            let [a, b] = [low, high].map(|end| Decimal::from_rational(end, digits + 2).0);
            format!("symbol,low,high,low_decimal,high_decimal\n{name},{low},{high},{a},{b}\n")
        }
        _ => format!(
            "{name} = {enclosure}\n\
             The {which} {quantity} for {first} <= t < {second} and for {second} <= t < {third} \
             change places there.\nOther such values in the range are not excluded.\n"
        ),
    }
}
