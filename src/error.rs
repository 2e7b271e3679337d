//! The error of the library's surface.
//!
//! Each layer says in an enum of its own what went wrong, and [`ProblemError`] holds them all. Here stands
//! what follows from it: of which kind an error is, and what can be done about it.

use crate::answer::{Method, WayError};
use crate::ball::BallError;
use crate::expression::{NotAUnit, NotInvertible};
use crate::field::FieldError;
use crate::history::{HistoryError, NotFollowed};
use crate::language::{ChangeError, Diagnostic, did_you_mean};
use crate::limits::MAX_DIGITS;
use crate::lock::LockError;
use crate::model::ModelError;
use crate::network::NetworkError;
use crate::problem::{EqualError, LockRefusal, ProblemError, Simpler};
use crate::scenes::SCENES;
use crate::signal::{EvaluateError, MethodError};
use crate::solution::{SolveError, Unsolvable};
use std::fmt;
use wavestep_polynomial::Symbol;

/// Why there is no answer.
///
/// `Display` says what went wrong; [`source`](std::error::Error::source) goes on to the causes.
///
/// ```
/// let error = wavestep::Problem::builtin("rigid-mas").err().unwrap();
/// assert!(error.is_bad_input() && !error.is_not_supported());
/// assert_eq!(error.to_string(), "there is no built-in scene `rigid-mas`");
/// assert!(error.remedy().unwrap().contains("rigid-mass"));
/// ```
#[derive(Debug)]
pub struct Error(Box<ProblemError>);

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    BadInput,
    AccuracyNotReached,
    TooMuchWork,
    NotSupported,
    Undefined,
}

