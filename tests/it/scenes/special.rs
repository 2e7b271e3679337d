//! Scenes at the edge: poles that meet, complex and irrational ones, loads of all kinds, one thing cut
//! in two, and everything mirrored.

use num_rational::BigRational;
use wavestep::expression::{Expression, Fraction};
use wavestep::network::{Network, NetworkError};
use wavestep::planner::{Purpose, of_scene};
use wavestep::scene::{Kind, Scene};
use wavestep::signal::{Limit, digits};
use wavestep::solution::Solution;
use wavestep_polynomial::Symbol;

use crate::scenes::numbers::assert_as_marched;
use crate::scenes::proof::assert_laws_hold;
use crate::scenes::{built_in, network_of, rational, scene_of, shipped, usual};
use crate::support::mirror::mirrored;
use crate::support::{by_echoes, by_periods, violation};

/// What is declared, the line, and how many units of time it is followed; `0` where the times lie on no
/// grid and the laws are not proved on cells.
const SPECIAL: [(&str, &str, &str, usize); 28] = [
    (
        "a mass between a spring and a bar: complex poles",
        "mass m { mass = 2, velocity = 1 }\nspring k { stiffness = 1 }\nbar b { impedance = 1, travel = 1 }",
        "free - m - k - b - free",
        12,
    ),
    (
        "a double pole",
        "mass m { mass = 1, velocity = 1 }\nspring k { stiffness = 4 }\nbar b { impedance = 1, travel = 1 }",
        "free - m - k - b - fixed",
        12,
    ),
    (
        "real irrational poles",
        "mass m { mass = 1, velocity = 1 }\nspring k { stiffness = 8 }\nbar b { impedance = 1, travel = 1 }",
        "free - m - k - b - fixed",
        10,
    ),
    (
        "real rational poles",
        "mass m { mass = 1, velocity = 1 }\nspring k { stiffness = 9/2 }\nbar b { impedance = 1, travel = 1 }",
        "free - m - k - b - free",
        10,
    ),
    (
        "discriminant 2",
        "mass m { mass = 4/3, velocity = 1 }\nspring k { stiffness = 4 }\nbar b { impedance = 1, travel = 1 }",
        "free - m - k - b - free",
        9,
    ),
    (
        "a spring and a mass on a support with a damper",
        "bar b { impedance = 1, travel = 1, velocity = 1 }\nmass m { mass = 1 }\nsupport s { stiffness = 3/2, damping = 1/2 }",
        "free - b | m - s - free",
        10,
    ),
    (
        "a mass on a support without damping, double pole",
        "bar b { impedance = 2, travel = 1, velocity = 1 }\nmass m { mass = 1 }\nsupport s { stiffness = 1 }",
        "fixed - b - m - s - free",
        10,
    ),
    (
        "two lumped systems and one bar",
        "mass m { mass = 1, velocity = 1 }\nspring k { stiffness = 1/2 }\nbar b { impedance = 1, travel = 3/4 }\nmass q { mass = 1/3 }\nspring l { stiffness = 1, damping = 1/5 }",
        "free - m - k - b - q - l - fixed",
        8,
    ),
    (
        "two masses at the ends of one bar",
        "mass m { mass = 1, velocity = 1 }\nbar b { impedance = 1, travel = 1 }\nmass q { mass = 2, velocity = -1/2 }",
        "free - m - b - q - free",
        10,
    ),
    (
        "several masses at one node",
        "mass m { mass = 1, velocity = 1 }\nmass q { mass = 2 }\nmass o { mass = 1/2, velocity = -1 }\nbar b { impedance = 1, travel = 1 }",
        "free - m | q - o - b - fixed",
        10,
    ),
    (
        "a mass, a support and a mass between bars",
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nmass m { mass = 1 }\nsupport s { damping = 1 }\nmass q { mass = 1 }\nbar b { impedance = 2, travel = 2 }",
        "free - a - m - s - q - b - free",
        10,
    ),
    (
        "a damper alone between bars",
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nspring d { damping = 3/2 }\nbar b { impedance = 2, travel = 1 }",
        "free - a - d - b - fixed",
        10,
    ),
    (
        "a step of force at an inner joint",
        "bar a { impedance = 1, travel = 1 }\nload f { force = 2 }\nbar b { impedance = 3, travel = 1/2 }",
        "fixed - a - f - b - free",
        10,
    ),
    (
        "a ramp of force",
        "load f { force = 3*t }\nbar a { impedance = 1, travel = 1 }",
        "free - f - a - fixed",
        9,
    ),
    (
        "a rectangular pulse on the grid",
        "load f { force = 1, from = 1, until = 3 }\nbar a { impedance = 1, travel = 1 }\nsupport s { stiffness = 1 }",
        "free - f - a - s - free",
        10,
    ),
    (
        "a rectangular pulse off the grid of the bar",
        "load f { force = 1, from = 1/3, until = 3/4 }\nbar a { impedance = 1, travel = 1 }\nmass m { mass = 1 }",
        "free - f - a - m - free",
        6,
    ),
    (
        "a force that decays",
        "load f { force = exp(-t) }\nbar a { impedance = 1, travel = 1 }\nspring k { stiffness = 1 }",
        "free - f - a - k - fixed",
        9,
    ),
    (
        "a force that decays, cut short, on a mass",
        "load f { force = (1 - t)*exp(-2*t), from = 1/2, until = 2 }\nmass m { mass = 1 }\nbar a { impedance = 1, travel = 1 }",
        "free - f - m - a - free",
        7,
    ),
    (
        "a velocity imposed on a bar",
        "load v { velocity = 1 - exp(-t) }\nbar a { impedance = 1, travel = 1 }\nmass m { mass = 1 }",
        "free - v - a - m - free",
        9,
    ),
    (
        "a velocity imposed on a spring",
        "load v { velocity = t, until = 2 }\nspring k { stiffness = 2, damping = 1/2 }\nbar a { impedance = 1, travel = 1 }",
        "free - v - k - a - fixed",
        9,
    ),
    (
        "a velocity imposed between two bars",
        "bar a { impedance = 1, travel = 1 }\nload v { velocity = 1, from = 1, until = 2 }\nbar b { impedance = 2, travel = 2 }",
        "fixed - a - v - b - free",
        10,
    ),
    (
        "a stretched bar let go",
        "bar a { impedance = 1, travel = 1, strain = 1 }\nbar b { impedance = 2, travel = 1 }",
        "fixed - a - b - free",
        10,
    ),
    (
        "a compressed, moving bar between a mass and a support",
        "mass m { mass = 1, velocity = 1/2 }\nbar a { impedance = 1, travel = 1, velocity = 1/2, strain = -1 }\nsupport s { stiffness = 1/2, damping = 1/4 }",
        "free - m - a - s - free",
        9,
    ),
    (
        "a support that moves with the bar from the start",
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nsupport s { stiffness = 1, damping = 1/2 }\nbar b { impedance = 1, travel = 1, velocity = 1 }",
        "free - a - s - b - free",
        9,
    ),
    (
        "a mass that moves with both bars",
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nmass m { mass = 2, velocity = 1 }\nbar b { impedance = 3, travel = 1, velocity = 1 }",
        "free - a - m - b - fixed",
        9,
    ),
    (
        "masses and springs without a bar",
        "mass m { mass = 1, velocity = 1 }\nspring k { stiffness = 2 }\nmass q { mass = 2 }",
        "free - m - k - q - free",
        6,
    ),
    (
        "endless on both sides",
        "bar a { impedance = 1 }\nmass m { mass = 1, velocity = 1 }\nspring k { stiffness = 1/3 }\nbar b { impedance = 2 }",
        "endless - a - m - k - b - endless",
        6,
    ),
    (
        "a mass that moves with a bar, everything else at rest at a distance",
        "mass m { mass = 1, velocity = 1 }\nbar a { impedance = 1, travel = 1, velocity = 1 }\nspring k { stiffness = 2 }\nbar b { impedance = 1, travel = 2 }",
        "free - m - a | k - b - fixed",
        9,
    ),
];

