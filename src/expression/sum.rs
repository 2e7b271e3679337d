//! The exponential polynomial `Σ_j p_j e^{λ_j}` and its ring operations.

use crate::expression::fraction::{Fraction, NotAUnit};
use crate::expression::turn::{has_pi, without_turns};
use num_traits::{One, Zero};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt;
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};
use wavestep_polynomial::{Polynomial, Rational, Symbol, power};

/// A sum of fractions times exponentials of fractions,
///
/// ```text
/// Σ_j p_j e^{λ_j}          λ_j pairwise different
/// ```
///
/// in any symbols; time is a symbol like any other. Exponentials of different exponents are
/// linearly independent over the rational functions: finitely many polynomials that are not zero
/// do not vanish at some rational point, whatever half-lines the symbols are confined to; there the
/// `λ_j` are apart, coefficients and denominators are not zero, and the theorem of Lindemann and
/// Weierstrass says that the sum is not. So the form is canonical: two expressions are equal as
/// functions exactly when `==` says so.
///
/// # Square roots
/// Coefficients and exponents may hold square roots of −1 and of primes
/// ([`Symbol::square_root`]): poles `σ ± iω` and `a ± √d` are fractions like others. Nothing above
/// changes. A polynomial with roots is zero only where its norm, which has none, is; at a rational
/// point exponents and coefficients are algebraic numbers, and it is for these that the theorem of
/// Lindemann and Weierstrass holds.
///
/// # The number π
/// Exponents may hold π, as those of sines do. Of a multiple `iπr` in an exponent, `r` rational, twelfths are taken off, as
/// factors of square roots, so that `sin 2π` is 0, and exponents that differ by such turns are the same. That sums with π
/// that are not zero here are none as numbers is not proven; enclosures tell it.
///
/// # Invariants
/// - exponents pairwise different, no coefficient zero.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Expression {
    terms: BTreeMap<Fraction, Fraction>,
}

/// A number `Σ_j r_j e^{λ_j}`: rational exponents (pairwise different) with rational, non-zero
/// coefficients. By the theorem of Lindemann and Weierstrass it is rational exactly when no
/// exponent but 0 is left.
pub type ExponentialSum = BTreeMap<Rational, Rational>;

impl Expression {
    pub fn zero() -> Expression {
        Expression::default()
    }

    pub fn one() -> Expression {
        Fraction::one().into()
    }

    pub fn constant(value: &Rational) -> Expression {
        Fraction::constant(value).into()
    }

    pub fn integer(value: i64) -> Expression {
        Polynomial::integer(value).into()
    }

    pub fn symbol(x: &Symbol) -> Expression {
        Polynomial::symbol(x).into()
    }

    /// `e^{exponent}`.
    pub fn exponential(exponent: Fraction) -> Expression {
        Expression::one().times_exponential(&exponent)
    }

    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    pub fn is_one(&self) -> bool {
        self.as_fraction().is_some_and(|value| value.is_one())
    }

