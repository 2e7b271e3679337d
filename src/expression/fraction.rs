//! Polynomials localised at irreducible factors.

use num_traits::{Signed, Zero};
use std::collections::BTreeMap;
use std::fmt;
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol};

/// A polynomial over a product of irreducible factors,
///
/// ```text
/// p / Π_i d_i^{k_i}
/// ```
///
/// Each `d_i` is *primitive* (coprime integer coefficients, the leading one positive) and irreducible.
/// Exact division then cancels all that can be cancelled, and no general gcd is needed.
///
/// Square roots stand in numerators only: a fraction with roots is a combination of their products,
/// with fractions without roots as coefficients, over the least common denominator of these.
///
/// # Invariants
/// - `k_i > 0`, and no `d_i` divides `p`;
/// - no `d_i` holds a square root;
/// - zero has no factors.
///
/// Equal values have one representation. The order (`Ord`) is total and without algebraic meaning.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fraction {
    numerator: Polynomial,
    factors: BTreeMap<Polynomial, u32>,
}

/// A polynomial that cannot be divided by: zero, or one whose factors are not found.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{}", self.message())]
pub struct NotAUnit(pub Polynomial);

impl NotAUnit {
    fn message(&self) -> String {
        match self.0.is_zero() {
            true => "division by zero".to_owned(),
            false => format!("cannot divide by {}: its factors are not found", self.0),
        }
    }
}

impl Fraction {
    pub fn zero() -> Fraction {
        Polynomial::zero().into()
    }

    pub fn one() -> Fraction {
        Polynomial::one().into()
    }

    pub fn constant(value: &Rational) -> Fraction {
        Polynomial::constant(value).into()
    }

    pub fn symbol(x: &Symbol) -> Fraction {
        Polynomial::symbol(x).into()
    }

    /// `1/p`, where `p` is zero neither nor so long that its irreducible factors are not found.
    ///
    /// Where `p` holds square roots, the denominator is rationalised, `1/p = m/(p m)` with
    /// [`Polynomial::norm`], and it is `p m` that must be such a product, or a power of one whose
    /// exponent is a power of 2. Every algebraic number but 0 has a reciprocal.
    pub fn reciprocal(p: &Polynomial) -> Result<Fraction, NotAUnit> {
        if p.is_zero() {
            return Err(NotAUnit(p.clone()));
        }
        if p.roots().next().is_some() {
            let (multiplier, norm) = p.norm();
            let inverse = reciprocal_of_power(&norm).ok_or_else(|| NotAUnit(p.clone()))?;
            return Ok(&Fraction::from(multiplier) * &inverse);
        }
        let (content, mut rest) = p.primitive_part();
        let mut factors = BTreeMap::new();
        for x in p.symbols() {
            let lowest = rest.coefficients(x).last().map_or(0, |(power, _)| *power);
            if lowest > 0 {
                let symbol = Polynomial::symbol(x);
                rest = rest.divide(&symbol.pow(lowest)).expect("x divides every term");
                factors.insert(symbol, lowest);
            }
        }
        if is_irreducible(&rest) {
            factors.insert(rest, 1);
        } else {
            factors.extend(rest.factors().ok_or_else(|| NotAUnit(p.clone()))?);
        }
        Ok(Fraction { numerator: Polynomial::constant(&content.recip()), factors })
    }

    /// `1/self`, where its numerator has a [`reciprocal`](Fraction::reciprocal).
    pub fn inverse(&self) -> Result<Fraction, NotAUnit> {
        Ok(&Fraction::reciprocal(&self.numerator)? * &Fraction::from(self.denominator()))
    }

    pub fn numerator(&self) -> &Polynomial {
        &self.numerator
    }

