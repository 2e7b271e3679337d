//! The built command in doubles: tolerances that are kept, methods by name, what is refused and how,
//! and C files.

use super::{anywhere, command, folder, run, words};
use num_rational::BigRational;
use num_traits::{FromPrimitive as _, Signed as _};
use proptest::prelude::RngExt as _;
use proptest::test_runner::{RngAlgorithm, TestRng};
use serde_json::Value;
use std::fs;
use std::process::{Output, Stdio};
use wavestep::language::parse_number;

/// Standard output and standard error of a command that does its work.
fn both(line: &str) -> (String, String) {
    let (code, out, err) = run(anywhere(), &words(line));
    assert_eq!(code, 0, "{line}: {err}");
    (out, err)
}

/// The value that a line of output ends with.
fn printed(line: &str) -> f64 {
    line.trim().rsplit(' ').next().unwrap().parse().unwrap_or_else(|_| panic!("{line}"))
}

/// The same value in forty digits, and what its rounding may be.
fn in_digits(line: &str) -> (BigRational, BigRational) {
    let (stdout, _) = both(&format!("{line} --digits 40 --format json"));
    let document: Value = serde_json::from_str(&stdout).unwrap();
    let value = document["values"][0]["value"].as_str().unwrap();
    let value = parse_number(value).unwrap();
    let rounding = value.abs() / BigRational::from_integer(10_u64.pow(18).into());
    let rounding = rounding / BigRational::from_integer(10_u64.pow(18).into());
    (value, rounding)
}

fn exact(value: f64) -> BigRational {
    BigRational::from_f64(value).expect("a number")
}

// ---- What is asked for is given -----------------------------------------------------------------

/// Values within tolerances at random, absolute ones, against forty digits.
#[test]
fn tolerances_are_honoured() {
    let mut random = TestRng::from_seed(RngAlgorithm::ChaCha, &[81; 32]);
    let mut compared = 0;
    for scene in [
        "rigid-mass --set mu=2/3 --quantity velocity",
        "rigid-mass --set mu=1/7 --quantity strain_fixed",
        "pulse-shape --set mu=3 --quantity force",
        "mass-between-bars --set m=2 --quantity force_wall",
        "stepped-striker --quantity pulse",
    ] {
        for side in ["left", "right"] {
            for _ in 0..3 {
                let time = format!("{}/8", random.random_range(0..48));
                let tolerance = 10f64.powf(random.random_range(-14.5..-1.0));
                let line = format!("eval {scene} --at {time} --side {side}");
                let (stdout, stderr) = both(&format!("{line} --tol abs:{tolerance:e}"));
                let mut said = stderr.lines();
                assert!(said.all(|told| told.starts_with("note: from t = ")), "{line}: {stderr}");
                let (value, rounding) = in_digits(&line);
                let error = (exact(printed(&stdout)) - value).abs();
                assert!(error <= exact(tolerance) + rounding, "{line} {tolerance:e}");
                compared += 1;
            }
        }
    }
    println!("tolerances of the command: {compared} comparisons");
    assert_eq!(compared, 30);
}

/// The double nearest to a tenth lies beyond it.
#[test]
fn models_reach_the_end_of_a_window() {
    for method in ["third", "modes:10", "leapfrog:20", "steps:1e-9", "compiled"] {
        let line = "eval mass-on-fixed-bar --set mu=1/100 --quantity velocity --from 0 --to 1/10 --points 2";
        let (values, _) = both(&format!("{line} --method {method}"));
        let last = printed(values.lines().last().unwrap());
        // A third of the mass is off by 0.0033.
        assert!((last - 0.5432).abs() < 4e-3, "{method}: {last}");
    }
}

/// A window that begins with an arrival has both limits there, by every method.
#[test]
fn left_limits_at_the_first_time() {
    for method in ["certified", "compiled", "marched", "stable", "double-double"] {
        for (mu, time) in [("1", "2"), ("1/3", "2/3"), ("1/10", "1")] {
            for side in ["left", "right"] {
                let line =
                    format!("eval rigid-mass --set mu={mu} --quantity f --at {time} --side {side}");
                let (stdout, _) = both(&format!("{line} --method {method}"));
                let (value, _) = in_digits(&line);
                let error = (exact(printed(&stdout)) - value).abs();
                assert!(error < exact(1e-14), "{line} --method {method}: {stdout}");
            }
        }
    }
    // The front of the spring at the toe begins at zero, where irrational terms cancel.
    let (stdout, _) = both("eval pile --quantity toe_force --at 1 --method certified");
    assert_eq!(stdout, "toe_force(1) = 0\n");
}

