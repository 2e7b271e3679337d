//! Errors of the library as exceptions, with place and remedy.

use pyo3::prelude::*;
use wavestep::{Diagnostic, Error};
use wavestep_studies::picture::PictureError;

/// Why there is no answer.
pub enum Failure {
    Library(Error),
    /// What was given is at fault.
    Input {
        message: String,
        remedy: String,
    },
    /// There is no picture.
    Picture {
        message: String,
        remedy: &'static str,
    },
    /// A bug.
    Internal(String),
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Failure {
        Failure::Library(error.into())
    }
}

/// Why there is no picture.
pub fn of_picture(error: PictureError) -> Failure {
    match error {
        PictureError::Problem(error) => Failure::Library((*error).into()),
        error => Failure::Picture { message: error.to_string(), remedy: error.remedy() },
    }
}

impl Failure {
    /// What is wrong with what was given, and what to do about it.
    pub fn input(message: impl Into<String>, remedy: impl Into<String>) -> Failure {
        Failure::Input { message: message.into(), remedy: remedy.into() }
    }

    /// The exception.
    pub fn raised(self, py: Python<'_>) -> PyErr {
        self.exception(py).unwrap_or_else(|error| error)
    }

    fn exception(self, py: Python<'_>) -> PyResult<PyErr> {
        let none = Vec::new();
        let (class, message, remedy, places) = match self {
            Failure::Input { message, remedy } => ("InputError", message, Some(remedy), none),
            Failure::Picture { message, remedy } => {
                ("UnsupportedError", message, Some(remedy.to_owned()), none)
            }
            Failure::Internal(message) => {
                let message = format!("wavestep failed: {message}");
                let remedy = "please report it, with the scene: it is a bug in wavestep".to_owned();
                ("InternalError", message, Some(remedy), none)
            }
            Failure::Library(error) => {
                let places = error.diagnostics().iter().map(|place| diagnostic(py, place));
                let places = places.collect::<PyResult<Vec<_>>>()?;
                // The library knows how the command is told.
                let raise =
                    |told: String| told.replace("raise --memory", "allow more with set_memory(…)");
                (class(&error), error.to_string(), error.remedy().map(raise), places)
            }
        };
        let class = py.import("wavestep._errors")?.getattr(class)?;
        Ok(PyErr::from_value(class.call1((message, remedy, places))?))
    }
}

fn class(error: &Error) -> &'static str {
    if error.is_accuracy_not_reached() {
        "AccuracyError"
    } else if error.is_too_much_work() {
        "WorkError"
    } else if error.is_not_supported() {
        "UnsupportedError"
    } else if error.is_undefined() {
        "UndefinedError"
    } else {
        "InputError"
    }
}

/// What is wrong in a text, with its line.
fn diagnostic<'py>(py: Python<'py>, found: &Diagnostic) -> PyResult<Bound<'py, PyAny>> {
    let (text, span) = (found.source().text(), found.span());
    let before = &text[..span.start];
    let begin = before.rfind('\n').map_or(0, |end| end + 1);
    let line = text[begin..].lines().next().unwrap_or_default();
    let marked = text[span.start..span.end].lines().next().unwrap_or_default();
    let class = py.import("wavestep._errors")?.getattr("Diagnostic")?;
    class.call1((
        found.source().name(),
        before.matches('\n').count() + 1,
        before[begin..].chars().count() + 1,
        marked.chars().count().max(1),
        line,
        found.message(),
        found.label(),
        found.remedy(),
    ))
}
