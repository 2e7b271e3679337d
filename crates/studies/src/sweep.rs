//! A scene at many values of its symbols: a row of doubles for each, the nearest to the exact values.
//!
//! Rows are worked out on several threads and handed on in their order, so what is written does not depend on how many
//! there are.

use crate::picture::{self, PictureError};
use crate::told::Teller;
use crate::validity;
use serde_json::{Map, Value as Json, json};
use std::collections::BTreeMap;
use std::str::FromStr;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::sync_channel;
use std::thread;
use wavestep::history::{ContactSummary, Ending};
use wavestep::language;
use wavestep::limits::{SEARCH_BITS, VALUE_BITS, count_nothing_here};
use wavestep::planner::Purpose;
use wavestep::problem::{
    Digits, Given, Problem, Undecided, Values, Wanted, evenly_spaced, geometrically_spaced, number,
};
use wavestep::scene::Dimension;
use wavestep::signal::{Extremum, Goal, Limit, Place, Search, Value};
use wavestep_polynomial::Rational;

/// As many digits as tell a double, and with those of extrema.
const DIGITS: usize = 17;

/// Significant digits of values in equal ratios.
const AXIS_DIGITS: usize = 15;

/// The most rows.
pub const MOST_ROWS: usize = 1_000_000;

/// Rows that wait for an earlier one, for each thread.
const WAITING: usize = 64;

/// The name of the column with the reason why a row is not complete.
pub const ERROR: &str = "error";

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
    Range(String),
    #[error("there are no values for `{0}`")]
    Empty(String),
    #[error("`{0}` has more than {MOST_ROWS} values")]
    TooMany(String),
    #[error("a symbol named `{0}` cannot be told from the column of that name")]
    Reserved(String),
    #[error("a value of `{0}` is beyond the range of doubles")]
    NotADouble(String),
    #[error("equal ratios in `{0}` need two positive ends")]
    NotPositive(String),
}

impl AxisError {
    /// What to do about it, where values are written in this form.
    pub fn remedy<'a>(&self, form: &'a str) -> &'a str {
        match self {
            AxisError::Reserved(_) => "rename the symbol in the scene",
            _ => form,
        }
    }
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
                    return Err(AxisError::Range(text.to_owned()));
                }
                if count > MOST_ROWS {
                    return Err(AxisError::TooMany(text.to_owned()));
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
        match symbol.trim() {
            "" => Err(form()),
            symbol => Axis::new(symbol, values),
        }
    }
}

impl Axis {
    /// A symbol that takes these values.
    ///
    /// # Errors
    /// There is no value, there are too many, one is beyond the range of doubles, or the symbol is called as a column is.
    pub fn new(symbol: &str, values: Vec<Rational>) -> Result<Axis, AxisError> {
        let symbol = symbol.to_owned();
        let is_double = |value: &Rational| {
            let double = crate::nearest(value);
            double.is_finite() && (double == 0.0) == (*value == Rational::default())
        };
        if TEXTS.contains(&symbol.as_str()) {
            Err(AxisError::Reserved(symbol))
        } else if values.is_empty() {
            Err(AxisError::Empty(symbol))
        } else if values.len() > MOST_ROWS {
            Err(AxisError::TooMany(symbol))
        } else if !values.iter().all(is_double) {
            Err(AxisError::NotADouble(symbol))
        } else {
            Ok(Axis { symbol, values })
        }
    }
}

/// What is asked of the scene at each value.
#[derive(Clone, PartialEq, Debug)]
pub struct ToSweep {
    /// Values of these quantities, of all observables where none is named, at these times.
    pub quantities: Vec<String>,
    pub at: Vec<Time>,
    /// The largest or smallest values of these quantities between two times, to the usual end where none is given.
    pub extrema: Vec<(Goal, String)>,
    pub from: Time,
    pub to: Option<Time>,
    /// How often each contact closes, how long it is closed at first, its impulse in that time, and its coefficient of
    /// restitution.
    pub contacts: bool,
}

/// A time as it was given, what columns call it, and what errors call it.
#[derive(Clone, PartialEq, Debug)]
pub struct Time {
    pub given: Given,
    pub label: String,
    pub option: &'static str,
}

impl Time {
    fn of(&self, problem: &Problem) -> Result<Rational, PictureError> {
        Ok(problem.time(self.option, self.given.clone())?)
    }
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

