//! `book`: the equations of the source with their verdicts.

use super::arguments::{Book, Format};
use super::failure::Failure;
use super::json::SCHEMA_VERSION;
use super::progress;
use serde_json::json;
use wavestep::export::TEXT_WIDTH;
use wavestep_studies::book::{self, UnknownNumber};

pub fn run(options: &Book) -> Result<String, Failure> {
    let unknown = |error: UnknownNumber| Failure::usage(error.to_string(), error.remedy());
    let Some(number) = &options.number else {
        let _progress = progress::spinner("deriving");
        let all = book::examine_all();
        return Ok(match options.format {
            Format::Latex => book::table_latex(&all),
            Format::Json => {
                let equations = book::table_json(&all);
                format!("{}\n", json!({"schema_version": SCHEMA_VERSION, "equations": equations}))
            }
            Format::Markdown => book::table_markdown(&all),
            _ => book::table(&all),
        });
    };
    if options.format == Format::Markdown {
        let remedy = "use --format text, latex or json, or omit the number";
        return Err(Failure::usage("only the whole table can be written as Markdown", remedy));
    }
    // What is not there is told before anything is derived.
    book::find(number).map_err(unknown)?;
    let _progress = progress::spinner("deriving");
    let found = book::examine(number).map_err(unknown)?;
    Ok(match options.format {
        Format::Latex => found.to_latex(),
        Format::Json => format!("{}\n", found.to_json()),
        _ => found.to_text(TEXT_WIDTH),
    })
}
