//! How formulas look, and that what is written is read back as the same expression.
//!
//! The snapshots fix the writing only; that the formulas are true is proved elsewhere.

use std::collections::BTreeMap;

use wavestep::export::{self, Formula, LATEX_WIDTH, Notation, TEXT_WIDTH, general_form};
use wavestep::expression::{Expression, Fraction};
use wavestep::language::{Source, read_listing, read_recurrence};
use wavestep::recurrence::WaveIndex;
use wavestep::scenes::{self, SCENES, Scene};
use wavestep::solution::Solution;

fn read(text: &str) -> Solution {
    let source = Source::new("scene", text).expect("text");
    Solution::new(read_recurrence(&source, &BTreeMap::new()).unwrap_or_else(|e| panic!("{e}")))
}

fn scene(name: &str) -> Solution {
    read(scenes::find(name).expect("a scene of the library").text)
}

fn wave(solution: &Solution, name: &str) -> WaveIndex {
    solution.recurrence().wave(name).expect("a wave of the scene")
}

fn waves(solution: &Solution) -> std::ops::Range<WaveIndex> {
    0..solution.recurrence().statement().waves.len()
}

fn name_of(solution: &Solution, wave: WaveIndex) -> String {
    solution.recurrence().statement().waves[wave].clone()
}

fn pieces(solution: &Solution, wave: WaveIndex, last: usize) -> Vec<Expression> {
    solution.pieces(wave, 0, last).unwrap_or_else(|error| panic!("{error}"))
}

fn period_form(solution: &Solution, wave: WaveIndex, last: usize) -> Vec<Formula> {
    let local = &solution.recurrence().statement().local;
    let formula = |(n, piece): (usize, &Expression)| {
        Formula::piece(&name_of(solution, wave), n, piece, local)
    };
    pieces(solution, wave, last).iter().enumerate().map(formula).collect()
}

fn echo_form(solution: &Solution, wave: WaveIndex, last: usize) -> Vec<Formula> {
    let local = &solution.recurrence().statement().local;
    let echoes = solution.echoes(wave, last).unwrap_or_else(|error| panic!("{error}"));
    let formula = |(k, echo): (usize, &Expression)| {
        Formula::echo(&name_of(solution, wave), &[k], echo, local)
    };
    echoes.echoes.iter().enumerate().map(formula).collect()
}

fn piecewise_form(solution: &Solution, wave: WaveIndex, last: usize) -> Vec<Formula> {
    let statement = solution.recurrence().statement();
    let on_period =
        |(n, formula): (usize, Formula)| formula.on_period(n, &Fraction::zero(), statement);
    period_form(solution, wave, last).into_iter().enumerate().map(on_period).collect()
}

fn assert_snapshot(name: &str, value: &str) {
    crate::snapshot(
        "formulas",
        name,
        "formulas of a scene that ships, or stated in the test",
        value,
    );
}

/// Snapshots of formulas in both notations.
fn assert_looks(name: &str, formulas: &[Formula]) {
    assert_snapshot(&format!("{name}-text"), &export::text(formulas, TEXT_WIDTH));
    let latex = export::latex(formulas, LATEX_WIDTH);
    assert_sound_latex(&latex);
    assert_snapshot(&format!("{name}-latex"), &latex);
}

// ---- How it looks ------------------------------------------------------------------------------

#[test]
fn rigid_mass_by_periods() {
    let solution = scene("rigid-mass");
    assert_looks("rigid-mass-f", &period_form(&solution, wave(&solution, "f"), 8));
}

#[test]
fn pulse_shape_by_periods() {
    let solution = scene("pulse-shape");
    assert_looks("pulse-shape-a", &period_form(&solution, wave(&solution, "a"), 8));
}

#[test]
fn algebraic_scenes_by_periods() {
    for name in ["two-bars", "constant-force"] {
        let solution = scene(name);
        let all = waves(&solution).flat_map(|wave| period_form(&solution, wave, 3));
        assert_looks(name, &all.collect::<Vec<_>>());
    }
}