/// Everything that can be observed of every element.
fn observables(scene: &Scene) -> String {
    let mut text = String::new();
    let mut observe = |what: String| {
        let count = text.lines().count();
        text.push_str(&format!("observe o{count} = {what}\n"));
    };
    for element in &scene.line.elements {
        let name = &scene.elements[*element].name;
        match &scene.elements[*element].kind {
            Kind::Bar(bar) => {
                let endless = bar.is_endless();
                let left = *element == scene.line.elements[0];
                let places: &[&str] = match (endless, left) {
                    (false, _) => &["left", "right", "at(1/3)"],
                    (true, true) => &["right", "at(1/3)"],
                    (true, false) => &["left", "at(1/3)"],
                };
                for place in places {
                    for measure in ["velocity", "force", "strain", "displacement"] {
                        observe(format!("{measure}({name}.{place})"));
                    }
                }
                observe(format!("momentum({name})"));
                observe(format!("energy({name})"));
            }
            Kind::Mass(_) => {
                for measure in ["velocity", "displacement", "momentum", "energy"] {
                    observe(format!("{measure}({name})"));
                }
            }
            Kind::Spring(_) => {
                for measure in ["force", "compression", "energy"] {
                    observe(format!("{measure}({name})"));
                }
            }
            Kind::Support(_) => {
                for measure in ["force", "energy"] {
                    observe(format!("{measure}({name})"));
                }
            }
            Kind::Hertz(_) | Kind::Load(_) => {}
        }
    }
    text.push_str("observe momentum = momentum(line)\nobserve energy = energy(line)\n");
    text
}

