//! `find`: certified roots and extrema in a window.

use super::arguments::Find;
use super::failure::{ACCURACY, Failure};
use super::find_equal;
use super::found::{self, Told};
use super::input;
use super::output::plural;
use super::progress;
use super::validity;
use wavestep::planner::Purpose;
use wavestep::signal::{Place, Search};

pub fn run(options: &Find) -> Result<String, Failure> {
    input::digits(options.digits)?;
    if options.equal.is_some() {
        return find_equal::run(options);
    }
    let (problem, other) = scenes(options)?;
    let (name, written) = quantity(options)?;
    let wanted = problem.wanted(name)?;
    let to = options.to.as_deref();
    let window = problem.window(("--from", &options.from), ("--to", to.unwrap_or_default()))?;
    // What is given wrongly is told before any work is done.
    let level = problem.quantity("--level", written, wanted.dimension)?;
    let signal = match &other {
        None => problem.signal_on(&wanted, window.each_ref(), Purpose::Search)?,
        Some(other) => problem.difference_on(other, &wanted, window.each_ref(), Purpose::Search)?,
    };
    let name = &match &options.minus {
        None => name.to_owned(),
        Some(scene) => format!("{name} - {name} of {scene}"),
    };
    let told =
        Told { options, name, level: written, problem: &problem, wanted: &wanted, window: &window };
    let search = Search::new(&*signal)?;
    let progress = progress::spinner("searching");
    let (digits, limit_bits) = (options.digits, options.max_bits);
    let found = match options.extremum() {
        Some((goal, _)) => {
            let extremum = search.extremum(goal, digits, limit_bits)?;
            drop(progress);
            let open = |place: &&Place| matches!(place, Place::Undecided { .. });
            let undecided = extremum.places.iter().filter(open).count();
            settled(found::extremum(&extremum, goal, &told), undecided, "place")
        }
        None => {
            let roots = search.roots(&level, digits, limit_bits)?;
            drop(progress);
            settled(found::roots(&roots, &told), roots.undecided(), "interval")
        }
    };
    if found.is_ok() {
        validity::note_pulling(&problem, &window[1]);
        if let Some(other) = &other {
            validity::note_pulling(other, &window[1]);
        }
    }
    found
}

/// The scene, and that which is taken from it; each with the values that it has symbols for. A value for a symbol of
/// neither is given to the first, which says so.
fn scenes(options: &Find) -> Result<(input::Asked, Option<input::Asked>), Failure> {
    let Some(minus) = &options.minus else { return Ok((input::problem(&options.scene)?, None)) };
    let values = input::values(&options.scene.set)?;
    let scene = &options.scene.scene;
    let [own, other] = [scene, minus].map(|scene| input::problem_with(scene, &Default::default()));
    let (own, other) = (own?, other?);
    let of = |problem: &input::Asked, name: &str| problem.symbols().contains(&name);
    let (mut owns, mut others) = (values.clone(), values);
    owns.retain(|name, _| of(&own, name) || !of(&other, name));
    others.retain(|name, _| of(&other, name));
    Ok((input::problem_with(scene, &owns)?, Some(input::problem_with(minus, &others)?)))
}

/// What was found, as a failure where some of it stays undecided.
fn settled(report: String, undecided: usize, what: &str) -> Result<String, Failure> {
    if undecided == 0 {
        return Ok(report);
    }
    let stay = if undecided == 1 { "stays" } else { "stay" };
    let message = format!("{} {stay} undecided", plural(undecided, what));
    let remedy = "raise --max-bits; roots of even order stay undecided with any precision";
    Err(Failure::new(ACCURACY, message, remedy).with_report(report))
}

/// The name of the quantity asked for, and the level as it is written.
fn quantity(options: &Find) -> Result<(&str, &str), Failure> {
    if let Some(level) = &options.level {
        return match level.split_once('=') {
            Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
                Ok((name.trim(), value.trim()))
            }
            _ => {
                let message = format!("`--level {level}` is no quantity with a value");
                Err(Failure::usage(message, "write --level QUANTITY=VALUE"))
            }
        };
    }
    let zero = || options.zero.as_deref().map(str::trim);
    let name = options.extremum().map(|(_, name)| name).or_else(zero);
    Ok((name.expect("one of them is required"), "0"))
}
