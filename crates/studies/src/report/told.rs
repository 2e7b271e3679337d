//! Events, extrema and energies of a scene.

use super::Observed;
use super::html::{left_out, list, paragraph, set};
use crate::picture::PictureError;
use crate::told::Teller;
use wavestep::history::Ending;
use wavestep::limits::{SEARCH_BITS, VALUE_BITS};
use wavestep::problem::Problem;
use wavestep::scene::Measure;
use wavestep::signal::{Goal, Limit, Place, Search, Value, digits};
use wavestep_draw::table;
use wavestep_polynomial::Rational;

/// Significant digits of what is told.
const DIGITS: usize = 10;

/// At how many places an extremum is told.
const MOST_PLACES: usize = 3;

fn teller(problem: &Problem) -> Teller<'_> {
    Teller { problem, digits: DIGITS, longest_fraction: DIGITS }
}

/// The events of contacts in their order, and what became of each contact.
pub fn events(problem: &Problem, until: Option<&Rational>, kept_closed: bool) -> String {
    let history = match problem.history(until, DIGITS) {
        Ok(history) => history,
        Err(error) => return left_out(&error),
    };
    if history.ending == Ending::NoContact {
        return left_out(&"no contact can open in this scene");
    }
    let item = |(sentence, lines): (String, Vec<String>)| {
        let lines = if lines.is_empty() { String::new() } else { list(&lines) };
        format!("<li>{}{lines}</li>\n", set(&sentence))
    };
    let told = teller(problem).history(&history);
    let about = match kept_closed {
        true => {
            " All other sections keep contacts closed; here they open when they would go into tension."
        }
        false => "",
    };
    let proven = match &history.assumptions[..] {
        [] => "this is proven",
        [_] => "this is proven under the assumption listed below",
        _ => "this is proven under the assumptions listed below",
    };
    paragraph(&format!("No event is missed; {proven}.{about}"))
        + &format!(
            "<ol class=\"events\">\n{}</ol>\n",
            told.into_iter().map(item).collect::<String>()
        )
}

/// The largest and the smallest value of each observable on a window, and where they are.
pub fn extrema(
    problem: &Problem,
    observed: &[Observed<'_>],
    window: [&Rational; 2],
) -> Result<String, PictureError> {
    let teller = teller(problem);
    let mut rows = Vec::new();
    for Observed { wanted, signal } in observed {
        let search = Search::new(&**signal)?;
        for (word, goal) in [("largest", Goal::Largest), ("smallest", Goal::Smallest)] {
            let [value, places] = match search.extremum(goal, DIGITS, SEARCH_BITS) {
                Ok(found) => [
                    teller.value(&found.value, wanted.dimension),
                    places(&teller, &joined(&found.places)),
                ],
                Err(error) => ["not found".to_owned(), error.to_string()],
            };
            rows.push(vec![wanted.name.clone(), word.to_owned(), value, places]);
        }
    }
    let [from, to] = window.map(|time| teller.time(&Value::Exact(time.clone())));
    let caption = format!("Proven for the whole window {from} <= t <= {to}");
    Ok(table(&caption, &["observable", "", "value", "where"], &rows, set))
}

/// Places, with plateaus as one where they follow one another, and with the value at their ends.
fn joined(places: &[Place]) -> Vec<Place> {
    let mut all: Vec<Place> = Vec::new();
    for place in places {
        let Some(Place::Plateau { to, closed, .. }) = all.last_mut() else {
            all.push(place.clone());
            continue;
        };
        match place {
            Place::Plateau { from, to: end, closed: own } if from == to => {
                (*to, *closed) = (end.clone(), *own);
            }
            Place::Arrival { time, after: true, .. } if time == to => *closed = true,
            other => all.push(other.clone()),
        }
    }
    all
}

fn places(teller: &Teller<'_>, places: &[Place]) -> String {
    let shown = places.iter().take(MOST_PLACES).map(|place| teller.place(place));
    let more = places.len().saturating_sub(MOST_PLACES);
    let more = (more > 0).then(|| format!("and at {more} more"));
    shown.chain(more).collect::<Vec<_>>().join("; ")
}

/// Energies at the beginning and the end of a window.
pub fn energies(
    problem: &Problem,
    observed: &[Observed<'_>],
    window: [&Rational; 2],
) -> Result<String, PictureError> {
    let teller = teller(problem);
    let mut rows = Vec::new();
    for Observed { wanted, signal } in observed {
        if problem.measure(wanted).is_some_and(Measure::is_energy) {
            let mut row = vec![wanted.name.clone()];
            for time in window {
                let energy = digits(&**signal, time, Limit::Right, DIGITS, VALUE_BITS)?;
                row.push(teller.value(&energy, wanted.dimension));
            }
            rows.push(row);
        }
    }
    if rows.is_empty() {
        let reason = "no energy is observed; `observe energy = energy(line)` adds it";
        return Ok(left_out(&reason));
    }
    let heads = window.map(|time| format!("at t = {}", teller.time(&Value::Exact(time.clone()))));
    Ok(table("Energies at the ends of the window", &["energy", &heads[0], &heads[1]], &rows, set))
}
