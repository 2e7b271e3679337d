//! `wavestep chart`: its files, and what stands in them.

use super::{anywhere, run, words};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A folder that is not there yet.
fn folder(name: &str) -> PathBuf {
    let folder = anywhere().join(name);
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

fn json(folder: &Path, name: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(folder.join(name)).unwrap()).unwrap()
}

/// All proven bounds hold, the reference is far finer than every error, and the page holds every chart.
#[test]
fn charts_of_a_scene() {
    let folder = folder("charts-of-a-scene");
    let (code, told, errors) = run(
        anywhere(),
        &[
            "chart",
            "mass-on-fixed-bar",
            "--set",
            "mu=1",
            "--quantity",
            "strain_impact",
            "--to",
            "12",
            "--points",
            "60",
            "--quick",
            "-o",
            folder.to_str().unwrap(),
        ],
    );
    assert_eq!(code, 0, "{errors}");
    let work = json(&folder, "work-precision.json");
    let mut proven = 0;
    for method in work["methods"].as_array().unwrap() {
        for point in method["points"].as_array().unwrap() {
            let error = point["error"].as_f64().unwrap();
            if let Some(bound) = point["bound"].as_f64() {
                assert!(error <= bound, "{}: {error:e} > {bound:e}", method["name"]);
                proven += 1;
            }
        }
    }
    assert!(proven >= 10, "{proven} proven bounds");
    let caption = work["caption"].to_string();
    for part in ["Norm", "mu=1", "strain_impact", "wavestep chart", "seed"] {
        assert!(caption.to_lowercase().contains(&part.to_lowercase()), "{part} in {caption}");
    }
    // Preparation is shown, and settings of different methods have different labels.
    let methods = work["methods"].as_array().unwrap();
    let points = || methods.iter().flat_map(|method| method["points"].as_array().unwrap());
    let with = |point: &Value| point["seconds_with_preparation"].as_f64().unwrap();
    assert!(points().all(|point| with(point) >= point["seconds"].as_f64().unwrap()));
    assert!(caption.contains("once all is prepared") && caption.contains("over 60 points"));
    let settings: Vec<&str> = points().filter_map(|point| point["setting"].as_str()).collect();
    let labels: Vec<&&str> = settings.iter().filter(|setting| !setting.is_empty()).collect();
    let different: std::collections::BTreeSet<_> = labels.iter().collect();
    assert_eq!(different.len(), labels.len(), "{labels:?}");
    // Captions say what the curves are.
    let norm = |name: &str| json(&folder, name)["caption"]["norm"].as_str().unwrap().to_owned();
    assert!(norm("finite-differences.json").contains("its mean over the times, and the largest"));
    assert!(norm("modes-near-a-jump.json").contains("each time alone"));
    // Every distance from a zero is looked at, and derivation is measured with symbols and without.
    let zeros = json(&folder, "error-near-zeros.json");
    let curves = zeros["curves"].as_array().unwrap();
    assert!(curves.iter().all(|curve| curve["points"].as_array().unwrap().len() == 12));
    let preparation = json(&folder, "preparation-by-order.json");
    let derived = |what: &str| {
        let name = format!("derivation of 0 to n, {what}");
        preparation["curves"].as_array().unwrap().iter().any(|curve| curve["name"] == name)
    };
    assert!(derived("symbols kept") && derived("numbers set"));
    // Maps reach from tiny to huge values.
    let map = json(&folder, "map-marched-unproven.json");
    assert_eq!(map["y"]["places"].to_string(), "[0.0001,1.0,10000.0]");
    let page = std::fs::read_to_string(folder.join("index.html")).unwrap();
    let mut pictures = 0;
    for file in told.lines() {
        assert!(Path::new(file).exists(), "{file}");
        pictures += usize::from(file.ends_with(".svg"));
    }
    assert!(pictures >= 16, "{told}");
    assert_eq!(page.matches("<svg").count(), pictures);
}

