//! The history of a scene whose contacts open and close: its events, and what became of each contact.

use crate::ball::{Attempt, Number, Precisions, Value};
use crate::enclosure::{EnclosureError, Numbers};
use crate::expression::{Expression, Root};
use crate::history::engine::Engine;
use crate::history::error::{HistoryError, Outcome};
use crate::history::moment::Moment;
use crate::history::story::Story;
use crate::limits::MAX_HISTORY_BITS;
use crate::network::Network;
use crate::scene::Dimension;
use wavestep_polynomial::Rational;

/// The precision that a scene with a local contact is begun with where no digits are asked for: its cost grows as the
/// cube of the bits, and errors hardly grow in the few contacts that there are.
pub(crate) const LEAST_BITS: u64 = 64;

/// What happens at a contact.
///
/// ```
/// use wavestep::EventKind;
///
/// // A bar strikes a wall and leaves it after two travel times.
/// let text = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed";
/// let history = wavestep::Problem::read("rod.wave", text)?.events(12)?;
/// let kinds: Vec<EventKind> = history.events.iter().map(|event| event.kind).collect();
/// assert_eq!(kinds, [EventKind::Impact, EventKind::Opening]);
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EventKind {
    /// Bodies that touch at the start press on each other from then on.
    Impact,
    /// A contact opens: it would pull.
    Opening,
    /// A contact ends with the force zero, and nothing moves apart: the bodies go on touching.
    Release,
    /// A gap closes.
    Closing,
}

impl EventKind {
    pub(crate) const ALL: [EventKind; 4] =
        [EventKind::Impact, EventKind::Opening, EventKind::Release, EventKind::Closing];

    /// Its name in reports and locks.
    #[doc(hidden)]
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            EventKind::Impact => "impact",
            EventKind::Opening => "opening",
            EventKind::Release => "release",
            EventKind::Closing => "closing",
        }
    }
}

/// A part of the line that moves by itself, with what it holds at an instant.
///
/// ```
/// let text = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed";
/// let history = wavestep::Problem::read("rod.wave", text)?.events(12)?;
/// // It comes back as it came: Z V² τ/2, and nothing of it is vibration.
/// let [rod] = &history.events[1].bodies[..] else { panic!("one body") };
/// assert_eq!(rod.energy.as_ref().unwrap().to_text(3), "0.5 = 1/2");
/// assert_eq!(rod.velocity.as_ref().unwrap().to_text(3), "-1");
/// assert_eq!(rod.vibration.as_ref().unwrap().to_text(3), "0");
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Body {
    /// The names of its elements, from left to right.
    pub elements: Vec<String>,
    /// Its energy; none where it is infinite.
    pub energy: Option<Value>,
    /// Its momentum; none where it is infinite.
    pub momentum: Option<Value>,
    /// Its mean velocity: of the centre of mass, zero where it stands fast, and what it had at the start
    /// where it is endless.
    pub velocity: Option<Value>,
    /// The energy that it has besides that of its mean motion, `E − P²/(2M)`; none where it is endless.
    pub vibration: Option<Value>,
}

/// Something that happens at a contact, in the user's units.
///
/// ```
/// let text = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed";
/// let history = wavestep::Problem::read("rod.wave", text)?.events(12)?;
/// let opening = &history.events[1];
/// assert_eq!((opening.between.join(", "), opening.time.to_f64()), ("rod, wall".into(), 2.0));
/// // The force of the impact is Z V until then.
/// assert_eq!(opening.forces.each_ref().map(|force| force.to_f64()), [1.0, 0.0]);
/// assert_eq!(opening.velocities[1][0].to_f64(), -1.0);
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Event {
    /// What happens.
    pub kind: EventKind,
    /// The contact, by its number in the line.
    pub contact: usize,
    /// The names of what is at its left and right.
    pub between: [String; 2],
    /// When.
    pub time: Value,
    /// When, in closed form: of the first opening, where the force of the closed contact is a linear
    /// function times an exponential there.
    #[doc(hidden)]
    pub exact: Option<Expression>,
    /// The force just before and just after, positive where it presses.
    pub forces: [Value; 2],
    /// The velocities at the left and the right of the contact, just before and just after.
    pub velocities: [[Value; 2]; 2],
    /// What moves by itself from then on.
    pub bodies: Vec<Body>,
}

/// What became of a contact, in the user's units.
///
/// ```
/// let text = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed";
/// let history = wavestep::Problem::read("rod.wave", text)?.events(12)?;
/// let contact = &history.contacts[0];
/// assert_eq!(contact.durations[0].as_ref().unwrap().to_f64(), 2.0);
/// assert_eq!(contact.impulses[0].to_f64(), 2.0);
/// assert_eq!(contact.restitution.as_ref().unwrap().to_f64(), 1.0);
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ContactSummary {
    /// The names of what is at its left and right.
    pub between: [String; 2],
    /// How long it was closed each time; none where it is closed still.
    pub durations: Vec<Option<Value>>,
    /// The impulse of each of these times, as far as it was followed.
    pub impulses: Vec<Value>,
    /// The coefficient of restitution of rigid bodies: the relative velocity of the mean motions after the
    /// last opening over that before the impact, with the sign changed.
    pub restitution: Option<Value>,
}

