//! The built command.

mod answer;
mod book;
mod certificates;
mod chart;
mod command;
mod dispersion;
mod documents;
mod enough;
mod events;
mod everywhere;
mod extremes;
mod find;
mod first_contact;
mod forged;
mod json;
mod local_contact;
mod lock;
mod messages;
mod open_contacts;
mod picture;
mod questions;
mod report;
mod scene;
#[path = "../../../../tests/it/support/snapshot.rs"]
mod snapshot;
mod strains;
mod sweep;
mod table;
mod theories;
mod typeset;
mod validity;
mod vocabulary;

use snapshot::snapshot;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The repository.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Where files lie that one test alone names.
fn anywhere() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR"))
}

/// A folder of a test's own, empty.
fn folder(name: &str) -> PathBuf {
    let folder = anywhere().join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// The command in a folder, on paper of 100 columns without colours.
fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wavestep"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null());
    command.env("COLUMNS", "100").env("NO_COLOR", "1");
    command
}

/// What the command does in a folder: its exit code, standard output and standard error.
fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = command(folder, arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// The arguments of a line; quotes are not needed here.
fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}
