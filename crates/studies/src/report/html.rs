//! Markup: escaped texts, sections, lists.

pub use wavestep_draw::escape;

/// A text with the signs of print in the place of those of a terminal.
fn typeset(text: &str) -> String {
    let signs = [("->", "→"), ("<=", "≤"), (">=", "≥"), ("*", "·"), (" -", " −"), ("(-", "(−")];
    let text = signs.iter().fold(text.to_owned(), |text, (plain, sign)| text.replace(plain, sign));
    text.strip_prefix('-').map_or_else(|| text.clone(), |rest| format!("−{rest}"))
}

/// Markup for a text in which names stand between backquotes.
pub fn set(text: &str) -> String {
    let parts = text.split('`').enumerate().map(|(i, part)| match i % 2 {
        0 => escape(&typeset(part)),
        _ => format!("<code>{}</code>", escape(part)),
    });
    parts.collect()
}

pub fn section(id: &str, heading: &str, contents: &str) -> String {
    let heading = escape(heading);
    format!(
        "<section aria-labelledby=\"{id}\">\n<h2 id=\"{id}\">{heading}</h2>\n{contents}</section>\n"
    )
}

pub fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", set(text))
}

/// A sentence from the message of an error, which begins in lower case and ends without a stop.
pub fn left_out(reason: &impl ToString) -> String {
    paragraph(&format!("Omitted: {}.", reason.to_string().trim_end_matches('.')))
}

pub fn list(items: &[String]) -> String {
    let items = items.iter().map(|item| format!("<li>{}</li>\n", set(item)));
    format!("<ul>\n{}</ul>\n", items.collect::<String>())
}
