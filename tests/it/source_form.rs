//! The source's form: that it says the same as the plain form, and how it looks.

use std::collections::BTreeMap;

use wavestep::export::{self, Formula, LATEX_WIDTH, SourceForm, TEXT_WIDTH};
use wavestep::expression::{Expression, Fraction};
use wavestep::language::{Source, read_expression, read_recurrence};
use wavestep::recurrence::WaveIndex;
use wavestep::scenes::{self, SCENES};
use wavestep::solution::{GeneralForm, Solution};
use wavestep_polynomial::Symbol;

fn solution(name: &str) -> Solution {
    let scene = scenes::find(name).expect("a scene of the library");
    let source = Source::new(scene.name, scene.text).expect("a text");
    Solution::new(read_recurrence(&source, &BTreeMap::new()).expect("a recurrence"))
}

fn expression(text: &str) -> Expression {
    let source = Source::new("text", text).expect("a text");
    read_expression(&source).unwrap_or_else(|error| panic!("{error}"))
}

/// The pieces `0 … last` of a wave, with the shorthand that the scene asks for.
fn formulas(solution: &Solution, wave: WaveIndex, last: usize) -> Vec<Formula> {
    let notation = &solution.recurrence().statement().notation;
    let (pieces, kept) = solution.pieces_by_ends(last, &notation.ends).expect("it can be solved");
    let form = SourceForm::new(solution.recurrence(), Some(&kept));
    pieces[wave].iter().enumerate().flat_map(|(n, piece)| form.piece(wave, n, piece)).collect()
}

/// Left and right sides of formulas as they are written.
fn sides(formulas: &[Formula]) -> Vec<(String, String)> {
    let split = |formula: &Formula| {
        let line = formula.to_line();
        let (left, right) = line.split_once(" = ").expect("an equation");
        (left.to_owned(), right.to_owned())
    };
    formulas.iter().map(split).collect()
}

fn substituted(value: &Expression, name: &str, by: &str) -> Expression {
    let by = expression(by).as_fraction().expect("no exponential");
    value.substitute(&Symbol::new(name).expect("a name"), &by).expect("a substitution")
}

/// With the constants put back in, a formula is the unit times the piece at `s = μz/L`.
#[test]
fn constants_and_units_say_what_the_pieces_say() {
    for (name, last) in [("rigid-mass", 8), ("constant-force", 5), ("two-bars", 5)] {
        let solution = solution(name);
        let statement = solution.recurrence().statement();
        for wave in 0..statement.waves.len() {
            let written = sides(&formulas(&solution, wave, last));
            let constants: BTreeMap<&str, &str> = written
                .iter()
                .filter(|(left, _)| !left.contains('['))
                .map(|(left, right)| (left.as_str(), right.as_str()))
                .collect();
            let pieces = solution.pieces(wave, 0, last).expect("it can be solved");
            let unit = Expression::from(statement.notation.units[&wave].to_fraction());
            let waves = written.iter().filter(|(left, _)| left.contains('['));
            for (n, ((_, right), piece)) in waves.zip(&pieces).enumerate() {
                let mut right = right.clone();
                if let Some(constant) = constants.get(&*format!("B_{n}")) {
                    right = right.replace(&format!("B_{n}"), &format!("({constant})"));
                }
                let expected = &unit * &substituted(piece, "s", "mu*z/L");
                assert_eq!(expression(&right), expected, "{name}: {right}");
            }
            if name == "rigid-mass" && wave == 0 {
                // B_0 and B_1 are short; the others are stated apart.
                assert_eq!(constants.len(), last - 1);
            }
        }
    }
}

/// With the values at the ends of earlier periods put back in, the shorthand is the piece.
#[test]
fn shorthand_says_what_the_pieces_say() {
    let solution = solution("pulse-shape");
    let pieces = solution.pieces(0, 0, 8).expect("it can be solved");
    let ends: Vec<String> = pieces
        .iter()
        .map(|piece| {
            let end = substituted(piece, "t", "mu");
            let head = export::Head::new("", "");
            let line = Formula::new(head, &end, &Symbol::new("t").expect("a name")).to_line();
            line.trim_start_matches(" = ").to_owned()
        })
        .collect();
    for (n, (left, mut right)) in sides(&formulas(&solution, 0, 8)).into_iter().enumerate() {
        assert_eq!(left, format!("alpha_tilde[{n}]"));
        assert_eq!(right.contains("alpha_tilde"), n > 0);
        for (i, end) in ends.iter().enumerate() {
            right = right.replace(&format!("alpha_tilde[{i}](mu)"), &format!("({end})"));
        }
        assert_eq!(substituted(&expression(&right), "t_tilde", "t"), pieces[n], "{n}");
    }
}

