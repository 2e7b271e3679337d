//! Every public item shows how it is used, by an example that `cargo test --doc` runs.
//!
//! The source is read as text. A type, trait, free function or constant has an example of its own;
//! a method has one, or an example in its file calls it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// What is part of no public library.
const NOT_LIBRARY: [&str; 2] = ["src/command", "src/main.rs"];

/// What a public item is, which decides what it needs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    Type,
    Trait,
    Function,
    Constant,
    Method,
}

/// An item whose `pub` has no parentheses.
#[derive(Debug)]
struct Item {
    kind: Kind,
    name: String,
    /// The type whose method or constant it is.
    of: Option<String>,
    line: usize,
    has_example: bool,
}

/// What a file declares and shows.
#[derive(Default, Debug)]
struct Declared {
    items: Vec<Item>,
    /// Types with their visibility: whether it is plainly `pub`.
    types: BTreeMap<String, bool>,
    /// The code of all examples.
    examples: String,
}

/// The first name in a text, and what follows it.
fn name(text: &str) -> (&str, &str) {
    let text = text.trim_start();
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len());
    text.split_at(end)
}

/// The code of the examples in a doc comment that are run: those with no other language than Rust.
fn examples(docs: &[&str]) -> String {
    let mut code = String::new();
    let mut block: Option<bool> = None;
    for line in docs {
        let line = line.strip_prefix(' ').unwrap_or(line);
        match (block, line.trim_start().strip_prefix("```")) {
            (None, Some(language)) => {
                block = Some(["", "rust", "should_panic"].contains(&language.trim()));
            }
            (Some(_), Some(_)) => block = None,
            (Some(true), None) => {
                code.push_str(line.strip_prefix("# ").unwrap_or(line));
                code.push('\n');
            }
            _ => {}
        }
    }
    code
}

/// The type that an `impl` block is for; `None` for the impl of a trait.
fn implemented(line: &str) -> Option<String> {
    let mut rest = line.strip_prefix("impl")?;
    if rest.starts_with('<') {
        let mut depth = 0;
        let end = rest.find(|c: char| {
            depth += i32::from(c == '<') - i32::from(c == '>');
            depth == 0
        });
        rest = &rest[end? + 1..];
    }
    if line.contains(" for ") {
        return None;
    }
    let (path, _) = rest.split_once(['<', '{']).unwrap_or((rest, ""));
    let last = path.trim().rsplit("::").next()?;
    (!last.is_empty()).then(|| last.to_owned())
}

/// The kind, visibility and name of an item that a line declares.
fn declared(line: &str, within: Option<&str>) -> Option<(Kind, bool, String)> {
    let line = line.trim_start();
    let (public, mut rest) = match line.strip_prefix("pub") {
        Some(after) if after.starts_with(' ') => (true, after),
        Some(after) if after.starts_with('(') => (false, after.split_once(')')?.1),
        _ => (false, line),
    };
    loop {
        let (word, after) = name(rest);
        let function = if within.is_some() { Kind::Method } else { Kind::Function };
        let kind = match word {
            "const" if name(after).0 != "fn" && name(after).0 != "unsafe" => Kind::Constant,
            "const" | "unsafe" | "async" => {
                rest = after;
                continue;
            }
            "struct" | "enum" | "union" | "type" => Kind::Type,
            "static" => Kind::Constant,
            "trait" => Kind::Trait,
            "fn" => function,
            _ => return None,
        };
        let (found, _) = name(after);
        return (!found.is_empty()).then(|| (kind, public, found.to_owned()));
    }
}

/// Reads a source text up to its unit tests.
fn read(text: &str) -> Declared {
    let mut found = Declared::default();
    let mut docs: Vec<&str> = Vec::new();
    let mut within: Option<String> = None;
    // How many brackets an attribute has open.
    let mut attribute = 0;
    let lines: Vec<&str> = text.lines().collect();
    for (number, line) in lines.iter().enumerate() {
        let next = lines.get(number + 1).copied().unwrap_or_default();
        if *line == "#[cfg(test)]" && next.starts_with("mod ") && next.ends_with('{') {
            break;
        }
        let code = line.trim_start();
        if let Some(doc) = code.strip_prefix("///").or_else(|| code.strip_prefix("//!")) {
            docs.push(doc);
            continue;
        }
        if attribute > 0 || code.starts_with("#[") {
            attribute += code.matches('[').count() as i32 - code.matches(']').count() as i32;
            continue;
        }
        if code.starts_with("//") {
            continue;
        }
        let example = examples(&std::mem::take(&mut docs));
        found.examples.push_str(&example);
        match *line {
            "}" => within = None,
            line if line.starts_with("impl") => within = implemented(line),
            _ => {}
        }
        if let Some((kind, public, name)) = declared(line, within.as_deref()) {
            if matches!(kind, Kind::Type | Kind::Trait) {
                found.types.insert(name.clone(), public);
            }
            if public {
                let (of, line) = (within.clone(), number + 1);
                let has_example = !example.is_empty();
                found.items.push(Item { kind, name, of, line, has_example });
            }
        }
    }
    found.examples.push_str(&examples(&docs));
    found
}

