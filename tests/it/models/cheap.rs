//! The rigid body and the third of the mass: what they keep, and how far off they are.

use crate::models::{built_in, doubles, exact, largest, mean, network, times};
use wavestep::model::{Model, RigidBody, Steps, ThirdOfMass};

/// Momentum is kept, and the mean velocity over whole round trips is the rigid one.
#[test]
fn free_lines_move_as_rigid_ones_in_the_mean() {
    let network = built_in("struck-free-bar", &[("mu", "1/2")]);
    let rigid = RigidBody::new(&network).unwrap();
    assert_eq!(rigid.mass(), 1.5);
    let times = times("40", 400);
    let momentum = 5;
    for value in rigid.values(momentum, &doubles(&times)).unwrap() {
        assert!((value - 1.0).abs() < 1e-15);
    }
    for observable in [0, 1] {
        let exact = exact(&network, observable, &times);
        let value = rigid.values(observable, &[1.0]).unwrap()[0];
        assert!((value - 2.0 / 3.0).abs() < 1e-15);
        assert!((mean(&exact) - value).abs() < 0.01, "{}", mean(&exact));
        // What is left out is as large as the waves.
        let off: Vec<f64> = exact.iter().map(|exact| exact - value).collect();
        assert!(largest(&off) > 0.1);
    }
}

/// A short stiff bar on soft springs and dampers, and forces that come and go: nearly rigid, in
/// both kinds of damping. The error is that of the travel time, here 1/400.
#[test]
fn stiff_lines_move_as_rigid_ones() {
    for damping in ["0", "4"] {
        let text = format!(
            "scene \"Stiff\"
            load push {{ force = 3, from = 1/2, until = 1 }}
            mass m {{ mass = 1/2, velocity = 2 }}
            bar a {{ impedance = 200, travel = 1/400 }}
            support s {{ stiffness = 1, damping = {damping} }}
            spring k {{ stiffness = 3 }}
            line free - push - m - a - s - k - fixed
            observe v = velocity(m)
            observe u = displacement(a.at(1/2))
            observe F = force(k) + 2*force(s)
            observe c = compression(k)
            observe P = momentum(line)"
        );
        let network = network(&text, &[]);
        let rigid = RigidBody::new(&network).unwrap();
        // The mean over twenty round trips takes out the waves; both sides are averaged.
        let steps = Steps::new(&network, 1e-6).unwrap();
        let mut times = Vec::new();
        for start in [0.2, 0.7, 1.1] {
            times.extend((0..499).map(|k| start + 0.1 / 499.0 * f64::from(k)));
        }
        for observable in 0..5 {
            let name = &network.observables()[observable].name;
            let pair = [&rigid as &dyn Model, &steps];
            let pair = pair.map(|model| model.values(observable, &times).unwrap());
            for (a, b) in pair[0].chunks(499).zip(pair[1].chunks(499)) {
                let (a, b) = (mean(a), mean(b));
                assert!((a - b).abs() < 0.03 * (1.0 + b.abs()), "{damping} {name} {a} {b}");
            }
        }
    }
}

/// `M v' + d v + k x = F` holds for what is computed, by differences of fourth order.
#[test]
fn rigid_motion_obeys_its_equation() {
    for (stiffness, damping) in [("3", "0"), ("3", "1"), ("1", "4"), ("1", "2"), ("0", "2")] {
        let text = format!(
            "scene \"Body\"
            bar a {{ impedance = 1/2, travel = 2, velocity = 3 }}
            support s {{ stiffness = {stiffness}, damping = {damping} }}
            load push {{ force = 5 }}
            line free - a - s - push - free
            observe v = velocity(a.left)
            observe u = displacement(a.right)
            observe F = force(s)"
        );
        let network = network(&text, &[]);
        let rigid = RigidBody::new(&network).unwrap();
        let (h, at) = (1e-3, 0.9);
        let times: Vec<f64> = [-2.0, -1.0, 1.0, 2.0, 0.0].map(|k| at + k * h).into();
        let slope =
            |values: &[f64]| (8.0 * (values[2] - values[1]) - (values[3] - values[0])) / (12.0 * h);
        let [v, u, force] = [0, 1, 2].map(|i| rigid.values(i, &times).unwrap());
        assert!((slope(&u) - v[4]).abs() < 1e-10, "{stiffness} {damping}");
        assert!((slope(&v) + force[4] - 5.0).abs() < 1e-10, "{stiffness} {damping}");
        assert!((rigid.values(0, &[0.0]).unwrap()[0] - 3.0).abs() < 1e-15);
    }
}

