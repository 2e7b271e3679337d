//! Local contacts followed with proof: against the exact solution of a spring, against collocation, and what of the
//! law, of the balances and of the bounds has to hold.

use num_traits::{Signed as _, ToPrimitive as _};
use wavestep::answer::Accuracy;
use wavestep::ball::{Ball, Magnitude, Number};
use wavestep::history::series::{CellNorm, Roughness, Series, Truncation};
use wavestep::planner::Purpose;
use wavestep::signal::{Limit, value as digits_at};
use wavestep::{Goal, Method, Place, Problem, Root, Value};
use wavestep_polynomial::Rational;

const MAX_BITS: u64 = 1 << 11;

fn problem(text: &str) -> Problem {
    Problem::read("test.wave", format!("scene \"A\"\n{text}")).unwrap()
}

fn value(problem: &Problem, name: &str, time: &str, digits: usize) -> String {
    let value = problem.signal(name).unwrap().at(time, digits).unwrap();
    value.to_text(digits)
}

/// The same at many times, from one history.
fn values(problem: &Problem, name: &str, times: &[&str], digits: usize) -> Vec<String> {
    let times: Vec<Rational> =
        times.iter().map(|time| problem.time("time", *time).unwrap()).collect();
    let wanted = problem.wanted(name).unwrap();
    let window = [&times[0], &times[times.len() - 1]];
    let signal = problem.signal_on(&wanted, window, Purpose::Values { digits }).unwrap();
    let text = |time| digits_at(&*signal, time, Limit::Right, digits, MAX_BITS).unwrap();
    times.iter().map(|time| text(time).to_text(digits)).collect()
}

/// By collocation, for which tests alone speak.
fn solved(problem: &Problem, name: &str, times: &[f64]) -> Vec<f64> {
    let times: Vec<Rational> =
        times.iter().map(|time| Rational::from_float(*time).unwrap()).collect();
    let accuracy = Accuracy::Method(Method::Steps { tolerance: 1e-13 }, None);
    problem.doubles(name, &times, Limit::Right, accuracy).unwrap().values
}

/// A steel ball between two bars, one of them with a mass, all of unlike impedances.
const WITH_MASSES: &str = "bar a { impedance = 2, travel = 3/2, velocity = 1 }\n\
    mass m { mass = 1/3, velocity = 1 }\nTIP\nmass anvil { mass = 1/2 }\n\
    bar b { impedance = 1, travel = 5/4 }\nline free - a - m - tip - anvil - b - fixed\n\
    observe force = force(tip)\nobserve compression = compression(tip)\nobserve velocity = velocity(b.left)\n\
    observe strain = velocity(a.at(1/2))";

/// With the exponent 1 a local contact is a spring while it pushes: twenty digits of two engines that share
/// neither the series nor the bound of their errors.
#[test]
fn with_exponent_one_it_is_a_spring() {
    for text in [WITH_MASSES, &WITH_MASSES.replace(" - m", "").replace(" - anvil", "")] {
        let text: String = (text.lines())
            .filter(|line| text.contains(" - m") || !line.starts_with("mass"))
            .map(|line| format!("{line}\n"))
            .collect();
        let local = problem(&text.replace("TIP", "hertz tip { stiffness = 7/3, exponent = 1 }"));
        let spring = problem(&text.replace("TIP", "spring tip { stiffness = 7/3 }"));
        for (name, time) in [("force", "1/3"), ("strain", "1")] {
            let [one, other] = [&local, &spring].map(|own| value(own, name, time, 20));
            assert_eq!(one, other, "{name} at {time}");
        }
    }
}

