//! What is wrong with a text, where, and what to do about it. The parser and every later stage that
//! reads the tree speak through this one type; nothing here prints.

use std::error::Error;
use std::fmt;

use super::source::{Source, Span};

/// One error in a text: a message, the place it is about, places that help to understand it, and a
/// remedy.
///
/// `Display` gives the place as `name:line:column`, the message with the remark, and the remedy.
///
/// # Invariants
/// All spans lie in the text and start and end between characters.
///
/// ```
/// let text = "scene \"A\"\nbar rod { impedance = 1, travl = 1 }\nline free - rod | fixed";
/// let error = wavestep::Problem::read("rod.wave", text).err().unwrap();
/// let wrong = &error.diagnostics()[0];
/// assert_eq!(wrong.remedy(), Some("did you mean `travel`?"));
/// assert_eq!(&text[wrong.span().start..wrong.span().end], "travl");
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic(Box<Content>);

/// Boxed, so that results stay small.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Content {
    message: String,
    source: Source,
    primary: Label,
    secondary: Vec<Label>,
    remedy: Option<String>,
}

/// A remark about a place.
///
/// ```
/// let text = "scene \"A\"\nbar a { impedance = 1, travel = 1 }\nbar a { impedance = 1, travel = 1 }\nline free - a - free";
/// let error = wavestep::Problem::read("a.wave", text).err().unwrap();
/// assert_eq!(error.diagnostics()[0].secondary().len(), 1);
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// The remark; may be empty.
    pub text: String,
}

impl Diagnostic {
    /// An error with its message and the place it is about; the place is moved into the text and onto
    /// characters, because a message about an error must not itself fail.
    #[must_use]
    pub fn new(
        source: &Source,
        message: impl Into<String>,
        span: Span,
        label: impl Into<String>,
    ) -> Self {
        Self(Box::new(Content {
            message: message.into(),
            source: source.clone(),
            primary: Label { span: on_characters(source.text(), span), text: label.into() },
            secondary: Vec::new(),
            remedy: None,
        }))
    }

    /// Adds a place that helps to understand the error.
    #[must_use]
    pub fn with_secondary(mut self, span: Span, label: impl Into<String>) -> Self {
        let span = on_characters(self.0.source.text(), span);
        self.0.secondary.push(Label { span, text: label.into() });
        self
    }

    /// Says what to do, replacing what was said before.
    #[must_use]
    pub fn with_remedy(mut self, remedy: impl Into<String>) -> Self {
        self.0.remedy = Some(remedy.into());
        self
    }

    /// Says `did you mean …?` if one of the candidates is close to the name, see [`closest`].
    #[must_use]
    pub fn with_closest<'a>(
        self,
        name: &str,
        candidates: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        match did_you_mean(name, candidates) {
            Some(remedy) => self.with_remedy(remedy),
            None => self,
        }
    }

    /// Adds a remedy where there is none yet.
    #[must_use]
    pub fn or_remedy(self, remedy: impl Into<String>) -> Self {
        if self.remedy().is_some() { self } else { self.with_remedy(remedy) }
    }

    /// What is wrong, in one sentence.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// The place the error is about.
    #[must_use]
    pub fn span(&self) -> Span {
        self.0.primary.span
    }

    /// The remark at that place.
    #[must_use]
    pub fn label(&self) -> &str {
        &self.0.primary.text
    }

    /// Places that help to understand the error.
    #[must_use]
    pub fn secondary(&self) -> &[Label] {
        &self.0.secondary
    }

    /// What to do about it.
    #[must_use]
    pub fn remedy(&self) -> Option<&str> {
        self.0.remedy.as_deref()
    }

    /// The text with its name; empty where it could not be read.
    #[must_use]
    pub fn source(&self) -> &Source {
        &self.0.source
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Content { message, source, primary, remedy, .. } = &*self.0;
        f.write_str(source.name())?;
        if !source.text().is_empty() {
            let before = &source.text()[..primary.span.start];
            let line = before.matches('\n').count() + 1;
            let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {message}")?;
        if !primary.text.is_empty() {
            write!(f, ": {}", primary.text)?;
        }
        match remedy {
            Some(remedy) => write!(f, "\nhelp: {remedy}"),
            None => Ok(()),
        }
    }
}

impl Error for Diagnostic {}

/// The span as one that lies in the text and starts and ends between characters.
fn on_characters(text: &str, span: Span) -> Span {
    let start = text.floor_char_boundary(span.start.min(text.len()));
    let end = text.ceil_char_boundary(span.end.min(text.len()));
    Span::new(start, end.max(start))
}

/// Names longer than this are not compared: nobody mistypes them into another name.
const LONGEST_COMPARED: usize = 64;

/// The candidate most like `name`, if one is so like it that a slip of the hand could explain the
/// difference: at most one edit in three characters. Of equally close candidates the first wins.
///
/// An edit inserts, removes or replaces a character, or swaps two neighbours (the
/// Damerau–Levenshtein distance in which no piece is edited twice).
#[must_use]
pub fn closest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name: Vec<char> = name.chars().take(LONGEST_COMPARED + 1).collect();
    if name.len() > LONGEST_COMPARED {
        return None;
    }
    candidates
        .into_iter()
        .filter(|candidate| candidate.len() <= LONGEST_COMPARED)
        .map(|candidate| (distance(&name, candidate), candidate))
        .filter(|&(edits, candidate)| edits * 3 <= name.len().max(candidate.len()))
        .min_by_key(|&(edits, _)| edits)
        .map(|(_, candidate)| candidate)
}

/// Asks whether the [`closest`] candidate was meant.
#[must_use]
pub fn did_you_mean<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<String> {
    closest(name, candidates).map(|candidate| format!("did you mean `{candidate}`?"))
}

fn distance(a: &[char], b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    // rows[i][j] is the distance of the first i characters of a and the first j of b.
    let mut rows = vec![(0..=b.len()).collect::<Vec<_>>()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replaced.min(rows[i - 1][j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            row.push(best);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}
