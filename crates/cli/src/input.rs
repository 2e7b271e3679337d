//! Reads what the arguments name: scenes, values, digits.

use super::arguments::Scene;
use super::failure::Failure;
use super::output::read_files;
use num_rational::BigRational;
use std::io::Read;
use std::ops::{Deref, DerefMut};
use std::path::Path;
use wavestep::answer::Costs;
use wavestep::language;
use wavestep::limits::{MAX_DIGITS, MAX_SOURCE_BYTES};
use wavestep::problem::{Problem, ProblemError, Values, number};
use wavestep::scenes;
use wavestep_studies::picture::{self, PictureError};

/// A problem that says on standard error, when all is answered, what answers took for granted.
pub struct Asked(Problem);

impl Deref for Asked {
    type Target = Problem;

    fn deref(&self) -> &Problem {
        &self.0
    }
}

impl DerefMut for Asked {
    fn deref_mut(&mut self) -> &mut Problem {
        &mut self.0
    }
}

impl Drop for Asked {
    fn drop(&mut self) {
        for assumption in self.0.assumptions() {
            eprintln!("note: assuming that {assumption}");
        }
    }
}

/// Reads what the arguments name, with the values put in.
pub fn problem(arguments: &Scene) -> Result<Asked, Failure> {
    problem_with(&arguments.scene, &values(&arguments.set)?)
}

/// Reads a built-in scene or a file, with these values put in.
pub fn problem_with(scene: &str, values: &Values) -> Result<Asked, Failure> {
    let (name, bytes) = source(scene)?;
    Ok(Asked(Problem::of_text(&name, bytes, values)?))
}

/// What the text of a built-in scene or a file is called, and the text.
pub fn text(scene: &str) -> Result<(String, String), Failure> {
    let (name, bytes) = source(scene)?;
    let text = String::from_utf8(bytes).map_err(|_| {
        Failure::usage(format!("the scene `{scene}` is no text"), "save it as UTF-8")
    })?;
    Ok((name, text))
}

fn source(scene: &str) -> Result<(String, Vec<u8>), Failure> {
    if let Some(built_in) = told_built_in(scene) {
        return Ok((built_in.name.to_owned(), built_in.text.into()));
    }
    let bytes = bytes(scene, MAX_SOURCE_BYTES).map_err(|error| unread(scene, &error))?;
    Ok((scene.to_owned(), bytes))
}

/// The built-in scene of a name; says so where a file could be meant.
fn told_built_in(name: &str) -> Option<&'static scenes::Scene> {
    let scene = scenes::find(name)?;
    let file = format!("{name}.wave");
    if Path::new(&file).exists() {
        eprintln!("note: `{name}` is the built-in scene; for the file here write `{file}`");
    }
    Some(scene)
}

/// Whether there is a built-in scene or a file of this name.
pub fn is_scene(name: &str) -> bool {
    scenes::find(name).is_some() || Path::new(name).exists()
}

/// Why a scene is not read.
pub fn unread(scene: &str, error: &std::io::Error) -> Failure {
    let names: Vec<&str> = scenes::SCENES.iter().map(|scene| scene.name).collect();
    let is_file = scene.contains(['.', '/']);
    let here = if is_file { files_beside(Path::new(scene)) } else { Vec::new() };
    let built_in = || language::closest(scene.trim_end_matches(".wave"), names.iter().copied());
    let remedy = match (language::closest(scene, here.iter().map(String::as_str)), built_in()) {
        (Some(file), _) => format!("did you mean `{file}`?"),
        (None, Some(scene)) => format!("did you mean the built-in scene `{scene}`?"),
        (None, None) if is_file => {
            "name a file that exists, or a built-in scene: `wavestep scenes` lists them".to_owned()
        }
        (None, None) => format!("name a file, or a built-in scene: {}", names.join(", ")),
    };
    Failure::usage(format!("the scene `{scene}` cannot be read: {error}"), remedy)
}

/// The files in the folder of this one.
fn files_beside(file: &Path) -> Vec<String> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let listed = if folder == Path::new("") { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(listed).into_iter().flatten().flatten();
    let named =
        |entry: std::fs::DirEntry| folder.join(entry.file_name()).to_str().map(str::to_owned);
    entries.filter_map(named).collect()
}

pub fn built_in(name: &str) -> Result<&'static scenes::Scene, Failure> {
    scenes::find(name).ok_or_else(|| ProblemError::NotBuiltIn(name.to_owned()).into())
}

/// The costs in a file.
pub fn costs(file: &str) -> Result<Costs, Failure> {
    let remedy = "measure them with `wavestep chart --costs -o FILE`";
    let refused = |error: &dyn std::fmt::Display| {
        Failure::usage(format!("the costs in `{file}` cannot be read: {error}"), remedy)
    };
    let bytes = bytes(file, MAX_SOURCE_BYTES).map_err(|error| refused(&error))?;
    let text = String::from_utf8_lossy(&bytes);
    Costs::read(&text, file).map_err(|error| {
        Failure::usage(format!("the costs in `{file}` cannot be read, line {error}"), remedy)
    })
}

/// The bytes of a file; of a longer one, one byte more than `limit`, which is enough to see that.
pub fn bytes(name: &str, limit: usize) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let input: Box<dyn Read> = match name {
        "-" => Box::new(std::io::stdin().lock()),
        name => {
            let file = std::fs::File::open(name)?;
            read_files().extend(std::fs::canonicalize(name));
            Box::new(file)
        }
    };
    input.take(limit as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The window that is asked for, to the usual end where none is given.
pub fn window(
    problem: &Problem,
    from: &str,
    to: Option<&str>,
) -> Result<[BigRational; 2], ProblemError> {
    let from = problem.time("--from", from)?;
    let to = to.map(|to| problem.time("--to", to)).transpose()?;
    picture::window(problem, from, to).map_err(|error| match error {
        PictureError::Problem(error) => *error,
        _ => ProblemError::NoEnd,
    })
}

/// A number of significant digits that can be certified.
pub fn digits(digits: usize) -> Result<usize, Failure> {
    if digits == 0 || digits > MAX_DIGITS {
        let message = format!("{digits} significant digits cannot be certified");
        return Err(Failure::usage(message, format!("give 1 to {MAX_DIGITS} digits")));
    }
    Ok(digits)
}

/// The values that `--set` gives, by name.
pub fn values(settings: &[String]) -> Result<Values, Failure> {
    let mut values = Values::new();
    for setting in settings {
        let (name, value) = setting.split_once('=').unwrap_or((setting, ""));
        let name = name.trim();
        if name.is_empty() {
            let message = format!("`--set {setting}` names no symbol");
            return Err(Failure::usage(message, "write --set NAME=VALUE"));
        }
        if value.trim().is_empty() {
            let message = format!("`--set {setting}` has no value");
            return Err(Failure::usage(message, format!("write --set {name}=1")));
        }
        let value = number(&format!("--set {name}"), value)?;
        // A Greek letter is normalised in the same way as in a scene.
        let name = language::normalise_name(name);
        if values.insert(name.clone(), value).is_some() {
            return Err(two_values(&name));
        }
    }
    Ok(values)
}

/// Why a symbol with two values is refused.
pub fn two_values(name: &str) -> Failure {
    let message = format!("two values are given for `{name}`");
    Failure::usage(message, "give each symbol one value")
}
