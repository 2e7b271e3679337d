//! What is known for every n or k at once, against what is derived one by one.

use crate::support::{by_echoes, by_periods, fraction};
use std::cell::LazyCell;
use std::collections::BTreeMap;

use wavestep::Problem;
use wavestep::export::{self, TEXT_WIDTH};
use wavestep::expression::{Expression, Fraction};
use wavestep::language::{Source, read_expression, read_recurrence};
use wavestep::recurrence::{
    Clause, Fault, LinearForm, Observation, Recurrence, Statement, WaveIndex,
};
use wavestep::scenes;
use wavestep::solution::{
    EchoByEcho, EchoTable, EchoTemplate, Family, GeneralForm, Geometric, PeriodByPeriod, Proof,
    Solution,
};
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol, binomial, factorial};

fn read(text: &str) -> Recurrence {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let text = format!("recurrence \"test\"\n{}\n", lines.join("\n"));
    let source = Source::new("recurrence", &text).unwrap_or_else(|error| panic!("{error}"));
    read_recurrence(&source, &BTreeMap::new()).unwrap_or_else(|error| panic!("{error}"))
}

fn scene(name: &str) -> Recurrence {
    let text = scenes::find(name).expect("a scene of the library").text;
    let body = text.lines().filter(|line| !line.starts_with("recurrence"));
    read(&body.collect::<Vec<_>>().join("\n"))
}

fn expression(text: &str) -> Expression {
    let source = Source::new("expected", text).unwrap_or_else(|error| panic!("{error}"));
    read_expression(&source).unwrap_or_else(|error| panic!("{error}"))
}

// ---- Observables -------------------------------------------------------------------------------

/// An observable on a period, straight from what it observes and the pieces of its waves.
fn seen(
    recurrence: &Recurrence,
    observation: &Observation,
    offset: &Fraction,
    pieces: &[Vec<Expression>],
    n: usize,
) -> Expression {
    let Statement { local, time, period, .. } = recurrence.statement();
    let begins = offset + &period.scale(&Rational::from_integer(n.into()));
    let mut sum =
        observation.forcing.substitute(time, &(&begins + &Fraction::symbol(local))).unwrap();
    for seen in &observation.waves {
        let since = Expression::from(&begins - &seen.delay);
        let order = match since.is_zero() {
            true => Rational::default(),
            false => since.proportion(&period.clone().into()).expect("a number of periods"),
        };
        assert!(order.is_integer());
        let Ok(order) = usize::try_from(order.to_integer()) else { continue };
        let piece = &pieces[seen.wave][order];
        let piece = if seen.slope { piece.derivative(local) } else { piece.clone() };
        sum += &(&piece * &seen.coefficient);
    }
    sum
}

/// The n-th period of a general form: a value of the sequence, or the echoes that have arrived.
fn from_general(form: &GeneralForm, recurrence: &Recurrence, n: usize) -> Expression {
    let Statement { local, period, .. } = recurrence.statement();
    match form {
        GeneralForm::Geometric(form) => form.value(n),
        GeneralForm::Echoes(template) => (0..=n).fold(Expression::zero(), |sum, k| {
            let delay = period.scale(&Rational::from_integer((n - k).into()));
            &sum + &template.echo(k, local).shift(local, &delay).unwrap()
        }),
    }
}