impl Declared {
    /// Whether an example of the file names the method or constant.
    fn shows(&self, item: &Item) -> bool {
        let Item { kind, name, .. } = item;
        match kind {
            Kind::Method => [".", "::"].iter().any(|by| {
                let calls = |end| self.examples.contains(&format!("{by}{name}{end}"));
                calls("(") || calls("::<")
            }),
            _ => self.examples.match_indices(&format!("::{name}")).any(|(at, found)| {
                let after = self.examples[at + found.len()..].chars().next();
                !after.is_some_and(|c| c.is_alphanumeric() || c == '_')
            }),
        }
    }
}

/// The public items of a library's files that lack an example, one line each, and how many there
/// are in all.
fn offenders(files: &[(String, String)]) -> (Vec<String>, usize) {
    let read: Vec<(&str, Declared)> =
        files.iter().map(|(path, text)| (path.as_str(), read(text))).collect();
    let (mut offenders, mut count) = (Vec::new(), 0);
    for (path, file) in &read {
        for item in &file.items {
            // The type is that of the file, or else one of another file.
            let visible = item.of.as_ref().is_none_or(|of| match file.types.get(of) {
                Some(public) => *public,
                None => read.iter().any(|(_, other)| other.types.get(of) == Some(&true)),
            });
            if !visible {
                continue;
            }
            count += 1;
            if !(item.has_example || item.of.is_some() && file.shows(item)) {
                let Item { kind, name, line, .. } = item;
                let of = item.of.as_ref().map_or_else(String::new, |of| format!("{of}::"));
                offenders.push(format!("{path}:{line}: {kind:?} {of}{name} has no example"));
            }
        }
    }
    (offenders, count)
}

/// The Rust files below a folder, with their paths from the root.
fn rust_files(folder: &str) -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = vec![root.join(folder)];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(&folder).expect("a folder");
        let paths: Vec<PathBuf> = entries.map(|entry| entry.expect("readable").path()).collect();
        for path in paths {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let name = path.strip_prefix(root).expect("below the root").to_str();
                let text = fs::read_to_string(&path).expect("text");
                files.push((name.expect("a plain name").to_owned(), text));
            }
        }
    }
    files.retain(|(path, _)| !NOT_LIBRARY.iter().any(|place| path.starts_with(place)));
    files.sort();
    files
}

#[test]
fn public_items_have_examples() {
    let mut all = Vec::new();
    for library in ["src", "polynomial/src"] {
        let (offenders, count) = offenders(&rust_files(library));
        assert!(count > 30, "the scan of {library} finds next to nothing");
        all.extend(offenders);
    }
    assert!(all.is_empty(), "{} items\n{}", all.len(), all.join("\n"));
}

/// The check can fail, and finds what it should in a small text.
#[test]
fn missing_examples_are_found() {
    let text = r#"//! A file.

/// Has one.
///
/// ```
/// let shown = Shown::new(1);
/// assert_eq!(shown.value::<u32>(), Shown::FIRST);
/// ```
#[derive(
    Clone
)]
pub struct Shown<T>(T);

/// A formula is no example.
///
/// ```text
/// x = y
/// ```
pub enum Bare {
    /// A variant.
    One,
}

impl<T: Into<Vec<T>>> Shown<T> {
    /// Named.
    pub const FIRST: u32 = 1;
    /// Not named: `FIRST` is another one.
    pub const FIR: u32 = 1;

    /// Called.
    #[must_use]
    pub const fn new(value: T) -> Self {}

    /// Called.
    pub fn value<U>(&self) -> U {}

    /// Only a longer name is called.
    pub fn val(&self) {}

    /// Of the crate.
    pub(crate) fn inner(&self) {}
}

impl Hidden {
    /// No one sees it.
    pub fn seen(&self) {}
}

pub(crate) struct Hidden;

impl From<Hidden> for Bare {
    fn from(hidden: Hidden) -> Bare {}
}

/// ```ignore
/// free();
/// ```
pub unsafe fn free() {}

/// ```
/// assert_eq!(CONSTANT, 1);
/// ```
pub const CONSTANT: usize = 1;

pub type Alias = Shown<u8>;
pub trait Open {}
pub use other::Thing;
pub mod part;

#[cfg(test)]
mod tests {
    pub fn inner() {}
}
"#;
    let other = "impl Shown<u8> {\n    pub fn other(&self) {}\n}\n\npub(super) fn f() {}\n";
    let files = [("src/a.rs", text), ("src/b.rs", other)];
    let files = files.map(|(path, text)| (path.to_owned(), text.to_owned()));
    let line = |part: &str| 1 + text.lines().position(|line| line.contains(part)).expect(part);
    let (found, count) = offenders(&files);
    let expected = [
        format!("src/a.rs:{}: Type Bare has no example", line("pub enum Bare")),
        format!("src/a.rs:{}: Constant Shown::FIR has no example", line("FIR:")),
        format!("src/a.rs:{}: Method Shown::val has no example", line("fn val(")),
        format!("src/a.rs:{}: Function free has no example", line("fn free")),
        format!("src/a.rs:{}: Type Alias has no example", line("type Alias")),
        format!("src/a.rs:{}: Trait Open has no example", line("trait Open")),
        "src/b.rs:2: Method Shown::other has no example".to_owned(),
    ];
    assert_eq!(found, expected);
    assert_eq!(count, 12);
}
