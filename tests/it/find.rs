//! Certified roots and extrema: known ones, and against values taken one by one.

use num_rational::BigRational;
use num_traits::Signed as _;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use wavestep::language::{Source, parse_number, read_recurrence, read_scene};
use wavestep::network::Network;
use wavestep::scenes;
use wavestep::signal::{
    ClosedSignal, EvaluateError, Extremum, Goal, Limit, Place, Root, Search, Value, digits,
};
use wavestep::solution::Solution;

const BITS: u64 = 1 << 12;

fn number(text: &str) -> BigRational {
    parse_number(text).unwrap()
}

/// A recurrence, built in or written out, with values for its symbols.
fn solution(scene: &str, values: &[(&str, &str)]) -> Solution {
    let text = scenes::find(scene).map_or(scene, |scene| scene.text);
    let values = values.iter().map(|(name, value)| ((*name).to_owned(), number(value))).collect();
    Solution::new(read_recurrence(&Source::new("scene", text).unwrap(), &values).unwrap())
}

/// A recurrence in which only functions of time are seen.
fn of_time(function: &str) -> Solution {
    solution(
        &format!(
            "recurrence \"Function\"\nperiod 2, local s, time t\nwave f\nequation f[n] = f[n-1]\n\
             observe q = f[n] + {function}\n"
        ),
        &[],
    )
}

fn roots(solution: &Solution, quantity: &str, window: [&str; 2], level: &str) -> Vec<Root> {
    let observation = solution.recurrence().observation(quantity).unwrap();
    let [from, to] = window.map(number);
    let signal = ClosedSignal::of_recurrence(solution, &observation, [&from, &to]).unwrap();
    let search = Search::new(&signal).unwrap();
    search.roots(&number(level), 20, BITS).unwrap().all
}

fn extremum(solution: &Solution, quantity: &str, window: [&str; 2], goal: Goal) -> Extremum {
    let observation = solution.recurrence().observation(quantity).unwrap();
    let [from, to] = window.map(number);
    let signal = ClosedSignal::of_recurrence(solution, &observation, [&from, &to]).unwrap();
    let search = Search::new(&signal).unwrap();
    search.extremum(goal, 20, BITS).unwrap()
}

/// A number, to the digits that are known of it.
fn rational(found: &Value) -> BigRational {
    match found {
        Value::Exact(value) => value.clone(),
        other => other.decimal(40).0.to_rational(),
    }
}

fn exactly(text: &str) -> Value {
    Value::Exact(number(text))
}

/// The sign of a value less a level, by echoes that are added up exactly.
fn sign(signal: &ClosedSignal<'_>, at: &BigRational, level: &BigRational) -> Ordering {
    value(signal, at).cmp(level)
}

fn value(signal: &ClosedSignal<'_>, at: &BigRational) -> BigRational {
    match digits(signal, at, Limit::Right, 30, BITS).unwrap() {
        Value::Exact(value) => value,
        other => other.decimal(30).0.to_rational(),
    }
}

// ---- Known roots --------------------------------------------------------------------------------

/// The mass leaves the bar at `3 + e^{-2}/2`; `e^{-2}` is `f(2−)`.
#[test]
fn the_mass_leaves_when_the_formula_says() {
    let solution = solution("rigid-mass", &[("mu", "1")]);
    let observation = solution.recurrence().observation("strain_impact").unwrap();
    let window = [number("2"), number("7/2")];
    let signal = ClosedSignal::of_recurrence(&solution, &observation, [&window[0], &window[1]]);
    let signal = signal.unwrap();
    let search = Search::new(&signal).unwrap();
    let f = solution.recurrence().observation("f").unwrap();
    let f = ClosedSignal::of_recurrence(&solution, &f, [&window[0], &window[1]]).unwrap();
    for count in [1, 5, 17, 60, 300] {
        let found = search.roots(&number("0"), count, BITS).unwrap().all;
        let [Root::Simple { time, rises: true }] = &found[..] else {
            panic!("{found:?}");
        };
        let e = digits(&f, &number("2"), Limit::Left, count + 10, BITS).unwrap();
        let exact = number("3") + e.decimal(count + 10).0.to_rational() / number("2");
        assert!(!matches!(time, Value::Enclosed(_)), "{found:?}");
        let (told, _) = time.decimal(count);
        let (wanted, _) = wavestep::ball::Decimal::from_rational(&exact, count);
        assert_eq!(told.to_string(), wanted.to_string());
    }
}

