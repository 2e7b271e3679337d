//! The error of the library's surface: one opaque type over the errors of the layers beneath.
//!
//! Each layer says in its own enum what went wrong. Here stands what follows from it: of which kind it
//! is, and what can be done about it.

use crate::answer::{InvalidTolerance, InvalidWay, WayError};
use crate::ball::BallError;
use crate::evaluate::{EvaluateError, MethodError};
use crate::expression::{NotAUnit, NotInvertible};
use crate::field::FieldError;
use crate::history::HistoryError;
use crate::language::Diagnostic;
use crate::lock::LockError;
use crate::model::ModelError;
use crate::network::NetworkError;
use crate::solution::{ObserveError, SolveError, Unsolvable};
use std::fmt;
use wavestep_polynomial::{Polynomial, Symbol};

/// Why there is no answer.
///
/// `Display` says what went wrong; [`source`](std::error::Error::source) goes on to the causes.
///
/// ```
/// use wavestep::evaluate::EvaluateError;
///
/// let error = wavestep::Error::from(EvaluateError::EmptyWindow);
/// assert!(error.is_bad_input() && !error.is_not_supported());
/// assert_eq!(error.remedy().unwrap().to_string(), "let the window end after it begins");
/// ```
#[derive(Debug)]
pub struct Error(Box<Cause>);

/// What went wrong, as the layer says that found it.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Cause {
    #[error("{}", in_paragraphs(.0))]
    Text(Vec<Diagnostic>),
    #[error(transparent)]
    Solve(#[from] SolveError),
    #[error(transparent)]
    Observe(#[from] ObserveError),
    #[error(transparent)]
    Network(#[from] NetworkError),
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    #[error(transparent)]
    Field(#[from] FieldError),
    #[error(transparent)]
    History(#[from] HistoryError),
    #[error(transparent)]
    Way(#[from] WayError),
    #[error(transparent)]
    InvalidWay(#[from] InvalidWay),
    #[error(transparent)]
    InvalidTolerance(#[from] InvalidTolerance),
    #[error(transparent)]
    Lock(#[from] LockError),
}

/// What kind of error it is; every error is of one kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    BadInput,
    AccuracyNotReached,
    TooMuchWork,
    NotSupported,
    Undefined,
}

/// What can be done about an error. `Display` says it; a program with options of its own can name those.
///
/// ```
/// assert_eq!(wavestep::Remedy::FewerDigits.to_string(), "ask for fewer digits");
/// ```
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Remedy {
    /// A symbol needs a value.
    #[error("give {0} a value")]
    GiveValue(Symbol),
    /// All symbols need values.
    #[error("give the symbols values")]
    GiveValues,
    /// A factor has to be known not to vanish.
    #[error("give the symbols values, or state `nonzero {0}` in the scene")]
    StateNonzero(Polynomial),
    /// The rates of a scene are to be symbols.
    #[error(
        "give the symbols values; or state the elements by their rates a and b, or sigma and omega, as \
         docs/scene-language.md shows"
    )]
    StateRates,
    /// Echoes or values instead of periods.
    #[error("ask for echoes in order of their arrival, or for values")]
    AskForEchoes,
    /// Values instead of formulas.
    #[error("ask for values")]
    AskForValues,
    /// An observable of another place.
    #[error("observe it at another place")]
    OtherPlace,
    /// A mass where something without mass is forced or held.
    #[error(
        "what has no mass cannot be forced or held against a spring or a moving bar: put a mass there"
    )]
    AddMass,
    /// A smaller order.
    #[error("ask for a smaller order")]
    SmallerOrder,
    /// An earlier time.
    #[error("ask for an earlier time")]
    EarlierTime,
    /// An earlier end of the history.
    #[error("ask for an earlier end")]
    EarlierEnd,
    /// A window of positive length.
    #[error("let the window end after it begins")]
    WindowInOrder,
    /// A shorter window.
    #[error("ask for a shorter window")]
    ShorterWindow,
    /// A quantity that is linear in the waves, or digits.
    #[error("ask for a force or a velocity, or for digits")]
    LinearOrDigits,
    /// Both waves of a complex pair.
    #[error("observe a wave in which both poles of each complex pair occur")]
    BothPoles,
    /// More bits, or fewer digits.
    #[error("allow more bits, or ask for fewer digits")]
    MoreBits,
    /// Fewer digits.
    #[error("ask for fewer digits")]
    FewerDigits,
    /// A value near by, for which an event is decided.
    #[error("change a value a little, or ask for an earlier end")]
    ChangeValue,
    /// A time or cells near by, for which a field is decided.
    #[error("give another time, or other cells")]
    OtherTimeOrCells,
    /// A scene whose contacts can be followed.
    #[error("docs/scene-language.md says under `Contacts` what is followed")]
    FollowedContacts,
    /// A method for all waves.
    #[error("use the method compiled or certified")]
    CompiledOrCertified,
    /// A shorter window, or the certified method.
    #[error("ask for a shorter window, or use the method certified")]
    ShorterOrCertified,
    /// Another model, or a method.
    #[error("use another model, or a method on the exact solution")]
    OtherModel,
    /// The method of steps.
    #[error("use the method of steps, as in steps:1e-10")]
    MethodOfSteps,
    /// A scene of bars instead of a recurrence.
    #[error("describe it by its parts: see docs/scene-language.md")]
    DescribeParts,
    /// Limits from the right.
    #[error("ask for the limit from the right")]
    RightLimit,
}

impl Error {
    /// Whether what was given is at fault: the text of a scene, a value, a time, a name.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        self.0.kind() == Kind::BadInput
    }

    /// Whether there is an answer, but not as accurate as was asked for.
    #[must_use]
    pub fn is_accuracy_not_reached(&self) -> bool {
        self.0.kind() == Kind::AccuracyNotReached
    }

    /// Whether an answer would take more work than a limit allows.
    #[must_use]
    pub fn is_too_much_work(&self) -> bool {
        self.0.kind() == Kind::TooMuchWork
    }

    /// Whether an answer may exist that is not computed here.
    #[must_use]
    pub fn is_not_supported(&self) -> bool {
        self.0.kind() == Kind::NotSupported
    }

    /// Whether there is no answer: a division by zero, a number that is not real.
    #[must_use]
    pub fn is_undefined(&self) -> bool {
        self.0.kind() == Kind::Undefined
    }

    /// What is wrong in a text, with its places; none where no text is at fault.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        match &*self.0 {
            Cause::Text(diagnostics) => diagnostics,
            _ => &[],
        }
    }

    /// What can be done about it, where that is known; [`Error::diagnostics`] have remedies of their own.
    #[must_use]
    pub fn remedy(&self) -> Option<Remedy> {
        self.0.remedy()
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.0.source()
    }
}

