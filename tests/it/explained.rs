//! Steps of an explained derivation: each is an identity, and what is printed is what was computed.

use crate::formulas::assert_sound_latex;
use crate::support::{by_echoes, form_on_period};
use std::collections::BTreeMap;
use wavestep::Problem;
use wavestep::export::{LATEX_WIDTH, Notation};
use wavestep::expression::{Expression, Fraction};
use wavestep::language::{Source, read_expression};
use wavestep::problem::{Form, Orders};
use wavestep::recurrence::{Recurrence, Start, Step};
use wavestep::scenes::SCENES;
use wavestep::solution::{
    EchoByEcho, EchoTemplate, GeneralForm, Integration, PeriodByPeriod, PieceSteps, SequenceStep,
    Solution, Solved, laplace, solved_for_waves,
};
use wavestep_polynomial::{Rational, Symbol};

const LAST: usize = 4;

/// Scenes without periods: their travel times have no common measure, or a contact has a power.
const WITHOUT: [&str; 3] = ["incommensurate", "local-contact", "hertz-striker"];

/// What no shipped scene has: echoes that are powers, and real modes.
const OTHERS: [(&str, &str); 2] = [
    (
        "powers",
        "recurrence \"Powers\"\nsymbol D > 0\nperiod D, local s, time t\nwave f\n\
         equation f[n]' + f[n]/3 = -2*f[n-1]\ncontinuous f[n] starts at 1\n",
    ),
    (
        "modes",
        "scene \"Modes\"\nmass hammer { mass = 1, velocity = 1 }\nspring cushion { stiffness = 9/2 }\n\
         bar rod { impedance = 1, travel = 1 }\nline free - hammer | cushion - rod - fixed\n",
    ),
];

fn problems() -> impl Iterator<Item = (&'static str, Problem)> {
    let shipped = SCENES.iter().map(|scene| (scene.name, scene.text));
    let with_periods = shipped.filter(|(name, _)| !WITHOUT.contains(name)).chain(OTHERS);
    with_periods.map(|(name, text)| (name, Problem::read(name, text).expect(name)))
}

fn with_factor(value: &Expression, exponent: &Fraction) -> Expression {
    value.clone().times_exponential(exponent)
}

/// The first identity that the steps break, `pieces[wave][n]` being known.
fn broken(
    recurrence: &Recurrence,
    pieces: &[Vec<Expression>],
    (solved, steps, n): (&Solved<'_>, &PieceSteps, usize),
) -> Option<&'static str> {
    let statement = recurrence.statement();
    let (x, Step { wave, start, .. }) = (&statement.local, solved.step);
    let PieceSteps { right, integration, piece } = steps;
    let holds = |name, holds: bool| (!holds).then_some(name);
    let of_all = holds("the piece", *piece == pieces[*wave][n]).or_else(|| {
        holds("the right side", *right == form_on_period(recurrence, &solved.right, pieces, n))
    });
    let (Some(start), Some(steps)) = (start, integration) else {
        return of_all.or_else(|| holds("the substitution", piece == right));
    };
    let Start { rate, continuous, initial } = start;
    let Integration { integrand, integral, beside, before, constant } = steps;
    let exponent = rate * &Fraction::symbol(x);
    let product = with_factor(piece, &exponent);
    let at_start = form_on_period(recurrence, continuous, pieces, n).at_zero(x);
    let at_end = n.checked_sub(1).map(|m| {
        let form = form_on_period(recurrence, continuous, pieces, m);
        form.substitute(x, &statement.period).expect("a period")
    });
    of_all
        .or_else(|| holds("the equation", &piece.derivative(x) + &piece.times(rate) == *right))
        .or_else(|| holds("the factor", *integrand == with_factor(right, &exponent)))
        .or_else(|| holds("the product rule", product.derivative(x) == *integrand))
        .or_else(|| holds("the integral", integral.derivative(x) == *integrand))
        .or_else(|| holds("the lower limit", integral.at_zero(x).is_zero()))
        .or_else(|| holds("the constant", &product - integral == *constant))
        .or_else(|| holds("the start", piece.at_zero(x) == *constant))
        .or_else(|| holds("what stands beside", constant + beside == *before))
        .or_else(|| holds("continuity", *before == at_start))
        .or_else(|| holds("the end before", *before == at_end.unwrap_or(initial.clone())))
}