#[test]
fn rational_roots_are_exact_and_arrivals_are_told() {
    let cubic = of_time("(t - 1)*(t - 2)*(t - 5/2)");
    let found = roots(&cubic, "q", ["0", "3"], "0");
    let simple = |time, rises| Root::Simple { time: exactly(time), rises };
    let arrival = Root::Arrival { time: exactly("2"), before: true, after: true };
    assert_eq!(found, [simple("1", true), arrival, simple("5/2", true)]);
    // Windows that begin and end at roots hold these, once each.
    let found = roots(&cubic, "q", ["1", "5/2"], "0");
    let end = |time| Root::End { time: exactly(time) };
    let arrival = Root::Arrival { time: exactly("2"), before: true, after: true };
    assert_eq!(found, [end("1"), arrival, end("5/2")]);
    assert_eq!(roots(&cubic, "q", ["11/10", "19/10"], "0"), []);
    // ln 2 and ln 3, with a level.
    let sum = of_time("exp(-2*t)");
    let found = roots(&sum, "q", ["0", "5"], "1/9");
    let [Root::Simple { time, rises: false }] = &found[..] else { panic!("{found:?}") };
    assert_eq!(time.to_text(20), "1.0986122886681096914");
    // Cosines have complex rates.
    let found = roots(&of_time("cos(3*t)"), "q", ["0", "3"], "0");
    let times: Vec<String> = found
        .iter()
        .map(|root| match root {
            Root::Simple { time, .. } => time.to_text(20),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(times, ["0.52359877559829887308", "1.5707963267948966192", "2.6179938779914943654"]); // pi/6, pi/2, 5 pi/6
}

/// Two roots closer than cells are cut are not taken for one, nor a root for the fraction beside
/// it.
#[test]
fn near_misses_are_kept_apart() {
    let near = roots(&of_time("(t - 1/3 - 1e-30)*(t + 1)"), "q", ["0", "1"], "0");
    let [Root::Simple { time, .. }] = &near[..] else { panic!("{near:?}") };
    assert_eq!(time.to_text(20), "0.33333333333333333333");
    let found = roots(&of_time("(t - 2)*(t - 2 - 1e-20)"), "q", ["0", "3"], "0");
    let arrival = Root::Arrival { time: exactly("2"), before: true, after: true };
    let [first, Root::Undecided { from, to, .. }] = &found[..] else { panic!("{found:?}") };
    assert_eq!(*first, arrival);
    assert!(*from == number("2") && *to > number("2 + 1e-20") && *to < number("2 + 1e-15"));
    // After many periods, where pieces need far more bits than at first.
    let rigid = solution("rigid-mass", &[("mu", "1")]);
    let f = rigid.recurrence().observation("f").unwrap();
    let window = [number("400"), number("402")];
    let f = ClosedSignal::of_recurrence(&rigid, &f, [&window[0], &window[1]]).unwrap();
    let found = roots(&rigid, "f", ["400", "402"], "0");
    assert!(found.len() > 1);
    for root in &found {
        let Root::Simple { time, .. } = root else { continue };
        let time = rational(time);
        let sides =
            [number("-1e-16"), number("1e-16")].map(|by| sign(&f, &(&time + by), &number("0")));
        assert_ne!(sides[0], sides[1]);
    }
    assert!(!found.iter().any(|root| matches!(root, Root::Undecided { .. })), "{found:?}");
}

/// `−exp(−t) + 1 − t + t²/2` begins with `t³/6`: a flat end of what sees a derivative of a wave.
#[test]
fn derivatives_that_are_seen_are_flat_at_an_end() {
    let decay = "recurrence \"Decay\"\nperiod 2, local s, time t\nwave f\nequation f[n]' = -f[n]\n\
        continuous f[n] starts at 1\nobserve q = f[n]' + 1 - t + t^2/2\n";
    let found = roots(&solution(decay, &[]), "q", ["0", "1"], "0");
    assert!(matches!(&found[..], [Root::End { .. }]), "{found:?}");
}

/// Where a function only touches a level, no enclosure decides it; at a simple fraction exact arithmetic does.
#[test]
fn levels_are_touched_at_simple_fractions() {
    for (function, at, level) in [
        ("(t - 1/3)^2", "1/3", "0"),
        ("6*t - 6*t^2", "1/2", "3/2"),
        ("-(t - 1)^2*exp(-t)", "1", "0"),
        ("(t - 1/2)^4*exp(t)", "1/2", "0"),
    ] {
        let touching = of_time(function);
        for to in ["5/4", "3/2", "2"] {
            let found = roots(&touching, "q", ["0", to], level);
            assert_eq!(found, [Root::Double { time: exactly(at) }], "{function} until {to}");
        }
    }
    // At an end of the window it is one root all the same.
    for (function, window) in
        ["(t - 1)^2 + 1", "(t - 1)^3*exp(t) + 1", "(t - 1)^4 + 1", "(t - 1)^2*(t - 3) + 1"]
            .into_iter()
            .flat_map(|function| [(function, ["1", "2"]), (function, ["0", "1"])])
    {
        let found = roots(&of_time(function), "q", window, "1");
        assert!(matches!(&found[..], [Root::End { .. }]), "{function}: {found:?}");
    }
    for (function, at, value, goal) in [
        ("6*t - 6*t^2", "1/2", "3/2", Goal::Largest),
        ("-(t - 1)^2*exp(-t)", "1", "0", Goal::Largest),
        ("(t - 1)^2*(1 + t)", "1", "0", Goal::Smallest),
    ] {
        let found = extremum(&of_time(function), "q", ["1/4", "7/4"], goal);
        assert_eq!(found.value, exactly(value), "{function}");
        assert_eq!(found.places, [Place::Critical(exactly(at))], "{function}");
    }
}

#[test]
fn even_roots_stay_undecided_with_what_is_known() {
    let double = of_time("(t^2 - 1/2)^2");
    let found = roots(&double, "q", ["0", "3/2"], "0");
    let [Root::Undecided { from, to, range, crosses: false }] = &found[..] else {
        panic!("{found:?}");
    };
    let half = number("1/2");
    assert!(from * from <= half && half <= to * to && to - from < number("1e-15"));
    assert!(range.contains(&number("0")) && !range.contains(&number("1e-29")));
    // A little above the level it has none, a little below two.
    let double = of_time("(t - 1/3)^2");
    assert_eq!(roots(&double, "q", ["0", "3/2"], "-1e-20"), []);
    let pair = roots(&double, "q", ["0", "3/2"], "1e-20");
    let [Root::Simple { rises: false, time: first }, Root::Simple { rises: true, time: second }] =
        &pair[..]
    else {
        panic!("{pair:?}");
    };
    assert_eq!(first.to_text(20), "0.33333333323333333333");
    assert_eq!(second.to_text(20), "0.33333333343333333333");
    // A triple root crosses.
    let found = roots(&of_time("(t - 1/3)^3"), "q", ["0", "3/2"], "0");
    assert!(matches!(&found[..], [Root::Undecided { crosses: true, .. }]), "{found:?}");
}

/// A force that changes its sign at every arrival, and one that stays zero.
#[test]
fn jumps_and_intervals() {
    let bars = solution("two-bars", &[("r", "1/3")]);
    let found = roots(&bars, "force", ["0", "7"], "0");
    let jump = |time| {
        found.iter().find_map(|root| match root {
            Root::Jump { time: at, limits } if *at == exactly(time) => Some(limits.clone()),
            _ => None,
        })
    };
    assert_eq!(found.len(), 3, "{found:?}");
    for time in ["2", "4", "6"] {
        let [before, after] = jump(time).unwrap();
        assert!(rational(&before).is_positive() != rational(&after).is_positive());
    }
    let bars = solution("two-bars", &[("r", "1")]);
    let found = roots(&bars, "force", ["0", "7"], "0");
    let whole = Root::Interval { from: exactly("2"), to: exactly("7"), closed: true };
    assert_eq!(found, [whole]);
    // The value that it has is an interval as well, half-open.
    let rigid = solution("rigid-mass", &[("mu", "1")]);
    let silent = Root::Interval { from: exactly("0"), to: exactly("1"), closed: false };
    assert_eq!(roots(&rigid, "strain_fixed", ["0", "3"], "0"), [silent]);
}

/// Waves that cancel each other are told as zero, and as constant.
#[test]
fn cancelling_waves_vanish() {
    let text = scenes::find("rigid-mass").unwrap().text;
    let text = format!("{text}observe nothing = g[n] + f[n-1]\n");
    let rigid = solution(&text, &[("mu", "1")]);
    let whole = Root::Interval { from: exactly("0"), to: exactly("9"), closed: true };
    assert_eq!(roots(&rigid, "nothing", ["0", "9"], "0"), [whole]);
    let largest = extremum(&rigid, "nothing", ["0", "3"], Goal::Largest);
    assert_eq!(largest.value, exactly("0"));
    let whole = Place::Plateau { from: exactly("0"), to: exactly("3"), closed: true };
    assert_eq!(largest.places, [whole]);
}

// ---- Against values taken one by one ------------------------------------------------------------

/// A small generator of numbers, the same on every machine.
struct Draw(u64);

impl Draw {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % limit
    }

    fn ratio(&mut self, largest: u64) -> BigRational {
        let denominator = 1 + self.below(12);
        BigRational::new((1 + self.below(largest * denominator)).into(), denominator.into())
    }
}

/// Between two samples the count of changes of sign is odd exactly where the signs differ.
#[test]
fn no_change_of_sign_is_missed() {
    let mut draw = Draw(7);
    let (mut changes, mut compared) = (0, 0);
    for (scene, symbol, quantities) in [
        ("rigid-mass", "mu", &["f", "velocity", "strain_fixed", "strain_impact"][..]),
        ("pulse-shape", "mu", &["force"][..]),
        ("two-bars", "r", &["force"][..]),
    ] {
        for _ in 0..4 {
            let value = draw.ratio(2);
            let solution = solution(scene, &[(symbol, &value.to_string())]);
            for quantity in quantities {
                let level = draw.ratio(1) * number("1/7") - number("1/14");
                let level = if draw.below(2) == 0 { number("0") } else { level };
                let from = draw.ratio(2) * number("1/3");
                let to = &from + draw.ratio(3) + number("4");
                let observation = solution.recurrence().observation(quantity).unwrap();
                let signal =
                    ClosedSignal::of_recurrence(&solution, &observation, [&from, &to]).unwrap();
                let search = Search::new(&signal).unwrap();
                let found = search.roots(&level, 20, BITS).unwrap();
                let mut exact = Vec::new();
                let mut blind = Vec::new();
                for root in &found.all {
                    match root {
                        Root::Simple { time, rises } => {
                            let time = rational(time);
                            let near = &time * number("1e-18");
                            let sides =
                                [&time - &near, &time + &near].map(|at| sign(&signal, &at, &level));
                            let rising = [Ordering::Less, Ordering::Greater];
                            let falling = [Ordering::Greater, Ordering::Less];
                            assert_eq!(sides, if *rises { rising } else { falling });
                            exact.push(time);
                        }
                        Root::Jump { time, .. } => exact.push(rational(time)),
                        Root::Interval { from, to, .. } => {
                            blind.push((rational(from), rational(to)));
                        }
                        Root::End { time } | Root::Arrival { time, .. } => {
                            blind.push((rational(time), rational(time)));
                        }
                        Root::Double { .. } => panic!("{quantity} is no square"),
                        Root::Undecided { from, to, .. } => blind.push((from.clone(), to.clone())),
                    }
                }
                let count = 60_u32;
                let time =
                    |i: u32| &from + (&to - &from) * BigRational::new(i.into(), count.into());
                let mut before = sign(&signal, &from, &level);
                for i in 0..count {
                    let (a, b) = (time(i), time(i + 1));
                    let after = sign(&signal, &b, &level);
                    let within = |(from, to): &(BigRational, BigRational)| *from <= b && a <= *to;
                    if !blind.iter().any(within) {
                        let inside = exact.iter().filter(|at| a < **at && **at <= b).count();
                        assert_eq!(
                            inside % 2 == 1,
                            before != after,
                            "{scene} {symbol}={value} {quantity}={level} between {a} and {b}: \
                             {found:?}"
                        );
                        changes += inside;
                        compared += 1;
                    }
                    before = after;
                }
            }
        }
    }
    assert!(changes > 40 && compared > 600, "{changes} {compared}");
}

/// A light mass turns many times in each period, so that a stretch takes many terms and is halved often: there is a root
/// wherever samples change their sign, the extremum is no less than any of them, and some come near.
#[test]
fn long_stretches_of_fast_motion_are_searched() -> Result<(), wavestep::Error> {
    let text = "scene \"A light mass\"\nmass hammer { mass = 1/20, velocity = 1 }\n\
        bar rod { impedance = 1, travel = 1 }\nline free - hammer - rod - fixed\n\
        observe v = velocity(hammer)\nobserve f = force(rod.right)\n";
    let problem = wavestep::Problem::read("scene", text)?;
    for quantity in ["v", "f"] {
        let signal = problem.signal(quantity)?;
        let roots = signal.roots(40..=48, 12)?;
        let times: Vec<BigRational> =
            (0..=800).map(|i| number("40") + BigRational::new(i.into(), 100.into())).collect();
        let values = signal.values(&times, wavestep::Tolerance::Absolute(1e-9))?.values;
        let at = |root: &Root| match root {
            Root::Simple { time, .. } | Root::Jump { time, .. } => rational(time),
            other => panic!("{other:?}"),
        };
        let at: Vec<BigRational> = roots.all.iter().map(at).collect();
        let mut changes = 0;
        for (window, pair) in times.windows(2).zip(values.windows(2)) {
            if pair.iter().any(|value| value.abs() < 1e-6) {
                continue;
            }
            let inside = at.iter().filter(|at| window[0] < **at && **at <= window[1]).count();
            assert_eq!(inside % 2 == 1, pair[0] * pair[1] < 0.0, "{quantity} between {window:?}");
            changes += inside;
        }
        assert!(changes > 20, "{quantity}: {changes}");
        let largest = signal.extremum(Goal::Largest, 40..=48, 12)?.value.to_f64();
        let sampled = values.iter().copied().fold(f64::MIN, f64::max);
        assert!(sampled <= largest + 1e-9 && largest < sampled * 1.02, "{sampled} {largest}");
    }
    Ok(())
}

/// No sample exceeds the extremum, and it is taken, or approached, where it is said to be.
#[test]
fn no_sample_exceeds_an_extremum() {
    let mut draw = Draw(11);
    let mut kinds = BTreeMap::new();
    for (scene, quantity) in [
        ("rigid-mass", "f"),
        ("rigid-mass", "velocity"),
        ("rigid-mass", "g"),
        ("pulse-shape", "force"),
    ] {
        for goal in [Goal::Largest, Goal::Smallest] {
            let solution = solution(scene, &[("mu", &draw.ratio(2).to_string())]);
            let from = draw.ratio(3);
            let to = &from + draw.ratio(6);
            let observation = solution.recurrence().observation(quantity).unwrap();
            let signal =
                ClosedSignal::of_recurrence(&solution, &observation, [&from, &to]).unwrap();
            let search = Search::new(&signal).unwrap();
            let found = search.extremum(goal, 20, BITS).unwrap();
            let best = rational(&found.value);
            let above = |value: &BigRational| match goal {
                Goal::Largest => value - &best,
                Goal::Smallest => &best - value,
            };
            for i in 0..=60_u32 {
                let at = &from + (&to - &from) * BigRational::new(i.into(), 60.into());
                assert!(above(&value(&signal, &at)) <= number("1e-18"));
            }
            assert_eq!(found.places.len(), 1, "{found:?}");
            let (kind, at, side) = match &found.places[0] {
                Place::Critical(time) => ("critical", time, Limit::Right),
                Place::End(time) => ("end", time, Limit::Right),
                Place::Arrival { time, after: true, .. } => ("after", time, Limit::Right),
                Place::Arrival { time, .. } => ("before", time, Limit::Left),
                Place::Plateau { from, .. } => ("plateau", from, Limit::Right),
                other => panic!("{other:?}"),
            };
            *kinds.entry(kind).or_insert(0) += 1;
            let told = digits(&signal, &rational(at), side, 30, BITS).unwrap();
            let told = told.decimal(30).0.to_rational();
            assert!((told - &best).abs() <= number("1e-17"), "{found:?}");
        }
    }
    assert!(kinds.len() >= 2, "{kinds:?}");
}

#[test]
fn suprema_at_sides_and_ties() {
    let rigid = solution("rigid-mass", &[("mu", "1")]);
    let found = extremum(&rigid, "strain_impact", ["2", "4"], Goal::Largest);
    let [place @ Place::Arrival { time, before: true, after: false }] = &found.places[..] else {
        panic!("{found:?}");
    };
    assert!(*time == exactly("4") && !place.is_attained());
    // Periodic: the same maximum three times, exactly.
    let found = extremum(&of_time("cos(t)"), "q", ["0", "1"], Goal::Largest);
    assert_eq!((found.value, found.places), (exactly("1"), vec![Place::End(exactly("0"))]));
    let parabola = of_time("t*(1 - t)");
    let found = extremum(&parabola, "q", ["0", "1"], Goal::Smallest);
    let ends = vec![Place::End(exactly("0")), Place::End(exactly("1"))];
    assert_eq!((found.value, found.places), (exactly("0"), ends));
    let found = extremum(&parabola, "q", ["0", "1"], Goal::Largest);
    let middle = vec![Place::Critical(exactly("1/2"))];
    assert_eq!((found.value, found.places), (exactly("1/4"), middle));
    let found = extremum(&of_time("t*(2/3 - t)"), "q", ["0", "1"], Goal::Largest);
    let third = vec![Place::Critical(exactly("1/3"))];
    assert_eq!((found.value, found.places), (exactly("1/9"), third));
    // Two maxima of a symmetric quartic cannot be told apart, and both are listed.
    let quartic = of_time("-((t - 1/3)^2 - 1/30)^2");
    let found = extremum(&quartic, "q", ["0", "1"], Goal::Largest);
    let times: Vec<String> = found
        .places
        .iter()
        .map(|place| match place {
            Place::Critical(time) => time.to_text(6),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(times, ["0.15075914749827796218", "0.51590751916838870449"]); // 1/3 ∓ 1/sqrt(30)
    // Both limits at an arrival where it is continuous are one place.
    let kink = of_time("4 - (t - 2)^2");
    let found = extremum(&kink, "q", ["1", "3"], Goal::Largest);
    let both = Place::Arrival { time: exactly("2"), before: true, after: true };
    assert_eq!((found.value, found.places), (exactly("4"), vec![both]));
    // A plateau.
    let force = solution("constant-force", &[]);
    let found = extremum(&force, "f", ["0", "5"], Goal::Largest);
    let plateau = Place::Plateau { from: exactly("4"), to: exactly("5"), closed: true };
    assert_eq!((found.value, found.places), (exactly("3"), vec![plateau]));
    // Alternately 1 and 0: limits at two arrivals are two places, and so are plateaus apart.
    let alternating = solution(
        "recurrence \"Alternating\"\nperiod 1, local s, time t\nwave f\nequation f[n] + f[n-1] = 1\n\
         observe arch = f[n] + 3*t - t^2\n",
        &[],
    );
    let found = extremum(&alternating, "arch", ["1/2", "5/2"], Goal::Largest);
    let at = |time, before, after| Place::Arrival { time: exactly(time), before, after };
    let apart = vec![at("1", true, false), at("2", false, true)];
    assert_eq!((found.value, found.places), (exactly("3"), apart));
    let found = extremum(&alternating, "f", ["0", "5/2"], Goal::Largest);
    let flat = |from, to, closed| Place::Plateau { from: exactly(from), to: exactly(to), closed };
    let apart = vec![flat("0", "1", false), flat("2", "5/2", true)];
    assert_eq!((found.value, found.places), (exactly("1"), apart));
}

/// Places that touch and have one value are one; those apart are not, also a limit that is not attained before a plateau.
#[test]
fn places_apart_are_told_apart() -> Result<(), wavestep::Error> {
    let text = "scene \"Places\"\nbar rod { impedance = 1 }\nload rise { force = t, until = 1 }\n\
        load first { force = 1, from = 2, until = 3 }\nload again { force = 1, from = 3, until = 4 }\n\
        load late { force = 1, from = 5, until = 6 }\n\
        line free - rise - first - again - late - rod - endless\nobserve v = velocity(rod.left)\n";
    let problem = wavestep::Problem::read("places", text)?;
    let found = problem.signal("v")?.extremum(Goal::Largest, "0"..="7", 20)?;
    let exactly = |text: &str| Value::Exact(number(text));
    let flat = |from, to| Place::Plateau { from: exactly(from), to: exactly(to), closed: false };
    let limit = Place::Arrival { time: exactly("1"), before: true, after: false };
    assert_eq!(found.value, exactly("1"));
    assert_eq!(found.places, [limit, flat("2", "4"), flat("5", "6")]);
    Ok(())
}

/// Arrivals at irrational times, in seconds.
#[test]
fn scenes_with_units_and_lattices() {
    let network = |name: &str| {
        let source = Source::new(name, scenes::find(name).unwrap().text).unwrap();
        Network::new(&read_scene(&source, &BTreeMap::new()).unwrap()).unwrap()
    };
    for (scene, quantity, kinds) in [
        ("hopkinson", "gauge_incident", "silent silent"),
        ("incommensurate", "contact_force", "jump jump jump"),
        ("percussive-drill", "penetration", "silent"),
        ("pile", "penetration", "silent"),
    ] {
        let network = network(scene);
        let observed = network.observables().iter().find(|seen| seen.name == quantity).unwrap();
        let window = [number("0"), number("35e-5")];
        let window = match scene {
            "incommensurate" => [number("0"), number("5e-4")],
            // Times without units. Where the wave is there, value and slope begin at zero.
            "pile" => [number("0"), number("2")],
            _ => window,
        };
        let signal = ClosedSignal::of_scene(&network, observed, [&window[0], &window[1]]).unwrap();
        let search = Search::new(&signal).unwrap();
        let found = search.roots(&number("0"), 12, BITS).unwrap().all;
        let told: Vec<&str> = found
            .iter()
            .map(|root| match root {
                Root::Interval { .. } => "silent",
                Root::Jump { .. } => "jump",
                Root::Simple { .. } => "simple",
                _ => "other",
            })
            .collect();
        assert_eq!(told.join(" "), kinds, "{scene}: {found:?}");
    }
    // An echo that is identically zero arrives within the plateau and does not divide it.
    let network = network("incommensurate");
    let observed = network.observables().iter().find(|seen| seen.name == "wall_force").unwrap();
    let window = [number("0"), number("5e-4")];
    let signal = ClosedSignal::of_scene(&network, observed, [&window[0], &window[1]]).unwrap();
    let search = Search::new(&signal).unwrap();
    let found = search.extremum(Goal::Smallest, 9, BITS).unwrap();
    assert!(matches!(&found.places[..], [Place::Plateau { closed: false, .. }]), "{found:?}");
    assert_eq!(found.value.to_text(9), "-53122.2775");
}

#[test]
fn empty_windows_are_refused() {
    let rigid = solution("rigid-mass", &[("mu", "1")]);
    let f = rigid.recurrence().observation("f").unwrap();
    let (one, two) = (number("1"), number("2"));
    let signal = ClosedSignal::of_recurrence(&rigid, &f, [&one, &one]).unwrap();
    let error = Search::new(&signal).err();
    assert_eq!(error, Some(EvaluateError::EmptyWindow));
    let symbolic = solution("rigid-mass", &[]);
    let error = ClosedSignal::of_recurrence(&symbolic, &f, [&one, &two]).err();
    assert!(matches!(error, Some(EvaluateError::MissingValue(_))));
}

/// A mass that stops at once between long bars: its velocity falls by `e^(−100002 t)` for a million times longer than
/// it takes to stop, and is above zero for all of that.
#[test]
fn what_has_died_out_falls_still() {
    let text = "scene \"Stopped\"\nbar west { impedance = 1e5 }\nmass ram { mass = 1, velocity = 1 }\n\
        bar east { impedance = 2 }\nline endless - west - ram - east - endless\nobserve v = velocity(ram)";
    let problem = wavestep::Problem::read("stopped.wave", text).unwrap();
    let least = problem.signal("v").unwrap();
    let least = least.extremum(wavestep::Goal::Smallest, 0..=10, 9).unwrap();
    // exp(−1000020), at the end.
    assert_eq!((least.value.to_string().as_str(), least.places.len()), ("6.79527614e-434304", 1));
}

/// Two masses on a stiff damper: their rates of 10^11, of 10^−9 and of one have values with few bits too.
#[test]
fn rates_of_very_different_sizes_have_values() {
    let text = "scene \"Stiff\"\nmass one { mass = 1 }\nmass two { mass = 3, velocity = -1 }\n\
        spring soft { stiffness = 1 }\nspring stiff { stiffness = 100, damping = 1e11 }\n\
        line fixed - soft - one - stiff - two - free\nobserve F = force(stiff)";
    let scene = read_scene(&Source::new("stiff.wave", text).unwrap(), &BTreeMap::new()).unwrap();
    let recurrence = Network::new(&scene).unwrap().recurrence().unwrap();
    let numbers = wavestep::enclosure::Numbers::new(recurrence.constants());
    assert!(recurrence.constants().len() > 2);
    for constant in recurrence.constants() {
        assert!(numbers.value(&constant.symbol, 64).is_some(), "{constant:?}");
    }
}
