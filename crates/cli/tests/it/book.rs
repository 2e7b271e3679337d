//! `wavestep book`: tables and single equations, and numbers that are not there.

use super::{anywhere, run};
use wavestep_studies::book::{examine, examine_all, table, table_json, table_markdown};

#[test]
fn the_command_shows_tables_and_single_equations() {
    let (code, text, _) = run(anywhere(), &["book", "6.75"]);
    assert_eq!((code, text), (0, examine("6.75").unwrap().to_text(100)));
    let (code, latex, _) = run(anywhere(), &["book", "6.80", "--format", "latex"]);
    assert_eq!((code, latex), (0, examine("6.80").unwrap().to_latex()));
    let (code, json, _) = run(anywhere(), &["book", "6.80", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((code, &json["verdict"]), (0, &"proved".into()));
    let all = examine_all();
    let (code, listed, _) = run(anywhere(), &["book"]);
    assert_eq!((code, listed), (0, table(&all)));
    let (code, listed, _) = run(anywhere(), &["book", "--format", "json"]);
    let listed: serde_json::Value = serde_json::from_str(&listed).expect("JSON");
    assert_eq!((code, &listed["equations"]), (0, &table_json(&all)));
    assert_eq!(listed["schema_version"], 1);
    let (code, page, _) = run(anywhere(), &["book", "--format", "markdown"]);
    assert_eq!((code, page), (0, table_markdown(&all)));
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
        let (code, out, error) = run(anywhere(), &["book", number]);
        assert_eq!((code, out.as_str()), (2, ""), "{number}");
        assert!(error.contains(&format!("there is no equation `{number}`")), "{error}");
        assert!(error.contains("equations 6.29 to 6.100 are known"), "{error}");
        assert!(error.contains(remedy), "{error}");
    }
    let (code, _, error) = run(anywhere(), &["book", "6.80", "--format", "markdown"]);
    assert_eq!(code, 2);
    assert!(error.contains("only the whole table"), "{error}");
}
