//! JSON: the same results term by term, with reduced rationals as strings.

use serde_json::{Map, Value, json};
use wavestep::expression::{Expression, Fraction};
use wavestep_polynomial::{Polynomial, Symbol};

/// The version of the layout; it rises when a reader would have to change.
pub const SCHEMA_VERSION: u32 = 1;

/// What was written by this program.
pub(crate) fn read(document: &str) -> Value {
    serde_json::from_str(document).expect("a document")
}

/// An expression as a list of terms
/// `{"coefficient": "-4/3", "powers": {"s": 3}, "exponent": "-s"}`, each standing for
/// `coefficient · Π symbol^power · e^{exponent}`; a term over a denominator has
/// `"denominator": [{"factor": "r + 1", "power": 2}]` as well, and one with square roots
/// `"roots": ["-1", "3"]`, the numbers under them: it is multiplied by `√−1 · √3`. Terms are ordered by exponent, then
/// in the monomial order of the polynomials.
pub fn expression_json(expression: &Expression) -> Value {
    let mut terms = Vec::with_capacity(expression.term_count());
    for (exponent, fraction) in expression.terms() {
        let exponent = exponent.to_string();
        let denominator: Vec<Value> = fraction
            .factors()
            .map(|(factor, power)| json!({"factor": factor.to_string(), "power": power}))
            .collect();
        let numerator: &Polynomial = fraction.numerator();
        for (exponents, coefficient) in numerator.terms() {
            let powers: Map<String, Value> = numerator
                .symbols()
                .iter()
                .zip(exponents)
                .filter(|(symbol, power)| **power > 0 && symbol.square().is_none())
                .map(|(symbol, power)| (symbol.name().to_owned(), json!(power)))
                .collect();
            let roots: Vec<Value> = numerator
                .symbols()
                .iter()
                .zip(exponents)
                .filter(|(_, power)| **power > 0)
                .filter_map(|(symbol, _)| symbol.square())
                .map(|square| Value::String(square.to_string()))
                .collect();
            let mut term = Map::new();
            term.insert("coefficient".into(), Value::String(coefficient.to_string()));
            if !roots.is_empty() {
                term.insert("roots".into(), Value::Array(roots));
            }
            term.insert("powers".into(), Value::Object(powers));
            term.insert("exponent".into(), Value::String(exponent.clone()));
            if !denominator.is_empty() {
                term.insert("denominator".into(), Value::Array(denominator.clone()));
            }
            terms.push(Value::Object(term));
        }
    }
    Value::Array(terms)
}

/// Functions of `local` in a list, the first of which has index `first`.
pub fn pieces_json(index: &str, first: usize, local: &Symbol, pieces: &[Expression]) -> Value {
    let piece = |(i, piece): (usize, &Expression)| json!({index: first + i, "variable": local.name(), "terms": expression_json(piece)});
    Value::Array(pieces.iter().enumerate().map(piece).collect())
}

/// A fraction in plain text.
pub fn fraction_json(fraction: &Fraction) -> Value {
    Value::String(fraction.to_string())
}
