//! The history of a scene whose contacts open and close: its events, and what became of each contact.

use crate::ball::{Attempt, Number, Precisions, Value};
use crate::enclosure::{EnclosureError, Numbers};
use crate::expression::{Expression, Fraction, Root};
use crate::history::body::parts;
use crate::history::closed_form;
use crate::history::energy::Integrand;
use crate::history::engine::Engine;
use crate::history::error::HistoryError;
use crate::history::moment::Moment;
use crate::limits::MAX_HISTORY_BITS;
use crate::network::Network;
use crate::scene::{Dimension, Kind};
use crate::signal::Limit;
use std::cmp::Ordering;
use std::ops::Range;
use wavestep_polynomial::Rational;

/// How many of the longest travel times a history is followed where no end is given.
pub(crate) const PATIENCE: u32 = 100;

/// The same beside a local contact, which takes some seconds for each time that it is pressed.
const PATIENCE_WITH_LOCAL_CONTACTS: u32 = 10;

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

type Outcome<T> = Result<T, HistoryError>;

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
    /// a hundred of the longest travel times at most, or ten beside a local contact. Instants have the digits asked for, unless they are exact.
    ///
    /// # Errors
    /// [`HistoryError::MissingValue`] for a symbol without a value; [`HistoryError::Refused`] for what is
    /// not followed; [`HistoryError::Undecided`] where [`MAX_HISTORY_BITS`] do not tell whether something happens;
    /// [`HistoryError::TooManyEvents`], [`HistoryError::TooManyCells`].
    ///
    /// # Cost
    /// A few products of small matrices with vectors for each coefficient of each cell; a cell begins where
    /// something arrives at a node. All is done again with half as much precision again until the digits are proven.
    pub fn of(
        network: &Network,
        until: Option<&Rational>,
        digits: usize,
    ) -> Result<History, HistoryError> {
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
        let mut engine = Engine::new(network, network.as_ref().contacts_that_may_open(), bits)?;
        let (end, parted) = match until {
            Some(until) => {
                let until = Moment::at(network.scaled_time(until));
                match follow_to_the_end(network, &mut engine, Some(&until))? {
                    (end, true) => (end, true),
                    _ => {
                        engine.follow_until(&until)?;
                        let parted = has_parted(network, &engine, &until)?;
                        (until, parted)
                    }
                }
            }
            None => follow_to_the_end(network, &mut engine, None)?,
        };
        let story = Story { network, engine, digits, end, parted };
        story.told()
    }
}

/// The longest travel time; one unit where nothing travels.
pub(crate) fn longest(engine: &Engine) -> Outcome<Fraction> {
    let mut longest = Fraction::zero();
    for travel in engine.bars.iter().filter_map(|(_, travel)| travel.as_ref()) {
        if engine.clock.numbers.compare(travel, &longest)? == Ordering::Greater {
            longest = travel.clone();
        }
    }
    Ok(if longest.is_zero() { Fraction::one() } else { longest })
}

/// Follows until nothing can meet again, for a while, or until an instant is near.
fn follow_to_the_end(
    network: &Network,
    engine: &mut Engine,
    until: Option<&Moment>,
) -> Outcome<(Moment, bool)> {
    let travel = longest(engine)?;
    let mut end = Moment::at(Fraction::zero());
    let patience = match network.local_contact() {
        None => PATIENCE,
        Some(_) => PATIENCE_WITH_LOCAL_CONTACTS,
    };
    for step in 1..=patience {
        let count = Rational::from_integer(step.into());
        let next = Moment::at(travel.scale(&count));
        if let Some(until) = until
            && engine.clock.compare(&next, until)? != Ordering::Less
        {
            break;
        }
        end = next;
        engine.follow_until(&end)?;
        if has_parted(network, engine, &end)? {
            return Ok((end, true));
        }
    }
    Ok((end, false))
}