impl Error {
    /// Whether what was given is at fault: the text of a scene, a value, a time, a name, an order beyond
    /// the limits.
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        kind(&self.0) == Kind::BadInput
    }

    /// Whether there is an answer, but none that is proven to be as accurate as was asked for.
    #[must_use]
    pub fn is_accuracy_not_reached(&self) -> bool {
        kind(&self.0) == Kind::AccuracyNotReached
    }

    /// Whether the answer takes more work than is done.
    #[must_use]
    pub fn is_too_much_work(&self) -> bool {
        kind(&self.0) == Kind::TooMuchWork
    }

    /// Whether there may be an answer that is not computed here.
    #[must_use]
    pub fn is_not_supported(&self) -> bool {
        kind(&self.0) == Kind::NotSupported
    }

    /// Whether there is no answer: a division by zero, a number that is not real.
    #[must_use]
    pub fn is_undefined(&self) -> bool {
        kind(&self.0) == Kind::Undefined
    }

    /// What is wrong in a text, with its places; none where no text is at fault.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        match &*self.0 {
            ProblemError::Text(diagnostics) => diagnostics,
            _ => &[],
        }
    }

    /// What can be done about it, where that is known; diagnostics have remedies of their own.
    #[must_use]
    pub fn remedy(&self) -> Option<String> {
        remedy(&self.0)
    }

    /// What went wrong, for programs that name their own options in a remedy.
    #[doc(hidden)]
    #[must_use]
    pub fn cause(&self) -> &ProblemError {
        &self.0
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

impl<E: Into<ProblemError>> From<E> for Error {
    fn from(error: E) -> Error {
        Error(Box::new(error.into()))
    }
}

impl ProblemError {
    /// The symbol that has no value, where that is all.
    pub fn missing_value(&self) -> Option<&Symbol> {
        match self {
            ProblemError::History(HistoryError::MissingValue(symbol)) => Some(symbol),
            ProblemError::Evaluate(error) => match &**error {
                EvaluateError::MissingValue(symbol) => Some(symbol),
                _ => None,
            },
            ProblemError::Way(error) => match &**error {
                WayError::Model(ModelError::MissingValue(symbol)) => Some(symbol),
                _ => None,
            },
            _ => None,
        }
    }
}

fn kind(error: &ProblemError) -> Kind {
    match error {
        ProblemError::Solve(error) => kind_of_solve(error),
        ProblemError::Network(error) => kind_of_network(error),
        ProblemError::Evaluate(error) => kind_of_evaluate(error),
        ProblemError::History(error) => kind_of_history(error),
        ProblemError::Way(error) => kind_of_way(error),
        ProblemError::Field(error) => match **error {
            FieldError::Undecided { .. } => Kind::AccuracyNotReached,
            _ => Kind::BadInput,
        },
        ProblemError::Lock(error) => match **error {
            LockError::Digits(_) => Kind::BadInput,
            _ => Kind::AccuracyNotReached,
        },
        ProblemError::Undecided { .. } => Kind::AccuracyNotReached,
        ProblemError::LocalContact { .. }
        | ProblemError::NoClosedForm { .. }
        | ProblemError::ModelOfLocalContact(_)
        | ProblemError::EnergyHasNoPieces(_)
        | ProblemError::ProductsHaveNoPieces(_)
        | ProblemError::NoCommonPeriods(_)
        | ProblemError::UnknownOrder(_)
        | ProblemError::NoPeriodsToExplain
        | ProblemError::NoEchoesToExplain
        | ProblemError::NothingArrives(_)
        | ProblemError::NoGeneralForm { .. }
        | ProblemError::Rates { .. }
        | ProblemError::LongEchoes { .. }
        | ProblemError::Disagreement(..) => Kind::NotSupported,
        // A time, a name, a limit of orders, or a question that this kind of text has no answer to.
        _ => Kind::BadInput,
    }
}

fn kind_of_division(NotAUnit(divisor): &NotAUnit) -> Kind {
    if divisor.is_zero() { Kind::Undefined } else { Kind::NotSupported }
}

fn kind_of_solve(error: &SolveError) -> Kind {
    match &error.reason {
        Unsolvable::NotInvertible(NotInvertible::Zero) => Kind::Undefined,
        Unsolvable::NotInvertible(_) => Kind::NotSupported,
        Unsolvable::NotAUnit(error) => kind_of_division(error),
        Unsolvable::DegreeTooHigh => Kind::TooMuchWork,
    }
}

fn kind_of_network(error: &NetworkError) -> Kind {
    match error {
        NetworkError::Division(error) => kind_of_division(error),
        NetworkError::Unobservable { .. } => Kind::Undefined,
        _ => Kind::NotSupported,
    }
}

fn kind_of_evaluate(error: &EvaluateError) -> Kind {
    match error {
        EvaluateError::MissingValue(_) | EvaluateError::EmptyWindow | EvaluateError::AfterLast => {
            Kind::BadInput
        }
        EvaluateError::AccuracyNotReached { .. }
        | EvaluateError::InstantsUndecided { .. }
        | EvaluateError::NotFollowed { .. } => Kind::AccuracyNotReached,
        EvaluateError::TooManyPeriods { .. }
        | EvaluateError::TooManyEchoes { .. }
        | EvaluateError::TooMuchMemory { .. }
        | EvaluateError::TooManyCells { .. }
        | EvaluateError::TooManyRoots { .. }
        | EvaluateError::Ball(BallError::ArgumentTooLarge) => Kind::TooMuchWork,
        EvaluateError::Solve(error) => kind_of_solve(error),
        EvaluateError::Network(error) => kind_of_network(error),
        EvaluateError::Division(error) => kind_of_division(error),
        EvaluateError::NotReal => Kind::Undefined,
        EvaluateError::Ball(_)
        | EvaluateError::TooSteep
        | EvaluateError::NoClosedForm
        | EvaluateError::NotLinear => Kind::NotSupported,
    }
}

fn kind_of_history(error: &HistoryError) -> Kind {
    match error {
        HistoryError::Undecided { .. } => Kind::AccuracyNotReached,
        HistoryError::TooManyEvents { .. }
        | HistoryError::TooManyCells { .. }
        | HistoryError::TooMuchMemory { .. } => Kind::TooMuchWork,
        HistoryError::Value(error) => kind_of_evaluate(&error.clone().into()),
        HistoryError::Refused(_) | HistoryError::Opens { .. } => Kind::NotSupported,
        _ => Kind::BadInput,
    }
}

fn kind_of_way(error: &WayError) -> Kind {
    match error {
        WayError::Method(MethodError::TooManyPeriods { .. })
        | WayError::Model(ModelError::TooMuch { .. }) => Kind::TooMuchWork,
        WayError::Method(MethodError::Outside)
        | WayError::Model(
            ModelError::MissingValue(_) | ModelError::Time(_) | ModelError::Setting { .. },
        ) => Kind::BadInput,
        WayError::NotMet { .. } => Kind::AccuracyNotReached,
        _ => Kind::NotSupported,
    }
}

/// What can be done about an error: what its layer says, what names something of the problem, or a rule.
fn remedy(error: &ProblemError) -> Option<String> {
    if let Some(symbol) = error.missing_value() {
        return Some(format!("give {symbol} a value"));
    }
    Some(match error {
        ProblemError::Solve(error) => remedy_of_solve(error),
        ProblemError::Equal(error) => remedy_of_equal(error),
        ProblemError::Method(_) => {
            format!("give one of {}", Method::NAMES.map(|(name, _)| name).join(", "))
        }
        ProblemError::NotBuiltIn(name) => {
            let names = SCENES.map(|scene| scene.name);
            did_you_mean(name, names)
                .unwrap_or_else(|| format!("the built-in scenes are {}", names.join(", ")))
        }
        ProblemError::Unknown { names, .. } | ProblemError::LeftOut { names, .. }
            if names.is_empty() =>
        {
            "nothing is observed here: add a line such as `observe v = velocity(NAME)`".to_owned()
        }
        ProblemError::UnknownThere { names, .. } if names.is_empty() => {
            "observe the same by the same name in both".to_owned()
        }
        ProblemError::Unknown { name, names }
        | ProblemError::UnknownThere { name, names, .. }
        | ProblemError::LeftOut { name, names } => {
            did_you_mean(name, names.iter().map(String::as_str))
                .unwrap_or_else(|| format!("choose one of {}", names.join(", ")))
        }
        ProblemError::Change(ChangeError::Unknown(text)) => {
            let likely = Simpler::corrected(text).map(|text| format!("did you mean `{text}`?"));
            likely.unwrap_or_else(|| format!("choose one of {}", Simpler::FORMS))
        }
        ProblemError::Change(ChangeError::NoElement { name, elements }) => {
            did_you_mean(name, elements.iter().map(String::as_str))
                .unwrap_or_else(|| format!("name one of {}", elements.join(", ")))
        }
        ProblemError::NoSymbol { symbols, .. } if !symbols.is_empty() => {
            format!("the free symbols are {}", symbols.join(", "))
        }
        ProblemError::Digits(_) => format!("give 1 to {MAX_DIGITS} digits"),
        ProblemError::OutsidePeriod(times) => {
            format!("give a time from 0 to less than {}", times[1])
        }
        ProblemError::LocalContact { spring, .. } => {
            format!("compute values, or replace it by a spring: {spring}")
        }
        error => return usual_remedy(error).map(str::to_owned),
    })
}

/// What helps where a value is not known to the digits that are asked for.
const OTHER_DIGITS: &str = "ask for one digit more or fewer: the value may lie too close to a rounding boundary; or allow more bits";

/// The same where it depends on nothing but the variant.
fn usual_remedy(error: &ProblemError) -> Option<&'static str> {
    Some(match error {
        ProblemError::Network(error) => remedy_of_network(error),
        ProblemError::Evaluate(error) => remedy_of_evaluate(error),
        ProblemError::History(error) => remedy_of_history(error),
        ProblemError::Way(error) => remedy_of_way(error),
        ProblemError::NoLock(refusal) => remedy_of_lock(refusal),
        ProblemError::Lock(_) => "use fewer digits",
        ProblemError::Undecided { .. } => OTHER_DIGITS,
        ProblemError::Field(error) => match **error {
            FieldError::Undecided { .. } => "choose another time, or another mesh",
            // The others say themselves what to give.
            _ => return None,
        },
        ProblemError::NoNumber(_) | ProblemError::NotFinite(_) => "give a number",
        ProblemError::Tolerance(_) => "give a number such as 1e-9, abs:1e-9 or ulp:4",
        ProblemError::BeforeStart(_) => "give times from 0 on",
        ProblemError::EmptyWindow(_) => "the window must end after it begins",
        ProblemError::NoEnd => "give the window an end",
        ProblemError::WaveOfClosedContacts(_) => "choose an observable, or remove `contacts open`",
        ProblemError::Equations(_) => DESCRIBE,
        ProblemError::Change(ChangeError::NotABar(_)) => "name a bar of the line",
        ProblemError::NoArrivals(_) => "choose another quantity, or another model",
        ProblemError::Change(ChangeError::Nothing(_)) => "write `modes:1`, or `echoes:1`",
        ProblemError::Change(_) => "choose another simplification",
        ProblemError::AllZero(_) => "use a longer window, or another quantity",
        ProblemError::SymbolRange(_) => {
            "write it as mu=1/10..10; the first value must be positive and smaller than the last"
        }
        ProblemError::NoSymbol { .. } => "every symbol has a value: remove --for",
        ProblemError::Apart { .. } => "compare scenes with the same units",
        ProblemError::NoClosedForm { .. } => "evaluate its observables, which works for every line",
        ProblemError::ModelOfLocalContact(_) => "use tested values by the method of steps",
        ProblemError::NoPeriods(_)
        | ProblemError::NoPeriodsWhereContactsOpen
        | ProblemError::NoPeriodsWithLocalContact(_) => "give times",
        ProblemError::EnergyHasNoPieces(_) | ProblemError::ProductsHaveNoPieces(_) => "evaluate it",
        ProblemError::NoCommonPeriods(_) => "evaluate it, or derive its waves",
        ProblemError::UnknownOrder(_) => "give the symbols values, or evaluate it",
        ProblemError::TooManyTerms(_) => "choose a smaller order, one wave, or one piece",
        ProblemError::TooManyEchoes { .. } => "choose a smaller order, or one wave",
        ProblemError::NothingArrives(_) => "choose a larger order",
        ProblemError::EchoesOfObservable(_) => "derive the echoes of its waves",
        ProblemError::NoCommonMeasure(_) => "derive echoes of waves, or evaluate",
        ProblemError::NoPeriodsToExplain => "derive its echoes",
        ProblemError::NoEchoesToExplain => "explain its pieces: leave out the form",
        ProblemError::NoSourceForm => "add a statement such as `written f in V/c, s as mu*z/L`",
        ProblemError::NoGeneralForm { symbol: Some(_), .. } => {
            "choose single orders; if a factor may vanish, stating `nonzero …` can help"
        }
        ProblemError::NoGeneralForm { symbol: None, .. } => "choose single orders",
        ProblemError::Rates { .. } => {
            "evaluate it, which works with any rates; or give values for which the rates are rational, \
             or roots of one quadratic with rational coefficients"
        }
        ProblemError::LongEchoes { .. } => {
            "derive through that order, or evaluate it, which works with any rates"
        }
        ProblemError::Disagreement(..) => "please report this scene: it is a bug in wavestep",
        _ => return None,
    })
}