#[test]
fn rigid_mass_in_other_forms() {
    let solution = scene("rigid-mass");
    let f = wave(&solution, "f");
    let statement = solution.recurrence().statement();
    assert_looks("rigid-mass-echoes", &echo_form(&solution, f, 3));
    let piecewise = piecewise_form(&solution, f, 3);
    assert_snapshot("rigid-mass-piecewise-text", &export::text(&piecewise, TEXT_WIDTH));
    let cases = export::latex_cases("f", &statement.time, &piecewise, LATEX_WIDTH);
    assert_sound_latex(&cases);
    assert_snapshot("rigid-mass-piecewise-latex", &cases);
}

#[test]
fn rigid_mass_observables() {
    let solution = scene("rigid-mass");
    let statement = solution.recurrence().statement();
    let mut formulas = Vec::new();
    for observable in &statement.observables {
        let seen = solution.observed(&observable.observation, 0, 2);
        let seen = seen.unwrap_or_else(|error| panic!("{error}"));
        for (n, piece) in seen.pieces.iter().enumerate() {
            let formula = Formula::piece(&observable.name, n, piece, &statement.local);
            formulas.push(formula.on_period(n, &seen.offset, statement));
        }
    }
    assert_looks("rigid-mass-observables", &formulas);
}

/// The scenes that are given as recurrences.
fn stated() -> impl Iterator<Item = &'static Scene> {
    SCENES.iter().filter(|scene| scene.text.contains("\nrecurrence "))
}

#[test]
fn scenes_in_general() {
    for scene in stated() {
        let solution = read(scene.text);
        let form = |wave| {
            let form = solution.general(wave).expect("every wave of the scenes has one");
            general_form(solution.recurrence(), wave, form)
        };
        let all: Vec<Formula> = waves(&solution).flat_map(form).collect();
        assert_looks(&format!("{}-general", scene.name), &all);
    }
}

// ---- That it can be read -----------------------------------------------------------------------

/// The functions that a text lists, in its order.
fn listed(text: &str) -> Vec<(String, usize, Expression)> {
    let source = Source::new("listing", text).unwrap_or_else(|error| panic!("{error}"));
    let formulas = read_listing(&source).unwrap_or_else(|error| panic!("{error}\n{text}"));
    formulas.into_iter().map(|f| (f.wave, f.counts[0], f.expression)).collect()
}

/// Recurrences whose solutions hold what those of the scenes do not: several exponentials, powers
/// of quotients, symbols in exponents, numbers beside symbols in a denominator.
const OTHERS: [&str; 5] = [
    "period 1, local s, time t
     wave u
     equation u[n]' + 2*u[n] = 3*u[n-1] - exp(-t)*t
     continuous u[n] starts at 1/3",
    "symbol D > 0, a, b
     nonzero a - b
     period D, local s, time t
     wave u_left, v
     equation u_left[n]' + a*u_left[n] = v[n-1]
     equation v[n]' + b*v[n] = -u_left[n]
     continuous u_left[n] starts at 1
     continuous v[n] starts at 0",
    "symbol L > 0, c > 0, alpha > 0
     period 2*L/c, local s, time t
     wave w
     equation L/c*w[n]' + alpha*w[n] = L/c*w[n-1]' - w[n-1]
     continuous w[n] - w[n-1] starts at 1/c",
    "symbol r > 0
     period 2, local s, time t
     wave f
     equation f[n]' = (1-r)/(1+r)*(f[n-1]' - f[n-1]) - exp(t/(2*r))
     continuous f[n] starts at 1/2",
    "symbol mu > 0
     period mu, local s, time t
     wave f
     equation f[n]' - f[n] = -exp(-mu)*f[n-1] + 1/mu
     continuous f[n] starts at -exp(mu)",
];

fn others() -> impl Iterator<Item = Solution> {
    OTHERS.iter().map(|text| {
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        read(&format!("recurrence \"other\"\n{}\n", lines.join("\n")))
    })
}

#[test]
fn written_functions_are_read_back() {
    let scenes = stated().map(|scene| (read(scene.text), 12));
    for (solution, last) in scenes.chain(others().map(|solution| (solution, 4))) {
        for wave in waves(&solution) {
            let name = name_of(&solution, wave);
            let text = export::text(&period_form(&solution, wave, last), TEXT_WIDTH);
            for (n, (read, index, piece)) in listed(&text).into_iter().enumerate() {
                assert_eq!((read.as_str(), index), (name.as_str(), n));
                assert_eq!(piece, pieces(&solution, wave, last)[n], "{text}");
            }
            let with_remarks = export::text(&piecewise_form(&solution, wave, last), TEXT_WIDTH);
            assert_eq!(listed(&with_remarks), listed(&text));
            let text = export::text(&echo_form(&solution, wave, last), TEXT_WIDTH);
            let echoes = solution.echoes(wave, last).expect("they were written");
            let read = listed(&text);
            assert_eq!(read.len(), last + 1);
            for ((wave, k, echo), expected) in read.iter().zip(&echoes.echoes) {
                assert_eq!(*wave, format!("phi_{name}"), "{k}");
                assert_eq!(echo, expected, "{text}");
            }
        }
    }
}

