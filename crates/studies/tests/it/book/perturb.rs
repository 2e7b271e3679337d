//! Every equation that holds is changed in a sign or a number, everywhere one after the other, and must
//! not hold any more; and the derived formulas that are printed hold as they are printed.

use wavestep::language::syntax::{Expression, Factor, Node, Sign, Term};
use wavestep_studies::book::{Equation, Finding, Verdict, sections};

use super::{ALL, examined, judged};

/// Applies one change to the tree: the `at`-th place that can be changed; counts places down.
fn change(tree: &mut Expression, at: &mut usize) -> bool {
    match &mut tree.value {
        Node::Number(value) => {
            let found = is_here(at);
            if found {
                *value += num_rational::BigRational::from_integer(1.into());
            }
            found
        }
        Node::Name(_) | Node::Wave(_) | Node::Call { .. } => {
            let found = is_here(at);
            if found {
                tree.value = Node::Negate(Box::new(tree.clone()));
            }
            found
        }
        Node::Exponential(inner) | Node::Negate(inner) => change(inner, at),
        Node::Function { argument, .. } => change(argument, at),
        Node::Summation { term, .. } => change(term, at),
        Node::Sum(terms) => {
            for Term { sign, value } in terms {
                if is_here(at) {
                    *sign = match sign {
                        Sign::Plus => Sign::Minus,
                        Sign::Minus => Sign::Plus,
                    };
                    return true;
                }
                if change(value, at) {
                    return true;
                }
            }
            false
        }
        Node::Product(factors) => factors.iter_mut().any(|Factor { value, .. }| change(value, at)),
        Node::Power { base, exponent } => {
            // An even power hides a sign.
            let even =
                matches!(&exponent.value, Node::Number(n) if (n.numer() % 2_u32) == 0.into());
            let name = matches!(exponent.value, Node::Name(_));
            !even && change(base, at) || !name && change_exponent(exponent, at)
        }
    }
}

/// A change in `n + 1`: the number is another one.
fn change_exponent(exponent: &mut Expression, at: &mut usize) -> bool {
    match &mut exponent.value {
        Node::Sum(terms) => {
            let numbers = terms.iter_mut().map(|term| &mut term.value);
            numbers.filter(|value| matches!(value.value, Node::Number(_))).any(|n| change(n, at))
        }
        _ => change(exponent, at),
    }
}

/// Whether this is the place; counts down.
fn is_here(at: &mut usize) -> bool {
    let found = *at == 0;
    *at = at.wrapping_sub(1);
    found
}

/// Every equation that differs from this one in one place of its right side.
fn changed(equation: &Equation) -> Vec<Equation> {
    let mut all = Vec::new();
    for place in 0.. {
        let mut right = equation.right.clone();
        if !change(&mut right, &mut place.clone()) {
            return all;
        }
        all.push(Equation { right, ..equation.clone() });
    }
    unreachable!("a formula has an end")
}

#[test]
fn whatever_holds_can_fail() {
    let (mut equations, mut changes) = (0, 0);
    for section in sections() {
        let Some(stage) = section.stage() else { continue };
        for equation in section.entries.iter().flat_map(judged) {
            if !stage.judge(equation).expect("understood").holds() {
                continue;
            }
            equations += 1;
            let all = changed(equation);
            assert!(!all.is_empty(), "{equation}");
            for other in all {
                let found = stage.judge(&other).unwrap_or_else(|error| panic!("{other}: {error}"));
                let Finding::Fails(witness) = found else {
                    panic!("{other} holds as well as {equation}")
                };
                assert!(witness.is_certain(), "{other}: {witness}");
                changes += 1;
            }
        }
    }
    println!("{changes} changes of {equations} equations");
    assert!(equations >= 60 && changes >= 300, "{equations} {changes}");
}

/// The derived pieces, read back as they are printed, hold.
#[test]
fn printed_derivations_hold() {
    let mut held = 0;
    let stages: Vec<_> = sections().iter().map(|s| (s.number.as_str(), s.stage())).collect();
    for found in ALL.iter() {
        let number = found.section.number.as_str();
        let stage = stages.iter().find(|(own, _)| *own == number).and_then(|(_, s)| s.as_ref());
        let Some(stage) = stage else { continue };
        for formula in &found.derived {
            let line = formula.to_line();
            let Some((head, right)) = line.split_once(" = ") else { panic!("{line}") };
            // Values at the ends of periods are printed as alpha_tilde[0](mu).
            let mut right = right.to_owned();
            for n in 0..9 {
                right = right.replace(&format!("[{n}](mu)"), &format!("_{n}(mu)"));
            }
            let fixed = head.ends_with(']') && !head.contains('n') || head.starts_with("B_");
            if !fixed {
                continue;
            }
            let equation = Equation::read(&format!("{head} = {right}")).expect("reads back");
            assert!(stage.judge(&equation).expect("understood").holds(), "{line}");
            held += 1;
            if let Verdict::Refuted(slip) = &found.verdict {
                assert!(!stage.judge(&slip.0).expect("understood").holds(), "{line}");
            }
        }
    }
    assert!(held >= 20, "{held}");
}

/// The compression of 6.75 by echoes, computed here: phi_k(x) = e^-x (L_(k-1)(x) - L_k(x)).
#[test]
fn the_witness_of_6_75_is_right() {
    fn laguerre(k: u32, x: f64) -> f64 {
        let (mut before, mut now) = (0.0, 1.0);
        for j in 0..k {
            let j = f64::from(j);
            (before, now) = (now, ((2.0 * j + 1.0 - x) * now - j * before) / (j + 1.0));
        }
        now
    }
    let echo = |k: u32, x: f64| match k {
        0 => 1.0 - (-x).exp(),
        k => (-x).exp() * (laguerre(k - 1, x) - laguerre(k, x)),
    };
    let piece = |n: u32, t: f64| {
        let sum = |n: u32| (0..=n).map(|k| echo(k, t + f64::from(n - k))).sum::<f64>();
        if n == 0 { sum(0) } else { sum(n) - sum(n - 1) }
    };
    let t: f64 = 0.5;
    let ends: Vec<f64> = (0..4).map(|n| piece(n, 1.0)).collect();
    let by_source = |sign: f64| {
        let [a, b, c, d] = ends[..] else { panic!("four ends") };
        (-t).exp()
            * (-t.powi(4) / 24.0
                + t.powi(3) / 6.0 * (3.0 - a)
                + sign * t.powi(2) / 2.0 * (3.0 - 2.0 * a - b)
                + t * (1.0 - a - b - c)
                + d)
    };
    let found = examined("6.75");
    let Verdict::Refuted(slip) = &found.verdict else { panic!("refuted") };
    let told = slip.1.to_string();
    let values: Vec<f64> = told.split(' ').filter_map(|word| word.parse().ok()).collect();
    assert_eq!(slip.1.at.len(), 2);
    assert!((values[0] - piece(4, t)).abs() < 1e-11, "{told}");
    assert!((values[0] - by_source(-1.0)).abs() < 1e-11, "{told}");
    assert!((values[1] - by_source(1.0)).abs() < 1e-11, "{told}");
}
