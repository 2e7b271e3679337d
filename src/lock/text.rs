//! Locks as text.
//!
//! ```text
//! # wavestep lock 1                                  # wavestep lock 2
//! through 1                                          until 100
//! digits 20                                          digits 20
//! set mu = 1/4                                       set mu = 1
//! stated observable velocity = f(t) + g(t)           stated line = free - hammer | rod - fixed
//! …                                                  …
//! holds 3 statements, 4 pieces, 1 values             holds 3 statements, 4 events, 1 contacts, 1 values
//!
//! f[0](s) = exp(-s)                                  event 1 kind = impact
//! …                                                  event 1 between = hammer | rod
//!                                                    event 1 time = 0
//!                                                    …
//!                                                    contact 1 duration 1 = 3.0676676416183063459
//!                                                    …
//!                                                    ending = parted
//!
//! value f(33/10) = 0.30538526440879106409            value velocity(1/2) = 0.60653065971263342360
//! ```
//!
//! A heading with the version, settings, statements, contents, values. Version 1 holds pieces, as a listing
//! of the language, version 2 events, a fact in each line. Comments begin with `#`. Versions to come read
//! both.

use crate::export::{self, Formula, TEXT_WIDTH};
use crate::history::EventKind;
use crate::language::{Diagnostic, Source, Span, normalise_name, parse_number, read_listing};
use crate::limits::{MAX_DIGITS, MAX_LOCK_BYTES};
use crate::lock::events::{Events, Facts};
use crate::lock::pieces::{ECHO, Piece, Pieces, name};
use crate::lock::{Contents, Lock, Request, Values};
use num_traits::Signed as _;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use wavestep_polynomial::Rational;

/// The versions of files of pieces and of events.
const PIECES: u32 = 1;
const EVENTS: u32 = 2;

const TWICE: &str = "it stands there twice: remove one of the two";
const HEADING: &str = "# wavestep lock ";

/// One line of a file with its place.
#[derive(Clone, Copy)]
struct Line<'a> {
    source: &'a Source,
    text: &'a str,
    span: Span,
}

impl<'a> Line<'a> {
    fn refused(self, remedy: &str) -> Diagnostic {
        let message = "this line cannot be read";
        Diagnostic::new(self.source, message, self.span, "in a lock file").with_remedy(remedy)
    }

    /// The sides of `name = value`.
    fn equation(self, text: &'a str) -> Result<(&'a str, &'a str), Diagnostic> {
        let sides = text.split_once('=').map(|(left, right)| (left.trim(), right.trim()));
        sides.ok_or_else(|| self.refused("write it as `name = value`, or lock again"))
    }

    fn count(self, text: &str) -> Result<usize, Diagnostic> {
        let number = text.trim().parse::<u32>().map(|number| number as usize);
        number.map_err(|_| self.refused("write a whole number, or lock again"))
    }

    fn number(self, text: &str) -> Result<Rational, Diagnostic> {
        parse_number(text).map_err(|_| self.refused("write a number such as 33/10, or lock again"))
    }

    /// Quantity, time and value of `f(33/10) = 0.3`.
    fn value(self, rest: &'a str) -> Result<(String, Rational, String), Diagnostic> {
        let (left, value) = self.equation(rest)?;
        let call = left.strip_suffix(')').and_then(|left| left.split_once('('));
        let Some((quantity, time)) = call else {
            return Err(self.refused("write it as `value f(33/10) = 0.3`"));
        };
        let time = self.number(time)?;
        if time.is_negative() || !is_value(value) {
            return Err(self.refused("write a time from 0 on, and a number"));
        }
        Ok((quantity.to_owned(), time, value.to_owned()))
    }
}

impl Lock {
    /// The lock as text; formulas in lines of at most 100 characters where they can be broken.
    pub fn to_text(&self) -> String {
        let mut text = String::from(HEADING);
        let _ = match &self.contents {
            Contents::Pieces(Pieces { through: Some(through), .. }) => {
                writeln!(text, "{PIECES}\nthrough {through}")
            }
            Contents::Pieces(_) => writeln!(text, "{PIECES}"),
            Contents::Events(Events { until: Some(until), .. }) => {
                writeln!(text, "{EVENTS}\nuntil {until}")
            }
            Contents::Events(_) => writeln!(text, "{EVENTS}"),
        };
        let _ = writeln!(text, "digits {}", self.request.digits);
        for (name, value) in &self.request.set {
            let _ = writeln!(text, "set {name} = {value}");
        }
        for (what, value) in &self.stated {
            let _ = writeln!(text, "stated {what} = {value}");
        }
        let _ = writeln!(text, "holds {}", self.held());
        match &self.contents {
            Contents::Pieces(pieces) => pieces.write(&mut text),
            Contents::Events(events) => events.write(&mut text),
        }
        if !self.values.is_empty() {
            text.push('\n');
        }
        for ((quantity, time), value) in &self.values {
            let _ = writeln!(text, "value {quantity}({time}) = {value}");
        }
        text
    }

