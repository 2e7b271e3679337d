//! `wavestep book`: tables and single equations, and numbers that are not there.

use std::process::{Command, Output};
use wavestep_studies::book::{examine, examine_all, table, table_json, table_markdown};

fn run(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_wavestep")).args(arguments).output();
    let Output { status, stdout, stderr } = output.expect("the command runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (status.code(), text(stdout), text(stderr))
}

#[test]
fn the_command_shows_tables_and_single_equations() {
    let (code, text, _) = run(&["book", "6.75"]);
    assert_eq!((code, text), (Some(0), examine("6.75").unwrap().to_text(100)));
    let (code, latex, _) = run(&["book", "6.80", "--format", "latex"]);
    assert_eq!((code, latex), (Some(0), examine("6.80").unwrap().to_latex()));
    let (code, json, _) = run(&["book", "6.80", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((code, &json["verdict"]), (Some(0), &"proved".into()));
    let all = examine_all();
    let (code, listed, _) = run(&["book"]);
    assert_eq!((code, listed), (Some(0), table(&all)));
    let (code, listed, _) = run(&["book", "--format", "json"]);
    let listed: serde_json::Value = serde_json::from_str(&listed).expect("JSON");
    assert_eq!((code, &listed["equations"]), (Some(0), &table_json(&all)));
    assert_eq!(listed["schema_version"], 1);
    let (code, page, _) = run(&["book", "--format", "markdown"]);
    assert_eq!((code, page), (Some(0), table_markdown(&all)));
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
