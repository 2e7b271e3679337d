//! Locks of scenes whose contacts open: their events, what became of each contact, and values.
//!
//! The formulas of waves are those of closed contacts and are not locked here. Numbers are rational and
//! exact, or rounded correctly, so they are the same on every machine.

use crate::ball::{Attempt, Ball, Decimal, Precisions};
use crate::evaluate::{Limit, Value, value};
use crate::history::{
    ContactSummary, Ending, Event, EventKind, FollowedSignal, History, HistoryError,
};
use crate::limits::MAX_DIGITS;
use crate::lock::LIMIT_BITS;
use crate::lock::difference::{Difference, compared};
use crate::lock::error::LockError;
use crate::lock::scene::stated;
use crate::network::Network;
use num_bigint::BigInt;
use num_traits::Zero;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use wavestep_polynomial::Rational;

/// The longest fraction that is locked; numbers with longer ones are rounded.
const MAX_FRACTION: usize = 60;

/// With how many times the digits asked for the history is told at most, so that all that is locked has
/// its own.
const MOST_TIMES: u64 = 4;

/// What is locked of a history.
///
/// # Invariants
/// Events and contacts are numbered from 1, and each of their facts has a name of its own.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct HistoryLock {
    /// What the scene states of itself: title, line, observables.
    pub(super) stated: BTreeMap<String, String>,
    pub(super) request: HistoryRequest,
    pub(super) events: BTreeMap<usize, Facts>,
    pub(super) contacts: BTreeMap<usize, Facts>,
    /// How the history ends.
    pub(super) ending: String,
    pub(super) values: BTreeMap<(String, Rational), String>,
}

/// What is told of an event or a contact, by name, in the order in which it is written.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(super) struct Facts(pub(super) Vec<(String, String)>);

/// What to lock of a history.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct HistoryRequest {
    /// The scene time until which contacts are followed; without it until nothing can meet again, as in
    /// [`History::of`].
    pub until: Option<Rational>,
    /// The scene times at which the values of all observables are locked, each the limit from later times.
    pub times: Vec<Rational>,
    /// How many significant digits numbers have that are not rational.
    pub digits: usize,
    /// The values that the symbols had when the scene was read.
    pub set: BTreeMap<String, Rational>,
}

impl Default for HistoryRequest {
    fn default() -> HistoryRequest {
        HistoryRequest { until: None, times: Vec::new(), digits: 20, set: BTreeMap::new() }
    }
}

type Outcome<T> = Result<T, LockError>;

impl HistoryLock {
    /// Follows a scene and takes down what is to be locked.
    ///
    /// # Errors
    /// [`LockError`] where the history is not told, a number has no proven digits, or the digits are
    /// not between 1 and [`MAX_DIGITS`].
    ///
    /// # Cost
    /// That of [`History::of`], and again for each observable.
    pub fn derive(network: &Network, request: &HistoryRequest) -> Outcome<HistoryLock> {
        if request.digits == 0 || request.digits > MAX_DIGITS {
            return Err(LockError::Digits(request.digits));
        }
        let mut request = request.clone();
        request.times.sort();
        request.times.dedup();
        let attempt = |digits| match told(network, &request, digits as usize) {
            Err(error @ LockError::AccuracyNotReached(_)) => Ok(Attempt::NotYet(error)),
            told => Ok(Attempt::Done(told?)),
        };
        let digits = request.digits as u64;
        Precisions::doubling(digits, MOST_TIMES * digits).raise(attempt).and_then(Attempt::done)
    }

    /// What was asked for.
    pub fn request(&self) -> &HistoryRequest {
        &self.request
    }

    /// How many events and how many values are locked.
    pub fn counts(&self) -> (usize, usize) {
        (self.events.len(), self.values.len())
    }

