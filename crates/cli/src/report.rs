//! `report`: one page about a scene.

use super::arguments::Report;
use super::certify;
use super::failure::Failure;
use super::input;
use super::output;
use super::progress;
use wavestep_studies::report::{Request, page};

pub fn run(options: &Report) -> Result<String, Failure> {
    if options.output != "-" && !options.output.ends_with(".html") {
        let message = format!("`{}` does not end in .html", options.output);
        return Err(Failure::usage(message, "name an .html file; a browser prints it as PDF"));
    }
    let problem = input::problem(&options.scene)?;
    let progress = progress::spinner("making the page");
    let page = page(
        &problem,
        &Request {
            version: env!("CARGO_PKG_VERSION"),
            command: &command(options),
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
    let words = ["wavestep", "report", &options.scene.scene].into_iter().chain(values);
    let words = words.chain(["-o", &options.output]).map(|word| {
        let plain = |c: char| c.is_alphanumeric() || "-_=./:+".contains(c);
        match word.chars().all(plain) && !word.is_empty() {
            true => word.to_owned(),
            false => format!("'{}'", word.replace('\'', "'\\''")),
        }
    });
    words.collect::<Vec<String>>().join(" ")
}
