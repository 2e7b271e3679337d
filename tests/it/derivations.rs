//! Two derivations of the same functions, compared with `==`, and put back into what was stated.
//!
//! Period by period works in time with integrating factors; echo by echo works in the Laplace
//! domain. They share ring arithmetic only, so that neither can repeat an error of the other. What
//! a solution must satisfy is computed here once more, straight from the statement.

use std::cell::Cell;
use std::collections::BTreeMap;

use crate::support::{by_echoes, by_periods, violation};
use num_traits::ToPrimitive;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use wavestep::enclosure::Numbers;
use wavestep::expression::{Expression, Fraction};
use wavestep::language::{self, Source, Stated, read_recurrence};
use wavestep::problem::{Derived, Form, Orders, ToDerive};
use wavestep::recurrence::Recurrence;
use wavestep::scenes::{self, SCENES};
use wavestep::solution::Solution;
use wavestep_polynomial::{Rational, Symbol};

type Values<'a> = &'a [(&'a str, (i64, i64))];

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn number(numerator: i64, denominator: i64) -> Fraction {
    Fraction::constant(&rational(numerator, denominator))
}

fn symbol(name: &str) -> Symbol {
    Symbol::new(name).expect("a name")
}

fn read_with(text: &str, values: Values<'_>) -> Recurrence {
    let source = Source::new("recurrence", text).unwrap_or_else(|error| panic!("{error}"));
    let values = values.iter().map(|(name, (p, q))| ((*name).to_owned(), rational(*p, *q)));
    read_recurrence(&source, &values.collect()).unwrap_or_else(|error| panic!("{error}"))
}

fn read(text: &str) -> Recurrence {
    read_with(text, &[])
}

fn scene(name: &str) -> &'static str {
    scenes::find(name).expect("a scene of the library").text
}

// ---- Every way to derive, and the conditions a solution must meet ------------------------------

/// Asserts that all derivations agree and that what was stated holds; returns the pieces.
fn assert_proved(name: &str, recurrence: &Recurrence, through: usize) -> Vec<Vec<Expression>> {
    let pieces = by_periods(recurrence, through);
    let echoes = by_echoes(recurrence, through);
    let solution = Solution::new(recurrence.clone());
    for (wave, wave_name) in recurrence.statement().waves.iter().enumerate() {
        let solved = solution.pieces(wave, 0, through).unwrap_or_else(|error| panic!("{error}"));
        for n in 0..=through {
            assert_eq!(pieces[wave][n], echoes[wave][n], "{name}: {wave_name}[{n}]");
            assert_eq!(pieces[wave][n], solved[n], "{name}: {wave_name}[{n}] of the solution");
        }
    }
    assert_eq!(violation(recurrence, &pieces), None, "{name}");
    pieces
}

// ---- Scenes, and recurrences that no scene has -------------------------------------------------

#[test]
fn derivations_agree_on_every_scene() {
    for scene in SCENES {
        let source = Source::new(scene.name, scene.text).expect("a text");
        if let Ok(Stated::Recurrence(stated)) = language::read(&source, &BTreeMap::new()) {
            assert_proved(scene.name, &stated, 30);
        }
    }
}

/// Recurrences of every kind, with the last period that is derived. Where several symbolic rates
/// meet, the number of terms grows with a higher power of n, and fewer periods are taken.
const RECURRENCES: [(&str, usize, &str); 22] = [
    (
        "derivative-delayed",
        30,
        "symbol D > 0
         period D, local s, time t
         wave f
         equation f[n]' + 2*f[n] = f[n-1]' - 3*f[n-1]
         continuous f[n] - f[n-1] starts at 1",
    ),
    (
        "two-symbolic-poles",
        6,
        "symbol D > 0, a, b
         nonzero a - b
         period D, local s, time t
         wave u, v
         equation u[n]' + a*u[n] = v[n-1]
         equation v[n]' + b*v[n] = u[n]
         continuous u[n] starts at 1
         continuous v[n] starts at 0",
    ),
    (
        "resonant-forcing",
        30,
        "symbol D > 0
         period D, local s, time t
         wave f
         equation f[n]' + f[n] = exp(-t) + f[n-1]
         continuous f[n] starts at 0",
    ),
    (
        "forcing-with-another-pole",
        30,
        "period 1, local s, time t
         wave f
         equation f[n]' + f[n] = exp(-2*t)*t - f[n-1]
         continuous f[n] starts at 1/2",
    ),
    (
        "forcing-with-several-lags",
        30,
        "period 2, local s, time t
         wave f, g
         equation g[n] = t^2 + exp(-t) - 3
         equation f[n]' + f[n] = g[n-1] - 2*g[n-3] + f[n-2]
         continuous f[n] + g[n-2] starts at 1",
    ),
    (
        "forcing-of-a-sum",
        30,
        "symbol D > 0
         period D, local s, time t
         wave f
         equation f[n]' = exp(-t)*t - 2*sum(f[i], i < n) + sum(f[i-1], i < n)
         continuous f[n] starts at -1",
    ),
    (
        "two-differential-waves",
        30,
        "period 1, local s, time t
         wave u, v
         equation u[n]' + u[n] = v[n-1]'
         equation v[n]' + 2*v[n] = u[n] - u[n-1]
         continuous u[n] starts at 1
         continuous v[n] - u[n] starts at 0",
    ),
    (
        "two-waves-with-mixed-rules",
        20,
        "period 3/2, local s, time t
         wave u, v
         equation u[n]' - u[n] = 3*v[n-2] - u[n-1]
         equation v[n]' + u[n]' = v[n-1]
         continuous u[n] + v[n] starts at 1
         continuous u[n] - v[n] + u[n-1] starts at 0",
    ),
    (
        "loop-on-one-period",
        30,
        "period 2, local s, time t
         wave f, g, h
         equation g[n] + h[n] = f[n-1]
         equation g[n] - h[n] = f[n]
         equation f[n]' + f[n] = g[n-1] - h[n]
         continuous f[n] starts at 1",
    ),
    (
        "loop-differentiated",
        30,
        "period 2, local s, time t
         wave f, g, h
         equation g[n] + h[n] = f[n-1] + t^2
         equation g[n] - h[n] = 2*f[n]
         equation f[n]' + 2*h[n]' = g[n]
         continuous f[n] + g[n] starts at 1/3",
    ),
    (
        "loop-algebraic",
        30,
        "symbol r > 0
         period 2, local s, time t
         wave f, g
         equation f[n] + r*g[n] = t + f[n-1]
         equation f[n] - g[n] = g[n-2]",
    ),
    (
        "sum-and-slope",
        30,
        "symbol D > 0
         period D, local s, time t
         wave f
         equation f[n]' + f[n] = 1 - f[n-1]' - 2*sum(f[i], i < n)
         continuous f[n] + f[n-1] starts at 2",
    ),
    (
        "sum-of-another-wave",
        30,
        "period 1, local s, time t
         wave f, g
         equation g[n] = 2*sum(f[i], i < n) - f[n]
         equation f[n]' = f[n] - g[n-1]
         continuous f[n] starts at 1",
    ),
    (
        "rigid-mass-with-numbers",
        30,
        "period 2/3, local s, time t
         wave f
         equation f[n]' + 5/4*f[n] = f[n-1]' - 5/4*f[n-1]
         continuous f[n] - f[n-1] starts at 7",
    ),
    (
        "period-is-a-quotient",
        15,
        "symbol L > 0, c > 0
         period 2*L/c, local s, time t
         wave f
         equation L/c*f[n]' + f[n] = L/c*f[n-1]' - f[n-1]
         continuous f[n] - f[n-1] starts at 1/c",
    ),
    (
        "leading-coefficient",
        30,
        "symbol mu > 0
         period 2, local s, time t
         wave f
         equation mu*f[n]' + f[n] = f[n-1] + 1
         continuous f[n] starts at 0",
    ),
    (
        "exponential-coefficient",
        30,
        "symbol mu > 0
         period mu, local s, time t
         wave f
         equation f[n]' + f[n] = exp(-mu)*f[n-1] + 1
         continuous f[n] - exp(-mu)*f[n-1] starts at 1",
    ),
    (
        "continuous-over-three-periods",
        30,
        "period 1, local s, time t
         wave f
         equation f[n]' + f[n] = f[n-1]' - f[n-2]'
         continuous f[n] - 1/2*f[n-1] + f[n-2] starts at 2",
    ),
    (
        "rate-zero",
        30,
        "symbol D > 0
         period D, local s, time t
         wave f
         equation f[n]' = 1 - f[n-1]
         continuous f[n] starts at 0",
    ),
    (
        "ratio-of-reflection",
        20,
        "symbol r > 0
         period 2, local s, time t
         wave f
         equation f[n]' + f[n] = (1-r)/(1+r)*(f[n-1]' - f[n-1])
         continuous f[n] - (1-r)/(1+r)*f[n-1] starts at 1",
    ),
    (
        "mass-between-springs",
        10,
        "symbol D > 0, k > 0
         nonzero k - 1
         period D, local s, time t
         wave u, v
         equation u[n]' + k*u[n] = v[n-1]' - k*v[n-1]
         equation v[n]' + v[n] = u[n-1]' - u[n-1]
         continuous u[n] - v[n-1] starts at 1
         continuous v[n] - u[n-1] starts at 0",
    ),
    (
        "constant-sequence",
        30,
        "symbol a
         period 2, local s, time t
         wave f
         equation f[n] = a*f[n-1] - exp(-a)*f[n-2] + t",
    ),
];

