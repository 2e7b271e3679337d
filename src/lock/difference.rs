//! What differs between two locks: which piece, which term, old and new.

use crate::export::expression_text;
use crate::expression::{Expression, Fraction};
use crate::lock::{Lock, Piece};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use wavestep_polynomial::{Polynomial, Rational, Symbol};

/// The most terms that are shown of one piece.
const MAX_SHOWN: usize = 10;

/// One difference between what is locked and what is derived now.
///
/// It is shown in lines: what differs, and for a piece every term with what is locked and what is
/// derived now.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Difference {
    what: String,
    lines: Vec<String>,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.what)?;
        self.lines.iter().take(MAX_SHOWN).try_for_each(|line| writeln!(f, "  {line}"))?;
        match self.lines.len().saturating_sub(MAX_SHOWN) {
            0 => Ok(()),
            more => writeln!(f, "  … and {more} more terms"),
        }
    }
}

impl Lock {
    /// How `now` differs from this lock, piece by piece and value by value. What only one of them
    /// has is a difference as well.
    pub fn differences(&self, now: &Lock) -> Vec<Difference> {
        let both =
            |old: &String, new: &String| vec![format!("locked {old}"), format!("now    {new}")];
        let mut differences = compared(&self.stated, &now.stated, String::clone, both);
        let name = |(wave, n): &(String, usize)| format!("{wave}[{n}]");
        differences.extend(compared(&self.pieces, &now.pieces, name, of_pieces));
        let name = |(quantity, time): &(String, Rational)| format!("{quantity}({time})");
        differences.extend(compared(&self.values, &now.values, name, both));
        differences
    }
}

/// The differences between entries of the same key, and the keys that only one side has.
pub(super) fn compared<K: Ord, V: PartialEq>(
    old: &BTreeMap<K, V>,
    new: &BTreeMap<K, V>,
    name: impl Fn(&K) -> String,
    lines: impl Fn(&V, &V) -> Vec<String>,
) -> Vec<Difference> {
    let keys: BTreeSet<&K> = old.keys().chain(new.keys()).collect();
    let difference = |key: &K| {
        let (what, lines) = match (old.get(key), new.get(key)) {
            (Some(old), Some(new)) if old == new => return None,
            (Some(old), Some(new)) => ("differs", lines(old, new)),
            (Some(_), None) => ("is locked, and is not derived now", Vec::new()),
            (None, _) => ("is derived now, and is not locked", Vec::new()),
        };
        Some(Difference { what: format!("{} {what}", name(key)), lines })
    };
    keys.into_iter().filter_map(difference).collect()
}

/// The terms in which two pieces differ.
fn of_pieces(old: &Piece, new: &Piece) -> Vec<String> {
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
