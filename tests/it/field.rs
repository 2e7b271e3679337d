//! Exact fields: against observables at the same places, against the balances of momentum and energy,
//! averages against nodes, the two sides of fronts, and what is refused.

use proptest::prelude::*;
use wavestep::expression::Fraction;
use wavestep::field::{Bounded, FieldError, FieldEvaluator, Fields, Mesh, Quantity};
use wavestep::language::{Source, parse_number, read_scene};
use wavestep::limits::MAX_FIELD_CELLS;
use wavestep::network::Network;
use wavestep::scene::{Dimension, Kind, Measure, Observable, Place, Position, Seen};
use wavestep::signal::{ClosedSignal, EvaluateError, Limit, digits};
use wavestep_polynomial::Symbol;

type Rational = wavestep_polynomial::Rational;

fn number(text: &str) -> Rational {
    parse_number(text).expect("a number")
}

fn network(text: &str, values: &[(&str, &str)]) -> Network {
    let values = values.iter().map(|(name, value)| ((*name).to_owned(), number(value))).collect();
    let source = Source::new("scene.wave", text).expect("a text");
    Network::new(&read_scene(&source, &values).expect("a scene")).expect("a network")
}

fn built_in(name: &str, values: &[(&str, &str)]) -> Network {
    network(wavestep::scenes::find(name).expect("a scene").text, values)
}

fn fields(network: &Network, time: &str, mesh: &Mesh) -> Fields {
    let time = number(time);
    FieldEvaluator::new(network, &time).unwrap().at(&time, mesh).unwrap()
}

/// The observable of a field at a share of a bar, evaluated in another way: by echoes.
fn observed(
    network: &Network,
    (bar, share): (usize, &Rational),
    quantity: Quantity,
    (time, side): (&Rational, Limit),
) -> f64 {
    let measure = match quantity {
        Quantity::Velocity => Measure::Velocity,
        Quantity::Strain => Measure::Strain,
        Quantity::Displacement => Measure::Displacement,
        Quantity::Force => Measure::Force,
    };
    let mut scene = network.scene().clone();
    let place = Place::At(bar, Position::Share(Fraction::constant(share)));
    let dimension = Dimension::NONE;
    let seen = Seen { coefficient: Fraction::one(), dimension, measure, place };
    scene.observables = vec![Observable { name: "q".into(), terms: vec![seen] }];
    let network = Network::new(&scene).unwrap();
    let signal = ClosedSignal::of_scene(&network, &network.observables()[0], [time, time]).unwrap();
    let value = digits(&signal.echo_by_echo(), time, side, 20, 1 << 14).unwrap();
    value.decimal(20).0.to_string().parse().unwrap()
}

/// The value lies within the bound of the field's, and the bound is that of a good double.
fn agrees(found: Bounded, expected: f64, scale: f64) {
    let off = (found.value - expected).abs();
    assert!(off <= found.bound + f64::EPSILON * expected.abs(), "{found:?} is not {expected}");
    assert!(found.bound <= 2.3e-16 * found.value.abs() + 1e-20 * scale, "{found:?}");
}

fn bar_of(network: &Network, name: &str) -> usize {
    network.scene().elements.iter().position(|element| element.name == name).unwrap()
}

