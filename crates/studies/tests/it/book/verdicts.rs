//! Which verdict each equation has.

use num_rational::BigRational;
use wavestep::ball::Ball;
use wavestep::expression::Expression;
use wavestep::recurrence::LinearForm;
use wavestep_studies::book::{
    Content, Equation, Finding, Ground, Refusal, Verdict, Witness, find, sections,
};

use super::{ALL, entries, examined, judged};

const REFUTED: [&str; 2] = ["6.54", "6.75"];

const UNSURE: [&str; 5] = ["6.31", "6.39", "6.71-constant", "6.81", "6.91a"];

const CHECKED: [&str; 3] = ["6.10-energy", "6.86", "6.100"];

const DEFINITIONS: [&str; 15] = [
    "6.49", "6.53", "6.56", "6.57", "6.65", "6.66", "6.87", "6.88", "6.89", "6.90", "6.91", "6.92",
    "6.93", "6.94", "6.97",
];

#[test]
fn every_number_is_there_once() {
    let numbers: Vec<&str> = entries().map(|(_, entry)| entry.number.as_str()).collect();
    for n in 29..=100 {
        let number = format!("6.{n}");
        let count = numbers.iter().filter(|own| **own == number).count();
        assert_eq!(count, 1, "{number}");
    }
    let mut others: Vec<&str> =
        numbers.iter().copied().filter(|n| n[2..].parse::<u32>().is_err()).collect();
    others.sort_unstable();
    assert_eq!(
        others,
        [
            "6.10-energy",
            "6.6-equal-bars",
            "6.6-restitution",
            "6.6-separation",
            "6.7-acceleration",
            "6.7-limit",
            "6.71-constant",
            "6.91a"
        ]
    );
}

#[test]
fn every_equation_has_its_verdict() {
    for found in ALL.iter() {
        let number = found.entry.number.as_str();
        let is = |list: &[&str]| list.contains(&number);
        match &found.verdict {
            Verdict::Proved(grounds) => {
                let other = [&REFUTED[..], &UNSURE, &CHECKED, &DEFINITIONS].concat();
                assert!(!is(&other), "{number} is proved");
                assert!(!grounds.is_empty(), "{number}");
            }
            Verdict::Refuted(slip) => {
                assert!(is(&REFUTED), "{number}: {}", slip.1);
                assert!(slip.1.is_certain(), "{number}");
                assert!(!found.derived.is_empty(), "{number}");
                assert_eq!(found.entry.unsure, None, "a slip needs a clear reading: {number}");
            }
            Verdict::Unsure(readings) => {
                assert!(is(&UNSURE) && found.entry.unsure.is_some(), "{number}");
                let supported = readings.iter().filter(|(_, finding)| finding.holds()).count();
                assert_eq!(supported, 1, "{number}");
                assert!(!found.derived.is_empty(), "{number}");
            }
            Verdict::Checked(_) => assert!(is(&CHECKED), "{number}"),
            Verdict::Definition => {
                let shown = found.entry.latex.is_some();
                let stated =
                    matches!(&found.entry.content, Content::Definition(e) if !e.is_empty());
                assert!(is(&DEFINITIONS) && (shown || stated), "{number}");
            }
        }
    }
}

/// What is about every n is proved for every n.
#[test]
fn general_equations_have_general_proofs() {
    let mut general = 0;
    for section in sections() {
        let Some(stage) = section.stage() else { continue };
        for equation in section.entries.iter().flat_map(judged) {
            let text = equation.to_string();
            let is_general = text.contains("[n") || text.contains("^n") || text.contains("< n)");
            let finding = stage.judge(equation).expect("understood");
            let Finding::Holds(ground) = finding else { continue };
            match ground {
                Ground::EveryPeriod | Ground::EveryPower | Ground::Continuity => {
                    assert!(is_general, "{text}");
                    general += 1;
                }
                Ground::SameExpression => assert!(!is_general, "{text}"),
                Ground::PeriodsThrough(_) => panic!("{text} is not proved"),
            }
        }
    }
    assert!(general >= 28, "{general}");
}

/// Where pieces agree and no proof is found, nothing more is said.
#[test]
fn agreement_on_some_periods_is_no_proof() {
    let judge = |number: &str, text: &str| {
        let stage = find(number).expect("there").0.stage().expect("a scene");
        stage.judge(&Equation::read(text).expect("read")).expect("understood")
    };
    // Zero on the first periods, and not after them.
    assert!(!judge("6.76", "g[n] = -f[n-1] + f[n-9]").holds());
    let slip = "v[n] = c*X/(E*A)*(2*n + 1) + n*(n - 1)*(n - 2)*(n - 3)*(n - 4)*(n - 5)";
    assert_eq!(judge("6.43", slip), Finding::Holds(Ground::PeriodsThrough(5)));
    let slip =
        "f_prime[n]*rho = X/(E*A)*rho*(n + 1) + rho*n*(n - 1)*(n - 2)*(n - 3)*(n - 4)*(n - 5)*2^n";
    assert_eq!(judge("6.43", slip), Finding::Holds(Ground::PeriodsThrough(5)));
}

