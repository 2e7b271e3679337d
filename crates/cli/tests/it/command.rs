//! The built command: what it prints, where, and with which exit code.

use super::{anywhere, command, folder, run, snapshot, words};
use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

use num_rational::BigRational;
use num_traits::ToPrimitive;
use serde_json::Value;
use wavestep::language::{Source, read_listing};
use wavestep_polynomial::Symbol;

const SCENES: [&str; 25] = [
    "two-bars",
    "constant-force",
    "pulse-shape",
    "rigid-mass",
    "striker-on-long-bar",
    "pushed-bar",
    "cushioned-impact",
    "mass-on-fixed-bar",
    "struck-free-bar",
    "stepped-striker",
    "mass-between-bars",
    "hopkinson",
    "pile",
    "percussive-drill",
    "incommensurate",
    "bars-that-part",
    "bars-of-equal-length",
    "bars-of-unequal-length",
    "saint-venant",
    "mass-on-free-bar",
    "cushion-with-release",
    "hopkinson-with-release",
    "mass-that-bounces",
    "local-contact",
    "hertz-striker",
];

/// The standard output of a command that does its work, and is quiet about it.
fn output_in(folder: &Path, line: &str) -> String {
    let (code, stdout, stderr) = run(folder, &words(line));
    assert_eq!((code, stderr.as_str()), (0, ""), "{line}");
    stdout
}

fn output(line: &str) -> String {
    output_in(anywhere(), line)
}

