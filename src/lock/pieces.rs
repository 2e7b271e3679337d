//! Locked pieces of the waves of a recurrence.

use crate::export::expression_text;
use crate::expression::{Expression, Fraction};
use crate::lock::difference::{Difference, compared};
use crate::lock::stated::of_recurrence;
use crate::lock::{Contents, LIMIT_BITS, Lock, LockError, Request, Values};
use crate::signal::{ClosedSignal, Limit, digits};
use crate::solution::Solution;
use std::collections::{BTreeMap, BTreeSet};
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// Pieces by wave and period.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(super) struct Pieces {
    /// The last period of which pieces are locked.
    pub through: usize,
    pub all: BTreeMap<(String, usize), Piece>,
}

/// A wave function on one period.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Piece {
    pub variable: Symbol,
    pub expression: Expression,
}

impl Lock {
    /// Derives the pieces of all waves on the periods from 0 through `through`, and values of all waves
    /// and observables.
    pub fn of_pieces(
        solution: &Solution,
        through: usize,
        request: &Request,
    ) -> Result<Lock, LockError> {
        let request = request.in_order()?;
        let statement = solution.recurrence().statement();
        let mut all = BTreeMap::new();
        for (wave, name) in statement.waves.iter().enumerate() {
            for (n, expression) in solution.pieces(wave, 0, through)?.into_iter().enumerate() {
                let piece = Piece { variable: statement.local.clone(), expression };
                all.insert((name.clone(), n), piece);
            }
        }
        let values = values(solution, &request)?;
        let contents = Contents::Pieces(Pieces { through, all });
        Ok(Lock { stated: of_recurrence(statement), request, contents, values })
    }
}

/// The values of all waves and observables.
fn values(solution: &Solution, request: &Request) -> Result<Values, LockError> {
    let mut values = Values::new();
    let (Some(first), Some(last)) = (request.times.first(), request.times.last()) else {
        return Ok(values);
    };
    let statement = solution.recurrence().statement();
    let observables = statement.observables.iter().map(|observable| &observable.name);
    for name in statement.waves.iter().chain(observables) {
        let quantity = solution.recurrence().observation(name).expect("a known name");
        let signal = ClosedSignal::of_recurrence(solution, &quantity, [first, last])?;
        for time in &request.times {
            let value = digits(&signal, time, Limit::Right, request.digits, LIMIT_BITS)?;
            let decimal = value.decimal(request.digits).0.to_string();
            values.insert((name.clone(), time.clone()), decimal);
        }
    }
    Ok(values)
}

impl Pieces {
    pub fn differences(&self, now: &Pieces) -> Vec<Difference> {
        compared(&self.all, &now.all, |(wave, n)| format!("{wave}[{n}]"), differing_terms)
    }
}

fn differing_terms(old: &Piece, new: &Piece) -> Vec<String> {
    if old.variable != new.variable {
        return vec![format!("locked as a function of {}, now of {}", old.variable, new.variable)];
    }
    let (old_terms, new_terms) = (by_exponent(&old.expression), by_exponent(&new.expression));
    let exponents: BTreeSet<&Fraction> =
        old_terms.keys().chain(new_terms.keys()).copied().collect();
    let mut lines = Vec::new();
    let zero = Fraction::zero();
    for exponent in exponents {
        let old = *old_terms.get(exponent).unwrap_or(&&zero);
        let new = *new_terms.get(exponent).unwrap_or(&&zero);
        let exponential = Expression::exponential(exponent.clone());
        match (old.as_polynomial(), new.as_polynomial()) {
            (Some(old), Some(new)) => {
                for (monomial, old, new) in different_monomials(old, new) {
                    let term = &Expression::from(monomial) * &exponential;
                    lines.push(line(
                        &term,
                        &Expression::constant(&old),
                        &Expression::constant(&new),
                    ));
                }
            }
            _ if old != new => {
                lines.push(line(&exponential, &old.clone().into(), &new.clone().into()))
            }
            _ => {}
        }
    }
    lines
}

fn by_exponent(expression: &Expression) -> BTreeMap<&Fraction, &Fraction> {
    expression.terms().collect()
}

/// The monomials whose coefficients differ, with both coefficients.
fn different_monomials(
    old: &Polynomial,
    new: &Polynomial,
) -> Vec<(Polynomial, Rational, Rational)> {
    let terms = |p: &Polynomial| -> BTreeMap<Vec<(Symbol, u32)>, Rational> {
        let powers = |exponents: &[u32]| {
            let powers = p.symbols().iter().cloned().zip(exponents.iter().copied());
            powers.filter(|(_, exponent)| *exponent > 0).collect()
        };
        p.terms().map(|(exponents, value)| (powers(exponents), value)).collect()
    };
    let (old, new) = (terms(old), terms(new));
    let keys: BTreeSet<_> = old.keys().chain(new.keys()).collect();
    let mut different = Vec::new();
    for key in keys {
        let at = |terms: &BTreeMap<_, Rational>| terms.get(key).cloned().unwrap_or_default();
        let (old, new) = (at(&old), at(&new));
        if old != new {
            let powers: Vec<(&Symbol, u32)> = key.iter().map(|(x, e)| (x, *e)).collect();
            let one = Rational::from_integer(1.into());
            different.push((Polynomial::monomial(&one, &powers), old, new));
        }
    }
    different
}

fn line(term: &Expression, old: &Expression, new: &Expression) -> String {
    let both = format!("locked {}, now {}", expression_text(old), expression_text(new));
    if term.is_one() { both } else { format!("{}: {both}", expression_text(term)) }
}
