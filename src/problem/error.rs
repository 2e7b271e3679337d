//! Why a problem has no answer.

use super::{EqualError, LockRefusal};
use crate::answer::{InvalidTolerance, InvalidWay, Tolerance, WayError};
use crate::evaluate::{EvaluateError, MethodError};
use crate::field::FieldError;
use crate::history::HistoryError;
use crate::language::Diagnostic;
use crate::limits::MAX_DERIVED_TERMS;
use crate::lock::LockError;
use crate::model::{ModelError, equivalent_stiffness};
use crate::network::{NetworkError, ScaledScene};
use crate::scene::Dimension;
use crate::signal::SignalError;
use crate::solution::SolveError;
use wavestep_polynomial::{Rational, Symbol};

/// Why a problem is not read, or has no answer to what is asked of it.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProblemError {
    /// The text is at fault, at these places.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n"))]
    Text(Vec<Diagnostic>),
    /// There is no built-in scene of this name.
    #[error("there is no built-in scene `{0}`")]
    NotBuiltIn(String),
    /// Nothing stands where a number of this name should.
    #[error("`{0}` gives no number")]
    NoNumber(String),
    /// A double that is no number, or infinite.
    #[error("{0} is no number")]
    NotFinite(f64),
    /// So many significant digits are not proven.
    #[error("{0} significant digits cannot be certified")]
    Digits(usize),
    /// A text is no tolerance.
    #[error(transparent)]
    Tolerance(#[from] InvalidTolerance),
    /// A text names no method.
    #[error(transparent)]
    Method(#[from] InvalidWay),
    /// A time before the start.
    #[error("the time {0} lies before the start")]
    BeforeStart(Rational),
    /// A window that ends before it begins.
    #[error("the window from {} to {} is empty", .0[0], .0[1])]
    EmptyWindow(Box<[Rational; 2]>),
    /// No usual length of a window is known.
    #[error("the window has no end")]
    NoEnd,
    /// Neither a wave nor an observable.
    #[error("`{name}` is neither a wave nor an observable here")]
    Unknown {
        /// The name asked for.
        name: String,
        /// Those that there are.
        names: Vec<String>,
    },
    /// A wave of a scene whose contacts open.
    #[error("{0} is a wave of the closed contacts, which open in this scene")]
    WaveOfClosedContacts(String),
    /// The text of this title states equations, and no bars.
    #[error("\"{0}\" states equations, and no bars along which to look")]
    Equations(String),
    /// A law is not linear, so that there is no recurrence and no exact solution.
    #[error("{}", NetworkError::NotLinear(contact.clone()))]
    LocalContact {
        /// The name of the contact.
        contact: String,
        /// The spring nearest to it, as a scene states it.
        spring: Option<String>,
    },
    /// Contacts open, so that there are no periods, and no echoes to count.
    #[error("where contacts open there are no periods and no counted echoes")]
    NoPeriodsWhereContactsOpen,
    /// With this local contact there are no echoes and periods.
    #[error("with the local contact `{0}` there are no echoes and periods")]
    NoPeriodsWithLocalContact(String),
    /// The waves of this quantity have no common periods.
    #[error("{0} has no periods of its own")]
    NoPeriods(String),
    /// A local time outside the period, and how long that is.
    #[error("the local time {} lies outside the period", .0[0])]
    OutsidePeriod(Box<[Rational; 2]>),
    /// With this local contact no digits are certified.
    #[error("no digits are certified: `{0}` is a local contact, and no exact solution is known")]
    NoDigits(String),
    /// With this local contact no tolerance is kept with proof.
    #[error(
        "no value is proven to be within {1}: `{0}` is a local contact, and no exact solution is known"
    )]
    NoProof(String, Tolerance),
    /// A value that cannot be rounded with certainty.
    #[error("accuracy not reached at t = {time}: {name} = {best}")]
    Undecided {
        /// What was asked for.
        name: String,
        /// When.
        time: Rational,
        /// The best that is known.
        best: String,
    },
    /// A recurrence has no contacts.
    #[error("a recurrence has no contacts")]
    EquationsHaveNoContacts,
    /// No contact stands in the line of the scene.
    #[error("this scene has no contact that could open")]
    NoContact,
    /// About so many terms are too many.
    #[error("this would have about {} terms; at most {MAX_DERIVED_TERMS} are derived at once", in_powers(*.0))]
    TooManyTerms(f64),
    /// So many echoes of a lattice are too many.
    #[error("this would be about {echoes} echoes; at most {limit} are derived at once")]
    TooManyEchoes {
        /// How many there would be.
        echoes: usize,
        /// The most that are derived at once.
        limit: usize,
    },
    /// Nothing arrives within so many periods of a lattice.
    #[error("nothing arrives within {0} periods of the lattice")]
    NothingArrives(usize),
    /// No wave of this problem.
    #[error("`{name}` is no wave of this scene")]
    NotAWave {
        /// The name asked for.
        name: String,
        /// The waves.
        waves: Vec<String>,
    },
    /// An observable, where a wave was asked for.
    #[error("`{0}` is no wave of this scene")]
    ObservableIsNoWave(String),
    /// No observable of this problem.
    #[error("`{name}` is no observable of this scene")]
    NotAnObservable {
        /// The name asked for.
        name: String,
        /// The observables.
        observables: Vec<String>,
    },
    /// An energy is an integral of squares.
    #[error("{0} is an energy, an integral of squares, and has no pieces of its own")]
    EnergyHasNoPieces(String),
    /// Waves have echoes, observables have theirs.
    #[error("the echoes of {0} are those of its waves")]
    EchoesOfObservable(String),
    /// The waves of this observable do not arrive together.
    #[error("the waves in {0} do not arrive together, so it has no common periods")]
    NoCommonPeriods(String),
    /// The waves of this observable arrive in an order that is not known.
    #[error("the waves in {0} arrive apart, in an order that is not known")]
    UnknownOrder(String),
    /// The travel times have no common measure.
    #[error("the travel times have no common measure, so there {0}")]
    NoCommonMeasure(Missing),
    /// A recurrence is not derived from anything.
    #[error("a recurrence is its own explanation: nothing was derived to get it")]
    NothingToExplain,
    /// The travel times have no common measure, so that no recurrence can be explained.
    #[error(
        "the travel times have no common measure, or too fine a one: there are no periods to explain \
         this scene by"
    )]
    NoPeriodsToExplain,
    /// The text does not say how its source writes it.
    #[error("this scene does not say how its source writes it")]
    NoSourceForm,
    /// A source gives no form for every n of a sum of echoes.
    #[error("a source gives no form for every n of a wave that is a sum of echoes")]
    NoGeneralSourceForm,
    /// No closed form was found.
    #[error(
        "no closed form in n was found for {wave}; with {} the derivative and {} the delay by one \
         period, its equation is, apart from the start,\n    {operator}",
        names[0],
        names[1]
    )]
    NoGeneralForm {
        /// The wave.
        wave: String,
        /// The left side of its equation.
        operator: String,
        /// What the derivative and the delay by a period are called in it.
        names: [Symbol; 2],
        /// A symbol without a value, where there is one.
        symbol: Option<Symbol>,
    },
    /// Waves decay together at rates that formulas cannot hold.
    #[error(
        "{place}, {} decay together at the rates {}, which these formulas would have to hold",
        waves.join(" and "),
        rates.join(", ")
    )]
    Rates {
        /// Where, in words.
        place: String,
        /// The waves.
        waves: Vec<String>,
        /// The rates.
        rates: Vec<String>,
    },
    /// The two derivations of this piece disagree.
    #[error("the two derivations of {0}[{1}] disagree")]
    Disagreement(String, usize),
    /// No value of a symbol makes extrema equal.
    #[error(transparent)]
    Equal(#[from] EqualError),
    /// There is no such thing to lock.
    #[error(transparent)]
    NoLock(#[from] LockRefusal),
    /// What is to be locked cannot be derived.
    #[error(transparent)]
    Lock(Box<LockError>),
    /// A model refuses a scene with a local contact.
    #[error(transparent)]
    ModelOfLocalContact(ModelError),
    /// There are no doubles.
    #[error(transparent)]
    Way(Box<WayError>),
    /// The scene gives no recurrence.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// A wave has no formula.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A quantity has no value.
    #[error(transparent)]
    Evaluate(Box<EvaluateError>),
    /// Contacts cannot be followed.
    #[error(transparent)]
    History(HistoryError),
    /// A field has no value.
    #[error(transparent)]
    Field(Box<FieldError>),
}

/// What there is not where travel times have no common measure.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Missing {
    /// A form for every period.
    #[error("is no form for every period")]
    GeneralForm,
    /// Periods.
    #[error("are no periods")]
    Periods,
    /// Pieces on periods.
    #[error("are no periods on which pieces hold")]
    Pieces,
}

