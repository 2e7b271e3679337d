//! How much is worked out for a value: locked, so that a change in it is seen.

use std::fmt::Write as _;

use wavestep::planner::{Purpose, of_scene};
use wavestep::signal::{EchoCount, Limit, digits};

use crate::scenes::{built_in, network_of, rational, scene_of, usual};

/// Scene, observable, and a time as a quotient.
const TABLE: [(&str, &str, (i64, i64)); 14] = [
    ("mass-on-fixed-bar", "velocity", (9, 2)),
    ("mass-on-fixed-bar", "strain_fixed", (40, 1)),
    ("cushioned-impact", "force", (10, 1)),
    ("stepped-striker", "pulse", (10, 1)),
    ("stepped-striker", "energy", (10, 1)),
    ("mass-between-bars", "force_wall", (12, 1)),
    ("hopkinson", "gauge_incident", (1, 2000)),
    ("hopkinson", "force", (1, 2000)),
    ("hopkinson", "energy", (1, 2000)),
    ("pile", "penetration", (12, 1)),
    ("percussive-drill", "rock_force", (1, 2000)),
    ("incommensurate", "contact_force", (1, 2000)),
    ("incommensurate", "wall_force", (1, 2000)),
    ("incommensurate", "energy", (1, 2000)),
];

#[test]
fn work_done_is_as_recorded() {
    let mut table = String::new();
    for (name, observable, (p, q)) in TABLE {
        let network = network_of(&scene_of(built_in(name), usual(name)));
        let at = rational(p, q);
        let observed = network.observables().iter().find(|seen| seen.name == observable);
        let observed = observed.expect("an observable");
        let signal = of_scene(&network, observed, [&at, &at], Purpose::Echoes).expect("a window");
        let value = digits(&*signal, &at, Limit::Right, 12, 1 << 12);
        let digits = value.expect("a value").decimal(12).0;
        let EchoCount { expanded, needed, .. } = signal.echoes().expect("echoes");
        let line = format!("{name} {observable}({p}/{q})");
        writeln!(table, "{line:<40}{digits:<24}{expanded:>5} of {needed:>5}").unwrap();
    }
    crate::snapshot("scenes", "work", "12 digits of the values named: echoes expanded", &table);
}

/// Five bars on one grid with two lumped elements, followed for thirty base periods. Shows the time; run
/// it in release mode.
#[test]
fn a_long_chain_is_followed() {
    let scene = scene_of(
        "scene \"Chain\"\n\
         bar a { impedance = 1, travel = 1, velocity = 1 }\n\
         bar b { impedance = 2, travel = 1 }\n\
         mass m { mass = 3/2 }\n\
         bar c { impedance = 3/2, travel = 2 }\n\
         spring k { stiffness = 5/4 }\n\
         bar d { impedance = 1/2, travel = 1 }\n\
         bar e { impedance = 3, travel = 1 }\n\
         line free - a | b - m - c - k - d - e - fixed\n\
         observe v = velocity(m)\n\
         observe F = force(k)\n\
         observe energy = energy(line)\n",
        &[],
    );
    let started = std::time::Instant::now();
    let network = network_of(&scene);
    let last = rational(60, 1);
    for observed in network.observables() {
        let at = &last - rational(1, 7);
        let signal = of_scene(&network, observed, [&at, &last], Purpose::Echoes).expect("a window");
        let value = digits(&*signal, &at, Limit::Right, 15, 1 << 14).expect("a value");
        let EchoCount { expanded, needed, .. } = signal.echoes().expect("echoes");
        eprintln!(
            "{} = {}: {expanded} of {needed} echoes, {:.1?}",
            observed.name,
            value.decimal(15).0,
            started.elapsed()
        );
        if observed.name == "energy" {
            assert_eq!(value.decimal(15).0.to_string(), "0.500000000000000");
        }
    }
}
