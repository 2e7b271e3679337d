//! What cannot be followed is refused by name; what no precision decides is a tie, told with the answer.

use crate::history::{kinds, network_of};
use wavestep::history::{Event, EventKind, History};
use wavestep::problem::{Problem, Values};

/// A bar against a wall. A force `f` at its other end is felt at the wall a travel time later as `2 f`, until
/// the wave has gone back and forth.
pub fn pressed(force: &str) -> String {
    format!(
        "scene \"A bar against a wall\"\nload push {{ force = {force} }}\n\
         bar rod {{ impedance = 1, travel = 1 }}\nline free - push - rod | fixed\ncontacts open"
    )
}

/// What touches zero with rational coefficients does not pull: the contact stays closed.
#[test]
fn a_polynomial_that_touches_zero_is_no_event() {
    for force in ["(t - 1)*(t - 1)", "(t - 4/3)*(t - 4/3)"] {
        let until = wavestep::language::parse_number("5/2").unwrap();
        let history = History::of(&network_of(&pressed(force), &[]), Some(&until), 9).unwrap();
        assert_eq!(kinds(&history.events), []);
    }
}

/// Polynomials of degree three are not decided exactly: that such a force touches zero is a tie, and what is
/// as near to zero as 1e-150 is none.
#[test]
fn a_force_that_touches_zero_is_a_tie() {
    let until = wavestep::language::parse_number("5/2").unwrap();
    let history =
        |force: &str| History::of(&network_of(&pressed(force), &[]), Some(&until), 9).unwrap();
    let touching = "(t - 5/4)*(t - 5/4)*(t + 1)";
    let tied = history(touching);
    assert_eq!(kinds(&tied.events), []);
    let [assumption] = &tied.assumptions[..] else { panic!("{:?}", tied.assumptions) };
    assert!(
        assumption
            .starts_with("the force between rod and wall does not fall below zero at t = 2.2")
            && assumption.ends_with(", which 829 bits do not decide"),
        "{assumption}"
    );
    let above = history(&format!("{touching} + 1e-150"));
    assert_eq!((kinds(&above.events), above.assumptions), (vec![], vec![]));
    let below = history(&format!("{touching} - 1e-150"));
    assert_eq!(kinds(&below.events), [EventKind::Opening, EventKind::Closing]);
    assert_eq!(below.assumptions, [""; 0]);
}

/// A light mass between two contacts, and a stiff spring behind one: forces die out until no precision tells
/// them from zero, and then what keeps them closed arrives, or what opens them. The history is that of a
/// mass, or a compliance, ten times as large, whose forces are told from zero, but for what dies out.
#[test]
fn forces_that_die_out_are_ties() {
    let light = |mass: &str| {
        format!(
            "scene \"A light mass between bars\"\nbar a {{ impedance = 1, travel = 1, velocity = 1 }}\n\
             mass m {{ mass = {mass} }}\nbar b {{ impedance = 2, travel = 3/2 }}\n\
             line free - a | m | b - free\ncontacts open"
        )
    };
    let until = wavestep::language::parse_number("4").unwrap();
    let history = |text: &str| History::of(&network_of(text, &[]), Some(&until), 9).unwrap();
    let (tied, told) = (history(&light("1e-5")), history(&light("1e-2")));
    assert_eq!(told.assumptions, [""; 0]);
    let assumed = &tied.assumptions;
    assert!(
        assumed[0].starts_with("the force between m and b does not fall below zero at"),
        "{assumed:?}"
    );
    let lasting = |event: &&Event| event.bodies.len() == 2;
    let [tied, told] = [&tied, &told].map(|history| history.events.iter().find(lasting).unwrap());
    assert_eq!((tied.kind, &tied.between), (told.kind, &told.between));
    assert!((tied.time.to_f64() - told.time.to_f64()).abs() < 0.1);
}

