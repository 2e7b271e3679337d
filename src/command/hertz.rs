//! `hertz`: closed forms of a local contact between two long bars.

use super::arguments::{Hertz, HertzFormat};
use super::failure::Failure;
use super::input::{self, Readable, Subject};
use num_rational::BigRational;
use serde_json::{Map, Value, json};
use wavestep::ball::Ball;
use wavestep::export::SCHEMA_VERSION;
use wavestep::hertz::{ContactOfScene, HertzError};
use wavestep::language::unit_of;
use wavestep::network::ScaledScene;
use wavestep::scene::Dimension;

/// Bits beyond those of the digits.
const SPARE_BITS: u64 = 48;

impl From<HertzError> for Failure {
    fn from(error: HertzError) -> Failure {
        let remedy = match error {
            HertzError::Enclosure(_) => "give it one: --set NAME=VALUE",
            HertzError::NotPositive(..) => "let the left bar run into the right one",
            HertzError::Share(_) => "give shares such as 1/10,1/2,9/10",
            HertzError::Time(_) => "give times from 0 on",
            _ => "see `wavestep scenes local-contact` for an example",
        };
        Failure::usage(error.to_string(), remedy)
    }
}

/// A value with its name, what it is in JSON, and its dimension.
struct Row {
    name: String,
    key: String,
    value: Ball,
    dimension: Dimension,
}

/// Tells what is asked for.
pub fn run(options: &Hertz) -> Result<String, Failure> {
    input::digits(options.digits)?;
    let scaled = match input::readable(&options.scene)? {
        Readable::WithoutRecurrence(scaled) => *scaled,
        Readable::Subject(Subject::Scene(network)) => {
            let scaled: &ScaledScene = (*network).as_ref();
            scaled.clone()
        }
        Readable::Subject(Subject::Recurrence(_)) => {
            return Err(HertzError::Scene("a recurrence has no contact; give a scene").into());
        }
    };
    let bits = 10 * options.digits as u64 / 3 + SPARE_BITS;
    let contact = ContactOfScene::new(&scaled, bits)?;
    let dimensional = scaled.scene().dimensional;
    let rows = rows(&contact, options, dimensional, bits)?;
    let digits = options.digits;
    let text = |ball: &Ball| ball.to_decimal(digits).midpoint().to_string();
    let unit = |dimension: Dimension| match dimensional {
        true => unit_of(dimension),
        false => String::new(),
    };
    let name = &scaled.scene().elements[contact.element].name;
    Ok(match options.format {
        HertzFormat::Text => {
            let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0);
            let line = |row: &Row| {
                let fill = " ".repeat(width - row.name.chars().count());
                let line =
                    format!("{}{fill}  {} {}", row.name, text(&row.value), unit(row.dimension));
                format!("{}\n", line.trim_end())
            };
            rows.iter().map(line).collect()
        }
        HertzFormat::Json => {
            let mut values = Map::new();
            for row in &rows {
                let value = json!({ "value": text(&row.value), "unit": unit(row.dimension) });
                values.insert(row.key.clone(), value);
            }
            let value: Value =
                json!({ "schema": SCHEMA_VERSION, "contact": name, "values": values });
            format!("{value}\n")
        }
    })
}

/// All values that are told.
fn rows(
    contact: &ContactOfScene,
    options: &Hertz,
    dimensional: bool,
    bits: u64,
) -> Result<Vec<Row>, Failure> {
    let bars = &contact.bars;
    let spring = bars.equivalent_spring();
    let row =
        |name: String, key: String, value: Ball, dimension| Row { name, key, value, dimension };
    let fixed = |name: &str, key: &str, value: &Ball, dimension| {
        row(name.to_owned(), key.to_owned(), value.clone(), dimension)
    };
    let mut rows = vec![
        fixed("largest force", "largest_force", bars.largest_force(), Dimension::FORCE),
        fixed(
            "largest compression",
            "largest_compression",
            bars.largest_compression(),
            Dimension::LENGTH,
        ),
        fixed("characteristic time", "time_unit", bars.time_unit(), Dimension::TIME),
        fixed("equivalent spring", "equivalent_spring", spring.stiffness(), Dimension::STIFFNESS),
    ];
    for text in &options.rise {
        let share = input::number("--rise", text)?;
        let time = bars.rise_time(&share)?;
        rows.push(row(
            format!("rise to {share}"),
            format!("rise_to_{share}"),
            time,
            Dimension::TIME,
        ));
        rows.push(row(
            format!("rise to {share}, equivalent spring"),
            format!("spring_rise_to_{share}"),
            spring.rise_time(&share)?,
            Dimension::TIME,
        ));
    }
    for text in &options.at {
        let time: BigRational = input::time("--at", text, dimensional)?;
        let at = Ball::from_rational(&time, bits);
        let is_start = num_traits::Zero::is_zero(&time);
        let force = match is_start {
            true => Ball::from_rational(&time, bits),
            false => bars.force(&at)?,
        };
        rows.push(row(
            format!("force at {text}"),
            format!("force_at_{text}"),
            force,
            Dimension::FORCE,
        ));
    }
    if let Some(time) = &contact.first_return {
        rows.push(fixed("valid until", "valid_until", time, Dimension::TIME));
    }
    Ok(rows)
}
