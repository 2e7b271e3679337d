//! Observables that are asked for together, and what signals are made of: a closed form, or a motion that is followed.

use super::{
    MOST_SEARCHED, Origin, Purpose, SignalError, balance, energy, has_few_arrivals, has_periods,
    origin,
};
use crate::ball::BallError;
use crate::expression::{Fraction, Root};
use crate::history::{self, FollowedSignal, Follower, HistoryError};
use crate::network::{Network, Observed, ObservedValue, Squared, Term};
use crate::recurrence::Observation;
use crate::signal::{ClosedForm, ClosedSignal, EvaluateError, Limit, Signal, Taps, value};
use num_traits::Signed as _;
use std::cell::OnceCell;
use std::rc::Rc;
use wavestep_polynomial::Rational;

type Following<'a> = Result<Rc<Follower<'a>>, HistoryError>;

/// Observables of a scene on one window of the user's time: what is followed is followed once for all of them.
pub struct Together<'a, 'o> {
    network: &'a Network,
    observed: &'o [&'o Observed],
    window: [&'o Rational; 2],
    purpose: Purpose,
    follower: OnceCell<Following<'a>>,
}

impl<'a, 'o> Together<'a, 'o> {
    pub fn new(
        network: &'a Network,
        observed: &'o [&'o Observed],
        window: [&'o Rational; 2],
        purpose: Purpose,
    ) -> Self {
        Together { network, observed, window, purpose, follower: OnceCell::new() }
    }

    /// One of them, with the source that it comes from.
    pub fn chosen(
        &self,
        observed: &Observed,
    ) -> Result<(Origin, Box<dyn Signal + 'a>), SignalError> {
        let Together { network, window, purpose, .. } = *self;
        let from = |origin| self.of_origin(origin, observed).map(|signal| (origin, signal));
        if !has_periods(network) {
            if purpose == Purpose::ClosedContacts {
                history::stays_closed(network, window[1])?;
                return from(Origin::Closed);
            }
            return from(Origin::Followed);
        }
        let closed = || from(Origin::Closed);
        if origin(network, window[1], purpose.of(observed)) == Origin::Closed {
            let found = closed()?;
            return match purpose != Purpose::Echoes && resonates(network, &*found.1, window[1]) {
                true => from(Origin::Followed),
                false => Ok(found),
            };
        }
        if purpose == Purpose::Polynomials && is_cheap_closed(network, observed, window) {
            return closed();
        }
        match from(Origin::Followed) {
            // The closed form gives the clearer error for a window that cannot be followed.
            Err(SignalError::Followed(
                HistoryError::Refused(_) | HistoryError::TooManyCells { .. },
            )) => closed(),
            // Where following takes too much memory, searching many sums takes too long.
            Err(SignalError::Followed(error @ HistoryError::TooMuchMemory { .. }))
                if purpose == Purpose::Search
                    && has_few_arrivals(network, window[1], MOST_SEARCHED)
                        .is_ok_and(|few| !few) =>
            {
                Err(error.into())
            }
            Err(_) if ClosedForm::foreseen(network, window[1]).is_ok() => closed(),
            followed => followed,
        }
    }

