//! `hertz`: closed forms of a local contact between two long bars.

use super::arguments::{Format, Hertz};
use super::failure::Failure;
use super::input;
use super::json::SCHEMA_VERSION;
use super::table::Table;
use num_rational::BigRational;
use num_traits::One as _;
use serde_json::{Map, Value, json};
use wavestep::ball::Ball;
use wavestep::problem::{Problem, ProblemError, number};
use wavestep::scene::Dimension;
use wavestep_studies::hertz::{ContactOfScene, HertzError, distance_from_spring};

/// Bits beyond those of the digits.
const SPARE_BITS: u64 = 48;

impl From<HertzError> for Failure {
    fn from(error: HertzError) -> Failure {
        let remedy = match error {
            HertzError::Enclosure(_) => "give it one: --set NAME=VALUE",
            HertzError::NotPositive(..) => "let the left bar move towards the right one",
            HertzError::Share(_) => "give fractions such as 1/10,1/2,9/10",
            HertzError::Time(_) => "give times from 0 on",
            HertzError::Exponent(_) => "give an exponent such as 3/2",
            _ => "see `wavestep scenes local-contact` for an example",
        };
        Failure::usage(error.to_string(), remedy)
    }
}

/// Decimal places of the distance from the equivalent spring.
const PLACES: u32 = 6;

struct Row {
    name: String,
    key: String,
    value: Ball,
    unit: String,
    digits: usize,
}

pub fn run(options: &Hertz) -> Result<String, Failure> {
    input::digits(options.digits)?;
    let problem = input::problem(&options.scene)?;
    let scaled = problem.scaled().map_err(|error| match error {
        ProblemError::Equations(_) => HertzError::Recurrence.into(),
        error => Failure::from(error),
    })?;
    let bits = 10 * options.digits as u64 / 3 + SPARE_BITS;
    let contact = ContactOfScene::new(scaled, bits)?;
    let rows = Told { contact: &contact, problem: &problem, options, bits }.rows()?;
    let text = |row: &Row| row.value.to_decimal(row.digits).midpoint().to_string();
    let name = &scaled.scene().elements[contact.element].name;
    Ok(match options.format {
        Format::Json => {
            let mut values = Map::new();
            for row in &rows {
                let value = json!({ "value": text(row), "unit": row.unit });
                values.insert(row.key.clone(), value);
            }
            let value: Value =
                json!({ "schema_version": SCHEMA_VERSION, "contact": name, "values": values });
            format!("{value}\n")
        }
        Format::Csv => {
            let value =
                |row: &Row| json!({ "name": row.key, "value": text(row), "unit": row.unit });
            let values: Vec<Value> = rows.iter().map(value).collect();
            Table::of(&json!({ "values": values })).csv()
        }
        _ => {
            let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0);
            let line = |row: &Row| {
                let fill = " ".repeat(width - row.name.chars().count());
                let line = format!("{}{fill}  {} {}", row.name, text(row), row.unit);
                format!("{}\n", line.trim_end())
            };
            rows.iter().map(line).collect()
        }
    })
}

/// What is told of a contact, in the units of its scene.
struct Told<'a> {
    contact: &'a ContactOfScene,
    problem: &'a Problem,
    options: &'a Hertz,
    bits: u64,
}

impl Told<'_> {
    fn rows(&self) -> Result<Vec<Row>, Failure> {
        let mut rows = self.constants()?;
        for share in &self.options.rise {
            rows.extend(self.rise(share)?);
        }
        for time in &self.options.at {
            rows.push(self.force_at(time)?);
        }
        let until = self.contact.first_return.as_ref();
        rows.extend(until.map(|time| self.row("valid until", time, Dimension::TIME)));
        Ok(rows)
    }

    /// A value of a dimension; its key is its name with low lines.
    fn row(&self, name: &str, value: &Ball, dimension: Dimension) -> Row {
        let unit = if self.problem.has_units() { dimension.unit() } else { String::new() };
        let (key, digits) = (name.replace(' ', "_"), self.options.digits);
        Row { name: name.to_owned(), key, value: value.clone(), unit, digits }
    }

    fn constants(&self) -> Result<Vec<Row>, Failure> {
        let bars = &self.contact.bars;
        let exponent = bars.law.exponent();
        let unit_of_law = match (self.problem.has_units(), exponent.is_integer()) {
            (true, true) if exponent.is_one() => "N/m".to_owned(),
            (true, true) => format!("N/m^{exponent}"),
            (true, false) => format!("N/m^({exponent})"),
            (false, _) => String::new(),
        };
        let stiffness = self.row("stiffness", &bars.stiffness, Dimension::NONE);
        let distance = distance_from_spring(&bars.law, PLACES)?;
        Ok(vec![
            Row { unit: unit_of_law, ..stiffness },
            self.row("largest force", &bars.largest_force, Dimension::FORCE),
            self.row("largest compression", &bars.largest_compression, Dimension::LENGTH),
            Row {
                key: "time_unit".to_owned(),
                ..self.row("characteristic time", &bars.time_unit, Dimension::TIME)
            },
            self.row("equivalent spring", &bars.stiffness_of_spring(), Dimension::STIFFNESS),
            Row {
                key: "distance_from_spring".to_owned(),
                unit: "of the largest force".to_owned(),
                digits: self.options.digits.min(PLACES as usize - 2),
                ..self.row("its largest error in force", &distance, Dimension::NONE)
            },
        ])
    }

    /// The times in which the force rises to a share of its largest value, here and with the equivalent
    /// spring.
    fn rise(&self, share: &str) -> Result<[Row; 2], Failure> {
        let bars = &self.contact.bars;
        let (part, share) = (number("--rise", share)?, share.trim());
        let here = self.row(&format!("rise to {share}"), &bars.rise_time(&part)?, Dimension::TIME);
        let here = Row { key: format!("rise_to_{share}"), ..here };
        let name = format!("rise to {share}, equivalent spring");
        let time = bars.rise_time_of_spring(&part)?;
        let spring = self.row(&name, &time, Dimension::TIME);
        let rows = [here, Row { key: format!("spring_rise_to_{share}"), ..spring }];
        for row in &rows {
            told_past_return(self.contact, &row.name, &row.value);
        }
        Ok(rows)
    }

    fn force_at(&self, time: &str) -> Result<Row, Failure> {
        let (exact, text): (BigRational, &str) =
            (self.problem.time("--at", time.trim())?, time.trim());
        let at = Ball::from_rational(&exact, self.bits);
        let force = match num_traits::Zero::is_zero(&exact) {
            true => at.clone(),
            false => self.contact.bars.force(&at)?,
        };
        let row = self.row(&format!("force at {text}"), &force, Dimension::FORCE);
        told_past_return(self.contact, &row.name, &at);
        Ok(Row { key: format!("force_at_{text}"), ..row })
    }
}

/// Notes that a value belongs to a time at which waves from far ends are felt.
fn told_past_return(contact: &ContactOfScene, name: &str, time: &Ball) {
    if contact.first_return.as_ref().is_some_and(|until| until.is_below(time)) {
        eprintln!(
            "note: {name} assumes endless bars, but a wave from a far end returns earlier; `eval` takes \
             it into account"
        );
    }
}