    /// How `now` differs from this lock, event by event, contact by contact and value by value. What only
    /// one of them has is a difference as well.
    pub fn differences(&self, now: &HistoryLock) -> Vec<Difference> {
        let both =
            |old: &String, new: &String| vec![format!("locked {old}"), format!("now    {new}")];
        let mut differences = compared(&self.stated, &now.stated, String::clone, both);
        let name = |number: &usize| format!("event {number}");
        differences.extend(compared(&self.events, &now.events, name, of_facts));
        let name = |number: &usize| format!("contact {number}");
        differences.extend(compared(&self.contacts, &now.contacts, name, of_facts));
        let ending = |ending: &String| BTreeMap::from([((), ending.clone())]);
        let name = |(): &()| "ending".to_owned();
        differences.extend(compared(&ending(&self.ending), &ending(&now.ending), name, both));
        let name = |(quantity, time): &(String, Rational)| format!("{quantity}({time})");
        differences.extend(compared(&self.values, &now.values, name, both));
        differences
    }
}

/// The facts that differ, one in a line.
fn of_facts(old: &Facts, new: &Facts) -> Vec<String> {
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
    match lines.is_empty() {
        true => vec!["the same facts stand in another order".to_owned()],
        false => lines,
    }
}

/// The lock, from a history that is told with so many digits.
fn told(network: &Network, request: &HistoryRequest, digits: usize) -> Outcome<HistoryLock> {
    let history = History::of(network, request.until.as_ref(), digits)?;
    let teller = Teller { digits: request.digits };
    let mut events = BTreeMap::new();
    for (number, event) in (1..).zip(&history.events) {
        events.insert(number, teller.event(number, event)?);
    }
    let mut contacts = BTreeMap::new();
    for (number, contact) in (1..).zip(&history.contacts) {
        contacts.insert(number, teller.contact(number, contact)?);
    }
    let ending = match &history.ending {
        Ending::Parted => "parted".to_owned(),
        Ending::Followed(time) => {
            format!("followed until {}", teller.number(time, || "the end".to_owned())?)
        }
    };
    let mut values = BTreeMap::new();
    for observable in network.scene().observables.iter().filter(|_| !request.times.is_empty()) {
        let name = &observable.name;
        let window = [&request.times[0], &request.times[request.times.len() - 1]];
        let signal = FollowedSignal::new(network, name, window)?;
        for time in &request.times {
            let value = value(&signal, time, Limit::Right, digits, LIMIT_BITS);
            let value = value.map_err(HistoryError::from)?;
            let value = teller.number(&value, || format!("{name}({time})"))?;
            values.insert((name.clone(), time.clone()), value);
        }
    }
    let stated = stated(network.scene());
    Ok(HistoryLock { stated, request: request.clone(), events, contacts, ending, values })
}

/// Writes numbers with so many digits.
struct Teller {
    digits: usize,
}

impl Teller {
    fn event(&self, number: usize, event: &Event) -> Outcome<Facts> {
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
            ("kind".to_owned(), word(event.kind).to_owned()),
            ("between".to_owned(), event.between.join(" | ")),
        ];
        for (name, value) in numbers {
            let value = self.number(value, || format!("the {name} of event {number}"))?;
            facts.push((name, value));
        }
        Ok(Facts(facts))
    }

    fn contact(&self, number: usize, contact: &ContactSummary) -> Outcome<Facts> {
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

    /// A rational as a fraction, where that is short; else its digits. What is not decided to be zero,
    /// and is nearer to it than one unit in the last of so many decimal places, is `0 ± 1e-20`: the bound is
    /// that of the digits, whatever enclosure proved it.
    fn number(&self, value: &Value, what: impl FnOnce() -> String) -> Outcome<String> {
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

/// The name of a kind of events.
pub(super) fn word(kind: EventKind) -> &'static str {
    match kind {
        EventKind::Impact => "impact",
        EventKind::Opening => "opening",
        EventKind::Release => "release",
        EventKind::Closing => "closing",
    }
}