/// Two zeros of the force within 2e-9 of each other: the contact opens and closes again. With
/// `s = t − 2` and `ε = 1e-9` the free end moves with `2 (s² − ε²)` and is back at the wall where
/// `(s + ε)² (s − 2ε) = 0`.
#[test]
fn two_zeros_near_each_other_are_both_found() {
    let near = pressed("(t - 1)*(t - 1) - 1/1000000000000000000");
    let until = wavestep::language::parse_number("5/2").unwrap();
    let history = History::of(&network_of(&near, &[]), Some(&until), 15).unwrap();
    assert_eq!(kinds(&history.events), [EventKind::Opening, EventKind::Closing]);
    assert_eq!(history.events[0].time.to_text(15), "1.999999999 = 1999999999/1000000000");
    assert_eq!(history.events[1].time.to_text(15), "2.000000002 = 1000000001/500000000");
    let above = pressed("(t - 1)*(t - 1) + 1/1000000000000000000");
    let history = History::of(&network_of(&above, &[]), Some(&until), 15).unwrap();
    assert_eq!(kinds(&history.events), []);
}

#[test]
fn rigid_masses_that_meet_are_refused() {
    let text = "scene \"Two masses\"\nmass a { mass = 1, velocity = 1 }\nmass b { mass = 1 }\n\
                line free - a | b - free\ncontacts open";
    let error = History::of(&network_of(text, &[]), None, 9).err().unwrap();
    assert!(error.to_string().contains("the rigid masses `a` and `b` meet"), "{error}");
}

/// A mass at a wall that a load pulls off, `t − 1/2` against a bar without end: it leaves when the load turns, and then
/// moves with `v' = τ − v`, which is `v = τ − 1 + exp(−τ)`.
const PULLED: &str = "scene \"Pulled off a wall\"\nload pull { force = t - 1/2 }\nmass m { mass = 1 }\n\
    bar rod { impedance = 1 }\nobserve v = velocity(m)\nline fixed | pull - m - rod - endless\ncontacts open";

#[test]
fn a_load_pulls_a_mass_off_a_wall() {
    let until = wavestep::language::parse_number("4").unwrap();
    let history = History::of(&network_of(PULLED, &[]), Some(&until), 9).unwrap();
    // Pressed by half of the unit of force at once.
    assert_eq!(kinds(&history.events), [EventKind::Impact, EventKind::Opening]);
    assert_eq!(history.events[0].forces[1].to_text(9), "0.5 = 1/2");
    assert_eq!(history.events[1].time.to_text(9), "0.5 = 1/2");
    let problem = Problem::of_text("wall.wave", PULLED, &Values::new()).unwrap();
    let signal = problem.signal("v").unwrap();
    assert_eq!(signal.at("1/2", 9).unwrap().to_text(9), "0");
    let moved = 2.5 - 1.0 + (-2.5_f64).exp();
    assert!((signal.at("3", 17).unwrap().to_f64() - moved).abs() < 1e-15);
}

/// A release at an irrational time needs no assumption: with `p = t² − 1/2` the gap begins as `τ³`, since what pressed the mass on
/// the wall, or on another mass, has just come to nothing. Then `v' = p − v`.
#[test]
fn a_mass_leaves_at_an_irrational_time() {
    let text = PULLED.replace("force = t - 1/2", "force = t*t - 1/2");
    let until = wavestep::language::parse_number("2").unwrap();
    let history = History::of(&network_of(&text, &[]), Some(&until), 12).unwrap();
    assert_eq!(history.assumptions, [""; 0]);
    assert_eq!(kinds(&history.events), [EventKind::Impact, EventKind::Opening]);
    let left = 0.5_f64.sqrt();
    assert!((history.events[1].time.to_f64() - left).abs() < 1e-12);
    // v = (t − 1)² + 1/2 + c exp(−t), and zero at the release.
    let moved = |t: f64| (t - 1.0).powi(2) + 0.5;
    let expected = moved(2.0) - moved(left) * (left - 2.0).exp();
    let problem = Problem::of_text("wall.wave", &text, &Values::new()).unwrap();
    let told = problem.signal("v").unwrap().at("2", 15).unwrap().to_f64();
    assert!((told - expected).abs() < 1e-14, "{told} {expected}");
    // Two masses that a load presses together, until it pulls.
    let masses = "scene \"Two masses\"\nload p { force = 1 - t*t*t }\nmass a { mass = 1 }\nmass b { mass = 2 }\n\
        bar rod { impedance = 1 }\nline free - p - a | b - rod - endless\ncontacts open";
    let history = History::of(&network_of(masses, &[]), Some(&until), 12).unwrap();
    assert_eq!(history.assumptions, [""; 0]);
    assert_eq!(kinds(&history.events), [EventKind::Impact, EventKind::Opening]);
}

