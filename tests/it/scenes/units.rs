//! Scenes in units, with constants that are no rational numbers, and travel times without a common
//! measure: in seconds, metres and newtons, as the march has them.

use wavestep::signal::{ClosedSignal, EvaluateError, Limit, digits};

use crate::scenes::numbers::assert_as_marched;
use crate::scenes::{network_of, rational, scene_of};

const MATERIALS: &str = "material steel { modulus = 210 GPa, density = 7850 kg/m^3 }\n\
    material alu { modulus = 70 GPa, density = 2700 kg/m^3 }\n";

/// The text, and for how many microseconds it is followed.
const SCENES: [(&str, i64); 12] = [
    (
        "scene \"A pile that is pushed\"
        load blow { force = (50 + 3e4*t)*exp(-1000*t) kN, from = 0.1 ms, until = 3/2 ms }
        bar pile { material = steel, area = 30 cm^2, length = 2 m }
        support toe { stiffness = 80 kN/mm, damping = 30 kN*s/m }
        line free - blow - pile - toe - free
        observe F = force(pile.at(500 mm)) - 2*force(toe)
        observe u = displacement(pile.right) + displacement(pile.at(1/3))/2
        observe s = stress(pile.at(1/4))
        observe P = momentum(line)
        observe E = energy(toe)",
        3000,
    ),
    (
        "scene \"Steel, spring, aluminium, mass\"
        bar a { material = steel, diameter = 20 mm, length = 300 mm, velocity = 4 m/s }
        spring k { stiffness = 30 kN/mm }
        bar b { material = alu, diameter = 25 mm, inner_diameter = 10 mm, length = 400 mm }
        mass m { mass = 300 g }
        line free - a - k - b - m - free
        observe v = velocity(m) - velocity(a.left)/3
        observe e = strain(a.at(100 mm)) + 2*strain(b.at(100 mm))
        observe d = compression(k) + displacement(m)
        observe E = energy(line)
        observe part = 2*energy(b) - energy(k)/3
        observe P = momentum(line)",
        700,
    ),
    (
        "scene \"A late step between two bars\"
        bar a { material = steel, area = 1 cm^2, length = 300 mm }
        load f { force = 2 kN, from = 10 us }
        bar b { material = alu, area = 2 cm^2, length = 200 mm }
        line fixed - a - f - b - free
        observe v = velocity(b.right)
        observe F = force(a.left)
        observe E = energy(line)",
        300,
    ),
    (
        "scene \"Endless on both sides\"
        bar a { material = steel, diameter = 20 mm }
        mass m { mass = 2 kg, velocity = 3 m/s }
        bar b { material = alu, diameter = 20 mm }
        line endless - a - m - b - endless
        observe F = force(a.at(200 mm)) + force(b.at(100 mm)) + force(a.right)
        observe v = velocity(m)
        observe u = displacement(a.at(300 mm))
        observe E = energy(line)
        observe P = momentum(line)",
        900,
    ),
    (
        "scene \"No bar\"
        mass m { mass = 2 kg, velocity = 3 m/s }
        spring k { stiffness = 5 kN/m, damping = 20 N*s/m }
        mass q { mass = 500 g }
        line free - m - k - q - free
        observe v = velocity(q)
        observe F = force(k)
        observe E = energy(line)
        observe x = displacement(q)",
        90_000,
    ),
    (
        "scene \"Impedances\"
        bar a { impedance = 12 kN*s/m, travel = 1 ms, velocity = 2 m/s }
        bar b { impedance = pi*3 kN*s/m, travel = 1/2 ms }
        bar c { impedance = 8 kN*s/m }
        line free - a | b - c - endless
        observe F = force(b.at(200 us)) + force(c.at(1/4 ms))
        observe v = velocity(a.at(1/4))
        observe E = energy(c)
        observe P = momentum(line)",
        7000,
    ),
    (
        "scene \"Strained\"
        bar a { material = alu, area = 1 cm^2, length = 100 mm, strain = 1e-3 }
        mass m { mass = 100 g }
        bar b { material = steel, area = 2 cm^2, length = 300 mm, strain = -2e-4 }
        line fixed - a - m - b - free
        observe e = strain(a.left) - strain(b.at(1/2))
        observe s = stress(b.left)
        observe v = velocity(m)
        observe E = energy(line)
        observe P = momentum(line)",
        400,
    ),
    (
        "scene \"A motion imposed\"
        load v { velocity = 0.2*exp(-2000*t) + 0.1 m/s, until = 1 ms }
        bar a { material = steel, diameter = 3 cm, length = 1 m }
        support s { stiffness = 100 kN/mm }
        bar b { material = alu, diameter = 3 cm, length = 500 mm }
        line free - v - a - s - b - fixed
        observe F = force(a.left) + force(s)
        observe E = energy(b)
        observe u = displacement(b.left)",
        900,
    ),
    (
        "scene \"Three bars and a spring\"
        bar a { material = steel, diameter = 20 mm, length = 100 mm, velocity = 4 m/s }
        bar b { material = alu, diameter = 20 mm, length = 150 mm }
        spring d { stiffness = 20 kN/mm }
        bar c { impedance = 10 kN*s/m, travel = 50 us }
        line free - a | b - d - c - free
        observe F = force(d)
        observe v = velocity(c.right)
        observe E = energy(line)",
        300,
    ),
    (
        "scene \"A step far down a bar at rest\"
        bar a { material = steel, diameter = 20 mm, length = 100 mm }
        bar b { material = steel, diameter = 30 mm, length = 150 mm }
        load f { force = 3 kN }
        bar c { material = steel, diameter = 40 mm }
        line fixed - a - b - f - c - endless
        observe F = force(a.left) - force(c.left)
        observe v = velocity(b.right)
        observe E = energy(a) + energy(c)",
        300,
    ),
    (
        "scene \"Moving together\"
        bar a { material = steel, diameter = 20 mm, length = 100 mm, velocity = -4 m/s }
        mass m { mass = 1/2 kg, velocity = -4 m/s }
        bar b { material = alu, diameter = 30 mm, length = 150 mm, velocity = -4 m/s }
        line free - a - m - b | fixed
        observe F = force(b.right)
        observe v = velocity(m)
        observe u = displacement(m)
        observe E = energy(line)
        observe P = momentum(line)",
        300,
    ),
    (
        "scene \"A rod let go\"
        bar a { material = steel, diameter = 20 mm, length = 100 mm, strain = 1e-4 }
        support s { stiffness = 20 kN/mm, damping = 2 kN*s/m }
        line free - a - s - free
        observe F = force(s)
        observe v = velocity(a.left)
        observe E = energy(line)
        observe P = momentum(line)",
        300,
    ),
];

