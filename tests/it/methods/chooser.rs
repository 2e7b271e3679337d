//! The chooser: the cheapest way that is proven to be good enough, and none that is not.

use crate::methods::subject::with;
use crate::methods::tally::{Tally, ends};
use crate::methods::{Values, exact, random, ratio, times, unit_in_the_last_place};
use proptest::prelude::RngExt as _;
use wavestep::answer::{
    Cost, Costs, InvalidCosts, Method, Promise, Question, Size, Tolerance, Verdict, Way, WayError,
    Weighed, Work, consider,
};
use wavestep::problem::Problem;
use wavestep::signal::{Limit, StablePrecision};

/// Problems of all kinds: on a grid with one pole, with several, in units, and on a lattice.
const PROBLEMS: [(&str, Values<'static>, &str, &str); 5] = [
    ("rigid-mass", &[("mu", "1")], "velocity", "12"),
    ("rigid-mass", &[("mu", "1/100")], "f", "1/4"),
    ("struck-free-bar", &[("mu", "2")], "middle_force", "14"),
    ("stepped-striker", &[], "pulse", "8"),
    ("incommensurate", &[], "wall_force", "1/4000"),
];

/// Whether the table of costs and the promises single out the way that is picked.
fn is_cheapest(problem: &Question<'_>, weighed: &Weighed, points: usize, tolerance: f64) {
    let proven = |promise: &Option<Promise>| matches!(promise, Some(Promise::Proven(bound)) if *bound <= tolerance);
    let good: Vec<_> = weighed.candidates.iter().filter(|c| proven(&c.promise)).collect();
    assert_eq!(weighed.met, !good.is_empty());
    assert_eq!(weighed.candidates.len(), 7, "every method is weighed");
    assert!(problem.order().unwrap() < 1000);
    if let Some(least) = good.iter().map(|c| c.seconds).min_by(f64::total_cmp) {
        let first = &weighed.candidates[0];
        assert!(proven(&first.promise), "{first:?}");
        assert_eq!(first.seconds, least, "{points} points: {first:?}");
        assert_eq!(first.verdict, Verdict::Picked);
        assert!(
            matches!(
                first.method,
                Method::Certified | Method::Compiled | Method::Marched { proven: true }
            ),
            "{first:?}"
        );
    }
    for candidate in &weighed.candidates[1..] {
        assert_ne!(candidate.verdict, Verdict::Picked);
    }
}

#[test]
fn what_is_picked_is_the_cheapest_that_is_proven() {
    let mut random = random(71);
    let mut weighed_problems = 0;
    let mut many = Vec::new();
    for (scene, values, quantity, last) in PROBLEMS {
        with(scene, values, quantity, ("0", last), |subject| {
            let (problem, scale) = (&subject.question, subject.scale());
            for _ in 0..60 {
                let tolerance = scale * 10f64.powf(random.random_range(-19.0..0.0));
                let points = 10f64.powf(random.random_range(0.0..6.0)) as usize;
                let weighed = consider(problem, points, tolerance, scale).unwrap();
                is_cheapest(problem, &weighed, points, tolerance);
                weighed_problems += 1;
            }
            // Nothing is nearer than half a unit in the last place.
            let unit = unit_in_the_last_place(scale);
            let met = |tolerance: f64| consider(problem, 10, tolerance, scale).unwrap().met;
            assert!(met(0.5 * unit) && met(unit) && !met(0.49 * unit));
            let first = |points, tolerance: f64| {
                consider(problem, points, tolerance, scale).unwrap().candidates[0].method
            };
            assert_eq!(first(1_000_000, 0.6 * unit), Method::Certified);
            many.push(first(1_000_000, 4.0 * unit));
            assert_eq!(first(1, 4.0 * unit), Method::Certified);
        });
    }
    println!("chooser: {weighed_problems} problems weighed, many values by {many:?}");
    // Pieces are worked out once, and each value costs less then.
    assert!(many.iter().all(|method| *method == Method::Compiled), "{many:?}");
}

/// A way made for a tolerance keeps it, for tolerances and numbers of points at random.
#[test]
fn tolerances_are_kept() {
    let mut random = random(72);
    let mut tally = Tally::new("ways by tolerance, of the tolerance");
    let mut methods = std::collections::BTreeSet::new();
    for (scene, values, quantity, last) in PROBLEMS {
        with(scene, values, quantity, ("0", last), |subject| {
            let (problem, scale) = (&subject.question, subject.scale());
            for _ in 0..6 {
                let tolerance = scale * 10f64.powf(random.random_range(-15.0..-1.0));
                let points = 10f64.powf(random.random_range(0.0..6.0)) as usize;
                let weighed = consider(problem, points, tolerance, scale).unwrap();
                assert!(weighed.met);
                let method = weighed.candidates[0].method;
                let way = Way::new(method, problem, Some(tolerance)).unwrap();
                methods.insert(way.method().to_string());
                let bound = way.bound().expect("what is picked is proven");
                // The bound of certified values is beyond the rounding of the result.
                let rounding = unit_in_the_last_place(scale) / 2.0;
                assert!(bound <= tolerance && rounding <= tolerance, "{method} {tolerance:e}");
                let mut at = times::special(subject);
                at.truncate(30);
                at.extend(times::anywhere(subject, &mut random, 20));
                let values = way.values(&at).unwrap();
                for (time, value) in at.iter().zip(values) {
                    let enclosed = ends(&subject.exact(&exact(*time), Limit::Right));
                    let place = || format!("{time:?} by {method} in {}", subject.name);
                    tally.within(value, enclosed, &exact(tolerance), place);
                }
                let exact_times: Vec<_> = at.iter().map(|time| exact(*time)).collect();
                let values = way.exact_values(&exact_times, Limit::Left).unwrap();
                for (time, value) in exact_times.iter().zip(values) {
                    let enclosed = ends(&subject.exact(time, Limit::Left));
                    let place = || format!("{time} on the left by {method} in {}", subject.name);
                    tally.within(value, enclosed, &exact(tolerance), place);
                }
            }
        });
    }
    println!("ways taken: {methods:?}");
    assert!(methods.contains("certified") && methods.contains("compiled"), "{methods:?}");
    tally.report(1_000);
}

/// Few values come cheapest without preparation, many with it; pairs of doubles cost more a value; a march of
/// more waves costs more.
#[test]
fn costs_follow_what_is_done() {
    let size = Size { order: 200, points: 1, marches: false, followed: false };
    let costs = Costs::default();
    let cost = |name: &str| Cost::of(name.parse().unwrap(), size, &costs).unwrap();
    let (certified, compiled) = (cost("certified"), cost("compiled"));
    assert!(certified.seconds(1) < compiled.seconds(1));
    assert!(compiled.seconds(1_000_000) < certified.seconds(1_000_000));
    let (stable, pairs) = (cost("stable"), cost("double-double"));
    assert!(pairs.point > stable.point && stable.setup == 0.0 && pairs.setup == 0.0);
    // What has been followed needs no echoes: values cost the same however many arrivals there are.
    let followed = |order| {
        let size = Size { order, followed: true, ..size };
        Cost::of("certified".parse().unwrap(), size, &costs).unwrap()
    };
    assert!(followed(5000) == followed(50) && followed(5000).setup == 0.0);
    assert!(Cost::of_waves(size, 2, &costs).setup < Cost::of_waves(size, 20, &costs).setup);
    assert_eq!(Cost { setup: 1.0, point: 0.5 }.seconds(4), 3.0);
}

/// The table that is compiled in is such a file, and another one changes what is picked.
#[test]
fn costs_are_read_from_files() {
    let built_in = Costs::default();
    let text = built_in.text();
    let file = &format!("{}/src/answer/costs.txt", crate::ROOT);
    assert_eq!(std::fs::read_to_string(file).unwrap(), text);
    assert_eq!(Costs::read(&text, &built_in.source), Ok(built_in.clone()));
    let dear = Costs::measured("here", |work| match work {
        Work::Ball => 1e3,
        other => built_in.of(other),
    });
    assert_eq!(Costs::read(&dear.text(), "here"), Ok(dear.clone()));
    let mut problem = Problem::builtin("stepped-striker").unwrap();
    let first = |problem: &Problem| {
        let question = problem.question("pulse", [ratio(0, 1), ratio(8, 1)]).unwrap();
        let weighed = consider(&question, 1, 1e-6, 1.0).unwrap();
        (weighed.candidates[0].method, weighed.costs)
    };
    assert_eq!(first(&problem), (Method::Certified, "the built-in table".to_owned()));
    problem.weigh_by(dear);
    assert_eq!(first(&problem), (Method::Compiled, "here".to_owned()));
}

#[test]
fn files_that_hold_no_costs_are_refused() {
    let text = Costs::default().text();
    let line = |name: &str| text.lines().find(|line| line.starts_with(name)).unwrap().to_owned();
    let without = |name: &str| text.replace(&format!("{}\n", line(name)), "");
    let instead = |new: &str| text.replace(&line("ball"), new);
    for (text, error) in [
        (String::new(), InvalidCosts::Header),
        (text.replace("costs 1", "costs 2"), InvalidCosts::Header),
        (without("wave "), InvalidCosts::Missing(13, "wave")),
        (instead("bal 1 s"), InvalidCosts::Name(4, "bal".to_owned())),
        (instead("ball 0 s"), InvalidCosts::Number(4, "ball".to_owned())),
        (instead("ball nan s"), InvalidCosts::Number(4, "ball".to_owned())),
        (instead("ball inf s"), InvalidCosts::Number(4, "ball".to_owned())),
        (instead("ball 1"), InvalidCosts::Number(4, "ball".to_owned())),
        (instead("ball 1 ms"), InvalidCosts::Number(4, "ball".to_owned())),
        (instead("step 1 s"), InvalidCosts::Again(10, "step".to_owned())),
    ] {
        assert_eq!(Costs::read(&text, "a file"), Err(error), "{text}");
    }
}

#[test]
fn tolerances_are_read_as_they_are_documented() {
    let mut random = random(73);
    for _ in 0..1000 {
        let scale = 10f64.powf(random.random_range(-290.0..290.0));
        let number = 10f64.powf(random.random_range(-8.0..3.0));
        let read = |text: String| text.parse::<Tolerance>().unwrap().absolute(scale);
        assert_eq!(read(format!("{number:e}")), number * scale);
        assert_eq!(read(format!("abs:{number:e}")), number);
        assert_eq!(read(format!("ulp:{number:e}")), number * unit_in_the_last_place(scale));
    }
    for text in ["", "0", "-1e-9", "nan", "inf", "1e-9%", "ulp:", "ulp:-1", "rel:1e-9", "1e999"] {
        let error = text.parse::<Tolerance>().unwrap_err();
        assert_eq!(error.to_string(), format!("`{text}` is not a tolerance"));
    }
}

#[test]
fn every_method_is_named_as_it_is_read() {
    for (name, about) in Method::NAMES {
        let bare = name.split(':').next().unwrap();
        let method: Method = bare.parse().unwrap();
        assert_eq!(method.name(), bare);
        assert_eq!(method.to_string().parse::<Method>(), Ok(method));
        assert_eq!(method.setting().is_empty(), !name.contains(':'), "{name}");
        let size = Size { order: 50, points: 10, marches: true, followed: false };
        let cost = Cost::of(method, size, &Costs::default());
        assert_eq!(cost.is_none(), about.starts_with("model: "), "{name}");
    }
    for text in ["modes:", "modes:-1", "leapfrog:4,x", "steps:tight", "compiled:3"] {
        let error = text.parse::<Method>().unwrap_err().to_string();
        let (name, setting) = text.split_once(':').unwrap();
        assert_eq!(error, format!("`{setting}` is not a setting of {name}"));
    }
}

/// Forced ways say what they cannot do.
#[test]
fn models_have_their_limits() {
    with("rigid-mass", &[("mu", "1")], "f", ("0", "4"), |subject| {
        let refused = Way::new(Method::Modes { count: 10 }, &subject.question, None).err();
        assert_eq!(refused, Some(WayError::NeedsScene("modes")));
    });
    with("mass-on-fixed-bar", &[("mu", "1")], "velocity", ("0", "4"), |subject| {
        let way = Way::new(Method::Modes { count: 10 }, &subject.question, None).unwrap();
        assert_eq!(way.bound(), None);
        let left = way.value(&exact(2.0), Limit::Left);
        assert_eq!(left, Err(WayError::LeftLimit("modes")));
        assert!(way.value(&exact(2.0), Limit::Right).is_ok());
        for precision in [StablePrecision::Double, StablePrecision::DoubleDouble] {
            let way = Way::new(Method::Stable(precision), &subject.question, None).unwrap();
            assert!(way.bound().is_none() && way.law().contains("measured"));
        }
    });
}
