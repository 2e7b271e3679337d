//! Exponential polynomials in the Laplace domain, as partial fractions.

use crate::expression::assumptions::{Assumptions, NotInvertible};
use crate::expression::calculus::rate_of;
use crate::expression::fraction::Fraction;
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
///
/// ```
/// use wavestep::expression::{Assumptions, Expression, Fraction, Transform};
/// use wavestep::language::{Source, read_expression};
/// use wavestep_polynomial::Symbol;
///
/// let read = |text| read_expression(&Source::new("text", text).unwrap()).unwrap();
/// let s = Symbol::new("s").unwrap();
/// // s e^{−s} ↔ 1/(p + 1)²: it starts at 0, and its derivative at 1.
/// let echo = Transform::of(&read("s*exp(-s)"), &s);
/// assert_eq!(echo.poles().next().unwrap().1, [Expression::zero(), Expression::one()]);
/// assert!(echo.initial_value().is_zero() && !echo.is_zero());
/// assert!(echo.derivative().initial_value().is_one());
/// // Divided by p + 1 it is 1/(p + 1)³ ↔ s²/2 e^{−s}.
/// let minus_one = -&Fraction::one();
/// let mut later = echo.divide_by_pole(&minus_one, &Assumptions::default()).unwrap();
/// assert_eq!(later.function(&s), read("s^2/2*exp(-s)"));
/// later.add_scaled(&echo, &read("2"));
/// assert_eq!(later.function(&s), read("(s^2/2 + 2*s)*exp(-s)"));
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Transform {
    poles: BTreeMap<Fraction, Vec<Expression>>,
}

impl Transform {
    /// The transform 0.
    pub(crate) fn zero() -> Transform {
        Transform::default()
    }

    /// `value / (p − pole)`.
    pub(crate) fn simple(pole: Fraction, value: Expression) -> Transform {
        Transform::normal(BTreeMap::from([(pole, vec![value])]))
    }

    fn normal(mut poles: BTreeMap<Fraction, Vec<Expression>>) -> Transform {
        for coefficients in poles.values_mut() {
            while coefficients.last().is_some_and(Expression::is_zero) {
                coefficients.pop();
            }
        }
        poles.retain(|_, coefficients| !coefficients.is_empty());
        Transform { poles }
    }

    /// The transform of a function of `x`, from its terms `x^j e^{λx} ↔ j!/(p − λ)^{j+1}`.
    ///
    /// # Panics
    /// Where an exponent is not linear in `x`, or `x` stands in a denominator.
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
        Transform::normal(poles)
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

    /// Whether this is 0.
    pub fn is_zero(&self) -> bool {
        self.poles.is_empty()
    }

    /// The poles with their coefficients `c_{λ,0}, c_{λ,1}, …`.
    pub fn poles(&self) -> impl Iterator<Item = (&Fraction, &[Expression])> + '_ {
        self.poles.iter().map(|(pole, coefficients)| (pole, &coefficients[..]))
    }

    /// Adds `factor · other`.
    pub fn add_scaled(&mut self, other: &Transform, factor: &Expression) {
        for (pole, coefficients) in &other.poles {
            let row = self.poles.entry(pole.clone()).or_default();
            if row.len() < coefficients.len() {
                row.resize(coefficients.len(), Expression::zero());
            }
            for (sum, coefficient) in row.iter_mut().zip(coefficients) {
                *sum += &(coefficient * factor);
            }
        }
        *self = Transform::normal(std::mem::take(&mut self.poles));
    }

    /// The value of the function at `x = 0+`: `lim p F(p) = Σ_λ c_{λ,0}`.
    pub fn initial_value(&self) -> Expression {
        let mut sum = Expression::zero();
        self.poles.values().for_each(|coefficients| sum += &coefficients[0]);
        sum
    }

    /// The transform of the derivative on `x > 0`: `p F(p) − f(0+)`. Since
    /// `p/(p−λ)^{j+1} = 1/(p−λ)^j + λ/(p−λ)^{j+1}`, that is `c_j ← λ c_j + c_{j+1}`.
    pub fn derivative(&self) -> Transform {
        let zero = Expression::zero();
        let rows = self.poles.iter().map(|(pole, coefficients)| {
            let next = coefficients.iter().skip(1).chain(std::iter::once(&zero));
            let derived = coefficients.iter().zip(next).map(|(c, next)| &c.times(pole) + next);
            (pole.clone(), derived.collect())
        });
        Transform::normal(rows.collect())
    }

    /// `F(p) / (p − pole)`, by
    ///
    /// ```text
    /// 1/((p−λ)^m (p−π)) = δ^{−m}/(p−π) − Σ_{i=1}^m δ^{i−m−1}/(p−λ)^i,     δ = π − λ ≠ 0.
    /// ```
    ///
    /// # Errors
    /// [`NotInvertible`] where `δ` is neither zero nor known to be non-zero.
    pub fn divide_by_pole(
        &self,
        pole: &Fraction,
        assumptions: &Assumptions,
    ) -> Result<Transform, NotInvertible> {
        let mut poles = BTreeMap::new();
        let mut residue = Expression::zero();
        for (other, coefficients) in &self.poles {
            let difference = pole - other;
            if difference.is_zero() {
                continue;
            }
            let inverse = assumptions.invert(&difference.into())?;
            let mut row = vec![Expression::zero(); coefficients.len()];
            let mut carried = Expression::zero();
            for (place, coefficient) in row.iter_mut().zip(coefficients).rev() {
                carried = &(&carried - coefficient) * &inverse;
                *place = carried.clone();
            }
            residue -= &carried;
            poles.insert(other.clone(), row);
        }
        let mut own = vec![residue];
        own.extend(self.poles.get(pole).into_iter().flatten().cloned());
        poles.insert(pole.clone(), own);
        Ok(Transform::normal(poles))
    }
}
