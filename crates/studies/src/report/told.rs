//! Events, extrema and energies as tables.

use super::html::{left_out, list, paragraph, table};
use super::line::rounded;
use crate::picture::PictureError;
use wavestep::ball::in_decimals;
use wavestep::export::expression_text;
use wavestep::history::{Ending, Event, EventKind};
use wavestep::limits::SEARCH_BITS;
use wavestep::planner::Purpose;
use wavestep::problem::{Problem, Wanted};
use wavestep::scene::Dimension;
use wavestep::signal::{Extremum, Goal, Place, Search, Value};
use wavestep_polynomial::Rational;

/// Significant digits of what is told.
const DIGITS: usize = 10;

/// At how many places an extremum is told.
const MOST_PLACES: usize = 3;

/// A value with its unit, where the scene has units.
fn value(problem: &Problem, value: &Value, dimension: Dimension) -> String {
    let text = match value {
        Value::Exact(value) if problem.has_units() => in_decimals(value),
        other => other.to_text(DIGITS),
    };
    let unit =
        if problem.has_units() { dimension.unit().replace('*', "·") } else { String::new() };
    format!("{text} {unit}").trim_end().to_owned()
}

fn sentence(event: &Event) -> String {
    let [left, right] = &event.between;
    match event.kind {
        EventKind::Impact => format!("{left} and {right} press on each other"),
        EventKind::Opening => format!("{left} and {right} part"),
        EventKind::Release => format!("{left} and {right} touch without force from now on"),
        EventKind::Closing => format!("{left} and {right} meet again"),
    }
}

/// The events of contacts, and what became of them; as `events` tells.
pub fn events(problem: &Problem, opens: bool) -> String {
    let history = match problem.history(None, DIGITS) {
        Ok(history) => history,
        Err(error) => return left_out(&error),
    };
    let told = |found: &Value, dimension| value(problem, found, dimension);
    let pair = |[before, after]: &[Value; 2], dimension| {
        let [before, after] = [before, after].map(|found| told(found, dimension));
        if before == after { before } else { format!("{before} → {after}") }
    };
    let row = |event: &Event| {
        let exact = event.exact.as_ref().map(|exact| format!(" = {}", expression_text(exact)));
        let [left, right] = &event.velocities[1];
        let [left, right] = [left, right].map(|found| told(found, Dimension::VELOCITY));
        vec![
            told(&event.time, Dimension::TIME) + &exact.unwrap_or_default(),
            sentence(event),
            pair(&event.forces, Dimension::FORCE),
            if event.between[0] == "wall" { "fixed".to_owned() } else { left },
            if event.between[1] == "wall" { "fixed".to_owned() } else { right },
        ]
    };
    let ending = match &history.ending {
        Ending::NoContact => return left_out(&"no contact can open in this scene"),
        Ending::Parted => {
            "Nothing meets again: the bodies move apart, or rest, and their energy of \
            vibration does not suffice to bring them together."
                .to_owned()
        }
        Ending::Followed(end) => {
            format!(
                "Followed until t = {}; what comes later is not known.",
                told(end, Dimension::TIME)
            )
        }
    };
    let rows: Vec<Vec<String>> = history.events.iter().map(row).collect();
    let heads = ["time", "event", "force", "velocity at the left after", "at the right after"];
    let mut out = String::new();
    if !opens && rows.len() > 1 {
        out += &paragraph(
            "All other sections keep the contacts closed; this one tells what they would do if they could open.",
        );
    }
    out += &match rows.is_empty() {
        true => paragraph("Nothing happens at the contacts in this time."),
        false => {
            table("What happens at contacts, with proof that nothing is missed", &heads, &rows)
        }
    };
    let contacts = history.contacts.iter().flat_map(|contact| {
        let [left, right] = &contact.between;
        let closed = contact.durations.iter().zip(&contact.impulses).map(|(duration, impulse)| {
            let impulse = told(impulse, Dimension::MOMENTUM);
            match duration {
                Some(duration) => {
                    format!("closed for {}, impulse {impulse}", told(duration, Dimension::TIME))
                }
                None => format!("closed still, impulse so far {impulse}"),
            }
        });
        let restitution = contact
            .restitution
            .as_ref()
            .map(|ratio| format!("coefficient of restitution {}", ratio.to_text(DIGITS)));
        let parts: Vec<String> = closed.chain(restitution).collect();
        (!parts.is_empty()).then(|| format!("Between {left} and {right}: {}.", parts.join("; ")))
    });
    out + &list(&contacts.collect::<Vec<_>>()) + &paragraph(&ending)
}

