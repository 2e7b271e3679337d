//! Markup: escaped texts, tables, sections.

use std::fmt::Write as _;
pub use wavestep_draw::escape;

/// A table with a caption; the first cell of a row is its heading.
pub fn table(caption: &str, heads: &[&str], rows: &[Vec<String>]) -> String {
    let head: String =
        heads.iter().map(|head| format!("<th scope=\"col\">{}</th>", escape(head))).collect();
    let mut body = String::new();
    for row in rows {
        let cells = row.iter().enumerate().map(|(i, text)| match i {
            0 => format!("<th scope=\"row\">{}</th>", escape(text)),
            _ => format!("<td>{}</td>", escape(text)),
        });
        let _ = writeln!(body, "<tr>{}</tr>", cells.collect::<String>());
    }
    format!(
        "<div class=\"wide\" role=\"region\" aria-label=\"{0}\" tabindex=\"0\"><table>\
         <caption>{0}</caption>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody></table></div>\n",
        escape(caption)
    )
}

/// A section with its heading.
pub fn section(id: &str, heading: &str, contents: &str) -> String {
    let heading = escape(heading);
    format!(
        "<section aria-labelledby=\"{id}\">\n<h2 id=\"{id}\">{heading}</h2>\n{contents}</section>\n"
    )
}

pub fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", escape(text))
}

/// A sentence from the message of an error, which begins in lower case and ends without a stop.
pub fn left_out(reason: &impl ToString) -> String {
    paragraph(&format!("Left out: {}.", reason.to_string().trim_end_matches('.')))
}

pub fn list(items: &[String]) -> String {
    let items = items.iter().map(|item| format!("<li>{}</li>\n", escape(item)));
    format!("<ul>\n{}</ul>\n", items.collect::<String>())
}