    fn held(&self) -> String {
        let contents = match &self.contents {
            Contents::Pieces(pieces) => format!("{} pieces", pieces.all.len()),
            Contents::Events(Events { events, contacts, .. }) => {
                format!("{} events, {} contacts", events.len(), contacts.len())
            }
        };
        format!("{} statements, {contents}, {} values", self.stated.len(), self.values.len())
    }

    pub fn read(source: &Source) -> Result<Lock, Diagnostic> {
        let lines = lines(source);
        let contents = match version(lines[0])? {
            PIECES => Contents::Pieces(Pieces::default()),
            _ => Contents::Events(Events::default()),
        };
        let (stated, values) = (BTreeMap::new(), Values::new());
        let mut lock = Lock { stated, request: Request::default(), contents, values };
        let (mut said, mut once) = (None, BTreeSet::new());
        // The listing of pieces is read with everything else blanked out, so that places stay the same.
        let mut listing = source.text().to_owned().into_bytes();
        for line in &lines {
            let is_setting = match line.text.split_once(' ') {
                _ if line.text.is_empty() || line.text.starts_with('#') => true,
                Some((word @ ("digits" | "holds"), _)) if !once.insert(word) => {
                    return Err(line.refused(TWICE));
                }
                Some(("holds", rest)) => {
                    said = Some((rest.trim(), *line));
                    true
                }
                Some((word, rest)) => lock.read_line(*line, word, rest)?,
                None => false,
            };
            match (is_setting, &lock.contents) {
                (true, _) => listing[line.span.start..line.span.end].fill(b' '),
                (false, Contents::Pieces(_)) => {}
                (false, Contents::Events(_)) => {
                    return Err(line.refused("remove it, or lock again"));
                }
            }
        }
        if let Contents::Pieces(pieces) = &mut lock.contents {
            pieces.read(lines[0], listing)?;
        }
        holds_as_said(lines[0], &lock.held(), said)?;
        if matches!(&lock.contents, Contents::Events(events) if events.ending.is_empty()) {
            let message = "this file does not say how the events end".to_owned();
            let label = "no line `ending = …` follows";
            return Err(incomplete(lines[0], message, lines[0].span, label));
        }
        // Whatever order the lines stand in.
        lock.request.times.sort();
        Ok(lock)
    }

    /// Takes one line that begins with `word`; whether it is a setting, a fact or a value.
    fn read_line(&mut self, line: Line<'_>, word: &str, rest: &str) -> Result<bool, Diagnostic> {
        let is_new = match (word, &mut self.contents) {
            ("digits", contents) => {
                let digits = line.count(rest)?;
                if !(1..=MAX_DIGITS).contains(&digits) {
                    let numbers = match contents {
                        Contents::Pieces(_) => "values",
                        Contents::Events(_) => "numbers",
                    };
                    let remedy = format!("{numbers} have 1 to {MAX_DIGITS} digits: lock again");
                    return Err(line.refused(&remedy));
                }
                self.request.digits = digits;
                true
            }
            ("set", _) => {
                let (name, value) = line.equation(rest)?;
                let value = line.number(value)?;
                self.request.set.insert(normalise_name(name), value).is_none()
            }
            ("stated", _) => {
                let (what, value) = line.equation(rest)?;
                self.stated.insert(what.to_owned(), value.to_owned()).is_none()
            }
            ("value", _) => {
                let (quantity, time, value) = line.value(rest)?;
                if !self.request.times.contains(&time) {
                    self.request.times.push(time.clone());
                }
                self.values.insert((quantity, time), value).is_none()
            }
            ("through", Contents::Pieces(pieces)) => {
                let through = line.count(rest)?;
                pieces.through.replace(through).is_none()
            }
            (_, Contents::Events(events)) => match events.read_line(line, word, rest)? {
                Some(is_new) => is_new,
                None => return Ok(false),
            },
            _ => return Ok(false),
        };
        match is_new {
            true => Ok(true),
            false => Err(line.refused(TWICE)),
        }
    }
}

impl Pieces {
    fn write(&self, text: &mut String) {
        let formula = |((wave, counts), piece): (&(String, Vec<usize>), &Piece)| {
            let Piece { variable, expression } = piece;
            match counts[..] {
                [n] => Formula::piece(wave, n, expression, variable),
                _ => Formula::echo(wave, counts, expression, variable),
            }
        };
        let formulas: Vec<Formula> = self.all.iter().map(formula).collect();
        if formulas.is_empty() {
            return;
        }
        text.push('\n');
        text.push_str(&export::text(&formulas, TEXT_WIDTH));
    }