    /// The factors of the denominator with their powers.
    pub fn factors(&self) -> impl Iterator<Item = (&Polynomial, u32)> + '_ {
        self.factors.iter().map(|(factor, power)| (factor, *power))
    }

    pub fn denominator(&self) -> Polynomial {
        self.factors.iter().fold(Polynomial::one(), |d, (factor, power)| &d * &factor.pow(*power))
    }

    pub fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }

    pub fn is_one(&self) -> bool {
        self.factors.is_empty() && self.numerator.is_one()
    }

    /// The polynomial, where there is no denominator.
    pub(crate) fn as_polynomial(&self) -> Option<&Polynomial> {
        self.factors.is_empty().then_some(&self.numerator)
    }

    /// The value, where no symbol occurs.
    pub fn as_constant(&self) -> Option<Rational> {
        self.as_polynomial().and_then(Polynomial::as_constant)
    }

    pub fn contains(&self, x: &Symbol) -> bool {
        let occurs = |p: &Polynomial| p.symbols().binary_search(x).is_ok();
        occurs(&self.numerator) || self.factors.keys().any(occurs)
    }

    /// The symbols that occur, ascending.
    pub(crate) fn symbols(&self) -> Vec<Symbol> {
        let all = std::iter::once(&self.numerator).chain(self.factors.keys());
        let mut symbols: Vec<_> = all.flat_map(|p| p.symbols().iter().cloned()).collect();
        symbols.sort();
        symbols.dedup();
        symbols
    }

    /// `numerator` over the denominator of this fraction.
    pub fn with_numerator(&self, numerator: Polynomial) -> Fraction {
        Fraction::normal(numerator, self.factors.clone())
    }

    /// Normal form of `numerator / Π factors`: cancels every factor that divides the numerator.
    fn normal(numerator: Polynomial, factors: BTreeMap<Polynomial, u32>) -> Fraction {
        if factors.is_empty() || numerator.is_zero() {
            return numerator.into();
        }
        let mut fraction = Fraction { numerator, factors: BTreeMap::new() };
        for (factor, mut power) in factors {
            while power > 0 {
                let Some(quotient) = fraction.numerator.divide(&factor) else { break };
                fraction.numerator = quotient;
                power -= 1;
            }
            if power > 0 {
                fraction.factors.insert(factor, power);
            }
        }
        fraction
    }

    /// The product with a rational number. O(terms).
    pub fn scale(&self, by: &Rational) -> Fraction {
        if by.is_zero() {
            return Fraction::zero();
        }
        Fraction { numerator: &self.numerator * by, factors: self.factors.clone() }
    }

    pub fn pow(&self, exponent: u32) -> Fraction {
        if exponent == 0 {
            return Fraction::one();
        }
        let factors = self.factors.iter().map(|(factor, power)| (factor.clone(), power * exponent));
        Fraction { numerator: self.numerator.pow(exponent), factors: factors.collect() }
    }

    pub fn derivative(&self, x: &Symbol) -> Fraction {
        let mut sum = self.with_numerator(self.numerator.derivative(x));
        for (factor, power) in &self.factors {
            let inner = factor.derivative(x);
            if !inner.is_zero() {
                let mut factors = self.factors.clone();
                *factors.get_mut(factor).expect("a factor of this fraction") += 1;
                let power = Rational::from_integer((*power).into());
                let numerator = &(&self.numerator * &inner) * &power;
                sum = &sum - &Fraction::normal(numerator, factors);
            }
        }
        sum
    }

    pub fn substitute(&self, x: &Symbol, value: &Fraction) -> Result<Fraction, NotAUnit> {
        let mut result = substitute_in(&self.numerator, x, value);
        for (factor, power) in &self.factors {
            let below = match factor.symbols().contains(x) {
                true => substitute_in(factor, x, value).inverse()?.pow(*power),
                false => Fraction {
                    numerator: Polynomial::one(),
                    factors: BTreeMap::from([(factor.clone(), *power)]),
                },
            };
            result = &result * &below;
        }
        Ok(result)
    }

    /// The value with `moved = x + step` in place of `x`.
    pub(crate) fn shift(
        &self,
        x: &Symbol,
        step: &Fraction,
        moved: &Fraction,
    ) -> Result<Fraction, NotAUnit> {
        match step.as_polynomial() {
            Some(step) if self.factors.is_empty() => Ok(self.numerator.shift(x, step).into()),
            _ => self.substitute(x, moved),
        }
    }

    /// The value where every symbol has one.
    pub fn evaluate(
        &self,
        values: &impl Fn(&Symbol) -> Option<Rational>,
    ) -> Result<Rational, Symbol> {
        let mut value = self.numerator.evaluate(values)?;
        for (factor, power) in &self.factors {
            let power = i32::try_from(*power).expect("powers of factors are small");
            value /= factor.evaluate(values)?.pow(power);
        }
        Ok(value)
    }
}

/// `1/p` for a polynomial without roots that is a unit, or a rational times a square of such a power.
fn reciprocal_of_power(p: &Polynomial) -> Option<Fraction> {
    Fraction::reciprocal(p).ok().or_else(|| {
        let (c, root) = p.square_root()?;
        Some(reciprocal_of_power(&root)?.pow(2).scale(&c.recip()))
    })
}

/// Whether a primitive polynomial is soon known to be irreducible: where it is linear in some symbol, with
/// a single term as that symbol's coefficient, no symbol of which divides the rest, and where it is a
/// quadratic whose discriminant is no square.
fn is_irreducible(p: &Polynomial) -> bool {
    is_irreducible_quadratic(p)
        || p.symbols().iter().any(|x| match &p.coefficients(x)[..] {
            [(1, slope), (0, rest)] => {
                slope.term_count() == 1 && !slope.symbols().iter().any(|y| divides(y, rest))
            }
            [(1, slope)] => slope.as_constant().is_some(),
            _ => false,
        })
}

