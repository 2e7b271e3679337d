//! Locks: derived forms and certified values in a small text file, to be compared with what is
//! derived later.
//!
//! A [`Lock`] is derived from a recurrence, written as text, read back, and compared with another.
//! Pieces are compared as exact expressions, term by term; values as decimals, which are correctly
//! rounded and therefore the same on every machine. A [`HistoryLock`] holds the events of a scene whose
//! contacts open instead; [`Locked`] is either of them, as it is read from a file.

mod difference;
mod error;
mod file;
mod history;
mod history_file;
mod scene;

use crate::evaluate::{ClosedSignal, Limit, digits};
use crate::export::expression_text;
use crate::expression::{Expression, Fraction};
use crate::language::{Diagnostic, Source};
use crate::limits::MAX_DIGITS;
use crate::recurrence::{Observation, Statement};
use crate::solution::Solution;
use std::collections::BTreeMap;
use wavestep_polynomial::{Rational, Symbol};

pub use difference::Difference;
pub use error::LockError;
pub use history::{HistoryLock, HistoryRequest};

/// How precisely the values of a lock may be worked out.
const LIMIT_BITS: u64 = 1 << 18;

/// What is locked of a recurrence.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lock {
    /// What the recurrence states of itself: title, period, symbols, observables.
    stated: BTreeMap<String, String>,
    request: Request,
    pieces: BTreeMap<(String, usize), Piece>,
    values: BTreeMap<(String, Rational), String>,
}

/// What to lock.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Request {
    /// The last period of which the pieces are locked.
    pub through: usize,
    /// The scene times at which the values of all waves and observables are locked, each the limit
    /// from later times.
    pub times: Vec<Rational>,
    /// How many significant digits the values have.
    pub digits: usize,
    /// The values that the symbols had when the recurrence was read.
    pub set: BTreeMap<String, Rational>,
}

impl Default for Request {
    fn default() -> Request {
        Request { through: 0, times: Vec::new(), digits: 20, set: BTreeMap::new() }
    }
}

/// What a file of locked results holds.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Locked {
    /// Pieces and values of a recurrence.
    Pieces(Lock),
    /// Events and values of a scene whose contacts open.
    History(HistoryLock),
}

impl Locked {
    /// Reads a file of any version.
    ///
    /// # Errors
    /// The first line that is none of a lock, with its place.
    pub fn read(source: &Source) -> Result<Locked, Diagnostic> {
        let lines = file::lines(source);
        Ok(match file::version(source, lines[0])? {
            file::VERSION => Locked::Pieces(Lock::read(source)?),
            _ => Locked::History(HistoryLock::read(source)?),
        })
    }

    /// The text of the file.
    pub fn to_text(&self) -> String {
        match self {
            Locked::Pieces(lock) => lock.to_text(),
            Locked::History(lock) => lock.to_text(),
        }
    }

    /// The values that were put in place of symbols.
    pub fn set(&self) -> &BTreeMap<String, Rational> {
        match self {
            Locked::Pieces(lock) => &lock.request().set,
            Locked::History(lock) => &lock.request().set,
        }
    }

    /// How many pieces or events are locked, and how many values.
    pub fn counts(&self) -> (usize, usize) {
        match self {
            Locked::Pieces(lock) => lock.counts(),
            Locked::History(lock) => lock.counts(),
        }
    }
}

/// A wave function on one period.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Piece {
    variable: Symbol,
    expression: Expression,
}

impl Lock {
    /// Derives what is to be locked.
    ///
    /// # Errors
    /// [`LockError`] where a piece or a value cannot be given, or the digits are not between 1 and
    /// [`MAX_DIGITS`].
    ///
    /// # Cost
    /// That of the pieces and of the values.
    pub fn derive(solution: &Solution, request: &Request) -> Result<Lock, LockError> {
        if request.digits == 0 || request.digits > MAX_DIGITS {
            return Err(LockError::Digits(request.digits));
        }
        let mut request = request.clone();
        request.times.sort();
        request.times.dedup();
        let statement = solution.recurrence().statement();
        let mut pieces = BTreeMap::new();
        for (wave, name) in statement.waves.iter().enumerate() {
            let derived = solution.pieces(wave, 0, request.through)?;
            for (n, expression) in derived.into_iter().enumerate() {
                let piece = Piece { variable: statement.local.clone(), expression };
                pieces.insert((name.clone(), n), piece);
            }
        }
        let mut values = BTreeMap::new();
        if !request.times.is_empty() {
            let observables = statement.observables.iter().map(|observable| &observable.name);
            for name in statement.waves.iter().chain(observables) {
                let quantity = solution.recurrence().observation(name).expect("a known name");
                let window = [&request.times[0], &request.times[request.times.len() - 1]];
                let signal = ClosedSignal::of_recurrence(solution, &quantity, window)?;
                for time in &request.times {
                    let value = digits(&signal, time, Limit::Right, request.digits, LIMIT_BITS)?;
                    let decimal = value.decimal(request.digits).0.to_string();
                    values.insert((name.clone(), time.clone()), decimal);
                }
            }
        }
        Ok(Lock { stated: stated(statement), request, pieces, values })
    }

    /// What was asked for.
    pub fn request(&self) -> &Request {
        &self.request
    }

    /// How many pieces and how many values are locked.
    pub fn counts(&self) -> (usize, usize) {
        (self.pieces.len(), self.values.len())
    }
}

/// What a recurrence states of itself, each in one line.
fn stated(statement: &Statement) -> BTreeMap<String, String> {
    let fraction = |value: &Fraction| expression_text(&value.clone().into());
    let mut stated = BTreeMap::from([
        ("title".to_owned(), statement.title.trim().to_owned()),
        ("period".to_owned(), fraction(&statement.period)),
    ]);
    for (symbol, condition) in statement.assumptions.symbols() {
        let condition = condition.map_or_else(|| "any".to_owned(), ToString::to_string);
        stated.insert(format!("symbol {symbol}"), condition);
    }
    for observable in &statement.observables {
        let seen = observed(&observable.observation, statement);
        stated.insert(format!("observable {}", observable.name), seen);
    }
    stated
}

/// `f(t) - 2*f'(t - mu) + forcing`, in the order of the statement.
fn observed(observation: &Observation, statement: &Statement) -> String {
    let time = &statement.time;
    let grouped = |text: String| if text.contains(' ') { format!("({text})") } else { text };
    let mut terms: Vec<String> = Vec::new();
    for seen in &observation.waves {
        let factor = match &*grouped(expression_text(&seen.coefficient)) {
            "1" => String::new(),
            "-1" => "-".to_owned(),
            coefficient => format!("{coefficient}*"),
        };
        let (wave, prime) = (&statement.waves[seen.wave], if seen.slope { "'" } else { "" });
        let since = match seen.delay.is_zero() {
            true => time.to_string(),
            false => match expression_text(&(-&seen.delay).into()) {
                early if !early.contains(' ') && !early.starts_with('-') => {
                    format!("{time} + {early}")
                }
                _ => format!("{time} - {}", grouped(expression_text(&seen.delay.clone().into()))),
            },
        };
        terms.push(format!("{factor}{wave}{prime}({since})"));
    }
    if !observation.forcing.is_zero() || terms.is_empty() {
        terms.push(expression_text(&observation.forcing));
    }
    terms.join(" + ").replace(" + -", " - ")
}
