//! Numbers against the march: every observable at many times.

use num_rational::BigRational;
use num_traits::ToPrimitive;
use wavestep::planner::{Purpose, of_scene};
use wavestep::scene::Scene;
use wavestep::signal::{Limit, digits};

use crate::scenes::march::March;
use crate::scenes::{built_in, network_of, rational, scene_of, shipped, usual};

/// Compares all observables at `count` times up to `last`, in seconds or plain numbers, none of which
/// lies on a grid of small numbers. The march is good to 1e-10 of the largest value of each.
pub fn assert_as_marched(scene: &Scene, last: &BigRational, count: i64) {
    // Contacts are closed on the march.
    let network = network_of(&Scene { contacts_open: false, ..scene.clone() });
    let march = March::new(scene, last.to_f64().unwrap());
    for (observed, seen) in network.observables().iter().zip(&scene.observables) {
        assert_eq!(observed.name, seen.name);
        let window = [&BigRational::default(), last];
        let signal = of_scene(&network, observed, window, Purpose::Echoes).expect("a window");
        let mut pairs = Vec::new();
        for k in 0..count {
            let at = last * rational((2 * k + 1) * 9973, 2 * count * 10007);
            let value = digits(&*signal, &at, Limit::Right, 15, 1 << 10);
            let value = value.unwrap_or_else(|error| {
                panic!("{}: {} at {at}: {error}", scene.title, observed.name)
            });
            let value: f64 = value.decimal(17).0.to_string().parse().expect("a number");
            pairs.push((at.clone(), value, march.observe(&seen.terms, at.to_f64().unwrap())));
        }
        let most = pairs.iter().map(|pair| pair.1.abs().max(pair.2.abs())).fold(0.0, f64::max);
        // What is zero is so but for rounding; plain numbers are about 1 in these scenes.
        let floor = if scene.dimensional { 0.0 } else { 1e-13 };
        for (at, value, marched) in pairs {
            assert!(
                (value - marched).abs() <= 1e-10 * most + floor,
                "{}: {} at {at}: {value:e}, marched {marched:e}, most {most:e}, {} cells",
                scene.title,
                observed.name,
                march.cells(),
            );
        }
    }
}

/// How far each built-in scene is followed.
fn last(name: &str) -> BigRational {
    match name {
        "hopkinson" | "hopkinson-with-release" => rational(12, 10_000),
        "percussive-drill" => rational(8, 10_000),
        "incommensurate" => rational(8, 10_000),
        "pile" | "stepped-striker" => rational(15, 1),
        "mass-between-bars" => rational(12, 1),
        _ => rational(9, 1),
    }
}

#[test]
fn built_in_scenes_are_as_marched() {
    for scene in shipped() {
        let data = scene_of(built_in(scene.name), usual(scene.name));
        let started = std::time::Instant::now();
        assert_as_marched(&data, &last(scene.name), 23);
        eprintln!("{}: {:.1?}", scene.name, started.elapsed());
    }
}