/// The general form of every observable of the shipped scenes that has one gives what both derivations of its waves give.
#[test]
fn general_forms_of_observables_are_sums_of_those_of_their_waves() {
    const LAST: usize = 6;
    let mut known = BTreeMap::<&str, usize>::new();
    for scene in scenes::SCENES {
        let problem = Problem::builtin(scene.name).unwrap();
        let Ok(solution) = problem.solution() else { continue };
        let recurrence = solution.recurrence();
        let waves = recurrence.statement().waves.len();
        let derived = [by_periods, by_echoes]
            .map(|derive| LazyCell::new(move || derive(recurrence, LAST + 1)));
        for observable in &recurrence.statement().observables {
            let mut all = observable.observation.waves.iter();
            if all.any(|seen| solution.general(seen.wave).is_err()) {
                continue;
            }
            let Some((extended, offset)) = solution.with_observable(observable) else { continue };
            let form = extended.general(waves).unwrap_or_else(|_| panic!("{}", observable.name));
            *known.entry(scene.name).or_default() += 1;
            for n in 0..=LAST {
                let value = from_general(form, recurrence, n);
                for pieces in &derived {
                    let own = seen(recurrence, &observable.observation, &offset, pieces, n);
                    assert_eq!(value, own, "{}: {} on period {n}", scene.name, observable.name);
                }
            }
        }
    }
    let rigid = known.get("rigid-mass");
    assert!(
        rigid == Some(&3) && known["mass-on-fixed-bar"] == 3 && known.values().sum::<usize>() >= 20,
        "{known:?}"
    );
}

// ---- Echoes in closed form ---------------------------------------------------------------------

fn template(solution: &Solution, wave: WaveIndex) -> &EchoTemplate {
    match solution.general(wave) {
        Ok(GeneralForm::Echoes(template)) => template,
        other => panic!("wave {wave} has {other:?}"),
    }
}

/// Asserts that every wave has echoes in closed form, and that they are those derived one by one.
fn assert_templates_hold(name: &str, recurrence: &Recurrence, through: usize) {
    let solution = Solution::new(recurrence.clone());
    let mut solver = EchoByEcho::new(recurrence);
    (0..=through).for_each(|_| solver.advance().unwrap_or_else(|error| panic!("{error}")));
    for wave in 0..recurrence.statement().waves.len() {
        let template = template(&solution, wave);
        assert!(template.first.len() <= 4, "{name}: most echoes are given by the sum");
        let sum = solver.sum(wave);
        for (k, expected) in sum.echoes.iter().enumerate() {
            let echo = template.echo(k, &recurrence.statement().local);
            assert_eq!(echo, *expected, "{name}: echo {k} of wave {wave}");
        }
        assert_eq!(solution.general(wave).map(GeneralForm::proof), Ok(Proof::CoefficientIdentity));
    }
}

#[test]
fn templates_of_scenes_hold() {
    assert_templates_hold("rigid-mass", &scene("rigid-mass"), 30);
    assert_templates_hold("pulse-shape", &scene("pulse-shape"), 30);
}

#[test]
fn templates_of_other_recurrences_hold() {
    for (name, text) in [
        (
            "derivative delayed",
            "symbol D > 0
             period D, local s, time t
             wave f
             equation f[n]' + 2*f[n] = f[n-1]' - 3*f[n-1]
             continuous f[n] - f[n-1] starts at 1",
        ),
        (
            "power family",
            "symbol D > 0
             period D, local s, time t
             wave f
             equation f[n]' + f[n] = f[n-1]
             continuous f[n] starts at 1",
        ),
        (
            "power family with a ratio",
            "symbol D > 0, r > 0
             period D, local s, time t
             wave f
             equation f[n]' + f[n]/r = -3/2*r*f[n-1]
             continuous f[n] starts at 1/2",
        ),
        (
            "power family, resonant",
            "period 1, local s, time t
             wave f
             equation f[n]' + f[n] = f[n-1] + exp(-t)
             continuous f[n] starts at 2",
        ),
        (
            "Laguerre, resonant",
            "period 1, local s, time t
             wave f
             equation f[n]' + f[n] = f[n-1]' - f[n-1] + exp(-t)
             continuous f[n] - f[n-1] starts at 2",
        ),
        (
            "Laguerre, forced at its zero",
            "period 1, local s, time t
             wave f
             equation f[n]' + f[n] = f[n-1]' - 2*f[n-1] + exp(2*t)
             continuous f[n] - f[n-1] starts at 0",
        ),
        (
            "ratio other than 1",
            "symbol r > 0
             period 2, local s, time t
             wave f
             equation f[n]' + f[n] = r/3*(f[n-1]' - f[n-1])
             continuous f[n] - r/3*f[n-1] starts at 1",
        ),
        (
            "wave of two lags",
            "period 2, local s, time t
             wave f, g
             equation f[n]' + f[n] = 2*(f[n-1]' - f[n-1])
             equation g[n] = f[n] - 5*f[n-2]
             continuous f[n] - 2*f[n-1] starts at 1",
        ),
        (
            "symbols as poles",
            "symbol D > 0, a > 0, b > 0
             period D, local s, time t
             wave f
             equation f[n]' + b*f[n] = f[n-1]' - a*f[n-1]
             continuous f[n] - f[n-1] starts at a",
        ),
        (
            "rule of two lags",
            "period 1, local s, time t
             wave f
             equation f[n]' + f[n] = f[n-1]' - f[n-1]
             continuous f[n] - f[n-1] starts at 1",
        ),
    ] {
        let through = if name == "symbols as poles" { 12 } else { 30 };
        assert_templates_hold(name, &read(text), through);
    }
}

