//! What the documents show is what the command does: every `console` block is run, every `wave`
//! block is read, every `refused` block is refused as the `text` block after it says, and the Rust of
//! the README is an example that is built.
//!
//! With `UPDATE_DOCUMENTS=1` the output in the documents is written anew; read it before you keep it.

use super::{ROOT, folder, run};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use wavestep::language::{self, Diagnostic, Source};
use wavestep_cli::diagnostic::{Style, render};

/// The README and all pages of `docs/`, with those of its notebooks.
fn documents() -> Vec<String> {
    let mut pages = Vec::new();
    for folder in ["docs", "docs/notebooks"] {
        let files = fs::read_dir(path(folder)).expect("the documents exist");
        let names =
            files.map(|page| page.expect("a page").file_name().into_string().expect("a name"));
        pages.extend(
            names.filter(|name| name.ends_with(".md")).map(|name| format!("{folder}/{name}")),
        );
    }
    pages.sort();
    pages.insert(0, "README.md".to_owned());
    pages
}

fn path(name: &str) -> PathBuf {
    Path::new(ROOT).join(name)
}

fn read(name: &str) -> String {
    fs::read_to_string(path(name)).expect("the document exists")
}

/// A fenced block: what stands behind its fence, and its lines.
struct Block<'a> {
    info: &'a str,
    lines: Vec<&'a str>,
}

/// A document as text between blocks, and blocks.
fn blocks(document: &str) -> Vec<Result<Block<'_>, &str>> {
    let mut parts = Vec::new();
    let mut current: Option<Block<'_>> = None;
    for line in document.lines() {
        match (&mut current, line.strip_prefix("```")) {
            (None, Some(info)) => current = Some(Block { info, lines: Vec::new() }),
            (None, None) => parts.push(Err(line)),
            (Some(_), Some("")) => parts.extend(current.take().map(Ok)),
            (Some(block), _) => block.lines.push(line),
        }
    }
    assert!(current.is_none(), "a block is not closed");
    parts
}

