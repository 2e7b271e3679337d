//! Expressions and pieces as JSON.

use crate::snapshot;
use std::collections::BTreeMap;
use wavestep::language::{Source, read_expression, read_recurrence};
use wavestep::scenes;
use wavestep::solution::Solution;
use wavestep_cli::json::{expression_json, pieces_json};

fn terms(text: &str) -> String {
    expression_json(&read_expression(&Source::new("text", text).unwrap()).unwrap()).to_string()
}

#[test]
fn terms_are_told_apart() {
    let one = r#"[{"coefficient":"1","powers":{},"exponent":"0"}]"#;
    assert_eq!(terms("1"), one);
    let quotient = r#"[{"coefficient":"-4/3","powers":{"s":3},"exponent":"-s","denominator":[{"factor":"r + 1","power":1}]}]"#;
    assert_eq!(terms("-4/3*s^3*exp(-s)/(r + 1)"), quotient);
    let roots =
        r#"[{"coefficient":"3/2","roots":["2","3"],"powers":{"s":1},"exponent":"-s*sqrt(2)"}]"#;
    assert_eq!(terms("3/2*sqrt(6)*s*exp(-sqrt(2)*s)"), roots);
}

#[test]
fn pieces_look_as_recorded() {
    let source = Source::new("scene", scenes::find("rigid-mass").unwrap().text).unwrap();
    let solution = Solution::new(read_recurrence(&source, &BTreeMap::new()).unwrap());
    let f = solution.recurrence().wave("f").unwrap();
    let local = &solution.recurrence().statement().local;
    let json = pieces_json("n", 0, local, &solution.pieces(f, 0, 2).unwrap());
    let json = serde_json::to_string_pretty(&json).unwrap();
    snapshot("formulas", "rigid-mass-json", "f of rigid-mass, its first three pieces", &json);
}
