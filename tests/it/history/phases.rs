//! What is found and drawn across the phases of contacts agrees with values, events and closed forms.

use crate::history::{SHIPPED, ball, is_zero, network_of, rational, shipped, signal};
use wavestep::history::{EventKind, History, HistoryError};
use wavestep::network::Network;
use wavestep::planner::Purpose;
use wavestep::signal::{EvaluateError, Goal, Limit, Place, Root, Search, Value};
use wavestep_polynomial::Rational;

const BITS: u64 = 1 << 10;

fn double(value: &Value) -> f64 {
    ball(value).rounded().unwrap_or_else(|| value.to_text(17).parse().unwrap())
}

/// A rational number near a time.
fn near(time: &Value) -> Rational {
    Rational::from_float(double(time)).unwrap()
}

/// Somewhat longer than until the first contact opens.
fn window(network: &Network) -> Rational {
    let history = History::of(network, None, 12).unwrap();
    let opening = history.events.iter().find(|event| event.kind != EventKind::Impact);
    opening.map_or(rational(3, 1), |event| near(&event.time) * rational(5, 3))
}

/// The mass of Saint-Venant's problem is slowest in the bar when it leaves the second time, and keeps that
/// velocity; its own force vanishes from the instants at which it leaves until it strikes again.
#[test]
fn roots_and_extrema_are_those_of_the_events() {
    let network = shipped("saint-venant", &[("mu", "1")]);
    let history = History::of(&network, None, 15).unwrap();
    let window = [rational(0, 1), rational(9, 1)];
    let seen = |name| signal(&network, name, window.each_ref(), Purpose::Stretches).unwrap();
    let (force, velocity) = (seen("strain_impact"), seen("velocity"));
    let [force, velocity] = [&force, &velocity].map(|signal| Search::new(&**signal).unwrap());
    let roots = force.roots(&rational(0, 1), 15, BITS).unwrap();
    let [first, second] = &roots.all[..] else { panic!("{roots:?}") };
    let [_, left, struck, again] = &history.events[..] else { panic!("four events") };
    let told = |root: &Root| match root {
        Root::Interval { from, to, .. } => [from.to_text(15), to.to_text(15)],
        other => panic!("{other:?}"),
    };
    assert_eq!(told(first), [left.time.to_text(15), struck.time.to_text(15)]);
    assert_eq!(told(second), [again.time.to_text(15), "9".to_owned()]);
    let least = velocity.extremum(Goal::Smallest, 15, BITS).unwrap();
    let [_, after] = &again.velocities;
    assert_eq!(least.value.to_text(15), after[0].to_text(15));
    // The velocity is zero once.
    let stop = velocity.roots(&rational(0, 1), 15, BITS).unwrap();
    let [Root::Simple { time, rises: false }] = &stop.all[..] else { panic!("{stop:?}") };
    let at = near(time);
    let there = crate::history::values(&network, "velocity", &[at], Limit::Right, 12);
    assert!(double(&there[0]).abs() < 1e-12);
}

/// The largest value is taken where it is said to be, and no value is larger.
#[test]
fn no_value_is_larger_than_the_largest() {
    for (name, values) in SHIPPED.iter().filter(|(name, _)| *name != "mass-that-bounces") {
        let network = shipped(name, values);
        let to = window(&network);
        let from = Rational::default();
        let seen = network.observables().iter().map(|observed| observed.name.clone());
        let observable = seen.into_iter().find(|name| !matches!(&name[..], "energy" | "momentum"));
        let observable = observable.expect("an observable that can be searched");
        let signal = signal(&network, &observable, [&from, &to], Purpose::Stretches).unwrap();
        let search = Search::new(&*signal).unwrap();
        let largest = search.extremum(Goal::Largest, 9, BITS).unwrap();
        let times: Vec<Rational> = (0..=40).map(|i| &to * rational(i, 40)).collect();
        let values = crate::history::values(&network, &observable, &times, Limit::Right, 9);
        let top = ball(&largest.value);
        for value in &values {
            let less = top.subtract(&ball(value), 200);
            let sign = if less.contains(&rational(0, 1)) { 0.0 } else { less.rounded().unwrap() };
            assert!(sign >= 0.0, "{name} {observable}: {value:?} above {:?}", largest.value);
        }
        let place = largest.places.first().expect("a place");
        let (time, side) = match place {
            Place::End(time) | Place::Critical(time) => (time, Limit::Right),
            Place::Arrival { time, before: true, .. } => (time, Limit::Left),
            Place::Arrival { time, .. } | Place::Plateau { from: time, .. } => (time, Limit::Right),
            Place::Undecided { .. } => panic!("{name} {observable}: {place:?}"),
        };
        // Instants that are no rational numbers are missed by a little; on a smooth run that is nothing.
        let exact = matches!(time, wavestep::signal::Value::Exact(_));
        if exact || matches!(place, Place::Critical(_)) {
            let at = near(time);
            let there = crate::history::values(&network, &observable, &[at], side, 9);
            let (there, top) = (double(&there[0]), double(&largest.value));
            assert!((there - top).abs() <= 1e-8 * top.abs(), "{name} {observable}: {there} {top}");
        }
    }
}