/// Whether nothing can meet again after an instant.
fn has_parted(network: &Network, engine: &Engine, moment: &Moment) -> Outcome<bool> {
    let count = engine.layout.contacts.len();
    // What happens a little later is known already; then the instant tells nothing.
    for happening in &engine.happenings {
        if engine.clock.compare(&happening.moment, moment)? == Ordering::Greater {
            return Ok(false);
        }
    }
    let apart = |contact: usize| engine.is_open(contact) || engine.is_idle(contact);
    if count == 0 || !(0..count).all(apart) {
        return Ok(count == 0);
    }
    let joints: Vec<usize> = engine.layout.contacts.iter().map(|contact| contact.joint).collect();
    let parts = parts(network, &joints);
    let wall = [0..0, usize::MAX..usize::MAX];
    for (contact, joint) in joints.iter().enumerate() {
        let left = parts.iter().find(|part| part.end == *joint).unwrap_or(&wall[0]);
        let right = parts.iter().find(|part| part.start == *joint).unwrap_or(&wall[0]);
        if !engine.never_meets(network, contact, [left, right], moment)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// A history that is being told.
struct Story<'a> {
    network: &'a Network,
    engine: Engine,
    digits: usize,
    end: Moment,
    parted: bool,
}

/// An event in the scale of the scene.
struct Row {
    kind: EventKind,
    contact: usize,
    moment: Moment,
}

impl Story<'_> {
    fn told(self) -> Outcome<History> {
        let rows = self.rows()?;
        let mut closed = vec![true; self.engine.layout.contacts.len()];
        let mut events = Vec::new();
        let first = rows.iter().position(|row| row.kind != EventKind::Impact);
        for (number, row) in rows.iter().enumerate() {
            closed[row.contact] = matches!(row.kind, EventKind::Impact | EventKind::Closing);
            let mut event = self.event(row, &closed)?;
            if first == Some(number) && row.kind == EventKind::Opening {
                event.exact = self.opening(row)?;
            }
            events.push(event);
        }
        let mut contacts = Vec::new();
        for contact in 0..self.engine.layout.contacts.len() {
            contacts.push(self.summary(contact, &rows, &closed)?);
        }
        let ending = match self.parted {
            true => Ending::Parted,
            false => {
                let time = self.engine.clock.time(&self.end)?;
                Ending::Followed(self.value(&time, Dimension::TIME)?)
            }
        };
        let (bits, cells) = (self.engine.cut.bits, self.engine.count());
        let assumptions = self.network.assumed.all();
        Ok(History { events, contacts, ending, assumptions, bits, cells })
    }

    /// A number of the scene's scale as a value in the user's units.
    fn value(&self, number: &Number, dimension: Dimension) -> Outcome<Value> {
        let unit = self.engine.unit(self.network, dimension)?;
        Ok(Value::of(&number.multiply(&unit, self.engine.cut.bits), self.digits))
    }

    /// All events until the end, in order.
    fn rows(&self) -> Outcome<Vec<Row>> {
        let engine = &self.engine;
        let start = Moment::at(Fraction::zero());
        let mut rows = Vec::new();
        for happening in &engine.happenings {
            if engine.clock.compare(&happening.moment, &self.end)? == Ordering::Greater {
                continue;
            }
            let kind = match happening.closes {
                true if happening.moment == start => EventKind::Impact,
                true => EventKind::Closing,
                false => EventKind::Opening,
            };
            rows.push(Row { kind, contact: happening.contact, moment: happening.moment.clone() });
        }
        for contact in 0..engine.layout.contacts.len() {
            if let Some(moment) = engine.idle_since(contact) {
                let moment = moment.clone();
                rows.push(Row { kind: EventKind::Release, contact, moment });
            }
        }
        // A change that is taken back at the same instant is none.
        let mut kept: Vec<Row> = Vec::new();
        for row in rows {
            let same = |other: &Row| other.contact == row.contact && other.moment == row.moment;
            let back = |other: &Row| same(other) && other.kind != row.kind && row.moment != start;
            match kept.last().is_some_and(back) {
                true => drop(kept.pop()),
                false => kept.push(row),
            }
        }
        let about = |row: &Row| engine.clock.about(&row.moment);
        kept.sort_by(|a, b| {
            let order = engine.clock.compare(&a.moment, &b.moment);
            order.unwrap_or_else(|_| about(a).total_cmp(&about(b)))
        });
        Ok(kept)
    }

    /// An opening in closed form, where its instant is not rational.
    fn opening(&self, row: &Row) -> Outcome<Option<Expression>> {
        let Number::Enclosed(instant) = self.engine.clock.time(&row.moment)? else {
            return Ok(None);
        };
        if self.network.local_contact().is_some() {
            return Ok(None);
        }
        let joint = self.engine.layout.contacts[row.contact].joint;
        Ok(closed_form::opening(self.network, joint, &instant))
    }

    fn event(&self, row: &Row, closed: &[bool]) -> Outcome<Event> {
        let engine = &self.engine;
        let (before, old) = engine.beside(row.contact, &row.moment, Limit::Left)?;
        let (mut after, new) = engine.beside(row.contact, &row.moment, Limit::Right)?;
        if !closed[row.contact] {
            after = Number::zero();
        }
        // A force that comes to zero by itself is zero then, though its enclosure is not a point.
        let zero = |force: Number| match force.sign() {
            None => Number::zero(),
            Some(_) => force,
        };
        let before = if row.kind == EventKind::Closing { before } else { zero(before) };
        let time = engine.clock.time(&row.moment)?;
        let force = |force: &Number| self.value(force, Dimension::FORCE);
        let velocities = |[left, right]: [Number; 2]| -> Outcome<[Value; 2]> {
            let velocity = |velocity: &Number| self.value(velocity, Dimension::VELOCITY);
            Ok([velocity(&left)?, velocity(&right)?])
        };
        Ok(Event {
            kind: row.kind,
            contact: row.contact,
            between: engine.layout.contacts[row.contact].names.clone(),
            time: self.value(&time, Dimension::TIME)?,
            exact: None,
            forces: [force(&before)?, force(&after)?],
            velocities: [velocities(old)?, velocities(new)?],
            bodies: self.bodies(&row.moment, closed)?,
        })
    }

    /// The parts of the line at an instant.
    fn parts(&self, closed: &[bool]) -> Vec<Range<usize>> {
        let contacts = self.engine.layout.contacts.iter().zip(closed);
        let open = contacts.filter(|(_, closed)| !**closed).map(|(contact, _)| contact.joint);
        parts(self.network, &open.collect::<Vec<_>>())
    }

    fn bodies(&self, moment: &Moment, closed: &[bool]) -> Outcome<Vec<Body>> {
        let (engine, bits, scene) = (&self.engine, self.engine.cut.bits, self.network.scene());
        let told = |value: &Option<Number>, dimension| {
            value.as_ref().map(|value| self.value(value, dimension)).transpose()
        };
        let mut bodies = Vec::new();
        for part in self.parts(closed) {
            let square =
                Integrand::Square { bits: precisions(self.digits, MAX_HISTORY_BITS).first() };
            let held = engine.held_by(self.network, &part, moment, square)?;
            let velocity = engine.mean_velocity(self.network, &part, moment)?;
            let mass = engine.mass_of(self.network, &part)?;
            let carried = match (&held.momentum, &velocity) {
                (Some(momentum), Some(velocity)) if mass.is_some() => {
                    Some(momentum.multiply(velocity, bits).over(2, bits))
                }
                _ => None,
            };
            let elements = &scene.line.elements[part.clone()];
            let rigid = |element: &usize| {
                matches!(scene.elements[*element].kind, Kind::Mass(_) | Kind::Load(_))
            };
            let vibration = match (&held.energy, carried) {
                (Some(_), Some(_)) if elements.iter().all(rigid) => Some(Number::zero()),
                (Some(energy), Some(carried)) => Some(energy.subtract(&carried, bits)),
                _ => None,
            };
            let names = scene.line.elements[part].iter();
            bodies.push(Body {
                elements: names.map(|element| scene.elements[*element].name.clone()).collect(),
                energy: told(&held.energy, Dimension::ENERGY)?,
                momentum: told(&held.momentum, Dimension::MOMENTUM)?,
                velocity: told(&velocity, Dimension::VELOCITY)?,
                vibration: told(&vibration, Dimension::ENERGY)?,
            });
        }
        Ok(bodies)
    }

    /// Durations, impulses and restitution of a contact.
    fn summary(&self, contact: usize, rows: &[Row], closed: &[bool]) -> Outcome<ContactSummary> {
        let engine = &self.engine;
        let (mut durations, mut impulses) = (Vec::new(), Vec::new());
        let mut since = Some(Moment::at(Fraction::zero()));
        let mut any = false;
        let mut stretch = |from: &Moment, to: &Moment, ended: bool| -> Outcome<()> {
            let impulse = engine.impulse(contact, [from, to])?;
            let duration = engine.clock.since(from, to)?;
            if impulse.is_zero() {
                return Ok(());
            }
            impulses.push(self.value(&impulse, Dimension::MOMENTUM)?);
            let duration = self.value(&duration, Dimension::TIME)?;
            durations.push(ended.then_some(duration));
            Ok(())
        };
        for row in rows.iter().filter(|row| row.contact == contact) {
            match row.kind {
                EventKind::Impact => {}
                EventKind::Closing => since = Some(row.moment.clone()),
                EventKind::Opening | EventKind::Release => {
                    if let Some(from) = since.take() {
                        stretch(&from, &row.moment, true)?;
                        any = true;
                    }
                }
            }
        }
        if let Some(from) = &since {
            stretch(from, &self.end, false)?;
        }
        let last = rows.iter().rev().find(|row| row.contact == contact);
        let restitution = match last.filter(|_| any && !closed[contact]) {
            Some(row) => self.restitution(contact, &row.moment)?,
            None => None,
        };
        let between = engine.layout.contacts[contact].names.clone();
        Ok(ContactSummary { between, durations, impulses, restitution })
    }

    /// The relative velocity of the mean motions at an instant over that at the start, with the sign
    /// changed; none where they did not meet, or where a body has no mean motion.
    fn restitution(&self, contact: usize, moment: &Moment) -> Outcome<Option<Value>> {
        let (engine, bits) = (&self.engine, self.engine.cut.bits);
        let joints: Vec<usize> =
            engine.layout.contacts.iter().map(|contact| contact.joint).collect();
        let parts = parts(self.network, &joints);
        let joint = joints[contact];
        let sides = [
            parts.iter().find(|part| part.end == joint),
            parts.iter().find(|part| part.start == joint),
        ];
        let relative = |moment: &Moment| -> Outcome<Option<Number>> {
            let mut velocities = Vec::new();
            for side in &sides {
                velocities.push(match side {
                    Some(part) => engine.mean_velocity(self.network, part, moment)?,
                    None => Some(Number::zero()),
                });
            }
            let [Some(left), Some(right)] = &velocities[..] else { return Ok(None) };
            Ok(Some(right.subtract(left, bits)))
        };
        let start = Moment::at(Fraction::zero());
        let (Some(before), Some(after)) = (relative(&start)?, relative(moment)?) else {
            return Ok(None);
        };
        if before.sign() != Some(Ordering::Less) {
            return Ok(None);
        }
        let ratio = after.multiply(&before.reciprocal(bits)?, bits).negate();
        Ok(Some(Value::of(&ratio, self.digits)))
    }
}
