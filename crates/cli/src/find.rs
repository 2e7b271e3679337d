//! `find`: certified roots and extrema in a window.

use super::arguments::Find;
use super::failure::Failure;
use super::find_equal;
use super::found::{self, Told};
use super::input::{self, Subject};
use super::progress;
use super::quantity;
use super::validity;
use num_rational::BigRational;
use wavestep::evaluate::{ClosedSignal, EvaluateError, Goal, Place, Search, Signal};
use wavestep::language::{self, Source};
use wavestep::network::{Network, Observed};
use wavestep::recurrence::Observation;
use wavestep::scene::Dimension;
use wavestep::signal::{self, Purpose};
use wavestep::solution::Solution;

/// Finds what is asked for.
pub fn run(options: &Find) -> Result<String, Failure> {
    input::digits(options.digits)?;
    if options.equal.is_some() {
        return find_equal::run(options);
    }
    let seen = Seen::of(input::subject(&options.scene)?, quantity(options)?.0)?;
    let (from, to) = (options.from.as_deref(), options.to.as_deref());
    let from = input::time("--from", from.unwrap_or_default(), seen.is_dimensional())?;
    let to = input::time("--to", to.unwrap_or_default(), seen.is_dimensional())?;
    if to <= from {
        let message = format!("the window from {from} to {to} is empty");
        return Err(Failure::usage(message, "give --from before --to"));
    }
    let told = Told { options, seen: &seen, window: [&from, &to] };
    // What is given wrongly is told before any work is done.
    let goal = goal(options);
    let level = if goal.is_none() { level(options, &seen)? } else { BigRational::default() };
    let signal = seen.signal([&from, &to])?;
    let search = Search::new(&*signal)?;
    let progress = progress::spinner("searching");
    let (digits, limit_bits) = (options.digits, options.max_bits);
    let found = match goal {
        Some(goal) => {
            let extremum = search.extremum(goal, digits, limit_bits)?;
            drop(progress);
            let open = |place: &&Place| matches!(place, Place::Undecided { .. });
            let undecided = extremum.places.iter().filter(open).count();
            settled(found::extremum(&extremum, goal, &told), undecided, ["place", "places"])
        }
        None => {
            let roots = search.roots(&level, digits, limit_bits)?;
            drop(progress);
            settled(found::roots(&roots, &told), roots.undecided(), ["interval", "intervals"])
        }
    };
    if let (Ok(_), Seen::Scene { network, .. }) = (&found, &seen) {
        validity::note_search(network, &to);
    }
    found
}

/// What was found, as a failure where some of it stays undecided.
fn settled(report: String, undecided: usize, [one, many]: [&str; 2]) -> Result<String, Failure> {
    if undecided == 0 {
        return Ok(report);
    }
    let message = match undecided {
        1 => format!("1 {one} stays undecided"),
        _ => format!("{undecided} {many} stay undecided"),
    };
    let remedy =
        "raise --max-bits; roots of even order stay undecided with any precision".to_owned();
    Err(Failure::Undecided { report, message, remedy })
}

/// The extremum asked for.
pub fn goal(options: &Find) -> Option<Goal> {
    match (&options.max, &options.min) {
        (Some(_), _) => Some(Goal::Largest),
        (_, Some(_)) => Some(Goal::Smallest),
        _ => None,
    }
}

/// The name of the quantity asked for, and the level as it is written.
pub fn quantity(options: &Find) -> Result<(&str, &str), Failure> {
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
    let name = options.max.as_ref().or(options.min.as_ref()).or(options.zero.as_ref());
    Ok((name.expect("one of them is required").trim(), "0"))
}

fn level(options: &Find, seen: &Seen) -> Result<BigRational, Failure> {
    match (&options.level, quantity(options)?, seen) {
        (None, ..) => Ok(BigRational::default()),
        (_, (_, value), Seen::Scene { observed, .. }) if seen.is_dimensional() => {
            let source = Source::new("--level", value)?;
            // A wave has no unit.
            match observed.dimension == Dimension::NONE {
                true => Ok(language::read_number(&source)?),
                false => Ok(language::read_quantity(&source, observed.dimension)?),
            }
        }
        (_, (_, value), _) => input::number("--level", value),
    }
}

/// A quantity with where it is seen.
pub enum Seen {
    /// A wave or observable of a recurrence.
    Recurrence(Box<Solution>, Observation),
    /// One of a scene.
    Scene {
        /// The scene.
        network: Box<Network>,
        /// What is seen of it.
        observed: Box<Observed>,
    },
}

impl Seen {
    /// The quantity of this name.
    pub fn of(subject: Subject, quantity: &str) -> Result<Seen, Failure> {
        match subject {
            Subject::Recurrence(recurrence) => {
                let observation = quantity::of_recurrence(&recurrence, quantity)?;
                if let Some(symbol) = recurrence.symbols().next() {
                    return Err(EvaluateError::MissingValue(symbol.clone()).into());
                }
                Ok(Seen::Recurrence(Box::new(Solution::new(*recurrence)), observation))
            }
            Subject::Scene(network) => {
                let observed = match network.scene().contacts_open {
                    true => quantity::of_phases(&network, quantity)?,
                    false => quantity::of_scene(&network, quantity)?,
                };
                let observed = Box::new(observed);
                Ok(Seen::Scene { network, observed })
            }
        }
    }

    /// Whether times and values have units.
    pub fn is_dimensional(&self) -> bool {
        matches!(self, Seen::Scene { network, .. } if network.scene().dimensional)
    }

    /// The unit of values.
    pub fn unit(&self) -> String {
        match self {
            Seen::Scene { observed, .. } if self.is_dimensional() => {
                language::unit_of(observed.dimension).clone()
            }
            _ => String::new(),
        }
    }

    /// The title of the scene.
    pub fn title(&self) -> &str {
        match self {
            Seen::Recurrence(solution, _) => &solution.recurrence().statement().title,
            Seen::Scene { network, .. } => &network.scene().title,
        }
    }

    /// The quantity on a window.
    pub fn signal(&self, window: [&BigRational; 2]) -> Result<Box<dyn Signal + '_>, Failure> {
        Ok(match self {
            Seen::Recurrence(solution, observation) => {
                Box::new(ClosedSignal::of_recurrence(solution, observation, window)?)
            }
            Seen::Scene { network, observed } => {
                signal::of_scene(network, observed, window, Purpose::Stretches)?
            }
        })
    }
}
