//! Pieces as theorems for Coq, as defined in `checkers/coq/Pieces.v`. Left out where there is no Coq.

use super::certificates::{certified, certify, run_program, run_script};
use super::{ROOT, folder};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Scenes whose pieces hold the root of −1, which has no place among real functions.
const WITH_ROOTS: [&str; 1] = ["pile"];

/// What `coqc` says of a file in a folder that also holds `Pieces.v`.
fn proved(folder: &Path, file: &str) -> Option<(bool, String)> {
    let arguments = ["-Q", ".", "Wavestep", file].map(str::to_owned);
    run_program(folder, "coqc", &arguments)
}

/// The text of the theorems of some certificates.
fn theory(folder: &Path, files: &[String]) -> Option<(bool, String)> {
    run_script(folder, "python3", "theory.py", files)
}

/// A folder with the proof that what Coq computes is right; `None` without Coq.
fn with_proof(name: &str) -> Option<std::path::PathBuf> {
    let folder = folder(name);
    fs::copy(format!("{ROOT}/checkers/coq/Pieces.v"), folder.join("Pieces.v")).unwrap();
    let (proven, told) = proved(&folder, "Pieces.v")?;
    assert!(proven, "{told}");
    Some(folder)
}

/// All shipped scenes, and one long certificate. They rest on nothing but the axioms of Coq's real numbers.
#[test]
fn pieces_of_shipped_scenes_are_theorems() {
    let Some(folder) = with_proof("theories") else { return };
    let mut files = vec!["long.json".to_owned()];
    certify(&folder, "rigid-mass --through 12", &files[0]);
    for scene in certified() {
        let file = format!("{scene}.json");
        certify(&folder, &format!("{scene} --through 4"), &file);
        if WITH_ROOTS.contains(&scene) {
            let (written, told) = theory(&folder, &[file]).unwrap();
            assert!(!written && told.contains("square roots"), "{told}");
        } else {
            files.push(file);
        }
    }
    let (written, text) = theory(&folder, &files).unwrap();
    assert!(written, "{text}");
    fs::write(folder.join("theories.v"), text).unwrap();
    let (proven, told) = proved(&folder, "theories.v").unwrap();
    assert!(proven, "{told}");
    let axioms: Vec<&str> = told
        .lines()
        .filter(|line| !line.starts_with(' ') && *line != "Axioms:")
        .map(|line| line.split([' ', ':']).next().unwrap())
        .collect();
    let of_reals = [
        "ClassicalDedekindReals.sig_not_dec",
        "ClassicalDedekindReals.sig_forall_dec",
        "FunctionalExtensionality.functional_extensionality_dep",
    ];
    assert_eq!(axioms, of_reals, "{told}");
}

/// One number at a time: of a function, an exponent, a start, a law.
#[test]
fn coq_refuses_altered_pieces() {
    let Some(folder) = with_proof("altered-theories") else { return };
    certify(&folder, "rigid-mass --through 3", "rigid.json");
    certify(&folder, "mass-on-fixed-bar --through 3", "mass.json");
    let alterations = [
        ("rigid.json", "/pieces/f/2/1/1/0/0/1/0", "-3"),
        ("rigid.json", "/pieces/f/2/1/0/0/0/1/0", "-2"),
        ("rigid.json", "/pieces/g/1/0/1/0/0/0/0", "1"),
        ("mass.json", "/line/1/velocity/0/0/0/0", "2"),
        ("mass.json", "/line/1/mass/0/0/0/0", "2"),
    ];
    for (i, (file, place, number)) in alterations.into_iter().enumerate() {
        let mut document: Value =
            serde_json::from_slice(&fs::read(folder.join(file)).unwrap()).unwrap();
        let old = document.pointer_mut(place).unwrap_or_else(|| panic!("{file} has no {place}"));
        assert!(old.is_string() && old != number, "{place} is {old}");
        *old = number.into();
        let altered = format!("altered{i}.json");
        fs::write(folder.join(&altered), document.to_string()).unwrap();
        let (written, text) = theory(&folder, &[altered]).unwrap();
        assert!(written, "{text}");
        fs::write(folder.join("altered.v"), text).unwrap();
        let (proven, told) = proved(&folder, "altered.v").unwrap();
        assert!(!proven && told.contains("\"check claim = true\""), "{place}: {told}");
    }
}