    /// Finds mistakes in what is asked: the scene of the first row, or of the last if only that can be read.
    ///
    /// # Errors
    /// A scene that cannot be read, or a quantity or time that it does not have.
    pub fn check(&self) -> Result<Problem, PictureError> {
        let last = self.count().unwrap_or(1).saturating_sub(1);
        let problem = self.problem(0).or_else(|_| self.problem(last))?;
        let extrema = self.asked.extrema.iter().map(|(_, name)| name);
        for name in self.asked.quantities.iter().chain(extrema) {
            problem.wanted(name)?;
        }
        for at in &self.asked.at {
            at.of(&problem)?;
        }
        if !self.asked.extrema.is_empty() {
            self.window(&problem)?;
        }
        Ok(problem)
    }

    /// The columns of a row that is complete.
    ///
    /// # Errors
    /// As [`Sweep::check`]; or contacts that cannot be told.
    pub fn columns(&self) -> Result<Vec<String>, PictureError> {
        let problem = self.check()?;
        let asked = self.asked;
        let mut columns: Vec<String> = self.axes.iter().map(|axis| axis.symbol.clone()).collect();
        for name in self.names(&problem) {
            let wanted = problem.wanted(name)?;
            columns.extend(asked.at.iter().map(|at| value_column(&problem, &wanted, at)));
        }
        for (goal, name) in &asked.extrema {
            columns.extend(extremum_columns(&problem, *goal, &problem.wanted(name)?));
        }
        if asked.contacts {
            let start = problem.history(Some(&Rational::default()), DIGITS)?;
            columns.extend(start.contacts.iter().flat_map(|own| contact_columns(&problem, own)));
        }
        Ok(columns)
    }

    /// The quantities whose values are asked for.
    fn names<'a>(&'a self, problem: &'a Problem) -> Vec<&'a str> {
        match &self.asked.quantities[..] {
            [] => problem.observables(),
            names => names.iter().map(String::as_str).collect(),
        }
    }

    /// A symbol that is given two values.
    pub fn twice(&self) -> Option<&str> {
        let names: Vec<String> =
            self.axes.iter().map(|axis| language::normalise_name(&axis.symbol)).collect();
        let is_twice =
            |i: &usize| self.set.contains_key(&names[*i]) || names[..*i].contains(&names[*i]);
        (0..self.axes.len()).find(is_twice).map(|i| self.axes[i].symbol.as_str())
    }

    /// All that the rows depend on.
    pub fn request(&self) -> Json {
        let axes = self.axes.iter().map(|axis| {
            let values: Vec<String> = axis.values.iter().map(ToString::to_string).collect();
            json!([axis.symbol, values])
        });
        let set = self.set.iter().map(|(name, value)| json!([name, value.to_string()]));
        json!({
            "wavestep": env!("CARGO_PKG_VERSION"),
            "text": self.text,
            "set": set.collect::<Vec<_>>(),
            "over": axes.collect::<Vec<_>>(),
            "asked": format!("{:?}", self.asked),
        })
    }

    fn window(&self, problem: &Problem) -> Result<[Rational; 2], PictureError> {
        let to = self.asked.to.as_ref().map(|to| to.of(problem)).transpose()?;
        picture::window(problem, self.asked.from.of(problem)?, to)
    }

    fn values(&self, index: usize) -> Values {
        let mut values = self.set.clone();
        for (symbol, value) in self.place(index) {
            values.insert(language::normalise_name(symbol), value.clone());
        }
        values
    }

    fn problem(&self, index: usize) -> Result<Problem, PictureError> {
        Ok(Problem::of_text(self.name, self.text, &self.values(index))?)
    }

    /// Whether a row that was kept can be the one of this index: its symbols have these values, and the rest numbers
    /// or, in the columns for it, text.
    pub fn is_row(&self, index: usize, row: &Row) -> bool {
        let is_here = |(symbol, value): (&str, &Rational)| {
            row.get(symbol) == Some(&json!(crate::nearest(value)))
        };
        let is_cell = |(name, value): (&String, &Json)| match TEXTS.contains(&name.as_str()) {
            true => value.is_string(),
            false => value.is_number() || value.is_null(),
        };
        self.place(index).into_iter().all(is_here) && row.iter().all(is_cell)
    }

