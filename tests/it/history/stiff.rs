//! Light masses and stiff springs: their free motion dies out within a tiny part of a travel time, and from then on
//! they follow what arrives.

use crate::history::{ball, is_zero, network_of, rational, values};
use wavestep::ball::Magnitude;
use wavestep::history::{EventKind, History};
use wavestep::planner::{Origin, Purpose, Together};
use wavestep::signal::{At, Limit};
use wavestep::{Goal, Place, Problem};
use wavestep_polynomial::Rational;

/// What is followed is the closed form of the same scene with closed contacts, as long as these would not open.
fn follows_the_closed_form(text: &str, names: &[&str], times: &[Rational]) {
    let closed = network_of(text, &[]);
    let open = network_of(&format!("{text}\ncontacts open"), &[]);
    for name in names {
        let [told, exact] = [&open, &closed].map(|own| values(own, name, times, Limit::Right, 45));
        for ((told, exact), time) in told.iter().zip(&exact).zip(times) {
            let off = ball(told).subtract(&ball(exact), 300);
            assert!(is_zero(&off), "{name} at {time}: {off}");
        }
    }
}

fn billionths(count: i64) -> Rational {
    rational(count, 1_000_000_000)
}

#[test]
fn a_light_mass_between_bars() {
    let text = "scene \"A light mass\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
        mass m { mass = 1e-9 }\nbar b { impedance = 2, travel = 3/2 }\nline free - a | m - b - free\n\
        observe v = velocity(m)\nobserve s = velocity(b.right)";
    let after =
        |time: Rational| [&time + billionths(1), &time + billionths(30), &time + billionths(90)];
    let times = [after(rational(0, 1)), after(rational(3, 2))].concat();
    let times: Vec<Rational> = times.into_iter().chain([rational(19, 10)]).collect();
    follows_the_closed_form(text, &["v", "s"], &times);
    // It leaves as the bar would by itself: (Z1 − Z2)/(Z1 + Z2) < 0 at 2L/c.
    let open = network_of(&format!("{text}\ncontacts open"), &[]);
    let history = History::of(&open, None, 12).unwrap();
    let opening = history.events.iter().find(|event| event.kind == EventKind::Opening).unwrap();
    let off =
        ball(&opening.time).subtract(&wavestep::ball::Ball::from_rational(&rational(2, 1), 99), 99);
    assert!(off.rounded().unwrap().abs() < 1e-6, "{off}");
}

#[test]
fn a_stiff_specimen_between_long_bars() {
    let text = "scene \"A stiff specimen\"\nbar s { impedance = 1, travel = 1, velocity = 1 }\n\
        bar a { impedance = 1, travel = 3 }\nspring k { stiffness = 1e6 }\n\
        bar b { impedance = 1, travel = 3 }\nline free - s | a - k - b - free\n\
        observe v = velocity(b.right)\nobserve F = force(k)";
    let after = |time: i64| [100, 1000, 20_000].map(|by| rational(time, 1) + billionths(by));
    let times = [after(3), after(5), after(6)].concat();
    follows_the_closed_form(text, &["F"], &times[..6]);
    let times: Vec<Rational> =
        times[6..].iter().cloned().chain([rational(13, 2), rational(79, 10)]).collect();
    follows_the_closed_form(text, &["v"], &times);
}

/// Motions that are gone at once and motions that last act on each other in one place.
#[test]
fn a_light_mass_among_heavy_ones() {
    let text = "scene \"A light mass among heavy ones\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
        mass m { mass = 1000 }\nspring d { damping = 1000 }\nmass q { mass = 1e-6 }\n\
        spring s { stiffness = 3 }\nmass o { mass = 2 }\nline free - a - m - d - q - s - o - free\n\
        observe v = velocity(o)\nobserve w = velocity(q)\nobserve F = force(s)";
    let times: Vec<Rational> = [1, 15, 77].map(|k| rational(k, 7)).into();
    follows_the_closed_form(text, &["v", "w", "F"], &times);
}

