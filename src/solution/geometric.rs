//! Sequences `Σ_i c_i n^{j_i} λ_i^n`: the general form of algebraic recurrences.

use crate::expression::{Assumptions, Expression};
use crate::recurrence::Lags;
use num_integer::Integer as _;
use num_traits::{One, Signed, ToPrimitive};
use wavestep_polynomial::{Integer, Polynomial, Rational, Symbol};

/// The most ratios, with multiplicity, of a closed form.
const MAX_RATIOS: usize = 16;

/// One term `coefficient · n^power · ratio^n`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct GeometricTerm {
    pub coefficient: Expression,
    pub power: u32,
    /// The ratio `λ`; `λ^0 = 1`, also for `λ = 0`.
    pub ratio: Expression,
}

/// A sequence in general n,
///
/// ```text
/// w[n] = first[n]                      for n < first.len()
///      = Σ_i c_i n^{j_i} λ_i^n         for n ≥ first.len()
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Geometric {
    /// The values that the sum does not give.
    pub first: Vec<Expression>,
    /// The terms of the sum, none zero.
    pub terms: Vec<GeometricTerm>,
}

/// A generating function `Σ_n w[n] q^n = numerator(q) / denominator(q)`, coefficients ascending,
/// `denominator(0) = 1`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Generating {
    pub numerator: Vec<Expression>,
    pub denominator: Vec<Expression>,
}

impl Generating {
    /// The series coefficients `w[0], …, w[count−1]`.
    pub fn series(&self, count: usize) -> Vec<Expression> {
        let mut values: Vec<Expression> = Vec::new();
        for n in 0..count {
            let mut value = self.numerator.get(n).cloned().unwrap_or_default();
            for (lag, coefficient) in self.denominator.iter().enumerate().take(n + 1).skip(1) {
                value -= &(coefficient * &values[n - lag]);
            }
            values.push(value);
        }
        values
    }

    /// `multiplier(q) · self + constants(q)/(1−q)`.
    pub fn combined(&self, multiplier: &[Expression], constants: &[Expression]) -> Generating {
        let step = [Expression::one(), Expression::integer(-1)];
        let main = product(&product(multiplier, &self.numerator), &step);
        let added = product(constants, &self.denominator);
        Generating { numerator: sum(&main, &added), denominator: product(&self.denominator, &step) }
    }

    /// Takes common factors `1 − q` out of numerator and denominator.
    fn cancel(mut self) -> Generating {
        let vanishes = |p: &[Expression]| {
            let value = p.iter().fold(Expression::zero(), |sum, c| &sum + c);
            value.is_zero() && !p.is_empty()
        };
        while vanishes(&self.numerator) && vanishes(&self.denominator) {
            self.numerator = divide_by_one_minus(&self.numerator, &Expression::one());
            self.denominator = divide_by_one_minus(&self.denominator, &Expression::one());
        }
        trim(&mut self.numerator);
        trim(&mut self.denominator);
        self
    }

    /// The general term, where the ratios can be found and told apart.
    pub fn closed_form(self, assumptions: &Assumptions) -> Option<Geometric> {
        let generating = self.cancel();
        if generating.denominator.len() > MAX_RATIOS + 1 {
            return None;
        }
        let ratios = ratios(&generating.denominator)?;
        let order = generating.denominator.len() - 1;
        let from = generating.numerator.len().saturating_sub(order);
        let values = generating.series(from + order);
        let mut basis = Vec::new();
        for (ratio, multiplicity) in &ratios {
            basis.extend((0..*multiplicity).map(|power| (power, ratio.clone())));
        }
        let rows = (from..from + order).map(|n| {
            let entry = |(power, ratio): &(u32, Expression)| term_at(n, *power, ratio);
            (basis.iter().map(entry).collect(), values[n].clone())
        });
        let coefficients = solve_linear(rows.collect(), assumptions)?;
        let terms = basis
            .into_iter()
            .zip(coefficients)
            .filter(|(_, c)| !c.is_zero())
            .map(|((power, ratio), coefficient)| GeometricTerm { coefficient, power, ratio });
        let form = Geometric { first: values[..from].to_vec(), terms: terms.collect() };
        form.satisfies(&generating.denominator).then_some(form)
    }
}

