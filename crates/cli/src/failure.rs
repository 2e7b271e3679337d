//! Failures with their exit codes, as they are shown.

use super::diagnostic::{Style, render};
use super::output::plural;
use std::fmt;
use std::io::{self, IsTerminal as _, Write as _};
use wavestep::Error;
use wavestep::answer::WayError;
use wavestep::expression::NotInvertible;
use wavestep::field::FieldError;
use wavestep::language::Diagnostic;
use wavestep::network::NetworkError;
use wavestep::problem::{LockRefusal, ProblemError};
use wavestep::signal::{EvaluateError, MethodError};
use wavestep::solution::Unsolvable;
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
    /// The library has no answer; a remedy other than its own.
    Unanswered(Error, Option<String>),
    /// The command says itself what is wrong.
    Told {
        code: u8,
        message: String,
        remedy: String,
        /// What is known all the same, for standard output.
        report: String,
    },
}

impl Failure {
    pub fn new(code: u8, message: impl Into<String>, remedy: impl Into<String>) -> Failure {
        let (message, remedy, report) = (message.into(), remedy.into(), String::new());
        Failure::Told { code, message, remedy, report }
    }

    /// What is asked for is at fault.
    pub fn usage(message: impl Into<String>, remedy: impl Into<String>) -> Failure {
        Failure::new(USAGE, message, remedy)
    }

    /// The same failure with what is known all the same.
    pub fn with_report(mut self, known: String) -> Failure {
        if let Failure::Told { report, .. } = &mut self {
            *report = known;
        }
        self
    }

    pub fn with_remedy(mut self, other: &str) -> Failure {
        match &mut self {
            Failure::Unanswered(_, remedy) => *remedy = Some(other.to_owned()),
            Failure::Told { remedy, .. } => other.clone_into(remedy),
        }
        self
    }

    pub fn code(&self) -> u8 {
        match self {
            Failure::Unanswered(error, _) if error.is_bad_input() => USAGE,
            Failure::Unanswered(error, _) if error.is_accuracy_not_reached() => ACCURACY,
            Failure::Unanswered(..) => COMPUTATION,
            Failure::Told { code, .. } => *code,
        }
    }

    /// Shows it on standard error.
    pub fn show(&self) {
        let coloured = io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
        let style = if coloured { Style::Coloured } else { Style::Plain };
        let _ = writeln!(io::stderr(), "{}", self.render(style));
    }

    /// What is shown to the person.
    pub fn render(&self, style: Style) -> String {
        let (red, green, plain) = match style {
            Style::Coloured => ("\x1b[1;31m", "\x1b[1;32m", "\x1b[0m"),
            Style::Plain => ("", "", ""),
        };
        let told = |message: &str, remedy: &str| {
            format!("{red}error{plain}: {message}\n{green}help{plain}: {remedy}")
        };
        match self {
            Failure::Unanswered(error, _) if !error.diagnostics().is_empty() => {
                let rendered = error.diagnostics().iter().map(|one| render(one, style));
                rendered.map(|one| one.trim_end().to_owned()).collect::<Vec<_>>().join("\n\n")
            }
            Failure::Unanswered(error, remedy) => {
                let own = || in_options(error.cause()).or_else(|| error.remedy());
                match remedy.clone().or_else(own) {
                    Some(remedy) => told(&error.to_string(), &remedy),
                    None => format!("{red}error{plain}: {error}"),
                }
            }
            Failure::Told { message, remedy, .. } => told(message, remedy),
        }
    }
}

/// What was found, as a failure where some of it stays undecided.
pub fn settled(
    report: String,
    (undecided, what): (usize, &str),
    remedy: &str,
) -> Result<String, Failure> {
    if undecided == 0 {
        return Ok(report);
    }
    let stay = if undecided == 1 { "stays" } else { "stay" };
    let message = format!("{} {stay} undecided", plural(undecided, what));
    Err(Failure::new(ACCURACY, message, remedy).with_report(report))
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Unanswered(error, _) => write!(f, "{error}"),
            Failure::Told { message, .. } => f.write_str(message),
        }
    }
}

impl From<ProblemError> for Failure {
    fn from(error: ProblemError) -> Failure {
        Failure::Unanswered(error.into(), None)
    }
}

/// Errors of layers beneath, which a problem hands on.
macro_rules! handed_on {
    ($($error:ty),*) => {$(
        impl From<$error> for Failure {
            fn from(error: $error) -> Failure {
                ProblemError::from(error).into()
            }
        }
    )*};
}

handed_on!(Diagnostic, EvaluateError, FieldError, WayError);

impl From<PictureError> for Failure {
    fn from(error: PictureError) -> Failure {
        match error {
            PictureError::Problem(error) => (*error).into(),
            PictureError::NothingObserved => {
                Failure::usage(error.to_string(), "give --quantity NAME")
            }
            PictureError::TooLarge(_) => {
                Failure::new(COMPUTATION, error.to_string(), error.remedy())
            }
            PictureError::Plot(error) => error.into(),
            error => Failure::usage(error.to_string(), error.remedy()),
        }
    }
}

impl From<PlotError> for Failure {
    fn from(error: PlotError) -> Failure {
        let message = error.to_string();
        match error {
            PlotError::NotDrawn(_) => Failure::usage(message, "choose another --width"),
            _ => Failure::new(COMPUTATION, message, "choose another quantity or window"),
        }
    }
}