/// The same behind a soft face of a specimen between bars; each arrival wakes the fast motion anew.
#[test]
fn a_light_specimen_with_a_soft_face() {
    let text = "scene \"A specimen with a face\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
        spring face { stiffness = 5 }\nmass m { mass = 1e-7 }\nbar b { impedance = 2, travel = 3/2 }\n\
        line free - a - face - m - b - free\nobserve v = velocity(m)\nobserve F = force(face)";
    let times: Vec<Rational> = [1, 5, 17, 41].map(|k| rational(k, 9)).into();
    follows_the_closed_form(text, &["v", "F"], &times);
}

/// A mass of 1e-9 under a force of 1e9: the rates of the scene differ by as much.
#[test]
fn a_light_mass_is_pressed_on_a_bar() {
    let text = "scene \"A mass under a constant force\"\nload weight { force = 1/1e-9 }\n\
        mass hammer { mass = 1e-9, velocity = 1 }\nbar rod { impedance = 1, travel = 1 }\n\
        line free - weight - hammer | rod - fixed\nobserve v = velocity(hammer)\n\
        observe e = strain(rod.right)";
    let times: Vec<Rational> = (0..3).map(|k| rational(20 * k + 7, 13)).collect();
    follows_the_closed_form(text, &["v", "e"], &times);
}

/// A fast motion that dies out takes more cells at a higher precision; the search keeps those that it counted.
#[test]
fn extrema_of_stiff_scenes_are_found_at_any_precision() {
    let text = "scene \"A light mass on a stiff bar\"\n\
        mass hammer { mass = 3/1000, velocity = 1000 }\n\
        bar anvil { velocity = -500, impedance = 10^6, travel = 4*10^(-6) }\n\
        load push { force = -1/3*10^6, from = 0, until = 4*10^(-6) }\n\
        bar rod { velocity = -1000, impedance = 1000, travel = 99*10^(-8) }\n\
        line free - hammer | anvil | push - rod - fixed\n\
        observe f = force(anvil.left)\n";
    let problem = Problem::read("stiff.wave", text).unwrap();
    let signal = problem.signal("f").unwrap();
    let largest = signal.extremum(Goal::Largest, "0"..="8e-6", 20).unwrap();
    assert_eq!(largest.value.to_string(), "1500000000");
}

/// A light mass on a spring loses bits at each return of a wave: stretches of a long window are counted with more.
#[test]
fn long_windows_of_light_masses_have_extrema() -> Result<(), wavestep::Error> {
    let text = "scene \"A light sensor\"\nmass block { mass = 20, velocity = 1 }\n\
        spring pad { stiffness = 1, damping = 1/10 }\nmass sensor { mass = 1/100 }\n\
        bar rod { impedance = 1, travel = 1 }\nline free - block - pad - sensor - rod - fixed\n\
        observe s = strain(rod.right)\n";
    let network = network_of(text, &[]);
    let [zero, to] = [0, 120].map(|time| rational(time, 1));
    let observed = &network.observables()[0];
    let together = [observed];
    let together = Together::new(&network, &together, [&zero, &to], Purpose::Search);
    let signal = together.of_origin(Origin::Followed, observed).unwrap();
    assert!(signal.count().unwrap() > 1000 && signal.ready_bits() > 192);
    let end = signal.enclose(signal.count().unwrap() - 1, 0, At::Time(&to), 64).unwrap();
    assert!(*end.radius() < Magnitude::power_of_two(-90), "{end}");
    // The value there by the closed form.
    let problem = Problem::read("scene", text)?;
    let largest = problem.signal("s")?.extremum(Goal::Largest, 0..=120, 12)?;
    let [Place::Critical(time)] = &largest.places[..] else { panic!("{:?}", largest.places) };
    let [at, _] = time.bounds();
    assert_eq!(problem.signal("s")?.at(at, 12)?.to_text(12), largest.value.to_text(12));
    Ok(())
}
