//! `export`: values on a window as a program.

use super::arguments::Export;
use super::eval_doubles::tolerance;
use super::failure::Failure;
use super::input;
use super::output;
use super::problem::{is_dimensional, with_problem};
use super::progress;
use num_rational::BigRational;
use num_traits::ToPrimitive as _;
use wavestep::answer::Tolerance;
use wavestep::evaluate::{Compiled, Method as _};
use wavestep::export::{CHeading, to_c};
use wavestep::language;

/// Writes the program that is asked for.
pub fn run(options: &Export) -> Result<String, Failure> {
    let tolerance = options.tol.as_deref().map_or(Ok(Tolerance::Ulps(4.0)), tolerance)?;
    let subject = input::subject(&options.scene)?.with_closed_contacts("export")?;
    let dimensional = is_dimensional(&subject);
    let from = input::time("--from", &options.from, dimensional)?;
    let to = input::time("--to", &options.to, dimensional)?;
    if to <= from {
        let message = format!("the window from {from} to {to} is empty");
        return Err(Failure::usage(message, "give --from before --to"));
    }
    // The double nearest to the end belongs to the window, also where it lies beyond.
    let nearest = to.to_f64().and_then(BigRational::from_float);
    let to = nearest.map_or(to.clone(), |nearest| nearest.max(to));
    let text = with_problem(subject, &options.quantity, (from, to), |problem, titles| {
        let spinner = progress::spinner("expanding the observable");
        let absolute = tolerance.absolute(problem.scale()?);
        let compiled = Compiled::new(problem.signal, &problem.from, &problem.to, Some(absolute))
            .map_err(wavestep::answer::WayError::from)?;
        drop(spinner);
        let bound = compiled.bound().expect("compiled polynomials have a bound");
        if bound > absolute {
            let message =
                format!("doubles are proven to be within {bound:.1e}, not within {tolerance}");
            return Err(Failure::Accuracy(message, "give a larger --tol".to_owned()));
        }
        let set: String = options.scene.set.iter().map(|set| format!(" --set {set}")).collect();
        let tol = options.tol.as_ref().map_or(String::new(), |tol| format!(" --tol {tol}"));
        let heading = CHeading {
            title: titles.title.clone(),
            quantity: language::normalise_name(&options.quantity),
            unit: titles.unit.clone(),
            time_unit: titles.time_unit.clone(),
            command: format!(
                "wavestep export {} --as c{set} --quantity {} --from {} --to {}{tol}",
                options.scene.scene, options.quantity, options.from, options.to
            ),
        };
        Ok(to_c(&compiled, &heading))
    })?;
    output::written(text, options.output.as_deref())
}