/// Calls with every step of a recurrence, and all pieces through its period.
fn each_step(
    recurrence: &Recurrence,
    mut call: impl FnMut(&[Vec<Expression>], (&Solved<'_>, &PieceSteps, usize)),
) {
    let solved = solved_for_waves(recurrence);
    let mut solver = PeriodByPeriod::new(recurrence);
    for n in 0..=LAST {
        solver.advance().unwrap_or_else(|error| panic!("{error}"));
        for solved in &solved {
            let steps = solver.steps(solved, n).unwrap_or_else(|error| panic!("{error}"));
            call(solver.pieces(), (solved, &steps, n));
        }
    }
}

#[test]
fn each_step_is_an_identity_and_leads_to_the_pieces() {
    let (mut integrated, mut substituted) = (0, 0);
    for (name, problem) in problems() {
        let recurrence = problem.recurrence().expect("periods");
        let echoes = by_echoes(recurrence, LAST);
        each_step(recurrence, |pieces, step @ (solved, steps, n)| {
            let wave = solved.step.wave;
            let at = format!("{name}: {}[{n}]", recurrence.wave_name(wave));
            assert_eq!(broken(recurrence, pieces, step), None, "{at}");
            if let Some(echoes) = echoes.get(wave) {
                assert_eq!(steps.piece, echoes[n], "{at}: echo by echo");
            }
            match steps.integration {
                Some(_) => integrated += 1,
                None => substituted += 1,
            }
        });
    }
    assert!(integrated > 50 && substituted > 200, "{integrated}, {substituted}");
}

/// A sign that is turned in one step, wherever it is not zero.
#[test]
fn a_wrong_sign_is_noticed() {
    type Turn = fn(&mut PieceSteps) -> &mut Expression;
    fn inner(steps: &mut PieceSteps) -> &mut Integration {
        steps.integration.as_mut().expect("a step that integrates")
    }
    let turns: [(&str, Turn); 7] = [
        ("piece", |steps| &mut steps.piece),
        ("right", |steps| &mut steps.right),
        ("integrand", |steps| &mut inner(steps).integrand),
        ("integral", |steps| &mut inner(steps).integral),
        ("beside", |steps| &mut inner(steps).beside),
        ("before", |steps| &mut inner(steps).before),
        ("constant", |steps| &mut inner(steps).constant),
    ];
    let mut turned = BTreeMap::new();
    for (name, problem) in problems().filter(|(name, _)| ["rigid-mass", "pile"].contains(name)) {
        let recurrence = problem.recurrence().expect("periods");
        each_step(recurrence, |pieces, (solved, steps, n)| {
            for (part, turn) in &turns[..if steps.integration.is_some() { 7 } else { 2 }] {
                let mut wrong = steps.clone();
                let value = turn(&mut wrong);
                if !value.is_zero() {
                    *value = -&*value;
                    let noticed = broken(recurrence, pieces, (solved, &wrong, n)).is_some();
                    assert!(noticed, "{name}: {part} on period {n}");
                    *turned.entry(part.to_owned()).or_insert(0) += 1;
                }
            }
        });
    }
    assert_eq!(turned.len(), turns.len(), "{turned:?}");
}

fn read(text: &str) -> Expression {
    let source = Source::new("printed", text).unwrap_or_else(|error| panic!("{text}: {error}"));
    read_expression(&source).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Whether a printed equation `head = right` is one of a step: then it must be true.
fn printed(
    step: (&Solved<'_>, &PieceSteps),
    wave: &str,
    x: &Symbol,
    head: &str,
    right: &str,
) -> bool {
    let (Solved { step, .. }, PieceSteps { right: known, integration, piece }) = step;
    let (whole, start) = (format!("{wave}({x})"), format!("{wave}(0)"));
    let (Some(rule), Some(steps)) = (&step.start, integration) else {
        assert!(head != whole || read(right) == *piece, "{head} = {right}");
        return head == whole;
    };
    // A symbol for the wave at the beginning.
    let started = |text: &str| read(&text.replace(&start, "begin"));
    let begin = Expression::symbol(&Symbol::new("begin").unwrap());
    let factor = with_factor(&Expression::one(), &(&rule.rate * &Fraction::symbol(x)));
    let product = head.strip_suffix(&format!("*{whole}"));
    let slope = head.strip_suffix(&format!("*{wave})'")).and_then(|head| head.strip_prefix('('));
    let holds = if right.contains(&start) {
        product.is_none_or(|head| read(head) == factor)
            && started(right) == &begin + &steps.integral
    } else if let Some(head) = slope {
        read(head) == factor && read(right) == steps.integrand
    } else if head.starts_with(&format!("{wave}'")) && !right.contains('[') {
        read(right) == *known
    } else if head == start {
        read(right) == steps.constant
    } else if head.starts_with(&start) {
        started(head) == &begin + &steps.beside && read(right) == steps.before
    } else if head == whole {
        read(right) == *piece
    } else {
        return false;
    };
    assert!(holds, "{head} = {right}");
    true
}

/// The periods on which all waves are said to be as on an earlier one, and that one.
fn quiet_periods(line: &str) -> Option<(std::ops::RangeInclusive<usize>, usize)> {
    let (periods, before) =
        line.split_once("All waves are the same functions of local time as on period ")?;
    let (which, _) = periods.split_once(',').expect("an interval");
    let numbers = which.split(' ').filter_map(|word| word.parse().ok()).collect::<Vec<usize>>();
    let before = before.trim_end_matches('.').parse().expect("a number");
    Some((numbers[0]..=*numbers.last().expect("a number"), before))
}

#[test]
fn what_is_printed_was_computed() {
    let (mut found, mut quiet_runs) = (0, 0);
    for (name, problem) in problems() {
        let recurrence = problem.recurrence().expect("periods");
        let local = &recurrence.statement().local;
        let orders = Some(Orders::Through(0, LAST));
        let text =
            problem.explanation(orders, 0, Form::Period, false).expect(name).to_text(usize::MAX);
        assert!(!text.contains("sqrt(-1)"), "{name}: a real scene without the imaginary unit");
        let steps = text.split("The pieces, step by step").nth(1).expect("pieces");
        let steps = steps.split("The form for every n").next().expect("pieces");
        let equations: Vec<_> =
            steps.lines().filter_map(|line| line.strip_prefix("    ")?.split_once(" = ")).collect();
        let mut seen = 0;
        each_step(recurrence, |_, (solved, steps, n)| {
            let wave = format!("{}[{n}]", recurrence.wave_name(solved.step.wave));
            let of_step =
                |(head, right): &&(&str, &str)| printed((solved, steps), &wave, local, head, right);
            seen += equations.iter().filter(of_step).count();
        });
        // The others are equations between waves.
        let between =
            equations.iter().filter(|(_, right)| right.contains('[') && !right.contains("(0)"));
        assert_eq!(seen + between.count(), equations.len(), "{name}: {steps}");
        let quiet = steps.lines().filter_map(quiet_periods).collect::<Vec<_>>();
        for wave in 0..recurrence.statement().waves.len() {
            let wave_name = recurrence.wave_name(wave);
            if wave_name.starts_with("integral") {
                assert!(!steps.contains(&*wave_name), "{name}: {wave_name}");
                continue;
            }
            let pieces = problem.solution().unwrap().pieces(wave, 0, LAST).expect("solved");
            for n in 0..=LAST {
                let head = format!("{wave_name}[{n}]({local})");
                let as_before = quiet.iter().find(|(periods, _)| periods.contains(&n));
                let told = equations.iter().any(|(of, _)| *of == head);
                assert_eq!(told, as_before.is_none(), "{name}: {head}");
                if let Some((_, before)) = as_before {
                    assert_eq!(pieces[n], pieces[*before], "{name}: {head}");
                }
            }
        }
        quiet_runs += quiet.len();
        found += seen;
    }
    assert!(found > 500 && quiet_runs > 3, "{found}, {quiet_runs}");
}

// ---- The step from n to n + 1, and from k to k + 1 ---------------------------------------------

#[test]
fn sequences_satisfy_their_equations_for_every_n() {
    let n = Symbol::new("n").unwrap();
    let mut found = 0;
    for (name, problem) in problems() {
        let recurrence = problem.recurrence().expect("periods");
        let solution = Solution::new(recurrence.clone());
        each_step(recurrence, |_, (solved, steps, period)| {
            let Some(step) = SequenceStep::of(&solution, solved, &n) else { return };
            assert_eq!(step.left, step.right, "{name}");
            // For a number n both sides are the piece of the later period.
            let Some(at) = period.checked_sub(step.later) else { return };
            let mut value = step.left.clone();
            for (stand_in, ratio) in &step.powers {
                let power = ratio.pow(u32::try_from(at).unwrap()).as_fraction().expect("no time");
                value = value.substitute(stand_in, &power).unwrap();
            }
            let number = Fraction::constant(&Rational::from_integer(at.into()));
            assert_eq!(value.substitute(&n, &number).unwrap(), steps.piece, "{name} at {at}");
            found += 1;
        });
    }
    assert!(found > 20, "{found}");
}

/// Visits the echoes of every wave that has a form for all of them, as they were derived echo by echo.
fn for_each_template(mut visit: impl FnMut(&str, &EchoTemplate, &[Expression], &Symbol)) {
    for (name, problem) in problems() {
        let recurrence = problem.recurrence().expect("periods");
        let (x, solution) = (&recurrence.statement().local, Solution::new(recurrence.clone()));
        let mut solver = EchoByEcho::new(recurrence);
        (0..9).for_each(|_| solver.advance().unwrap_or_else(|error| panic!("{error}")));
        for (wave, title) in recurrence.statement().waves.iter().enumerate() {
            if let Ok(GeneralForm::Echoes(template)) = solution.general(wave) {
                visit(&format!("{name}: {title}"), template, &solver.sum(wave).echoes, x);
            }
        }
    }
}

#[test]
fn each_echo_follows_from_the_one_before() {
    let mut found = 0;
    for_each_template(|name, template, echoes, x| {
        let (slope, value) = template.step();
        for pair in echoes[template.first.len().min(7)..].windows(2) {
            let left = &pair[1].derivative(x) + &pair[1].times(&template.rate);
            let right = &pair[0].derivative(x).times(&slope) + &pair[0].times(&value);
            assert_eq!(left, right, "{name}");
            assert_eq!(pair[1].at_zero(x), pair[0].at_zero(x).times(&slope), "{name}");
            found += 1;
        }
    });
    assert!(found > 20, "{found}");
}

/// Transforms of echoes, each the one before times a rational function, are those of the echoes that were derived.
#[test]
fn transforms_are_those_of_the_echoes() {
    let (mut found, p) = (0, Symbol::new("transformed").unwrap());
    for_each_template(|name, template, echoes, x| {
        let echoes = echoes.iter().enumerate().skip(template.first.len());
        for (k, echo) in echoes.filter(|_| !template.terms.is_empty()) {
            let Some(transform) = template.transform(k, x, &p) else { continue };
            assert_eq!(laplace(echo, x, &p), Some(transform), "{name}, {k}");
            found += 1;
        }
    });
    assert!(found > 40, "{found}");
}

#[test]
fn echoes_are_explained_by_transforms() {
    let mut explained = 0;
    for (name, problem) in problems() {
        let Ok(derivation) = problem.explanation(None, 0, Form::Echo, false) else { continue };
        let latex = derivation.to_latex(LATEX_WIDTH);
        assert_eq!(latex.matches('{').count(), latex.matches('}').count(), "{name}");
        assert!(latex.contains("\\Phi^{") && !latex.contains("step by step"), "{name}");
        explained += 1;
    }
    assert!(explained >= 7, "{explained}");
    let rigid = Problem::builtin("rigid-mass").unwrap();
    let text = rigid.explanation(None, 0, Form::Echo, false).unwrap().to_text(100);
    for line in [
        "    Phi_f[k+1](p) = ((p - 1)/(p + 1))*Phi_f[k](p)\n",
        "    Phi_f(p) = Phi_f[0](p)/(1 - q*((p - 1)/(p + 1)))\n",
        "    phi_f[2](s) = exp(-s)*(2*s^2 - 4*s + 1)\n",
    ] {
        assert!(text.contains(line), "{text}");
    }
}

// ---- LaTeX -------------------------------------------------------------------------------------

#[test]
fn latex_is_sound() {
    for (name, problem) in problems() {
        let latex =
            problem.explanation(None, 0, Form::Period, true).expect(name).to_latex(LATEX_WIDTH);
        let mut prose = String::new();
        let (_, mut rest) = latex.split_once("\\end{verbatim}").expect("the text of the scene");
        while let Some((before, after)) = rest.split_once("\\begin{align}\n") {
            let (equations, after) = after.split_once("\\end{align}\n").expect("an end");
            let lines = equations.lines().map(|line| match line.split_once(" \\label{") {
                Some((line, end)) => format!("{line}{}\n", &end[end.find('}').expect("}") + 1..]),
                None => format!("{}\n", line.replace(" \\nonumber", "")),
            });
            assert_sound_latex(&lines.collect::<String>());
            prose += before;
            rest = after;
        }
        prose += rest;
        assert_eq!(prose.matches('$').count() % 2, 0, "{name}: {prose}");
        for (i, part) in prose.split('$').enumerate() {
            let outside = i % 2 == 0;
            assert!(
                !outside || !part.contains(['_', '^', '<', '>']) || part.contains("\\_"),
                "{part}"
            );
            assert!(outside || Notation::Latex.width(part) > 0, "{name}: an empty formula");
        }
        for label in prose.split("\\eqref{").skip(1) {
            let label = format!("\\label{{{}}}", label.split('}').next().expect("a label"));
            assert_eq!(latex.matches(&label).count(), 1, "{name}: {label}");
        }
    }
}