    /// A row. What cannot be answered at its values is left out, and the first reason is told.
    pub fn row(&self, index: usize) -> Row {
        let place = self.place(index).into_iter();
        let mut row: Row = place
            .map(|(symbol, value)| (symbol.to_owned(), json!(crate::nearest(value))))
            .collect();
        let mut notes = Vec::new();
        if let Err(error) = self.answer(index, (&mut row, &mut notes)) {
            let error = error.to_string().replace('\n', " ");
            row.insert(ERROR.to_owned(), json!(error));
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
        let asked = self.asked;
        let times = asked.at.iter().map(|at| at.of(&problem)).collect::<Result<Vec<_>, _>>()?;
        let mut last = times.iter().max().cloned().unwrap_or_default();
        let digits = Digits {
            count: DIGITS,
            max_bits: VALUE_BITS,
            limit: Limit::Right,
            count_echoes: false,
            undecided: Undecided::Refused,
        };
        for name in self.names(&problem).into_iter().filter(|_| !times.is_empty()) {
            let wanted = problem.wanted(name)?;
            let found = problem.proven(&wanted, &times, digits, &|| ())?;
            for (at, value) in asked.at.iter().zip(&found.values) {
                put(row, value_column(&problem, &wanted, at), Some(value));
            }
        }
        if !asked.extrema.is_empty() {
            let window = self.window(&problem)?;
            last = last.max(window[1].clone());
            let names = asked.extrema.iter().map(|(_, name)| problem.wanted(name));
            let wanted = names.collect::<Result<Vec<_>, _>>()?;
            let signals = problem.signals_on(&wanted, window.each_ref(), Purpose::Search);
            for (((goal, _), wanted), signal) in asked.extrema.iter().zip(&wanted).zip(signals) {
                let found = Search::new(&*signal?)?.extremum(*goal, DIGITS, SEARCH_BITS)?;
                let [value, time] = extremum_columns(&problem, *goal, wanted);
                put(row, value, Some(&found.value));
                put(row, time, first(&found));
            }
        }
        if asked.contacts {
            let until = asked.to.as_ref().map(|to| to.of(&problem)).transpose()?;
            let history = problem.history(until.as_ref(), DIGITS)?;
            history.contacts.iter().for_each(|contact| put_contact(row, &problem, contact));
            if let Ending::Followed(time) = &history.ending {
                let teller = Teller { problem: &problem, digits: DIGITS, longest_fraction: DIGITS };
                let time = teller.time(time);
                notes.push(format!("followed until t = {time}; later contacts are not known"));
            }
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

fn put_contact(row: &mut Row, problem: &Problem, contact: &ContactSummary) {
    let [count, duration, impulse, restitution] = contact_columns(problem, contact);
    row.insert(count, json!(contact.durations.len() as f64));
    put(row, duration, contact.durations.first().and_then(Option::as_ref));
    put(row, impulse, contact.impulses.first());
    put(row, restitution, contact.restitution.as_ref());
}

/// A column with its unit, where there is one.
fn in_unit(problem: &Problem, name: String, dimension: Dimension) -> String {
    match dimension.unit() {
        unit if problem.has_units() && !unit.is_empty() => format!("{name} [{unit}]"),
        _ => name,
    }
}

fn value_column(problem: &Problem, wanted: &Wanted, at: &Time) -> String {
    in_unit(problem, format!("{}({})", wanted.name, at.label), wanted.dimension)
}

fn extremum_columns(problem: &Problem, goal: Goal, wanted: &Wanted) -> [String; 2] {
    let which = if goal == Goal::Largest { "max" } else { "min" };
    let value = format!("{which}({})", wanted.name);
    let time = format!("time of {value}");
    [in_unit(problem, value, wanted.dimension), in_unit(problem, time, Dimension::TIME)]
}

fn contact_columns(problem: &Problem, contact: &ContactSummary) -> [String; 4] {
    let name = contact.between.join("-");
    let columns = [
        ("contacts", Dimension::NONE),
        ("contact time", Dimension::TIME),
        ("impulse", Dimension::MOMENTUM),
        ("restitution", Dimension::NONE),
    ];
    columns.map(|(what, dimension)| in_unit(problem, format!("{what} {name}"), dimension))
}