impl Geometric {
    /// The sequence times a number that is not zero.
    pub(crate) fn scaled(&self, factor: &Rational) -> Geometric {
        let first = self.first.iter().map(|value| value.scale(factor)).collect();
        let scaled = |term: &GeometricTerm| GeometricTerm {
            coefficient: term.coefficient.scale(factor),
            ..term.clone()
        };
        Geometric { first, terms: self.terms.iter().map(scaled).collect() }
    }

    pub fn value(&self, n: usize) -> Expression {
        if let Some(value) = self.first.get(n) {
            return value.clone();
        }
        self.terms.iter().fold(Expression::zero(), |sum, term| {
            &sum + &(&term.coefficient * &term_at(n, term.power, &term.ratio))
        })
    }

    /// Whether the sum satisfies `Σ_j d_j w[n−j] = 0` for every n, with each `λ^n` a symbol of its
    /// own: for every ratio, `Σ_j d_j Σ_i c_i (n−j)^{j_i} λ^{order−j}` vanishes as a polynomial in n.
    pub(crate) fn satisfies(&self, denominator: &[Expression]) -> bool {
        let n = Symbol::new("n").expect("a name");
        let order = denominator.len() - 1;
        let mut ratios: Vec<&Expression> = self.terms.iter().map(|term| &term.ratio).collect();
        ratios.dedup();
        ratios.into_iter().all(|ratio| {
            let mut residual = Expression::zero();
            for (lag, coefficient) in denominator.iter().enumerate() {
                let shifted = &Polynomial::symbol(&n) - &Polynomial::integer(lag);
                let exponent = u32::try_from(order - lag).expect("orders are small");
                let factor = coefficient * &ratio.pow(exponent);
                for term in self.terms.iter().filter(|term| &term.ratio == ratio) {
                    let power = Expression::from(shifted.pow(term.power));
                    residual += &(&(&term.coefficient * &factor) * &power);
                }
            }
            residual.is_zero()
        })
    }
}

fn term_at(n: usize, power: u32, ratio: &Expression) -> Expression {
    let n = u32::try_from(n).expect("orders are small");
    ratio.pow(n).scale(&Rational::from_integer(Integer::from(n).pow(power)))
}

fn trim(p: &mut Vec<Expression>) {
    while p.last().is_some_and(Expression::is_zero) {
        p.pop();
    }
}

pub(crate) fn sum(left: &[Expression], right: &[Expression]) -> Vec<Expression> {
    let at = |p: &[Expression], i: usize| p.get(i).cloned().unwrap_or_default();
    let mut sum = (0..left.len().max(right.len())).map(|i| &at(left, i) + &at(right, i)).collect();
    trim(&mut sum);
    sum
}

pub(crate) fn product(left: &[Expression], right: &[Expression]) -> Vec<Expression> {
    let mut product = vec![Expression::zero(); (left.len() + right.len()).saturating_sub(1)];
    for (i, l) in left.iter().enumerate() {
        for (j, r) in right.iter().enumerate() {
            product[i + j] += &(l * r);
        }
    }
    trim(&mut product);
    product
}

/// `p / (1 − λq)` where that is exact.
fn divide_by_one_minus(p: &[Expression], ratio: &Expression) -> Vec<Expression> {
    let mut quotient: Vec<Expression> = Vec::new();
    for coefficient in &p[..p.len() - 1] {
        let carried = quotient.last().map_or_else(Expression::zero, |last| last * ratio);
        quotient.push(coefficient + &carried);
    }
    quotient
}

