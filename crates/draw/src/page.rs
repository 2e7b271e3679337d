//! One page with pictures and their numbers, complete in one file: no script, no other resource.

use super::Chart;
use super::text::escape;
use std::fmt::Write;

/// A small table under a chart: what can be read from the chart, in numbers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Listing {
    pub caption: String,
    pub heads: Vec<String>,
    /// Its rows, each with one text a column.
    pub rows: Vec<Vec<String>>,
}

/// A table with a caption; the first cell of a row is its heading. `set` turns texts into markup.
pub fn table(
    caption: &str,
    heads: &[impl AsRef<str>],
    rows: &[Vec<String>],
    set: fn(&str) -> String,
) -> String {
    let head = |text: &str| match text.is_empty() {
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
        heads.iter().map(|text| head(text.as_ref())).collect::<String>(),
        rows.iter().map(row).collect::<String>()
    )
}

/// A chart on a page, with what the reader should see in it.
#[derive(Clone, Copy)]
pub struct Section<'a> {
    pub heading: &'a str,
    /// A sentence or two on what is to be seen.
    pub explanation: &'a str,
    pub chart: &'a dyn Chart,
    pub listing: Option<&'a Listing>,
}

#[derive(Clone, PartialEq, Debug)]
pub struct Row {
    pub method: String,
    pub setting: String,
    pub error: f64,
    pub bound: Option<f64>,
    /// Seconds for one point.
    pub seconds: f64,
    /// Seconds of the method compared with, over these seconds.
    pub speed_up: Option<f64>,
}

/// The table of a page: rows in an order of the caller's choice.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Table {
    /// The method to which speed-ups refer; empty if there are none.
    pub compared_with: String,
    pub rows: Vec<Row>,
}

/// A number of the table: three figures, so that columns can be compared by eye and sorted when
/// copied.
fn cell(value: Option<f64>) -> String {
    match value {
        None => "–".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(value) => format!("{value:.2e}"),
    }
}

fn numbers(table: &Table) -> String {
    let mut caption = "Error, proven bound and speed of every setting.".to_owned();
    if !table.compared_with.is_empty() {
        let other = &table.compared_with;
        caption += &format!(" Speed-up is the time of {other} over the time of the row.");
    }
    let heads =
        ["method", "setting", "error", "bound", "seconds a point", "points a second", "speed-up"];
    let row = |row: &Row| {
        let numbers = [Some(row.error), row.bound, Some(row.seconds), Some(1.0 / row.seconds)];
        let speed_up = row.speed_up.map(|ratio| format!("{}×", ratio_text(ratio)));
        let texts = [row.method.clone(), row.setting.clone()].into_iter();
        let texts = texts.chain(numbers.map(cell));
        texts.chain([speed_up.unwrap_or_else(|| cell(None))]).collect()
    };
    let rows: Vec<Vec<String>> = table.rows.iter().map(row).collect();
    let markup = self::table(&caption, &heads, &rows, escape);
    format!("<section class=\"settings\">\n<h2>Numbers</h2>\n{markup}</section>\n")
}

/// A ratio in three figures: 0.0123, 1.23, 12.3, 1230.
fn ratio_text(ratio: f64) -> String {
    if ratio == 0.0 || !ratio.is_finite() {
        return format!("{ratio}");
    }
    let leading = ratio.abs().log10().floor() as i32;
    if !(-4..=6).contains(&leading) {
        return format!("{ratio:.2e}");
    }
    match usize::try_from(2 - leading) {
        Ok(decimals) => format!("{ratio:.decimals$}"),
        Err(_) => {
            let step = 10f64.powi(leading - 2);
            format!("{}", (ratio / step).round() * step)
        }
    }
}

/// A page with a picture and its data for each section, and a table of all numbers after them.
///
/// It is one file of HTML 5, complete in itself: pictures stand in the markup, and nothing is run
/// or loaded. Colours follow the reader's choice of light or dark; in print they are light, and a
/// picture is not broken between pages. Cost: linear in the size of the result.
pub fn page(title: &str, sections: &[Section<'_>], table: &Table) -> String {
    let title = escape(title);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n"
    );
    for (number, section) in sections.iter().enumerate() {
        let svg = section.chart.svg_named(&format!("chart-{}", number + 1));
        let _ = write!(
            page,
            "<section>\n<h2>{}</h2>\n<p>{}</p>\n<figure>\n{svg}</figure>\n<details>\n\
             <summary>The numbers of this picture</summary>\n<pre>",
            escape(section.heading),
            escape(section.explanation)
        );
        for line in section.chart.csv().lines() {
            let _ = writeln!(page, "{}", escape(line));
        }
        page.push_str("</pre>\n</details>\n");
        if let Some(Listing { caption, heads, rows }) = section.listing {
            page.push_str(&self::table(caption, heads, rows, escape));
        }
        page.push_str("</section>\n");
    }
    if !table.rows.is_empty() {
        page.push_str(&numbers(table));
    }
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

const STYLE: &str = "\
:root{color-scheme:light dark}\
body{margin:0;background:#fff;color:#222;\
font:16px/1.5 system-ui,'Segoe UI',Helvetica,Arial,'DejaVu Sans',sans-serif}\
main{max-width:900px;margin:0 auto;padding:24px 16px 64px}\
h1{font-size:28px;line-height:1.2;margin:16px 0 8px}\
h2{font-size:20px;line-height:1.3;margin:44px 0 4px}\
p{margin:4px 0 12px;max-width:70ch}\
figure{margin:0;overflow-x:auto}\
figure svg{display:block;max-width:100%;height:auto;min-width:640px}\
details{margin:6px 0}summary{cursor:pointer;font-size:14px;color:#555}\
pre{font-size:12px;line-height:1.4;max-height:320px;overflow:auto;border:1px solid #ddd;\
padding:8px}\
table{border-collapse:collapse;font-size:14px;width:100%;margin-top:8px}\
caption{text-align:left;color:#555;padding-bottom:8px}\
th,td{text-align:right;font-weight:400;padding:4px 10px 4px 0;border-bottom:1px solid #e4e4e4;\
vertical-align:top;font-variant-numeric:tabular-nums;white-space:nowrap}\
tr :first-child,.settings tr :nth-child(2){text-align:left}\
thead th{font-weight:600;border-bottom:2px solid #888}\
.wide{overflow-x:auto}\
@media screen and (prefers-color-scheme:dark){body{background:#17191d;color:#e8e8e8}\
summary,caption{color:#b9bcc2}pre{border-color:#3a3f47}th,td{border-color:#2c3036}\
thead th{border-color:#757b84}}\
@media print{main{max-width:none;padding:0}section{break-inside:avoid}\
section:has(table){break-inside:auto}\
details{display:none}figure svg{min-width:0}}";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_have_three_figures() {
        for (ratio, text) in [
            (0.012_345, "0.0123"),
            (1.0, "1.00"),
            (12.34, "12.3"),
            (123_456.0, "123000"),
            (1e9, "1.00e9"),
        ] {
            assert_eq!(ratio_text(ratio), text);
        }
    }
}
