//! The planner: which source of signals answers for a quantity.
//!
//! Where contacts stay closed, waves have a closed form, which is cheap and exact; where they open, or where the closed
//! form takes too much, the scene is followed from cell to cell. Energies are sums of squares of such signals, in bars integrated
//! over the last travel time. Who has a signal need not know which it is; what is no signal, such as a lock,
//! asks whether there are periods.

mod balance;
mod energy;
mod together;

pub use together::Together;

use crate::expression::{Fraction, Root};
use crate::history::{FollowedSignal, Follower, HistoryError};
use crate::network::{
    Contacts, ElementLaw, FieldBars, Layout, Lumped, Network, Node, Observed, ObservedValue,
};
use crate::signal::{
    ClosedForm, ClosedSignal, Difference, EvaluateError, Operation, Scale, Signal, Vibrating,
};
use num_traits::Zero as _;
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// Why there is no signal.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum SignalError {
    /// There is no closed form.
    #[error(transparent)]
    Closed(#[from] EvaluateError),
    /// The scene cannot be followed.
    #[error(transparent)]
    Followed(#[from] HistoryError),
}

/// What is asked of a signal, which decides what is prepared.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Purpose {
    /// Values at times, with so many digits.
    Values { digits: usize },
    /// Values at times, from echoes that are counted one by one.
    Echoes,
    /// Stretches between breaks, for any method in doubles.
    Stretches,
    /// The same for polynomials alone.
    Polynomials,
    /// The same for roots and extrema: energies and momenta with what flows in.
    Search,
    /// The same for a size to so many digits.
    Size { digits: usize },
    /// Values by what knows of contacts that stay closed alone: methods that need a closed form, and models.
    ClosedContacts,
}

impl Purpose {
    /// The same for what is asked about: an integral since the start takes in all that a search does.
    fn of(self, observed: &Observed) -> Purpose {
        match (self, &observed.value) {
            (Purpose::Values { digits }, ObservedValue::Energy(sum))
                if digits <= MOST_FOLLOWED_DIGITS && sum.is_since_start() =>
            {
                Purpose::Search
            }
            _ => self,
        }
    }

    /// How many digits are wanted; `None` where that is not known beforehand.
    fn digits(self) -> Option<usize> {
        match self {
            Purpose::Values { digits } | Purpose::Size { digits } => Some(digits),
            _ => None,
        }
    }
}

/// Whether the waves of a scene have periods and echoes, which can be counted; else it is followed, and has
/// events.
pub fn has_periods(network: &Network) -> bool {
    !network.scene().contacts_open && network.local_contact().is_none()
}

/// A closed form that would take more bytes than this is replaced by following: its memory grows at least as the square
/// of the number of echoes.
const FOLLOWED_FROM: f64 = 64e6;

/// Where roots, extrema or polynomials are wanted, a closed form with more pieces or arrivals than this is replaced by
/// following, since each of them is a sum over all before it; what is known of a few lets a search end sooner.
const MOST_SEARCHED: usize = 64;

/// Where echoes that cannot matter for a tolerance are left out, a closed form serves for more arrivals.
const MOST_LEFT_OUT: usize = 1024;

/// Following takes ever more bits and memory for more digits; a closed form goes on beyond these.
const MOST_FOLLOWED_DIGITS: usize = 100;

/// A node with more masses and springs than this has more rates than a closed form is quick with.
const MANY_STATES: usize = 6;

/// Whether a place between bars has so many masses and springs.
fn is_crowded(network: &Network) -> bool {
    let states = |node: &Node<Fraction>| {
        let moves = |own: &&Lumped<Fraction>| match &own.law {
            ElementLaw::Mass { .. } => true,
            law => law.resistance().is_some_and(|[stiffness, _]| !stiffness.is_zero()),
        };
        node.elements.iter().filter(moves).count()
    };
    let layout = Layout::of(network.scene(), network.model(), Contacts::of(network.scene()));
    layout.nodes.iter().any(|node| states(node) > MANY_STATES)
}

/// Where values come from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Origin {
    /// The closed form of waves.
    Closed,
    /// The scene, followed from cell to cell.
    Followed,
}