    /// One of them from one of the two sources.
    pub fn of_origin(
        &self,
        origin: Origin,
        observed: &Observed,
    ) -> Result<Box<dyn Signal + 'a>, SignalError> {
        let Together { network, window, purpose, .. } = *self;
        let sources = || self.sources(origin, observed);
        if let (Purpose::Search | Purpose::Size { .. }, Some(known)) =
            (purpose.of(observed), &observed.balance)
        {
            return balance::of_sources(&sources()?, observed, known, window);
        }
        if let ObservedValue::Energy(sum) = &observed.value {
            return energy::of_sources(&sources()?, sum, &observed.unit, window);
        }
        if let Some(follower) = sources()?.follower {
            let followed = FollowedSignal::observable(&follower, observed, window)?;
            return Ok(match purpose {
                Purpose::Values { .. } | Purpose::Echoes => Box::new(followed),
                _ => Box::new(followed.cut_at_breaks()?),
            });
        }
        let signal = ClosedSignal::of_scene(network, observed, window)?;
        Ok(Box::new(match purpose {
            Purpose::Echoes => signal.echo_by_echo(),
            _ => signal,
        }))
    }

    /// Where one of them comes from.
    fn sources(&self, origin: Origin, observed: &Observed) -> Result<Sources<'a>, SignalError> {
        let [from, to] = self.window;
        if to < from {
            return Err(EvaluateError::EmptyWindow.into());
        }
        let follower = match origin {
            Origin::Closed => None,
            Origin::Followed => Some(self.follower(observed)?),
        };
        Ok(Sources { network: self.network, to: to.clone(), follower })
    }

    /// The scene, followed for all of them; for one alone, where all would take too much.
    pub(crate) fn follower(&self, observed: &Observed) -> Result<Rc<Follower<'a>>, SignalError> {
        match self.follower.get_or_init(|| self.follow(self.observed)) {
            Err(HistoryError::TooMuchMemory { .. } | HistoryError::TooManyCells { .. })
                if self.observed.len() > 1 =>
            {
                Ok(self.follow(&[observed])?)
            }
            followed => Ok(followed.clone()?),
        }
    }

    /// How many cells are worked out where one of them is followed, and how many of them, with those of waves, are kept.
    pub fn cells(&self, observed: &Observed) -> Result<[usize; 2], SignalError> {
        Ok(self.follower(observed)?.cells())
    }

    fn follow(&self, observed: &[&Observed]) -> Following<'a> {
        let [from, to] = self.window;
        if from.is_negative() {
            return Err(EvaluateError::EmptyWindow.into());
        }
        let (mut reach, mut digits) = (from.clone(), self.purpose.digits());
        for own in observed {
            // Integrals of squares cost digits.
            if let ObservedValue::Energy(sum) = &own.value {
                reach = reach.min(energy::reach(self.network, sum, from)?);
                digits = None;
            }
        }
        Follower::new(self.network, Some(observed), [&reach, to], digits)
    }
}

/// Bits by which numbers that differ are told apart.
const TELLING_BITS: u64 = 1 << 12;

/// Whether a load has a rate of the motion, where both are numbers with names and no form tells that they are equal.
fn resonates(network: &Network, signal: &dyn Signal, at: &Rational) -> bool {
    let model = network.model();
    let may_resonate = !model.loads.is_empty() && !model.constants.is_empty();
    let divides = EvaluateError::Ball(BallError::DivisorMayBeZero);
    may_resonate && value(signal, at, Limit::Left, 1, TELLING_BITS) == Err(divides)
}

/// Whether the closed form is cheap for polynomials: a march through waves of one pole and one lag, which takes no memory, or
/// echoes that die out, so that most are left out.
fn is_cheap_closed(network: &Network, observed: &Observed, window: [&Rational; 2]) -> bool {
    let Ok(signal) = ClosedSignal::of_scene(network, observed, window) else { return false };
    signal
        .closed_form()
        .is_ok_and(|form| Taps::of(form).is_ok() || form.falls(window[1]).unwrap_or(false))
}

/// Where signals come from of which one is made: they share one closed form or one history.
pub(super) struct Sources<'a> {
    pub network: &'a Network,
    /// The end of the window, in the user's time.
    to: Rational,
    /// Where the scene is followed.
    follower: Option<Rc<Follower<'a>>>,
}

/// Something that is read of a motion, in waves, and as a reading of what is followed, on a window.
type Seen<'s> = (&'s Observation, Squared, [&'s Rational; 2]);

impl<'a> Sources<'a> {
    /// Signals in the scale of the scene.
    pub fn signals<'s>(
        &self,
        seen: impl Iterator<Item = Seen<'s>>,
    ) -> Result<Vec<Rc<dyn Signal + 'a>>, SignalError> {
        let Some(follower) = &self.follower else {
            let seen: Vec<_> = seen.map(|(waves, _, window)| (waves, window)).collect();
            let signals = ClosedSignal::several(self.network, &seen, &self.to)?.into_iter();
            return Ok(signals.map(|signal| Rc::new(signal) as Rc<dyn Signal>).collect());
        };
        let mut signals: Vec<Rc<dyn Signal + 'a>> = Vec::new();
        for (_, reading, window) in seen {
            signals.push(Rc::new(FollowedSignal::squared(follower, &reading, window)?));
        }
        Ok(signals)
    }

    /// A sum of readings in the scale of the scene.
    pub fn signal(
        &self,
        waves: &Observation,
        readings: &[Term],
        window: [&Rational; 2],
    ) -> Result<Box<dyn Signal + 'a>, SignalError> {
        let Some(follower) = &self.follower else {
            let mut signals = ClosedSignal::several(self.network, &[(waves, window)], &self.to)?;
            return Ok(Box::new(signals.pop().expect("one signal for one observation")));
        };
        let unit = Root::from(Fraction::one());
        Ok(Box::new(FollowedSignal::linear(follower, (readings, &unit), window)?))
    }
}
