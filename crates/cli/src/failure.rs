//! Failures with their exit codes.

use super::diagnostic::{Style, render};
use wavestep::answer::WayError;
use wavestep::evaluate::{EvaluateError, MethodError};
use wavestep::expression::NotInvertible;
use wavestep::field::FieldError;
use wavestep::language::Diagnostic;
use wavestep::model::ModelError;
use wavestep::network::NetworkError;
use wavestep::signal::SignalError;
use wavestep::solution::{SolveError, Unsolvable};
use wavestep_draw::PlotError;
use wavestep_studies::picture::PictureError;

/// Exit code: could not compute, or not as locked.
pub const COMPUTATION: u8 = 1;
/// Exit code: usage, or a bad scene.
pub const USAGE: u8 = 2;
/// Exit code: accuracy not reached.
pub const ACCURACY: u8 = 3;

/// Why the command ends without a result.
pub enum Failure {
    /// The text of a scene or a number is at fault.
    Text(Diagnostic),
    /// The text of a scene is at fault in several places.
    Texts(Vec<Diagnostic>),
    /// What is asked for is at fault: what is wrong, and the remedy.
    Usage(String, String),
    /// It cannot be computed: what, and the remedy.
    Computation(String, String),
    /// The accuracy asked for is not reached: what, and the remedy.
    Accuracy(String, String),
    /// Some of what is asked for stays undecided.
    Undecided {
        /// What is known, for standard output.
        report: String,
        /// What is not.
        message: String,
        /// The remedy.
        remedy: String,
    },
    /// What is derived differs from what is locked.
    Difference {
        /// What differs, for standard output.
        report: String,
        /// What was compared.
        message: String,
        /// The remedy.
        remedy: String,
    },
}

impl Failure {
    /// The exit code.
    pub fn code(&self) -> u8 {
        match self {
            Failure::Text(_) | Failure::Texts(_) | Failure::Usage(..) => USAGE,
            Failure::Computation(..) | Failure::Difference { .. } => COMPUTATION,
            Failure::Accuracy(..) | Failure::Undecided { .. } => ACCURACY,
        }
    }

    /// What is shown to the person.
    pub fn render(&self, style: Style) -> String {
        match self {
            Failure::Text(diagnostic) => render(diagnostic, style).trim_end().to_owned(),
            Failure::Texts(diagnostics) => {
                let rendered =
                    diagnostics.iter().map(|one| render(one, style).trim_end().to_owned());
                rendered.collect::<Vec<_>>().join("\n\n")
            }
            Failure::Usage(message, remedy)
            | Failure::Computation(message, remedy)
            | Failure::Accuracy(message, remedy)
            | Failure::Undecided { message, remedy, .. }
            | Failure::Difference { message, remedy, .. } => {
                format!("error: {message}\nhelp: {remedy}")
            }
        }
    }

    /// The same failure with another remedy, where it has one to replace.
    pub fn with_remedy(self, remedy: &str) -> Failure {
        let remedy = remedy.to_owned();
        match self {
            Failure::Usage(message, _) => Failure::Usage(message, remedy),
            Failure::Computation(message, _) => Failure::Computation(message, remedy),
            Failure::Accuracy(message, _) => Failure::Accuracy(message, remedy),
            other => other,
        }
    }

    /// A fault of usage.
    pub fn usage(message: impl Into<String>, remedy: impl Into<String>) -> Failure {
        Failure::Usage(message.into(), remedy.into())
    }
}

impl From<Diagnostic> for Failure {
    fn from(diagnostic: Diagnostic) -> Failure {
        Failure::Text(diagnostic)
    }
}

impl From<SolveError> for Failure {
    fn from(error: SolveError) -> Failure {
        let remedy = match &error.reason {
            Unsolvable::NotInvertible(NotInvertible::Undeclared(factor)) => {
                format!("give values with --set, or state `nonzero {factor}` in the scene")
            }
            Unsolvable::DegreeTooHigh => "ask for a smaller order".to_owned(),
            _ => "give values with --set".to_owned(),
        };
        Failure::Computation(error.to_string(), remedy)
    }
}

