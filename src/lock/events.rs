//! Locked events of a scene whose contacts open, and what became of each contact.
//!
//! The formulas of waves are those of closed contacts and are not locked here.

use crate::ball::{Attempt, Ball, Decimal, Precisions};
use crate::history::{ContactSummary, Ending, Event, History, HistoryError};
use crate::lock::difference::{Difference, both, compared};
use crate::lock::stated::of_scene;
use crate::lock::{Contents, LIMIT_BITS, Lock, LockError, Request, Values};
use crate::network::Network;
use crate::planner::{self, Purpose};
use crate::signal::{Limit, Value, value};
use num_bigint::BigInt;
use num_traits::Zero;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use wavestep_polynomial::Rational;

/// The longest fraction that is locked; numbers with longer ones are rounded.
const MAX_FRACTION: usize = 60;

/// The history is followed with up to this many times the digits of the lock, until all numbers have
/// theirs.
const MOST_TIMES: u64 = 4;

/// The events of a scene.
///
/// # Invariants
/// Events and contacts are numbered from 1, and each of their facts has a name of its own.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(super) struct Events {
    /// The scene time until which contacts are followed.
    pub until: Option<Rational>,
    pub events: BTreeMap<usize, Facts>,
    pub contacts: BTreeMap<usize, Facts>,
    /// How the history ends.
    pub ending: String,
}

/// The facts of an event or a contact, by name, in the order in which they are written.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(super) struct Facts(pub Vec<(String, String)>);

impl Lock {
    /// Follows the contacts of a scene until a scene time, or until nothing can meet again, and takes
    /// down their events and the values of all observables.
    pub fn of_events(
        network: &Network,
        until: Option<Rational>,
        request: &Request,
    ) -> Result<Lock, LockError> {
        let request = request.in_order()?;
        let attempt = |digits| {
            let found = Events::of(network, until.as_ref(), &request, digits as usize);
            Ok(match found.and_then(|events| Ok((events, values(network, &request, digits)?))) {
                Err(error @ LockError::AccuracyNotReached(_)) => Attempt::NotYet(error),
                found => Attempt::Done(found?),
            })
        };
        let digits = request.digits as u64;
        let precisions = Precisions::doubling(digits, MOST_TIMES * digits);
        let (events, values) = precisions.raise(attempt).and_then(Attempt::done)?;
        let stated = of_scene(network.scene());
        Ok(Lock { stated, request, contents: Contents::Events(events), values })
    }
}

/// The values of all observables, from enclosures with so many digits.
fn values(network: &Network, request: &Request, digits: u64) -> Result<Values, LockError> {
    let writer = Writer { digits: request.digits };
    let observables = network.observables().iter().map(|observed| (&observed.name, observed));
    let purpose = Purpose::Values { digits: digits as usize };
    let signal = |observed, window| Ok(planner::of_scene(network, observed, window, purpose)?);
    request.values(observables, signal, |name, signal, time| {
        let value = value(&**signal, time, Limit::Right, digits as usize, LIMIT_BITS);
        writer.number(&value.map_err(HistoryError::from)?, || format!("{name}({time})"))
    })
}

impl Events {
    /// The events of a history that is followed with so many digits.
    fn of(
        network: &Network,
        until: Option<&Rational>,
        request: &Request,
        digits: usize,
    ) -> Result<Events, LockError> {
        let history = History::of(network, until, digits)?;
        let writer = Writer { digits: request.digits };
        let mut events = BTreeMap::new();
        for (number, event) in (1..).zip(&history.events) {
            events.insert(number, writer.event(number, event)?);
        }
        let mut contacts = BTreeMap::new();
        for (number, contact) in (1..).zip(&history.contacts) {
            contacts.insert(number, writer.contact(number, contact)?);
        }
        let ending = match &history.ending {
            Ending::Parted => "parted".to_owned(),
            Ending::NoContact => "no contact".to_owned(),
            Ending::Followed(time) => {
                format!("followed until {}", writer.number(time, || "the end".to_owned())?)
            }
        };
        Ok(Events { until: until.cloned(), events, contacts, ending })
    }

    pub fn differences(&self, now: &Events) -> Vec<Difference> {
        let name = |number: &usize| format!("event {number}");
        let mut differences = compared(&self.events, &now.events, name, differing_facts);
        let name = |number: &usize| format!("contact {number}");
        differences.extend(compared(&self.contacts, &now.contacts, name, differing_facts));
        let ending = |events: &Events| BTreeMap::from([((), events.ending.clone())]);
        let name = |(): &()| "ending".to_owned();
        differences.extend(compared(&ending(self), &ending(now), name, both));
        differences
    }
}

