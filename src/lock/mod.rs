//! Locks: derived forms and certified values in a small text file, to be compared with what is
//! derived later.
//!
//! A [`Lock`] is derived, written as text, read back, and compared with another. It holds the pieces of a
//! recurrence, or the events of a scene whose contacts open, and values. Pieces are compared as exact
//! expressions, term by term; numbers are rational or correctly rounded, and therefore the same on every
//! machine.

mod difference;
mod error;
mod events;
mod pieces;
mod stated;
mod text;

use crate::limits::MAX_DIGITS;
use events::Events;
use pieces::Pieces;
use std::collections::BTreeMap;
use wavestep_polynomial::Rational;

pub use difference::Difference;
pub use error::LockError;
pub use pieces::Derivable;

/// The highest precision of a value.
const LIMIT_BITS: u64 = 1 << 18;

/// Locked results, and what was locked.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lock {
    /// The title and other statements of the recurrence or scene, by name.
    stated: BTreeMap<String, String>,
    request: Request,
    contents: Contents,
    values: Values,
}

/// The pieces or events of a lock.
#[derive(Clone, PartialEq, Eq, Debug)]
enum Contents {
    Pieces(Pieces),
    Events(Events),
}

/// Values by quantity and time.
type Values = BTreeMap<(String, Rational), String>;

#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Request {
    /// The scene times of the values, each the limit from later times.
    pub times: Vec<Rational>,
    /// The number of significant digits.
    pub digits: usize,
    /// The values that the symbols had when the scene was read.
    pub set: BTreeMap<String, Rational>,
}

/// How much is locked besides values.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Extent {
    /// The pieces on the periods from 0 through this one; none where values alone are locked.
    Pieces { through: Option<usize> },
    /// The events of contacts.
    Events {
        /// The scene time until which contacts are followed; without it until nothing can meet again, as
        /// in [`History::of`](crate::history::History::of).
        until: Option<Rational>,
    },
}

impl Default for Request {
    fn default() -> Request {
        Request { times: Vec::new(), digits: 20, set: BTreeMap::new() }
    }
}

impl Request {
    /// The request with its times in order, each once.
    fn in_order(&self) -> Result<Request, LockError> {
        if !(1..=MAX_DIGITS).contains(&self.digits) {
            return Err(LockError::Digits(self.digits));
        }
        let mut request = self.clone();
        request.times.sort();
        request.times.dedup();
        Ok(request)
    }

    /// The values of quantities, by their names, at the times of the request: of each its signal, and how a
    /// value of that is written.
    fn values<'r, 'n, Q, S>(
        &'r self,
        quantities: impl Iterator<Item = (&'n String, Q)>,
        signal: impl Fn(Q, [&'r Rational; 2]) -> Result<S, LockError>,
        written: impl Fn(&str, &S, &Rational) -> Result<String, LockError>,
    ) -> Result<Values, LockError> {
        let mut values = Values::new();
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else {
            return Ok(values);
        };
        for (name, quantity) in quantities {
            let signal = signal(quantity, [first, last])?;
            for time in &self.times {
                values.insert((name.clone(), time.clone()), written(name, &signal, time)?);
            }
        }
        Ok(values)
    }
}

impl Lock {
    pub fn request(&self) -> &Request {
        &self.request
    }

    pub fn extent(&self) -> Extent {
        match &self.contents {
            Contents::Pieces(pieces) => Extent::Pieces { through: pieces.through },
            Contents::Events(events) => Extent::Events { until: events.until.clone() },
        }
    }

    /// The number of pieces or events, and of values.
    pub fn counts(&self) -> (usize, usize) {
        let count = match &self.contents {
            Contents::Pieces(pieces) => pieces.all.len(),
            Contents::Events(events) => events.events.len(),
        };
        (count, self.values.len())
    }
}