/// Where no closed form is found, saying so is right; a wrong closed form is not. Whatever is
/// claimed here agrees with the solution period by period.
#[test]
fn claims_about_intricate_recurrences_hold() {
    for text in [
        "period 1, local s, time t
         wave f, g
         equation g[n] = f[n-1]'
         equation f[n]' + f[n] = f[n-1]
         continuous f[n] + g[n] starts at 1",
        "period 1, local s, time t
         wave f, g
         equation g[n] = exp(-t)
         equation f[n]' + f[n] = f[n-1] + g[n-1]
         continuous f[n] starts at 1",
        "period 1, local s, time t
         wave f, g
         equation g[n] = 2 - f[n]
         equation f[n]' + f[n] = f[n-1]' + 3*f[n-1] - g[n-1]
         continuous f[n] + g[n-1] starts at 1",
        "period 2, local s, time t
         wave f, g
         equation g[n] = exp(-t) + f[n-1]
         equation f[n]' + f[n] = f[n-1]' - f[n-1] + g[n-1]' + g[n-1]
         continuous f[n] - f[n-1] - g[n-1] starts at 1",
        "period 1, local s, time t
         wave f
         equation f[n]' + f[n] = 2*f[n-1]' - f[n-1]
         continuous f[n] - f[n-1] starts at 1",
        "period 1, local s, time t
         wave f
         equation f[n]' + f[n] = exp(-2*t)
         continuous f[n] - f[n-1] + f[n-2] starts at 1",
        "period 1, local s, time t
         wave f
         equation f[n]' = exp(-t) - sum(f[i], i < n)
         continuous f[n] starts at 1",
        "period 1, local s, time t
         wave f, g
         equation g[n] = t
         equation f[n] = f[n-1] + 1
         ",
        "period 1, local s, time t
         wave f, g
         equation g[n] = 3*f[n-2] - t
         equation f[n]' + f[n] = f[n-1] + 1
         continuous f[n] starts at 0",
    ] {
        let recurrence = read(text);
        let solution = Solution::new(recurrence.clone());
        let mut solver = PeriodByPeriod::new(&recurrence);
        (0..=7).for_each(|_| solver.advance().unwrap_or_else(|error| panic!("{error}")));
        for (wave, expected) in solver.pieces().iter().enumerate() {
            let pieces = solution.pieces(wave, 0, 7).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(&pieces, expected, "wave {wave} of\n{text}");
            if let Ok(GeneralForm::Geometric(form)) = solution.general(wave) {
                let values: Vec<Expression> = (0..=7).map(|n| form.value(n)).collect();
                assert_eq!(&values, expected, "wave {wave} of\n{text}");
            }
        }
    }
}