/// With all ends kept, and put back in, every wave of every scene is what it was.
#[test]
fn kept_ends_hold_for_every_scene() {
    for scene in SCENES.iter().filter(|scene| scene.text.contains("\nrecurrence ")) {
        let solution = solution(scene.name);
        let statement = solution.recurrence().statement();
        let all = (0..statement.waves.len()).collect();
        for wave in 0..statement.waves.len() {
            let pieces = solution.pieces(wave, 0, 5).expect("it can be solved");
            let (kept, ends) = solution.pieces_by_ends(5, &all).expect("the same");
            for (piece, kept) in pieces.iter().zip(&kept[wave]) {
                let mut value = kept.clone();
                for (symbol, wave, n) in ends.symbols() {
                    let end = solution.pieces(wave, n, n).expect("the same")[0]
                        .substitute(&statement.local, &statement.period)
                        .expect("an end");
                    value = replaced(&value, symbol, &end);
                }
                assert_eq!(value, *piece, "{}: {wave}", scene.name);
            }
        }
    }
}

/// A polynomial in `x` of degree 1 with `by` in place of `x`.
fn replaced(value: &Expression, x: &Symbol, by: &Expression) -> Expression {
    let rest = value.substitute(x, &Fraction::zero()).expect("no denominator");
    let slope = value.derivative(x);
    assert!(!slope.contains(x), "ends occur linearly");
    &rest + &(&slope * by)
}

