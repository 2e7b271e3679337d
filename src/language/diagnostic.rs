//! What is wrong with a text, where, and what to do about it. The parser and every later stage that
//! reads the tree speak through this one type; nothing here prints.

use std::error::Error;
use std::fmt;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::source::Source;
use super::syntax::Span;

/// One error in a text: a message, the place it is about, places that help to understand it, and a
/// remedy.
///
/// `Display` is [`Diagnostic::render`] in plain text.
///
/// ```
/// use wavestep::language::{Diagnostic, Source, Style, read_number};
///
/// let source = Source::new("example", "3/mu")?;
/// let error = read_number(&source).unwrap_err();
/// assert_eq!(error.message(), "this is not a constant");
/// assert_eq!((source.slice(error.span()), error.label()), ("mu", "a number is needed here"));
/// assert_eq!(error.remedy(), Some("write a number such as `3`, `0.25`, `33/10` or `1e-3`"));
/// assert_eq!(error.render(Style::Plain), error.to_string());
/// assert!(error.to_string().contains("example:1:3"));
/// # Ok::<(), Diagnostic>(())
/// ```
#[derive(Clone, Debug)]
pub struct Diagnostic(Box<Content>);

/// Boxed, so that results stay small.
#[derive(Clone, Debug)]
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
/// use wavestep::language::{Label, Source, read_recurrence};
///
/// let source = Source::new("twice.wave", "recurrence \"Twice\"\nsymbol f\nwave f")?;
/// let error = read_recurrence(&source, &Default::default()).unwrap_err();
/// let [Label { span, text }] = error.secondary() else { panic!("one more place") };
/// assert_eq!((source.slice(*span), span.start), ("f", 26));
/// assert_eq!(text, "first declared here");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// The remark; may be empty.
    pub text: String,
}

/// How a [`Diagnostic`] is rendered.
///
/// ```
/// use wavestep::language::{Style, parse_number};
///
/// let error = parse_number("1/0").unwrap_err();
/// assert!(error.render(Style::Plain).starts_with("error: division by zero"));
/// assert!(error.render(Style::Coloured).contains("\u{1b}["));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Text alone.
    Plain,
    /// Text with ANSI colour codes, for a terminal.
    Coloured,
}

impl Diagnostic {
    /// An error with its message and the place it is about.
    #[must_use]
    pub(crate) fn new(
        source: &Source,
        message: impl Into<String>,
        span: Span,
        label: impl Into<String>,
    ) -> Self {
        Self(Box::new(Content {
            message: message.into(),
            source: source.clone(),
            primary: Label { span, text: label.into() },
            secondary: Vec::new(),
            remedy: None,
        }))
    }

    /// Adds a place that helps to understand the error.
    #[must_use]
    pub(super) fn with_secondary(mut self, span: Span, label: impl Into<String>) -> Self {
        self.0.secondary.push(Label { span, text: label.into() });
        self
    }

    /// Says what to do, replacing what was said before.
    #[must_use]
    pub(crate) fn with_remedy(mut self, remedy: impl Into<String>) -> Self {
        self.0.remedy = Some(remedy.into());
        self
    }

    /// Says `did you mean …?` if one of the candidates is close to the name, see [`closest`].
    #[must_use]
    pub(super) fn with_closest<'a>(
        self,
        name: &str,
        candidates: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        match closest(name, candidates) {
            Some(candidate) => self.with_remedy(format!("did you mean `{candidate}`?")),
            None => self,
        }
    }

    /// Adds a remedy where there is none yet.
    #[must_use]
    pub(super) fn or_remedy(self, remedy: impl Into<String>) -> Self {
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

    /// The message with the lines of the text it is about. The text is left out if it is empty.
    #[must_use]
    pub fn render(&self, style: Style) -> String {
        let Content { message, source, primary, secondary, remedy } = &*self.0;
        let mut group = Group::with_title(Level::ERROR.primary_title(message));
        let text = source.text();
        if !text.is_empty() {
            let mark = |label: &'_ Label, kind: AnnotationKind| {
                let label_text = (!label.text.is_empty()).then(|| label.text.clone());
                kind.span(on_characters(text, label.span)).label(label_text)
            };
            let snippet = Snippet::source(text)
                .path(source.name())
                .annotation(mark(primary, AnnotationKind::Primary))
                .annotations(secondary.iter().map(|label| mark(label, AnnotationKind::Context)));
            group = group.element(snippet);
        }
        if let Some(remedy) = remedy {
            group = group.element(Level::HELP.message(remedy));
        }
        let renderer = match style {
            Style::Plain => Renderer::plain(),
            Style::Coloured => Renderer::styled(),
        };
        renderer.term_width(WIDTH).render(&[group])
    }
}

/// Longer lines are cut around the place they are shown for.
const WIDTH: usize = 100;

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(Style::Plain))
    }
}

impl Error for Diagnostic {}

/// The span as a range that lies in the text and starts and ends between characters, whatever the
/// caller passed: a message about an error must not itself fail.
fn on_characters(text: &str, span: Span) -> std::ops::Range<usize> {
    let start = text.floor_char_boundary(span.start.min(text.len()));
    let end = text.ceil_char_boundary(span.end.min(text.len()));
    start..end.max(start)
}

/// Names longer than this are not compared: nobody mistypes them into another name.
const LONGEST_COMPARED: usize = 64;

/// The candidate most like `name`, if one is so like it that a slip of the hand could explain the
/// difference: at most one edit in three characters. Of equally close candidates the first wins.
///
/// An edit inserts, removes or replaces a character, or swaps two neighbours (the
/// Damerau–Levenshtein distance in which no piece is edited twice).
///
/// ```
/// use wavestep::language::closest;
///
/// assert_eq!(closest("equasion", ["observe", "equation"]), Some("equation"));
/// assert_eq!(closest("q", ["mu", "r"]), None);
/// ```
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        for (a, b, edits) in
            [("", "abc", 3), ("wave", "wvae", 1), ("ca", "abc", 3), ("mü", "mu", 1)]
        {
            assert_eq!(distance(&a.chars().collect::<Vec<_>>(), b), edits, "{a} {b}");
        }
    }

    #[test]
    fn only_slips_are_close() {
        assert_eq!(closest("waves", ["wave"]), Some("wave"));
        assert_eq!(closest("Mu", ["r", "mu"]), None);
        assert_eq!(closest("alhpa", ["beta", "alpha"]), Some("alpha"));
        assert_eq!(closest("x", ["y", "z"]), None);
        assert_eq!(closest(&"x".repeat(1000), ["y"]), None);
    }

    #[test]
    fn any_span_renders() {
        for text in ["σ = ρcV\n", "", "a", "\u{4F60}\u{597D} f"] {
            let source = Source::new("t", text).unwrap();
            for (start, end) in [(0, 0), (1, 2), (3, 1), (5, 999), (usize::MAX, usize::MAX)] {
                let error = Diagnostic::new(&source, "m", Span::new(start, end), "l")
                    .with_secondary(Span::new(end, start), "s");
                assert!(error.render(Style::Plain).contains('m'));
                assert!(error.render(Style::Coloured).contains('m'));
            }
        }
    }
}