    /// The terms: exponent and coefficient, in the order of the exponents' representation.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&Fraction, &Fraction)> + '_ {
        self.terms.iter()
    }

    /// The number of terms, each coefficient's numerator counted out.
    pub fn term_count(&self) -> usize {
        self.terms.values().map(|coefficient| coefficient.numerator().term_count()).sum()
    }

    /// The value without exponentials, where there are none.
    pub fn as_fraction(&self) -> Option<Fraction> {
        match self.terms.len() {
            0 => Some(Fraction::zero()),
            1 => self.terms.get(&Fraction::zero()).cloned(),
            _ => None,
        }
    }

    /// The value, where it is a rational number.
    pub fn as_constant(&self) -> Option<Rational> {
        self.as_fraction().and_then(|value| value.as_constant())
    }

    pub fn contains(&self, x: &Symbol) -> bool {
        self.terms.iter().any(|(exponent, p)| exponent.contains(x) || p.contains(x))
    }

    /// The symbols that occur, ascending.
    pub fn symbols(&self) -> Vec<Symbol> {
        let both = self.terms.iter().flat_map(|(exponent, p)| [exponent, p]);
        let mut symbols: Vec<_> = both.flat_map(Fraction::symbols).collect();
        symbols.sort();
        symbols.dedup();
        symbols
    }

    /// Adds `coefficient · e^{exponent}`.
    pub fn add_term(&mut self, exponent: Fraction, coefficient: Fraction) {
        if coefficient.is_zero() {
            return;
        }
        if let Some((exponent, turned)) = without_turns(&exponent) {
            return self.add_term(exponent, &coefficient * &turned);
        }
        match self.terms.entry(exponent) {
            Entry::Vacant(place) => {
                place.insert(coefficient);
            }
            Entry::Occupied(mut place) => {
                *place.get_mut() += &coefficient;
                if place.get().is_zero() {
                    place.remove();
                }
            }
        }
    }

    /// Adds `factor · other`.
    pub(crate) fn add_scaled(&mut self, other: &Expression, factor: &Expression) {
        let number = factor.as_constant();
        if number.as_ref().is_some_and(One::is_one) {
            *self += other;
        } else if number.is_some_and(|number| (-number).is_one()) {
            *self -= other;
        } else {
            for (exponent, p) in &other.terms {
                for (more, scale) in &factor.terms {
                    self.add_term(exponent + more, p * scale);
                }
            }
        }
    }

    /// `1/self` of a single term; `None` for other sums.
    pub fn inverse_of_term(&self) -> Option<Result<Expression, NotAUnit>> {
        let mut terms = self.terms();
        let (Some((exponent, coefficient)), None) = (terms.next(), terms.next()) else {
            return None;
        };
        let inverse = coefficient.inverse();
        Some(inverse.map(|own| Expression::from(own).times_exponential(&-exponent)))
    }

    /// The product with `e^{exponent}`: coefficients are moved, not computed.
    pub fn times_exponential(self, exponent: &Fraction) -> Expression {
        if exponent.is_zero() {
            return self;
        }
        let moved = self.terms.into_iter().map(|(own, p)| (&own + exponent, p));
        if !has_pi(exponent) {
            return Expression { terms: moved.collect() };
        }
        let mut sum = Expression::zero();
        moved.for_each(|(own, p)| sum.add_term(own, p));
        sum
    }

    pub fn times(&self, factor: &Fraction) -> Expression {
        if factor.is_zero() {
            return Expression::zero();
        }
        if factor.is_one() {
            return self.clone();
        }
        self.map(|p| p * factor)
    }

    pub fn scale(&self, factor: &Rational) -> Expression {
        if factor.is_zero() { Expression::zero() } else { self.map(|p| p.scale(factor)) }
    }

    /// Applies `change`, which must not turn a coefficient into zero.
    fn map(&self, change: impl Fn(&Fraction) -> Fraction) -> Expression {
        let terms = self.terms.iter().map(|(exponent, p)| (exponent.clone(), change(p)));
        Expression { terms: terms.collect() }
    }

    /// The number `q` with `self = q · other`, where there is one; `None` for zero.
    pub fn proportion(&self, other: &Expression) -> Option<Rational> {
        let leading = |value: &Expression| {
            value.terms().next().map(|(_, p)| p.numerator().leading_coefficient())
        };
        let ratio = leading(self)? / leading(other)?;
        (*self == other.scale(&ratio)).then_some(ratio)
    }

    /// `self^exponent`, by repeated squaring.
    pub fn pow(&self, exponent: u32) -> Expression {
        power(Expression::one(), self, exponent.into(), |a, b| a * b)
    }

    /// The value with `value` in place of `x`, in coefficients and exponents.
    pub fn substitute(&self, x: &Symbol, value: &Fraction) -> Result<Expression, NotAUnit> {
        let mut result = Expression::zero();
        for (exponent, p) in &self.terms {
            result.add_term(exponent.substitute(x, value)?, p.substitute(x, value)?);
        }
        Ok(result)
    }

    /// The value with `x + step` in place of `x`.
    pub fn shift(&self, x: &Symbol, step: &Fraction) -> Result<Expression, NotAUnit> {
        if step.is_zero() {
            return Ok(self.clone());
        }
        let moved = &Fraction::symbol(x) + step;
        let mut result = Expression::zero();
        for (exponent, p) in &self.terms {
            result.add_term(exponent.substitute(x, &moved)?, p.shift(x, step, &moved)?);
        }
        Ok(result)
    }

    /// The exact number `Σ r_j e^{λ_j}` where every symbol has a rational value.
    pub fn evaluate(
        &self,
        values: &impl Fn(&Symbol) -> Option<Rational>,
    ) -> Result<ExponentialSum, Symbol> {
        let mut sum = ExponentialSum::new();
        for (exponent, p) in &self.terms {
            *sum.entry(exponent.evaluate(values)?).or_default() += p.evaluate(values)?;
        }
        sum.retain(|_, coefficient| !coefficient.is_zero());
        Ok(sum)
    }
}

impl From<Fraction> for Expression {
    fn from(value: Fraction) -> Expression {
        let mut sum = Expression::zero();
        sum.add_term(Fraction::zero(), value);
        sum
    }
}

impl From<&Fraction> for Expression {
    fn from(value: &Fraction) -> Expression {
        value.clone().into()
    }
}

impl From<Polynomial> for Expression {
    fn from(value: Polynomial) -> Expression {
        Fraction::from(value).into()
    }
}

impl Expression {
    /// Adds each term of `other` to the term of the same exponent; `alone` is what it is without one.
    fn merge(
        &mut self,
        other: &Expression,
        alone: impl Fn(&Fraction) -> Fraction,
        add: impl Fn(&mut Fraction, &Fraction),
    ) {
        for (exponent, p) in &other.terms {
            match self.terms.get_mut(exponent) {
                None => drop(self.terms.insert(exponent.clone(), alone(p))),
                Some(own) => {
                    add(own, p);
                    if own.is_zero() {
                        self.terms.remove(exponent);
                    }
                }
            }
        }
    }
}

macro_rules! operators {
    ($operator:ident $name:ident, $in_place:ident $name_in_place:ident, $alone:expr) => {
        impl $in_place<&Expression> for Expression {
            fn $name_in_place(&mut self, other: &Expression) {
                self.merge(other, $alone, |own, p| own.$name_in_place(p));
            }
        }

        impl $operator for &Expression {
            type Output = Expression;
            fn $name(self, other: &Expression) -> Expression {
                let mut result = self.clone();
                result.$name_in_place(other);
                result
            }
        }
    };
}
operators!(Add add, AddAssign add_assign, Fraction::clone);
operators!(Sub sub, SubAssign sub_assign, |p| -p);

impl Mul for &Expression {
    type Output = Expression;
    fn mul(self, other: &Expression) -> Expression {
        let mut product = Expression::zero();
        for (left_exponent, left) in &self.terms {
            for (right_exponent, right) in &other.terms {
                product.add_term(left_exponent + right_exponent, left * right);
            }
        }
        product
    }
}

impl Neg for &Expression {
    type Output = Expression;
    fn neg(self) -> Expression {
        self.map(|p| -p)
    }
}

impl fmt::Debug for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.terms.is_empty() {
            return f.write_str("0");
        }
        let terms = self.terms.iter().map(|(exponent, p)| format!("({p})*exp({exponent})"));
        f.write_str(&terms.collect::<Vec<_>>().join(" + "))
    }
}
