//! The method of steps reaches its tolerance.

use crate::models::{Settings, built_in, differences, exact, largest, network, times};
use wavestep::model::{Model, Steps};
use wavestep::network::{Network, ObservedValue};

/// Every observable within a few tolerances of its largest value.
fn assert_reached(network: &Network, last: &str, tolerances: &[f64]) {
    let times = times(last, 23);
    let observables = network.observables().iter().enumerate();
    let linear =
        observables.filter(|(_, observed)| matches!(observed.value, ObservedValue::Linear(_)));
    for (observable, _) in linear {
        let exact = exact(network, observable, &times);
        for tolerance in tolerances {
            let model = Steps::new(network, *tolerance).unwrap_or_else(|error| panic!("{error}"));
            let error = largest(&differences(&model, observable, &times, &exact));
            let name = &network.observables()[observable].name;
            let bound = 10.0 * tolerance * largest(&exact) + 1e-14;
            assert!(error <= bound, "{}: {name} {tolerance:e}: {error:e}", network.scene().title);
        }
    }
}

#[test]
fn shipped_scenes_are_solved_to_the_tolerance() {
    let scenes: [(&str, Settings<'_>, &str); 9] = [
        ("mass-on-fixed-bar", &[("mu", "1")], "15"),
        ("struck-free-bar", &[("mu", "2/3")], "9"),
        ("mass-between-bars", &[("m", "5/4")], "12"),
        ("pile", &[], "15"),
        ("pushed-bar", &[], "9"),
        ("stepped-striker", &[], "15"),
        ("striker-on-long-bar", &[("r", "7/3")], "9"),
        ("cushioned-impact", &[("mu", "3/2")], "9"),
        ("hopkinson", &[], "0.001"),
    ];
    for (name, settings, last) in scenes {
        assert_reached(&built_in(name, settings), last, &[1e-5, 1e-10]);
    }
}

#[test]
fn second_order_nodes_and_loads_are_solved() {
    assert_reached(&built_in("percussive-drill", &[]), "0.0006", &[1e-9]);
    let pushed = "scene \"Loads\"
        load blow { force = (1 + 2*t)*exp(-t) + cos(3*t), from = 1/2, until = 2 }
        bar a { impedance = 2, travel = 1, strain = -1/4 }
        support s { stiffness = 1/3, damping = 1/5 }
        bar b { impedance = 1, travel = 3/2 }
        load shake { velocity = exp(-t), until = 3 }
        line free - blow - a - s - b - shake - free
        observe v = velocity(a.left) - velocity(b.at(1/3))/2
        observe u = displacement(a.right) + 2*displacement(a.at(1/4))
        observe F = force(s) + force(b.right)
        observe P = momentum(line)";
    assert_reached(&network(pushed, &[]), "8", &[1e-10]);
    let endless = "scene \"Endless and moving\"
        bar a { impedance = 2, velocity = 1 }
        mass m { mass = 1/2 }
        spring k { stiffness = 3, damping = 1/4 }
        bar b { impedance = 1, travel = 1 }
        bar c { impedance = 3 }
        line endless - a | m - k - b - c - endless
        observe v = velocity(m) + velocity(a.at(2))
        observe F = force(k) - force(c.at(1/2))
        observe u = displacement(a.at(1)) + compression(k)
        observe p = momentum(b) + momentum(m)";
    assert_reached(&network(endless, &[]), "6", &[1e-10]);
}

/// At a jump it is the value behind it; before the start there is nothing.
#[test]
fn jumps_are_exact() {
    let network = built_in("mass-on-fixed-bar", &[("mu", "1")]);
    let model = Steps::new(&network, 1e-11).unwrap();
    let strain = model.values(2, &[-0.5, 0.0, 0.999_999_999, 1.0, 3.0]).unwrap();
    let behind = -2.0 * (1.0 + f64::exp(-2.0));
    for (value, known) in strain.iter().zip([0.0, 0.0, 0.0, -2.0, behind]) {
        assert!((value - known).abs() < 1e-10, "{value} {known}");
    }
}
