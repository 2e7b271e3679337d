//! The decisions about contacts: which are closed, which would pull or pass through each other, and which
//! changes first.
//!
//! A contact pushes and never pulls, and a gap is never negative. Whatever enclosures do not decide is
//! refused by name.

use crate::ball::{Magnitude, Number};
use crate::history::crossing::{Beginning, Course, Errors, beginning, follow, tied_beginning};
use crate::history::engine::Engine;
use crate::history::error::{HistoryError, Outcome, Question};
use crate::history::moment::Moment;
use crate::history::motion::Motion;
use crate::history::passivity::Passivity;
use crate::history::series::{CellNorm, Series, Truncation};
use crate::limits::MAX_EVENTS;
use crate::network::{ElementLaw, Lumped, Node, System};
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
    /// Whether the contact had pushed since it closed.
    pub pressed: bool,
}

/// A contact as it is.
pub(crate) struct Contact {
    pub closed: bool,
    pub gap: Number,
    /// How many derivatives of the gap are zero, exactly, when it begins to open: its velocity, and its acceleration where a force
    /// that holds two masses together has fallen to zero.
    pub flat: usize,
    /// Since when the force is exactly zero, after it was positive.
    pub idle: Option<Moment>,
    /// The last stretch without force that ended because the contact pushes again: since when, and until when.
    pub rested: Option<[Moment; 2]>,
    pub pressed: bool,
}

impl Contact {
    /// At the start.
    pub fn begun(gap: Number) -> Contact {
        Contact { closed: gap.is_zero(), gap, flat: 0, idle: None, rested: None, pressed: false }
    }

    /// The contact pushes from now on.
    pub fn push(&mut self, now: &Moment) {
        self.pressed = true;
        if let Some(since) = self.idle.take() {
            self.rested = Some([since, now.clone()]);
        }
    }
}

/// What keeps a contact as it is on a cell while it is not negative: its gap while it is open; its force while it
/// is closed, of a local one its compression.
pub(crate) struct Guard {
    kept: Kept,
    series: Series,
    /// Enclosures of its first coefficients.
    starts: Vec<Number>,
}

/// What is not negative while a contact stays as it is.
enum Kept {
    Force,
    /// Of a gap, how fast it grows.
    Gap(Series),
    /// Of a compression, how fast it grows, and the force.
    Compression(Series, Series),
}

impl Guard {
    /// Whether there is no force.
    pub fn has_no_force(&self) -> bool {
        match &self.kept {
            Kept::Force => self.series.is_zero(),
            Kept::Gap(_) => true,
            Kept::Compression(_, force) => force.is_zero(),
        }
    }

    /// Whether a contact is known to stay as it is until the end of the cell: a local one whose compression cannot come to
    /// zero there, and one whose force or gap has the sign of what arrives from a local contact that pushes.
    fn is_safe(&self) -> bool {
        match &self.kept {
            Kept::Compression(_, force) => !force.coefficients.is_empty(),
            Kept::Force | Kept::Gap(_) => {
                self.series.is_zero() || self.told() == Some(Ordering::Greater)
            }
        }
    }

    /// The sign that a force has on the cell, or a gap, by that of what arrives. A gap was not negative before, so that it is not
    /// where it grows.
    fn told(&self) -> Option<Ordering> {
        let sign = |series: &Series| series.signed.map(|own| own.sign);
        match &self.kept {
            Kept::Force => sign(&self.series),
            Kept::Gap(rate) => {
                let begins = self.starts.first().is_some_and(Number::is_zero);
                sign(rate).filter(|sign| begins || sign.is_gt())
            }
            Kept::Compression(..) => None,
        }
    }

    /// The force of a local contact.
    pub fn force_mut(&mut self) -> Option<&mut Series> {
        match &mut self.kept {
            Kept::Compression(_, force) => Some(force),
            Kept::Force | Kept::Gap(_) => None,
        }
    }

    /// Whether it is that of a local contact whose force is below the precision.
    pub fn is_light(&self) -> bool {
        matches!(self.kept, Kept::Compression(..)) && !self.is_safe()
    }

    /// Whether a local contact has a force that may be taken for zero, since its compression is.
    pub fn may_be_idle(&self) -> bool {
        self.is_light() && beginning(&self.series, &self.starts) != Beginning::Positive
    }

    /// The gap after a time, zero where the contact is closed.
    pub fn gap_after(&self, time: &Number, bits: u64) -> Number {
        match &self.kept {
            Kept::Gap(apart) => apart.integrated(&self.series, time, bits),
            Kept::Force | Kept::Compression(..) => Number::zero(),
        }
    }

