//! Exponential polynomials in the Laplace domain, as partial fractions.

use crate::expression::assumptions::{Assumptions, NotInvertible};
use crate::expression::calculus::rate_of;
use crate::expression::fraction::{Fraction, NotAUnit};
use crate::expression::sum::Expression;
use std::collections::BTreeMap;
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol, factorial};

/// A proper rational function of `p` in partial fractions,
///
/// ```text
/// Σ_λ Σ_j c_{λ,j} / (p − λ)^{j+1}      ↔      Σ_λ e^{λx} Σ_j c_{λ,j} x^j/j!
/// ```
///
/// with poles `λ` and coefficients `c` free of time.
///
/// # Invariants
/// - the last coefficient of every pole is not zero; poles without coefficients are absent.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Transform<V = Expression> {
    poles: BTreeMap<Fraction, Vec<V>>,
}

/// The field of the coefficients of a [`Transform`]: exact expressions, or enclosures of a
/// given precision. Poles are exact in either case, so that equal ones are recognised.
pub trait Field {
    type Value: Clone;
    type Error: From<NotAUnit>;

    fn zero(&self) -> Self::Value;
    /// Whether a coefficient is certainly 0.
    fn is_zero(&self, value: &Self::Value) -> bool;
    /// The coefficient that an exact value is.
    fn embed(&self, value: &Expression) -> Result<Self::Value, Self::Error>;
    /// The inverse of an exact value that is not 0.
    fn inverse(&self, value: &Fraction) -> Result<Self::Value, Self::Error>;
    fn add(&self, sum: &mut Self::Value, other: &Self::Value);
    fn product(&self, left: &Self::Value, right: &Self::Value) -> Self::Value;
    /// Adds `left · right`.
    fn add_product(&self, sum: &mut Self::Value, left: &Self::Value, right: &Self::Value) {
        self.add(sum, &self.product(left, right));
    }
}

/// Exact coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Exact<'a> {
    assumptions: &'a Assumptions,
}

impl<'a> Exact<'a> {
    /// Divides by what these assumptions allow to divide by.
    pub fn new(assumptions: &'a Assumptions) -> Exact<'a> {
        Exact { assumptions }
    }
}

impl Field for Exact<'_> {
    type Value = Expression;
    type Error = InexactDivision;

    fn zero(&self) -> Expression {
        Expression::zero()
    }

    fn is_zero(&self, value: &Expression) -> bool {
        value.is_zero()
    }

    fn embed(&self, value: &Expression) -> Result<Expression, InexactDivision> {
        Ok(value.clone())
    }

    fn inverse(&self, value: &Fraction) -> Result<Expression, InexactDivision> {
        Ok(self.assumptions.invert(&value.clone().into())?)
    }

    fn add(&self, sum: &mut Expression, other: &Expression) {
        *sum += other;
    }

    fn product(&self, left: &Expression, right: &Expression) -> Expression {
        left * right
    }

    fn add_product(&self, sum: &mut Expression, left: &Expression, right: &Expression) {
        sum.add_scaled(left, right);
    }
}