/// Whether a symbol is in every term of a polynomial.
fn divides(y: &Symbol, p: &Polynomial) -> bool {
    p.coefficients(y).last().is_none_or(|(power, _)| *power > 0)
}

/// Whether a primitive polynomial is a quadratic in some symbol, led by a single term with which the others have no symbol in
/// common, whose discriminant is no square: its factors would be linear in the symbol, and their zeros hold the root.
fn is_irreducible_quadratic(p: &Polynomial) -> bool {
    p.symbols().iter().any(|x| {
        let powers = p.coefficients(x);
        let coefficient = |power: u32| {
            let found = powers.iter().find(|(own, _)| *own == power);
            found.map_or_else(Polynomial::zero, |(_, coefficient)| coefficient.clone())
        };
        let in_others = |y: &Symbol| powers[1..].iter().all(|(_, own)| divides(y, own));
        let lead = coefficient(2);
        let leads =
            p.degree(x) == 2 && lead.term_count() == 1 && !lead.symbols().iter().any(in_others);
        leads && {
            let four = Rational::from_integer(4.into());
            let product = &(&lead * &coefficient(0)) * &four;
            let discriminant = &(&coefficient(1) * &coefficient(1)) - &product;
            match discriminant.square_root() {
                None => !discriminant.is_zero(),
                Some((c, _)) => {
                    let is_square = |n: &Integer| n.sqrt().pow(2) == *n;
                    c.is_negative() || !is_square(c.numer()) || !is_square(c.denom())
                }
            }
        }
    })
}

fn substitute_in(p: &Polynomial, x: &Symbol, value: &Fraction) -> Fraction {
    if let Some(value) = value.as_polynomial() {
        return p.substitute(x, value).into();
    }
    let powers = p.coefficients(x).into_iter();
    powers.fold(Fraction::zero(), |sum, (power, coefficient)| {
        &sum + &(&value.pow(power) * &coefficient.into())
    })
}

impl From<Polynomial> for Fraction {
    fn from(numerator: Polynomial) -> Fraction {
        Fraction { numerator, factors: BTreeMap::new() }
    }
}

/// The sum or difference over the least common denominator.
fn combine(
    left: &Fraction,
    right: &Fraction,
    add: impl Fn(&Polynomial, &Polynomial) -> Polynomial,
) -> Fraction {
    if left.factors.is_empty() && right.factors.is_empty() {
        return add(&left.numerator, &right.numerator).into();
    }
    let mut common = left.factors.clone();
    for (factor, power) in &right.factors {
        let entry = common.entry(factor.clone()).or_insert(0);
        *entry = (*entry).max(*power);
    }
    let over_common = |fraction: &Fraction| {
        common.iter().fold(fraction.numerator.clone(), |numerator, (factor, power)| {
            let missing = power - fraction.factors.get(factor).unwrap_or(&0);
            if missing == 0 { numerator } else { &numerator * &factor.pow(missing) }
        })
    };
    Fraction::normal(add(&over_common(left), &over_common(right)), common)
}

macro_rules! operators {
    ($operator:ident $name:ident, $in_place:ident $name_in_place:ident) => {
        impl $operator for &Fraction {
            type Output = Fraction;
            fn $name(self, other: &Fraction) -> Fraction {
                combine(self, other, |left, right| left.$name(right))
            }
        }

        impl $in_place<&Fraction> for Fraction {
            /// Where neither has a denominator, into the terms of `self`.
            fn $name_in_place(&mut self, other: &Fraction) {
                if self.factors.is_empty() && other.factors.is_empty() {
                    self.numerator.$name_in_place(&other.numerator);
                } else {
                    *self = (&*self).$name(other);
                }
            }
        }
    };
}
operators!(Add add, AddAssign add_assign);
operators!(Sub sub, SubAssign sub_assign);

impl Mul for &Fraction {
    type Output = Fraction;
    fn mul(self, other: &Fraction) -> Fraction {
        if self.is_one() {
            return other.clone();
        }
        if other.is_one() {
            return self.clone();
        }
        let mut factors = self.factors.clone();
        for (factor, power) in &other.factors {
            *factors.entry(factor.clone()).or_insert(0) += power;
        }
        Fraction::normal(&self.numerator * &other.numerator, factors)
    }
}

impl Neg for &Fraction {
    type Output = Fraction;
    fn neg(self) -> Fraction {
        Fraction { numerator: -&self.numerator, factors: self.factors.clone() }
    }
}

impl fmt::Display for Fraction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.factors.is_empty() {
            return write!(f, "{}", self.numerator);
        }
        write!(f, "({})", self.numerator)?;
        for (factor, power) in &self.factors {
            write!(f, "/({factor})")?;
            if *power > 1 {
                write!(f, "^{power}")?;
            }
        }
        Ok(())
    }
}

impl fmt::Debug for Fraction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