    /// What else is known of the compression of a local contact: it has the sign of the force, and is minus the gap
    /// where the contact is open.
    pub fn complete(&self, compression: &mut Series, bits: u64) {
        match &self.kept {
            Kept::Compression(_, force) => compression.signed = force.signed,
            Kept::Gap(_) => *compression = Series::zero().subtract(&self.series, bits),
            Kept::Force => {}
        }
    }

    pub fn into_force_and_gap(self) -> (Series, Series) {
        match self.kept {
            Kept::Force => (self.series, Series::zero()),
            Kept::Gap(_) => (Series::zero(), self.series),
            Kept::Compression(_, force) => (force, Series::zero()),
        }
    }

    /// It over the power `x^j` that it begins with, and the errors of that.
    ///
    /// The error `e` of the function itself has `j` zeros at the start, with what its polynomial has there.
    /// The derivatives of a gap are those of how fast the bodies move apart, of one order less.
    fn skipped(&self, norm: &CellNorm, cut: &Truncation) -> (Series, Errors) {
        let skipped = self.starts.iter().take_while(|c| c.is_zero()).count();
        let (known, lifts) = match &self.kept {
            Kept::Force => (&self.series, 0),
            Kept::Gap(rate) | Kept::Compression(rate, _) => (rate, 1),
        };
        let low = (0..skipped.saturating_sub(lifts)).map(|k| known.coefficient(k).magnitude());
        let low = norm.of_sizes(&low.collect::<Vec<_>>());
        let [error, rest] = [known.error, known.rest].map(|bound| bound.add(&low));
        let bound = |order: usize| match order.checked_sub(lifts) {
            None => error.multiply(&norm.length),
            Some(0) => error,
            Some(order) => known.bound_of_derivative(&rest, order, cut),
        };
        let errors = Errors::new(skipped, bound);
        let kept = self.series.coefficients.iter().skip(skipped).cloned().collect();
        let kept = Series::new(kept, self.series.rest).with_error(error, Magnitude::ZERO);
        (Series { roughness: self.series.roughness, ..kept }, errors)
    }

    /// The size of the first derivatives that may be zero, besides those that are, in the norm of cells.
    fn undecided_at_start(&self, rate: i64) -> Magnitude {
        let left = self.starts.iter().zip(0_i64..).skip_while(|(c, _)| c.is_zero());
        let open = left.take_while(|(c, _)| c.sign().is_none());
        open.map(|(c, k)| c.magnitude().scale(-rate * k)).fold(Magnitude::ZERO, Magnitude::max)
    }

    fn quantity(&self) -> &'static str {
        match self.kept {
            Kept::Force => "the force",
            Kept::Gap(_) => "the gap",
            Kept::Compression(..) => "the compression",
        }
    }
}

/// The supports that let go of a node as its contacts change, with their stiffness and where their displacement stood.
fn relieved<'n>(
    node: &'n Node<Number>,
    [before, after]: [&'n System<Number>; 2],
) -> impl Iterator<Item = (&'n Lumped<Number>, &'n Number, usize)> {
    let places = before.kept.iter().zip(&after.kept);
    node.elements.iter().zip(places).filter_map(|(own, places)| match (&own.law, places) {
        (ElementLaw::Support { stiffness, .. }, (Some(place), None)) => {
            Some((own, stiffness, *place))
        }
        _ => None,
    })
}

impl Engine {
    fn between(&self, contact: usize) -> String {
        let [left, right] = &self.layout.contacts[contact].names;
        format!("between {left} and {right}")
    }

