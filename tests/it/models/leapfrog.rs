//! The leapfrog: second order where the solution is smooth, first order in the mean where it jumps,
//! and exact on characteristics.

use crate::models::{
    Settings, built_in, differences, exact, largest, linear, mean, network, times,
};
use wavestep::model::Leapfrog;
use wavestep::network::Network;

/// A load that begins smoothly, and all that a node can have.
const SMOOTH: &str = "scene \"Smooth\"
    load push { force = t^4*exp(-3*t) }
    mass head { mass = 1/3 }
    bar a { impedance = 1, travel = 1 }
    spring k { stiffness = 2, damping = 1/3 }
    mass m { mass = 1/2 }
    bar b { impedance = 2, travel = 2 }
    support s { stiffness = 3, damping = 1/2 }
    line free - push - head - a - k - m - b - s - free
    observe v = velocity(a.at(3/8)) - velocity(m)
    observe u = displacement(b.at(5/8)) + displacement(head)
    observe F = force(k) + force(s)
    observe X = force(a.left) + force(b.at(1/3)) + 2*force(b.right)
    observe P = momentum(line) + compression(k)";

fn errors(
    network: &Network,
    observable: usize,
    last: &str,
    cells: &[usize],
    courant: f64,
) -> Vec<Vec<f64>> {
    let times = times(last, 40);
    let exact = exact(network, observable, &times);
    let error = |cells: &usize| {
        let model =
            Leapfrog::new(network, *cells, courant).unwrap_or_else(|error| panic!("{error}"));
        differences(&model, observable, &times, &exact)
    };
    cells.iter().map(error).collect()
}

#[test]
fn smooth_motion_is_of_second_order() {
    let network = network(SMOOTH, &[]);
    for courant in [0.6, 1.0] {
        for observable in linear(&network) {
            let errors = errors(&network, observable, "6", &[40, 160], courant);
            let [coarse, fine] = [0, 1].map(|i| largest(&errors[i]));
            let order = (coarse / fine).log2() / 2.0;
            let name = &network.observables()[observable].name;
            assert!((1.8..2.6).contains(&order), "{name} {courant} {order}");
            assert!(fine < 1e-3, "{name} {courant} {fine:e}");
        }
    }
}

#[test]
fn jumps_are_of_first_order_in_the_mean() {
    let scenes: [(&str, Settings<'_>, &str); 4] = [
        ("mass-on-fixed-bar", &[("mu", "1")], "6"),
        ("pile", &[], "9"),
        ("mass-between-bars", &[("m", "5/4")], "9"),
        ("hopkinson", &[], "0.0008"),
    ];
    for (name, settings, last) in scenes {
        let network = built_in(name, settings);
        for observable in linear(&network) {
            let errors = errors(&network, observable, last, &[16, 256], 1.0);
            let [coarse, fine] = [0, 1].map(|i| mean(&errors[i]));
            // Sixteen times finer: at least ten times better.
            assert!(
                fine < coarse / 10.0 || fine < 1e-12,
                "{name} {observable}: {coarse:e} {fine:e}"
            );
        }
    }
}

/// Bars alone with steps of one cell: exact at all times farther than a step from a jump.
#[test]
fn characteristics_are_exact() {
    let text = "scene \"Bars\"
        bar a { impedance = 2, travel = 1, velocity = 1, strain = -1/8 }
        bar b { impedance = 3, travel = 3/2, velocity = -1/2 }
        bar c { impedance = 1, travel = 1/2, strain = 1/4 }
        bar d { impedance = 5/2, velocity = -1/2 }
        line fixed - a | b - c - d - endless
        observe v = velocity(a.at(1/4)) + velocity(b.right) + velocity(d.at(3/2))
        observe X = force(a.left) + 2*force(c.left) + force(d.at(1/2))
        observe F = force(a.right) + force(b.at(1/5))";
    let jumps = network(text, &[]);
    let scenes = [
        (jumps, 0.05),
        (built_in("stepped-striker", &[]), 0.5),
        (built_in("pushed-bar", &[]), 0.5),
    ];
    for (network, grid) in &scenes {
        for observable in linear(network) {
            let name = &network.observables()[observable].name;
            // Arrivals are multiples of the grid; between them momentum is linear in time.
            let times: Vec<_> = times("8", 60);
            let model = Leapfrog::new(network, 40, 1.0).unwrap();
            let near = 1.01 * model.step();
            let exact = exact(network, observable, &times);
            let differences = differences(&model, observable, &times, &exact);
            let mut far = 0;
            for (time, difference) in crate::models::doubles(&times).iter().zip(differences) {
                let phase = (time / grid).fract() * grid;
                if phase > near && phase < grid - near {
                    far += 1;
                    assert!(difference < 1e-12, "{name} {time} {difference:e}");
                }
            }
            assert!(far > 5, "{name}: {far} times decide something");
        }
    }
}

/// Ten cells in the shorter of two bars, twenty in the other.
#[test]
fn cells_take_the_same_time_in_all_bars() {
    let bars = "scene \"Bars\"
        bar a { impedance = 1, travel = 1, velocity = 1 }
        bar b { impedance = 3, travel = 2 }
        line free - a | b - free";
    let model = Leapfrog::new(&network(bars, &[]), 10, 1.0).unwrap();
    assert_eq!((model.cells(), model.step()), (30, 0.1));
}