/// Two long bars and the exponent 2: `α' = V − (1/Z₁ + 1/Z₂) k α²` is solved by a hyperbolic tangent. It comes to rest,
/// and is followed for ten thousand times as long as that takes. Of the constant state nothing is told from the tangent,
/// whatever the digits.
#[test]
fn two_long_bars_come_to_rest_as_a_tangent_does() {
    let local = problem(
        "bar a { impedance = 1, velocity = 1 }\nhertz tip { stiffness = 1/2, exponent = 2 }\n\
         bar b { impedance = 1 }\nline endless - a - tip - b - endless\n\
         observe alpha = compression(tip)\nobserve force = force(tip)",
    );
    let bits = 400;
    for (time, digits) in [(1, 30), (18, 15), (46, 30), (1_000_000, 30)] {
        let decayed = Ball::from_integer(&(-2 * time.min(2000)).into()).exp(bits).unwrap();
        let one = Ball::from_integer(&1.into());
        let below = one.add(&decayed, bits).reciprocal(bits).unwrap();
        let alpha = one.subtract(&decayed, bits).multiply(&below, bits);
        let half = Ball::from_integer(&2.into()).reciprocal(bits).unwrap();
        let force = alpha.multiply(&alpha, bits).multiply(&half, bits);
        for (name, exact) in [("alpha", alpha), ("force", force)] {
            let exact = Value::of(&Number::Enclosed(exact), digits).to_text(digits);
            assert_eq!(value(&local, name, &time.to_string(), digits), exact, "{name} at {time}");
        }
    }
}

/// A mass that a load presses onto a long bar comes to rest at the force of the load, a light one and
/// a heavy one; few digits agree with more on the way.
#[test]
fn a_mass_comes_to_rest_on_a_long_bar() {
    for mass in ["1/10", "20"] {
        let local = problem(&format!(
            "mass ball {{ mass = {mass} }}\nload push {{ force = 1 }}\nhertz tip {{ stiffness = 3 }}\n\
             bar b {{ impedance = 1 }}\nline free - push - ball - tip - b - endless\n\
             observe force = force(tip)\nobserve v = velocity(ball)"
        ));
        let [few, more] = [12, 30].map(|digits| rational(&value(&local, "v", "40", digits)));
        assert!((few - &more).abs() < rational("0.000000000006"), "mass {mass}: {more}");
        assert_eq!(value(&local, "force", "1000000", 30), format!("1.{}", "0".repeat(29)));
    }
}

/// A decimal number.
fn rational(text: &str) -> Rational {
    let (whole, after) = text.split_once('.').unwrap_or((text, ""));
    let digits: Rational = format!("{whole}{after}").parse().unwrap();
    digits / Rational::from_integer(10.into()).pow(after.len() as i32)
}

/// Contacts that begin, end and begin again, beside bars, masses and walls, with exponents on both sides of one.
#[test]
fn values_are_those_of_collocation() {
    let bars = "bar a { impedance = 3, travel = 5/4, velocity = 1 }\nTIP\n\
        bar b { impedance = 1, travel = 1/2 }\nline free - a - tip - b - fixed\n\
        observe force = force(tip)\nobserve compression = compression(tip)\nobserve velocity = velocity(b.left)\n\
        observe strain = velocity(a.at(1/2))";
    let wall = "mass m { mass = 2, velocity = 3 }\nTIP\nline free - m - tip - fixed\n\
        observe force = force(tip)\nobserve compression = compression(tip)\nobserve velocity = velocity(m)";
    let cases = [
        (bars, "stiffness = 40, exponent = 3/2", "3/2"),
        (bars, "stiffness = 40, exponent = 5/2", "3/4"),
        (bars, "stiffness = 3, exponent = 4/5", "3/4"),
        (WITH_MASSES, "stiffness = 4, exponent = 3/2", "3/2"),
        (wall, "stiffness = 5", "3/4"),
    ];
    for (text, law, time) in cases {
        let local = problem(&text.replace("TIP", &format!("hertz tip {{ {law} }}")));
        let proven: f64 =
            value(&local, "force", time, 15).split(' ').next().unwrap().parse().unwrap();
        let exact = local.time("time", time).unwrap().to_f64().unwrap();
        let tested = solved(&local, "force", &[exact])[0];
        assert!((proven - tested).abs() < 1e-11, "{law}: {proven} and {tested}");
    }
}

