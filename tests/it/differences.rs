//! How far a scene is from a simpler one: the proven distance against samples, and instants that are one in both.

use std::collections::BTreeSet;
use wavestep::planner::Purpose;
use wavestep::problem::Size;
use wavestep::signal::{Search, Signal};
use wavestep::{Goal, Place, Problem, Root, Value};
use wavestep_polynomial::Rational;

const ROD: &str = "scene \"A mass on a fixed rod\"\nsymbol mu > 0\nbar rod { impedance = 1, travel = 1 }\n\
    mass m { mass = 1/mu, velocity = 1 }\nline free - m - rod - fixed\nobserve v = velocity(m)";

/// The rod as a spring, and a third of its mass moving with the other.
const THIRD: &str = "scene \"A third of its mass\"\nsymbol mu > 0\nspring rod { stiffness = 1 }\n\
    mass m { mass = 1/mu + 1/3, velocity = 1/(1 + mu/3) }\nline free - m - rod - fixed\nobserve v = velocity(m)";

fn read(text: &str, mu: &str) -> Problem {
    Problem::read("test.wave", text).unwrap().with("mu", mu).unwrap()
}

/// Asks the difference of a quantity on a window that begins at 0.
fn ask<T>(
    [own, other]: [&Problem; 2],
    name: &str,
    to: Rational,
    ask: impl FnOnce(&dyn Signal) -> T,
) -> T {
    let (wanted, from) = (own.wanted(name).unwrap(), Rational::default());
    ask(&*own.difference_on(other, &wanted, [&from, &to], Purpose::Search).unwrap())
}

fn extremes(problems: [&Problem; 2], name: &str, to: Rational) -> [Value; 2] {
    ask(problems, name, to, |signal| {
        let search = Search::new(signal).unwrap();
        [Goal::Smallest, Goal::Largest]
            .map(|goal| search.extremum(goal, 12, 1 << 12).unwrap().value)
    })
}

fn whole(number: i64) -> Rational {
    Rational::from_integer(number.into())
}

/// The largest differences hold all samples, and are hardly larger than the largest of these.
#[test]
fn a_distance_is_that_of_samples() {
    for mu in ["1/100", "1/10", "1", "10"] {
        let [rod, third] = [ROD, THIRD].map(|text| read(text, mu));
        let [least, most] = extremes([&rod, &third], "v", whole(12)).map(|value| value.to_f64());
        let times: Vec<f64> = (0..=120_000).map(|i| f64::from(i) / 1e4).collect();
        let values = [&rod, &third].map(|problem| {
            let found = problem.signal("v").unwrap().values(&times, "abs:1e-12".parse().unwrap());
            found.unwrap().values
        });
        let differences = values[0].iter().zip(&values[1]).map(|(own, other)| own - other);
        let ends = differences.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], own| {
            [low.min(own), high.max(own)]
        });
        assert!(
            least <= ends[0] + 2e-12 && ends[1] - 2e-12 <= most,
            "{mu}: {least} {most} {ends:?}"
        );
        assert!(ends[0] - least < 1e-6 && most - ends[1] < 1e-6, "{mu}: {least} {most} {ends:?}");
    }
}

/// The same motion in two scales: the difference is zero to all digits, and their breaks are one.
#[test]
fn a_scene_is_no_distance_from_itself() {
    let other = ROD.replace("impedance = 1", "impedance = 7").replace("1/mu", "7/mu");
    let [rod, other] = [ROD, &other].map(|text| read(text, "2/3"));
    for value in extremes([&rod, &other], "v", whole(7)) {
        assert!(value.to_f64().abs() < 1e-30, "{value:?}");
    }
    let counts = [[&rod, &other], [&rod, &rod]]
        .map(|both| ask(both, "v", whole(7), |signal| signal.count().unwrap()));
    assert_eq!(counts, [4; 2]);
}

/// A gap is closed in both scenes at one time, a root that no name shows to be one: the instants are taken for one.
#[test]
fn instants_of_two_scenes_may_be_one_root() {
    let text = "scene \"Pushed across a gap\"\nload push { force = 1 }\nmass m { mass = 1 }\n\
        bar rod { impedance = 1, travel = 1 }\nline free - push - m |1/3| rod - free\ncontacts open\n\
        observe v = velocity(m)";
    let stiff = text.replace("impedance = 1", "impedance = 2");
    let problems = [text, &stiff].map(|text| Problem::read("test.wave", text).unwrap());
    let [_, most] = extremes([&problems[0], &problems[1]], "v", whole(2)).map(|own| own.to_f64());
    // From v = t there it is drawn to 1/Z.
    let closed = (2.0_f64 / 3.0).sqrt();
    let [own, other] =
        [1.0_f64, 2.0].map(|z| (closed - 1.0 / z) * (-z * (2.0 - closed)).exp() + 1.0 / z);
    assert!((most - (own - other)).abs() < 1e-12, "{most} {own} {other}");
}