#[test]
fn what_is_continuous_is_what_the_scene_says() {
    let stage = find("6.76").expect("there").0.stage().expect("a scene");
    let judge = |text: &str| stage.judge(&Equation::read(text).expect("read")).expect("understood");
    assert!(!judge("f[n] - f[n-1] starts at 2*V/c").holds());
    assert!(!judge("f[n] starts at V/c").holds());
    assert!(judge("c*f[n] - c*f[n-1] starts at V").holds());
    assert!(judge("2*v_0[n] starts at 2*V").holds());
}

/// A form is proved to be zero by the equations of its scene, never by those of another.
#[test]
fn relations_follow_from_equations_or_do_not() {
    let stage = |number: &str| find(number).expect("there").0.stage().expect("a scene");
    for (number, slope) in [("6.76", true), ("6.62", true), ("6.29", false), ("6.42", false)] {
        let stage = stage(number);
        let (solution, count) = (stage.solution(), stage.solution().recurrence().wave_count());
        assert!(solution.is_always_zero(&LinearForm::zero()));
        for wave in 0..count {
            assert!(!solution.is_always_zero(&LinearForm::wave(wave, 9)), "{number}");
            assert!(!solution.is_always_zero(&LinearForm::sum(wave, 0)), "{number}");
        }
        assert!(!solution.is_always_zero(&LinearForm::forcing(Expression::one())));
        for equation in &solution.recurrence().statement().equations {
            assert!(solution.is_always_zero(equation), "{number}");
            let mut other = equation.clone();
            other.add_scaled(&LinearForm::wave(0, 9), &Expression::one(), 0);
            assert!(!solution.is_always_zero(&other), "{number}");
        }
        let slopes = solution.recurrence().statement().equations.iter();
        let slopes = slopes.flat_map(LinearForm::operators).any(|(_, o)| !o.slope.is_empty());
        assert_eq!(slopes, slope, "{number}");
    }
}

#[test]
fn witnesses_are_certain_only_where_enclosures_are_apart() {
    let ball =
        |value: i64, bits| Ball::from_rational(&BigRational::new(value.into(), 3.into()), bits);
    let witness = |left, right| Witness { period: None, at: Vec::new(), left, right };
    assert!(witness(ball(1, 64), ball(2, 64)).is_certain());
    assert!(!witness(ball(1, 64), ball(1, 90)).is_certain());
}

#[test]
fn what_cannot_be_understood_is_refused() {
    let (section, _) = find("6.76").expect("there");
    let stage = section.stage().expect("a scene");
    for (text, expected) in [
        ("h[n] = 1", Refusal::UnknownName("h".to_owned())),
        ("h_2(0) = 1", Refusal::UnknownName("h".to_owned())),
        ("f[n]*f[n-1] = 1", Refusal::NotLinear),
        ("f[n]/f[n-1] = 1", Refusal::NotLinear),
        ("f[n+1] = 1", Refusal::DependsOnPeriod),
        ("exp(f[n]) = 1", Refusal::DependsOnPeriod),
        ("f[0] = 1/(exp(z) + 1)", Refusal::NotInvertible),
        ("f[0] = cos(z)", Refusal::Function("cos".to_owned())),
        ("f[0] = W", Refusal::NoValue("W".to_owned())),
    ] {
        let refusal = stage.judge(&Equation::read(text).expect("read"));
        assert_eq!(refusal, Err(expected), "{text}");
    }
    for text in ["f[0]", "f[0] = ", "f[0] = 1 when r", "f[0] starts at", "= 1"] {
        assert!(
            matches!(Equation::read(text), Err(Refusal::Text(_) | Refusal::NoMark { .. })),
            "{text}"
        );
    }
}

/// What is known of the largest strain without this library: for 1/mu = 1 it is 2 (1 + e^-2), where the
/// second front is felt at the fixed end; for a light mass the first front alone, 2.
#[test]
fn estimates_are_measured_against_what_is_known() {
    let better = examined("6.86");
    let line = |mass: &str| {
        let start = format!("1/mu = {mass}: exact ");
        let found = better.steps.iter().find_map(|step| step.strip_prefix(&start));
        let digits = found.and_then(|rest| rest.split(',').next()).expect("a step");
        digits.parse::<f64>().expect("a number")
    };
    assert!((line("1") - 2.0 * (1.0 + (-2.0_f64).exp())).abs() < 5e-6);
    assert!((line("1/2") - 2.0 * (1.0 + (-4.0_f64).exp())).abs() < 5e-6);
    assert!((line("1/4") - 2.0 * (1.0 + (-8.0_f64).exp())).abs() < 5e-6);
    let bound = |number: &str| {
        let Verdict::Checked(told) = &examined(number).verdict else { panic!("an estimate") };
        let percent = told.strip_prefix("off by up to ").and_then(|rest| rest.split(' ').next());
        percent.expect("a bound").parse::<f64>().expect("a number")
    };
    let (energy, better) = (bound("6.10-energy"), bound("6.86"));
    // (1/4 + 1/3)^(1/2) and 1 more, against 2.00067.
    let root = (7.0_f64 / 12.0).sqrt();
    let off = |estimate: f64| 100.0 * (1.0 - estimate / (2.0 * (1.0 + (-8.0_f64).exp())));
    assert!(energy >= off(root) && energy < off(root) + 0.1, "{energy}");
    assert!(better >= off(1.0 + root) && better < off(1.0 + root) + 0.1, "{better}");
}
