//! Echoes in closed form: the operator `((p−a)/(p+b))^k` and its Laguerre polynomials.
//!
//! A wave whose equation has one pole and one lag has the transform
//! `W = S(p,q) / [(p+b) − ρ q (p−a)]`, and
//!
//! ```text
//! (p−a)^k / (p+b)^{k+1}   ↔   e^{−bx} L_k((a+b)x) = e^{−bx} Σ_j C(k,j) (−(a+b))^j x^j/j!
//!       1 / (p+b)^{k+1}   ↔   e^{−bx} x^k/k!
//! ```
//!
//! In divided powers `x^j/j!` the coefficients are integers over one denominator:
//! `docs/divided-powers.md` proves it, and what follows for pieces.

use crate::expression::{Assumptions, Expression, Fraction, Transform};
use crate::recurrence::{LinearForm, Step, WaveIndex};
use crate::solution::geometric::{product, sum};
use num_traits::{One, Zero};
use std::collections::BTreeMap;
use wavestep_polynomial::{
    Integer, IntegerRow, Polynomial, Rational, Symbol, Univariate, binomial, factorial,
};

/// The family of functions `T_k` that the echoes are made of.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Family {
    /// `T_k(x) = L_k(c x)`, Laguerre polynomials, with `c = a + b`.
    Laguerre(Fraction),
    /// `T_k(x) = x^k/k!`.
    Power,
}

/// Echoes in general k,
///
/// ```text
/// φ_k(x) = first[k](x)                              for k < first.len()
///        = ρ^k e^{−bx} Σ_i c_i T_{k−i}(x)           for k ≥ first.len()
/// ```
///
/// with `i` at most `first.len()` for every term.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EchoTemplate {
    /// The functions `T_k`.
    pub family: Family,
    /// `b`.
    pub rate: Fraction,
    /// `ρ`.
    pub ratio: Fraction,
    /// Lag `i` (−1 where `T_{k+1}` occurs) and coefficient `c_i`, not zero, by ascending lag.
    pub terms: Vec<(isize, Fraction)>,
    /// The echoes before the sum holds, in the local variable.
    pub first: Vec<Expression>,
}

/// The Laplace transform of a sum of powers times exponentials: `c x^j/j! e^{λx} ↔ c/(p − λ)^{j+1}`.
pub fn laplace(function: &Expression, x: &Symbol, p: &Symbol) -> Option<Fraction> {
    let mut sum = Fraction::zero();
    for (pole, coefficients) in Transform::of(function, x).poles() {
        let share = (&Fraction::symbol(p) - pole).inverse().ok()?;
        let mut power = share.clone();
        for coefficient in coefficients {
            sum = &sum + &(&coefficient.as_fraction()? * &power);
            power = &power * &share;
        }
    }
    Some(sum)
}

impl EchoTemplate {
    /// `v` and `u` of the step from `k = first.len()` on, with the rate `b`,
    ///
    /// ```text
    /// φ_{k+1}' + b φ_{k+1} = v φ_k' + u φ_k,        φ_{k+1}(0) = v φ_k(0)
    /// ```
    ///
    /// On the coefficients of Laguerre polynomials, after division by `ρ^{k+1} e^{−bx}`, it is Pascal's rule.
    #[must_use]
    pub fn step(&self) -> (Fraction, Fraction) {
        match &self.family {
            Family::Laguerre(c) => (self.ratio.clone(), &self.ratio * &(&self.rate - c)),
            Family::Power => (Fraction::zero(), self.ratio.clone()),
        }
    }

    /// What the transform of an echo is multiplied by to give that of the next one, from `k = first.len()` on:
    /// `(v p + u)/(p + b)`.
    pub fn transform_ratio(&self, p: &Symbol) -> Fraction {
        let (slope, value) = self.step();
        let p = Fraction::symbol(p);
        let below = (&p + &self.rate).inverse().expect("a polynomial of degree one in p");
        &(&(&slope * &p) + &value) * &below
    }

