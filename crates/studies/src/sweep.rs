//! A scene at many values of its symbols: a row of doubles for each, the nearest to the exact values.
//!
//! Rows are worked out on several threads and handed on in their order, so what is written does not depend on how many
//! there are.

use crate::picture::{PictureError, usual_end};
use crate::validity;
use serde_json::{Map, Value as Json, json};
use std::collections::BTreeMap;
use std::str::FromStr;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::sync_channel;
use std::thread;
use wavestep::history::ContactSummary;
use wavestep::limits::{SEARCH_BITS, VALUE_BITS, count_nothing_here};
use wavestep::planner::Purpose;
use wavestep::problem::{Digits, Problem, Values, geometrically_spaced, number};
use wavestep::signal::{Extremum, Goal, Limit, Place, Search, Value};
use wavestep_polynomial::Rational;

/// As many digits as tell a double, and with those of extrema.
const DIGITS: usize = 17;

/// Significant digits of values in equal ratios.
const AXIS_DIGITS: usize = 6;

/// The most rows.
pub const MOST_ROWS: usize = 1_000_000;

/// Rows that wait for an earlier one, for each thread.
const WAITING: usize = 64;

/// The name of the column with the reason why a row is not complete.
const ERROR: &str = "error";

/// The name of the column with what the answers of a row take for granted.
const NOTE: &str = "note";

/// The columns that hold text; the others hold numbers.
pub const TEXTS: [&str; 2] = [NOTE, ERROR];

/// A column each: values by name.
pub type Row = Map<String, Json>;

/// A symbol and the values that it takes.
#[derive(Clone, PartialEq, Debug)]
pub struct Axis {
    pub symbol: String,
    pub values: Vec<Rational>,
}

#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum AxisError {
    #[error("`{0}` is not of the form NAME=A,B,…, NAME=A..B:N or NAME=A..B:N:log")]
    Form(String),
    #[error("`{0}` has no values: the range is empty, or N is below 2")]
    Empty(String),
    #[error("equal ratios in `{0}` need two positive ends")]
    NotPositive(String),
}

impl FromStr for Axis {
    type Err = AxisError;

    fn from_str(text: &str) -> Result<Axis, AxisError> {
        let form = || AxisError::Form(text.to_owned());
        let (symbol, values) = text.split_once('=').ok_or_else(form)?;
        let value = |text: &str| number(symbol, text.trim()).map_err(|_| form());
        let values = match values.split_once("..") {
            None => values.split(',').map(value).collect::<Result<_, _>>()?,
            Some((from, rest)) => {
                let mut rest = rest.split(':');
                let mut next = || rest.next().map(str::trim);
                let (to, count, spacing) = (next(), next(), next());
                let (from, to) = (value(from)?, value(to.ok_or_else(form)?)?);
                let count = count.and_then(|count| count.parse().ok()).ok_or_else(form)?;
                if count < 2 || from >= to {
                    return Err(AxisError::Empty(text.to_owned()));
                }
                match (spacing, next()) {
                    (None, None) => evenly_spaced(&from, &to, count),
                    (Some("log"), None) if from > Rational::default() => {
                        geometrically_spaced(&from, &to, count, AXIS_DIGITS)
                    }
                    (Some("log"), None) => return Err(AxisError::NotPositive(text.to_owned())),
                    _ => return Err(form()),
                }
            }
        };
        let symbol = symbol.trim().to_owned();
        if symbol.is_empty() { Err(form()) } else { Ok(Axis { symbol, values }) }
    }
}

fn evenly_spaced(from: &Rational, to: &Rational, count: usize) -> Vec<Rational> {
    let parts = Rational::from_integer((count - 1).into());
    (0..count).map(|i| from + (to - from) * Rational::from_integer(i.into()) / &parts).collect()
}

/// What is asked of the scene at each value.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ToSweep {
    /// Values of these quantities, of all observables where none is named, at these times.
    pub quantities: Vec<String>,
    pub at: Vec<String>,
    /// The largest or smallest values of these quantities between two times, to the usual end where none is given.
    pub extrema: Vec<(Goal, String)>,
    pub from: String,
    pub to: Option<String>,
    /// How long each contact is closed at first, its impulse in that time, and its coefficient of restitution.
    pub contacts: bool,
}

/// A scene, the values that its symbols take, and what is asked.
pub struct Sweep<'a> {
    /// The text of the scene and what it is called.
    pub text: &'a str,
    pub name: &'a str,
    pub set: &'a Values,
    pub axes: &'a [Axis],
    pub asked: &'a ToSweep,
}

