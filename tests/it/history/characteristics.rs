//! The method of characteristics in doubles, on a fine grid of time, with contacts that open where the
//! force becomes negative and close where the gap does. One contact; a mass or a bar at its left, a bar at
//! its right.

use crate::history::{SHIPPED, ball, shipped};
use wavestep::history::{EventKind, History};

/// Steps in a unit of time.
const STEPS: usize = 4000;

/// What stands at the left of the contact.
enum Left {
    Bar { impedance: f64, travel: f64 },
    Mass { mass: f64, load: f64 },
}

/// What is beyond the bar at the right.
enum Far {
    Endless,
    Free,
    Fixed,
    /// A spring and an endless bar.
    Specimen {
        stiffness: f64,
        impedance: f64,
    },
}

struct Scene {
    left: Left,
    /// Stiffness of a spring between the contact and the bar at the right.
    spring: Option<f64>,
    impedance: f64,
    travel: f64,
    far: Far,
}

fn steps(time: f64) -> usize {
    (time * STEPS as f64).round() as usize
}

/// When the contact opens and closes, the striker coming with velocity 1.
fn simulate(scene: &Scene, until: f64) -> Vec<(EventKind, f64)> {
    let dt = 1.0 / STEPS as f64;
    let z = scene.impedance;
    let mut events = vec![(EventKind::Impact, 0.0)];
    let (mut closed, mut gap, mut velocity, mut compression) = (true, 0.0, 1.0, 0.0_f64);
    // What leaves the contact to the left and to the right, and what the far end sends back.
    let (mut out_left, mut out_right, mut back) = (Vec::new(), Vec::new(), Vec::new());
    let mut squeezed = 0.0;
    // Since when the force is zero: a contact ends there, if it pulls before it presses again.
    let mut idle = None;
    for i in 0..steps(until) {
        let n = steps(scene.travel);
        let reach = |from: usize| i.checked_sub(from);
        // The far end sees now what left the contact a travel time ago.
        let arriving = reach(n).map_or(0.0, |k| out_right[k]);
        back.push(match &scene.far {
            Far::Endless => 0.0,
            Far::Free => arriving,
            Far::Fixed => -arriving,
            Far::Specimen { stiffness, impedance } => {
                let rate = |s: f64| 2.0 * arriving - stiffness * s * (1.0 / z + 1.0 / impedance);
                squeezed += dt * rate(squeezed + dt / 2.0 * rate(squeezed));
                2.0 * arriving - stiffness * squeezed / z - arriving
            }
        });
        let from_right = reach(n).map_or(0.0, |k| back[k]);
        let (mut force, own, other);
        match &scene.left {
            Left::Bar { impedance, travel } => {
                let from_left = reach(2 * steps(*travel)).map_or(0.5, |k: usize| out_left[k]);
                let apart = 2.0 * (from_left - from_right);
                force = match scene.spring {
                    _ if !closed => 0.0,
                    None => apart / (1.0 / impedance + 1.0 / z),
                    Some(stiffness) => {
                        let soft = 1.0 / impedance + 1.0 / z;
                        let rate = |a: f64| apart - stiffness * a * soft;
                        compression += dt * rate(compression + dt / 2.0 * rate(compression));
                        stiffness * compression
                    }
                };
                if closed && force.abs() < 1e-12 && i > 0 {
                    idle.get_or_insert(i);
                } else if force < 0.0 {
                    (closed, gap, compression) = (false, 0.0, 0.0);
                    let since = idle.take().unwrap_or(i);
                    events.push((EventKind::Opening, since as f64 * dt));
                }
                force = force.max(0.0);
                own = 2.0 * from_left - force / impedance;
                other = 2.0 * from_right + force / z;
                out_left.push(own - from_left);
            }
            Left::Mass { mass, load } => {
                let next = match closed {
                    true => {
                        let inertia = mass / dt;
                        let pushed = load + 2.0 * z * from_right;
                        ((inertia - z / 2.0) * velocity + pushed) / (inertia + z / 2.0)
                    }
                    false => velocity + load / mass * dt,
                };
                let mean = (velocity + next) / 2.0;
                force = if closed { z * (mean - 2.0 * from_right) } else { 0.0 };
                velocity = next;
                if force < 0.0 {
                    (closed, gap, force) = (false, 0.0, 0.0);
                    events.push((EventKind::Opening, i as f64 * dt));
                }
                own = mean;
                other = 2.0 * from_right + force / z;
            }
        }
        out_right.push(other - from_right);
        if !closed {
            gap += (other - own) * dt;
            // Rounding alone opens no gap and closes none.
            if gap < -1e-9 {
                (closed, gap) = (true, 0.0);
                events.push((EventKind::Closing, i as f64 * dt));
            }
        }
    }
    events
}