/// Where values until a time of the user's come from at the least cost; a scene whose contacts open has no closed form.
pub fn origin(network: &Network, to: &Rational, purpose: Purpose) -> Origin {
    if !has_periods(network) || is_crowded(network) && purpose != Purpose::Echoes {
        return Origin::Followed;
    }
    let is_closed = match purpose {
        Purpose::Values { digits } if digits <= MOST_FOLLOWED_DIGITS => {
            ClosedForm::foreseen(network, to).map(|bytes| bytes <= FOLLOWED_FROM)
        }
        // Named rates hide which values are exactly zero behind an arrival.
        Purpose::Search | Purpose::Size { .. } => {
            ClosedForm::of_nothing(network, to).and_then(|form| {
                Ok(form.order(to)? <= MOST_SEARCHED && !form.recurrence.has_named_rates())
            })
        }
        Purpose::Polynomials => {
            let is_lattice = network.lattice().periods().len() > 1;
            let most = if is_lattice { MOST_LEFT_OUT } else { MOST_SEARCHED };
            has_few_arrivals(network, to, most)
        }
        _ => return Origin::Closed,
    };
    match is_closed {
        Ok(true) => Origin::Closed,
        Err(error) if !error.is_too_much() => Origin::Closed,
        _ => Origin::Followed,
    }
}

/// Whether a closed form until a time has so many pieces or arrivals at most.
fn has_few_arrivals(network: &Network, to: &Rational, most: usize) -> Result<bool, EvaluateError> {
    Ok(ClosedForm::of_nothing(network, to)?.order(to)? <= most)
}

/// An observable of a scene on a window of the user's time.
pub fn of_scene<'a>(
    network: &'a Network,
    observed: &Observed,
    window: [&Rational; 2],
    purpose: Purpose,
) -> Result<Box<dyn Signal + 'a>, SignalError> {
    Together::new(network, &[observed], window, purpose).chosen(observed).map(|(_, signal)| signal)
}

/// How far a signal of one scene or recurrence is from one of another, both on this window and in one unit; of the second only
/// the first arrivals count where their number is given.
pub(crate) fn difference<'a>(
    scales: [Rc<Scale<'a>>; 2],
    operands: [Rc<dyn Signal + 'a>; 2],
    arrivals: Option<usize>,
    window: [&Rational; 2],
) -> Box<dyn Signal + 'a> {
    let (scale, unit) = (Rc::clone(&scales[0]), Root::from(Fraction::one()));
    Box::new(Operation::new(
        &scale,
        Difference { scales, operands, arrivals, from: window[0].clone() },
        unit,
        window,
    ))
}

/// A drift and modes of a scene in its user's time and unit, `c + s t + Σ (a cos ωt + b sin ωt)`; `None` where one of the
/// numbers `c, s` and `ω, a, b` is not finite.
pub(crate) fn vibration<'a>(
    network: &'a Network,
    (drift, modes): ([f64; 2], &[[f64; 3]]),
    window: [&Rational; 2],
) -> Option<Box<dyn Signal + 'a>> {
    let scale = Scale::of(network);
    let rule = Vibrating::new(&scale, drift, modes)?;
    Some(Box::new(Operation::new(&scale, rule, Root::from(Fraction::one()), window)))
}

/// A wave as it enters a bar, without the state at the start, its integral over time since then, and the
/// integral of that.
pub type EnteringWave<'a> = [Box<dyn Signal + 'a>; 3];

/// Of each bar of a scene the waves to the right and to the left in its scale, until a time of the user's;
/// none for what comes from the far side of an endless bar.
pub(crate) fn entering_waves<'a>(
    network: &'a Network,
    last: &Rational,
) -> Result<Vec<[Option<EnteringWave<'a>>; 2]>, SignalError> {
    let window = [&Rational::zero(), last];
    let follower = match origin(network, last, Purpose::Search) {
        Origin::Closed => None,
        Origin::Followed => match Follower::new(network, None, window, None) {
            Err(HistoryError::Refused(_)) if has_periods(network) => None,
            follower => Some(follower?),
        },
    };
    let FieldBars { network: own, bars } = network.field_bars().map_err(EvaluateError::from)?;
    let mut signals: Vec<Box<dyn Signal + 'a>> = Vec::new();
    match follower {
        Some(follower) => {
            for (bar, place) in bars.iter().zip(0..) {
                for (direction, wave) in bar.entering.iter().enumerate() {
                    for integrated in 0..wave.as_ref().map_or(0, |levels| levels.len()) {
                        let wave = (place, direction);
                        let signal = FollowedSignal::entering(&follower, wave, integrated, window)?;
                        signals.push(Box::new(signal));
                    }
                }
            }
        }
        None => {
            let levels = bars.iter().flat_map(|bar| bar.entering.iter().flatten().flatten());
            let observed: Vec<_> = levels.map(|level| (level, window)).collect();
            let closed = ClosedSignal::several(own, &observed, last)?.into_iter();
            signals.extend(closed.map(|signal| Box::new(signal) as Box<dyn Signal>));
        }
    }
    let mut signals = signals.into_iter();
    let mut next = |_| signals.next().expect("one for each level");
    let mut wave = |levels: &Option<_>| levels.as_ref().map(|_| [0, 1, 2].map(&mut next));
    Ok(bars.iter().map(|bar| bar.entering.each_ref().map(&mut wave)).collect())
}