const DESCRIBE: &str = "describe the scene by its parts: see docs/scene-language.md";

fn remedy_of_solve(error: &SolveError) -> String {
    match &error.reason {
        Unsolvable::NotInvertible(NotInvertible::Undeclared(factor)) => {
            format!("give the symbols values, or state `nonzero {factor}` in the scene")
        }
        Unsolvable::DegreeTooHigh => "choose a smaller order".to_owned(),
        _ => "give the symbols values".to_owned(),
    }
}

fn remedy_of_network(error: &NetworkError) -> &'static str {
    match error {
        NetworkError::Division(_) => "give the symbols values",
        NetworkError::Incommensurate => "derive echoes in order of arrival, or compute values",
        NetworkError::Unobservable { .. } => "observe it at another place",
        NetworkError::Rates { .. } => {
            "give the symbols values; or state the elements by their rates a and b, or sigma and omega, \
             as docs/scene-language.md shows"
        }
        NetworkError::NotLinear(_) | NetworkError::Apart(_) => "compute values",
        NetworkError::Massless(_) => {
            "a spring passes a force on unchanged: put the load behind it, or put a mass or a damper at the joint"
        }
        NetworkError::Recurrence(_) => {
            "a joint without mass cannot be forced or held against a spring or a moving bar: put a mass there"
        }
    }
}