/// Compares the output of a command with what is recorded.
fn recorded(name: &str, line: &str) {
    snapshot("command", name, line, &output(line));
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

// ---- What is printed --------------------------------------------------------------------------

#[test]
fn help_is_as_recorded() {
    recorded("help", "--help");
    for subcommand in [
        "derive",
        "eval",
        "find",
        "events",
        "report",
        "advise",
        "sweep",
        "export",
        "chart",
        "dispersion",
        "check",
        "scenes",
    ] {
        let help = output(&format!("{subcommand} --help"));
        assert_eq!(help, output(&format!("help {subcommand}")));
        snapshot("command", &format!("help-{subcommand}"), &format!("{subcommand} --help"), &help);
    }
    assert!(output("--version").starts_with("wavestep "));
}

#[test]
fn scenes_are_listed_and_correct() {
    let list = output("scenes");
    assert_eq!(list.lines().map(|line| words(line)[0]).collect::<Vec<_>>(), SCENES);
    snapshot("command", "scenes", "scenes", &list);
    // In `incommensurate` nothing has a common measure, and the last two are not linear.
    let linear = &SCENES[..SCENES.len() - 2];
    for scene in linear.iter().filter(|scene| **scene != "incommensurate") {
        let line = format!("check {scene} --verbose");
        let report = output(&line);
        let derived = ["derived in two ways, equal in periods 0 to", "derived echo by echo"];
        assert!(derived.iter().any(|told| report.contains(told)), "{report}");
        snapshot("command", &format!("check-{scene}"), &line, &report);
    }
}

#[test]
fn derivations_are_as_recorded() {
    for (name, line) in [
        ("derive-rigid-mass", "derive rigid-mass"),
        ("derive-rigid-mass-echo", "derive rigid-mass --form echo --through 5"),
        ("derive-rigid-mass-latex", "derive rigid-mass --quantity f --format latex"),
        (
            "derive-rigid-mass-piecewise",
            "derive rigid-mass --quantity f --form piecewise --through 2",
        ),
        ("derive-rigid-mass-json", "derive rigid-mass --quantity f --piece 1 --format json"),
        ("derive-rigid-mass-value", "derive rigid-mass --set mu=1/4 --quantity f"),
        ("derive-rigid-mass-general", "derive rigid-mass --general"),
        ("derive-rigid-mass-observable", "derive rigid-mass --quantity strain_fixed"),
        ("derive-pulse-shape", "derive pulse-shape --through 4"),
        ("derive-two-bars-general", "derive two-bars --general"),
        ("derive-two-bars-general-latex", "derive two-bars --general --format latex"),
        ("derive-constant-force-general", "derive constant-force --general"),
    ] {
        recorded(name, line);
    }
}

#[test]
fn values_are_as_recorded() {
    for (name, line) in [
        ("eval-text", "eval rigid-mass --set mu=1/4 --quantity f --at 33/10 --digits 30"),
        ("eval-exact", "eval two-bars --set r=1/3 --quantity force --at 0 --at 2 --at 7.5 --at 9"),
        ("eval-left", "eval rigid-mass --set mu=1 --quantity g --at 2 --side left"),
        (
            "eval-csv",
            "eval rigid-mass --set mu=1 --quantity strain_fixed --from 0 --to 6 --points 13 \
             --format csv",
        ),
        (
            "eval-json",
            "eval rigid-mass --set mu=1 --quantity f --piece 2 --local 1/2 --format json",
        ),
    ] {
        recorded(name, line);
    }
}

// ---- What is printed can be read by others ------------------------------------------------------

#[test]
fn a_long_piece_has_every_term() {
    let text = output("derive rigid-mass --quantity f --piece 80 --format json");
    let document = json(&text);
    let function = &document["waves"][0]["functions"][0];
    assert_eq!(function["n"], 80);
    assert_eq!(terms(function), 88_641);
}

/// The terms of a function: a term is where a coefficient is.
fn terms(value: &Value) -> usize {
    match value {
        Value::Array(values) => values.iter().map(terms).sum(),
        Value::Object(members) => {
            let own = usize::from(members.contains_key("coefficient"));
            own + members.values().map(terms).sum::<usize>()
        }
        _ => 0,
    }
}

#[test]
fn values_in_json_are_enclosed() {
    use wavestep::language::parse_number;
    let line = "eval rigid-mass --set mu=1/4 --quantity f --from 0 --to 3 --points 7 --digits 25 \
                --format json";
    let document = json(&output(line));
    let values = document["values"].as_array().unwrap();
    assert_eq!(values.len(), 7);
    let number = |value: &Value| parse_number(value.as_str().unwrap()).unwrap();
    for row in values {
        let value = number(&row["value"]);
        let Some(midpoint) = row.get("midpoint") else {
            assert_eq!(value, number(&row["exact"]));
            continue;
        };
        let (midpoint, radius) = (number(midpoint), number(&row["radius"]));
        // The enclosure proves the digits: it is far narrower than a unit of the last.
        assert!(radius < parse_number("1e-25").unwrap(), "{row}");
        let distance = if value > midpoint { value - midpoint } else { midpoint - value };
        assert!(distance < parse_number("1e-24").unwrap(), "{row}");
    }
}

#[test]
fn values_in_csv_have_four_columns() {
    let line = "eval two-bars --set r=1/3 --quantity g --from 0 --to 20 --points 41 --format csv";
    let text = output(line);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("time,time_decimal,value,exact"));
    assert_eq!(lines.clone().count(), 41);
    for line in lines {
        let columns: Vec<&str> = line.split(',').collect();
        assert_eq!(columns.len(), 4, "{line}");
        assert!(columns[1].parse::<f64>().is_ok() && columns[2].parse::<f64>().is_ok(), "{line}");
        assert!(["true", "false"].contains(&columns[3]));
    }
}

/// With units there is a column for them, and times that do not end are rounded in decimals, in text as well.
#[test]
fn values_in_csv_have_their_units() {
    let line = "eval hopkinson --quantity force,gauge_output --from 0us --to 500us --points 4";
    for method in ["", " --method certified"] {
        let text = output(&format!("{line} --format csv{method}"));
        let rows: Vec<Vec<&str>> = text.lines().map(|row| row.split(',').collect()).collect();
        assert_eq!(rows[0].last(), Some(&"unit"));
        assert_eq!(rows[2][..3], ["force", "1/6000", "0.00016666666666666667"]);
        assert_eq!(rows[2].last(), Some(&"N"));
        assert_eq!(rows[6].last(), Some(&""), "a strain has no unit");
    }
    let told = output(line);
    let starts = ["force(0 s) = ", "force(0.00016666666666666667 s) = "];
    assert!(told.lines().zip(starts).all(|(row, start)| row.starts_with(start)), "{told}");
}