impl<E: Into<Cause>> From<E> for Error {
    fn from(error: E) -> Error {
        Error(Box::new(error.into()))
    }
}

impl From<Diagnostic> for Cause {
    fn from(diagnostic: Diagnostic) -> Cause {
        Cause::Text(vec![diagnostic])
    }
}

impl From<Vec<Diagnostic>> for Cause {
    fn from(diagnostics: Vec<Diagnostic>) -> Cause {
        Cause::Text(diagnostics)
    }
}

fn in_paragraphs(diagnostics: &[Diagnostic]) -> String {
    let told: Vec<String> =
        diagnostics.iter().map(|one| one.to_string().trim_end().to_owned()).collect();
    told.join("\n\n")
}

impl Cause {
    fn kind(&self) -> Kind {
        match self {
            Cause::Text(_) | Cause::InvalidWay(_) | Cause::InvalidTolerance(_) => Kind::BadInput,
            Cause::Solve(error) | Cause::Observe(ObserveError::Solve(error)) => of_solve(error),
            Cause::Observe(ObserveError::MixedOffsets) => Kind::NotSupported,
            Cause::Network(error) => of_network(error),
            Cause::Evaluate(error) => of_evaluate(error),
            Cause::Field(error) => of_field(error),
            Cause::History(error) => of_history(error),
            Cause::Way(error) => of_way(error),
            Cause::Lock(LockError::Solve(error)) => of_solve(error),
            Cause::Lock(LockError::Evaluate(error)) => of_evaluate(error),
            Cause::Lock(LockError::History(error)) => of_history(error),
            Cause::Lock(LockError::Digits(_)) => Kind::BadInput,
            Cause::Lock(LockError::AccuracyNotReached(_)) => Kind::AccuracyNotReached,
        }
    }