#[test]
fn the_way_is_explained() {
    let line = "eval rigid-mass --set mu=1 --quantity f --from 0 --to 80";
    let picked = |rest: &str| {
        let (stdout, stderr) = both(&format!("{line} {rest} --explain"));
        assert!(stdout.starts_with("f(0) = 1\n"), "{stdout}");
        let mut rows = stderr.lines().skip(2);
        let first = rows.next().unwrap().trim_start().to_owned();
        assert!(first.contains("the cheapest that is proven to be accurate enough"), "{stderr}");
        assert_eq!(rows.count(), 6, "{stderr}");
        first.split(' ').next().unwrap().to_owned()
    };
    assert_eq!(picked("--points 2 --tol 1e-16"), "certified");
    // Values of a march in integers are the cheapest of all at exact times; others are not.
    assert_eq!(picked("--points 12000 --tol 1e-15"), "certified");
    let others = "eval cushioned-impact --set mu=1 --quantity force --from 0 --to 4 --points 20000";
    let (_, stderr) = both(&format!("{others} --tol 1e-15 --explain"));
    let row = stderr.lines().nth(2).unwrap().trim_start();
    assert!(row.starts_with("compiled "), "{stderr}");
    let (_, stderr) = both(&format!("{line} --points 2 --method compiled --explain"));
    assert!(stderr.starts_with("compiled, as requested: at most "), "{stderr}");
    assert!(stderr.contains("proven"), "{stderr}");
}

#[test]
fn formats_hold_the_method_and_its_bound() {
    let line = "eval rigid-mass --set mu=1 --quantity f --from 0 --to 5 --points 3";
    let (stdout, _) = both(&format!("{line} --method compiled --format json"));
    let document: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(document["method"], "compiled");
    assert!(document["bound"].as_f64().unwrap() < 1e-15);
    let by_json: Vec<f64> = document["values"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v["value"].as_f64().unwrap())
        .collect();
    let (stdout, _) = both(&format!("{line} --method compiled --format csv"));
    let mut rows = stdout.lines();
    assert_eq!(rows.next(), Some("time,time_decimal,value"));
    let by_csv: Vec<f64> =
        rows.map(|row| row.rsplit(',').next().unwrap().parse().unwrap()).collect();
    assert_eq!(by_json, by_csv);
    let (stdout, _) = both(&format!("{line} --method stable --format json"));
    let document: Value = serde_json::from_str(&stdout).unwrap();
    assert!(document["bound"].is_null(), "what is measured is no bound");
    assert!(document["law"].as_str().unwrap().contains("measured"));
}

/// Methods that are forced give their values, and say on standard error what these are worth.
#[test]
fn forced_methods_warn() {
    let line = "eval rigid-mass --set mu=1 --quantity f --at 80";
    let warned = |rest: &str, expected: &str| {
        let (stdout, stderr) = both(&format!("{line} {rest}"));
        assert!(stdout.starts_with("f(80) = 1.07"), "{stdout}");
        assert!(stderr.contains(expected), "{rest}: {stderr}");
    };
    warned("--method expanded --tol 1e-12", "warning: expanded is off by ");
    warned("--method stable --tol 1e-9", "note: stable is off by at most ");
    warned("--method compiled --tol 1e-18", "warning: compiled is proven to within ");
    warned("--method marched --tol ulp:4", "not to 4 units in the last place");
    let model = "eval mass-on-fixed-bar --set mu=1 --quantity velocity --at 3 --method";
    let (_, stderr) = both(&format!("{model} modes:4 --tol 1e-9"));
    assert!(stderr.starts_with("warning: modes:4 is off by "), "{stderr}");
    let (_, stderr) = both(&format!("{model} modes:400 --tol 1e-2"));
    assert!(stderr.starts_with("note: modes:400 is off by at most "), "{stderr}");
    let (_, stderr) = both(&format!("{model} modes:4"));
    assert_eq!(stderr, "", "nothing is compared where nothing is asked for");
}