fn text_of(name: &str, parts: &str, line: &str) -> String {
    format!("scene \"{name}\"\n{parts}\nline {line}\n")
}

fn special(name: &str, parts: &str, line: &str) -> Scene {
    let text = text_of(name, parts, line);
    let observables = observables(&scene_of(&text, &[]));
    scene_of(&format!("{text}{observables}"), &[])
}

#[test]
fn special_scenes_are_as_marched() {
    for (name, parts, line, last) in SPECIAL {
        let scene = special(name, parts, line);
        assert_as_marched(&scene, &rational(last as i64, 1), 7);
    }
}

#[test]
fn laws_hold_in_special_scenes() {
    for (name, parts, line, _) in SPECIAL {
        let mut scene = special(name, parts, line);
        scene.observables.retain(|seen| seen.name == "momentum");
        let network = network_of(&scene);
        let cells = if network.model().bars.is_empty() { 1 } else { 10 };
        assert_laws_hold(&network, cells);
    }
}

#[test]
fn both_derivations_give_the_same_in_special_scenes() {
    for (name, parts, line, _) in SPECIAL {
        let recurrence = network_of(&scene_of(&text_of(name, parts, line), &[])).recurrence();
        let recurrence = recurrence.unwrap_or_else(|error| panic!("{name}: {error}"));
        let pieces = by_periods(&recurrence, 5);
        assert!(pieces == by_echoes(&recurrence, 5), "{name}");
        assert_eq!(violation(&recurrence, &pieces), None, "{name}");
    }
}

// ---- One thing cut in two ------------------------------------------------------------------------

/// The pieces of an observable.
fn pieces(scene: &Scene, name: &str, last: usize) -> (String, Vec<Expression>) {
    let mut scene = scene.clone();
    scene.observables.retain(|seen| seen.name == name);
    let solution = Solution::new(network_of(&scene).recurrence().expect("a grid"));
    let seen = solution.recurrence().observation(name).expect("an observable");
    let observed = solution.observed(&seen, 0, last).expect("pieces");
    (observed.offset.numerator().to_string(), observed.pieces)
}

#[test]
fn a_joint_of_equal_impedances_is_no_joint() {
    let ends = "mass m { mass = 1, velocity = 1 }\nsymbol k > 0\nsupport s { damping = k }\n";
    let whole = scene_of(
        &format!(
            "scene \"Whole\"\n{ends}bar b {{ impedance = 2, travel = 3 }}\n\
             line free - m - b - s - free\nobserve v = velocity(m)\nobserve F = force(b.right)\n"
        ),
        &[],
    );
    let cut = scene_of(
        &format!(
            "scene \"Cut\"\n{ends}bar b {{ impedance = 2, travel = 1 }}\n\
             bar c {{ impedance = 2, travel = 2 }}\n\
             line free - m - b - c - s - free\nobserve v = velocity(m)\nobserve F = force(c.right)\n"
        ),
        &[],
    );
    // The whole one has periods of 6, the other of 2.
    for name in ["v", "F"] {
        let (whole, cut) = (pieces(&whole, name, 3), pieces(&cut, name, 11));
        let shift = |piece: &Expression, by: i64| {
            let local = Symbol::new("s").unwrap();
            let by = Fraction::constant(&rational(by, 1));
            piece.shift(&local, &by).expect("a shift")
        };
        // The force arrives after 3 in both: later by 1 on periods of 2.
        let (offset, own) = match name {
            "F" => (1, 1),
            _ => (0, 0),
        };
        assert_eq!((whole.0.as_str(), cut.0.as_str()), [("0", "0"), ("3", "1")][own]);
        for n in 0..12 - offset {
            let expected = shift(&whole.1[n / 3], 2 * (n as i64 % 3));
            assert!(cut.1[n + offset] == expected, "{name} on piece {n}");
        }
    }
}

