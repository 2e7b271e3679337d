//! Energies and momenta between events: what a body holds is what contacts and loads have done to it.

use crate::history::{Values, ball, is_zero, network_of, rational, values};
use wavestep::ball::Ball;
use wavestep::network::Network;
use wavestep::signal::{Limit, Value};
use wavestep_polynomial::Rational;

/// A mass strikes a fixed bar and leaves it; each body is seen by itself.
const STRUCK: &str = "scene \"Struck\"\nsymbol mu > 0\nmass hammer { mass = 1/mu, velocity = 1 }\n\
    bar rod { impedance = 1, travel = 1 }\nline free - hammer | rod - fixed\ncontacts open\n\
    observe v = velocity(hammer)\nobserve end = velocity(rod.left)\nobserve force = force(rod.left)\n\
    observe kinetic = energy(hammer)\nobserve held = energy(rod)\n";

/// Two bars with a mass on the one that is struck: nothing holds them.
const FREE: &str = "scene \"Free\"\nbar striker { impedance = 1, travel = 3/7, velocity = 1 }\n\
    bar rod { impedance = 2, travel = 1 }\nmass weight { mass = 3/4 }\n\
    line free - striker | rod - weight - free\ncontacts open\n\
    observe energy = energy(line)\nobserve momentum = momentum(line)\n";

fn told(network: &Network, name: &str, times: &[Rational]) -> Vec<Ball> {
    values(network, name, times, Limit::Right, 12).iter().map(ball).collect()
}

/// Times that meet no arrival, in cells and across events.
fn times(count: i64) -> Vec<Rational> {
    (1..=count).map(|n| rational(97 * n, 307)).collect()
}

/// All that the hammer loses has been done as work at its contact, and the bar holds it.
#[test]
fn a_bar_holds_what_the_hammer_loses() {
    for mu in ["1", "2", "1/3"] {
        let values: Values<'_> = &[("mu", mu)];
        let network = network_of(STRUCK, values);
        let mass = ["1", "2", "1/3"].iter().position(|own| *own == mu).unwrap();
        let mass = [rational(1, 1), rational(1, 2), rational(3, 1)][mass].clone();
        let half = &mass * rational(1, 2);
        let times = times(25);
        let [v, hammer, rod] = ["v", "kinetic", "held"].map(|name| told(&network, name, &times));
        for ((v, hammer), rod) in v.iter().zip(&hammer).zip(&rod) {
            let kinetic = v.multiply(v, 300).multiply_rational(&half, 300);
            assert!(is_zero(&kinetic.subtract(hammer, 300)), "{mu}: {kinetic} {hammer}");
            let lost = Ball::from_rational(&half, 300).subtract(hammer, 300);
            assert!(is_zero(&lost.subtract(rod, 300)), "{mu}: {lost} {rod}");
        }
    }
}

/// The work of the contact, `∫ F v dt` at the end of the bar by Simpson's rule, is what the bar gains. No
/// wave arrives within these windows; in the last one the hammer has left.
#[test]
fn the_work_of_a_contact_is_the_energy_of_the_bar() {
    const STEPS: i64 = 40;
    let network = network_of(STRUCK, &[("mu", "1")]);
    let double = |ball: &Ball| ball.rounded().unwrap_or(0.0);
    for (from, to) in [((0, 1), (19, 10)), ((21, 10), (3, 1)), ((16, 5), (39, 10))] {
        let (from, to) = (rational(from.0, from.1), rational(to.0, to.1));
        let step = (&to - &from) / rational(STEPS, 1);
        let times: Vec<Rational> = (0..=STEPS).map(|i| &from + &step * rational(i, 1)).collect();
        let [force, end] = ["force", "end"].map(|name| told(&network, name, &times));
        let weight = |i: usize| match i {
            0 => 1.0,
            i if i as i64 == STEPS => 1.0,
            i if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let powers = force.iter().zip(&end).map(|(force, end)| double(&force.multiply(end, 300)));
        let sum: f64 = powers.enumerate().map(|(i, power)| weight(i) * power).sum();
        let work = sum * double(&Ball::from_rational(&step, 300)) / 3.0;
        let held = told(&network, "held", &[from, to]);
        let gained = double(&held[1].subtract(&held[0], 300));
        assert!((work - gained).abs() < 1e-6, "{work} {gained}");
        assert!(times[0] > rational(3, 1) || gained.abs() > 0.1, "{gained}");
    }
}

/// Energy and momentum of bodies that nothing holds are what they were.
#[test]
fn free_bodies_keep_energy_and_momentum() {
    let network = network_of(FREE, &[]);
    for (name, start) in [("energy", rational(3, 14)), ("momentum", rational(3, 7))] {
        for held in told(&network, name, &times(25)) {
            assert!(is_zero(&held.subtract(&Ball::from_rational(&start, 300), 300)), "{held}");
        }
    }
}

/// Bars alone hold rational energies at rational times, and these are told exactly.
#[test]
fn rational_energies_stay_exact() {
    let text = "scene \"Bars\"\nbar striker { impedance = 1, travel = 2/3, velocity = 1 }\n\
        bar rod { impedance = 3, travel = 1 }\nline free - striker | rod - fixed\ncontacts open\n\
        observe held = energy(rod)\nobserve energy = energy(line)\nobserve momentum = momentum(rod)\n";
    let network = network_of(text, &[]);
    let times = times(25);
    let exact = |name| {
        let values = values(&network, name, &times, Limit::Right, 12);
        let exact = values.into_iter().map(|value| match value {
            Value::Exact(value) => value,
            other => panic!("{name}: {other:?}"),
        });
        exact.collect::<Vec<Rational>>()
    };
    assert!(exact("energy").iter().all(|energy| *energy == rational(1, 3)));
    // Until 1 both waves are on their way: v = Z1/(Z1 + Z3) = 1/4 behind the front, 3 v² of energy a time.
    assert_eq!(exact("held")[..3], [1, 2, 3].map(|n| rational(3 * 97 * n, 16 * 307)));
    assert_eq!(exact("momentum")[..3], [1, 2, 3].map(|n| rational(3 * 97 * n, 4 * 307)));
}