/// A mass between two local contacts: the one behind it is touched at first, and pressed by what the one before it
/// does, less than any precision tells. Values and instants against collocation.
#[test]
fn a_contact_is_pressed_by_another() {
    for (exponents, bar) in [(["3/2", "3/2"], "travel = 1/2"), (["5/4", "2"], "travel = 1/3")] {
        let problem = problem(&format!(
            "bar a {{ impedance = 1, travel = 1/2, velocity = 1 }}\n\
             hertz tip {{ stiffness = 40, exponent = {} }}\nmass m {{ mass = 1/4 }}\n\
             hertz tail {{ stiffness = 30, exponent = {} }}\nbar b {{ impedance = 1, {bar} }}\n\
             line free - a - tip - m - tail - b - free\nobserve force = force(tail)\n\
             observe before = compression(tip)\nobserve behind = compression(tail)\n\
             observe all = energy(line)",
            exponents[0], exponents[1],
        ));
        let proven = values(&problem, "force", &["1/8", "1/4"], 13);
        for (proven, tested) in proven.iter().zip(solved(&problem, "force", &[0.125, 0.25])) {
            let proven: f64 = proven.parse().unwrap();
            assert!((proven - tested).abs() < 1e-11, "{proven} and {tested}");
        }
        assert_eq!(value(&problem, "all", "1/8", 6), "0.250000");
        let history = problem.events_until("3/2", 6).unwrap();
        let opened =
            history.events.iter().filter(|event| event.kind == wavestep::EventKind::Opening);
        let opened: Vec<_> = opened.collect();
        assert_eq!(opened.len(), 2, "{:?}", history.events);
        for (event, name) in opened.iter().zip(["before", "behind"]) {
            let time = event.time.to_f64();
            let beside = solved(&problem, name, &[time - 1e-5, time + 1e-5]);
            assert!(beside[0] > 0.0 && beside[1] < 0.0, "{name} at {time}: {beside:?}");
        }
    }
}

/// The reflection from the far end presses again: force and instants of the second contact, within 10⁻¹².
#[test]
fn a_second_contact_is_that_of_collocation() {
    let problem = problem(
        "bar a { impedance = 1, travel = 1/2, velocity = 1 }\nhertz tip { stiffness = 40 }\n\
         bar b { impedance = 6/5, travel = 1 }\nline free - a - tip - b - fixed\n\
         observe force = force(tip)\nobserve compression = compression(tip)",
    );
    let history = problem.events_until("9/4", 13).unwrap();
    let [_, parted, met] = &history.events[..] else { panic!("{:?}", history.events) };
    let instants = [parted, met].map(|event| event.time.to_f64());
    let beside = instants.map(|time| [time - 1e-12, time + 1e-12]).concat();
    for pair in solved(&problem, "compression", &beside).chunks(2) {
        assert!(pair[0] * pair[1] < 0.0, "{instants:?}: {pair:?}");
    }
    let proven = value(&problem, "force", "9/4", 14).parse::<f64>().unwrap();
    let tested = solved(&problem, "force", &[2.25])[0];
    assert!((proven - tested).abs() < 1e-12 * 0.5, "{proven} and {tested}");
}

/// Two steel bars in SI units: the wave that returns presses the contact a second time. Instants within 10⁻¹⁶ s, forces
/// within 10⁻¹² of the largest.
#[test]
fn a_second_contact_of_steel_bars_is_that_of_collocation() {
    let problem = problem(
        "material steel { modulus = 210 GPa, density = 7850 kg/m^3 }\n\
         bar striker { material = steel, diameter = 20 mm, length = 300 mm, velocity = 10 m/s }\n\
         hertz nose { radius = 50 mm, material = steel, poisson = 3/10 }\n\
         bar struck { material = steel, diameter = 20 mm, length = 1000 mm }\n\
         line free - striker - nose - struck - fixed\n\
         observe force = force(nose)\nobserve compression = compression(nose)",
    );
    let events = problem.events_until("600us", 15).unwrap().events;
    let [_, parted, met, apart] = &events[..] else { panic!("{events:?}") };
    let instants = [parted, met, apart].map(|event| event.time.to_f64());
    let beside = instants.map(|time| [time - 1e-16, time + 1e-16]).concat();
    for pair in solved(&problem, "compression", &beside).chunks(2) {
        assert!(pair[0] * pair[1] < 0.0, "{instants:?}: {pair:?}");
    }
    let signal = problem.signal("force").unwrap();
    let largest = signal.extremum(Goal::Largest, "430us"..="562us", 15).unwrap();
    let wanted = largest.value.to_f64();
    let [Place::Critical(time)] = &largest.places[..] else { panic!("{:?}", largest.places) };
    let time = time.to_f64();
    let forces = solved(&problem, "force", &[time, time - 1e-8, time + 1e-8, 500e-6]);
    close(forces[0], wanted, 1e-12);
    // Nothing near it is larger: a step of 10 ns changes the force by less than 10⁻⁵ of it.
    for force in &forces[1..3] {
        assert!(*force < wanted && *force > wanted * (1.0 - 1e-5), "{force}");
    }
    let proven = signal.at("500us", 16).unwrap().to_f64();
    assert!((forces[3] - proven).abs() <= 1e-12 * wanted, "{} and {proven}", forces[3]);
}

