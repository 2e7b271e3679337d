//! `export`: values on a window as a program.

use super::arguments::Export;
use super::command_line::CommandLine;
use super::doubles::tolerance;
use super::failure::{ACCURACY, Failure};
use super::input;
use super::output;
use super::progress;
use super::validity::pulling;
use num_rational::BigRational;
use num_traits::ToPrimitive as _;
use wavestep::answer::{Tolerance, WayError};
use wavestep::export::{CHeading, to_c};
use wavestep::planner::Purpose;
use wavestep::signal::{Compiled, Evaluator as _};

pub fn run(options: &Export) -> Result<String, Failure> {
    let tolerance = options.tol.as_deref().map_or(Ok(Tolerance::Ulps(4.0)), tolerance)?;
    let problem = input::problem(&options.scene)?;
    let [from, to] = input::window(&problem, &options.from, Some(&options.to))?;
    // The doubles nearest to both ends belong to the window, also where they lie beyond.
    let nearest = |end: &BigRational| end.to_f64().and_then(BigRational::from_float);
    let from = nearest(&from).map_or(from.clone(), |nearest| nearest.min(from));
    let to = nearest(&to).map_or(to.clone(), |nearest| nearest.max(to));
    let pulls = pulling(&problem, &to);
    let spinner = progress::spinner("expanding the observable");
    let question = problem.question_for(&options.quantity, [from, to], Purpose::Polynomials)?;
    let absolute = tolerance.absolute(question.scale()?);
    let compiled = Compiled::new(&*question.signal, Some(absolute)).map_err(WayError::from)?;
    drop(spinner);
    let bound = compiled.bound().expect("compiled polynomials have a bound");
    if bound > absolute {
        let message = format!("doubles are proven to within {bound:.1e}, not to {tolerance}");
        return Err(Failure::new(ACCURACY, message, "give a larger --tol"));
    }
    let command = CommandLine::new("export", &options.scene)
        .option("--as", "c")
        .option("--quantity", &options.quantity)
        .option("--from", &options.from)
        .option("--to", &options.to)
        .given("--tol", options.tol.as_ref());
    let wanted = problem.wanted(&options.quantity)?;
    let heading = CHeading {
        title: problem.title().to_owned(),
        quantity: wanted.name.clone(),
        unit: wanted.unit(),
        time_unit: problem.time_unit().to_owned(),
        note: pulls.unwrap_or_default(),
        command: command.into_text(),
    };
    output::written(to_c(&compiled, &heading), options.output.output.as_deref())
}