/// `L_k(cx) = Σ_j C(k,j) (−c)^j x^j/j!`, with numbers and with a symbol.
#[test]
fn laguerre_polynomials_are_sums_of_binomials() {
    let x = Symbol::new("x").unwrap();
    for c in ["2", "-1/3", "a", "a + 1/2"] {
        let c = fraction(c);
        for k in 0..=12u32 {
            let mut expected = Fraction::zero();
            for j in 0..=k {
                let weight = Rational::new(binomial(k, j), factorial(j));
                let power = Polynomial::monomial(&weight, &[(&x, j)]);
                expected = &expected + &(&(-&c).pow(j) * &power.into());
            }
            let found = Family::Laguerre(c.clone()).function(k as usize, &x);
            assert_eq!(found, expected, "L_{k}({c} x)");
        }
    }
}

// ---- Sequences ---------------------------------------------------------------------------------

fn sequence(solution: &Solution, wave: WaveIndex) -> &Geometric {
    match solution.general(wave) {
        Ok(GeneralForm::Geometric(form)) => form,
        other => panic!("wave {wave} has {other:?}"),
    }
}

/// Asserts that every wave is a sequence in general n, with this many values before the sum holds.
fn assert_sequences_hold(recurrence: &Recurrence, first: &[usize]) {
    let solution = Solution::new(recurrence.clone());
    let mut solver = PeriodByPeriod::new(recurrence);
    (0..=30).for_each(|_| solver.advance().unwrap_or_else(|error| panic!("{error}")));
    for (wave, expected) in solver.pieces().iter().enumerate() {
        let form = sequence(&solution, wave);
        assert_eq!(form.first.len(), first[wave], "{form:?}");
        for (n, value) in expected.iter().enumerate() {
            assert_eq!(form.value(n), *value, "n = {n}");
        }
    }
}

#[test]
fn sequences_of_scenes_hold() {
    assert_sequences_hold(&scene("two-bars"), &[0, 0, 0]);
    let constant_force = scene("constant-force");
    assert_sequences_hold(&constant_force, &[0]);
    let solution = Solution::new(constant_force);
    let form = sequence(&solution, 0);
    assert!(form.terms.iter().any(|term| term.power == 1), "a double root gives n·1^n: {form:?}");
}

#[test]
fn sequences_of_other_recurrences_hold() {
    let of = |equations: &str| {
        read(&format!("symbol r > 0\nperiod 1, local s, time t\nwave f\nequation {equations}"))
    };
    assert_sequences_hold(&of("f[n] = 5*f[n-1] - 6*f[n-2] + 1"), &[0]);
    assert_sequences_hold(&of("f[n] = 4*f[n-1] - 4*f[n-2] + r"), &[0]);
    assert_sequences_hold(&of("6*f[n] = 5*f[n-1] - f[n-2] + exp(-r)"), &[0]);
    assert_sequences_hold(&of("f[n] = 3*f[n-1] - 3*f[n-2] + f[n-3] + 1"), &[0]);
    assert_sequences_hold(&of("f[n] = -r*f[n-1] + 1"), &[0]);
    assert_sequences_hold(&of("f[n] = 7"), &[0]);
}

/// Values that the sum does not give: a wave that only begins after some periods.
#[test]
fn sequences_may_start_late() {
    let recurrence = read(
        "symbol r > 0
         period 1, local s, time t
         wave f, g
         equation f[n] = 2*f[n-1] + 1
         equation g[n] = f[n-3] + r",
    );
    assert_sequences_hold(&recurrence, &[0, 2]);
}

/// Irrational ratios are not found, and that is said; the pieces are there all the same.
#[test]
fn irrational_ratios_are_unknown() {
    let text = "period 1, local s, time t\nwave f\nequation f[n] = f[n-1] + f[n-2] + 1";
    let solution = Solution::new(read(text));
    assert!(solution.general(0).is_err());
    let pieces = solution.pieces(0, 0, 5).unwrap_or_else(|error| panic!("{error}"));
    let expected = [1, 2, 4, 7, 12, 20].map(Expression::integer);
    assert_eq!(pieces, expected);
}

