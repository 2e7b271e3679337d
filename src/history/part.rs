//! The parts that an observable is the sum of: waves with their delays, motions of nodes, compressions,
//! forces of contacts.

use crate::ball::Number;
use crate::expression::Fraction;
use crate::history::contacts::Cause;
use crate::history::energy::Integrand;
use crate::history::engine::{Cell, Engine};
use crate::history::error::Outcome;
use crate::history::moment::Moment;
use crate::history::series::{Series, Truncation};
use crate::history::track::Track;
use crate::network::{ElementLaw, Lump, Side, Window};
use crate::signal::Limit;
use std::borrow::Cow;

/// What changes with time by itself.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Source {
    /// A wave in a bar, to the right (0) or to the left (1), so long after it entered; without a delay what
    /// it was before the start, which comes for ever from the far side of an endless bar.
    Wave { bar: usize, direction: usize, delay: Option<Fraction> },
    /// What changes at a node.
    Node { node: usize, quantity: NodeQuantity },
}

impl Source {
    pub fn is_at(&self, node: usize) -> bool {
        matches!(self, Source::Node { node: own, .. } if *own == node)
    }

    pub fn is_wave(&self, bar: usize, direction: usize) -> bool {
        matches!(self, Source::Wave { bar: own, direction: way, .. } if (*own, *way) == (bar, direction))
    }
}

/// What changes at a node.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum NodeQuantity {
    /// The velocity of a run.
    Velocity(usize),
    /// The displacement of a run since the start.
    Displacement(usize),
    /// The compression of a spring or the displacement of a support, by its place in the node.
    Compression(usize),
    /// The force of a contact, by its place among those of the node.
    Force(usize),
}

/// `c f(t)`, or `c ∫ f dt` since the start or over the last travel time.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Part {
    pub source: Source,
    /// `c`
    pub factor: Number,
    /// Over which time it is integrated. Of waves alone more than [`Window::Now`] is known.
    pub over: Window,
}

impl Part {
    /// What changes by itself.
    pub fn of(source: Source, factor: Number) -> Part {
        Part { source, factor, over: Window::Now }
    }
}

impl Cell {
    fn series(&self, quantity: NodeQuantity, cut: &Truncation) -> Cow<'_, Series> {
        Cow::Borrowed(match quantity {
            NodeQuantity::Velocity(run) => &self.velocities[run],
            NodeQuantity::Displacement(run) => {
                let start = self.displacements[run].clone();
                return Cow::Owned(self.velocities[run].integral_over(start, &self.length, cut));
            }
            NodeQuantity::Compression(place) => &self.compressions[place],
            NodeQuantity::Force(place) => &self.forces[place],
        })
    }
}

impl Engine {
    /// The value of a part.
    pub fn value_of(&self, part: &Part, moment: &Moment, limit: Limit) -> Outcome<Number> {
        let value = match &part.source {
            Source::Node { node, quantity } => {
                let (start, cell) = self.cell(*node, moment, limit)?;
                cell.series(*quantity, &self.cut)
                    .value(&self.clock.since(start, moment)?, &self.cut)
            }
            Source::Wave { bar, direction, delay: None } => {
                let length = match &part.over {
                    Window::Now => Number::one(),
                    Window::Last(length) => self.clock.number(length)?,
                    Window::Always => self.clock.time(moment)?,
                };
                let before = self.waves[*bar][*direction].before().coefficient(0);
                before.multiply(&length, self.cut.bits)
            }
            Source::Wave { bar, direction, delay: Some(delay) } => {
                let track = &self.waves[*bar][*direction];
                let seen = moment.before(delay);
                let from = match &part.over {
                    Window::Now => None,
                    Window::Last(length) => Some(seen.before(length)),
                    Window::Always => Some(Moment::at(-delay)),
                };
                match from {
                    None => track.value(&self.clock, &seen, limit, &self.cut)?,
                    Some(from) => {
                        let window = [&from, &seen];
                        track.integral(Integrand::Wave, &self.clock, window, &self.cut)?
                    }
                }
            }
        };
        Ok(part.factor.multiply(&value, self.cut.bits))
    }

