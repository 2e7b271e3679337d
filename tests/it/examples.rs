//! What the library exports by name at its root shows how it is used, in an example of its own that
//! `cargo test --doc` runs. The crates beneath it are no surface of their own.
//!
//! The source is read as text.

use std::fs;
use std::path::{Path, PathBuf};

/// The names that `pub use` exports in a text.
fn exported(root: &str) -> Vec<&str> {
    let statements = root.split(';').filter_map(|statement| statement.split_once("\npub use "));
    let paths = statements.flat_map(|(_, paths)| paths.split(['{', '}', ',']));
    let names = paths.filter_map(|path| path.trim().rsplit("::").next());
    names.filter_map(|name| name.split_whitespace().next()).collect()
}

/// Whether a line declares a public item of this name.
fn declares(line: &str, name: &str) -> bool {
    let kinds = ["struct", "enum", "trait", "type", "fn", "const fn", "const"];
    line.strip_prefix("pub ").is_some_and(|line| {
        kinds.iter().filter_map(|kind| line.strip_prefix(kind)?.strip_prefix(' ')).any(|rest| {
            let after = rest.strip_prefix(name);
            after.is_some_and(|after| !after.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
        })
    })
}

/// Whether the comments before declarations of this name have examples in Rust.
fn examples(text: &str, name: &str) -> Vec<bool> {
    let lines: Vec<&str> = text.lines().collect();
    let places = (0..lines.len()).filter(|place| declares(lines[*place], name));
    let has_example = |place: usize| {
        let start = lines[..place].iter().rposition(|line| line.is_empty()).unwrap_or(0);
        // Fences open and close in turn.
        let mut fences = lines[start..place].iter().filter_map(|line| line.strip_prefix("/// ```"));
        fences.by_ref().step_by(2).any(|language| ["", "should_panic"].contains(&language))
    };
    places.map(has_example).collect()
}

/// The names that are declared in these files and exported without an example.
fn offenders<'a>(root: &'a str, files: &[String]) -> Vec<&'a str> {
    let lacks_one = |name: &&str| {
        let found: Vec<bool> = files.iter().flat_map(|text| examples(text, name)).collect();
        !found.is_empty() && !found.contains(&true)
    };
    exported(root).into_iter().filter(lacks_one).collect()
}

/// The texts of the Rust files below a folder.
fn rust_files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable"));
    let paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    let mut texts = Vec::new();
    for path in paths {
        if path.is_dir() {
            texts.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            texts.push(fs::read_to_string(&path).expect("text"));
        }
    }
    texts
}

#[test]
fn exported_names_have_examples() {
    let folder = Path::new(crate::ROOT).join("src");
    let root = fs::read_to_string(folder.join("lib.rs")).expect("text");
    let offenders = offenders(&root, &rust_files(&folder));
    assert!(offenders.is_empty(), "{offenders:?} have no example");
}

/// A surface that a person can keep in mind.
#[test]
fn exported_names_are_few() {
    let root = Path::new(crate::ROOT).join("src/lib.rs");
    let root = fs::read_to_string(root).expect("text");
    let names = exported(&root);
    assert!((25..=45).contains(&names.len()), "{}: {names:?}", names.len());
}

/// The check can fail.
#[test]
fn missing_examples_are_found() {
    let root = "//! A library.\n\npub mod inner;\n\npub use inner::{Bare, Shown, free};\n\
                pub use other::{deep::Formula, self::Alias as Renamed, Elsewhere};\npub(crate) use own::Own;\n";
    let text = "/// ```\n/// Shown::new();\n/// ```\n#[derive(\n    Clone\n)]\npub struct Shown<T>(T);\n\n\
                pub enum Bare {}\n\n/// ```\n/// free();\n/// ```\npub fn free() {}\n\n\
                /// ```text\n/// x = y\n/// ```\npub trait Formula {}\n\n\
                /// ```\n/// let shorter = Ali;\n/// ```\npub type Ali = u8;\n\npub type Alias = u8;\n";
    assert_eq!(offenders(root, &[text.to_owned()]), ["Bare", "Formula", "Alias"]);
}
