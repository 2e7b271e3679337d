//! Springs and dampers beside contacts that open.

use crate::history::{ball, is_zero, network_of, rational, values};
use wavestep::history::{EventKind, History};
use wavestep::network::Network;
use wavestep::signal::{Limit, Value};
use wavestep_polynomial::Rational;

/// A mass strikes a fixed bar through a damper, and leaves it.
const DAMPED: &str = "scene \"A damper\"\nmass m { mass = 1, velocity = 1 }\n\
    spring s { damping = 1 }\nbar b { impedance = 1, travel = 1 }\nline free - m | s - b - fixed\n\
    observe c = compression(s)\nobserve F = force(s)\nobserve um = displacement(m)\n\
    observe ub = displacement(b.left)\n";

/// When a contact opens first, to the nearest double.
fn first_opening(network: &Network) -> Rational {
    let history = History::of(network, None, 12).unwrap();
    let opening = history.events.iter().find(|event| event.kind == EventKind::Opening).unwrap();
    Rational::from_float(ball(&opening.time).rounded().unwrap()).unwrap()
}

/// What a damper is compressed by is what its ends have moved; `1 − e^{−t/2}` until a wave returns, the same
/// as with closed contacts until the first opening, and constant without force from then on.
#[test]
fn a_damper_is_compressed_and_stays_so() {
    let open = network_of(&format!("{DAMPED}contacts open"), &[]);
    let told = |name, times: &[Rational]| {
        let told = values(&open, name, times, Limit::Right, 12);
        told.iter().map(ball).collect::<Vec<_>>()
    };
    let one = rational(1, 1);
    let exact = wavestep::ball::Ball::from_rational(&rational(-1, 2), 200).exp(200).unwrap();
    let sum = told("c", std::slice::from_ref(&one))[0].add(&exact, 200);
    assert!(is_zero(&sum.subtract(&wavestep::ball::Ball::from_rational(&one, 200), 200)));
    let after = first_opening(&open) + &one;
    let times = [rational(4, 1), after.clone(), &after + &one];
    let compressed = told("c", &times);
    assert!(is_zero(&compressed[1].subtract(&compressed[2], 200)));
    assert!(!is_zero(&compressed[0]));
    let [um, ub] = ["um", "ub"].map(|name| told(name, &times[..1]).remove(0));
    // The end of the bar is the other end of the damper.
    assert!(is_zero(&um.subtract(&ub, 200).subtract(&compressed[0], 200)));
    let force = values(&open, "F", &times[1..], Limit::Right, 12);
    assert_eq!(force, vec![Value::Exact(rational(0, 1)); 2]);
}

/// The force of a spring with damping is exactly zero once its contact is open.
#[test]
fn a_damped_spring_is_without_force_after_an_opening() {
    let text = DAMPED.replace("{ damping = 1 }", "{ stiffness = 2, damping = 1/2 }");
    let open = network_of(&format!("{text}contacts open"), &[]);
    let after = first_opening(&open);
    let times = [&after + rational(1, 100), &after + rational(1, 10)];
    let force = values(&open, "F", &times, Limit::Right, 12);
    assert_eq!(force, vec![Value::Exact(rational(0, 1)); 2]);
}

/// The force of a damped support that stands alone is exactly zero, while it comes back.
#[test]
fn a_damped_support_that_stands_alone_has_no_force() {
    let text = "scene \"Bit off the rock\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nmass bit { mass = 1/3 }\n\
        support rock { stiffness = 4, damping = 1 }\nline free - rod - bit | rock - free\ncontacts open\n\
        observe force = force(rock)\nobserve pressed = displacement(rock)";
    let open = network_of(text, &[]);
    let after = first_opening(&open);
    let times = [&after + rational(1, 100), &after + rational(1, 10)];
    let force = values(&open, "force", &times, Limit::Right, 12);
    assert_eq!(force, vec![Value::Exact(rational(0, 1)); 2]);
    let before = values(&open, "force", &[rational(1, 2)], Limit::Right, 12);
    let pressed = values(&open, "pressed", &times, Limit::Right, 12);
    assert!(before.iter().chain(&pressed).all(|own| own.to_f64() > 0.0));
}

