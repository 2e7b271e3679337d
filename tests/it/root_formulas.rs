//! Formulas with square roots, cosines and sines: they look as a person would write them, read back
//! as what they show, and come out of derivations with second-order poles.

use crate::support::fraction;
use proptest::prelude::*;
use wavestep::export::{Formula, LATEX_WIDTH, expression_text, latex};
use wavestep::expression::{Expression, Fraction};
use wavestep::language::{Source, parse_number, read_expression, read_listing, read_recurrence};
use wavestep::signal::{ClosedSignal, EvaluateError, Limit, Value, digits};
use wavestep::solution::Solution;
use wavestep_polynomial::{Rational, Symbol};

fn read(text: &str) -> Expression {
    read_expression(&Source::new("text", text).unwrap()).unwrap_or_else(|error| panic!("{error}"))
}

fn s() -> Symbol {
    Symbol::new("s").unwrap()
}

fn formula(value: &Expression) -> Formula {
    Formula::piece("f", 0, value, &s())
}

/// What a line shows, as an expression.
fn shown(value: &Expression) -> String {
    formula(value).to_line().trim_start_matches("f[0](s) = ").to_owned()
}

fn shown_in_latex(value: &Expression) -> String {
    let text = latex(&[formula(value)], LATEX_WIDTH);
    text.lines().nth(1).unwrap().trim_start_matches("f_{0}(s) &= ").to_owned()
}

fn assert_reads_back(value: &Expression) {
    for text in [expression_text(value), shown(value)] {
        assert_eq!(&read(&text), value, "{text}");
    }
    let listing = Source::new("listing", formula(value).to_text(40)).unwrap();
    assert_eq!(&read_listing(&listing).unwrap()[0].expression, value);
}

#[test]
fn formulas_look_as_a_person_would_write_them() {
    for (text, plain, tex) in [
        (
            "exp(-s/2)*cos(sqrt(3)/2*s)",
            "exp(-1/2*s)*cos(sqrt(3)/2*s)",
            r"e^{-\frac{1}{2} s} \cos\left(\frac{\sqrt{3}}{2} s\right)",
        ),
        ("cos(2*s) - 3*sin(2*s)", "cos(2*s) - 3*sin(2*s)", r"\cos(2 s) - 3 \sin(2 s)"),
        ("sqrt(6)*s", "sqrt(6)*s", r"\sqrt{6} s"),
        ("3*sqrt(2)*sqrt(3)/4*s^2", "3*sqrt(6)/4*s^2", r"\frac{3 \sqrt{6}}{4} s^{2}"),
        (
            "exp(-2*s + sqrt(3)*s) + exp(-2*s - sqrt(3)*s)",
            "exp(-2*s + sqrt(3)*s) + exp(-2*s - sqrt(3)*s)",
            r"e^{-2 s + \sqrt{3} s} + e^{-2 s - \sqrt{3} s}",
        ),
        ("exp(-s)*cos(s)*(1 + s)", "exp(-s)*cos(s)*(s + 1)", r"e^{-s} \cos(s)\bigl[s + 1\bigr]"),
        ("sin(s + mu)", "sin(mu + s)", r"\sin(\mu + s)"),
        ("cos(mu)*s + 1", "s*cos(mu) + 1", r"s \cos(\mu) + 1"),
        ("sqrt(-1)*s", "sqrt(-1)*s", r"\mathrm{i} s"),
        ("sqrt(-3)/2*s", "sqrt(-3)/2*s", r"\frac{\mathrm{i}\sqrt{3}}{2} s"),
        ("exp(sqrt(-1)*s)", "exp(sqrt(-1)*s)", r"e^{\mathrm{i} s}"),
        ("1 + sqrt(5)", "1 + sqrt(5)", r"1 + \sqrt{5}"),
        ("(1 - sqrt(2))/(r + 1)", "(1 - sqrt(2))/(1 + r)", r"\frac{1 - \sqrt{2}}{1 + r}"),
        ("cos(s/(r + 1))", "cos(s/(1 + r))", r"\cos\left(\frac{s}{1 + r}\right)"),
        ("sin(-2*s)", "-sin(2*s)", r"-\sin(2 s)"),
    ] {
        let value = read(text);
        assert_reads_back(&value);
        assert_eq!((shown(&value).as_str(), shown_in_latex(&value).as_str()), (plain, tex));
    }
}

