//! `field`: velocity, strain, displacement and force along the bars at a time.

use super::arguments::{Field, Format};
use super::failure::Failure;
use super::input;
use super::json::SCHEMA_VERSION;
use super::output::written;
use super::progress;
use super::validity::note_pulling;
use serde_json::{Value as Json, json};
use std::fmt::Write as _;
use wavestep::field::{BarFields, Bounded, Fields, Mesh, Quantity, Sampling};
use wavestep::language;
use wavestep::problem::Problem;
use wavestep::scene::Dimension;
use wavestep::signal::Limit;

pub fn run(options: &Field) -> Result<String, Failure> {
    let problem = input::problem(&options.scene)?;
    if options.at.as_str().contains(',') {
        let remedy = "ask for one after the other, or draw several with `wavestep plot --at`";
        return Err(Failure::usage("a field is told at one time", remedy));
    }
    let time = problem.time("--at", options.at.as_str())?;
    let mut mesh = Mesh::new(options.mesh)?.with_limit(options.side);
    if options.averages {
        mesh = mesh.averages();
    }
    for bar in &options.bar {
        mesh = mesh.only(&language::normalise_name(bar));
    }
    if let Some(reach) = &options.reach {
        let reach = problem.quantity("--reach", reach.as_str(), Dimension::LENGTH)?;
        mesh = mesh.reaching(&reach)?;
    }
    let progress = progress::spinner("evaluating");
    let fields = problem.field_evaluator(&time)?.at(&time, &mesh)?;
    drop(progress);
    note_pulling(&problem, &time);
    let text = match options.format {
        Format::Json => json_document(&fields, &problem, options),
        _ => csv(&fields, problem.has_units()),
    };
    written(text, options.output.output.as_deref())
}

/// The places of a row: a node, or the two ends of a cell.
fn places(bar: &BarFields, sampling: Sampling) -> impl Iterator<Item = &[f64]> {
    bar.x.windows(if sampling == Sampling::Nodes { 1 } else { 2 })
}

/// A row for each place, with the units of columns in their names where the scene has units.
fn csv(fields: &Fields, has_units: bool) -> String {
    let column = |name: &str, unit: &str| match has_units && !unit.is_empty() {
        true => format!(",{name} [{unit}]"),
        false => format!(",{name}"),
    };
    let ends: &[&str] = match fields.sampling {
        Sampling::Nodes => &["x"],
        Sampling::Averages => &["x_left", "x_right"],
    };
    let mut text = "bar".to_owned();
    ends.iter().for_each(|place| text += &column(place, "m"));
    for quantity in Quantity::ALL {
        let (name, unit) = (quantity.name(), quantity.dimension().unit());
        text += &column(name, &unit);
        text += &column(&format!("{name}_bound"), &unit);
    }
    text.push('\n');
    for bar in &fields.bars {
        for (row, place) in places(bar, fields.sampling).enumerate() {
            text += &bar.name;
            for x in place {
                let _ = write!(text, ",{x:?}");
            }
            for quantity in Quantity::ALL {
                let Bounded { value, bound } = bar.of(quantity)[row];
                let _ = write!(text, ",{value:?},{bound:?}");
            }
            text.push('\n');
        }
    }
    text
}

fn json_document(fields: &Fields, problem: &Problem, options: &Field) -> String {
    let bar = |bar: &BarFields| {
        let mut told = json!({"bar": bar.name, "x": bar.x});
        for quantity in Quantity::ALL {
            let values = bar.of(quantity);
            let of = |which: fn(&Bounded) -> f64| values.iter().map(which).collect::<Vec<f64>>();
            told[quantity.name()] = json!(of(|value| value.value));
            told[format!("{}_bound", quantity.name())] = json!(of(|value| value.bound));
        }
        told
    };
    let mut document = json!({
        "schema_version": SCHEMA_VERSION,
        "title": problem.title(),
        "set": options.scene.set,
        "time": fields.time.to_string(),
        "sampling": if fields.sampling == Sampling::Nodes { "nodes" } else { "averages" },
        "side": if fields.side == Limit::Left { "left" } else { "right" },
        "bars": fields.bars.iter().map(bar).collect::<Vec<Json>>(),
    });
    if fields.dimensional {
        let unit =
            |quantity: &Quantity| (quantity.name().to_owned(), json!(quantity.dimension().unit()));
        let units = Quantity::ALL.iter().map(unit).collect::<serde_json::Map<_, _>>();
        document["time_unit"] = json!("s");
        document["x_unit"] = json!("m");
        document["units"] = Json::Object(units);
    }
    format!("{document}\n")
}