/// With units the times of echoes are no rational numbers; those of the same bars are still one break.
#[test]
fn breaks_of_the_same_bars_are_one() {
    let text = include_str!("../../scenes/hopkinson.wave");
    let own = Problem::read("hopkinson.wave", text).unwrap();
    let softer = text.replace("stiffness = 40 kN/mm", "stiffness = 30 kN/mm");
    assert_ne!(text, softer);
    let softer = Problem::read("softer.wave", softer).unwrap();
    let to = Rational::new(1.into(), 2000.into());
    let stretches = |both| ask(both, "force", to.clone(), |signal| signal.count().unwrap());
    assert_eq!(stretches([&own, &softer]), stretches([&own, &own]));
    let [least, most] = extremes([&own, &softer], "force", to).map(|value| value.to_f64());
    assert!(least <= 0.0 && most > 1000.0, "{least} {most}");
}

/// What no difference is asked of is told.
#[test]
fn what_has_no_difference_is_told() {
    let told = |other: Problem| {
        let rod = read(ROD, "1");
        let (wanted, window) = (rod.wanted("v").unwrap(), [&whole(0), &whole(1)]);
        let found = rod.difference_on(&other, &wanted, window, Purpose::Search);
        wavestep::Error::from(found.err().expect("they have no difference")).to_string()
    };
    let spring = read(&THIRD.replace("observe v", "observe w"), "1");
    assert!(told(spring).contains("neither a wave nor an observable of \"A third of its mass\""));
    let with_units = Problem::read(
        "units.wave",
        "scene \"U\"\nbar rod { impedance = 1 kg/s, travel = 1 s }\nmass m { mass = 1 kg, velocity = 1 m/s }\n\
         line free - m - rod - fixed\nobserve v = velocity(m)",
    );
    assert!(told(with_units.unwrap()).contains("has another unit"));
}

/// Until the contact opens the difference is `−2 (t − 2) e^(2 − t)`, flat where it is largest: at 3, where a wave arrives.
/// That its slope is zero there no ball tells, but how large it is at most.
#[test]
fn an_extremum_beside_a_flat_end_has_all_digits() {
    let own = Problem::builtin("saint-venant").unwrap().with("mu", 1).unwrap();
    let other = own.simpler(&"endless:rod.right".parse().unwrap()).unwrap();
    let wanted = own.wanted("velocity").unwrap();
    let (from, digits) = (Rational::default(), 30);
    for to in [3, 4].map(|to| Rational::from_integer(to.into())) {
        let signal = own.difference_on(&other, &wanted, [&from, &to], Purpose::Search).unwrap();
        let found = Search::new(&*signal).unwrap().extremum(Goal::Smallest, digits, 1 << 12);
        let found = found.unwrap();
        assert_eq!(found.value.to_string(), "-0.735758882342884643191047540323"); // −2/e
        // On both sides of the arrival, where there are two.
        let three = Rational::from_integer(3.into());
        let [Place::Undecided { from, to: last }] = &found.places[..] else { panic!("{found:?}") };
        assert!(*from < three && (if to > three { three < *last } else { three == *last }));
        assert!(last - from < Rational::new(1.into(), 1_000_000_000_000_i64.into()), "{found:?}");
    }
}

/// Where the slope at the middle of what is left stays undecided, that beside it is not.
#[test]
fn an_extremum_at_the_middle_of_an_interval_has_all_digits() {
    let own = Problem::builtin("struck-free-bar").unwrap().with("mu", 1).unwrap();
    let other = own.simpler(&"endless:rod.right".parse().unwrap()).unwrap();
    let wanted = own.wanted("velocity").unwrap();
    let (from, to) = (Rational::default(), Rational::from_integer(4.into()));
    let signal = own.difference_on(&other, &wanted, [&from, &to], Purpose::Search).unwrap();
    let found = Search::new(&*signal).unwrap().extremum(Goal::Largest, 9, 1 << 12).unwrap();
    assert!(matches!(found.value, Value::Certified { .. }), "{:?}", found.value);
    assert!(!found.places.iter().any(|place| matches!(place, Place::Undecided { .. })));
}

