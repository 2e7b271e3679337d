//! `chart`: accuracy against speed, measured, as pictures with their data and one page.

use super::arguments::Chart as Options;
use super::chart_page::{check, write};
use super::failure::Failure;
use super::input;
use super::progress;
use wavestep::problem::window;
use wavestep_studies::study::{Effort, Sampling, ToChart, charts, usual_end};

/// The most times of a reference.
const MAX_POINTS: usize = 100_000;

pub fn run(options: &Options) -> Result<String, Failure> {
    if options.points == 0 || options.points > MAX_POINTS {
        let message = format!("{} times cannot be measured", options.points);
        return Err(Failure::usage(message, format!("ask for 1 to {MAX_POINTS}")));
    }
    check(&options.output)?;
    let problem = input::problem(&options.scene)?;
    let quantity = options.quantity.as_deref().or_else(|| problem.usual_quantity());
    let Some(quantity) = quantity else {
        return Err(Failure::usage("the scene observes nothing", "give --quantity NAME"));
    };
    let to = match &options.to {
        Some(to) => problem.time("--to", to.as_str())?,
        None => usual_end(&problem)?,
    };
    let window = window(problem.time("--from", options.from.as_str())?, to)?;
    let asked = ToChart {
        quantity,
        sampling: Sampling { points: options.points, seed: options.seed },
        effort: if options.quick { Effort::Quick } else { Effort::Full },
        symbol: single_symbol(options),
        command: &command(options, quantity),
    };
    let charts = {
        let spinner = progress::spinner("measuring");
        let tick = |text: &str| spinner.set_message(text.to_owned());
        charts(&problem, window, &asked, &tick)?
    };
    for (name, reason) in &charts.left_out {
        eprintln!("note: {name} is left out: {reason}");
    }
    let title = format!("{}: accuracy and speed of {quantity}", options.scene.scene);
    write(&options.output, &title, &charts)
}

/// The symbol that has a value, where it is one only.
fn single_symbol(options: &Options) -> Option<&str> {
    match &options.scene.set[..] {
        [set] => set.split_once('=').map(|(name, _)| name.trim()),
        _ => None,
    }
}

/// The command that draws the charts again.
fn command(options: &Options, quantity: &str) -> String {
    let set: String = options.scene.set.iter().map(|set| format!(" --set {set}")).collect();
    let to = options.to.as_ref().map_or(String::new(), |to| format!(" --to {to}"));
    let quick = if options.quick { " --quick" } else { "" };
    format!(
        "wavestep chart {}{set} --quantity {quantity} --from {}{to} --points {} --seed {}{quick} -o DIR",
        options.scene.scene, options.from, options.points, options.seed
    )
}
