//! The decisions about contacts: which are closed, which would pull or pass through each other, and which
//! changes first.
//!
//! A contact pushes and never pulls, and a gap is never negative. Whatever enclosures do not decide is
//! refused by name.

use crate::ball::Number;
use crate::history::crossing::{Beginning, Course, beginning, follow};
use crate::history::engine::Engine;
use crate::history::error::{HistoryError, Question};
use crate::history::moment::Moment;
use crate::history::motion::Motion;
use crate::history::series::Series;
use crate::limits::MAX_EVENTS;
use crate::network::System;
use std::cmp::Ordering;

/// Why a contact closed or opened.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Cause {
    /// Its force or its gap came to zero by itself.
    Crossing,
    /// What arrives jumped.
    Jump,
}

/// That a contact closed or opened.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Happening {
    /// Whether the contact closed.
    pub closes: bool,
    pub cause: Cause,
    pub contact: usize,
    pub moment: Moment,
    /// When the contact would have pulled, or the gap have become negative: later than the moment where a
    /// contact had had no force for a while.
    pub forced: Moment,
}

/// A contact as it is.
pub(crate) struct Contact {
    pub closed: bool,
    pub gap: Number,
    /// Whether the gap begins to open with velocity zero, exactly.
    pub rests: bool,
    /// Since when the force is exactly zero, after it was positive.
    pub idle: Option<Moment>,
    pub pressed: bool,
}

type Outcome<T> = Result<T, HistoryError>;

impl Engine {
    fn between(&self, contact: usize) -> String {
        let [left, right] = &self.layout.contacts[contact].names;
        format!("between {left} and {right}")
    }

    /// Forces and gaps of the contacts of a node on a cell.
    pub fn contact_series(&self, node: usize, motion: &Motion) -> (Vec<Series>, Vec<Series>) {
        let (mut forces, mut gaps) = (Vec::new(), Vec::new());
        for (contact, run) in self.nodes[node].contacts() {
            let closed = self.states[node].system.closed.iter().position(|own| own.0 == contact);
            let Some(row) = closed else {
                let apart =
                    motion.velocities[run + 1].subtract(&motion.velocities[run], self.cut.bits);
                let own = &self.open[contact];
                let mut gap = apart.integral(own.gap.clone(), &self.cut);
                if own.rests && gap.coefficients.len() > 1 {
                    gap.coefficients[1] = Number::zero();
                }
                forces.push(Series::zero());
                gaps.push(gap);
                continue;
            };
            forces.push(motion.forces[row].clone());
            gaps.push(Series::zero());
        }
        (forces, gaps)
    }

    /// Which contacts of a node change at once: those that would pull, and those whose gap would become
    /// negative.
    pub fn changes(&self, node: usize, forces: &[Series], gaps: &[Series]) -> Outcome<Vec<usize>> {
        let mut changes = Vec::new();
        for (place, (contact, _)) in self.nodes[node].contacts().enumerate() {
            let closed = self.open[contact].closed;
            let series = if closed { &forces[place] } else { &gaps[place] };
            match beginning(series) {
                Beginning::Positive | Beginning::Zero => {}
                Beginning::Negative => changes.push(contact),
                Beginning::Undecided => {
                    let quantity = if closed { "the force" } else { "the gap" };
                    let what = Question::Sign { quantity, place: self.between(contact) };
                    return self.undecided(what, &self.states[node].now, None);
                }
            }
        }
        Ok(changes)
    }

