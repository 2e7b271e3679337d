//! Lines to statements. A statement is one line and the lines after it that are indented deeper
//! than the first statement of the text; a line that begins with `}` ends what the statement before
//! it opened. Blank lines and comments belong to whatever surrounds them.

use super::syntax::Span;

/// Tabs reach to the next multiple of this many columns.
const TAB: usize = 8;

/// Where each statement stands: disjoint spans in rising order, each starting at its first
/// visible character. Comments between and after the lines of a statement are included.
pub(super) fn statements(text: &str) -> Vec<Span> {
    let mut found: Vec<Span> = Vec::new();
    let mut margin = None;
    let mut line_start = 0;
    for line in text.split_inclusive('\n') {
        let line_end = line_start + line.len();
        if let Some((bytes, column)) = indentation(line) {
            let margin = *margin.get_or_insert(column);
            match found.last_mut() {
                Some(statement) if column > margin || line[bytes..].starts_with('}') => {
                    statement.end = line_end;
                }
                _ => found.push(Span::new(line_start + bytes, line_end)),
            }
        }
        line_start = line_end;
    }
    found
}

/// Whether a character only separates others.
pub(super) fn is_space(character: char) -> bool {
    // The last three are what word processors and web pages put where a space was typed.
    matches!(character, ' ' | '\t' | '\r' | '\n' | '\u{A0}' | '\u{2009}' | '\u{202F}')
}

/// The offset and the column of the first visible character; none if the line is blank or a comment.
fn indentation(line: &str) -> Option<(usize, usize)> {
    let mut column = 0;
    for (offset, character) in line.char_indices() {
        match character {
            '#' => return None,
            '\t' => column += TAB - column % TAB,
            _ if is_space(character) => column += 1,
            _ => return Some((offset, column)),
        }
    }
    None
}