    /// The guards of the contacts of a node on a cell.
    pub fn guards(
        &self,
        node: usize,
        motion: &Motion,
        input: &[Series],
        norm: &CellNorm,
    ) -> Vec<Guard> {
        if self.nodes[node].contacts().next().is_none() {
            return Vec::new();
        }
        let (bits, runs) = (self.cut.bits, self.nodes[node].runs());
        let state = &self.states[node];
        let starts = state.system.starts(&state.state, input, &self.cut);
        let guard = |(contact, run): (usize, usize)| {
            let closed = state.system.closed.iter().position(|own| own.0 == contact);
            if let Some(row) = closed {
                let (series, starts) = (&motion.forces[row], &starts[runs + row]);
                let (series, starts) = (series.clone(), starts.clone());
                return Guard { kept: Kept::Force, series, starts };
            }
            let own = &self.open[contact];
            if self.has_let_go {
                let kept = Kept::Gap(Series::zero());
                return Guard { kept, series: Series::zero(), starts: Vec::new() };
            }
            let known = match own.closed {
                true => self.nodes[node].local_contact(contact).and_then(|place| {
                    Some((state.system.kept[place]?, state.system.driven[place]?))
                }),
                false => None,
            };
            let first = known.map_or(&own.gap, |(place, _)| &state.state[place]);
            let [less, more] = if known.is_some() { [run + 1, run] } else { [run, run + 1] };
            let rate = motion.velocities[more].subtract(&motion.velocities[less], bits);
            let series = rate.integral_over(first.clone(), &norm.length, &self.cut);
            let [less, more] = [less, more].map(|run| &starts[run]);
            let mut starts = vec![first.clone()];
            for (k, (less, more)) in (1..).zip(less.iter().zip(more)) {
                starts.push(more.subtract(less, bits).over(k, bits));
            }
            starts.iter_mut().skip(1).take(own.flat).for_each(|start| *start = Number::zero());
            let kept = match known {
                Some((_, force)) => Kept::Compression(rate, input[force].clone()),
                None => Kept::Gap(rate),
            };
            Guard { kept, series, starts }
        };
        self.nodes[node].contacts().map(guard).collect()
    }

    /// Which contacts of a node change at once: those that would pull, and those whose gap would become
    /// negative.
    pub fn changes(&self, node: usize, guards: &[Guard]) -> Outcome<Vec<usize>> {
        let mut changes = Vec::new();
        for (guard, (contact, _)) in guards.iter().zip(self.nodes[node].contacts()) {
            match beginning(&guard.series, &guard.starts) {
                Beginning::Positive | Beginning::Zero => {}
                Beginning::Negative => changes.push(contact),
                Beginning::Undecided if guard.told() == Some(Ordering::Less) => {
                    changes.push(contact)
                }
                Beginning::Undecided
                    if guard.told() == Some(Ordering::Greater)
                        || self.only_touches(contact, guard) => {}
                Beginning::Undecided => {
                    let (quantity, place) = (guard.quantity(), self.between(contact));
                    let now = self.clock.time(&self.states[node].now)?;
                    let size = guard.undecided_at_start(self.cut.rate);
                    self.clock.tie(Question::Sign { quantity, place }, &now, &size)?;
                    if tied_beginning(&guard.starts) == Beginning::Negative {
                        changes.push(contact);
                    }
                }
            }
        }
        Ok(changes)
    }

    /// Of contacts that would change at once, those that do. What undamped supports alone would hold on, displaced, pushes
    /// what is at one side of it: there the contact stays closed.
    pub fn yielding(&self, node: usize, changes: Vec<usize>) -> Outcome<Vec<usize>> {
        let (own, state, bits) = (&self.nodes[node], &self.states[node], self.cut.bits);
        let next =
            self.system(node, |contact| self.open[contact].closed != changes.contains(&contact))?;
        let mut pushes = vec![Number::zero(); own.runs()];
        for (lumped, stiffness, place) in relieved(own, [&state.system, &next]) {
            let push = &mut pushes[next.group[lumped.run]];
            *push = push.add(&stiffness.multiply(&state.state[place], bits), bits);
        }
        let now = self.clock.time(&state.now)?;
        let mut pressed = Vec::new();
        for (group, push) in pushes.iter().enumerate().filter(|(_, push)| !push.is_zero()) {
            let beside = |side: usize| {
                let mut parting = own.contacts().filter(|(own, _)| changes.contains(own));
                let found = parting.find(|(_, run)| next.group[run + 1 - side] == group);
                found.map(|(contact, _)| contact)
            };
            let side = match push.sign() {
                Some(Ordering::Less) => beside(1),
                Some(_) => beside(0),
                // It is let go where it rests already.
                None => {
                    let contact = beside(0).or(beside(1)).unwrap_or(changes[0]);
                    let (quantity, place) = ("the force", self.between(contact));
                    self.clock.tie(Question::Sign { quantity, place }, &now, &push.magnitude())?;
                    continue;
                }
            };
            pressed.push(side.ok_or_else(|| self.clock.undecided(Question::Simultaneous, &now))?);
        }
        Ok(changes.into_iter().filter(|contact| !pressed.contains(contact)).collect())
    }

    /// Whether a local contact has not been pressed yet, as far as is known, and may not be on this cell either: its
    /// force is within its bounds whether it is closed or open, so that nothing has to be decided.
    fn only_touches(&self, contact: usize, guard: &Guard) -> bool {
        !self.open[contact].pressed && guard.may_be_idle()
    }

