//! The command line: what is asked for, and how failures are told.
//!
//! Standard output carries results alone; errors and progress go to standard error. Exit codes:
//! 0 done, 1 could not compute or not as locked, 2 usage or bad scene, 3 accuracy not reached.

mod advise;
mod arguments;
mod book;
mod budget;
mod certify;
mod chart;
mod chart_page;
mod check;
mod command_line;
mod compared;
mod derive;
pub mod diagnostic;
mod dispersion;
mod doubles;
mod enough;
mod eval;
mod events;
mod export;
mod failure;
mod field;
mod figure;
mod find;
mod find_equal;
mod first_contact;
mod found;
mod generate;
mod hertz;
mod input;
pub mod json;
mod lock;
mod output;
mod picture;
mod plot;
mod progress;
mod report;
mod rows;
mod share;
mod sweep;
mod table;
mod validity;

use arguments::{Arguments, Scenes, Subcommand};
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory as _, FromArgMatches as _};
use failure::Failure;
use std::io::{self, Write as _};
use std::process::ExitCode;
use wavestep::scenes::{SCENES, Scene};
use wavestep::signal::limit_instructions;

/// Runs the command that the arguments name.
pub fn run() -> ExitCode {
    let arguments = match parsed() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are no failures; clap prints them to standard output.
            let code = if error.use_stderr() { failure::USAGE } else { 0 };
            return match error.print() {
                Ok(()) => ExitCode::from(code),
                Err(error) => written(Err(error)),
            };
        }
    };
    if let Some(memory) = arguments.memory {
        wavestep::limits::set_memory(memory);
    }
    if let Some(name) = &arguments.instructions {
        assert!(limit_instructions(name), "the arguments have these names only");
    }
    budget::watch(arguments.time_limit);
    let result = match &arguments.subcommand {
        Subcommand::Derive(options) => output::report(derive::run(options), &options.output),
        Subcommand::Eval(options) => output::report(eval::run(options), &options.output),
        Subcommand::Chart(options) => chart::run(options),
        Subcommand::Events(options) => output::report(events::run(options), &options.output),
        Subcommand::Export(options) => export::run(options),
        Subcommand::Plot(options) => plot::run(options),
        Subcommand::Report(options) => report::run(options),
        Subcommand::Field(options) => field::run(options),
        Subcommand::Find(options) => output::report(find::run(options), &options.output),
        Subcommand::Advise(options) => advise::run(options),
        Subcommand::Sweep(options) => sweep::run(options),
        Subcommand::Dispersion(options) => {
            output::report(dispersion::run(options), &options.output)
        }
        Subcommand::Hertz(options) => output::report(hertz::run(options), &options.output),
        Subcommand::Figure(options) => figure::run(options),
        Subcommand::Book(options) => output::report(book::run(options), &options.output),
        Subcommand::Certify(options) => output::report(certify::run(options), &options.output),
        Subcommand::Check(options) => check::run(options),
        Subcommand::Lock(options) => lock::run(options),
        Subcommand::Scenes(options) => scenes(options),
        Subcommand::Generate(options) => generate::run(options),
    };
    budget::done();
    match result {
        Ok(output) => written(io::stdout().lock().write_all(output.as_bytes())),
        Err(failure) => {
            if let Failure::Told { report, .. } = &failure {
                let _ = io::stdout().lock().write_all(report.as_bytes());
            }
            failure.show();
            ExitCode::from(failure.code())
        }
    }
}

/// The arguments. A negative number is the value of the option before it, which says what is wrong with it.
fn parsed() -> Result<Arguments, clap::Error> {
    let mut command = Arguments::command().mut_subcommands(|subcommand| {
        subcommand.mut_args(|argument| match argument.get_action().takes_values() {
            true => argument.allow_negative_numbers(true),
            false => argument,
        })
    });
    let matches = command.try_get_matches_from_mut(std::env::args_os());
    let mut matches = matches.map_err(without_dashes)?;
    Arguments::from_arg_matches_mut(&mut matches).map_err(|error| error.format(&mut command))
}

/// An error without the advice to pass an option as a value behind `--`, which is never what was meant.
fn without_dashes(mut error: clap::Error) -> clap::Error {
    if let Some(ContextValue::StyledStrs(tips)) = error.remove(ContextKind::Suggested) {
        let useful = |tip: &StyledStr| !tip.to_string().contains("-- ");
        let tips: Vec<StyledStr> = tips.into_iter().filter(useful).collect();
        if !tips.is_empty() {
            error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
        }
    }
    error
}

/// The exit code after writing: a reader that has gone away ends the command quietly.
fn written(result: io::Result<()>) -> ExitCode {
    let result = result.and_then(|()| io::stdout().flush());
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: the output cannot be written: {error}");
            ExitCode::from(failure::COMPUTATION)
        }
    }
}

/// The built-in scenes with their titles, or the text of one.
fn scenes(options: &Scenes) -> Result<String, Failure> {
    if let Some(name) = &options.name {
        return Ok(input::built_in(name)?.text.to_owned());
    }
    let width = SCENES.iter().map(|scene| scene.name.len()).max().unwrap_or_default() + 2;
    let line = |scene: &Scene| format!("{:<width$}{}\n", scene.name, scene.title());
    Ok(SCENES.iter().map(line).collect())
}
