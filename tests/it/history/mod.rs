//! Contacts that open and close: instants known in closed form, the laws of mechanics through every
//! event, and a numerical method that shares nothing with what is tested.

mod characteristics;
mod closed_form;
mod crossing;
mod energies;
mod late;
mod load;
mod locks;
mod order;
mod page;
mod passive;
mod passivity;
mod phases;
mod positive;
mod pressing;
mod refusals;
mod series;
mod springs;
mod squares;
mod stiff;
mod track;
mod validity;

use crate::support::mirror::mirrored;
use std::collections::BTreeMap;
use wavestep::ball::Ball;
use wavestep::history::{Ending, Event, EventKind, History};
use wavestep::language::{Source, parse_number, read_scene};
use wavestep::network::Network;
use wavestep::planner::{Purpose, SignalError, of_scene};
use wavestep::signal::{Limit, Signal, Value, value};
use wavestep_polynomial::Rational;
use wavestep_trials::events::by_force;

type Values<'a> = &'a [(&'a str, &'a str)];

/// The shipped scenes whose contacts open, with values for their symbols.
const SHIPPED: [(&str, Values<'static>); 10] = [
    ("bars-that-part", &[("r", "1/2")]),
    ("bars-that-part", &[("r", "1")]),
    ("bars-that-part", &[("r", "2")]),
    ("bars-of-equal-length", &[]),
    ("bars-of-unequal-length", &[]),
    ("saint-venant", &[("mu", "1")]),
    ("mass-on-free-bar", &[("m", "2")]),
    ("cushion-with-release", &[("mu", "3")]),
    ("hopkinson-with-release", &[]),
    ("mass-that-bounces", &[]),
];

fn network_of(text: &str, values: Values<'_>) -> Network {
    let number = |(name, value): &(&str, &str)| ((*name).to_owned(), parse_number(value).unwrap());
    let values: BTreeMap<_, _> = values.iter().map(number).collect();
    let scene = read_scene(&Source::new("test.wave", text).unwrap(), &values);
    Network::new(&scene.unwrap_or_else(|errors| panic!("{}", errors[0]))).unwrap()
}

fn shipped(name: &str, values: Values<'_>) -> Network {
    network_of(wavestep::scenes::find(name).expect("a built-in scene").text, values)
}

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// An observable as it is followed through all phases.
fn signal<'a>(
    network: &'a Network,
    name: &str,
    window: [&Rational; 2],
    purpose: Purpose,
) -> Result<Box<dyn Signal + 'a>, SignalError> {
    let observed = network.observables().iter().find(|own| own.name == name).unwrap();
    of_scene(network, observed, window, purpose)
}

/// The digits of an observable at times.
fn values(
    network: &Network,
    name: &str,
    times: &[Rational],
    limit: Limit,
    digits: usize,
) -> Vec<Value> {
    let window = [times.iter().min().unwrap(), times.iter().max().unwrap()];
    let signal = signal(network, name, window, Purpose::Values { digits }).unwrap();
    times.iter().map(|time| value(&*signal, time, limit, digits, 1 << 14).unwrap()).collect()
}

fn ball(value: &Value) -> Ball {
    value.ball(300)
}

fn kinds(events: &[Event]) -> Vec<EventKind> {
    events.iter().map(|event| event.kind).collect()
}

/// Whether a ball is within `10^-40` of zero and contains it.
fn is_zero(ball: &Ball) -> bool {
    let tiny = Rational::new(1.into(), num_bigint::BigInt::from(10).pow(40));
    let widest = Ball::symmetric(&tiny);
    let (own, limit) = (ball.to_decimal(60), widest.to_decimal(60));
    ball.contains(&Rational::default())
        && own.radius().to_rational() <= limit.radius().to_rational() * rational(2, 1)
}

/// 3 + e^(−2)/2, to more digits than were asked for.
#[test]
fn the_mass_leaves_the_bar_at_a_known_instant() {
    let history = History::of(&shipped("saint-venant", &[("mu", "1")]), None, 20).unwrap();
    assert_eq!(
        kinds(&history.events),
        [EventKind::Impact, EventKind::Opening, EventKind::Closing, EventKind::Opening]
    );
    let power = Ball::from_rational(&rational(-2, 1), 300).exp(300).unwrap();
    let half = power.multiply_rational(&rational(1, 2), 300);
    let exact = half.add(&Ball::from_rational(&rational(3, 1), 300), 300);
    assert!(is_zero(&ball(&history.events[1].time).subtract(&exact, 300)));
    assert_eq!(history.ending, Ending::Parted);
}