/// Minus the gap, while the contact is open and after it has closed again, in every way that it is asked for.
#[test]
fn a_compression_is_minus_the_gap() {
    let problem = problem(
        "bar a { impedance = 1, travel = 1/2, velocity = 1 }\nhertz tip { stiffness = 40 }\n\
         bar b { impedance = 6/5, travel = 1 }\nline free - a - tip - b - fixed\n\
         observe compression = compression(tip)\nobserve moved = displacement(a.right) - displacement(b.left)",
    );
    let times = ["3/2", "7/4", "9/4"];
    let [one, other] = ["compression", "moved"].map(|name| values(&problem, name, &times, 20));
    assert_eq!(one, other);
    let proven: f64 = one[1].parse().unwrap();
    assert!(proven < -0.01, "{proven}");
    close(solved(&problem, "compression", &[1.75])[0], proven, 1e-12);
    let signal = problem.signal("compression").unwrap();
    for method in [Method::Certified, Method::Compiled] {
        close(signal.values_by(&["7/4"], method).unwrap().values[0], proven, 1e-14);
    }
    let events = problem.events_until("9/4", 12).unwrap().events;
    let zeros = signal.roots(0..=2, 12).unwrap().all;
    let [Root::End { .. }, Root::Arrival { time, before: true, after: true }] = &zeros[..] else {
        panic!("{zeros:?}")
    };
    close(time.to_f64(), events[1].time.to_f64(), 1e-11);
    let least = signal.extremum(Goal::Smallest, 0..=2, 12).unwrap().value.to_f64();
    assert!(least <= proven, "{least}");
    let least_moved = problem.signal("moved").unwrap();
    let least_moved = least_moved.extremum(Goal::Smallest, "3/2"..="2", 12).unwrap().value.to_f64();
    close(least, least_moved, 1e-12);
}

/// Where both bars are free the momentum is what it was; what is in the contact and in the bars is told by `events`.
#[test]
fn nothing_is_lost_between_free_bars() {
    let text = "bar a { impedance = 3, travel = 5/4, velocity = 1 }\nhertz tip { stiffness = 40 }\n\
        bar b { impedance = 1, travel = 1/2 }\nline free - a - tip - b - free";
    let history = problem(text).events(12).unwrap();
    let parted = history.events.last().unwrap();
    assert_eq!(parted.kind, wavestep::EventKind::Opening);
    let sum = |of: fn(&wavestep::Body) -> f64| parted.bodies.iter().map(of).sum::<f64>();
    let energy = sum(|body| body.energy.as_ref().unwrap().to_f64());
    let momentum = sum(|body| body.momentum.as_ref().unwrap().to_f64());
    assert!((energy - 3.75 / 2.0).abs() < 1e-11, "{energy}");
    assert!((momentum - 3.75).abs() < 1e-11, "{momentum}");
}

/// What a ball presses arrives at a contact between two bars, pushes it, and comes back from the far end as tension that parts
/// them: below all precision at first, but with a known sign. The first bar is at rest then, and the second has all momentum.
#[test]
fn a_local_contact_and_one_that_opens_are_followed() {
    let text = "mass ball { mass = 1/8, velocity = 1 }\nhertz tip { stiffness = 40 }\n\
        bar a { impedance = 1, travel = 3 }\nbar b { impedance = 1, travel = 2 }\n\
        line free - ball - tip - a | b - free\ncontacts open\nobserve F = force(tip)\n\
        observe e = energy(a)\nobserve p = momentum(b)\nobserve v = velocity(ball)\nobserve all = energy(line)\n";
    let ours = problem(text);
    let joined =
        problem(&text.replace("a | b", "a - b").replace("p = momentum(b)", "p = momentum(line)"));
    // The same force as of one bar, until the wave is back.
    let times = ["1/10", "1/2", "1", "3/2"];
    assert_eq!(values(&ours, "F", &times, 12), values(&joined, "F", &times, 12));
    let history = ours.history(Some(&rational("12")), 12).unwrap();
    assert_eq!(history.assumptions, [""; 0]);
    assert_eq!(history.contacts[1].durations.len(), 1);
    let [pressed, passed] = [0, 1].map(|contact| history.contacts[contact].impulses[0].to_f64());
    close(pressed, passed, 1e-12);
    assert_eq!(value(&ours, "e", "9", 12), "0");
    let late = |name| value(&ours, name, "12", 15).parse::<f64>().unwrap();
    close(late("p"), pressed, 1e-12);
    close(late("p") + late("v") / 8.0, 0.125, 1e-12);
    close(late("all"), 0.0625, 1e-12);
}