impl From<NetworkError> for Failure {
    fn from(error: NetworkError) -> Failure {
        let remedy = match &error {
            NetworkError::Incommensurate => {
                "ask `derive` for echoes in order of their arrival, with --form echo, or `eval` for values"
            }
            NetworkError::Unobservable { .. } => "observe it at another place",
            NetworkError::Rates { .. } => {
                "give values with --set; or state the elements by their rates a and b, or sigma and \
                 omega, as docs/scene-language.md shows"
            }
            NetworkError::NotLinear(_) => "ask for values, with `eval`",
            NetworkError::Recurrence(_) => {
                "what has no mass cannot be forced or held against a spring or a moving bar: put a \
                 mass there"
            }
            _ => "give values with --set",
        };
        Failure::Computation(error.to_string(), remedy.to_owned())
    }
}

impl From<EvaluateError> for Failure {
    fn from(error: EvaluateError) -> Failure {
        let message = error.to_string();
        match error {
            EvaluateError::MissingValue(symbol) => {
                Failure::usage(message, format!("give it one: --set {symbol}=1"))
            }
            EvaluateError::TooManyPeriods { .. } | EvaluateError::TooManyEchoes { .. } => {
                Failure::Computation(message, "ask for an earlier time".to_owned())
            }
            EvaluateError::NotLinear(_) => {
                let remedy = "ask for a force or a velocity, or for digits: `eval` without --tol and --method";
                Failure::Computation(message, remedy.to_owned())
            }
            EvaluateError::EmptyWindow => Failure::usage(message, "give --from before --to"),
            EvaluateError::TooManyRoots { .. } | EvaluateError::TooManyCells { .. } => {
                Failure::Computation(message, "ask for a shorter window".to_owned())
            }
            EvaluateError::NotReal => {
                let remedy = "observe a wave in which both poles of each complex pair occur";
                Failure::Computation(message, remedy.to_owned())
            }
            EvaluateError::Solve(error) => error.into(),
            EvaluateError::Network(error) => (*error).into(),
            EvaluateError::AccuracyNotReached { .. } => {
                Failure::Accuracy(message, "raise --max-bits, or ask for fewer digits".to_owned())
            }
            _ => Failure::Computation(message, "ask for an earlier time".to_owned()),
        }
    }
}

impl From<SignalError> for Failure {
    fn from(error: SignalError) -> Failure {
        match error {
            SignalError::Closed(error) => error.into(),
            SignalError::Followed(error) => error.into(),
        }
    }
}

impl From<FieldError> for Failure {
    fn from(error: FieldError) -> Failure {
        match error {
            FieldError::Evaluate(error) => error.into(),
            FieldError::Undecided { .. } => {
                Failure::Accuracy(error.to_string(), "give another time, or other cells".to_owned())
            }
            error => Failure::usage(error.to_string(), "see `wavestep field --help`"),
        }
    }
}

impl From<PictureError> for Failure {
    fn from(error: PictureError) -> Failure {
        match error {
            PictureError::Evaluate(error) => error.into(),
            PictureError::Field(error) => error.into(),
            PictureError::Plot(error) => error.into(),
            error => Failure::usage(error.to_string(), "see `wavestep plot --help`"),
        }
    }
}

impl From<PlotError> for Failure {
    fn from(error: PlotError) -> Failure {
        let message = error.to_string();
        match error {
            PlotError::NotDrawn(_) => Failure::usage(message, "give another --width"),
            _ => Failure::Computation(message, "choose another quantity or window".to_owned()),
        }
    }
}

impl From<WayError> for Failure {
    fn from(error: WayError) -> Failure {
        let message = error.to_string();
        let remedy = match error {
            WayError::Method(MethodError::Evaluate(error)) => return error.into(),
            WayError::Method(MethodError::NoTaps(_)) => "use --method compiled or certified",
            WayError::Method(_) => "ask for a shorter window, or use --method certified",
            WayError::Model(ModelError::MissingValue(symbol)) => {
                return Failure::usage(message, format!("give it one: --set {symbol}=1"));
            }
            WayError::Model(_) => "use another model, or a method on the exact solution",
            WayError::NeedsRecurrence(_) => "leave out --method, or ask for `--method steps:1e-10`",
            WayError::NeedsScene(_) => "describe it by its parts: see docs/scene-language.md",
            WayError::LeftLimit(_) => "leave out --side left",
        };
        Failure::Computation(message, remedy.to_owned())
    }
}
