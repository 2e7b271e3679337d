//! The parts that an observable is the sum of: waves with their delays, motions of nodes, compressions.

use crate::ball::Number;
use crate::evaluate::Limit;
use crate::expression::Fraction;
use crate::history::energy::Integrand;
use crate::history::engine::{Cell, Engine};
use crate::history::error::HistoryError;
use crate::history::moment::Moment;
use crate::history::series::Series;
use crate::network::{ElementLaw, Side};

type Outcome<T> = Result<T, HistoryError>;

/// What changes with time by itself.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Source {
    /// A wave in a bar: to the right (0), or to the left (1).
    Wave { bar: usize, direction: usize },
    /// What a node does.
    Node { node: usize, signal: Signal },
}

/// What a node does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Signal {
    /// The velocity of a run.
    Velocity(usize),
    /// The displacement of a run since the start.
    Displacement(usize),
    /// The compression of a spring or support.
    Yield(usize),
    /// The force of a contact, by its place among those of the node.
    Force(usize),
}

/// `c · f(t − a)` or `c · ∫_0^t f(s − a) ds`.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Part {
    pub source: Source,
    /// `a`; none for what comes in an endless bar and is always the same.
    pub delay: Option<Fraction>,
    /// `c`.
    pub factor: Number,
    /// Whether it is the integral.
    pub integrated: bool,
}

impl Part {
    /// What changes by itself, without delay.
    pub fn of(source: Source, factor: Number) -> Part {
        Part { source, delay: Some(Fraction::zero()), factor, integrated: false }
    }
}

impl Cell {
    fn series(&self, signal: Signal) -> &Series {
        match signal {
            Signal::Velocity(run) => &self.velocities[run],
            Signal::Displacement(run) => &self.displacements[run],
            Signal::Yield(place) => &self.yields[place],
            Signal::Force(place) => &self.forces[place],
        }
    }
}

impl Engine {
    /// The value of a part.
    ///
    /// # Errors
    /// As [`Engine::cell`].
    pub fn value_of(&self, part: &Part, moment: &Moment, limit: Limit) -> Outcome<Number> {
        let value = match part.source {
            Source::Node { node, signal } => {
                let (start, cell) = self.cell(node, moment, limit)?;
                cell.series(signal).value(&self.clock.since(start, moment)?, &self.cut)
            }
            Source::Wave { bar, direction } => {
                let track = &self.waves[bar][direction];
                match (&part.delay, part.integrated) {
                    (Some(delay), false) => {
                        track.value(&self.clock, &moment.before(delay), limit, &self.cut)?
                    }
                    (Some(delay), true) => {
                        let start = Moment::at(Fraction::zero());
                        let window = [&start.before(delay), &moment.before(delay)];
                        track.integral(Integrand::Wave, &self.clock, window, &self.cut)?
                    }
                    (None, false) => track.before().coefficient(0),
                    (None, true) => {
                        let time = self.clock.time(moment)?;
                        track.before().coefficient(0).multiply(&time, self.cut.bits)
                    }
                }
            }
        };
        Ok(part.factor.multiply(&value, self.cut.bits))
    }

    /// A part from an instant on, until the next of its breaks.
    ///
    /// # Errors
    /// As [`Engine::cell`].
    pub fn series_of(&self, part: &Part, now: &Moment) -> Outcome<Series> {
        let (start, series) = match (part.source, &part.delay) {
            (Source::Node { node, signal }, _) => {
                let (start, cell) = self.cell(node, now, Limit::Right)?;
                (start.clone(), cell.series(signal))
            }
            (Source::Wave { bar, direction }, Some(delay)) => {
                let track = &self.waves[bar][direction];
                let cell = track.cell(&self.clock, &now.before(delay), Limit::Right)?;
                let (start, wave) = &track.cells[cell];
                (start.after(delay), wave.series())
            }
            (Source::Wave { bar, direction }, None) => {
                (now.clone(), self.waves[bar][direction].before())
            }
        };
        let (bits, zero) = (self.cut.bits, Number::zero());
        let series = series.shift(&self.clock.since(&start, now)?, &self.cut);
        let series = series.combine(&part.factor, &Series::zero(), &zero, bits);
        Ok(match part.integrated {
            true => series.integral(self.value_of(part, now, Limit::Right)?, &self.cut),
            false => series,
        })
    }

    /// Whether a part never jumps: displacements, integrals of waves, velocities of masses.
    pub fn is_continuous(&self, part: &Part) -> bool {
        match part.source {
            Source::Wave { .. } => part.integrated || part.delay.is_none(),
            Source::Node { signal: Signal::Displacement(_), .. } => true,
            Source::Node { node, signal: Signal::Velocity(run) } => {
                let mut attached = self.nodes[node].attached(run);
                attached.any(|own| matches!(own.law, ElementLaw::Mass { .. }))
            }
            Source::Node { signal: Signal::Yield(_) | Signal::Force(_), .. } => false,
        }
    }

    /// Whether a part is known to be exactly zero just before an instant: the force of a contact that
    /// opens since it came to zero.
    pub fn vanishes_before(&self, part: &Part, moment: &Moment) -> bool {
        let Source::Node { node, signal: Signal::Force(place) } = part.source else { return false };
        let contact = self.nodes[node].contacts().nth(place).expect("a contact of the node").0;
        let mut happenings = self.happenings.iter().filter(|own| own.contact == contact);
        happenings.any(|own| own.smooth && !own.closes && own.moment == *moment)
    }

    /// What the derivative of a part is a multiple of, where that is the force of one contact: of the
    /// velocity of a mass on which nothing else acts.
    pub fn slope_of(&self, part: &Part) -> Option<Part> {
        let Source::Node { node, signal: Signal::Velocity(run) } = part.source else { return None };
        let own = &self.nodes[node];
        let is_mass = |law: &ElementLaw<Number>| matches!(law, ElementLaw::Mass { .. });
        let acted = own.attached(run).next().is_none()
            || own.attached(run).any(|own| !is_mass(&own.law))
            || own.sides(run).any(|side| side != Side::Free);
        let links = usize::from(run > 0) + usize::from(run < own.links.len());
        let place = own.contact_left_of(run).or_else(|| own.contact_right_of(run))?;
        if links > 1 {
            return None;
        }
        let source = Source::Node { node, signal: Signal::Force(place) };
        (!acted).then(|| Part { source, ..part.clone() })
    }

    /// When a part may change its series.
    pub fn breaks_of(&self, part: &Part) -> Vec<Moment> {
        match (part.source, &part.delay) {
            (Source::Node { node, .. }, _) => {
                self.cells[node].iter().map(|(start, _)| start.clone()).collect()
            }
            (Source::Wave { bar, direction }, Some(delay)) => {
                let cells = self.waves[bar][direction].cells.iter();
                cells.map(|(start, _)| start.after(delay)).collect()
            }
            (Source::Wave { .. }, None) => Vec::new(),
        }
    }
}
