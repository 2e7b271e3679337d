//! Expressions as lists.

use num_rational::BigRational;
use serde_json::{Map, Value as Json, json};
use std::collections::BTreeSet;
use wavestep::expression::{Expression, Fraction, PI};
use wavestep::recurrence::{LinearForm, Recurrence};
use wavestep::solution::{Family, GeneralForm};
use wavestep_polynomial::{Polynomial, Symbol};

/// Writes expressions as lists, and keeps the symbols that it met.
#[derive(Default)]
pub struct Writer {
    /// Those that stand for square roots.
    roots: BTreeSet<Symbol>,
    pub others: BTreeSet<Symbol>,
}

impl Writer {
    /// `[[coefficient, {symbol: power}], …]`.
    fn polynomial(&mut self, polynomial: &Polynomial) -> Json {
        let symbols = polynomial.symbols();
        for symbol in symbols {
            let kind = if symbol.square().is_some() { &mut self.roots } else { &mut self.others };
            kind.insert(symbol.clone());
        }
        let term = |(exponents, coefficient): (&[u32], BigRational)| {
            let powers = symbols.iter().zip(exponents).filter(|(_, power)| **power > 0);
            let powers: Map<String, Json> =
                powers.map(|(symbol, power)| (symbol.to_string(), json!(power))).collect();
            json!([coefficient.to_string(), powers])
        };
        polynomial.terms().map(term).collect()
    }

    /// `[[numerator, [[factor, power], …]]]`, empty for zero.
    pub fn function(&mut self, fraction: &Fraction) -> Json {
        if fraction.is_zero() {
            return json!([]);
        }
        let below: Vec<Json> = fraction
            .factors()
            .map(|(factor, power)| json!([self.polynomial(factor), power]))
            .collect();
        json!([[self.polynomial(fraction.numerator()), below]])
    }

    /// `[[exponent, coefficient], …]`.
    pub fn expression(&mut self, expression: &Expression) -> Json {
        expression
            .terms()
            .map(|(exponent, coefficient)| {
                json!([self.function(exponent), self.function(coefficient)])
            })
            .collect()
    }

    /// `{"waves": [[wave, "value", lag, coefficient], …], "forcing": [[lag, function], …]}`.
    pub fn form(&mut self, recurrence: &Recurrence, form: &LinearForm) -> Json {
        let mut waves = Vec::new();
        for (wave, operator) in form.operators() {
            let rows =
                [("value", &operator.value), ("slope", &operator.slope), ("sum", &operator.sum)];
            for (kind, lags) in rows {
                waves.extend(lags.iter().map(|(lag, coefficient)| {
                    json!([recurrence.wave_name(wave), kind, lag, self.expression(coefficient)])
                }));
            }
        }
        let forcing: Vec<Json> = form
            .forcing_terms()
            .iter()
            .map(|(lag, function)| json!([lag, self.expression(function)]))
            .collect();
        json!({ "waves": waves, "forcing": forcing })
    }

    /// `{"first": […], "terms": …}`: `Σ c n^j λ^n` as `[[c, j, λ], …]`, or echoes `ρ^k e^(-b x) Σ c T_(k - i)(x)` with their
    /// family and numbers and `[[i, c], …]`.
    pub fn general(&mut self, form: &GeneralForm) -> Json {
        match form {
            GeneralForm::Geometric(form) => {
                let first: Vec<Json> = form.first.iter().map(|own| self.expression(own)).collect();
                let terms = form.terms.iter().map(|term| {
                    json!([
                        self.expression(&term.coefficient),
                        term.power,
                        self.expression(&term.ratio)
                    ])
                });
                let terms: Vec<Json> = terms.collect();
                json!({ "first": first, "terms": terms })
            }
            GeneralForm::Echoes(form) => {
                let first: Vec<Json> = form.first.iter().map(|own| self.expression(own)).collect();
                let terms = form.terms.iter().map(|(lag, c)| json!([lag, self.function(c)]));
                let terms: Vec<Json> = terms.collect();
                let c = match &form.family {
                    Family::Laguerre(c) => Some(self.function(c)),
                    Family::Power => None,
                };
                json!({
                    "first": first, "terms": terms, "laguerre": c,
                    "rate": self.function(&form.rate), "ratio": self.function(&form.ratio),
                })
            }
        }
    }

    /// What is below each root; those that turns hold are among them.
    pub fn told_roots(&self) -> Json {
        let has_turns = self.others.iter().any(|symbol| symbol.name() == PI)
            && self.roots.iter().any(|root| root.square() == Some(-1));
        let of_turns = [-1, 2, 3].into_iter().filter(|_| has_turns);
        let of_turns: Vec<Symbol> = of_turns.filter_map(Symbol::square_root).collect();
        let square =
            |symbol: &Symbol| Some((symbol.to_string(), json!(symbol.square()?.to_string())));
        Json::Object(self.roots.iter().chain(&of_turns).filter_map(square).collect())
    }
}
