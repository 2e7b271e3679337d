//! `hertz`: closed forms of a local contact between two long bars.

use super::arguments::{Hertz, HertzFormat};
use super::failure::Failure;
use super::input;
use super::json::SCHEMA_VERSION;
use num_rational::BigRational;
use num_traits::One as _;
use serde_json::{Map, Value, json};
use wavestep::ball::Ball;
use wavestep::problem::{Problem, ProblemError, number};
use wavestep::scene::Dimension;
use wavestep_studies::hertz::{ContactOfScene, HertzError, NoContact, distance_from_spring};

/// Bits beyond those of the digits.
const SPARE_BITS: u64 = 48;

impl From<HertzError> for Failure {
    fn from(error: HertzError) -> Failure {
        let remedy = match error {
            HertzError::Enclosure(_) => "give it one: --set NAME=VALUE",
            HertzError::NotPositive(..) => "let the left bar run into the right one",
            HertzError::Share(_) => "give shares such as 1/10,1/2,9/10",
            HertzError::Time(_) => "give times from 0 on",
            HertzError::Exponent(_) => "give an exponent such as 3/2",
            _ => "see `wavestep scenes local-contact` for an example",
        };
        Failure::usage(error.to_string(), remedy)
    }
}

/// Decimal places of the distance from the equivalent spring.
const PLACES: u32 = 6;

/// A value with its name, what it is in JSON, its unit, and how many digits of it are told.
struct Row {
    name: String,
    key: String,
    value: Ball,
    unit: String,
    digits: usize,
}

/// Tells what is asked for.
pub fn run(options: &Hertz) -> Result<String, Failure> {
    input::digits(options.digits)?;
    let problem = input::problem(&options.scene)?;
    let scaled = problem.scaled().map_err(|error| match error {
        ProblemError::Equations(_) => HertzError::Scene(NoContact::Recurrence).into(),
        error => Failure::from(error),
    })?;
    let bits = 10 * options.digits as u64 / 3 + SPARE_BITS;
    let contact = ContactOfScene::new(scaled, bits)?;
    let rows = rows(&contact, &problem, options, bits)?;
    let text = |row: &Row| row.value.to_decimal(row.digits).midpoint().to_string();
    let name = &scaled.scene().elements[contact.element].name;
    Ok(match options.format {
        HertzFormat::Text => {
            let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0);
            let line = |row: &Row| {
                let fill = " ".repeat(width - row.name.chars().count());
                let line = format!("{}{fill}  {} {}", row.name, text(row), row.unit);
                format!("{}\n", line.trim_end())
            };
            rows.iter().map(line).collect()
        }
        HertzFormat::Json => {
            let mut values = Map::new();
            for row in &rows {
                let value = json!({ "value": text(row), "unit": row.unit });
                values.insert(row.key.clone(), value);
            }
            let value: Value =
                json!({ "schema_version": SCHEMA_VERSION, "contact": name, "values": values });
            format!("{value}\n")
        }
    })
}

/// All values that are told.
fn rows(
    contact: &ContactOfScene,
    problem: &Problem,
    options: &Hertz,
    bits: u64,
) -> Result<Vec<Row>, Failure> {
    let dimensional = problem.has_units();
    let bars = &contact.bars;
    let spring = bars.equivalent_spring();
    let unit = |dimension: Dimension| match dimensional {
        true => dimension.unit(),
        false => String::new(),
    };
    let row = |name: String, key: String, value: &Ball, unit: String| Row {
        name,
        key,
        value: value.clone(),
        unit,
        digits: options.digits,
    };
    let fixed = |name: &str, key: &str, value: &Ball, dimension| {
        row(name.to_owned(), key.to_owned(), value, unit(dimension))
    };
    let exponent = bars.law().exponent();
    let unit_of_law = match (dimensional, exponent.is_integer()) {
        (true, true) if exponent.is_one() => "N/m".to_owned(),
        (true, true) => format!("N/m^{exponent}"),
        (true, false) => format!("N/m^({exponent})"),
        (false, _) => String::new(),
    };
    let mut rows = vec![
        row("stiffness".to_owned(), "stiffness".to_owned(), bars.stiffness(), unit_of_law),
        fixed("largest force", "largest_force", bars.largest_force(), Dimension::FORCE),
        fixed(
            "largest compression",
            "largest_compression",
            bars.largest_compression(),
            Dimension::LENGTH,
        ),
        fixed("characteristic time", "time_unit", bars.time_unit(), Dimension::TIME),
        fixed("equivalent spring", "equivalent_spring", spring.stiffness(), Dimension::STIFFNESS),
        Row {
            digits: options.digits.min(PLACES as usize - 2),
            ..row(
                "its force is off by at most".to_owned(),
                "distance_from_spring".to_owned(),
                &distance_from_spring(bars.law(), PLACES)?,
                "of the largest force".to_owned(),
            )
        },
    ];
    for text in &options.rise {
        let share = number("--rise", text)?;
        let text = text.trim();
        let times = [
            (format!("rise to {text}"), format!("rise_to_{text}"), bars.rise_time(&share)?),
            (
                format!("rise to {text}, equivalent spring"),
                format!("spring_rise_to_{text}"),
                spring.rise_time(&share)?,
            ),
        ];
        for (name, key, time) in times {
            told_past_return(contact, &name, &time);
            rows.push(row(name, key, &time, unit(Dimension::TIME)));
        }
    }
    for text in &options.at {
        let text = text.trim();
        let time: BigRational = problem.time("--at", text)?;
        let at = Ball::from_rational(&time, bits);
        let force = match num_traits::Zero::is_zero(&time) {
            true => at.clone(),
            false => bars.force(&at)?,
        };
        let name = format!("force at {text}");
        told_past_return(contact, &name, &at);
        rows.push(row(name, format!("force_at_{text}"), &force, unit(Dimension::FORCE)));
    }
    if let Some(time) = &contact.first_return {
        rows.push(fixed("valid until", "valid_until", time, Dimension::TIME));
    }
    Ok(rows)
}

/// Notes that a value belongs to a time at which waves from far ends are felt.
fn told_past_return(contact: &ContactOfScene, name: &str, time: &Ball) {
    if contact.first_return.as_ref().is_some_and(|until| until.is_below(time)) {
        eprintln!(
            "note: {name} is that of endless bars, and a wave from a far end is felt earlier; `eval` \
             follows it"
        );
    }
}