/// A recurrence has no models, and the page says why they are missing.
#[test]
fn charts_of_a_recurrence() {
    let folder = folder("charts-of-a-recurrence");
    let (code, _, errors) = run(
        anywhere(),
        &[
            "chart",
            "two-bars",
            "--set",
            "r=1/2",
            "--to",
            "8",
            "--points",
            "20",
            "--quick",
            "-o",
            folder.to_str().unwrap(),
        ],
    );
    assert_eq!(code, 0, "{errors}");
    let work = json(&folder, "work-precision.json").to_string();
    assert!(
        work.contains("rigid is a model for scenes of bars, and this is a recurrence"),
        "{work}"
    );
}

#[test]
fn bad_requests_are_refused() {
    let folder = folder("charts-refused");
    let to = folder.to_str().unwrap();
    let cases: [(&[&str], &str); 4] = [
        (&["chart", "rigid-mass", "-o", to], "the symbol mu has no value"),
        (
            &["chart", "rigid-mass", "--set", "mu=1", "--from", "3", "--to", "2", "-o", to],
            "is empty",
        ),
        (&["chart", "rigid-mass", "--set", "mu=1", "--points", "0", "-o", to], "0 times"),
        (
            &["chart", "rigid-mass", "--set", "mu=1", "--quantity", "force", "-o", to],
            "neither a wave",
        ),
    ];
    for (arguments, part) in cases {
        let (code, _, errors) = run(anywhere(), arguments);
        assert!(code != 0 && errors.contains(part), "{arguments:?}: {errors}");
        assert!(errors.contains("help: "), "{errors}");
        assert!(!folder.exists(), "no partial files");
    }
    let (code, _, errors) =
        run(anywhere(), &["chart", "two-bars", "--set", "r=1", "--quick", "-o", "/dev/null/no"]);
    assert!(code != 0 && errors.contains("cannot be created"));
}

/// Costs are measured, shown beside those in use, and written so that `eval` reads them.
#[test]
fn costs_are_measured_and_used() {
    let folder = super::folder("chart-costs");
    let (code, told, errors) = run(&folder, &words("chart --costs --quick -o own.txt"));
    assert_eq!(code, 0, "{errors}");
    let names: Vec<&str> = told.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let file = std::fs::read_to_string(folder.join("own.txt")).unwrap();
    let written = file.lines().skip(2).filter_map(|line| line.split_whitespace().next());
    let rows = &names[1..names.len() - 1];
    assert_eq!(rows, written.collect::<Vec<_>>(), "{told}");
    for line in told.lines().skip(1).take(rows.len()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [measured, used, ratio] = [1, 2, 3].map(|i| words[i].parse::<f64>().unwrap());
        assert!(
            measured > 0.0 && (measured / used / ratio - 1.0).abs() < 0.1 + 0.005 / ratio,
            "{line}"
        );
    }
    let eval = "eval rigid-mass --set mu=1 --quantity f --at 5 --tol 1e-6 --explain";
    assert!(run(&folder, &words(eval)).2.contains("by the built-in table"));
    let (code, _, errors) = run(&folder, &words(&format!("{eval} --costs own.txt")));
    assert!(code == 0 && errors.contains("by own.txt"), "{errors}");
    std::fs::write(folder.join("bad.txt"), file.replace("ball ", "bell ")).unwrap();
    for (name, message) in [
        (
            "bad.txt",
            "error: the costs in `bad.txt` cannot be read, line 4: `bell` is not an operation",
        ),
        ("none.txt", "error: the costs in `none.txt` cannot be read: "),
    ] {
        let (code, out, errors) = run(&folder, &words(&format!("{eval} --costs {name}")));
        assert_eq!((code, out.as_str()), (2, ""), "{errors}");
        assert!(errors.starts_with(message), "{errors}");
        assert!(
            errors.contains("\nhelp: measure them with `wavestep chart --costs -o FILE`"),
            "{errors}"
        );
    }
    for line in ["chart", "chart --costs rigid-mass", "chart rigid-mass", "chart --costs --to 4"] {
        assert_eq!(run(&folder, &words(line)).0, 2, "{line}");
    }
}
