//! Files that are written: whole, or not at all.

use super::arguments::Output;
use super::budget;
use super::failure::Failure;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Text for standard output, or written to a file, which is then named there.
pub fn written(text: String, file: Option<&str>) -> Result<String, Failure> {
    match file.filter(|file| *file != "-") {
        None => Ok(text),
        Some(file) => {
            write_whole(Path::new(file), text.as_bytes())?;
            Ok(format!("{file}: {} bytes\n", text.len()))
        }
    }
}

/// A report, in a file where one is named; one of a failure is told all the same.
pub fn report(report: Result<String, Failure>, to: &Output) -> Result<String, Failure> {
    written(report?, to.output.as_deref())
}

/// The files that were read: none of them is written to.
pub fn read_files() -> MutexGuard<'static, Vec<PathBuf>> {
    static FILES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Writes a file as a whole or not at all: beside it first, under a name that is free, then in its
/// place. What is no ordinary file, such as a pipe, is written to.
pub fn write_whole(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let is_read = |target: PathBuf| target.is_file() && read_files().contains(&target);
    if fs::canonicalize(file).is_ok_and(is_read) {
        let message = format!("`{}` is what was read, and would be replaced", file.display());
        return Err(Failure::usage(message, "name another file"));
    }
    let _writing = budget::writing();
    let written = match fs::metadata(file) {
        Ok(found) if !found.is_file() => fs::write(file, bytes),
        // A link stays a link: its target is replaced.
        Ok(_) => fs::canonicalize(file).and_then(|target| {
            // A file that is protected stays as it is.
            File::options().write(true).open(&target)?;
            replace(&target, bytes)
        }),
        Err(_) => replace(file, bytes),
    };
    written.map_err(|error| {
        let message = format!("the file `{}` cannot be written: {error}", file.display());
        Failure::usage(message, "name a file in an existing, writable folder")
    })
}

fn replace(file: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut name = file.as_os_str().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let beside = PathBuf::from(name);
    let mut part = File::options().write(true).create_new(true).open(&beside)?;
    let written = part.write_all(bytes).and_then(|()| part.sync_all());
    let written = written.and_then(|()| match fs::metadata(file) {
        Ok(old) => fs::set_permissions(&beside, old.permissions()),
        Err(_) => Ok(()),
    });
    written.and_then(|()| fs::rename(&beside, file)).inspect_err(|_| {
        let _ = fs::remove_file(&beside);
    })
}

/// So many things, by the word for one.
pub fn plural(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}