/// The largest strain at the fixed end: 6.86 is near the exact one, its root without the front below it by
/// about the front, and momentum, which the model keeps, makes it smaller still.
#[test]
fn the_third_is_the_estimate_of_the_source() {
    for (mu, inverse, bound) in [("1/16", 16.0, 0.02), ("1/4", 4.0, 0.05), ("1", 1.0, 0.06)] {
        let network = built_in("mass-on-fixed-bar", &[("mu", mu)]);
        let model = ThirdOfMass::new(&network).unwrap();
        // (M + m/3) ω² = k: M = 1, m = μ, k = 1/μ.
        let ride = 1.0 + 1.0 / (3.0 * inverse);
        let period = std::f64::consts::TAU * f64::sqrt(ride / inverse);
        // With V/c = 1 for the front, and a third that strikes along.
        let energy = f64::sqrt(inverse + 1.0 / 3.0);
        let estimate = 1.0 + energy;
        let strains = model.values(2, &[period / 4.0, period / 2.0]).unwrap();
        assert!((largest(&strains) - energy / ride).abs() < 1e-14);
        assert!(strains[1].abs() < 1e-14);
        // The exact strain at the fixed end while the contact presses: less than half a period.
        let last = format!("{}", (period * 55.0).floor() / 100.0);
        let strains = exact(&network, 2, &times(&last, 300));
        let most = largest(&strains);
        let off = (estimate - most).abs() / most;
        eprintln!("mu {mu}: exact {most:.4}, 6.86 {estimate:.4}, by momentum {:.4}", energy / ride);
        assert!(off < bound, "mu {mu}: exact {most}, 6.86 {estimate}");
        assert!(energy < most);
    }
}

/// The same scene mirrored, with units, and read at all places.
#[test]
fn the_third_is_the_same_from_both_sides() {
    let scene = |line: &str| {
        let text = format!(
            "scene \"Third\"
            mass hammer {{ mass = 3 kg, velocity = {} m/s }}
            bar rod {{ modulus = 200 GPa, density = 8000 kg/m^3, area = 5 cm^2, length = 2 m }}
            line {line}
            observe v = velocity(hammer) + velocity(rod.at(1/4))
            observe F = force(rod.left)
            observe s = stress(rod.right)
            observe u = displacement(rod.at(1/2))
            observe p = momentum(hammer)",
            if line.starts_with("free") { 4 } else { -4 }
        );
        ThirdOfMass::new(&network(&text, &[])).unwrap()
    };
    let left = scene("free - hammer | rod - fixed");
    let right = scene("fixed - rod | hammer - free");
    let times = [0.0, 1e-4, 7e-4];
    for (observable, sign) in [(1, 1.0), (2, 1.0), (3, -1.0), (4, -1.0)] {
        let pair = [&left, &right].map(|model| model.values(observable, &times).unwrap());
        for (a, b) in pair[0].iter().zip(&pair[1]) {
            assert!((a - sign * b).abs() <= 1e-12 * a.abs(), "{observable} {a} {b}");
        }
    }
    // 8/3 of the 8 kg of the bar ride along with 3 kg: 4 m/s become 4·3/(17/3).
    let start = 12.0 / (3.0 + 8.0 / 3.0);
    assert!((left.values(4, &[0.0]).unwrap()[0] - 3.0 * start).abs() < 1e-12);
    // The hammer at the left end, and a quarter of the bar from it, or from the fixed end.
    assert!((left.values(0, &[0.0]).unwrap()[0] - 1.75 * start).abs() < 1e-12);
    assert!((right.values(0, &[0.0]).unwrap()[0] + 1.25 * start).abs() < 1e-12);
    // The force is k u: EA/L = 5e7.
    let t = 1e-4;
    let omega = f64::sqrt(5e7 / (17.0 / 3.0));
    let force = 5e7 * start / omega * (omega * t).sin();
    assert!((left.values(1, &[t]).unwrap()[0] - force).abs() < 1e-9 * force);
}