/// A scene like none of those that are shipped: Windows line ends, Greek, names used elsewhere.
const STRANGE: &str = "\u{FEFF}recurrence \"Größe \\\\ & % $ _ {x} <b>\"\r\n\
    symbol μ > 0, r_1 >= 1/2\r\n\
    period μ, local σ, time τ\r\n\
    wave φ, Ψ_2\r\n\
    equation φ[n] = −Ψ_2[n−1]/r_1\r\n\
    equation Ψ_2[n]′ + 2·Ψ_2[n] = φ[n] + exp(−τ)\r\n\
    continuous Ψ_2[n] starts at 1\r\n\
    observe Σ = φ(τ − μ/2)\r\n";

#[test]
fn a_scene_of_ones_own_works_everywhere() {
    let folder = folder("command-own");
    fs::write(folder.join("strange.wave"), STRANGE).unwrap();
    let recorded =
        |name: &str, line: &str| snapshot("command", name, line, &output_in(&folder, line));
    recorded("own-check", "check strange.wave --verbose");
    recorded("own-derive", "derive strange.wave --through 1");
    for form in ["period", "echo", "piecewise"] {
        let line = format!("derive strange.wave --through 1 --form {form} --format");
        recorded(&format!("own-{form}-latex"), &format!("{line} latex"));
        let document = json(&output_in(&folder, &format!("{line} json")));
        assert_eq!(document["title"], "Größe \\\\ & % $ _ {x} <b>");
        assert_eq!(document["waves"].as_array().unwrap().len(), 2);
    }
    let values = "--set μ=1 --set r_1=3/4";
    let line = format!("eval strange.wave {values} --quantity Σ --at 15/4");
    let text = output_in(&folder, &line);
    let again =
        output_in(&folder, &format!("eval strange.wave {values} --quantity Sigma --at 15/4"));
    assert_eq!(text.split('=').next_back(), again.split('=').next_back());
    snapshot("command", "own-eval", &line, &text);
    let general = "recurrence \"One pole\"\nperiod 1, local s, time t\nwave u\n\
                   equation u[n]' + 3*u[n] = 2*u[n-1]\ncontinuous u[n] starts at 1\n";
    fs::write(folder.join("general.wave"), general).unwrap();
    recorded("own-general", "derive general.wave --general");
    json(&output_in(&folder, "derive general.wave --general --format json"));
    output_in(&folder, "derive general.wave --general --format latex");
}

// ---- What goes wrong --------------------------------------------------------------------------

/// Refused: the exit code, one error on standard error, nothing on standard output.
fn assert_fails(folder: &Path, name: &str, arguments: &[&str], code: i32) {
    let (found, stdout, stderr) = run(folder, arguments);
    assert_eq!(found, code, "{name}: {stderr}");
    assert!(stdout.is_empty(), "{name} prints to standard output");
    assert!(!stderr.contains("panicked"), "{name}: {stderr}");
    assert_eq!(stderr.matches("error:").count(), 1, "{name}: {stderr}");
    assert!(stderr.len() < 2000, "{name}: {stderr}");
    assert!(stderr.contains("help") || stderr.contains("tip"), "{name} has no remedy: {stderr}");
    snapshot("command", &format!("error-{name}"), &arguments.join(" "), &stderr);
}