    /// The Laplace transform of the k-th echo, `k ≥ first.len()`, from that of the first one of these; `None` where
    /// that has exponentials of symbols as coefficients.
    pub fn transform(&self, k: usize, x: &Symbol, p: &Symbol) -> Option<Fraction> {
        let first = self.first.len();
        let mut transform = laplace(&self.echo(first, x), x, p)?;
        for _ in first..k {
            transform = &transform * &self.transform_ratio(p);
        }
        Some(transform)
    }

    /// The k-th echo as a function of `x`. O(k) operations on coefficients.
    pub fn echo(&self, k: usize, x: &Symbol) -> Expression {
        if let Some(echo) = self.first.get(k) {
            return echo.clone();
        }
        let mut sum = Fraction::zero();
        for (lag, coefficient) in &self.terms {
            sum = &sum + &(coefficient * &self.family.function(index(k, *lag), x));
        }
        let power = u32::try_from(k).expect("orders fit 32 bits");
        let sum = &sum * &self.ratio.pow(power);
        let exponent = &self.rate * &Fraction::symbol(x);
        Expression::from(sum).times_exponential(&-&exponent)
    }

    /// The echoes `0 … through` as functions of `x`. Where all constants are rational numbers, a
    /// product and a sum for each coefficient, else as for [`EchoTemplate::echo`].
    pub(crate) fn echoes(&self, through: usize, x: &Symbol) -> Vec<Expression> {
        let first = self.first.iter().take(through + 1).cloned();
        let later = (through >= self.first.len()).then(|| self.numeric_rows(through)).flatten();
        let Some((rate, rows)) = later else {
            return (0..=through).map(|k| self.echo(k, x)).collect();
        };
        let exponent = Fraction::symbol(x).scale(&-rate);
        let echo =
            |row: Univariate| Expression::from(row.to_polynomial(x)).times_exponential(&exponent);
        first.chain(rows.into_iter().map(echo)).collect()
    }

    /// Where all constants are rational numbers: the rate `b`, and the echoes `first.len() …
    /// through` without their exponential `e^{−bx}`. A product and a sum for each coefficient.
    pub(crate) fn numeric_rows(&self, through: usize) -> Option<(Rational, Vec<Univariate>)> {
        let (rate, ratio) = (self.rate.as_constant()?, self.ratio.as_constant()?);
        let terms = self.terms.iter().map(|(lag, c)| Some((*lag, c.as_constant()?)));
        let terms: Vec<(isize, Rational)> = terms.collect::<Option<_>>()?;
        let last = terms.iter().map(|(lag, _)| index(through, *lag)).max();
        let mut family = self.family.rows(last.map_or(0, |last| last + 1))?;
        let mut scale = num_traits::pow(ratio.clone(), self.first.len());
        let rows = (self.first.len()..=through).map(|k| {
            let row = match &terms[..] {
                // The only use of this function.
                [(lag, c)] if (c * &scale).is_one() => {
                    std::mem::replace(&mut family[index(k, *lag)], Univariate::zero())
                }
                terms => terms.iter().fold(Univariate::zero(), |sum, (lag, c)| {
                    &sum + &family[index(k, *lag)].scale(&(c * &scale))
                }),
            };
            scale *= &ratio;
            row
        });
        Some((rate, rows.collect()))
    }
}

/// `k − lag`.
fn index(k: usize, lag: isize) -> usize {
    k.checked_add_signed(-lag).expect("the sum holds from the largest lag on")
}

impl Family {
    /// `T_k(x)`.
    pub fn function(&self, k: usize, x: &Symbol) -> Fraction {
        let k = u32::try_from(k).expect("orders fit 32 bits");
        match self {
            Family::Power => {
                let coefficient = Rational::new(Integer::one(), factorial(k));
                Polynomial::monomial(&coefficient, &[(x, k)]).into()
            }
            Family::Laguerre(c) => (0..=k).fold(Fraction::zero(), |sum, j| {
                let coefficient = Rational::new(binomial(k, j), factorial(j));
                let monomial = Polynomial::monomial(&coefficient, &[(x, j)]);
                &sum + &(&(-c).pow(j) * &monomial.into())
            }),
        }
    }

