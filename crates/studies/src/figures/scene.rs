//! Built-in scenes and recurrences with numbers put in.

use super::FigureError;
use crate::picture::{Sampled, sampled};
use std::collections::BTreeMap;
use wavestep::evaluate::{ClosedSignal, EvaluateError};
use wavestep::language::{self, Source};
use wavestep::network::Network;
use wavestep::recurrence::Recurrence;
use wavestep::signal::{Purpose, of_scene};
use wavestep::solution::Solution;
use wavestep_polynomial::Rational;

fn source(name: &str) -> Source {
    let text = wavestep::scenes::find(name).expect("a built-in scene").text;
    Source::new(name, text).expect("a short text")
}

fn values(given: &[(&str, Rational)]) -> BTreeMap<String, Rational> {
    given.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect()
}

/// A built-in scene.
pub(super) fn network(name: &str, given: &[(&str, Rational)]) -> Network {
    let scene = language::read_scene(&source(name), &values(given)).expect("a built-in scene");
    Network::new(&scene).expect("a built-in scene")
}

/// A built-in recurrence.
pub(super) fn recurrence(name: &str, given: &[(&str, Rational)]) -> Recurrence {
    language::read_recurrence(&source(name), &values(given)).expect("a built-in recurrence")
}

/// The values of an observable of a recurrence on a window from 0.
pub(super) fn course(
    recurrence: &Recurrence,
    name: &str,
    last: &Rational,
) -> Result<Sampled, EvaluateError> {
    let observation = recurrence.observation(name).expect("a built-in observable");
    let solution = Solution::new(recurrence.clone());
    let window = [&Rational::default(), last];
    sampled(&ClosedSignal::of_recurrence(&solution, &observation, window)?)
}

/// An observable of a scene whose contacts open, on a window from 0.
pub(super) fn followed(
    network: &Network,
    name: &str,
    last: &Rational,
) -> Result<Sampled, FigureError> {
    let observed = network.observables().iter().find(|observed| observed.name == name);
    let observed = observed.expect("a built-in observable");
    let signal = of_scene(network, observed, [&Rational::default(), last], Purpose::Stretches)?;
    Ok(sampled(&*signal)?)
}
