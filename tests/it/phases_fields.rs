//! Fields of scenes whose contacts open and close: against observables of their history at the same
//! places, averages against momentum, energy and displacements, against closed contacts as long as they
//! are closed; and fronts of what an opening or a closing sends out.

use wavestep::expression::Fraction;
use wavestep::field::{Bounded, FieldError, FieldEvaluator, Mesh, Profile, Quantity};
use wavestep::history::{EventKind, History, HistoryError};
use wavestep::language::{Source, parse_number, read_scene};
use wavestep::network::Network;
use wavestep::planner::{Purpose, SignalError, of_scene};
use wavestep::scene::{Dimension, Kind, Measure, Observable, Place, Position, Scene, Seen};
use wavestep::signal::{Limit, Value, value};

type Rational = wavestep_polynomial::Rational;

fn number(text: &str) -> Rational {
    parse_number(text).expect("a number")
}

fn built_in(name: &str, values: &[(&str, &str)]) -> Network {
    let values = values.iter().map(|(name, value)| ((*name).to_owned(), number(value))).collect();
    let text = wavestep::scenes::find(name).expect("a scene").text;
    let source = Source::new(name, text).expect("a text");
    Network::new(&read_scene(&source, &values).expect("a scene")).expect("a network")
}

/// The double nearest to a value, or one beside it.
fn double(value: &Value) -> f64 {
    value.to_text(20).split(" = ").next().unwrap().parse().unwrap()
}

fn double_of(value: &Rational) -> f64 {
    double(&Value::Exact(value.clone()))
}

