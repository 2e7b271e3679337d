//! Formulas of wavenumbers as text and LaTeX.

use num_traits::{One, Signed};
use wavestep_polynomial::Rational;

use super::formula::{Formula, Function, Node};
use wavestep::export::Notation;

/// A formula as text, which [`read_relation`](super::read_relation) and
/// [`read_spectrum`](super::read_spectrum) read back.
pub fn formula_text(formula: &Formula) -> String {
    sum(formula, Notation::Text)
}

pub fn formula_latex(formula: &Formula) -> String {
    sum(formula, Notation::Latex)
}

fn sum(formula: &Formula, n: Notation) -> String {
    let mut text = String::new();
    for (i, term) in formula.terms().iter().enumerate() {
        let is_negative = term.factors()[0].as_number().is_some_and(Signed::is_negative);
        text.push_str(match (i, is_negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        text.push_str(&unsigned_term(term, n));
    }
    text
}

/// A term without its sign.
fn unsigned_term(term: &Formula, n: Notation) -> String {
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
            return (sum(factors[0].0, n), 1, true);
        }
        let mut parts = Vec::new();
        if !number.is_one() || factors.is_empty() {
            parts.push(number.to_string());
        }
        parts.extend(factors.iter().map(|(base, exponent)| power(base, exponent, n)));
        (parts.join(n.times_symbol()), parts.len(), false)
    };
    let (above, _, above_sum) = side(number.numer().clone().into(), &upper);
    if lower.is_empty() && number.denom().is_one() {
        return if above_sum { n.enclosed(&above) } else { above };
    }
    let (below, count, below_sum) = side(number.denom().clone().into(), &lower);
    n.quotient((&above, above_sum), (&below, below_sum || count > 1))
}

/// A factor with a positive exponent.
fn power(base: &Formula, exponent: &Rational, n: Notation) -> String {
    if *exponent == Rational::new(1.into(), 2.into()) {
        return n.root_of(&sum(base, n));
    }
    let exponent = (!exponent.is_one()).then(|| exponent.to_string());
    let raised = |base: String| match &exponent {
        Some(exponent) => n.power(&base, exponent),
        None => base,
    };
    match base.node() {
        Node::Symbol(symbol) => raised(n.symbol(symbol)),
        Node::Function(Function::Exponential, argument) => raised(n.exponential(&sum(argument, n))),
        Node::Function(function, argument) => {
            let (name, argument) = (function.name(), sum(argument, n));
            match (n, &exponent) {
                (Notation::Text | Notation::MathMl, _) => raised(n.function(name, &argument)),
                // The exponent stands behind the name.
                (Notation::Latex, exponent) => {
                    let command = match function {
                        Function::Sinc => "operatorname{sinc}",
                        _ => name,
                    };
                    let power = exponent.as_ref().map_or(String::new(), |e| format!("^{{{e}}}"));
                    n.function(&format!("{command}{power}"), &argument)
                }
            }
        }
        _ => raised(n.enclosed(&sum(base, n))),
    }
}