fn close(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance * wanted.abs(), "{found} and {wanted}");
}

/// The line holds what bars, masses and the contact do, `X α/(m+1)`, and loses nothing; what is held by the contact is
/// largest where its force is.
#[test]
fn a_contact_holds_energy() {
    let local = problem(
        "bar a { impedance = 3, travel = 5/4, velocity = 1 }\nhertz tip { stiffness = 40 }\n\
         bar b { impedance = 1, travel = 1/2 }\nline free - a - tip - b - free\n\
         observe all = energy(line)\nobserve held = energy(tip)\nobserve passed = energy(b)\n\
         observe total = energy(a) + energy(tip) + energy(b)\nobserve carried = momentum(b)\n\
         observe force = force(tip)\nobserve compression = compression(tip)",
    );
    let times = ["1/64", "1/4", "9/10"];
    let at = |name: &str| -> Vec<f64> {
        let values = values(&local, name, &times, 15).into_iter();
        values.map(|value| value.parse().unwrap()).collect()
    };
    for whole in [at("all"), at("total")].concat() {
        close(whole, 15.0 / 8.0, 1e-15);
    }
    let [held, forces, compressions] = ["held", "force", "compression"].map(at);
    for (held, (force, compression)) in held.iter().zip(forces.iter().zip(&compressions)) {
        close(*held, force * compression / 2.5, 1e-14);
    }
    let largest = |name: &str| {
        let found = local.signal(name).unwrap().extremum(Goal::Largest, "0"..="9/10", 15).unwrap();
        assert_eq!(found.places.len(), 1, "{name}: {:?}", found.places);
        found.value.to_f64()
    };
    let all = local.signal("all").unwrap().extremum(Goal::Largest, 0..=1, 9).unwrap().value;
    assert!(matches!(all, Value::Exact(_)) && all.to_f64() == 15.0 / 8.0, "{all:?}");
    let force = largest("force");
    close(largest("held"), force * (force / 40.0).powf(2.0 / 3.0) / 2.5, 1e-14);
    // What a bar at rest is given is the work of the force, and its impulse: by Simpson's rule.
    let times: Vec<Rational> = (0..=1_800).map(|i| Rational::new(i.into(), 2_000.into())).collect();
    let steps = Accuracy::Method(Method::Steps { tolerance: 1e-12 }, None);
    let forces = local.doubles("force", &times, Limit::Right, steps).unwrap().values;
    let simpson = |power: i32| {
        let weight = |i: usize| [2.0, 4.0][i % 2] - f64::from(u8::from(i == 0 || i == 1_800));
        let sum: f64 = (0..=1_800).map(|i| weight(i) * forces[i].powi(power)).sum();
        sum / 6_000.0
    };
    // No wave has returned, so that the velocity beside it is `X/Z`.
    close(at("passed")[2], simpson(2), 1e-5);
    close(at("carried")[2], simpson(1), 1e-5);
}

