//! Failures with their exit codes.

use super::diagnostic::{Style, render};
use wavestep::answer::WayError;
use wavestep::evaluate::{EvaluateError, MethodError};
use wavestep::expression::NotInvertible;
use wavestep::field::FieldError;
use wavestep::language::{Diagnostic, closest};
use wavestep::lock::LockError;
use wavestep::model::ModelError;
use wavestep::network::NetworkError;
use wavestep::problem::{EqualError, LockRefusal, ProblemError};
use wavestep::scenes::SCENES;
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

    /// Why a command has no answer that does not follow contacts that open.
    pub fn not_followed(error: ProblemError, command: &str) -> Failure {
        let ProblemError::ContactsOpen = error else { return error.into() };
        let message = format!("contacts that open are not followed by `{command}`");
        let remedy = "leave `contacts open` out of the scene, or use `events`, `eval` with --digits, `find` or `plot`";
        Failure::usage(message, remedy)
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

impl From<ProblemError> for Failure {
    fn from(error: ProblemError) -> Failure {
        let message = error.to_string();
        let remedy = match error {
            ProblemError::Text(diagnostics) => return Failure::Texts(diagnostics),
            ProblemError::Network(error) => return error.into(),
            ProblemError::Solve(error) => return error.into(),
            ProblemError::Evaluate(error) => return (*error).into(),
            ProblemError::History(error) => return error.into(),
            ProblemError::Field(error) => return (*error).into(),
            ProblemError::Way(error) => return (*error).into(),
            ProblemError::NoProof(..) => {
                let remedy = "ask for tested values, as in `--method steps:1e-10`";
                return Failure::Accuracy(message, remedy.to_owned());
            }
            ProblemError::NoDigits(_) => {
                let remedy = "leave out --digits; finer values are had by `--method steps:1e-13`";
                return Failure::Accuracy(message, remedy.to_owned());
            }
            ProblemError::Undecided { .. } => {
                return Failure::Accuracy(message, "ask for fewer digits".to_owned());
            }
            ProblemError::LocalContact { contact, spring } => {
                let spring = match spring {
                    Some(spring) => format!("the equivalent one is `{spring}`"),
                    None => format!("`spring {contact} {{ stiffness = … }}`"),
                };
                let remedy =
                    format!("ask for values, with `eval`, or put a spring in its place: {spring}");
                return Failure::Computation(message, remedy);
            }
            ProblemError::ModelOfLocalContact(_) => {
                let remedy = "leave out --method, or ask for `--method steps:1e-10`";
                return Failure::Computation(message, remedy.to_owned());
            }
            ProblemError::NotBuiltIn(_) => {
                let names: Vec<&str> = SCENES.iter().map(|scene| scene.name).collect();
                format!("the built-in scenes are {}", names.join(", "))
            }
            ProblemError::Unknown { name, names } => {
                match closest(&name, names.iter().map(String::as_str)) {
                    Some(name) => format!("did you mean `{name}`?"),
                    None => format!("ask for one of {}", names.join(", ")),
                }
            }
            ProblemError::NotAWave { waves, .. } => {
                format!("the waves of this scene are {}", waves.join(", "))
            }
            ProblemError::NotAnObservable { observables, .. } => match &observables[..] {
                [] => "this scene has no observables: derive its waves".to_owned(),
                names => format!("the observables of this scene are {}", names.join(", ")),
            },
            ProblemError::ObservableIsNoWave(name) => {
                format!("it is an observable: ask for --observable {name}")
            }
            ProblemError::EnergyHasNoPieces(name) => {
                let remedy = format!("evaluate it: wavestep eval SCENE --quantity {name} --at T");
                return Failure::Computation(message, remedy);
            }
            ProblemError::NoCommonPeriods(_) => {
                let remedy = "evaluate it with `wavestep eval`, or derive its waves";
                return Failure::Computation(message, remedy.to_owned());
            }
            ProblemError::UnknownOrder(_) => {
                let remedy = "give values with --set, or evaluate it with `wavestep eval`";
                return Failure::Computation(message, remedy.to_owned());
            }
            ProblemError::NoPeriodsToExplain => {
                let remedy = "derive its echoes: leave out --explain";
                return Failure::Computation(message, remedy.to_owned());
            }
            ProblemError::NothingArrives(_) => {
                let remedy = "ask for a larger --through";
                return Failure::Computation(message, remedy.to_owned());
            }
            ProblemError::NoGeneralForm { symbol, .. } => {
                let remedy = match symbol {
                    Some(_) => {
                        "ask for single orders, with --through or --piece; where a factor of symbols \
                         may vanish, stating `nonzero …` can help"
                    }
                    None => "ask for single orders, with --through or --piece",
                };
                return Failure::Computation(message, remedy.to_owned());
            }
            ProblemError::Rates { .. } => {
                let remedy = "evaluate it, which works with any certified rates; or give values for which \
                              the rates are rational, or roots of one quadratic in rational numbers";
                return Failure::Computation(message, remedy.to_owned());
            }
            ProblemError::Disagreement(..) => {
                let remedy = "please report this scene: it is a fault of wavestep";
                return Failure::Computation(message, remedy.to_owned());
            }
            ProblemError::Equal(error) => remedy_of_equal(&error),
            ProblemError::NoLock(refusal) => remedy_of_lock(&refusal).to_owned(),
            ProblemError::Lock(error) => match *error {
                LockError::Solve(error) => return error.into(),
                LockError::History(error) => return error.into(),
                LockError::Evaluate(EvaluateError::AccuracyNotReached { .. })
                | LockError::AccuracyNotReached(_) => {
                    return Failure::Accuracy(message, "ask for fewer digits".to_owned());
                }
                LockError::Evaluate(error) => return error.into(),
                _ => "ask for fewer digits".to_owned(),
            },
            ProblemError::NoNumber(name) => format!("write a number such as {name} 33/10"),
            ProblemError::OutsidePeriod(times) => {
                let [_, period] = &*times;
                format!("give 0 <= S < {period}, or S = {period} with --side left")
            }
            ProblemError::BeforeStart(_) => "give times from 0 on".to_owned(),
            ProblemError::EmptyWindow(_) => "give --from before --to".to_owned(),
            ProblemError::WaveOfClosedContacts(_) => {
                "ask for an observable, or leave out `contacts open`".to_owned()
            }
            ProblemError::Equations(_) => {
                "describe it by its parts: see docs/scene-language.md".to_owned()
            }
            ProblemError::NoPeriods(_)
            | ProblemError::NoPeriodsWhereContactsOpen
            | ProblemError::NoPeriodsWithLocalContact(_) => {
                "give --at T, or --from, --to and --points".to_owned()
            }
            ProblemError::EquationsHaveNoContacts => {
                "describe it by its parts: see docs/scene-language.md".to_owned()
            }
            ProblemError::NoContact => "write `|` in its line where bodies only touch".to_owned(),
            ProblemError::NoEnd => "give --to T".to_owned(),
            ProblemError::TooManyTerms(_) => {
                "ask for a smaller order, one wave, one piece, or --form echo".to_owned()
            }
            ProblemError::TooManyEchoes { .. } => {
                "ask for a smaller --through, or one wave".to_owned()
            }
            ProblemError::EchoesOfObservable(_) => "derive the waves with --form echo".to_owned(),
            ProblemError::NoCommonMeasure(_) => {
                "ask for the echoes of waves, with --wave NAME and --through N, or evaluate"
                    .to_owned()
            }
            ProblemError::NothingToExplain => {
                "ask for --explain with a scene of bars and elements, or leave it out".to_owned()
            }
            ProblemError::NoSourceForm => {
                "add a statement such as `written f in V/c, s as mu*z/L`, or \
                                           leave out --source-form"
                    .to_owned()
            }
            ProblemError::NoGeneralSourceForm => "leave out --source-form, or --general".to_owned(),
            _ => "give a number".to_owned(),
        };
        Failure::Usage(message, remedy)
    }
}

fn remedy_of_equal(error: &EqualError) -> String {
    match error {
        EqualError::TooManyDigits { limit, .. } => format!("ask for 1 to {limit} digits"),
        EqualError::EqualAtEnd => "give another range".to_owned(),
        EqualError::NoChange(_) => "give a range in which that changes".to_owned(),
        EqualError::NotAscending { .. } => "give T1 before T2 before T3".to_owned(),
        EqualError::NoTime { symbol, .. } => format!("let it hold no symbol but {symbol}"),
    }
}

fn remedy_of_lock(refusal: &LockRefusal) -> &'static str {
    match refusal {
        LockRefusal::PeriodsWhereContactsOpen => {
            "leave out --through: events are locked, until --until T"
        }
        LockRefusal::NoEvents => "give --through N for pieces and --at T for values",
        LockRefusal::ValuesWithUnits => "leave out --at: pieces are locked, without units",
        LockRefusal::ValuesWithConstants(_) => {
            "leave out --at: pieces are locked with their symbols"
        }
        LockRefusal::NoLastPeriod => "give --through N, for the periods 0 … N",
        LockRefusal::PiecesLocked | LockRefusal::EventsLocked => "lock it again",
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
            PictureError::Problem(error) => (*error).into(),
            PictureError::Evaluate(error) => error.into(),
            PictureError::NothingObserved => {
                Failure::usage(error.to_string(), "give --quantity NAME")
            }
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
            WayError::NoNumber(..) => "use --method certified",
            WayError::NotMet { .. } => {
                return Failure::Accuracy(
                    message,
                    "ask for digits instead: --digits 25".to_owned(),
                );
            }
        };
        Failure::Computation(message, remedy.to_owned())
    }
}
