//! Events and extrema in words, for a terminal and for a page.

use wavestep::ball::{Bound, Decimal, in_decimals};
use wavestep::export::expression_text;
use wavestep::history::{Body, ContactSummary, Ending, Event, EventKind, History};
use wavestep::problem::Problem;
use wavestep::scene::{Dimension, Joint};
use wavestep::signal::{Place, Value};
use wavestep_polynomial::Rational;

/// The fewest digits of the ends of an interval somewhere in which an extremum may be.
const PLACE_DIGITS: usize = 6;

/// Tells what was found in a problem, in so many significant digits.
#[derive(Clone, Copy)]
pub struct Teller<'a> {
    pub problem: &'a Problem,
    pub digits: usize,
    /// How many characters a fraction has at most that is told beside its digits.
    pub longest_fraction: usize,
}

impl Teller<'_> {
    /// A value without its unit; where the scene has units, exact values are decimals, rounded where they do not end.
    pub fn number(&self, value: &Value) -> String {
        let rounded = || value.decimal(self.digits).0.to_string();
        match value {
            Value::Exact(number) if self.problem.has_units() => {
                let decimals = in_decimals(number);
                if decimals.contains('/') { rounded() } else { decimals }
            }
            Value::Exact(fraction) if fraction.to_string().len() > self.longest_fraction => {
                rounded()
            }
            other => other.to_text(self.digits),
        }
    }

    /// The same with the unit.
    pub fn value(&self, value: &Value, dimension: Dimension) -> String {
        let text = self.number(value);
        match self.problem.has_units() {
            true => format!("{text} {}", dimension.unit()).trim_end().to_owned(),
            false => text,
        }
    }

    /// A time; where the scene has no units, exact ones are fractions.
    pub fn time(&self, time: &Value) -> String {
        match time {
            Value::Exact(time) if !self.problem.has_units() => time.to_string(),
            _ => self.value(time, Dimension::TIME),
        }
    }

    fn pair(&self, [before, after]: &[Value; 2], dimension: Dimension) -> String {
        let (before, after) = (self.value(before, dimension), self.value(after, dimension));
        if before == after { before } else { format!("{before} -> {after}") }
    }

    /// The events in their order, what became of each contact, and how it ends: a sentence each, with the
    /// lines below it.
    pub fn history(&self, history: &History) -> Vec<(String, Vec<String>)> {
        let events = history.events.iter().enumerate().map(|(place, event)| {
            let before = &history.events[..place];
            self.event(event, before.iter().any(|own| own.contact == event.contact))
        });
        let contacts = history.contacts.iter().map(|contact| self.contact(contact));
        let ending = (self.ending(&history.ending), Vec::new());
        events.chain(contacts).chain([ending]).collect()
    }

    fn event(&self, event: &Event, again: bool) -> (String, Vec<String>) {
        let [left, right] = &event.between;
        let exact = event.exact.as_ref().map(|exact| format!(" = {}", expression_text(exact)));
        let happens = match event.kind {
            EventKind::Closing if again => "make contact again",
            EventKind::Impact | EventKind::Closing => "make contact",
            EventKind::Opening => "separate",
            EventKind::Release => "touch without force from here on",
        };
        let time = self.value(&event.time, Dimension::TIME) + &exact.unwrap_or_default();
        let mut lines = vec![format!("force    {}", self.pair(&event.forces, Dimension::FORCE))];
        let [[l0, r0], [l1, r1]] = event.velocities.clone();
        for (name, pair) in [(left, [l0, l1]), (right, [r0, r1])] {
            if name != "wall" {
                let velocity = self.pair(&pair, Dimension::VELOCITY);
                lines.push(format!("velocity {velocity} of {name}"));
            }
        }
        lines.extend(event.bodies.iter().map(|body| self.body(body)));
        (format!("t = {time}: {left} and {right} {happens}"), lines)
    }

    fn body(&self, body: &Body) -> String {
        let named = [
            ("energy", &body.energy, Dimension::ENERGY),
            ("vibration energy", &body.vibration, Dimension::ENERGY),
            ("momentum", &body.momentum, Dimension::MOMENTUM),
            ("mean velocity", &body.velocity, Dimension::VELOCITY),
        ];
        let told = named.into_iter().filter_map(|(name, value, dimension)| {
            Some(format!("{name} {}", self.value(value.as_ref()?, dimension)))
        });
        format!("{}: {}", body.elements.join(" - "), told.collect::<Vec<_>>().join(", "))
    }

    fn contact(&self, contact: &ContactSummary) -> (String, Vec<String>) {
        let closed = contact.durations.iter().zip(&contact.impulses).map(|(duration, impulse)| {
            let impulse = self.value(impulse, Dimension::MOMENTUM);
            match duration {
                Some(duration) => {
                    format!(
                        "closed for {}, impulse {impulse}",
                        self.value(duration, Dimension::TIME)
                    )
                }
                None => format!("still closed, impulse so far {impulse}"),
            }
        });
        let mut lines: Vec<String> = closed.collect();
        if lines.is_empty() {
            lines.push("no force throughout".to_owned());
        }
        let restitution = contact.restitution.as_ref();
        lines.extend(
            restitution
                .map(|ratio| format!("coefficient of restitution {}", ratio.to_text(self.digits))),
        );
        let [left, right] = &contact.between;
        (format!("Between {left} and {right}"), lines)
    }

    fn ending(&self, ending: &Ending) -> String {
        match ending {
            Ending::Parted => {
                "No further contact: the bodies move apart or stay at rest, and their vibration energy \
                 is too\nsmall to bring them together."
                    .to_owned()
            }
            Ending::Followed(end) => {
                let end = self.value(end, Dimension::TIME);
                format!("Followed until t = {end}; later events are not known.")
            }
            Ending::NoContact => "Nothing can open: there is no contact.".to_owned(),
        }
    }

    /// The ends of an interval, rounded outwards, with as many digits as show about how wide it is.
    fn ends(&self, from: &Rational, to: &Rational) -> [Decimal; 2] {
        let ends = |digits| {
            [Decimal::bound(from, digits, Bound::Lower), Decimal::bound(to, digits, Bound::Upper)]
        };
        let twice = (to - from) * Rational::from_integer(2.into());
        let shows = |[from, to]: &[Decimal; 2]| to.to_rational() - from.to_rational() <= twice;
        let last = self.digits.max(PLACE_DIGITS);
        (PLACE_DIGITS..last).map(ends).find(shows).unwrap_or_else(|| ends(last))
    }

    /// A place at which an extremum is taken.
    pub fn place(&self, place: &Place) -> String {
        match place {
            Place::Critical(time) => format!("at t = {} (critical point)", self.time(time)),
            Place::End(time) => format!("at t = {} (end of the window)", self.time(time)),
            Place::Arrival { time, before, after } => {
                let limit = match (before, after) {
                    (true, true) => "both limits",
                    (false, _) => "right limit",
                    _ => "left limit, not attained",
                };
                format!("at t = {} (arrival, {limit})", self.time(time))
            }
            Place::Plateau { from, to, closed } => {
                let relation = if *closed { "<=" } else { "<" };
                format!("for {} <= t {relation} {} (constant)", self.time(from), self.time(to))
            }
            Place::Undecided { from, to } => {
                let [from, to] = self.ends(from, to);
                let second = if self.problem.has_units() { " s" } else { "" };
                format!("somewhere in {from}{second} <= t <= {to}{second} (undecided)")
            }
        }
    }
}

/// Whether contacts of a scene open, where it has some; local ones are none of these.
pub fn contacts_open(problem: &Problem) -> Option<bool> {
    let scene = problem.scaled().ok()?.scene();
    scene.line.joints.contains(&Joint::Contact).then_some(scene.contacts_open)
}
