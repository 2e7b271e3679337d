//! `find`: certified roots and extrema in a window.

use super::arguments::Find;
use super::compared::{self, Compared};
use super::failure::{Failure, settled};
use super::find_equal;
use super::found::{self, Told};
use super::input;
use super::progress;
use super::validity;
use num_rational::BigRational;
use wavestep::planner::Purpose;
use wavestep::problem::Size;
use wavestep::signal::{Extremum, Goal, Place, Search, Value};

const FEWER_DIGITS: &str = "ask for fewer digits, or a shorter window";
const MORE_BITS: &str =
    "raise --max-bits; a root without a change of sign is proven only at a simple fraction";

pub fn run(options: &Find) -> Result<String, Failure> {
    input::digits(options.digits)?;
    if options.equal.is_some() {
        return find_equal::run(options);
    }
    let (problem, other) = compared::scenes(&options.scene, options.minus.as_deref())?;
    if let Some(name) = &options.distance {
        return distances(
            options,
            (&problem, other.as_ref().expect("it is required")),
            name.trim(),
        );
    }
    let (name, written) = quantity(options)?;
    let wanted = problem.wanted(name)?;
    let window = input::window(&problem, &options.from, options.to.as_deref())?;
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
            let undecided = usize::from(matches!(extremum.value, Value::Enclosed(_)));
            note_default_end(options, &extremum, goal, &window[1]);
            settled(found::extremum(&extremum, goal, &told), (undecided, "value"), FEWER_DIGITS)
        }
        None => {
            let roots = search.roots(&level, digits, limit_bits)?;
            drop(progress);
            settled(found::roots(&roots, &told), (roots.undecided(), "interval"), MORE_BITS)
        }
    };
    if found.is_ok() {
        validity::note_pulling(&problem, &window[1]);
        if let Some(other) = other.as_ref().and_then(Compared::problem) {
            validity::note_pulling(other, &window[1]);
        }
    }
    found
}

/// Warns that an extremum may lie at the end of a default window.
fn note_default_end(options: &Find, extremum: &Extremum, goal: Goal, last: &BigRational) {
    let is_last = |place: &Place| match place {
        Place::End(time) | Place::Arrival { time, .. } => time.exact() == Some(last),
        _ => false,
    };
    if options.to.is_none() && extremum.places.iter().any(is_last) {
        let [here, beyond] = match goal {
            Goal::Largest => ["largest", "larger"],
            Goal::Smallest => ["smallest", "smaller"],
        };
        eprintln!(
            "note: the default window ends where the value is {here}; a {beyond} one may follow: give --to"
        );
    }
}

/// How far quantities are from those of another answer at most.
fn distances(
    options: &Find,
    (problem, other): (&input::Asked, &Compared),
    name: &str,
) -> Result<String, Failure> {
    let window = input::window(problem, &options.from, options.to.as_deref())?;
    let names: Vec<&str> = match name {
        "" => problem.observables().into_iter().filter(|own| other.tells(problem, own)).collect(),
        _ => vec![name],
    };
    let _progress = progress::spinner("searching");
    // What is so much smaller than the quantity is no distance.
    let nothing = BigRational::new(1.into(), num_bigint::BigInt::from(1) << 100_u32);
    let mut rows = Vec::new();
    for name in names {
        let wanted = problem.wanted(name)?;
        let difference =
            problem.difference_on(other, &wanted, window.each_ref(), Purpose::Search)?;
        let signal = problem.signal_on(&wanted, window.each_ref(), Purpose::Search)?;
        let asked = (options.digits, options.max_bits);
        let size = Size::of(&*signal, asked, &Default::default())?;
        let negligible = &size.bounds[0] * &nothing;
        rows.push((wanted, Size::of(&*difference, asked, &negligible)?, size));
    }
    let (report, undecided) = found::distances(&rows, problem, &window, options);
    settled(report, (undecided, "distance"), FEWER_DIGITS)
}

/// The name of the quantity asked for, and the level as it is written.
fn quantity(options: &Find) -> Result<(&str, &str), Failure> {
    if let Some(level) = &options.level {
        return match level.split_once('=') {
            Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
                Ok((name.trim(), value.trim()))
            }
            _ => {
                let message = format!("`--level {level}` is not of the form QUANTITY=VALUE");
                Err(Failure::usage(message, "write --level QUANTITY=VALUE"))
            }
        };
    }
    let zero = || options.zero.as_deref().map(str::trim);
    let name = options.extremum().map(|(_, name)| name).or_else(zero);
    let name = name.expect("one of them is required");
    match name.contains(',') {
        true => {
            let message = format!("`{name}` are several quantities, and `find` takes one");
            Err(Failure::usage(message, "ask for one after the other"))
        }
        false => Ok((name, "0")),
    }
}
