//! The command `events`, and what other commands say of contacts that open.

use super::{anywhere, run, snapshot, words};

fn output(arguments: &[&str]) -> String {
    let (code, out, told) = run(anywhere(), arguments);
    assert_eq!(code, 0, "{arguments:?}: {told}");
    out
}

fn refusal(arguments: &[&str]) -> (i32, String) {
    let (code, out, told) = run(anywhere(), arguments);
    assert!(out.is_empty());
    (code, told)
}

#[test]
fn the_time_line_reads_well() {
    for (name, line) in [
        ("events-text", "events bars-of-equal-length"),
        ("events-latex", "events bars-of-equal-length --format latex"),
    ] {
        snapshot("history", name, line, &output(&words(line)));
    }
}

#[test]
fn json_holds_exact_and_certified_numbers() {
    let text = output(&["events", "saint-venant", "--set", "mu=1", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let events = json["events"].as_array().unwrap();
    let kinds: Vec<&str> = events.iter().map(|event| event["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["impact", "opening", "closing", "opening"]);
    assert_eq!(events[0]["time"]["exact"], "0");
    assert_eq!(events[1]["time"]["decimal"], "3.06766764162");
    assert!(events[1]["time"]["radius"].is_string());
    assert_eq!(events[1]["bodies"].as_array().unwrap().len(), 2);
    assert_eq!(json["ending"]["kind"], "parted");
    assert_eq!(json["contacts"][0]["durations"].as_array().unwrap().len(), 2);
}

/// In the closed form the right bar pulls the left one after t = 2; across phases the left one is at rest.
#[test]
fn eval_goes_on_across_phases() {
    let arguments = |scene| ["eval", scene, "--quantity", "left", "--at", "5/2"];
    assert_eq!(output(&arguments("bars-of-equal-length")), "left(5/2) = 0\n");
    let closed = output(&["scenes", "bars-of-equal-length"]).replace("contacts open\n", "");
    let file = anywhere().join("closed.wave");
    std::fs::write(&file, closed).unwrap();
    let closed = output(&arguments(file.to_str().unwrap()));
    assert_eq!(closed, "left(5/2) = 0.5 = 1/2\n");
}

#[test]
fn what_does_not_follow_contacts_says_so() {
    for arguments in [
        &[
            "eval",
            "saint-venant",
            "--set",
            "mu=1",
            "--quantity",
            "velocity",
            "--at",
            "1",
            "--tol",
            "1e-9",
        ][..],
        &[
            "export",
            "saint-venant",
            "--as",
            "c",
            "--set",
            "mu=1",
            "--quantity",
            "velocity",
            "--to",
            "1",
        ],
    ] {
        let (code, told) = refusal(arguments);
        assert_eq!(code, 2, "{told}");
        assert!(told.contains("contacts that open are not followed by"), "{told}");
    }
    let (code, told) = refusal(&["events", "rigid-mass"]);
    assert!(code == 2 && told.contains("a recurrence has no contacts"), "{told}");
    let (code, told) = refusal(&["events", "pushed-bar"]);
    assert!(code == 2 && told.contains("no contact that could open"), "{told}");
    let (code, told) = refusal(&["events", "saint-venant"]);
    assert!(code == 2 && told.contains("`mu` has no value"), "{told}");
}

/// The form with closed contacts says until when it holds.
#[test]
fn derive_says_until_when_its_form_holds() {
    let line = "derive saint-venant --set mu=1 --through 1";
    let (code, _, told) = run(anywhere(), &words(line));
    assert_eq!(code, 0);
    assert_eq!(told, "note: this holds until t = 3.06766764162, when hammer and rod part\n");
}
