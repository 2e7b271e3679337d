//! How equations look, and the page that lists them.

use std::fs;
use std::path::Path;

use wavestep_studies::book::{table_latex, table_markdown};

use super::{ALL, examined};
use crate::{ROOT, snapshot};

fn recorded(number: &str, format: &str, text: &str) {
    let asked = format!("book {number} --format {format}");
    snapshot("book", &format!("{number}.{format}"), &asked, text);
}

#[test]
fn equations_are_shown_as_text() {
    for number in
        ["6.31", "6.32", "6.40", "6.75", "6.79", "6.81", "6.86", "6.6-restitution", "6.93"]
    {
        let found = examined(number);
        let text = found.to_text(100);
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
        recorded(number, "text", &text);
    }
}

#[test]
fn equations_are_shown_as_latex() {
    for number in ["6.31", "6.63", "6.75", "6.80", "6.7-acceleration"] {
        recorded(number, "latex", &examined(number).to_latex());
    }
}

#[test]
fn the_table_is_shown_as_latex() {
    let latex = table_latex(&ALL);
    assert!(latex.contains("6.75 & ") && latex.contains("refuted as read"), "{latex}");
}

#[test]
fn equations_are_shown_as_json() {
    let document = examined("6.75").to_json();
    assert_eq!(document["verdict"], "refuted");
    assert_eq!(document["reading"], "clear");
    assert!(document["refuted"]["witness"].as_str().is_some_and(|told| told.contains("against")));
    let text = serde_json::to_string_pretty(&document).expect("JSON");
    recorded("6.75", "json", &text);
    let unsure = examined("6.31").to_json();
    assert_eq!(unsure["readings"][0]["supported"], true);
    assert_eq!(unsure["readings"][1]["supported"], false);
}

#[test]
fn the_page_of_equations_is_not_stale() {
    let path = Path::new(ROOT).join("docs/equations.md");
    let page = table_markdown(&ALL);
    let kept = fs::read_to_string(&path).unwrap_or_default();
    if page != kept && std::env::var_os("UPDATE_DOCUMENTS").is_some() {
        fs::write(&path, &page).expect("the page can be written");
    }
    let kept = fs::read_to_string(&path).expect("the page exists");
    assert_eq!(kept, page);
}
