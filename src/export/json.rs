//! JSON: the same results term by term, with reduced rationals as strings.

use crate::expression::{Expression, Fraction};
use serde_json::{Map, Value, json};
use wavestep_polynomial::{Polynomial, Symbol};

/// The version of the layout; it rises when a reader would have to change.
///
/// ```
/// use wavestep::export::{SCHEMA_VERSION, expression_json};
/// use wavestep::expression::Expression;
///
/// let one = expression_json(&Expression::one()).to_string();
/// let layout = r#"[{"coefficient":"1","powers":{},"exponent":"0"}]"#;
/// assert_eq!((SCHEMA_VERSION, one.as_str()), (1, layout));
/// ```
pub const SCHEMA_VERSION: u32 = 1;

/// An expression as a list of terms
/// `{"coefficient": "-4/3", "powers": {"s": 3}, "exponent": "-s"}`, each standing for
/// `coefficient · Π symbol^power · e^{exponent}`; a term over a denominator has
/// `"denominator": [{"factor": "r + 1", "power": 2}]` as well, and one with square roots
/// `"roots": ["-1", "3"]`, the numbers under them: it is multiplied by `√−1 · √3`. Terms are ordered by exponent, then
/// in the monomial order of the polynomials.
///
/// ```
/// use wavestep::export::expression_json;
/// use wavestep::language::{Source, read_expression};
///
/// let value = read_expression(&Source::new("text", "-4/3*s^3*exp(-s)/(r + 1)")?)?;
/// let term = &expression_json(&value)[0];
/// assert_eq!(term["coefficient"], "-4/3");
/// assert_eq!(term["powers"].to_string(), r#"{"s":3}"#);
/// assert_eq!(term["exponent"], "-s");
/// assert_eq!(term["denominator"].to_string(), r#"[{"factor":"r + 1","power":1}]"#);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
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
///
/// ```
/// use wavestep::export::pieces_json;
/// use wavestep::expression::Expression;
/// use wavestep_polynomial::Symbol;
///
/// let s = Symbol::new("s").unwrap();
/// let pieces = pieces_json("n", 7, &s, &[Expression::one(), Expression::zero()]);
/// assert_eq!((&pieces[0]["n"], &pieces[1]["n"]), (&7.into(), &8.into()));
/// assert_eq!(pieces[1].to_string(), r#"{"n":8,"variable":"s","terms":[]}"#);
/// ```
pub fn pieces_json(index: &str, first: usize, local: &Symbol, pieces: &[Expression]) -> Value {
    let piece = |(i, piece): (usize, &Expression)| json!({index: first + i, "variable": local.name(), "terms": expression_json(piece)});
    Value::Array(pieces.iter().enumerate().map(piece).collect())
}

/// A fraction in plain text.
///
/// ```
/// use wavestep::{export::fraction_json, expression::Fraction};
/// use wavestep_polynomial::Polynomial;
///
/// let period = Fraction::from("2*mu".parse::<Polynomial>().unwrap());
/// assert_eq!(fraction_json(&period), "2*mu");
/// ```
pub fn fraction_json(fraction: &Fraction) -> Value {
    Value::String(fraction.to_string())
}