/// The shipped scene in units of the travel time of what strikes.
fn scene(name: &str, value: f64) -> Scene {
    let bar = |impedance, travel| Left::Bar { impedance, travel };
    let plain = |left, travel, far| Scene { left, spring: None, impedance: 1.0, travel, far };
    match name {
        "bars-that-part" => plain(bar(value, 1.0), 1.0, Far::Endless),
        "bars-of-equal-length" => plain(bar(1.0, 1.0), 1.0, Far::Free),
        "bars-of-unequal-length" => plain(bar(1.0, 1.0), 2.5, Far::Free),
        "saint-venant" => plain(Left::Mass { mass: 1.0 / value, load: 0.0 }, 1.0, Far::Fixed),
        "mass-on-free-bar" => plain(Left::Mass { mass: value, load: 0.0 }, 1.0, Far::Free),
        "cushion-with-release" => {
            let own = plain(bar(1.0, value / 2.0), 1.0, Far::Endless);
            Scene { spring: Some(0.5), ..own }
        }
        "hopkinson-with-release" => {
            // In units of the striker: Z = 0.64 of that of the long bars, kT/Z from the material.
            let (modulus, density) = (210e9_f64, 7850.0);
            let speed = f64::sqrt(modulus / density);
            let impedance = modulus * std::f64::consts::PI * 0.016 * 0.016 / 4.0 / speed;
            let stiffness = 40e6 * (0.3 / speed) / impedance;
            let long = 1.0 / 0.64;
            let far = Far::Specimen { stiffness, impedance: long };
            Scene { left: bar(1.0, 1.0), spring: None, impedance: long, travel: 5.0, far }
        }
        "mass-that-bounces" => plain(Left::Mass { mass: 1.0, load: 0.05 }, 1.0, Far::Fixed),
        _ => unreachable!("a shipped scene"),
    }
}

#[test]
fn characteristics_agree_on_every_shipped_scene() {
    for (name, values) in SHIPPED {
        let value = values.first().map_or(0.0, |(_, value)| match *value {
            "1/2" => 0.5,
            other => other.parse().unwrap(),
        });
        let network = shipped(name, values);
        let unit = match network.scene().dimensional {
            true => 0.3 / f64::sqrt(210e9 / 7850.0),
            false => 1.0,
        };
        let until = if name == "mass-that-bounces" { 25.0 } else { 12.0 };
        let limit = (until * unit * 1e9) as i64;
        let limit = crate::history::rational(limit, 1_000_000_000);
        let history = History::of(&network, Some(&limit), 9).unwrap();
        let told: Vec<(EventKind, f64)> = (super::by_force(&history.events).into_iter())
            .map(|(kind, event)| (kind, ball(&event.time).rounded().unwrap_or(f64::NAN) / unit))
            .collect();
        let mut seen = simulate(&scene(name, value), until);
        if told.last().is_some_and(|(kind, _)| *kind == EventKind::Release) {
            // A force that stays zero has a rounding for its sign.
            seen.retain(|(kind, _)| *kind == EventKind::Impact);
            seen.push((EventKind::Release, 2.0));
        }
        assert_eq!(told.len(), seen.len(), "{name} {values:?}: {told:?} {seen:?}");
        for ((kind, time), (other, about)) in told.iter().zip(&seen) {
            // A root where the force is flat is found to about the root of the step.
            assert!(kind == other && (time - about).abs() < 3e-3, "{name}: {told:?} {seen:?}");
        }
    }
}
