//! `report`: one page about a scene.

use super::arguments::Report;
use super::certify;
use super::failure::Failure;
use super::input;
use super::output;
use super::progress;
use num_traits::Zero as _;
use wavestep_studies::report::{Request, page};

pub fn run(options: &Report) -> Result<String, Failure> {
    if options.output != "-" && !options.output.ends_with(".html") {
        let message = format!("`{}` does not end in .html", options.output);
        return Err(Failure::usage(message, "name an .html file; a browser prints it as PDF"));
    }
    let problem = input::problem(&options.scene)?;
    let to = options.to.as_deref().map(|to| problem.time("--to", to)).transpose()?;
    if to.as_ref().is_some_and(|to| to.is_zero()) {
        return Err(Failure::usage(
            "the page would end at its first time, 0",
            "give --to a time after 0",
        ));
    }
    let progress = progress::spinner("making the page");
    let page = page(
        &problem,
        &Request {
            version: env!("CARGO_PKG_VERSION"),
            command: &command(options),
            to: to.as_ref(),
            certificate: &|| certify::of_pieces(&problem).map_err(|failure| failure.to_string()),
            progress: &|part| progress.set_message(part.to_owned()),
        },
    );
    drop(progress);
    output::written(page, Some(&options.output))
}

/// The command that makes the page again; blanks are quoted.
fn command(options: &Report) -> String {
    let values = options.scene.set.iter().flat_map(|value| ["--set", value]);
    let to = options.to.iter().flat_map(|to| ["--to", to]);
    let words = ["wavestep", "report", &options.scene.scene].into_iter().chain(values).chain(to);
    let words = words.chain(["-o", &options.output]).map(|word| {
        let plain = |c: char| c.is_alphanumeric() || "-_=./:+".contains(c);
        match word.chars().all(plain) && !word.is_empty() {
            true => word.to_owned(),
            false => format!("'{}'", word.replace('\'', "'\\''")),
        }
    });
    words.collect::<Vec<String>>().join(" ")
}
