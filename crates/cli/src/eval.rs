//! `eval`: values with proven digits, or in doubles.

use super::arguments::Eval;
use super::doubles;
use super::failure::{Failure, settled};
use super::input;
use super::output::plural;
use super::progress;
use super::rows::{Told, times, written};
use super::validity::note_pulling;
use num_rational::BigRational;
use std::time::Instant;
use wavestep::answer::Accuracy;
use wavestep::problem::{Digits, Problem, Undecided};
use wavestep::signal::Value;

/// Values at times, with as many digits as asked or by one method.
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
    let names: Vec<String> = match (&options.quantity[..], &problem.observables()[..]) {
        ([], []) => problem.waves().iter().map(|&name| name.to_owned()).collect(),
        ([], observables) => observables.iter().map(|&name| name.to_owned()).collect(),
        (named, _) => named.iter().map(|name| name.trim().to_owned()).collect(),
    };
    let mut told = Told::new(options.format, names.len());
    let (mut last, mut undecided) = (None, 0);
    for name in &names {
        let times = times(&problem, name, options)?;
        last = last.max(times.iter().max().cloned());
        let if_undecided = match (names.len(), times.len()) {
            (1, 1) => Undecided::Refused,
            _ => Undecided::Enclosed,
        };
        let (text, open) = answered(&problem, (name, &times), accuracy, if_undecided, options)?;
        undecided += open;
        told.add(name, text);
    }
    last.iter().for_each(|last| note_pulling(&problem, last));
    let remedy = "ask for one digit more or fewer, or allow more bits with --max-bits";
    settled(told.all(), (undecided, "value"), remedy)
}

/// The values of one quantity, as they are told, and how many stay undecided.
fn answered(
    problem: &Problem,
    (name, times): (&str, &[BigRational]),
    accuracy: Accuracy,
    undecided: Undecided,
    options: &Eval,
) -> Result<(String, usize), Failure> {
    let limit = options.side;
    let tolerance = match accuracy {
        Accuracy::Within(tolerance) => Some(tolerance),
        Accuracy::Method(_, tolerance) => tolerance,
        Accuracy::Digits => None,
    };
    if accuracy != Accuracy::Digits {
        let progress = progress::spinner("evaluating");
        let found = problem.doubles(name, times, limit, accuracy);
        drop(progress);
        let found = found.map_err(|error| doubles::refused(error, times.len(), options.explain))?;
        doubles::tell(&found, times.len(), tolerance, options.explain);
        if options.stats {
            doubles::count(name, found.echoes);
        }
        let wanted = problem.wanted(name)?;
        return Ok((doubles::written(&found, problem, &wanted, times, options), 0));
    }
    let wanted = problem.wanted(name)?;
    let (count, max_bits) = (options.digits, options.max_bits);
    let digits = Digits { count, max_bits, limit, count_echoes: options.stats, undecided };
    let (progress, begin) = (progress::counted(times.len()), Instant::now());
    let found = problem.proven(&wanted, times, digits, &|| progress.inc(1))?;
    drop(progress);
    if options.explain {
        let (how, took) = (problem.how_found(found.origin), begin.elapsed().as_secs_f64());
        let several = plural(times.len(), "value");
        eprintln!(
            "{several} with {count} proven digits, {took:.1} s\n  {how}\n  bound: interval arithmetic \
             of rising precision, until the rounding is certain"
        );
    }
    if options.stats {
        doubles::count(name, found.echoes);
    }
    let open = found.values.iter().filter(|value| matches!(value, Value::Enclosed(_))).count();
    Ok((written(problem, &wanted, (times, &found.values), options), open))
}
