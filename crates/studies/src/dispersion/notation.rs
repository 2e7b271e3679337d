//! Formulas of wavenumbers as text and LaTeX: one walk, two hands.

use num_traits::{One, Signed};
use wavestep_polynomial::{Rational, Symbol};

use super::formula::{Formula, Function, Node};
use wavestep::export::latex_name;

/// What differs between the notations.
trait Hand {
    fn symbol(&self, symbol: &Symbol) -> String;
    fn root(&self, radicand: &str) -> String;
    fn power(&self, base: &str, exponent: &str) -> String;
    /// A function of an argument, to a power where there is one.
    fn function(&self, function: Function, argument: &str, power: Option<&str>) -> String;
    /// What stands between two factors.
    fn times(&self) -> &'static str;
    fn bracket(&self, text: &str) -> String;
    /// A quotient; the flags say whether a side is a sum, and whether the lower one has several
    /// factors.
    fn quotient(&self, upper: (&str, bool), lower: (&str, bool)) -> String;
}

struct Text;

struct Latex;

impl Hand for Text {
    fn symbol(&self, symbol: &Symbol) -> String {
        symbol.to_string()
    }

    fn root(&self, radicand: &str) -> String {
        format!("sqrt({radicand})")
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        let simple = exponent.chars().all(char::is_alphanumeric);
        if simple { format!("{base}^{exponent}") } else { format!("{base}^({exponent})") }
    }

    fn function(&self, function: Function, argument: &str, power: Option<&str>) -> String {
        let value = format!("{}({argument})", function.name());
        power.map_or(value.clone(), |power| self.power(&value, power))
    }

    fn times(&self) -> &'static str {
        "*"
    }

    fn bracket(&self, text: &str) -> String {
        format!("({text})")
    }

    fn quotient(&self, upper: (&str, bool), lower: (&str, bool)) -> String {
        let side = |(text, brackets): (&str, bool)| match brackets {
            true => format!("({text})"),
            false => text.to_owned(),
        };
        format!("{}/{}", side(upper), side(lower))
    }
}

impl Hand for Latex {
    fn symbol(&self, symbol: &Symbol) -> String {
        latex_name(symbol.name(), None)
    }

    fn root(&self, radicand: &str) -> String {
        format!("\\sqrt{{{radicand}}}")
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        // A subscript and an exponent stand over each other only with braces.
        let braces = base.contains("_{") && !base.starts_with('(');
        let base = if braces { format!("{{{base}}}") } else { base.to_owned() };
        format!("{base}^{{{exponent}}}")
    }

    fn function(&self, function: Function, argument: &str, power: Option<&str>) -> String {
        if function == Function::Exponential {
            return format!("e^{{{argument}}}");
        }
        let name = match function {
            Function::Sinc => "\\operatorname{sinc}".to_owned(),
            other => format!("\\{}", other.name()),
        };
        let power = power.map_or(String::new(), |power| format!("^{{{power}}}"));
        format!("{name}{power}{}", self.bracket(argument))
    }

    fn times(&self) -> &'static str {
        " "
    }

    fn bracket(&self, text: &str) -> String {
        let tall = text.contains("\\frac");
        if tall { format!("\\left({text}\\right)") } else { format!("({text})") }
    }

    fn quotient(&self, (upper, _): (&str, bool), (lower, _): (&str, bool)) -> String {
        format!("\\frac{{{upper}}}{{{lower}}}")
    }
}

/// A formula as text, which [`read_relation`](super::read_relation) and
/// [`read_spectrum`](super::read_spectrum) read back.
pub fn formula_text(formula: &Formula) -> String {
    sum(formula, &Text)
}

/// A formula as LaTeX, for math mode.
pub fn formula_latex(formula: &Formula) -> String {
    sum(formula, &Latex)
}

fn sum(formula: &Formula, hand: &dyn Hand) -> String {
    let mut text = String::new();
    for (i, term) in formula.terms().iter().enumerate() {
        let is_negative = term.factors()[0].as_number().is_some_and(Signed::is_negative);
        text.push_str(match (i, is_negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        text.push_str(&unsigned_term(term, hand));
    }
    text
}

/// A term without its sign.
fn unsigned_term(term: &Formula, hand: &dyn Hand) -> String {
    let mut number = Rational::one();
    let (mut upper, mut lower) = (Vec::new(), Vec::new());
    for factor in term.factors() {
        match factor.node() {
            Node::Number(value) => number = value.abs(),
            Node::Power(base, exponent) if exponent.is_negative() => {
                lower.push((base, -exponent.clone()));
            }
            Node::Power(base, exponent) => upper.push((base, exponent.clone())),
            _ => upper.push((factor, Rational::one())),
        }
    }
    let side = |number: Rational, factors: &[(&Formula, Rational)]| {
        let one_sum = number.is_one()
            && matches!(factors, [(base, exponent)]
                if exponent.is_one() && matches!(base.node(), Node::Sum(_)));
        if one_sum {
            return (sum(factors[0].0, hand), 1, true);
        }
        let mut parts = Vec::new();
        if !number.is_one() || factors.is_empty() {
            parts.push(number.to_string());
        }
        parts.extend(factors.iter().map(|(base, exponent)| power(base, exponent, hand)));
        (parts.join(hand.times()), parts.len(), false)
    };
    let (above, _, above_sum) = side(number.numer().clone().into(), &upper);
    if lower.is_empty() && number.denom().is_one() {
        return if above_sum { hand.bracket(&above) } else { above };
    }
    let (below, count, below_sum) = side(number.denom().clone().into(), &lower);
    hand.quotient((&above, above_sum), (&below, below_sum || count > 1))
}

/// A factor with a positive exponent.
fn power(base: &Formula, exponent: &Rational, hand: &dyn Hand) -> String {
    if *exponent == Rational::new(1.into(), 2.into()) {
        return hand.root(&sum(base, hand));
    }
    let exponent = (!exponent.is_one()).then(|| exponent.to_string());
    let raised = |base: String| match &exponent {
        Some(exponent) => hand.power(&base, exponent),
        None => base,
    };
    match base.node() {
        Node::Symbol(symbol) => raised(hand.symbol(symbol)),
        Node::Function(function, argument) => {
            hand.function(*function, &sum(argument, hand), exponent.as_deref())
        }
        _ => raised(hand.bracket(&sum(base, hand))),
    }
}
