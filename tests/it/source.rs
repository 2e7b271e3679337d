//! The source's printed equations, typed by hand, against what is derived from the scenes.
//!
//! Every expected value is the formula as it stands on the page, in the scenes' units, read by the
//! language and compared with `==`. Nothing that is expected is computed by what is under test.

use std::collections::BTreeMap;

use wavestep::expression::{Expression, Fraction};
use wavestep::language::{Source, read_expression, read_recurrence};
use wavestep::recurrence::Recurrence;
use wavestep::scenes;
use wavestep::solution::Solution;
use wavestep_polynomial::{Polynomial, Rational, Symbol};

fn expression(text: &str) -> Expression {
    let source = Source::new("expected", text).unwrap_or_else(|error| panic!("{error}"));
    read_expression(&source).unwrap_or_else(|error| panic!("{error}"))
}

fn scene(name: &str) -> Solution {
    let text = scenes::find(name).expect("a scene of the library").text;
    let source = Source::new(name, text).expect("text");
    Solution::new(read_recurrence(&source, &BTreeMap::new()).unwrap_or_else(|e| panic!("{e}")))
}

fn pieces(solution: &Solution, wave: &str, last: usize) -> Vec<Expression> {
    let wave = solution.recurrence().wave(wave).expect("a wave of the scene");
    solution.pieces(wave, 0, last).unwrap_or_else(|error| panic!("{error}"))
}

/// An observable `(n−back)D + s` into the scene, where its waves are delayed by whole periods and
/// `back` of one more.
fn observed(solution: &Solution, name: &str, back: &Fraction, last: usize) -> Vec<Expression> {
    let recurrence = solution.recurrence();
    let statement = recurrence.statement();
    let observation = recurrence.observation(name).expect("an observable of the scene");
    assert!(!observation.forcing.contains(&statement.time));
    let mut values = vec![observation.forcing.clone(); last + 1];
    for seen in &observation.waves {
        assert!(!seen.slope);
        let lag = whole_periods(recurrence, &(&seen.delay - back));
        let pieces = solution.pieces(seen.wave, 0, last).unwrap_or_else(|error| panic!("{error}"));
        for (value, piece) in values.iter_mut().skip(lag).zip(&pieces) {
            *value += &(piece * &seen.coefficient);
        }
    }
    let derived = solution.observed(&observation, 0, last).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((&derived.offset, &derived.pieces), (back, &values), "{name}");
    let later = solution.observed(&observation, last, last).map(|seen| seen.pieces);
    assert_eq!(later, Ok(values[last..].to_vec()), "{name}");
    values
}

fn whole_periods(recurrence: &Recurrence, delay: &Fraction) -> usize {
    let period = &recurrence.statement().period;
    let lag = (0..10).find(|lag| period.scale(&Rational::from_integer((*lag).into())) == *delay);
    lag.expect("a delay by whole periods")
}

fn symbol(name: &str) -> Symbol {
    Symbol::new(name).expect("a name")
}

// ---- 6.6 Impact of two bars: r = Z1/Z2, ρ = (r−1)/(r+1), with g in V/c1 and F in V/c2 ----------

fn rho_to_the(n: u32) -> Expression {
    expression("(r - 1)/(1 + r)").pow(n)
}

#[test]
fn two_bars_first_periods_are_6_34_to_6_38() {
    let scene = scene("two-bars");
    let (f, g, transmitted) =
        (pieces(&scene, "f", 1), pieces(&scene, "g", 1), pieces(&scene, "F", 1));
    assert!(f[0].is_zero());
    assert_eq!(g[0], expression("-1/(1 + r)")); // 6.34
    assert_eq!(transmitted[0], expression("r/(1 + r)")); // 6.35
    assert_eq!(transmitted[1], expression("r*(r - 1)/(1 + r)^2")); // 6.36
    assert_eq!(f[1], expression("-1/(1 + r)")); // 6.37
    let zero = Fraction::zero();
    let velocity = observed(&scene, "interface_velocity", &zero, 0);
    assert_eq!(velocity[0], expression("r/(1 + r)")); // 6.38
    let equal_bars = velocity[0].substitute(&symbol("r"), &Fraction::one());
    assert_eq!(equal_bars, Ok(expression("1/2")));
}

