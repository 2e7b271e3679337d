//! A history that is being told while it is followed: events in the order of time, and what became of each contact.
//!
//! Mostly all is told at the end. Where what is followed takes much memory, events are told on the way, and what was
//! before them is forgotten but for the waves that are still on their way. Beside a contact that has lost its force and
//! stays closed nothing is forgotten: what may still be told happened when it lost it.

use crate::ball::{Number, Value};
use crate::enclosure::sorted;
use crate::expression::{Expression, Fraction};
use crate::history::body::parts;
use crate::history::closed_form;
use crate::history::contacts::Happening;
use crate::history::energy::Integrand;
use crate::history::engine::Engine;
use crate::history::error::{HistoryError, Outcome};
use crate::history::history::{
    Body, ContactSummary, Ending, Event, EventKind, History, precisions,
};
use crate::history::moment::Moment;
use crate::limits::{MAX_EVENTS, MAX_HISTORY_BITS, MAX_HISTORY_CELLS, memory};
use crate::network::Network;
use crate::scene::{Dimension, Kind};
use crate::signal::Limit;
use std::cmp::Ordering;
use std::ops::Range;
use wavestep_polynomial::Rational;

/// How many of the longest travel times a history is followed where no end is given.
pub const PATIENCE: u32 = 100;

/// The same beside a local contact, which takes some seconds for each time that it is pressed.
const PATIENCE_WITH_LOCAL_CONTACTS: u32 = 10;

/// How many cells are followed where no end is given, until the next multiple of that time: echoes of travel times without a
/// common measure are ever more.
const MANY_CELLS: usize = MAX_HISTORY_CELLS / 4;

/// And after so many events.
const MANY_EVENTS: usize = MAX_EVENTS / 4;

/// Events are told on the way where what is kept takes more than this share of the memory.
const MUCH: u64 = 64;

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

/// An event in the scale of the scene.
struct Row {
    kind: EventKind,
    contact: usize,
    moment: Moment,
}

/// What became of a contact so far.
struct Course {
    /// Since when it has been closed; none while it is open.
    since: Option<Moment>,
    /// Its impulse since then, as far as it is counted.
    impulse: Number,
    /// Until when that is.
    counted: Moment,
    durations: Vec<Option<Value>>,
    impulses: Vec<Value>,
    /// When it opened last, until the coefficient of restitution after that is told.
    opened: Option<Moment>,
    restitution: Option<Value>,
}

/// A history that is being told.
pub struct Story<'a> {
    network: &'a Network,
    engine: Engine,
    digits: usize,
    end: Moment,
    parted: bool,
    /// How many happenings were looked at, and which of these are still to be told.
    seen: usize,
    waiting: Vec<Row>,
    events: Vec<Event>,
    /// Which contacts are closed after the last event.
    closed: Vec<bool>,
    courses: Vec<Course>,
    /// Of each contact the relative velocity of the mean motions at the start, once they are asked for.
    approaches: Option<Vec<Option<Number>>>,
}

