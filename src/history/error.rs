//! Why a history cannot be followed.

use crate::ball::{Ball, BallError, Number, Value};
use crate::enclosure::EnclosureError;
use crate::signal::EvaluateError;
use std::fmt;
use wavestep_polynomial::Symbol;

/// What following yields, or why it cannot go on.
pub(crate) type Outcome<T> = Result<T, HistoryError>;

/// Why a history cannot be followed to its end.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HistoryError {
    /// A symbol without a value.
    #[error("events need numbers, and `{0}` has no value")]
    MissingValue(Symbol),
    /// A value of the scene that is no number.
    #[error(transparent)]
    Value(EnclosureError),
    /// Something that is not followed.
    #[error(transparent)]
    Refused(#[from] NotFollowed),
    /// Something that the precision allowed does not decide.
    #[error("undecided {what}, at t = {when:.20} with {bits} bits")]
    Undecided {
        /// What is not decided.
        what: Question,
        /// About when.
        when: When,
        /// The precision in bits.
        bits: u64,
    },
    /// More events than are followed.
    #[error("more than {limit} events; the last one followed is at t = {when}")]
    TooManyEvents {
        /// How many are followed.
        limit: usize,
        /// About when the last one was.
        when: When,
    },
    /// More cells than are worked out.
    #[error("more than {limit} cells of waves; followed until t = {when}")]
    TooManyCells {
        /// How many are worked out.
        limit: usize,
        /// How far the history was followed.
        when: When,
    },
    /// More memory than is allowed.
    #[error(
        "following the scene to the end would take more than {megabytes} MB of memory; stopped at \
         t = {when}"
    )]
    TooMuchMemory {
        /// How much is allowed.
        megabytes: u64,
        /// How far the history was followed.
        when: When,
    },
    /// A contact that opens, where it has to stay closed.
    #[error("{} and {} separate at t = {at}, and this method needs closed contacts", between[0], between[1])]
    Opens {
        /// What is at its left and right.
        between: [String; 2],
        /// When, with its unit.
        at: String,
    },
    /// A time after the last one that was asked for.
    #[error("a time after the end of the followed history")]
    AfterLast,
    /// A time before those that were asked for.
    #[error("a time before the kept part of the history")]
    Forgotten,
    /// A value that is not enclosed.
    #[error(transparent)]
    Evaluate(Box<EvaluateError>),
}

/// About when, as it is told: with its unit, in as many digits as a format asks for.
#[derive(Clone, PartialEq, Debug)]
pub struct When {
    /// In the user's unit of time.
    pub time: Box<Ball>,
    /// That unit after a space, empty where there is none.
    pub unit: &'static str,
}

impl fmt::Display for When {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = f.precision().unwrap_or(6);
        let time = Value::of(&Number::Enclosed((*self.time).clone()), digits);
        write!(f, "{}{}", time.to_text(digits), self.unit)
    }
}

/// What is not followed through the openings of contacts.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NotFollowed {
    /// A load, by its name, that imposes the velocity of what touches a mass.
    #[error(
        "the load `{0}` imposes the velocity of what touches a mass: put a spring or a bar between them"
    )]
    ImposedVelocity(String),
    /// Too many contacts in one place.
    #[error("{place} {contacts} contacts meet; at most {limit} at one place are supported")]
    ContactsInOnePlace {
        /// Where, in words.
        place: String,
        /// How many there are.
        contacts: usize,
        /// How many are followed.
        limit: usize,
    },
    /// A part without mass, at this place, that nothing resists.
    #[error("{place} a joint without mass moves, and nothing resists it")]
    Massless {
        /// Where, in words.
        place: String,
    },
    /// Two masses that meet with different velocities.
    #[error(
        "the rigid masses {} meet with different velocities{at}: put a spring or a bar between them",
        .masses.each_ref().map(|mass| format!("`{mass}`")).join(" and ")
    )]
    RigidImpact {
        /// Their names.
        masses: [String; 2],
        /// When, as ` at t = 1 s`; empty at the start.
        at: String,
    },
    /// A moving mass that meets a wall.
    #[error("the rigid mass `{mass}` hits a wall{at}: put a spring or a bar between them")]
    ImpactOnWall {
        /// Its name.
        mass: String,
        /// When, as ` at t = 1 s`; empty at the start.
        at: String,
    },
}

/// What the precision allowed does not decide.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Question {
    /// The order of two instants.
    #[error("which of two instants is earlier, an event and an arrival or two events")]
    Order,
    /// The state after several contacts of a node change at once.
    #[error("which contacts are closed after several change at once")]
    Simultaneous,
    /// The sign of the force or the gap of a contact.
    #[error("whether {quantity} {place} is positive")]
    Sign {
        /// The force or the gap.
        quantity: &'static str,
        /// Where, in words.
        place: String,
    },
    /// Whether a contact opens or closes.
    #[error("whether {quantity} {place} becomes zero")]
    Zero {
        /// The force or the gap.
        quantity: &'static str,
        /// Where, in words.
        place: String,
    },
    /// Whether a contact opens or closes before the next arrival.
    #[error("whether {quantity} {place} becomes zero before something arrives there")]
    ZeroBeforeArrival {
        /// The force or the gap.
        quantity: &'static str,
        /// Where, in words.
        place: String,
    },
    /// Which of two contacts changes first.
    #[error("whether the contact {} or {} changes first", .0[0], .0[1])]
    First([String; 2]),
}

impl Question {
    /// The answer that is taken for granted where nothing decides it, at a time in words: the case on the
    /// border.
    pub(crate) fn tied(&self, at: &str) -> String {
        match self {
            Question::Order => format!("two instants at t = {at} are one"),
            Question::Simultaneous => format!("nothing more changes at t = {at}"),
            Question::Sign { quantity, place } => format!("{quantity} {place} is zero at t = {at}"),
            Question::Zero { quantity, place } => {
                format!("{quantity} {place} does not fall below zero at t = {at}")
            }
            Question::ZeroBeforeArrival { quantity, place } => {
                format!("{quantity} {place} becomes zero when something arrives there, at t = {at}")
            }
            Question::First([one, other]) => {
                format!("the contacts {one} and {other} change at the same instant, t = {at}")
            }
        }
    }
}

impl HistoryError {
    /// Whether a zero may lie on either side of the end of a cell.
    pub(crate) fn is_at_an_end(&self) -> bool {
        let at_end = |what: &Question| matches!(what, Question::ZeroBeforeArrival { .. });
        matches!(self, HistoryError::Undecided { what, .. } if at_end(what))
    }

    /// Why there is no value with so many bits, of a scene that was followed as far as that before:
    /// nothing but the precision can be wanting.
    pub(crate) fn of_value(self, bits: u64) -> EvaluateError {
        match self {
            HistoryError::Evaluate(error) => *error,
            HistoryError::Value(error) => error.into(),
            _ => EvaluateError::NotFollowed { bits },
        }
    }
}

impl From<EnclosureError> for HistoryError {
    fn from(error: EnclosureError) -> HistoryError {
        match error {
            EnclosureError::MissingValue(symbol) => HistoryError::MissingValue(symbol),
            other => HistoryError::Value(other),
        }
    }
}

impl From<EvaluateError> for HistoryError {
    fn from(error: EvaluateError) -> HistoryError {
        match error {
            EvaluateError::MissingValue(symbol) => HistoryError::MissingValue(symbol),
            other => HistoryError::Evaluate(Box::new(other)),
        }
    }
}

impl From<BallError> for HistoryError {
    fn from(error: BallError) -> HistoryError {
        HistoryError::Value(EnclosureError::Ball(error))
    }
}
