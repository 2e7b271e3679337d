//! The layers of the library, kept: a lower layer never imports a higher one.
//!
//! The source is read as text. Every path that begins with `crate::`, `wavestep::` or `super::` is
//! resolved to the layer it leads to, and libraries and macros that belong to one layer are looked
//! for in all others.

use std::fs;
use std::path::{Path, PathBuf};

/// Every layer with the layers it may use.
const LAYERS: [(&str, &[&str]); 25] = [
    ("ball", &[]),
    ("plot", &[]),
    ("expression", &[]),
    ("enclosure", &["ball", "expression"]),
    ("dispersion", &["ball", "expression"]),
    ("scene", &["expression"]),
    ("recurrence", &["enclosure", "expression"]),
    ("network", &["enclosure", "expression", "recurrence", "scene"]),
    ("hertz", &["ball", "enclosure", "expression", "network", "scene"]),
    ("model", &["ball", "enclosure", "expression", "network", "recurrence", "scene"]),
    ("solution", &["expression", "recurrence"]),
    (
        "evaluate",
        &["ball", "enclosure", "expression", "network", "recurrence", "scene", "solution"],
    ),
    ("field", &["ball", "enclosure", "evaluate", "expression", "network", "scene"]),
    (
        "history",
        &["ball", "enclosure", "evaluate", "expression", "field", "network", "scene", "solution"],
    ),
    ("answer", &["evaluate", "model", "network"]),
    (
        "export",
        &["dispersion", "evaluate", "expression", "network", "recurrence", "scene", "solution"],
    ),
    ("language", &["dispersion", "expression", "recurrence", "scene"]),
    (
        "lock",
        &[
            "ball",
            "evaluate",
            "export",
            "expression",
            "history",
            "language",
            "network",
            "recurrence",
            "scene",
            "solution",
        ],
    ),
    (
        "error",
        &[
            "answer",
            "ball",
            "evaluate",
            "expression",
            "field",
            "history",
            "language",
            "lock",
            "model",
            "network",
            "solution",
        ],
    ),
    ("study", &["answer", "evaluate", "language", "plot", "recurrence", "solution"]),
    (
        "picture",
        &["ball", "evaluate", "expression", "field", "language", "network", "plot", "scene"],
    ),
    ("scenes", &[]),
    (
        "figures",
        &[
            "ball",
            "dispersion",
            "enclosure",
            "evaluate",
            "expression",
            "field",
            "hertz",
            "history",
            "language",
            "network",
            "picture",
            "plot",
            "recurrence",
            "scenes",
            "solution",
        ],
    ),
    (
        "book",
        &[
            "ball",
            "dispersion",
            "enclosure",
            "evaluate",
            "export",
            "expression",
            "hertz",
            "language",
            "network",
            "recurrence",
            "scenes",
            "solution",
        ],
    ),
    (
        "command",
        &[
            "answer",
            "ball",
            "book",
            "dispersion",
            "enclosure",
            "evaluate",
            "export",
            "expression",
            "field",
            "figures",
            "hertz",
            "history",
            "language",
            "lock",
            "model",
            "network",
            "picture",
            "plot",
            "recurrence",
            "scene",
            "scenes",
            "solution",
            "study",
        ],
    ),
];

/// What unit tests may use beyond that, to have scenes to work on.
const FOR_UNIT_TESTS: [&str; 2] = ["language", "scenes"];

/// What may stand in one layer only.
const CONFINED: [(&str, &str); 13] = [
    ("nom::", "language"),
    ("nom_locate", "language"),
    ("annotate_snippets", "language"),
    ("clap", "command"),
    ("indicatif", "command"),
    ("println!", "command"),
    ("eprintln!", "command"),
    ("std::process", "command"),
    ("wavestep_kernels", "evaluate"),
    ("ode_solvers", "model"),
    ("rustfft", "dispersion"),
    ("resvg", "plot"),
    ("dejavu", "plot"),
];

const MAX_LINES: usize = 800;