/// Two bars that part at `t = 2`, or stay together: behind the third bar, nothing is felt before `t = 4`, nor at once then.
#[test]
fn a_difference_that_is_zero_until_a_wave_comes_is_told_once() {
    let text = "scene \"Two bars\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
        bar b { impedance = 2, travel = 1 }\nspring s { stiffness = 1 }\nbar c { impedance = 2, travel = 3 }\n\
        bar d { impedance = 2 }\nline free - a | b - s - c - d - endless\ncontacts open\n\
        observe g = force(d.left)";
    let open = Problem::read("open.wave", text).unwrap();
    let closed = open.simpler(&"closed".parse().unwrap()).unwrap();
    let (wanted, window) = (open.wanted("g").unwrap(), [&whole(0), &whole(4)]);
    let signal = open.difference_on(&closed, &wanted, window, Purpose::Search).unwrap();
    let size = Size::of(&*signal, (12, 1 << 12), &Rational::default()).unwrap();
    assert_eq!(size.bounds, [whole(0), whole(0)]);
    let told: Vec<String> = size.places.iter().map(|place| format!("{place:?}")).collect();
    let distinct: BTreeSet<&String> = told.iter().collect();
    assert_eq!(distinct.len(), told.len(), "{told:?}");
}

/// Of two loads on an endless bar: the velocities differ by `(t − 1)²/2` from `t = 0` on, which is zero at 1 alone.
#[test]
fn a_difference_that_touches_zero_is_decided() {
    let scene = |force: &str| {
        let text = format!(
            "scene \"Two loads\"\nbar west {{ impedance = 1 }}\nbar east {{ impedance = 1 }}\n\
             load p {{ force = {force} }}\nline endless - west - p - east - endless\n\
             observe v = velocity(east.left)"
        );
        Problem::read("loads.wave", text).unwrap()
    };
    let (own, other) = (scene("exp(-t) + t^2"), scene("exp(-t) + 2*t - 1"));
    ask([&own, &other], "v", whole(2), |signal| {
        let search = Search::new(signal).unwrap();
        let found = search.roots(&Rational::default(), 12, 1 << 12).unwrap().all;
        assert_eq!(found, [Root::Double { time: Value::Exact(whole(1)) }]);
        let least = search.extremum(Goal::Smallest, 12, 1 << 12).unwrap();
        assert_eq!((least.value, least.places.len()), (Value::Exact(whole(0)), 1));
    });
}

/// A line and its equations, as a text states them, are one; delay equations with other rates are not.
#[test]
fn stated_equations_are_compared() {
    let [line, stated] = ["mass-on-fixed-bar", "rigid-mass"]
        .map(|scene| Problem::builtin(scene).unwrap().with("mu", "1").unwrap());
    let eight = Rational::from_integer(8.into());
    for pair in [[&line, &stated], [&stated, &line], [&stated, &stated]] {
        let found = extremes(pair, "velocity", eight.clone());
        assert_eq!(found.map(|value| value.to_string()), ["0", "0"]);
    }
    let delayed = |rate: u32| {
        let text = format!(
            "recurrence \"Delayed\"\nperiod 1, local s, time t\nwave x\n\
             equation x[n]' = -{rate}*x[n-1]\ncontinuous x[n] starts at 1\n"
        );
        Problem::read("delayed.wave", text).unwrap()
    };
    // Until 1 both are 1, then 1 - 2 s and 1 - 3 s, then -1 - 2 s + 2 s² and -2 - 3 s + 9/2 s².
    let [_, largest] = extremes([&delayed(2), &delayed(3)], "x", Rational::from_integer(3.into()));
    // s = 1/5 is where 1 + s - 5/2 s² is largest.
    assert_eq!(largest.to_string(), "11/10");
}

/// Work is continuous, and so is its difference from that without a trap: a plateau is attained at both ends, and is one place.
#[test]
fn a_difference_of_what_is_continuous_is_attained() {
    let bars = "scene \"A\"\nbar a { impedance = 1, travel = 1/5, velocity = 2 }\nbar b { impedance = 1, travel = 1 }\n";
    let [trapped, bare] = ["| b |1/10| c", "| b"].map(|line| {
        let trap = if line.contains('c') { "bar c { impedance = 1, travel = 3/10 }\n" } else { "" };
        let text = format!(
            "{bars}{trap}line free - a {line} - free\ncontacts open\nobserve w = work(b.at(1/50))"
        );
        Problem::read("test.wave", text).unwrap()
    });
    ask([&trapped, &bare], "w", whole(3), |signal| {
        let search = Search::new(signal).unwrap();
        let found = search.extremum(Goal::Largest, 12, 1 << 12).unwrap();
        let [Place::Plateau { from, to, closed: true }] = &found.places[..] else {
            panic!("{:?}", found.places)
        };
        let told = [from, to].map(|time| time.to_text(4));
        assert_eq!(told, ["2.07 = 207/100", "2.38 = 119/50"]);
    });
}
