//! Markup: escaped texts, tables, sections.

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

/// A table with a caption; the first cell of a row is its heading.
pub fn table(caption: &str, heads: &[&str], rows: &[Vec<String>]) -> String {
    let head = |text: &&str| match text.is_empty() {
        true => "<td></td>".to_owned(),
        false => format!("<th scope=\"col\">{}</th>", set(text)),
    };
    let row = |row: &Vec<String>| {
        let [first, rest @ ..] = &row[..] else { return String::new() };
        let cells: String = rest.iter().map(|text| format!("<td>{}</td>", set(text))).collect();
        format!("<tr><th scope=\"row\">{}</th>{cells}</tr>\n", escape(first))
    };
    format!(
        "<div class=\"wide\" role=\"group\" aria-label=\"{0}\" tabindex=\"0\"><table>\
         <caption>{0}</caption>\n<thead><tr>{1}</tr></thead>\n<tbody>\n{2}</tbody></table></div>\n",
        set(caption),
        heads.iter().map(head).collect::<String>(),
        rows.iter().map(row).collect::<String>()
    )
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