/// The remedy, where it takes options or subcommands of this program.
fn in_options(cause: &ProblemError) -> Option<String> {
    if let Some(symbol) = cause.missing_value() {
        return Some(format!("set it: --set {symbol}=1"));
    }
    Some(match cause {
        ProblemError::Solve(error) => match &error.reason {
            Unsolvable::NotInvertible(NotInvertible::Undeclared(factor)) => {
                format!("{VALUES}, or state `nonzero {factor}` in the scene")
            }
            Unsolvable::DegreeTooHigh => return None,
            _ => VALUES.to_owned(),
        },
        ProblemError::LocalContact { spring, .. } => {
            format!("compute values with `eval`, or replace it by a spring: {spring}")
        }
        ProblemError::EnergyHasNoPieces(name) | ProblemError::ProductsHaveNoPieces(name) => {
            format!("evaluate it: wavestep eval SCENE --quantity {name} --at T")
        }
        ProblemError::NoNumber(name) => format!("write a number such as {name} 33/10"),
        ProblemError::OutsidePeriod(times) => {
            let period = &times[1];
            format!("give 0 <= S < {period}, or S = {period} with --side left")
        }
        cause => usual(cause)?.to_owned(),
    })
}

/// The same where it depends on nothing but the variant.
fn usual(cause: &ProblemError) -> Option<&'static str> {
    Some(match cause {
        ProblemError::Network(error) => for_network(error)?,
        ProblemError::Evaluate(error) => for_evaluate(error)?,
        ProblemError::Way(error) => for_way(error)?,
        ProblemError::NoLock(refusal) => for_lock(refusal)?,
        ProblemError::EmptyWindow(_) => WINDOW,
        ProblemError::Field(error) => match &**error {
            FieldError::Undecided { .. } => return None,
            _ => "see `wavestep field --help`",
        },
        ProblemError::ModelOfLocalContact(error) if error.is_of_measure() => "remove --method",
        ProblemError::ModelOfLocalContact(_) => STEPS,
        ProblemError::NoClosedForm { .. } => {
            "compute values with `eval`, which works for every line"
        }
        ProblemError::NoCommonPeriods(_) => "evaluate it with `wavestep eval`, or derive its waves",
        ProblemError::UnknownOrder(_) => {
            "give values with --set, or evaluate it with `wavestep eval`"
        }
        ProblemError::NoPeriodsToExplain => "derive its echoes: remove --explain",
        ProblemError::NoEchoesToExplain => "explain its pieces: remove --form echo",
        ProblemError::NothingArrives(_) => "choose a larger --through",
        ProblemError::NoGeneralForm { symbol: Some(_), .. } => {
            "choose single orders with --through or --piece; if a factor may vanish, \
             stating `nonzero …` can help"
        }
        ProblemError::NoGeneralForm { symbol: None, .. } => {
            "choose single orders with --through or --piece"
        }
        ProblemError::NoPeriods(_)
        | ProblemError::NoPeriodsWhereContactsOpen
        | ProblemError::NoPeriodsWithLocalContact(_) => "give --at T, or --from, --to and --points",
        ProblemError::NoEnd => "give --to T",
        ProblemError::TooManyTerms(_) => {
            "choose a smaller order, one wave, one piece, or --form echo"
        }
        ProblemError::TooManyEchoes { .. } => "choose a smaller --through, or one wave",
        ProblemError::EchoesOfObservable(_) => "derive the waves with --form echo",
        ProblemError::NoCommonMeasure(_) => {
            "derive the echoes of a wave with --quantity WAVE and --through N (`derive` without options lists the waves), \
             or evaluate"
        }
        ProblemError::NoSourceForm => {
            "add a statement such as `written f in V/c, s as mu*z/L`, or remove --source-form"
        }
        _ => return None,
    })
}

fn for_network(error: &NetworkError) -> Option<&'static str> {
    Some(match error {
        NetworkError::Incommensurate => {
            "use `derive --form echo` for echoes in order of arrival, or `eval` for values"
        }
        NetworkError::Rates { .. } => {
            "compute values with `eval`, which works with any rates; or state the elements by their rates a \
             and b, or sigma and omega, as docs/scene-language.md shows"
        }
        NetworkError::NotLinear(_) | NetworkError::Apart(_) => {
            "compute values with `eval`: its methods certified, compiled and steps support such scenes"
        }
        NetworkError::Division(_) => VALUES,
        _ => return None,
    })
}

fn for_evaluate(error: &EvaluateError) -> Option<&'static str> {
    Some(match error {
        EvaluateError::AccuracyNotReached { .. } => {
            "raise --max-bits, or ask for one digit more or fewer: the value may lie too close to a rounding boundary"
        }
        EvaluateError::EmptyWindow => WINDOW,
        _ => return None,
    })
}

fn for_way(error: &WayError) -> Option<&'static str> {
    Some(match error {
        WayError::Method(MethodError::NoTaps(_) | MethodError::Cancels(_)) => {
            "use --method compiled or certified"
        }
        WayError::Method(_) => "use a shorter window, or --method certified",
        WayError::NeedsRecurrence(_) => STEPS,
        WayError::LeftLimit(_) => "remove --side left",
        WayError::NoNumber(..) | WayError::TooSmall(_) | WayError::NotMet { .. } => {
            "compute digits instead: --digits 25"
        }
        _ => return None,
    })
}

fn for_lock(refusal: &LockRefusal) -> Option<&'static str> {
    Some(match refusal {
        LockRefusal::PeriodsWhereContactsOpen => {
            "remove --through: events are locked, until --to T"
        }
        LockRefusal::NoEvents => "give --through N for pieces and --at T for values",
        LockRefusal::NoLastPeriod => "give --through N, for the periods 0 … N, or --at T",
        LockRefusal::PiecesLocked | LockRefusal::EventsLocked => return None,
    })
}

const VALUES: &str = "give values with --set";
const WINDOW: &str = "give --from before --to";
const STEPS: &str = "remove --method, or use `--method steps:1e-10`";
