//! Why a problem has no answer.

use crate::answer::{InvalidMethod, InvalidTolerance, NotReduced, WayError};
use crate::field::FieldError;
use crate::history::HistoryError;
use crate::language::{ChangeError, Diagnostic};
use crate::limits::MAX_DERIVED_TERMS;
use crate::lock::LockError;
use crate::model::{ModelError, equivalent_stiffness};
use crate::network::{NetworkError, NoClosedForm, ScaledScene};
use crate::planner::SignalError;
use crate::scene::{Dimension, Mistake};
use crate::signal::{EvaluateError, MethodError};
use crate::solution::SolveError;
use std::cmp::Ordering;
use wavestep_polynomial::{Rational, Symbol};

/// Why a problem is not read, or has no answer to what is asked of it.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProblemError {
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n"))]
    Text(Vec<Diagnostic>),
    #[error("there is no built-in scene `{0}`")]
    NotBuiltIn(String),
    #[error("`{0}` is not a number")]
    NoNumber(String),
    #[error("{0} is not a finite number")]
    NotFinite(f64),
    #[error("{0} significant digits cannot be certified")]
    Digits(usize),
    #[error(transparent)]
    Tolerance(#[from] InvalidTolerance),
    #[error(transparent)]
    Method(#[from] InvalidMethod),
    #[error("the time {0} is before the start")]
    BeforeStart(String),
    #[error("the window from {} to {} is empty", .0[0], .0[1])]
    EmptyWindow([String; 2]),
    #[error("the window has no end")]
    NoEnd,
    #[error("`{name}` is neither a wave nor an observable of this scene")]
    Unknown { name: String, names: Vec<String> },
    #[error("{0} is a wave for closed contacts, and contacts open in this scene")]
    WaveOfClosedContacts(String),
    #[error("`{name}` is neither a wave nor an observable of \"{title}\"")]
    UnknownThere { name: String, title: String, names: Vec<String> },
    #[error(
        "the echoes of `{0}` cannot be counted: it is an energy, contacts open, or there is a local contact"
    )]
    NoArrivals(String),
    #[error("`{name}` observes what is left out")]
    LeftOut { name: String, names: Vec<String> },
    #[error("`{name}` has another unit in \"{title}\"")]
    Apart { name: String, title: String },
    #[error(transparent)]
    Change(ChangeError),
    #[error("`{0}` is not a range of a symbol")]
    SymbolRange(String),
    #[error("`{0}` is zero in this window")]
    AllZero(String),
    #[error("`{name}` is not a free symbol of this scene")]
    NoSymbol { name: String, symbols: Vec<String> },
    #[error("\"{0}\" states equations; it has no bars")]
    Equations(String),
    #[error("{}", NetworkError::NotLinear(contact.clone()))]
    LocalContact {
        contact: String,
        /// The spring to put in its place, as the remedy tells it: the equivalent one where it is known.
        spring: String,
    },
    #[error("the first contact at `{contact}` has no closed form: {why}")]
    NoClosedForm { contact: String, why: NoClosedForm },
    #[error("if contacts open, there are no periods and no numbered echoes")]
    NoPeriodsWhereContactsOpen,
    #[error("with the local contact `{0}` there are no echoes and no periods")]
    NoPeriodsWithLocalContact(String),
    #[error("{0} has no periods of its own")]
    NoPeriods(String),
    /// A local time, and how long the period is.
    #[error("the local time {} is outside the period", .0[0])]
    OutsidePeriod(Box<[Rational; 2]>),
    #[error("accuracy not reached at t = {time}: {name} = {best}")]
    Undecided { name: String, time: Rational, best: String },
    #[error("this needs about {} terms; at most {MAX_DERIVED_TERMS} are derived at once", in_powers(*.0))]
    TooManyTerms(f64),
    #[error("this needs about {echoes} echoes; at most {limit} are derived at once")]
    TooManyEchoes { echoes: usize, limit: usize },
    #[error("no echo arrives within {0} periods")]
    NothingArrives(usize),
    #[error("{0} is an energy, quadratic in the waves, so it has no pieces of its own")]
    EnergyHasNoPieces(String),
    #[error("{0} contains products of waves, so it has no pieces of its own")]
    ProductsHaveNoPieces(String),
    #[error("the echoes of {0} are those of its waves")]
    EchoesOfObservable(String),
    #[error("the waves in {0} arrive at different times, so it has no common periods")]
    NoCommonPeriods(String),
    #[error("the waves in {0} arrive at different times, in an unknown order")]
    UnknownOrder(String),
    #[error("the travel times are incommensurable, so there {0}")]
    NoCommonMeasure(Missing),
    #[error(
        "the travel times are incommensurable, or their common divisor is too small: there are no \
         periods to explain"
    )]
    NoPeriodsToExplain,
    /// No wave has echoes that follow from each other by one rate.
    #[error("no echo of this scene is the one before times a rational function in the transform")]
    NoEchoesToExplain,
    #[error("this scene has no `written` statement, so its source form is unknown")]
    NoSourceForm,
    #[error(
        "no closed form in n was found for {wave}; with {} for the derivative and {} for the delay by \
         one period, its equation after the start is\n    {operator}",
        names[0],
        names[1]
    )]
    NoGeneralForm {
        wave: String,
        /// The left side of its equation.
        operator: String,
        /// What the derivative and the delay by a period are called in it.
        names: [Symbol; 2],
        /// A symbol without a value, where there is one.
        symbol: Option<Symbol>,
    },
    #[error(
        "{place}, {} decay together at the rates {}, which these formulas cannot express",
        waves.join(" and "),
        rates.join(", ")
    )]
    Rates { place: String, waves: Vec<String>, rates: Vec<String> },
    #[error(
        "{place}, {} decay together at the rates {}; with names for these the echoes of order {n} have at \
         least {terms} terms, and later ones many times more",
        waves.join(" and "),
        rates.join(", ")
    )]
    LongEchoes { place: String, waves: Vec<String>, rates: Vec<String>, n: usize, terms: usize },
    #[error("the two derivations of {0}[{1}] disagree")]
    Disagreement(String, usize),
    #[error(transparent)]
    Equal(#[from] EqualError),
    #[error(transparent)]
    NoLock(#[from] LockRefusal),
    #[error(transparent)]
    Lock(Box<LockError>),
    /// A model refuses a scene with a local contact.
    #[error(transparent)]
    ModelOfLocalContact(ModelError),
    #[error(transparent)]
    Way(Box<WayError>),
    #[error(transparent)]
    Network(#[from] NetworkError),
    #[error(transparent)]
    Solve(#[from] SolveError),
    #[error(transparent)]
    Evaluate(Box<EvaluateError>),
    #[error(transparent)]
    History(HistoryError),
    #[error(transparent)]
    Field(Box<FieldError>),
}

/// Why a problem is not locked as asked for.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum LockRefusal {
    #[error("if contacts open, there are no periods and no pieces to lock")]
    PeriodsWhereContactsOpen,
    #[error("there are no events: no contact opens")]
    NoEvents,
    #[error("neither a last period for pieces nor times for values are given")]
    NoLastPeriod,
    #[error("pieces are locked, but contacts open now")]
    PiecesLocked,
    #[error("events are locked, but no contact opens now")]
    EventsLocked,
}

/// Why no value of a symbol with equal extrema is found.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum EqualError {
    #[error("{digits} digits are too many for a symbol")]
    TooManyDigits { digits: usize, limit: usize },
    #[error("the extrema cannot be told apart at an end of the range")]
    EqualAtEnd,
    #[error("the extremum in the {} window is the larger one at both ends of the range", larger(*.0))]
    NoChange(Ordering),
    #[error("the times of {times} are not in ascending order at {symbol} = {value}")]
    NotAscending {
        /// What errors call the times.
        times: String,
        symbol: String,
        value: Rational,
    },
    #[error("at {value} the time `{text}` is not a number from 0 on")]
    NoTime { text: String, symbol: String, value: Rational },
}

fn larger(sign: Ordering) -> &'static str {
    if sign == Ordering::Greater { "first" } else { "second" }
}

