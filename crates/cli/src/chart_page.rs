//! Charts as files: each as a picture, as JSON and as CSV, and one page with all of them.

use super::failure::Failure;
use super::output::write_whole;
use std::fs;
use std::path::Path;
use wavestep_draw::{Section, page};
use wavestep_studies::study::Charts;

/// Refuses a folder that cannot be made, before anything is measured.
pub fn check(folder: &str) -> Result<(), Failure> {
    let known = Path::new(folder).ancestors().find(|folder| folder.exists());
    match known.is_none_or(Path::is_dir) {
        true => Ok(()),
        false => Err(unusable(folder, "a part of its path is a file")),
    }
}

fn unusable(folder: &str, reason: impl std::fmt::Display) -> Failure {
    let message = format!("the folder `{folder}` cannot be created: {reason}");
    Failure::usage(message, "name a writable folder with -o")
}

pub fn write(folder: &str, title: &str, charts: &Charts) -> Result<String, Failure> {
    fs::create_dir_all(folder).map_err(|error| unusable(folder, error))?;
    let folder = Path::new(folder);
    let mut told = String::new();
    let mut sections = Vec::new();
    for figure in &charts.all {
        let chart = figure.chart.as_ref();
        let files =
            [("svg", chart.svg()), ("json", format!("{:#}\n", chart.json())), ("csv", chart.csv())];
        for (ending, text) in files {
            let file = folder.join(format!("{}.{ending}", figure.name));
            write_whole(&file, text.as_bytes())?;
            told += &format!("{}\n", file.display());
        }
        let (heading, explanation) = (chart.title(), figure.text);
        let listing = figure.listing.as_ref();
        sections.push(Section { heading, explanation, chart, listing });
    }
    let file = folder.join("index.html");
    write_whole(&file, page(title, &sections, &charts.table).as_bytes())?;
    Ok(told + &format!("{}\n", file.display()))
}