    /// Reads a listing; `first` is the line that an error points to.
    fn read(&mut self, first: Line<'_>, listing: Vec<u8>) -> Result<(), Diagnostic> {
        let listing = String::from_utf8(listing).expect("whole lines were blanked out");
        if listing.trim().is_empty() {
            return Ok(());
        }
        let blanked = Source::with_limit(first.source.name(), listing, MAX_LOCK_BYTES)?;
        for formula in read_listing(&blanked)? {
            let piece = Piece { variable: formula.variable, expression: formula.expression };
            let mut wave = formula.wave;
            if formula.counts.len() > 1
                && let Some(name) = wave.strip_prefix(ECHO)
            {
                wave = name.to_owned();
            }
            let key = (wave, formula.counts);
            let message = format!("{} stands there twice", name(&key));
            if self.all.insert(key, piece).is_some() {
                return Err(Diagnostic::new(first.source, message, first.span, "in this file")
                    .with_remedy("restore the file, or lock again"));
            }
        }
        Ok(())
    }
}

impl Events {
    fn write(&self, text: &mut String) {
        for (what, all) in [("event", &self.events), ("contact", &self.contacts)] {
            for (number, Facts(facts)) in all {
                text.push('\n');
                for (name, value) in facts {
                    let _ = writeln!(text, "{what} {number} {name} = {value}");
                }
            }
        }
        let _ = writeln!(text, "\nending = {}", self.ending);
    }

    /// Takes one line that begins with `word`; whether it says something new, or `None` if it is no line
    /// of events.
    fn read_line(
        &mut self,
        line: Line<'_>,
        word: &str,
        rest: &str,
    ) -> Result<Option<bool>, Diagnostic> {
        Ok(Some(match word {
            "until" => {
                let until = line.number(rest)?;
                self.until.replace(until).is_none()
            }
            "event" | "contact" => {
                let (left, value) = line.equation(rest)?;
                let Some((place, name)) = left.split_once(' ') else {
                    return Err(line.refused("write it as `event 1 time = 0`"));
                };
                if !is_fact(name, value) {
                    return Err(line.refused("restore the file, or lock again"));
                }
                let all = if word == "event" { &mut self.events } else { &mut self.contacts };
                let Facts(facts) = all.entry(line.count(place)?).or_default();
                let is_new = facts.iter().all(|(known, _)| known != name);
                facts.push((name.to_owned(), value.to_owned()));
                is_new
            }
            "ending" => {
                let Some(ending) = rest.trim().strip_prefix('=').map(str::trim) else {
                    return Err(line.refused("write it as `ending = parted`"));
                };
                let is_new = self.ending.is_empty();
                self.ending = ending.to_owned();
                is_new && !ending.is_empty()
            }
            _ => return Ok(None),
        }))
    }
}

/// Whether a fact of this name can be so: a kind of events, names, a state of a contact, or a number.
fn is_fact(name: &str, value: &str) -> bool {
    match name {
        "kind" => EventKind::ALL.into_iter().any(|kind| kind.word() == value),
        "between" => value.contains(" | "),
        _ if name.starts_with("duration") && value == "still closed" => true,
        _ => is_value(value),
    }
}

fn lines(source: &Source) -> Vec<Line<'_>> {
    let mut start = 0;
    let mut lines = Vec::new();
    for line in source.text().split('\n') {
        let text = line.trim_end_matches('\r');
        lines.push(Line { source, text, span: Span::new(start, start + text.len()) });
        start += line.len() + 1;
    }
    lines
}

fn version(first: Line<'_>) -> Result<u32, Diagnostic> {
    let Some(version) = first.text.strip_prefix(HEADING) else {
        return Err(Diagnostic::new(
            first.source,
            "this is not a lock file",
            first.span,
            format!("expected `{HEADING}{PIECES}`"),
        )
        .with_remedy("write one with `wavestep lock SCENE --through N -o FILE`"));
    };
    match version.trim().parse::<u32>() {
        Ok(version) if (PIECES..=EVENTS).contains(&version) => Ok(version),
        _ => Err(Diagnostic::new(
            first.source,
            format!("this file has version {}", version.trim()),
            first.span,
            format!("versions up to {EVENTS} are supported"),
        )
        .with_remedy("use a newer wavestep, or lock again with this one")),
    }
}

/// Something in the file is missing.
fn incomplete(first: Line<'_>, message: String, span: Span, label: &str) -> Diagnostic {
    Diagnostic::new(first.source, message, span, label)
        .with_remedy("restore the file, or lock again")
}

/// Refuses a file that does not hold what it says.
fn holds_as_said(
    first: Line<'_>,
    found: &str,
    said: Option<(&str, Line<'_>)>,
) -> Result<(), Diagnostic> {
    match said {
        Some((said, _)) if said == found => Ok(()),
        Some((said, line)) => {
            let message = format!("this file holds {found}, and says {said}");
            Err(incomplete(first, message, line.span, "something is missing, or was added"))
        }
        None => {
            let message = "this file does not say what it holds".to_owned();
            let label = "no line `holds …` follows: the file is cut off";
            Err(incomplete(first, message, first.span, label))
        }
    }
}

/// Whether this is a number as locks write it: a decimal or a fraction, or `0 ± 1e-20`.
fn is_value(text: &str) -> bool {
    parse_number(text.strip_prefix("0 ± ").unwrap_or(text)).is_ok()
}