#[test]
fn identities_hold_as_they_are_read() {
    for (left, right) in [
        ("cos(s)^2 + sin(s)^2", "1"),
        ("cos(s + mu)", "cos(s)*cos(mu) - sin(s)*sin(mu)"),
        ("sin(2*s)", "2*sin(s)*cos(s)"),
        ("cos(0) + sin(0)", "1"),
        ("sqrt(12)", "2*sqrt(3)"),
        ("sqrt(1/2)", "sqrt(2)/2"),
        ("sqrt(0) + sqrt(9/4)", "3/2"),
        ("sqrt(2)*sqrt(6)", "2*sqrt(3)"),
        ("1/(1 + sqrt(2))", "sqrt(2) - 1"),
        ("sqrt(-4)^2", "-4"),
        ("1/(1 + sqrt(2) + sqrt(3) + sqrt(5))*(1 + sqrt(2) + sqrt(3) + sqrt(5))", "1"),
        ("r/(r + r*sqrt(2))", "sqrt(2) - 1"),
        ("exp(sqrt(-1)*s)", "cos(s) + sqrt(-1)*sin(s)"),
        ("sin(sqrt(2)*s)/sqrt(2)", "sqrt(2)*sin(sqrt(2)*s)/2"),
    ] {
        assert_eq!(read(left), read(right));
    }
    assert_ne!(read("sqrt(2)"), read("1.41421356"));
    // A symbol may be called i.
    assert_ne!(read("i"), read("sqrt(-1)"));
}

fn numbers() -> BoxedStrategy<Fraction> {
    let roots = ["1", "sqrt(-1)", "sqrt(2)", "sqrt(3)", "sqrt(-1)*sqrt(3)"].map(fraction);
    prop::collection::vec((-4_i64..5, 1_i64..4), roots.len())
        .prop_map(move |values| {
            roots.iter().zip(&values).fold(Fraction::zero(), |sum, (root, (above, below))| {
                &sum + &root.scale(&Rational::new((*above).into(), (*below).into()))
            })
        })
        .boxed()
}

fn expressions() -> BoxedStrategy<Expression> {
    let symbols = ["1", "s", "mu", "s^2", "s*mu"].map(fraction);
    let over = Fraction::reciprocal(fraction("r + 1").numerator()).unwrap();
    let part = (numbers(), numbers(), 0_usize..5, 0_usize..4, 0_usize..5, any::<bool>());
    prop::collection::vec(part, 0..4)
        .prop_map(move |parts| {
            let mut sum = Expression::zero();
            for (a, b, i, j, k, divided) in parts {
                let exponent = if k > 2 { Fraction::zero() } else { &a * &symbols[[0, 1, 2][k]] };
                let mut factor = &b * &symbols[i];
                if divided && j == 0 {
                    factor = &factor * &over;
                }
                sum.add_term(exponent, factor);
            }
            sum
        })
        .boxed()
}

proptest! {
    #[test]
    fn expressions_read_back(value in expressions()) {
        assert_reads_back(&value);
        let i = Symbol::square_root(-1).unwrap();
        let real = &value + &value.conjugate(&i);
        assert_reads_back(&real);
        prop_assert!(!expression_text(&real).contains("sqrt(-"), "{}", expression_text(&real));
    }
}

// ---- Derivations -------------------------------------------------------------------------------

/// `(D − λ₁)(D − λ₂) f = forcing`, one pole after the other.
fn scene(first: &str, second: &str, forcing: &str) -> Solution {
    let text = format!(
        "recurrence \"Second order\"\nperiod 2, local s, time t\nwave f, g\n\
         equation g[n]' - ({second})*g[n] = f[n-1] + {forcing}\n\
         equation f[n]' - ({first})*f[n] = g[n]\n\
         continuous f[n] starts at 1\ncontinuous g[n] starts at 0 - ({first})\n\
         observe twice = 2*f[n]\nobserve inner = g[n]\n"
    );
    let source = Source::new("scene", text).unwrap();
    let recurrence = read_recurrence(&source, &Default::default());
    Solution::new(recurrence.unwrap_or_else(|error| panic!("{error}")))
}