/// The text with its title; lines may be indented.
fn titled(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    format!("recurrence \"test\"\n{}\n", lines.join("\n"))
}

fn named(name: &str) -> String {
    let found = RECURRENCES.iter().find(|(other, _, _)| *other == name);
    titled(found.expect("a recurrence of the list").2)
}

#[test]
fn derivations_agree_on_unshipped_recurrences() {
    for (name, through, text) in RECURRENCES {
        assert_proved(name, &read(&titled(text)), through);
    }
}

/// What `violation` finds, it finds: pieces that are changed a little break what was stated.
#[test]
fn wrong_pieces_are_noticed() {
    let recurrence = read(scene("rigid-mass"));
    let right = by_periods(&recurrence, 3);
    assert_eq!(violation(&recurrence, &right), None);
    let local = Expression::symbol(&recurrence.statement().local);
    for error in
        [Expression::one(), Expression::exponential(-&Fraction::symbol(&symbol("s"))), local]
    {
        for wave in 0..2 {
            let mut wrong = right.clone();
            wrong[wave][2] += &error;
            assert!(violation(&recurrence, &wrong).is_some(), "{error:?} in wave {wave}");
        }
    }
}

// ---- Values before and after derivation --------------------------------------------------------

#[test]
fn values_before_derivation_equal_values_after() {
    for (text, name, value) in [
        (scene("rigid-mass").to_owned(), "mu", (1, 3)),
        (scene("pulse-shape").to_owned(), "mu", (1, 3)),
        (scene("two-bars").to_owned(), "r", (7, 2)),
        (named("leading-coefficient"), "mu", (1, 3)),
        (named("exponential-coefficient"), "mu", (1, 3)),
        (named("ratio-of-reflection"), "r", (2, 5)),
        (named("mass-between-springs"), "k", (3, 1)),
    ] {
        let through = 8;
        let before = assert_proved("values", &read_with(&text, &[(name, value)]), through);
        let after = by_echoes(&read(&text), through);
        for (before, after) in before.iter().zip(&after) {
            for (before, after) in before.iter().zip(after) {
                let after = after.substitute(&symbol(name), &number(value.0, value.1));
                assert_eq!(*before, after.expect("no denominator vanishes"));
            }
        }
    }
}

