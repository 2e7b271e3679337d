//! A scene whose bars of finite length are all rigid, or all springs with a share of their mass: no wave returns in it.

use crate::answer::way::WayError;
use crate::ball::{at_or_after, at_or_before, rational};
use crate::model::{ModelError, NotRepresented};
use crate::network::{Network, NetworkError, ScaledScene};
use crate::planner::{self, Purpose, SignalError};
use crate::scene::{Element, Fault, Ideal, Kind, Part, Scene};
use crate::signal::{Compiled, Table};
use wavestep_polynomial::Rational;

/// Why there are no values of a scene without waves.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NotReduced {
    /// What is wrong with an element, or with what is observed.
    #[error("`{0}`: {1}")]
    Fault(String, Box<Fault>),
    #[error(transparent)]
    Network(#[from] NetworkError),
    #[error(transparent)]
    Signal(#[from] SignalError),
}

/// The scene with contacts that stay closed, this in the place of each bar of finite length, and one of its observables.
fn network(scaled: &ScaledScene, observable: usize, ideal: &Ideal) -> Result<Network, NotReduced> {
    let mut scene = Scene { contacts_open: false, ..scaled.scene().clone() };
    let name = |element: usize| scaled.scene().elements[element].name.clone();
    scene.observables = vec![scene.observables.swap_remove(observable)];
    let is_finite = |own: &Element| matches!(&own.kind, Kind::Bar(bar) if !bar.is_endless());
    // That there is none is a fault.
    let is_any = scene.elements.iter().any(is_finite);
    for element in scene.elements.iter_mut().filter(|own| is_finite(own) || !is_any) {
        if let Kind::Bar(bar) = &mut element.kind {
            bar.ideal = Some(ideal.clone());
        }
    }
    if let Some(fault) = scene.faults().into_iter().next() {
        let name = match fault.parts.first() {
            Some(Part::Element(element) | Part::Property(element, _)) => name(*element),
            _ => scene.observables[0].name.clone(),
        };
        return Err(NotReduced::Fault(name, Box::new(fault)));
    }
    let expanded = scene.expanded().map_err(NetworkError::from)?;
    Ok(Network::new(&expanded)?)
}

/// The values of the reduced scene on a window, as polynomials.
pub(super) fn reduced(
    model: &'static str,
    (scaled, observable): (&ScaledScene, usize),
    ideal: &Ideal,
    window: [&Rational; 2],
) -> Result<Table, WayError> {
    if let Some(contact) = scaled.local_contact() {
        let name = scaled.scene().elements[contact].name.clone();
        return Err(
            ModelError::Refused { model, reason: NotRepresented::LocalContact(name) }.into()
        );
    }
    let refused = |error| WayError::Reduced(model, Box::new(error));
    let network = network(scaled, observable, ideal).map_err(refused)?;
    let observed = &network.observables()[0];
    // Times come as the nearest doubles, which may lie a little beyond the ends.
    let [from, to] = [at_or_before(window[0]), at_or_after(window[1])].map(rational);
    let signal = planner::of_scene(&network, observed, [&from, &to], Purpose::Polynomials);
    let signal = signal.map_err(|error| refused(error.into()))?;
    Ok(Compiled::new(&*signal, None)?.into_table())
}