/// The ratios `λ_i` with multiplicities such that `denominator = Π (1 − λ_i q)^{m_i}`.
fn ratios(denominator: &[Expression]) -> Option<Vec<(Expression, u32)>> {
    let mut rest = denominator.to_vec();
    let mut found: Vec<(Expression, u32)> = Vec::new();
    while rest.len() > 1 {
        let ratio = match &rest[..] {
            [_, slope] => -slope,
            _ => candidates(&rest).into_iter().find(|ratio| is_ratio(&rest, ratio))?,
        };
        rest = divide_by_one_minus(&rest, &ratio);
        trim(&mut rest);
        match found.iter_mut().find(|(known, _)| *known == ratio) {
            Some((_, multiplicity)) => *multiplicity += 1,
            None => found.push((ratio, 1)),
        }
    }
    Some(found)
}

/// Whether `1 − λq` divides: the reversed polynomial vanishes at `λ`.
fn is_ratio(p: &[Expression], ratio: &Expression) -> bool {
    let horner = |value: Expression, coefficient: &Expression| &(&value * ratio) + coefficient;
    p.iter().fold(Expression::zero(), horner).is_zero()
}

/// Numbers that may be ratios: ±1, and by the rational root theorem the quotients of divisors
/// where all coefficients are rational numbers of moderate size.
fn candidates(p: &[Expression]) -> Vec<Expression> {
    let mut candidates = vec![Rational::one(), -Rational::one()];
    let constants: Option<Vec<Rational>> = p.iter().map(Expression::as_constant).collect();
    if let Some(constants) = constants {
        let scale = constants.iter().fold(Integer::one(), |d, c| d.lcm(c.denom()));
        let end = |value: Option<&Rational>| value.map(|v| (v * &scale).to_integer());
        let (lead, last) = (end(constants.first()), end(constants.last()));
        let divisors = |value: Option<Integer>| {
            let value = value.and_then(|v| v.abs().to_u32()).filter(|v| *v <= 100_000);
            let value = value.unwrap_or(0);
            (1..=value).filter(|d| value.is_multiple_of(*d)).map(Integer::from).collect::<Vec<_>>()
        };
        let (numerators, denominators) = (divisors(last), divisors(lead));
        for numerator in &numerators {
            for denominator in &denominators {
                let ratio = Rational::new(numerator.clone(), denominator.clone());
                candidates.extend([ratio.clone(), -ratio]);
            }
        }
    }
    candidates.iter().map(Expression::constant).collect()
}

type LinearRow = (Vec<Expression>, Expression);

/// Solves a square linear system by elimination, dividing by declared factors only.
fn solve_linear(mut rows: Vec<LinearRow>, assumptions: &Assumptions) -> Option<Vec<Expression>> {
    let order = rows.len();
    for column in 0..order {
        let (pivot, inverse) = (column..order).find_map(|i| {
            assumptions.invert(&rows[i].0[column]).ok().map(|inverse| (i, inverse))
        })?;
        rows.swap(column, pivot);
        let (coefficients, value) = &mut rows[column];
        coefficients.iter_mut().for_each(|c| *c = &*c * &inverse);
        *value = &*value * &inverse;
        let (pivot_row, pivot_value) = rows[column].clone();
        for (i, (coefficients, value)) in rows.iter_mut().enumerate() {
            let factor = coefficients[column].clone();
            if i == column || factor.is_zero() {
                continue;
            }
            for (c, p) in coefficients.iter_mut().zip(&pivot_row) {
                *c -= &(p * &factor);
            }
            *value -= &(&pivot_value * &factor);
        }
    }
    Some(rows.into_iter().map(|(_, value)| value).collect())
}

/// The forcing of a form where it does not depend on time, by lag.
pub(crate) fn constant_forcing(forcing: &Lags, time: &Symbol) -> Option<Vec<Expression>> {
    let constant = forcing.values().all(|function| !function.contains(time));
    constant.then(|| forcing.dense())
}