#[test]
fn two_poles_are_unknown() {
    let recurrence = read(
        "period 1, local s, time t
         wave u, v
         equation u[n]' + u[n] = v[n-1]
         equation v[n]' + 2*v[n] = u[n]
         continuous u[n] starts at 1
         continuous v[n] starts at 0",
    );
    let solution = Solution::new(recurrence);
    assert!(solution.general(0).is_err() && solution.general(1).is_err());
}

// ---- Pieces, term by term ----------------------------------------------------------------------

fn table(solution: &Solution, wave: WaveIndex, through: usize) -> EchoTable {
    let table = solution.table(wave, through).unwrap_or_else(|error| panic!("{error}"));
    table.expect("the constants are numbers")
}

#[test]
fn streamed_terms_add_up_to_pieces() {
    for (name, wave) in [("rigid-mass", 0), ("rigid-mass", 1), ("pulse-shape", 0)] {
        let solution = Solution::new(scene(name));
        let statement = solution.recurrence().statement();
        let (s, period) = (Fraction::symbol(&statement.local), &statement.period);
        let table = table(&solution, wave, 12);
        let pieces = solution.pieces(wave, 0, 12).unwrap_or_else(|error| panic!("{error}"));
        for (n, piece) in pieces.iter().enumerate() {
            let mut sum = Expression::zero();
            table.for_each_term(n, |term| {
                let (i, l) = (term.local_power, term.period_power);
                let below = term.denominator * factorial(i) * factorial(l);
                let value = Rational::new(term.numerator.to_integer(), below);
                let age = Rational::from_integer(term.age.into());
                let exponent = (&s + &period.scale(&age)).scale(term.rate);
                sum.add_term(exponent, (&s.pow(i) * &period.pow(l)).scale(&value));
            });
            assert_eq!(sum, *piece, "{name}: {n}");
        }
    }
}

/// The coefficient of `e^{−s−mD} s^j/j! D^l/l!` in `f_n` is `C(k,i) (−2)^i m^l`, `k = n − m`,
/// `i = j + l`; with `D = 2μ` the period form of 6.80–6.82.
#[test]
fn rigid_mass_period_form_is_closed() {
    let solution = Solution::new(scene("rigid-mass"));
    let table = table(&solution, 0, 80);
    for n in [0usize, 1, 7, 30] {
        let mut count = 0;
        table.for_each_term(n, |term| {
            let (m, j, l) = (term.age, term.local_power, term.period_power);
            let (k, i) = (n as u32 - m, j + l);
            let power = |base: i64, exponent: u32| Integer::from(base).pow(exponent);
            let expected = binomial(k, i) * power(-2, i) * power(m.into(), l);
            let found = Rational::new(term.numerator.to_integer(), term.denominator.clone());
            assert_eq!(found, expected.into());
            assert_eq!(*term.rate, Rational::from_integer((-1).into()));
            count += 1;
        });
        // (k+1)(k+2)/2 terms an echo of age m = n − k > 0, and k + 1 for the youngest.
        let expected = (0..n).map(|k| (k + 1) * (k + 2) / 2).sum::<usize>() + n + 1;
        assert_eq!(count, expected, "n = {n}");
    }
    let mut count = 0usize;
    table.for_each_term(80, |_| count += 1);
    assert_eq!(count, 88_641);
}

#[test]
fn a_wave_that_never_comes_back_has_one_echo() {
    let recurrence = read(
        "symbol r > 1\nperiod 1, local s, time t\nwave f\nequation f[n]' + f[n] = 0\n\
         continuous (r - 1)*f[n] starts at 1",
    );
    assert_templates_hold("never back", &recurrence, 6);
    let solution = Solution::new(recurrence);
    let template = template(&solution, 0);
    assert!(template.terms.is_empty());
    assert_eq!(template.first[0], expression("exp(-s)/(r - 1)"));
}

