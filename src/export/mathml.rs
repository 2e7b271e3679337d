//! MathML Core: structure is markup, all else is plain text until [`tokens`] makes elements of it.

use crate::export::names::{GREEK, latex_name};

/// The letters that [`GREEK`] names, in the same order.
const LETTERS: &str = "αβγδεζηθικλμνξπρστυφχψωΓΔΘΛΞΠΣΥΦΨΩ";

/// Accents of names, as [`latex_name`] writes them.
const ACCENTS: [(&str, &str); 4] = [("tilde", "~"), ("bar", "¯"), ("hat", "^"), ("dot", "˙")];

/// An element around contents.
pub(super) fn element(tag: &str, parts: &[&str]) -> String {
    match parts {
        [only] => format!("<{tag}>{only}</{tag}>"),
        _ => {
            let parts: String = parts.iter().map(|part| format!("<mrow>{part}</mrow>")).collect();
            format!("<{tag}>{parts}</{tag}>")
        }
    }
}

/// A name with an index beside its subscript, as [`latex_name`] arranges them.
pub(super) fn name(name: &str, index: Option<&str>) -> String {
    arranged(&latex_name(name, index))
}

/// The few commands of which names consist.
fn arranged(latex: &str) -> String {
    if let Some((letter, below)) = split_subscript(latex) {
        return element("msub", &[&arranged(letter), &listed(below)]);
    }
    if let Some(letter) = latex.strip_suffix('\'') {
        return element("msup", &[&arranged(letter), "<mo>′</mo>"]);
    }
    if let Some(word) = latex.strip_prefix("\\mathrm{").and_then(|rest| rest.strip_suffix('}')) {
        return identifier(&word.replace("\\_", "_"));
    }
    for (accent, sign) in ACCENTS {
        let inner = latex.strip_prefix('\\').and_then(|rest| rest.strip_prefix(accent));
        if let Some(letter) = inner.and_then(|rest| rest.strip_prefix('{')?.strip_suffix('}')) {
            return format!("<mover accent=\"true\">{}<mo>{sign}</mo></mover>", arranged(letter));
        }
    }
    let greek = latex.strip_prefix('\\').and_then(letter);
    greek.map_or_else(|| latex.to_owned(), |letter| identifier(&letter))
}

fn letter(name: &str) -> Option<String> {
    let known = GREEK.iter().zip(LETTERS.chars()).find(|(known, _)| **known == name);
    known.map(|(_, letter)| letter.to_string())
}

/// The name of a Greek letter.
pub(super) fn spelt(letter: char) -> Option<&'static str> {
    let known = GREEK.iter().zip(LETTERS.chars()).find(|(_, own)| *own == letter);
    known.map(|(name, _)| *name)
}

/// A letter and what stands below it, where the name ends with that.
fn split_subscript(latex: &str) -> Option<(&str, &str)> {
    let inner = latex.strip_suffix('}')?;
    let mut depth = 1;
    for (at, character) in inner.char_indices().rev() {
        depth += match character {
            '}' => 1,
            '{' => -1,
            _ => 0,
        };
        if depth == 0 {
            return inner[..at].strip_suffix('_').map(|letter| (letter, &inner[at + 1..]));
        }
    }
    None
}

/// The parts of a subscript, with commas between them.
fn listed(below: &str) -> String {
    let parts: Vec<String> = below.split(',').map(arranged).collect();
    parts.join(",")
}

/// `n` over `k`, in parentheses.
pub(super) fn binomial(n: &str, k: &str) -> String {
    format!("(<mfrac linethickness=\"0\"><mi>{n}</mi><mi>{k}</mi></mfrac>)")
}

/// A sentence with formulas between dollars, and names of the scene between backticks.
pub(super) fn sentence(text: &str) -> String {
    let parts = text.split('$').enumerate().map(|(at, part)| match at % 2 {
        0 => {
            let escaped = part.replace('&', "&amp;").replace('<', "&lt;");
            let quoted = escaped.split('`').enumerate();
            let quoted = quoted.map(|(at, part)| match at % 2 {
                0 => part.to_owned(),
                _ => format!("<code>{part}</code>"),
            });
            quoted.collect()
        }
        _ => format!("<math>{}</math>", tokens(part)),
    });
    parts.collect()
}

fn identifier(name: &str) -> String {
    format!("<mi>{name}</mi>")
}

/// Markup with elements for what is plain text in it: numbers, names and signs.
pub(super) fn tokens(markup: &str) -> String {
    let mut out = String::with_capacity(4 * markup.len());
    let mut rest = markup;
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '<' if rest.starts_with("< ") => 1,
            // Elements that hold text are kept as they are.
            '<' => {
                let tag = rest.find('>').map_or(rest.len(), |end| end + 1);
                let is_text = ["<mi", "<mn", "<mo>", "<mo ", "<mtext"];
                match is_text.iter().any(|start| rest.starts_with(start)) {
                    true => rest.find("</").map_or(rest.len(), |end| {
                        end + rest[end..].find('>').map_or(0, |close| close + 1)
                    }),
                    false => tag,
                }
            }
            _ if first.is_ascii_digit() => run(rest, |c| c.is_ascii_digit() || c == '.'),
            _ if first.is_alphabetic() => run(rest, |c| c.is_alphanumeric() || c == '_'),
            other => other.len_utf8(),
        };
        let (token, after) = rest.split_at(length);
        match first {
            '<' if token == "<" => out.push_str("<mo>&lt;</mo>"),
            '<' => out.push_str(token),
            ' ' => {}
            // The sign of what follows, not a difference.
            '-' if ["=</mo>", "(</mo>", "<mrow>"].iter().any(|end| out.ends_with(end)) => {
                out.push_str("<mo form=\"prefix\">−</mo>");
            }
            '-' => out.push_str("<mo>−</mo>"),
            '\'' => out.push_str("<mo>′</mo>"),
            '(' | ')' | '[' | ']' => {
                out.push_str(&format!("<mo stretchy=\"false\">{token}</mo>"));
            }
            _ if first.is_ascii_digit() => out.push_str(&format!("<mn>{token}</mn>")),
            _ if first.is_alphabetic() => out.push_str(&identifier(token)),
            _ => out.push_str(&format!("<mo>{token}</mo>")),
        }
        rest = after;
    }
    out
}

/// How many bytes belong together from the start on.
fn run(text: &str, belongs: impl Fn(char) -> bool) -> usize {
    text.find(|c: char| !belongs(c)).unwrap_or(text.len())
}

/// How wide markup is on the page: tags count nothing, a sign with its space as two.
pub(super) fn width(markup: &str) -> usize {
    let (mut width, mut inside) = (0, false);
    for character in markup.chars() {
        width += match character {
            '<' | '>' => {
                inside = character == '<';
                0
            }
            _ if inside => 0,
            '+' | '-' => 2,
            ' ' | TIMES_CHARACTER => 0,
            _ => 1,
        };
    }
    width
}

/// Multiplication without a sign.
pub(super) const TIMES: &str = "<mo rspace=\"0.15em\">\u{2062}</mo>";
const TIMES_CHARACTER: char = '\u{2062}';
