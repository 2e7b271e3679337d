//! CSV with the fields of the JSON: a row for each innermost entry, columns named after the fields.

use serde_json::{Map, Value as Json};
use wavestep::ball::Decimal;

/// Lists whose entries have rows; an entry's own fields stand in each row of the entries below it.
const LISTS: [&str; 9] =
    ["events", "waves", "echoes", "functions", "formulas", "terms", "tried", "at", "values"];

/// Rows, and the columns in the order in which they first occur.
#[derive(Default)]
pub struct Table {
    columns: Vec<String>,
    rows: Vec<Map<String, Json>>,
}

impl Table {
    /// Adds the rows of a document, each with these fields in front.
    pub fn add(&mut self, document: &Json, front: &Map<String, Json>) {
        for list in LISTS.iter().filter_map(|list| document[*list].as_array()) {
            list.iter().for_each(|entry| self.entry(entry, front.clone()));
        }
    }

    fn entry(&mut self, entry: &Json, mut row: Map<String, Json>) {
        let mut below = None;
        for (name, value) in entry.as_object().into_iter().flatten() {
            match value.as_array() {
                Some(list) if LISTS.contains(&name.as_str()) && !list.is_empty() => {
                    below = Some(list)
                }
                _ => flatten(name, value, &mut row),
            }
        }
        match below {
            Some(below) => below.iter().for_each(|entry| self.entry(entry, row.clone())),
            None => self.push(row),
        }
    }

    /// The rows of a document alone.
    pub fn of(document: &Json) -> Table {
        let mut table = Table::default();
        table.add(document, &Map::new());
        table
    }

    /// Adds a row.
    pub fn push(&mut self, row: Map<String, Json>) {
        let new = row.keys().filter(|name| !self.columns.contains(name));
        let new: Vec<String> = new.cloned().collect();
        self.columns.extend(new);
        self.rows.push(row);
    }

    /// Puts these columns last, where there are some.
    pub fn move_last(&mut self, names: &[&str]) {
        self.columns.sort_by_key(|column| names.iter().position(|name| name == column));
    }

    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    pub fn rows(&self) -> &[Map<String, Json>] {
        &self.rows
    }

    pub fn csv(&self) -> String {
        let header = self.columns.join(",") + "\n";
        let cell =
            |row: &Map<String, Json>, column: &String| row.get(column).map_or(String::new(), text);
        let line = |row: &Map<String, Json>| {
            let cells = self.columns.iter().map(|column| cell(row, column));
            cells.collect::<Vec<_>>().join(",") + "\n"
        };
        header + &self.rows.iter().map(line).collect::<String>()
    }
}

/// Significant digits of what is exact.
const DIGITS: usize = 17;

/// A number is its decimal; other parts have columns of their own: `force.0`,
/// `velocities.after.1`, `powers.s`.
fn flatten(name: &str, value: &Json, row: &mut Map<String, Json>) {
    let within = |part: &str| format!("{name}.{part}");
    match value {
        Json::Object(parts) => {
            if let Some(number) = number(value) {
                let exact = number.parse().map(|exact| Decimal::from_rational(&exact, DIGITS).0);
                let decimal = exact.map_or_else(|_| number.to_owned(), |exact| exact.to_string());
                row.insert(name.to_owned(), decimal.into());
                return;
            }
            parts.iter().for_each(|(part, value)| flatten(&within(part), value, row));
        }
        Json::Array(parts) => {
            for (i, value) in parts.iter().enumerate() {
                flatten(&within(&i.to_string()), value, row);
            }
        }
        other => drop(row.insert(name.to_owned(), other.clone())),
    }
}

/// A number of [`found::number`](super::found::number) in one word.
pub fn number(value: &Json) -> Option<&str> {
    ["exact", "decimal", "midpoint", "value"].iter().find_map(|key| value[*key].as_str())
}

fn text(value: &Json) -> String {
    let text = match value {
        Json::String(text) => text.clone(),
        Json::Null => String::new(),
        other => other.to_string(),
    };
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text,
    }
}
