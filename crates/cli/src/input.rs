//! What the arguments point at: scenes, values, times.

use super::arguments::Scene;
use super::eval_contact;
use super::failure::Failure;
use num_rational::BigRational;
use num_traits::Signed as _;
use std::collections::BTreeMap;
use std::io::Read as _;
use wavestep::language::{self, Source};
use wavestep::limits::{MAX_DIGITS, MAX_SOURCE_BYTES};
use wavestep::network::{Network, ScaledScene};
use wavestep::recurrence::Recurrence;
use wavestep::scene::Dimension;
use wavestep::scenes;

/// What a text states: equations between periods, or a line of bars and what they are joined by.
pub enum Subject {
    /// A recurrence.
    Recurrence(Box<Recurrence>),
    /// A scene, as a network.
    Scene(Box<Network>),
}

/// What can be read: a subject, or a scene with a local contact, of which models alone are made.
pub enum Readable {
    /// What has a recurrence.
    Subject(Subject),
    /// A scene in its own scales.
    WithoutRecurrence(Box<ScaledScene>),
}

impl Subject {
    /// Refuses a scene whose contacts open, which some commands cannot follow.
    pub fn with_closed_contacts(self, command: &str) -> Result<Subject, Failure> {
        match &self {
            Subject::Scene(network) if network.scene().contacts_open => {
                let message = format!("contacts that open are not followed by `{command}`");
                let remedy = "leave `contacts open` out of the scene, or use `events`, `eval` with --digits, `find` or `plot`";
                Err(Failure::usage(message, remedy))
            }
            _ => Ok(self),
        }
    }

    /// The recurrence, stated or derived.
    pub fn into_recurrence(self) -> Result<Recurrence, Failure> {
        match self {
            Subject::Recurrence(recurrence) => Ok(*recurrence),
            Subject::Scene(network) => Ok(network.recurrence()?),
        }
    }
}

/// Reads the scene that the arguments name, with the values put in.
pub fn subject(arguments: &Scene) -> Result<Subject, Failure> {
    subject_with(&arguments.scene, &values(&arguments.set)?)
}

/// Reads what the arguments name, with the values put in, be it linear or not.
pub fn readable(arguments: &Scene) -> Result<Readable, Failure> {
    readable_with(&arguments.scene, &values(&arguments.set)?)
}

/// Reads a scene with these values put in.
pub fn subject_with(
    scene: &str,
    values: &BTreeMap<String, BigRational>,
) -> Result<Subject, Failure> {
    match readable_with(scene, values)? {
        Readable::Subject(subject) => Ok(subject),
        Readable::WithoutRecurrence(scaled) => Err(eval_contact::refused(&scaled)),
    }
}

fn readable_with(scene: &str, values: &BTreeMap<String, BigRational>) -> Result<Readable, Failure> {
    let source = source(scene)?;
    match language::kind(&source) {
        language::Kind::Recurrence => {
            let recurrence = language::read_recurrence(&source, values)?;
            Ok(Readable::Subject(Subject::Recurrence(Box::new(recurrence))))
        }
        language::Kind::Scene => {
            let scene = language::read_scene(&source, values).map_err(Failure::Texts)?;
            let scaled = ScaledScene::of(&scene)?;
            Ok(match scaled.local_contact() {
                Some(_) => Readable::WithoutRecurrence(Box::new(scaled)),
                None => Readable::Subject(Subject::Scene(Box::new(scaled.network()?))),
            })
        }
    }
}

/// The built-in scene called `name`.
pub fn built_in(name: &str) -> Result<&'static scenes::Scene, Failure> {
    scenes::find(name).ok_or_else(|| {
        let names: Vec<&str> = scenes::SCENES.iter().map(|scene| scene.name).collect();
        let remedy = format!("the built-in scenes are {}", names.join(", "));
        Failure::usage(format!("there is no built-in scene `{name}`"), remedy)
    })
}

fn source(name: &str) -> Result<Source, Failure> {
    if let Some(scene) = scenes::find(name) {
        return Ok(Source::new(scene.name, scene.text)?);
    }
    let bytes = bytes(name, MAX_SOURCE_BYTES).map_err(|error| {
        let names: Vec<&str> = scenes::SCENES.iter().map(|scene| scene.name).collect();
        let remedy = match language::closest(name, names.iter().copied()) {
            Some(scene) => format!("did you mean the built-in scene `{scene}`?"),
            None => format!("name a file, or a built-in scene: {}", names.join(", ")),
        };
        Failure::usage(format!("the scene `{name}` cannot be read: {error}"), remedy)
    })?;
    Ok(Source::new(name, bytes)?)
}

/// The bytes of a file; of a longer one, one byte more than `limit`, which is enough to see that.
pub fn bytes(name: &str, limit: usize) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    std::fs::File::open(name)?.take(limit as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// A number of significant digits that can be certified.
pub fn digits(digits: usize) -> Result<usize, Failure> {
    if digits == 0 || digits > MAX_DIGITS {
        let message = format!("{digits} significant digits cannot be certified");
        return Err(Failure::usage(message, format!("ask for 1 to {MAX_DIGITS} digits")));
    }
    Ok(digits)
}

/// The values that `--set` gives, by name.
pub fn values(settings: &[String]) -> Result<BTreeMap<String, BigRational>, Failure> {
    let mut values = BTreeMap::new();
    for setting in settings {
        let (name, value) = setting.split_once('=').unwrap_or((setting, ""));
        let name = name.trim();
        if name.is_empty() {
            let message = format!("`--set {setting}` names no symbol");
            return Err(Failure::usage(message, "write --set NAME=VALUE"));
        }
        if value.trim().is_empty() {
            let message = format!("`--set {setting}` gives no value");
            return Err(Failure::usage(message, format!("write --set {name}=1")));
        }
        let value = number(&format!("--set {name}"), value)?;
        // A Greek letter is normalised in the same way as in a scene.
        let name = language::normalise_name(name);
        if values.insert(name.clone(), value).is_some() {
            let message = format!("two values are given for `{name}`");
            return Err(Failure::usage(message, "give each symbol one value"));
        }
    }
    Ok(values)
}

/// Reads a scene time given as this argument; in seconds for scenes with units.
pub fn time(argument: &str, text: &str, dimensional: bool) -> Result<BigRational, Failure> {
    let time = match dimensional {
        true => language::read_quantity(&Source::new(argument, text)?, Dimension::TIME)?,
        false => number(argument, text)?,
    };
    if time.is_negative() {
        let message = format!("the time {time} lies before the start");
        return Err(Failure::usage(message, "give times from 0 on"));
    }
    Ok(time)
}

/// Reads an exact number given as this argument.
pub fn number(argument: &str, text: &str) -> Result<BigRational, Failure> {
    if text.trim().is_empty() {
        let remedy = format!("write a number such as {argument} 33/10");
        return Err(Failure::usage(format!("`{argument}` gives no number"), remedy));
    }
    Ok(language::read_number(&Source::new(argument, text)?)?)
}
