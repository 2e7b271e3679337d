//! The language of scenes: every text of its corpus, what is read, and random texts and trees.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;
use wavestep::expression::Fraction;
use wavestep::language::syntax::Scene as Tree;
use wavestep::language::{
    Diagnostic, Kind as TextKind, Source, Span, Style, kind, parse_number, parse_scene,
    read_expression, read_scene,
};
use wavestep::scene::{Body, Drive, End, Joint, Kind, Measure, Place, Position, Scene};

// ---- The corpus -------------------------------------------------------------------------------

/// The texts of a folder of the grammar, in the order of their names.
fn corpus(folder: &str) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("grammar").join(folder);
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, fs::read(path).unwrap())
    };
    paths.into_iter().map(read).collect()
}

fn settings() -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots/scene-language"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}

fn source(name: &str, bytes: impl AsRef<[u8]>) -> Source {
    Source::new(&format!("{name}.wave"), bytes).unwrap()
}

fn meaning(text: &str, values: &[(&str, &str)]) -> Result<Scene, Vec<Diagnostic>> {
    let value = |&(name, value): &(&str, &str)| (name.to_owned(), parse_number(value).unwrap());
    read_scene(&source("text", text), &values.iter().map(value).collect())
}

fn rendered(errors: &[Diagnostic]) -> String {
    let texts: Vec<String> = errors.iter().map(|error| error.render(Style::Plain)).collect();
    texts.join("\n\n")
}

fn assert_prints_and_reads_back(tree: &Tree) {
    let printed = tree.to_string();
    let again = parse_scene(&source("printed", &printed)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.title, tree.title);
    assert_eq!(again.statements, tree.statements, "{printed}");
    assert_eq!(again.to_string(), printed);
    assert!(printed.is_ascii() || !tree.title.value.is_ascii());
}

#[test]
fn accepted_scenes_are_read_and_printed() {
    let corpus = corpus("accepted-scenes");
    assert!(corpus.len() >= 6);
    for (name, bytes) in corpus {
        let source = source(&name, bytes);
        assert_eq!(kind(&source), TextKind::Scene);
        let tree = parse_scene(&source).unwrap_or_else(|error| panic!("{error}"));
        assert_prints_and_reads_back(&tree);
        if let Err(errors) = read_scene(&source, &BTreeMap::new()) {
            panic!("{}", rendered(&errors));
        }
        settings().bind(|| insta::assert_snapshot!(format!("accepted-{name}"), tree.to_string()));
    }
}

/// One file an error: neither a second message for the same mistake, nor none.
#[test]
fn rejected_scenes_are_explained() {
    let corpus = corpus("rejected-scenes");
    assert!(corpus.len() >= 0);
    for (name, bytes) in corpus {
        let source = source(&name, bytes);
        if let Ok(tree) = parse_scene(&source) {
            assert_prints_and_reads_back(&tree);
        }
        let errors = read_scene(&source, &BTreeMap::new()).expect_err(&name);
        for error in &errors {
            assert!(error.remedy().is_some(), "{name} has no remedy");
        }
        let several = name.starts_with("several-");
        assert_eq!(errors.len() > 1, several, "{name}:\n{}", rendered(&errors));
        let text = rendered(&errors);
        settings().bind(|| insta::assert_snapshot!(format!("rejected-{name}"), text));
    }
}