// ---- What is refused ----------------------------------------------------------------------------

/// Lines with the exit code, the message and the remedy, which may go on.
const REFUSALS: [(&str, i32, &str, &str); 17] = [
    (
        "eval rigid-mass --set mu=1 --quantity f --at 2 --tol 1e-20",
        3,
        "no double is proven to be within 1e-20 of the largest value",
        "compute digits instead: --digits 25",
    ),
    (
        "eval rigid-mass --set mu=1 --quantity f --at 2 --tol abs:1e-17",
        3,
        "no double is proven to be within 1e-17",
        "compute digits instead",
    ),
    (
        "eval rigid-mass --set mu=1 --quantity f --at 2 --tol ulp:0.49",
        3,
        "no double is proven to be within 0.49 units in the last place of the largest value",
        "compute digits instead",
    ),
    (
        "eval rigid-mass --set mu=1 --quantity f --at 2 --method magic",
        2,
        "there is no method `magic`",
        "give one of certified, compiled, marched, marched-unproven, stable, double-double, plain, \
         expanded, rigid, third, modes:N, leapfrog:CELLS,CFL, steps:TOL",
    ),
    (
        "eval rigid-mass --set mu=1 --quantity f --at 2 --method modes:few",
        2,
        "`few` is not a setting of modes",
        "give one of",
    ),
    (
        "eval rigid-mass --set mu=1 --quantity f --at 2 --method compiled:4",
        2,
        "`4` is not a setting of compiled",
        "give one of",
    ),
    (
        "eval rigid-mass --set mu=1 --quantity f --at 2 --tol often",
        2,
        "`often` is not a tolerance",
        "write 1e-9 (of the largest value), abs:1e-9 or ulp:4",
    ),
    (
        "eval rigid-mass --set mu=1 --quantity f --at 2 --tol rel:1e-9",
        2,
        "`rel:1e-9` is not a tolerance",
        "write 1e-9",
    ),
    (
        "eval rigid-mass --set mu=1 --quantity f --at 2 --method modes",
        1,
        "modes is a model for scenes of bars, and this is a recurrence",
        "describe the scene by its parts: see docs/scene-language.md",
    ),
    (
        "eval mass-on-fixed-bar --set mu=1 --quantity velocity --at 2 --side left --method modes",
        1,
        "modes is a model without one-sided limits",
        "remove --side left",
    ),
    (
        "eval mass-on-fixed-bar --set mu=1 --quantity velocity --at 2 --method rigid",
        1,
        "the model \"rigid body\" does not support this scene",
        "use another model, or a method based on the exact solution",
    ),
    (
        "eval incommensurate --quantity wall_force --at 100us --method stable",
        1,
        "echoes do not arrive on a common grid",
        "use --method compiled or certified",
    ),
    (
        "eval rigid-mass --set mu=1 --quantity f --at 100000000 --method marched",
        1,
        "50000000 periods; this method supports at most 10000000",
        "use a shorter window, or --method certified",
    ),
    (
        "eval rigid-mass --quantity f --at 2 --tol 1e-9",
        2,
        "the symbol mu has no value",
        "set it: --set mu=1",
    ),
    (
        "export rigid-mass --set mu=1 --as c --quantity f --from 3 --to 2",
        2,
        "the window from 3 to 2 is empty",
        "give --from before --to",
    ),
    (
        "export rigid-mass --set mu=1 --as c --quantity f --to 2 --tol 1e-20",
        3,
        "doubles are proven to within ",
        "give a larger --tol",
    ),
    (
        "export rigid-mass --set mu=1 --as c --quantity f --to 2 --tol 1%",
        2,
        "`1%` is not a tolerance",
        "write 1e-9",
    ),
];

#[test]
fn refusals_say_what_is_wrong_and_what_helps() {
    for (line, code, message, remedy) in REFUSALS {
        let (found, stdout, stderr) = run(anywhere(), &words(line));
        assert_eq!((found, stdout.as_str()), (code, ""), "{line}: {stderr}");
        assert!(stderr.starts_with(&format!("error: {message}")), "{line}: {stderr}");
        assert!(stderr.contains(&format!("\nhelp: {remedy}")), "{line}: {stderr}");
    }
}