/// 6.32 and 6.33 as steps from one period to the next.
#[test]
fn two_bars_go_on_by_6_32_and_6_33() {
    let scene = scene("two-bars");
    let (g, transmitted) = (pieces(&scene, "g", 20), pieces(&scene, "F", 20));
    let (one, two) = (Expression::one(), Expression::integer(2));
    let (over, reflected) = (expression("1/(1 + r)"), expression("1 - r"));
    for n in 1..=20 {
        let bracket = &one + &(&reflected * &g[n - 1]);
        assert_eq!(g[n], &-&bracket * &over);
        let bracket = &one + &(&two * &g[n - 1]);
        assert_eq!(transmitted[n], &(&bracket * &over) * &expression("r"));
    }
}

#[test]
fn two_bars_every_period_is_6_39_to_6_41() {
    let scene = scene("two-bars");
    let (g, transmitted) = (pieces(&scene, "g", 30), pieces(&scene, "F", 30));
    let force = observed(&scene, "force", &Fraction::zero(), 30);
    for n in 0..=30u32 {
        let at = n as usize;
        let difference = &Expression::one() - &rho_to_the(n + 1);
        assert_eq!(g[at], &expression("-1/2") * &difference); // 6.39
        assert_eq!(transmitted[at], &expression("r/(1 + r)") * &rho_to_the(n)); // 6.40
        assert_eq!(force[at], &expression("r/(1 + r)") * &rho_to_the(n)); // 6.41
    }
}

// ---- 6.7 Constant force, in X/EA and c X/EA ----------------------------------------------------

#[test]
fn constant_force_is_6_42_and_6_43() {
    let scene = scene("constant-force");
    let f = pieces(&scene, "f", 30);
    let velocity = observed(&scene, "velocity", &Fraction::zero(), 30);
    for n in 0..=30i64 {
        let at = usize::try_from(n).expect("not negative");
        assert_eq!(f[at], Expression::integer(n + 1)); // 6.42
        assert_eq!(velocity[at], Expression::integer(2 * n + 1)); // 6.43
    }
}

// ---- 6.9 Pulse shape ---------------------------------------------------------------------------

/// 6.71–6.75 are nested: each holds the values `α̃_i(μ)` of those before. They are written with
/// `A0 … A3` in their place, and each value is the printed formula before, at `t = μ`.
#[test]
fn pulse_shape_is_6_71_to_6_75() {
    let printed = [
        "1 - exp(-t)",
        "exp(-t)*(t + A0)",
        "exp(-t)*(-t^2/2 + t*(1 - A0) + A1)",
        "exp(-t)*(t^3/6 - t^2/2*(2 - A0) + t*(1 - A0 - A1) + A2)",
        // The page has + before t²/2; the recurrence 6.67 asks for −.
        "exp(-t)*(-t^4/24 + t^3/6*(3 - A0) - t^2/2*(3 - 2*A0 - A1) + t*(1 - A0 - A1 - A2) + A3)",
    ];
    let derived = pieces(&scene("pulse-shape"), "a", 4);
    let mut ends: Vec<Expression> = Vec::new();
    for (n, text) in printed.iter().enumerate() {
        let mut formula = expression(text);
        for (i, end) in ends.iter().enumerate() {
            formula = put(&formula, &symbol(&format!("A{i}")), end);
        }
        assert_eq!(derived[n], formula, "a[{n}]");
        let mu = Fraction::symbol(&symbol("mu"));
        ends.push(formula.substitute(&symbol("t"), &mu).expect("no denominators"));
    }
    let as_printed = expression("exp(-t)*t^2*(3 - 2*A0 - A1)");
    assert!(!as_printed.is_zero());
}

