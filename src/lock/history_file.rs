//! Locks of histories as text.
//!
//! ```text
//! # wavestep lock 2
//! digits 20
//! set mu = 1
//! stated line = free - hammer | rod - fixed
//! …
//! holds 3 statements, 4 events, 1 contacts, 1 values
//!
//! event 1 kind = impact
//! event 1 between = hammer | rod
//! event 1 time = 0
//! …
//! contact 1 between = hammer | rod
//! contact 1 duration 1 = 3.0676676416183063459
//! …
//! ending = parted
//!
//! value velocity(1/2) = 0.60653065971263342360
//! ```
//!
//! A heading with the version, settings, what is stated, then a fact in each line. Comments begin with `#`.

use crate::history::EventKind;
use crate::language::{Diagnostic, Source, normalise_name};
use crate::limits::MAX_DIGITS;
use crate::lock::file::{
    HEADING, Line, check_heading, count, equation, holds_as_said, is_value, lines, number, refused,
    value_line, write_stated, write_values,
};
use crate::lock::history::{Facts, HistoryLock, HistoryRequest, word};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The version of files of histories.
pub(super) const VERSION: u32 = 2;

const KINDS: [EventKind; 4] =
    [EventKind::Impact, EventKind::Opening, EventKind::Release, EventKind::Closing];

impl HistoryLock {
    /// The lock as text, one fact in each line.
    pub fn to_text(&self) -> String {
        let HistoryRequest { until, digits, set, .. } = &self.request;
        let mut text = format!("{HEADING}{VERSION}\n");
        if let Some(until) = until {
            let _ = writeln!(text, "until {until}");
        }
        let _ = writeln!(text, "digits {digits}");
        write_stated(&mut text, set, &self.stated);
        let _ = writeln!(text, "holds {}", self.contents());
        for (what, all) in [("event", &self.events), ("contact", &self.contacts)] {
            for (number, Facts(facts)) in all {
                text.push('\n');
                for (name, value) in facts {
                    let _ = writeln!(text, "{what} {number} {name} = {value}");
                }
            }
        }
        let _ = writeln!(text, "\nending = {}", self.ending);
        write_values(&mut text, &self.values);
        text
    }

    /// How much the lock holds.
    fn contents(&self) -> String {
        let HistoryLock { stated, events, contacts, values, .. } = self;
        format!(
            "{} statements, {} events, {} contacts, {} values",
            stated.len(),
            events.len(),
            contacts.len(),
            values.len()
        )
    }

    /// Reads a lock.
    ///
    /// # Errors
    /// The first line that is none of a lock of a history, with its place.
    pub fn read(source: &Source) -> Result<HistoryLock, Diagnostic> {
        let lines = lines(source);
        check_heading(source, &lines, VERSION)?;
        let mut lock = HistoryLock {
            stated: BTreeMap::new(),
            request: HistoryRequest::default(),
            events: BTreeMap::new(),
            contacts: BTreeMap::new(),
            ending: String::new(),
            values: BTreeMap::new(),
        };
        let mut said = None;
        for line in lines.iter().filter(|line| !line.text.is_empty() && !line.text.starts_with('#'))
        {
            match line.text.split_once(' ') {
                Some(("holds", rest)) => said = Some((rest.trim(), *line)),
                Some((word, rest)) => lock.read_line(source, *line, word, rest)?,
                None => return Err(refused(source, *line, "remove it, or lock again")),
            }
        }
        holds_as_said(source, lines[0], &lock.contents(), said)?;
        Ok(lock)
    }

    /// Takes one line that begins with `word`.
    fn read_line(
        &mut self,
        source: &Source,
        line: Line<'_>,
        word: &str,
        rest: &str,
    ) -> Result<(), Diagnostic> {
        let refuse = |remedy: &str| Err(refused(source, line, remedy));
        let is_new = match word {
            "until" => {
                let until = number(source, line, rest)?;
                self.request.until.replace(until).is_none()
            }
            "digits" => {
                self.request.digits = count(source, line, rest)?;
                if self.request.digits == 0 || self.request.digits > MAX_DIGITS {
                    return refuse(&format!("numbers have 1 to {MAX_DIGITS} digits: lock again"));
                }
                true
            }
            "set" => {
                let (name, value) = equation(source, line, rest)?;
                let value = number(source, line, value)?;
                self.request.set.insert(normalise_name(name), value).is_none()
            }
            "stated" => {
                let (what, value) = equation(source, line, rest)?;
                self.stated.insert(what.to_owned(), value.to_owned()).is_none()
            }
            "event" | "contact" => {
                let (left, value) = equation(source, line, rest)?;
                let Some((place, name)) = left.split_once(' ') else {
                    return refuse("write it as `event 1 time = 0`");
                };
                if !is_fact(name, value) {
                    return refuse("restore the file, or lock again");
                }
                let all = if word == "event" { &mut self.events } else { &mut self.contacts };
                let Facts(facts) = all.entry(count(source, line, place)?).or_default();
                let is_new = facts.iter().all(|(known, _)| known != name);
                facts.push((name.to_owned(), value.to_owned()));
                is_new
            }
            "ending" => {
                let Some(ending) = rest.trim().strip_prefix('=').map(str::trim) else {
                    return refuse("write it as `ending = parted`");
                };
                let is_new = self.ending.is_empty();
                self.ending = ending.to_owned();
                is_new && !ending.is_empty()
            }
            "value" => {
                let (quantity, time, value) = value_line(source, line, rest)?;
                if !self.request.times.contains(&time) {
                    self.request.times.push(time.clone());
                }
                self.values.insert((quantity, time), value).is_none()
            }
            _ => return refuse("remove it, or lock again"),
        };
        match is_new {
            true => Ok(()),
            false => refuse("it stands there twice: remove one of the two"),
        }
    }
}

/// Whether a fact of this name can be so: a kind of events, names, a state of a contact, or a number.
fn is_fact(name: &str, value: &str) -> bool {
    match name {
        "kind" => KINDS.into_iter().any(|kind| word(kind) == value),
        "between" => value.contains(" | "),
        _ if name.starts_with("duration") && value == "still closed" => true,
        _ => is_value(value),
    }
}