#[test]
fn bad_scenes_are_explained() {
    let folder = folder("command-scenes");
    let write = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).unwrap();
    let head = "recurrence \"A\"\nperiod 1, local s, time t\nwave f\nequation f[n] = ";
    write("bad.wave", format!("{head}f[n-1] +\n").as_bytes());
    write("name.wave", format!("{head}nu*f[n-1]\n").as_bytes());
    write("parentheses.wave", format!("{head}{}", "(".repeat(100_000)).as_bytes());
    write("binary.wave", &(0..=255).cycle().take(5000).collect::<Vec<u8>>());
    write("empty.wave", b"");
    write("long.wave", &vec![b' '; 3 << 20]);
    fs::create_dir(folder.join("folder")).unwrap();
    for scene in ["bad", "name", "parentheses", "binary", "empty", "long", "missing"] {
        let file = format!("{scene}.wave");
        assert_fails(&folder, &format!("scene-{scene}"), &["derive", &file], 2);
    }
    assert_fails(&folder, "scene-folder", &["check", "folder"], 2);
    assert_fails(&folder, "scene-misspelt", &["check", "rigid-mas"], 2);
}

#[test]
fn bad_arguments_are_explained() {
    let folder = folder("command-arguments");
    let eval = "eval rigid-mass --set mu=1 --quantity f";
    let at = "eval rigid-mass --quantity f --at 1";
    for (name, line) in [
        ("subcommand", "devire rigid-mass".to_owned()),
        ("no-scene", "derive".to_owned()),
        ("set-unknown", "derive rigid-mass --set nu=1".to_owned()),
        ("set-misspelt", "derive rigid-mass --set m=1".to_owned()),
        ("set-negative", "derive rigid-mass --set mu=-1".to_owned()),
        ("set-zero", format!("{at} --set mu=0")),
        ("set-nan", format!("{at} --set mu=nan")),
        ("set-nothing", format!("{at} --set mu")),
        ("set-empty", format!("{at} --set mu=")),
        ("set-nameless", format!("{at} --set =1")),
        ("set-double", format!("{at} --set mu=1=2")),
        ("set-twice", format!("{at} --set mu=1 --set μ=1")),
        ("symbol-without-value", at.to_owned()),
        ("quantity-missing", "export rigid-mass --as c --set mu=1 --to 1".to_owned()),
        ("quantity-unknown", "eval rigid-mass --set mu=1 --quantity h --at 1".to_owned()),
        ("quantity-misspelt", "eval rigid-mass --set mu=1 --quantity velocty --at 1".to_owned()),
        ("derive-unknown", "derive rigid-mass --quantity strain".to_owned()),
        ("time-missing", eval.to_owned()),
        ("at-nan", format!("{eval} --at nan")),
        ("at-name", format!("{eval} --at mu")),
        ("at-negative", format!("{eval} --at -3")),
        ("at-out-of-range", format!("{eval} --at 1e1001")),
        ("at-exponential", format!("{eval} --at exp(1)")),
        ("digits-zero", format!("{eval} --at 1 --digits 0")),
        ("digits-many", format!("{eval} --at 1 --digits 999999999")),
        ("digits-negative", format!("{eval} --at 1 --digits=-1")),
        ("points-zero", format!("{eval} --from 0 --to 1 --points 0")),
        ("points-many", format!("{eval} --from 0 --to 1 --points 1000000000")),
        ("points-power", format!("{eval} --from 0 --to 1 --points 10^9")),
        ("window-empty", format!("{eval} --from 2 --to 1 --points 3")),
        ("window-before-start", format!("{eval} --from -1 --to 1 --points 3")),
        ("window-half", format!("{eval} --from 2")),
        ("local-outside", format!("{eval} --piece 1 --local 2")),
        ("local-negative", format!("{eval} --piece 1 --local -1/2")),
        ("local-missing", format!("{eval} --piece 1")),
        ("through-many", "derive rigid-mass --through 1000000000".to_owned()),
        ("piece-many", "derive rigid-mass --piece 1000000000".to_owned()),
        ("echo-many", "derive rigid-mass --form echo --through 1000000000".to_owned()),
        ("piece-most", "derive two-bars --piece 18446744073709551615".to_owned()),
        ("piece-and-general", "derive rigid-mass --general --piece 3".to_owned()),
        ("form-unknown", "derive rigid-mass --form foo".to_owned()),
        ("time-without-unit", "derive rigid-mass --time-limit 5".to_owned()),
        ("memory-without-unit", "derive rigid-mass --memory 500".to_owned()),
    ] {
        assert_fails(&folder, name, &words(&line), 2);
    }
    assert_fails(&folder, "at-empty", &[&words(eval)[..], &["--at", ""]].concat(), 2);
}