/// A support without damping that stands alone behind a contact is a spring to the ground: what it held flies on, and it is
/// back at once where it carries no force.
#[test]
fn a_support_that_stands_alone_is_a_spring_to_the_ground() {
    let drill = |rock: &str, end: &str| {
        network_of(
            &format!(
                "scene \"A bit on rock\"\nbar piston {{ impedance = 1, travel = 1, velocity = 1 }}\n\
                bar rod {{ impedance = 2, travel = 3 }}\nmass bit {{ mass = 1 }}\n{rock} rock {{ stiffness = 1/4 }}\n\
                line free - piston | rod - bit | rock - {end}\ncontacts open\n\
                observe F = force(rock)\nobserve u = displacement(bit)\nobserve e = energy(rock)\n"
            ),
            &[],
        )
    };
    let [support, spring] = [drill("support", "free"), drill("spring", "fixed")];
    let until = rational(40, 1);
    let [ours, others] = [&support, &spring].map(|own| History::of(own, Some(&until), 12).unwrap());
    let of_rock = |history: &History| history.events.iter().filter(|own| own.contact == 1).count();
    assert!(of_rock(&ours) > 2, "the rock lets go, and is met again");
    assert_eq!(format!("{:?}", ours.events), format!("{:?}", others.events));
    let times: Vec<Rational> = (1..40).map(|n| rational(n, 1)).collect();
    for name in ["F", "u", "e"] {
        let told = |own| values(own, name, &times, Limit::Right, 12);
        assert_eq!(told(&support), told(&spring), "{name}");
    }
    let forces = values(&support, "F", &times, Limit::Right, 12);
    assert!(forces.contains(&Value::Exact(rational(0, 1))));
}

/// Waves that reach both sides of a support at once would part it from both bars. As it is displaced it goes back with one of
/// them, so that no energy is lost, and stands alone only once it is back.
#[test]
fn a_support_between_two_contacts_goes_back_with_one_side() {
    let bars = |of: [&str; 2], line: &str| {
        let [left, right] = of;
        network_of(
            &format!(
                "scene \"A support between bars\"\nbar a {{ {left}, travel = 1 }}\nbar b {{ {right}, travel = 1 }}\n\
                support r {{ stiffness = 3 }}\nsupport w {{ stiffness = 2 }}\nline {line}\ncontacts open\n\
                observe e = energy(line)\nobserve u = displacement(r)\n"
            ),
            &[],
        )
    };
    let struck = ["impedance = 1, velocity = 1", "impedance = 1"];
    let mirrored = ["impedance = 1, velocity = -1", "impedance = 1"];
    let both = ["impedance = 1, velocity = 2", "impedance = 2, velocity = -2"];
    let times: Vec<Rational> = (1..27).map(|n| rational(n, 3)).collect();
    for (bars, energy) in [
        (bars(struck, "free - a | r - w | b - free"), rational(1, 2)),
        (bars(mirrored, "free - b | w | r | a - free"), rational(1, 2)),
        (bars(both, "free - w | a | r | b - free"), rational(6, 1)),
    ] {
        for value in values(&bars, "e", &times, Limit::Right, 12) {
            assert!((value.to_f64() - Value::Exact(energy.clone()).to_f64()).abs() < 1e-12);
        }
        let displacements = values(&bars, "u", &times, Limit::Right, 12);
        assert!(displacements.contains(&Value::Exact(rational(0, 1))), "{displacements:?}");
        assert!(displacements.iter().any(|u| u.to_f64().abs() > 0.1), "{displacements:?}");
    }
}