#[test]
fn options_that_contradict_each_other_are_usage() {
    let line = "eval rigid-mass --set mu=1 --quantity f --at 2 --tol 1e-9";
    for other in ["--digits 20", "--max-bits 100", "--method certified --stats"] {
        let (code, _, stderr) = run(anywhere(), &words(&format!("{line} {other}")));
        assert_eq!(code, 2, "{other}");
        assert!(stderr.contains("cannot be used with"), "{other}: {stderr}");
    }
}

/// More output than a pipe holds, to a reader that is gone.
#[test]
fn a_reader_that_goes_away_ends_it_quietly() {
    let line = "eval pushed-bar --quantity velocity --from 0 --to 10 --points 50000 --tol 1e-9";
    let mut command = command(anywhere(), &words(line));
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let Output { status, stderr, .. } = child.wait_with_output().unwrap();
    assert_eq!(status.code(), Some(0));
    assert_eq!(String::from_utf8(stderr).unwrap(), "");
}

// ---- C files ------------------------------------------------------------------------------------

/// The file names the command that writes it, its bound is within the tolerance, and the command that
/// it names writes the same file.
#[test]
fn a_c_file_tells_how_it_was_written() {
    let folder = folder("answer-c");
    let file = folder.join("gauge.c");
    let line = "export hopkinson --as c --quantity gauge_output --to 500us --tol 1e-6";
    let (stdout, _) = both(&format!("{line} -o {}", file.display()));
    let text = fs::read_to_string(&file).unwrap();
    assert_eq!(stdout, format!("{}: {} bytes\n", file.display(), text.len()));
    let stated = text.lines().find_map(|l| l.strip_prefix(" *   wavestep ")).unwrap();
    assert_eq!(
        stated,
        "export hopkinson --as c --quantity gauge_output --from 0 --to 500us --tol 1e-6"
    );
    let (again, _) = both(stated);
    assert_eq!(again, text);
    let bound = text.lines().find_map(|l| l.strip_prefix("#define WAVESTEP_GAUGE_OUTPUT_BOUND "));
    let bound: f64 = bound.unwrap().parse().unwrap();
    // The strain behind a striker of 10 m/s is about V/(2c): some 1e-3.
    assert!(bound > 0.0 && bound <= 1e-6 * 2e-3, "{bound:e}");
    assert!(text.contains("in s;"), "the unit of time");
}

/// The doubles nearest to both ends are in the window: 1.4 and 3.3 lie on different sides of 7/5 and 33/10.
#[test]
fn exported_windows_hold_the_doubles_of_their_ends() {
    for (from, to) in [("1.4", "3.3"), ("3.3", "4.4"), ("0.1", "0.3")] {
        let line =
            format!("export rigid-mass --set mu=1 --as c --quantity f --from {from} --to {to}");
        let (out, _) = both(&line);
        let told = out.lines().find_map(|line| line.strip_prefix(" * t from "));
        let ends = told.and_then(|told| told.split_once(" to ")).unwrap();
        let number = |text: &str| {
            let text = text.split([' ', ',', '*']).next().unwrap();
            text.parse::<f64>().unwrap_or_else(|_| panic!("{text}"))
        };
        assert!(
            number(ends.0) <= from.parse().unwrap() && number(ends.1) >= to.parse().unwrap(),
            "{ends:?}"
        );
    }
}