#[test]
fn what_cannot_be_computed_is_explained() {
    let folder = folder("command-computation");
    let poles = "recurrence \"Two poles\"\nsymbol a > 0\nperiod 1, local s, time t\nwave f, g\n\
                 equation f[n]' + a*f[n] = g[n-1]\nequation g[n]' + 2*a*g[n] = f[n]\n\
                 continuous f[n] starts at 1\ncontinuous g[n] starts at 0\n";
    fs::write(folder.join("poles.wave"), poles).unwrap();
    // For a = 1 the pole and the forcing meet, and the answer is another.
    let resonance = "recurrence \"Resonance\"\nsymbol a > 0\nperiod 1, local s, time t\nwave f\n\
                     equation f[n]' + a*f[n] = exp(-t)\ncontinuous f[n] starts at 1\n";
    fs::write(folder.join("resonance.wave"), resonance).unwrap();
    output_in(&folder, "derive resonance.wave --set a=1");
    // What fails within one period leaves nothing of it behind.
    let thin = "scene \"Thin\"\nbar striker { impedance = 1, travel = 1/8, velocity = 1 }\n\
                spring cushion { stiffness = 1/2 }\nbar long { impedance = 1e-300 }\n\
                line free - striker | cushion - long - endless\nobserve energy = energy(line)\n";
    fs::write(folder.join("thin.wave"), thin).unwrap();
    let rings = "scene \"A mass that rings\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
                 spring s { stiffness = 3 }\nmass m { mass = 1e-18 }\nspring d { stiffness = 1e6 }\n\
                 bar b { impedance = 2, travel = pi }\nline free - a | s - m - d - b - free\n\
                 contacts open\nobserve v = velocity(m)\n";
    fs::write(folder.join("rings.wave"), rings).unwrap();
    let joint = "scene \"Pushed spring\"\nload push { force = sin(t) }\nspring cushion { stiffness = 2 }\n\
                 bar pile { impedance = 1, travel = 1 }\nline free - push - cushion - pile - fixed\n\
                 observe force = force(pile.left)\n";
    fs::write(folder.join("joint.wave"), joint).unwrap();
    let eval = "eval rigid-mass --set mu=1 --quantity f";
    for (name, code, line) in [
        ("joint-without-mass", 1, "derive joint.wave".into()),
        ("model-of-equations", 2, "derive rigid-mass --model third".into()),
        ("wavenumber-irrational", 2, "dispersion beam --wavenumber pi/2".into()),
        ("time-late", 1, format!("{eval} --at 100000")),
        ("time-far-off", 1, format!("{eval} --at 1e999")),
        ("piece-late", 1, format!("{eval} --piece 1000000000 --local 0")),
        ("exponential-large", 1, "eval rigid-mass --set mu=1e300 --quantity f --at 1e299".into()),
        ("rate-huge", 1, "eval thin.wave --quantity energy --at 7/3 --tol 1e-6".into()),
        ("general-unknown", 1, "derive poles.wave --general".into()),
        ("division", 1, "derive resonance.wave".into()),
        ("bits-few", 3, format!("{eval} --at 33/10 --max-bits 16")),
        ("bits-none", 3, format!("{eval} --at 33/10 --max-bits 0")),
        (
            "memory-of-echoes",
            1,
            "eval hopkinson --quantity force --from 0s --to 50ms --points 2 --memory 10MB".into(),
        ),
        (
            "memory-of-cells",
            1,
            "find mass-that-bounces --zero velocity --to 60 --memory 1MB".into(),
        ),
        ("cells-short", 1, "eval rings.wave --quantity v --at 3".into()),
        ("cells-many", 1, "eval hopkinson-with-release --quantity force --at 1000s".into()),
    ] {
        assert_fails(&folder, name, &words(&line), code);
    }
}