/// A contact closes as a wave arrives there: two instants that no precision tells apart are assumed to be one. What a bar
/// holds then, and a travel time later, is told under that assumption.
#[test]
fn energies_at_instants_that_are_assumed_to_be_one_are_told() {
    let text = "scene \"One instant\"\nbar a { impedance = 1, travel = 3/2, velocity = 1 }\n\
        support r { stiffness = 5 }\nbar b { impedance = 2, travel = 1, velocity = -1/2 }\n\
        line fixed - a | r | b - free\ncontacts open\nobserve e = energy(b)\nobserve all = energy(line)\n";
    let network = network_of(text, &[]);
    let times = [rational(9, 2), rational(11, 2), rational(13, 2)];
    for (name, energy) in [("e", 0.25), ("all", 1.0)] {
        for value in values(&network, name, &times, Limit::Right, 12) {
            assert!((value.to_f64() - energy).abs() < 1e-12, "{name}: {value:?}");
        }
    }
    assert_eq!(network.assumed.all().len(), 1);
}

/// Both sides of a closed contact move alike: their difference is zero as far as can be told.
#[test]
fn a_difference_that_is_zero_is_told_as_that() {
    let text = "scene \"Together\"\nmass m { mass = 1, velocity = 1 }\n\
        bar b { impedance = 1, travel = 1 }\nline free - m | b - free\n\
        observe apart = displacement(b.left) - displacement(m)\ncontacts open";
    let network = network_of(text, &[]);
    let times = [rational(1, 2), rational(1, 1)];
    for value in values(&network, "apart", &times, Limit::Right, 9) {
        assert!(value.to_text(9).starts_with("0 ± "), "{value:?}");
        assert!(ball(&value).contains(&rational(0, 1)));
    }
}

/// A mass that bounces on a spring under a constant force: with mass, stiffness and velocity 1 and the force
/// `F`, the spring is compressed by `F (1 − cos t) + sin t`, which is zero again at `D = 2π − 2 atan(1/F)`. It leaves
/// as fast as it came and is back after `2/F`, for ever. A flight of eight units ends where cells of one unit do.
#[test]
fn a_mass_bounces_on_a_spring_for_ever() {
    const BOUNCES: usize = 40;
    let text = "scene \"A mass bounces on a spring\"\nload weight { force = 1/4 }\n\
        mass hammer { mass = 1, velocity = 1 }\nspring s { stiffness = 1 }\n\
        line free - weight - hammer | s - fixed\ncontacts open\nobserve v = velocity(hammer)";
    let closed = 2.0 * (std::f64::consts::PI - 4.0_f64.atan());
    let until = rational(((closed + 8.0) * BOUNCES as f64) as i64, 1);
    let history = History::of(&network_of(text, &[]), Some(&until), 12).unwrap();
    assert_eq!(history.events.len(), 2 * BOUNCES);
    for (number, event) in history.events.iter().enumerate() {
        let begun = (closed + 8.0) * (number / 2) as f64;
        let (kind, time) = match number {
            0 => (EventKind::Impact, 0.0),
            n if n % 2 == 0 => (EventKind::Closing, begun),
            _ => (EventKind::Opening, begun + closed),
        };
        let told = ball(&event.time).to_double().0;
        assert!(event.kind == kind && (told - time).abs() < 1e-11 * time.max(1.0), "{number}");
    }
    let [contact] = &history.contacts[..] else { panic!("one contact") };
    assert_eq!(contact.restitution.as_ref().map(|value| value.to_f64()), Some(1.0));
}