    /// Which contact of a node changes first on a cell of this length, by its force or its gap coming to
    /// zero, and how long after the start of the cell.
    pub fn first_change(
        &self,
        node: usize,
        [forces, gaps]: [&[Series]; 2],
        length: &Number,
    ) -> Outcome<Option<(usize, Number)>> {
        let now = &self.states[node].now;
        let mut first: Option<(usize, Number)> = None;
        for (place, (contact, _)) in self.nodes[node].contacts().enumerate() {
            let closed = self.open[contact].closed;
            let series = if closed { &forces[place] } else { &gaps[place] };
            if series.is_zero() {
                continue;
            }
            let quantity = if closed { "the force" } else { "the gap" };
            let at = match follow(series, length, &self.cut) {
                Course::Positive => continue,
                Course::Falls(at) => at,
                Course::Undecided(at) => {
                    let what = Question::Zero { quantity, place: self.between(contact) };
                    return self.undecided(what, now, Some(&at));
                }
            };
            match at.subtract(length, self.cut.bits).sign() {
                Some(Ordering::Less) => {}
                Some(_) => continue,
                None => {
                    let place = self.between(contact);
                    let what = Question::ZeroBeforeArrival { quantity, place };
                    return self.undecided(what, now, Some(&at.ball(self.cut.bits)));
                }
            }
            first = Some(match first {
                None => (contact, at),
                Some((other, earliest)) => match at.subtract(&earliest, self.cut.bits).sign() {
                    Some(Ordering::Less) => (contact, at),
                    Some(Ordering::Greater) => (other, earliest),
                    _ => {
                        let what = Question::First([other, contact].map(|one| self.between(one)));
                        return self.undecided(what, now, Some(&at.ball(self.cut.bits)));
                    }
                },
            });
        }
        Ok(first)
    }

    /// Opens closed contacts and closes open ones at the time of a node.
    pub fn change(&mut self, node: usize, changes: &[usize], cause: Cause) -> Outcome<()> {
        let bits = self.cut.bits;
        let now = self.states[node].now.clone();
        let own = &self.nodes[node];
        if self.happenings.len() + changes.len() > MAX_EVENTS {
            let at = self.ball_at(&now);
            return Err(HistoryError::TooManyEvents { limit: MAX_EVENTS, at });
        }
        for contact in changes {
            let known = &mut self.open[*contact];
            let moment = known.idle.take().unwrap_or_else(|| now.clone());
            known.closed = !known.closed;
            known.gap = Number::zero();
            known.pressed = false;
            let (closes, contact, forced) = (known.closed, *contact, now.clone());
            self.happenings.push(Happening { closes, cause, contact, moment, forced });
        }
        let state = &self.states[node];
        let open = &self.open;
        let system = self.system(node, |contact| open[contact].closed)?;
        let known = |place: Option<usize>| place.map(|place| state.state[place].clone());
        let displaced: Vec<Number> = (state.system.kept.iter())
            .map(|place| known(*place).unwrap_or_else(Number::zero))
            .collect();
        let velocity = |run: usize| known(state.system.place_of_velocity(run));
        let next = system.state(own, velocity, &displaced, &self.places[node], bits)?;
        let is_kept = |system: &System<Number>, place: usize| system.kept[place].is_some();
        let loosened = (0..own.elements.len())
            .any(|place| is_kept(&system, place) != is_kept(&state.system, place));
        for contact in changes {
            let run = self.layout.contacts[*contact].run;
            let inert = system.has_inertia(run) && system.has_inertia(run + 1);
            let own = &mut self.open[*contact];
            own.rests = !own.closed && (inert || cause == Cause::Crossing && !loosened);
        }
        let state = &mut self.states[node];
        (state.system, state.state) = (system, next);
        Ok(())
    }

    /// Contacts that press from the start close then.
    pub fn tell_impacts(&mut self, node: usize, forces: &[Series]) {
        for (place, (contact, _)) in self.nodes[node].contacts().enumerate() {
            if self.open[contact].closed && !forces[place].is_zero() {
                let moment = self.states[node].now.clone();
                let forced = moment.clone();
                self.happenings.push(Happening {
                    closes: true,
                    cause: Cause::Jump,
                    contact,
                    moment,
                    forced,
                });
            }
        }
    }

    /// Whether a contact is open, or touches without force since an instant.
    pub fn is_open(&self, contact: usize) -> bool {
        !self.open[contact].closed
    }

    /// Since when a closed contact has had no force.
    pub fn idle_since(&self, contact: usize) -> Option<&Moment> {
        self.open[contact].idle.as_ref()
    }

    /// Whether a closed contact has no force now.
    pub fn is_idle(&self, contact: usize) -> bool {
        let own = &self.open[contact];
        own.closed && (own.idle.is_some() || !own.pressed)
    }
}
