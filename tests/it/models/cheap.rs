//! The rigid body and the third of the mass: what they keep, how far off they are, and what they refuse.

use crate::models::{built_in, doubles, exact, largest, mean, times};
use wavestep::{Method, Problem};

fn read(text: &str) -> Problem {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    Problem::read("test.wave", lines.join("\n")).unwrap()
}

fn values(problem: &Problem, name: &str, times: &[f64], method: Method) -> Vec<f64> {
    problem.signal(name).unwrap().values_by(times, method).unwrap().values
}

/// Momentum is kept, and the mean velocity over whole round trips is the rigid one.
#[test]
fn free_lines_move_as_rigid_ones_in_the_mean() {
    let network = built_in("struck-free-bar", &[("mu", "1/2")]);
    let bar = Problem::builtin("struck-free-bar").unwrap().with("mu", "1/2").unwrap();
    let times = times("40", 400);
    for value in values(&bar, "momentum", &doubles(&times), Method::Rigid) {
        assert!((value - 1.0).abs() < 1e-15);
    }
    for (observable, name) in ["velocity", "far_velocity"].into_iter().enumerate() {
        let exact = exact(&network, observable, &times);
        let value = values(&bar, name, &[1.0], Method::Rigid)[0];
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
        let bar = read(&text);
        // The mean over twenty round trips takes out the waves; both sides are averaged.
        let mut times = Vec::new();
        for start in [0.2, 0.7, 1.1] {
            times.extend((0..499).map(|k| start + 0.1 / 499.0 * f64::from(k)));
        }
        for name in ["v", "u", "F", "c", "P"] {
            let pair = [Method::Rigid, Method::Steps { tolerance: 1e-6 }];
            let pair = pair.map(|method| values(&bar, name, &times, method));
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
        let bar = read(&text);
        let (h, at) = (1e-3, 0.9);
        let times: Vec<f64> = [-2.0, -1.0, 1.0, 2.0, 0.0].map(|k| at + k * h).into();
        let slope =
            |values: &[f64]| (8.0 * (values[2] - values[1]) - (values[3] - values[0])) / (12.0 * h);
        let [v, u, force] = ["v", "u", "F"].map(|name| values(&bar, name, &times, Method::Rigid));
        assert!((slope(&u) - v[4]).abs() < 1e-10, "{stiffness} {damping}");
        assert!((slope(&v) + force[4] - 5.0).abs() < 1e-10, "{stiffness} {damping}");
        assert!((values(&bar, "v", &[0.0], Method::Rigid)[0] - 3.0).abs() < 1e-15);
    }
}

/// The largest strain at the fixed end: 6.86 is near the exact one, its root without the front below it by
/// about the front, and momentum, which the model keeps, makes it smaller still.
#[test]
fn the_third_is_the_estimate_of_the_source() {
    for (mu, inverse, bound) in [("1/16", 16.0, 0.02), ("1/4", 4.0, 0.05), ("1", 1.0, 0.06)] {
        let network = built_in("mass-on-fixed-bar", &[("mu", mu)]);
        let bar = Problem::builtin("mass-on-fixed-bar").unwrap().with("mu", mu).unwrap();
        // (M + m/3) ω² = k: M = 1, m = μ, k = 1/μ.
        let ride = 1.0 + 1.0 / (3.0 * inverse);
        let period = std::f64::consts::TAU * f64::sqrt(ride / inverse);
        // With V/c = 1 for the front, and a third that strikes along.
        let energy = f64::sqrt(inverse + 1.0 / 3.0);
        let estimate = 1.0 + energy;
        let strains = values(&bar, "strain_fixed", &[period / 4.0, period / 2.0], Method::Third);
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
        read(&text)
    };
    let left = scene("free - hammer | rod - fixed");
    let right = scene("fixed - rod | hammer - free");
    let times = [0.0, 1e-4, 7e-4];
    let values = |bar, name, times: &[f64]| values(bar, name, times, Method::Third);
    for (observable, sign) in [("F", 1.0), ("s", 1.0), ("u", -1.0), ("p", -1.0)] {
        let pair = [&left, &right].map(|bar| values(bar, observable, &times));
        for (a, b) in pair[0].iter().zip(&pair[1]) {
            assert!((a - sign * b).abs() <= 1e-12 * a.abs(), "{observable} {a} {b}");
        }
    }
    // 8/3 of the 8 kg of the bar ride along with 3 kg: 4 m/s become 4·3/(17/3).
    let start = 12.0 / (3.0 + 8.0 / 3.0);
    assert!((values(&left, "p", &[0.0])[0] - 3.0 * start).abs() < 1e-12);
    // The hammer at the left end, and a quarter of the bar from it, or from the fixed end.
    assert!((values(&left, "v", &[0.0])[0] - 1.75 * start).abs() < 1e-12);
    assert!((values(&right, "v", &[0.0])[0] + 1.25 * start).abs() < 1e-12);
    // The force is k u: EA/L = 5e7.
    let t = 1e-4;
    let omega = f64::sqrt(5e7 / (17.0 / 3.0));
    let force = 5e7 * start / omega * (omega * t).sin();
    assert!((values(&left, "F", &[t])[0] - force).abs() < 1e-9 * force);
}

const BAR: &str = "bar a { impedance = 1, travel = 1, velocity = 1 }\n";

/// A refusal says what is not represented, by name; energies are those of the masses and springs.
#[test]
fn what_has_waves_or_cannot_move_is_refused() {
    let refused = [
        (
            Method::Rigid,
            "bar s { impedance = 1, travel = 1, strain = 1 }\nline free - a - s - free",
            "`s`: a bar without waves has no strain at the start",
        ),
        (Method::Rigid, "line free - a - fixed", "`a`: this bar cannot move"),
        (
            Method::Rigid,
            "line free - a - free\nobserve X = force(a.at(1/4))",
            "`X`: the force in a rigid bar is unknown",
        ),
        (Method::Third, "line fixed - a - fixed", "`a`: this bar cannot move"),
    ];
    for (method, scene, told) in refused {
        let text = format!("scene \"A\"\n{BAR}{scene}\nobserve v = velocity(a.left)");
        let name = if scene.contains("X = ") { "X" } else { "v" };
        let bar = read(&text);
        let error = bar.signal(name).unwrap().values_by(&[1.0], method).unwrap_err();
        assert!(error.is_not_supported(), "{error}");
        let text = error.to_string();
        assert!(text.ends_with(&format!("does not support this scene: {told}")), "{text}");
    }
}

/// An endless bar stays one: a rigid bar of mass 1 is slowed down by its impedance 1, `v = e^(−t)`.
#[test]
fn endless_bars_stay_beside_rigid_ones() {
    let bar = read(&format!(
        "scene \"A\"\n{BAR}bar e {{ impedance = 1 }}\nline free - a - e - endless\n\
         observe v = velocity(a.left)\nobserve F = force(e.left)"
    ));
    for name in ["v", "F"] {
        let value = values(&bar, name, &[1.5], Method::Rigid)[0];
        assert!((value - f64::exp(-1.5)).abs() < 1e-14, "{name}: {value}");
    }
    // As a spring it has half of its mass at each end.
    let third = read(
        "scene \"B\"\nmass l { mass = 1/2, velocity = 1 }\nspring k { stiffness = 1 }\n\
         mass r { mass = 1/2, velocity = 1 }\nbar e { impedance = 1 }\n\
         line free - l - k - r - e - endless\nobserve F = force(e.left)",
    );
    let exact = third.signal("F").unwrap().at("3/2", 15).unwrap().to_f64();
    let value = values(&bar, "F", &[1.5], Method::Third)[0];
    assert!((value - exact).abs() < 1e-13, "{value} {exact}");
}

/// What used to take one body takes several, and forces that vary.
#[test]
fn rigid_bars_are_as_many_bodies_as_springs_part_them_into() {
    let bar = read(&format!(
        "scene \"A\"\n{BAR}spring k {{ stiffness = 1 }}\nmass m {{ mass = 1 }}\nline free - m - k - a - free\n\
         observe F = force(k)\nobserve e = energy(line)"
    ));
    // The spring swings with half of the mass: `F = −∫ V cos(√2 t)`.
    let force = values(&bar, "F", &[1.5], Method::Rigid)[0];
    assert!((force + (1.5 * f64::sqrt(2.0)).sin() / f64::sqrt(2.0)).abs() < 1e-14, "{force}");
    assert!((values(&bar, "e", &[1.5], Method::Rigid)[0] - 0.5).abs() < 1e-14);
    let pushed = read(&format!(
        "scene \"A\"\n{BAR}load f {{ force = exp(-t) }}\nline free - f - a - free\n\
         observe v = velocity(a.left)"
    ));
    let own = values(&pushed, "v", &[2.0], Method::Rigid)[0];
    assert!((own - (2.0 - (-2.0_f64).exp())).abs() < 1e-14, "{own}");
}