fn remedy_of_evaluate(error: &EvaluateError) -> &'static str {
    match error {
        EvaluateError::NoClosedForm | EvaluateError::NotLinear => {
            "use the method compiled or certified"
        }
        EvaluateError::EmptyWindow => "the window must end after it begins",
        EvaluateError::TooManyRoots { .. } | EvaluateError::TooManyCells { .. } => {
            "use a shorter window"
        }
        EvaluateError::NotReal => "observe a wave with both poles of each complex pair",
        EvaluateError::TooMuchMemory { .. } => {
            "choose an earlier time, raise --memory, or use doubles by the method marched"
        }
        EvaluateError::TooManyEchoes { .. } => {
            "choose an earlier time; if travel times have no common measure, round them so that they do: fewer echoes arrive"
        }
        EvaluateError::AccuracyNotReached { .. } => OTHER_DIGITS,
        EvaluateError::InstantsUndecided { .. } => "choose a time slightly earlier or later",
        _ => "choose an earlier time",
    }
}

fn remedy_of_history(error: &HistoryError) -> &'static str {
    match error {
        HistoryError::Undecided { .. } => "change a value slightly, or choose an earlier end",
        HistoryError::TooManyEvents { .. } => "choose an earlier end",
        HistoryError::TooManyCells { .. } => {
            "choose an earlier end; there are fewer echoes where travel times are multiples of one of them, and where no light \
             mass or stiff spring rings"
        }
        HistoryError::TooMuchMemory { .. } => "choose an earlier end, or raise --memory",
        HistoryError::Refused(NotFollowed::Massless { .. }) => {
            "put a mass or a damper there, or write two springs in a row as one"
        }
        HistoryError::Refused(
            NotFollowed::RigidImpact { at, .. } | NotFollowed::ImpactOnWall { at, .. },
        ) if !at.is_empty() => "choose an earlier end to see what happens until then",
        HistoryError::Refused(_) => {
            "docs/scene-language.md lists under `Contacts` what is supported"
        }
        HistoryError::Opens { .. } => {
            "choose an earlier time, or use the method compiled or certified"
        }
        _ => "choose an earlier time",
    }
}

