//! Derivative, antiderivative, and the first-order equation `y' + a y = q`.

use crate::expression::assumptions::{Assumptions, NotInvertible};
use crate::expression::fraction::Fraction;
use crate::expression::sum::Expression;
use wavestep_polynomial::Symbol;

impl Expression {
    /// The partial derivative with respect to `x`: `Σ (p_j' + λ_j' p_j) e^{λ_j}`. One pass.
    pub fn derivative(&self, x: &Symbol) -> Expression {
        let mut result = Expression::zero();
        for (exponent, p) in self.terms() {
            let rate = exponent.derivative(x);
            result.add_term(exponent.clone(), &p.derivative(x) + &(&rate * p));
        }
        result
    }

    /// The antiderivative `∫_0^x`, which is zero at `x = 0`, term by term:
    ///
    /// ```text
    /// ∫ p e^{κx} dx = p antiderived                         for κ = 0
    ///               = e^{κx} Σ_j (−1)^j p^{(j)} / κ^{j+1}   else
    /// ```
    pub fn antiderivative(
        &self,
        x: &Symbol,
        assumptions: &Assumptions,
    ) -> Result<Expression, NotInvertible> {
        let mut result = Expression::zero();
        for (exponent, p) in self.terms() {
            let rate = rate_of(exponent, x);
            if rate.is_zero() {
                let raised = p.with_numerator(p.numerator().antiderivative(x));
                result.add_term(exponent.clone(), raised);
                continue;
            }
            let inverse = assumptions.invert(&rate.into())?;
            let inverse = inverse.as_fraction().expect("the inverse of a fraction");
            let mut step = p * &inverse;
            let mut sum = Fraction::zero();
            while !step.is_zero() {
                sum = &sum + &step;
                step = &-&step.derivative(x) * &inverse;
            }
            let at_zero = sum.substitute(x, &Fraction::zero()).expect("no denominator holds x");
            let base = exponent.substitute(x, &Fraction::zero()).expect("exponents are linear");
            result.add_term(exponent.clone(), sum);
            result.add_term(base, -&at_zero);
        }
        Ok(result)
    }

    /// The solution of `y' + a y = self`, `y(0) = start`, by the integrating factor `e^{ax}`:
    ///
    /// ```text
    /// y = e^{−ax} [ start + ∫_0^x e^{au} q(u) du ]
    /// ```
    ///
    /// Resonance (an exponent `−a` in `q`) is no special case: there the integrand is a polynomial.
    pub fn solve_first_order(
        self,
        x: &Symbol,
        a: &Fraction,
        start: &Expression,
        assumptions: &Assumptions,
    ) -> Result<Expression, NotInvertible> {
        let factor = a * &Fraction::symbol(x);
        let mut bracket = self.times_exponential(&factor).antiderivative(x, assumptions)?;
        bracket += start;
        Ok(bracket.times_exponential(&-&factor))
    }

    /// The value at `x = 0`.
    pub fn at_zero(&self, x: &Symbol) -> Expression {
        self.substitute(x, &Fraction::zero()).expect("no denominator holds the variable")
    }
}

/// The coefficient of `x` in an exponent.
pub(crate) fn rate_of(exponent: &Fraction, x: &Symbol) -> Fraction {
    let rate = exponent.derivative(x);
    assert!(!rate.contains(x), "an exponent that is not linear in {x}");
    rate
}
