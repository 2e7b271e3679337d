//! Locks as text.
//!
//! ```text
//! # wavestep lock 1
//! title "Rigid mass on a fixed bar"
//! through 1
//! digits 20
//! set mu = 1/4
//! holds 2 pieces, 1 values
//!
//! f[0](s) = exp(-s)
//! f[1](s) = exp(-s)*(-2*s + 1 + exp(-1/2))
//!
//! value f(33/10) = 0.30538526440879106409
//! ```
//!
//! A heading that names the version, settings, pieces as a listing of the language, values.
//! Comments begin with `#`. Versions to come read this one.

use crate::export::{self, Formula, Head, TEXT_WIDTH};
use crate::language::{Diagnostic, Source, Span, parse_number, read_listing};
use crate::lock::{Lock, Piece, Request};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The version of the format that is written. Every version up to it is read.
///
/// ```
/// assert_eq!(wavestep::lock::FORMAT_VERSION, 1);
/// ```
pub const FORMAT_VERSION: u32 = 1;

/// The most bytes of a file that is read.
///
/// ```
/// assert_eq!(wavestep::lock::MAX_FILE_BYTES, 16 << 20);
/// ```
pub const MAX_FILE_BYTES: usize = 16 << 20;

const HEADING: &str = "# wavestep lock ";

/// One line of a file with its place.
#[derive(Clone, Copy)]
struct Line<'a> {
    text: &'a str,
    span: Span,
}

impl Lock {
    /// The lock as text, in lines of at most 100 characters where they can be broken.
    pub fn to_text(&self) -> String {
        let Request { through, digits, set, .. } = &self.request;
        let mut text = format!(
            "{HEADING}{FORMAT_VERSION}\n\
             title \"{}\"\nthrough {through}\ndigits {digits}\n",
            self.title
        );
        for (name, value) in set {
            let _ = writeln!(text, "set {name} = {value}");
        }
        let (pieces, values) = self.counts();
        let _ = writeln!(text, "holds {pieces} pieces, {values} values\n");
        let formula = |((wave, n), piece): (&(String, usize), &Piece)| {
            let head = Head::Piece { wave: wave.clone(), n: *n, local: piece.variable.clone() };
            Formula::new(head, &piece.expression, &piece.variable)
        };
        let formulas: Vec<Formula> = self.pieces.iter().map(formula).collect();
        text.push_str(&export::text(&formulas, TEXT_WIDTH));
        if !self.values.is_empty() {
            text.push('\n');
        }
        for ((quantity, time), value) in &self.values {
            let _ = writeln!(text, "value {quantity}({time}) = {value}");
        }
        text
    }

