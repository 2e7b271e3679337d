//! CSV has the fields of the JSON, row by row.

use super::{anywhere, folder, run, words};
use serde_json::Value;
use std::process::Command;

fn output(line: &str) -> String {
    let (code, out, told) = run(anywhere(), &words(line));
    assert_eq!(code, 0, "{line}: {told}");
    out
}

fn json(line: &str) -> Value {
    serde_json::from_str(&output(&format!("{line} --format json"))).expect("JSON")
}

/// The cells of each row by the name of their column; no cell in these tables holds a comma.
fn rows(line: &str) -> Vec<Vec<(String, String)>> {
    let text = output(&format!("{line} --format csv"));
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells.len(), header.len(), "{line}");
        let named =
            header.iter().zip(cells).map(|(name, cell)| (name.to_string(), cell.to_owned()));
        named.filter(|(_, cell)| !cell.is_empty()).collect()
    };
    lines.map(row).collect()
}

fn cell<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    row.iter().find(|(own, _)| own == name).map_or("", |(_, cell)| cell)
}

#[test]
fn events_have_a_row_each() {
    let line = "events saint-venant --set mu=1";
    let (rows, json) = (rows(line), json(line));
    let events = json["events"].as_array().unwrap();
    assert_eq!(rows.len(), events.len());
    for (row, event) in rows.iter().zip(events) {
        assert_eq!(cell(row, "kind"), event["kind"]);
        assert_eq!(cell(row, "between.1"), event["between"][1]);
        if let Some(time) = event["time"]["decimal"].as_str() {
            assert_eq!(cell(row, "time"), time);
        }
        let bodies = event["bodies"].as_array().unwrap().len();
        assert_eq!(cell(row, "bodies.1.momentum").is_empty(), bodies < 2);
    }
    // What is exact is a decimal, too.
    assert_eq!(cell(&rows[0], "bodies.0.energy"), "0.5");
}

/// The terms of a table give the functions of the JSON back.
#[test]
fn derived_terms_have_a_row_each() {
    for line in [
        "derive rigid-mass --through 3",
        "derive two-bars --through 2",
        "derive incommensurate --through 2",
        "derive mass-on-fixed-bar --form echo --through 2",
    ] {
        let (rows, json) = (rows(line), json(line));
        let mut terms = Vec::new();
        let mut add = |wave: &Value, function: &Value| {
            for term in function["terms"].as_array().unwrap() {
                terms.push((wave.clone(), function["n"].clone(), term.clone()));
            }
        };
        for wave in json["waves"].as_array().into_iter().flatten() {
            let functions = wave["functions"].as_array().unwrap();
            functions.iter().for_each(|function| add(&wave["wave"], function));
        }
        for echo in json["echoes"].as_array().into_iter().flatten() {
            add(&echo["wave"], echo);
        }
        let told: Vec<_> = rows.iter().filter(|row| !cell(row, "coefficient").is_empty()).collect();
        assert!(!terms.is_empty(), "{line}");
        assert_eq!(told.len(), terms.len(), "{line}");
        for (row, (wave, n, term)) in told.into_iter().zip(&terms) {
            assert_eq!(cell(row, "wave"), wave, "{line}");
            assert_eq!(cell(row, "coefficient"), term["coefficient"], "{line}");
            assert_eq!(cell(row, "exponent"), term["exponent"], "{line}");
            if !n.is_null() {
                assert_eq!(cell(row, "n"), n.to_string(), "{line}");
            }
            for (symbol, power) in term["powers"].as_object().unwrap() {
                assert_eq!(cell(row, &format!("powers.{symbol}")), power.to_string(), "{line}");
            }
        }
    }
}

#[test]
fn other_tables_have_the_fields_of_the_json() {
    let line = "dispersion lattice --wavenumber 1,2";
    let all = json(line);
    for (row, at) in rows(line).iter().zip(all["at"].as_array().unwrap()) {
        assert_eq!(cell(row, "omega"), at["omega"]["value"]);
    }
    let line = "hertz hertz-striker --at 20us";
    let all = json(line);
    let rows = rows(line);
    assert_eq!(rows.len(), all["values"].as_object().unwrap().len());
    for row in &rows {
        let value = &all["values"][cell(row, "name")];
        assert_eq!(
            (cell(row, "value"), cell(row, "unit")),
            (value["value"].as_str().unwrap(), value["unit"].as_str().unwrap())
        );
    }
    let both = output("derive mass-on-fixed-bar --model third --through 0 --format csv");
    for model in ["\nexact,f,", "\nthird,rod,"] {
        assert!(both.contains(model), "{both}");
    }
}

/// What a report carries is the certificate of the command, and the checker accepts it.
#[test]
fn reports_carry_their_certificate() {
    let folder = folder("certified-report");
    let (code, _, told) = run(&folder, &words("report two-bars --set r=1/2 -o page.html"));
    assert_eq!(code, 0, "{told}");
    let page = std::fs::read_to_string(folder.join("page.html")).unwrap();
    let (_, rest) = page.split_once("data:application/json,").expect("a certificate");
    let (address, _) = rest.split_once('"').unwrap();
    let mut bytes = Vec::new();
    let mut parts = address.split('%');
    bytes.extend(parts.next().unwrap().bytes());
    for part in parts {
        bytes.push(u8::from_str_radix(&part[..2], 16).unwrap());
        bytes.extend(part[2..].bytes());
    }
    let own = output("certify two-bars --set r=1/2");
    assert_eq!(String::from_utf8(bytes).unwrap(), own);
    std::fs::write(folder.join("certificate.json"), own).unwrap();
    let checker = concat!(env!("CARGO_MANIFEST_DIR"), "/../../checkers/check.py");
    let mut check = Command::new("python3");
    let checked = check.arg(checker).arg("certificate.json").current_dir(&folder).output();
    let checked = checked.expect("Python");
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stdout));
}