#[test]
fn rigid_masses_that_hit_a_wall_are_refused() {
    let until = wavestep::language::parse_number("4").unwrap();
    let error = |text: &str| History::of(&network_of(text, &[]), Some(&until), 9).err().unwrap();
    // v = 3 − 2t − 3 exp(−t), and x = 3t − t² − 3 (1 − exp(−t)) is zero again.
    let refused =
        "the rigid mass `m` hits a wall at t = 1.36078: put a spring or a bar between them";
    let comes_back = PULLED.replace("t - 1/2", "1 - 2*t");
    assert_eq!(error(&comes_back).to_string(), refused);
    let mirrored =
        comes_back.replace("fixed | pull - m - rod - endless", "endless - rod - m - pull | fixed");
    let mirrored = mirrored.replace("1 - 2*t", "2*t - 1");
    assert_eq!(error(&mirrored).to_string(), refused);
    // One that moves at the start is refused when it is read, whichever way it goes.
    for velocity in ["1", "-1", "V"] {
        let begins =
            PULLED.replace("mass = 1 }", &format!("mass = 1, velocity = {velocity} }}\nsymbol V"));
        let error = Problem::of_text("wall.wave", &begins, &Values::new()).err().unwrap();
        assert!(
            error.to_string().contains("the mass `m` touches a wall, and has to begin at rest"),
            "{error}"
        );
    }
    // So are two masses that meet at once, by `check`.
    let meet = "scene \"Two masses\"\nmass a { mass = 1, velocity = 1 }\nmass b { mass = 1 }\n\
        bar rod { impedance = 1 }\nline free - a | b - rod - endless\ncontacts open";
    let problem = Problem::of_text("meet.wave", meet, &Values::new()).unwrap();
    assert!(problem.check().unwrap_err().to_string().contains("the rigid masses `a` and `b` meet"));
}

/// What is joined to one wall cannot leave another.
#[test]
fn what_is_joined_to_a_wall_does_not_leave_the_other() {
    for line in ["fixed | pull - m - fixed", "fixed - pull - m | fixed"] {
        let text = format!(
            "scene \"Between walls\"\nload pull {{ force = t }}\nmass m {{ mass = 1 }}\nobserve v = velocity(m)\n\
             line {line}\ncontacts open"
        );
        let error = Problem::of_text("walls.wave", &text, &Values::new()).err().unwrap();
        assert!(error.to_string().contains("has no effect at a fixed end"), "{line}: {error}");
    }
}

/// What presses a mass whose velocity is imposed by what touches it depends on how that velocity changes; also across what has no
/// mass.
#[test]
fn imposed_velocities_of_what_touches_inertia_are_refused() {
    for (line, support) in [
        ("push | m - rod", ""),
        ("m | push - rod", ""),
        ("push | toe | m - rod", "support toe { stiffness = 1 }\n"),
    ] {
        let text = format!(
            "scene \"Pushed\"\nload push {{ velocity = 1 }}\nmass m {{ mass = 1 }}\n{support}\
             bar rod {{ impedance = 1, travel = 1 }}\nline free - {line} - free\ncontacts open"
        );
        let error = History::of(&network_of(&text, &[]), None, 9).err().unwrap().to_string();
        let told = "what touches a mass: put a spring or a bar between them";
        assert!(error.ends_with(told), "{line}: {error}");
    }
}

/// Bodies that move apart from the start part at once, and a gap that closes exactly when a wave arrives
/// is closed there.
#[test]
fn events_at_the_start_and_at_arrivals_are_told() {
    let text = "scene \"Apart\"\nbar rod { impedance = 1, travel = 1, velocity = -1 }\n\
                bar two { impedance = 1, travel = 1 }\nline fixed - rod | two - free";
    let history = History::of(&network_of(text, &[]), None, 9).unwrap();
    let opening = &history.events[0];
    assert_eq!((opening.kind, opening.time.to_text(9).as_str()), (EventKind::Opening, "0"));
    // The free end goes to the left with the rod until the wall is felt, for one travel time, and then
    // comes back with velocity 1: it is home at t = 2, when the next wave arrives from the wall.
    let closing = &history.events[1];
    assert_eq!((closing.kind, closing.time.to_text(9).as_str()), (EventKind::Closing, "2"));
    assert_eq!(closing.forces[1].to_text(9), "0.5 = 1/2");
}