/// A search that memory does not suffice for says so: neither an enclosure that tells nothing, nor sums without end.
#[test]
fn searches_name_the_memory_that_they_lack() {
    let folder = folder("memory-of-searches");
    let text = "scene \"A light sensor\"\nmass block { mass = 20, velocity = 1 }\n\
        spring pad { stiffness = 1, damping = 1/10 }\nmass sensor { mass = 1/100 }\n\
        bar rod { impedance = 1, travel = 1 }\nline free - block - pad - sensor - rod - fixed\n\
        observe s = strain(rod.right)\n";
    std::fs::write(folder.join("light.wave"), text).unwrap();
    let (code, stdout, told) =
        run(&folder, &words("find light.wave --max s --to 150 --memory 5MB"));
    assert_eq!((code, stdout.as_str()), (1, ""));
    assert!(told.contains("would take more than 5 MB of memory"), "{told}");
    assert!(told.contains("raise --memory"), "{told}");
}

/// What has passed is forgotten where one late value is asked for; a window from the start on takes more, as the snapshot
/// `memory-of-echoes` tells.
#[test]
fn late_values_take_little_memory() {
    let line = "eval hopkinson --quantity force --at 50ms --digits 9 --memory 3MB";
    let (code, stdout, _) = run(anywhere(), &words(line));
    assert_eq!((code, stdout.as_str()), (0, "force(0.05 s) = 737.539602 N\n"));
}

/// What no estimate foresees is ended by a watch: nothing is written, and the error tells how far it came.
#[test]
fn work_is_held_to_its_time_and_memory() {
    let folder = folder("command-watch");
    for (line, message, option) in [
        (
            "plot mass-that-bounces --quantity velocity --to 4000 -o late.svg --time-limit 0.3s",
            "error: no answer within 0.3 s (",
            "--time-limit",
        ),
        (
            "derive rigid-mass --piece 120 --memory 1MB --time-limit 1min",
            "error: the answer takes more than 1 MB of memory",
            "--memory",
        ),
    ] {
        let (code, stdout, stderr) = run(&folder, &words(line));
        assert_eq!((code, stdout.as_str()), (1, ""), "{line}");
        assert!(stderr.starts_with(message), "{line}: {stderr}");
        assert!(stderr.trim_end().ends_with(&format!("or allow more with {option}")), "{stderr}");
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0, "nothing is written");
}

#[test]
fn no_arguments_show_the_help() {
    assert_eq!(run(anywhere(), &[]), (2, String::new(), output("--help")));
}

#[test]
fn a_reader_that_goes_away_ends_the_command_quietly() {
    let folder = folder("command-pipe");
    for line in [
        "derive rigid-mass --quantity f --piece 30 --format json",
        "eval constant-force --quantity f --from 0 --to 10 --points 20000",
    ] {
        let mut child = command(&folder, &words(line))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let Output { status, stderr, .. } = child.wait_with_output().unwrap();
        assert_eq!(status.code(), Some(0), "{line}");
        assert_eq!(String::from_utf8(stderr).unwrap(), "", "{line}");
    }
}

/// A piece that `derive` prints and a piece that `eval` addresses are the same function, also where
/// the observable's periods begin at an offset.
#[test]
fn pieces_of_derive_and_eval_are_the_same() {
    let by_piece =
        output("eval rigid-mass --set mu=1/4 --quantity strain_fixed --piece 2 --local 1/8");
    let by_time = output("eval rigid-mass --set mu=1/4 --quantity strain_fixed --at 11/8");
    assert_eq!(by_piece, by_time);
    let derived = output("derive rigid-mass --set mu=1/4 --quantity strain_fixed --piece 2");
    assert!(derived.contains("5/4 <= t < 7/4"), "{derived}");
    let formulas = read_listing(&Source::new("derived", &derived).unwrap()).unwrap();
    let local = BigRational::new(1.into(), 8.into());
    let at = |symbol: &Symbol| (*symbol == formulas[0].variable).then(|| local.clone());
    let value: f64 = formulas[0].expression.evaluate(&at).unwrap().iter().map(term).sum();
    let printed: f64 = by_time.trim().rsplit(' ').next().unwrap().parse().unwrap();
    assert!((value - printed).abs() < 1e-12, "{value} {printed}");
}