/// With the two poles made one by values, nothing is divided by their difference, and the answer is
/// the one of the recurrence that has one pole from the start.
#[test]
fn poles_made_equal_give_the_confluent_answer() {
    let two = named("two-symbolic-poles");
    let one = two.replace(", b\n", "\n").replace("nonzero a - b\n", "").replace("b*v", "a*v");
    assert_ne!(one, two);
    let through = 5;
    let confluent = assert_proved("one pole", &read(&one), through);
    for (p, q) in [(1, 1), (-3, 2), (0, 1)] {
        let values = [("a", (p, q)), ("b", (p, q))];
        let met = assert_proved("poles that meet", &read_with(&two, &values), through);
        for (met, confluent) in met.iter().flatten().zip(confluent.iter().flatten()) {
            let expected = confluent.substitute(&symbol("a"), &number(p, q)).expect("a number");
            assert_eq!(*met, expected);
        }
    }
    let apart = assert_proved("poles apart", &read(&two), 1);
    // The symbolic answer itself cannot take equal poles: it has to refuse.
    let met = apart[0][1].substitute(&symbol("b"), &Fraction::symbol(&symbol("a")));
    assert!(met.is_err());
    // It tends to the confluent one: the difference halves with the distance of the poles.
    let at = |expression: &Expression, b: Rational| {
        let value = |x: &Symbol| match x.name() {
            "a" => Some(rational(1, 1)),
            "b" => Some(b.clone()),
            "D" => Some(rational(2, 1)),
            _ => Some(rational(5, 4)),
        };
        float(expression, &value)
    };
    let exact = at(&confluent[0][1], rational(1, 1));
    let distance = |d: i64| at(&apart[0][1], rational(d + 1, d)) - exact;
    let ratio = distance(1000) / distance(2000);
    assert!(distance(1000).abs() < 1e-3 && (ratio - 2.0).abs() < 0.01, "{ratio}");
}

