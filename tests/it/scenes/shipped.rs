//! The built-in scenes: derived in both ways, and proved.

use wavestep::network::NetworkError;

use crate::scenes::proof::assert_laws_hold;
use crate::scenes::{built_in, network_of, scene_of, shipped};
use crate::support::{by_echoes, by_periods, violation};

/// How many periods hold the first six arrivals at the nodes.
fn periods(name: &str) -> usize {
    match name {
        "hopkinson" | "percussive-drill" | "mass-between-bars" | "stepped-striker" => 9,
        _ => 6,
    }
}

#[test]
fn both_derivations_give_the_same() {
    let mut incommensurate = Vec::new();
    for scene in shipped() {
        let network = network_of(&scene_of(built_in(scene.name), &[]));
        let recurrence = match network.recurrence() {
            Err(NetworkError::Incommensurate) => {
                incommensurate.push(scene.name);
                continue;
            }
            other => other.unwrap_or_else(|error| panic!("{error}")),
        };
        let through = periods(scene.name);
        let pieces = by_periods(&recurrence, through);
        assert!(pieces == by_echoes(&recurrence, through), "{}", scene.name);
        assert_eq!(violation(&recurrence, &pieces), None, "{}", scene.name);
    }
    assert_eq!(incommensurate, ["incommensurate"]);
}

#[test]
fn laws_hold_as_identities() {
    for scene in shipped().filter(|scene| scene.name != "incommensurate") {
        let started = std::time::Instant::now();
        let cells = match scene.name {
            "hopkinson" | "percussive-drill" => 24,
            _ => 14,
        };
        assert_laws_hold(&network_of(&scene_of(built_in(scene.name), &[])), cells);
        eprintln!("{}: {:.1?}", scene.name, started.elapsed());
    }
}