impl Sweep<'_> {
    /// How many rows there are; none where they are too many.
    pub fn count(&self) -> Option<usize> {
        let mut sizes = self.axes.iter().map(|axis| axis.values.len());
        let count = sizes.try_fold(1_usize, usize::checked_mul)?;
        (count <= MOST_ROWS).then_some(count)
    }

    /// The value of each symbol in a row; the last one changes fastest.
    pub fn place(&self, mut row: usize) -> Vec<(&str, &Rational)> {
        let mut place = Vec::new();
        for Axis { symbol, values } in self.axes.iter().rev() {
            place.push((symbol.as_str(), &values[row % values.len()]));
            row /= values.len();
        }
        place.reverse();
        place
    }

    /// Finds mistakes in what is asked, at the first row that can be read, or the last.
    ///
    /// # Errors
    /// A scene that cannot be read, or a quantity or time that it does not have.
    pub fn check(&self) -> Result<(), PictureError> {
        let last = self.count().unwrap_or(1).saturating_sub(1);
        let problem = self.problem(0).or_else(|_| self.problem(last))?;
        let extrema = self.asked.extrema.iter().map(|(_, name)| name);
        for name in self.asked.quantities.iter().chain(extrema) {
            problem.wanted(name)?;
        }
        for at in &self.asked.at {
            problem.time("--at", at.as_str())?;
        }
        self.window(&problem)?;
        Ok(())
    }

    fn window(&self, problem: &Problem) -> Result<[Rational; 2], PictureError> {
        let from = problem.time("--from", self.asked.from.as_str())?;
        let to = match &self.asked.to {
            Some(to) => problem.time("--to", to.as_str())?,
            None => usual_end(problem, &from)?,
        };
        Ok(problem.between(from, to)?)
    }

    fn values(&self, index: usize) -> Values {
        let mut values = self.set.clone();
        for (symbol, value) in self.place(index) {
            values.insert(wavestep::language::normalise_name(symbol), value.clone());
        }
        values
    }

    fn problem(&self, index: usize) -> Result<Problem, PictureError> {
        Ok(Problem::of_text(self.name, self.text, &self.values(index))?)
    }

    /// A row. What cannot be answered at its values is left out, and the first reason is told.
    pub fn row(&self, index: usize) -> Row {
        let place = self.place(index).into_iter();
        let mut row: Row = place
            .map(|(symbol, value)| (symbol.to_owned(), json!(crate::nearest(value))))
            .collect();
        let mut notes = Vec::new();
        if let Err(error) = self.answer(index, (&mut row, &mut notes)) {
            let error = error.to_string();
            row.insert(ERROR.to_owned(), json!(error.lines().next()));
        }
        if !notes.is_empty() {
            row.insert(NOTE.to_owned(), json!(notes.join("; ")));
        }
        row
    }

    fn answer(
        &self,
        index: usize,
        (row, notes): (&mut Row, &mut Vec<String>),
    ) -> Result<(), PictureError> {
        let problem = self.problem(index)?;
        let (asked, mut last) = (self.asked, Rational::default());
        let names = match &asked.quantities[..] {
            [] if !asked.at.is_empty() => problem.observables(),
            names => names.iter().map(String::as_str).collect(),
        };
        let times: Vec<Rational> = asked
            .at
            .iter()
            .map(|at| problem.time("--at", at.as_str()))
            .collect::<Result<_, _>>()?;
        let digits = Digits {
            count: DIGITS,
            max_bits: VALUE_BITS,
            limit: Limit::Right,
            count_echoes: false,
        };
        last = times.iter().max().cloned().unwrap_or(last);
        for name in names.iter().filter(|_| !times.is_empty()) {
            let found = problem.proven(&problem.wanted(name)?, &times, digits, &|| ())?;
            for (at, value) in asked.at.iter().zip(&found.values) {
                put(row, format!("{name}({at})"), Some(value));
            }
        }
        if !asked.extrema.is_empty() {
            let window = self.window(&problem)?;
            last = last.max(window[1].clone());
            for (goal, name) in &asked.extrema {
                let wanted = problem.wanted(name)?;
                let signal = problem.signal_on(&wanted, window.each_ref(), Purpose::Search)?;
                let found = Search::new(&*signal)?.extremum(*goal, DIGITS, SEARCH_BITS)?;
                let which = if *goal == Goal::Largest { "max" } else { "min" };
                put(row, format!("{which}({name})"), Some(&found.value));
                put(row, format!("time of {which}({name})"), first(&found));
            }
        }
        if asked.contacts {
            let until =
                asked.to.as_ref().map(|to| problem.time("--to", to.as_str())).transpose()?;
            let history = problem.history(until.as_ref(), DIGITS)?;
            history.contacts.iter().for_each(|contact| put_contact(row, contact));
        }
        notes.extend(problem.assumptions().into_iter().map(|one| format!("assuming that {one}")));
        notes.extend(validity::pulling(&problem, &last));
        Ok(())
    }

    /// Works out the rows that are not known yet, on so many threads, and hands each on, in their order.
    ///
    /// # Errors
    /// That of `each`, which ends the work.
    pub fn run<E>(
        &self,
        known: usize,
        threads: usize,
        mut each: impl FnMut(usize, Row) -> Result<(), E>,
    ) -> Result<(), E> {
        let count = self.count().unwrap_or(0);
        let next = AtomicUsize::new(known);
        let (to, rows) = sync_channel(WAITING * threads.max(1));
        thread::scope(|scope| {
            for _ in 0..threads.max(1) {
                let (to, next) = (to.clone(), &next);
                scope.spawn(move || {
                    count_nothing_here();
                    loop {
                        let index = next.fetch_add(1, Ordering::Relaxed);
                        if index >= count || to.send((index, self.row(index))).is_err() {
                            break;
                        }
                    }
                });
            }
            drop(to);
            let (mut waiting, mut due) = (BTreeMap::new(), known);
            for (index, row) in rows {
                waiting.insert(index, row);
                while let Some(row) = waiting.remove(&due) {
                    each(due, row)?;
                    due += 1;
                }
            }
            Ok(())
        })
    }
}

fn put(row: &mut Row, name: String, value: Option<&Value>) {
    row.insert(name, value.map_or(Json::Null, |value| json!(value.to_f64())));
}

/// When an extremum is first taken, where that is known.
fn first(found: &Extremum) -> Option<&Value> {
    match found.places.first()? {
        Place::Critical(time) | Place::End(time) | Place::Arrival { time, .. } => Some(time),
        Place::Plateau { from, .. } => Some(from),
        Place::Undecided { .. } => None,
    }
}

fn put_contact(row: &mut Row, contact: &ContactSummary) {
    let name = contact.between.join("-");
    put(row, format!("contact time {name}"), contact.durations.first().and_then(Option::as_ref));
    put(row, format!("impulse {name}"), contact.impulses.first());
    put(row, format!("restitution {name}"), contact.restitution.as_ref());
}
