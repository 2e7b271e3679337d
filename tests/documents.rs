//! What the documents show is what the command does: every `console` block is run, every `wave`
//! block is read.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use wavestep::language::{Source, read_recurrence};

const DOCUMENTS: [&str; 3] = ["README.md", "docs/language.md", "docs/output.md"];

/// The fenced blocks of a language in a document.
fn blocks(document: &str, language: &str) -> Vec<String> {
    let mut blocks = Vec::new();
    let mut current: Option<String> = None;
    let opening = format!("```{language}");
    for line in document.lines() {
        match (&mut current, line.trim_end()) {
            (None, line) if line == opening => current = Some(String::new()),
            (Some(_), "```") => blocks.extend(current.take()),
            (Some(block), line) => {
                block.push_str(line);
                block.push('\n');
            }
            (None, _) => {}
        }
    }
    blocks
}

fn read(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    std::fs::read_to_string(path).expect("the document exists")
}

/// A `console` block is commands after `$ wavestep`, each with its output.
#[test]
fn console_blocks_show_the_real_output() {
    let mut shown = 0;
    for name in DOCUMENTS {
        for block in blocks(&read(name), "console") {
            let mut expected = String::new();
            let mut actual = String::new();
            for line in block.lines() {
                expected.push_str(line);
                expected.push('\n');
                let Some(arguments) = line.strip_prefix("$ wavestep ") else { continue };
                let output = Command::new(env!("CARGO_BIN_EXE_wavestep"))
                    .current_dir(env!("CARGO_MANIFEST_DIR"))
                    .args(arguments.split_whitespace())
                    .output()
                    .expect("the command runs");
                let text = String::from_utf8(output.stdout).expect("text");
                let errors = String::from_utf8(output.stderr).expect("text");
                actual.push_str(&format!("{line}\n{text}{errors}"));
                shown += 1;
            }
            assert_eq!(actual, expected, "in {name}");
        }
    }
    assert!(shown >= 3, "the documents show {shown} commands");
}

#[test]
fn wave_blocks_are_recurrences() {
    let mut read_blocks = 0;
    for name in DOCUMENTS {
        for block in blocks(&read(name), "wave") {
            let source = Source::new(name, block.as_bytes()).expect("a text");
            if let Err(diagnostic) = read_recurrence(&source, &BTreeMap::new()) {
                panic!("in {name}:\n{diagnostic}");
            }
            read_blocks += 1;
        }
    }
    assert!(read_blocks >= 2);
}