/// A division that cannot be done exactly.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum InexactDivision {
    /// The divisor is not known to be non-zero.
    #[error(transparent)]
    NotInvertible(#[from] NotInvertible),
    /// By what a fraction cannot have in its denominator.
    #[error(transparent)]
    NotAUnit(#[from] NotAUnit),
}

impl<V: Clone> Transform<V> {
    pub(crate) fn zero() -> Transform<V> {
        Transform { poles: BTreeMap::new() }
    }

    /// `value / (p − pole)`.
    pub(crate) fn simple<F: Field<Value = V>>(field: &F, pole: Fraction, value: V) -> Transform<V> {
        Transform::normal(field, BTreeMap::from([(pole, vec![value])]))
    }

    pub(crate) fn normal<F: Field<Value = V>>(
        field: &F,
        mut poles: BTreeMap<Fraction, Vec<V>>,
    ) -> Transform<V> {
        for coefficients in poles.values_mut() {
            while coefficients.last().is_some_and(|last| field.is_zero(last)) {
                coefficients.pop();
            }
        }
        poles.retain(|_, coefficients| !coefficients.is_empty());
        Transform { poles }
    }

    pub fn is_zero(&self) -> bool {
        self.poles.is_empty()
    }

    /// The poles with their coefficients `c_{λ,0}, c_{λ,1}, …`.
    pub fn poles(&self) -> impl Iterator<Item = (&Fraction, &[V])> + '_ {
        self.poles.iter().map(|(pole, coefficients)| (pole, &coefficients[..]))
    }

    /// Adds `factor · other`.
    pub fn add_product<F: Field<Value = V>>(
        &mut self,
        field: &F,
        other: &Transform<V>,
        factor: &V,
    ) {
        self.merge(field, other, |sum, coefficient| field.add_product(sum, coefficient, factor));
    }

    pub(crate) fn add<F: Field<Value = V>>(&mut self, field: &F, other: &Transform<V>) {
        self.merge(field, other, |sum, coefficient| field.add(sum, coefficient));
    }

    /// Adds something of each coefficient of `other` to that of the same pole and power.
    fn merge<F: Field<Value = V>>(
        &mut self,
        field: &F,
        other: &Transform<V>,
        add: impl Fn(&mut V, &V),
    ) {
        for (pole, coefficients) in &other.poles {
            let row = self.poles.entry(pole.clone()).or_default();
            if row.len() < coefficients.len() {
                row.resize(coefficients.len(), field.zero());
            }
            for (sum, coefficient) in row.iter_mut().zip(coefficients) {
                add(sum, coefficient);
            }
        }
        *self = Transform::normal(field, std::mem::take(&mut self.poles));
    }

    /// The value of the function at `x = 0+`: `lim p F(p) = Σ_λ c_{λ,0}`.
    pub fn initial<F: Field<Value = V>>(&self, field: &F) -> V {
        let mut sum = field.zero();
        self.poles.values().for_each(|coefficients| field.add(&mut sum, &coefficients[0]));
        sum
    }

    /// The transform of the derivative on `x > 0`: `p F(p) − f(0+)`. Since
    /// `p/(p−λ)^{j+1} = 1/(p−λ)^j + λ/(p−λ)^{j+1}`, that is `c_j ← λ c_j + c_{j+1}`.
    pub fn differentiated<F: Field<Value = V>>(&self, field: &F) -> Result<Transform<V>, F::Error> {
        let mut poles = BTreeMap::new();
        for (pole, coefficients) in &self.poles {
            let factor = field.embed(&pole.clone().into())?;
            let mut row = Vec::with_capacity(coefficients.len());
            for (j, coefficient) in coefficients.iter().enumerate() {
                let mut value = field.product(coefficient, &factor);
                if let Some(next) = coefficients.get(j + 1) {
                    field.add(&mut value, next);
                }
                row.push(value);
            }
            poles.insert(pole.clone(), row);
        }
        Ok(Transform::normal(field, poles))
    }

    /// `F(p) / (p − pole)`, by
    ///
    /// ```text
    /// 1/((p−λ)^m (p−π)) = δ^{−m}/(p−π) − Σ_{i=1}^m δ^{i−m−1}/(p−λ)^i,     δ = π − λ ≠ 0.
    /// ```
    pub fn over_pole<F: Field<Value = V>>(
        &self,
        field: &F,
        pole: &Fraction,
    ) -> Result<Transform<V>, F::Error> {
        let mut poles = BTreeMap::new();
        let mut residue = field.zero();
        for (other, coefficients) in &self.poles {
            // −δ, so that nothing needs to be subtracted.
            let difference = other - pole;
            if difference.is_zero() {
                continue;
            }
            let inverse = field.inverse(&difference)?;
            let mut row = vec![field.zero(); coefficients.len()];
            let mut carried = field.zero();
            let minus = field.embed(&Expression::integer(-1))?;
            for (place, coefficient) in row.iter_mut().zip(coefficients).rev() {
                // c ← (c − coefficient)/δ = (coefficient − c)/(−δ)
                let mut rest = coefficient.clone();
                field.add_product(&mut rest, &carried, &minus);
                carried = field.product(&rest, &inverse);
                *place = carried.clone();
            }
            field.add_product(&mut residue, &carried, &minus);
            poles.insert(other.clone(), row);
        }
        let mut own = vec![residue];
        own.extend(self.poles.get(pole).into_iter().flatten().cloned());
        poles.insert(pole.clone(), own);
        Ok(Transform::normal(field, poles))
    }

    /// The same transform with other coefficients.
    pub fn embedded<F: Field>(
        exact: &Transform,
        field: &F,
    ) -> Result<Transform<F::Value>, F::Error> {
        let mut poles = BTreeMap::new();
        for (pole, coefficients) in exact.poles() {
            let row: Result<Vec<_>, _> = coefficients.iter().map(|c| field.embed(c)).collect();
            poles.insert(pole.clone(), row?);
        }
        Ok(Transform { poles })
    }
}

impl Transform {
    /// How many terms the numerators of its coefficients have.
    pub fn term_count(&self) -> usize {
        let values = self.poles().flat_map(|(_, row)| row);
        values.flat_map(Expression::terms).map(|(_, value)| value.numerator().term_count()).sum()
    }

    /// The transform of a function of `x`, from its terms `x^j e^{λx} ↔ j!/(p − λ)^{j+1}`.
    pub fn of(function: &Expression, x: &Symbol) -> Transform {
        let mut poles = BTreeMap::<Fraction, Vec<Expression>>::new();
        for (exponent, coefficient) in function.terms() {
            let pole = rate_of(exponent, x);
            let base = exponent - &(&pole * &Fraction::symbol(x));
            let row = poles.entry(pole).or_default();
            let over = Fraction::from(coefficient.denominator());
            assert!(!over.contains(x), "the variable in a denominator");
            for (power, part) in coefficient.numerator().divided_coefficients(x) {
                let j = power as usize;
                if row.len() <= j {
                    row.resize(j + 1, Expression::zero());
                }
                row[j].add_term(base.clone(), coefficient.with_numerator(part));
            }
        }
        Transform::normal(&Exact::new(&Assumptions::default()), poles)
    }

    /// The function of `x` with this transform.
    pub fn function(&self, x: &Symbol) -> Expression {
        let mut function = Expression::zero();
        for (pole, coefficients) in &self.poles {
            let mut polynomial = Expression::zero();
            for (j, coefficient) in coefficients.iter().enumerate() {
                let power = u32::try_from(j).expect("orders of poles fit 32 bits");
                let scale = Rational::new(Integer::from(1), factorial(power));
                let monomial = Polynomial::monomial(&scale, &[(x, power)]);
                polynomial += &coefficient.times(&monomial.into());
            }
            function += &polynomial.times_exponential(&(pole * &Fraction::symbol(x)));
        }
        function
    }
}