    /// `T_0 … T_{count−1}` in divided powers, where their coefficients are numbers. With
    /// `c = u/v`, the coefficients of `v^k T_k` are `C(k,j) v^{k−j} (−u)^j`, by Pascal's rule.
    fn rows(&self, count: usize) -> Option<Vec<Univariate>> {
        let c = match self {
            Family::Power => {
                let row = |k: usize| {
                    let zeros = std::iter::repeat_n(Integer::zero(), k);
                    Univariate::new(zeros.chain([Integer::one()]), Integer::one())
                };
                return Some((0..count).map(row).collect());
            }
            Family::Laguerre(c) => c.as_constant()?,
        };
        // Nothing cancels between numerators and denominator, since u and v are coprime.
        let (minus_u, v) = (-c.numer(), c.denom());
        let mut rows = vec![Univariate::constant(&Rational::one())];
        while rows.len() < count {
            let last = rows.last().expect("a row");
            let (row, denominator) = (last.coefficients(), last.denominator() * v);
            let next = IntegerRow::combination(v, row, &minus_u, row, 1);
            rows.push(Univariate::from_row(next, denominator));
        }
        Some(rows)
    }
}

/// A wave with one pole and one lag: `W = S(p,q) / [(p+b) − ρq(p−a)]`.
pub(crate) struct OnePole<'a> {
    assumptions: &'a Assumptions,
    rate: Fraction,
    ratio: Fraction,
    /// `a`, or `None` for the power family.
    zero: Option<Fraction>,
    /// `S`, by lag: a constant and a proper function of p.
    source: Vec<(Expression, Transform)>,
}