    /// Reads a lock.
    ///
    /// ```
    /// use wavestep::language::Source;
    /// use wavestep::lock::Lock;
    ///
    /// let text = "# wavestep lock 1\ntitle \"Mine\"\nthrough 0\ndigits 20\nholds 1 pieces, 0 values\n\n\
    ///             f[0](s) = exp(-s)\n";
    /// let lock = Lock::read(&Source::new("mine.lock", text)?)?;
    /// assert_eq!(lock.to_text(), text);
    /// # Ok::<(), wavestep::language::Diagnostic>(())
    /// ```
    ///
    /// # Errors
    /// The first line that is none of a lock, with its place.
    pub fn read(source: &Source) -> Result<Lock, Diagnostic> {
        let lines = lines(source);
        check_heading(source, &lines)?;
        let (mut title, mut holds) = (None, None);
        let mut request = Request::default();
        let mut values = BTreeMap::new();
        // The listing is read with everything else blanked out, so that places stay what they are.
        let mut listing = source.text().to_owned().into_bytes();
        for line in &lines {
            let is_setting = match line.text.split_once(' ') {
                Some(("title", rest)) => {
                    title = Some(rest.trim().trim_matches('"').to_owned());
                    true
                }
                Some(("through", rest)) => {
                    request.through = count(source, *line, rest)?;
                    true
                }
                Some(("digits", rest)) => {
                    request.digits = count(source, *line, rest)?;
                    true
                }
                Some(("holds", rest)) => {
                    holds = Some((rest.trim(), *line));
                    true
                }
                Some(("set", rest)) => {
                    let (name, value) = equation(source, *line, rest)?;
                    request.set.insert(name.to_owned(), number(source, *line, value)?);
                    true
                }
                Some(("value", rest)) => {
                    let (left, value) = equation(source, *line, rest)?;
                    let call = left.strip_suffix(')').and_then(|left| left.split_once('('));
                    let Some((quantity, time)) = call else {
                        return Err(refused(source, *line, "write it as `value f(33/10) = 0.3`"));
                    };
                    let time = number(source, *line, time)?;
                    if !request.times.contains(&time) {
                        request.times.push(time.clone());
                    }
                    values.insert((quantity.to_owned(), time), value.to_owned());
                    true
                }
                _ => line.text.is_empty() || line.text.starts_with('#'),
            };
            if is_setting {
                listing[line.span.start..line.span.end].fill(b' ');
            }
        }
        let listing = String::from_utf8(listing).expect("whole lines were blanked out");
        let mut pieces = BTreeMap::new();
        if !listing.trim().is_empty() {
            let source = Source::with_limit(source.name(), listing, MAX_FILE_BYTES)?;
            for formula in read_listing(&source)? {
                let piece = Piece { variable: formula.variable, expression: formula.expression };
                pieces.insert((formula.wave, formula.n), piece);
            }
        }
        let found = format!("{} pieces, {} values", pieces.len(), values.len());
        match holds {
            Some((said, _)) if said == found => {}
            Some((said, line)) => {
                let message = format!("this file holds {found}, and says {said}");
                return Err(Diagnostic::new(source, message, line.span, "something is missing")
                    .with_remedy("restore the file, or lock again"));
            }
            None => return Err(refused(source, lines[0], "restore the file, or lock again")),
        }
        Ok(Lock { title: title.unwrap_or_default(), request, pieces, values })
    }
}

fn lines(source: &Source) -> Vec<Line<'_>> {
    let mut start = 0;
    let mut lines = Vec::new();
    for line in source.text().split('\n') {
        let text = line.trim_end_matches('\r');
        lines.push(Line { text, span: Span::new(start, start + text.len()) });
        start += line.len() + 1;
    }
    lines
}

fn check_heading(source: &Source, lines: &[Line<'_>]) -> Result<(), Diagnostic> {
    let first = lines[0];
    let Some(version) = first.text.strip_prefix(HEADING) else {
        return Err(Diagnostic::new(
            source,
            "this is no file of locked results",
            first.span,
            format!("expected `{HEADING}{FORMAT_VERSION}`"),
        )
        .with_remedy("write one with `wavestep lock SCENE --through N -o FILE`"));
    };
    match version.trim().parse::<u32>() {
        Ok(version) if (1..=FORMAT_VERSION).contains(&version) => Ok(()),
        _ => Err(Diagnostic::new(
            source,
            format!("this file is of version {}", version.trim()),
            first.span,
            format!("versions up to {FORMAT_VERSION} are read"),
        )
        .with_remedy("use a newer wavestep, or lock again with this one")),
    }
}

fn refused(source: &Source, line: Line<'_>, remedy: &str) -> Diagnostic {
    Diagnostic::new(source, "this line cannot be read", line.span, "in a file of locked results")
        .with_remedy(remedy)
}

fn count(source: &Source, line: Line<'_>, text: &str) -> Result<usize, Diagnostic> {
    let number = text.trim().parse::<u32>().ok();
    number
        .map(|number| number as usize)
        .ok_or_else(|| refused(source, line, "write a whole number, or lock again"))
}

fn equation<'a>(
    source: &Source,
    line: Line<'_>,
    text: &'a str,
) -> Result<(&'a str, &'a str), Diagnostic> {
    let sides = text.split_once('=').map(|(left, right)| (left.trim(), right.trim()));
    sides.ok_or_else(|| refused(source, line, "write it as `name = value`, or lock again"))
}

fn number(
    source: &Source,
    line: Line<'_>,
    text: &str,
) -> Result<wavestep_polynomial::Rational, Diagnostic> {
    parse_number(text)
        .map_err(|_| refused(source, line, "write a number such as 33/10, or lock again"))
}