/// Two endless bars, `α' = 1 − 4 α^{3/2}`: the force `2 α^{3/2}` is 1/4 at `∫ dα/(1 − 4 α^{3/2})` up to 1/4, a series.
/// Near the touch it is below all precision, and not zero.
#[test]
fn roots_and_extrema_are_those_of_the_closed_form() {
    let local = problem(
        "bar a { impedance = 1, velocity = 1 }\nhertz tip { stiffness = 2 }\nbar b { impedance = 1 }\n\
         line endless - a - tip - b - endless\nobserve force = force(tip)\nobserve velocity = velocity(b.left)\n\
         observe pulled = velocity(b.left) - 1/2*velocity(a.right)",
    );
    let rises: f64 = (0..60).map(|k| 0.25 * 0.5_f64.powi(k) / (1.5 * f64::from(k) + 1.0)).sum();
    for name in ["force", "velocity"] {
        let signal = local.signal(name).unwrap();
        let found = signal.crossings("1/4", 0..=1, 15).unwrap().all;
        let [Root::Simple { time, rises: true }] = &found[..] else { panic!("{name}: {found:?}") };
        close(time.to_f64(), rises, 1e-14);
        let zeros = signal.roots(0..=1, 15).unwrap().all;
        let [Root::End { time }] = &zeros[..] else { panic!("{name}: {zeros:?}") };
        assert_eq!(time.to_string(), "0");
        let least = signal.extremum(Goal::Smallest, 0..=1, 15).unwrap();
        assert_eq!((least.value.to_string(), least.places.len()), ("0".to_owned(), 1));
        let largest = signal.extremum(Goal::Largest, 0..=1, 15).unwrap();
        assert_eq!(largest.value.to_f64(), signal.at(1, 17).unwrap().to_f64());
    }
    let found = local.signal("pulled").unwrap().roots(0..=2, 12).unwrap().all;
    assert!(matches!(&found[..], [Root::Simple { rises: true, .. }]), "{found:?}");
}

/// A contact that opens pushes until then, and has no force on an interval that begins with the event.
#[test]
fn a_force_is_zero_from_the_end_of_a_contact_on() {
    let local = problem(
        "bar a { impedance = 1, travel = 1/2, velocity = 1 }\nhertz tip { stiffness = 20 }\n\
         bar b { impedance = 1 }\nline free - a - tip - b - endless\nobserve force = force(tip)\n\
         observe velocity = velocity(b.left)\nobserve mirrored = -velocity(b.left)",
    );
    let parted = local.events(15).unwrap().events.last().unwrap().time.to_f64();
    for name in ["force", "velocity", "mirrored"] {
        let zeros = local.signal(name).unwrap().roots(0..=3, 15).unwrap().all;
        let [Root::End { .. }, Root::Interval { from, to, .. }] = &zeros[..] else {
            panic!("{name}: {zeros:?}")
        };
        close(from.to_f64(), parted, 1e-14);
        assert_eq!(to.to_string(), "3");
    }
}

/// A ball that falls on a rod with a fixed far end, and falls again.
const BALL: &str = "mass ball { mass = 1, velocity = 1 }\nhertz tip { stiffness = 4, exponent = 3/2 }\n\
    bar rod { impedance = 1/2, travel = 2 }\nload weight { force = 1/5 }\n\
    line free - weight - ball - tip - rod - fixed\nobserve force = force(tip)\n\
    observe compression = compression(tip)\nobserve displacement = displacement(ball)";

/// The spring that stands for a contact follows its stiffness, so that errors hardly grow while it is pressed: the
/// bits that do for the first contact do for later ones.
#[test]
fn a_contact_that_is_pressed_for_long_needs_no_more_bits() {
    let ball = problem(BALL);
    let history = ball.events_until(20, 12).unwrap();
    assert_eq!(history.bits, ball.events_until(1, 12).unwrap().bits);
    let instants: Vec<String> = history.events.iter().map(|event| event.time.to_string()).collect();
    assert_eq!(instants, ["0", "9.96522682338", "18.7073223504"]);
}

