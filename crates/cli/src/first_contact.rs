//! `derive` where a local contact is: the closed form of its first contact.

use super::arguments::{Derive, Format};
use super::failure::Failure;
use super::json::SCHEMA_VERSION;
use serde_json::{Map, Value, json};
use wavestep::ball::Ball;
use wavestep::export::{self, Formula};
use wavestep::problem::{Orders, Problem};
use wavestep::scene::Dimension;
use wavestep_studies::hertz::ContactOfScene;

/// Significant digits of the numbers beside formulas, and bits enough for them.
const DIGITS: usize = 6;
const BITS: u64 = 64;

/// `None` where there is no local contact, or something else of the scene is asked for.
pub fn derive(problem: &Problem, options: &Derive) -> Result<Option<String>, Failure> {
    let is_of_other = options.quantity.is_some()
        || options.general
        || options.explain
        || options.source_form
        || options.from > 0
        || matches!(options.orders(), Some(Orders::Only(n)) if n > 0);
    if is_of_other {
        return Ok(None);
    }
    let Some(formulas) = problem.first_contact()? else { return Ok(None) };
    Ok(Some(written(problem, &formulas, options)?))
}

fn written(problem: &Problem, formulas: &[Formula], options: &Derive) -> Result<String, Failure> {
    let text: String = formulas.iter().map(|formula| formula.to_text(options.width())).collect();
    let numbers = numbers(problem);
    let (mark, body) = match options.format {
        Format::Json => return Ok(document(problem, formulas, &numbers)),
        Format::Latex => ("%", export::latex(formulas, options.width())),
        _ => ("#", text.clone()),
    };
    let mut lines = problem.constants(Some(&text))?;
    let number = |(name, value, unit): &(&str, String, String)| {
        format!("{name} = {value} {unit}").trim_end().to_owned()
    };
    lines.extend(numbers.iter().map(number));
    let lines: String = lines.iter().map(|line| format!("{mark} {line}\n")).collect();
    Ok(lines + &body)
}

/// The largest force and compression and the unit of time, where all in them is known.
fn numbers(problem: &Problem) -> Vec<(&'static str, String, String)> {
    let contact = problem.scaled().ok().and_then(|scaled| ContactOfScene::new(scaled, BITS).ok());
    let Some(ContactOfScene { bars, first_return, .. }) = contact else { return Vec::new() };
    let number = |name, value: &Ball, dimension: Dimension| {
        let unit = if problem.has_units() { dimension.unit() } else { String::new() };
        (name, value.to_decimal(DIGITS).midpoint().to_string(), unit)
    };
    let mut numbers = vec![
        number("X_max", &bars.largest_force, Dimension::FORCE),
        number("alpha_max", &bars.largest_compression, Dimension::LENGTH),
        number("T", &bars.time_unit, Dimension::TIME),
    ];
    numbers.extend(first_return.map(|time| number("until t", &time, Dimension::TIME)));
    numbers
}

fn document(problem: &Problem, formulas: &[Formula], numbers: &[(&str, String, String)]) -> String {
    let formula = |formula: &Formula| {
        let remark = formula.remark.as_ref().map(|(text, _)| text);
        json!({"formula": formula.to_line(), "remark": remark})
    };
    let numbers: Map<String, Value> = (numbers.iter())
        .map(|(name, value, unit)| (name.replace(' ', "_"), json!({"value": value, "unit": unit})))
        .collect();
    let document = json!({
        "schema_version": SCHEMA_VERSION,
        "title": problem.title(),
        "form": "first contact",
        "contact": problem.local_contact(),
        "formulas": formulas.iter().map(formula).collect::<Vec<_>>(),
        "values": numbers,
    });
    format!("{document}\n")
}