/// An expression with another one, which may hold exponentials, in place of a symbol.
fn put(formula: &Expression, x: &Symbol, value: &Expression) -> Expression {
    let mut sum = Expression::zero();
    for (exponent, fraction) in formula.terms() {
        assert!(!exponent.contains(x));
        let over = Fraction::from(fraction.denominator());
        assert_eq!(over, Fraction::one());
        for (power, coefficient) in fraction.numerator().coefficients(x) {
            let coefficient: Polynomial = coefficient;
            let part = Expression::from(coefficient).times_exponential(exponent);
            sum += &(&part * &value.pow(power));
        }
    }
    sum
}

#[test]
fn pulse_shape_force_is_the_compression() {
    let scene = scene("pulse-shape");
    assert_eq!(observed(&scene, "force", &Fraction::zero(), 6), pieces(&scene, "a", 6));
}

// ---- 6.10 Rigid mass, in V/c, with s = μz/L ----------------------------------------------------

#[test]
fn rigid_mass_is_6_76_to_6_82() {
    let scene = scene("rigid-mass");
    let f = pieces(&scene, "f", 3);
    let b_2 = "1 + exp(-2*mu)*(1 - 4*mu) + exp(-4*mu)";
    let b_3 = "1 + exp(-2*mu)*(1 - 8*mu + 8*mu^2) + exp(-4*mu)*(1 - 8*mu) + exp(-6*mu)";
    let printed = [
        "exp(-s)".to_owned(),                                      // 6.78
        "exp(-s)*(-2*s + 1 + exp(-2*mu))".to_owned(),              // 6.79, 6.80
        format!("exp(-s)*(2*s^2 - s*(4 + 2*exp(-2*mu)) + {b_2})"), // 6.81
        format!(
            "exp(-s)*(-4/3*s^3 + s^2*(6 + 2*exp(-2*mu))
             - 2*s*(3 + exp(-2*mu)*(2 - 4*mu) + exp(-4*mu)) + {b_3})"
        ), // 6.82
    ];
    for (n, printed) in printed.iter().enumerate() {
        assert_eq!(f[n], expression(printed), "f[{n}]");
    }
}

#[test]
fn rigid_mass_far_end_is_6_76() {
    let scene = scene("rigid-mass");
    let (f, g) = (pieces(&scene, "f", 30), pieces(&scene, "g", 30));
    assert!(g[0].is_zero());
    for n in 1..=30 {
        assert_eq!(g[n], -&f[n - 1]);
    }
}

/// What is observed, in printed waves: 6.83 and 6.84 at the mass, 6.85 one passage later at the
/// fixed end.
#[test]
fn rigid_mass_observables_are_6_83_to_6_85() {
    let scene = scene("rigid-mass");
    let f = pieces(&scene, "f", 12);
    let zero = Fraction::zero();
    let velocity = observed(&scene, "velocity", &zero, 12);
    let struck = observed(&scene, "strain_impact", &zero, 12);
    let fixed = observed(&scene, "strain_fixed", &Fraction::symbol(&symbol("mu")), 12);
    assert_eq!(velocity[0], expression("exp(-s)"));
    assert_eq!(struck[0], expression("-exp(-s)"));
    assert_eq!(velocity[1], expression("exp(-s)*(-2*s + exp(-2*mu))"));
    assert_eq!(struck[1], expression("-exp(-s)*(-2*s + 2 + exp(-2*mu))"));
    assert_eq!(fixed[1], expression("-2*exp(-s)*(-2*s + 1 + exp(-2*mu))"));
    for n in 1..=12 {
        assert_eq!(velocity[n], &f[n] - &f[n - 1]); // 6.83
        assert_eq!(struck[n], -&(&f[n] + &f[n - 1])); // 6.84
        assert_eq!(fixed[n], &Expression::integer(-2) * &f[n]); // 6.85
    }
}