/// The poles of `y'' + b y' + c y`, and these numbers.
const POLES: [(&str, &str, &str, &str); 4] = [
    ("-1/2 + sqrt(-3)/2", "-1/2 - sqrt(-3)/2", "1", "1"),
    ("-2 + sqrt(3)", "-2 - sqrt(3)", "4", "1"),
    ("2*sqrt(-1)", "-2*sqrt(-1)", "0", "4"),
    ("-1", "-2", "3", "2"),
];

#[test]
fn derived_pieces_satisfy_their_equation_and_are_real() {
    for (first, second, b, c) in POLES {
        for forcing in ["0", "cos(2*t)", "t*exp(-t)"] {
            let solution = scene(first, second, forcing);
            let pieces = solution.pieces(0, 0, 3).unwrap();
            let (period, start) = (fraction("2"), read(forcing));
            for (n, piece) in pieces.iter().enumerate() {
                let at = &period.scale(&Rational::from_integer(n.into())) + &Fraction::symbol(&s());
                let t = Symbol::new("t").unwrap();
                let mut expected = start.substitute(&t, &at).unwrap();
                if n > 0 {
                    expected += &pieces[n - 1];
                }
                let slope = piece.derivative(&s());
                let mut left = slope.derivative(&s());
                left += &(&slope * &read(b));
                left += &(piece * &read(c));
                assert_eq!(left, expected, "{first}, {forcing}, n = {n}");
                for root in piece.roots() {
                    assert_eq!(&piece.conjugate(&root), piece, "{root}");
                }
                assert_reads_back(piece);
                assert!(!shown(piece).contains("sqrt(-"), "{}", shown(piece));
            }
        }
    }
}

#[test]
fn values_agree_with_the_pieces() {
    for (first, second, _, _) in POLES {
        let solution = scene(first, second, "cos(2*t)");
        let last = parse_number("31/4").unwrap();
        let twice = solution.recurrence().observation("twice").unwrap();
        let window = [&Rational::default(), &last];
        let twice = ClosedSignal::of_recurrence(&solution, &twice, window).unwrap();
        for (n, at) in [(0, "1/3"), (1, "5/2"), (3, "31/4")] {
            let local = parse_number(at).unwrap() - Rational::from_integer((2 * n).into());
            let piece = &solution.pieces(0, n, n).unwrap()[0];
            let exact = piece.substitute(&s(), &Fraction::constant(&local)).unwrap();
            let ball = wavestep::enclosure::enclose_expression(&exact, &|_, _| None, 300).unwrap();
            let time = parse_number(at).unwrap();
            let value = digits(&twice, &time, Limit::Right, 40, 2000).unwrap();
            let Value::Certified { ball: value, .. } = value else { panic!("not rational") };
            let half = value.multiply_rational(&Rational::new(1.into(), 2.into()), 300);
            let difference = half.subtract(ball.real(), 300);
            assert!(difference.contains(&Rational::default()), "{first} at {at}");
            assert!(ball.imaginary().contains(&Rational::default()));
        }
        // At the start f is 1, exactly.
        let start = digits(&twice, &Rational::default(), Limit::Right, 10, 200);
        assert_eq!(start, Ok(Value::Exact(parse_number("2").unwrap())));
    }
}

#[test]
fn a_wave_with_one_pole_of_a_pair_is_not_real() {
    let solution = scene("2*sqrt(-1)", "-2*sqrt(-1)", "0");
    let inner = solution.recurrence().observation("inner").unwrap();
    let at = parse_number("1/3").unwrap();
    let inner = ClosedSignal::of_recurrence(&solution, &inner, [&at, &at]).unwrap();
    let value = digits(&inner, &at, Limit::Right, 10, 200);
    assert_eq!(value, Err(EvaluateError::NotReal));
}

/// f'' + 4 f = 0, f = cos 2t: the digits of cos(2/3).
#[test]
fn digits_of_a_cosine() {
    let solution = scene("2*sqrt(-1)", "-2*sqrt(-1)", "0");
    let f = solution.recurrence().observation("f").unwrap();
    let at = parse_number("1/3").unwrap();
    let f = ClosedSignal::of_recurrence(&solution, &f, [&at, &at]).unwrap();
    let value = digits(&f, &at, Limit::Right, 20, 400).unwrap();
    assert_eq!(value.to_text(20), "0.78588726077694800072");
}
