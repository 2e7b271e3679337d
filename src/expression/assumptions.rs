//! Assumptions on symbols: conditions on their values, and factors that are not zero.

use crate::expression::fraction::Fraction;
use crate::expression::sum::Expression;
use crate::expression::turn::PI;
use num_traits::{Signed, Zero};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol};

/// How a symbol compares with a number.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Relation {
    Greater,
    AtLeast,
    Less,
    AtMost,
    Unequal,
}

/// A condition on the value of one symbol, such as `> 0`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Condition {
    pub relation: Relation,
    pub bound: Rational,
}

impl Condition {
    /// `> bound`
    pub fn above(bound: i64) -> Condition {
        Condition { relation: Relation::Greater, bound: Rational::from_integer(bound.into()) }
    }

    /// Whether `value` meets the condition.
    pub fn holds(&self, value: &Rational) -> bool {
        match self.relation {
            Relation::Greater => value > &self.bound,
            Relation::AtLeast => value >= &self.bound,
            Relation::Less => value < &self.bound,
            Relation::AtMost => value <= &self.bound,
            Relation::Unequal => value != &self.bound,
        }
    }

    /// A half-line of values as `bound ± x`, `x` not negative; `None` for `!=`.
    fn half_line(&self, symbol: &Symbol) -> Option<Polynomial> {
        let (x, bound) = (Polynomial::symbol(symbol), Polynomial::constant(&self.bound));
        match self.relation {
            Relation::Greater | Relation::AtLeast => Some(&bound + &x),
            Relation::Less | Relation::AtMost => Some(&bound - &x),
            Relation::Unequal => None,
        }
    }

    fn is_strict(&self) -> bool {
        !self.holds(&self.bound)
    }
}

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Relation::Greater => ">",
            Relation::AtLeast => ">=",
            Relation::Less => "<",
            Relation::AtMost => "<=",
            Relation::Unequal => "!=",
        })
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.relation, self.bound)
    }
}

/// Conditions on symbols, and irreducible factors taken to be non-zero.
///
/// Only declared factors, and such as cannot vanish under the conditions, are divided by. A
/// symbolic answer therefore holds wherever the conditions hold and no factor vanishes; other
/// values are put in before anything is derived.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Assumptions {
    conditions: BTreeMap<Symbol, Option<Condition>>,
    factors: BTreeSet<Polynomial>,
    /// Numbers between which the values of symbols lie.
    bounds: BTreeMap<Symbol, (Rational, Rational)>,
    /// The squares of symbols.
    squares: BTreeMap<Symbol, Fraction>,
}

/// An expression that the declared factors do not allow to divide by.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NotInvertible {
    #[error("division by zero")]
    Zero,
    /// This irreducible factor would have to be declared non-zero first.
    #[error("division by {0}, which is not known to be non-zero")]
    Undeclared(Polynomial),
    /// A sum of exponentials, which may vanish somewhere.
    #[error("division by a sum of exponentials")]
    SumOfExponentials,
}

impl Assumptions {
    /// Declares a symbol, with a condition on its values if there is one.
    pub fn declare_symbol(&mut self, symbol: Symbol, condition: Option<Condition>) {
        if let Some(condition) = &condition {
            if !condition.holds(&Rational::zero()) {
                self.factors.insert(Polynomial::symbol(&symbol));
            }
            if !condition.holds(&condition.bound) {
                let distance =
                    &Polynomial::symbol(&symbol) - &Polynomial::constant(&condition.bound);
                self.factors.insert(distance.primitive_part().1);
            }
        }
        self.conditions.insert(symbol, condition);
    }

    /// Declares the factors of the denominator of `unit` to be non-zero.
    pub fn declare_factors(&mut self, unit: &Fraction) {
        self.factors.extend(unit.factors().map(|(factor, _)| factor.clone()));
    }

    /// Declares positive numbers between which the value of a symbol lies.
    pub fn declare_bounds(&mut self, symbol: Symbol, lower: Rational, upper: Rational) {
        assert!(lower.is_positive() && lower <= upper, "bounds in order, and positive");
        self.bounds.insert(symbol, (lower, upper));
    }

    /// Declares the square of a symbol, free of the symbol itself.
    pub fn declare_square(&mut self, symbol: Symbol, square: Fraction) {
        self.squares.insert(symbol, square);
    }

    /// The value with known squares put in, so that no symbol with one has a power above the first
    /// in a numerator.
    pub fn reduced(&self, value: &Expression) -> Expression {
        let mut reduced = Expression::zero();
        for (exponent, coefficient) in value.terms() {
            let below = coefficient.with_numerator(Polynomial::one());
            let above = self.reduced_polynomial(coefficient.numerator());
            reduced.add_term(exponent.clone(), &above * &below);
        }
        reduced
    }