    /// A part from an instant on, until the next of its breaks.
    pub fn series_of(&self, part: &Part, now: &Moment) -> Outcome<Series> {
        let series = match &part.source {
            Source::Node { node, quantity } => {
                let (start, cell) = self.cell(*node, now, Limit::Right)?;
                cell.series(*quantity, &self.cut).shift(&self.clock.since(start, now)?, &self.cut)
            }
            Source::Wave { bar, direction, delay: Some(delay) } => {
                let track = &self.waves[*bar][*direction];
                let series = self.series_at(track, &now.before(delay))?;
                match &part.over {
                    Window::Last(length) => {
                        let left = self.series_at(track, &now.before(&(delay + length)))?;
                        series.subtract(&left, self.cut.bits)
                    }
                    Window::Now | Window::Always => series,
                }
            }
            Source::Wave { delay: None, .. } if matches!(part.over, Window::Last(_)) => {
                Series::zero()
            }
            Source::Wave { bar, direction, delay: None } => {
                self.waves[*bar][*direction].before().clone()
            }
        };
        let (bits, zero) = (self.cut.bits, Number::zero());
        let series = series.combine(&part.factor, &Series::zero(), &zero, bits);
        Ok(match part.over {
            Window::Now => series,
            Window::Last(_) | Window::Always => {
                series.integral(self.value_of(part, now, Limit::Right)?, &self.cut)
            }
        })
    }

    /// A wave from an instant on.
    fn series_at(&self, track: &Track, now: &Moment) -> Outcome<Series> {
        let cell = track.cell(&self.clock, now, Limit::Right)?;
        let (start, wave) = track.cells.get(cell);
        Ok(wave.series().shift(&self.clock.since(start, now)?, &self.cut))
    }

    /// Whether a part never jumps: displacements, integrals of waves, velocities of masses.
    pub fn is_continuous(&self, part: &Part) -> bool {
        match &part.source {
            Source::Wave { delay, .. } => part.over != Window::Now || delay.is_none(),
            Source::Node { quantity: NodeQuantity::Displacement(_), .. } => true,
            Source::Node { node, quantity: NodeQuantity::Velocity(run) } => {
                let mut attached = self.nodes[*node].attached(*run);
                attached.any(|own| matches!(own.law, ElementLaw::Mass { .. }))
            }
            Source::Node {
                quantity: NodeQuantity::Compression(_) | NodeQuantity::Force(_),
                ..
            } => false,
        }
    }

    /// Whether a part is known to be exactly zero just before an instant: the force of a contact that opens because it
    /// came to zero, with the compression of a spring that presses as it does; the compression of a local contact, while
    /// open its negative gap, that opens or closes by itself.
    pub fn vanishes_before(&self, part: &Part, moment: &Moment) -> bool {
        let Source::Node { node, quantity } = part.source else { return false };
        let own = &self.nodes[node];
        let is_local = |contact| match quantity {
            NodeQuantity::Compression(place) => own.local_contact(contact) == Some(place),
            _ => false,
        };
        let force = match quantity {
            NodeQuantity::Force(place) => Some(place),
            NodeQuantity::Compression(place) => match own.elements[place].law.resistance() {
                Some([_, damping]) if damping.is_zero() => {
                    let lone = || own.contact_of_support(own.elements[place].run);
                    self.contact_of_spring(Lump { node, place }).or_else(lone)
                }
                _ => None,
            },
            NodeQuantity::Displacement(run) => own.contact_of_support(run),
            NodeQuantity::Velocity(_) => None,
        };
        let mut contacts = own.contacts().zip(0..);
        let contact = contacts.find(|((own, _), place)| is_local(*own) || force == Some(*place));
        let Some(((contact, _), _)) = contact else { return false };
        let mut happenings = self.happenings.iter().filter(|own| own.contact == contact);
        happenings.any(|own| {
            let holds = is_local(contact) || !own.closes;
            own.cause == Cause::Crossing && holds && own.moment == *moment
        })
    }

    /// What the derivative of a part is a multiple of, where that is the force of one contact: of the
    /// velocity of a mass on which nothing else acts.
    pub fn slope_of(&self, part: &Part) -> Option<Part> {
        let Source::Node { node, quantity: NodeQuantity::Velocity(run) } = part.source else {
            return None;
        };
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
        let source = Source::Node { node, quantity: NodeQuantity::Force(place) };
        (!acted).then(|| Part { source, ..part.clone() })
    }

    /// When a part may change its series: lists, each in order.
    pub fn breaks_of(&self, part: &Part) -> Vec<Vec<Moment>> {
        let Source::Wave { bar, direction, delay } = &part.source else {
            let Source::Node { node, .. } = part.source else { return Vec::new() };
            return vec![self.cells[node].starts().cloned().collect()];
        };
        let Some(delay) = delay else { return Vec::new() };
        let cells = &self.waves[*bar][*direction].cells;
        let after = |delay: &Fraction| -> Vec<Moment> {
            cells.starts().map(|start| start.after(delay)).collect()
        };
        match &part.over {
            Window::Last(length) => vec![after(delay), after(&(delay + length))],
            Window::Now | Window::Always => vec![after(delay)],
        }
    }
}