/// How the history ends.
///
/// ```
/// let text = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed";
/// let history = wavestep::Problem::read("rod.wave", text)?.events(12)?;
/// assert_eq!(history.ending, wavestep::Ending::Parted);
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Ending {
    /// Nothing can meet again: the mean motions lead apart, and the energy of vibration does not suffice
    /// to come back.
    Parted,
    /// It was followed to this instant; what comes later is not known.
    Followed(Value),
    /// The line has no contact that could open.
    NoContact,
}

/// The history of a scene.
///
/// ```
/// // A rigid mass strikes a bar of the same mass whose far end is fixed, and leaves it at 3 + exp(-2)/2.
/// let hammer = wavestep::Problem::builtin("saint-venant")?.with("mu", 1)?;
/// let history = hammer.events(20)?;
/// assert_eq!(history.events[1].time.to_string(), "3.0676676416183063459");
/// assert_eq!(history.contacts[0].impulses.len(), 2);
/// # Ok::<(), wavestep::Error>(())
/// ```
pub struct History {
    /// What happened, in the order of time.
    pub events: Vec<Event>,
    /// What became of each contact.
    pub contacts: Vec<ContactSummary>,
    /// How it ends.
    pub ending: Ending,
    /// What was taken for granted, in words, because no precision decides it; mostly nothing.
    pub assumptions: Vec<String>,
    /// The precision that did, in bits.
    #[doc(hidden)]
    pub bits: u64,
    /// How many cells of nodes were worked out at that precision.
    #[doc(hidden)]
    pub cells: usize,
}

/// A unit as a number.
pub(crate) fn unit(root: &Root, numbers: &Numbers, bits: u64) -> Result<Number, EnclosureError> {
    match root.exact().and_then(|value| value.as_constant()) {
        Some(value) => Ok(Number::of_rational(value, bits)),
        None => Ok(Number::Enclosed(numbers.enclose_root(root, bits)?)),
    }
}

impl Engine {
    /// What 1 of a dimension is in the user's units.
    pub(crate) fn unit(&self, network: &Network, dimension: Dimension) -> Outcome<Number> {
        let root = network.model().scale.unit(dimension).map_err(EnclosureError::from)?;
        Ok(unit(&root, &self.clock.numbers, self.cut.bits)?)
    }
}

/// The precisions that a scene is followed with for numbers of so many digits.
pub(crate) fn precisions(digits: usize, limit: u64) -> Precisions {
    Precisions::growing_by_half(128 + 4 * digits as u64, limit)
}

/// What is undecided may be decided with more bits.
pub(crate) fn undecided<T>(error: HistoryError) -> Outcome<Attempt<Outcome<T>>> {
    match error {
        HistoryError::Undecided { .. } => Ok(Attempt::NotYet(Err(error))),
        error => Err(error),
    }
}

#[doc(hidden)]
impl History {
    /// That of a line without contacts.
    pub fn without_contacts() -> History {
        let (events, contacts) = (Vec::new(), Vec::new());
        History {
            events,
            contacts,
            ending: Ending::NoContact,
            assumptions: Vec::new(),
            bits: 0,
            cells: 0,
        }
    }

    /// Follows a scene until a time in the user's units or until nothing can meet again; without a time for
    /// a hundred of the longest travel times at most, or ten beside a local contact, and until some 250 events. Instants have the digits asked for, unless they are exact.
    ///
    /// # Errors
    /// [`HistoryError::MissingValue`] for a symbol without a value; [`HistoryError::Refused`] for what is
    /// not followed; [`HistoryError::Undecided`] where [`MAX_HISTORY_BITS`] do not tell whether something happens;
    /// [`HistoryError::TooManyEvents`], [`HistoryError::TooManyCells`].
    ///
    /// # Cost
    /// A few products of small matrices with vectors for each coefficient of each cell; a cell begins where
    /// something arrives at a node. All is done again with half as much precision again until the digits are proven.
    pub fn of(network: &Network, until: Option<&Rational>, digits: usize) -> Outcome<History> {
        let attempt = |bits| match History::with(network, until, digits, bits) {
            Ok(history) => {
                let is_determined = history.is_determined();
                Ok(Attempt::of(Ok(history), is_determined))
            }
            Err(error @ HistoryError::Value(EnclosureError::Ball(_))) => {
                Ok(Attempt::NotYet(Err(error)))
            }
            Err(error) => undecided(error),
        };
        let precisions = match network.local_contact() {
            None => precisions(digits, MAX_HISTORY_BITS),
            Some(_) => {
                Precisions::growing_by_half(LEAST_BITS + 4 * digits as u64, MAX_HISTORY_BITS)
            }
        };
        precisions.raise(attempt)?.best()
    }

    /// Whether every instant has its digits.
    fn is_determined(&self) -> bool {
        self.events.iter().all(|event| !matches!(event.time, Value::Enclosed(_)))
    }

    /// The history at one precision.
    pub(crate) fn with(
        network: &Network,
        until: Option<&Rational>,
        digits: usize,
        bits: u64,
    ) -> Outcome<History> {
        let end = until.map(|until| Moment::at(network.scaled_time(until)));
        let mut story = Story::begin(network, digits, bits)?;
        story.follow(end.as_ref())?;
        let told = story.told()?;
        let ending = match (told.ending, until) {
            (Ending::Followed(_), Some(until)) => Ending::Followed(Value::Exact(until.clone())),
            (ending, _) => ending,
        };
        Ok(History { ending, ..told })
    }
}