#[test]
fn extreme_steps_of_impedance_are_ends() {
    let z = Symbol::new("z").unwrap();
    let hammer = "mass m { mass = 1, velocity = 1 }\nbar a { impedance = 1, travel = 1 }\n";
    let seen = "observe v = velocity(m)\nobserve F = force(a.left)\n";
    // With 1/z for the impedance, z = 0 is a wall.
    for (impedance, end) in [("z", "free"), ("1/z", "fixed")] {
        let second = format!("bar b {{ impedance = {impedance}, travel = 1 }}\n");
        let line = "line free - m - a - b - free\n";
        let stepped =
            scene_of(&format!("scene \"Step\"\nsymbol z > 0\n{hammer}{second}{line}{seen}"), &[]);
        let line = format!("line free - m - a - {end}\n");
        let alone = scene_of(&format!("scene \"End\"\n{hammer}{line}{seen}"), &[]);
        for name in ["v", "F"] {
            let (with, without) = (pieces(&stepped, name, 7), pieces(&alone, name, 7));
            for (with, without) in with.1.iter().zip(&without.1) {
                let limit = with.substitute(&z, &Fraction::zero()).expect("a limit");
                assert!(limit == *without, "{name} at a {end} end");
            }
        }
    }
}

// ---- Mirrored ------------------------------------------------------------------------------------

#[test]
fn mirrored_scenes_give_mirrored_answers() {
    let built_in = shipped().map(|scene| scene_of(built_in(scene.name), usual(scene.name)));
    let special = SPECIAL.iter().map(|(name, parts, line, _)| special(name, parts, line));
    for scene in built_in.chain(special) {
        let other = mirrored(&scene);
        let last = if scene.dimensional { rational(5, 10_000) } else { rational(5, 1) };
        assert_same_numbers(&network_of(&scene), &network_of(&other), &last);
    }
}

fn assert_same_numbers(one: &Network, other: &Network, last: &BigRational) {
    let start = BigRational::default();
    for (own, turned) in one.observables().iter().zip(other.observables()) {
        let signals = [(one, own), (other, turned)].map(|(network, observed)| {
            of_scene(network, observed, [&start, last], Purpose::Echoes).expect("a window")
        });
        for k in 1..4 {
            let at = last * rational(k * 997, 4 * 1009);
            let [first, second] = signals.each_ref().map(|signal| {
                let value = digits(&**signal, &at, Limit::Right, 20, 1 << 10);
                value.unwrap_or_else(|error| panic!("{error}")).decimal(20).0.to_string()
            });
            assert_eq!(first, second, "{}: {} at {at}", one.scene().title, own.name);
        }
    }
}

// ---- Energies that stay ----------------------------------------------------------------------------

/// Where nothing is spent, carried away or added, certified digits of the energy are those of the start.
#[test]
fn energy_that_nothing_takes_stays() {
    let kept = ["mass-on-fixed-bar", "struck-free-bar", "mass-between-bars", "incommensurate"];
    let kept = kept.iter().map(|name| scene_of(built_in(name), usual(name)));
    let conserving = SPECIAL.iter().filter(|(_, parts, line, _)| {
        !["damping", "load", "endless"]
            .iter()
            .any(|what| parts.contains(what) || line.contains(what))
    });
    for scene in kept.chain(conserving.map(|(name, parts, line, _)| special(name, parts, line))) {
        let network = network_of(&scene);
        let last = if scene.dimensional { rational(1, 1000) } else { rational(8, 1) };
        let energy = network.observables().iter().find(|seen| seen.name == "energy").expect("one");
        let window = [&BigRational::default(), &last];
        let signal =
            of_scene(&network, energy, window, Purpose::Values { digits: 20 }).expect("a window");
        let value = |at: BigRational| {
            let value = digits(&*signal, &at, Limit::Right, 30, 1 << 10);
            value.unwrap_or_else(|error| panic!("{error}")).decimal(30).0.to_string()
        };
        let start = value(rational(0, 1));
        for k in 1..5 {
            let at = &last * rational(k * 89, 5 * 97);
            assert_eq!(value(at), start, "{}", scene.title);
        }
    }
}

// ---- What is refused -------------------------------------------------------------------------------

#[test]
fn travel_times_without_a_measure_give_no_recurrence() {
    let network = network_of(&scene_of(built_in("incommensurate"), &[]));
    assert_eq!(network.recurrence(), Err(NetworkError::Incommensurate));
    assert_eq!(network.lattice().periods().len(), 2);
}
