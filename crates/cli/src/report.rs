//! `report`: one page about a scene.

use super::arguments::Report;
use super::certify;
use super::command_line::CommandLine;
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
    let command = CommandLine::new("report", &options.scene)
        .given("--to", options.to.as_ref())
        .option("-o", &options.output);
    let progress = progress::spinner("making the page");
    let page = page(
        &problem,
        &Request {
            version: env!("CARGO_PKG_VERSION"),
            command: &command.into_text(),
            to: to.as_ref(),
            certificate: &|| certify::of_pieces(&problem).map_err(|failure| failure.to_string()),
            progress: &|part| progress.set_message(part.to_owned()),
        },
    );
    drop(progress);
    output::written(page, Some(&options.output))
}
