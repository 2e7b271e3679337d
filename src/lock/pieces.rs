//! Locked pieces of the waves of a recurrence, and values without events.

use crate::export::expression_text;
use crate::expression::{Expression, Fraction};
use crate::lock::difference::{Difference, compared};
use crate::lock::stated::{of_lattice, of_recurrence};
use crate::lock::{Contents, LIMIT_BITS, Lock, LockError, Request, Values};
use crate::network::Network;
use crate::planner::{self, Purpose};
use crate::recurrence::WaveIndex;
use crate::signal::{self, Arrival, Limit, Signal, arrivals, digits};
use crate::solution::Solution;
use std::collections::{BTreeMap, BTreeSet};
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// What the name of an echo begins with.
pub(super) const ECHO: &str = "phi_";

/// Pieces by wave and period; on a lattice echoes, by how often each of its periods has passed.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(super) struct Pieces {
    /// The last period of which pieces are locked; none where values alone are.
    pub through: Option<usize>,
    pub all: BTreeMap<(String, Vec<usize>), Piece>,
}

/// A wave function on one period, or an echo.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Piece {
    pub variable: Symbol,
    pub expression: Expression,
}

/// What pieces and values are derived from.
#[derive(Clone, Copy)]
pub enum Derivable<'a> {
    /// Equations between periods.
    Equations(&'a Solution),
    /// A scene, with its solution where it has periods, and not a lattice of them.
    Scene(&'a Network, Option<&'a Solution>),
}

impl Lock {
    /// Derives the pieces of all waves on the periods from 0 through `through`, on a lattice the echoes that are
    /// known to come first within so many periods together, and values: of all waves and
    /// observables; of the observables alone where a scene has units, constants or no periods.
    pub fn of_pieces(
        from: Derivable<'_>,
        through: Option<usize>,
        request: &Request,
    ) -> Result<Lock, LockError> {
        let request = request.in_order()?;
        let solution = match from {
            Derivable::Equations(solution) => Some(solution),
            Derivable::Scene(_, solution) => solution,
        };
        let mut all = BTreeMap::new();
        if let (Some(solution), Some(through)) = (solution, through) {
            let statement = solution.recurrence().statement();
            for (wave, name) in statement.waves.iter().enumerate() {
                for (n, expression) in solution.pieces(wave, 0, through)?.into_iter().enumerate() {
                    let piece = Piece { variable: statement.local.clone(), expression };
                    all.insert((name.clone(), vec![n]), piece);
                }
            }
        }
        if let (Derivable::Scene(network, None), Some(through)) = (from, through) {
            let waves: Vec<WaveIndex> = (0..network.waves().len()).collect();
            let found = arrivals(network, &waves, through, usize::MAX)?;
            for Arrival { wave, counts, echo, .. } in found.expect("of any length") {
                let piece = Piece { variable: network.local(), expression: echo };
                all.insert((network.waves()[wave].name.clone(), counts), piece);
            }
        }
        let values = match from {
            Derivable::Equations(solution) => of_solution(solution, &request)?,
            Derivable::Scene(network, Some(solution))
                if !network.scene().dimensional && solution.recurrence().constants().is_empty() =>
            {
                of_solution(solution, &request)?
            }
            Derivable::Scene(network, _) => of_observables(network, &request)?,
        };
        let stated = match from {
            Derivable::Scene(network, None) => of_lattice(network),
            Derivable::Equations(solution) | Derivable::Scene(_, Some(solution)) => {
                of_recurrence(solution.recurrence().statement())
            }
        };
        let contents = Contents::Pieces(Pieces { through, all });
        Ok(Lock { stated, request, contents, values })
    }
}

/// The values of all waves and observables of a recurrence.
fn of_solution(solution: &Solution, request: &Request) -> Result<Values, LockError> {
    let statement = solution.recurrence().statement();
    let names: Vec<String> = statement.observed().into_iter().map(str::to_owned).collect();
    let names = statement.waves.iter().chain(&names);
    let signal = |name: &String, window| {
        Ok(signal::of_recurrence(solution, name, window)?.expect("a known name"))
    };
    request.values(names.map(|name| (name, name)), signal, |_, signal, time| {
        rounded(&**signal, time, request)
    })
}

/// The values of all observables of a scene, in its units.
fn of_observables(network: &Network, request: &Request) -> Result<Values, LockError> {
    let observables = network.observables().iter().map(|observed| (&observed.name, observed));
    let purpose = Purpose::Values { digits: request.digits };
    let signal = |observed, window| Ok(planner::of_scene(network, observed, window, purpose)?);
    request.values(observables, signal, |_, signal, time| rounded(&**signal, time, request))
}

fn rounded(signal: &dyn Signal, time: &Rational, request: &Request) -> Result<String, LockError> {
    let value = digits(signal, time, Limit::Right, request.digits, LIMIT_BITS)?;
    Ok(value.decimal(request.digits).0.to_string())
}

impl Pieces {
    pub fn differences(&self, now: &Pieces) -> Vec<Difference> {
        compared(&self.all, &now.all, name, differing_terms)
    }
}

/// `f[3]`, `phi_f[2,1]`.
pub(super) fn name((wave, counts): &(String, Vec<usize>)) -> String {
    let echo = if counts.len() > 1 { ECHO } else { "" };
    let counts: Vec<String> = counts.iter().map(ToString::to_string).collect();
    format!("{echo}{wave}[{}]", counts.join(","))
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
