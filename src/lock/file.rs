//! Locks as text.
//!
//! ```text
//! # wavestep lock 1
//! through 1
//! digits 20
//! set mu = 1/4
//! stated observable velocity = (1)*f(t) + (1)*g(t)
//! stated period = 1/2
//! stated title = Rigid mass on a fixed bar
//! holds 3 statements, 4 pieces, 1 values
//!
//! f[0](s) = exp(-s)
//! …
//!
//! value f(33/10) = 0.30538526440879106409
//! ```
//!
//! A heading with the version, settings, what is stated, pieces as a listing of the language, values.
//! Comments begin with `#`. Versions to come read this one.

use crate::export::{self, Formula, Head, TEXT_WIDTH};
use crate::language::{Diagnostic, Source, Span, normalise_name, parse_number, read_listing};
use crate::limits::{MAX_DIGITS, MAX_LOCK_BYTES};
use crate::lock::{Lock, Piece, Request, history_file};
use num_traits::Signed as _;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use wavestep_polynomial::Rational;

/// The newest version of the format, that of histories; pieces are written in version 1, which says all of
/// them. Every version up to it is read.
const FORMAT_VERSION: u32 = history_file::VERSION;

/// The version of files of pieces.
pub(super) const VERSION: u32 = 1;

pub(super) const HEADING: &str = "# wavestep lock ";

/// One line of a file with its place.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub(super) text: &'a str,
    span: Span,
}

/// Adds the values of symbols, and what the scene states.
pub(super) fn write_stated(
    text: &mut String,
    set: &BTreeMap<String, Rational>,
    stated: &BTreeMap<String, String>,
) {
    for (name, value) in set {
        let _ = writeln!(text, "set {name} = {value}");
    }
    for (what, value) in stated {
        let _ = writeln!(text, "stated {what} = {value}");
    }
}

/// Adds values of observables, after an empty line.
pub(super) fn write_values(text: &mut String, values: &BTreeMap<(String, Rational), String>) {
    if !values.is_empty() {
        text.push('\n');
    }
    for ((quantity, time), value) in values {
        let _ = writeln!(text, "value {quantity}({time}) = {value}");
    }
}

impl Lock {
    /// The lock as text, in lines of at most 100 characters where they can be broken.
    pub fn to_text(&self) -> String {
        let Request { through, digits, set, .. } = &self.request;
        let mut text = format!("{HEADING}{VERSION}\nthrough {through}\ndigits {digits}\n");
        write_stated(&mut text, set, &self.stated);
        let _ = writeln!(text, "holds {}\n", self.contents());
        let formula = |((wave, n), piece): (&(String, usize), &Piece)| {
            let head = Head::Piece { wave: wave.clone(), n: *n, local: piece.variable.clone() };
            Formula::new(head, &piece.expression, &piece.variable)
        };
        let formulas: Vec<Formula> = self.pieces.iter().map(formula).collect();
        text.push_str(&export::text(&formulas, TEXT_WIDTH));
        write_values(&mut text, &self.values);
        text
    }

    /// How much the lock holds.
    fn contents(&self) -> String {
        let (pieces, values) = self.counts();
        format!("{} statements, {pieces} pieces, {values} values", self.stated.len())
    }

    /// Reads a lock.
    ///
    /// # Errors
    /// The first line that is none of a lock, with its place.
    pub fn read(source: &Source) -> Result<Lock, Diagnostic> {
        let lines = lines(source);
        check_heading(source, &lines, VERSION)?;
        let mut lock = Lock {
            stated: BTreeMap::new(),
            request: Request::default(),
            pieces: BTreeMap::new(),
            values: BTreeMap::new(),
        };
        let mut holds = None;
        // The listing is read with everything else blanked out, so that places stay what they are.
        let mut listing = source.text().to_owned().into_bytes();
        for line in &lines {
            let is_setting = match line.text.split_once(' ') {
                Some(("holds", rest)) => {
                    holds = Some((rest.trim(), *line));
                    true
                }
                Some((word, rest)) => lock.read_line(source, *line, word, rest)?,
                None => line.text.is_empty(),
            };
            if is_setting || line.text.starts_with('#') {
                listing[line.span.start..line.span.end].fill(b' ');
            }
        }
        let listing = String::from_utf8(listing).expect("whole lines were blanked out");
        if !listing.trim().is_empty() {
            let blanked = Source::with_limit(source.name(), listing, MAX_LOCK_BYTES)?;
            for formula in read_listing(&blanked)? {
                let piece = Piece { variable: formula.variable, expression: formula.expression };
                let key = (formula.wave, formula.n);
                let message = format!("{}[{}] stands there twice", key.0, key.1);
                if lock.pieces.insert(key, piece).is_some() {
                    return Err(Diagnostic::new(source, message, lines[0].span, "in this file")
                        .with_remedy("restore the file, or lock again"));
                }
            }
        }
        holds_as_said(source, lines[0], &lock.contents(), holds)?;
        Ok(lock)
    }