/// `r e^λ` in doubles.
fn term((exponent, value): (&BigRational, &BigRational)) -> f64 {
    value.to_f64().unwrap() * exponent.to_f64().unwrap().exp()
}

#[test]
fn completions_and_the_manual_name_every_subcommand() {
    const SUBCOMMANDS: [&str; 10] = [
        "derive", "eval", "find", "export", "chart", "book", "check", "lock", "scenes", "generate",
    ];
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = output(&format!("generate {shell}"));
        for name in SUBCOMMANDS {
            assert!(script.contains(name), "{shell}: {name}");
        }
        assert!(script.contains("source-form") && script.contains("locked"), "{shell}");
    }
    let manual = output("generate manual");
    for name in SUBCOMMANDS {
        let heading = format!(".SH \"WAVESTEP {}\"", name.to_uppercase());
        assert_eq!(manual.matches(&heading).count(), 1, "{name}");
        assert!(manual.contains(&format!("wavestep {name}")), "{name}");
    }
    assert!(!manual.contains("(1)"), "no page but this one is named");
    assert_eq!(manual.matches(".nf").count(), manual.matches(".fi").count());
    assert!(manual.contains("\\-\\-quantity f \\-\\-at 33/10"), "{manual}");
    assert!(output("--version").starts_with("wavestep "));
}

#[test]
fn the_form_of_a_source_that_says_nothing_is_refused() {
    let folder = folder("command-source-form");
    let text =
        "recurrence \"plain\"\nperiod 1, local s, time t\nwave f\nequation f[n] = f[n-1] + 1\n";
    fs::write(folder.join("plain.wave"), text).unwrap();
    for (line, expected) in [
        ("derive plain.wave --source-form", "has no `written` statement"),
        ("derive rigid-mass --source-form --format json", "for reading, not for programs"),
        (
            "derive pulse-shape --source-form --general --format json",
            "for reading, not for programs",
        ),
    ] {
        let (code, stdout, stderr) = run(&folder, &words(line));
        assert_eq!((code, stdout.as_str()), (2, ""), "{line}: {stderr}");
        assert!(stderr.contains(expected), "{line}: {stderr}");
    }
    for (line, expected) in [
        ("derive mass-on-fixed-bar --general --quantity momentum", "arrive at different times"),
        ("derive mass-on-fixed-bar --general --quantity energy", "quadratic in the waves"),
        ("derive mass-that-bounces --general --quantity displacement", "no closed form in n"),
    ] {
        let (code, stdout, stderr) = run(&folder, &words(line));
        assert_eq!((code, stdout.as_str()), (1, ""), "{line}: {stderr}");
        assert!(stderr.contains(expected), "{line}: {stderr}");
    }
}

#[test]
fn from_alone_gives_four_periods() {
    let formulas = output("derive rigid-mass --quantity f --from 4");
    let heads: Vec<&str> =
        formulas.lines().filter(|line| line.starts_with('f')).map(|line| &line[..4]).collect();
    assert_eq!(heads, ["f[4]", "f[5]", "f[6]", "f[7]"]);
}

#[test]
fn negative_numbers_are_values_of_options() {
    for (arguments, reason) in [
        (["eval", "rigid-mass", "--quantity", "f", "--at", "1", "--tol", "-1"], "-1"),
        (["eval", "rigid-mass", "--quantity", "f", "--local", "0", "--piece", "-1"], "--piece"),
    ] {
        let (code, out, errors) = run(anywhere(), &arguments);
        assert!(code != 0 && out.is_empty(), "{arguments:?}");
        assert!(errors.contains(reason) && !errors.contains("unexpected argument"), "{errors}");
    }
}