fn text_of(text: &str) -> String {
    let mut lines: Vec<&str> = text.lines().map(str::trim).collect();
    lines.insert(1, MATERIALS.trim_end());
    lines.join("\n") + "\n"
}

#[test]
fn scenes_in_units_are_as_marched() {
    for (text, last) in SCENES {
        let uses = |name: &str| text.contains(&format!("material = {name}"));
        let mut text = text_of(text);
        for name in ["steel", "alu"] {
            if !uses(name) {
                let lines = text.lines().filter(|l| !l.starts_with(&format!("material {name}")));
                text = lines.collect::<Vec<_>>().join("\n") + "\n";
            }
        }
        assert_as_marched(&scene_of(&text, &[]), &rational(last, 1_000_000), 5);
    }
}

/// A spring and a mass at one end of a bar whose impedance is no rational number: the two rates are
/// roots of a quadratic with irrational coefficients, and no form of them is known.
#[test]
fn rates_of_second_order_in_units_are_told() {
    let text = text_of(
        "scene \"Ram and cushion\"
        mass ram { mass = 10 kg, velocity = 4 m/s }
        spring cushion { stiffness = 100 kN/mm }
        bar pile { material = steel, diameter = 50 mm, length = 2 m }
        line free - ram | cushion - pile - free
        observe v = velocity(ram)",
    );
    let text: String =
        text.lines().filter(|line| !line.contains("alu")).flat_map(|line| [line, "\n"]).collect();
    let network = network_of(&scene_of(&text, &[]));
    let last = rational(1, 1000);
    let signal = ClosedSignal::of_scene(&network, &network.observables()[0], [&last, &last]);
    match digits(&signal.expect("a window"), &last, Limit::Right, 15, 1 << 10) {
        Ok(_) => assert_as_marched(&scene_of(&text, &[]), &rational(2, 1000), 9),
        Err(EvaluateError::Network(error)) => {
            assert!(error.to_string().contains("rates"), "{error}");
        }
        Err(error) => panic!("{error}"),
    }
}