/// The arguments of a command; single quotes keep blanks.
fn arguments(line: &str) -> Vec<String> {
    let quoted = line.split('\'').enumerate();
    let words = quoted.flat_map(|(i, part)| match i % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect::<Vec<_>>(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

/// A command with what it prints.
fn shown(line: &str, folder: &Path) -> String {
    let arguments = arguments(line.strip_prefix("$ wavestep ").expect("a command of wavestep"));
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (_, out, err) = run(folder, &arguments);
    format!("{line}\n{out}{err}")
}

/// What is wrong with a text that states a recurrence or a scene.
fn refusals(name: &str, lines: &[&str]) -> Vec<Diagnostic> {
    let source = Source::new(name, lines.join("\n")).expect("a text");
    language::read(&source, &BTreeMap::new()).err().unwrap_or_default()
}

/// The document with the real output of its commands, and how many they are. Files that it names,
/// as in "```wave mine.wave", are written first.
fn with_real_output(name: &str) -> (String, usize) {
    let folder = folder(&name.replace('/', "-"));
    let document = read(name);
    let (mut real, mut commands) = (String::new(), 0);
    let mut refused = None;
    for part in blocks(&document) {
        let Block { info, lines } = match part {
            Ok(block) => block,
            Err(line) => {
                real.push_str(&format!("{line}\n"));
                continue;
            }
        };
        if let Some(file) = info.strip_prefix("wave ") {
            fs::write(folder.join(file), lines.join("\n") + "\n").expect("a file");
        }
        let text: String = match info {
            "console" => {
                let asked = lines.iter().filter(|line| line.starts_with("$ "));
                asked.inspect(|_| commands += 1).map(|line| shown(line, &folder)).collect()
            }
            "text" if refused.is_some() => refused.take().expect("just seen"),
            _ => lines.iter().map(|line| format!("{line}\n")).collect(),
        };
        if info == "refused" {
            let errors = refusals("scene.wave", &lines);
            assert!(!errors.is_empty(), "in {name}: not refused:\n{}", lines.join("\n"));
            let texts: Vec<String> =
                errors.iter().map(|error| render(error, Style::Plain) + "\n").collect();
            refused = Some(texts.join("\n"));
        }
        real.push_str(&format!("```{info}\n{text}```\n"));
    }
    (real, commands)
}

#[test]
fn console_blocks_show_the_real_output() {
    let mut shown = 0;
    for name in &documents() {
        let (real, commands) = with_real_output(name);
        shown += commands;
        if real != read(name) && std::env::var_os("UPDATE_DOCUMENTS").is_some() {
            fs::write(path(name), &real).expect("the document can be written");
        }
        assert_eq!(real, read(name), "in {name}");
    }
    assert!(shown >= 10, "the documents show {shown} commands");
}

#[test]
fn wave_blocks_are_read() {
    let mut read_blocks = 0;
    for name in &documents() {
        let document = read(name);
        for block in blocks(&document).into_iter().flatten() {
            if block.info.split(' ').next() != Some("wave") {
                continue;
            }
            if let Some(diagnostic) = refusals(name, &block.lines).first() {
                panic!("in {name}:\n{diagnostic}");
            }
            read_blocks += 1;
        }
    }
    assert!(read_blocks >= 12);
}

#[test]
fn the_rust_of_the_readme_is_the_example_of_the_library() {
    let readme = read("README.md");
    let rust: Vec<String> = blocks(&readme)
        .into_iter()
        .flatten()
        .filter(|block| block.info == "rust")
        .map(|block| block.lines.join("\n") + "\n")
        .collect();
    let example = read("examples/derive.rs");
    let (_, code) = example.split_once("\n\n").expect("a comment, then the code");
    assert_eq!(rust, [code]);
    assert!(code.lines().count() <= 12);
    let library = read("src/lib.rs");
    let lines = library.lines().map_while(|line| line.strip_prefix("//!"));
    let docs: Vec<&str> = lines.map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
    assert!(
        docs.join("\n").contains(&format!("```\n{code}```")),
        "the example of src/lib.rs differs"
    );
}

/// The formula at the top of the README is what the command typesets.
#[test]
fn the_formula_of_the_readme_is_derived() {
    let readme = read("README.md");
    let formula = readme.lines().find_map(|line| line.strip_prefix("$$")?.strip_suffix("$$"));
    let line = ["derive", "rigid-mass", "--quantity", "f", "--piece", "2", "--format", "latex"];
    let (_, latex, _) = run(&folder("readme-formula"), &line);
    let lines: Vec<&str> = latex.lines().filter(|line| !line.contains("align*")).collect();
    assert_eq!(formula.expect("a formula"), lines.join(" ").replace(" &=", " ="));
    assert!(readme.lines().count() <= 200);
}

/// The site has every page once, the tutorial first; links within the repository lead to files that are there.
#[test]
fn the_site_has_every_page_and_links_lead_somewhere() {
    let summary = read("docs/SUMMARY.md");
    let links = |text: &str| -> Vec<String> {
        let links = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        links.map(str::to_owned).collect()
    };
    let listed = links(&summary);
    assert_eq!(listed[0], "tutorial.md");
    let mut sorted: Vec<String> = listed.iter().map(|page| format!("docs/{page}")).collect();
    sorted.sort();
    let mut pages = documents();
    pages.retain(|page| page != "README.md" && page != "docs/SUMMARY.md");
    assert_eq!(sorted, pages);
    let mut followed = 0;
    for name in &documents() {
        let text: Vec<String> = blocks(&read(name))
            .into_iter()
            .filter_map(|part| part.err().map(str::to_owned))
            .collect();
        for link in links(&text.join("\n")) {
            let file = link.split('#').next().unwrap_or_default();
            if !file.contains(['.', '/']) || file.contains("://") {
                continue;
            }
            let folder = Path::new(name).parent().expect("a folder");
            assert!(Path::new(ROOT).join(folder).join(file).exists(), "in {name}: {link}");
            followed += 1;
        }
    }
    assert!(followed > 50, "{followed}");
}