/// A scene, values of its symbols, and a time.
type Case = (&'static str, &'static [(&'static str, &'static str)], &'static str);

const SCENES: [Case; 6] = [
    ("mass-on-fixed-bar", &[("mu", "1/2")], "37/10"),
    ("mass-between-bars", &[("m", "2")], "23/4"),
    ("stepped-striker", &[], "17/3"),
    ("struck-free-bar", &[("mu", "1")], "31/5"),
    ("incommensurate", &[], "3e-4"),
    ("hopkinson", &[], "2e-4"),
];

#[test]
fn nodes_agree_with_observables() {
    let mut compared = 0;
    for (name, values, time) in SCENES {
        let network = built_in(name, values);
        let found = fields(&network, time, &Mesh::new(7).unwrap());
        for bar in &found.bars {
            let element = bar_of(&network, &bar.name);
            let Kind::Bar(data) = &network.scene().elements[element].kind else { panic!() };
            if data.is_endless() {
                continue;
            }
            for quantity in Quantity::ALL {
                let scale = bar.of(quantity).iter().map(|v| v.value.abs()).fold(0.0, f64::max);
                for j in [0_usize, 2, 5, 7] {
                    let share = Rational::new(j.into(), 7.into());
                    let place = (element, &share);
                    let expected =
                        observed(&network, place, quantity, (&number(time), Limit::Right));
                    agrees(bar.of(quantity)[j], expected, scale.max(1e-12));
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn random_places_agree_with_observables(j in 0_usize..=1000, t in 1_u32..4000) {
        let network = built_in("mass-between-bars", &[("m", "3/2")]);
        let time = Rational::new(t.into(), 401.into());
        let evaluator = FieldEvaluator::new(&network, &time).unwrap();
        let found = evaluator.at(&time, &Mesh::new(1000).unwrap().only("east")).unwrap();
        let share = Rational::new(j.into(), 1000.into());
        let east = (bar_of(&network, "east"), &share);
        for quantity in Quantity::ALL {
            let expected = observed(&network, east, quantity, (&time, Limit::Right));
            agrees(found.bars[0].of(quantity)[j], expected, 1.0);
        }
    }
}

/// `∫ρA v dx` over cells is the momentum of the bar; with that of the mass it is the observable, and
/// stays what it was.
#[test]
fn momentum_is_that_of_the_cells() {
    let network = built_in("struck-free-bar", &[("mu", "3/2")]);
    for time in ["1/3", "13/4", "20"] {
        let means = fields(&network, time, &Mesh::new(50).unwrap().averages());
        let nodes = fields(&network, time, &Mesh::new(1).unwrap());
        let velocities = means.bars[0].of(Quantity::Velocity);
        let mean = velocities.iter().map(|velocity| velocity.value).sum::<f64>() / 50.0;
        // The hammer, of mass 1, moves with the left end of its bar, of mass 3/2.
        let momentum = nodes.bars[0].of(Quantity::Velocity)[0].value + 1.5 * mean;
        assert!((momentum - 1.0).abs() < 1e-14, "{momentum} at {time}");
    }
}

/// The elastic and kinetic energy of the fields, by Simpson's rule between fronts, with that of the
/// mass is what the mass brought.
#[test]
fn energy_is_kept() {
    let network = built_in("mass-on-fixed-bar", &[("mu", "1")]);
    for time in ["1/2", "7/4", "5/2", "27/4"] {
        let time = number(time);
        let evaluator = FieldEvaluator::new(&network, &time).unwrap();
        let profile = evaluator.profiles(&time, 400).unwrap().remove(0);
        let density = |fields: &[f64; 4]| (fields[0].powi(2) + fields[1].powi(2)) / 2.0;
        let mut energy = profile.stretches[0][0].1[0].powi(2) / 2.0;
        for stretch in &profile.stretches {
            let count = stretch.len() - 1;
            for i in 0..count {
                let (from, to) = (&stretch[i], &stretch[i + 1]);
                energy += (to.0 - from.0) * (density(&from.1) + density(&to.1)) / 2.0;
            }
        }
        assert!((energy - 0.5).abs() < 1e-5, "{energy} at {time}");
    }
}

/// A mean is that of the values within the cell, and means of cells make up those of larger ones.
#[test]
fn averages_are_means() {
    for (name, values, time) in SCENES {
        let network = built_in(name, values);
        let coarse = fields(&network, time, &Mesh::new(3).unwrap().averages());
        let fine = fields(&network, time, &Mesh::new(12).unwrap().averages());
        for (coarse, fine) in coarse.bars.iter().zip(&fine.bars) {
            for quantity in Quantity::ALL {
                let largest = fine.of(quantity).iter().map(|v| v.value.abs()).fold(0.0, f64::max);
                for (mean, parts) in coarse.of(quantity).iter().zip(fine.of(quantity).chunks(4)) {
                    let sum = parts.iter().map(|part| part.value).sum::<f64>() / 4.0;
                    assert!((sum - mean.value).abs() <= 1e-14 * largest, "{name}: {sum} {mean:?}");
                }
            }
        }
    }
    // Means of many nodes come near; fronts cost one cell each.
    let network = built_in("mass-on-fixed-bar", &[("mu", "1")]);
    let mean = fields(&network, "5/2", &Mesh::new(1).unwrap().averages());
    let nodes = fields(&network, "5/2", &Mesh::new(20_000).unwrap());
    for quantity in Quantity::ALL {
        let values = nodes.bars[0].of(quantity);
        let sum: f64 = values.windows(2).map(|pair| (pair[0].value + pair[1].value) / 2.0).sum();
        let mean = mean.bars[0].of(quantity)[0].value;
        assert!((sum / 20_000.0 - mean).abs() < 2e-4, "{quantity:?}");
    }
}

/// At a front, the two sides differ by its jump; elsewhere they are equal. At the ends the limit is
/// that from within.
#[test]
fn fronts_have_two_sides() {
    let network = built_in("mass-on-fixed-bar", &[("mu", "1")]);
    // The front has come to 1/2 for the first time.
    let right = fields(&network, "1/2", &Mesh::new(4).unwrap());
    let left = fields(&network, "1/2", &Mesh::new(4).unwrap().with_limit(Limit::Left));
    let of = |fields: &Fields, j: usize| fields.bars[0].of(Quantity::Velocity)[j].value;
    assert_eq!((of(&left, 2), of(&right, 2)), (1.0, 0.0));
    for j in [0, 1, 3, 4] {
        assert_eq!(of(&left, j), of(&right, j));
    }
    // When the front is at the end, what is seen there is what is behind it, or not yet there.
    for (time, at_far_end) in [("0", 0.0), ("1", 1.0), ("2", 0.0)] {
        let found = fields(&network, time, &Mesh::new(4).unwrap());
        assert_eq!(of(&found, 4), at_far_end, "at {time}");
    }
    // Just before it leaves the mass, no front is in the bar.
    assert_eq!(of(&fields(&network, "0", &Mesh::new(4).unwrap()), 0), 0.0);
}

#[test]
fn the_start_is_given() {
    let network = network(
        "scene \"Pulled and let go\"\nbar rod { impedance = 2, travel = 3, strain = 1/5, velocity = 4 }\n\
         line free - rod - fixed",
        &[],
    );
    let found = fields(&network, "0", &Mesh::new(5).unwrap());
    for quantity in Quantity::ALL {
        let expected = [4.0, 0.2, 0.0, -0.4][quantity as usize];
        for value in found.bars[0].of(quantity) {
            assert_eq!(value.value, expected, "{quantity:?}");
        }
    }
    // Averages over the whole bar: u(L) − u(0) adds to the strain at the start.
    let means = fields(&network, "2", &Mesh::new(1).unwrap().averages());
    let nodes = fields(&network, "2", &Mesh::new(1).unwrap());
    let u = nodes.bars[0].of(Quantity::Displacement);
    let strain = means.bars[0].of(Quantity::Strain)[0].value;
    assert!((0.2 + (u[1].value - u[0].value) / 3.0 - strain).abs() < 1e-14);
}

#[test]
fn endless_bars_are_followed() {
    let network = built_in("striker-on-long-bar", &[("r", "1")]);
    let reached = fields(&network, "3", &Mesh::new(6).unwrap().only("long"));
    assert_eq!(reached.bars[0].x, [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]);
    // Equal bars: a pulse of one half, as long as two travel times of the striker.
    let velocity: Vec<f64> =
        reached.bars[0].of(Quantity::Velocity).iter().map(|v| v.value).collect();
    assert_eq!(velocity[..6], [0.0, 0.0, 0.5, 0.5, 0.5, 0.5]);
    let farther = Mesh::new(5).unwrap().only("long").reaching(&number("5")).unwrap();
    let farther = fields(&network, "3", &farther);
    assert_eq!(farther.bars[0].x[5], 5.0);
    assert_eq!(farther.bars[0].of(Quantity::Force)[4].value, 0.0);
    // Nothing has entered at the start.
    assert!(fields(&network, "0", &Mesh::new(4).unwrap()).bars[1].x.is_empty());
}

#[test]
fn late_times_keep_their_digits() {
    // After 60 periods the expanded form needs many more bits than doubles have.
    let network = built_in("mass-on-fixed-bar", &[("mu", "1")]);
    let time = number("1201/10");
    let found = fields(&network, "1201/10", &Mesh::new(3).unwrap());
    let element = bar_of(&network, "rod");
    for (j, value) in found.bars[0].of(Quantity::Strain).iter().enumerate() {
        let share = Rational::new(j.into(), 3.into());
        let expected =
            observed(&network, (element, &share), Quantity::Strain, (&time, Limit::Right));
        agrees(*value, expected, 1.0);
    }
}

#[test]
fn what_cannot_be_given_is_refused() {
    for cells in [0, MAX_FIELD_CELLS + 1] {
        assert_eq!(Mesh::new(cells), Err(FieldError::Cells { cells, limit: MAX_FIELD_CELLS }));
    }
    assert!(matches!(
        Mesh::new(1).unwrap().reaching(&number("0")),
        Err(FieldError::NegativeReach(_))
    ));
    let symbolic = built_in("mass-on-fixed-bar", &[]);
    let refused = FieldEvaluator::new(&symbolic, &number("1")).err().unwrap();
    assert_eq!(refused, EvaluateError::MissingValue(Symbol::new("mu").unwrap()).into());
    let known = built_in("mass-on-fixed-bar", &[("mu", "1")]);
    let refused = FieldEvaluator::new(&known, &number("-1")).err().unwrap();
    assert!(refused.to_string().contains("before the start"));
    let evaluator = FieldEvaluator::new(&known, &number("1")).unwrap();
    let other = evaluator.at(&number("1"), &Mesh::new(1).unwrap().only("red")).unwrap_err();
    assert!(other.to_string().contains("no bar `red`: its bars are rod"));
    let later = evaluator.at(&number("2"), &Mesh::new(1).unwrap()).unwrap_err();
    assert_eq!(later, EvaluateError::AfterLast.into());
}

/// Late waves are small differences of large terms; pictures take as much precision as that needs.
#[test]
fn late_pictures_show_what_the_fields_are() {
    let network = built_in("mass-on-fixed-bar", &[("mu", "1")]);
    let time = parse_number("296").unwrap();
    let evaluator = FieldEvaluator::new(&network, &time).unwrap();
    let fields = evaluator.at(&time, &Mesh::new(2).unwrap()).unwrap();
    let nodes: Vec<f64> =
        fields.bars[0].of(Quantity::Velocity).iter().map(|bounded| bounded.value).collect();
    assert!(nodes[0] < -1.0, "{nodes:?}");
    let profiles = evaluator.profiles(&time, 40).unwrap();
    let place = Quantity::ALL.iter().position(|quantity| *quantity == Quantity::Velocity).unwrap();
    let first = profiles[0].stretches[0][0].1[place];
    assert!((first - nodes[0]).abs() < 1e-12, "{first} {nodes:?}");
    // A diagram has the waves from which these velocities come.
    let from = parse_number("292").unwrap();
    let waves = evaluator.waves([&from, &time], 48).unwrap();
    let largest = waves[0].right.iter().map(|strip| strip.value.abs()).fold(0.0, f64::max);
    assert!(largest > 0.5 && waves[0].right.len() > 24, "{largest} {}", waves[0].right.len());
}