fn remedy_of_way(error: &WayError) -> &'static str {
    match error {
        WayError::Method(MethodError::Outside) => "give times within the window",
        WayError::Method(MethodError::NoTaps(_) | MethodError::Cancels(_)) => {
            "use the method compiled or certified"
        }
        WayError::Method(_) => "use a shorter window, or the method certified",
        WayError::Model(ModelError::Setting { .. }) => "give a setting within these bounds",
        WayError::Model(_) | WayError::Reduced(..) => {
            "use another model, or a method based on the exact solution"
        }
        WayError::NeedsRecurrence(_) => "use the method of steps",
        WayError::NeedsScene(_) => DESCRIBE,
        WayError::NeedsClosedContacts(_) => "use the method compiled or certified",
        WayError::LeftLimit(_) => "use the limit from the right",
        WayError::NoNumber(..) | WayError::TooSmall(_) | WayError::NotMet { .. } => {
            "compute digits instead"
        }
    }
}

fn remedy_of_equal(error: &EqualError) -> String {
    let usual = match error {
        EqualError::TooManyDigits { limit, .. } => {
            return format!("give 1 to {limit} digits");
        }
        EqualError::EqualAtEnd => "give another range",
        EqualError::NoChange(_) => "choose a range in which that changes",
        EqualError::NotAscending { .. } => "the times must satisfy T1 < T2 < T3",
        EqualError::NoTime { symbol, .. } => {
            return format!("use no symbol but {symbol} in it");
        }
    };
    usual.to_owned()
}

fn remedy_of_lock(refusal: &LockRefusal) -> &'static str {
    match refusal {
        LockRefusal::PeriodsWhereContactsOpen => "lock events, until a time",
        LockRefusal::NoEvents => "lock pieces through a period, and values at times",
        LockRefusal::NoLastPeriod => "give the last period, or times",
        LockRefusal::PiecesLocked | LockRefusal::EventsLocked => "lock it again",
    }
}
