//! How equations look, and the page that lists them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use wavestep::book::{table, table_json, table_latex, table_markdown};

use crate::{ALL, examined};

fn snapshot(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots/book"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name.to_owned(), text));
}

fn run(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_wavestep")).args(arguments).output();
    let Output { status, stdout, stderr } = output.expect("the command runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (status.code(), text(stdout), text(stderr))
}

#[test]
fn equations_are_shown_as_text() {
    for number in
        ["6.31", "6.32", "6.40", "6.75", "6.79", "6.81", "6.86", "6.6-restitution", "6.93"]
    {
        let found = examined(number);
        let text = found.to_text(100);
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
        snapshot(&format!("{number}.text"), &text);
    }
}

#[test]
fn equations_are_shown_as_latex() {
    for number in ["6.31", "6.63", "6.75", "6.80", "6.7-acceleration"] {
        snapshot(&format!("{number}.latex"), &examined(number).to_latex());
    }
}

#[test]
fn equations_are_shown_as_json() {
    let document = examined("6.75").to_json();
    assert_eq!(document["verdict"], "refuted");
    assert_eq!(document["reading"], "clear");
    assert!(document["refuted"]["witness"].as_str().is_some_and(|told| told.contains("against")));
    let text = serde_json::to_string_pretty(&document).expect("JSON");
    snapshot("6.75.json", &text);
    let unsure = examined("6.31").to_json();
    assert_eq!(unsure["readings"][0]["supported"], true);
    assert_eq!(unsure["readings"][1]["supported"], false);
}

#[test]
fn the_command_shows_tables_and_single_equations() {
    let (code, text, _) = run(&["book", "6.75"]);
    assert_eq!((code, text), (Some(0), examined("6.75").to_text(100)));
    let (code, latex, _) = run(&["book", "6.80", "--format", "latex"]);
    assert_eq!((code, latex), (Some(0), examined("6.80").to_latex()));
    let (code, json, _) = run(&["book", "6.80", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((code, &json["verdict"]), (Some(0), &"proved".into()));
    let (code, listed, _) = run(&["book"]);
    assert_eq!((code, listed), (Some(0), table(&ALL)));
    let (code, listed, _) = run(&["book", "--format", "json"]);
    let listed: serde_json::Value = serde_json::from_str(&listed).expect("JSON");
    assert_eq!((code, &listed), (Some(0), &table_json(&ALL)));
    assert_eq!(listed["equations"].as_array().map(Vec::len), Some(ALL.len()));
    let latex = table_latex(&ALL);
    assert!(latex.contains("6.75 & ") && latex.contains("refuted as read"), "{latex}");
}

#[test]
fn numbers_that_are_not_there_are_refused() {
    for (number, remedy) in [
        ("6.28", "did you mean `6.29`?"),
        ("6.101", "did you mean `6.100`?"),
        ("6.91b", "did you mean `6.91`?"),
        ("6.7-limits", "did you mean `6.7-limit`?"),
        ("x", "as `6.80`, and limits such as"),
    ] {
        let (code, out, error) = run(&["book", number]);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{number}");
        assert!(error.contains(&format!("there is no equation `{number}`")), "{error}");
        assert!(error.contains("equations 6.29 to 6.100 are known"), "{error}");
        assert!(error.contains(remedy), "{error}");
    }
    let (code, _, error) = run(&["book", "6.80", "--format", "markdown"]);
    assert_eq!(code, Some(2));
    assert!(error.contains("only the whole table"), "{error}");
}

#[test]
fn the_page_of_equations_is_not_stale() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/equations.md");
    let page = table_markdown(&ALL);
    let (code, printed, _) = run(&["book", "--format", "markdown"]);
    assert_eq!((code, &printed), (Some(0), &page));
    let kept = fs::read_to_string(&path).unwrap_or_default();
    if page != kept && std::env::var_os("UPDATE_DOCUMENTS").is_some() {
        fs::write(&path, &page).expect("the page can be written");
    }
    let kept = fs::read_to_string(&path).expect("the page exists");
    assert_eq!(kept, page);
}