/// The instants at which a gap closes and opens are roots of the compression, and end the times without a force. A
/// displacement that is zero at the touch has no other root near it, though the force there is below the precision.
#[test]
fn contacts_begin_and_end_with_roots() {
    let ball = problem(
        &BALL.replace("bar rod { impedance = 1/2, travel = 2 }\n", "").replace("rod - ", ""),
    );
    let events = ball.events_until(20, 12).unwrap().events;
    let [_, opens, closes, ..] = &events[..] else { panic!("{events:?}") };
    let instants = [opens, closes].map(|event| event.time.to_string());
    let roots = |name: &str| ball.signal(name).unwrap().roots(0..=13, 12).unwrap().all;
    match &roots("compression")[..] {
        [
            Root::End { .. },
            Root::Arrival { time: opens, before: true, after: true },
            Root::Arrival { time: closes, before: true, after: true },
        ] => assert_eq!([opens, closes].map(|time| time.to_string()), instants),
        other => panic!("{other:?}"),
    }
    match &roots("force")[..] {
        [Root::End { .. }, Root::Interval { from, to, closed: true }] => {
            assert_eq!([from, to].map(|time| time.to_string()), instants);
        }
        other => panic!("{other:?}"),
    }
    let rises = problem(BALL).signal("displacement").unwrap().roots(0..=1, 12).unwrap();
    assert!(matches!(rises.all[..], [Root::End { .. }]), "{:?}", rises.all);
}

/// A bar that moves with the other, and one that moves away, are never pressed.
#[test]
fn what_does_not_meet_has_no_force() {
    for velocity in ["1", "2"] {
        let text = format!(
            "bar a {{ impedance = 3, travel = 5/4, velocity = 1 }}\nhertz tip {{ stiffness = 40 }}\n\
             bar b {{ impedance = 1, travel = 1/2, velocity = {velocity} }}\n\
             line free - a - tip - b - free\nobserve force = force(tip)"
        );
        assert_eq!(value(&problem(&text), "force", "2", 12), "0");
    }
}

/// `1/(1 + x)` is bounded near its cell, but its derivatives grow as factorials.
#[test]
fn rough_series_bound_values_and_derivatives() {
    let mut cut = Truncation::new(128, 0);
    cut.longest = Magnitude::power_of_two(-3);
    let roughness = Roughness::within(&Magnitude::power_of_two(-2), &cut);
    assert_eq!(roughness, Roughness::within(&Magnitude::power_of_two(-9), &cut).min(roughness));
    let mut norm = CellNorm::new(cut.longest, &cut);
    norm.roughness = Some(roughness);
    let signs = (0..12).map(|k| Number::integer(if k % 2 == 0 { 1 } else { -1 }));
    // What is left out is `x^12/(1 + x)`, of which the factor is at most 2 nearby.
    let rest = norm.of_term(12, &Magnitude::from_u64(2));
    let mut f = Series::new(signs.collect(), rest);
    f.roughness = Some(roughness);
    let x = Rational::new(1.into(), 16.into());
    let inverse = (Rational::from_integer(1.into()) + &x).recip();
    let mut exact = inverse.clone();
    let mut derivative = f;
    for order in 1..4_i64 {
        let told = derivative.value(&Number::Exact(x.clone()), &cut).ball(256);
        assert!(told.contains(&exact), "{order}");
        let start: Ball = derivative.start(0, &cut).ball(256);
        assert!(start.radius().to_double().is_finite(), "{order}");
        exact = -exact * &inverse * Rational::from_integer(order.into());
        derivative = derivative.derivative(&cut);
    }
    let shifted = derivative.shift(&Number::Exact(x), &cut);
    assert_eq!((shifted.rest, shifted.roughness), (derivative.rest, derivative.roughness));
    assert!(derivative.rest.to_double().to_f64().unwrap() > 0.0);
}

/// When a contact has opened, what both bars hold is what they had; the force came to zero at an irrational time, near which its
/// power is enclosed on ever shorter cells.
#[test]
fn energies_are_told_after_a_contact_has_opened() {
    let local = problem(
        "bar a { impedance = 1, travel = 1, velocity = 1 }\nhertz tip { stiffness = 4 }\n\
         bar b { impedance = 1, travel = 2 }\nline free - a - tip - b - free\n\
         observe all = energy(line)\nobserve left = energy(a)\nobserve right = energy(b)",
    );
    let times = ["9/2", "7"];
    let at = |name: &str| -> Vec<f64> {
        values(&local, name, &times, 9).iter().map(|value| value.parse().unwrap()).collect()
    };
    let [all, left, right] = ["all", "left", "right"].map(at);
    for ((all, left), right) in all.into_iter().zip(left).zip(right) {
        close(all, 1.0 / 2.0, 1e-9);
        close(left + right, 1.0 / 2.0, 1e-8);
        assert!(left > 1e-3 && left < 1e-1, "{left}");
    }
}