    /// What becomes of a force or a gap on a cell of its node that begins now. What may be negative by no more
    /// than a tie is taken not to be.
    fn course(
        &self,
        contact: usize,
        guard: &Guard,
        (now, length): (&Number, &Number),
        norm: &CellNorm,
    ) -> Outcome<Course> {
        let cut = &self.cut;
        let (series, errors) = guard.skipped(norm, cut);
        let at = match follow(&series, (&errors, &Magnitude::ZERO), length, cut) {
            Course::Undecided(at) => now.add(&Number::Enclosed(at), cut.bits),
            course => return Ok(course),
        };
        let what = Question::Zero { quantity: guard.quantity(), place: self.between(contact) };
        if let Some(tie) = self.clock.tie_size()
            && let course @ (Course::Positive | Course::Falls(_)) =
                follow(&series, (&errors, &tie), length, cut)
        {
            self.clock.assume(what, &at);
            return Ok(course);
        }
        Err(self.clock.undecided(what, &at))
    }

    /// Which contact of a node changes first on a cell of this length, by its force or its gap coming to
    /// zero, and how long after the start of the cell. Where nothing changes at its end, a shorter one
    /// tells what becomes zero just there.
    pub fn first_change(
        &self,
        node: usize,
        guards: &[Guard],
        (length, is_step): (&Number, bool),
        norm: &CellNorm,
    ) -> Outcome<Option<(usize, Number)>> {
        let bits = self.cut.bits;
        let now = self.clock.time(&self.states[node].now)?;
        let after = |time: &Number| now.add(time, bits);
        let mut first: Option<(usize, Number)> = None;
        for (guard, (contact, _)) in guards.iter().zip(self.nodes[node].contacts()) {
            if guard.is_safe() || self.only_touches(contact, guard) {
                continue;
            }
            let at = match self.course(contact, guard, (&now, length), norm)? {
                Course::Falls(at) => at,
                _ => continue,
            };
            let before = at.subtract(length, bits);
            match before.sign() {
                Some(Ordering::Less) => {}
                Some(_) => continue,
                None => {
                    let (quantity, place) = (guard.quantity(), self.between(contact));
                    let what = Question::ZeroBeforeArrival { quantity, place };
                    if is_step {
                        return Err(self.clock.undecided(what, &after(&at)));
                    }
                    self.clock.tie(what, &after(&at), &before.magnitude())?;
                    continue;
                }
            }
            first = Some(match first {
                None => (contact, at),
                Some((other, earliest)) => {
                    let before = at.subtract(&earliest, bits);
                    match before.sign() {
                        Some(Ordering::Less) => (contact, at),
                        Some(Ordering::Greater) => (other, earliest),
                        _ => {
                            let both = [other, contact].map(|one| self.between(one));
                            let what = Question::First(both);
                            self.clock.tie(what, &after(&at), &before.magnitude())?;
                            (other, earliest)
                        }
                    }
                }
            });
        }
        Ok(first)
    }

    /// Opens closed contacts and closes open ones at the time of a node.
    pub fn change(&mut self, node: usize, changes: &[usize], cause: Cause) -> Outcome<()> {
        let bits = self.cut.bits;
        let now = self.states[node].now.clone();
        if self.happenings.len() + changes.len() > MAX_EVENTS {
            let when = self.clock.told(&self.clock.time(&now)?);
            return Err(HistoryError::TooManyEvents { limit: MAX_EVENTS, when });
        }
        for contact in changes {
            self.happen(*contact, &now, cause);
        }
        let (own, state) = (&self.nodes[node], &self.states[node]);
        let open = &self.open;
        let system = self.system(node, |contact| open[contact].closed)?;
        let known = |place: Option<usize>| place.map(|place| state.state[place].clone());
        let displaced: Vec<Number> = (state.system.kept.iter())
            .map(|place| known(*place).unwrap_or_else(Number::zero))
            .collect();
        let before = &state.system;
        let rests = |run: usize| before.held[before.group[run]].then(Number::zero);
        let velocity = |run: usize| known(before.place_of_velocity(run)).or_else(|| rests(run));
        let impact = |runs| self.impact(own, runs, Some(&now));
        let next = system.state(own, velocity, &displaced, impact, bits)?;
        let is_kept = |system: &System<Number>, place: usize| system.kept[place].is_some();
        let is_spring = |place: &usize| !own.elements[*place].law.is_driven();
        let loosened = (0..own.elements.len())
            .filter(is_spring)
            .any(|place| is_kept(&system, place) != is_kept(&state.system, place));
        for contact in changes {
            let run = self.layout.contacts[*contact].run;
            let inert = system.has_inertia(run) && system.has_inertia(run + 1);
            let own = &mut self.open[*contact];
            // The end of a spring that comes loose leaves with a velocity of its own.
            let is_local = self.nodes[node].local_contact(*contact).is_some();
            own.flat = match cause {
                _ if own.closed || loosened || is_local => 0,
                Cause::Crossing => 1 + usize::from(inert),
                _ => usize::from(inert),
            };
        }
        let passivity = Passivity::at(&self.nodes[node], &system, (&next, self.cut.bits))?;
        let state = &mut self.states[node];
        // What rests on supports that have let go is where it began.
        for (lumped, ..) in relieved(&self.nodes[node], [&state.system, &system]) {
            let own = |run: &usize| system.group[*run] == system.group[lumped.run];
            let runs = (0..system.group.len()).filter(own);
            runs.for_each(|run| state.displacements[run] = Number::zero());
        }
        state.errors = passivity.errors(&next);
        (state.system, state.passivity, state.state) = (system, passivity, next);
        Ok(())
    }