/// A file that cannot be written is a fault of usage, and no part of it is left.
#[test]
fn a_file_is_written_whole_or_not_at_all() {
    let folder = folder("answer-nowhere");
    let file = folder.join("missing").join("f.c");
    let line = "export rigid-mass --set mu=1 --as c --quantity f --to 2 -o";
    assert_eq!(run(anywhere(), &words(&format!("{line} {}", file.display()))).0, 2);
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

// ---- What is said of values ---------------------------------------------------------------------

#[test]
fn times_of_few_digits_are_printed_so() {
    let (out, _) = both("eval rigid-mass --set mu=1 --quantity f --at 1e-300 --digits 3");
    assert_eq!(out, "f(1e-300) = 1.00\n");
    let (out, _) = both("eval rigid-mass --set mu=1 --quantity f --at 1/3 --digits 3");
    assert!(out.starts_with("f(1/3) = "), "{out}");
}

#[test]
fn a_value_outside_its_range_is_one_error() {
    let (code, _, err) = run(anywhere(), &words("check saint-venant --set mu=0"));
    assert_eq!((code, err.matches("error:").count()), (2, 1), "{err}");
    assert!(err.contains("outside the range"), "{err}");
}

#[test]
fn values_beyond_a_pulling_contact_are_noted() {
    for accuracy in ["", " --tol 1e-6"] {
        let (_, err) = both(&format!("eval hopkinson --quantity force --at 1ms{accuracy}"));
        let note =
            "between striker and incident is in tension; add `contacts open` and it opens instead";
        assert!(err.contains(note), "{err}");
    }
    let (_, err) = both("eval hopkinson --quantity force --at 100us");
    assert!(!err.contains("in tension"), "{err}");
}

/// In scenes with units exact values are decimals, rounded where they do not end; without units the fraction stands beside.
#[test]
fn fractions_stand_beside_decimals_without_units() {
    let folder = folder("fractions");
    let text = "scene \"A\"\nbar a { impedance = 1 kg/s, travel = 1 s, velocity = 1 m/s }\n\
        bar b { impedance = 2 kg/s, travel = 1 s }\nline free - a | b - free\nobserve v = velocity(b.left)\n";
    fs::write(folder.join("units.wave"), text).unwrap();
    let plain = text.replace(" kg/s", "").replace(" m/s", "").replace("1 s", "1");
    fs::write(folder.join("plain.wave"), plain).unwrap();
    let told = |scene: &str, at: &str| {
        let line = format!("eval {scene} --quantity v --digits 6 --at {at}");
        run(&folder, &words(&line)).1
    };
    assert_eq!(told("units.wave", "0.5s"), "v(0.5 s) = 0.333333 m/s\n");
    assert_eq!(told("plain.wave", "1/2"), "v(1/2) = 0.333333 = 1/3\n");
}

#[test]
fn a_picture_of_values_beyond_doubles_is_refused() {
    let folder = folder("too-large");
    let scene = folder.join("large.wave");
    let text = "scene \"A\"\nload push { force = 1e400 }\nbar b { impedance = 1, travel = 1 }\n\
        line free - push - b - free\nobserve f = force(b.at(1/2))\n";
    fs::write(&scene, text).unwrap();
    let scene = scene.to_str().unwrap();
    let arguments = ["plot", scene, "--quantity", "f", "--to", "4", "-o", "large.svg"];
    let (code, _, err) = run(&folder, &arguments);
    assert!(code != 0 && err.contains("values of f are too large for doubles"), "{err}");
}

#[test]
fn times_beyond_all_doubles_are_refused() {
    let folder = folder("far");
    for how in ["--method certified", "--method marched", "--tol 1e-9", "--digits 9"] {
        let line = format!("eval rigid-mass --set mu=1 --quantity velocity --at 1e400 {how}");
        let (code, _, err) = run(&folder, &line.split(' ').collect::<Vec<_>>());
        assert!(code == 1 && err.contains("far more"), "{how}: {code} {err}");
    }
}

/// Beside a value that stays undecided the others are told, as text, CSV and JSON; one alone is refused.
#[test]
fn decided_values_are_told_beside_undecided_ones() {
    let line = "eval rigid-mass --set mu=1/4 --quantity f --digits 40 --max-bits 64 --at";
    let told = |rest: &str| run(anywhere(), &words(&format!("{line} {rest}")));
    let (code, out, error) = told("0,1/2");
    assert!(code == 3 && error.contains("1 value stays undecided"), "{error}");
    assert!(
        out.starts_with("f(0) = 1\nf(1/2) = 1.60653065971263342") && out.contains(" ± "),
        "{out}"
    );
    let (_, out, _) = told("0,1/2 --format csv");
    assert!(out.ends_with("0,0,1,true\n1/2,0.5,,undecided\n"), "{out}");
    let (_, out, _) = told("0,1/2 --format json");
    let json: Value = serde_json::from_str(&out).unwrap();
    assert!(json["values"][0]["value"] == "1" && json["values"][1]["value"].is_null(), "{out}");
    let (code, out, error) = told("1/2");
    assert!(code == 3 && out.is_empty() && error.contains("accuracy not reached"), "{error}");
}