/// 6.6: they part at 2L/c where Z1 <= Z2; equal bars of equal length exchange their velocities.
#[test]
fn bars_part_when_the_first_wave_returns() {
    for (r, kind, restitution) in
        [("1/3", EventKind::Opening, "0.5 = 1/2"), ("1", EventKind::Release, "0")]
    {
        let history = History::of(&shipped("bars-that-part", &[("r", r)]), None, 12).unwrap();
        assert_eq!(kinds(&history.events), [EventKind::Impact, kind]);
        assert_eq!(history.events[1].time.to_text(9), "2");
        let [contact] = &history.contacts[..] else { panic!("one contact") };
        assert_eq!(contact.restitution.as_ref().unwrap().to_text(9), restitution);
        assert_eq!(history.ending, Ending::Parted);
    }
    let history = History::of(&shipped("bars-of-equal-length", &[]), None, 12).unwrap();
    let [_, opening] = &history.events[..] else { panic!("two events") };
    let [left, right] = &opening.bodies[..] else { panic!("two bodies") };
    for (value, told) in [
        (&opening.time, "2"),
        (left.energy.as_ref().unwrap(), "0"),
        (right.velocity.as_ref().unwrap(), "1"),
        (right.vibration.as_ref().unwrap(), "0"),
        (history.contacts[0].restitution.as_ref().unwrap(), "1"),
    ] {
        assert_eq!(value.to_text(9), told);
    }
}

/// 6.41: for Z1 > Z2 the force is `V Z1 Z2/(Z1 + Z2) ρ^n` for ever; followed for a hundred travel times.
#[test]
fn a_heavier_striker_stays_in_contact() {
    let network = shipped("bars-that-part", &[("r", "3")]);
    let history = History::of(&network, None, 12).unwrap();
    assert_eq!(kinds(&history.events), [EventKind::Impact]);
    let end = Value::Exact(rational(100, 1));
    assert_eq!(history.ending, Ending::Followed(end));
    let times: Vec<Rational> = (0..9).map(|n| rational(2 * n + 1, 1)).collect();
    let forces = values(&network, "force", &times, Limit::Right, 12);
    for (n, force) in forces.iter().enumerate() {
        let exact = rational(3, 4) / rational(2_i64.pow(n as u32), 1);
        assert_eq!(*force, Value::Exact(exact));
    }
    assert_eq!(history.contacts[0].durations, [None]);
}

/// The energy of all bodies is what it was, after every event; what the load does is counted.
#[test]
fn energy_and_momentum_are_kept_through_every_event() {
    for (name, values) in SHIPPED {
        let network = shipped(name, values);
        let until = rational(25, 1);
        let until = (name == "mass-that-bounces").then_some(&until);
        let history = History::of(&network, until, 12).unwrap_or_else(|e| panic!("{name}: {e}"));
        let unit = if network.scene().dimensional { 10 } else { 0 };
        let loaded = name == "mass-that-bounces";
        let free = !loaded && name != "saint-venant";
        let sum = |event: &Event, momentum: bool| {
            event.bodies.iter().fold(Ball::symmetric(&rational(0, 1)), |sum, body| {
                let value = if momentum { &body.momentum } else { &body.energy };
                sum.add(&ball(value.as_ref().unwrap()), 300)
            })
        };
        for event in &history.events[1..] {
            let first = &history.events[0];
            let close = |change: Ball| {
                let scale = rational(1, 10_i64.pow(unit));
                is_zero(&change.multiply_rational(&scale, 300))
            };
            if !loaded {
                let change = sum(event, false).subtract(&sum(first, false), 300);
                assert!(close(change.clone()), "{name}: {change}");
            }
            if free {
                let change = sum(event, true).subtract(&sum(first, true), 300);
                assert!(close(change.clone()), "{name}: {change}");
            }
        }
    }
}

