//! The laws of stable sums are measured, and these are the measurements: 64 units in the last place
//! of the largest value in doubles, 2 in pairs of doubles, for all n ≤ 200 and mu from 1/100 to 10.

use crate::methods::response::Response;
use crate::methods::subject::with;
use crate::methods::tally::{Tally, ends};
use crate::methods::{exact, mass_ratio, random, ratio, unit_in_the_last_place};
use num_rational::BigRational;
use proptest::prelude::RngExt as _;
use std::collections::BTreeMap;
use wavestep::answer::{Accuracy, Method};
use wavestep::language::parse_number;
use wavestep::problem::Problem;
use wavestep::signal::{Evaluator, Limit, MethodError, NoTaps, StablePrecision, Summation, Summed};

/// Doubles on every period up to a last one: just after its start, just before its end, and four
/// between, most of them near the front.
fn times(
    mu: f64,
    periods: std::ops::Range<u32>,
    random: &mut proptest::test_runner::TestRng,
) -> Vec<f64> {
    let mut times = Vec::new();
    for n in periods {
        let (start, end) = (2.0 * mu * f64::from(n), 2.0 * mu * f64::from(n + 1));
        let length = end - start;
        times.extend([start, start.next_up(), end.next_down().next_down()]);
        times.push(start + length * random.random_range(0.0..1.0));
        times.push(start + length * random.random_range(0.0..0.05));
        times.push(start + length * random.random_range(0.0..1.0_f64).powi(6));
    }
    times
}

#[test]
fn the_laws_of_stable_sums_hold() {
    let mut random = random(21);
    let mut doubles = Tally::new("stable, of 64 units in the last place");
    let mut pairs = Tally::new("double-double, of 2 units in the last place");
    let mut ratios: Vec<String> =
        ["1/100", "1/10", "1/4", "1", "3", "10"].iter().map(ToString::to_string).collect();
    ratios.extend((0..4).map(|_| mass_ratio(&mut random)));
    for (i, mu) in ratios.iter().enumerate() {
        let value = parse_number(mu).unwrap();
        let periods = 201;
        let response = Response::new(&value, periods + 1);
        let last = (&value * exact(2.0 * f64::from(periods))).to_string();
        with("rigid-mass", &[("mu", mu)], "f", ("0", &last), |subject| {
            let at = times(crate::methods::near(&value), 0..200, &mut random);
            let stable = |precision| Summed::new(subject.signal(), precision).unwrap();
            let place = |time: f64| move || format!("{time:?} for mu = {mu}");
            let in_doubles = stable(Summation::Scaled);
            let mut values = vec![f64::NAN; at.len()];
            in_doubles.values(&at, &mut values).unwrap();
            let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            let unit = unit_in_the_last_place(largest);
            for (time, value) in at.iter().zip(&values) {
                doubles.within(*value, response.at(*time), &exact(64.0 * unit), place(*time));
            }
            // Pairs cost more: a tenth of the times, and single values in doubles at the same.
            let in_pairs = stable(Summation::DoubleDouble);
            for time in at.iter().skip(i).step_by(11) {
                let enclosed = response.at(*time);
                let value = in_pairs.value(&exact(*time), Limit::Right).unwrap();
                pairs.within(value, enclosed.clone(), &exact(2.0 * unit), place(*time));
                let value = in_doubles.value(&exact(*time), Limit::Right).unwrap();
                doubles.within(value, enclosed, &exact(64.0 * unit), place(*time));
            }
        });
    }
    doubles.report(12_000);
    pairs.report(1_000);
}

/// An observable of two waves, each some times as large: their sum is rounded once.
#[test]
fn waves_that_cancel_keep_the_law_of_pairs() {
    let mut pairs = Tally::new("double-double of a velocity, of 2 units in the last place");
    with("rigid-mass", &[("mu", "1/100")], "velocity", ("3", "15/4"), |subject| {
        let stable = Summed::new(subject.signal(), Summation::DoubleDouble).unwrap();
        let unit = unit_in_the_last_place(0.998);
        for i in 0..=150 {
            let (from, to) = (&subject.from, &subject.to);
            let time = from + (to - from) * BigRational::new(i.into(), 150.into());
            let value = stable.value(&time, Limit::Right).unwrap();
            let place = || format!("{time}");
            pairs.within(
                value,
                ends(&subject.enclose(&time, Limit::Right, 1 << 12)),
                &exact(2.0 * unit),
                place,
            );
        }
    });
    pairs.report(150);
}