#[test]
fn names_in_general_forms_are_free() {
    let text = |text: &str| {
        let solution = Solution::new(read(text));
        match solution.general(0) {
            Ok(form) => {
                export::text(&export::general_form(solution.recurrence(), 0, form), TEXT_WIDTH)
            }
            Err(unknown) => export::operator_of(solution.recurrence(), unknown),
        }
    };
    let index = text(
        "symbol k > 0\nperiod k, local j, time t\nwave f\nequation f[n]' + k*f[n] = -f[n-1]\n\
         continuous f[n] starts at 1",
    );
    assert!(index.contains("phi_f[m](j) = (-1)^m*exp(-k*j)*j^m/m!"), "{index}");
    let operator = text(
        "symbol p > 0, q > 0\nperiod 1, local s, time t\nwave f\n\
         equation f[n]' + p*f[n] + q*f[n-1] + f[n-2] = 0\ncontinuous f[n] starts at 1",
    );
    assert_eq!(operator, "(z^2 + q*z + P + p)*f = 0");
}

#[test]
fn products_of_too_high_a_degree_are_refused() {
    let chain = |power: u32| {
        let mut text =
            String::from("recurrence \"chain\"\nsymbol c > 0\nperiod 1, local s, time t\n");
        text.push_str("wave a, b, d, e, g\n");
        for (wave, before) in [("b", "a"), ("d", "b"), ("e", "d"), ("g", "e")] {
            text.push_str(&format!("equation {wave}[n] = c^{power}*{before}[n]\n"));
        }
        text.push_str(&format!("equation a[n] = c^{power}*g[n-1] + 1\n"));
        read_recurrence(&Source::new("chain", text).unwrap(), &BTreeMap::new())
    };
    assert!(chain(1000).unwrap_err().message().contains("too high a degree"));
    let solution = Solution::new(chain(300).unwrap());
    assert_eq!(solution.pieces(4, 0, 0).unwrap(), [expression("c^1000*c^200")]);
    assert!(solution.pieces(4, 0, 3).is_err());
    assert!(solution.general(4).is_err());
}

#[test]
fn ill_formed_statements_are_refused() {
    let good = scene("rigid-mass").statement().clone();
    let refused = |form: LinearForm| {
        let mut statement = good.clone();
        statement.equations[1].add_scaled(&form, &Expression::one(), 0);
        let invalid = Recurrence::new(statement).unwrap_err();
        assert_eq!((invalid.clause, invalid.fault), (Clause::Equation(1), Fault::IllFormed));
    };
    refused(LinearForm::wave(7, 1));
    refused(LinearForm::wave(0, 1).scaled(&expression("t")));
    refused(LinearForm::forcing(expression("s")));
    refused(LinearForm::forcing(expression("exp(t^2)")));
    refused(LinearForm::forcing(expression("1/(1 + t)")));
    assert!(Recurrence::new(good.clone()).is_ok());
    let mut statement = good.clone();
    statement.continuity[0].start = expression("t");
    assert_eq!(Recurrence::new(statement).unwrap_err().clause, Clause::Continuity(0));
}

// ---- Observables -------------------------------------------------------------------------------

/// Lags that differ by no whole period cut a period into stretches.
#[test]
fn arrivals_cut_a_period_into_stretches() {
    let text = scenes::find("constant-force").expect("a scene of the library").text;
    let body = text.lines().filter(|line| !line.starts_with("recurrence"));
    let body = body.collect::<Vec<_>>().join("\n");
    let solution =
        Solution::new(read(&format!("{body}\nobserve middle = f(t - 1/2) + f(t - 3/2)")));
    let middle = solution.recurrence().observation("middle").expect("an observable");
    let stretches = solution.observed_between_arrivals(&middle, 0, 0).expect("two stretches");
    let told: Vec<_> = stretches.iter().map(|s| (s.from.to_string(), s.value.clone())).collect();
    let number = Expression::integer;
    assert_eq!(told, [("1/2".to_owned(), number(1)), ("3/2".to_owned(), number(2))]);
    assert_eq!(stretches[1].to.to_string(), "5/2");
}