/// A scene with values of its symbols, and until when it is looked at.
type Case = (&'static str, &'static [(&'static str, &'static str)], &'static str);

/// All shipped scenes with contacts that open.
const SCENES: [Case; 9] = [
    ("bars-that-part", &[("r", "1/2")], "5"),
    ("bars-of-equal-length", &[], "5"),
    ("bars-of-unequal-length", &[], "8"),
    ("cushion-with-release", &[("mu", "2")], "9"),
    ("saint-venant", &[("mu", "1")], "6"),
    ("mass-on-free-bar", &[("m", "2")], "8"),
    ("mass-that-bounces", &[], "30"),
    ("hopkinson-with-release", &[], "4e-4"),
    ("saint-venant", &[("mu", "1/4")], "9"),
];

/// The instants at which something happens.
fn instants(network: &Network, until: &Rational) -> Vec<f64> {
    let history = History::of(network, Some(until), 20).unwrap();
    let later = history.events.iter().filter(|event| event.kind != EventKind::Impact);
    later.map(|event| double(&event.time)).collect()
}

/// Two times in each phase, as fractions of two to three figures.
fn times(network: &Network, until: &str) -> Vec<Rational> {
    let until = number(until);
    let last = double_of(&until);
    let mut ends = vec![0.0];
    ends.extend(instants(network, &until));
    ends.push(last);
    let mut times = Vec::new();
    for phase in ends.windows(2) {
        for share in [0.31, 0.83] {
            let time = phase[0] + (phase[1] - phase[0]) * share;
            let thousandths = (time / last * 1000.0).round() as i64;
            let time = &until * Rational::new(thousandths.into(), 1000.into());
            let told = double_of(&time);
            if phase[0] < told && told < phase[1] {
                times.push(time);
            }
        }
    }
    assert!(times.len() >= ends.len() - 1, "{times:?} {ends:?}");
    times
}

/// The values of a weighted sum in the history, at times. One run of the history serves for many places.
fn observed(
    network: &Network,
    measure: Measure,
    places: Vec<(Rational, Place)>,
    times: &[Rational],
) -> Vec<f64> {
    let mut scene = network.scene().clone();
    let seen = |(weight, place): (Rational, Place)| Seen {
        dimension: Dimension::NONE,
        coefficient: Fraction::constant(&weight),
        measure,
        place,
    };
    let terms = places.into_iter().map(seen).collect();
    scene.observables = vec![Observable { name: "q".into(), terms }];
    let network = Network::new(&scene).unwrap();
    let window = [times.iter().min().unwrap(), times.iter().max().unwrap()];
    let observed = &network.observables()[0];
    let signal = of_scene(&network, observed, window, Purpose::Values { digits: 20 }).unwrap();
    let told = |time| value(&*signal, time, Limit::Right, 18, 1 << 12).unwrap();
    times.iter().map(|time| double(&told(time))).collect()
}

/// Weights by which a mistake at one place is not undone by another.
fn weight(place: usize) -> Rational {
    Rational::new((place * place + 2).into(), 2.into())
}

/// Bounded values with these weights add up to what is expected; each bound is that of a good double.
fn agree(found: &[Bounded], expected: f64, scale: f64, what: &str) {
    let (mut sum, mut bound) = (0.0, 0.0);
    for (place, found) in found.iter().enumerate() {
        let weight = double_of(&weight(place));
        sum += weight * found.value;
        bound += weight * (found.bound + 4.0 * f64::EPSILON * found.value.abs());
        assert!(found.bound <= 2.3e-16 * found.value.abs() + 1e-20 * scale, "{what}: {found:?}");
    }
    assert!((sum - expected).abs() <= bound, "{what}: {sum} is not {expected}");
}

const MEASURES: [(Quantity, Measure); 4] = [
    (Quantity::Velocity, Measure::Velocity),
    (Quantity::Strain, Measure::Strain),
    (Quantity::Displacement, Measure::Displacement),
    (Quantity::Force, Measure::Force),
];

fn bar_of(network: &Network, name: &str) -> usize {
    network.scene().elements.iter().position(|element| element.name == name).unwrap()
}

fn is_endless(network: &Network, bar: usize) -> bool {
    match &network.scene().elements[bar].kind {
        Kind::Bar(bar) => bar.is_endless(),
        _ => panic!("a bar"),
    }
}

#[test]
fn nodes_agree_with_the_history() {
    let mut compared = 0;
    for (name, values, until) in SCENES {
        let network = built_in(name, values);
        let times = times(&network, until);
        let evaluator = FieldEvaluator::new(&network, &number(until)).unwrap();
        let mesh = Mesh::new(5).unwrap();
        let fields: Vec<_> = times.iter().map(|time| evaluator.at(time, &mesh).unwrap()).collect();
        let bars = evaluator.bars().map(|bar| bar_of(&network, bar)).enumerate();
        let bars: Vec<(usize, usize)> =
            bars.filter(|(_, element)| !is_endless(&network, *element)).collect();
        let nodes: Vec<(usize, usize, usize)> = bars
            .iter()
            .flat_map(|(place, element)| [0, 2, 5].map(|j| (*place, *element, j)))
            .collect();
        for (quantity, measure) in MEASURES {
            let section = |(k, (_, element, j)): (usize, &(usize, usize, usize))| {
                let share = Fraction::constant(&Rational::new((*j).into(), 5.into()));
                (weight(k), Place::At(*element, Position::Share(share)))
            };
            let places = nodes.iter().enumerate().map(section).collect();
            let expected = observed(&network, measure, places, &times);
            for (i, expected) in expected.into_iter().enumerate() {
                let found =
                    nodes.iter().map(|(place, _, j)| fields[i].bars[*place].of(quantity)[*j]);
                let found: Vec<Bounded> = found.collect();
                let scale = found.iter().map(|found| found.value.abs()).fold(1e-12, f64::max);
                agree(&found, expected, scale, &format!("{name} {quantity:?} at {}", times[i]));
                compared += found.len();
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

/// In an endless bar the wave that entered at its end is seen later by the distance.
#[test]
fn endless_bars_agree_with_the_history() {
    let network = built_in("bars-that-part", &[("r", "1/2")]);
    let times = times(&network, "5");
    let evaluator = FieldEvaluator::new(&network, &number("5")).unwrap();
    let element = bar_of(&network, "long");
    let mesh = Mesh::new(5).unwrap().only("long").reaching(&number("3")).unwrap();
    for (quantity, measure) in MEASURES {
        let nodes = [0_usize, 1, 4];
        let section = |(k, j): (usize, &usize)| {
            let distance = Fraction::constant(&Rational::new((3 * j).into(), 5.into()));
            (weight(k), Place::At(element, Position::Distance(distance)))
        };
        let places = nodes.iter().enumerate().map(section).collect();
        let expected = observed(&network, measure, places, &times);
        for (time, expected) in times.iter().zip(expected) {
            let found = evaluator.at(time, &mesh).unwrap();
            let found = nodes.map(|j| found.bars[0].of(quantity)[j]);
            agree(&found, expected, 1.0, &format!("{quantity:?} at {time}"));
        }
    }
}

/// The mean strain of a cell is the difference of displacements over its length, the mean velocity of a
/// bar its momentum over its mass, and the energy that of its fields.
#[test]
fn averages_are_those_of_the_balances() {
    for (name, values, until) in SCENES {
        let network = built_in(name, values);
        let times = times(&network, until);
        let evaluator = FieldEvaluator::new(&network, &number(until)).unwrap();
        let mesh = Mesh::new(4).unwrap();
        let waves = evaluator.waves([&Rational::default(), &number(until)], 1).unwrap();
        for (place, bar) in waves.iter().enumerate().filter(|(_, bar)| !bar.is_endless) {
            let element = bar_of(&network, &bar.name);
            let mass = bar.impedance * bar.length * bar.slowness;
            let part = || vec![(number("1"), Place::Element(element))];
            let momentum = observed(&network, Measure::Momentum, part(), &times);
            let energy = observed(&network, Measure::Energy, part(), &times);
            for (i, time) in times.iter().enumerate() {
                let what = format!("{name} {} at {time}", bar.name);
                let nodes = evaluator.at(time, &mesh).unwrap();
                let means = evaluator.at(time, &mesh.clone().averages()).unwrap();
                let (nodes, means) = (&nodes.bars[place], &means.bars[place]);
                let displacements = nodes.of(Quantity::Displacement).windows(2);
                let largest = nodes.of(Quantity::Displacement).iter().map(|u| u.value.abs());
                let largest = 4.0 * largest.fold(0.0, f64::max) / bar.length;
                for (pair, mean) in displacements.zip(means.of(Quantity::Strain)) {
                    let slope = 4.0 * (pair[1].value - pair[0].value) / bar.length;
                    assert!((slope - mean.value).abs() <= 4e-16 * largest, "{what}: {slope}");
                }
                let mean = means.of(Quantity::Velocity).iter().map(|v| v.value / 4.0).sum::<f64>();
                let off = (mass * mean - momentum[i]).abs();
                assert!(off <= 1e-14 * mass * (1.0 + mean.abs()), "{what}: {off}");
                // A profile takes long: one in each phase does.
                if i % 2 == 1 {
                    continue;
                }
                let profile = &evaluator.profiles(time, 60).unwrap()[place];
                let held = energy_of(profile, mass / bar.length, bar.stiffness);
                let off = (held - energy[i]).abs();
                assert!(off <= 1e-3 * energy[i].max(1e-3), "{what}: {held} {}", energy[i]);
            }
        }
    }
}

/// The energy of fields by the trapezoidal rule between fronts.
fn energy_of(profile: &Profile, density: f64, stiffness: f64) -> f64 {
    let own =
        |fields: &[f64; 4]| (density * fields[0].powi(2) + stiffness * fields[1].powi(2)) / 2.0;
    let pairs = profile.stretches.iter().flat_map(|stretch| stretch.windows(2));
    pairs.map(|pair| (pair[1].0 - pair[0].0) * (own(&pair[0].1) + own(&pair[1].1)) / 2.0).sum()
}

/// As long as all contacts are closed the fields are those of closed contacts, within the bounds; and
/// not afterwards.
#[test]
fn closed_contacts_have_the_same_fields() {
    for (name, values, until) in SCENES {
        let network = built_in(name, values);
        let last = number(until);
        let scene = Scene { contacts_open: false, ..network.scene().clone() };
        let shut = Network::new(&scene).unwrap();
        let (open, closed) = (
            FieldEvaluator::new(&network, &last).unwrap(),
            FieldEvaluator::new(&shut, &last).unwrap(),
        );
        let first = instants(&network, &last)[0];
        let differs = |time: &Rational, mesh: &Mesh| {
            let (open, closed) = (open.at(time, mesh).unwrap(), closed.at(time, mesh).unwrap());
            let mut differs = false;
            for (open, closed) in open.bars.iter().zip(&closed.bars) {
                assert_eq!((&open.name, &open.x), (&closed.name, &closed.x));
                for quantity in Quantity::ALL {
                    for (one, other) in open.of(quantity).iter().zip(closed.of(quantity)) {
                        let off = (one.value - other.value).abs();
                        differs |= off > one.bound + other.bound;
                    }
                }
            }
            differs
        };
        let nodes = Mesh::new(6).unwrap();
        for mesh in [nodes.clone(), nodes.clone().averages(), nodes.with_limit(Limit::Left)] {
            for i in 0..=12 {
                let time = &last * Rational::new(i.into(), 12.into());
                let told = double_of(&time);
                if told < first {
                    assert!(!differs(&time, &mesh), "{name} at {time}");
                }
            }
            assert!(differs(&last, &mesh), "{name} goes on as if nothing had opened");
        }
        // Pictures look at no other stretches.
        let time = &last * Rational::new(1.into(), 15.into());
        let (open, closed) = (open.profiles(&time, 9).unwrap(), closed.profiles(&time, 9).unwrap());
        for (open, closed) in open.iter().zip(&closed) {
            let starts = |profile: &Profile| -> Vec<f64> {
                profile.stretches.iter().map(|stretch| stretch[0].0).collect()
            };
            let known = starts(closed);
            let is_known = |x: &f64| known.iter().any(|known| (known - x).abs() < 1e-12);
            assert!(starts(open).iter().all(is_known), "{name} {:?} {known:?}", starts(open));
        }
    }
}

/// Two equal bars exchange all: the striker is at rest and free of force ever after.
#[test]
fn the_striker_of_equal_bars_comes_to_rest() {
    let network = built_in("bars-of-equal-length", &[]);
    let evaluator = FieldEvaluator::new(&network, &number("20")).unwrap();
    let (nodes, means) = (Mesh::new(8).unwrap(), Mesh::new(8).unwrap().averages());
    for time in ["2", "17/8", "3", "77/9", "20"] {
        let time = number(time);
        for mesh in [&nodes, &means] {
            let fields = evaluator.at(&time, mesh).unwrap();
            let first = fields.bars.iter().find(|bar| bar.name == "first").unwrap();
            for quantity in [Quantity::Velocity, Quantity::Strain, Quantity::Force] {
                let is_zero = |found: &Bounded| found.value == 0.0 && found.bound < 1e-30;
                assert!(first.of(quantity).iter().all(is_zero), "{time}");
            }
            // It has gone as far as its end was pushed on by V/2 for two travel times.
            assert!(first.of(Quantity::Displacement).iter().all(|u| u.value == 1.0));
        }
    }
}

/// The mass leaves at 3 + e^(−2)/2: from then on the slope of the wave in the bar is another, and the
/// left end moves freely.
#[test]
fn a_release_is_a_front() {
    let network = built_in("saint-venant", &[("mu", "1")]);
    let evaluator = FieldEvaluator::new(&network, &number("6")).unwrap();
    let release = 3.0 + (-2.0_f64).exp() / 2.0;
    let waves = evaluator.waves([&number("0"), &number("6")], 60).unwrap();
    let fronts = &waves[0].right_fronts;
    let found = fronts.iter().find(|front| (front.at - release).abs() < 1e-12).unwrap();
    assert!(!found.jumps, "{found:?}");
    // The front of the impact returns at 2 and 4, the second time to a free end, which it throws at the
    // mass once more.
    let jumps: Vec<f64> = fronts.iter().filter(|front| front.jumps).map(|front| front.at).collect();
    assert_eq!(jumps[..3], [0.0, 2.0, 4.0]);
    assert_eq!(jumps.len(), 4, "{jumps:?}");
    // The free end has no strain, before it is struck again and after it is left again.
    for (time, is_free) in [("3", false), ("19/5", true), ("43/10", false), ("9/2", true)] {
        let end = evaluator.at(&number(time), &Mesh::new(3).unwrap()).unwrap();
        assert_eq!(end.bars[0].of(Quantity::Strain)[0].value == 0.0, is_free, "at {time}");
    }
    // On a profile the front is where the wave has come, and the velocity is continuous there.
    let profile = evaluator.profiles(&number("7/2"), 40).unwrap().remove(0);
    let place = 3.5 - release;
    let at = profile.stretches.iter().position(|stretch| (stretch[0].0 - place).abs() < 1e-12);
    let at = at.expect("a stretch begins at the front");
    let before = profile.stretches[at - 1].last().unwrap();
    assert!((before.1[0] - profile.stretches[at][0].1[0]).abs() < 1e-12);
    let slope = |pair: &[(f64, [f64; 4])]| (pair[1].1[0] - pair[0].1[0]) / (pair[1].0 - pair[0].0);
    let behind = profile.stretches[at - 1].windows(2).last().map(slope).unwrap();
    let ahead = slope(&profile.stretches[at][..2]);
    assert!((behind - ahead).abs() > 0.05, "{behind} {ahead}");
}

/// A mass that falls back strikes at an instant that is only enclosed. The jump travels with the wave:
/// both its sides are drawn where it is, as large as the momentum of the impact makes them.
#[test]
fn an_impact_at_an_enclosed_instant_is_a_front() {
    let network = built_in("mass-that-bounces", &[]);
    let history = History::of(&network, Some(&number("40")), 20).unwrap();
    let closing = history.events.iter().find(|event| event.kind == EventKind::Closing).unwrap();
    let struck = double(&closing.time);
    assert!(matches!(closing.time, Value::Certified { .. }));
    let time = Rational::new(((struck * 1000.0) as i64 + 400).into(), 1000.into());
    let told = double_of(&time);
    let evaluator = FieldEvaluator::new(&network, &time).unwrap();
    let profile = evaluator.profiles(&time, 50).unwrap().remove(0);
    let place = told - struck;
    let at = profile.stretches.iter().position(|stretch| (stretch[0].0 - place).abs() < 1e-12);
    let at = at.expect("a stretch begins at the front");
    let (behind, ahead) = (profile.stretches[at - 1].last().unwrap().1, profile.stretches[at][0].1);
    // The end of the rod took over the velocity of the mass.
    let [before, after] = &closing.velocities;
    let jump = double(&after[1]) - double(&before[1]);
    assert!(jump > 0.1 && (behind[0] - ahead[0] - jump).abs() < 1e-12, "{behind:?} {ahead:?}");
    let from = &time - number("1/2");
    let waves = evaluator.waves([&from, &time], 20).unwrap();
    let front = waves[0].right_fronts.iter().find(|front| (front.at - struck).abs() < 1e-9);
    assert!(front.is_some_and(|front| front.jumps), "{:?}", waves[0].right_fronts);
}

#[test]
fn what_cannot_be_given_is_refused() {
    let network = built_in("saint-venant", &[("mu", "1")]);
    let early = FieldEvaluator::new(&network, &number("-1")).err().unwrap();
    assert!(matches!(early, FieldError::Negative(_)));
    assert!(early.to_string().contains("before the start"));
    let symbolic = built_in("saint-venant", &[]);
    let symbolic = FieldEvaluator::new(&symbolic, &number("1")).err().unwrap();
    let missing = |error: &_| matches!(error, SignalError::Followed(HistoryError::MissingValue(_)));
    assert!(matches!(&symbolic, FieldError::Signal(error) if missing(error)));
    let evaluator = FieldEvaluator::new(&network, &number("1")).unwrap();
    let mesh = Mesh::new(2).unwrap();
    assert!(
        evaluator.at(&number("2"), &mesh).is_err() && evaluator.at(&number("1"), &mesh).is_ok()
    );
    assert!(evaluator.waves([&number("0"), &number("9")], 4).is_err());
}