#[test]
fn empty_windows_are_refused() {
    let network = shipped("saint-venant", &[("mu", "1")]);
    let (one, early) = (rational(1, 1), rational(-1, 1));
    let velocity = |window| signal(&network, "velocity", window, Purpose::Stretches);
    let instant = velocity([&one, &one]).unwrap();
    assert_eq!(Search::new(&*instant).err(), Some(EvaluateError::EmptyWindow));
    let refused = HistoryError::from(EvaluateError::EmptyWindow);
    assert_eq!(velocity([&early, &one]).err(), Some(refused.into()));
}

/// A distance may be no rational share of a travel time: then that has a name, and its digits are the same
/// as those of the share of the length.
#[test]
fn distances_are_shares_of_travel_times() {
    let network = network_of(
        "scene \"Steel strikes aluminium\"\n\
         bar a { modulus = 210 GPa, density = 7850 kg/m^3, area = 1 cm^2, length = 1 m, velocity = 1 m/s }\n\
         bar b { modulus = 70 GPa, density = 2700 kg/m^3, area = 1 cm^2, length = 2 m }\n\
         line free - a | b - free\ncontacts open\n\
         observe share = velocity(b.at(1/4))\nobserve distance = velocity(b.at(500 mm))\n\
         observe end = force(b.left)\nobserve start = force(b.at(0 mm))\n",
        &[],
    );
    let times: Vec<Rational> = (1..40).map(|n| rational(n, 30_000)).collect();
    let told = |name| {
        let values = crate::history::values(&network, name, &times, Limit::Right, 20);
        values.iter().map(|value| value.to_text(20)).collect::<Vec<_>>()
    };
    assert_eq!(told("share"), told("distance"));
    assert_eq!(told("end"), told("start"));
    assert!(told("share").iter().any(|value| value != "0"));
}

/// An event at the very end of a window is told, one after it is not; a search that ends there as well.
#[test]
fn events_at_the_end_of_a_window_are_told() {
    let parting = shipped("bars-that-part", &[("r", "1/3")]);
    let kinds = |network: &Network, until: &Rational| {
        let history = History::of(network, Some(until), 12).unwrap();
        history.events.iter().map(|event| event.kind).collect::<Vec<_>>()
    };
    let before = rational(2, 1) - Rational::new(1.into(), num_bigint::BigInt::from(10).pow(30));
    assert_eq!(kinds(&parting, &before), [EventKind::Impact]);
    assert_eq!(kinds(&parting, &rational(2, 1)), [EventKind::Impact, EventKind::Opening]);
    // 3 + e^{−2}/2 = 3.0676676416183063459…
    let struck = shipped("saint-venant", &[("mu", "1")]);
    let digits = |last: i64| rational(30_676_676_416_183_000 + last, 10_000_000_000_000_000);
    assert_eq!(kinds(&struck, &digits(63)), [EventKind::Impact]);
    assert_eq!(kinds(&struck, &digits(64)), [EventKind::Impact, EventKind::Opening]);
    // A force that comes to zero exactly at the end.
    let pressed = crate::history::refusals::pressed("3/2 - t");
    let network = network_of(&format!("{pressed}\nobserve wall = force(rod.right)"), &[]);
    let window = [rational(3, 2), rational(5, 2)];
    let signal = signal(&network, "wall", window.each_ref(), Purpose::Stretches).unwrap();
    let search = Search::new(&*signal).unwrap();
    let roots = search.roots(&rational(0, 1), 9, BITS).unwrap();
    let [Root::Arrival { time, .. } | Root::End { time }] = &roots.all[..] else {
        panic!("{roots:?}")
    };
    assert_eq!(time.to_text(9), "2.5 = 5/2");
}