    /// Notes that a contact opens or closes now. One that does both at one instant, while others settle, has done neither.
    fn happen(&mut self, contact: usize, now: &Moment, cause: Cause) {
        let known = &mut self.open[contact];
        let moment = known.idle.take().unwrap_or_else(|| now.clone());
        let pressed = std::mem::take(&mut known.pressed);
        known.closed = !known.closed;
        known.gap = Number::zero();
        let closes = known.closed;
        let undone = |own: &Happening| {
            (own.contact, own.cause, cause) == (contact, Cause::Jump, Cause::Jump)
                && own.forced == *now
        };
        if let Some(last) = self.happenings.iter().rposition(undone) {
            let last = self.happenings.remove(last);
            known.pressed = last.pressed;
            known.idle = (last.moment != last.forced).then_some(last.moment);
            return;
        }
        let forced = now.clone();
        self.happenings.push(Happening { closes, cause, contact, moment, forced, pressed });
    }

    /// Replaces the springs that stand for the local contacts of a node by ones about as stiff as these are now, if
    /// they differ much.
    pub fn follow_stiffness(&mut self, node: usize) -> Outcome<()> {
        let state = &self.states[node];
        if state.passivity.is_near(&state.state) {
            return Ok(());
        }
        let passivity =
            Passivity::at(&self.nodes[node], &state.system, (&state.state, self.cut.bits))?;
        let errors = passivity.carried(&state.passivity, &state.errors);
        let state = &mut self.states[node];
        (state.passivity, state.errors) = (passivity, errors);
        Ok(())
    }

    /// Contacts that press from the start close then.
    pub fn tell_impacts(&mut self, node: usize, guards: &[Guard]) {
        for (guard, (contact, _)) in guards.iter().zip(self.nodes[node].contacts()) {
            if !guard.has_no_force() {
                let moment = self.states[node].now.clone();
                let forced = moment.clone();
                self.happenings.push(Happening {
                    closes: true,
                    cause: Cause::Jump,
                    contact,
                    moment,
                    forced,
                    pressed: false,
                });
            }
        }
    }

    /// Whether a contact has no force on a cell: exactly, or by a tie that was taken for granted at its start.
    pub fn is_unloaded(&self, guard: &Guard, norm: &CellNorm) -> bool {
        let is_tied = |tie: Magnitude| {
            let force = &guard.series;
            matches!(guard.kept, Kept::Force)
                && beginning(force, &guard.starts) == Beginning::Undecided
                && tied_beginning(&guard.starts) == Beginning::Zero
                && force.size_from(0, &norm.length).add(&force.error) <= tie
        };
        guard.has_no_force() || self.clock.tie_size().is_some_and(is_tied)
    }

    /// Whether a contact is open, or touches without force since an instant.
    pub fn is_open(&self, contact: usize) -> bool {
        !self.open[contact].closed
    }

    /// Since when a closed contact has had no force.
    pub fn idle_since(&self, contact: usize) -> Option<&Moment> {
        self.open[contact].idle.as_ref()
    }

    /// Since when a contact had had no force until an instant, where it pushes again from then on.
    pub fn rested_until(&self, contact: usize, end: &Moment) -> Outcome<Option<&Moment>> {
        let Some([since, until]) = &self.open[contact].rested else { return Ok(None) };
        let ends = self.clock.compare(until, end)? == Ordering::Equal;
        Ok(ends.then_some(since))
    }

    /// Whether a closed contact has no force now.
    pub fn is_idle(&self, contact: usize) -> bool {
        let own = &self.open[contact];
        own.closed && (own.idle.is_some() || !own.pressed)
    }
}
