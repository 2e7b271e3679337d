//! What Cargo cannot say of the layers: inside the library a lower one never imports a higher one.
//!
//! The source is read as text: every path that begins with `crate::` leads to a
//! layer, and libraries and macros that belong to one layer are looked for in all others.

use std::fs;
use std::path::{Path, PathBuf};

/// The layer of constants that every other one may use.
const FOR_ALL: &str = "limits";

/// Every layer with the layers it may use, besides [`FOR_ALL`].
const LAYERS: [(&str, &[&str]); 21] = [
    (FOR_ALL, &[]),
    ("ball", &[]),
    ("expression", &[]),
    ("enclosure", &["ball", "expression"]),
    ("scene", &["expression"]),
    ("recurrence", &["enclosure", "expression"]),
    ("network", &["ball", "enclosure", "expression", "recurrence", "scene"]),
    ("model", &["ball", "enclosure", "expression", "network", "recurrence", "scene"]),
    ("solution", &["expression", "recurrence"]),
    ("signal", &["ball", "enclosure", "expression", "network", "recurrence", "scene", "solution"]),
    (
        "history",
        &["ball", "enclosure", "expression", "model", "network", "scene", "signal", "solution"],
    ),
    ("planner", &["ball", "enclosure", "expression", "history", "network", "recurrence", "signal"]),
    ("field", &["ball", "enclosure", "expression", "network", "planner", "scene", "signal"]),
    ("answer", &["ball", "model", "network", "planner", "scene", "signal"]),
    ("export", &["expression", "network", "recurrence", "scene", "signal", "solution"]),
    ("language", &["expression", "recurrence", "scene"]),
    (
        "lock",
        &[
            "ball",
            "enclosure",
            "export",
            "expression",
            "history",
            "language",
            "network",
            "planner",
            "recurrence",
            "scene",
            "signal",
            "solution",
        ],
    ),
    ("scenes", &[]),
    (
        "problem",
        &[
            "answer",
            "ball",
            "enclosure",
            "export",
            "expression",
            "field",
            "history",
            "language",
            "lock",
            "model",
            "network",
            "planner",
            "recurrence",
            "scene",
            "scenes",
            "signal",
            "solution",
        ],
    ),
    (
        "error",
        &[
            "answer",
            "ball",
            "expression",
            "field",
            "history",
            "language",
            "lock",
            "model",
            "network",
            "problem",
            "scenes",
            "signal",
            "solution",
        ],
    ),
    (
        "facade",
        &[
            "answer",
            "ball",
            "error",
            "export",
            "expression",
            "field",
            "history",
            "language",
            "planner",
            "problem",
            "scenes",
            "signal",
        ],
    ),
];

/// What may stand in one layer only, or in none.
const CONFINED: [(&str, &str); 6] = [
    ("nom::", "language"),
    ("wavestep_kernels", "signal"),
    ("bits *=", "ball"),
    ("println!", "no layer"),
    ("eprintln!", "no layer"),
    ("std::process", "no layer"),
];

const MAX_LINES: usize = 800;

/// The modules of a file: `src/solution/echo.rs` is `solution::echo`, `mod.rs` its folder.
fn modules(path: &str) -> Vec<&str> {
    let path = path.trim_start_matches("src/").trim_end_matches(".rs");
    path.split('/').filter(|module| !matches!(*module, "mod" | "lib")).collect()
}

/// A line without its comment.
fn code(line: &str) -> &str {
    match line.trim_start().starts_with("//") {
        true => "",
        false => line.split(" //").next().unwrap_or(line),
    }
}

/// The first names of the paths that go on after a prefix: one, or those of a group in braces.
fn heads(after: &str) -> Vec<String> {
    let name = |text: &str| -> String {
        text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let Some(group) = after.strip_prefix('{') else { return vec![name(after)] };
    let mut heads = Vec::new();
    let (mut depth, mut start) = (0, 0);
    for (i, character) in group.char_indices() {
        match character {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                heads.push(name(group[start..i].trim()));
                start = i + 1;
                if character == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    heads.retain(|head| !head.is_empty());
    heads
}

/// What is wrong with a source file of the library, one line each.
fn complaints(path: &str, text: &str) -> Vec<String> {
    let modules = modules(path);
    let Some(own) = modules.first().copied() else { return Vec::new() };
    let Some((_, allowed)) = LAYERS.iter().find(|(layer, _)| *layer == own) else {
        return vec![format!("{path}: `{own}` is no known layer")];
    };
    let mut complaints = Vec::new();
    let lines: Vec<&str> = text.lines().map(code).collect();
    let to_the_root = "super::".repeat(modules.len());
    for (number, line) in lines.iter().enumerate() {
        let mut complain = |told: String| complaints.push(format!("{path}:{}: {told}", number + 1));
        let rest = lines[number..].join("\n");
        for (at, _) in line.match_indices("crate::") {
            let used = heads(&rest[at + "crate::".len()..]);
            let is_allowed = |used: &str| [own, FOR_ALL].contains(&used) || allowed.contains(&used);
            for layer in used.iter().filter(|used| !is_allowed(used)) {
                complain(format!("{own} must not use {layer}"));
            }
        }
        if line.contains(&to_the_root) {
            complain("another layer is named from `crate::`".to_owned());
        }
        for (what, layer) in CONFINED {
            let starts =
                |(at, _): (usize, &str)| !line[..at].ends_with(|c: char| c.is_alphanumeric());
            if layer != own && line.match_indices(what).any(starts) {
                complain(format!("{what} belongs to {layer}"));
            }
        }
    }
    complaints
}

fn root() -> &'static Path {
    Path::new(crate::ROOT)
}

/// The Rust files below a folder, with their paths from the root.
fn rust_files(folder: &str) -> Vec<(String, String)> {
    let mut folders = vec![root().join(folder)];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(&folder).into_iter().flatten();
        let paths: Vec<PathBuf> = entries.map(|entry| entry.expect("readable").path()).collect();
        for path in paths {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let name = path.strip_prefix(root()).expect("below the root");
                let text = fs::read_to_string(&path).expect("text");
                files.push((name.to_str().expect("a plain name").to_owned(), text));
            }
        }
    }
    files.sort();
    files
}