// ---- Random recurrences ------------------------------------------------------------------------

fn coefficient() -> BoxedStrategy<Option<(i64, i64)>> {
    prop_oneof![3 => Just(None), 2 => (-3..=3i64, 1..=2i64).prop_map(Some)].boxed()
}

/// One term `p/q*w[n-lag]'`, where the coefficient is not zero.
fn terms(waves: usize, lags: std::ops::RangeInclusive<usize>) -> BoxedStrategy<String> {
    let lags: Vec<usize> = lags.collect();
    let places: Vec<(usize, usize, &str)> = (0..waves)
        .flat_map(|wave| {
            lags.clone().into_iter().flat_map(move |lag| [(wave, lag, ""), (wave, lag, "'")])
        })
        .collect();
    prop::collection::vec(coefficient(), places.len())
        .prop_map(move |coefficients| {
            let present = places.iter().zip(coefficients);
            let written = present.filter_map(|((wave, lag, prime), c)| {
                c.map(|(p, q)| format!(" + ({p}/{q})*{}[n-{lag}]{prime}", ["u", "v"][*wave]))
            });
            written.collect()
        })
        .boxed()
}

fn forcing() -> BoxedStrategy<String> {
    let function = (-2..=2i64, 0..=2u32, -2..=1i64)
        .prop_map(|(c, power, rate)| format!(" + ({c})*t^{power}*exp({rate}*t)"));
    prop_oneof![Just(String::new()), function].boxed()
}

/// An equation for `wave`: differential or algebraic, mostly with older waves only beside it.
fn equation(wave: usize, waves: usize) -> BoxedStrategy<(bool, String)> {
    let name = ["u", "v"][wave];
    let own = prop_oneof![
        4 => (-2..=2i64).prop_map(move |a| (true, format!("{name}[n]' + ({a})*{name}[n]"))),
        1 => Just((false, format!("2*{name}[n]"))),
    ];
    let now = prop_oneof![3 => Just(String::new()), 1 => terms(waves, 0..=0)];
    (own, terms(waves, 1..=2), now, forcing())
        .prop_map(|((slope, own), past, now, forcing)| {
            (slope, format!("equation {own} = 0{past}{now}{forcing}\n"))
        })
        .boxed()
}

fn rule(wave: usize, waves: usize) -> BoxedStrategy<String> {
    let name = ["u", "v"][wave];
    (terms(waves, 1..=2), -2..=2i64)
        .prop_map(move |(past, start)| {
            let past = past.replace('\'', "");
            format!("continuous {name}[n]{past} starts at {start}\n")
        })
        .boxed()
}

fn random_recurrence() -> BoxedStrategy<String> {
    let one = (equation(0, 1), rule(0, 1)).prop_map(|(e, r)| ("u", vec![(e, r)]));
    let two = (equation(0, 2), rule(0, 2), equation(1, 2), rule(1, 2))
        .prop_map(|(e, r, f, s)| ("u, v", vec![(e, r), (f, s)]));
    let period = prop_oneof![Just("1"), Just("3/2"), Just("D")];
    (period, prop_oneof![one.boxed(), two.boxed()])
        .prop_map(|(period, (waves, parts))| {
            let mut text = "recurrence \"random\"\nsymbol D > 0\n".to_owned();
            text.push_str(&format!("period {period}, local s, time t\nwave {waves}\n"));
            for ((slope, equation), rule) in parts {
                text.push_str(&equation);
                text.push_str(if slope { &rule } else { "" });
            }
            text
        })
        .boxed()
}

#[test]
fn derivations_agree_on_random_recurrences() {
    let (refused, solved, general) = (Cell::new(0), Cell::new(0), Cell::new(0usize));
    let config = Config { cases: 96, failure_persistence: None, ..Config::default() };
    let outcome = TestRunner::new(config).run(&random_recurrence(), |text| {
        let source = Source::new("random", &text).expect("printable text");
        let Ok(recurrence) = read_recurrence(&source, &BTreeMap::new()) else {
            refused.set(refused.get() + 1);
            return Ok(());
        };
        solved.set(solved.get() + 1);
        let (periods, echoes) = (by_periods(&recurrence, 6), by_echoes(&recurrence, 6));
        prop_assert_eq!(&periods, &echoes, "{}", text);
        let solution = Solution::new(recurrence.clone());
        for (wave, pieces) in periods.iter().enumerate() {
            general.set(general.get() + usize::from(solution.general(wave).is_ok()));
            let solved = solution.pieces(wave, 0, 6);
            prop_assert_eq!(Ok(pieces), solved.as_ref(), "{}", text);
        }
        prop_assert_eq!(violation(&recurrence, &periods), None, "{}", text);
        Ok(())
    });
    eprintln!(
        "random recurrences: {} solved ({} waves in general n), {} refused",
        solved.get(),
        general.get(),
        refused.get()
    );
    outcome.unwrap_or_else(|error| panic!("{error}"));
    assert!(solved.get() >= 32, "too many were refused for this to mean anything");
}