#[test]
fn lines_are_as_wide_as_they_may_be() {
    for scene in stated() {
        let solution = read(scene.text);
        for wave in waves(&solution) {
            let text = export::text(&period_form(&solution, wave, 12), TEXT_WIDTH);
            for line in text.lines().filter(|line| line.chars().count() > TEXT_WIDTH) {
                assert!(!breakable(line.trim_start()), "{line}");
            }
        }
    }
}

// ---- LaTeX that a typesetter takes ---------------------------------------------------------------

/// Whether a line could have been broken: at a sign that is in no quotient and no exponent.
fn breakable(line: &str) -> bool {
    let line = line.trim_start_matches("\\quad {}").trim_start_matches(['+', '-', ' ']);
    let line = line.split_once("= ").map_or(line, |(_, right)| right);
    let mut braces = 0;
    let mut parts = Vec::new();
    for (i, character) in line.char_indices() {
        match character {
            '{' => braces += 1,
            '}' => braces -= 1,
            '+' | '-' if braces == 0 && i > 0 => parts.push(i),
            _ => {}
        }
    }
    let quotient = line.contains(")/(");
    !quotient && parts.iter().any(|i| line[..*i].ends_with(' '))
}

pub fn assert_sound_latex(latex: &str) {
    for bad in ["1 \\cdot", "+ -", "- -", "+ +", "{}{", "  ", "^{1}", "\\frac{0}", "--"] {
        assert!(!latex.contains(bad), "{bad:?} in\n{latex}");
    }
    let words: Vec<&str> = latex.split([' ', '&', '\n']).collect();
    for pair in words.windows(2).filter(|pair| pair[0].trim_start_matches('-') == "1") {
        let next = pair[1].trim_start_matches('\\');
        let factor =
            next.starts_with(char::is_alphanumeric) && !["end{align*}", "le"].contains(&next);
        assert!(!factor, "{pair:?} in\n{latex}");
    }
    let count = |part: &str| latex.matches(part).count();
    for (open, close) in [("\\bigl[", "\\bigr]"), ("\\Bigl[", "\\Bigr]"), ("\\Bigl(", "\\Bigr)")] {
        assert_eq!(count(open), count(close), "{latex}");
    }
    assert_eq!(count("\\left("), count("\\right)"), "{latex}");
    let mut stack = Vec::new();
    for character in latex.chars() {
        match character {
            '{' | '(' | '[' => stack.push(character),
            '}' => assert_eq!(stack.pop(), Some('{'), "{latex}"),
            ')' => assert_eq!(stack.pop(), Some('('), "{latex}"),
            ']' => assert_eq!(stack.pop(), Some('['), "{latex}"),
            _ => {}
        }
    }
    assert_eq!(stack, [], "{latex}");
    for (line, pair) in latex
        .lines()
        .filter(|line| !line.contains("\\begin{aligned}"))
        .filter_map(|line| line.split_once('&').map(|pair| (line, pair)))
    {
        let (head, right) = pair;
        let right = right.trim_end_matches(" \\\\");
        if !right.starts_with('=') && !right.starts_with("\\quad") {
            continue;
        }
        let width = Notation::Latex.width(head) + Notation::Latex.width(right);
        assert!(width <= LATEX_WIDTH + 2 || !breakable(right), "{width}: {line}");
    }
}