impl<'a> OnePole<'a> {
    /// Reads a step that involves its own wave alone; `None` where it has another form.
    pub fn of(step: &Step, assumptions: &'a Assumptions, time: &Symbol) -> Option<OnePole<'a>> {
        let start = step.start.as_ref()?;
        let operator = step.equation.operator(step.wave);
        if operator.reach() > 2 || start.continuous.has_slopes() {
            return None;
        }
        let (slope, value) = (operator.slope_at(1), operator.value_at(1));
        let (ratio, zero) = if slope.is_zero() {
            ((-&value).as_fraction()?, None)
        } else {
            let inverse = assumptions.invert(&slope).ok()?;
            ((-&slope).as_fraction()?, Some((-&(&value * &inverse)).as_fraction()?))
        };
        let source = source(step, time)?;
        Some(OnePole { assumptions, rate: start.rate.clone(), ratio, zero, source })
    }

    fn family(&self) -> Family {
        self.zero.as_ref().map_or(Family::Power, |a| Family::Laguerre(a + &self.rate))
    }

    /// The echoes of `multiplier(q) W` in general k, and the k from which the sum holds; `None`
    /// where a pole of the source meets neither `a` nor `−b`. A pole of the source is absorbed by
    ///
    /// ```text
    /// T_k/(p−a) = (T_{k−1} − T_k)/(a+b),   T_k/(p+b) = (T_k − T_{k+1})/(a+b)     Laguerre, k ≥ 1
    /// T_k/(p+b) = T_{k+1}                                                        Power
    /// ```
    pub fn template(&self, multiplier: &[Expression]) -> Option<(EchoTemplate, usize)> {
        let mut sum = WeightedLags::new();
        if self.ratio.is_zero() {
            // Nothing comes back: there are finitely many echoes.
            let count = self.source.len() + multiplier.len();
            return Some((self.with_terms(Vec::new()), count));
        }
        for (lag, (constant, transform)) in self.source.iter().enumerate() {
            for (extra, factor) in multiplier.iter().enumerate().filter(|(_, c)| !c.is_zero()) {
                // T_{k−lag} comes with ρ^{k−lag}, which is written ρ^k ρ^{−lag}.
                let lag = lag + extra;
                let weight = factor * &self.power_of_inverse_ratio(lag)?;
                let lag = isize::try_from(lag).ok()?;
                *sum.entry(lag).or_default() += &(constant * &weight);
                for (pole, coefficients) in transform.poles() {
                    let [coefficient] = coefficients else { return None };
                    self.absorb(pole, &(coefficient * &weight), lag, &mut sum)?;
                }
            }
        }
        let from = sum.keys().next_back().map_or(0, |lag| usize::try_from(*lag).unwrap_or(0));
        let terms = sum.into_iter().filter(|(_, value)| !value.is_zero());
        let terms = terms.map(|(lag, value)| Some((lag, value.as_fraction()?)));
        Some((self.with_terms(terms.collect::<Option<_>>()?), from))
    }

    fn with_terms(&self, terms: Vec<(isize, Fraction)>) -> EchoTemplate {
        EchoTemplate {
            family: self.family(),
            rate: self.rate.clone(),
            ratio: self.ratio.clone(),
            terms,
            first: Vec::new(),
        }
    }

    /// Adds `value · T_{k−lag} / (p − pole)`.
    fn absorb(
        &self,
        pole: &Fraction,
        value: &Expression,
        lag: isize,
        sum: &mut WeightedLags,
    ) -> Option<()> {
        let at_own_pole = *pole == -&self.rate;
        match &self.zero {
            None if at_own_pole => *sum.entry(lag - 1).or_default() += value,
            Some(a) if a == pole || at_own_pole => {
                let argument = a + &self.rate;
                let part = value * &self.assumptions.invert(&argument.into()).ok()?;
                let (minus, plus) = if at_own_pole { (lag - 1, lag) } else { (lag, lag + 1) };
                *sum.entry(minus).or_default() += &-&part;
                *sum.entry(plus).or_default() += &part;
            }
            _ => return None,
        }
        Some(())
    }

    fn power_of_inverse_ratio(&self, exponent: usize) -> Option<Expression> {
        if exponent == 0 {
            return Some(Expression::one());
        }
        let inverse = self.assumptions.invert(&self.ratio.clone().into()).ok()?;
        Some(inverse.pow(u32::try_from(exponent).ok()?))
    }
}

/// Coefficients of `T_{k−i}`, by lag `i`.
type WeightedLags = BTreeMap<isize, Expression>;

/// `S = −Q + D(q) J(q)`, `J = (start − jumps of forcing)/C(q)`, where it is a polynomial in q.
fn source(step: &Step, time: &Symbol) -> Option<Vec<(Expression, Transform)>> {
    let start = step.start.as_ref()?;
    let mut jumps = vec![start.initial.clone()];
    for (lag, function) in start.continuous.forcing_terms().iter() {
        let mut row = vec![Expression::zero(); lag];
        row.push(-&function.at_zero(time));
        jumps = sum(&jumps, &row);
    }
    let operator = step.equation.operator(step.wave);
    let numerator = product(&operator.slope.dense(), &jumps);
    let constants = divide(&numerator, &start.continuous.operator(step.wave).value.dense())?;
    let forcing = step.equation.forcing_terms();
    let mut source = Vec::new();
    for lag in 0..constants.len().max(forcing.reach()) {
        let forced = |function: &Expression| Transform::of(&-function, time);
        let transform = forcing.get(lag).map_or_else(Transform::zero, forced);
        source.push((constants.get(lag).cloned().unwrap_or_default(), transform));
    }
    Some(source)
}

/// `p / d` as polynomials in q, `d(0) = 1`, where that is exact.
fn divide(p: &[Expression], d: &[Expression]) -> Option<Vec<Expression>> {
    let mut rest = p.to_vec();
    let mut quotient = Vec::new();
    while rest.len() >= d.len() {
        let lead = rest[0].clone();
        for (r, c) in rest.iter_mut().zip(d) {
            *r -= &(c * &lead);
        }
        rest.remove(0);
        quotient.push(lead);
    }
    rest.iter().all(Expression::is_zero).then_some(quotient)
}

/// The coefficients of the value operator of the only wave in a form, where it has no slopes.
pub(crate) fn multiplier(form: &LinearForm, wave: WaveIndex) -> Option<Vec<Expression>> {
    let operator = form.operator(wave);
    let alone = form.operators().all(|(other, _)| other == wave);
    (alone && operator.slope.is_empty()).then(|| operator.value.dense())
}