    fn remedy(&self) -> Option<Remedy> {
        Some(match self {
            Cause::Text(_) | Cause::InvalidWay(_) | Cause::InvalidTolerance(_) => return None,
            Cause::Observe(ObserveError::MixedOffsets) => Remedy::AskForValues,
            Cause::Solve(error) | Cause::Observe(ObserveError::Solve(error)) => after_solve(error),
            Cause::Network(error) => after_network(error),
            Cause::Evaluate(error) => after_evaluate(error),
            Cause::Field(error) => return after_field(error),
            Cause::History(error) => return after_history(error),
            Cause::Way(error) => after_way(error),
            Cause::Lock(error) => match error {
                LockError::Solve(error) => after_solve(error),
                LockError::Evaluate(EvaluateError::AccuracyNotReached { .. })
                | LockError::AccuracyNotReached(_)
                | LockError::Digits(_) => Remedy::FewerDigits,
                LockError::Evaluate(error) => after_evaluate(error),
                LockError::History(error) => return after_history(error),
            },
        })
    }
}

fn of_division(NotAUnit(divisor): &NotAUnit) -> Kind {
    if divisor.is_zero() { Kind::Undefined } else { Kind::NotSupported }
}

fn of_solve(error: &SolveError) -> Kind {
    match &error.reason {
        Unsolvable::NotInvertible(NotInvertible::Zero) => Kind::Undefined,
        Unsolvable::NotInvertible(_) => Kind::NotSupported,
        Unsolvable::NotAUnit(error) => of_division(error),
        Unsolvable::DegreeTooHigh => Kind::TooMuchWork,
    }
}

fn after_solve(error: &SolveError) -> Remedy {
    match &error.reason {
        Unsolvable::NotInvertible(NotInvertible::Undeclared(factor)) => {
            Remedy::StateNonzero(factor.clone())
        }
        Unsolvable::DegreeTooHigh => Remedy::SmallerOrder,
        _ => Remedy::GiveValues,
    }
}

fn of_network(error: &NetworkError) -> Kind {
    match error {
        NetworkError::Division(error) => of_division(error),
        NetworkError::Unobservable { .. } => Kind::Undefined,
        _ => Kind::NotSupported,
    }
}

fn after_network(error: &NetworkError) -> Remedy {
    match error {
        NetworkError::Division(_) => Remedy::GiveValues,
        NetworkError::Incommensurate => Remedy::AskForEchoes,
        NetworkError::Unobservable { .. } => Remedy::OtherPlace,
        NetworkError::Rates { .. } => Remedy::StateRates,
        NetworkError::NotLinear(_) => Remedy::AskForValues,
        NetworkError::Recurrence(_) => Remedy::AddMass,
    }
}

fn of_evaluate(error: &EvaluateError) -> Kind {
    match error {
        EvaluateError::MissingValue(_) | EvaluateError::EmptyWindow | EvaluateError::AfterLast => {
            Kind::BadInput
        }
        EvaluateError::AccuracyNotReached { .. } | EvaluateError::NotFollowed { .. } => {
            Kind::AccuracyNotReached
        }
        EvaluateError::TooManyPeriods { .. }
        | EvaluateError::TooManyEchoes { .. }
        | EvaluateError::TooManyCells { .. }
        | EvaluateError::TooManyRoots { .. }
        | EvaluateError::Ball(BallError::ArgumentTooLarge) => Kind::TooMuchWork,
        EvaluateError::Solve(error) => of_solve(error),
        EvaluateError::Network(error) => of_network(error),
        EvaluateError::Division(error) => of_division(error),
        EvaluateError::NotReal => Kind::Undefined,
        EvaluateError::Ball(_) | EvaluateError::TooSteep | EvaluateError::NotLinear(_) => {
            Kind::NotSupported
        }
    }
}