/// Lines of a formula that end inside brackets, though what these hold fits in a line, with the sign and the factor before
/// them and what follows up to the next sign.
fn needless_breaks(lines: &[&str], notation: Notation, width: usize) -> Vec<String> {
    let whole = lines.join(" ");
    let mut breaks = lines.iter().scan(0, |end, line| {
        *end += line.len() + 1;
        Some(*end)
    });
    let mut breaks: Vec<usize> = breaks.by_ref().take(lines.len() - 1).collect();
    let (mut open, mut found) = (vec![0], Vec::new());
    // For each bracket around a place, where the term began that it stands in.
    for (i, character) in whole.char_indices() {
        let sign = [" + ", " - "]
            .iter()
            .any(|sign| whole[..i].ends_with(" ") && whole[i - 1..].starts_with(sign));
        if sign {
            *open.last_mut().unwrap() = i;
        }
        if breaks.first() == Some(&i) {
            breaks.remove(0);
            for (level, start) in open[..open.len() - 1].iter().enumerate() {
                let end = end_of_term(&whole[i..], open.len() - 1 - level) + i;
                let term = &whole[*start..end];
                if *start > 0 && notation.width(term) <= width {
                    found.push(term.to_owned());
                }
            }
        }
        match character {
            '(' | '[' => open.push(i + 1),
            ')' | ']' => _ = open.pop(),
            _ => {}
        }
    }
    found
}

/// Where a term ends that stands so many brackets further out.
fn end_of_term(rest: &str, mut out: usize) -> usize {
    for (i, character) in rest.char_indices() {
        match character {
            '(' | '[' => out += 1,
            ')' | ']' if out == 0 => return i,
            ')' | ']' => out -= 1,
            ' ' if out == 0 && [" + ", " - "].iter().any(|sign| rest[i..].starts_with(sign)) => {
                return i;
            }
            _ => {}
        }
    }
    rest.len()
}

#[test]
fn lines_end_outside_brackets_that_fit_in_a_line() {
    let (mut inside, mut outside) = (0, 0);
    for solution in stated().map(|scene| read(scene.text)).chain(others()) {
        for wave in waves(&solution) {
            for formula in period_form(&solution, wave, 6) {
                let latex = export::latex(&[formula], LATEX_WIDTH);
                let body = latex.lines().skip(1).take_while(|line| !line.starts_with("\\end"));
                let body: Vec<&str> = body.map(|line| line.trim_end_matches(" \\\\")).collect();
                let Some((head, first)) = body[0].split_once(" &= ") else { panic!("{latex}") };
                let later = body[1..].iter().map(|line| line.trim_start_matches("&\\quad {}"));
                let lines: Vec<&str> = [first].into_iter().chain(later).collect();
                let width = LATEX_WIDTH - Notation::Latex.width(head) - 5;
                let needless = needless_breaks(&lines, Notation::Latex, width);
                assert!(needless.is_empty(), "{needless:?} in\n{latex}");
                let depth = |text: &str| {
                    text.matches(['(', '[']).count() - text.matches([')', ']']).count()
                };
                let ends = (1..lines.len()).map(|i| depth(&lines[..i].concat()));
                let (deep, flat): (Vec<usize>, Vec<usize>) = ends.partition(|depth| *depth > 1);
                (inside, outside) = (inside + deep.len(), outside + flat.len());
            }
        }
    }
    assert!(inside > 0 && outside > 100, "{inside} {outside}");
    let needless = needless_breaks(&["a + b (c", "+ d) + e"], Notation::Text, 20);
    assert_eq!(needless, ["+ b (c + d)"]);
}

#[test]
fn latex_of_every_recurrence_is_sound() {
    let scenes = stated().map(|scene| (read(scene.text), 12));
    for (solution, last) in scenes.chain(others().map(|solution| (solution, 4))) {
        let time = &solution.recurrence().statement().time;
        for wave in waves(&solution) {
            for formulas in [period_form(&solution, wave, last), echo_form(&solution, wave, last)] {
                assert_sound_latex(&export::latex(&formulas, LATEX_WIDTH));
            }
            let cases = piecewise_form(&solution, wave, last);
            let name = name_of(&solution, wave);
            assert_sound_latex(&export::latex_cases(&name, time, &cases, LATEX_WIDTH));
            if let Ok(form) = solution.general(wave) {
                let formulas = general_form(solution.recurrence(), wave, form);
                assert_sound_latex(&export::latex(&formulas, LATEX_WIDTH));
            }
        }
    }
}

/// The check itself can fail.
#[test]
#[should_panic(expected = "+ -")]
fn doubled_signs_are_noticed() {
    assert_sound_latex("f &= 1 + -x");
}