    fn reduced_polynomial(&self, p: &Polynomial) -> Fraction {
        let mut value = Fraction::from(p.clone());
        for (symbol, square) in self.squares.iter().rev() {
            if value.numerator().degree(symbol) < 2 {
                continue;
            }
            let below = value.with_numerator(Polynomial::one());
            let powers = value.numerator().coefficients(symbol).into_iter();
            let above = powers.fold(Fraction::zero(), |sum, (power, coefficient)| {
                let odd = Polynomial::symbol(symbol).pow(power % 2);
                &sum + &(&square.pow(power / 2) * &(&coefficient * &odd).into())
            });
            value = &above * &below;
        }
        value
    }

    /// The declared symbols with their conditions, ascending by name.
    pub fn symbols(&self) -> impl Iterator<Item = (&Symbol, Option<&Condition>)> + '_ {
        self.conditions.iter().map(|(symbol, condition)| (symbol, condition.as_ref()))
    }

    /// Whether a symbol of this name is declared.
    pub fn declares(&self, name: &str) -> bool {
        self.conditions.keys().any(|symbol| symbol.name() == name)
    }

    /// The factors taken to be non-zero.
    pub fn factors(&self) -> impl Iterator<Item = &Polynomial> + '_ {
        self.factors.iter()
    }

    /// The inverse of `c · e^λ`, where `c` is a product of declared factors, a number, and what is certainly
    /// positive or certainly negative.
    ///
    /// An algebraic number that is not zero can always be inverted. Where `c` holds square roots and
    /// symbols, it is its norm that must be such a product, or a power of one.
    pub fn invert(&self, value: &Expression) -> Result<Expression, NotInvertible> {
        let mut terms = value.terms();
        let (exponent, coefficient) = terms.next().ok_or(NotInvertible::Zero)?;
        if terms.next().is_some() {
            return Err(NotInvertible::SumOfExponentials);
        }
        let inverse = self.invert_polynomial(coefficient.numerator());
        let inverse = inverse.or_else(|refused| {
            let conjugated = self.invert_by_squares(coefficient.numerator());
            conjugated.ok_or(refused)
        })?;
        let inverse = &Fraction::from(coefficient.denominator()) * &inverse;
        Ok(Expression::from(inverse).times_exponential(&-exponent))
    }

    /// The inverse by known squares: that of `a + b w` is `(a − b w)/(a² − b² w²)`.
    fn invert_by_squares(&self, p: &Polynomial) -> Option<Fraction> {
        if self.squares.is_empty() {
            return None;
        }
        let reduced = self.reduced_polynomial(p);
        let mut inverse = Fraction::from(reduced.denominator());
        let mut rest = reduced.numerator().clone();
        for symbol in self.squares.keys().rev() {
            if let Ok(found) = self.invert_polynomial(&rest) {
                return Some(&inverse * &found);
            }
            let conjugate = rest.substitute(symbol, &-&Polynomial::symbol(symbol));
            if rest.degree(symbol) == 0 {
                continue;
            }
            let norm = self.reduced_polynomial(&(&rest * &conjugate));
            inverse = &(&inverse * &conjugate.into()) * &norm.denominator().into();
            rest = norm.numerator().clone();
        }
        if rest.roots().next().is_some() {
            let (multiplier, norm) = rest.norm();
            let norm = self.reduced_polynomial(&norm);
            inverse = &(&inverse * &multiplier.into()) * &norm.denominator().into();
            rest = norm.numerator().clone();
        }
        Some(&inverse * &self.invert_norm(&rest).ok()?)
    }

    fn invert_polynomial(&self, p: &Polynomial) -> Result<Fraction, NotInvertible> {
        let mut inverse = Fraction::one();
        let mut rest = p.clone();
        for factor in &self.factors {
            while let Some(quotient) = rest.divide(factor) {
                rest = quotient;
                let reciprocal = Fraction::reciprocal(factor);
                inverse = &inverse * &reciprocal.expect("declared factors are irreducible");
            }
        }
        if let Some(number) = rest.as_constant() {
            inverse = inverse.scale(&number.recip());
        } else if rest.roots().next().is_some() {
            let (multiplier, norm) = rest.norm();
            inverse = &inverse * &(&Fraction::from(multiplier) * &self.invert_norm(&norm)?);
        } else {
            let undeclared = |p: &Polynomial| NotInvertible::Undeclared(p.primitive_part().1);
            let reciprocal = Fraction::reciprocal(&rest).map_err(|_| undeclared(&rest))?;
            if !self.has_one_sign(&rest)
                && let Some((factor, _)) = reciprocal.factors().find(|(p, _)| !self.has_one_sign(p))
            {
                return Err(undeclared(factor));
            }
            inverse = &inverse * &reciprocal;
        }
        Ok(inverse)
    }

    /// The inverse of a polynomial without roots that may be a power, as norms of products with
    /// numbers are.
    fn invert_norm(&self, norm: &Polynomial) -> Result<Fraction, NotInvertible> {
        match norm.square_root() {
            Some((c, root)) if !root.is_one() => {
                Ok(self.invert_norm(&root)?.pow(2).scale(&c.recip()))
            }
            _ => self.invert_polynomial(norm),
        }
    }

    /// Whether a polynomial is certainly positive or certainly negative.
    fn has_one_sign(&self, p: &Polynomial) -> bool {
        self.is_positive_polynomial(p) || self.is_positive_polynomial(&-p)
    }

    /// Whether the value is certainly positive under the conditions: a quotient of polynomials
    /// that, written in the distances of the symbols from their bounds, have positive coefficients
    /// only, and at least one term that cannot vanish.
    pub fn is_positive(&self, value: &Fraction) -> bool {
        let positive = |p: &Polynomial| self.is_positive_polynomial(p);
        positive(value.numerator()) && value.factors().all(|(factor, _)| positive(factor))
    }

    /// Symbols without an upper bound are written as `bound ± x` with `x ≥ 0`. The coefficients of their
    /// powers hold symbols and roots that lie between positive numbers: there a term with a positive
    /// coefficient is least at the lower ones, any other at the upper ones.
    fn is_positive_polynomial(&self, p: &Polynomial) -> bool {
        let mut in_distances = p.clone();
        let mut bounds = BTreeMap::new();
        for symbol in p.symbols() {
            let condition = self.conditions.get(symbol).and_then(Option::as_ref);
            let is_pi = symbol.name() == PI;
            let of_number = || if is_pi { Some(pi_bounds()) } else { root_bounds(symbol) };
            if let Some(between) = self.bounds.get(symbol).cloned().or_else(of_number) {
                bounds.insert(symbol.clone(), between);
            } else if let Some(half_line) = condition.and_then(|known| known.half_line(symbol)) {
                in_distances = in_distances.substitute(symbol, &half_line);
            } else {
                return false;
            }
        }
        let mut least: BTreeMap<Vec<(&Symbol, u32)>, Rational> = BTreeMap::new();
        for (exponents, coefficient) in in_distances.terms() {
            let powers = in_distances.symbols().iter().zip(exponents.iter().copied());
            let powers = powers.filter(|(_, power)| *power > 0);
            let (bounded, free): (Vec<_>, Vec<_>) =
                powers.partition(|(x, _)| bounds.contains_key(x));
            let least_term = bounded.iter().fold(coefficient, |product, (symbol, power)| {
                let (lower, upper) = &bounds[symbol];
                let bound = if product.is_positive() { lower } else { upper };
                product * bound.pow(i32::try_from(*power).expect("powers are small"))
            });
            *least.entry(free).or_default() += least_term;
        }
        let strict = |x: &Symbol| {
            self.conditions.get(x).and_then(Option::as_ref).is_some_and(Condition::is_strict)
        };
        let cannot_vanish = |free: &[(&Symbol, u32)]| free.iter().all(|(symbol, _)| strict(symbol));
        least.values().all(|coefficient| !coefficient.is_negative())
            && least.iter().any(|(free, c)| c.is_positive() && cannot_vanish(free))
    }
}

/// Rational numbers 2⁻⁶¹ apart between which π lies.
fn pi_bounds() -> (Rational, Rational) {
    let at = |numerator: i64| Rational::new(numerator.into(), Integer::from(1) << 61_u32);
    (at(7_244_019_458_077_122_842), at(7_244_019_458_077_122_843))
}

/// Numbers between which a real square root lies, less than 2⁻⁶⁴ apart.
fn root_bounds(root: &Symbol) -> Option<(Rational, Rational)> {
    let square = root.square().filter(|square| *square > 0)?;
    let lower: Integer = (Integer::from(square) << 128_u32).sqrt();
    let upper = &lower + 1;
    let scale = Integer::from(1) << 64_u32;
    Some((Rational::new(lower, scale.clone()), Rational::new(upper, scale)))
}

/// A name that is not taken: this one, with as many underscores behind it as that needs.
pub fn free_name(name: impl Into<String>, is_taken: impl Fn(&str) -> bool) -> String {
    let mut name = name.into();
    while is_taken(&name) {
        name.push('_');
    }
    name
}