fn in_powers(terms: f64) -> String {
    format!("{terms:.1e}").replace(".0e", "e")
}

impl ProblemError {
    /// What is said of a scene with a local contact by all that needs a recurrence.
    pub(super) fn local_contact(scaled: &ScaledScene) -> ProblemError {
        let contact = scaled.local_contact().map(|contact| &scaled.scene().elements[contact].name);
        let contact = contact.cloned().unwrap_or_default();
        ProblemError::LocalContact { contact, spring: equivalent_spring(scaled) }
    }
}

/// Significant digits of the stiffness of an equivalent spring, which is an approximation itself.
const STIFFNESS_DIGITS: i32 = 6;

/// The spring that comes nearest to a local contact, as a scene states it.
pub(super) fn equivalent_spring(scaled: &ScaledScene) -> Option<String> {
    let contact = scaled.local_contact()?;
    let stiffness = equivalent_stiffness(scaled, contact).ok()?;
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
            HistoryError::Field(error) => (*error).into(),
            error => ProblemError::History(error),
        }
    }
}

impl From<FieldError> for ProblemError {
    fn from(error: FieldError) -> ProblemError {
        match error {
            FieldError::Evaluate(error) => error.into(),
            error => ProblemError::Field(Box::new(error)),
        }
    }
}

impl From<WayError> for ProblemError {
    fn from(error: WayError) -> ProblemError {
        match error {
            WayError::Method(MethodError::Evaluate(error)) => error.into(),
            error => ProblemError::Way(Box::new(error)),
        }
    }
}

impl From<LockError> for ProblemError {
    fn from(error: LockError) -> ProblemError {
        match error {
            LockError::Solve(error) => error.into(),
            LockError::History(error) => error.into(),
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
