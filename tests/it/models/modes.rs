//! Modes of vibration: errors fall like 1/N away from jumps.

use crate::models::{built_in, differences, exact, largest, linear, mean, network, times};
use wavestep::model::{Model, Modes};

#[test]
fn errors_fall_with_the_number_of_modes() {
    let strained = "scene \"A strained rod is let go\"
        mass m { mass = 1/2, velocity = 1 }
        bar a { impedance = 2, travel = 1, strain = -1/4, velocity = 1/3 }
        spring k { stiffness = 3 }
        bar b { impedance = 1, travel = 1/2 }
        support s { stiffness = 2 }
        line free - m - a - k - b - s - free
        observe v = velocity(m)
        observe F = force(k) + force(s)
        observe X = force(a.at(1/3)) + force(b.left)
        observe u = displacement(b.at(1/4)) - compression(k)
        observe P = momentum(line)";
    let scenes: [(crate::models::Network, &str); 4] = [
        (built_in("mass-on-fixed-bar", &[("mu", "1")]), "10"),
        (built_in("struck-free-bar", &[("mu", "2/3")]), "7"),
        (built_in("mass-between-bars", &[("m", "5/4")]), "9"),
        (network(strained, &[]), "7"),
    ];
    for (network, last) in &scenes {
        let times = times(last, 41);
        for observable in linear(network) {
            let exact = exact(network, observable, &times);
            let error = |count: usize| {
                let model = Modes::new(network, count).unwrap_or_else(|error| panic!("{error}"));
                mean(&differences(&model, observable, &times, &exact))
            };
            let [few, many] = [50, 1600].map(error);
            let name = &network.observables()[observable].name;
            // 32 times as many modes: 1/N would be 32 times better.
            assert!(many < few / 12.0 || many < 1e-12, "{name}: {few:e} {many:e}");
            assert!(many < 2.0 / 1600.0 * largest(&exact), "{name}: {many:e}");
        }
    }
}

/// The frequencies of known lines, in order and without gaps, also where a mass stands still.
#[test]
fn frequencies_are_those_of_known_equations() {
    let rod = "scene \"A\"
        symbol m > 0
        bar a { impedance = 1, travel = 1, velocity = 1 }
        mass mid { mass = m }
        bar b { impedance = 1, travel = 1 }
        line fixed - a - mid - b - fixed";
    let pi = std::f64::consts::PI;
    for mass in ["1/100", "1", "1000000"] {
        let network = network(rod, &[("m", mass)]);
        let modes = Modes::new(&network, 40).unwrap();
        let found: Vec<f64> = modes.frequencies().collect();
        let (numerator, denominator) = mass.split_once('/').unwrap_or((mass, "1"));
        let mass = numerator.parse::<f64>().unwrap() / denominator.parse::<f64>().unwrap();
        for (n, frequency) in found.iter().enumerate() {
            let half = (n / 2) as f64;
            match n % 2 {
                // 2 cot ω = m ω, one root between multiples of π.
                0 => {
                    assert!(*frequency > half * pi && *frequency < (half + 1.0) * pi);
                    let rest = 2.0 * frequency.cos() - mass * frequency * frequency.sin();
                    let slope = 2.0 + mass * (1.0 + frequency);
                    assert!(rest.abs() < 1e-13 * slope * (1.0 + frequency), "{mass} {n} {rest:e}");
                }
                // The mass stands still.
                _ => assert!((frequency - (half + 1.0) * pi).abs() < 1e-13 * frequency),
            }
        }
    }
    // A free line moves as a whole first.
    let free = built_in("struck-free-bar", &[("mu", "1")]);
    let modes = Modes::new(&free, 3).unwrap();
    let found: Vec<f64> = modes.frequencies().collect();
    assert!(found[0] == 0.0 && (found[1].tan() + found[1]).abs() < 1e-12);
}

/// In seconds: the first mode of a steel bar fixed at one end is c/4L, in turns a second.
#[test]
fn units_are_those_of_the_user() {
    let text = "scene \"A steel bar\"
        bar rod { modulus = 200 GPa, density = 8000 kg/m^3, diameter = 20 mm, length = 1 m, velocity = 2 m/s }
        line free - rod - fixed
        observe s = stress(rod.right)
        observe v = velocity(rod.left)";
    let network = network(text, &[]);
    let modes = Modes::new(&network, 400).unwrap();
    let first = modes.frequencies().next().unwrap() / std::f64::consts::TAU;
    assert!((first - 1250.0).abs() < 1e-9);
    let times = times("0.001", 11);
    for observable in [0, 1] {
        let exact = exact(&network, observable, &times);
        let error = mean(&differences(&modes, observable, &times, &exact));
        assert!(error < 5e-3 * largest(&exact), "{error:e}");
    }
    assert_eq!(modes.values(0, &[-1e-3]).unwrap(), [0.0]);
}
