//! Tables of comma-separated values: a reader of RFC 4180 gets back every text and every double.

use crate::bytes::Bytes;
use serde_json::{Map, Value as Json, json};
use wavestep_draw::{Axis, Caption, Chart as _, Figure, Panel, Series};

#[path = "../../../crates/cli/src/table.rs"]
#[allow(dead_code, missing_docs, reason = "shared with the command")]
mod table;

/// The fields of each row; `None` for what is no such table.
fn rows(csv: &str) -> Option<Vec<Vec<String>>> {
    let (mut rows, mut row, mut field) = (Vec::new(), Vec::new(), String::new());
    let mut characters = csv.chars().peekable();
    let (mut is_quoted, mut was_quoted) = (false, false);
    while let Some(character) = characters.next() {
        match character {
            '"' if is_quoted && characters.peek() == Some(&'"') => {
                characters.next();
                field.push('"');
            }
            '"' if is_quoted => is_quoted = false,
            '"' if field.is_empty() && !was_quoted => (is_quoted, was_quoted) = (true, true),
            _ if is_quoted => field.push(character),
            ',' | '\n' => {
                row.push(std::mem::take(&mut field));
                was_quoted = false;
                if character == '\n' {
                    rows.push(std::mem::take(&mut row));
                }
            }
            '"' | '\r' => return None,
            _ if was_quoted => return None,
            _ => field.push(character),
        }
    }
    let is_whole = field.is_empty() && row.is_empty() && !is_quoted;
    let is_even = rows.windows(2).all(|pair| pair[0].len() == pair[1].len());
    (is_whole && is_even).then_some(rows)
}

fn assert_rows(csv: &str, expected: &[Vec<String>]) {
    assert_eq!(rows(csv).as_deref(), Some(expected), "{csv:?}");
}

pub fn tables(data: &[u8]) {
    let mut bytes = Bytes(data);
    // A figure.
    let axis = Axis::linear(&bytes.text()).unit(&bytes.text());
    let mut expected =
        vec![vec!["panel".to_owned(), "series".into(), axis.label(), "value".into()]];
    let (mut panels, mut numbers) = (Vec::new(), Vec::new());
    for _ in 0..=bytes.below(2) {
        let y = Axis::linear(&bytes.text());
        let mut all = Vec::new();
        for _ in 0..=bytes.below(2) {
            let name = bytes.text();
            let points: Vec<_> =
                (0..bytes.below(4)).map(|_| (bytes.double(), bytes.double())).collect();
            for (x, value) in points.iter().filter(|(x, y)| x.is_finite() && y.is_finite()) {
                // A series without a name is called after its axis.
                let named = if name.is_empty() { &y.name } else { &name };
                expected.push(vec![y.label(), named.clone(), x.to_string(), value.to_string()]);
                numbers.push([*x, *value].map(f64::to_bits));
            }
            all.push(Series::new(&name, points));
        }
        panels.push(Panel::new(y, all));
    }
    if let Ok(figure) = Figure::new(&bytes.text(), axis, panels, Caption::default()) {
        let mut found = rows(&figure.csv()).expect("a table");
        for (row, pair) in found[1..].iter_mut().zip(&numbers) {
            for (field, bits) in row[2..].iter_mut().zip(pair) {
                let number: f64 = field.parse().expect("a number");
                assert_eq!(number.to_bits(), *bits, "{field}");
                *field = number.to_string();
            }
        }
        assert_eq!(found, expected);
    }
    // A table of the command.
    let (mut columns, mut table) = (Vec::<String>::new(), table::Table::default());
    let mut lines: Vec<Map<String, Json>> = Vec::new();
    for _ in 0..=bytes.below(4) {
        let mut line = Map::new();
        for _ in 0..=bytes.below(4) {
            let name = format!("c{}", bytes.below(6));
            let value = match bytes.below(5) {
                0 => Json::Null,
                1 => json!(bytes.word() as i64),
                2 => json!(bytes.below(2) == 1),
                _ => json!(bytes.text()),
            };
            if !columns.contains(&name) {
                columns.push(name.clone());
            }
            line.insert(name, value);
        }
        lines.push(line);
    }
    table.add(&json!({ "values": lines }), &Map::new());
    let cell = |value: Option<&Json>| match value {
        None | Some(Json::Null) => String::new(),
        Some(Json::String(text)) => text.clone(),
        Some(other) => other.to_string(),
    };
    let body = lines.iter().map(|line| columns.iter().map(|name| cell(line.get(name))).collect());
    let mut expected: Vec<Vec<String>> = body.collect();
    expected.insert(0, columns.clone());
    assert_rows(&table.csv(), &expected);
}