#[test]
fn layers_are_kept() {
    let files = rust_files("src");
    assert!(files.len() > 50);
    for (layer, _) in LAYERS {
        assert!(files.iter().any(|(path, _)| modules(path).first() == Some(&layer)), "{layer}");
    }
    let complaints: Vec<String> =
        files.iter().flat_map(|(path, text)| complaints(path, text)).collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

/// Unsafe code stands in one file of the kernels, the vector instructions, and nowhere else.
#[test]
fn unsafe_code_stands_in_one_file() {
    const ALLOWED: [&str; 1] = ["crates/kernels/src/vector/instructions.rs"];
    let is_unsafe = |text: &str| {
        let words = |line: &str| {
            line.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|word| word == "unsafe")
        };
        text.lines().map(code).any(words)
    };
    let mut found = Vec::new();
    for folder in ["src", "crates", "benches", "examples"] {
        let files = rust_files(folder);
        found.extend(files.into_iter().filter(|(_, text)| is_unsafe(text)).map(|(path, _)| path));
    }
    assert_eq!(found, ALLOWED);
}

/// Where Cargo builds no unit tests or no examples of documentation, there are none: they would not run.
#[test]
fn no_test_is_left_out() {
    let mut without = 0;
    for folder in [
        "",
        "crates/polynomial/",
        "crates/kernels/",
        "crates/draw/",
        "crates/studies/",
        "crates/cli/",
    ] {
        let manifest =
            fs::read_to_string(root().join(folder).join("Cargo.toml")).expect("a manifest");
        let library =
            manifest.split("\n[").find(|table| table.starts_with("lib]")).expect("a library");
        let files = rust_files(&format!("{folder}src"));
        let count = |line: &str| {
            let lines = files.iter().flat_map(|(_, text)| text.lines());
            lines.filter(|own| own.trim_start_matches(['/', '!', ' ']) == line).count()
        };
        if library.contains("\ntest = false") {
            assert_eq!(count("#[test]") + count("#[cfg(test)]"), 0, "{folder}");
            without += 1;
        }
        if library.contains("\ndoctest = false") {
            // All fences that tell no language end text.
            assert_eq!(count("```"), count("```text"), "{folder}");
        }
    }
    assert_eq!(without, 3);
}

#[test]
fn files_are_of_moderate_length() {
    for folder in ["src", "crates", "tests", "benches", "examples"] {
        for (path, text) in rust_files(folder) {
            let count = text.lines().count();
            assert!(count <= MAX_LINES, "{path} has {count} lines");
        }
    }
}

/// The check can fail: each of these is found.
#[test]
fn breaches_are_found() {
    for (path, text, complaint) in [
        ("src/ball/x.rs", "use crate::expression::Expression;", "ball must not use expression"),
        ("src/expression/sum.rs", "use crate::{ball, solution};", "expression must not use ball"),
        ("src/recurrence/a/b.rs", "use super::super::super::export::text;", "from `crate::`"),
        ("src/scenes.rs", "let x = super::language::read();", "from `crate::`"),
        ("src/export/text.rs", "fn f() { crate::language::parse() }", "not use language"),
        (
            "src/language/x.rs",
            "use crate::{\n    recurrence::A,\n    signal::{B, C},\n};",
            "not use signal",
        ),
        ("src/field/x.rs", "            bits *= 2;", "bits *= belongs to ball"),
        ("src/signal/x.rs", "    println!(\"x\");", "println! belongs to no layer"),
        ("src/novel/x.rs", "", "`novel` is no known layer"),
    ] {
        let found = complaints(path, text);
        assert!(found.iter().any(|found| found.contains(complaint)), "{path}: {found:?}");
    }
    for (path, text) in [
        ("src/ball/x.rs", "// use crate::expression::X;\nuse super::binary::Binary;"),
        ("src/solution/x.rs", "use crate::{expression::{A, B}, recurrence::C};"),
        ("src/signal/x.rs", "let f = format!(\"sprintln!\"); // eprintln!"),
    ] {
        assert_eq!(complaints(path, text), [""; 0], "{path}");
    }
}
