//! Charts as files: each as a picture, as JSON and as CSV, and one page with all of them.

use super::failure::Failure;
use super::output::write_whole;
use std::fs;
use std::path::Path;
use wavestep::plot::{Chart, Section, Table, page};

/// A chart with its file name and what is to be seen.
pub struct Figure {
    name: String,
    text: &'static str,
    chart: Box<dyn Chart>,
}

impl Figure {
    /// A figure.
    pub fn new(name: &str, text: &'static str, chart: impl Chart + 'static) -> Figure {
        Figure { name: name.to_owned(), text, chart: Box::new(chart) }
    }
}

/// Writes all files, and says which.
pub fn write(
    folder: &str,
    title: &str,
    figures: &[Figure],
    table: &Table,
) -> Result<String, Failure> {
    let folder = Path::new(folder);
    fs::create_dir_all(folder).map_err(|error| {
        let message = format!("the folder `{}` cannot be made: {error}", folder.display());
        Failure::usage(message, "name a folder that can be written to with -o")
    })?;
    let mut told = String::new();
    let mut sections = Vec::new();
    for figure in figures {
        let chart = figure.chart.as_ref();
        let files =
            [("svg", chart.svg()), ("json", format!("{:#}\n", chart.json())), ("csv", chart.csv())];
        for (ending, text) in files {
            let file = folder.join(format!("{}.{ending}", figure.name));
            write_whole(&file, &text)?;
            told += &format!("{}\n", file.display());
        }
        sections.push(Section { heading: chart.title(), explanation: figure.text, chart });
    }
    let file = folder.join("index.html");
    write_whole(&file, &page(title, &sections, table))?;
    Ok(told + &format!("{}\n", file.display()))
}
