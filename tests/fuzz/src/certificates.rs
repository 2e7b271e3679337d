//! Certificates, altered: both checkers refuse one, or it claims the same as before.

use crate::bytes::Bytes;
use serde_json::{Value as Json, json};
use std::cell::RefCell;
use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A process that judges; it runs as long as its input is open.
struct Judge {
    originals: Vec<Json>,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    _process: Child,
}

impl Judge {
    /// `None` without Python.
    fn new() -> Option<Judge> {
        let files = crate::path("tests/fuzz/seeds/certificates").read_dir().expect("a folder");
        let mut files: Vec<_> = files.map(|entry| entry.expect("an entry").path()).collect();
        files.sort();
        let text = |file| std::fs::read_to_string(file).expect("a file");
        let parsed = |file| serde_json::from_str(&text(file)).expect("a document");
        let originals = files.into_iter().map(parsed).collect();
        let flint = crate::path("target/flint/bin/python");
        let python = if flint.exists() { flint } else { "python3".into() };
        let mut command = Command::new(python);
        command.arg(crate::path("tests/fuzz/judge.py")).env("PYTHONDONTWRITEBYTECODE", "1");
        let mut process = match command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn() {
            Ok(process) => process,
            Err(error) => {
                eprintln!("certificates are not judged without Python: {error}");
                return None;
            }
        };
        let (input, output) = (process.stdin.take()?, BufReader::new(process.stdout.take()?));
        Some(Judge { originals, input, output, _process: process })
    }

    fn verdict(&mut self, original: &Json, altered: &Json) -> String {
        let mut verdict = String::new();
        writeln!(self.input, "{}", json!([original, altered])).expect("the judge listens");
        self.output.read_line(&mut verdict).expect("the judge answers");
        verdict
    }
}

/// The parts of a document: how many there are, and the one of a number.
fn count(node: &Json) -> usize {
    1 + match node {
        Json::Array(all) => all.iter().map(count).sum::<usize>(),
        Json::Object(all) => all.values().map(count).sum(),
        _ => 0,
    }
}

fn part<'a>(node: &'a mut Json, number: &mut usize) -> Option<&'a mut Json> {
    if *number == 0 {
        return Some(node);
    }
    *number -= 1;
    match node {
        Json::Array(all) => all.iter_mut().find_map(|child| part(child, number)),
        Json::Object(all) => all.values_mut().find_map(|child| part(child, number)),
        _ => None,
    }
}

/// One part is altered: another digit, sign or character, another number, a part left out, doubled, moved, or put
/// in place of another one.
fn alter(document: &mut Json, bytes: &mut Bytes<'_>) {
    let mut places = [(); 2].map(|()| bytes.below(count(document) as u64) as usize);
    let other = part(document, &mut places[1]).expect("a part").clone();
    let node = part(document, &mut places[0]).expect("a part");
    let (kind, at) = (bytes.below(6), bytes.below(64) as usize);
    match node {
        _ if kind == 0 => *node = other,
        Json::String(text) => {
            let at = text.floor_char_boundary(at % (text.len() + 1));
            let end = text.ceil_char_boundary((at + usize::from(kind != 1)).min(text.len()));
            let with = ["0", "1", "9", "-", "/", "s", "2", ""][bytes.below(8) as usize];
            text.replace_range(at..end, with);
        }
        Json::Number(number) => {
            *node = json!(number.as_i64().unwrap_or(0) + bytes.about_zero(2));
        }
        Json::Array(all) if !all.is_empty() => {
            let (one, two) = (at % all.len(), bytes.below(all.len() as u64) as usize);
            match kind {
                1 => drop(all.remove(one)),
                2 => all.insert(one, all[two].clone()),
                _ => all.swap(one, two),
            }
        }
        Json::Object(all) if kind < 3 => {
            let key = all.keys().nth(at % all.len().max(1)).cloned();
            key.and_then(|key| all.shift_remove(&key));
        }
        _ => {}
    }
}

pub fn certificates(data: &[u8]) {
    thread_local! {
        static JUDGE: RefCell<Option<Judge>> = RefCell::new(Judge::new());
    }
    JUDGE.with_borrow_mut(|judge| {
        let Some(judge) = judge else { return };
        let mut bytes = Bytes(data);
        let original = judge.originals[bytes.below(judge.originals.len() as u64) as usize].clone();
        let mut altered = original.clone();
        for _ in 0..=bytes.below(3) {
            alter(&mut altered, &mut bytes);
        }
        let verdict = judge.verdict(&original, &altered);
        assert!(["refused\n", "harmless\n"].contains(&verdict.as_str()), "{verdict}: {altered}");
    });
}
