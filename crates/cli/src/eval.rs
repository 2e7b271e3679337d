//! `eval`: values with proven digits, or in doubles.

use super::arguments::Eval;
use super::doubles;
use super::failure::Failure;
use super::input;
use super::output::plural;
use super::progress;
use super::rows::{times, written};
use super::validity::note_pulling;
use std::time::Instant;
use wavestep::answer::Accuracy;
use wavestep::problem::Digits;

/// Says where a contact that stays closed would pull before the last of some times.
pub fn run(options: &Eval) -> Result<String, Failure> {
    input::digits(options.digits)?;
    let mut problem = input::problem(&options.scene)?;
    if let Some(file) = &options.costs {
        problem.weigh_by(input::costs(file)?);
    }
    let tolerance = options.tol.as_deref().map(doubles::tolerance).transpose()?;
    let method = options.method.as_deref().map(doubles::method).transpose()?;
    let accuracy = match (method, tolerance) {
        (Some(method), tolerance) => Accuracy::Method(method, tolerance),
        (None, Some(tolerance)) => Accuracy::Within(tolerance),
        (None, None) => Accuracy::Digits,
    };
    let (name, limit) = (&options.quantity, options.side);
    if accuracy != Accuracy::Digits {
        let times = times(&problem, options)?;
        let progress = progress::spinner("evaluating");
        let found = problem.doubles(name, &times, limit, accuracy);
        drop(progress);
        let found = found.map_err(|error| doubles::refused(error, times.len(), options.explain))?;
        doubles::tell(&found, times.len(), tolerance, options.explain);
        if options.stats {
            doubles::count(found.echoes);
        }
        times.iter().max().into_iter().for_each(|last| note_pulling(&problem, last));
        let unit = problem.wanted(name)?.unit();
        return Ok(doubles::written(&found, &problem, &unit, &times, options));
    }
    let wanted = problem.wanted(name)?;
    let times = times(&problem, options)?;
    let (count, max_bits) = (options.digits, options.max_bits);
    let digits = Digits { count, max_bits, limit, count_echoes: options.stats };
    let (progress, begin) = (progress::counted(times.len()), Instant::now());
    let found = problem.proven(&wanted, &times, digits, &|| progress.inc(1))?;
    drop(progress);
    if options.explain {
        let (how, took) = (problem.how_found(found.origin), begin.elapsed().as_secs_f64());
        let several = plural(times.len(), "value");
        eprintln!(
            "{several} with {count} proven digits, {took:.1} s\n  {how}\n  bound: enclosed more and \
             more narrowly, until the last digit is rounded correctly"
        );
    }
    times.iter().max().into_iter().for_each(|last| note_pulling(&problem, last));
    if options.stats {
        doubles::count(found.echoes);
    }
    Ok(written(&problem, &wanted, (&times, &found.values), options))
}