/// The modules of a file: `src/solution/echo.rs` is `solution::echo`, `mod.rs` its folder.
fn modules(path: &str) -> Vec<&str> {
    let path = path.trim_start_matches("src/").trim_end_matches(".rs");
    let mut modules: Vec<&str> = path.split('/').collect();
    if matches!(modules.last(), Some(&("mod" | "lib" | "main"))) {
        modules.pop();
    }
    modules
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

/// The layers that a source text names, with the line where it does.
fn imports(path: &str, text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut inline = 0;
    let lines: Vec<&str> = text.lines().map(code).collect();
    for (number, line) in lines.iter().enumerate() {
        // A module written in a file is one level deeper; it ends with a brace in the first column.
        let opens = line.trim_start().trim_start_matches("pub ").starts_with("mod ");
        if opens && line.ends_with('{') {
            inline = 1;
        } else if line.starts_with('}') {
            inline = 0;
        }
        let rest = lines[number..].join("\n");
        for (at, _) in line.match_indices("::") {
            let before = &line[..at];
            let word = before.rsplit(|c: char| !(c.is_alphanumeric() || c == '_')).next();
            let after = &rest[at + 2..];
            match word {
                Some("crate" | "wavestep") => {
                    found.extend(heads(after).into_iter().map(|head| (number + 1, head)));
                }
                Some("super") if !before.ends_with("super::super") => {
                    let mut up = 1;
                    let mut after = after;
                    while let Some(further) = after.strip_prefix("super::") {
                        (up, after) = (up + 1, further);
                    }
                    let modules = modules(path);
                    let depth = (modules.len() + inline).saturating_sub(up);
                    match depth {
                        0 => found.extend(heads(after).into_iter().map(|head| (number + 1, head))),
                        _ => found.push((number + 1, modules[0].to_owned())),
                    }
                }
                _ => {}
            }
        }
    }
    found
}

/// What is wrong with a source file, one line each.
fn complaints(path: &str, text: &str) -> Vec<String> {
    let mut complaints = Vec::new();
    if text.lines().count() > MAX_LINES {
        complaints.push(format!("{path}: more than {MAX_LINES} lines"));
    }
    let Some(own) = modules(path).first().copied() else { return complaints };
    let Some((_, allowed)) = LAYERS.iter().find(|(layer, _)| *layer == own) else {
        complaints.push(format!("{path}: `{own}` is no known layer"));
        return complaints;
    };
    // Unit tests end a file.
    let library = text.lines().take_while(|line| *line != "#[cfg(test)]").count();
    for (line, layer) in imports(path, text) {
        let for_tests = line > library && FOR_UNIT_TESTS.contains(&layer.as_str());
        if layer != own && !allowed.contains(&layer.as_str()) && !for_tests {
            complaints.push(format!("{path}:{line}: {own} must not use {layer}"));
        }
    }
    // Unit tests may print how often they decided nothing.
    for (number, line) in text.lines().take(library).map(code).enumerate() {
        for (what, layer) in CONFINED {
            let starts =
                |(at, _): (usize, &str)| !line[..at].ends_with(|c: char| c.is_alphanumeric());
            if layer != own && line.match_indices(what).any(starts) {
                complaints.push(format!("{path}:{}: {what} belongs to {layer}", number + 1));
            }
        }
    }
    complaints
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
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
    let imports = files.iter().map(|(path, text)| imports(path, text).len()).sum::<usize>();
    assert!(imports > 100, "the scan finds next to nothing");
    let complaints: Vec<String> =
        files.iter().flat_map(|(path, text)| complaints(path, text)).collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

/// The polynomials know nothing of waves.
#[test]
fn polynomials_stand_alone() {
    for (path, text) in rust_files("polynomial") {
        let names = text.replace("wavestep_polynomial", "").replace("wavestep-polynomial", "");
        assert!(!names.contains("wavestep"), "{path}");
    }
    let manifest = fs::read_to_string(root().join("polynomial/Cargo.toml")).expect("text");
    let dependencies = manifest.split_once("[dependencies]").expect("a list").1;
    assert!(!dependencies.contains("wavestep"), "{dependencies}");
}

/// The kernels know nothing of waves either: not of expressions, scenes and recurrences.
#[test]
fn kernels_stand_alone() {
    let files = rust_files("kernels");
    assert!(files.len() > 30);
    for (path, text) in files {
        let names = text.replace("wavestep_kernels", "");
        assert!(!names.contains("wavestep::") && !names.contains("wavestep_"), "{path}");
    }
    let manifest = fs::read_to_string(root().join("kernels/Cargo.toml")).expect("text");
    let dependencies = manifest.split_once("[dependencies]").expect("a list").1;
    assert!(!dependencies.contains("wavestep"), "{dependencies}");
}

/// Unsafe code stands in two files of the kernels, the vector instructions, and nowhere else.
#[test]
fn unsafe_code_stands_in_two_files() {
    const ALLOWED: [&str; 2] = ["kernels/src/lanes/x86.rs", "kernels/src/vector/instructions.rs"];
    let is_unsafe = |text: &str| {
        let words = |line: &str| {
            line.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|word| word == "unsafe")
        };
        text.lines().map(code).any(words)
    };
    let mut found = Vec::new();
    for folder in ["src", "polynomial", "kernels", "benches", "examples"] {
        let files = rust_files(folder);
        found.extend(files.into_iter().filter(|(_, text)| is_unsafe(text)).map(|(path, _)| path));
    }
    assert_eq!(found, ALLOWED);
}

#[test]
fn files_are_of_moderate_length() {
    for folder in ["src", "polynomial", "kernels", "tests", "benches", "examples"] {
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
        ("src/recurrence/a/b.rs", "use super::super::super::export::text;", "not use export"),
        ("src/recurrence/mod.rs", "use super::solution;", "recurrence must not use solution"),
        ("src/scenes.rs", "let x = super::language::read();", "scenes must not use language"),
        ("src/export/text.rs", "fn f() { crate::language::parse() }", "not use language"),
        (
            "src/language/x.rs",
            "use crate::{\n    recurrence::A,\n    evaluate::{B, C},\n};",
            "not use evaluate",
        ),
        ("src/evaluate/x.rs", "use crate::{ball, model};", "evaluate must not use model"),
        ("src/model/x.rs", "use crate::evaluate::Signal;", "model must not use evaluate"),
        ("src/evaluate/x.rs", "use crate::scenes::SCENES;", "evaluate must not use scenes"),
        (
            "src/evaluate/x.rs",
            "#[cfg(test)]\nmod tests {\n    use crate::command;\n}",
            "evaluate must not use command",
        ),
        ("src/answer/x.rs", "use ode_solvers::Dop853;", "ode_solvers belongs to model"),
        ("src/export/x.rs", "use wavestep_kernels::Table;", "wavestep_kernels belongs to evaluate"),
        ("src/export/x.rs", "use nom::IResult;", "nom:: belongs to language"),
        ("src/picture/x.rs", "use resvg::usvg;", "resvg belongs to plot"),
        ("src/plot/x.rs", "use crate::field::Fields;", "plot must not use field"),
        ("src/solution/x.rs", "use clap::Parser;", "clap belongs to command"),
        ("src/evaluate/x.rs", "    println!(\"x\");", "println! belongs to command"),
        ("src/book/x.rs", "use crate::command;", "book must not use command"),
        ("src/export/x.rs", "use crate::book::find;", "export must not use book"),
        ("src/novel/x.rs", "", "`novel` is no known layer"),
    ] {
        let found = complaints(path, text);
        assert!(found.iter().any(|found| found.contains(complaint)), "{path}: {found:?}");
    }
    let long = "\n".repeat(MAX_LINES + 1);
    assert!(!complaints("src/ball/x.rs", &long).is_empty());
    for (path, text) in [
        ("src/ball/x.rs", "// use crate::expression::X;\nuse super::binary::Binary;"),
        ("src/solution/x.rs", "use crate::{expression::{A, B}, recurrence::C};"),
        ("src/solution/mod.rs", "mod tests {\n    use super::*;\n    use super::echo::X;\n}"),
        ("src/evaluate/x.rs", "let f = format!(\"sprintln!\"); // eprintln!"),
        ("src/evaluate/x.rs", "#[cfg(test)]\nmod tests {\n    use crate::scenes::SCENES;\n}"),
        ("src/command/mod.rs", "use wavestep::{ball, language};\nuse clap::Parser;"),
    ] {
        assert_eq!(complaints(path, text), [""; 0], "{path}");
    }
}