/// Two thousand echoes: `e^{−x}` of the first ones is far below the smallest double, and its products
/// with Laguerre polynomials are not. Arrivals from both sides as well.
#[test]
fn exponentials_that_underflow_do_no_harm() {
    let mut tally = Tally::new("stable after 2000 echoes, of 640 units in the last place");
    let mut pairs = Tally::new("double-double after 2000 echoes, of 20 units in the last place");
    let response = Response::new(&exact(1.0), 2003);
    with("rigid-mass", &[("mu", "1")], "f", ("3990", "4004"), |subject| {
        let unit = unit_in_the_last_place(1.0);
        let [stable, exactly] = [Summation::Scaled, Summation::DoubleDouble]
            .map(|precision| Summed::new(subject.signal(), precision).unwrap());
        let mut largest = 0.0_f64;
        for (i, offset) in [0.001, 0.1, 0.4, 0.9, 1.3, 1.9, 2.2, 3.7].into_iter().enumerate() {
            let time = 4000.0 + offset;
            let place = || format!("{time}");
            let value = stable.value(&exact(time), Limit::Right).unwrap();
            largest = largest.max(value.abs());
            tally.within(value, response.at(time), &exact(640.0 * unit), place);
            if i % 4 == 0 {
                let value = exactly.value(&exact(time), Limit::Right).unwrap();
                pairs.within(value, response.at(time), &exact(20.0 * unit), place);
            }
        }
        assert!(largest > 0.01, "nothing is seen");
        let arrival = exact(4002.0);
        let [before, after] = [Limit::Left, Limit::Right].map(|side| {
            let value = stable.value(&arrival, side).unwrap();
            let enclosed = response.at_exactly(&arrival, side);
            tally.within(value, enclosed, &exact(640.0 * unit), || format!("4002 {side:?}"));
            value
        });
        // The echo jumps by e^0 L(0) = 1.
        assert!((after - before - 1.0).abs() < 1280.0 * unit);
    });
    tally.report(10);
    pairs.report(2);
}

/// Laguerre polynomials at 0 are 1, so every echo begins at 1 whatever the order: delays that were
/// off by one unit in the last place would be seen.
#[test]
fn echoes_begin_at_one() {
    for mu in ["1/3", "7/10"] {
        with("rigid-mass", &[("mu", mu)], "f", ("0", "150"), |subject| {
            let stable = Summed::new(subject.signal(), Summation::Scaled).unwrap();
            let period = parse_number(mu).unwrap() * exact(2.0);
            for n in [1, 10, 50, 100] {
                let at = &period * BigRational::from_integer(n.into());
                let [left, right] =
                    [Limit::Left, Limit::Right].map(|side| stable.value(&at, side).unwrap());
                assert!((right - left - 1.0).abs() < 1e-13, "{mu} {n}: {left} {right}");
            }
        });
    }
}

/// Where waves have no closed echoes, the reason is told.
#[test]
fn what_has_no_echoes_is_refused() {
    let refused = |scene: &str, values: crate::methods::Values<'_>, quantity: &str| {
        with(scene, values, quantity, ("0", "1/2500"), |subject| {
            match Summed::new(subject.signal(), Summation::Scaled) {
                Err(MethodError::NoTaps(reason)) => reason,
                Err(other) => panic!("{other}"),
                Ok(_) => panic!("{scene} has values"),
            }
        })
    };
    assert_eq!(refused("incommensurate", &[], "wall_force"), NoTaps::NoGrid);
    assert!(matches!(refused("pile", &[], "toe_force"), NoTaps::NoForm(_)));
    assert!(matches!(
        refused("stepped-striker", &[], "pulse"),
        NoTaps::NoForm(_) | NoTaps::Sequence(_)
    ));
}

/// The formula as printed is right after one period and of no use after eighty; the recurrence of
/// three terms still is.
#[test]
fn the_printed_formula_fails_first() {
    with("rigid-mass", &[("mu", "1")], "f", ("0", "200"), |subject| {
        let signal = subject.signal();
        let plain = Summed::new(signal, Summation::Plain).unwrap();
        let expanded = Summed::new(signal, Summation::Expanded).unwrap();
        let stable = Summed::new(signal, Summation::DoubleDouble).unwrap();
        let off = |method: &dyn Evaluator, at: f64| {
            let value = |method: &dyn Evaluator| method.value(&exact(at), Limit::Right).unwrap();
            (value(method) - value(&stable)).abs()
        };
        assert!(off(&plain, 3.0) < 1e-15 && off(&expanded, 3.0) < 1e-14);
        assert!(off(&plain, 161.0) < 1e-11 && off(&expanded, 161.0) > 1e3);
    });
}

/// A function of time is added to the echoes that are observed with it, at one time as at many.
#[test]
fn functions_of_time_are_added_to_echoes() {
    let scene = wavestep::scenes::find("rigid-mass").expect("a built-in scene");
    let text = format!("{}observe moved = f[n] + 1 + 3*t*exp(-t/2)\n", scene.text);
    let values = BTreeMap::from([("mu".to_owned(), ratio(1, 3))]);
    let problem = Problem::of_text("moved", &text, &values).unwrap();
    let times = [ratio(1, 4), ratio(7, 2)];
    let exactly = |time: &BigRational| problem.signal("moved")?.at(time, 17);
    for precision in [StablePrecision::Double, StablePrecision::DoubleDouble] {
        let values = |times: &[BigRational]| {
            let method = Accuracy::Method(Method::Stable(precision), None);
            problem.doubles("moved", times, Limit::Right, method).unwrap().values
        };
        for (time, value) in times.iter().zip(values(&times)) {
            let known = exactly(time).unwrap().to_f64();
            let alone = values(std::slice::from_ref(time))[0];
            assert!((value - known).abs() < 1e-14, "{time}: {value}, {known}");
            assert!((alone - known).abs() < 1e-14, "{time}: {alone}, {known}");
        }
    }
}