/// The statements of a scene, what its source writes for symbols, and the unit of its wave.
type Other = (&'static str, &'static [(&'static str, &'static str)], &'static str);

/// Scenes whose source writes symbols as products and quotients, where brackets matter.
const OTHERS: [Other; 5] = [
    (
        "symbol tau > 0, mu > 0\nperiod 2*mu, local s, time t\nwave f\n\
         equation tau*f[n]' + f[n] = tau*f[n-1]' - f[n-1]\ncontinuous f[n] - f[n-1] starts at 1/tau\n\
         written tau as a_0*T, mu as L/c, f in 2*X/(E*A)\n",
        &[("tau", "a_0*T"), ("mu", "L/c")],
        "2*X/(E*A)",
    ),
    (
        "symbol b > 0\nperiod 1, local s, time t\nwave f\nequation b*f[n] = 1 - f[n-1]\n\
         written b as Z_1/Z_2, f in V/2\n",
        &[("b", "Z_1/Z_2")],
        "V/2",
    ),
    (
        "symbol b > 0\nperiod 1, local s, time t\nwave f\nequation b*f[n]' + f[n] = f[n-1]\n\
         continuous f[n] starts at 3\nwritten b as 1/omega, s as 2*z, f in 3*V^2\n",
        &[("b", "1/omega"), ("s", "2*z")],
        "3*V^2",
    ),
    (
        "symbol mu > 0\nperiod 2*mu, local s, time t\nwave f\n\
         equation f[n]' + f[n] = f[n-1]' - f[n-1]\ncontinuous f[n] - f[n-1] starts at 1\n\
         written s as 2*z, mu as 3*m/M, constants of f as B\n",
        &[("mu", "3*m/M"), ("s", "2*z")],
        "1",
    ),
    (
        "symbol r > 0\nperiod 2, local s, time t\nwave f\nequation f[n] = 2*r*f[n-1] + r\n\
         written f in V/c\n",
        &[],
        "V/c",
    ),
];

#[test]
fn symbols_written_as_products_keep_their_value() {
    for (text, renamed, unit) in OTHERS {
        let source = Source::new("other", format!("recurrence \"other\"\n{text}")).expect("a text");
        let recurrence = read_recurrence(&source, &BTreeMap::new());
        let solution = Solution::new(recurrence.unwrap_or_else(|error| panic!("{error}")));
        let written = sides(&formulas(&solution, 0, 4));
        let constants: Vec<_> = written.iter().filter(|(left, _)| !left.contains('[')).collect();
        let waves = written.iter().filter(|(left, _)| left.contains('['));
        for (n, (_, right)) in waves.enumerate() {
            let mut right = right.clone();
            for (name, constant) in constants.iter().rev() {
                right = right.replace(name.as_str(), &format!("({constant})"));
            }
            let mut expected = solution.pieces(0, n, n).expect("it can be solved")[0].clone();
            for (name, by) in renamed {
                expected = substituted(&expected, name, by);
            }
            assert_eq!(expression(&right), &expression(unit) * &expected, "{text}{right}");
        }
        let latex = export::latex(&formulas(&solution, 0, 4), LATEX_WIDTH);
        for bad in ["2 3", "3 2", "2 2", "4 3", "2 1", "- -", "+ -"] {
            assert!(!latex.contains(bad), "{bad}: {latex}");
        }
    }
}

/// With n put in, the sequence for every n is the unit times the piece.
#[test]
fn sequences_say_what_the_pieces_say() {
    for name in ["two-bars", "constant-force"] {
        let solution = solution(name);
        let form = SourceForm::new(solution.recurrence(), None);
        let statement = solution.recurrence().statement();
        for wave in 0..statement.waves.len() {
            let general = solution.general(wave).expect("a closed form");
            let (_, right) = sides(&form.general(wave, general)).remove(0);
            let unit = Expression::from(statement.notation.units[&wave].to_fraction());
            for (n, piece) in solution.pieces(wave, 0, 5).expect("solved").iter().enumerate() {
                let power = format!("^({n} + 1)");
                let right = right.replace("^(n + 1)", &power).replace("^n", &format!("^{n}"));
                let right = right.replace("(n + 1)", &format!("({n} + 1)"));
                let whole = right.replace(&power, &format!("^{}", n + 1));
                assert_eq!(expression(&whole), &unit * piece, "{name}: {whole}");
            }
        }
    }
}

/// With n and the echoes put in, the sum for every n is the unit times the piece.
#[test]
fn sums_of_echoes_say_what_the_pieces_say() {
    for (name, local) in [("rigid-mass", "mu*z/L"), ("pulse-shape", "t_tilde")] {
        let solution = solution(name);
        let statement = solution.recurrence().statement();
        let form = SourceForm::new(solution.recurrence(), None);
        for wave in 0..statement.waves.len() {
            let GeneralForm::Echoes(template) = solution.general(wave).expect("a closed form")
            else {
                panic!("{name} has echoes")
            };
            let general = solution.general(wave).expect("a closed form");
            let (_, sum) = sides(&form.general(wave, general)).remove(0);
            let (unit, rest) = sum.split_once("sum(phi_").expect("a sum of echoes");
            let (_, rest) = rest.split_once("[k](").expect("the argument of an echo");
            let argument = rest.strip_suffix("), 0 <= k <= n)").expect("the range of echoes");
            for (n, piece) in solution.pieces(wave, 0, 5).expect("solved").iter().enumerate() {
                let mut value = Expression::zero();
                for k in 0..=n {
                    let echo = template.echo(k, &statement.local);
                    let argument = argument.replace("(n - k)", &format!("({n} - {k})"));
                    value += &substituted(&echo, statement.local.name(), &argument);
                }
                let unit = expression(&format!("{unit}1"));
                let by_pieces = substituted(piece, statement.local.name(), local);
                assert_eq!(&unit * &value, &unit * &by_pieces, "{name}: {sum}, n = {n}");
                let written = statement.notation.units.get(&wave);
                assert_eq!(unit, written.map_or(Expression::one(), |u| u.to_fraction().into()));
            }
        }
    }
}

fn assert_looks(name: &str, formulas: &[Formula]) {
    let asked = format!("the source's form of {name}");
    let looks = |notation: &str, text: String| {
        crate::snapshot("source-form", &format!("{name}-{notation}"), &asked, &text);
    };
    looks("text", export::text(formulas, TEXT_WIDTH));
    looks("latex", export::latex(formulas, LATEX_WIDTH));
}

#[test]
fn how_the_source_writes_it() {
    for (name, wave, last) in
        [("two-bars", 1, 3), ("constant-force", 0, 3), ("pulse-shape", 0, 4), ("rigid-mass", 0, 3)]
    {
        assert_looks(name, &formulas(&solution(name), wave, last));
    }
}

#[test]
fn sequences_for_every_n() {
    for name in ["two-bars", "constant-force", "rigid-mass", "pulse-shape"] {
        let solution = solution(name);
        let form = SourceForm::new(solution.recurrence(), None);
        let waves = 0..solution.recurrence().statement().waves.len();
        let all = waves.flat_map(|wave| {
            let general: &GeneralForm = solution.general(wave).expect("a closed form");
            form.general(wave, general)
        });
        assert_looks(&format!("{name}-general"), &all.collect::<Vec<_>>());
    }
}