/// What needs commensurate travel times.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Missing {
    #[error("is no form for every n")]
    GeneralForm,
    #[error("are no periods")]
    Periods,
    #[error("are no periods and no pieces")]
    Pieces,
}

fn in_powers(terms: f64) -> String {
    format!("{terms:.1e}").replace(".0e", "e")
}

impl ProblemError {
    /// Whether the closed form of waves takes too much, so that a scene is better followed.
    pub(super) fn is_too_much_of_a_closed_form(&self) -> bool {
        matches!(self, ProblemError::Evaluate(error) if error.is_too_much())
    }

    /// Whether it is that nothing moves in the scene.
    pub(super) fn is_at_rest(&self) -> bool {
        let told = Mistake::NothingMoves.to_string();
        matches!(self, ProblemError::Text(all) if all.iter().any(|own| own.message() == told))
    }

    /// What is said of a scene with a local contact by all that needs a recurrence.
    pub(super) fn local_contact(scaled: &ScaledScene) -> ProblemError {
        let contact = scaled.local_contact().map(|contact| &scaled.scene().elements[contact].name);
        let contact = contact.cloned().unwrap_or_default();
        let spring = match equivalent_spring(scaled) {
            Some(spring) => format!("the equivalent one is `{spring}`"),
            None => format!("`spring {contact} {{ stiffness = … }}`"),
        };
        ProblemError::LocalContact { contact, spring }
    }
}

