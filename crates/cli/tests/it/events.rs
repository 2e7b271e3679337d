//! The command `events`, and what other commands say of contacts that open.

use std::path::Path;
use std::process::{Command, Output};

fn run(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wavestep"));
    command.current_dir(Path::new(env!("CARGO_TARGET_TMPDIR"))).env("NO_COLOR", "1");
    command.args(arguments).output().expect("the command runs")
}

fn output(arguments: &[&str]) -> String {
    let output = run(arguments);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{arguments:?}: {told}");
    String::from_utf8(output.stdout).unwrap()
}

fn refusal(arguments: &[&str]) -> (i32, String) {
    let output = run(arguments);
    assert!(output.stdout.is_empty());
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

fn snapshot(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/../../snapshots/history"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name.to_owned(), text));
}

#[test]
fn the_time_line_reads_well() {
    let text = output(&["events", "bars-of-equal-length"]);
    snapshot("events-text", &text);
    let latex = output(&["events", "bars-of-equal-length", "--format", "latex"]);
    snapshot("events-latex", &latex);
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
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("closed.wave");
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
    let output = run(&["derive", "saint-venant", "--set", "mu=1", "--through", "1"]);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success());
    assert_eq!(told, "note: this holds until t = 3.06766764162, when hammer and rod part\n");
}