fn after_evaluate(error: &EvaluateError) -> Remedy {
    match error {
        EvaluateError::MissingValue(symbol) => Remedy::GiveValue(symbol.clone()),
        EvaluateError::NotLinear(_) => Remedy::LinearOrDigits,
        EvaluateError::EmptyWindow => Remedy::WindowInOrder,
        EvaluateError::TooManyRoots { .. } | EvaluateError::TooManyCells { .. } => {
            Remedy::ShorterWindow
        }
        EvaluateError::NotReal => Remedy::BothPoles,
        EvaluateError::Solve(error) => after_solve(error),
        EvaluateError::Network(error) => after_network(error),
        EvaluateError::AccuracyNotReached { .. } => Remedy::MoreBits,
        _ => Remedy::EarlierTime,
    }
}

fn of_field(error: &FieldError) -> Kind {
    match error {
        FieldError::Evaluate(error) => of_evaluate(error),
        FieldError::Undecided { .. } => Kind::AccuracyNotReached,
        _ => Kind::BadInput,
    }
}

/// Other errors of fields say in their message what to give.
fn after_field(error: &FieldError) -> Option<Remedy> {
    match error {
        FieldError::Evaluate(error) => Some(after_evaluate(error)),
        FieldError::Undecided { .. } => Some(Remedy::OtherTimeOrCells),
        _ => None,
    }
}

fn of_history(error: &HistoryError) -> Kind {
    match error {
        HistoryError::MissingValue(_)
        | HistoryError::NoObservable(_)
        | HistoryError::AfterLast
        | HistoryError::EmptyWindow => Kind::BadInput,
        HistoryError::Undecided { .. } => Kind::AccuracyNotReached,
        HistoryError::TooManyEvents { .. } | HistoryError::TooManyCells { .. } => Kind::TooMuchWork,
        HistoryError::Evaluate(error) => of_evaluate(error),
        HistoryError::Value(error) => of_evaluate(&error.clone().into()),
        HistoryError::Field(error) => of_field(error),
        HistoryError::Refused(_) => Kind::NotSupported,
    }
}

fn after_history(error: &HistoryError) -> Option<Remedy> {
    Some(match error {
        HistoryError::MissingValue(symbol) => Remedy::GiveValue(symbol.clone()),
        HistoryError::Undecided { .. } => Remedy::ChangeValue,
        HistoryError::TooManyEvents { .. } | HistoryError::TooManyCells { .. } => {
            Remedy::EarlierEnd
        }
        HistoryError::Field(error) => return after_field(error),
        HistoryError::Refused(_) => Remedy::FollowedContacts,
        HistoryError::EmptyWindow => Remedy::WindowInOrder,
        HistoryError::NoObservable(_) => return None,
        _ => Remedy::EarlierTime,
    })
}

fn of_way(error: &WayError) -> Kind {
    match error {
        WayError::Method(MethodError::Evaluate(error)) => of_evaluate(error),
        WayError::Method(MethodError::TooManyPeriods { .. })
        | WayError::Model(ModelError::TooMuch { .. }) => Kind::TooMuchWork,
        WayError::Method(MethodError::Outside)
        | WayError::Model(ModelError::MissingValue(_) | ModelError::Time(_)) => Kind::BadInput,
        WayError::NotMet { .. } => Kind::AccuracyNotReached,
        _ => Kind::NotSupported,
    }
}

fn after_way(error: &WayError) -> Remedy {
    match error {
        WayError::Method(MethodError::Evaluate(error)) => after_evaluate(error),
        WayError::Method(MethodError::NoTaps(_)) => Remedy::CompiledOrCertified,
        WayError::Method(_) => Remedy::ShorterOrCertified,
        WayError::Model(ModelError::MissingValue(symbol)) => Remedy::GiveValue(symbol.clone()),
        WayError::Model(_) => Remedy::OtherModel,
        WayError::NeedsRecurrence(_) => Remedy::MethodOfSteps,
        WayError::NeedsScene(_) => Remedy::DescribeParts,
        WayError::LeftLimit(_) => Remedy::RightLimit,
        WayError::NoNumber(..) => Remedy::CompiledOrCertified,
        WayError::NotMet { .. } => Remedy::AskForValues,
    }
}