// ---- Numbers, independently --------------------------------------------------------------------

/// An exact expression in doubles, term by term: good where terms do not cancel much.
fn float(expression: &Expression, values: &impl Fn(&Symbol) -> Option<Rational>) -> f64 {
    let sum = expression.evaluate(values).expect("every symbol has a value");
    let term = |(exponent, coefficient): (&Rational, &Rational)| {
        coefficient.to_f64().unwrap() * exponent.to_f64().unwrap().exp()
    };
    sum.iter().map(term).sum()
}

/// The velocity `v` of a rigid mass on a bar, with `f(t) = v(t) + f(t−D)`, obeys
/// `v' = −v − 2 f(t−D)`. The classical Runge-Kutta method, with a cubic through both ends of a step
/// for its middle, knows nothing of what is under test.
#[test]
fn rigid_mass_agrees_with_runge_kutta() {
    const STEPS: usize = 1000;
    let recurrence = read_with(scene("rigid-mass"), &[("mu", (1, 1))]);
    let pieces = by_echoes(&recurrence, 5);
    let h = 2.0 / STEPS as f64;
    // f at the start, the middle and the end of every step of the period before.
    let mut before = vec![[0.0; 3]; STEPS];
    let mut v = 1.0f64;
    let mut worst = 0.0f64;
    for piece in &pieces[0] {
        for (step, f) in before.iter_mut().enumerate() {
            let slope = |v: f64, delayed: f64| -v - 2.0 * delayed;
            let k1 = slope(v, f[0]);
            let k2 = slope(v + h / 2.0 * k1, f[1]);
            let k3 = slope(v + h / 2.0 * k2, f[1]);
            let k4 = slope(v + h * k3, f[2]);
            let next = v + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            let middle = (v + next) / 2.0 + h / 8.0 * (k1 - slope(next, f[2]));
            *f = [f[0] + v, f[1] + middle, f[2] + next];
            v = next;
            if step % 50 == 49 {
                let s = rational(step as i64 + 1, STEPS as i64 / 2);
                worst = worst.max((float(piece, &|_| Some(s.clone())) - f[2]).abs());
            }
        }
    }
    eprintln!("Runge-Kutta differs by {worst:e}");
    assert!(worst < 1e-8, "{worst:e}");
}

/// Travel times without a common measure: echoes in order of arrival, none of them zero, each after whole periods of both, and
/// none left out before the first that may be missing.
#[test]
fn echoes_on_a_lattice_are_in_order() {
    let problem = wavestep::Problem::builtin("incommensurate").unwrap();
    let network = problem.network().unwrap();
    let numbers = Numbers::new(&network.model().constants);
    let periods = network.lattice().periods();
    let asked = |last| {
        let orders = Orders::Through(0, last);
        match problem.functions(ToDerive::Waves, orders, Form::Echo).unwrap() {
            Derived::Arrivals(found) => found,
            other => panic!("{other:?}"),
        }
    };
    let (few, more) = (asked(3), asked(5));
    assert!(few.len() > 8 && more.len() > few.len(), "{} {}", few.len(), more.len());
    for arrival in &more {
        let delays = arrival.counts.iter().zip(periods);
        let delay = delays.fold(Fraction::zero(), |sum, (count, period)| {
            &sum + &period.scale(&Rational::from_integer((*count).into()))
        });
        assert!(!arrival.echo.is_zero() && arrival.delay == delay, "{arrival:?}");
    }
    for pair in more.windows(2).filter(|pair| pair[0].wave == pair[1].wave) {
        assert!(numbers.compare(&pair[0].delay, &pair[1].delay).unwrap().is_lt());
    }
    // Those of fewer orders are the first of each wave.
    for wave in 0..problem.waves().len() {
        let [few, more] = [&few, &more].map(|all| all.iter().filter(|own| own.wave == wave));
        assert!(few.zip(more).all(|(one, other)| one == other));
    }
}
