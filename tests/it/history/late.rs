//! Late values, for which what has passed is forgotten, against those of windows that begin at the start.

use super::{network_of, rational};
use wavestep::history::History;
use wavestep::network::{Network, Observed};
use wavestep::planner::{Origin, Purpose, Together};
use wavestep::scenes::SCENES;
use wavestep::signal::{Limit, digits};
use wavestep_polynomial::Rational;

/// A load that has acted, and a bar on which a mass hangs by a local contact.
const OTHERS: [(&str, &str); 2] = [
    (
        "load",
        "scene \"Load\"\nload push { force = 1, until = 3/2 }\nbar rod { impedance = 1, travel = 1 }\n\
         mass end { mass = 2 }\nline free - push - rod - end - free\nobserve v = velocity(end)\n\
         observe u = displacement(rod.at(1/3))\nobserve held = energy(rod)\nobserve p = momentum(line)\n",
    ),
    (
        "far",
        "scene \"Far\"\nload push { force = 1, until = 3/2 }\nbar rod { impedance = 1, travel = 1 }\n\
         spring soft { stiffness = 1 }\nbar far { impedance = 2 }\n\
         line free - push - rod - soft - far - endless\nobserve seen = force(far.at(5))\n\
         observe u = displacement(far.at(4))\nobserve p = momentum(far)\nobserve e = energy(far)\n",
    ),
];

fn networks() -> impl Iterator<Item = (&'static str, Network)> {
    let shipped = SCENES.iter().map(|scene| (scene.name, scene.text)).chain(OTHERS);
    shipped.filter_map(|(name, text)| {
        let values = [("mu", "4/3"), ("r", "4/3"), ("m", "4/3")];
        let named = |name: &str| text.contains(&format!("symbol {name} "));
        let values: Vec<_> = values.into_iter().filter(|(name, _)| named(name)).collect();
        // The second one takes half a minute.
        let is_followed = text.contains("\nline ") && name != "hertz-striker";
        is_followed.then(|| (name, network_of(text, &values)))
    })
}

/// How many cells are worked out where an observable is followed on a window, and how many of them are kept.
fn cells(network: &Network, observed: &Observed, window: [&Rational; 2]) -> [usize; 2] {
    let observed = [observed];
    let together = Together::new(network, &observed, window, Purpose::Stretches);
    together.cells(observed[0]).unwrap()
}

/// Just before and just after the end of a window.
fn told(network: &Network, observable: usize, window: [&Rational; 2]) -> [String; 2] {
    let observed = &network.observables()[observable];
    let count = if network.local_contact().is_some() { 6 } else { 20 };
    let purpose = Purpose::Values { digits: count };
    let signal =
        Together::new(network, &[observed], window, purpose).of_origin(Origin::Followed, observed);
    let signal = signal.unwrap_or_else(|error| panic!("{}: {error}", observed.name));
    [Limit::Left, Limit::Right].map(|limit| {
        let value = digits(&*signal, window[1], limit, count, 1 << 12);
        value.unwrap_or_else(|error| panic!("{}: {error}", observed.name)).to_text(count)
    })
}

/// Values, energies, displacements and momenta of all scenes that can be followed, within cells and, without units, where
/// they meet, from either side.
#[test]
fn what_is_forgotten_changes_no_digit() {
    let (mut compared, mut forgetful) = (0, 0);
    for (name, network) in networks() {
        let unit = rational(1, if network.scene().dimensional { 5000 } else { 1 });
        let times = match network.local_contact() {
            Some(_) => vec![rational(23, 10)],
            None => vec![rational(17, 2), rational(10, 1)],
        };
        for (observable, observed) in network.observables().iter().enumerate() {
            for time in &times {
                let (start, at) = (Rational::default(), time * &unit);
                let windows = [[&start, &at], [&at, &at]];
                let [kept, late] = windows.map(|window| told(&network, observable, window));
                assert_eq!(kept, late, "{name} {} at {at}", observed.name);
                compared += 1;
                if network.local_contact().is_some() {
                    continue;
                }
                let [first, second] = windows.map(|window| cells(&network, observed, window));
                assert_eq!(first[0], second[0], "{name}");
                forgetful += usize::from(2 * second[1] < first[1]);
            }
        }
    }
    assert!(compared > 150 && forgetful > 100, "{compared} {forgetful}");
}

