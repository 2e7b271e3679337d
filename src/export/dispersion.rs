//! Formulas of wavenumbers as text and LaTeX: one walk, two hands.

use num_traits::{One, Signed as _};
use wavestep_polynomial::{Rational, Symbol};

use crate::dispersion::{Formula, Function, Node};
use crate::export::notation::{Latex, Notation, Text};

/// What differs between the notations, beyond numbers and names.
trait Hand {
    fn number(&self, value: &Rational) -> String;
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

impl Hand for Text {
    fn number(&self, value: &Rational) -> String {
        Notation::number(self, value)
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        Notation::symbol(self, symbol)
    }

    fn root(&self, radicand: &str) -> String {
        format!("sqrt({radicand})")
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        Notation::power(self, base, exponent)
    }

    fn function(&self, function: Function, argument: &str, power: Option<&str>) -> String {
        let value = format!("{}({argument})", function.name());
        power.map_or(value.clone(), |power| Notation::power(self, &value, power))
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
    fn number(&self, value: &Rational) -> String {
        Notation::number(self, value)
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        Notation::symbol(self, symbol)
    }

    fn root(&self, radicand: &str) -> String {
        format!("\\sqrt{{{radicand}}}")
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        Notation::power(self, base, exponent)
    }

    fn function(&self, function: Function, argument: &str, power: Option<&str>) -> String {
        if function == Function::Exponential {
            return self.exponential(argument);
        }
        let name = match function {
            Function::Sinc => "\\operatorname{sinc}".to_owned(),
            other => format!("\\{}", other.name()),
        };
        let power = power.map_or(String::new(), |power| format!("^{{{power}}}"));
        format!("{name}{power}{}", self.enclosed(argument))
    }

    fn times(&self) -> &'static str {
        " "
    }

    fn bracket(&self, text: &str) -> String {
        self.enclosed(text)
    }

    fn quotient(&self, (upper, _): (&str, bool), (lower, _): (&str, bool)) -> String {
        format!("\\frac{{{upper}}}{{{lower}}}")
    }
}

/// A formula as text, which [`read_relation`](crate::language::read_relation) and
/// [`read_spectrum`](crate::language::read_spectrum) read back.
///
/// ```
/// use wavestep::dispersion::Builtin;
/// use wavestep::export::dispersion_text;
///
/// let love = Builtin::Love.relation();
/// assert_eq!(dispersion_text(love.frequency()), "k/sqrt(1 + kappa*k^2)");
/// assert_eq!(dispersion_text(love.phase_velocity()), "1/sqrt(1 + kappa*k^2)");
/// assert_eq!(dispersion_text(love.group_velocity()), "1/(1 + kappa*k^2)^(3/2)");
/// ```
#[must_use]
pub fn dispersion_text(formula: &Formula) -> String {
    sum(formula, &Text)
}

/// A formula as LaTeX, for math mode.
///
/// ```
/// use wavestep::dispersion::Builtin;
/// use wavestep::export::dispersion_latex;
///
/// let lattice = Builtin::Lattice.relation();
/// assert_eq!(dispersion_latex(lattice.group_velocity()), r"\cos\left(\frac{k}{2}\right)");
/// let stiff = dispersion_latex(Builtin::StiffString.relation().phase_velocity());
/// assert_eq!(stiff, r"\sqrt{1 + \frac{k^{2}}{12}}");
/// ```
#[must_use]
pub fn dispersion_latex(formula: &Formula) -> String {
    sum(formula, &Latex)
}

fn sum(formula: &Formula, hand: &dyn Hand) -> String {
    let terms = match formula.node() {
        Node::Sum(terms) => &terms[..],
        _ => std::slice::from_ref(formula),
    };
    let mut text = String::new();
    for (i, term) in terms.iter().enumerate() {
        text.push_str(match (i, term_is_negative(term)) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        text.push_str(&unsigned_term(term, hand));
    }
    text
}

/// Whether a term, which is no sum, has a minus in front.
fn term_is_negative(term: &Formula) -> bool {
    !matches!(term.node(), Node::Sum(_)) && term.leads_negative_number()
}

/// A term without its sign.
fn unsigned_term(term: &Formula, hand: &dyn Hand) -> String {
    let factors = match term.node() {
        Node::Product(factors) => &factors[..],
        _ => std::slice::from_ref(term),
    };
    let mut number = Rational::one();
    let (mut upper, mut lower) = (Vec::new(), Vec::new());
    for factor in factors {
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
            parts.push(hand.number(&number));
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
    let exponent = (!exponent.is_one()).then(|| Text.number_of(exponent));
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

impl Text {
    /// A number in a line, as exponents are written in both notations.
    fn number_of(&self, value: &Rational) -> String {
        Notation::number(self, value)
    }
}

impl Formula {
    /// Whether a negative number is its first factor.
    fn leads_negative_number(&self) -> bool {
        match self.node() {
            Node::Number(value) => value.is_negative(),
            Node::Product(factors) => {
                factors[0].as_number().is_some_and(num_traits::Signed::is_negative)
            }
            _ => false,
        }
    }
}