/// Significant digits of the stiffness of an equivalent spring, which is an approximation itself.
const STIFFNESS_DIGITS: i32 = 6;

/// The spring that comes nearest to a local contact, as a scene states it.
pub(super) fn equivalent_spring(scaled: &ScaledScene) -> Option<String> {
    let contact = scaled.local_contact()?;
    let stiffness = equivalent_stiffness(scaled, contact)?;
    let unit = match scaled.scene().dimensional {
        true => format!(" {}", Dimension::STIFFNESS.unit()),
        false => String::new(),
    };
    let name = &scaled.scene().elements[contact].name;
    let decimals = STIFFNESS_DIGITS - 1 - stiffness.log10().floor() as i32;
    let stiffness = match usize::try_from(decimals) {
        Ok(decimals) => format!("{stiffness:.decimals$}"),
        Err(_) => {
            let step = 10_f64.powi(-decimals);
            format!("{:.0}", (stiffness / step).round() * step)
        }
    };
    Some(format!("spring {name} {{ stiffness = {stiffness}{unit} }}"))
}

impl From<Diagnostic> for ProblemError {
    fn from(diagnostic: Diagnostic) -> ProblemError {
        ProblemError::Text(vec![diagnostic])
    }
}

impl From<ChangeError> for ProblemError {
    fn from(error: ChangeError) -> ProblemError {
        match error {
            ChangeError::Text(diagnostic) => diagnostic.into(),
            error => ProblemError::Change(error),
        }
    }
}

impl From<ModelError> for ProblemError {
    fn from(error: ModelError) -> ProblemError {
        WayError::from(error).into()
    }
}

impl From<SignalError> for ProblemError {
    fn from(error: SignalError) -> ProblemError {
        match error {
            SignalError::Closed(error) => error.into(),
            SignalError::Followed(error) => error.into(),
        }
    }
}

// What a layer only hands on becomes the error of the layer that it comes from.

impl From<EvaluateError> for ProblemError {
    fn from(error: EvaluateError) -> ProblemError {
        match error {
            EvaluateError::Solve(error) => error.into(),
            EvaluateError::Network(error) => (*error).into(),
            error => ProblemError::Evaluate(Box::new(error)),
        }
    }
}

impl From<HistoryError> for ProblemError {
    fn from(error: HistoryError) -> ProblemError {
        match error {
            HistoryError::Evaluate(error) => (*error).into(),
            error => ProblemError::History(error),
        }
    }
}

impl From<FieldError> for ProblemError {
    fn from(error: FieldError) -> ProblemError {
        match error {
            FieldError::Signal(error) => error.into(),
            error => ProblemError::Field(Box::new(error)),
        }
    }
}

impl From<WayError> for ProblemError {
    fn from(error: WayError) -> ProblemError {
        match error {
            WayError::Method(MethodError::Evaluate(error)) => error.into(),
            WayError::Reduced(model, error) => match *error {
                NotReduced::Network(error) => error.into(),
                NotReduced::Signal(error) => error.into(),
                error => ProblemError::Way(Box::new(WayError::Reduced(model, Box::new(error)))),
            },
            error => ProblemError::Way(Box::new(error)),
        }
    }
}

impl From<MethodError> for ProblemError {
    fn from(error: MethodError) -> ProblemError {
        WayError::from(error).into()
    }
}

impl From<LockError> for ProblemError {
    fn from(error: LockError) -> ProblemError {
        match error {
            LockError::Solve(error) => error.into(),
            LockError::History(error) => error.into(),
            LockError::Signal(error) => (*error).into(),
            // Fewer digits help here, more bits do not.
            LockError::Evaluate(EvaluateError::AccuracyNotReached { .. }) => {
                ProblemError::Lock(Box::new(error))
            }
            LockError::Evaluate(error) => error.into(),
            error => ProblemError::Lock(Box::new(error)),
        }
    }
}

impl From<Vec<Diagnostic>> for ProblemError {
    fn from(diagnostics: Vec<Diagnostic>) -> ProblemError {
        ProblemError::Text(diagnostics)
    }
}