/// What is kept does not grow with time, but for what needs all since the start.
#[test]
fn few_cells_are_kept_for_late_values() {
    let (_, network) = networks().find(|(name, _)| *name == "hopkinson").unwrap();
    let kept = |name: &str, milliseconds: i64| {
        let observed = network.observables().iter().find(|own| own.name == name).unwrap();
        let at = rational(milliseconds, 1000);
        cells(&network, observed, [&at, &at])
    };
    for (name, count) in [("force", 23), ("gauge_output", 23), ("momentum", 34)] {
        assert_eq!([kept(name, 5), kept(name, 20)], [[231, count], [1005, count]], "{name}");
    }
    // What has gone into the endless bar is summed up since the start.
    assert_eq!(kept("energy", 20), [1005, 2001]);
}

/// In a striker that has parted waves return at other times than in the bar. Cells of one are not cut at those of the
/// other again and again.
#[test]
fn cells_grow_in_proportion_to_the_window() {
    let text = "scene \"Bars that part\"\nbar a { impedance = 1, travel = 3/10, velocity = 1 }\n\
                bar b { impedance = 1, travel = sqrt(2) }\nspring left { stiffness = 5 }\n\
                mass light { mass = 1/100 }\nspring right { stiffness = 5 }\n\
                bar c { impedance = 1, travel = sqrt(2) }\n\
                line free - a | b - left - light - right - c - free\ncontacts open\n\
                observe held = energy(line)\nobserve carried = momentum(line)\n";
    let network = network_of(text, &[]);
    let cells =
        [10, 20].map(|until| History::of(&network, Some(&rational(until, 1)), 9).unwrap().cells);
    assert!(cells[1] < 3 * cells[0] && cells[1] < 1500, "{cells:?}");
    // Waves go on unchanged through cells that are joined: energy and momentum are what they were at the start.
    for (observable, known) in [0.15, 0.3].into_iter().enumerate() {
        for at in [rational(97, 10), rational(197, 10)] {
            for value in told(&network, observable, [&at, &at]) {
                let value: f64 = value.parse().unwrap();
                assert!((value - known).abs() < 1e-15, "{observable} at {at}: {value}");
            }
        }
    }
}

/// Once two bars never meet again the one of which nothing is asked is followed no longer: the other moves as with both, and
/// where its own waves alone return, cells are few.
#[test]
fn what_has_parted_is_followed_no_longer() {
    let text = "scene \"Bars that part\"\nbar a { impedance = 1, travel = 1/50, velocity = 1 }\n\
                bar b { impedance = 1, travel = sqrt(2) }\nmass m { mass = 1/5 }\n\
                line free - a | b - m - free\ncontacts open\n\
                observe end = velocity(m)\nobserve far = displacement(b.left)\nobserve held = energy(b)\n\
                observe mass = energy(m)\nobserve other = energy(a)\n\
                observe short = velocity(a.left)\nobserve all = velocity(a.left) + velocity(m)\n";
    let network = network_of(text, &[]);
    let observed = |name: &str| {
        let place = network.observables().iter().position(|own| own.name == name);
        place.expect("an observable")
    };
    let (start, at) = (Rational::default(), rational(40, 1));
    let count = |name: &str, until: &Rational| {
        cells(&network, &network.observables()[observed(name)], [&start, until])[0]
    };
    let whole = count("all", &at);
    for name in ["end", "far", "held"] {
        assert!(10 * count(name, &at) < whole, "{name}: {} of {whole}", count(name, &at));
    }
    assert!(count("short", &at) < whole);
    let value = |name: &str| {
        let [before, after] = told(&network, observed(name), [&start, &at]);
        assert_eq!(before, after);
        before.parse::<f64>().unwrap()
    };
    assert!((value("all") - value("short") - value("end")).abs() < 1e-15);
    // Both together hold what the short one had: Z T v²/2.
    assert!((value("held") + value("mass") + value("other") - 0.01).abs() < 1e-15);
    assert!(value("held") > 1e-3 && value("other") > 1e-3);
}
