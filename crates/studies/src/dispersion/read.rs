//! Dispersion relations and spectra: expressions in the wavenumber `k`, with named parameters.

use std::collections::BTreeMap;

use num_rational::BigRational;
use wavestep_polynomial::Symbol;

use super::error::DispersionError;
use super::formula::{Formula, FormulaError, Function};
use super::relation::Relation;
use wavestep::language::syntax::{Expression, Factor, Function as Written, Node, Operator, Sign};
use wavestep::language::{Diagnostic, RESERVED, Source, constant, parse_expression};

/// Functions that are names to the grammar.
const MORE_FUNCTIONS: [(&str, Function); 2] =
    [("tanh", Function::HyperbolicTangent), ("sinc", Function::Sinc)];

/// Reads a dispersion relation `ω(k)`: numbers, `k`, `pi`, parameters, `+ - * /`, powers with rational
/// exponents, `sqrt`, `sin`, `cos`, `exp`, `tanh` and `sinc`; with values in place of parameters.
pub fn read_relation(
    source: &Source,
    values: &BTreeMap<String, BigRational>,
) -> Result<Relation, Diagnostic> {
    let tree = parse_expression(source)?;
    let whole = |error: DispersionError| {
        Diagnostic::new(source, error.to_string(), tree.span, "this formula")
            .with_remedy(error.remedy())
    };
    let relation = Relation::new(formula(&tree, source)?).map_err(whole)?;
    relation.with_values(values).map_err(whole)
}

/// Reads a spectrum `U(k)`, in the same notation, without parameters.
pub fn read_spectrum(source: &Source) -> Result<Formula, Diagnostic> {
    let tree = parse_expression(source)?;
    let spectrum = formula(&tree, source)?;
    let known = ["k", "pi"];
    match spectrum.symbols().iter().find(|symbol| !known.contains(&symbol.name())) {
        None => Ok(spectrum),
        Some(symbol) => {
            let message = format!("the parameter `{symbol}` has no value");
            Err(Diagnostic::new(source, message, tree.span, "a spectrum is a formula in k alone")
                .with_remedy("write the number"))
        }
    }
}

fn formula(tree: &Expression, source: &Source) -> Result<Formula, Diagnostic> {
    let failed = |error: FormulaError, label: &str| {
        Diagnostic::new(source, error.to_string(), tree.span, label)
            .with_remedy("use other numbers")
    };
    Ok(match &tree.value {
        Node::Number(value) => Formula::number(value),
        Node::Name(written) => {
            let symbol = Symbol::new(written).expect("names are names");
            Formula::symbol(&symbol)
        }
        Node::Negate(operand) => formula(operand, source)?.negate(),
        Node::Sum(terms) => terms.iter().try_fold(Formula::integer(0), |sum, term| {
            let value = formula(&term.value, source)?;
            Ok(if term.sign == Sign::Plus { sum.add(&value) } else { sum.subtract(&value) })
        })?,
        Node::Product(factors) => product(factors, Operator::Multiply, source)?,
        Node::Power { base, exponent } => {
            let exponent = constant(exponent, source)?;
            let base = formula(base, source)?;
            base.power(&exponent).map_err(|error| failed(error, "this power"))?
        }
        Node::Exponential(argument) => formula(argument, source)?.apply(Function::Exponential),
        Node::Function { function, argument } => {
            let argument = formula(argument, source)?;
            match function {
                Written::Cosine => argument.apply(Function::Cosine),
                Written::Sine => argument.apply(Function::Sine),
                Written::SquareRoot => {
                    let half = BigRational::new(1.into(), 2.into());
                    argument.power(&half).map_err(|error| failed(error, "this root"))?
                }
            }
        }
        Node::Call { name: called, argument } => {
            let known = MORE_FUNCTIONS.iter().find(|(word, _)| *word == called.value);
            let Some((_, function)) = known else {
                let words = RESERVED.iter().filter(|word| **word != "sum").copied();
                let words = words.chain(MORE_FUNCTIONS.iter().map(|(word, _)| *word));
                let message = format!("there is no function `{}`", called.value);
                return Err(Diagnostic::new(source, message, called.span, "not known")
                    .with_closest(&called.value, words)
                    .or_remedy("use one of sqrt, sin, cos, exp, tanh and sinc"));
            };
            formula(argument, source)?.apply(*function)
        }
        Node::Wave(_) | Node::Summation { .. } => {
            let message = "this has no place in a formula of the wavenumber";
            return Err(Diagnostic::new(source, message, tree.span, "a formula in k is needed")
                .with_remedy("write ω as a formula in k, such as 2*sin(k/2)"));
        }
    })
}

/// The product of factors, those with another operator than `above` as divisors.
fn product(factors: &[Factor], above: Operator, source: &Source) -> Result<Formula, Diagnostic> {
    factors.iter().try_fold(Formula::integer(1), |product, factor| {
        let of = if factor.operator == above { formula } else { inverse };
        Ok(product.multiply(&of(&factor.value, source)?))
    })
}

/// One over the formula of a tree; powers and products stay as they are written, `1/(1 + k)^2` is not
/// multiplied out.
fn inverse(tree: &Expression, source: &Source) -> Result<Formula, Diagnostic> {
    let failed = |error: FormulaError| {
        let label = match error {
            FormulaError::DivisionByZero => "this is zero",
            _ => "this power",
        };
        Diagnostic::new(source, error.to_string(), tree.span, label)
            .with_remedy("divide by nonzero terms without huge powers")
    };
    match &tree.value {
        Node::Negate(operand) => Ok(inverse(operand, source)?.negate()),
        Node::Product(factors) => product(factors, Operator::Divide, source),
        Node::Power { base, exponent } => {
            let exponent = -constant(exponent, source)?;
            formula(base, source)?.power(&exponent).map_err(failed)
        }
        _ => formula(tree, source)?.power(&BigRational::from_integer((-1).into())).map_err(failed),
    }
}