/// The largest and the smallest value of each observable on a window, and when they are taken.
pub fn extrema(
    problem: &Problem,
    names: &[&str],
    [from, to]: [&Rational; 2],
) -> Result<String, PictureError> {
    let mut rows = Vec::new();
    for name in names {
        let wanted = problem.wanted(name)?;
        let signal = problem.signal_on(&wanted, [from, to], Purpose::Search)?;
        let search = Search::new(&*signal)?;
        for (word, goal) in [("largest", Goal::Largest), ("smallest", Goal::Smallest)] {
            let found = search.extremum(goal, DIGITS, SEARCH_BITS);
            let (value, places) = match &found {
                Ok(found) => {
                    (value(problem, &found.value, wanted.dimension), places(problem, found))
                }
                Err(error) => ("not found".to_owned(), error.to_string()),
            };
            rows.push(vec![(*name).to_owned(), word.to_owned(), value, places]);
        }
    }
    let window =
        [from, to].map(|time| value(problem, &Value::Exact(time.clone()), Dimension::TIME));
    let caption = format!("Largest and smallest values for {} ≤ t ≤ {}", window[0], window[1]);
    Ok(table(&caption, &["observable", "", "value", "when"], &rows))
}

fn places(problem: &Problem, found: &Extremum) -> String {
    let time = |time: &Value| value(problem, time, Dimension::TIME);
    let place = |place: &Place| match place {
        Place::Critical(at) => format!("t = {}", time(at)),
        Place::End(at) => format!("t = {}, an end of the window", time(at)),
        Place::Arrival { time: at, before: true, after: false } => {
            format!("just before t = {}, when a wave arrives", time(at))
        }
        Place::Arrival { time: at, .. } => format!("t = {}, when a wave arrives", time(at)),
        Place::Plateau { from, to, closed } => {
            let relation = if *closed { "≤" } else { "<" };
            format!("{} ≤ t {relation} {}", time(from), time(to))
        }
        Place::Undecided { from, to } => {
            let [from, to] = [from, to].map(|time| rounded(crate::nearest(time)));
            format!("between {from} and {to}, undecided")
        }
    };
    let mut texts: Vec<String> = found.places.iter().take(MOST_PLACES).map(place).collect();
    if let more @ 1.. = found.places.len().saturating_sub(MOST_PLACES) {
        texts.push(format!("and {more} more"));
    }
    texts.join("; ")
}

/// Energies at the beginning and the end of a window.
pub fn energies(
    problem: &Problem,
    names: &[&str],
    [from, to]: [&Rational; 2],
) -> Result<String, PictureError> {
    let is_energy = |name: &&&str| -> Option<Wanted> {
        let wanted = problem.wanted(name).ok()?;
        let measure = problem.measure(&wanted)?;
        (measure == wavestep::scene::Measure::Energy).then_some(wanted)
    };
    let all: Vec<Wanted> = names.iter().filter_map(|name| is_energy(&name)).collect();
    if all.is_empty() {
        return Ok(left_out(
            &"no energy is observed; `observe energy = energy(line)` would show it",
        ));
    }
    let times = [from.clone(), to.clone()];
    let mut rows = Vec::new();
    for wanted in all {
        let signal = problem.signal_on(&wanted, [from, to], Purpose::Search)?;
        let mut row = vec![wanted.name.clone()];
        for time in &times {
            let found = wavestep::signal::digits(
                &*signal,
                time,
                wavestep::signal::Limit::Right,
                DIGITS,
                SEARCH_BITS,
            )?;
            row.push(value(problem, &found, wanted.dimension));
        }
        rows.push(row);
    }
    let ends = times.map(|time| value(problem, &Value::Exact(time), Dimension::TIME));
    let heads = ends.map(|time| format!("at t = {time}"));
    Ok(table("Energies at the ends of the window", &["energy", &heads[0], &heads[1]], &rows))
}
