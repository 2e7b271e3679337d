//! `chart`: accuracy against speed, measured, as pictures with their data and one page.

use super::arguments::{Chart as Options, Scene};
use super::chart_page::{check, write};
use super::command_line::CommandLine;
use super::failure::Failure;
use super::input;
use super::output::written;
use super::progress;
use std::fmt::Write as _;
use std::time::Duration;
use wavestep::answer::{Costs, Work};
use wavestep_studies::study::{Effort, Sampling, ToChart, charts, measured_costs, usual_end};

/// The most times of a reference.
const MAX_POINTS: usize = 100_000;

pub fn run(options: &Options) -> Result<String, Failure> {
    match (&options.scene, options.output.as_deref()) {
        (Some(scene), Some(folder)) => drawn(options, scene, folder),
        (_, file) => costs(options, file),
    }
}

/// The costs by which ways are weighed, measured, beside those compiled in; written to a file where one is named.
fn costs(options: &Options, file: Option<&str>) -> Result<String, Failure> {
    let each = Duration::from_millis(if options.quick { 1 } else { 200 });
    let spinner = progress::spinner("measuring");
    let (measured, used) = (measured_costs(each)?, Costs::default());
    drop(spinner);
    let mut table =
        format!("{:<19} {:>9} {:>9} {:>6}\n", "seconds", "measured", "built in", "ratio");
    for work in Work::ALL {
        let (now, then) = (measured.of(work), used.of(work));
        let (name, ratio) = (work.name(), now / then);
        let _ =
            writeln!(table, "{name:<19} {now:>9.1e} {then:>9.1e} {ratio:>6.2}  {}", work.meaning());
    }
    if let Some(file) = file.filter(|file| *file != "-") {
        table += &written(measured.text(), Some(file))?;
    }
    Ok(table)
}

fn drawn(options: &Options, scene: &Scene, folder: &str) -> Result<String, Failure> {
    if options.points == 0 || options.points > MAX_POINTS {
        let message = format!("{} times cannot be measured", options.points);
        return Err(Failure::usage(message, format!("give 1 to {MAX_POINTS}")));
    }
    check(folder)?;
    let problem = input::problem(scene)?;
    let quantity = options.quantity.as_deref().or_else(|| problem.usual_quantity());
    let Some(quantity) = quantity else {
        return Err(Failure::usage("the scene has no observables", "give --quantity NAME"));
    };
    let to = match &options.to {
        Some(to) => problem.time("--to", to.as_str())?,
        None => usual_end(&problem)?,
    };
    let window = problem.between(problem.time("--from", options.from.as_str())?, to)?;
    let asked = ToChart {
        quantity,
        sampling: Sampling { points: options.points, seed: options.seed },
        effort: if options.quick { Effort::Quick } else { Effort::Full },
        symbol: single_symbol(scene),
        command: &command(options, scene, quantity),
    };
    let charts = {
        let spinner = progress::spinner("measuring");
        let tick = |text: &str| spinner.set_message(text.to_owned());
        charts(&problem, window, &asked, &tick)?
    };
    for (name, reason) in &charts.left_out {
        eprintln!("note: {name} is omitted: {reason}");
    }
    let title = format!("{}: accuracy and speed of {quantity}", scene.scene);
    write(folder, &title, &charts)
}

/// The symbol that has a value, where it is one only.
fn single_symbol(scene: &Scene) -> Option<&str> {
    match &scene.set[..] {
        [set] => set.split_once('=').map(|(name, _)| name.trim()),
        _ => None,
    }
}

/// The command that draws the charts again.
fn command(options: &Options, scene: &Scene, quantity: &str) -> String {
    let line = CommandLine::new("chart", scene)
        .option("--quantity", quantity)
        .option("--from", &options.from)
        .given("--to", options.to.as_ref())
        .option("--points", &options.points.to_string())
        .option("--seed", &options.seed.to_string());
    let line = if options.quick { line.word("--quick") } else { line };
    line.option("-o", "DIR").into_text()
}