impl Story<'_> {
    /// The scene at its start.
    pub fn begin(network: &Network, digits: usize, bits: u64) -> Outcome<Story<'_>> {
        let engine = Engine::new(network, network.contacts_that_may_open(), bits)?;
        let start = Moment::at(Fraction::zero());
        let course = |closed: &bool| Course {
            since: closed.then(|| start.clone()),
            impulse: Number::zero(),
            counted: start.clone(),
            durations: Vec::new(),
            impulses: Vec::new(),
            opened: None,
            restitution: None,
        };
        let closed: Vec<bool> =
            engine.layout.contacts.iter().map(|own| own.gap.is_zero()).collect();
        Ok(Story {
            network,
            engine,
            digits,
            end: start.clone(),
            parted: false,
            seen: 0,
            waiting: Vec::new(),
            events: Vec::new(),
            courses: closed.iter().map(course).collect(),
            closed,
            approaches: None,
        })
    }

    /// Follows the scene until an instant or until nothing can meet again; without an instant for a while, or as far as it can be
    /// followed in the longest travel times.
    pub fn follow(&mut self, until: Option<&Moment>) -> Outcome<()> {
        let travel = longest(&self.engine)?;
        let patience = match self.network.local_contact() {
            None => PATIENCE,
            Some(_) => PATIENCE_WITH_LOCAL_CONTACTS,
        };
        let times = |count: u32| Moment::at(travel.scale(&Rational::from_integer(count.into())));
        self.engine.whole = self.engine.clock.about(until.unwrap_or(&times(patience)));
        let mut count = 0;
        loop {
            count += if count < patience { 1 } else { patience };
            let next = match until {
                None if count > patience || self.is_long() => return Ok(()),
                None => times(count),
                Some(until) => self.engine.clock.earlier(until.clone(), times(count))?,
            };
            let is_last = until == Some(&next);
            // Until then it may end early.
            if let Some(until) = until.filter(|_| count > patience) {
                self.engine.foresee_cells(until, |_| true)?;
            }
            match self.engine.follow_until(&next) {
                // What is known until then is told.
                Err(HistoryError::TooManyCells { .. } | HistoryError::TooMuchMemory { .. })
                    if until.is_none() && count > 1 =>
                {
                    return Ok(());
                }
                followed => followed?,
            }
            self.end = next;
            self.parted = (count <= patience || is_last)
                && self.engine.has_parted(self.network, &self.end)?;
            if self.parted || is_last {
                return Ok(());
            }
            if self.engine.bytes > memory() / MUCH {
                self.tell_and_forget()?;
            }
        }
    }

    /// Whether there is much to tell already, where no end was asked for.
    fn is_long(&self) -> bool {
        self.engine.count() > MANY_CELLS || self.engine.happenings.len() > MANY_EVENTS
    }

    /// Tells what was before the end and forgets it, unless a contact has come to no force: the event that follows, if
    /// one does, is told of the instant when it did.
    fn tell_and_forget(&mut self) -> Outcome<()> {
        let mut contacts = 0..self.engine.layout.contacts.len();
        if contacts.any(|contact| self.engine.idle_since(contact).is_some()) {
            return Ok(());
        }
        self.look();
        let end = self.end.clone();
        let mut rows = Vec::new();
        for row in std::mem::take(&mut self.waiting) {
            match self.engine.clock.compare(&row.moment, &end)? {
                Ordering::Less => rows.push(row),
                _ => self.waiting.push(row),
            }
        }
        self.tell(rows)?;
        self.approaches()?;
        for contact in 0..self.courses.len() {
            self.count_impulse(contact, &end)?;
            self.tell_restitution(contact)?;
        }
        self.engine.forget_before(&end);
        Ok(())
    }

    /// The history until the end.
    pub fn told(mut self) -> Outcome<History> {
        self.look();
        let mut rows = Vec::new();
        for row in std::mem::take(&mut self.waiting) {
            if self.engine.clock.compare(&row.moment, &self.end)? != Ordering::Greater {
                rows.push(row);
            }
        }
        for contact in 0..self.courses.len() {
            let since = match self.engine.idle_since(contact) {
                None => self.engine.rested_until(contact, &self.end)?,
                since => since,
            };
            if let Some(moment) = since.cloned() {
                push(&mut rows, Row { kind: EventKind::Release, contact, moment });
            }
        }
        self.tell(rows)?;
        let mut contacts = Vec::new();
        for contact in 0..self.courses.len() {
            contacts.push(self.summary(contact)?);
        }
        let ending = match self.parted {
            true => Ending::Parted,
            false => {
                let time = self.engine.clock.time(&self.end)?;
                Ending::Followed(self.value(&time, Dimension::TIME)?)
            }
        };
        let (bits, cells) = (self.engine.cut.bits, self.engine.count());
        let (events, assumptions) = (self.events, self.network.assumed.all());
        Ok(History { events, contacts, ending, assumptions, bits, cells })
    }

    /// A number of the scene's scale as a value in the user's units.
    fn value(&self, number: &Number, dimension: Dimension) -> Outcome<Value> {
        let unit = self.engine.unit(self.network, dimension)?;
        Ok(Value::of(&number.multiply(&unit, self.engine.cut.bits), self.digits))
    }

    /// What happened since it was looked last waits to be told.
    fn look(&mut self) {
        let start = Moment::at(Fraction::zero());
        for happening in &self.engine.happenings[self.seen..] {
            let Happening { contact, closes, moment, forced, .. } = happening.clone();
            let kind = match closes {
                true if moment == start => EventKind::Impact,
                true => EventKind::Closing,
                false => EventKind::Opening,
            };
            // Without force since earlier, the bodies touch until they move apart.
            if kind == EventKind::Opening && moment != forced {
                push(&mut self.waiting, Row { kind: EventKind::Release, contact, moment });
                push(&mut self.waiting, Row { kind, contact, moment: forced });
            } else {
                push(&mut self.waiting, Row { kind, contact, moment });
            }
        }
        self.seen = self.engine.happenings.len();
    }

    /// Tells events in the order of time.
    fn tell(&mut self, rows: Vec<Row>) -> Outcome<()> {
        let clock = &self.engine.clock;
        let about = |row: &Row| clock.about(&row.moment);
        let rows = sorted(rows, &|a: &Row, b: &Row| -> Outcome<Ordering> {
            let order = clock.compare(&a.moment, &b.moment);
            Ok(order.unwrap_or_else(|_| about(a).total_cmp(&about(b))))
        })?;
        for row in rows {
            self.closed[row.contact] = matches!(row.kind, EventKind::Impact | EventKind::Closing);
            let mut event = self.event(&row)?;
            let is_first = self.events.iter().all(|event| event.kind == EventKind::Impact);
            if is_first && row.kind == EventKind::Opening {
                event.exact = self.opening(&row)?;
            }
            self.events.push(event);
            self.carry(row)?;
        }
        Ok(())
    }

    /// Carries an event over to the course of its contact.
    fn carry(&mut self, Row { kind, contact, moment }: Row) -> Outcome<()> {
        match kind {
            EventKind::Impact => {}
            EventKind::Closing => {
                let course = &mut self.courses[contact];
                (course.since, course.counted) = (Some(moment.clone()), moment);
            }
            EventKind::Opening | EventKind::Release => {
                self.end_stretch(contact, &moment, true)?;
                let course = &mut self.courses[contact];
                (course.opened, course.restitution) = (Some(moment), None);
            }
        }
        Ok(())
    }

    /// Counts the impulse of a contact until an instant.
    fn count_impulse(&mut self, contact: usize, until: &Moment) -> Outcome<()> {
        let course = &self.courses[contact];
        if course.since.is_some() {
            let further = self.engine.impulse(contact, [&course.counted, until])?;
            let course = &mut self.courses[contact];
            course.impulse = course.impulse.add(&further, self.engine.cut.bits);
            course.counted = until.clone();
        }
        Ok(())
    }

    /// A contact has been closed until an instant, and opens then or not yet.
    fn end_stretch(&mut self, contact: usize, until: &Moment, opens: bool) -> Outcome<()> {
        self.count_impulse(contact, until)?;
        let course = &mut self.courses[contact];
        let impulse = std::mem::replace(&mut course.impulse, Number::zero());
        let Some(from) = course.since.take().filter(|_| !impulse.is_zero()) else { return Ok(()) };
        let duration = self.engine.clock.since(&from, until)?;
        let impulse = self.value(&impulse, Dimension::MOMENTUM)?;
        let duration = self.value(&duration, Dimension::TIME)?;
        let course = &mut self.courses[contact];
        course.impulses.push(impulse);
        course.durations.push(opens.then_some(duration));
        Ok(())
    }

    /// Durations, impulses and restitution of a contact.
    fn summary(&mut self, contact: usize) -> Outcome<ContactSummary> {
        let end = self.end.clone();
        self.end_stretch(contact, &end, false)?;
        self.tell_restitution(contact)?;
        let is_open = !self.closed[contact];
        let between = self.engine.layout.contacts[contact].names.clone();
        let Course { durations, impulses, restitution, .. } = &mut self.courses[contact];
        let (durations, impulses) = (std::mem::take(durations), std::mem::take(impulses));
        let restitution = restitution.take().filter(|_| is_open);
        Ok(ContactSummary { between, durations, impulses, restitution })
    }

    /// The relative velocity of the mean motions beside a contact at an instant; none where a body has no mean motion.
    fn relative(&self, contact: usize, moment: &Moment) -> Outcome<Option<Number>> {
        let engine = &self.engine;
        let mut velocities = Vec::new();
        for part in engine.bodies_beside(self.network, contact) {
            velocities.push(match part.is_empty() {
                true => Some(Number::zero()),
                false => engine.mean_velocity(self.network, &part, moment)?,
            });
        }
        let [Some(left), Some(right)] = &velocities[..] else { return Ok(None) };
        Ok(Some(right.subtract(left, engine.cut.bits)))
    }

    /// The coefficient of restitution after the last opening, unless it is told: the relative velocity of the mean
    /// motions then over that at the start, with the sign changed; none where the bodies did not meet.
    fn tell_restitution(&mut self, contact: usize) -> Outcome<()> {
        let Some(opened) = self.courses[contact].opened.take() else { return Ok(()) };
        let approach = self.approaches()?[contact].clone();
        let approach = approach.filter(|own| own.sign() == Some(Ordering::Less));
        let Some(before) = approach else { return Ok(()) };
        if let Some(after) = self.relative(contact, &opened)? {
            let bits = self.engine.cut.bits;
            let ratio = after.multiply(&before.reciprocal(bits)?, bits).negate();
            self.courses[contact].restitution = Some(Value::of(&ratio, self.digits));
        }
        Ok(())
    }

    fn approaches(&mut self) -> Outcome<&[Option<Number>]> {
        if self.approaches.is_none() {
            let start = Moment::at(Fraction::zero());
            let relative = |contact| self.relative(contact, &start);
            let all = (0..self.courses.len()).map(relative).collect::<Outcome<Vec<_>>>()?;
            self.approaches = Some(all);
        }
        Ok(self.approaches.as_deref().unwrap_or_default())
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

    fn event(&self, row: &Row) -> Outcome<Event> {
        let engine = &self.engine;
        let (before, old) = engine.beside(row.contact, &row.moment, Limit::Left)?;
        let (mut after, new) = engine.beside(row.contact, &row.moment, Limit::Right)?;
        if !self.closed[row.contact] {
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
            bodies: self.bodies(&row.moment)?,
        })
    }

    /// The parts of the line between the contacts that are open after the last event.
    fn parts(&self) -> Vec<Range<usize>> {
        let contacts = self.engine.layout.contacts.iter().zip(&self.closed);
        let open = contacts.filter(|(_, closed)| !**closed).map(|(contact, _)| contact.joint);
        parts(self.network, &open.collect::<Vec<_>>())
    }

    fn bodies(&self, moment: &Moment) -> Outcome<Vec<Body>> {
        let (engine, bits, scene) = (&self.engine, self.engine.cut.bits, self.network.scene());
        let told = |value: &Option<Number>, dimension| {
            value.as_ref().map(|value| self.value(value, dimension)).transpose()
        };
        let mut bodies = Vec::new();
        for part in self.parts() {
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
}

/// One more event, unless it takes the one before back at the same instant: then neither is one.
fn push(rows: &mut Vec<Row>, row: Row) {
    let is_taken_back = rows.last().is_some_and(|last| {
        let is_same = last.contact == row.contact && last.moment == row.moment;
        is_same && last.kind != row.kind && row.moment != Moment::at(Fraction::zero())
    });
    match is_taken_back {
        true => drop(rows.pop()),
        false => rows.push(row),
    }
}