/// The end of a spring that comes loose has no mass: it leaves with a velocity of its own. So a bit that
/// strikes a rock comes back as often as it likes and presses each time; seen in a mirror as well.
#[test]
fn the_end_of_a_spring_is_struck_again() {
    let lines = [
        ("1", "free - striker | rod - bit | rock - fixed"),
        ("-1", "fixed - rock | bit - rod | striker - free"),
    ];
    let told = lines.map(|(velocity, line)| {
            let text = format!(
                "scene \"Struck again\"\n\
                 bar striker {{ impedance = 1, travel = 1, velocity = {velocity} }}\n\
                 bar rod {{ impedance = 1, travel = 3 }}\nmass bit {{ mass = 2, velocity = {velocity} }}\n\
                 spring rock {{ stiffness = 2 }}\nline {line}\ncontacts open\nobserve v = velocity(bit)"
            );
            History::of(&network_of(&text, &[]), Some(&rational(40, 1)), 12).unwrap()
        });
    let [one, mirrored] = told;
    let presses = |kind| matches!(kind, EventKind::Impact | EventKind::Closing);
    assert_eq!(one.events.iter().filter(|event| presses(event.kind)).count(), 4);
    let rock = |own: &&wavestep::history::ContactSummary| own.between.contains(&"rock".to_owned());
    let of_rock = one.contacts.iter().find(rock).expect("a contact with the spring");
    assert_eq!(of_rock.durations.len(), 2);
    assert!(of_rock.impulses.iter().all(|impulse| impulse.to_f64() > 1.0));
    assert_eq!(one.events.len(), mirrored.events.len());
    let times = |history: &History| -> Vec<f64> {
        let mut times: Vec<f64> = history.events.iter().map(|event| event.time.to_f64()).collect();
        times.sort_by(f64::total_cmp);
        times
    };
    for (time, other) in times(&one).iter().zip(times(&mirrored)) {
        assert!((time - other).abs() < 1e-10);
    }
    // A gap has no force until it closes.
    let again = one.events.iter().filter(|event| event.kind == EventKind::Closing);
    for event in again {
        let [before, after] = &event.forces;
        assert_eq!((before.to_f64(), after.to_f64() >= 0.0), (0.0, true));
    }
}

/// A stiff specimen between long bars: its rate is some fifty of their travel times, and what is not known of it
/// dies out as fast. So the precision hardly grows until nothing meets again, and cells are as many as arrivals.
#[test]
fn a_stiff_specimen_needs_few_cells_and_bits() {
    let text = "scene \"A stiff specimen\"\nbar striker { impedance = 1, travel = 1/5, velocity = 1 }\n\
        bar incident { impedance = 1, travel = 1 }\nspring specimen { stiffness = 26 }\n\
        bar transmitter { impedance = 1, travel = 1 }\n\
        line free - striker | incident - specimen - transmitter - free\ncontacts open\n\
        observe force = force(specimen)";
    let history = History::of(&network_of(text, &[]), None, 12).unwrap();
    assert_eq!(history.ending, wavestep::Ending::Parted);
    assert!(history.bits <= 352 && history.cells <= 1600, "{} {}", history.bits, history.cells);
}

/// Once a ram has left the cushion on a pile, the end of the pile carries no force at all: that of the contact, and not
/// what is left of waves that cancel.
#[test]
fn a_bar_behind_a_loose_spring_has_no_force_at_its_end() {
    let right = "line free - ram | cushion - pile - toe - free";
    let left = "line free - toe - pile - cushion | ram - free";
    for (line, velocity, end) in [(right, "1", "left"), (left, "-1", "right")] {
        let problem = wavestep::Problem::read(
            "pile.wave",
            format!(
                "scene \"A\"\nmass ram {{ mass = 1/2, velocity = {velocity} }}\nspring cushion {{ stiffness = 4 }}\n\
                 bar pile {{ impedance = 1, travel = 1 }}\nsupport toe {{ damping = 1/3 }}\n{line}\n\
                 contacts open\nobserve top = force(pile.{end})\nobserve spring = force(cushion)"
            ),
        )
        .unwrap();
        let parted = problem.events_until("6", 12).unwrap().events[1].time.to_f64();
        let signals = ["top", "spring"].map(|name| problem.signal(name).unwrap());
        for time in ["1/3", "1", "3/2"] {
            let [top, cushion] =
                signals.each_ref().map(|own| own.at(time, 20).unwrap().to_string());
            assert_eq!(top, cushion, "{end} at {time}");
        }
        assert!(parted < 5.0, "{parted}");
        assert_eq!(signals[0].at("11/2", 20).unwrap().to_string(), "0");
        let zeros = signals[0].roots("1/10"..="6", 9).unwrap().all;
        assert!(
            matches!(&zeros[..], [wavestep::Root::Interval { from, .. }] if (from.to_f64() - parted).abs() < 1e-8),
            "{zeros:?}"
        );
    }
}
