//! Certificates of the shipped scenes are verified by a checker that shares nothing with the program, and altered ones are
//! not. Left out where there is no Python.

use super::{ROOT, folder, run};
use std::path::Path;
use std::process::Command;
use wavestep::scenes::SCENES;

/// Shipped scenes that have no periods, and so no certificates.
const WITHOUT: [&str; 3] = ["incommensurate", "local-contact", "hertz-striker"];

/// Scenes that have certificates of their pieces.
fn certified() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|scene| scene.name).filter(|name| !WITHOUT.contains(name))
}

/// Values of waves and of observables, with delays, forcing, roots and slopes among them.
const VALUES: [&str; 6] = [
    "rigid-mass --set mu=1/4 --quantity velocity --at 33/10 --digits 30",
    "rigid-mass --set mu=1/4 --quantity f --at 33/10",
    "two-bars --set r=1/2 --quantity force --at 5",
    "pulse-shape --set mu=1 --quantity force --at 3",
    "mass-on-fixed-bar --set mu=1 --quantity strain_fixed --at 4 --digits 50",
    "pushed-bar --quantity velocity --at 7/2",
];

/// What a script of `checkers/` says of files in a folder; `None` without Python.
fn checked(folder: &Path, script: &str, arguments: &[String]) -> Option<(bool, String)> {
    let mut command = Command::new("python3");
    command.arg(format!("{ROOT}/checkers/{script}")).args(arguments).current_dir(folder);
    match command.env("PYTHONDONTWRITEBYTECODE", "1").output() {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            eprintln!("python3 is missing: left out");
            None
        }
        output => {
            let output = output.unwrap();
            let told = [output.stdout, output.stderr].concat();
            Some((output.status.success(), String::from_utf8(told).unwrap()))
        }
    }
}

/// Certificates of all scenes and values, by the names of their files.
fn certificates(folder: &Path) -> Vec<String> {
    let pieces = certified().map(|scene| format!("{scene} --through 4"));
    let asked = pieces.chain(VALUES.map(str::to_owned)).enumerate();
    let written = asked.map(|(i, line)| {
        let file = format!("{i}.json");
        let words: Vec<&str> = line.split(' ').chain(["-o", &file]).collect();
        let (code, _, errors) = run(folder, &[&["certify"], &words[..]].concat());
        assert_eq!((code, errors.contains("error")), (0, false), "{line}: {errors}");
        file
    });
    written.collect()
}

#[test]
fn certificates_of_shipped_scenes_are_verified() {
    let folder = folder("certificates");
    let files = certificates(&folder);
    let Some((proven, told)) = checked(&folder, "check.py", &files) else { return };
    assert!(proven && told.matches(": proven (").count() == files.len(), "{told}");
}

/// Every observable of scenes without units, at several times: its value is verified, or there is no certificate and it is
/// said why.
#[test]
fn values_of_all_observables_are_verified_or_refused() {
    let folder = folder("certificates-of-values");
    let mut files = Vec::new();
    for scene in certified() {
        let problem = wavestep::Problem::builtin(scene).unwrap();
        if problem.has_units() {
            continue;
        }
        let symbols: Vec<String> =
            problem.symbols().iter().map(|name| format!("--set {name}=3/2")).collect();
        for quantity in problem.observables() {
            for at in ["1/3", "3", "29/4"] {
                let file = format!("{}.json", files.len());
                let symbols = symbols.join(" ");
                let line =
                    format!("certify {scene} {symbols} --quantity {quantity} --at {at} -o {file}");
                let words: Vec<&str> = line.split_whitespace().collect();
                let (code, _, errors) = run(&folder, &words);
                match code {
                    0 => files.push(file),
                    _ => assert!(errors.contains("no certificates of values"), "{line}: {errors}"),
                }
            }
        }
    }
    assert!(files.len() > 60, "{}", files.len());
    let Some((proven, told)) = checked(&folder, "check.py", &files) else { return };
    assert!(proven, "{told}");
}

#[test]
fn altered_certificates_are_not() {
    let folder = folder("altered-certificates");
    let files = certificates(&folder);
    let arguments = [&["1000".to_owned()], &files[..]].concat();
    let Some((passed, told)) = checked(&folder, "alterations.py", &arguments) else { return };
    assert!(passed && told.contains("1000 alterations") && told.contains(" 0 missed"), "{told}");
}

/// Each part of the checker finds what it is there for.
#[test]
fn wrong_claims_are_told_by_what_is_wrong() {
    let folder = folder("wrong-certificates");
    let ask = |line: &str| {
        let words: Vec<&str> = line.split(' ').collect();
        let (code, out, errors) = run(&folder, &[&["certify"], &words[..]].concat());
        assert_eq!(code, 0, "{errors}");
        serde_json::from_str::<serde_json::Value>(&out).unwrap()
    };
    let pieces = ask("rigid-mass --through 2");
    let value = ask(VALUES[0]);
    type Change = fn(&mut serde_json::Value);
    let cases: [(&serde_json::Value, Change, &str); 7] = [
        (&pieces, |own| own["pieces"]["f"][2][0][1][0][0][0][0] = "7".into(), "period 2"),
        (&pieces, |own| own["continuity"][0]["start"] = serde_json::json!([]), "continuity 0"),
        (&pieces, |own| own["continuity"] = serde_json::json!([]), "leaves values open"),
        (&pieces, |own| own["equations"][0] = own["equations"][1].clone(), "derivatives open"),
        (&pieces, |own| own["pieces"]["g"][1] = serde_json::json!([]), "equation"),
        (&value, |own| own["value"] = "0.3".into(), "another one"),
        (&value, |own| own["at"] = "34/10".into(), "another one"),
    ];
    for (certificate, change, wrong) in cases {
        let mut altered = certificate.clone();
        change(&mut altered);
        std::fs::write(folder.join("altered.json"), altered.to_string()).unwrap();
        let told = checked(&folder, "check.py", &["altered.json".to_owned()]);
        let Some((proven, told)) = told else { return };
        assert!(!proven && told.contains("NOT proven") && told.contains(wrong), "{wrong}: {told}");
    }
}

#[test]
fn what_has_no_certificate_is_told() {
    let folder = folder("no-certificates");
    let rates = "scene \"Three rates\"\nmass hammer { mass = 1, velocity = 1 }\nspring pad { stiffness = 2 }\n\
                 mass anvil { mass = 3 }\nbar rod { impedance = 1, travel = 1 }\n\
                 line free - hammer - pad - anvil - rod - fixed\n";
    std::fs::write(folder.join("rates.wave"), rates).unwrap();
    for (line, message) in [
        ("certify rates.wave", "which has no formula"),
        ("certify incommensurate", "incommensurable"),
        ("certify hertz-striker", "local contact"),
        ("certify mass-on-fixed-bar --set mu=1 --quantity energy --at 1", "not linear"),
        ("certify mass-on-fixed-bar --set mu=1 --quantity momentum --at 1", "integrals of waves"),
        ("certify saint-venant --set mu=1 --quantity velocity --at 5", "where contacts open"),
        ("certify hopkinson --quantity force --at 1ms", "with units"),
        ("certify rigid-mass --quantity f --at 1", "mu"),
        ("certify rigid-mass --at 1", "--quantity"),
    ] {
        let words: Vec<&str> = line.split(' ').collect();
        let (code, out, errors) = run(&folder, &words);
        assert!(code != 0 && out.is_empty() && errors.contains(message), "{line}: {errors}");
    }
}
