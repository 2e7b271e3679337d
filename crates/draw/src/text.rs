//! Text in pictures: escaped for markup, measured, and broken into lines; and the fields of data
//! files.

use serde_json::{Value, json};

/// Text with the characters of markup replaced by their entities.
///
/// Line breaks and tabs become blanks. Other control characters, and the two code points that XML
/// forbids, become the replacement character `U+FFFD`: no text can make the markup invalid.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            '\n' | '\r' | '\t' => escaped.push(' '),
            '\u{FFFE}' | '\u{FFFF}' => escaped.push('\u{FFFD}'),
            other if other.is_control() => escaped.push('\u{FFFD}'),
            other => escaped.push(other),
        }
    }
    escaped
}

/// How far the characters from blank to tilde advance in DejaVu Sans, in thousandths of the size.
#[rustfmt::skip]
const ADVANCES: [u16; 95] = [
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337,
    636, 636, 636, 636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531,
    1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863, 748, 787,
    603, 787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500,
    500, 613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612,
    635, 635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838,
];

/// The width of a text in pixels at a font size.
///
/// The reader's font is not known here. The widths are those of DejaVu Sans, wide among sans
/// serifs, so that room is kept for it; narrower fonts leave a little more space.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let thousandths = |character: char| match character {
        ' '..='~' => ADVANCES[character as usize - ' ' as usize],
        '·' => 318,
        '⁰'..='⁹' | '¹' | '²' | '³' => 401,
        '⁻' => 528,
        '—' | '…' | '\u{2E80}'.. => 1000,
        _ => 840,
    };
    size / 1e3 * text.chars().map(|character| f64::from(thousandths(character))).sum::<f64>()
}

/// A text in lines no wider than `limit` pixels, broken between words, or inside a word that is too
/// wide alone.
pub(super) fn wrap(text: &str, limit: f64, size: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        let joined = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if width(&joined, size) <= limit {
            line = joined;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for character in word.chars() {
            line.push(character);
            if width(&line, size) > limit && line.chars().count() > 1 {
                line.pop();
                lines.push(std::mem::take(&mut line));
                line.push(character);
            }
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// A field of a table of comma-separated values (RFC 4180): quoted where it must be.
pub(super) fn csv_field(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// A double in the shortest form that reads back as the same double; nothing for none.
pub(super) fn csv_number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:e}"))
}

pub(super) fn csv_row(texts: &[&str], numbers: impl IntoIterator<Item = Option<f64>>) -> String {
    let texts = texts.iter().map(|text| csv_field(text));
    let fields: Vec<String> = texts.chain(numbers.into_iter().map(csv_number)).collect();
    fields.join(",") + "\n"
}

/// A double as JSON: none is `null`, and what JSON cannot hold is a text.
pub(super) fn json_number(value: Option<f64>) -> Value {
    match value {
        None => Value::Null,
        Some(value) if value.is_nan() => "not a number".into(),
        Some(value) if value.is_infinite() => if value > 0.0 { "inf" } else { "-inf" }.into(),
        Some(value) => value.into(),
    }
}

/// Points as pairs of numbers in JSON.
pub(super) fn json_points(points: &[(f64, f64)]) -> Value {
    let number = |value: f64| json_number(Some(value));
    points.iter().map(|&(x, y)| json!([number(x), number(y)])).collect()
}

/// Places with names in JSON; `key` says along which axis they are.
pub(super) fn json_places(key: &str, places: &[(f64, String)]) -> Value {
    places.iter().map(|(at, name)| json!({key: json_number(Some(*at)), "name": name})).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_is_escaped() {
        assert_eq!(escape("a<b & \"c\" 'd'>"), "a&lt;b &amp; &quot;c&quot; &#39;d&#39;&gt;");
        assert_eq!(escape("a\nb\u{0}c\u{1b}\u{FFFF}"), "a b\u{FFFD}c\u{FFFD}\u{FFFD}");
    }

    #[test]
    fn widths_are_those_of_the_font() {
        assert!(
            (width("N = 10⁵", 1000.0) - (748 + 2 * 318 + 838 + 2 * 636 + 401) as f64).abs() < 1e-6
        );
        assert_eq!((width("~", 1000.0), width("A", 1000.0)), (838.0, 684.0));
    }

    #[test]
    fn lines_are_no_wider_than_asked() {
        let text = "a few words and onewordthatisfartoolongtostandonasinglelinealone at the end";
        let lines = wrap(text, 100.0, 12.0);
        assert!(lines.len() > 4 && lines.iter().all(|line| width(line, 12.0) <= 100.0));
        let letters = |text: &str| text.replace(' ', "");
        assert_eq!(letters(&lines.concat()), letters(text));
        assert_eq!(wrap("", 100.0, 12.0), [""; 0]);
        assert_eq!(wrap("mm", 1.0, 12.0), ["m", "m"]);
    }

    #[test]
    fn fields_are_quoted_where_needed() {
        assert_eq!(csv_field("N = 10"), "N = 10");
        assert_eq!(csv_field("a,\"b\""), "\"a,\"\"b\"\"\"");
        assert_eq!(csv_number(Some(1e-17)), "1e-17");
        assert_eq!(csv_number(None), "");
    }
}
