//! Waves and observables by name.

use super::failure::Failure;
use wavestep::expression::{Expression, Fraction, Root};
use wavestep::language;
use wavestep::network::{Network, Observed, ObservedValue};
use wavestep::recurrence::{Observation, ObservedWave, Recurrence};
use wavestep::scene::{Dimension, Scene};

/// Refuses a quantity that is none of these.
fn unknown(names: &[&str], quantity: &str) -> Failure {
    let message = format!("`{quantity}` is neither a wave nor an observable here");
    let remedy = match language::closest(quantity, names.iter().copied()) {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("ask for one of {}", names.join(", ")),
    };
    Failure::usage(message, remedy)
}

/// A wave or an observable of a recurrence.
pub fn of_recurrence(recurrence: &Recurrence, quantity: &str) -> Result<Observation, Failure> {
    let found = recurrence.observation(&language::normalise_name(quantity));
    found.ok_or_else(|| {
        let statement = recurrence.statement();
        let observables = statement.observables.iter().map(|observable| observable.name.as_str());
        let names: Vec<&str> =
            statement.waves.iter().map(String::as_str).chain(observables).collect();
        unknown(&names, quantity)
    })
}

/// The place of an observable in a scene without a recurrence.
pub fn of_model(scene: &Scene, quantity: &str) -> Result<usize, Failure> {
    let name = language::normalise_name(quantity);
    let names: Vec<&str> = scene.observables.iter().map(|seen| seen.name.as_str()).collect();
    names.iter().position(|known| *known == name).ok_or_else(|| unknown(&names, quantity))
}

/// An observable of a scene whose contacts open: its waves are those of closed contacts.
pub fn of_phases(network: &Network, quantity: &str) -> Result<Observed, Failure> {
    let observed = of_scene(network, quantity)?;
    let name = &observed.name;
    match network.scene().observables.iter().any(|own| own.name == *name) {
        true => Ok(observed),
        false => {
            let message =
                format!("{name} is a wave of the closed contacts, which open in this scene");
            Err(Failure::usage(message, "ask for an observable, or leave out `contacts open`"))
        }
    }
}

/// An observable of a scene, or a wave in its scale.
pub fn of_scene(network: &Network, quantity: &str) -> Result<Observed, Failure> {
    let name = language::normalise_name(quantity);
    if let Some(observed) = network.observables().iter().find(|observed| observed.name == name) {
        return Ok(observed.clone());
    }
    let waves = network.waves();
    let Some(wave) = waves.iter().position(|wave| wave.name == name) else {
        let observables = network.observables().iter().map(|observed| observed.name.as_str());
        let names: Vec<&str> =
            observables.chain(waves.iter().map(|wave| wave.name.as_str())).collect();
        return Err(unknown(&names, quantity));
    };
    let (coefficient, delay) = (Expression::one(), Fraction::zero());
    let seen = ObservedWave { coefficient, wave, slope: false, delay };
    let observation = Observation { waves: vec![seen], forcing: Expression::zero() };
    Ok(Observed {
        name,
        value: ObservedValue::Linear(observation),
        unit: Root::from(Fraction::one()),
        dimension: Dimension::NONE,
    })
}