fn differing_facts(old: &Facts, new: &Facts) -> Vec<String> {
    let by_name = |facts: &Facts| facts.0.iter().cloned().collect::<BTreeMap<String, String>>();
    let (old_facts, new_facts) = (by_name(old), by_name(new));
    let mut seen = BTreeSet::new();
    let names = old.0.iter().chain(&new.0).map(|(name, _)| name);
    let mut lines = Vec::new();
    for name in names.filter(|name| seen.insert(*name)) {
        lines.push(match (old_facts.get(name), new_facts.get(name)) {
            (Some(old), Some(new)) if old == new => continue,
            (Some(old), Some(new)) => format!("{name}: locked {old}, now {new}"),
            (Some(old), None) => format!("{name}: locked {old}, not there now"),
            (None, new) => format!("{name}: not locked, now {}", new.map_or("", String::as_str)),
        });
    }
    if lines.is_empty() { vec!["the same facts stand in another order".to_owned()] } else { lines }
}

/// Writes numbers with so many digits.
struct Writer {
    digits: usize,
}

impl Writer {
    fn event(&self, number: usize, event: &Event) -> Result<Facts, LockError> {
        let mut numbers = vec![("time".to_owned(), &event.time)];
        let moments = ["before", "after"];
        for (moment, force) in moments.iter().zip(&event.forces) {
            numbers.push((format!("force {moment}"), force));
        }
        for (side, name) in event.between.iter().enumerate().filter(|(_, name)| *name != "wall") {
            for (moment, pair) in moments.iter().zip(&event.velocities) {
                numbers.push((format!("velocity of {name} {moment}"), &pair[side]));
            }
        }
        let mut facts = vec![
            ("kind".to_owned(), event.kind.word().to_owned()),
            ("between".to_owned(), event.between.join(" | ")),
        ];
        for (name, value) in numbers {
            let value = self.number(value, || format!("the {name} of event {number}"))?;
            facts.push((name, value));
        }
        Ok(Facts(facts))
    }

    fn contact(&self, number: usize, contact: &ContactSummary) -> Result<Facts, LockError> {
        let mut facts = vec![("between".to_owned(), contact.between.join(" | "))];
        let told = |name: &str, value: &Value| {
            let value = self.number(value, || format!("the {name} of contact {number}"))?;
            Ok::<_, LockError>((name.to_owned(), value))
        };
        for (time, (duration, impulse)) in
            (1..).zip(contact.durations.iter().zip(&contact.impulses))
        {
            let name = format!("duration {time}");
            facts.push(match duration {
                Some(duration) => told(&name, duration)?,
                None => (name, "still closed".to_owned()),
            });
            facts.push(told(&format!("impulse {time}"), impulse)?);
        }
        if let Some(restitution) = &contact.restitution {
            facts.push(told("restitution", restitution)?);
        }
        Ok(Facts(facts))
    }

    /// A rational as a fraction, where that is short; else its digits. A number that may be zero, and is
    /// nearer to it than one unit in the last of so many decimal places, is `0 ± 1e-20`, whatever enclosure
    /// proved it.
    fn number(&self, value: &Value, what: impl FnOnce() -> String) -> Result<String, LockError> {
        let ball = match value {
            Value::Exact(value) => {
                let fraction = value.to_string();
                return Ok(match fraction.len() <= MAX_FRACTION {
                    true => fraction,
                    false => Decimal::from_rational(value, self.digits).0.to_string(),
                });
            }
            Value::Certified { ball, .. } | Value::Enclosed(ball) => ball,
        };
        if let Some(decimal) = ball.proven_digits(self.digits)
            && !decimal.is_zero()
        {
            return Ok(decimal.to_string());
        }
        let places = u32::try_from(self.digits).unwrap_or(u32::MAX);
        let bound = Rational::new(1.into(), BigInt::from(10).pow(places));
        let [low, high] = [-&bound, bound].map(|end| Ball::from_rational(&end, 64));
        let above = ball.subtract(&low, 64).sign() == Some(Ordering::Greater);
        let below = ball.subtract(&high, 64).sign() == Some(Ordering::Less);
        match above && below && ball.contains(&Rational::zero()) {
            true => Ok(format!("0 ± 1e-{}", self.digits)),
            false => Err(LockError::AccuracyNotReached(what())),
        }
    }
}