/// With a wall the momentum of the striker alone is kept: it changes by the impulses of its contact, and by
/// what the load gives, at every opening.
#[test]
fn impulses_are_the_momentum_that_a_striker_loses() {
    for (name, values, load) in [
        ("saint-venant", &[("mu", "1")][..], 0),
        ("saint-venant", &[("mu", "1/4")], 0),
        ("mass-that-bounces", &[], 1),
    ] {
        let network = shipped(name, values);
        let until = rational(25, 1);
        let until = (load > 0).then_some(&until);
        let history = History::of(&network, until, 12).unwrap();
        let striker = |event: &Event| {
            let body = event.bodies.iter().find(|body| body.elements.last().unwrap() == "hammer");
            body.map(|body| ball(body.momentum.as_ref().unwrap()))
        };
        let mut held = ball(history.events[0].bodies[0].momentum.as_ref().unwrap());
        let mut impulses = history.contacts[0].impulses.iter();
        let mut openings = 0;
        for event in history.events.iter().filter(|event| event.kind == EventKind::Opening) {
            held = held.subtract(&ball(impulses.next().unwrap()), 300);
            let given = ball(&event.time).multiply_rational(&rational(load, 20), 300);
            let off = striker(event).unwrap().subtract(&held.add(&given, 300), 300);
            assert!(is_zero(&off), "{name}: {off}");
            openings += 1;
        }
        assert!(openings > 0, "{name}");
    }
}

/// The same at times between events, and with the work of the constant force.
#[test]
fn the_force_does_the_work_that_the_bodies_hold() {
    let network = shipped("mass-that-bounces", &[]);
    let times: Vec<Rational> = (0..7).map(|n| rational(7 * n, 2)).collect();
    let told = |name| values(&network, name, &times, Limit::Right, 12);
    let (energy, displacement) = (told("energy"), told("displacement"));
    for (energy, displacement) in energy.iter().zip(&displacement) {
        let work = ball(displacement).multiply_rational(&rational(1, 20), 300);
        let change = ball(energy).subtract(&work, 300);
        let start = Ball::from_rational(&rational(1, 2), 300);
        assert!(is_zero(&change.subtract(&start, 300)), "{change}");
    }
}

/// A mass that falls back strikes again, and again.
#[test]
fn a_mass_under_a_force_bounces() {
    let network = shipped("mass-that-bounces", &[]);
    let until = rational(60, 1);
    let history = History::of(&network, Some(&until), 9).unwrap();
    let closings = history.events.iter().filter(|event| event.kind == EventKind::Closing);
    assert!(closings.count() >= 2, "{:?}", kinds(&history.events));
    // Before each closing the bodies approach each other.
    for event in history.events.iter().filter(|event| event.kind == EventKind::Closing) {
        let [before, _] = &event.velocities;
        let approach = ball(&before[0]).subtract(&ball(&before[1]), 300).rounded().unwrap();
        assert!(approach > 0.0);
    }
}

/// Across phases, jumps have two limits, and displacements of both sides differ by the gap.
#[test]
fn observables_go_on_across_phases() {
    let network = shipped("bars-of-equal-length", &[]);
    let times = [rational(2, 1), rational(3, 1)];
    let right = values(&network, "right", &times, Limit::Right, 9);
    let left = values(&network, "right", &times, Limit::Left, 9);
    let text = |values: &[Value]| values.iter().map(|v| v.to_text(9)).collect::<Vec<_>>();
    assert_eq!(
        (text(&left), text(&right)),
        (vec!["0.5 = 1/2".to_owned(), "1".to_owned()], vec!["1".to_owned(), "1".to_owned()],)
    );
}

/// The closed form of the first opening lies in its enclosure; none is told where the mass leaves in a later
/// period, since the force there is no line times an exponential, and none for later openings.
#[test]
fn the_first_opening_is_told_in_closed_form() {
    for (mu, told) in
        [("1", Some("3 + 1/2*exp(-2)")), ("2", Some("5/2 + 1/4*exp(-4)")), ("1/2", None)]
    {
        let history = History::of(&shipped("saint-venant", &[("mu", mu)]), None, 15).unwrap();
        let exact = history.events[1].exact.as_ref().map(wavestep::export::expression_text);
        assert_eq!(exact.as_deref(), told, "{mu}");
        if let Some(exact) = &history.events[1].exact {
            let value = wavestep::enclosure::enclose_expression(exact, &|_, _| None, 300).unwrap();
            let off = value.real().subtract(&ball(&history.events[1].time), 300);
            assert!(is_zero(&off), "{mu}: {off}");
        }
        assert!(history.events[2..].iter().all(|event| event.exact.is_none()));
    }
}

