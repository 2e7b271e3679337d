//! When loads alone make up an observable, and do not act: then it is zero by a boundary condition.

use super::signal::{Limit, has_begun};
use crate::enclosure::Numbers;
use crate::expression::Fraction;
use crate::network::{Network, Observed};

/// The loads that alone make up an observable: each acts from a time and until another.
pub(crate) struct Silence {
    numbers: Numbers,
    acts: Vec<(Fraction, Option<Fraction>)>,
}

impl Silence {
    /// `None` where an observable is made of more than loads.
    pub fn of(network: &Network, observed: &Observed) -> Option<Silence> {
        let acts = observed.acts.clone()?;
        Some(Silence { numbers: Numbers::new(&network.model().constants), acts })
    }

    /// Whether no load is known to act between two times, each in a limit.
    pub fn holds(&self, [first, last]: [(&Fraction, Limit); 2]) -> bool {
        let order = |time: &Fraction, at: &Fraction| self.numbers.compare(time, at).ok();
        let is_over =
            |until: &Fraction| order(until, first.0).is_some_and(|order| has_begun(order, first.1));
        let is_to_come =
            |from: &Fraction| order(from, last.0).is_some_and(|order| !has_begun(order, last.1));
        self.acts
            .iter()
            .all(|(from, until)| until.as_ref().is_some_and(is_over) || is_to_come(from))
    }
}
