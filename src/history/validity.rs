//! How long the form with closed contacts is true: until a contact would pull.
//!
//! Until then a scene whose contacts open and one whose contacts stay closed move alike, so the first
//! opening of the one is the end of the other. It is found without following anything beyond it.

use crate::ball::{Attempt, Ball, Value};
use crate::history::contacts::Happening;
use crate::history::engine::Engine;
use crate::history::error::{HistoryError, Outcome, When};
use crate::history::history::{precisions, undecided};
use crate::history::moment::{Moment, TOLD_DIGITS};
use crate::history::story::{PATIENCE, longest};
use crate::limits::MAX_HISTORY_BITS;
use crate::network::Network;
use crate::scene::Dimension;
use std::cmp::Ordering;
use wavestep_polynomial::Rational;

/// Until when the form with closed contacts is true, in the user's units.
///
/// ```
/// use wavestep::history::Validity;
/// use wavestep::language::{Source, parse_number, read_scene};
/// use wavestep::network::Network;
///
/// let text = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed";
/// let scene = read_scene(&Source::new("text", text)?, &Default::default()).unwrap();
/// let network = Network::new(&scene).unwrap();
/// // With closed contacts the wall would pull the bar after two travel times.
/// let Validity::Until { time, between } = Validity::of(&network, None, 12, 200).unwrap() else {
///     panic!("the bar leaves the wall")
/// };
/// assert_eq!((time.to_text(12).as_str(), between), ("2", ["rod".into(), "wall".into()]));
/// // Nothing pulls before.
/// let Validity::Followed(time) = Validity::of(&network, Some(&parse_number("1")?), 12, 200).unwrap() else {
///     panic!("the bar is pressed on the wall")
/// };
/// assert_eq!(time.to_text(12), "1");
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Validity {
    /// At this instant the first contact would pull.
    Until {
        /// When.
        time: Value,
        /// The names of what is at its left and right.
        between: [String; 2],
    },
    /// Until this instant nothing pulls; what comes later was not followed.
    Followed(Value),
}

impl Validity {
    /// Follows a scene until a contact would pull, or until a time in the user's units; without one for a
    /// hundred of the longest travel times. No more than so many cells are worked out. Contacts count as
    /// such that open, whether the scene says so or not; one that has no force is closed still.
    ///
    /// # Errors
    /// As [`History::of`](crate::history::History::of), but for the count of cells.
    ///
    /// # Cost
    /// That of following the scene so far, once where the precision begun with decides everything.
    pub fn of(
        network: &Network,
        until: Option<&Rational>,
        digits: usize,
        cells: usize,
    ) -> Outcome<Validity> {
        let attempt = |bits| match followed(network, until, digits, (bits, cells)) {
            Ok(told) => {
                let is_open = matches!(told, Validity::Until { time: Value::Enclosed(_), .. });
                Ok(Attempt::of(Ok(told), !is_open))
            }
            Err(error) => undecided(error),
        };
        precisions(digits, MAX_HISTORY_BITS).raise(attempt)?.best()
    }
}

/// How many cells are followed to see that contacts stay closed.
const MOST_CELLS: usize = 5_000;

/// That contacts stay closed until a time in the user's units.
///
/// # Errors
/// [`HistoryError::Opens`]; [`HistoryError::TooManyCells`] where that is not known after [`MOST_CELLS`]; else as
/// [`Validity::of`].
pub fn stays_closed(network: &Network, until: &Rational) -> Outcome<()> {
    match Validity::of(network, Some(until), TOLD_DIGITS, MOST_CELLS)? {
        Validity::Followed(time) => {
            let time = time.ball(MAX_HISTORY_BITS);
            let until = Ball::from_rational(until, MAX_HISTORY_BITS);
            let left = until.subtract(&time, MAX_HISTORY_BITS);
            match left.sign() {
                Some(Ordering::Greater) => {
                    let unit = if network.scene().dimensional { " s" } else { "" };
                    let when = When { time: Box::new(time), unit };
                    Err(HistoryError::TooManyCells { limit: MOST_CELLS, when })
                }
                _ => Ok(()),
            }
        }
        Validity::Until { time, between } => {
            let unit = if network.scene().dimensional { " s" } else { "" };
            let at = time.to_text(TOLD_DIGITS) + unit;
            Err(HistoryError::Opens { between, at })
        }
    }
}

fn followed(
    network: &Network,
    until: Option<&Rational>,
    digits: usize,
    (bits, cells): (u64, usize),
) -> Outcome<Validity> {
    let mut engine = Engine::new(network, network.contacts_that_may_open(), bits)?;
    let until = Moment::at(match until {
        Some(until) => network.scaled_time(until),
        None => longest(&engine)?.scale(&Rational::from_integer(PATIENCE.into())),
    });
    let (first, end) = engine.first_opening(&until, cells)?;
    let unit = engine.unit(network, Dimension::TIME)?;
    let time = engine.clock.time(&end)?.multiply(&unit, bits);
    let time = Value::of(&time, digits);
    Ok(match first {
        Some(first) => {
            let between = engine.layout.contacts[first.contact].names.clone();
            Validity::Until { time, between }
        }
        None => Validity::Followed(time),
    })
}

impl Engine {
    /// Follows all nodes until a contact opens or to an instant, whichever is first, with at most so many
    /// cells in all: the first opening, in the order of [`Happening::forced`], and how far it was followed.
    /// A change that is taken back at the same instant is none.
    ///
    /// A node that is behind may open a contact earlier than one that was found. So all nodes are followed
    /// to the first opening found; what opened there does not change what was before.
    ///
    /// # Errors
    /// As [`Engine::follow_until`], but for the count of cells.
    fn first_opening(
        &mut self,
        until: &Moment,
        limit: usize,
    ) -> Outcome<(Option<Happening>, Moment)> {
        loop {
            let first = self.earliest_opening()?;
            let end = match &first {
                Some(first) => self.clock.earlier(first.forced.clone(), until.clone())?,
                None => until.clone(),
            };
            let Some((node, now)) = self.behind() else { return Ok((None, end)) };
            if self.clock.compare(now, &end)? == Ordering::Greater {
                return Ok((first.filter(|first| first.forced == end), end));
            }
            if self.count() >= limit {
                return Ok((None, now.clone()));
            }
            self.advance(node)?;
        }
    }

    /// The opening known so far at which a contact would have pulled first.
    fn earliest_opening(&self) -> Outcome<Option<Happening>> {
        let mut first: Option<&Happening> = None;
        for (number, own) in self.happenings.iter().enumerate() {
            let back = |later: &Happening| {
                later.closes && later.contact == own.contact && later.forced == own.forced
            };
            if own.closes || self.happenings[number..].iter().any(back) {
                continue;
            }
            let is_earlier = match first {
                Some(first) => self.clock.compare(&own.forced, &first.forced)? == Ordering::Less,
                None => true,
            };
            first = if is_earlier { Some(own) } else { first };
        }
        Ok(first.cloned())
    }
}