/// What a wall takes up is missing in the momentum: `P(0) − P(t) = ∫ F dt` over the fixed end, by Gauss's
/// rule between the instants at which anything changes.
#[test]
fn the_wall_takes_up_the_missing_momentum() {
    const NODES: [(f64, f64); 5] = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ];
    let network = shipped("saint-venant", &[("mu", "1")]);
    let history = History::of(&network, None, 15).unwrap();
    let until = 7.25;
    let mut cuts = vec![0.0, until];
    for start in history.events.iter().map(|event| double(&event.time)) {
        cuts.extend((0..8).map(|n| start + f64::from(n)).filter(|time| *time < until));
    }
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    let mut points = Vec::new();
    for pair in cuts.windows(2) {
        for half in [0.0, 0.5] {
            let (length, from) = (pair[1] - pair[0], pair[0]);
            let middle = from + length * (half + 0.25);
            points.extend(NODES.map(|(x, w)| (middle + x * length / 4.0, w * length / 4.0)));
        }
    }
    let times: Vec<Rational> =
        points.iter().map(|(time, _)| Rational::from_float(*time).unwrap()).collect();
    let strains = crate::history::values(&network, "strain_fixed", &times, Limit::Right, 12);
    // Impedance and wave speed are one: the force is the strain with its sign changed.
    let impulse: f64 =
        points.iter().zip(&strains).map(|((_, weight), strain)| -weight * double(strain)).sum();
    let ends = [Rational::default(), Rational::from_float(until).unwrap()];
    let held = crate::history::values(&network, "momentum", &ends, Limit::Right, 12);
    let lost = double(&held[0]) - double(&held[1]);
    assert!((impulse - lost).abs() < 1e-9, "{impulse} {lost}");
}

/// Enclosures of roots hold what a finer history tells.
#[test]
fn finer_digits_begin_with_the_coarser() {
    let network = shipped("saint-venant", &[("mu", "2")]);
    let window = [rational(0, 1), rational(6, 1)];
    let signal = signal(&network, "velocity", window.each_ref(), Purpose::Stretches).unwrap();
    let search = Search::new(&*signal).unwrap();
    let time = |digits| match &search.roots(&rational(0, 1), digits, BITS).unwrap().all[..] {
        [Root::Simple { time, .. }, ..] => ball(time),
        other => panic!("{other:?}"),
    };
    let (coarse, fine) = (time(12), time(60));
    let difference = coarse.subtract(&fine, 400);
    assert!(difference.contains(&rational(0, 1)) && !is_zero(&coarse));
    // The finer one is known to 40 digits, the coarser one is not.
    assert!(is_zero(&fine.subtract(&fine, 400)) && !is_zero(&coarse.subtract(&coarse, 400)));
}

/// Doubles by the method of steps: those of the proven source for a while, and ten thousand periods later where a scene
/// whose contact has opened is periodic.
#[test]
fn the_method_of_steps_follows_contacts_that_open() {
    use wavestep::answer::Accuracy;
    use wavestep::{Method, Problem};
    let bounces = "scene \"A\"\nload weight { force = 1/20 }\nmass hammer { mass = 1, velocity = 1 }\n\
        bar rod { impedance = 1, travel = 1 }\nline free - weight - hammer | rod - fixed\ncontacts open\n\
        observe velocity = velocity(hammer)\nobserve force = force(rod.right)";
    let cushion = "scene \"A\"\nbar a { impedance = 2, travel = 1, velocity = 1 }\nspring k { stiffness = 3 }\n\
        bar b { impedance = 1, travel = 3/2 }\nline free - a - k | b - fixed\ncontacts open\n\
        observe velocity = velocity(a.right)\nobserve force = force(k)\nobserve gap = compression(k)";
    let stepped = |problem: &Problem, name: &str, time: &str| {
        let accuracy = Accuracy::Method(Method::Steps { tolerance: 1e-12 }, None);
        let times = [problem.time("time", time).unwrap()];
        problem.doubles(name, &times, Limit::Right, accuracy).unwrap().values[0]
    };
    let read = |text: &str| Problem::read("test.wave", text).unwrap();
    let shipped = |name: &str| Problem::builtin(name).unwrap();
    let scenes = [
        (read(bounces), ["velocity", "force"], ["3", "13/3", "20", "50"]),
        (read(cushion), ["velocity", "force"], ["1", "7/3", "5", "17"]),
        (read(cushion), ["gap", "gap"], ["1", "7/3", "5", "17"]),
        (shipped("hopkinson-with-release"), ["force", "force"], ["100us", "500us", "1ms", "3ms"]),
        (
            shipped("saint-venant").with("mu", "1").unwrap(),
            ["velocity", "strain_fixed"],
            ["1", "7/2", "5", "40"],
        ),
    ];
    for (problem, names, times) in scenes {
        for name in names {
            let proven =
                times.map(|time| problem.signal(name).unwrap().at(time, 15).unwrap().to_f64());
            let largest = proven.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            for (time, proven) in times.iter().zip(proven) {
                let found = stepped(&problem, name, time);
                assert!(
                    (found - proven).abs() <= 1e-10 * largest,
                    "{name} at {time}: {found} and {proven}"
                );
            }
        }
    }
    // Once the mass has left, the bar between its free and its fixed end has the period 4.
    let problem = shipped("saint-venant").with("mu", "1").unwrap();
    for name in ["velocity", "strain_fixed"] {
        let proven = problem.signal(name).unwrap().at("100", 15).unwrap().to_f64();
        let found = stepped(&problem, name, "20000");
        assert!((found - proven).abs() <= 1e-10, "{name}: {found} and {proven}");
    }
}