/// Seen from behind, contacts open and close at the same instants, with the same forces, and what moved to
/// the right moves to the left.
#[test]
fn mirrored_scenes_have_mirrored_histories() {
    let walls = [
        "scene \"A wall\"\nbar rod { impedance = 2, travel = 3, velocity = 1 }\nline free - rod | fixed",
        "scene \"A spring on a wall\"\nbar rod { impedance = 2, travel = 3, velocity = 1 }\n\
         mass m { mass = 5, velocity = 1 }\nspring k { stiffness = 1 }\n\
         line free - rod - m - k | fixed",
    ];
    let walls = walls.map(|text| network_of(text, &[]));
    for network in SHIPPED.iter().map(|(name, values)| shipped(name, values)).chain(walls) {
        let behind = Network::new(&mirrored(network.scene())).unwrap();
        let until = if network.scene().dimensional { rational(1, 1000) } else { rational(8, 1) };
        let [own, turned] =
            [&network, &behind].map(|network| History::of(network, Some(&until), 12).unwrap());
        let text = |value: &Value| value.to_text(12);
        let title = &network.scene().title;
        assert_eq!(own.events.len(), turned.events.len(), "{title}");
        for (own, turned) in own.events.iter().zip(&turned.events) {
            let [left, right] = &turned.between;
            assert_eq!((own.kind, &own.between), (turned.kind, &[right.clone(), left.clone()]));
            assert_eq!(text(&own.time), text(&turned.time), "{title}");
            assert_eq!(
                own.forces.each_ref().map(text),
                turned.forces.each_ref().map(text),
                "{title}"
            );
            for (own, turned) in own.velocities.iter().zip(&turned.velocities) {
                for (own, turned) in own.iter().zip(turned.iter().rev()) {
                    assert_eq!(own.to_f64(), -turned.to_f64(), "{title}");
                }
            }
        }
    }
}

/// Nothing presses and nothing parts where all move alike, and no precision is needed to say so: 2/3 stays exact.
#[test]
fn bodies_that_move_alike_do_not_press() {
    let text = "scene \"Alike\"\nbar a { impedance = 3, travel = 2, velocity = 2/3 }\n\
        mass m { mass = 2, velocity = 2/3 }\nbar b { impedance = 2/3, travel = 1/2, velocity = 2/3 }\n\
        line free - a | m - b - free\ncontacts open\nobserve v = velocity(m)";
    let history = History::of(&network_of(text, &[]), Some(&rational(10, 1)), 12).unwrap();
    assert!(history.events.is_empty() && history.assumptions.is_empty(), "{:?}", history.events);
}

/// The spring leaves the rod once nothing presses it; four units later the end of that wave reaches the tip, and no force is left
/// there. No precision tells this zero from a small force: it is assumed, and told from then on.
#[test]
fn a_force_that_is_zero_by_assumption_is_told_from_then_on() {
    let text = "scene \"Wave that ends\"\ncontacts open\nbar hammer { impedance = 1/2, travel = 3/2, velocity = 2/3 }\n\
        support spring { stiffness = 2 }\nbar rod { impedance = 7/5, travel = 4, velocity = 1/3 }\n\
        bar tip { impedance = 2, travel = 5/4, velocity = 1/3 }\nline free - hammer - spring | rod | tip - free";
    let history = History::of(&network_of(text, &[]), Some(&rational(8, 1)), 20).unwrap();
    use EventKind::{Impact, Opening, Release};
    assert_eq!(kinds(&history.events), [Impact, Opening, Release, Opening]);
    assert!(!history.assumptions.is_empty());
    let [_, parted, released, _] = &history.events[..] else { unreachable!() };
    let travelled = ball(&released.time).subtract(&ball(&parted.time), 300);
    assert!(is_zero(&travelled.subtract(&Ball::from_rational(&rational(4, 1), 300), 300)));
}