    /// Takes one line that begins with `word`; whether it is none of the listing.
    fn read_line(
        &mut self,
        source: &Source,
        line: Line<'_>,
        word: &str,
        rest: &str,
    ) -> Result<bool, Diagnostic> {
        let twice = |old: bool| match old {
            true => Err(refused(source, line, "it stands there twice: remove one of the two")),
            false => Ok(true),
        };
        match word {
            "through" => self.request.through = count(source, line, rest)?,
            "digits" => {
                self.request.digits = count(source, line, rest)?;
                if self.request.digits == 0 || self.request.digits > MAX_DIGITS {
                    let remedy = format!("values have 1 to {MAX_DIGITS} digits: lock again");
                    return Err(refused(source, line, &remedy));
                }
            }
            "set" => {
                let (name, value) = equation(source, line, rest)?;
                let value = number(source, line, value)?;
                return twice(self.request.set.insert(normalise_name(name), value).is_some());
            }
            "stated" => {
                let (what, value) = equation(source, line, rest)?;
                return twice(self.stated.insert(what.to_owned(), value.to_owned()).is_some());
            }
            "value" => {
                let (quantity, time, value) = value_line(source, line, rest)?;
                if !self.request.times.contains(&time) {
                    self.request.times.push(time.clone());
                }
                return twice(self.values.insert((quantity, time), value).is_some());
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

pub(super) fn lines(source: &Source) -> Vec<Line<'_>> {
    let mut start = 0;
    let mut lines = Vec::new();
    for line in source.text().split('\n') {
        let text = line.trim_end_matches('\r');
        lines.push(Line { text, span: Span::new(start, start + text.len()) });
        start += line.len() + 1;
    }
    lines
}

/// The version that the first line says.
pub(super) fn version(source: &Source, first: Line<'_>) -> Result<u32, Diagnostic> {
    let Some(version) = first.text.strip_prefix(HEADING) else {
        return Err(Diagnostic::new(
            source,
            "this is no file of locked results",
            first.span,
            format!("expected `{HEADING}{VERSION}`"),
        )
        .with_remedy("write one with `wavestep lock SCENE --through N -o FILE`"));
    };
    match version.trim().parse::<u32>() {
        Ok(version) if (1..=FORMAT_VERSION).contains(&version) => Ok(version),
        _ => Err(Diagnostic::new(
            source,
            format!("this file is of version {}", version.trim()),
            first.span,
            format!("versions up to {FORMAT_VERSION} are read"),
        )
        .with_remedy("use a newer wavestep, or lock again with this one")),
    }
}

/// Refuses a file of another version than this one.
pub(super) fn check_heading(
    source: &Source,
    lines: &[Line<'_>],
    expected: u32,
) -> Result<(), Diagnostic> {
    let first = lines[0];
    if version(source, first)? == expected {
        return Ok(());
    }
    let (message, label) = match expected {
        VERSION => {
            ("this file holds a history of contacts, and no pieces", "version 1 holds pieces")
        }
        _ => ("this file holds pieces, and no history of contacts", "version 2 holds histories"),
    };
    Err(Diagnostic::new(source, message, first.span, label).with_remedy("lock again"))
}

/// Refuses a file that does not hold what it says.
pub(super) fn holds_as_said(
    source: &Source,
    first: Line<'_>,
    found: &str,
    said: Option<(&str, Line<'_>)>,
) -> Result<(), Diagnostic> {
    let refuse = |message: String, span: Span, label: &str| {
        Err(Diagnostic::new(source, message, span, label)
            .with_remedy("restore the file, or lock again"))
    };
    match said {
        Some((said, _)) if said == found => Ok(()),
        Some((said, line)) => {
            let message = format!("this file holds {found}, and says {said}");
            refuse(message, line.span, "something is missing, or was added")
        }
        None => {
            let message = "this file does not say what it holds".to_owned();
            refuse(message, first.span, "no line `holds …` follows: the file is cut off")
        }
    }
}

/// Whether this is a number as it stands in locks: a decimal or a fraction, or `0 ± 1e-20`.
pub(super) fn is_value(text: &str) -> bool {
    parse_number(text.strip_prefix("0 ± ").unwrap_or(text)).is_ok()
}

/// Quantity, time and value of `f(33/10) = 0.3`.
pub(super) fn value_line(
    source: &Source,
    line: Line<'_>,
    rest: &str,
) -> Result<(String, Rational, String), Diagnostic> {
    let (left, value) = equation(source, line, rest)?;
    let call = left.strip_suffix(')').and_then(|left| left.split_once('('));
    let Some((quantity, time)) = call else {
        return Err(refused(source, line, "write it as `value f(33/10) = 0.3`"));
    };
    let time = number(source, line, time)?;
    if time.is_negative() || !is_value(value) {
        return Err(refused(source, line, "write a time from 0 on, and a number"));
    }
    Ok((quantity.to_owned(), time, value.to_owned()))
}

pub(super) fn refused(source: &Source, line: Line<'_>, remedy: &str) -> Diagnostic {
    Diagnostic::new(source, "this line cannot be read", line.span, "in a file of locked results")
        .with_remedy(remedy)
}

pub(super) fn count(source: &Source, line: Line<'_>, text: &str) -> Result<usize, Diagnostic> {
    let number = text.trim().parse::<u32>().ok();
    number
        .map(|number| number as usize)
        .ok_or_else(|| refused(source, line, "write a whole number, or lock again"))
}

pub(super) fn equation<'a>(
    source: &Source,
    line: Line<'_>,
    text: &'a str,
) -> Result<(&'a str, &'a str), Diagnostic> {
    let sides = text.split_once('=').map(|(left, right)| (left.trim(), right.trim()));
    sides.ok_or_else(|| refused(source, line, "write it as `name = value`, or lock again"))
}

pub(super) fn number(source: &Source, line: Line<'_>, text: &str) -> Result<Rational, Diagnostic> {
    parse_number(text)
        .map_err(|_| refused(source, line, "write a number such as 33/10, or lock again"))
}
