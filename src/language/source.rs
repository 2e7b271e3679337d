//! A text together with the name it is known by, checked once so that everything after may rely on
//! it: valid UTF-8, of bounded size, and free of characters that cannot be seen.

use crate::limits::MAX_SOURCE_BYTES;
use std::sync::Arc;

use super::diagnostic::Diagnostic;

/// A half-open range of bytes in a text.
///
/// ```
/// let text = "scene \"A\"\nline fre - free";
/// let error = wavestep::Problem::read("a.wave", text).err().unwrap();
/// assert_eq!(error.diagnostics()[0].span(), wavestep::Span { start: 15, end: 18 });
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The first byte.
    pub start: usize,
    /// The byte after the last; equal to `start` for a place between two characters.
    pub end: usize,
}

impl Span {
    /// The bytes from `start` up to, not including, `end`.
    #[must_use]
    pub const fn new(start: usize, end: usize) -> Self {
        Self { start, end }
    }

    /// From the start of this span to the end of a later one.
    pub(super) const fn to(self, later: Self) -> Self {
        Self::new(self.start, later.end)
    }
}

/// A checked text and its name; cloning is cheap.
///
/// # Invariants
/// - The text is UTF-8 without a byte order mark, and no longer than the limit it was read under.
/// - Of the control characters it holds only tab, line feed, and carriage return before a line feed.
/// - It holds no character that reverses or isolates the direction of writing, because such a text
///   does not read the way it is parsed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    name: Arc<str>,
    text: Arc<str>,
}

impl Source {
    /// Checks `bytes` and keeps them under `name`, which is what messages call the text: a file
    /// name, or a word such as `argument`. A leading byte order mark is dropped.
    pub fn new(name: &str, bytes: impl AsRef<[u8]>) -> Result<Self, Diagnostic> {
        Self::with_limit(name, bytes, MAX_SOURCE_BYTES)
    }

    /// [`Source::new`] with a limit of the caller's choice, for texts written by a program.
    pub fn with_limit(
        name: &str,
        bytes: impl AsRef<[u8]>,
        limit: usize,
    ) -> Result<Self, Diagnostic> {
        let bytes = bytes.as_ref();
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        if bytes.len() > limit {
            let length = bytes.len();
            return Err(Diagnostic::new(
                &Self::unchecked(name, ""),
                format!("the text is {length} bytes long; the limit is {limit} bytes"),
                Span::new(0, 0),
                "",
            )
            .with_remedy("divide it into smaller texts"));
        }
        let text = match str::from_utf8(bytes) {
            Ok(text) => text,
            Err(error) => return Err(not_utf8(name, bytes, error.valid_up_to())),
        };
        let source = Self::unchecked(name, text);
        match first_invisible(text) {
            None => Ok(source),
            Some((start, found)) => Err(invisible(&source, start, found)),
        }
    }

    /// A text that is only shown, never parsed.
    fn unchecked(name: &str, text: &str) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// What messages call the text.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text itself; every [`Span`] counts its bytes.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The part of the text under `span`.
    #[must_use]
    pub fn slice(&self, span: Span) -> &str {
        &self.text[span.start..span.end]
    }
}

/// The first character refused everywhere, comments included, with its offset.
fn first_invisible(text: &str) -> Option<(usize, char)> {
    let mut characters = text.char_indices().peekable();
    while let Some((start, found)) = characters.next() {
        let refused = match found {
            '\t' | '\n' => false,
            '\r' => characters.peek().is_none_or(|&(_, next)| next != '\n'),
            '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}' => true,
            _ => found.is_control(),
        };
        if refused {
            return Some((start, found));
        }
    }
    None
}

fn invisible(source: &Source, start: usize, found: char) -> Diagnostic {
    let code = u32::from(found);
    let (what, remedy) = match found {
        '\0' => (
            "a NUL character".to_owned(),
            "save the file as plain UTF-8 text; NUL characters appear in UTF-16 and in binary files",
        ),
        '\r' => (
            "a carriage return without a line feed".to_owned(),
            "save the file with line ends LF or CR LF",
        ),
        _ => (format!("an invisible control character (U+{code:04X})"), "delete the character"),
    };
    Diagnostic::new(
        source,
        format!("the text contains {what}"),
        Span::new(start, start + found.len_utf8()),
        "here",
    )
    .with_remedy(remedy)
}

/// Bytes that are not UTF-8 are shown as U+FFFD; up to the first of them the offsets agree.
fn not_utf8(name: &str, bytes: &[u8], start: usize) -> Diagnostic {
    let shown = String::from_utf8_lossy(bytes);
    let byte = bytes[start];
    Diagnostic::new(
        &Source::unchecked(name, &shown),
        "the text is not UTF-8",
        Span::new(start, start + char::REPLACEMENT_CHARACTER.len_utf8()),
        format!("the byte 0x{byte:02X} at offset {start} is not part of a character"),
    )
    .with_remedy("save the file with the encoding UTF-8")
}