/// Where an end moves with `sin(2t)` the wave leaves the rod at `1 + π/2`, and what it holds is what was done at its end. At rest
/// again, the end is a wall, from which the rod does not part.
#[test]
fn an_end_moves_as_a_load_says() {
    let text = "scene \"Driven end\"\nload shake { velocity = sin(2*t), until = 4 }\nbar rod { impedance = 1, travel = 1 }\n\
        bar far { impedance = 1 }\nline free - shake - rod | far - endless\ncontacts open\nobserve v = velocity(shake)\n\
        observe w = work(rod.left) - energy(rod) - energy(far)";
    let network = network_of(text, &[]);
    let history = History::of(&network, Some(&rational(9, 2)), 40).unwrap();
    assert_eq!(kinds(&history.events), [EventKind::Opening]);
    let half = Ball::from_rational(&rational(1, 2), 300);
    let expected = Ball::pi(300).multiply(&half, 300);
    let expected = expected.add(&Ball::from_rational(&rational(1, 1), 300), 300);
    assert!(is_zero(&ball(&history.events[0].time).subtract(&expected, 300)));
    let times = [rational(1, 2), rational(7, 2), rational(17, 4)];
    let [early, late, after] = &values(&network, "v", &times, Limit::Right, 40)[..] else {
        unreachable!()
    };
    let [sine_of_1, sine_of_7] = [
        "0.8414709848078965066525023216302989996226",
        "0.6569865987187890903969990915936351779369",
    ];
    assert_eq!([early, late].map(|own| own.to_text(40)), [sine_of_1, sine_of_7]);
    assert_eq!(after.exact(), Some(&rational(0, 1)));
    for own in values(&network, "w", &times, Limit::Right, 40) {
        assert!(is_zero(&ball(&own)));
    }
    let touching = text
        .replace("shake - rod", "shake | ram - rod")
        .replace("bar rod", "mass ram { mass = 1 }\nbar rod");
    let refused = History::of(&network_of(&touching, &[]), None, 12).err().unwrap().to_string();
    assert!(refused.contains("`shake` imposes the velocity of what touches a mass"), "{refused}");
}

/// Loads that begin with zero press masses together from the start on, and nothing is assumed to say so.
#[test]
fn loads_that_begin_with_zero_press_at_once() {
    let loads =
        ["sin(3*t)", "sin(pi*t)", "t*exp(-t)", "1 - cos(2*t)", "exp(-t) - 1 + t", "sin(pi*t)^2"];
    for force in loads {
        let text = format!(
            "scene \"Blow\"\nload blow {{ force = {force}, until = 1 }}\nmass ram {{ mass = 1 }}\n\
             bar pile {{ impedance = sqrt(2), travel = 1 }}\nline free - blow - ram | pile - fixed\ncontacts open\n\
             observe top = force(pile.left)"
        );
        let history = History::of(&network_of(&text, &[]), Some(&rational(1, 2)), 12).unwrap();
        assert!(history.assumptions.is_empty(), "{force}: {:?}", history.assumptions);
        let pull = text.replace(force, &format!("-({force})"));
        let history = History::of(&network_of(&pull, &[]), Some(&rational(1, 2)), 12).unwrap();
        assert!(history.assumptions.is_empty(), "-{force}: {:?}", history.assumptions);
        let [first, ..] = &history.events[..] else {
            panic!("-{force}: the ram is not pulled away")
        };
        assert!(
            matches!(first.kind, EventKind::Opening | EventKind::Release),
            "-{force}: {:?}",
            first.kind
        );
    }
}

/// A drill that a feed presses to the rock chatters on; without an end it is followed until there is much to tell.
#[test]
fn much_chatter_is_told_as_far_as_it_is_followed() {
    let text = "scene \"Drill\"\nbar piston { impedance = 8, travel = 2, velocity = 9 }\n\
        bar rod { impedance = 3, travel = 15 }\nbar bit { impedance = 13, travel = 1 }\n\
        support rock { stiffness = 2, damping = 1/2 }\nload feed { force = 5 }\n\
        line free - feed - piston | rod - bit - rock - free\ncontacts open";
    let history = History::of(&network_of(text, &[]), None, 6).unwrap();
    let Ending::Followed(end) = &history.ending else { panic!("{:?}", history.ending) };
    assert!(history.events.len() > 250 && end.to_f64() < 1500.0, "{}", history.events.len());
    let times: Vec<f64> = history.events.iter().map(|event| event.time.to_f64()).collect();
    assert!(times.windows(2).all(|pair| pair[0] <= pair[1]) && times[250] <= end.to_f64());
}
